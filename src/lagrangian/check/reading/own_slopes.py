"""Derivatives of energies by the coordinates of an answer, where some are of its own and replace those of the system.

With w_a = f_a(ξ) in place of ξ_a, a step of the coordinate η, one of the w or of the ξ that are left, moves ξ_a by

    m_a = ∂ξ_a/∂η = (J⁻¹)_aη    or    −(J⁻¹ ∂f/∂η)_a,    J_ab = ∂f_a/∂ξ_b,

and the same step of η̇ moves ξ̇_a by m_a. As ξ̇ = J⁻¹ (ẇ − Σ_left ∂f/∂ξ_j ξ̇_j) depends on positions, too,

    ∂T/∂η̇ = ∂T/∂ξ̇_η + Σ ∂T/∂ξ̇_a m_a,    ∂T/∂η = ∂T/∂ξ_η + Σ (∂T/∂ξ_a m_a + ∂T/∂ξ̇_a dξ̇_a/dη).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.model.names import time
from lagrangian.records import dataclass

Slope = Callable[[sp.Expr], sp.Expr]
"""The derivative of one energy by a coordinate or a rate of the system."""

MOST = 4
"""The largest number of coordinates that are replaced."""


@dataclass(frozen=True, eq=False)
class OwnCoordinates:
    """Coordinates of an answer's own: ``meanings`` are f(ξ) by name, ``inverse`` is J⁻¹.

    ``replaced`` are those of the system in whose place they stand.
    """

    meanings: Mapping[str, sp.Expr]
    replaced: tuple[sp.Expr, ...]
    inverse: sp.ImmutableMatrix

    def slope(self, by: str | sp.Expr, order: int, slope: Slope) -> sp.Expr:
        """The derivative by a coordinate (``order`` 0) or rate (1): one of the answer's, by name, or of the system."""
        f = list(self.meanings.values())
        own = isinstance(by, str)
        if own:
            column = list(self.meanings).index(cast("str", by))
            moved = [cast("sp.Expr", self.inverse[a, column]) for a in range(len(f))]
        else:
            turned = -self.inverse * sp.Matrix([x.diff(cast("sp.Expr", by)) for x in f])
            moved = cast("list[sp.Expr]", turned.flat())
        rates = [cast("sp.Expr", x.diff(time)) for x in self.replaced]
        steps = [(x, v, m) for x, v, m in zip(self.replaced, rates, moved, strict=True) if m != 0]
        if order == 1:
            first = sp.S.Zero if own else slope(cast("sp.Expr", cast("sp.Expr", by).diff(time)))
            return sp.Add(first, *[slope(v) * m for _, v, m in steps])
        found = sp.S.Zero if own else slope(cast("sp.Expr", by))
        held = [sp.Dummy() for _ in f]
        others = [x.diff(time).xreplace(dict.fromkeys(rates, sp.S.Zero)) for x in f]
        moving = self.inverse * sp.Matrix([w - x for w, x in zip(held, others, strict=True)])
        back = {w: x.diff(time) for w, x in zip(held, f, strict=True)}
        rests = [
            (v, sp.Add(*[h.diff(x) * m for x, _, m in steps], sp.S.Zero if own else h.diff(by)).xreplace(back))
            for v, h in zip(rates, moving, strict=True)
        ]
        return sp.Add(found, *[slope(x) * m for x, _, m in steps], *[slope(v) * h for v, h in rests if h != 0])


@lru_cache(maxsize=16)
def own_coordinates(stated: tuple[tuple[str, sp.Expr], ...], kept: frozenset[sp.Expr]) -> OwnCoordinates | None:
    """The coordinates of an answer that differentiates by these, ``stated`` by name and meaning, and by those of the
    system that are ``kept``.

    None unless it is clear which coordinate of the system each of its own replaces.
    """
    meanings = dict(stated)
    left = {name: {*f.atoms(AppliedUndef)} - kept for name, f in meanings.items()}
    if not 0 < len(meanings) <= MOST or any(f.has(sp.Derivative) for f in meanings.values()):
        return None
    replaced: dict[str, Any] = {}
    while left:
        name = next((name for name, xs in left.items() if len(xs) == 1), None)
        if name is None:
            return None
        replaced[name] = left.pop(name).pop()
        left = {other: xs - {replaced[name]} for other, xs in left.items()}
    xs = tuple(replaced[name] for name in meanings)
    J = sp.Matrix([[f.diff(x) for x in xs] for f in meanings.values()])
    whole = bounded.expand(cast("sp.Expr", J.det()))
    if bounded.is_zero(whole):
        return None
    return OwnCoordinates(meanings, xs, sp.ImmutableMatrix(J.adjugate() / whole))
