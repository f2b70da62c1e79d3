"""Draws the shaft through discs that turn about one axis, seen from the side, and what is on it: springs, losses."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import BEHIND, GROUND, JOINT, TIE, Board
from lagrangian.look.shapes import floor, joined, line, lines, spiral, turned
from lagrangian.look.ties import Tie
from lagrangian.look.turning import Turn
from lagrangian.page.scene import Role

Array = NDArray[np.float64]

BEARING, END, JAW, RIM = 38.0, 66.0, 7.0, 34.0
"""How far a bearing and the end of the shaft are from the disc beside them, and half of a bearing's gap and of a disc's
height [px]."""
THIN = 4.0
"""Half of how thick a shaft is drawn [px]."""


def draw_shaft(board: Board) -> None:
    """The shaft through all discs, in bearings at both ends."""
    spots = [*board.shaft_spots.values()]
    if not spots:
        return
    y, xs = float(spots[0][1]), [float(s[0]) for s in spots]
    left, right = min(xs), max(xs)
    board.put(line((left - 56.0, y), (right + 56.0, y)), "thin", kind="axis", width=0.9, layer=BEHIND)
    for side in (-THIN, THIN):
        board.put(line((left, y + side), (right, y + side)), "rod", kind="shaft", width=1.4, layer=BEHIND)
    for x in (left - BEARING, right + BEARING):
        for side, angle in ((-JAW, pi), (JAW, 0.0)):
            board.put(turned(floor(-12.0, 12.0), angle, x, y + side), "ground", kind="bearing", layer=GROUND)
        board.block((x, y), 26, 30)


def on_shaft(board: Board, tie: Tie, turn: Turn, names: tuple[str, ...], role: Role) -> None:
    """A spring or losses in the piece of shaft between two discs, or between a disc and the ground."""
    spot = board.shaft_spots[turn.name]
    if isinstance(tie.a, Turn) and tie.a.name in board.shaft_spots:
        a, b = sorted((board.shaft_spots[tie.a.name], spot), key=lambda s: float(s[0]))
        _between(board, tie, a, b, names, role)
        return
    xs = [float(s[0]) for s in board.shaft_spots.values()]
    side = 1.0 if spot[0] == max(xs) else -1.0 if spot[0] == min(xs) else 0.0
    if tie.element.kind == "spring":
        at = spot + (END * side, 0.0)
        board.put(turned(spiral(10.0), 0.0, *_pair(at)), role, of=(tie.element.name,), kind="spring", layer=JOINT)
        wall = turned(floor(-16.0, 16.0), -pi / 2 * side, *_pair(at + (10.0 * side, 0.0)))
        board.put(wall, "ground", kind="wall", layer=GROUND)
        board.block(at, 20.0, 20.0)
    elif side:
        at = spot + (BEARING * side, 0.0)
        _rubbing(board, tie, at, JAW - 2.5, 12.0, role)
    else:  # a shoe on the rim of a disc between others
        at = spot - (0.0, RIM + 3.0)
        board.put(turned(floor(-12.0, 12.0), pi, *_pair(at - (0.0, 3.0))), "ground", kind="bearing", layer=GROUND)
        _rubbing(board, tie, at, 0.0, 8.0, role)
    board.block(at, 26.0, 14.0)
    board.wish(names, at + (0.0, 10.0 if side else 0.0), (0.2, 1.0 if side else -1.0), role, (tie.element.name,))


def _between(board: Board, tie: Tie, a: Array, b: Array, names: tuple[str, ...], role: Role) -> None:
    """What is in the shaft itself: hatching for a spring, a thick dashed line for losses."""
    of, y = (tie.element.name,), float(a[1])
    twisted = tie.element.kind == "spring"
    if twisted:
        hatch = [((x, y + THIN), (x + 5.0, y - THIN)) for x in np.arange(a[0] + 14, b[0] - 28, 8.0)]
        board.put(lines(*hatch), role, of=of, kind="spring", width=1.2, layer=TIE + 1)
    else:
        _rubbing(board, tie, (a + b) / 2 - (7.0, 0.0), THIN + 3.0, (b[0] - a[0]) / 2 - 21, role)
    board.block((a + b) / 2, float(b[0] - a[0]) - 20, 2 * THIN + 8)
    board.wish(names, (a + b) / 2, (0.0, -1.0 if twisted else 1.0), role, of, distance=THIN + 8.0)


def _rubbing(board: Board, tie: Tie, at: Array, apart: float, half: float, role: Role) -> None:
    """Thick dashed lines on both sides of a place, along the shaft."""
    (x, y), kind = _pair(at), tie.element.kind
    sides = (-apart, apart) if apart else (0.0,)
    shape = joined(*(line((x - half, y + s), (x + half, y + s)) for s in sides))
    board.put(shape, role, of=(tie.element.name,), kind=kind, width=3.0, dashed=True, layer=TIE)


def _pair(v: Array) -> tuple[float, float]:
    return float(v[0]), float(v[1])
