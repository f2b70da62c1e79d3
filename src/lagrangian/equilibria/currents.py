"""Circuits at rest: steady currents of charges on which nothing depends, and the sizes of charges and currents.

A circuit without a capacitor rests with a steady current, not with a charge that stays: there i is sought in place of
q, with h(q, i) = 0 and ∂h/∂i in place of ∂h/∂q.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.linear.jacobians import reads
from lagrangian.linear.linearization import Linearization
from lagrangian.linear.linearize import Linearizer
from lagrangian.linear.stability import Stability, shown
from lagrangian.model import Capacitor, Model, Parameter, time

Array = NDArray[np.float64]

ROUNDING = 1e-11
"""A real part above this fraction of the largest entry of A, with a minus, is not certainly negative."""


def steady_currents(linearizer: Linearizer) -> tuple[int, ...]:
    """The numbers of the charges on which neither forces nor M depend; none of a system with constraints."""
    model = linearizer.model
    if linearizer.manifold is not None or not model.charges:
        return ()
    read = reads(linearizer.forces, "h", "q") | reads(linearizer.mass, "M", "q")
    return tuple(k for k, c in enumerate(model.coordinates) if c in model.charges and k not in read)


def split_state(z: Array, steady: tuple[int, ...]) -> tuple[Array, Array]:
    """q and v (…, n) of what is sought: currents in place of the charges ``steady``, rates 0 else."""
    q, v = np.array(z, float), np.zeros_like(z)
    for k in steady:
        v[..., k], q[..., k] = q[..., k], 0.0
    return q, v


def slopes(K: Array, D: Array, steady: tuple[int, ...]) -> Array:
    """∂h by what is sought: columns of D = ∂h/∂v for the currents, of K = ∂h/∂q else."""
    found = np.array(K)
    for k in steady:
        found[..., k] = D[..., k]
    return found


def without_charges(linear: Linearization, steady: tuple[int, ...]) -> Stability:
    """The verdict, where the charges ``steady``, on which nothing depends, do not count: currents do."""
    verdict = linear.stability
    if not steady or verdict.verdict != "marginal":
        return verdict
    A = np.delete(np.delete(linear.A, steady, axis=0), steady, axis=1)
    poles = np.linalg.eigvals(A)
    slowest = poles[poles.real.argmax()]
    if slowest.real >= -ROUNDING * float(np.abs(A).max()):
        return verdict
    listed = ", ".join(linear.states[k] for k in steady)
    return Stability(
        "asymptotically stable",
        f"currents and positions return, the slowest pole is {shown(complex(slowest))}; the charge {listed} does not "
        "count, because nothing depends on it",
        complex(slowest),
    )


def largest_charge(model: Model, parameters: Mapping[Parameter, float], u: Array) -> float | None:
    """The largest C |u| [C] of the capacitors at 0, with |u| at least 1 V; None if no capacitance has a value."""
    table = {c.symbol: sp.Float(c.start) for c in model.coordinates}
    table |= {p.symbol: sp.Float(x) for p, x in parameters.items()}
    found: list[float] = []
    for element in model.branches:
        if isinstance(element, Capacitor) and element.C is not None:
            value = model.expand(element.C, constants=True).subs({**table, time: 0})
            if value.is_number and value.is_real and value.is_finite:
                found.append(abs(float(value)))
    return max(found) * max(1.0, float(np.abs(u).max(initial=0.0))) if found and max(found) > 0 else None
