"""Circuits at rest: steady currents of charges on which nothing depends, and the sizes of charges and currents.

A loop without a capacitor rests with a steady current, not with a charge that stays: there i is sought in place of
q, with h(q, i) = 0 and ∂h/∂i in place of ∂h/∂q. Such a loop may pass through several meshes, whose charges then move
together.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.linear.echelon import null_space, reduced
from lagrangian.linear.linearization import Linearization
from lagrangian.linear.linearize import Linearizer
from lagrangian.linear.stability import Stability, shown
from lagrangian.model import Capacitor, Model, Parameter, time
from lagrangian.records import dataclass

Array = NDArray[np.float64]

STATES = 4
"""The number of random states that decide on what nothing depends."""

SAME = 1e-10
"""A relative change below this is rounding."""

ROUNDING = 1e-11
"""A real part above this fraction of the largest entry of A, with a minus, is not certainly negative."""


@dataclass(frozen=True, eq=False)
class SteadyCurrents:
    """The directions in which charges may flow for ever: nothing depends on a shift of q along d.

    What is sought, z, holds in place of the first charge of every direction the current along it:
    v = Σ z_k d, and q_k = 0; all other entries of z are those of q.
    """

    directions: Array
    """(m, n), in reduced row echelon form."""

    leading: tuple[int, ...]
    """The first coordinate of every direction, in which it has a 1."""

    @classmethod
    def of(cls, linearizer: Linearizer, u: Array, p: Array) -> SteadyCurrents:
        """Those of a system with the given inputs and parameters; none of one with constraints."""
        n, charges = len(linearizer.forces.inputs["q"]), linearizer.model.charges
        columns = [k for k, c in enumerate(linearizer.model.coordinates) if c in charges]
        if linearizer.manifold is not None or not columns:
            return cls(np.zeros((0, n)), ())
        source = np.random.default_rng(7)
        states = [source.uniform(0.3, 1.4, (2, n)) for _ in range(STATES)]
        slopes = [linearizer.values(linearizer.forces, q=q, v=v, u=u, p=p, t=0.0)["K"][:, columns] for q, v in states]
        rows, _ = reduced(
            null_space(np.concatenate([K for K in slopes if np.isfinite(K).all()] or [np.eye(len(columns))]))
        )
        directions = np.zeros((len(rows), n))
        directions[:, columns] = rows
        free = [d for d in directions if _nothing_depends(linearizer, d, states, u, p)]
        return cls(np.array(free).reshape(-1, n), tuple(int(np.flatnonzero(d)[0]) for d in free))

    def __bool__(self) -> bool:
        """Whether there are any."""
        return bool(self.leading)

    def state(self, z: Array) -> tuple[Array, Array]:
        """q and v (…, n) of what is sought."""
        q = np.array(z, float)
        v = q[..., list(self.leading)] @ self.directions
        q[..., list(self.leading)] = 0.0
        return q, v

    def slopes(self, K: Array, D: Array) -> Array:
        """∂h by what is sought: D d with D = ∂h/∂v for the currents, columns of K = ∂h/∂q else."""
        found = np.array(K)
        for k, d in zip(self.leading, self.directions, strict=True):
            found[..., k] = D @ d
        return found

    @property
    def basis(self) -> Array:
        """T (n, n): velocities are T times those of what is sought."""
        T = np.eye(self.directions.shape[1])
        T[:, list(self.leading)] = self.directions.T
        return T

    def verdict(self, linear: Linearization) -> Stability:
        """The verdict on a linearization in which the charges do not count on which nothing depends: currents do."""
        verdict = linear.stability
        if not self or verdict.verdict != "marginal":
            return verdict
        T = np.kron(np.eye(2), self.basis)
        A = np.linalg.solve(T, linear.A @ T)
        A = np.delete(np.delete(A, self.leading, axis=0), self.leading, axis=1)
        poles = np.linalg.eigvals(A)
        slowest = poles[poles.real.argmax()]
        if slowest.real >= -ROUNDING * float(np.abs(A).max()):
            return verdict
        listed = ", ".join(self.named(linear.states))
        return Stability(
            "asymptotically stable",
            f"currents and positions return, the slowest pole is {shown(complex(slowest))}; the charge {listed} does "
            "not count, because nothing depends on it",
            complex(slowest),
        )

    def named(self, names: Sequence[str]) -> list[str]:
        """The charge of every direction: one name, or those that are shifted together."""
        return [" and ".join(names[int(k)] for k in np.flatnonzero(d)) for d in self.directions]


def _nothing_depends(linearizer: Linearizer, d: Array, states: Sequence[Array], u: Array, p: Array) -> bool:
    """Whether neither h nor M changes where q is shifted along d, at some states and times."""
    for k, (q, v) in enumerate(states):
        for program, name in ((linearizer.forces, "h"), (linearizer.mass, "M")):
            here, there = (
                linearizer.values(program, q=at, v=v, u=u, p=p, t=0.7 * k)[name] for at in (q, q + (1.0 + k) * d)
            )
            if not np.abs(there - here).max(initial=0.0) <= SAME * np.abs(here).max(initial=0.0):
                return False
    return True


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
