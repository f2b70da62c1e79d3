"""The states that constraints allow, and the directions in which they can change.

States x = [q; v] satisfy f(q, t) = 0 and c = A(q, t) v + a₀ = 0. Near one of them they are functions of some of their
own entries y, the independent states: x = φ(y, t), and the motion ẋ = F(x) gives

    δx = T δy,    δẏ = S ∂F/∂x T δy + S ∂F/∂u δu,    S T = 1

where S takes the independent entries out of x, and T spans the null space of the rows' slopes,

    ∂f/∂q δq = 0,    ∂c/∂q δq + A δv = 0.

A row on velocities that is not a rate of an f restricts speeds and no coordinate. The length of a quaternion e never
changes: eᵀ δe = 0 is one more row for δq.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property
from itertools import repeat

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.assembly.assemble import consistent
from lagrangian.errors import RunError
from lagrangian.graph import Program
from lagrangian.linear.jacobians import Arrays, reads, values, with_jacobians
from lagrangian.model import Model
from lagrangian.records import dataclass

Array = NDArray[np.float64]

CLEAR = 0.05
"""An entry of at least this part of its row's largest is good enough to solve the row for it."""

DEPENDENT = 1e-9
"""What elimination leaves of a row is rounding below this part of it: the row depends on the others."""

ON_ROWS = 1e-13
"""A row is satisfied if it is at most this part of its terms."""

BESIDE = 1e-6
"""A state of a run that is off a row by more than this part of its terms does not satisfy it."""

CHOICES = 40
"""The number of times of a run at which independent states are chosen."""

STEEP = 1e6
"""Independent states of which others are this multiple determine no motion."""

ASIDE = 1e-2
"""How far, relative to 1 + |x|, neighbours are sought to which a rank is compared."""


@dataclass(frozen=True, eq=False)
class Tangent:
    """The independent entries of x, by number, the first ``positions`` of them coordinates, and the basis T.

    ``complete``: no row depends on others; ``velocities``: the number of all velocities.
    """

    kept: tuple[int, ...]
    positions: int
    basis: Array
    complete: bool
    velocities: int

    @property
    def speeds(self) -> Array:
        """The speeds as functions of the independent ones: the columns span the null space of A."""
        n = len(self.basis) - self.velocities
        return self.basis[n:, self.positions :]

    def reduced(self, found: Arrays) -> Arrays:
        """ẋ, A and B of the independent states."""
        kept = list(self.kept)
        return {
            "xdot": found["xdot"][kept],
            "A": found["A"][kept] @ self.basis,
            "B": found["B"][kept],
        }


