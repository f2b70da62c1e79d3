"""One run of a system with dry friction: what is integrated, and what a trajectory tells of slipping and sticking."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from lagrangian import dynamics
from lagrangian.errors import RunError
from lagrangian.integrate import METHODS, RunStatus
from lagrangian.integrate.scipy_methods import Outcome
from lagrangian.model import Model
from lagrangian.records import dataclass
from lagrangian.simulate.events import events_of
from lagrangian.simulate.inputs import InputSignals
from lagrangian.simulate.integrating import SYMPLECTIC, Task, outcome_of, right_hand_side, solver_options
from lagrangian.simulate.recorded import Occurrences
from lagrangian.simulate.settings import RunSettings
from lagrangian.simulate.stick_slip import SlipSolution, StickSlip
from lagrangian.viewed import Entries

if TYPE_CHECKING:
    from lagrangian.simulate.trajectory import Trajectory

ENDS = (RunStatus.ZENO, RunStatus.CROWDED)
"""The statuses of runs that change between slipping and sticking without end."""


def check_method(model: Model, method: str) -> None:
    """Raise `RunError` for a method that cannot integrate friction."""
    if not model.frictions or (method in METHODS and method not in SYMPLECTIC):
        return
    raise RunError(
        f"method '{method}' does not find where {model.frictions[0].title} begins to stick or to slip",
        fix="use 'dop853', 'taylor' or another method in machine code; give inputs as expressions or tables",
        code="E501",
    )


def solver_of_runs(model: Model, settings: RunSettings, method: str, drive: InputSignals) -> StickSlip:
    """What integrates the runs of an ensemble."""
    events = events_of(model, settings.events)
    return StickSlip(model, method, drive.feedback, events, project=settings.project, supply=False)


@dataclass(frozen=True)
class SlipRun:
    """A run and the regimes it went through."""

    task: Task
    outcome: Outcome
    solution: SlipSolution

    def noted(self, made: Trajectory) -> None:
        """Add the modes at the samples, and the times at which frictions begin to stick and to slip, as events."""
        frictions = self.task.model.frictions
        count = len(made.t)
        modes = self.solution.modes[0, : min(count, len(self.outcome.times))]
        modes = np.concatenate([modes, np.repeat(self.solution.last_modes, count - len(modes), axis=0)])
        made.modes = Entries({f.name: modes[:, i] for i, f in enumerate(frictions)}, "modes")
        made.regimes = modes
        events = dict(made.events)
        for i, f in enumerate(frictions):
            for word, sticks in (("sticks", True), ("slips", False)):
                own = [
                    x
                    for x in self.solution.transitions[0]
                    if x.friction == i and (x.mode == 0) == sticks and x.time <= self.outcome.reached
                ]
                states = np.array([x.state[: self.task.size] for x in own]).reshape(len(own), self.task.size).T
                events[f"{f.name} {word}"] = Occurrences(np.array([x.time for x in own]), states)
        made.events = Entries(events, "events")


def run(task: Task) -> SlipRun:
    """Integrate a system with friction, regime by regime."""
    program = right_hand_side(task.model, task.drive)
    supply = dynamics.SUPPLY in program.inputs["x"]
    way = StickSlip(task.model, task.method, task.drive.feedback, task.events, project=task.project, supply=supply)
    found = way.solve(task.x0, task.times, **solver_options(task))
    outcome = outcome_of(task, found)
    if outcome.status in ENDS:
        changes = len(found.transitions[0])
        said = f"[E505] gave up after {len(outcome.hits)} events and {changes} changes between slipping and sticking"
        outcome = replace(outcome, reason=said)
    return SlipRun(task, outcome, found)
