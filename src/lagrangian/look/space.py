"""Arcs in space: an angle is drawn in the plane across its axis."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import BEHIND, MEASURE, Board
from lagrangian.look.shapes import head, line
from lagrangian.look.turning import Turn

Array = NDArray[np.float64]

ARC = 46.0
"""The radius of an arc in space [px]."""


def axis_of(board: Board, frame: int, i: int) -> Array | None:
    """The axis about which coordinate i turns a frame in the pose, as a unit vector in the fixed axes."""
    views = board.views
    R, RJ = views.R[0, frame], views.RJ[0, frame, :, :, i]
    W = RJ @ R.T
    n = np.array([W[2, 1], W[0, 2], W[1, 0]])
    size = float(np.linalg.norm(n))
    return n / size if size > 1e-9 else None


def rotated(n: Array, angle: float, d: Array) -> Array:
    """A vector after a turn about the unit vector n (Rodrigues)."""
    return d * np.cos(angle) + np.cross(n, d) * np.sin(angle) + n * (n @ d) * (1 - np.cos(angle))


def arc_in_space(board: Board, i: int, name: str, turn: Turn, used: dict[int, int]) -> None:
    """An arc across the axis of an angle, from where the direction is at 0 to where it is now."""
    n = _axis(board, i, turn)
    if n is None:
        board.lacks(f"coordinate {name} is not drawn", "")
        return
    joint, tip = board.r[turn.joint], board.r[turn.tip]
    d = tip - joint
    flat = d - (d @ n) * n
    if np.linalg.norm(flat) < 0.05 * max(float(np.linalg.norm(d)), 1e-9) or not np.linalg.norm(d):
        flat = _across(board, n)
    flat = flat / np.linalg.norm(flat)
    level = used[turn.joint] = used.get(turn.joint, -1) + 1
    radius = (ARC + 14.0 * level) / board.scale
    angles = np.linspace(-float(board.q[i]), 0.0, 25)
    origin = board.at(turn.joint)
    path = [origin + board.scale * (board.view @ (radius * rotated(n, a, flat))) for a in angles]
    spots = [(float(x), float(y)) for x, y in path]
    board.put(line(*spots[:-1]), "coordinate", of=(name,), kind="coordinate", width=1.8, layer=MEASURE, moves=False)
    end, before = path[-1], path[-4]
    if np.linalg.norm(end - before) > 1e-6:
        e = end - before
        tip_shape = head(spots[-1], (float(e[0]), float(e[1])))
        board.put(
            tip_shape, "coordinate", of=(name,), kind="coordinate", width=0.0, solid=True, layer=MEASURE, moves=False
        )
    for spot in (path[0], path[-1]):
        far = origin + 1.25 * (spot - origin)
        board.put(
            line(tuple(origin), tuple(far)), "thin", kind="reference", width=1.0, dashed=True, layer=BEHIND, moves=False
        )
    for a, b in itertools.pairwise(path):
        board.fence(a, b)
    middle = path[len(path) // 2]
    board.wish((name,), middle, middle - origin, "coordinate", (name,), distance=4.0)


def _axis(board: Board, i: int, turn: Turn) -> Array | None:
    """The axis of a frame's turn, or that of a rod: d × ∂d/∂q."""
    if turn.frame is not None:
        return axis_of(board, turn.frame, i)
    views = board.views
    d = views.r[0, turn.tip] - views.r[0, turn.joint]
    D = views.J[0, turn.tip, :, i] - views.J[0, turn.joint, :, i]
    n = _rod_axis(board, i, turn, d, D)
    size = float(np.linalg.norm(n))
    return n / size if size > 1e-9 else None


def _rod_axis(board: Board, i: int, turn: Turn, d: Array, D: Array) -> Array:
    """The axis of a rod's turn: perpendicular to the change of direction in this pose and in a neighbouring one."""
    q = board.q.copy()
    q[i] += 0.3
    views = board.stage.views([q], board.p)
    D2 = views.J[0, turn.tip, :, i] - views.J[0, turn.joint, :, i]
    n = np.cross(D, D2)
    return n if np.linalg.norm(n) > 1e-9 else np.cross(d, D)


def _across(board: Board, n: Array) -> Array:
    """A direction across an axis that is seen well."""
    options = [np.eye(3)[k] - n[k] * n for k in range(3)]
    return max(options, key=lambda x: float(np.linalg.norm(board.view @ x)) if np.linalg.norm(x) > 0.1 else 0.0)
