"""Compares the derivatives of a compiled system, and its single steps, with difference quotients and textbook formulas.

    derivatives    ∂a/∂q δq + ∂a/∂v δv + ∂a/∂u δu is the difference quotient of a along a random direction, and ∂a/∂p
                   that by each parameter; of the forces r of inverse dynamics likewise; ∂a/∂Ξ M ∂a/∂Ξ = ∂a/∂Ξ
    pullback       wᵀ ∂a/∂(q, v, u, p), and its own difference quotient for Hessian products
    linearized     A δx + B δu is the difference quotient of ẋ
    step           Runge's and Kutta's formulas with rates by the slow evaluator
    A, B of it     A δx + B δu is the difference quotient of the step
    sensitivities  the variational equations along every column are difference quotients of ẋ

A wrong entry changes the result along a random direction, whichever entry it is.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.errors import Error, RunError
from lagrangian.graph import Program
from lagrangian.model import Model
from lagrangian.page.formula import Check, Name, Text, text
from lagrangian.records import dataclass
from lagrangian.verify.neighbours import BESIDE, Changing, Function, Neighbourhood, quotient, resolved
from lagrangian.verify.on_rows import OnRows
from lagrangian.verify.slopes import POINTS, TOLERANCE, too_long
from lagrangian.verify.states import State, evaluated, relative

Array: TypeAlias = NDArray[np.float64]
Rates: TypeAlias = Callable[[Array, float], Array]
"""x, t → ẋ."""

ROUNDING = 1e-9
"""Two numbers are equal if their difference, relative to the largest term, is at most this."""

STEP = 1e-2
"""The length of a step [s] where nothing changes faster than by 1 a second; shorter elsewhere."""


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


Comparison: TypeAlias = Callable[[Changing, Neighbourhood], float | None]
"""Functions and a place → a relative difference, or None where quotients do not settle."""


def changes(functions: Changing, model: Model, states: Sequence[State]) -> Iterator[Check]:
    """Yield the checks, each at the first few states where it can be made: quotients do not settle across a kink."""
    rhs = dynamics.rhs(model)
    long = too_long(model)
    places = [Neighbourhood(model, state, k) for k, state in enumerate(states)]
    if model.constraints and not long:
        onto = OnRows(model)
        for place in places:
            place.kept_on_rows(functions, onto)
    A, B, M, Xi = Name("A"), Name("B"), Name("M"), Name("Xi")
    derivatives = text("the compiled derivatives of the accelerations, also by parameters, equal difference quotients")
    pulled = text("the compiled ∂a/∂", Xi, " fits ", M, ", and pullback gives weighted sums of the derivatives")
    hessians = text("the compiled hessian_product equals difference quotients of pullback")
    varied = text("the variational equations, which give the sensitivities of runs, equal difference quotients")
    comparisons: list[tuple[Text, float, Comparison]] = [
        (derivatives, TOLERANCE, _derivatives),
        (
            text("the compiled derivatives of the inverse dynamics equal difference quotients"),
            TOLERANCE,
            _inverse_derivatives,
        ),
        (pulled, ROUNDING, _products),
        (hessians, TOLERANCE, _hessian_products),
        (text("the compiled ", A, " and ", B, " of linearized equal difference quotients of ẋ"), TOLERANCE, _linear),
        (
            text("the compiled steps by rk4, midpoint and euler follow the textbook, with slowly evaluated ẋ"),
            ROUNDING,
            partial(_steps, rhs),
        ),
        (
            text("the compiled ", A, " and ", B, " of a step equal difference quotients of the step"),
            TOLERANCE,
            _step_derivatives,
        ),
        (varied, TOLERANCE, _variations),
    ]
    for what, tolerance, compare in comparisons:
        found = _Found()
        if long and not isinstance(compare, partial):  # all but steps
            yield Check(what, None, f"not checked: {long}")
            continue
        for place in places:
            if found.points == POINTS:
                break
            _attempted(found, partial(compare, functions, place))
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


def _derivatives(functions: Changing, place: Neighbourhood) -> float | None:
    """How far the derivatives of a are from a quotient along the direction of a place, and by every parameter."""
    d = functions.derivatives(place.q, place.v, place.u, **place.fixed)
    found = [_off(functions, place, place.forward(functions), (d.a_q, d.a_v, d.a_u), place.a)]
    if place.parameters:
        d = functions.derivatives(place.q, place.v, place.u, wrt=place.parameters, **place.fixed)
        found.append(_off_by_parameters(place, place.forward(functions), d.a_p, place.a))
    return _largest(found)


def _inverse_derivatives(functions: Changing, place: Neighbourhood) -> float | None:
    """How far the derivatives of r are from quotients, and the r and M beside them from those of other functions."""
    wanted = (*dynamics.VARIED, *place.parameters)
    d = functions.derivatives(place.q, place.v, place.u, a=place.a, wrt=wanted, **place.fixed)
    r = functions.inverse(place.q, place.v, place.a, u=place.u, **place.fixed)
    M = functions.mass_matrix(place.q, v=place.v, **place.fixed)
    terms = M * place.a
    found = [
        _off(functions, place, place.inverse(functions), (d.r_q, d.r_v, d.r_u), terms),
        relative(d.r - r, r, terms),
        relative(d.M - M, M),
    ]
    if place.parameters:
        found.append(_off_by_parameters(place, place.inverse(functions), d.r_p, terms))
    return _largest(found)


def _off(functions: Changing, place: Neighbourhood, f: Function, slopes: Sequence[Array], terms: Array) -> float | None:
    """How far slopes by q, v and u are from the quotient of f along the direction of a place."""
    quotient = place.along(functions, f)
    if quotient is None:
        return None
    parts = [slope @ d for slope, d in zip(slopes, (place.dq, place.dv, place.du), strict=True)]
    return relative(sum(parts) - quotient, quotient, *parts, terms, resolved(place, f))


def _off_by_parameters(place: Neighbourhood, f: Function, slopes: Mapping[str, Array], terms: Array) -> float | None:
    """How far slopes by parameters are from quotients of f, column by column, each in units of its parameter."""
    quotients = place.by_parameters(f)
    if quotients is None:
        return None
    found = np.array(list(slopes.values())).T
    unit, least = np.where(place.p != 0, np.abs(place.p), 1.0), resolved(place, f)
    return max(
        relative((x - y) * one, x * one, y * one, terms, least)
        for x, y, one in zip(found.T, quotients.T, unit, strict=True)
    )


def _largest(found: Sequence[float | None]) -> float | None:
    """The largest difference, not-a-number if one is; None if quotients did not settle."""
    known = [x for x in found if x is not None]
    return float(np.max(known)) if len(known) == len(found) else None


def _products(functions: Changing, place: Neighbourhood) -> float:
    """How far pulled-back weights are from weighted derivatives, and ∂a/∂Ξ from an inverse of M."""
    q, v, u, w = place.q, place.v, place.u, place.weights
    d = functions.derivatives(q, v, u, **place.fixed)
    pulled = functions.pullback(q, v, u, w, **place.fixed)
    M = functions.mass_matrix(q, v=v, **place.fixed)
    off = [w @ slope - row for slope, row in ((d.a_q, pulled.q), (d.a_v, pulled.v), (d.a_u, pulled.u))]
    if place.dependent:
        off = [np.atleast_1d(off[0] @ place.dq + off[1] @ place.dv), off[2]]
    found = [
        *(relative(x, d.a_q, d.a_v, d.a_u, place.a) for x in off),
        relative(pulled.a - d.a, d.a),
        relative(d.Minv @ M @ d.Minv - d.Minv, np.abs(d.Minv) @ np.abs(M) @ np.abs(d.Minv)),
    ]
    if place.parameters:
        by_p = functions.derivatives(q, v, u, wrt=place.parameters, **place.fixed)
        pulled = functions.pullback(q, v, u, w, wrt=place.parameters, **place.fixed)
        # −wᵀ M⁻¹ ∂r/∂p, where terms as large as M a cancel in r
        terms = np.abs(w) @ np.abs(d.Minv) @ np.abs(M) @ np.abs(d.a)
        for (name, column), one in zip(by_p.a_p.items(), np.where(place.p != 0, np.abs(place.p), 1.0), strict=True):
            found.append(relative((w @ column - pulled.p[name]) * one, column * one, place.a, terms))
    return float(np.max(found))


def _hessian_products(functions: Changing, place: Neighbourhood) -> float | None:
    """How far Hessian products are from quotients of pulled-back weights along (δq, δv)."""
    if place.dependent:
        raise RunError(BESIDE, code="E503")
    wanted = (*dynamics.VARIED, *place.parameters)
    given = place.q, place.v, place.u, place.weights
    d = functions.hessian_product(*given, place.dq, place.dv, wrt=wanted, **place.fixed)
    moved, found = functions.rates(place.q, place.dq), list[float | None]()
    for wrt in (dynamics.VARIED, place.parameters) if place.parameters else (dynamics.VARIED,):

        def pulled(h: float, wrt: tuple[str, ...] = wrt) -> Array:
            s = np.array([[h], [-h]])
            q, v = place.q + s * moved, place.v + s * place.dv
            return _joined(functions.pullback(q, v, place.u, place.weights, wrt=wrt, **place.fixed), wrt)

        change = quotient(pulled)
        found.append(None if change is None else relative(_joined(d, wrt) - change, change, place.a))
    return _largest(found)


def _joined(pulled: Any, wrt: Sequence[str]) -> Array:
    """All that was pulled back, in one row for each state."""
    if wrt == dynamics.VARIED:
        return np.concatenate([pulled.q, pulled.v, pulled.u], axis=-1)
    return np.stack(list(pulled.p.values()), axis=-1)


def _linear(functions: Changing, place: Neighbourhood) -> float | None:
    """How far A δx + B δu is from a quotient of ẋ.

    δq = N ξ varies along the velocities, so that ξ̇ = N⁺ (δ(N v) − Ṅ ξ); N = 1 without floating frames.
    """
    A, B = functions.linearized(place.q, place.v, place.u, **place.fixed)
    a = place.along(functions, place.forward(functions))
    rate = place.along(functions, lambda q, v, u, p: functions.rates(q, v))
    flow = functions.rates(place.q, place.v)
    turned = quotient(lambda h: functions.rates(place.q + np.array([[h], [-h]]) * flow, place.dq))
    if a is None or rate is None or turned is None:
        return None
    N = functions.rates(place.q, np.eye(len(place.v))).T
    along = np.linalg.lstsq(N, rate - turned, rcond=None)[0]
    parts = A @ np.concatenate([place.dq, place.dv]), B @ place.du
    return relative(sum(parts) - np.concatenate([along, a]), *parts, place.a)


def _variations(functions: Changing, place: Neighbourhood) -> float | None:
    """How far the variational equations of all states, inputs and parameters are from quotients of ẋ."""
    if place.dependent:
        raise RunError(BESIDE, code="E503")
    n, x = len(place.q), np.concatenate([place.q, place.v])
    kinds: dict[Literal["x", "u", "p", "knot"], int] = {"x": len(x), "u": len(place.u), "p": len(place.p)}
    columns = [dynamics.VariedColumn(kind, k, f"{kind}{k}") for kind, count in kinds.items() for k in range(count)]
    rates = place.model.remembered("variations", lambda: dynamics.variational(place.model, columns, {}).rates)
    units = np.array([abs(place.p[c.at]) or 1.0 if c.kind == "p" else 1.0 for c in columns])
    source = random.Random(place.seed)
    changes = np.array([[source.uniform(-1, 1) for _ in x] for _ in columns])
    given = {**place.state, "x": [*x.tolist(), *(changes / units[:, None]).ravel().tolist()]}
    xdot, *slopes = np.array(evaluated(rates, given)["xdot"], float).reshape(1 + len(columns), len(x))

    def rhs(x: Array, u: Array, p: Array) -> Array:
        q, v = x[..., :n], x[..., n:]
        return np.concatenate([functions.rates(q, v), functions.forward(q, v, u=u, p=p, t=place.t)], axis=-1)

    found = [relative(xdot - rhs(x, place.u, place.p), xdot)]
    for column, change, slope, unit in zip(columns, changes, slopes, units, strict=True):
        du, dp = np.zeros_like(place.u), np.zeros_like(place.p)
        if column.kind != "x":
            (du if column.kind == "u" else dp)[column.at] = unit

        def shifted(h: float, dx: Array = change, du: Array = du, dp: Array = dp) -> Array:
            return np.stack([rhs(x + s * dx, place.u + s * du, place.p + s * dp) for s in (h, -h)])

        if (along := quotient(shifted)) is None:
            return None
        found.append(relative(slope * unit - along, along, xdot))
    return float(np.max(found))


def _steps(rhs: Program, functions: Changing, place: Neighbourhood) -> float:
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


def _step_derivatives(functions: Changing, place: Neighbourhood) -> float | None:
    """How far A and B of a step are from a quotient of the step."""
    dt, places = _length(functions, place), len(place.q)
    x1, A, B = functions.step(place.q, place.v, place.u, dt, derivatives=True, **place.fixed)
    quotient = place.along(functions, lambda q, v, u, p: functions.step(q, v, u, dt, p=p, t=place.t))
    if quotient is None:
        return None
    N = functions.rates(x1[:places], np.eye(len(place.v))).T  # q̇ = N v after the step
    along = np.linalg.lstsq(N, quotient[:places], rcond=None)[0]
    parts = A @ np.concatenate([place.dq, place.dv]), B @ place.du
    return relative(sum(parts) - np.concatenate([along, quotient[places:]]), *parts)


def _length(functions: Changing, place: Neighbourhood) -> float:
    """A step in which no state changes by much more than 0.01."""
    a = functions.forward(place.q, place.v, u=place.u, **place.fixed)
    return STEP / (1 + float(np.abs([*a, *place.v]).max(initial=0.0)))


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
