"""What `Compiled.derivatives` returns: the accelerations or the forces, with their derivatives by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.calls import Guided
from lagrangian.errors import NoSuchEntry, RunError
from lagrangian.graph import Program
from lagrangian.page.plain import plain
from lagrangian.viewed import Entries

Array = NDArray[np.float64]

GROUPS = ("q", "v", "u")
"""The groups of columns."""

PARAMETER = dynamics.PARAMETER

ALSO: Mapping[str, str] = {
    **dict.fromkeys(("ddq_dq", "da_dq", "A"), "a_q, and linearized(q, v, u) for A and B"),
    **dict.fromkeys(("ddq_dv", "da_dv"), "a_v"),
    **dict.fromkeys(("ddq_du", "da_du", "B"), "a_u, and linearized(q, v, u) for A and B"),
    **dict.fromkeys(("ddq_dtau", "a_tau", "M_inv", "inverse_inertia"), "Minv = ∂a/∂Ξ"),
}
"""Names that these derivatives have elsewhere, and what they are called here."""


class NamedSlopes(Guided):
    """Values with their derivatives; ``of`` is "a" or "r", and the names are those of the program's outputs."""

    _guide = ALSO
    _of = "a"

    def __init__(self, program: Program, values: Mapping[str, Array], wrt: tuple[str, ...]) -> None:
        self._values, self._wrt = dict(values), wrt
        self._inputs = len(program.inputs["u"])
        self._program_inputs = program.inputs
        self._structure = {
            name: np.array([i != program.graph.zero for i in output.ids]).reshape(output.shape)
            for name, output in program.outputs.items()
        }

    def __repr__(self) -> str:
        shown = ", ".join(f"{name} {value.shape}" for name, value in self._values.items())
        return f"<{type(self).__name__}: {shown}>"

    @property
    def sparsity(self) -> dict[str, NDArray[np.bool_]]:
        """Which entries of each array may differ from 0, by its name; the others are 0 in every state."""
        return Entries(self._structure, "sparsity")

    def _along(self, group: str) -> Array:
        """The derivative with respect to q, v or u."""
        if group not in self._wrt:
            raise RunError(
                f"{self._of}_{group} was not computed: wrt is {self._wrt!r}",
                fix=f"add '{group}' to wrt",
                code="E402",
            )
        if group == "u" and not self._inputs:
            return np.zeros((*self._shape, 0))
        return self._values[f"{self._of}_{group}"]

    @property
    def _shape(self) -> tuple[int, ...]:
        """The shape of what is differentiated."""
        return self._values[self._of].shape

    @property
    def _by_parameter(self) -> dict[str, Array]:
        names = [name for name in self._wrt if name not in GROUPS and name not in self._places]
        columns = {name.removeprefix(PARAMETER): self._values[f"{self._of}_p"][..., k] for k, name in enumerate(names)}
        return Entries(columns, f"{self._of}_p")

    @property
    def _places(self) -> dict[str, tuple[str, int]]:
        """The group and the place of every coordinate, velocity and input that is one column."""
        inputs = self._program_inputs
        found: dict[str, tuple[str, int]] = {}
        for group in GROUPS:
            if group != "q" or len(inputs["q"]) == len(inputs["v"]):
                found |= {name: (group, i) for i, name in enumerate(inputs[group])}
        return found

    def __getitem__(self, name: Any) -> Array:
        """Return the derivative with respect to one coordinate, velocity, input or parameter, by name or symbol.

        Its shape is that of the accelerations or forces. Raises `NoSuchEntry` for what was not computed.
        """
        shown = plain(name) if isinstance(name, sp.Basic) else str(name)
        places = self._places
        alone = [x for x in self._wrt if x in places]
        if shown in alone:
            return self._values[f"{self._of}_s"][..., alone.index(shown)]
        if shown in places and places[shown][0] in self._wrt:
            group, k = places[shown]
            return self._along(group)[..., k]
        known = [*alone, *(x for x, (group, _) in places.items() if group in self._wrt), *self._by_parameter]
        if shown in self._by_parameter:
            return self._by_parameter[shown]
        raise NoSuchEntry.among("derivatives have no entry", shown, known)


