"""The linear-quadratic regulator of a linearization, and the linearization as python-control's StateSpace."""

from __future__ import annotations

from collections.abc import Mapping
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import MissingExtra, RunError
from lagrangian.linear.linear_model import LinearModel
from lagrangian.linear.modes import slowest_first
from lagrangian.linear.reach import controllable, observable
from lagrangian.linear.regulator import Regulator
from lagrangian.linear.stability import shown
from lagrangian.values.values import Group, number

Array = NDArray[np.float64]

ON_THE_AXIS = 1e-9
"""The part of a pole below which its real part is rounding."""

WEIGHED = "give a weight to the states whose modes do not decay by themselves"


def python_control() -> ModuleType:
    """Import python-control, or raise the error with the command that installs it."""
    try:
        import control
    except ImportError as missing:
        raise MissingExtra(
            "this needs the package python-control", fix="pip install 'lagrangian[control]'", code="E801"
        ) from missing
    return control


def to_control(linear: LinearModel) -> Any:
    """The linearization as python-control's StateSpace, with the names of states, inputs and outputs."""
    return python_control().ss(
        linear.A,
        linear.B,
        linear.C,
        linear.D,
        states=list(linear.states),
        inputs=list(linear.inputs),
        outputs=list(linear.outputs),
        name=linear.model.name,
    )


def lqr(linear: LinearModel, Q: Any, R: Any) -> Regulator:
    """The regulator that minimizes ∫ (δxᵀQ δx + δuᵀR δu) dt: K = R⁻¹BᵀS, where S solves Riccati's equation.

    ``Q`` and ``R``: a matrix, a number (times the identity), or weights of the diagonal by name (0 if not named).
    A coordinate on which no rate depends and that costs nothing, such as the charge of a motor, is left out.
    Raises `RunError` if an uncontrollable mode does not decay, if one that does not decay costs nothing, and for
    weights that do not fit.
    """
    import scipy.linalg  # slow to load

    q = _weights(Q, "Q", "state", linear.states)
    r = _weights(R, "R", "input", linear.inputs)
    kept = _kept(linear, q)
    inner = np.ix_(kept, kept)
    A, B, cost, states = linear.A[inner], linear.B[kept], q[inner], tuple(linear.states[k] for k in kept)
    reach = controllable(A, B, states)
    lost = [m for m in reach.missing if not m.pole.real < 0]
    if lost:
        names = ", ".join(lost[0].combination)
        raise RunError(
            f"no feedback can stabilize the system: the pole {shown(lost[0].pole)} of {names} is not controllable",
            fix="add an input that acts on it, or linearize without that coordinate",
            code="E522",
        )
    if np.linalg.eigvalsh(q).min() < -1e-12 * max(1.0, float(np.abs(q).max())):
        raise RunError("Q must be positive semidefinite", fix="give weights that are not negative", code="E501")
    if np.linalg.eigvalsh(r).min() <= 0:
        raise RunError("R must be positive definite", fix="give every input a positive weight", code="E501")
    free = [m for m in observable(A, cost, states).missing if not abs(m.pole.real) > ON_THE_AXIS * abs(m.pole)]
    if free:
        names = ", ".join(free[0].combination)
        raise RunError(
            f"the pole {shown(free[0].pole)} of {names} would stay as it is, since no weight in Q makes this motion "
            "cost anything",
            fix=WEIGHED,
            code="E522",
        )
    try:
        found = np.asarray(scipy.linalg.solve_continuous_are(A, B, cost, r), float)
    except (np.linalg.LinAlgError, ValueError) as trouble:
        raise RunError(f"Riccati's equation has no solution: {trouble}", fix=WEIGHED, code="E522") from trouble
    gains = np.linalg.solve(r, B.T @ found)
    poles: NDArray[np.complex128] = np.asarray(np.linalg.eigvals(A - B @ gains), complex)
    if not (poles.real < 0).all():
        worst = complex(poles[int(np.argmax(poles.real))])
        raise RunError(f"the closed loop would have the pole {shown(worst)}", fix=WEIGHED, code="E522")
    S, K = np.zeros_like(q), np.zeros((len(r), len(q)))
    S[inner], K[:, kept] = found, gains
    left_out = tuple(name for name in linear.states if name not in states)
    return Regulator(linear, q, r, K, S, poles[slowest_first(poles)], left_out)


def _kept(linear: LinearModel, q: Array) -> list[int]:
    """The places of the states without coordinates on which no rate depends, so that they may drift, and that cost
    nothing."""
    moving = {c.name for c in linear.model.coordinates}
    used = [bool(column.any()) for column in np.vstack([linear.A, q]).T]
    return [k for k, name in enumerate(linear.states) if used[k] or name not in moving]


def _weights(given: Any, what: str, noun: str, names: tuple[str, ...]) -> Array:
    n = len(names)
    if isinstance(given, Mapping):
        found = Group(noun, names, (None,) * n).values(given)
        return np.diag([found.get(name, 0.0) for name in names])
    if np.ndim(given) == 0:
        return number(given, what) * np.eye(n)
    try:
        matrix = np.asarray(given, float)
    except (TypeError, ValueError):
        raise RunError(f"{what} must be made of real numbers", code="E501") from None
    if matrix.shape != (n, n) or not np.isfinite(matrix).all():
        raise RunError(
            f"{what} has shape {matrix.shape}, {(n, n)} is needed: {', '.join(names)}",
            fix="give a finite matrix, one number, or weights by name",
            code="E501",
        )
    if not np.allclose(matrix, matrix.T, rtol=1e-12, atol=0):
        raise RunError(f"{what} must be symmetric", code="E501")
    return matrix
