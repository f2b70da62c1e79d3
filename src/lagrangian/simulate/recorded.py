"""The recorded data of a run, and what can be computed from them: states, expressions, energies, points, energy
balance."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.advice import Advice, Argument
from lagrangian.calls import TRAJECTORY, Guided
from lagrangian.errors import ModelError, NoSuchEntry, Notice, did_you_mean
from lagrangian.integrate.status import RunStatus
from lagrangian.model import Element, Model, Point, as_expr
from lagrangian.model.names import multiplier_symbol
from lagrangian.model.rows import drive_symbol, named_conditions
from lagrangian.records import dataclass, field
from lagrangian.simulate.drift import RunDrift
from lagrangian.simulate.integrating import Task, remembered
from lagrangian.simulate.joint_forces import joint_force, part_of
from lagrangian.simulate.quantities import quantity
from lagrangian.simulate.reaction import Reaction, worked_out
from lagrangian.simulate.settings import ATOL
from lagrangian.viewed import Brief, Entries

if TYPE_CHECKING:
    from lagrangian.graph import Program

Array = NDArray[np.float64]


TRUSTED = 1e-3
"""An error of the energy balance, relative to the energy that moves, up to this is accepted."""

ROUNDING = 1e-13
"""If the supplied energy is below this fraction of the energy that moves, it counts as zero."""


SEEN = 16 * float(np.finfo(float).eps) / TRUSTED
"""The energy, relative to V, whose balance can be judged to `TRUSTED` beside the rounding of V."""


@dataclass(frozen=True)
class Audit(Brief):
    """How well a run satisfies its energy balance h(t) = h(0) + supplied energy, h = q̇·∂L/∂q̇ − L.

    ``figure`` is the largest difference, relative to the energy that moves in the run (the largest of T*, the change of
    V, and the supplied energy), or to the least that rounding lets be seen beside V if that is more. It is 0 at rest,
    where no rate exceeds the absolute tolerance and its default. ``time`` is where it is largest. float(audit) is the
    figure.
    """

    figure: float
    time: float
    conserved: bool

    def __float__(self) -> float:
        return self.figure

    @property
    def missed(self) -> Advice:
        """The warning about an error of more than `TRUSTED`, otherwise an empty text."""
        if self.figure <= TRUSTED:
            return Advice()
        return Advice(
            f"energy balance missed by {100 * self.figure:.2g} % at t = {self.time:.4g} s: the integration is not to "
            "be trusted: smaller ",
            Argument("max_step"),
            ", ",
            Argument("step"),
            " or tolerances",
        )

    def __str__(self) -> str:
        """Return ``energy drift 3.1e-12`` or ``power balance 3.1e-12``."""
        return f"{'energy drift' if self.conserved else 'power balance'} {self.figure:.1e}"


@dataclass(frozen=True)
class Occurrences(Brief):
    """The occurrences of an event: the times ``t`` (k,) and the states just before it, ``y`` (n_states, k)."""

    t: Array
    y: Array

    def __len__(self) -> int:
        return len(self.t)


@dataclass(eq=False)
class Recorded(Guided):
    """The numbers of a run, and everything that can be computed from them by name; see `Trajectory`."""

    _guide = TRAJECTORY

    model: Model = field(repr=False)
    t: Array
    y: Array
    status: RunStatus
    success: bool
    message: str
    method: str
    nfev: int
    steps: int
    rejected: int
    p: Array
    u: Array
    feedback: dict[Any, sp.Expr]
    events: Mapping[str, Occurrences]
    supplied: Array
    jumps: Array
    settings: Mapping[str, Any]
    notices: tuple[Notice, ...] = ()
    drift: RunDrift | None = None
    modes: Mapping[str, NDArray[np.int8]] = field(default_factory=dict[str, NDArray[np.int8]])
    regimes: NDArray[np.int8] = field(default_factory=lambda: np.zeros((0, 0), np.int8))
    reactions: Sequence[str] = ()
    task: Task | None = field(default=None, repr=False)

    # -- quantities ---------------------------------------------------------------------------------------------

    @cached_property
    def states(self) -> tuple[str, ...]:
        """The names of the states, coordinates first."""
        return (*(c.name for c in self.model.coordinates), *(v.name for v in self.model.velocities))

    @property
    def params(self) -> dict[str, float]:
        """The parameters of the run."""
        values = zip((p.name for p in self.model.parameters), map(float, self.p), strict=True)
        return Entries(dict(values), "params")

    def __getitem__(self, asked: Any) -> Array:
        """Return a quantity at every time: a state by name, an expression (SymPy or text), the path of a point (S, d),
        the multiplier of a constraint's row, ``run["loop.x"]``, or of a joint's reaction |F| or a component,
        ``run["reaction B"]``, ``run["reaction B.x"]``."""
        if isinstance(asked, str):
            if asked in self.states:
                return self.y[self.states.index(asked)]
            if (joint := joint_force(self.model, asked)) is not None:
                found = self.reaction(joint.joint)
                return part_of(joint.part, found.force, found.torque.reshape(len(self.t), -1))
            asked = quantity(self.model, asked, "quantity asked of the run")
        elif isinstance(asked, (int, slice)):
            raise ModelError(
                f"run[…] takes a name or an expression (got {asked!r:.40})",
                fix=f"run['{self.states[0]}']; the rows of run.y are the states",
                code="E406",
            )
        if isinstance(asked, sp.Expr) and (at := self._places.get(asked)) is not None:
            return self.y[at]
        return self.observe({"asked": asked})["asked"]

    @cached_property
    def _places(self) -> dict[Any, int]:
        """The rows of ``y`` for the symbols of the states."""
        symbols = [*(c.symbol for c in self.model.coordinates), *(v.symbol for v in self.model.velocities)]
        return {symbol: i for i, symbol in enumerate(symbols)}

    def _own_name(self, name: str) -> str | None:
        """Quantities are accessed as entries, not as attributes."""
        model = self.__dict__.get("model")
        return f'run["{name}"]' if model is not None and name in model.symbols else None

    def observe(self, outputs: Mapping[str, Any]) -> dict[str, Array]:
        """Return several expressions or points at once, by name."""
        asked = {k: x if isinstance(x, Point) else as_expr(x, f"'{k}'") for k, x in outputs.items()}
        key = ("observe", tuple(asked.items()), frozenset(self.feedback.items()))
        return self._evaluated(key, lambda model: dynamics.observe_closed(model, asked, self.feedback))

    def _evaluated(self, key: Any, make: Callable[[Model], Program]) -> dict[str, Array]:
        """The outputs of a program at every time; it is compiled only once for all runs of the system.

        With friction, a sample is evaluated with the equations of its regime.
        """
        if not self.modes:
            return self._evaluated_in(self.model, key, make, slice(None))
        regimes, which = np.unique(self.regimes, axis=0, return_inverse=True)
        found: dict[str, Array] = {}
        for k, modes in enumerate(regimes.tolist()):
            at = np.flatnonzero(which.reshape(-1) == k)
            for name, values in self._evaluated_in(dynamics.regime(self.model, tuple(modes)), key, make, at).items():
                found.setdefault(name, np.empty((len(self.t), *values.shape[1:])))[at] = values
        return found

    def _evaluated_in(self, model: Model, key: Any, make: Callable[[Model], Program], at: Any) -> dict[str, Array]:
        """The outputs of a program of a model at some of the times."""
        kernel: machine.Kernel = remembered(model, key, lambda: machine.compile(make(model)))
        answer = kernel(np.ascontiguousarray(self.y.T[at]), self.u[at], self.p, self.t[at])
        return answer if isinstance(answer, dict) else {next(iter(kernel.program.outputs)): answer}

    @cached_property
    def stuck(self) -> Mapping[str, Array]:
        """When each friction sticks, by name: from when to when [s], (k, 2), up to the end of the run."""
        found: dict[str, Array] = {}
        for name, modes in self.modes.items():
            begins, ends = self.events[f"{name} sticks"].t, self.events[f"{name} slips"].t
            if len(modes) and modes[0] == 0 and not np.any(begins <= self.t[0]):
                begins = np.concatenate([self.t[:1], begins])
            ends = np.append(ends, self.t[-1:])
            found[name] = np.stack([begins, ends[np.searchsorted(ends[:-1], begins)]], axis=1)
        return Entries(found, "stuck")

    # -- energies -----------------------------------------------------------------------------------------------

    @cached_property
    def _power(self) -> dict[str, Array]:
        key = ("power", frozenset(self.feedback.items()))
        return self._evaluated(key, lambda model: dynamics.power_closed(model, self.feedback))

    @property
    def kinetic(self) -> Array:
        """T* [J], shape (S,)."""
        return self._power["T"]

    @property
    def potential(self) -> Array:
        """V [J], shape (S,)."""
        return self._power["V"]

    @property
    def energy(self) -> Array:
        """T + V [J], shape (S,); the energy T is the co-energy T* except for coils that saturate."""
        total, coils = self.kinetic + self.potential, self.model.saturating
        if not coils:
            return total
        return total + self[sp.Add(*(e.stored_energy(self.model) - e.kinetic(self.model) for e in coils))]

    @property
    def power(self) -> Array:
        """The external power Ξ·q̇ − ∂L/∂t [W], shape (S,)."""
        return self._power["P"]

    @cached_property
    def imbalance(self) -> Array:
        """h(t) − h(0) − the energy supplied until t [J], shape (S,), from which `audit` is computed."""
        h = self._power["h"]
        return h - h[0] - self.supplied - self.jumps if len(h) else h

    @cached_property
    def audit(self) -> Audit:
        """The energy balance as a figure."""
        if not len(self.t):
            return Audit(0.0, 0.0, True)
        T, V, W = self.kinetic, self.potential, self.supplied
        given = float(np.max(np.abs(W)))
        scale = max(float(np.max(np.abs(T))), float(np.ptp(V)), given, SEEN * float(np.max(np.abs(V))))
        worst = int(np.argmax(np.abs(self.imbalance)))
        at_rest = np.all(np.abs(self.y[-len(self.model.velocities) :]) <= min(self.settings["atol"], ATOL))
        largest = 0.0 if at_rest else abs(float(self.imbalance[worst]))
        return Audit(largest / scale if largest else 0.0, float(self.t[worst]), given <= ROUNDING * scale)

    @cached_property
    def points(self) -> Mapping[str, Array]:
        """Paths of the named points, (S, d) each, in the fixed axes [m]."""
        return NamedQuantities(self, "point", {p.name: partial(_same, p) for p in self.model.points if p.name})

    @cached_property
    def powers(self) -> Mapping[str, Array]:
        """The power [W] that each force, damper, spring, constraint, … supplies to the motion, by name, (S,) each.

        A constraint supplies power where it depends on time, −Σ λ a₀ with c = A v + a₀; otherwise 0.
        """
        acting = [e for e in self.model.elements if e.ledger != "T*"]
        return NamedQuantities(
            self, "element that gives power,", {e.name: partial(element_power, self.model, e) for e in acting}
        )

    def reaction(self, joint: Any, *, on: Any = None, axes: Any = None) -> Reaction:
        """Return the force and the torque in a joint at every time, as a `lagrangian.Reaction`.

        ``joint`` is the name of a constraint, of a point at which a body is held, or of a body that is held. Without
        ``on``, the reaction acts on the first point's body of a constraint, and on the outer body of another joint.
        ``on`` names a body, frame or point, or is "ground". Components are in the fixed axes, or in a frame's ``axes``.
        Torques and springs that act on a joint's own coordinate are no part of its reaction. Raises `ModelError` for
        what is no joint.
        """
        key = ("reaction", joint, on, axes, frozenset(self.feedback.items()))

        def made(model: Model) -> dynamics.ReactionProgram:
            return remembered(
                model,
                (*key, "program"),
                lambda: dynamics.reaction(model, joint, on, axes, self.feedback, state=True),
            )

        first = made(dynamics.slips(self.model))
        return worked_out(self.model, first, self._evaluated(key, lambda model: made(model).program))

    @cached_property
    def multipliers(self) -> Mapping[str, Array]:
        """The multipliers λ of the constraints' rows by name, (S,) each; λ > 0 acts so as to increase what is zero."""
        return NamedQuantities(
            self,
            "constraint row",
            {row.name: partial(multiplier_symbol, row.name) for row in named_conditions(self.model)},
        )


