"""The data of a linearization: the matrices with their names, and quantities that are computed from them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lagrangian.linear.modes import Mode, Spectrum, modes, spectrum
from lagrangian.linear.reach import Reach, controllable, observable
from lagrangian.linear.stability import Stability, judge
from lagrangian.model import Model
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class LinearModel(Brief):
    """The linear system δẋ = A δx + B δu, δy = C δx + D δu about a point x₀, u₀.

    ``states``, ``inputs``, ``outputs`` name the entries in declared order, x = [q; q̇]. ``at``, ``inputs_at``,
    ``parameters`` are the values there by name. ``kind`` is "rest" (an equilibrium), "steady motion" (only coordinates
    on which nothing depends move) or "operating point"; in the last case ``drift`` = f(x₀, u₀) is added to δẋ.
    ``residual`` is the largest |q̈|. ``mass``, ``damping``, ``stiffness``, ``input_matrix`` are M, D, K and S of the
    second-order form about an equilibrium, otherwise None. ``notes`` contain remarks about the point, ``free`` names
    the coordinates on which nothing depends, ``changing`` says that A or B depends on time, ``minimum`` that the energy
    has a strict minimum there and nothing supplies power. ``noise`` are the rounding errors in A and in M⁻¹K.

    With constraints ``states`` are independent ones: coordinates and rates from which all others follow, so that there
    are fewer of them than entries of ``at``. All change by ``basis`` δx, in the order of ``at``; ``basis`` is None
    without constraints. ``multipliers`` are λ of the constraints' rows at the point, by name, empty if rows depend on
    each other.

    With floating frames the states are minimal, too: in place of the four entries of a quaternion there are three small
    turns about the frame's own axes, ``hull_rx``, ``hull_ry``, ``hull_rz`` [rad]. Then ``back`` is Z⁺ of the basis Z,
    δx = Z⁺ · (change of all), and ``transport`` is Z⁺ Ż, with which A = Z⁺ (∂f/∂x) Z − Z⁺ Ż.
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
    minimum: bool = False
    noise: tuple[Array | float, float] = (0.0, 0.0)
    basis: Array | None = None
    multipliers: Mapping[str, float] = field(default_factory=dict[str, float])
    back: Array | None = None
    transport: Array | None = None

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The names of the coordinates."""
        return tuple(c.name for c in self.model.coordinates)

    @cached_property
    def spectrum(self) -> Spectrum:
        """The eigenvalues of A with bounds of their rounding errors."""
        if self.mass is not None and self.damping is not None and self.stiffness is not None:
            return spectrum(self.A, (self.mass, self.damping, self.stiffness), self.noise)
        return spectrum(self.A, None, self.noise)

    @cached_property
    def motions(self) -> Spectrum:
        """The spectrum with its vectors in all coordinates and rates, those that depend on others included."""
        found = self.spectrum
        return found if self.basis is None else replace(found, vectors=self.basis @ found.vectors)

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
        """−Re λ/|λ| of every pole; NaN for a pole at 0."""
        size = np.abs(self.poles)
        return np.where(size > 0, -self.poles.real / np.where(size > 0, size, 1.0), np.nan)

    @cached_property
    def modes(self) -> tuple[Mode, ...]:
        """The modes, slowest first, with their shapes by the names of the coordinates."""
        return modes(self.motions, self.coordinates)

    @cached_property
    def stability(self) -> Stability:
        """The verdict on stability, with its reason."""
        if self.changing:
            return Stability("depends on time", "A changes with time, and poles at one moment decide nothing")
        if self.kind == "operating point":
            return Stability("marginal", "the point is not a rest; poles tell how neighbours part, for a short while")
        return judge(self.motions, self.coordinates, self.minimum)

    @property
    def controllability(self) -> Reach:
        """What the inputs can control, and the modes that they cannot. Raises `RunError` if there is no input."""
        return controllable(self.A, self.B, self.states)

    @property
    def observability(self) -> Reach:
        """What can be observed from the outputs, and the modes that cannot."""
        return observable(self.A, self.C, self.states)

    @property
    def stable(self) -> bool | None:
        """True or False if the verdict is known, otherwise None."""
        return self.stability.stable
