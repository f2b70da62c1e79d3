"""What is said of a prescribed motion u = U sin Ωt whose letter a mistake leaves out or turns.

A term with U Ω cos Ωt that is missing lacks no Ω: the rate u̇ of the prescribed motion is left out.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.explain.changes.change import LocalChange, Words
from lagrangian.check.explain.changes.ring import Monomial, TooLong
from lagrangian.check.explain.changes.sites import Sites
from lagrangian.model import Model, time

OF_LETTERS = ("left_out_of_a_sum", "sign_in_a_sum")
"""The kinds of changes that leave out or turn everything with one letter."""
ORDERS = {0: "", 1: "the rate ", 2: "the acceleration "}
"""What the time derivatives of a motion are called."""
OF_MOTION = " of the prescribed motion"


def of_given(change: LocalChange, sites: Sites) -> LocalChange:
    """The change of one of `OF_LETTERS`, of which the motion that it leaves out or turns is said, or its rate, and not
    the letter of it."""
    letter: Any = change.right
    if not isinstance(letter, sp.Symbol):
        return change
    given = [(x, f) for x, f in _motions(sites) if f.has(letter)]
    if len(given) != 1:
        return change
    [(symbol, value)] = given
    if not bounded.diff(value, time, time).has(letter):
        return change  # of Ω t it is the rate itself
    once = [m for s in change.effect.sums() for m in s if _is_once_in_time(sites, m)]  # cos² Ωt is 1 − sin² Ωt there
    orders = {_order(sites, m, value) for m in once}
    if None in orders or not orders:
        return change
    order = orders.pop() if len(orders) == 1 else None
    return replace(change, right=_words(symbol, order or 0))


def _words(symbol: sp.Expr, order: int) -> Words:
    """A motion, or its rate or acceleration, in words."""
    if order == 0:
        return ("the prescribed motion ", symbol)
    return (ORDERS[order], cast("sp.Expr", sp.diff(symbol, (time, order))), OF_MOTION)


def _motions(sites: Sites) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """The motions of a system that time alone gives, each as it is called and what it is."""
    s, named = sites.of, list[sp.Expr]()
    for symbol, value in given_motions(s.model):
        named.append(value)
        yield symbol, value
    known = {x for f in named for x in f.free_symbols} - {time}
    yield from ((x, x) for x in s.driven if not x.free_symbols & known)


def given_motions(model: Model) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """The definitions of a system that time alone gives, u = U sin Ωt: their symbols, and what these are."""
    for d in model.definitions:
        value = model.expand(d.symbol, constants=True)
        if d.moving and not value.has(*(x.symbol for x in (*model.coordinates, *model.inputs))):
            yield d.symbol, value


def _is_once_in_time(sites: Sites, monomial: Monomial) -> bool:
    """Whether a term has one factor that time alone gives, no square of one."""
    exprs = [(sites.ring.atoms[a], e) for a, e in monomial]
    return sum(abs(e) for x, e in exprs if x.has(time) and not x.has(AppliedUndef)) == 1


def _order(sites: Sites, monomial: Monomial, value: sp.Expr) -> int | None:
    """The highest derivative of a motion by which a term can be divided; None if it has none."""
    held = dict(monomial)
    for order in (2, 1, 0):
        try:
            parts = sites.ring.of(bounded.diff(value, *[time] * order))
        except TooLong:
            return None
        if any(all(held.get(a, 0) >= e for a, e in m) and m for m in parts):
            return order
    return None
