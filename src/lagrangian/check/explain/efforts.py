"""Tells of which force, torque or damper a term of an answer is, by the letters that only those have."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.model import Damper, Element
from lagrangian.records import dataclass

SHORT = 10
"""The largest number of operations of a rate that a sentence holds."""


@dataclass(frozen=True, eq=False)
class Effort:
    """What a term of Ξ is of: the element if it is one alone, whether it damps, and the rate that a damper feels."""

    element: Element | None
    damper: bool
    rate: sp.Expr | None = None


def effort_of(pool: Pool, kind: str, row: int | None, term: sp.Expr, scale: sp.Expr | None = sp.S.One) -> Effort | None:
    """The force, torque or damper with whose own letters a term of an equation or a Ξ is written; None for others.

    Of several with the same letter, the one that acts in equation ``row``. The term is ``scale`` times one of the right
    equation: a letter by which an equation was divided stands in all its terms.
    """
    if kind not in ("equation", "Xi"):
        return None
    above, _ = sp.fraction(bounded.cancel(term / scale) if scale is not None else term)
    held = bounded.letters(above)
    found = [e for e, own in _own_letters(pool).items() if own & held]
    if not found:
        return None
    acting = [e for e in found if row is not None and row in pool.sites.shares.get(e, {})]
    element = _only(acting) or _only(found)
    damper = all(isinstance(e, Damper) for e in found)
    return Effort(element, damper, _felt(pool, element))


def _only(elements: Sequence[Element]) -> Element | None:
    return elements[0] if len(elements) == 1 else None


def _felt(pool: Pool, element: Element | None) -> sp.Expr | None:
    """The rate that a linear damper feels, if it is short."""
    if not isinstance(element, Damper) or element.b is None:
        return None
    rate = pool.sites.of.expand(element.rate(pool.truth.model))
    return rate if bounded.size(rate) <= SHORT else None


def _own_letters(pool: Pool) -> dict[Element, set[Any]]:
    """For every force, torque and damper the inputs and parameters of its effort that neither T* nor V has."""

    def made() -> dict[Element, set[Any]]:
        s = pool.sites.of
        conservative: set[Any] = set(s.T.free_symbols) | set(s.V.free_symbols)
        moving = {*s.q, *s.v, *s.a}
        listed: dict[Element, set[Any]] = {}
        for element in s.acting:
            efforts = [s.expand(a.effort) for a in s.actions(element)]
            letters = {x for e in efforts for x in bounded.letters(e)}
            listed[element] = letters - conservative - moving
        return listed

    return pool.kept("letters of efforts", made)
