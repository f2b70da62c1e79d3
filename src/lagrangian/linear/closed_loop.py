"""Compares a regulator with other routes: Riccati's equation, Lyapunov's, and the compiled-in law itself.

Riccati       Aᵀ S + S A − S B R⁻¹ Bᵀ S + Q = 0
Lyapunov      (A − B K)ᵀ P + P (A − B K) + Q + Kᵀ R K = 0 has the solution P = S, by the method of Bartels and Stewart:
              S is what the loop costs, and δxᵀ S δx falls along every motion
poles         those of A − B K lie on the left
law           ẋ of the nonlinear system with the law as its input has the slope A − B K, by difference quotients
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.graph import evaluate
from lagrangian.linear.linear_model import LinearModel
from lagrangian.page.figures import complex_figure
from lagrangian.page.formula import Check, Name, text

Array = NDArray[np.float64]

TOLERANCE = 1e-8
"""The relative difference up to which two solutions count as equal: Riccati's equation magnifies rounding."""

SLOPE = 1e-5
"""That of slopes from difference quotients."""

WIDTH = 1e-4
"""The step of the quotients, relative to 1 + |x|."""


def closed_loop(
    linear: LinearModel,
    regulator: tuple[Array, Array, Array, Array],
    law: Mapping[sp.Expr, sp.Expr],
    left_out: Sequence[str] = (),
) -> tuple[Check, ...]:
    """Return the checks of Q, R, K, S and of a law; all but that of the law without the states that are left out."""
    import scipy.linalg

    kept = [k for k, name in enumerate(linear.states) if name not in left_out]
    inner, R, whole = np.ix_(kept, kept), regulator[1], linear.A - linear.B @ regulator[2]
    Q, K, S = regulator[0][inner], regulator[2][:, kept], regulator[3][inner]
    A, B = linear.A[inner], linear.B[kept]
    loop, cost = A - B @ K, Q + K.T @ R @ K
    pushed = S @ B @ np.linalg.solve(R, B.T @ S)
    terms = (A.T @ S, S @ A, pushed, Q)
    riccati = _relative(terms[0] + terms[1] - pushed + Q, *terms)
    P: Any = scipy.linalg.solve_continuous_lyapunov(loop.T, -cost)
    lyapunov = _relative(P - S, S)
    worst = complex(max(np.linalg.eigvals(loop), key=lambda pole: pole.real))
    names = {name: Name(name) for name in "ABKS"}
    return (
        Check(text(names["S"], " solves Riccati's equation"), riccati < TOLERANCE, _said(riccati)),
        Check(
            text(
                "Lyapunov's equation of the closed loop gives the same ", names["S"], ": the cost falls on every motion"
            ),
            lyapunov < TOLERANCE,
            _said(lyapunov),
        ),
        Check(
            text("the poles of the closed loop lie on the left"),
            worst.real < 0,
            f"the one farthest right is {complex_figure(worst)}",
        ),
        _law_check(linear, whole, law),
    )


def _law_check(linear: LinearModel, loop: Array, law: Mapping[sp.Expr, sp.Expr]) -> Check:
    """The slopes of the nonlinear system with the law compiled in, against those of the linear loop."""
    what = text("the system with this law has the slopes ", Name("A"), " − ", Name("B"), Name("K"))
    rates = dynamics.closed(linear.model, law)
    x, p = (np.array(list(values.values()), float) for values in (linear.at, linear.parameters))

    def at(x: Array) -> Array:
        return np.array(evaluate(rates, {"x": x.tolist(), "u": [], "p": p.tolist(), "t": [linear.time]})["xdot"], float)

    basis = np.eye(len(x)) if linear.basis is None else linear.basis
    slopes: list[Array] = []
    for column in basis.T:
        step = WIDTH * column
        slopes.append((8 * (at(x + step) - at(x - step)) - (at(x + 2 * step) - at(x - 2 * step))) / (12 * WIDTH))
    found = np.array(slopes).T
    if linear.back is not None and linear.transport is not None:
        found = linear.back @ found - linear.transport
    elif linear.basis is not None:
        found = found[[list(linear.at).index(name) for name in linear.states]]
    worst = _relative(found - loop, loop)
    return Check(what, worst < SLOPE, _said(worst))


def _relative(difference: Array, *terms: Array) -> float:
    size = max(float(np.abs(x).max(initial=0.0)) for x in terms)
    return float(np.abs(difference).max(initial=0.0)) / (size or 1.0)


def _said(worst: float) -> str:
    return f"largest relative difference {worst:.1e}"
