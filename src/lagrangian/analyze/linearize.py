"""Linearization: δẋ = A δx + B δu, δy = C δx + D δu, exact, with the names of everything.

A = ∂ẋ/∂x and B = ∂ẋ/∂u of ẋ = f(x, u, p, t), x = [q; q̇], by differentiating the graph of the forward dynamics; q̈ is
already solved for in it. About a rest the same is M δq̈ + D δq̇ + K δq = S δu, with K = ∂h/∂q, D = ∂h/∂q̇, S = −∂h/∂u of
h = C q̇ + G − Ξ.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.analyze.given import Given, Named
from lagrangian.analyze.jacobians import Arrays, forces, rates, reads, values
from lagrangian.analyze.modes import Mode, Spectrum, modes, spectrum
from lagrangian.analyze.outputs import Measured, measured
from lagrangian.analyze.rest import Rest, rest
from lagrangian.analyze.stability import Stability, energy_decides, judge
from lagrangian.errors import RunError
from lagrangian.model import Model

Array = NDArray[np.float64]

TIMES = (0.0, 0.37, 1.91, 7.13)
"""[s] Times at which coefficients that read t are compared."""


@dataclass(frozen=True, eq=False)
class Linearization:
    """δẋ = A δx + B δu, δy = C δx + D δu about a point x₀, u₀.

    ``states``, ``inputs``, ``outputs`` name the entries in declared order, x = [q; q̇]. ``at``, ``inputs_at``,
    ``parameters`` are the values there by name. ``kind`` is "rest", "steady motion" (only coordinates that nothing
    depends on move) or "operating point", where ``drift`` = f(x₀, u₀) adds to δẋ. ``residual`` is the largest |q̈|.
    ``mass``, ``damping``, ``stiffness``, ``input_matrix`` are M, D, K and S of the second-order form about a rest, else
    None. ``notes`` say what else there is to know of the point.
    """

    model: Model
    A: Array
    B: Array
    C: Array
    D: Array
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    at: Mapping[str, float]
    inputs_at: Mapping[str, float]
    outputs_at: Mapping[str, float]
    parameters: Mapping[str, float]
    kind: str
    drift: Array
    residual: float
    mass: Array | None
    damping: Array | None
    stiffness: Array | None
    input_matrix: Array | None
    time: float
    notes: tuple[str, ...] = ()
    free: tuple[str, ...] = ()
    changing: bool = False
    _minimum: bool = field(default=False, repr=False)

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The coordinates' names."""
        return tuple(c.name for c in self.model.coordinates)

    @cached_property
    def spectrum(self) -> Spectrum:
        """The eigenvalues of A with the bounds of their rounding errors."""
        if self.mass is not None and self.damping is not None and self.stiffness is not None:
            return spectrum(self.A, (self.mass, self.damping, self.stiffness))
        return spectrum(self.A)

    @property
    def poles(self) -> NDArray[np.complex128]:
        """The eigenvalues of A [1/s], slowest first."""
        return self.spectrum.poles

    @property
    def frequencies(self) -> Array:
        """|λ| of every pole [rad/s]."""
        return np.abs(self.poles)

    @property
    def damping_ratios(self) -> Array:
        """−Re λ/|λ| of every pole; nan for a pole at 0."""
        size = np.abs(self.poles)
        return np.where(size > 0, -self.poles.real / np.where(size > 0, size, 1.0), np.nan)

    @cached_property
    def modes(self) -> tuple[Mode, ...]:
        """The modes, slowest first, with their shapes by the names of the coordinates."""
        return modes(self.spectrum, self.states[: len(self.coordinates)])

    @cached_property
    def stability(self) -> Stability:
        """The verdict and its reason."""
        if self.changing:
            return Stability("depends on time", "A changes with time, and poles at one moment decide nothing")
        if self.kind == "operating point":
            return Stability("marginal", "the point is not a rest; poles tell how neighbours part, for a short while")
        return judge(self.spectrum, self.states[: len(self.coordinates)], self._minimum)

    @property
    def stable(self) -> bool | None:
        """True or False where the verdict is known, else None."""
        return self.stability.stable