class Manifold:
    """The states of a model with constraints."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.names = (*(c.name for c in model.coordinates), *(v.name for v in model.velocities))
        self.size = len(model.coordinates)
        places = {c.name: k for k, c in enumerate(model.coordinates)}
        floating = [f.floating for f in model.floating if f.floating is not None]
        self.quaternions = [[places[c.name] for c in f.orientation] for f in floating]

    @cached_property
    def rows(self) -> Program:
        """f and c with ∂f/∂q, ∂c/∂q and A."""
        wanted = {"F": ("f", "q"), "Cq": ("Av", "q"), "A": ("Av", "v")}
        return with_jacobians(dynamics.residual(self.model), wanted)

    @cached_property
    def moves_with_time(self) -> bool:
        """Whether a row contains time."""
        return any(reads(self.rows, name, "t") for name in ("f", "Av"))

    def at(self, x: Array, p: Array, t: float) -> Arrays:
        """f, c and their slopes at a state, and as ``lengths`` the slopes of |e|²/2 of quaternions."""
        n = self.size
        lengths = np.zeros((len(self.quaternions), n))
        for row, entries in zip(lengths, self.quaternions, strict=True):
            row[entries] = x[entries]
        u = np.zeros(len(self.model.inputs))
        return {**values(self.rows, q=x[:n], v=x[n:], u=u, p=p, t=t), "lengths": lengths}

    def holds(self, x: Array, p: Array, t: float) -> bool:
        """Whether a state satisfies every row but for rounding."""
        return all(off <= ON_ROWS for off in self.gaps(x, self.at(x, p, t)))

    def gaps(self, x: Array, found: Arrays) -> list[float]:
        """How far every row is from 0 at a state, in parts of its terms."""
        n = self.size
        F, Cq, A = (np.abs(found[name]) for name in ("F", "Cq", "A"))
        q, v = np.abs(x[:n]), np.abs(x[n:])
        sizes = (F @ q + F.max(axis=1, initial=0.0), A @ v + Cq @ q + A.max(axis=1, initial=0.0))
        off = [np.abs(found[name]) / np.maximum(size, 1e-300) for name, size in zip(("f", "Av"), sizes, strict=True)]
        return np.concatenate(off).tolist()

    def moved(self, x: Array, p: Array, t: float, fixed: Sequence[str] = ()) -> Array:
        """The state nearest to x that satisfies every row; coordinates in ``fixed`` stay. Raises `RunError`."""
        n = self.size
        return np.concatenate(consistent(self.model, x[:n], x[n:], p, t, fixed=fixed))

    def tangent(
        self, x: Array, p: Array, t: float, kept: Sequence[int] | None = None, idle: Sequence[int] = ()
    ) -> Tangent:
        """The tangent at a state, with independent states of its own choice unless ``kept`` names them by number.

        Rows are solved for the last coordinates that can be, and for speeds of these, of coordinates in ``idle``
        (numbers), and for the last ones. Raises `RunError` where rows depend on each other that do not do so nearby:
        there is no tangent there.
        """
        found = self.at(x, p, t)
        made = self.tangent_of(found, kept, idle)
        if kept is None and not made.complete and self._is_singular(x, p, t, made):
            raise RunError(
                f"the constraints depend on each other at {point_words(self.names, x)}, and not nearby: "
                "the system can move in more than one way from there",
                fix="choose a neighbouring point",
                code="E525",
            )
        return made

    def tangent_of(self, found: Arrays, kept: Sequence[int] | None, idle: Sequence[int] = ()) -> Tangent:
        """The tangent that follows from the slopes of the rows."""
        n, size = self.size, len(self.names)
        F, A = np.vstack([found["F"], found["lengths"]]), found["A"]
        if kept is None:
            late = range(n - 1, -1, -1)
            placed = pivots(F, late)
            rates = {name: k for k, name in enumerate(self.names[n:])}
            named = [f"{self.names[k]}'" for k in (*placed, *sorted(idle, reverse=True))]
            order = [*(rates[name] for name in named if name in rates), *range(size - n - 1, -1, -1)]
            speeds = pivots(A, dict.fromkeys(order))
            complete = len(placed) == len(F) and len(speeds) == len(A)
        else:
            placed = [k for k in range(n) if k not in kept]
            speeds = [k for k in range(size - n) if k + n not in kept]
            complete = True
        free_q = [k for k in range(n) if k not in placed]
        free_v = [k for k in range(size - n) if k not in speeds]
        basis = np.zeros((size, len(free_q) + len(free_v)))
        positions, rest = basis[:n], basis[n:]
        positions[free_q, np.arange(len(free_q))] = 1.0
        positions[placed, : len(free_q)] = _solved(F[:, placed], -F[:, free_q])
        rest[free_v, len(free_q) + np.arange(len(free_v))] = 1.0
        right = np.hstack([-found["Cq"] @ positions[:, : len(free_q)], -A[:, free_v]])
        rest[speeds] = _solved(A[:, speeds], right)
        return Tangent((*free_q, *(n + k for k in free_v)), len(free_q), basis, complete, size - n)

    def _is_singular(self, x: Array, p: Array, t: float, here: Tangent) -> bool:
        """Whether the rows are more independent at neighbours than at x."""
        source = np.random.default_rng(7)
        for _ in range(3):
            step = here.basis @ source.uniform(-1, 1, here.basis.shape[1])
            near = x + ASIDE * (1 + np.abs(x)) * step / max(1.0, float(np.abs(step).max(initial=0.0)))
            try:
                found = self.tangent_of(self.at(self.moved(near, p, t), p, t), None)
            except RunError:
                return True
            if len(found.kept) < len(here.kept):
                return True
        return False


def tangents(manifold: Manifold, t: Array, x: Array, p: Array) -> tuple[list[int], Array]:
    """Independent states that are some at all times, by number, and the bases T (times, all states, independent).

    Choices are tried that are made at some of the times; that with the smallest T is taken. Raises `RunError` for a
    state beside the constraints, and if every choice fails somewhere.
    """
    rows = [manifold.at(*state) for state in zip(x, repeat(p), t, strict=False)]
    for k, found in enumerate(rows):
        off = max(manifold.gaps(x[k], found), default=0.0)
        if off > BESIDE:
            raise RunError(
                f"the state at t = {t[k]:g} s does not satisfy the constraints: a row is off by {off:.2g} of its terms",
                fix="use the states of a run, or those that compile().assemble(q, v) returns",
                code="E521",
            )
    some = np.unique(np.linspace(0, len(x) - 1, CHOICES).astype(int)).tolist()
    best: tuple[float, list[int], Array] = (np.inf, [], np.zeros(0))
    for choice in dict.fromkeys(manifold.tangent(x[k], p, float(t[k])).kept for k in some):
        try:
            bases = np.array([manifold.tangent_of(found, choice).basis for found in rows])
        except np.linalg.LinAlgError:
            continue
        size = float(np.abs(bases).max(initial=0.0))
        if size < best[0]:
            best = size, list(choice), bases
    if not best[0] < STEEP:
        raise RunError(
            "no choice of independent states stays one along the run: each has a time at which it determines no motion",
            fix="take a shorter part of the run, or linearize at single times with operating_point=True",
            code="E523",
        )
    return best[1], best[2]


def point_words(names: tuple[str, ...], x: Array) -> str:
    """Return the first entries of a point, ``theta = 0.1, x' = 2``."""
    listed = [f"{n} = {v:.6g}" for n, v in zip(names, x, strict=True)]
    return ", ".join(listed[:8]) + (", …" if len(listed) > 8 else "")


