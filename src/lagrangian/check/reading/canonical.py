"""Derivatives of a Hamiltonian, which hold the momenta of the answer fixed and not the rates.

With p = p(q, q̇), M = ∂p/∂q̇ and H written out in rates,

    ∂H/∂q at fixed p = ∂H/∂q − ∂H/∂q̇ M⁻¹ ∂p/∂q,    ∂H/∂p = ∂H/∂q̇ M⁻¹.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.model.names import time

NAMES = ("H", "ℋ")
"""How answers call a Hamiltonian."""

MOST = 4
"""The most momenta."""


def momenta_of(own: Mapping[str, tuple[str, Any]], rates: Sequence[sp.Expr]) -> dict[str, sp.Expr]:
    """The momenta among an answer's own names, by key: those that begin with p and hold rates; none unless there is one
    for each of the ``rates``."""
    found = {
        base: v for base, (_, v) in own.items() if base[:1] in ("p", "P") and isinstance(v, sp.Expr) and v.has(*rates)
    }
    return found if len(found) == len(rates) <= MOST else {}


def slope_at_momenta(
    H: sp.Expr,
    momenta: Mapping[str, sp.Expr],
    coordinates: Sequence[Any],
    by: Any,
    slope: Callable[[sp.Expr, Any], sp.Expr],
) -> sp.Expr | None:
    """The derivative of H by a coordinate, or by the momentum of which ``by`` is the key; None if the momenta do not
    determine the rates. ``slope`` differentiates."""
    rates = [q.diff(time) for q in coordinates]
    M = sp.Matrix([[slope(p, v) for v in rates] for p in momenta.values()])
    if M.has(*rates) or bounded.is_zero(bounded.expand(cast("sp.Expr", M.det()))):
        return None
    by_momenta = M.T.LUsolve(sp.Matrix([slope(H, v) for v in rates]))
    if by in momenta:
        return cast("sp.Expr", by_momenta[list(momenta).index(by)])
    moved = [x * slope(p, by) for x, p in zip(by_momenta.flat(), momenta.values(), strict=True)]
    return slope(H, by) - sp.Add(*moved)
