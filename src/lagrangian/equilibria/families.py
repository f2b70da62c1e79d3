"""Roots that are not isolated: K is singular there, and h stays 0 along a curve or a surface.

At a root with K c = 0, a step is made along c and corrected back to h = 0. If this ends at another point, the root
belongs to a family; if it returns, the root is isolated but degenerate.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lagrangian.equilibria.roots import EXACT, Search
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

Array = NDArray[np.float64]

SINGULAR = 1e-6
"""A singular value of K below this fraction of the largest counts as zero."""

DEGENERATE = 1e-3
"""Roots within this distance, in widths of the box, may be one degenerate root."""

STRIDE = 0.01
"""The length of a step along a family, in widths of the box."""

MAX_ROOTS = 1500

NARROWED = 60
"""The number of times that the place of the simplest root is narrowed to three fifths."""


@dataclass(frozen=True, eq=False)
class Family(Brief):
    """A continuum of roots: one of them, its dimension, and the coordinates that change along it."""

    root: Array
    dimension: int
    moving: tuple[int, ...]


def split(search: Search, roots: Array, low: Array, high: Array) -> tuple[Array, list[Family]]:
    """The isolated roots among distinct ones, and the families of the others."""
    isolated: list[Array] = []
    families: list[Family] = []
    left = list(roots)
    while left:
        root = left.pop(0)
        flat = _flat(search, root)
        directions = _directions(search, root, flat)
        if not len(directions):
            isolated.append(root)
            if len(flat):  # Newton's steps stall near a degenerate root and leave copies around it
                left = [r for r in left if search.distance(r, root) > DEGENERATE or not _touch(search, r, root)]
            continue
        if len(directions) == 1:
            path = _curve(search, root, directions[0], low, high)
        else:
            path = np.array(
                [root, *(r for r in left if len(_directions(search, r, _flat(search, r))) == len(directions))]
            )
        simplest = _simplest(search, path) if len(directions) == 1 else _with_zeros(search, path, len(directions))
        families.append(Family(simplest, len(directions), _moving(path, search.width)))
        left = [r for r in left if search.distance(path, r).min() > 2 * STRIDE]
    return np.array(isolated).reshape(-1, roots.shape[1]), families


def _flat(search: Search, root: Array) -> Array:
    """The directions, in widths of the box, with K c = 0."""
    values, rows = search.singular(root)
    return rows[values <= SINGULAR * max(float(values.max(initial=0.0)), 1.0)]


def _touch(search: Search, a: Array, b: Array) -> bool:
    """Whether h is also 0 between two roots, to within rounding."""
    return bool(search.residual((a + b)[None] / 2)[0] < 1e2 * EXACT)


def _directions(search: Search, root: Array, flat: Array) -> Array:
    """The flat directions along which h stays 0."""
    return np.array([c for c in flat if any(_stays(search, root, sign * c) for sign in (1, -1))])


def _stays(search: Search, root: Array, direction: Array) -> bool:
    """Whether a step along ``direction`` leads to another root."""
    return _next(search, root, direction, 0.2 * STRIDE) is not None


def _next(search: Search, root: Array, direction: Array, length: float) -> Array | None:
    """The root one step further along, or None if there is none."""
    trial = root.copy()
    trial[search.seek] += length * direction * search.width[search.seek]
    found = search.polish(trial[None])[0]
    moved = (found - root)[search.seek] / search.width[search.seek] @ direction
    return found if search.residual(found[None])[0] < EXACT and 0.5 * length < moved < 2 * length else None


def _curve(search: Search, root: Array, direction: Array, low: Array, high: Array) -> Array:
    """The roots along a curve, from one side of the box to the other, or once around a closed curve."""
    sides: list[list[Array]] = []
    for sign in (1.0, -1.0):
        here, along, path = root, sign * direction, [root]
        while len(path) < MAX_ROOTS:
            found = _next(search, here, along, STRIDE)
            if found is None or not _inside(found, low, high, search):
                break
            path.append(found)
            _, rows = search.singular(found)
            along = rows[-1] * np.sign(rows[-1] @ along)
            here = found
            if len(path) > 4 and search.distance(search.wrapped(found), root) < STRIDE:
                break
        sides.append(path)
    return search.wrapped(np.array([*reversed(sides[1]), *sides[0][1:]]))


def _inside(q: Array, low: Array, high: Array, search: Search) -> bool:
    held = ~search.turns
    return bool(((q >= low) & (q <= high))[held].all())


def _size(q: Array) -> Array:
    """How far positions (…, n) are from 0: Σ|q|, which is least where coordinates are 0."""
    return np.abs(q).sum(axis=-1)


def _simplest(search: Search, path: Array) -> Array:
    """The root of a curve nearest to 0, wherever the roots of ``path`` lie on it; of several, that of the greatest
    first coordinate (``search.last``: last)."""
    sizes = _size(path)
    near = sizes <= sizes.min() + STRIDE * search.width.sum()
    before, after = np.append(np.inf, sizes[:-1]), np.append(sizes[1:], np.inf)
    lowest = np.flatnonzero(near & (sizes <= before) & (sizes <= after))
    refined = [_refined(search, path, int(k)) for k in lowest]
    order = -1 if search.last else 1
    return min(refined, key=lambda q: (round(float(_size(q)), 9), (-q.round(9))[::order].tolist()))


def _refined(search: Search, path: Array, k: int) -> Array:
    """The least root between the neighbours of number k: where a coordinate is 0, else where Σ|q| is stationary."""
    here, zeros = path[k], list[Array]()
    for j in search.seek:
        found = _where_zero(search, here, [int(j)])
        if found is not None and search.distance(found, here) < 2 * STRIDE:
            zeros.append(found)
    if zeros and _size(best := min(zeros, key=lambda q: float(_size(q)))) <= _size(here) + SINGULAR:
        return best
    low, high = path[max(k - 1, 0)], path[min(k + 1, len(path) - 1)]
    for _ in range(NARROWED):
        ends = search.polish(np.array([low + (high - low) * share for share in (0.4, 0.6)]))
        if _size(ends[0]) < _size(ends[1]):
            high = ends[1]
        else:
            low = ends[0]
    return low


def _where_zero(search: Search, q: Array, zeros: Sequence[int]) -> Array | None:
    """The root near q where some coordinates are 0."""
    trial = q.copy()
    trial[list(zeros)] = 0.0
    left = np.array([j for j in search.seek if j not in zeros], np.int64)
    found = replace(search, seek=left).polish(trial[None])[0] if len(left) else trial
    return found if search.residual(found[None])[0] < EXACT else None


def _with_zeros(search: Search, path: Array, dimension: int) -> Array:
    """A root of a surface in which one coordinate after the other is 0, as far as the surface has such roots."""
    best = path[int(np.argmin(_size(path)))]
    zeros: list[int] = []
    for j in search.seek:
        found = _where_zero(search, best, [*zeros, int(j)])
        if found is not None and len(_directions(search, found, _flat(search, found))) == dimension:
            best = found
            zeros.append(int(j))
    return best


def _moving(path: Array, width: Array) -> tuple[int, ...]:
    spread = (path.max(axis=0) - path.min(axis=0)) / width
    return tuple(int(k) for k in np.flatnonzero(spread > 1e-6))
