"""Finds places for labels where they meet nothing: the cheapest of many, by what they would lie on."""

from __future__ import annotations

import itertools
from math import pi

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import MEASURE, Board, Wish
from lagrangian.look.shapes import line
from lagrangian.page.placing import placed
from lagrangian.page.scene import Disc, Label, Pair
from lagrangian.write.scene_letters import width_of

Array = NDArray[np.float64]
Box = tuple[float, float, float, float]

SIZE = 15.0
DIRECTIONS, DISTANCES = 16, (0.0, 5.0, 12.0, 22.0, 36.0, 52.0)
ROUNDS, BAD = 2, 1.5
"""How often labels are placed again, and from which cost on."""
ORDER = {role: k for k, role in enumerate(("coordinate", "body", "input", "gravity", "stiffness", "damping"))}
"""Which labels are placed first."""
APART = 7.0
"""Letters on one line that are nearer than this [px] read as a product."""
FAR = 11.0
"""From which distance [px] on a label has a line to its place."""


def placed_labels(board: Board) -> list[Label]:
    """The labels of a board, each where it meets the least; one that found no room nearby has a line to its place.

    Labels are placed one after another, coordinates first; those that lie badly are placed again, knowing all others.
    Those that would lie on others all the same are left out, and the board says which.
    """
    ink = Ink(np.concatenate([np.array(board.segments, float).reshape(-1, 2, 2), _strokes(board)]))
    wishes = sorted(board.wishes, key=lambda w: (not w.inside, ORDER.get(w.role, len(ORDER))))
    given, boxes, costs = np.array(board.boxes, float).reshape(-1, 4), list[Box](), list[float]()
    for wish in wishes:
        box, cost = _best(wish, given, boxes, ink)
        boxes.append(box)
        costs.append(cost)
    for _ in range(ROUNDS):
        for k, wish in enumerate(wishes):
            if costs[k] > BAD:
                boxes[k], costs[k] = _best(wish, given, boxes[:k] + boxes[k + 1 :], ink)
    kept = [k for k, box in enumerate(boxes) if not _on_others(box, boxes[:k])]
    _say_left_out(board, [w for k, w in enumerate(wishes) if k not in set(kept)])
    wishes, boxes = [wishes[k] for k in kept], [boxes[k] for k in kept]
    for wish, box in zip(wishes, boxes, strict=True):
        _lead(board, wish, box, boxes)
    return [
        Label(w.names, (x + wide / 2, y + high / 2), w.role, w.elements, (x, y, wide, high), SIZE)
        for w, (x, y, wide, high) in zip(wishes, boxes, strict=True)
    ]


def _on_others(box: Box, others: list[Box]) -> bool:
    return bool(others) and bool((_overlaps(np.array(box), np.array(others)) > 0).any())


def _say_left_out(board: Board, wishes: list[Wish]) -> None:
    """Say which letters have no room, with the line that makes some."""
    names = list(dict.fromkeys(name for wish in wishes for name in wish.names))
    if names:
        shown = ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")
        first = next((x for wish in wishes for x in wish.elements), "")
        help_by = f'[look] hide = ["{first}"] makes room by leaving out what needs no letter' if first else ""
        board.lacks(f"there is no room for the letters {shown}", help_by)


class Ink:
    """Where lines (n, 2, 2) [px] are drawn, as small squares, of which any number is counted at once."""

    def __init__(self, lines: Array) -> None:
        lines = lines[np.isfinite(lines).all(axis=(1, 2))]
        spots = lines.reshape(-1, 2) if len(lines) else np.zeros((1, 2))
        self.low = spots.min(axis=0)
        size = spots.max(axis=0) - self.low
        self.side = max(2.0, float(size.max()) / 1000)
        counts = np.ceil(np.hypot(*(lines[:, 1] - lines[:, 0]).T) / self.side).astype(int) + 1
        of = np.repeat(np.arange(len(lines)), counts)
        along = (np.arange(len(of)) - (np.cumsum(counts) - counts)[of]) / np.maximum(counts - 1, 1)[of]
        at = lines[of, 0] + along[:, None] * (lines[of, 1] - lines[of, 0])
        shape = tuple(int(x) for x in size / self.side + 2)
        inked = np.zeros(shape)
        inked[tuple(((at - self.low) / self.side).astype(int).T)] = 1.0
        self.sums = np.zeros((shape[0] + 1, shape[1] + 1))
        self.sums[1:, 1:] = inked.cumsum(axis=0).cumsum(axis=1)

    def under(self, boxes: Array) -> Array:
        """How many squares with ink boxes (n, 4) cover."""
        most = np.array(self.sums.shape) - 1
        low = np.clip(((boxes[:, :2] - self.low) / self.side).astype(int), 0, most)
        high = np.clip(((boxes[:, :2] + boxes[:, 2:] - self.low) / self.side).astype(int) + 1, 0, most)
        sums = self.sums
        return sums[high[:, 0], high[:, 1]] - sums[low[:, 0], high[:, 1]] - sums[high[:, 0], low[:, 1]] + sums[*low.T]


