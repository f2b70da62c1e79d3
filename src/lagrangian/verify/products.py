"""What people take away from a system, held against other routes: compiled functions, their exports, linearizations.

Every compiled function is compared with the slow evaluation of its own program (`graph.evaluate`), state by state and
in one batch, and then with routes that share nothing with it:

    forward        Lagrange's equations, differentiated on the graph from L, vanish at its accelerations;
                   M q̈ = −bias
    inverse        Lagrange's equations at any accelerations;  M a + bias
    mass_matrix    the Hessian of T* in the velocities
    rhs            the rates of the coordinates, and forward

Derivatives and single steps are compared in `verify.changes`, the linearization in `verify.slopes`.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol, TypeAlias

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.derive.sample import without_value
from lagrangian.errors import Error
from lagrangian.graph import Graph, Output, Program, hessian
from lagrangian.model import Model
from lagrangian.page.formula import Check, Name, Text, text
from lagrangian.records import dataclass, field
from lagrangian.verify.changes import changes
from lagrangian.verify.drawn import drawn_checks
from lagrangian.verify.exports import Sources, exported
from lagrangian.verify.foreign.checks import foreign_checks, not_run
from lagrangian.verify.live_pages import live_page_checks
from lagrangian.verify.neighbours import Changing, depends
from lagrangian.verify.on_rows import OnRows
from lagrangian.verify.recorded_runs import recorded_runs
from lagrangian.verify.slopes import slopes
from lagrangian.verify.states import Expected, State, cancelling, evaluated, random_states, relative
from lagrangian.verify.swept import swept_runs

_log = logging.getLogger(__name__)
TOLERANCE = 1e-9
"""Two numbers are equal if their difference, relative to the largest term, is at most this: no more than rounding."""

ONE_BY_ONE = 3
"""The number of states at which functions are also called one state at a time; all others are evaluated in one
batch."""

Array: TypeAlias = NDArray[np.float64]


Function: TypeAlias = Callable[..., Array]


class Functions(Changing, Protocol):
    """The compiled functions of a system, as `lagrangian.Compiled` provides them."""

    @property
    def inverse(self) -> Function: ...  # noqa: D102
    @property
    def bias(self) -> Function: ...  # noqa: D102
    @property
    def potential_force(self) -> Function: ...  # noqa: D102
    @property
    def coriolis_matrix(self) -> Function: ...  # noqa: D102
    @property
    def energies(self) -> Callable[..., tuple[Array, Array]]: ...  # noqa: D102
    @property
    def rhs(self) -> Function: ...  # noqa: D102
    @property
    def program(self) -> Callable[[str], Program]: ...  # noqa: D102
    @property
    def exported(self) -> tuple[str, ...]: ...  # noqa: D102
    @property
    def quadratic(self) -> bool: ...  # noqa: D102


@dataclass
class Worst:
    """The largest relative difference of each comparison by name; NaN is the worst and stays."""

    figures: dict[str, float] = field(default_factory=dict)

    def note(self, name: str, difference: Array, *terms: Array) -> None:
        """Record a difference, relative to the largest of ``terms``."""
        self.figures[name] = float(np.maximum(self.figures.get(name, 0.0), relative(difference, *terms)))


def verify_products(
    model: Model, functions: Functions, sources: Sources, *, states: int = 50, seed: int = 1, exports: bool = False
) -> tuple[Check, ...]:
    """Return the checks of every compiled function, of the exported source and of the linearization.

    ``exports``: exports to other programs are run in them, and a run and its files, a sweep's store, the picture, an
    animation and the page that moves are compared. Parameters keep their values. If a check cannot be made on this
    machine, ``holds`` is None and the figure says why. Raises `ModelError` if no random state has finite accelerations.
    """
    found = list(random_states(model, dynamics.forward(model), states, seed))
    if model.constraints and not (found := _on_rows(model, found)):
        what = text("every compiled function, where the constraints hold")
        return (Check(what, None, "not checked: no random position could be moved to where the constraints hold"),)
    expected = Expected(functions.program)
    _log.info("verifying: the compiled functions")
    try:
        compiled = _compiled(model, functions, expected, found)
    except Error as error:  # a compiled function refused a state at which its formulas are finite
        culprit = without_value(model, values=True)
        why = (
            f"{culprit.title} has no finite real value with the values that parameters have" if culprit else str(error)
        )
        return (Check(text("every compiled function can be evaluated"), False, why),)
    _log.info("verifying: the exported sources and the linearization")
    written = exported({name: functions.program(name) for name in functions.exported}, sources, expected, found)
    if exports:
        written += (*foreign_checks(model, found), *not_run(), *recorded_runs(model, functions, found[0]))
        _log.info("verifying: the picture and the page that moves")
        written += (swept_runs(model, found[0]), *drawn_checks(model, found), *live_page_checks(model, found))
    _log.info("verifying: the derivatives and the steps")
    dependent = bool(model.constraints) and any(depends(functions, state) for state in found)
    linear = slopes(model, functions.rhs, found, OnRows(model).of if dependent else None)
    return (*compiled, *written, *linear, *changes(functions, model, found))


def _on_rows(model: Model, states: Sequence[State]) -> list[State]:
    """The states moved onto the rows of the constraints, those that can be."""
    rows = OnRows(model)
    return [moved for state in states if (moved := rows.of(state)) is not None]


def _compiled(model: Model, functions: Functions, expected: Expected, states: Sequence[State]) -> list[Check]:
    """Compare the compiled functions with the slow evaluator and with each other."""
    worst, routes = Worst(), _Routes(model)
    batch = _calls(functions, _stacked(states))
    for k, state in enumerate(states):
        answers = {name: answer[k] for name, answer in batch.items()}
        _against_formulas(expected, state, answers, worst)
        if k < ONE_BY_ONE:
            for name, answer in _calls(functions, {group: np.array(x) for group, x in state.items()}).items():
                terms = cancelling(name, state, answers["mass_matrix"])
                worst.note("formulas", answer - answers[name], answers[name], terms)
        routes.hold(state, answers, worst)
    n = f"{len(states)} random state{'s' if len(states) != 1 else ''}"
    figures = worst.figures
    M, T, V = Name("M"), Name("T*"), Name("V")
    right = (Name("A"), "ᵀ", Name("lambda")) if model.constraints else ("0",)
    described: list[tuple[str, Text]] = [
        ("formulas", text("every compiled function equals the slow evaluation of its formulas, singly and in batches")),
        ("forward", text("the compiled accelerations solve Lagrange's equations")),
        ("rows", text("the compiled accelerations keep the rows of the constraints")),
        ("solved", text("the compiled ", M, ", accelerations a and bias satisfy ", M, " a + bias = ", *right)),
        ("inverse", text("the compiled inverse dynamics equals Lagrange's equations, and ", M, " a + bias")),
        ("hessian", text("the compiled ", M, " is the Hessian of ", T, " in the rates")),
        ("energies", text("the compiled energies are the sums of ", T, " and ", V, " over the elements")),
        ("rhs", text("the compiled right-hand side consists of q̇ and the compiled accelerations")),
    ]
    return [
        Check(what, figures[name] < TOLERANCE, f"largest relative difference {figures[name]:.1e} at {n}")
        for name, what in described
        if name in figures
    ]


def _stacked(states: Sequence[State]) -> dict[str, Array]:
    return {group: np.array([state[group] for state in states]) for group in states[0]}


def _calls(functions: Functions, at: Mapping[str, Array]) -> dict[str, Array]:
    """The results of all compiled functions at one state or at many."""
    q, v, a, u, p, t = (at[group] for group in ("q", "v", "a", "u", "p", "t"))
    t = t[..., 0]
    T, V = functions.energies(q, v, u=u, p=p, t=t)
    found = {
        "forward": functions.forward(q, v, u=u, p=p, t=t),
        "inverse": functions.inverse(q, v, a, u=u, p=p, t=t),
        "mass_matrix": functions.mass_matrix(q, p=p, t=t, v=v),
        "bias": functions.bias(q, v, u=u, p=p, t=t),
        "potential_force": functions.potential_force(q, u=u, p=p, t=t),
        "rates": functions.rates(q, v),
        "rhs": functions.rhs(t, np.concatenate([q, v], axis=-1), u=u, p=p),
        "T": np.asarray(T),
        "V": np.asarray(V),
    }
    if functions.quadratic:
        found["coriolis"] = functions.coriolis_matrix(q, v, p=p, t=t)
    return found


def _against_formulas(expected: Expected, state: State, answers: Mapping[str, Array], worst: Worst) -> None:
    """Compare every result with the slow evaluation of its own program."""
    for name, answer in answers.items():
        if name in ("T", "V"):
            found: Any = expected.at("energy", state)[name]
        else:
            (found,) = expected.at(name, state).values()
        slow = np.array(found, float)
        worst.note("formulas", answer - slow, slow, cancelling(name, state, answers["mass_matrix"]))


class _Routes:
    """Routes to the same numbers that share nothing with the compiled elimination."""

    def __init__(self, model: Model) -> None:
        self._lagrange = dynamics.inverse_from_lagrangian(model)
        self._hessian = _hessian_of_kinetic(model)
        self._rows = (dynamics.constraint_matrix(model), dynamics.multipliers(model)) if model.constraints else None
        self._energies = None if model.floating else _energies_of_elements(model)

    def hold(self, state: State, answers: Mapping[str, Array], worst: Worst) -> None:
        """Compare the results at a state with every route."""
        a, forward = np.array(state["a"]), answers["forward"]
        M, bias = answers["mass_matrix"], answers["bias"]
        terms = cancelling("inverse", state, M), bias
        push = self._constrained(state, forward, worst)
        worst.note("forward", self._residual({**state, "a": forward.tolist()}) - push, M * forward, *terms)
        worst.note("solved", M @ forward + bias - push, M * forward, *terms)
        for expected in (self._residual(state), M @ a + bias):
            worst.note("inverse", answers["inverse"] - expected, *terms)
        worst.note("hessian", M - np.array(evaluated(self._hessian, state)["H"], float), M)
        if self._energies is not None:
            found = evaluated(self._energies, {**state, "x": [*state["q"], *state["v"]]})
            T, V = (np.array(found[name], float) for name in ("T", "V"))
            worst.note("energies", np.array([answers["T"] - T, answers["V"] - V]), T, V)
        rhs = np.concatenate([answers["rates"], forward])
        worst.note("rhs", answers["rhs"] - rhs, rhs)

    def _constrained(self, state: State, forward: Array, worst: Worst) -> Array:
        """Aᵀ λ, once the accelerations were found to keep the rows: A v̇ + γ = 0; 0 without constraints."""
        if self._rows is None:
            return np.zeros(len(forward))
        found, lam = (evaluated(program, state) for program in self._rows)
        A, gamma = np.array(found["A"], float).reshape(-1, len(forward)), np.array(found["gamma"], float)
        worst.note("rows", A @ forward + gamma, A * forward, gamma, A)
        return A.T @ np.array(lam["lam"], float)

    def _residual(self, state: State) -> Array:
        return np.array(evaluated(self._lagrange, state)["r"], float)


def _hessian_of_kinetic(model: Model) -> Program:
    """∂²T*/∂v_i∂v_k, shape (n, n), of T* as a sum over bodies, differentiated by the rates themselves."""
    graph = Graph()
    inputs = dynamics.Inputs.of(graph, model)
    T, n = dynamics.describe(model, graph, inputs).kinetic(), len(inputs.v)
    entries = hessian(graph, T, inputs.v)
    ids = tuple(entries.get((i, k), graph.zero) for i in range(n) for k in range(n))
    return Program("hessian", graph, dynamics.energy(model).inputs, {"H": Output(ids, (n, n))})


def _energies_of_elements(model: Model) -> Program:
    """T* and V as the elements define them for the derivation, not as they are combined for the machine."""
    T = sp.Add(*(e.kinetic(model) for e in model.elements))
    V = sp.Add(*(e.potential(model) for e in model.elements))
    return dynamics.observe(model, {"T": T, "V": V})
