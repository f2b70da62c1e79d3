"""Which lines follow from a wrong rate of a prescribed motion: ü = Ω² u for −Ω² u, and the term J ü/r² with it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.below_wrong_constraints import is_spanned
from lagrangian.check.explain.given_said import given_motions
from lagrangian.check.prescribed import own_rate
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Status
from lagrangian.model import time

ORDERS = (2, 1, 0)


def follow_from_given_rates(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with those marked that are right with the rates of prescribed motions that the answer states."""
    found = list(findings)
    for symbol, value in given_motions(truth.model):
        base = str(symbol.func)
        said: dict[int, sp.Expr] = {}
        for k, f in enumerate(found):
            name = f.line.name or ""
            order = name.count("'")
            if f.line.kind != "identity" or name.rstrip("'") != base or f.status is not Status.WRONG or not order:
                continue
            stated = cast("sp.Expr", bounded.diff(value, *[time] * order) - f.line.expr)
            if order == 2 and 1 in said and zero_everywhere(truth, bounded.diff(said[1], time) - stated):
                found[k] = replace(f, follows=True)
            said.setdefault(order, stated)
        if said:
            rates = [(k, x) for k in ORDERS if not isinstance(x := bounded.diff(value, *[time] * k), sp.Add)]
            found = _with_following(truth, found, [(k, x) for k, x in rates if x.has(time)], said)
    for f in tuple(found):
        own = own_rate(truth, f.line) if f.status is Status.WRONG else None
        if own is not None and not isinstance(own[0], sp.Add):
            found = _with_following(truth, found, [(0, own[0])], {0: own[1]})
    return found


def _with_following(
    truth: Reference,
    findings: Sequence[Finding],
    rates: Sequence[tuple[int, sp.Expr]],
    said: Mapping[int, sp.Expr],
) -> list[Finding]:
    """The findings, with the equations and T* that are right with what is ``said`` of the ``rates`` of a motion."""
    rows = [_with_rates(truth, row, rates, said) for row in truth.rows]
    T = _with_rates(truth, truth.T, rates, said)

    def follows(line: AnsweredLine) -> bool:
        if line.kind == "equation":
            return is_spanned(truth, line.expr, rows)
        return line.kind == "T" and zero_everywhere(truth, line.expr - T)

    return [replace(f, follows=True) if f.is_open and follows(f.line) else f for f in findings]


def _with_rates(
    truth: Reference, expr: sp.Expr, rates: Sequence[tuple[int, sp.Expr]], said: Mapping[int, sp.Expr]
) -> sp.Expr:
    """An expression with the rates that are ``said`` in the terms that have the right ones, once or squared."""
    model = truth.model
    moving: list[Any] = [x for c in model.coordinates for x in (c.acceleration, c.rate, c.symbol)]
    held: dict[Any, Any] = {x: sp.Dummy() for x in (*moving, *(u.symbol for u in model.inputs))}
    back = {d: x for x, d in held.items()}
    total: list[sp.Expr] = []
    hidden = cast("sp.Expr", truth.expand(expr).xreplace(held))
    functions = [x for x in hidden.atoms(sp.sin, sp.cos) if x.has(time)]
    turned = {x: sp.Dummy() for x in functions if x.has(*back) or x.args[0].has(sp.sin, sp.cos)}  # the place is right
    hidden, inner = cast("sp.Expr", hidden.xreplace(turned)), {d: x for x, d in turned.items()}
    for term in sp.Add.make_args(bounded.expand(hidden)):
        total.append(_term_with_rates(term, rates, said))
    return cast("sp.Expr", sp.Add(*total).xreplace(inner).xreplace(back))


def _term_with_rates(term: sp.Expr, rates: Sequence[tuple[int, sp.Expr]], said: Mapping[int, sp.Expr]) -> sp.Expr:
    """A term with the rate that is ``said`` in place of the right one."""
    for order, rate in rates:
        for power in (2, 1):
            rest = cast("sp.Expr", term / rate**power)
            below = sp.fraction(rest)[1].free_symbols - sp.fraction(term)[1].free_symbols
            if not rest.has(time) and not below & rate.free_symbols:
                return cast("sp.Expr", rest * said.get(order, rate) ** power)
    return term
