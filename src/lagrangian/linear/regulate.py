"""Uses python-control: a linearization as a StateSpace with names, and the linear-quadratic regulator."""

from __future__ import annotations

from collections.abc import Mapping
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import MissingExtra, RunError
from lagrangian.linear.linear_model import LinearModel
from lagrangian.linear.modes import slowest_first
from lagrangian.linear.reach import controllable
from lagrangian.linear.regulator import Regulator
from lagrangian.linear.stability import shown
from lagrangian.values.values import Group, number

Array = NDArray[np.float64]


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
    """The regulator that minimizes ∫ (δxᵀQ δx + δuᵀR δu) dt, computed by python-control.

    ``Q`` and ``R``: a matrix, a number (times the identity), or weights of the diagonal by name (0 if not named).
    Raises `RunError` if an uncontrollable mode does not decay, and for weights that do not fit.
    """
    reach = controllable(linear.A, linear.B, linear.states)
    lost = [m for m in reach.missing if not m.pole.real < 0]
    if lost:
        names = ", ".join(lost[0].combination)
        raise RunError(
            f"no feedback can stabilize the system: the pole {shown(lost[0].pole)} of {names} is not controllable",
            fix="add an input that acts on it, or linearize without that coordinate",
            code="E522",
        )
    q = _weights(Q, "Q", "state", linear.states)
    r = _weights(R, "R", "input", linear.inputs)
    if np.linalg.eigvalsh(q).min() < -1e-12 * max(1.0, float(np.abs(q).max())):
        raise RunError("Q must be positive semidefinite", fix="give weights that are not negative", code="E501")
    if np.linalg.eigvalsh(r).min() <= 0:
        raise RunError("R must be positive definite", fix="give every input a positive weight", code="E501")
    try:
        K, S, poles = python_control().lqr(linear.A, linear.B, q, r)
    except (np.linalg.LinAlgError, ValueError) as trouble:
        raise RunError(
            f"Riccati's equation has no solution: {trouble}",
            fix="give a weight to the states whose modes do not decay by themselves",
            code="E522",
        ) from trouble
    poles = np.asarray(poles, complex)
    return Regulator(linear, np.atleast_2d(K), np.asarray(S), poles[slowest_first(poles)])


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
