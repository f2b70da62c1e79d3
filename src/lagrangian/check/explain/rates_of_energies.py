"""Rates of energies in a balance of powers, dT/dt = I θ' θ'' + I' θ'³: which term is wrong, and what follows from it.

With one coordinate, dT/dt + dV/dt − P is its rate times its equation: what dT/dt has too much, the equation has too
much times the rate.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import alignments
from lagrangian.check.explain.derivative_lines import LONGEST, replaced
from lagrangian.check.explain.own_terms import term_replaced
from lagrangian.check.reference import Reference
from lagrangian.check.rows import same_values, zero_everywhere
from lagrangian.check.stated import given
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.model import time
from lagrangian.page.formula import Left, Name, Total, text

WHY = text(
    "Product and chain rule: what stands before the square of a rate is differentiated too, once, and it keeps the ½ "
    "of the energy; the square gives twice the rate times the acceleration, which cancels this ½."
)
WHY_V = text("dV/dt is the sum of the slopes of V, each times the rate of its coordinate.")
STEP = 5
"""The step of the derivatives."""
SMALL = 1e-9
"""The relative size of a difference that is rounding."""


def rate_stated(truth: Reference, line: AnsweredLine, lines: Sequence[AnsweredLine]) -> tuple[str, sp.Expr] | None:
    """Which energy a line gives the rate of, "T" or "V", and what that is; None for another line."""
    if line.kind != "identity" or line.name is not None or line.sides is None:
        return None
    above = given(truth, [x for x in lines if x.number <= line.number])
    for kind, own, right in (("T", above.T, truth.T), ("V", above.V, truth.V)):
        rate = bounded.diff(right if own is None else own, time)
        if rate != 0 and zero_everywhere(truth, truth.expand(line.sides[0]) - rate):
            return kind, rate
    return None


def slip_in_rate(truth: Reference, line: AnsweredLine, lines: Sequence[AnsweredLine]) -> Mistake | None:
    """The one term of such a rate that is wrong; None if it is more."""
    stated = rate_stated(truth, line, lines)
    if stated is None:
        return None
    kind, rate = stated
    rest, right = ([x for x in sp.Add.make_args(bounded.expand(e)) if x != 0] for e in (-line.expr, rate))
    pair = replaced(rest, right) if rest and len(right) <= LONGEST else None
    if pair is None:
        return None
    title: Left = Total(Name("T*" if kind == "T" else "V"))
    name, said = term_replaced(*(cast("sp.Expr", sp.factor_terms(x)) for x in pair))
    first, *others = said.parts
    words = str(first)
    what = text("In ", title, ": " if words.startswith("In ") else ", ", words[:1].lower() + words[1:], *others)
    brief = text("A term of ", title, " is not right.")
    return Mistake(name, what, WHY if kind == "T" else WHY_V, STEP, None, None, brief)


def follow_from_rates(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with the equation of the one coordinate marked if it has just what such a rate has too much."""
    lines = [f.line for f in findings]
    wrong = [f for f in findings if f.is_open and rate_stated(truth, f.line, lines) is not None]
    rows = [f for f in findings if f.is_open and f.line.kind == "equation"]
    told = {id(f) for f in wrong if f.differences and slip_in_rate(truth, f.line, lines) is not None}
    findings = [replace(f, differences=()) if id(f) in told else f for f in findings]  # left minus right nobody wrote
    if truth.n != 1 or not wrong or not rows:
        return findings
    rate = truth.states.of(truth.model.coordinates[0].rate)
    extra = CompiledExpressions([f.line.expr for f in wrong]).at(truth.states)
    values = CompiledExpressions([f.line.expr for f in rows]).at(truth.states)
    follow: set[int] = set()
    for f, P in zip(rows, values, strict=True):
        above = [x for w, x in zip(wrong, extra, strict=True) if w.line.number <= f.line.number]
        for a in alignments(truth, [f.line.expr], P[None]) if np.isfinite(P).all() else ():
            if any(same_values(-a.rest[0] * rate, x, SMALL) for x in above):
                follow.add(id(f))
    return [replace(f, follows=True) if id(f) in follow else f for f in findings]
