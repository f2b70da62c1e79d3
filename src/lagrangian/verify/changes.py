"""Compares the derivatives of a compiled system, and its single steps, with difference quotients and textbook formulas.

    derivatives    ∂a/∂q δq + ∂a/∂v δv + ∂a/∂u δu is the difference quotient of a along a random direction;
                   ∂a/∂Ξ M ∂a/∂Ξ = ∂a/∂Ξ
    pullback       wᵀ ∂a/∂(q, v, u)
    step           Runge's and Kutta's formulas with rates by the slow evaluator
    A, B of it     A δx + B δu is the difference quotient of the step

A wrong entry changes the result along a random direction, whichever entry it is.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import Error
from lagrangian.graph import Program, reached
from lagrangian.page.formula import Check, Name, Text, text
from lagrangian.verify.slopes import POINTS, SETTLED, TOLERANCE, WIDTH, extrapolated
from lagrangian.verify.states import State, evaluated, relative

Array: TypeAlias = NDArray[np.float64]
Rates: TypeAlias = Callable[[Array, float], Array]
"""x, t → ẋ."""

ROUNDING = 1e-9
"""Two numbers are equal if their difference, relative to the largest term, is at most this."""

MOST_NODES = 4000
"""The largest right-hand side, in nodes of its graph, whose derivatives are compiled here: they have several times as
many, and compiling them would take most of the time of a verification."""

STEP = 1e-2
"""The length of a step [s] where nothing changes faster than by 1 a second; shorter elsewhere."""


class Changing(Protocol):
    """The functions of `lagrangian.Compiled` that are compared."""

    @property
    def forward(self) -> Callable[..., Array]: ...  # noqa: D102
    @property
    def mass_matrix(self) -> Callable[..., Array]: ...  # noqa: D102
    @property
    def rates(self) -> Callable[..., Array]: ...  # noqa: D102
    @property
    def derivatives(self) -> Callable[..., Any]: ...  # noqa: D102
    @property
    def pullback(self) -> Callable[..., Any]: ...  # noqa: D102
    @property
    def step(self) -> Callable[..., Any]: ...  # noqa: D102


@dataclass
class _Found:
    """The largest relative difference of one comparison, at how many states, and why others were left out."""

    worst: float = 0.0
    points: int = 0
    refused: str = ""

    def note(self, *differences: float) -> None:
        self.points += 1
        self.worst = float(np.max([self.worst, *differences]))

    def check(self, what: Any, tolerance: float) -> Check:
        if not self.points:
            return Check(what, None, f"not checked at any random state: {self.refused}")
        at = f"{self.points} random state{'s' if self.points != 1 else ''}"
        return Check(what, self.worst < tolerance, f"largest relative difference {self.worst:.1e} at {at}")


@dataclass
class _Place:
    """A state, and a random direction from it: δq along the velocities, δv, δu."""

    state: State
    seed: int
    q: Array = field(init=False)
    v: Array = field(init=False)
    u: Array = field(init=False)

    def __post_init__(self) -> None:
        self.q, self.v, self.u = (np.array(self.state[group], float) for group in ("q", "v", "u"))
        source = random.Random(self.seed)
        self.dq, self.dv, self.weights = (np.array([source.uniform(-1, 1) for _ in self.v]) for _ in range(3))
        self.du = np.array([source.uniform(-1, 1) for _ in self.u])
        self.size = np.array(self.state["a"])  # of terms that may cancel to rounding
        self.fixed = {"p": np.array(self.state["p"], float), "t": self.state["t"][0]}


Comparison: TypeAlias = Callable[[Changing, _Place], float | None]
"""Functions and a place → a relative difference, or None where quotients do not settle."""


def changes(functions: Changing, rhs: Program, states: Sequence[State]) -> Iterator[Check]:
    """Yield the checks, each at the first few states where it can be made: quotients do not settle across a kink."""
    A, B, M, Xi = Name("A"), Name("B"), Name("M"), Name("Xi")
    comparisons: list[tuple[Text, float, Comparison]] = [
        (text("the compiled derivatives of the accelerations equal difference quotients"), TOLERANCE, _derivatives),
        (text("those by ", Xi, " fit ", M, ", and those pulled back are weighted sums of them"), ROUNDING, _products),
        (text("compiled steps by rk4, midpoint and euler are those of these rates"), ROUNDING, partial(_steps, rhs)),
        (text("the ", A, " and ", B, " of a step equal its difference quotients"), TOLERANCE, _step_derivatives),
    ]
    nodes = len(reached(rhs.graph, rhs.ids))
    for what, tolerance, compare in comparisons:
        found = _Found()
        if nodes > MOST_NODES and not isinstance(compare, partial):  # all but steps
            long = f"the accelerations have {nodes} nodes, and derivatives of more than {MOST_NODES} take long"
            yield Check(what, None, f"not checked: {long}")
            continue
        for k, state in enumerate(states):
            if found.points == POINTS:
                break
            _attempted(found, partial(compare, functions, _Place(state, k)))
        yield found.check(what, tolerance)


def _attempted(found: _Found, compare: Callable[[], float | None]) -> None:
    """Note a difference; a state at which nothing can be computed, or no quotient settles, is left out."""
    try:
        difference = compare()
    except Error as error:
        found.refused = found.refused or error.what
        return
    if difference is None:
        found.refused = found.refused or "the difference quotients do not settle"
    else:
        found.note(difference)


def _derivatives(functions: Changing, place: _Place) -> float | None:
    """How far the derivatives of a are from a quotient along the direction of a place."""
    d = functions.derivatives(place.q, place.v, place.u, **place.fixed)
    quotient = _quotient(functions, place, lambda q, v, u: functions.forward(q, v, u=u, **place.fixed))
    if quotient is None:
        return None
    parts = d.a_q @ place.dq, d.a_v @ place.dv, d.a_u @ place.du
    return relative(sum(parts) - quotient, quotient, *parts, place.size)


def _products(functions: Changing, place: _Place) -> float:
    """How far pulled-back weights are from weighted derivatives, and ∂a/∂Ξ from an inverse of M."""
    q, v, u = place.q, place.v, place.u
    d = functions.derivatives(q, v, u, **place.fixed)
    pulled = functions.pullback(q, v, u, place.weights, **place.fixed)
    M = functions.mass_matrix(q, v=v, **place.fixed)
    return max(
        relative(place.weights @ d.a_q - pulled.q, d.a_q, place.size),
        relative(place.weights @ d.a_v - pulled.v, d.a_v, place.size),
        relative(place.weights @ d.a_u - pulled.u, d.a_u, place.size),
        relative(d.Minv @ M @ d.Minv - d.Minv, np.abs(d.Minv) @ np.abs(M) @ np.abs(d.Minv)),
    )


def _steps(rhs: Program, functions: Changing, place: _Place) -> float:
    """How far steps are from the textbook's formulas, with the slow evaluator's rates."""

    def rates(x: Array, t: float) -> Array:
        return np.array(evaluated(rhs, {**place.state, "x": x.tolist(), "t": [t]})["xdot"], float)

    x, t, dt = np.concatenate([place.q, place.v]), place.fixed["t"], _length(functions, place)
    worst = 0.0
    for method, formula in FORMULAS.items():
        expected = formula(rates, x, t, dt)
        found = functions.step(place.q, place.v, place.u, dt, method=method, **place.fixed)
        worst = float(np.maximum(worst, relative(found - expected, expected, x)))
    return worst


def _step_derivatives(functions: Changing, place: _Place) -> float | None:
    """How far A and B of a step are from a quotient of the step."""
    dt, places = _length(functions, place), len(place.q)
    x1, A, B = functions.step(place.q, place.v, place.u, dt, derivatives=True, **place.fixed)
    quotient = _quotient(functions, place, lambda q, v, u: functions.step(q, v, u, dt, **place.fixed))
    if quotient is None:
        return None
    N = functions.rates(x1[:places], np.eye(len(place.v))).T  # q̇ = N v after the step
    along = np.linalg.lstsq(N, quotient[:places], rcond=None)[0]
    parts = A @ np.concatenate([place.dq, place.dv]), B @ place.du
    return relative(sum(parts) - np.concatenate([along, quotient[places:]]), *parts)


def _length(functions: Changing, place: _Place) -> float:
    """A step in which no state changes by much more than 0.01."""
    a = functions.forward(place.q, place.v, u=place.u, **place.fixed)
    return STEP / (1 + float(np.abs([*a, *place.v]).max(initial=0.0)))


def _quotient(functions: Changing, place: _Place, f: Callable[[Array, Array, Array], Array]) -> Array | None:
    """The derivative of f(q, v, u) along the direction of a place; None where quotients do not settle."""
    along = functions.rates(place.q, place.dq)
    levels = []
    for k in range(3):
        h = WIDTH / 2**k
        signs = np.array([[h], [-h]])
        values = f(place.q + signs * along, place.v + signs * place.dv, place.u + signs * place.du)
        levels.append((values[0] - values[1]) / (2 * h))
    found, doubt = extrapolated(levels)
    return found if doubt <= SETTLED * (float(np.abs(found).max(initial=0.0)) or 1.0) else None


def _euler(f: Rates, x: Array, t: float, h: float) -> Array:
    """x + h f(x, t)."""
    return x + h * f(x, t)


def _midpoint(f: Rates, x: Array, t: float, h: float) -> Array:
    """x + h f(x + h/2 f(x, t), t + h/2)."""
    return x + h * f(x + h / 2 * f(x, t), t + h / 2)


def _rk4(f: Rates, x: Array, t: float, h: float) -> Array:
    """x + h (k₁ + 2 k₂ + 2 k₃ + k₄)/6; Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.1."""
    k1 = f(x, t)
    k2 = f(x + h / 2 * k1, t + h / 2)
    k3 = f(x + h / 2 * k2, t + h / 2)
    k4 = f(x + h * k3, t + h)
    return x + h * (k1 + 2 * k2 + 2 * k3 + k4) / 6


FORMULAS = {"euler": _euler, "midpoint": _midpoint, "rk4": _rk4}
"""The methods of a step, as textbooks write them."""
