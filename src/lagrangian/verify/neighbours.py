"""States from which derivatives are compared with difference quotients, each with a random direction.

Where rows of constraints depend on each other wherever they hold, as in a double parallelogram, but not beside that,
accelerations jump there. Neighbours are moved onto the constraints then, along a direction that satisfies them.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.errors import RunError
from lagrangian.model import Model
from lagrangian.records import dataclass, field
from lagrangian.verify.on_rows import OnRows
from lagrangian.verify.slopes import SETTLED, TOLERANCE, WIDTH, extrapolated
from lagrangian.verify.states import State

Array: TypeAlias = NDArray[np.float64]

RESOLVED = 1e-12
"""What a quotient resolves of a function that hardly changes, in parts of its value: rounding, divided by the step."""

INDEPENDENT = 1e-10
"""Rows of constraints depend on each other where their margin is at most this."""

BESIDE = "the rows of the constraints depend on each other where they hold, and accelerations jump beside that"


class Changing(Protocol):
    """The functions of `lagrangian.Compiled` that are compared."""

    @property
    def forward(self) -> Callable[..., Array]: ...  # noqa: D102
    @property
    def inverse(self) -> Callable[..., Array]: ...  # noqa: D102
    @property
    def mass_matrix(self) -> Callable[..., Array]: ...  # noqa: D102
    @property
    def rates(self) -> Callable[..., Array]: ...  # noqa: D102
    @property
    def derivatives(self) -> Callable[..., Any]: ...  # noqa: D102
    @property
    def linearized(self) -> Callable[..., tuple[Array, Array]]: ...  # noqa: D102
    @property
    def pullback(self) -> Callable[..., Any]: ...  # noqa: D102
    @property
    def hessian_product(self) -> Callable[..., Any]: ...  # noqa: D102
    @property
    def step(self) -> Callable[..., Any]: ...  # noqa: D102
    @property
    def margin(self) -> Callable[..., Array]: ...  # noqa: D102
    @property
    def allowed_changes(self) -> Callable[..., Array]: ...  # noqa: D102


@dataclass
class Neighbourhood:
    """A state, and a random direction from it: δq along the velocities, δv, δu."""

    model: Model
    state: State
    seed: int
    q: Array = field(init=False)
    v: Array = field(init=False)
    a: Array = field(init=False)
    u: Array = field(init=False)
    p: Array = field(init=False)

    def __post_init__(self) -> None:
        self.q, self.v, self.a, self.u, self.p = (np.array(self.state[group], float) for group in "qvaup")
        source = random.Random(self.seed)
        self.dq, self.dv, self.weights = (np.array([source.uniform(-1, 1) for _ in self.v]) for _ in range(3))
        self.du = np.array([source.uniform(-1, 1) for _ in self.u])
        self.t = self.state["t"][0]
        self.fixed = {"p": self.p, "t": self.t}
        self.parameters = tuple(f"{dynamics.PARAMETER}{p.name}" for p in self.model.parameters)
        self.dependent = False

    def kept_on_rows(self, functions: Changing, onto: OnRows) -> None:
        """If the rows depend on each other here, take a direction that satisfies them."""
        if not depends(functions, self.state):
            return
        self.dependent, self._onto = True, onto
        T = functions.allowed_changes(self.q, self.v, **self.fixed)
        source, n = random.Random(self.seed), len(self.v)
        change = T @ np.array([source.uniform(-1, 1) for _ in range(T.shape[1])])
        self.dq, self.dv, self.parameters = change[:n], change[n:], ()

    def _state(self, q: Array, v: Array) -> tuple[Array, Array]:
        """A neighbour, moved onto rows that depend on each other; raises `RunError` where that fails."""
        if not self.dependent:
            return q, v
        moved = self._onto.of({**self.state, "q": q.tolist(), "v": v.tolist()})
        if moved is None:
            raise RunError("a neighbour cannot be moved to where the constraints hold", code="E503")
        return np.array(moved["q"]), np.array(moved["v"])

    def forward(self, functions: Changing) -> Function:
        """(q, v, u, p) → a."""
        return lambda q, v, u, p: functions.forward(q, v, u=u, p=p, t=self.t)

    def inverse(self, functions: Changing) -> Function:
        """(q, v, u, p) → r at the accelerations of the state."""
        return lambda q, v, u, p: functions.inverse(q, v, self.a, u=u, p=p, t=self.t)

    def along(self, functions: Changing, f: Function) -> Array | None:
        """The derivative of f(q, v, u, p) along the direction; None where quotients do not settle."""
        moved = functions.rates(self.q, self.dq)

        def shifted(h: float) -> Array:
            sides = [self._state(self.q + s * moved, self.v + s * self.dv) for s in (h, -h)]
            q, v = (np.stack(x) for x in zip(*sides, strict=True))
            return f(q, v, self.u + np.array([[h], [-h]]) * self.du, self.p)

        return quotient(shifted)

    def by_parameters(self, f: Function) -> Array | None:
        """The derivative of f(q, v, u, p) by every parameter, one a column; None where quotients do not settle."""
        columns: list[Array] = []
        for k, unit in enumerate(np.where(self.p != 0, np.abs(self.p), 1.0)):
            change = unit * np.eye(len(self.p))[k]

            def shifted(h: float, change: Array = change) -> Array:
                return np.stack([f(self.q, self.v, self.u, self.p + s * change) for s in (h, -h)])

            if (column := quotient(shifted)) is None:
                return None
            columns.append(column / unit)
        return np.array(columns).T


def depends(functions: Changing, state: State) -> bool:
    """Whether the rows of constraints depend on each other at a state."""
    return bool(functions.margin(np.array(state["q"]), p=np.array(state["p"]), t=state["t"][0]) <= INDEPENDENT)


Function: TypeAlias = Callable[[Array, Array, Array, Array], Array]
"""q, v, u, p → a vector, of one state or of two."""


def resolved(place: Neighbourhood, f: Function) -> Array:
    """What quotients of f resolve, as a term of a comparison within `TOLERANCE`."""
    return RESOLVED / TOLERANCE * f(place.q, place.v, place.u, place.p)


def quotient(shifted: Callable[[float], Array]) -> Array | None:
    """f′ of a function that is given as h → [f(h), f(−h)]; None where quotients do not settle."""
    levels: list[Array] = []
    size = 0.0
    for k in range(3):
        h = WIDTH / 2**k
        ahead, behind = shifted(h)
        levels.append((ahead - behind) / (2 * h))
        size = max(size, float(np.abs(ahead).max(initial=0.0)))
    found, doubt = extrapolated(levels)
    slope = float(np.abs(found).max(initial=0.0))
    return found if doubt <= max(SETTLED * slope, RESOLVED * size) else None
