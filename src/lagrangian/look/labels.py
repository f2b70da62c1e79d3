"""Finds places for labels where they meet nothing: the cheapest of many, by what they would lie on."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import Board, Wish
from lagrangian.page.scene import Label, Pair
from lagrangian.write.scene_letters import width_of

Array = NDArray[np.float64]
Box = tuple[float, float, float, float]

SIZE = 15.0
DIRECTIONS, DISTANCES = 16, (0.0, 5.0, 12.0, 22.0, 36.0)


def placed_labels(board: Board) -> list[Label]:
    """The labels of a board, each where it meets the least."""
    boxes, labels = list(board.boxes), list[Label]()
    segments = np.array(board.segments, float).reshape(-1, 2, 2)
    for wish in sorted(board.wishes, key=lambda w: not w.inside):
        width, height = width_of(wish.names, SIZE), SIZE * 1.15
        centre = wish.near if wish.inside else _best(wish, width, height, boxes, segments)
        box = (centre[0] - width / 2, centre[1] - height / 2, width, height)
        boxes.append(box)
        labels.append(Label(wish.names, centre, wish.role, wish.elements, box, SIZE))
    return labels


def _best(wish: Wish, width: float, height: float, boxes: list[Box], segments: Array) -> Pair:
    size = (wish.away[0] ** 2 + wish.away[1] ** 2) ** 0.5 or 1.0
    ax, ay = wish.away[0] / size, wish.away[1] / size
    angles = 2 * pi * np.arange(DIRECTIONS) / DIRECTIONS
    extra, angle = (x.ravel() for x in np.meshgrid(DISTANCES, angles, indexing="ij"))
    dx, dy = np.cos(angle), np.sin(angle)
    reach = wish.distance + extra + abs(dx) * width / 2 + abs(dy) * height / 2
    x, y = wish.near[0] + reach * dx, wish.near[1] + reach * dy
    size_of = np.full_like(x, width + 2), np.full_like(x, height + 2)
    box = np.stack([x - width / 2 - 1, y - height / 2 - 1, *size_of], axis=-1)[:, None]
    cost = 0.45 * (1 - dx * ax - dy * ay) + 0.055 * extra
    if boxes:
        cost = cost + 6.0 * _overlaps(box, np.array(boxes, float)).sum(axis=1)
    cost = cost + 2.5 * _crossings(box, _near(segments, box)).sum(axis=1)
    least = int(np.argmin(cost))
    return float(x[least]), float(y[least])


def _overlaps(a: Array, b: Array) -> Array:
    """Whether boxes (…, 4) meet, and how much of the smaller one is covered: 0, or 0.3 to 1."""
    w, h = (
        np.minimum(a[..., k] + a[..., k + 2], b[..., k] + b[..., k + 2]) - np.maximum(a[..., k], b[..., k])
        for k in (0, 1)
    )
    least = np.maximum(1e-9, np.minimum(a[..., 2] * a[..., 3], b[..., 2] * b[..., 3]))
    return np.where((w > 0) & (h > 0), 0.3 + 0.7 * w * h / least, 0.0)


def _near(lines: Array, box: Array) -> Array:
    """The lines (n, 2, 2) that may meet one of the boxes (…, 4)."""
    low, high = box[..., :2].min(axis=(0, 1)), (box[..., :2] + box[..., 2:]).max(axis=(0, 1))
    return lines[((lines.min(axis=1) <= high) & (lines.max(axis=1) >= low)).all(axis=-1)]


def _crossings(box: Array, lines: Array) -> NDArray[np.bool_]:
    """Whether lines (…, 2, 2) meet boxes (…, 4) (clipping by Liang and Barsky)."""
    low, high = np.zeros(np.broadcast_shapes(box.shape[:-1], lines.shape[:-2])), np.ones(1)
    for k in range(2):
        step = lines[..., 1, k] - lines[..., 0, k]
        near = box[..., k] - lines[..., 0, k]
        far = near + box[..., k + 2]
        flat = np.abs(step) < 1e-12
        whole = np.where(flat, 1.0, step)
        outside = np.where((near > 0) | (far < 0), np.inf, -np.inf)
        low = np.maximum(low, np.where(flat, outside, np.minimum(near / whole, far / whole)))
        high = np.minimum(high, np.where(flat, np.inf, np.maximum(near / whole, far / whole)))
    return np.asarray(low <= high)


def crosses(box: Box, a: Pair, b: Pair) -> bool:
    """Whether a line meets a box."""
    return bool(_crossings(np.array(box), np.array((a, b))).all())
