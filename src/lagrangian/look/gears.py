"""Gears between a wheel and an arm, which turn about fixed centres in a ratio, each the other way.

The model says where both centres are, and that the wheel turns n times as far as the arm. With the distance d of the
centres, the radii are d/(1 + n) and n d/(1 + n).
"""

from __future__ import annotations

import itertools
from math import pi

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import BODY, Board
from lagrangian.look.cast import BodyGlyph, Player
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.look.shapes import INK, arc
from lagrangian.records import dataclass

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ArmGear:
    """A gear on an arm: the arm holds the point ``tip`` about the point ``joint``; ``ratio`` is −n, ``radius`` [m]."""

    wheel: Player
    joint: int
    tip: int
    ratio: float
    radius: sp.Expr


def arm_gears(motions: Motions, parts: list[Player]) -> list[ArmGear]:
    """The arms of a system in the plane that are geared to a wheel; the wheel takes the radius of its pitch circle."""
    found: list[ArmGear] = []
    if motions.stage.dimension == 3:
        return found
    for wheel in parts:
        if wheel.glyph is not BodyGlyph.DISC or wheel.frame is None or not motions.still(wheel.point):
            continue
        for part in parts:
            hold = motions.holds[part.point]
            if part is wheel or hold.how is not HoldKind.ROD or not motions.still(hold.holder):
                continue
            gear = _gear(motions, wheel, hold.holder, part.point)
            if gear is not None:
                found.append(gear)
                break
    return found


def _gear(motions: Motions, wheel: Player, joint: int, tip: int) -> ArmGear | None:
    d, D = motions.local(tip, joint, None)
    slopes = (d[:, 0, None] * D[:, 1] - d[:, 1, None] * D[:, 0]) / (d**2).sum(axis=1)[:, None]
    own, turn = motions.angle_slopes(wheel.frame or 0), slopes[0]
    square = float(turn @ turn)
    ratio = float(own @ turn) / square if square > 1e-18 else 0.0
    steady = float(np.ptp(slopes, axis=0).max()) < 1e-9 * max(float(np.abs(slopes).max()), 1e-12)
    if ratio >= 0 or not steady or not np.allclose(own, ratio * turn, atol=1e-9):
        return None
    gap = motions.length(wheel.point, joint)
    n = motions.named(-ratio) or (sp.Integer(round(-ratio)) if abs(ratio - round(ratio)) < 1e-9 else None)
    if n is None or gap == 0:
        return None
    wheel.radius = gap / (1 + n)
    return ArmGear(wheel, joint, tip, ratio, gap * n / (1 + n))


def draw_arm_gears(board: Board, gears: list[ArmGear]) -> None:
    """The pitch circle of every arm, which meets that of its wheel."""
    for gear in gears:
        of = [b.name for b in board.stage.model.bodies if board.stage.index(b.at) == gear.tip]
        circle = arc(board.pixels(gear.radius), 0.0, 2 * pi)
        board.put(circle, "rod", board.placed(gear.joint), of=of, kind="gear", width=INK, layer=BODY - 6)
        at, radius = board.at(gear.joint), board.pixels(gear.radius)
        turns = np.linspace(0.0, 2 * pi, 13)
        spots = [at + radius * np.array([np.cos(a), np.sin(a)]) for a in turns]
        for a, b in itertools.pairwise(spots):
            board.fence(a, b)
