"""Roots that are not isolated: K is singular there, and h stays 0 along a curve or a surface.

At a root with K c = 0, a step is made along c and corrected back to h = 0. If this ends at another point, the root
belongs to a family; if it returns, the root is isolated but degenerate.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lagrangian.equilibria.roots import EXACT, Search
from lagrangian.viewed import Brief

Array = NDArray[np.float64]

SINGULAR = 1e-6
"""A singular value of K below this fraction of the largest counts as zero."""

DEGENERATE = 1e-3
"""Roots within this distance, in widths of the box, may be one degenerate root."""

STRIDE = 0.01
"""The length of a step along a family, in widths of the box."""

MAX_ROOTS = 1500


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
        families.append(Family(_simplest(path), len(directions), _moving(path, search.width)))
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


def _simplest(path: Array) -> Array:
    """The root nearest to 0."""
    return path[int(np.argmin(np.abs(path).sum(axis=1)))]


def _moving(path: Array, width: Array) -> tuple[int, ...]:
    spread = (path.max(axis=0) - path.min(axis=0)) / width
    return tuple(int(k) for k in np.flatnonzero(spread > 1e-6))
