"""``system.optimize``: the best parameters, initial values and inputs of a run, by SciPy with exact gradients."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from scipy.optimize import minimize

from lagrangian.advice import Advice, Argument
from lagrangian.errors import RunError, did_you_mean
from lagrangian.model import Model, as_expr
from lagrangian.optimize.objective import FAR, Goal, Objective
from lagrangian.optimize.result import Optimum
from lagrangian.records import dataclass
from lagrangian.simulate.allowance import Allowance, OutOfEvaluationsError, OutOfTimeError
from lagrangian.simulate.guesses import Bounds, by_key, check_inside, guessed, limits, quantity_value
from lagrangian.simulate.inputs import SampledInput
from lagrangian.simulate.integrating import Task
from lagrangian.simulate.quantities import quantity
from lagrangian.simulate.settings import RunSettings, check_names, whole
from lagrangian.simulate.simulation import OPTIONS, named, run_of, simulate
from lagrangian.simulate.unknowns import values_of, with_values
from lagrangian.simulate.varied import Columns, columns_of
from lagrangian.values.dimensions import NONE
from lagrangian.values.values import Given, key_name, number
from lagrangian.viewed import Entries

_log = logging.getLogger(__name__)
Array = NDArray[np.float64]

REACHED = 1e-6
"""Quantities at the end count as reached within this distance in SI units."""

ROUGH = "no step along the slope makes the cost smaller: it may have no lowest value, or jump"

ENDED: tuple[dict[int, str], dict[int, str]] = (
    {0: "the cost no longer changes", 1: "max_evaluations were not enough", 2: ROUGH},
    {
        0: "the cost no longer changes",
        2: "reach has more quantities than there are unknowns",
        **dict.fromkeys((3, 4, 5, 6, 7), "what is to be reached contradicts itself, or no unknown changes it"),
        8: "no step makes the cost smaller and comes closer to what is to be reached",
        9: "max_evaluations were not enough",
    },
)
"""How the search ended, by the status of L-BFGS-B, and of SLSQP with ``reach``."""

ON_BOUND = 1e-9
"""A value counts as on its bound within this fraction of its size."""


@dataclass(frozen=True)
class OptimizeOptions:
    """The arguments of an optimization beside its unknowns; see `lagrangian.System.optimize`."""

    final: Any = None
    integral: Any = None
    reach: Any = None
    bounds: Any = None
    initial: Any = None
    params: Any = None
    inputs: Any = None
    max_evaluations: int = 500
    tolerance: float = 1e-9


def optimize(
    model: Model, unknowns: Any, options: OptimizeOptions, by_name: Mapping[str, Any], run_options: dict[str, Any]
) -> Optimum:
    """Minimize the cost of a run; see `lagrangian.System.optimize`. ``run_options``: duration, method, events, …"""
    check_names(model, by_name, (*OPTIONS, "final", "integral", "reach", "bounds"))
    given = Given.of(model, named(model))
    goal = _goal(model, options, given)
    most = whole(options.max_evaluations, "max_evaluations")
    tolerance = number(options.tolerance, "tolerance", NONE)
    if not 0 < tolerance < 1:
        raise RunError(f"tolerance must be between 0 and 1 (got {tolerance:g})", fix="such as 1e-9", code="E501")
    guesses = guessed(unknowns, "unknowns")
    task, settings = _first_run(model, guesses, given, options, by_name, run_options)
    columns = columns_of(task, list(guesses))
    names = [c.name for c in columns]
    z0 = values_of(task, columns)
    bounds = limits(options.bounds, names, [name.partition("[")[0] for name in names], given)
    check_inside(names, z0, bounds)
    objective = Objective(task, columns, goal)
    first = objective.judged(z0)  # a first guess with which nothing can be computed is an error
    z, success, message = _search(objective, z0, bounds, Allowance(most, run_options["timeout"]), tolerance)
    best = objective.judged(z)
    if goal.reach and np.abs(best.missing).max() > REACHED:
        success, message = (
            False,
            f"what is to be reached is missed by up to {np.abs(best.missing).max():.3g}; {message}",
        )
    size = ON_BOUND * np.maximum(np.abs(z), 1.0)
    bound = (z - bounds[0] <= size) | (bounds[1] - z <= size)
    final = with_values(task, columns, z)
    return Optimum(
        model=model,
        names=tuple(names),
        values=Entries(dict(zip(names, map(float, z), strict=True)), "values"),
        cost=best.cost,
        first_cost=first.cost,
        gradient=best.gradient,
        missing=Entries(dict(zip(goal.reach, map(float, best.missing), strict=True)), "missing"),
        at_bound=tuple(name for name, x in zip(names, bound, strict=True) if x),
        **_given_form(final, columns, z),
        run=run_of(final, settings),
        evaluations=objective.evaluations,
        success=success,
        message=message,
        checks=objective.checks(z, first, _sizes(columns, z0)),
    )


def _goal(model: Model, options: OptimizeOptions, given: Given) -> Goal:
    """What is minimized and what must be reached, as expressions."""

    def read(asked: Any, what: str) -> sp.Expr:
        return as_expr(quantity(model, asked, what) if isinstance(asked, str) else asked, what)

    if options.final is None and options.integral is None:
        raise RunError(
            "nothing is to be minimized",
            fix=Advice(
                "give ",
                Argument("final", "'(x - 1)^2'"),
                ", a cost at the end, or ",
                Argument("integral", "'F^2'"),
                ", a cost along the run",
            ),
            code="E401",
        )
    reach = options.reach or {}
    if not isinstance(reach, Mapping):
        raise RunError(
            f"reach must be a mapping from quantities to their values at the end (got {type(reach).__name__})",
            fix='such as {"theta": 0, "theta\'": 0}',
            code="E501",
        )
    ends = {
        key_name(key): (expr := read(key, "reach"), number(value, f"reach: '{key_name(key)}'", given.dimension(expr)))
        for key, value in reach.items()
    }
    final = None if options.final is None else read(options.final, "final")
    integral = None if options.integral is None else read(options.integral, "integral")
    return Goal(final, integral, ends)


def _first_run(
    model: Model,
    guesses: Mapping[str, Any],
    given: Given,
    options: OptimizeOptions,
    by_name: Mapping[str, Any],
    run_options: dict[str, Any],
) -> tuple[Task, Mapping[str, Any]]:
    """What is integrated with the first guesses. Raises what `System.simulate` raises."""
    known = (*given.parameters.names, *given.states.names, *given.inputs.names)
    initial = given.states.values(options.initial) | given.states.values(by_name)
    params, inputs = by_key(options.params, "params"), by_key(options.inputs, "inputs")
    for name, guess in guesses.items():
        if name not in known:
            fix = did_you_mean(name, known) or f"parameters, states, inputs: {', '.join(known[:16])}"
            raise RunError(f"there is nothing called '{name[:64]}' to optimize", fix=fix, code="E402")
        if guess is None:
            continue
        if name in given.inputs.names:
            inputs[name] = guess
        else:
            group = params if name in given.parameters.names else initial
            group[name] = quantity_value(guess, name, given, f"the first guess of '{name}'")
    settings = RunSettings(**run_options)
    made = simulate(model, settings, initial=initial, params=params or None, inputs=inputs or None, by_name={})
    if not made.success or made.task is None:
        raise RunError(
            f"the run fails with the first guess: {made.message}", fix="give another first guess", code="E501"
        )
    return made.task, made.settings


def _search(
    objective: Objective, z0: Array, bounds: Bounds, allowance: Allowance, tolerance: float
) -> tuple[Array, bool, str]:
    """SciPy's L-BFGS-B, or SLSQP where something must be reached; in units of the first guess and of its cost.

    Where evaluations or time are used up, it returns the last iterate.
    """
    objective.allowance = allowance
    first = objective.judged(z0)
    size = _sizes(objective.columns, z0)
    unit = abs(first.cost) or float(np.linalg.norm(first.gradient * size)) or 1.0

    def cost(y: Array) -> tuple[float, Array]:
        found = objective.tried(y * size)
        if found is None:
            return FAR, np.zeros(len(y))
        return found.cost / unit, found.gradient * size / unit

    tied: list[dict[str, Any]] = []
    if objective.goal.reach:
        far = np.full(len(objective.goal.reach), FAR)
        none = np.zeros((len(far), len(z0)))

        def missing(y: Array) -> Array:
            found = objective.tried(y * size)
            return far if found is None else found.missing

        def slopes(y: Array) -> Array:
            found = objective.tried(y * size)
            return none if found is None else found.slopes * size

        tied.append({"type": "eq", "fun": missing, "jac": slopes})
    limited = list(zip(bounds[0] / size, bounds[1] / size, strict=True))
    small: dict[str, Any] = {"ftol": tolerance}
    most = allowance.total
    small |= {"maxiter": most} if tied else {"maxfun": most, "maxiter": most, "gtol": tolerance}
    iterates = [z0 / size]
    try:
        found = minimize(
            cost,
            z0 / size,
            jac=True,
            method="SLSQP" if tied else "L-BFGS-B",
            bounds=limited,
            constraints=tied,
            options=small,
            callback=lambda y: iterates.append(np.array(y)),
        )
    except (OutOfEvaluationsError, OutOfTimeError) as spent:
        name = "timeout was" if isinstance(spent, OutOfTimeError) else "max_evaluations were"
        return np.ascontiguousarray(iterates[-1] * size), False, f"{name} not enough"
    finally:
        objective.allowance = None
    _log.info("optimize: %d evaluations, %s", objective.evaluations, found.message)
    ended = ENDED[bool(tied)].get(int(found.status), ROUGH)
    return np.ascontiguousarray(found.x * size), bool(found.success), ended


def _sizes(columns: Columns, z0: Array) -> Array:
    """The unit of each unknown: its first guess, for a table its largest value; 1 if that is 0."""
    size = np.abs(z0)
    for at in {c.at for c in columns if c.kind == "knot"}:
        own = [j for j, c in enumerate(columns) if c.kind == "knot" and c.at == at]
        size[own] = size[own].max()
    return np.where(size > 0, size, 1.0)


def _given_form(task: Task, columns: Columns, z: Array) -> dict[str, Any]:
    """The values as `simulate` takes them: params, initial, inputs."""
    params, initial, inputs = dict[str, float](), dict[str, float](), dict[str, Any]()
    for column, value in zip(columns, z, strict=True):
        if column.kind == "p":
            params[column.name] = float(value)
        elif column.kind == "x":
            initial[column.name] = float(value)
        else:
            source = task.drive.sources[column.at]
            name = task.drive.free[column.at].name
            if isinstance(source, SampledInput):
                inputs[name] = (source.times, source.values, "hold" if source.hold else "linear")
            else:
                inputs[name] = float(value)
    kinds = {"params": params, "initial": initial, "inputs": inputs}
    return {name: Entries(found, name) for name, found in kinds.items()}
