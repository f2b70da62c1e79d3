"""The coordinates η of an answer, some of its own, and what is stated by them: derivatives of energies, forces.

With w_a = f_a(ξ, t) in place of as many ξ_a, a step of one of the w, or of a ξ_k that is left, moves the ξ_a by

    ∂ξ/∂w = J⁻¹    or    ∂ξ/∂ξ_k = −J⁻¹ ∂f/∂ξ_k,    J_ab = ∂f_a/∂ξ_b;

a constraint c(ξ, t) = 0 is one of the f that no step changes. With S = ∂ξ/∂η, as ∂ξ̇/∂η̇ = S and ∂ξ̇/∂η = Ṡ,

    ∂E/∂η̇ = Sᵀ ∂E/∂ξ̇,    ∂E/∂η = Sᵀ ∂E/∂ξ + Ṡᵀ ∂E/∂ξ̇,    Ξ_η = Sᵀ Ξ_ξ.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.model.names import time
from lagrangian.read.letters import key
from lagrangian.records import dataclass

Slope = Callable[[Any], sp.Expr]
"""The derivative of one energy by a coordinate or a rate of the system."""

MOST = 6
"""The largest number of coordinates that are replaced."""


@dataclass(frozen=True, eq=False)
class OwnCoordinates:
    """The coordinates of an answer: ``columns`` are those of S, ξ_j and S_jη where it is not 0, by the key of η.

    ``order`` has the key of the one in the place of each of the system's; those that constraints determine have none.
    """

    columns: Mapping[str, tuple[tuple[Any, sp.Expr], ...]]
    order: tuple[str, ...]

    def along(self, by: str, of: Slope) -> sp.Expr:
        """(Sᵀ x)_η of quantities x_j = ``of(ξ_j)``: a generalized force, or a derivative by a rate."""
        return sp.Add(*[of(x) * s for x, s in self.columns[by]])

    def slope(self, by: str, order: int, slope: Slope) -> sp.Expr:
        """The derivative of an energy by a coordinate (``order`` 0) or its rate (1)."""
        if order == 1:
            return self.along(by, lambda x: slope(x.diff(time)))
        turning = [(x, rate) for x, s in self.columns[by] if (rate := bounded.diff(s, time)) != 0]
        return sp.Add(self.along(by, slope), *[slope(x.diff(time)) * rate for x, rate in turning])


def named(symbol: Any) -> str:
    """The key of a coordinate's name."""
    return key(symbol.func.__name__)


@lru_cache(maxsize=64)
def replaced_by(
    stated: tuple[tuple[str, sp.Expr], ...],
    gone: tuple[Any, ...],
    coordinates: tuple[Any, ...],
    rows: tuple[sp.Expr, ...] = (),
) -> OwnCoordinates | None:
    """The coordinates ``stated`` by key and meaning, and ``rows`` of constraints, in place of those that are ``gone``.

    None if they do not determine these, or are too many.
    """
    f = [*(x for _, x in stated), *rows]
    if not 0 < len(f) == len(gone) <= MOST or any(x.has(sp.Derivative) for x in f):
        return None
    J = sp.Matrix([[bounded.diff(x, q) for q in gone] for x in f])
    det = bounded.expand(cast("sp.Expr", J.det()))
    if bounded.is_zero(det):
        return None
    inverse = J.adjugate() / det
    columns: dict[str, tuple[tuple[Any, sp.Expr], ...]] = {}
    for q in (q for q in coordinates if q not in gone):
        moved = -inverse * sp.Matrix([bounded.diff(x, q) for x in f])
        columns[named(q)] = ((q, sp.S.One), *_moving(gone, moved.flat()))
    columns |= {name: _moving(gone, inverse.col(a).flat()) for a, (name, _) in enumerate(stated)}
    return OwnCoordinates(columns, _order(stated, gone, coordinates))


def _moving(gone: Sequence[Any], steps: Sequence[Any]) -> tuple[tuple[Any, sp.Expr], ...]:
    return tuple((x, s) for x, s in zip(gone, steps, strict=True) if s != 0)


def _order(stated: Sequence[tuple[str, sp.Expr]], gone: Sequence[Any], coordinates: Sequence[Any]) -> tuple[str, ...]:
    """The keys in the places of the system's coordinates: z1 before z2, else the first that is left and holds it."""
    left = dict(stated)
    found: list[str] = []
    for k, q in enumerate(coordinates, 1):
        if q not in gone:
            found.append(named(q))
            continue
        numbered = [name for name in left if name.rstrip("0123456789") + str(k) == name]
        mine = numbered if len(numbered) == 1 else [name for name, x in left.items() if x.has(q)]
        if mine:
            found.append(mine[0])
            del left[mine[0]]
    return tuple(found)


def own_coordinates(
    stated: tuple[tuple[str, sp.Expr], ...], kept: frozenset[sp.Expr], coordinates: tuple[Any, ...]
) -> OwnCoordinates | None:
    """The coordinates of an answer that differentiates by these, ``stated`` by key and meaning, and by those of the
    system that are ``kept``.

    None unless it is clear which coordinate of the system each of its own replaces.
    """
    left = {name: f.atoms(AppliedUndef).intersection(coordinates) - kept for name, f in stated}
    if not left:
        return None
    gone: list[Any] = []
    while left:
        name = next((name for name, xs in left.items() if len(xs) == 1), None)
        if name is None:
            return None
        gone.append(left.pop(name).pop())
        left = {other: xs - {gone[-1]} for other, xs in left.items()}
    return replaced_by(stated, tuple(gone), coordinates)
