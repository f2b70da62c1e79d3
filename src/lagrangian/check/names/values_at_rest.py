"""Values at rest that an answer subtracts and may leave open: p = φ − φ₀ and u = τ − τ₀ are deviations from rest.

The system rests at these values: its equations hold there, with all rates 0. Those of a uniform motion, w = φ′ − Ω, may
be any.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Verdict
from lagrangian.model import Model, time


def values_at_rest(model: Model, lines: Sequence[AnsweredLine]) -> dict[sp.Expr, sp.Symbol]:
    """Return the names that an answer gives to values of coordinates and inputs, of which the deviations have names."""
    known = {p.symbol for p in model.parameters}
    found = ((x, own / time if own.has(time) else own) for x, own in constants_subtracted(model, lines).items())
    return {x: own for x, own in found if isinstance(own, sp.Symbol) and own not in known and own != time}


def equations_at_rest(truth: Reference, lines: Sequence[AnsweredLine]) -> list[sp.Expr]:
    """Return what is 0 where a system rests at the values of which an answer names the deviations; none without."""
    model = truth.model
    found, named = constants_subtracted(model, lines), values_at_rest(model, lines)
    if truth.derivation.multipliers or not any(c.symbol in named for c in model.coordinates):
        return []
    if any(c.rate in found or found.get(c.symbol, sp.S.Zero).has(time) for c in model.coordinates):
        return []  # it does not rest
    rest: dict[Any, Any] = {x: sp.S.Zero for c in model.coordinates for x in (c.rate, c.acceleration)}
    rest |= {c.symbol: found.get(c.symbol, c.symbol) for c in model.coordinates}
    rest |= {u.symbol: found.get(u.symbol, sp.S.Zero) for u in model.inputs}
    return [cast("sp.Expr", row.xreplace(rest)) for row in truth.rows]


def constants_subtracted(model: Model, lines: Sequence[AnsweredLine]) -> dict[sp.Expr, sp.Expr]:
    """Return the constants that definitions subtract from coordinates, their rates and inputs; Ω t of φ − Ω t, too."""
    moving = [*(x for c in model.coordinates for x in (c.symbol, c.rate)), *(u.symbol for u in model.inputs)]
    found: dict[sp.Expr, sp.Expr] = {}
    for line in lines:
        for x in moving if line.kind == "definition" and line.expr.is_Add else ():
            own = cast("sp.Expr", x - line.expr)
            if not own.has(AppliedUndef):
                found.setdefault(x, own)
    return found


def with_work_at_rest(
    truth: Reference,
    lines: tuple[AnsweredLine, ...],
    values: Mapping[sp.Expr, sp.Expr],
    fits: Callable[[Sequence[AnsweredLine]], bool],
) -> tuple[AnsweredLine, ...]:
    """Return the lines with V and Ξ that count the constant ``values`` of inputs at rest in Ξ, if that makes V fit.

    A holding torque that is left out with the weight which it balances is conservative: its work is in V.
    """
    inputs: dict[Any, Any] = {u.symbol: values.get(u.symbol, sp.S.Zero) for u in truth.model.inputs}
    if not any(u.symbol in values for u in truth.model.inputs) or not any(x.kind in ("V", "L") for x in lines):
        return lines
    inputs |= {c.rate: sp.S.Zero for c in truth.model.coordinates}
    held = [cast("sp.Expr", truth.expand(x).xreplace(inputs)) for x in truth.Xi]
    if any(x.has(AppliedUndef) for x in held):
        return lines
    work = sum((f * c.symbol for f, c in zip(held, truth.model.coordinates, strict=True)), sp.S.Zero)
    of = {c.name: f for c, f in zip(truth.model.coordinates, held, strict=True)}
    added = {
        "V": lambda x: x.expr + work,
        "L": lambda x: x.expr - work,
        "Xi": lambda x: x.expr + of.get(str(x.name), 0),
    }
    put = tuple(replace(x, expr=added[x.kind](x)) if x.kind in added else x for x in lines)
    return put if fits([x for x in put if x.kind in ("V", "L")]) else lines


def without_balanced_weights(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict on an answer in deviations from rest, in which a wrong term is told without the weight that is
    balanced at rest by what it should be: k (z − y) is, written out, k (z₀ − y₀), too."""
    if verdict.right or not values_at_rest(truth.model, lines):
        return verdict
    findings: list[Finding] = []
    for f in verdict.findings:
        kept = tuple(d for d in f.differences if d.term.has(AppliedUndef) or d.written.has(AppliedUndef))
        findings.append(replace(f, differences=kept) if kept and len(kept) < len(f.differences) else f)
    return replace(verdict, findings=tuple(findings))
