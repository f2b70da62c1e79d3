"""One step of an explicit Runge–Kutta method, and the exact derivative of that step.

The discrete map is differentiated stage by stage. With stages x_i = x + h Σ_j a_ij k_j and k_i = f(x_i, u),

    x₁ = x + h Σ b_i k_i        k_i' = f_x (x' + h Σ_j a_ij k_j') + f_u        x₁' = x' + h Σ b_i k_i'

A floating frame is varied along its velocities, δq = N(q) ξ; after the step ξ₁ = N⁺(q₁) δq₁, with N⁺ N = 1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import RunError, did_you_mean
from lagrangian.integrate.methods.explicit import Tableau
from lagrangian.integrate.methods.rk4 import RK4
from lagrangian.records import dataclass

Array = NDArray[np.float64]

METHODS: Mapping[str, Tableau] = {
    "euler": Tableau(c=(0.0,), a=((),), b=(1.0,)),
    "midpoint": Tableau(c=(0.0, 1 / 2), a=((), (1 / 2,)), b=(0.0, 1.0)),
    "rk4": RK4.table,
}
"""The methods of a single step."""


def tableau(method: str) -> Tableau:
    """Return the coefficients of a method; raises `RunError` for an unknown name."""
    if not isinstance(method, str) or method not in METHODS:
        hint = did_you_mean(str(method), METHODS) or f"use one of {', '.join(METHODS)}"
        raise RunError(f"there is no method {method!r} for a single step", fix=hint, code="E402")
    return METHODS[method]


@dataclass(frozen=True)
class VelocityMap:
    """How q moves with v: q̇ = N v, N, ∂q̇/∂q, N⁺, and ad_v, the Lie bracket with v."""

    qdot: Array
    N: Array
    Nq: Array
    back: Array
    ad: Array


@dataclass(frozen=True)
class Rates:
    """q̇ and v̇ at one state, with their derivatives if these are wanted."""

    qdot: Array
    a: Array
    a_q: Array | None = None
    a_v: Array | None = None
    a_u: Array | None = None
    tangent: VelocityMap | None = None


Evaluated = Callable[[Array, Array, float], Rates]
"""(q, v, how much later) → the rates."""


def _moved(start: Array, h: float, weights: Sequence[float], slopes: Sequence[Array]) -> Array:
    """start + h Σ weight · slope."""
    total = start
    for weight, slope in zip(weights, slopes, strict=False):
        if weight:
            total = total + h * weight * slope
    return total


def stepped(table: Tableau, h: float, q: Array, v: Array, rates: Evaluated) -> tuple[Array, list[Rates]]:
    """x₁ = [q₁; v₁], and the rates at all stages."""
    stages: list[Rates] = []
    for c, row in zip(table.c, table.a, strict=True):
        at_q = _moved(q, h, row, [k.qdot for k in stages])
        at_v = _moved(v, h, row, [k.a for k in stages])
        stages.append(rates(at_q, at_v, c * h))
    q1 = _moved(q, h, table.b, [k.qdot for k in stages])
    v1 = _moved(v, h, table.b, [k.a for k in stages])
    lead = np.broadcast_shapes(q1.shape[:-1], v1.shape[:-1])
    both = [np.broadcast_to(x, (*lead, x.shape[-1])) for x in (q1, v1)]
    return np.concatenate(both, axis=-1), stages


def differentiated(table: Tableau, h: float, stages: Sequence[Rates], end: VelocityMap | None) -> tuple[Array, Array]:
    """A = ∂x₁/∂x, shape (..., 2n, 2n), and B = ∂x₁/∂u, shape (..., 2n, number of inputs); ``end`` is the tangent at
    q₁."""
    first = stages[0]
    assert first.a_u is not None
    lead, n, inputs = first.a.shape[:-1], first.a.shape[-1], first.a_u.shape[-1]
    one = np.broadcast_to(np.eye(n, 2 * n + inputs), (*lead, n, 2 * n + inputs))
    dv = np.roll(one, n, axis=-1)
    dq = one if first.tangent is None else first.tangent.N @ one
    dqs: list[Array] = []
    dvs: list[Array] = []
    for k, row in zip(stages, table.a, strict=True):
        assert k.a_q is not None and k.a_v is not None and k.a_u is not None
        at_q, at_v = _moved(dq, h, row, dqs), _moved(dv, h, row, dvs)
        along = at_q if k.tangent is None else k.tangent.back @ at_q
        dqs.append(at_v if k.tangent is None else k.tangent.Nq @ at_q + k.tangent.N @ at_v)
        change = k.a_q @ along + k.a_v @ at_v
        change[..., 2 * n :] += k.a_u
        dvs.append(change)
    q1, v1 = _moved(dq, h, table.b, dqs), _moved(dv, h, table.b, dvs)
    both = np.concatenate([q1 if end is None else end.back @ q1, v1], axis=-2)
    return both[..., : 2 * n], both[..., 2 * n :]
