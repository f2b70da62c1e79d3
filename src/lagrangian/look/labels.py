"""Finds places for labels where they meet nothing: the cheapest of many, by what they would lie on."""

from __future__ import annotations

from math import cos, pi, sin

from lagrangian.look.board import Board, Wish
from lagrangian.page.scene import Label, Pair
from lagrangian.write.scene_letters import width_of

Box = tuple[float, float, float, float]

SIZE = 15.0
DIRECTIONS, DISTANCES = 16, (0.0, 5.0, 12.0, 22.0, 36.0)


def placed_labels(board: Board) -> list[Label]:
    """The labels of a board, each where it meets the least."""
    boxes, labels = list(board.boxes), list[Label]()
    for wish in sorted(board.wishes, key=lambda w: not w.inside):
        width, height = width_of(wish.names, SIZE), SIZE * 1.15
        centre = wish.near if wish.inside else _best(wish, width, height, boxes, board.segments)
        box = (centre[0] - width / 2, centre[1] - height / 2, width, height)
        boxes.append(box)
        labels.append(Label(wish.names, centre, wish.role, wish.elements, box, SIZE))
    return labels


def _best(wish: Wish, width: float, height: float, boxes: list[Box], segments: list[tuple[Pair, Pair]]) -> Pair:
    size = (wish.away[0] ** 2 + wish.away[1] ** 2) ** 0.5 or 1.0
    ax, ay = wish.away[0] / size, wish.away[1] / size
    best, least = wish.near, float("inf")
    for extra in DISTANCES:
        for n in range(DIRECTIONS):
            angle = 2 * pi * n / DIRECTIONS
            dx, dy = cos(angle), sin(angle)
            reach = wish.distance + extra + abs(dx) * width / 2 + abs(dy) * height / 2
            centre = (wish.near[0] + reach * dx, wish.near[1] + reach * dy)
            box = (centre[0] - width / 2 - 1, centre[1] - height / 2 - 1, width + 2, height + 2)
            cost = 0.45 * (1 - dx * ax - dy * ay) + 0.055 * extra
            cost += sum(6.0 * _overlap(box, other) for other in boxes)
            cost += sum(2.5 for a, b in segments if crosses(box, a, b))
            if cost < least:
                best, least = centre, cost
    return best


def _overlap(a: Box, b: Box) -> float:
    """Whether two boxes meet, and how much of the smaller one is covered: 0, or 0.3 to 1."""
    w = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    h = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    if w <= 0 or h <= 0:
        return 0.0
    return 0.3 + 0.7 * w * h / max(1e-9, min(a[2] * a[3], b[2] * b[3]))


def crosses(box: Box, a: Pair, b: Pair) -> bool:
    """Whether a line meets a box (clipping by Liang and Barsky)."""
    low, high = 0.0, 1.0
    for k in range(2):
        step = b[k] - a[k]
        near, far = box[k] - a[k], box[k] + box[k + 2] - a[k]
        if abs(step) < 1e-12:
            if near > 0 or far < 0:
                return False
            continue
        first, last = sorted((near / step, far / step))
        low, high = max(low, first), min(high, last)
        if low > high:
            return False
    return True