class Derivatives(NamedSlopes):
    """The accelerations a of forward dynamics and their derivatives, at one state or at many.

    M a + C v + G = Ξ gives ∂a/∂x = −M⁻¹ ∂(M a + C v + G − Ξ)/∂x at a held constant. Leading dimensions are those of
    the states. Units are SI: an entry of ``a_q`` is an acceleration by a length or an angle.
    """

    @property
    def a(self) -> Array:
        """The accelerations, shape ``(..., n)``."""
        return self._values["a"]

    @property
    def a_q(self) -> Array:
        """∂a/∂q, shape ``(..., n, n)``; for floating frames along the velocities, δq = N(q) e_k in column k."""
        return self._along("q")

    @property
    def a_v(self) -> Array:
        """∂a/∂v, shape ``(..., n, n)``."""
        return self._along("v")

    @property
    def a_u(self) -> Array:
        """∂a/∂u, shape ``(..., n, number of inputs)``."""
        return self._along("u")

    @property
    def a_p(self) -> dict[str, Array]:
        """∂a/∂p by the names of the parameters in ``wrt``, each of shape ``(..., n)``."""
        return self._by_parameter

    @property
    def Minv(self) -> Array:
        """M⁻¹ = ∂a/∂Ξ, shape ``(..., n, n)``: what generalized forces change; with constraints ∂a/∂Ξ alone."""
        return self._values["Minv"]


class InverseDerivatives(NamedSlopes):
    """The generalized forces r = M a + C v + G − Ξ that a motion needs in addition, and their derivatives.

    Leading dimensions are those of the states; a is held constant, and units are SI.
    """

    _of = "r"

    @property
    def r(self) -> Array:
        """The missing generalized forces, shape ``(..., n)``."""
        return self._values["r"]

    @property
    def r_q(self) -> Array:
        """∂r/∂q, shape ``(..., n, n)``; for floating frames along the velocities, δq = N(q) e_k in column k."""
        return self._along("q")

    @property
    def r_v(self) -> Array:
        """∂r/∂v, shape ``(..., n, n)``."""
        return self._along("v")

    @property
    def r_u(self) -> Array:
        """∂r/∂u, shape ``(..., n, number of inputs)``."""
        return self._along("u")

    @property
    def r_p(self) -> dict[str, Array]:
        """∂r/∂p by the names of the parameters in ``wrt``, each of shape ``(..., n)``."""
        return self._by_parameter

    @property
    def M(self) -> Array:
        """M = ∂r/∂a, shape ``(..., n, n)``."""
        return self._values["M"]


class Pullback(NamedSlopes):
    """The derivatives of w·a for weights w, the vector-Jacobian products wᵀ ∂a/∂x, at one state or at many.

    ``sparsity`` says which entries may differ from 0. Leading dimensions are those of the states; units are SI.
    """

    _of = "w"

    @property
    def _shape(self) -> tuple[int, ...]:
        return next(iter(self._values.values())).shape[:-1]

    @property
    def a(self) -> Array:
        """The accelerations, shape ``(..., n)``."""
        return self._values["a"]

    @property
    def q(self) -> Array:
        """wᵀ ∂a/∂q, shape ``(..., n)``; for floating frames along the velocities, δq = N(q) e_k in entry k."""
        return self._along("q")

    @property
    def v(self) -> Array:
        """wᵀ ∂a/∂v, shape ``(..., n)``."""
        return self._along("v")

    @property
    def u(self) -> Array:
        """wᵀ ∂a/∂u, shape ``(..., number of inputs)``."""
        return self._along("u")

    @property
    def p(self) -> dict[str, Array]:
        """wᵀ ∂a/∂p by the names of the parameters in ``wrt``, each of shape ``(...)``."""
        return self._by_parameter


class HessianProduct(Pullback):
    """The change of wᵀ ∂a/∂x along a direction (δq, δv), by the same names: Hessian-vector products of w·a."""

    @property
    def a(self) -> Array:
        """Not part of a Hessian product; raises `RunError`."""
        raise RunError("a Hessian product contains no accelerations", fix="forward(q, v, u) gives them", code="E402")
