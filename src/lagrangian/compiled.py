"""The compiled system: the class that ``system.compile()`` returns."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.differentiated import Differentiated
from lagrangian.errors import RunError
from lagrangian.export.programs import exported
from lagrangian.graph import reached
from lagrangian.queries import by_name as _named

if TYPE_CHECKING:
    from lagrangian.graph import Program
    from lagrangian.model import Model

Values = ArrayLike | Mapping[Any, Any] | None
"""Inputs or parameters: an array in declared order, a mapping by name or symbol, or None for the declared values."""

SINGULAR = 1e12
"""Condition number of M above which a configuration is called singular."""

NO_LENGTH = 1e-150
"""A quaternion shorter than this cannot be normalized: its square is too small to divide by."""

NOT_FINITE = "E503"
"""The error code of results that are not finite."""


class Compiled(Differentiated):
    """The dynamics M(q) q̈ + C(q, q̇) q̇ + G(q) = Ξ of a system, as functions in machine code.

    Every method takes arrays of shape ``(..., n)``, whose leading dimensions broadcast together, in the declared order
    of ``coordinates`` and ``velocities``. v contains the rates of q and has as many entries, except for floating
    frames: for each of these q has seven entries, among them a quaternion of any length but 0, and v has six; for a
    ball joint q has the four of the quaternion, and v has three.
    Accelerations, forces, M, C, G and J correspond to the entries of v; `rates` returns q̇.

    ``u`` are the inputs, 0 unless given; ``p`` are the parameters, with their declared values unless given. Both may be
    mappings by name or arrays in declared order. ``t`` is time [s]. Each method is compiled at its first call, and its
    code is kept on disk.

    Raises `RunError` for a shape, a type, a name or a value that does not fit, and if M is singular.
    """

    def __init__(self, model: Model, *, lanes: int | None = None, threads: int | None = None) -> None:
        self._model, self._lanes, self._threads = model, lanes, threads
        self._kernels: dict[str, machine.Kernel] = {}
        # The quick ways into the programs: a method tries its own before it does anything else.
        self._quick: dict[str, Callable[[tuple[Any, ...]], Any]] = dict.fromkeys(_PROGRAMS, _not_compiled)
        self._seen: dict[Any, machine.Kernel] = {}
        self.coordinates = tuple(c.name for c in model.coordinates)
        self.velocities = tuple(v.name for v in model.velocities)
        self._floats = [f.floating for f in model.floating if f.floating is not None]
        self.inputs = tuple(u.name for u in model.inputs)
        self.parameters = tuple(p.name for p in model.parameters)
        self.exported = exported(model)
        """The programs that a source file is written of."""
        self._kernel("forward")  # so that a coordinate without mass is found now, not at the first call

    def __reduce__(self) -> Any:
        return partial(type(self), lanes=self._lanes, threads=self._threads), (self._model,)

    def __repr__(self) -> str:
        """Name the system and its coordinates."""
        return f"<Compiled {self._model.name!r}: q = {', '.join(self.coordinates)}>"

    def program(self, name: str) -> Program:
        """Return the `Program` of a method: "forward", "inverse", "mass_matrix", "bias", "potential_force", …"""
        if not isinstance(name, str) or name not in _PROGRAMS:
            raise RunError(f"there is no program {name!r}", fix=f"use one of {', '.join(_PROGRAMS)}", code="E402")
        return _PROGRAMS[name](self._model)

    def _kernel(self, name: str) -> machine.Kernel:
        found = self._kernels.get(name)
        if found is None:
            optional = {"u": 0.0, "t": 0.0}
            if name in _STILL:
                optional["v"] = 0.0
            found = machine.compile(self.program(name), optional=optional, lanes=self._lanes, threads=self._threads)
            if name in _SOLVING:
                self._admit(found)
            found.also({x.symbol: x.name for x in (*self._model.inputs, *self._model.parameters)})
            self._kernels[name] = found
            self._quick[name] = found.quick
        return found

    def forward(
        self, q: ArrayLike, v: ArrayLike, u: Values = None, p: Values = None, t: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Return the accelerations q̈, shape ``(..., n)``; for chains and trees the time is O(n)."""
        answer = self._quick["forward"](given := (q, v, u, p, t))
        return self._closer("forward", given) if answer is None else answer

    def inverse(
        self, q: ArrayLike, v: ArrayLike, a: ArrayLike, u: Values = None, p: Values = None, t: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Return the generalized forces that a motion needs in addition to those described: M a + C v + G − Ξ(u).

        With constraints, the forces Aᵀ λ of their rows are part of what is missing: on a motion by `forward` nothing
        else is.
        """
        answer = self._quick["inverse"](given := (q, v, a, u, p, t))
        return self._closer("inverse", given) if answer is None else answer

    def mass_matrix(
        self, q: ArrayLike, p: Values = None, t: ArrayLike = 0.0, *, v: ArrayLike | None = None
    ) -> NDArray[np.float64]:
        """Return M(q), shape ``(..., n, n)``.

        If T* is not quadratic in the rates, M depends on them, and ``v`` must be given; otherwise there is a
        `RunError`.
        """
        if v is None and not self._quadratic:
            raise RunError(
                "M depends on the rates: the kinetic co-energy is not quadratic in them",
                fix="give the rates as well, mass_matrix(q, v=…)",
                code="E501",
            )
        answer = self._quick["mass_matrix"](given := (q, v, None, p, t))
        return self._closer("mass_matrix", given) if answer is None else answer

    def bias(
        self, q: ArrayLike, v: ArrayLike, u: Values = None, p: Values = None, t: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Return C v + G − Ξ(u), which is `inverse` at a = 0."""
        answer = self._quick["bias"](given := (q, v, u, p, t))
        return self._closer("bias", given) if answer is None else answer

    def coriolis_matrix(self, q: ArrayLike, v: ArrayLike, p: Values = None, t: ArrayLike = 0.0) -> NDArray[np.float64]:
        """Return C(q, v), made of Christoffel symbols, shape ``(..., n, n)``: Ṁ − 2C is skew-symmetric.

        C v is the part of the bias that is quadratic in v. For the velocities of a floating frame, which are not rates
        of coordinates, the symbols contain additional terms, so that both properties hold as well. Raises `RunError` if
        T* is not quadratic in the rates.
        """
        if not self.quadratic:
            raise RunError(
                "there are no Christoffel symbols: the kinetic co-energy is not quadratic in the rates",
                fix="use bias(q, v), which contains all velocity and position terms",
                code="E501",
            )
        answer = self._quick["coriolis"](given := (q, v, None, p, t))
        return self._closer("coriolis", given) if answer is None else answer

    def potential_force(
        self, q: ArrayLike, u: Values = None, p: Values = None, t: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Return ∂V/∂q, shape ``(..., n)``, from gravity, springs and potentials (Nᵀ ∂V/∂q if q̇ = N v)."""
        answer = self._quick["potential_force"](given := (q, None, u, p, t))
        return self._closer("potential_force", given) if answer is None else answer

    def energy(
        self, q: ArrayLike, v: ArrayLike, u: Values = None, p: Values = None, t: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Return T* + V [J], shape ``(...)``."""
        answer = self._quick["energy"](given := (q, v, u, p, t))
        both = self._closer("energy", given) if answer is None else answer
        return both["T"] + both["V"]

    def energies(
        self, q: ArrayLike, v: ArrayLike, u: Values = None, p: Values = None, t: ArrayLike = 0.0
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return T* and V [J], each of shape ``(...)``."""
        answer = self._quick["energy"](given := (q, v, u, p, t))
        both = self._closer("energy", given) if answer is None else answer
        return both["T"], both["V"]

    def rates(self, q: ArrayLike, v: ArrayLike) -> NDArray[np.float64]:
        """Return q̇ = N(q) v, shape ``(..., n_q)``, which equals v except for floating frames."""
        unread = np.ones(len(self.parameters))  # q̇ = N(q) v has no parameters, and they may have no values
        answer = self._quick["rates"](given := (q, v, None, unread, 0.0))
        return self._closer("rates", given) if answer is None else answer

    def rhs(self, t: ArrayLike, x: ArrayLike, u: Values = None, p: Values = None) -> NDArray[np.float64]:
        """Return ẋ of x = [q; v] in declared order, shape ``(..., n_q + n_v)``: the right-hand side that ODE solvers
        need."""
        answer = self._quick["rhs"](given := (x, u, p, t))
        return self._closer("rhs", given) if answer is None else answer

    def _closer(self, name: str, given: tuple[Any, ...]) -> Any:
        """The result of a program that is not compiled yet, or whose arguments need a closer look."""
        return self._called(self._kernel(name), given)

    def _called(self, kernel: machine.Kernel, given: tuple[Any, ...]) -> Any:
        """Call a kernel with coordinates or states, …, inputs, parameters and t; if the result is not finite, explain
        why."""
        answer = kernel.quick(given)
        if answer is not None:
            return answer
        *states, u, p, t = given
        try:
            return kernel(*states, _named(u), _named(p), t)
        except RunError as trouble:
            raise self._explained(trouble, states[0], p, t) from None

    @property
    def quadratic(self) -> bool:
        """Whether T* is quadratic in the rates, as it is for bodies; then M depends only on q and perhaps t."""
        return self._quadratic

    @cached_property
    def _quadratic(self) -> bool:
        program = self._kernel("mass_matrix").program
        return not any(program.graph.nodes[i][:2] == ("input", "v") for i in reached(program.graph, program.ids))

    @cached_property
    def operations(self) -> int:
        """The number of machine operations that one evaluation of q̈ takes."""
        return self._kernel("forward").operations

    def _explained(self, trouble: RunError, q: ArrayLike, p: Values, t: ArrayLike) -> RunError:
        """If a result is not finite, look for a quaternion of length 0 and for a singular M, and raise the error that
        explains it.

        ``q`` are coordinates, or states x, as they were passed to the method.
        """
        if trouble.code != NOT_FINITE or not trouble.what.startswith("output"):
            return trouble
        q, n = self._placed(q), len(self.coordinates)
        for floating in self._floats:
            first = self.coordinates.index(floating.orientation[0].name)
            lengths = np.linalg.norm(q[..., first : first + 4], axis=-1)
            if lengths.min() < NO_LENGTH:
                listed = ", ".join(c.name for c in floating.orientation)
                return RunError(
                    f"the quaternion {listed} has the length {lengths.min():.3g}, so it does not define an orientation",
                    fix="use a quaternion of any length other than 0; (0, 0, 0, 1) means not rotated",
                    code="E503",
                )
        if self._model.constraints:  # a singular M alone would explain nothing
            return trouble
        try:
            matrices = np.asarray(self._kernel("mass_matrix")(q, None, None, _named(p), t))
        except RunError:
            return trouble
        flat = matrices.reshape(-1, *matrices.shape[-2:])
        states = np.broadcast_to(q, (*matrices.shape[:-2], n)).reshape(len(flat), -1)
        for state, M in zip(states, flat, strict=True):
            _, singular, right = np.linalg.svd(M)
            if singular[-1] <= singular[0] / SINGULAR:
                moved = dynamics.moving_no_mass(self.velocities, right[-1:])
                return RunError(
                    f"M is singular at {self._listed(state)}: {moved} there",
                    fix="choose other coordinates near this configuration, or give what they move mass or inertia",
                    code="E203",
                )
        return trouble

    def _placed(self, given: Any) -> NDArray[np.float64]:
        """The coordinates, (..., n), among the coordinates or states that were passed to a kernel."""
        if isinstance(given, Mapping):
            named = {str(name): np.asarray(value, float) for name, value in given.items()}
            return np.stack(np.broadcast_arrays(*(named[name] for name in self.coordinates)), axis=-1)
        return np.atleast_1d(np.asarray(given, float))[..., : len(self.coordinates)]

    def _listed(self, state: NDArray[np.float64]) -> str:
        shown = [f"{name} = {x:.6g}" for name, x in zip(self.coordinates, state, strict=True)]
        return ", ".join(shown[:8]) + (", …" if len(shown) > 8 else "")


_PROGRAMS: dict[str, Callable[[Model], Program]] = {
    "forward": dynamics.forward,
    "inverse": dynamics.inverse,
    "mass_matrix": dynamics.mass_matrix,
    "bias": dynamics.bias,
    "potential_force": dynamics.potential_force,
    "coriolis": dynamics.coriolis,
    "energy": dynamics.energy,
    "rhs": dynamics.rhs,
    "rates": dynamics.rates,
}
_STILL = ("mass_matrix", "potential_force")
_SOLVING = ("forward", "rhs")


def _not_compiled(_: tuple[Any, ...]) -> None:
    """Stand in for a program that is not compiled yet."""