def linearize(
    model: Model,
    at: Any = None,
    *,
    inputs: Named | None = None,
    params: Named | None = None,
    outputs: Sequence[Any] | Mapping[str, Any] | None = None,
    time: object = 0.0,
    operating_point: bool = False,
) -> Linearization:
    """Return the linearization of a model about a point.

    ``at``: values of coordinates and rates by name or symbol, 0 where not given, or an `Equilibrium`; a number or text
    with a unit each. ``outputs``: expressions, listed or by name; the coordinates unless given. A point that is no rest
    is refused unless ``operating_point`` asks for it; what is within rounding of one is moved onto it and says so.
    Raises `RunError` for names and values that do not fit, and where M is singular.
    """
    program = rates(model)
    given = Given.of(model, program)
    t = given.time_value(time)
    here = rest(model, program, given, at, inputs, params, t, operating_point)
    found = _finite(program_values(program, here, t), here)
    y = measured(model, outputs, program)
    seen = values(y.program, x=here.x, u=here.u, p=here.p, t=t)
    second = None if here.kind == "operating point" else _second_order(model, here, t)
    return Linearization(
        model=model,
        A=found["A"],
        B=found["B"],
        C=seen["C"],
        D=seen["D"],
        states=program.inputs["x"],
        inputs=program.inputs["u"],
        outputs=y.names,
        at=dict(zip(program.inputs["x"], here.x.tolist(), strict=True)),
        inputs_at=dict(zip(program.inputs["u"], here.u.tolist(), strict=True)),
        outputs_at=dict(zip(y.names, seen["y"].tolist(), strict=True)),
        parameters=dict(zip(program.inputs["p"], here.p.tolist(), strict=True)),
        kind=here.kind,
        drift=found["xdot"],
        residual=here.residual,
        mass=None if second is None else second["M"],
        damping=None if second is None else second["D"],
        stiffness=None if second is None else second["K"],
        input_matrix=None if second is None else -second["S"],
        time=t,
        notes=here.notes,
        free=here.free,
        changing=_changes(program, here),
        _minimum=second is not None
        and here.kind == "rest"
        and energy_decides(model, second, here.x[: len(second["K"])], here.u, here.p, t),
    )


def program_values(program: Any, here: Rest, t: float) -> Arrays:
    """The outputs of a program over x at a point."""
    return values(program, x=here.x, u=here.u, p=here.p, t=t)


def _finite(found: Arrays, here: Rest) -> Arrays:
    for name, array in found.items():
        if not np.isfinite(array).all():
            raise RunError(
                f"{name} is not finite at {here.shown}",
                fix="look whether the mass matrix is singular there, or a square root or a division ends there",
                code="E503",
            )
    return found


def _second_order(model: Model, here: Rest, t: float) -> Arrays | None:
    """M, D, K, S about a rest, where velocities are the rates of the coordinates."""
    program = forces(model)
    n = len(program.inputs["q"])
    if n != len(program.inputs["v"]):
        return None
    point = {"q": here.x[:n], "v": here.x[n:], "u": here.u, "p": here.p, "t": t}
    return values(program, **point) | values(dynamics.mass_matrix(model), **point)


def _changes(program: Any, here: Rest) -> bool:
    """Whether A or B differs between a few times."""
    if not reads(program, "A", "t") and not reads(program, "B", "t"):
        return False
    first, *others = (program_values(program, here, t) for t in TIMES)
    return any(
        np.abs(other[k] - first[k]).max(initial=0.0) > 1e-9 * max(1.0, np.abs(first[k]).max(initial=0.0))
        for other in others
        for k in ("A", "B")
    )


__all__ = ["Linearization", "Measured", "linearize"]
