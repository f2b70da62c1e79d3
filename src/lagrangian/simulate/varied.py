"""One run together with its variational equations: what is varied, and the integration of both."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.errors import RunError, did_you_mean
from lagrangian.graph import Output, Program, jacobian, operands, reached
from lagrangian.integrate import METHODS, Events, RunStatus, Solver
from lagrangian.integrate.crossings import Crossings, Hit
from lagrangian.integrate.guards import guards
from lagrangian.integrate.scipy_methods import IMPLICIT, Outcome, integrate_scipy
from lagrangian.model import Model
from lagrangian.model.without_friction import check_no_friction
from lagrangian.records import dataclass
from lagrangian.simulate import resets
from lagrangian.simulate.inputs import SampledInput
from lagrangian.simulate.integrating import SYMPLECTIC, Task, outcome_of, remembered, solver_options
from lagrangian.values.values import key_name

Array = NDArray[np.float64]
Columns = tuple[dynamics.VariedColumn, ...]

IN_ITS_PLACE = "dop853"
"""The method for variational equations where that of the run cannot integrate them."""

MOST = 512
"""The largest number of quantities that are varied together."""


@dataclass(frozen=True, eq=False)
class VariedRun:
    """A run with its changes: states ``x`` (S, nx) at ``t`` (S,), ``changes`` (S, nx, k), and the same of integrals.

    ``hits``: the events, whose states contain the changes; ``delays`` (hits, k): how the time of each changes.
    """

    t: Array
    x: Array
    changes: Array
    integrals: Array
    integral_changes: Array
    hits: Sequence[Hit]
    delays: Array
    outcome: Outcome
    varied: Array


def columns_of(task: Task, wrt: Any) -> Columns:
    """The columns that names or symbols stand for; a table has one for each of its knots, "F[0]", "F[1]", …

    Raises `RunError` for names that are no parameter, initial state or input of the run.
    """
    _check_called(task)
    model, drive = task.model, task.drive
    places = {p.name: ("p", i) for i, p in enumerate(model.parameters)}
    places |= {name: ("x", i) for i, name in enumerate(task.states)}
    places |= {u.name: ("u", i) for i, u in enumerate(drive.free)}
    fed = {u.name for u in model.inputs if u.symbol in drive.feedback}
    found: list[dynamics.VariedColumn] = []
    signals = 0
    for name in _names(wrt, [p.name for p in model.parameters]):
        if name in fed:
            raise RunError(
                f"input '{name}' is an expression of time and state in this run, which is not one number",
                fix="differentiate by the parameters in it",
                code="E501",
            )
        if name not in places:
            fix = did_you_mean(name, places) or f"parameters, states and inputs: {', '.join(list(places)[:16])}"
            raise RunError(f"there is nothing called '{name[:64]}' to differentiate by", fix=fix, code="E402")
        kind, at = places[name]
        source = drive.sources[at] if kind == "u" else None
        if isinstance(source, SampledInput):
            for k in range(len(source.times)):
                found.append(dynamics.VariedColumn("knot", at, f"{name}[{k}]", signals))
                signals += 1
        else:
            found.append(dynamics.VariedColumn(kind, at, name))  # type: ignore[arg-type]
    if len(found) > MOST:
        raise RunError(f"{len(found)} quantities are varied at once; the limit is {MOST}", code="E601")
    return tuple(found)


def _names(wrt: Any, default: Sequence[str]) -> list[str]:
    """What is asked for as names without repetition."""
    if wrt is None:
        listed: list[Any] = list(default)
    else:
        listed = [wrt] if isinstance(wrt, (str, sp.Basic)) else list(wrt) if hasattr(wrt, "__iter__") else [None]
    if not all(isinstance(name, (str, sp.Basic)) for name in listed):
        raise RunError(
            f"wrt must be names or symbols (got {wrt!r:.60})", fix="such as ['m1', \"theta1'\"]", code="E501"
        )
    names = [key_name(name) for name in listed]
    if not names:
        raise RunError("wrt names nothing to differentiate by", fix="give parameters or states", code="E401")
    for k, name in enumerate(names):
        if name in names[:k]:
            raise RunError(f"'{name}' is given twice in wrt", fix="name it once", code="E404")
    return names


def check_differentiable(model: Model, task: Task) -> None:
    """Raise an error for runs whose states have no derivatives that could be known."""
    check_no_friction(model, "there are no sensitivities")
    if model.constraints:
        raise RunError(
            f"system '{model.name}' has constraints, which tie initial values and parameters to each other: there are "
            "no sensitivities of its runs",
            fix="describe it in independent coordinates, without constraints",
            code="E501",
        )
    _check_called(task)


def _check_called(task: Task) -> None:
    """Raise an error for an input whose derivatives are not known."""
    if task.drive.calls_python:
        called = [u.name for u, s in zip(task.drive.free, task.drive.sources, strict=True) if callable(s)]
        raise RunError(
            f"input '{called[0]}' is a Python function, whose derivatives are not known",
            fix="give it as an expression or a table",
            code="E501",
        )


def _check_smooth(program: Program, columns: Columns, model: Model) -> None:
    """Raise an error where f may jump at a place that depends on the state or on what is varied."""
    g, nodes = program.graph, program.graph.nodes
    varied = {("p", c.at) for c in columns if c.kind == "p"} | {("u", c.at) for c in columns if c.kind in ("u", "knot")}
    guarding, conditions = guards(program)
    active: dict[int, bool] = {}
    for i in reached(g, program.ids):
        node = nodes[i]
        if node[0] == "input":
            active[i] = node[1] == "x" or (node[1], node[2]) in varied
            continue
        active[i] = any(active[k] for k in operands(node))
        if i in guarding or i in conditions:
            continue
        jumps = node[0] == "sign" and active[node[1]]
        if jumps or (node[0] == "select" and nodes[node[1]][0] != "eq" and active[node[1]]):
            said = "sign" if jumps else "piecewise"
            raise RunError(
                f"the accelerations of system '{model.name}' contain {said} of something that is varied: where they "
                "jump, the variational equations do not hold",
                fix="write it with min, max, abs or tanh, which do not jump; or a jump as an event with a reset",
                code="E525",
            )


def _check_events(task: Task) -> None:
    """Raise an error for an event whose rate is not known, because a table is in it."""
    if task.drive.constant:
        return
    tables = [u for u, s in zip(task.drive.free, task.drive.sources, strict=True) if isinstance(s, SampledInput)]
    for event in task.events:
        asked = [task.model.expand(x) for x in (event.expression, *event.reset.values())]
        for u in tables:
            if any(x.has(u.symbol) for x in asked):
                raise RunError(
                    f"event '{event.title}' depends on input '{u.name}', a table, whose rate is not known",
                    fix="give the input as an expression of time",
                    code="E501",
                )


def programs_of(task: Task, columns: Columns, integrals: Sequence[sp.Expr]) -> dynamics.VariedPrograms:
    """The variational equations of a run, checked; they are remembered with the model."""
    events = tuple((e.expression, frozenset(e.reset.items())) for e in task.events)
    feedback = task.drive.feedback
    key = ("variational", dynamics.columns_key(columns), frozenset(feedback.items()), events, tuple(integrals))

    def make() -> dynamics.VariedPrograms:
        made = dynamics.variational(task.model, columns, feedback, task.impacts, integrals)
        _check_smooth(made.base, columns, task.model)
        return made

    made = remembered(task.model, key, make)
    _check_events(task)
    return made


def varied_run(task: Task, columns: Columns, integrals: Sequence[sp.Expr] = ()) -> VariedRun:
    """Integrate a run with its variational equations, by the method and to the tolerances of the run.

    The method is `IN_ITS_PLACE` for taylor, gauss4 and SciPy's explicit methods.
    """
    check_differentiable(task.model, task)
    programs = programs_of(task, columns, integrals)
    n, size, k = task.size, programs.size, len(columns)
    wide = with_signals(task, columns)
    x0 = np.zeros(size * (1 + k))
    x0[:n] = task.x0[:n]
    for j, column in enumerate(columns):
        if column.kind == "x":
            x0[size * (1 + j) + column.at] = 1.0
    wide = replace(wide, x0=x0)
    outcome = _integrated(wide, programs, _absolute(task, columns, size))
    times, states = outcome.times, outcome.states
    if outcome.status != RunStatus.REACHED and outcome.reached > times[-1]:
        times, states = np.append(times, outcome.reached), np.vstack([states, outcome.final])
    _check_ended(outcome)
    changes = states[:, size:].reshape(len(times), k, size).transpose(0, 2, 1)
    return VariedRun(
        times,
        states[:, :n],
        changes[:, :n],
        states[:, n:size],
        changes[:, n:],
        outcome.hits,
        _delays(wide, programs, outcome.hits, k),
        outcome,
        states,
    )


def _check_ended(outcome: Outcome) -> None:
    """Raise `RunError` if the variational equations could not be integrated to the end."""
    if outcome.status >= 0:
        return
    raise RunError(
        f"the sensitivities could not be integrated beyond t = {outcome.reached:.6g} s: "
        f"{outcome.reason or outcome.status.message}",
        fix="an event that is only touched, or a motion that fails there, has no derivative: end the run before",
        code="E503",
    )


def with_signals(task: Task, columns: Columns) -> Task:
    """The run with a further input for each knot that is varied: 1 there, and 0 at the other knots."""
    drive = task.drive
    free, sources = list(drive.free), list(drive.sources)
    for column in columns:
        if column.kind != "knot":
            continue
        table = drive.sources[column.at]
        assert isinstance(table, SampledInput)
        first = next(c.signal for c in columns if c.kind == "knot" and c.at == column.at)
        hat = np.zeros(len(table.times))
        hat[column.signal - first] = 1.0
        free.append(drive.free[column.at])
        sources.append(SampledInput(table.times, hat, table.hold))
    return replace(task, drive=replace(drive, free=tuple(free), sources=tuple(sources)))


def _absolute(task: Task, columns: Columns, size: int) -> Array:
    """The absolute tolerance of every entry: that of the run, divided by the size of what is varied."""
    found = np.full(size * (1 + len(columns)), task.atol)
    for j, column in enumerate(columns):
        scale = abs(float(task.p[column.at])) if column.kind == "p" else 1.0
        found[size * (1 + j) : size * (2 + j)] = task.atol / (scale or 1.0)
    return found


def _integrated(task: Task, programs: dynamics.VariedPrograms, atol: Array) -> Outcome:
    """The outcome of the variational equations, whose states are those of their programs."""
    if len(task.times) == 1:
        return Outcome(task.times, task.x0[np.newaxis], RunStatus.REACHED, float(task.times[0]), task.x0)
    return _by_scipy(task, programs, atol) if task.method in IMPLICIT else _by_machine(task, programs, atol)


def _by_machine(task: Task, programs: dynamics.VariedPrograms, atol: Array) -> Outcome:
    known = METHODS.get(task.method)
    method = IN_ITS_PLACE if known is None or known.expands or task.method in SYMPLECTIC else task.method
    events = None
    if programs.events is not None:
        events = Events(
            programs.events,
            tuple(e.direction for e in task.events),
            tuple(e.terminal for e in task.events),
            tuple(bool(e.reset) for e in task.events),
        )
    watched = tuple((e.direction, e.terminal) for e in task.events)
    solver: Solver = programs.rates.remembered(
        ("solver", method, watched), lambda: Solver(programs.rates, method, events=events, threads=1)
    )
    options = {**solver_options(task), "atol": atol}
    if METHODS[method].adaptive:
        options["step"] = None
    found = solver.solve(task.x0, task.times, **options)
    marked = replace(task, events=tuple(replace(e, reset={}) for e in task.events))  # resets are in the program
    return outcome_of(marked, found)


def _by_scipy(task: Task, programs: dynamics.VariedPrograms, atol: Array) -> Outcome:
    rates = programs.rates
    g, n = rates.graph, len(rates.inputs["x"])

    def slopes() -> machine.Kernel:
        entries = jacobian(g, rates.outputs["xdot"].ids, [g.input("x", i) for i in range(n)])
        ids = tuple(entries.get((i, k), g.zero) for i in range(n) for k in range(n))
        outputs = {"J": Output(ids, (n, n))}
        return machine.compile(replace(rates, name="jacobian", outputs=outputs))

    crossings = None
    if programs.events is not None:
        crossings = Crossings(
            resets.valued(rates.remembered("events", lambda: machine.compile(programs.events))),  # type: ignore[arg-type]
            programs.events,
            task.p,
            [e.direction for e in task.events],
            [e.terminal for e in task.events],
            [bool(e.reset) for e in task.events],
        )
    return integrate_scipy(
        task.method,
        rates.remembered("kernel", lambda: machine.compile(rates)),
        task.x0,
        task.times,
        task.drive.legs(float(task.times[0]), float(task.times[-1])),
        task.p,
        jacobian=rates.remembered("slopes", slopes),
        crossings=crossings,
        rtol=task.rtol,
        atol=atol,
        over_run=task.over_run,
        bounds=task.bounds,
    )


def _delays(task: Task, programs: dynamics.VariedPrograms, hits: Sequence[Hit], count: int) -> Array:
    """How the time of each event changes, (hits, columns)."""
    if programs.times is None or not hits:
        return np.zeros((0, count))
    times = programs.times
    kernel = times.remembered("kernel", lambda: machine.compile(times))
    at = np.array([h.time for h in hits])
    before = np.array([h.before for h in hits])
    found = kernel(before, task.drive.at(at, before), task.p, at)
    return np.array([found[i, h.index] for i, h in enumerate(hits)])
