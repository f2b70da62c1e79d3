"""What `Trajectory.sensitivities` returns: how the quantities of a run change with what was varied."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.calls import Guided
from lagrangian.errors import ModelError, NoSuchEntry, RunError
from lagrangian.model import Point, as_expr
from lagrangian.records import dataclass, field
from lagrangian.simulate import quotients
from lagrangian.simulate.guesses import by_key
from lagrangian.simulate.quantities import quantity
from lagrangian.simulate.unknowns import values_of, with_values
from lagrangian.simulate.varied import Columns, VariedRun, columns_of, varied_run, with_signals
from lagrangian.values.values import check_sampling, key_name
from lagrangian.viewed import Entries

if TYPE_CHECKING:
    from lagrangian.page.formula import Check
    from lagrangian.simulate.integrating import Task
    from lagrangian.simulate.recorded import Recorded

Array = NDArray[np.float64]

SHOWN = 8
"""The number of columns in a notebook's view."""

ALSO: Mapping[str, str] = {
    **dict.fromkeys(("x", "y", "states", "values"), 'changes, (states, samples, names); sensitivities["theta"]'),
    **dict.fromkeys(("names", "parameters", "params", "columns"), "wrt"),
    **dict.fromkeys(("jacobian", "J", "gradient"), 'sensitivities["theta"], one column for each of wrt'),
    **dict.fromkeys(("times", "time"), "t"),
}
"""Names that sensitivities have elsewhere, and what they are called here."""


@dataclass(eq=False)
class Sensitivities(Guided):
    """The derivatives of a run's quantities with respect to parameters, initial values and inputs, by name.

    ``t`` (S,) are the times [s], ``wrt`` the names of the k columns, and ``changes`` (n_states, S, k) the derivatives
    of the states at these times. ``s["theta1"]`` and ``s["m1*x1'^2/2"]`` are (S, k), derivatives of any quantity that
    depends on parameters and inputs directly too; ``s["theta1", "m1"]`` is one column, (S,). Units are SI: an entry is
    the quantity's unit by that of the column. ``events`` has for each event the derivatives of its times,
    (occurrences, k). Where a terminal event ended the run, the derivatives are those at that fixed time.
    """

    _guide = ALSO

    t: Array
    wrt: tuple[str, ...]
    changes: Array
    events: Mapping[str, Array]
    _task: Task = field(repr=False)
    _columns: Columns = field(repr=False)
    _run: VariedRun = field(repr=False)
    _compared: str = "not compared with runs yet: verify() does"

    def __getitem__(self, asked: Any) -> Array:
        """Return the derivatives of a state, an expression (SymPy or text) or a point's path, (S, …, k)."""
        if isinstance(asked, tuple):
            if len(asked) != 2:
                raise ModelError(
                    f"sensitivities[…] takes a quantity, or a quantity and a name of wrt (got {len(asked)} entries)",
                    fix=f"such as [{self._task.states[0]!r}, {self.wrt[0]!r}]",
                    code="E406",
                )
            return self._of(asked[0])[..., self._place(asked[1])]
        return self._of(asked)

    def _place(self, name: Any) -> int:
        """The column of a name or symbol."""
        shown = key_name(name) if isinstance(name, (str, sp.Basic)) else repr(name)
        if shown not in self.wrt:
            raise NoSuchEntry.among("sensitivities have no column", shown, self.wrt)
        return self.wrt.index(shown)

    def _of(self, asked: Any) -> Array:
        states = self._task.states
        if isinstance(asked, str) and asked in states:
            return self.changes[states.index(asked)]
        if isinstance(asked, str):
            asked = quantity(self._task.model, asked, "quantity asked of the sensitivities")
        elif not isinstance(asked, (sp.Expr, Point)):
            raise ModelError(
                f"sensitivities[…] takes a name or an expression (got {asked!r:.40})",
                fix=f"such as [{states[0]!r}]",
                code="E406",
            )
        return self.observe({"asked": asked})["asked"]

    def observe(self, outputs: Mapping[str, Any]) -> dict[str, Array]:
        """Return the derivatives of several expressions (SymPy or text) or points at once, by name, each (S, …, k)."""
        given = by_key(outputs, "outputs")
        read = {k: quantity(self._task.model, x, f"'{k}'") if isinstance(x, str) else x for k, x in given.items()}
        asked = {k: x if isinstance(x, Point) else as_expr(x, f"'{k}'") for k, x in read.items()}
        found = observed(self._task, self._columns, self._run, asked)
        return {name: found[f"change of {name}"] for name in asked}

    def verify(self, *, seed: int = 1) -> tuple[Check, ...]:
        """Hold the derivatives of all states against difference quotients of ordinary runs; return the checks.

        All of ``wrt`` are changed together in a random direction by up to a thousandth of their values. Samples that
        an event comes that close to are left out. In a chaotic run over a long time the quotients do not settle; the
        check then says so, and ``holds`` is None.
        """
        check_sampling(1, seed)
        task, columns = self._task, self._columns
        z = values_of(task, columns)
        d = quotients.direction(quotients.units_of(z), seed)
        size = np.ptp(self._run.x, axis=0)
        size = np.where(size > 0, size, 1.0)
        moved = 2 * quotients.WIDTH * np.abs(self._run.delays @ d)
        hits = np.array([h.time for h in self._run.hits])
        kept = np.all(np.abs(self.t[:, None] - hits) > moved, axis=1)

        def states(values: Array) -> Array:
            made = quotients.plain_run(with_values(task, columns, values))
            if made.x.shape != self._run.x.shape:
                raise RunError("an event ends it at another sample", code="E503")
            return (made.x[kept] / size).ravel()

        exact = (self._run.changes[kept] @ d / size).ravel()
        what = "the derivatives of the states equal difference quotients of runs without variational equations"
        check = quotients.held(what, exact, states, z, d)
        verdict = {True: "equal to quotients of runs", False: "NOT equal to quotients of runs", None: ""}[check.holds]
        self._compared = ", ".join(x for x in (verdict, check.figure) if x)
        return (check,)

    def _own_name(self, name: str) -> str | None:
        """Quantities are accessed as entries, not as attributes."""
        task = self.__dict__.get("_task")
        return f'sensitivities["{name}"]' if task is not None and name in task.model.symbols else None

    def _repr_html_(self) -> str:
        from lagrangian.write.views import table_view

        names = self.wrt[:SHOWN]
        words = [f"derivatives at the end, t = {self.t[-1]:g} s; {len(self.t)} samples"]
        words.append(self._compared)
        words += [f"and {len(self.wrt) - len(names)} more columns"] if len(self.wrt) > len(names) else []
        rows = [
            (state, *(f"{x:.6g}" for x in found[-1, : len(names)]))
            for state, found in zip(self._task.states, self.changes, strict=True)
        ]
        return table_view(self._task.model.name, words, ("state", *(f"by {name}" for name in names)), rows)

    def __repr__(self) -> str:
        """Name what was differentiated by what."""
        to = f"{', '.join(self._task.states)} to {', '.join(self.wrt)}, {len(self.t)} samples"
        return f"<Sensitivities of {to}; {self._compared}>"


