"""Rows that follow from others along the motion, although not in every position.

A platform on three equal, parallel cranks moves, although its six rows restrict six coordinates: where all of them
hold, one follows from the others. Off the constraints, as inside a step, it does not, and its tiny pivot is of no use.
So the number of such rows is found before a run, from the ranks of A at the start and at neighbours that satisfy the
rows.

A set of rows belongs together if a null vector yᵀA = 0 contains all of them. It is taken to have k spare rows if its
rank lacks k or more at every one of these positions.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.assembly.assemble import Assembler, assembler_of
from lagrangian.errors import RunError
from lagrangian.graph import Program, evaluate
from lagrangian.integrate.closing import kernel_of
from lagrangian.model import Model
from lagrangian.model.spare import SpareRows

Array = NDArray[np.float64]

NOTHING, SOMETHING = 1e-9, 1e-5
"""A singular value below the first part of the largest one is 0, above the second it is not. Between them is doubt."""

SHARE = 1e-6
"""A row whose entry of a null vector is below this part of the largest one has none."""

FLAT, ASIDE = 1e-3, 1e-2
"""A row has no slope if it is below the first part of what it is at the second distance, relative to 1 + |q|."""

DIRECTIONS, STEPS = 3, 4
"""The number of directions in which neighbours are sought, and of neighbours in each."""

STRIDE = 0.06
"""The distance of neighbours: the largest change of a coordinate, relative to 1 + |q|."""


def check_slopes(model: Model, q: Array, p: Array, t: float = 0.0) -> None:
    """Raise `RunError` for a row whose gradient is 0 where the row holds, though not beside, as that of x² = 0."""
    assembler = assembler_of(model)
    source = np.random.default_rng(6)
    here = _sizes(assembler, q, p, t)
    if not (here < FLAT * (1 + here.max(initial=0.0))).any():
        return
    beside = [_sizes(assembler, q + ASIDE * (1 + np.abs(q)) * source.uniform(-1, 1, len(q)), p, t) for _ in range(3)]
    for row, size, others in zip(assembler.rows, here, np.array(beside).T, strict=True):
        if size < FLAT * float(np.nanmin(others)):
            raise RunError(
                f"the constraint '{row.name}' has no slope where it holds, so that it restricts no rate",
                fix="write what is 0 itself instead of a power of it, x for x^2, or start elsewhere",
                place=row.element.place,
                code="E309",
            )


def _sizes(assembler: Assembler, q: Array, p: Array, t: float) -> Array:
    """The largest entry of every row of A."""
    return np.abs(_matrix(assembler, q, p, t)).max(axis=1, initial=0.0)


def spare_rows(model: Model, q: Array, v: Array, p: Array, t: float = 0.0) -> tuple[SpareRows, ...]:
    """The sets of rows with spare ones, for motions from the position q (n,) and rates v, which satisfy all rows.

    Where more rows depend on each other at the start than nearby, the system can move in more than one way from there:
    then neighbours count to which v leads, or the accelerations at rest.
    """
    if not model.constraints:
        return ()
    assembler = assembler_of(model)
    names = [row.name for row in assembler.rows]
    known = dynamics.dependent_rows(model)  # left out in any case
    rows = [k for k, name in enumerate(names) if name not in known]
    here = _matrix(assembler, q, p, t)[rows]
    if _missing(here) <= 0:
        return ()
    way = _Neighbours(model, assembler, p, t)
    source = np.random.default_rng(5)
    directions = [source.standard_normal(len(model.velocities)) for _ in range(DIRECTIONS)]
    places = [here, *(_matrix(assembler, x, p, t)[rows] for e in directions for x in way.along(q, e))]
    if min(map(_missing, places)) < _missing(here):
        e = v if np.abs(v).max(initial=0.0) > 0 else way.acceleration(q, v)
        places = [_matrix(assembler, x, p, t)[rows] for sign in (1, -1) for x in way.along(q, sign * e)]
    found: list[SpareRows] = []
    for group in _merged([part for A in places for part in parts(A)]):
        count = min(_missing(A[group]) for A in places)
        if count > 0:
            found.append(SpareRows(tuple(names[rows[k]] for k in group), count))
    return tuple(found)


def parts(A: Array) -> list[list[int]]:
    """The sets of rows that the null vectors of Aᵀ connect: the components of its reduced echelon form."""
    A = _scaled(A)
    left, sizes, _ = np.linalg.svd(A)
    rank = int((sizes > NOTHING * sizes.max(initial=0.0)).sum())
    null = left[:, rank:].T.copy()
    free = list(range(null.shape[1]))
    for k in range(len(null)):  # reduced: one row of its own for each vector, the largest entry first
        j = free.pop(int(np.argmax(np.abs(null[k, free]))))
        null[k] /= null[k, j]
        others = np.arange(len(null)) != k
        null[others] -= np.outer(null[others, j], null[k])
    return [np.flatnonzero(np.abs(y) > SHARE * np.abs(y).max()).tolist() for y in null]


def _merged(groups: Iterable[Sequence[int]]) -> list[list[int]]:
    """Sets that have a member in common become one."""
    found: list[set[int]] = []
    for group in groups:
        now = set(group)
        for other in [x for x in found if x & now]:
            found.remove(other)
            now |= other
        found.append(now)
    return sorted(sorted(x) for x in found)


def _missing(A: Array) -> int:
    """How many rows follow from the others; 0 where that is in doubt."""
    sizes = np.linalg.svd(_scaled(A), compute_uv=False)
    largest = sizes.max(initial=0.0)
    clear = int((sizes > SOMETHING * largest).sum())
    return len(A) - clear if clear == int((sizes > NOTHING * largest).sum()) else 0


def _scaled(A: Array) -> Array:
    """A with its columns and rows brought to the size 1; ranks and the support of null vectors stay."""
    for axis in (0, 1):
        size = np.abs(A).max(axis=axis, initial=0.0, keepdims=True)
        A = A / np.where(size > 0, size, 1.0)
    return A


def _matrix(assembler: Assembler, q: Array, p: Array, t: float) -> Array:
    """A at one of a few positions, for which no machine code is made; its error says which entry has no value."""
    program = assembler.matrix
    slopes = program.remembered("A alone", lambda: replace(program, outputs={"A": program.outputs["A"]}))
    rest = {group: [0.0] * len(program.inputs[group]) for group in ("v", "u")}
    A = np.array(evaluate(slopes, {"q": q.tolist(), "p": p.tolist(), "t": [t], **rest})["A"], float)
    return A if np.isfinite(A).all() else np.asarray(kernel_of(program)(q=q, p=p, t=t)["A"])


class _Neighbours:
    """Positions nearby that satisfy the rows."""

    def __init__(self, model: Model, assembler: Assembler, p: Array, t: float) -> None:
        self.model, self.assembler, self.p, self.t = model, assembler, p, t
        self.rest = {"u": [0.0] * len(model.inputs), "p": p.tolist(), "t": [t]}

    def along(self, q: Array, direction: Array) -> Iterator[Array]:
        """Neighbours step by step in the direction of some velocities, or near it."""
        search = self.assembler.search
        rates: Program = self.model.remembered("rates for neighbours", lambda: dynamics.rates(self.model))
        at, last = q, direction
        for _ in range(STEPS if search is not None else 0):
            last = _allowed(_matrix(self.assembler, at, self.p, self.t), last)
            motion = np.array(evaluate(rates, {"q": at.tolist(), "v": last.tolist(), **self.rest})["qdot"])
            size = float((np.abs(motion) / (1 + np.abs(at))).max(initial=0.0))
            if not size > 0 or search is None:
                return
            found, closed = search.run((at + STRIDE / size * motion)[None, :], self.p, self.t)
            if not closed[0]:
                return
            at = found[0]
            yield at

    def acceleration(self, q: Array, v: Array) -> Array:
        """v̇ without inputs; 0 where it has no value."""
        forward: Program = self.model.remembered("forward for neighbours", lambda: dynamics.forward(self.model))
        try:
            found = evaluate(forward, {"q": q.tolist(), "v": v.tolist(), **self.rest})["a"]
        except RunError:
            return np.zeros(len(v))
        return np.array(found, float)


def _allowed(A: Array, direction: Array) -> Array:
    """The part of a direction that the rows allow, of length 1."""
    _, sizes, right = np.linalg.svd(A)
    rank = int((sizes > SOMETHING * sizes.max(initial=0.0)).sum())
    free = right[rank:]
    along = free.T @ (free @ direction)
    length = float(np.linalg.norm(along))
    return along / length if length > 0 else along