class NamedQuantities(Mapping[str, Array]):
    """Quantities of a run by name, computed when they are requested; ``what`` describes them in messages."""

    def __init__(self, run: Recorded, what: str, quantities: Mapping[str, Callable[[], Any]]) -> None:
        self._run, self._what, self._quantities = run, what, quantities
        self._known: dict[str, Array] = {}

    def __getitem__(self, name: Any) -> Array:
        key = getattr(name, "name", name)  # the point or element itself is accepted, too
        if key not in self._quantities:
            known = ", ".join(self._quantities) or "none"
            fix = did_you_mean(str(key), self._quantities) or f"known: {known}"
            raise NoSuchEntry(f"there is no {self._what} '{key}'", fix=fix, code="E412")
        if key not in self._known:
            self._known[key] = self._run[self._quantities[key]()]
        return self._known[key]

    def __contains__(self, name: object) -> bool:
        return getattr(name, "name", name) in self._quantities

    def __iter__(self) -> Iterator[str]:
        return iter(self._quantities)

    def __len__(self) -> int:
        return len(self._quantities)

    def __repr__(self) -> str:
        """List the names."""
        return f"<{', '.join(self._quantities) or 'nothing'}>"


def _same(thing: Any) -> Any:
    return thing


def element_power(model: Model, element: Element) -> sp.Expr:
    """The power [W] that an element supplies to the motion: Σ effort · rate, and −V̇ of its potential energy.

    V̇ is taken along the motion, with inputs and time constant. Of a constraint it is −Σ λ a₀ over its rows.
    """
    if element.ledger == "λ":
        rows = [row.name for row in named_conditions(model) if row.element is element]
        return -sp.Add(*(multiplier_symbol(name) * drive_symbol(name) for name in rows))
    given = sum((a.effort * a.rate for a in element.works(model)), sp.S.Zero)
    stored = element.potential(model)
    return given - sum((sp.diff(stored, c.symbol) * c.rate for c in model.coordinates), sp.S.Zero)
