"""What an answer says of virtual displacements, δs = −δx (x − s cos β)/(s − x cos β), judged as one of rates."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reading.placeholders import variation
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.model import time
from lagrangian.model.rows import rows_of

MOVES = "virtual displacements"
"""The name of such a line once its displacements are rates."""


def with_virtual_displacements(
    truth: Reference,
    lines: Sequence[AnsweredLine],
    verdict: Verdict,
    judge: Callable[[Sequence[AnsweredLine]], Verdict],
) -> tuple[Sequence[AnsweredLine], Verdict]:
    """The lines of a wrong answer with relations of virtual displacements as relations of rates, and the verdict on
    them; only where no constraint is driven, so that displacements are as rates."""
    if verdict.status is not Status.WRONG or not _are_undriven(truth):
        return lines, verdict
    rates = {variation(c.name): c.rate for c in truth.model.coordinates}
    moved = {id(x): y for x in lines if (y := _in_rates(truth, x, rates)) is not None}
    if not moved:
        return lines, verdict
    told = judge(list(moved.values())).findings
    findings = sorted([*verdict.findings, *told], key=lambda f: f.line.number)
    return [moved.get(id(x), x) for x in lines], replace(verdict, findings=tuple(findings))


def _are_undriven(truth: Reference) -> bool:
    """Whether no constraint asks for a rate of its own."""
    still: dict[Any, Any] = {c.rate: sp.S.Zero for c in truth.model.coordinates}
    return all(bounded.replaced(truth.expand(row.rate), still) == 0 for row in rows_of(truth.model))


def _in_rates(truth: Reference, line: AnsweredLine, rates: dict[Any, Any]) -> AnsweredLine | None:
    """A line that is linear in virtual displacements, with factors of positions alone, in rates; None for any other."""
    held = [x for x in rates if line.expr.has(x)]
    if line.kind != "statement" or len(held) < 2:
        return None
    slopes = [bounded.diff(line.expr, x) for x in held]
    places = {time, *truth.derivation.coordinates, *(p.symbol for p in truth.model.parameters)}
    if any(a.has(sp.Derivative) or not bounded.letters(a) <= places for a in slopes):
        return None
    if bounded.cancel(line.expr - sp.Add(*[a * x for a, x in zip(slopes, held, strict=True)])) != 0:
        return None
    expr, _ = sp.fraction(bounded.together(line.expr))
    return replace(line, kind="equation", name=MOVES, expr=cast("sp.Expr", expr.xreplace(rates)))