def sensitivities(run: Recorded, wrt: Any) -> Sensitivities:
    """The sensitivities of a run; see `lagrangian.Trajectory.sensitivities`."""
    task = run.task
    if task is None:
        raise RunError("this run does not know how it was made", fix="take one that simulate returned", code="E501")
    if not run.success:
        raise RunError(
            f"the run failed, so that it has no sensitivities: {run.message}",
            fix="end it before, with a shorter duration",
            code="E501",
        )
    columns = columns_of(task, wrt)
    made = varied_run(task, columns)
    events: dict[str, Any] = {}
    for k, e in enumerate(task.events):
        events[e.title] = made.delays[[i for i, h in enumerate(made.hits) if h.index == k]]
    changes = np.ascontiguousarray(made.changes.transpose(1, 0, 2))
    names = tuple(c.name for c in columns)
    return Sensitivities(made.t, names, changes, Entries(events, "events"), task, columns, made)


def observed(task: Task, columns: Columns, run: VariedRun, asked: Mapping[str, Any]) -> dict[str, Array]:
    """Each quantity and, as ``"change of …"``, its derivatives, at all times of a varied run."""
    feedback = task.drive.feedback
    key = ("varied", dynamics.columns_key(columns), tuple(asked.items()), frozenset(feedback.items()))
    program = task.model.recent(
        "compiled", key, lambda: dynamics.varied_quantities(task.model, columns, feedback, asked), 32
    )
    kernel = program.remembered("kernel", lambda: machine.compile(program))
    x = np.concatenate([run.x, run.changes.transpose(0, 2, 1).reshape(len(run.t), -1)], axis=1)
    answer = kernel(np.ascontiguousarray(x), with_signals(task, columns).drive.at(run.t, run.x), task.p, run.t)
    return answer if isinstance(answer, dict) else {next(iter(program.outputs)): answer}
