"""What a term too much comes from: a mass that another body has already, or a force with another arm.

½ m ż² beside ½ m ṡ²     m is counted twice, here with ż
F (1 + r/R) for F        the force counts with the factor 1 + r/R
"""

from __future__ import annotations

from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.changes.change import Words
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.efforts import Effort
from lagrangian.check.explain.quoted import letters_in
from lagrangian.model import Element, RigidBody, time
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class TooMuch:
    """Why a term is too much, as the end of a sentence, and the element of which it is."""

    words: Words
    element: Element


def too_much(
    pool: Pool, kind: str, row: int | None, term: sp.Expr, effort: Effort | None, scale: sp.Expr | None = sp.S.One
) -> TooMuch | None:
    """Why a term of T*, or of an equation, ``scale`` times the right one, or a Ξ, is too much; None if nothing is
    known of it."""
    if kind == "T":
        return _mass_twice(pool, term)
    if effort is None or effort.damper or effort.element is None or row is None or not scale:
        return None
    return _other_arm(pool, row, effort.element, cast("sp.Expr", -term / scale if kind == "equation" else term))


def _mass_twice(pool: Pool, term: sp.Expr) -> TooMuch | None:
    """The mass or the moment of inertia of the one element that has it, with the rate of another one."""
    s, rates = pool.sites.of, [v for v in pool.sites.of.v if term.has(v)]
    if len(rates) != 1 or bounded.cancel(term / rates[0] ** 2).has(*s.q, *s.v):
        return None
    held: list[tuple[Element, set[Any]]] = [(b, _inertias(s.expand(b.mass), b)) for b in s.bodies]
    held += [(e, _masses(s.kinetic(e))) for e in pool.sites.others]
    owners = [(p, e) for e, letters in held for p in letters if term.has(p) and not (term / p).has(p)]
    if len(owners) != 1 or s.kinetic(owners[0][1]).has(rates[0]):
        return None
    [(p, e)] = owners
    return TooMuch((": ", p, f" of {e.title} is counted twice, here with ", rates[0]), e)


def _inertias(mass: sp.Expr, body: Any) -> set[Any]:
    """The letters that are the mass of a body, or one of its moments of inertia."""
    return {x for x in (mass, *(body.inertia if isinstance(body, RigidBody) else ())) if x.is_Symbol}


def _masses(T: sp.Expr) -> set[Any]:
    """The letters of an energy that stand once in all terms that have them."""
    parts = sp.Add.make_args(bounded.expand(T))
    return {p for p in T.free_symbols - {time} if all(not x.has(p) or not (x / p).has(p) for x in parts)}


def _other_arm(pool: Pool, row: int, element: Element, more: sp.Expr) -> TooMuch | None:
    """The factor with which a force counts in an equation, where it has ``more`` of its Ξ than it should."""
    s = pool.sites.of
    share = s.shares(element).get(row, sp.S.Zero)
    letters = [x for x in letters_in(more) & letters_in(share) if x not in (*s.q, *s.v)]
    efforts = [x for x in letters if any(s.expand(a.effort).has(x) for a in s.actions(element))]
    if len(efforts) != 1:
        return None
    own, right = (bounded.expand(bounded.cancel(x / efforts[0])) for x in (share + more, share))
    if own.has(efforts[0]) or right.has(efforts[0]):
        return None
    return TooMuch((f": {element.title} counts with the factor ", own, " there, not with ", right), element)
