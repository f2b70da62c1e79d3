"""Rates of a sine or a cosine that an answer states for itself, d/dt sin(φ − θ) = φ̇ cos(φ − θ), and what follows from a
wrong one: d/dt ∂T*/∂ξ̇ in which it is put.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import given, index_of, right_value
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status
from lagrangian.model import time
from lagrangian.page.formula import text

NAME = "inner_derivative"
WHY = text("Chain rule: the derivative of a function of an angle is multiplied by the rate of the whole angle.")


def _stated(truth: Reference, line: AnsweredLine) -> tuple[sp.Expr, sp.Expr, sp.Expr] | None:
    """The function of which a line states the rate, its rate, and what is written; None for another line."""
    if line.kind != "identity" or line.name is not None or line.sides is None or truth.values:
        return None
    right, written = (truth.expand(x) for x in line.sides)
    for f in sorted(truth.T.atoms(sp.sin, sp.cos), key=sp.default_sort_key):
        if f.args[0].has(*(c.symbol for c in truth.model.coordinates)):
            rate = bounded.diff(cast("sp.Expr", f), time)
            if bounded.expand(rate - right) == 0:
                return cast("sp.Expr", f), rate, written
    return None


def slip_in_inner_rate(truth: Reference, line: AnsweredLine) -> Mistake | None:
    """What is said of a wrong rate of a function; None for another line."""
    if (stated := _stated(truth, line)) is None:
        return None
    f, rate, written = stated
    what = text(f"{line.opening} is not right: the derivative of ", f, " by time is ", rate, ", not ", written, ".")
    return Mistake(NAME, what, WHY, 5, None, None, text(f"{line.opening} is not right."))


def follow_from_inner_rates(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with the derivatives by time marked that are right with a wrong rate of a function above them."""
    wrong = [(f, x) for f in findings if f.status is Status.WRONG and (x := _stated(truth, f.line)) is not None]
    if not wrong:
        return list(findings)
    own = given(truth, [f.line for f in findings])
    T = truth.T if own.T is None else own.T

    def follows(finding: Finding) -> bool:
        line, i = finding.line, index_of(truth, finding.line.name)
        if finding.status is not Status.WRONG or line.kind not in ("T-rate", "p-rate") or i is None:
            return False
        right = right_value(truth, line, i)
        if right is None:
            return False
        momentum = truth.expand(bounded.diff(T, truth.model.coordinates[i].rate))
        for w, (f, rate, written) in wrong:
            place = sp.Dummy()
            slope = bounded.diff(cast("sp.Expr", momentum.xreplace({f: place})), place).xreplace({place: f})
            extra = cast("sp.Expr", slope) * (written - rate)
            rest = truth.expand(line.expr - right)
            above = w.line.number <= line.number and extra != 0
            if above and any(zero_everywhere(truth, rest - s * extra) for s in (1, -1)):
                return True
        return False

    told = {id(w) for w, _ in wrong}
    found = [replace(f, follows=True) if not f.follows and follows(f) else f for f in findings]
    return [replace(f, differences=()) if id(f) in told else f for f in found]
