"""What a run in a browser is made of: programs for WebAssembly, and functions in JavaScript for what is around it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache, cached_property
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.codegen.javascript import names_function
from lagrangian.errors import RunError
from lagrangian.graph import Output, Program, count_program, replaced
from lagrangian.integrate import Events, Projection
from lagrangian.integrate.chattering import ASIDE, LEAST, NEAR, RESTS, Sticking
from lagrangian.integrate.portable import PortableIntegrator, portable
from lagrangian.integrate.projection import BREAKS
from lagrangian.model import Model
from lagrangian.records import dataclass
from lagrangian.simulate.events import Event
from lagrangian.simulate.inputs import InputSignals
from lagrangian.simulate.integrating import SYMPLECTIC, event_program, projection, right_hand_side
from lagrangian.simulate.pulses import Pulses
from lagrangian.simulate.switching import Switches

Quantities: TypeAlias = Program | Mapping[str, Any]
"""A program over x, u, p, t; or expressions and points of the model by name."""

ORDER = ("x", "p", "u", "t")
"""The order in which functions in JavaScript take the groups."""

SHORTEST = {False: 16, True: 6}
"""An operation in JavaScript has at least so many characters; and where they are few."""

MOST = 100_000
"""The largest number of steps to which pulses in time may force a run."""


@dataclass(frozen=True)
class BrowserParts:
    """The programs of one model, method and list of events.

    ``field`` is ẋ of x = [q; v], ``rates`` what the method integrates: the same, or over momenta.
    """

    model: Model
    drive: InputSignals
    watched: tuple[Event, ...]
    momenta: bool
    field: Program
    rates: Program
    rows: Projection | None

    @classmethod
    def of(cls, model: Model, drive: InputSignals, method: str, watched: Sequence[Event]) -> BrowserParts:
        """The parts of a run by a method. Raises `ModelError` if there are no momenta and the method needs them."""
        field = right_hand_side(model, drive)
        momenta = method in SYMPLECTIC
        rates = right_hand_side(model, drive, canonical=True) if momenta else field
        return cls(model, drive, tuple(watched), momenta, field, rates, projection(model, field, project=True))

    @cached_property
    def events(self) -> Events | None:
        """The events for the integrator, None if there are none."""
        if not self.watched:
            return None
        return Events(
            event_program(self.model, self.watched, self.drive, self.rates, momenta=self.momenta),
            tuple(e.direction for e in self.watched),
            tuple(e.terminal for e in self.watched),
            tuple(bool(e.reset) for e in self.watched),
        )

    @cached_property
    def switches(self) -> Switches:
        """Conditions that depend only on time."""
        return Switches(self.model, self.drive)

    @cached_property
    def sticking(self) -> Sticking:
        """Surfaces on which a run may stick."""
        return Sticking(self.field)

    @property
    def signals(self) -> bool:
        """Whether steps have to end at certain times: knots of tables, and times at which conditions switch."""
        return bool(self.switches) or not self.drive.constant

    def compiled(self, method: str, lanes: int, tolerance: float) -> PortableIntegrator:
        """The integrator as WebAssembly; ``tolerance`` is the relative one of a step."""
        return portable(
            self.rates,
            method,
            events=self.events,
            projection=self.rows,
            signals=self.signals,
            lanes=lanes,
            tolerance=tolerance,
        )

    def longest(self, p: NDArray[np.float64], duration: float) -> float | None:
        """The longest step [s] that does not jump over a pulse in time, None if there are no pulses."""
        pulses = Pulses(self.model, self.drive)
        if not pulses:
            return None
        x = np.zeros((1, self.drive.size))
        u = self.drive.at(np.zeros(1), x)[0] if self.drive.constant else np.zeros(len(self.drive.free))
        times = pulses.times(p, u, 0.0, duration)
        if not len(times):
            return None
        return max(float(np.diff(np.concatenate([[0.0], times, [duration]])).min()), duration / MOST)

    @cached_property
    def _around(self) -> dict[str, Program]:
        """The programs that a run in WebAssembly needs around it."""
        found: dict[str, Program] = {}
        if self._masses is not None:
            found["masses"] = self._masses
        if self.momenta:
            found |= {"momenta": dynamics.momenta(self.model), "velocities": dynamics.velocities(self.model)}
        if self.switches:
            found["switches"] = self.switches.compared()
        if self.rows is not None and self.rows.spare:
            found |= self._landing
        if self.sticking:
            found |= {"rhs": self.field, "surfaces": self.sticking.surfaces()}
        return found

    @cached_property
    def _masses(self) -> Program | None:
        """p → the masses that depend on parameters, None if there are none."""
        bodies = dynamics.body_numbers(self.model, (p.name for p in self.model.parameters), inertias=False)
        return None if bodies is None else replace(bodies, name="masses")

    @cached_property
    def _projections(self) -> dict[str, Callable[[], Program]]:
        """What makes the programs that project a state onto the constraints, by their names."""
        if self.rows is None:
            return {}
        approach = self.rows.approach
        return {
            **({} if approach is None else {"approach": lambda: approach}),
            "landing": lambda: self._landing["landing"],
        }

    @cached_property
    def _landing(self) -> dict[str, Program]:
        """The last step of a projection, and what it leaves."""
        return {} if self.rows is None else {"landing": self.rows.landing(self.field)}

    def layout(self) -> dict[str, Any]:
        """What the driver has to know of them, as plain data."""
        sticking = {"near": NEAR, "aside": ASIDE, "rests": RESTS, "least": LEAST} if self.sticking else None
        broken = {"names": ["reset_position", "reset_velocity"], "limit": BREAKS} if self.rows and self.events else None
        return {
            "events": [
                {"name": e.title, "direction": e.direction, "terminal": e.terminal, "reset": bool(e.reset)}
                for e in self.watched
            ],
            "masses": [{"name": name, "rests": name.startswith("resting")} for name in self._masses.outputs]
            if self._masses is not None
            else [],
            "supply": dynamics.SUPPLY in self.field.inputs["x"],
            "spare": {"names": ["position_after", "velocity_after"], "limit": BREAKS}
            if "landing" in self._around
            else None,
            "momenta": self.momenta,
            "switching": bool(self.switches),
            "sticking": sticking,
            "broken": broken,
            "projected": list(self._projections),
            "needs": list(self._around),
        }

    def _replacing(self, most: float) -> dict[str, Program]:
        """The programs of a run in JavaScript, none if they have more than ``most`` operations: not all are made."""
        found: dict[str, Program] = {}
        count = 0
        for name, make in {"rhs": lambda: self.field, **self._projections}.items():
            found[name] = make()
            count += 0 if name in self._around else count_program(found[name]).operations
            if count > most:
                return {}
        return found

    def functions(self, more: Mapping[str, Quantities], *, fallback: float, brief: bool = False) -> str:
        """An expression of JavaScript: the object of all functions, by name.

        ``more``: those that the page asked for. ``fallback``: also those that runs in JavaScript need, unless the
        text has more characters than that. ``brief``: in few characters. Raises `RunError` for a name that a function
        cannot have.
        """
        model, feedback = self.model, self.drive.feedback
        checked: dict[str, Program] = {}
        if "power" not in more:  # whose balance has T and V, too
            power = dynamics.power_closed(model, feedback)
            checked["energy"] = replace(power, name="energy", outputs={n: power.outputs[n] for n in ("T", "V")})
        for name, asked in more.items():
            if name in {*self._around, "rhs", *self._projections, *checked} or not names_function(name):
                raise RunError(
                    f"'{name}' cannot name a function", fix="use letters, digits and underscores", code="E702"
                )
            checked[name] = asked if isinstance(asked, Program) else dynamics.observe_closed(model, asked, feedback)
        needed = {**self._around, **checked}
        printed = machine.brief_javascript if brief else machine.to_javascript
        every: dict[str, Program] = {}

        @cache
        def text(name: str) -> str:
            return printed(_ordered(every[name]), name=name, checked=name in checked)

        def written(programs: Mapping[str, Program]) -> str:
            every.update(programs)
            return _object({name: text(name) for name in programs})

        if spared := self._replacing(fallback / SHORTEST[brief]):
            whole = written({**needed, **spared})
            if len(whole) <= fallback:
                return whole
        return written({**self._residual, **needed})

    @property
    def _residual(self) -> dict[str, Program]:
        """x, p, u, t → the rows on positions, which are 0 where loops are closed; for pages without ``approach``."""
        if self.rows is None or self.rows.approach is None:
            return {}
        found = dynamics.residual(self.model)
        graph, rows, n = found.graph, found.outputs["f"], len(found.inputs["q"])
        known = {graph.input("q", i): graph.input("x", i) for i in range(n)}
        known |= {graph.input("v", i): graph.input("x", n + i) for i in range(len(found.inputs["v"]))}
        f = Output(tuple(replaced(graph, rows.ids, known)), rows.shape)
        return {"residual": Program("residual", graph, self.field.inputs, {"f": f}, found.defaults)}


def _object(texts: Mapping[str, str]) -> str:
    """An expression of JavaScript: the object of functions with these definitions."""
    return "\n".join(["(() => {", *texts.values(), f"return {{{', '.join(texts)}}};", "})()"])


def _ordered(program: Program) -> Program:
    """The program with its groups in the order x, p, u, t."""
    return replace(program, inputs={group: program.inputs.get(group, ()) for group in ORDER} | {"t": ("t",)})
