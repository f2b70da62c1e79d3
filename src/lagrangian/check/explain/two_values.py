"""A name with two values of which one follows from the lines above: r_s = ∂r/∂s = 1 where r = a + s cos β."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status
from lagrangian.page.formula import text

WHY = text("Work it out once more: differentiate term by term, and keep the factor of what is differentiated.")
WHY_VALUE = text("A name has one value: work it out once more.")


def _values(truth: Reference, line: AnsweredLine) -> tuple[sp.Expr, sp.Expr] | None:
    """The value that follows and the one that is written, in a line without rates that gives a name two."""
    if line.kind != "identity" or line.name is not None or line.sides is None or line.text.count("=") < 2:
        return None
    one, other = (cast("sp.Expr", truth.expand(x)) for x in line.sides)
    return None if 0 in (one, other) or one.has(sp.Derivative) or other.has(sp.Derivative) else (one, other)


def slip_in_values(truth: Reference, line: AnsweredLine) -> Mistake | None:
    """That both values are not the same; None for any other line."""
    values = _values(truth, line)
    if values is None:
        return None
    what = text(f"{line.opening} is not right: ", values[0], " is not ", values[1], ".")
    why = WHY if "∂" in line.text or "partial" in line.text else WHY_VALUE
    return Mistake("two_values", what, why, 5, brief=text(f"{line.opening} gives a name two values."))


def follow_from_values(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with those marked in which nothing is wrong but that one value stands for the other."""
    wrong = [f for f in findings if f.is_open]
    pairs = [(f.line.number, x) for f in wrong if (x := _values(truth, f.line)) is not None]
    found: list[Finding] = []
    for f in findings:
        if any(f is x for x in wrong) and _values(truth, f.line) is not None:
            found.append(replace(f, differences=()))
            continue
        own = [x for number, x in pairs if number <= f.line.number]
        follows = f.status is Status.WRONG and bool(f.differences) and any(_only(f, *x) for x in own)
        found.append(replace(f, follows=True) if follows else f)
    return found


def _only(finding: Finding, right: sp.Expr, written: sp.Expr) -> bool:
    """Whether in all terms that differ one value stands in place of another."""
    times = bounded.cancel(right / written)
    pairs = [(d.term, d.written) for d in finding.differences]
    return all(y != 0 and bounded.cancel(x / y / times) == 1 for x, y in pairs)