def _strokes(board: Board) -> Array:
    """The straight lines (n, 2, 2) [px] of what is drawn, with curves as their chords; not the grid on the ground."""
    at = board.scale * (board.r[list(board.anchors)] @ board.view.T)
    found: list[tuple[Array, Array]] = []
    for part in board.parts:
        if part.kind in ("grid", "measure") or isinstance(part.shape, Disc):
            continue
        made = [(letter, numbers[-2:]) for letter, numbers in placed(part, at) if numbers.size]
        found += [(a, b) for (_, a), (letter, b) in itertools.pairwise(made) if letter != "M"]
    return np.array(found, float).reshape(-1, 2, 2)


def _lead(board: Board, wish: Wish, box: Box, boxes: list[Box]) -> None:
    """Draw a thin line from a label to its place if it is far away and nothing else that is written lies between."""
    (x, y, wide, high), near = box, np.array(wish.near)
    edge = np.clip(near, (x, y), (x + wide, y + high))
    way = near - edge
    far = float(np.hypot(*way)) - wish.distance
    if wish.inside or far < FAR:
        return
    start, end = edge + way * 2.0 / np.hypot(*way), near - way * min(wish.distance, 3.0) / np.hypot(*way)
    (a, b), (c, d) = start.tolist(), end.tolist()
    if any(crosses(other, (a, b), (c, d)) for other in boxes):
        return
    board.put(line((a, b), (c, d)), wish.role, of=wish.elements, kind="leader", width=0.7, layer=MEASURE, moves=False)


def _best(wish: Wish, given: Array, others: list[Box], ink: Ink) -> tuple[Box, float]:
    """The place of a label where it meets the least, and what it costs; one inside a body has its place."""
    width, height = width_of(wish.names, SIZE), SIZE * 1.15
    if wish.inside:
        return (wish.near[0] - width / 2, wish.near[1] - height / 2, width, height), 0.0
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
    if len(given):
        cost = cost + 6.0 * _overlaps(box, given).sum(axis=1)
    if others:
        met = np.array(others, float)
        wider = box + (-APART, height / 4, 2 * APART, -height / 2)
        cost = cost + 12.0 * _overlaps(box, met).sum(axis=1) + 0.7 * (_overlaps(wider, met) > 0).any(axis=1)
    covered = ink.under(box[:, 0])
    cost = cost + 2.0 * (covered > 0) + 0.3 * np.minimum(covered, 30)
    least = int(np.argmin(cost))
    return (float(x[least]) - width / 2, float(y[least]) - height / 2, width, height), float(cost[least])


def _overlaps(a: Array, b: Array) -> Array:
    """Whether boxes (…, 4) meet, and how much of the smaller one is covered: 0, or 0.3 to 1."""
    w, h = (
        np.minimum(a[..., k] + a[..., k + 2], b[..., k] + b[..., k + 2]) - np.maximum(a[..., k], b[..., k])
        for k in (0, 1)
    )
    least = np.maximum(1e-9, np.minimum(a[..., 2] * a[..., 3], b[..., 2] * b[..., 3]))
    return np.where((w > 0) & (h > 0), 0.3 + 0.7 * w * h / least, 0.0)


def crosses(box: Box, a: Pair, b: Pair) -> bool:
    """Whether a line meets a box (clipping by Liang and Barsky)."""
    low, high = 0.0, 1.0
    for k in range(2):
        step, near = b[k] - a[k], box[k] - a[k]
        far = near + box[k + 2]
        if abs(step) < 1e-12:
            if near > 0 or far < 0:
                return False
        else:
            low, high = max(low, min(near / step, far / step)), min(high, max(near / step, far / step))
    return low <= high
