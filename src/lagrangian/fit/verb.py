"""``system.fit``: least squares on measured data, by SciPy with the exact derivatives of runs."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import RunError, did_you_mean
from lagrangian.fit.measured import MeasuredRun, measured
from lagrangian.fit.problem import FitProblem, FittedRun
from lagrangian.fit.result import Fit, residuals_of
from lagrangian.fit.search import ENDED, OUT_OF_TIME, search, searched
from lagrangian.fit.uncertainty import Uncertainty, uncertainty
from lagrangian.model import Model
from lagrangian.records import dataclass
from lagrangian.simulate.allowance import Allowance
from lagrangian.simulate.guesses import Bounds, by_key, check_inside, guessed, limits, quantity_value
from lagrangian.simulate.plot import Units
from lagrangian.simulate.settings import RunSettings, check_names, whole
from lagrangian.simulate.simulation import OPTIONS, named, run_of, simulate
from lagrangian.simulate.trajectory import Trajectory
from lagrangian.simulate.unknowns import values_of, with_values
from lagrangian.simulate.varied import columns_of
from lagrangian.values.values import Given, number
from lagrangian.viewed import Entries

_log = logging.getLogger(__name__)
Array = NDArray[np.float64]

ROUNDS = 12
"""How often the standard deviations of several columns are estimated, and the fit repeated with them."""

SETTLED = 1e-4
"""Estimated standard deviations that change by less than this fraction are final."""

LEAST_SIGMA = 1e-12
"""The smallest standard deviation, relative to the range of a column, that is estimated: data without noise."""


@dataclass(frozen=True)
class FitOptions:
    """The arguments of a fit beside data and unknowns; see `lagrangian.System.fit`."""

    initial: Any = None
    params: Any = None
    inputs: Any = None
    sigma: Any = None
    bounds: Any = None
    start: Any = None
    max_evaluations: int = 500


def fit(
    model: Model,
    data: Any,
    parameters: Any,
    options: FitOptions,
    by_name: Mapping[str, Any],
    run_options: dict[str, Any],
) -> Fit:
    """Fit unknowns of a model to data; see `lagrangian.System.fit`. ``run_options``: method, rtol, atol, events, …"""
    check_names(model, by_name, (*OPTIONS, "sigma", "bounds"))
    runs = measured(model, data)
    guesses = guessed(parameters)
    given = Given.of(model, named(model))
    _check_columns(runs, guesses, given)
    most = whole(options.max_evaluations, "max_evaluations")
    fitted, names, owners, z0 = _runs(model, runs, guesses, given, options, by_name, run_options)
    bounds = limits(options.bounds, names, owners, given)
    check_inside(names, z0, bounds)
    problem = FitProblem(model, fitted, names)
    if problem.count < len(names):
        raise RunError(
            f"{problem.count} samples cannot determine {len(names)} unknowns", fix="measure more", code="E501"
        )
    problem.compared(z0)  # a first guess with which nothing can be computed is an error
    sigma, known = _first_sigma(options.sigma, problem, given)
    return _fitted(model, problem, z0, bounds, (sigma, known), Allowance(most, run_options["timeout"]), owners)


def _check_columns(runs: Sequence[MeasuredRun], guesses: Mapping[str, Any], given: Given) -> None:
    """Raise `RunError` for unknowns that are neither parameters nor initial states nor inputs."""
    known = (*given.parameters.names, *given.states.names, *given.inputs.names)
    for name in guesses:
        if name not in known:
            fix = did_you_mean(name, known) or f"parameters, states (their initial values), inputs: {', '.join(known)}"
            raise RunError(f"there is nothing called '{name[:64]}' to fit", fix=fix[:300], code="E402")


def _of_run(given: Any, k: int, count: int, what: str) -> Any:
    """The argument of one run: the k-th of a list with one mapping a run, or the one for all."""
    if not isinstance(given, (list, tuple)) or (given and not isinstance(given[0], Mapping)):
        return given
    if len(given) != count:
        raise RunError(f"{what} has {len(given)} entries for {count} runs", fix="one mapping for each run", code="E501")
    return given[k]


def _runs(
    model: Model,
    data: Sequence[MeasuredRun],
    guesses: Mapping[str, Any],
    given: Given,
    options: FitOptions,
    by_name: Mapping[str, Any],
    run_options: dict[str, Any],
) -> tuple[list[FittedRun], list[str], list[str], Array]:
    """The runs of a fit; the names of the unknowns, what each belongs to, and the first guesses.

    Parameters are the same in all runs; an initial state or an input that is unknown is another one in each.
    """
    count = len(data)
    shared = [name for name in guesses if name in given.parameters.names]
    own = [name for name in guesses if name not in shared]
    names, owners = list(shared), list(shared)
    z0 = np.zeros(len(shared) + len(own) * count)
    fitted: list[FittedRun] = []
    for k, run in enumerate(data):
        values = {name: _guess(guesses[name], name, k, count, given) for name in guesses}
        made = _first_run(model, run, options, (k, count), by_name, run_options, values, given)
        assert made.task is not None
        columns = columns_of(made.task, [*shared, *own])
        if knots := [c for c in columns if c.kind == "knot"]:
            raise RunError(
                f"input '{knots[0].name.partition('[')[0]}' is a table, which a fit does not take as one unknown",
                fix="give it as an expression with parameters, and fit these",
                code="E501",
            )
        places = [*range(len(shared)), *(len(names) + i for i in range(len(own)))]
        names += own if count == 1 else [f"{name}[{k}]" for name in own]
        owners += own
        fitted.append(FittedRun(made.task, columns, np.array(places), run, made.settings))
        z0[places] = values_of(made.task, columns)
    return fitted, names, owners, z0


def _guess(guess: Any, name: str, k: int, count: int, given: Given) -> float | None:
    """The first guess of an unknown in one run; a list has one for each run."""
    if isinstance(guess, (list, tuple)):
        if len(guess) != count or name in given.parameters.names:
            raise RunError(
                f"the first guess of '{name}' has {len(guess)} values for {count} runs",
                fix="one value for a parameter; one, or one a run, for an initial state",
                code="E501",
            )
        guess = guess[k]
    return None if guess is None else quantity_value(guess, name, given, f"the first guess of '{name}'")


def _first_run(
    model: Model,
    run: MeasuredRun,
    options: FitOptions,
    which: tuple[int, int],
    by_name: Mapping[str, Any],
    run_options: dict[str, Any],
    values: Mapping[str, float | None],
    given: Given,
) -> Trajectory:
    """One run with the first guesses, the k-th of several. Raises what `System.simulate` raises."""
    k, count = which
    begin = float(run.t[0]) if options.start is None else given.time_value(options.start, "start")
    if begin > run.t[0]:
        raise RunError(
            f"the run would start at {begin:g} s, after the first sample at {run.t[0]:g} s",
            fix="give an earlier start",
            code="E501",
        )
    guess = {name: x for name, x in values.items() if x is not None}
    states = {name: x for name, x in guess.items() if name in given.states.names}
    params = {name: x for name, x in guess.items() if name in given.parameters.names}
    driven = {name: x for name, x in guess.items() if name in given.inputs.names}
    initial = given.states.values(_of_run(options.initial, k, count, "initial")) | given.states.values(by_name)
    fixed = given.parameters.values(by_key(_of_run(options.params, k, count, "params"), "params"))
    inputs = by_key(_of_run(options.inputs, k, count, "inputs"), "inputs") | driven
    settings = RunSettings(times=run.t, start=begin, **run_options)
    made = simulate(model, settings, initial=initial | states, params=fixed | params, inputs=inputs or None, by_name={})
    if not made.success:
        name = f"run {k}" if count > 1 else "the run"
        raise RunError(
            f"{name} fails with the first guesses: {made.message}", fix="give other first guesses", code="E501"
        )
    if len(made.t) < len(run.t) or made.t[-1] < run.t[-1]:
        raise RunError(
            f"an event ends the run at t = {made.t[-1]:g} s, before the last sample at {run.t[-1]:g} s",
            fix="leave out the samples behind it, or the event",
            code="E501",
        )
    return made


# -- noise ---------------------------------------------------------------------------------------------------------


def _first_sigma(given: Any, problem: FitProblem, dims: Given) -> tuple[Array, bool]:
    """The standard deviation of the noise of each column: given, or as a first guess the range of its values."""
    titles = problem.titles
    known = {c.name: dims.dimension(c.expression) for c in problem.runs[0].data.columns}
    if given is None:
        values = problem.by_column([c.values for run in problem.runs for c in run.data.columns])
        return np.array([float(np.ptp(x)) or float(np.max(np.abs(x))) or 1.0 for x in values]), False
    if not isinstance(given, Mapping):
        given = dict.fromkeys(titles, given)
    found = {
        name: number(value, f"sigma of '{name}'", known.get(name)) for name, value in by_key(given, "sigma").items()
    }
    for name, value in found.items():
        if name not in titles:
            fix = did_you_mean(name, titles) or f"columns: {', '.join(titles)}"
            raise RunError(f"sigma: there is no column '{name[:64]}' in the data", fix=fix, code="E402")
        if value <= 0:
            raise RunError(f"sigma of '{name}' must be above 0 (got {value:g})", code="E501")
    if missing := [name for name in titles if name not in found]:
        raise RunError(
            f"sigma of '{missing[0]}' is missing", fix="give one for every column, or none to estimate all", code="E401"
        )
    return np.array([found[name] for name in titles]), True


def _estimated(problem: FitProblem, away: Sequence[Array], rank: int, least: Array) -> Array:
    """The standard deviation of each column from its residuals, corrected by its share of what was fitted."""
    columns = problem.by_column(away)
    total = sum(len(x) for x in columns)
    share = 1 - rank / total if total > rank else 1.0
    return np.array(
        [max(float(np.sqrt(np.sum(x**2) / (len(x) * share))), m) for x, m in zip(columns, least, strict=True)]
    )


# -- the search ----------------------------------------------------------------------------------------------------


def _fitted(
    model: Model,
    problem: FitProblem,
    z0: Array,
    bounds: Bounds,
    noise: tuple[Array, bool],
    allowance: Allowance,
    owners: Sequence[str],
) -> Fit:
    """The best unknowns; where the noise is not known, columns are weighted by their own residuals."""
    sigma, known = noise
    least = sigma * LEAST_SIGMA
    z, sure = z0, None
    found: Any = None
    for k in range(1 if known else ROUNDS):
        found = (search if k else searched)(problem, z, bounds, sigma, allowance)
        z = found.x
        free = found.active_mask == 0
        sure = uncertainty(problem.slopes(z, sigma), z, problem.names, free)
        _log.info("fit: %d evaluations, cost %g", found.nfev, found.cost)
        if known:
            break
        next_sigma = _estimated(problem, problem.compared(z)[0], sure.rank, least)
        settled = bool(np.all(np.abs(next_sigma - sigma) <= SETTLED * sigma))
        single = len(sigma) == 1  # its weight does not change the minimum
        sigma = next_sigma
        sure = uncertainty(problem.slopes(z, sigma), z, problem.names, free)
        if settled or single or not found.success:
            break
        if allowance.used_up:  # the standard deviations are not final yet
            found.success, found.status = False, OUT_OF_TIME if allowance.over else 0
            break
    assert sure is not None
    return _result(model, problem, z, sigma, known, sure, found, owners)


def _result(
    model: Model,
    problem: FitProblem,
    z: Array,
    sigma: Array,
    known: bool,
    sure: Uncertainty,
    found: Any,
    owners: Sequence[str],
) -> Fit:
    names, width = problem.names, len(problem.titles)
    away, _ = problem.compared(z)
    runs, residuals = [], []
    for k, run in enumerate(problem.runs):
        places = [c.at for c in run.data.columns]
        own = residuals_of(away[k * width : (k + 1) * width], places, len(run.data.t))
        residuals.append(Entries(dict(zip(problem.titles, own, strict=True)), "residuals"))
        runs.append(run_of(with_values(run.task, run.columns, z[run.places]), run.settings))
    bound = found.active_mask != 0
    std = np.where(bound, np.nan, np.sqrt(np.diag(sure.covariance)))
    units, symbols = Units(model), {**model.symbols, **{v.name: v.symbol for v in model.velocities}}
    weighted = np.concatenate([r / s for r, s in zip(away, problem.spread(sigma), strict=True)])
    return Fit(
        model=model,
        names=names,
        estimate=Entries(dict(zip(names, map(float, z), strict=True)), "estimate"),
        std=Entries(dict(zip(names, map(float, std), strict=True)), "std"),
        covariance=sure.covariance,
        sigma=Entries(dict(zip(problem.titles, map(float, sigma), strict=True)), "sigma"),
        known_sigma=known,
        residuals=tuple(residuals),
        undetermined=sure.undetermined,
        at_bound=tuple(name for name, x in zip(names, bound, strict=True) if x),
        runs=tuple(runs),
        chi2=float(weighted @ weighted),
        dof=problem.count - sure.rank,
        evaluations=problem.evaluations,
        success=bool(found.success),
        message=ENDED[int(found.status)],
        units={name: units.of(symbols[owner]) for name, owner in zip(names, owners, strict=True)},
        ranges=Entries(problem.ranges(), "ranges"),
        checks=problem.checks(z, sigma),
    )
