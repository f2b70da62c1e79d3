"""Compares a linearization with difference quotients of the compiled right-hand side."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.errors import Error, RunError
from lagrangian.graph import reached
from lagrangian.linear.along import linearize_along
from lagrangian.linear.linear_model import LinearModel
from lagrangian.linear.linearize import linearize
from lagrangian.model import Model
from lagrangian.page.formula import Check, Name, text
from lagrangian.verify.poles import poles
from lagrangian.verify.states import State, named_values, relative

Array: TypeAlias = NDArray[np.float64]
Moved: TypeAlias = Callable[[dict[str, list[float]]], dict[str, list[float]] | None]
"""A state → one that satisfies the constraints, or None."""

TOLERANCE = 1e-6
"""The allowed difference from a quotient, relative to the largest derivative: the accuracy of quotients in doubles."""

SETTLED = 1e-7
"""A quotient is used if its last refinement changed it by at most this, relative to the largest derivative."""

WIDTH = 1e-2
"""The largest of the three steps of a quotient, relative to 1 + |x|; each of the others is half of the previous one."""

MOST_NODES = 4000
"""The largest right-hand side, in nodes of its graph, whose derivatives are compiled here: they have several times as
many, and compiling them would take most of the time of a verification."""

POINTS = 3
"""The number of states at which quotients are compared."""

UNSETTLED = "the difference quotients do not settle"


def slopes(
    model: Model, rhs: Callable[..., Array], states: Sequence[State], onto: Moved | None = None
) -> tuple[Check, Check]:
    """Return the check of A = ∂ẋ/∂x and B = ∂ẋ/∂u at a few states where the quotients converge, and that of the poles.

    Central quotients D(h) = (f(x + h) − f(x − h))/2h at h, h/2 and h/4 are extrapolated to h → 0 (Richardson), which
    leaves O(h⁶). A state where two extrapolations differ by more than `SETTLED`, as across a kink, is skipped. With
    ``onto``, which moves a state onto the rows of constraints, x is varied along the constraints alone.
    """
    A, B = Name("A"), Name("B")
    worst, refused, runs, missed = 0.0, "", 0, ""
    held: list[LinearModel] = []
    for state in states:
        if len(held) == POINTS:
            break
        try:
            quotients, doubt = (None, 0.0) if onto else _quotients(rhs, state)  # first, because they take less time
            if quotients is not None and not doubt < SETTLED * _size(quotients):
                refused = refused or UNSETTLED
                continue
            found = linearized(model, state)
            basis = None if onto is None else found.basis
            if quotients is None:
                quotients, doubt = _quotients(rhs, state, basis, onto)
        except Error as error:
            refused = refused or error.what
            continue
        whole = quotients
        if basis is not None:
            quotients = quotients[[list(found.at).index(name) for name in found.states]]
        elif found.back is not None:  # of the minimal states of floating frames
            m = len(found.at)
            minimal = found.back @ quotients[:, :m] @ found.basis - found.transport
            quotients = np.hstack([minimal, found.back @ quotients[:, m:]])
        elif found.basis is not None:  # of what constraints leave independent
            kept, m = [list(found.at).index(name) for name in found.states], len(found.at)
            quotients = np.hstack([quotients[kept, :m] @ found.basis, quotients[kept, m:]])
        exact = np.hstack([found.A, found.B])
        size = _size(quotients)
        if not doubt < SETTLED * size:
            refused = refused or UNSETTLED
            continue
        held.append(found)
        worst = float(np.maximum(worst, np.max(np.abs(exact - quotients), initial=0.0) / size))
        off = too_long(model) or _off_along(model, state, found.states, whole, quotients)
        if isinstance(off, str):
            missed = missed or off
        else:
            runs, worst = runs + 1, float(np.maximum(worst, off))
    too = ", also along a run," if runs else ""
    what = text(A, " and ", B, f" of the linearization{too} equal difference quotients of ẋ")
    if not held:
        return Check(what, None, f"not checked at any of {len(states)} random states: {refused}"), poles(held)
    at = f"{len(held)} random state{'s' if len(held) != 1 else ''}"
    at += f"; not compared along a run: {missed}" if missed and not runs else ""
    return Check(what, worst < TOLERANCE, f"largest relative difference {worst:.1e} at {at}"), poles(held)


def _size(quotients: Array) -> float:
    return float(np.max(np.abs(quotients), initial=0.0)) or 1.0


def linearized(model: Model, state: State) -> Any:
    """The linearization about a state, whether it is an equilibrium or not."""
    at = named_values(model, state)
    return linearize(model, at.initial, inputs=at.inputs, params=at.params, time=state["t"][0], operating_point=True)


def _off_along(model: Model, state: State, states: Sequence[str], whole: Array, quotients: Array) -> float | str:
    """How far the linearization along a run of one sample is from quotients, or why that is not known.

    ``whole`` are those of all coordinates and rates, ``quotients`` those of ``states``.
    """
    at = named_values(model, state)
    try:
        along = linearize_along(model, (state["t"], [[*state["q"], *state["v"]]]), inputs=at.inputs, params=at.params)
    except Error as error:  # such as friction that sticks
        return error.what
    if along.basis is not None and along.states != states:
        return "other states are independent there"
    expected = whole if along.basis is None else quotients
    return relative(np.hstack([along.A[0], along.B[0]]) - expected, expected)


def too_long(model: Model) -> str:
    """Why derivatives of a system are not compiled here; empty if they are."""
    rhs = dynamics.rhs(model)
    nodes = rhs.remembered("nodes", lambda: len(reached(rhs.graph, rhs.ids)))
    if nodes <= MOST_NODES:
        return ""
    return f"the accelerations have {nodes} nodes, and derivatives of more than {MOST_NODES} take long"


def _quotients(
    rhs: Callable[..., Array], state: State, basis: Array | None = None, onto: Moved | None = None
) -> tuple[Array, float]:
    """∂ẋ/∂[x; u], shape (n, n + m), and the largest change in the last extrapolation.

    With ``basis`` x changes along its columns, in place of every entry for itself, and is moved ``onto`` the rows.
    """
    x, u = np.array([*state["q"], *state["v"]]), np.array(state["u"])
    own: Array = np.diag(WIDTH * (1 + np.abs(x))) if basis is None else WIDTH * basis.T
    changes = np.zeros((len(own) + len(u), len(x) + len(u)))
    changes[: len(own), : len(x)] = own
    changes[len(own) :, len(x) :] = np.diag(WIDTH * (1 + np.abs(u)))
    widths = changes.max(axis=1) if basis is None else np.array([WIDTH] * len(own) + [*WIDTH * (1 + np.abs(u))])
    levels: list[Array] = []
    for k in range(3):
        around = np.concatenate([x, u]) + np.concatenate([changes, -changes]) / 2**k
        if basis is not None and onto is not None:
            around[:, : len(x)] = [_moved(onto, state, row[: len(x)]) for row in around]
        f = rhs(state["t"][0], around[:, : len(x)], u=around[:, len(x) :], p=np.array(state["p"]))
        levels.append((f[: len(changes)] - f[len(changes) :]).T / (2 * widths / 2**k))
    return extrapolated(levels)


def _moved(onto: Moved, state: State, x: Array) -> list[float]:
    """A neighbour x moved onto the rows; raises `RunError` where that fails."""
    n = len(state["q"])
    found = onto({**state, "q": x[:n].tolist(), "v": x[n:].tolist()})
    if found is None:
        raise RunError("a neighbour cannot be moved to where the constraints hold", code="E503")
    return [*found["q"], *found["v"]]


def extrapolated(levels: Sequence[Array]) -> tuple[Array, float]:
    """Central quotients at h, h/2 and h/4 extrapolated to h → 0, and the largest change in the last extrapolation."""
    once = [(4 * levels[k + 1] - levels[k]) / 3 for k in range(2)]
    twice = (16 * once[1] - once[0]) / 15
    return twice, float(np.max(np.abs(twice - once[1]), initial=0.0))