def pivots(matrix: Array, order: Iterable[int]) -> list[int]:
    """The columns that rows are solved for: the first of ``order`` with a clear entry, as many as the rank."""
    size = np.abs(matrix).max(axis=1, initial=0.0, keepdims=True)
    left = (matrix / np.where(size > 0, size, 1.0))[size[:, 0] > 0]
    found: list[int] = []
    listed = list(order)
    for clear in (CLEAR, 0.0):
        for k in listed:
            if not len(left) or k in found:
                continue
            largest = np.abs(left).max(axis=1)
            r = int(np.argmax(np.abs(left[:, k]) / largest))
            if abs(left[r, k]) < max(clear * largest[r], DEPENDENT):
                continue
            pivot = left[r] / left[r, k]
            left = np.delete(left, r, axis=0)
            left = left - np.outer(left[:, k], pivot)
            left[:, k] = 0.0
            left = left[np.abs(left).max(axis=1, initial=0.0) > DEPENDENT]
            found.append(k)
    return found


def _solved(matrix: Array, right: Array) -> Array:
    """X with matrix X = right, of rows that may depend on each other."""
    if not matrix.shape[1]:
        return np.zeros((0, right.shape[1]))
    size = np.abs(matrix).max(axis=1, initial=0.0, keepdims=True)
    size = np.where(size > 0, size, 1.0)
    if matrix.shape[0] == matrix.shape[1]:
        return np.asarray(np.linalg.solve(matrix / size, right / size), float)
    return np.asarray(np.linalg.lstsq(matrix / size, right / size, rcond=DEPENDENT)[0], float)
