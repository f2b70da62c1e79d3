"""The regimes of a system with dry friction, compiled: each friction slips in one sense or sticks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.errors import RunError
from lagrangian.graph import Program, evaluate
from lagrangian.integrate import Events, Solver
from lagrangian.model import Model
from lagrangian.model.rows import pressed_rows
from lagrangian.records import dataclass
from lagrangian.simulate import resets
from lagrangian.simulate.events import Event
from lagrangian.simulate.integrating import projection, remembered

Array = NDArray[np.float64]
Modes = dynamics.Modes


@dataclass(frozen=True)
class Regime:
    """A regime, compiled: its solver, the verdict on its states, and whether its x ends with the supplied energy."""

    modes: Modes
    solver: Solver
    verdict: Program
    supplies: bool


class Regimes:
    """The regimes of a model over x = [q; v] and, with ``supply``, the supplied energy; each is compiled when needed.

    ``drifts``: whether runs may drift from constraints that the model has besides its frictions.
    """

    def __init__(
        self,
        model: Model,
        method: str,
        feedback: Mapping[Any, Any],
        events: Sequence[Event],
        *,
        project: bool,
        supply: bool,
    ) -> None:
        self.model, self.method, self.feedback, self.events = model, method, dict(feedback), tuple(events)
        self.project, self.supply = project, supply
        self.size = len(model.coordinates) + len(model.velocities)
        self.count = len(model.frictions)
        self.start: Modes = (0,) * self.count + (1,) * len(pressed_rows(model))
        self.drifts = bool(model.constraints) and dynamics.projection(model) != (None, None)
        self._key = (method, frozenset(self.feedback.items()), project, supply)
        if any(e.reset for e in events) and model.constraints:
            raise RunError(
                "an event changes the state of a system that has both constraints and friction",
                fix="leave out the reset, or one of the two",
                code="E501",
            )

    def regime(self, modes: Modes, rest: float) -> Regime:
        """A regime, compiled at the first request."""
        listed = tuple((e.expression, e.direction, e.terminal, bool(e.reset)) for e in self.events)
        key = ("regime", *self._key, listed, rest)
        return remembered(dynamics.regime(self.model, modes), key, lambda: self._made(modes, rest))

    def _made(self, modes: Modes, rest: float) -> Regime:
        model = dynamics.regime(self.model, modes)
        program = remembered(
            model, ("rhs", *self._key), lambda: dynamics.closed(model, self.feedback, supply=self.supply)
        )
        supplies = len(program.inputs["x"]) > self.size
        impacts = [(e.title, e.expression, e.reset) for e in self.events]
        ends = dynamics.watches(self.model, modes)
        watched = dynamics.watched(self.model, modes, impacts, self.feedback, supply=supplies, rest=rest)
        events = Events(
            watched,
            (*(e.direction for e in self.events), *(-1 for _ in ends)),
            (*(e.terminal or bool(e.reset) for e in self.events), *(True for _ in ends)),
            (False,) * (len(self.events) + len(ends)),
        )
        rows = projection(model, program, project=self.project)
        solver = Solver(program, self.method, events=events, projection=rows)
        return Regime(modes, solver, self._verdict(modes), supplies)

    def _verdict(self, modes: Modes) -> Program:
        key = ("verdict", *self._key)
        model = dynamics.regime(self.model, modes)
        return remembered(model, key, lambda: dynamics.verdict(self.model, modes, self.feedback))

    def paradox(self, modes: Modes) -> int:
        """The number of the event at which friction and what presses on it determine each other no more; −1: none."""
        ends = dynamics.watches(self.model, modes)
        return len(self.events) + ends.index(dynamics.PARADOX) if dynamics.PARADOX in ends else -1

    def after(self, k: int, x: Array, u: Array, p: Array, t: float) -> Array:
        """The state after event k."""

        def make() -> Any:
            impacts = [(e.title, e.expression, e.reset) for e in self.events]
            return resets.valued(machine.compile(dynamics.impacts(self.model, impacts, self.feedback)))

        key = ("after", *self._key, tuple((e.expression, frozenset(e.reset.items())) for e in self.events))
        kernel = remembered(self.model, key, make)
        return np.append(kernel(np.array(x[: self.size]), u, p, t)["after"][k], x[self.size :])

    def judged(self, modes: Modes, x: Array, u: Array, p: Array, t: float) -> dict[str, Array]:
        """The verdict of a regime on a state."""
        given = {"x": x[: self.size], "u": u, "p": p, "t": [t]}
        found = evaluate(self._verdict(modes), {name: list(map(float, values)) for name, values in given.items()})
        return {name: np.array(values, float) for name, values in found.items()}
