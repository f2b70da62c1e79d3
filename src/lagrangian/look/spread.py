"""Moves bodies apart on the screen that would lie on one another, in the order in which springs join them."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import Board
from lagrangian.look.cast import BodyGlyph, Player, direction
from lagrangian.look.holds import HoldKind
from lagrangian.look.ties import Tie

Array = NDArray[np.float64]

ACROSS, UPWARD = 140.0, 92.0
"""The distance of the centres of two bodies on one line [px], on horizontal and on vertical lines."""


def spread(board: Board, parts: list[Player], ties: list[Tie], strung: set[int]) -> float | None:
    """Set the shifts of bodies on common lines, and return how far these can move [px] without meeting.

    Bodies at the points ``strung`` hang on strings and are not moved.
    """
    groups = _groups(board, [part for part in parts if part.point not in strung])
    room: float | None = None
    for group in groups:
        if len(group) < 2 or not _crowded(board, group):
            continue
        ordered = _ordered(group, ties)
        e = slide_along(board, ordered[0])
        gap = ACROSS if abs(e[0]) > 0.5 else UPWARD
        base = float(board.at(ordered[0].point) @ e)
        walls = [t for t in ties if t.way == "slides" and t.a is None and t.b == ordered[0].point]
        way = -wall_side(board, ordered[0], walls[0]) if walls else 1.0
        for n, part in enumerate(ordered):
            now = float(board.at(part.point) @ e)
            dx, dy = (base + way * n * gap - now) * e
            x, y = board.shifts.get(part.point, (0.0, 0.0))
            board.shifts[part.point] = (x + float(dx), y + float(dy))
        room = (gap - 62.0) / 2
    return room


def slide_along(board: Board, part: Player) -> Array:
    """The direction of a slide on the screen, to the right or, on a vertical line, upward."""
    hold = board.motions.holds[part.point]
    J = board.views.J[0]
    e = board.seen(direction(J[part.point] - J[hold.holder]))
    e = e / np.linalg.norm(e)
    return -e if e[0] < -1e-9 or (abs(e[0]) < 1e-9 and e[1] > 0) else e


def wall_side(board: Board, part: Player, tie: Tie) -> float:
    """On which side of a body the wall of a tie is: where the body comes from as the deflection grows.

    −1 is left or below, 1 right or above.
    """
    assert part.direction is not None
    grows = tie.sign * float(board.seen(part.direction) @ slide_along(board, part))
    return -1.0 if grows > 0 else 1.0


def _groups(board: Board, parts: list[Player]) -> list[list[Player]]:
    groups: list[list[Player]] = []
    for part in parts:
        hold = board.motions.holds[part.point]
        if hold.how is not HoldKind.SLIDE or part.glyph not in (
            BodyGlyph.CART,
            BodyGlyph.BLOCK,
            BodyGlyph.BALL,
            BodyGlyph.WHEEL,
        ):
            continue
        e = slide_along(board, part)
        for group in groups:
            other = slide_along(board, group[0])
            gap = board.at(part.point) - board.at(group[0].point)
            if abs(e @ other) > 0.9999 and abs(gap[0] * e[1] - gap[1] * e[0]) < 4.0:
                group.append(part)
                break
        else:
            groups.append([part])
    return groups


def _crowded(board: Board, group: list[Player]) -> bool:
    e = slide_along(board, group[0])
    spots = sorted(float(board.at(part.point) @ e) for part in group)
    return min(b - a for a, b in itertools.pairwise(spots)) < 100.0


def _ordered(group: list[Player], ties: list[Tie]) -> list[Player]:
    """From the body that is tied to the ground along the ties; in the order of the description where nothing ties."""
    points = [part.point for part in group]
    pairs = [(t.a, t.b) for t in ties if t.way in ("slides", "points") and t.b in points]
    grounded = [b for a, b in pairs if a not in points]
    upward = sorted(points, key=lambda k: (k not in grounded, points.index(k)))
    order: list[int] = []
    waiting = [upward[0]]
    while len(order) < len(points):
        if not waiting:
            waiting = [next(k for k in points if k not in order)]
        k = waiting.pop(0)
        if k in order:
            continue
        order.append(k)
        near = [b if a == k else a for a, b in pairs if k in (a, b)]
        waiting += [x for x in near if isinstance(x, int) and x in points and x not in order]
    return [group[points.index(k)] for k in order]
