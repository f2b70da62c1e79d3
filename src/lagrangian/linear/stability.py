"""Determines the stability of an equilibrium or a steady motion from its poles or, if these do not decide, from its
energy.

Lyapunov's first method: all Re λ < 0 is asymptotically stable, one Re λ > 0 unstable; poles on the imaginary axis do
not decide. Lagrange–Dirichlet: if h = T₂ − T₀ + V has a strict minimum and nothing supplies power, the equilibrium is
stable. Sources: Hahn, Stability of Motion (1967), §§ 25, 28; Meirovitch, Methods of Analytical Dynamics (1970), §§ 6.7,
6.10.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import listed
from lagrangian.graph import Program
from lagrangian.linear.jacobians import Arrays
from lagrangian.linear.modes import SYMMETRIC, Spectrum
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

Array = NDArray[np.float64]

SAMPLES = 40
"""The number of random motions near the equilibrium for which the power of nonconservative forces is computed."""


@dataclass(frozen=True)
class Stability(Brief):
    """A verdict on stability, with its reason.

    Verdicts: "asymptotically stable", "stable" (in Lyapunov's sense), "unstable", "marginal" (the linearization does
    not decide), "depends on time" (the coefficients change, so poles say nothing). ``pole`` is the one that decides.
    """

    verdict: str
    reason: str
    pole: complex | None = None

    @property
    def stable(self) -> bool | None:
        """True or False if it is known, otherwise None."""
        return {"asymptotically stable": True, "stable": True, "unstable": False}.get(self.verdict)

    def __str__(self) -> str:
        """Return the verdict as a sentence."""
        return f"{self.verdict}: {self.reason}"


def shown(pole: complex) -> str:
    """Return a pole in words for a sentence: ``−0.5 ± 2i``."""
    real = f"{pole.real + 0.0:.6g}".replace("-", "−")
    if abs(pole.imag) == 0:
        return real
    return f"{real + ' ' if pole.real else ''}± {abs(pole.imag):.6g}i"


def judge(found: Spectrum, coordinates: tuple[str, ...], minimum: bool) -> Stability:
    """The verdict for a spectrum over x = [q; q̇]; ``minimum`` says that the energy decides."""
    sides = found.sides
    if not len(sides):
        return Stability("marginal", "nothing moves")
    if (sides > 0).any():
        k = int(np.argmax(np.where(sides > 0, found.poles.real, -np.inf)))
        pole = complex(found.poles[k])
        return Stability("unstable", f"the pole {shown(pole)} has a positive real part: {_growth(pole)}", pole)
    if (sides < 0).all():
        k = int(np.argmax(found.poles.real))
        pole = complex(found.poles[k])
        return Stability(
            "asymptotically stable", f"all poles have negative real parts, the slowest is {shown(pole)}", pole
        )
    if minimum:
        return Stability(
            "stable", "the energy has a strict minimum there and nothing supplies power (Lagrange–Dirichlet)"
        )
    k = int(np.argmin(np.where(sides == 0, np.abs(found.poles), np.inf)))
    pole = complex(found.poles[k])
    if pole:
        where = f"the pole {shown(pole)} is on the imaginary axis"
    else:
        shape = np.abs(found.vectors[: len(coordinates), k])
        moved = [name for name, x in zip(coordinates, shape, strict=True) if x > 1e-9 * shape.max()]
        where = f"there is a pole at 0: nothing brings {listed(moved)} back"
        others = sides[np.abs(found.poles) > 0]
        if len(others) and (others < 0).all():
            where += ", and everything else decays"
    return Stability("marginal", f"{where}; the linearization does not decide", pole)


def _growth(pole: complex) -> str:
    return f"it doubles every {np.log(2) / pole.real:.3g} s"


def has_minimum(M: Array, K: Array, noise: float) -> bool:
    """Whether K, known up to ``noise``, is symmetric and positive definite, and M positive definite."""
    size = float(np.abs(K).max(initial=0.0))
    if size <= noise or float(np.abs(K - K.T).max()) > SYMMETRIC * size:
        return False
    return bool(
        np.linalg.eigvalsh((K + K.T) / 2).min() > 1e-13 * size + noise and np.linalg.eigvalsh((M + M.T) / 2).min() > 0
    )


def loses_power(values: Callable[..., Arrays], power: Program, q: Array, u: Array, p: Array) -> bool:
    """Whether no random motion near the equilibrium q gains energy: dh/dt = P ≤ 0."""
    source = np.random.default_rng(1)
    for _ in range(SAMPLES):
        x = np.concatenate([q + 0.1 * source.standard_normal(len(q)), source.standard_normal(len(q))])
        got = values(power, x=x, u=u, p=p, t=10 * source.random())
        if not got["P"] <= 1e-12 * (abs(float(got["T"])) + abs(float(got["V"]))):
            return False
    return True


def loses_power_beyond_potential(values: Callable[..., Arrays], power: Program, q: Array, u: Array, p: Array) -> bool:
    """Whether the forces at rest, w(q), have a potential and all others take power: P − w·q̇ ≤ 0 near the equilibrium
    q.

    w = ∂P/∂q̇ at q̇ = 0, such as a constant torque, or the force of a spring whose end is an input. It has a potential
    if ∂w/∂q is symmetric and w does not depend on time. ``power`` has "W" = ∂P/∂x and "slope" = ∂W/∂x besides P.
    """
    source = np.random.default_rng(2)
    n = len(q)
    for _ in range(SAMPLES):
        near, v = q + 0.1 * source.standard_normal(n), source.standard_normal(n)
        t, later = 10 * source.random(2)
        there = values(power, x=np.concatenate([near, np.zeros(n)]), u=u, p=p, t=t)
        w, slope = there["W"].ravel()[n:], there["slope"][n:, :n]
        then = values(power, x=np.concatenate([near, np.zeros(n)]), u=u, p=p, t=later)["W"].ravel()[n:]
        size = float(np.abs(w).max(initial=0.0))
        bent = float(np.abs(slope - slope.T).max(initial=0.0))
        if not bent <= 1e-9 * np.abs(slope).max(initial=0.0) or not np.abs(then - w).max(initial=0.0) <= 1e-12 * size:
            return False
        got = values(power, x=np.concatenate([near, v]), u=u, p=p, t=t)
        scale = abs(float(got["T"])) + abs(float(got["V"])) + float(np.abs(w * v).sum())
        if not float(got["P"]) - float(w @ v) <= 1e-12 * scale:
            return False
    return True
