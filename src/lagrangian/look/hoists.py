"""Loads on strings over a wheel at rest; what ties such a load to the ground hangs on the wheel's other side.

A model says nothing of the string. What it says is that a body moves along a vertical line by R φ, where φ turns a
wheel about its fixed centre and R is a parameter, while no other body moves with it.
"""

from __future__ import annotations

from math import pi

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import BODY, GROUND, TIE, Board
from lagrangian.look.cast import BodyGlyph, Player
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.look.shapes import BLOCK, coil, dashpot, floor, line, turned
from lagrangian.look.strings import HUNG, PulleyString, down_of
from lagrangian.look.tie_glyphs import ROLES, symbol_names
from lagrangian.look.ties import Tie
from lagrangian.page.scene import Placement
from lagrangian.records import dataclass

Array = NDArray[np.float64]

DEEP, HIGH, TIED, CEILING = 105.0, 42.0, 80.0, 26.0
"""How far below a wheel a load hangs at least, a tie begins, how long a tie is, how high the ceiling is [px]."""
STRING, APART = 1.6, 20.0


@dataclass(frozen=True, eq=False)
class Hoist:
    """A load on a wheel: ``side`` is 1 where its string is on the wheel's right; ``down`` (2,) is a unit vector."""

    load: Player
    wheel: Player
    side: float
    down: Array


def hoists_of(motions: Motions, parts: list[Player], strings: list[PulleyString]) -> list[Hoist]:
    """The loads of a system in the plane that hang on a wheel alone; such wheels become pulleys of that radius."""
    down = down_of(motions)
    if down is None or motions.stage.dimension == 3:
        return []
    used = {end.point for x in strings for end in x.ends}
    taken = {x.pulley.name for x in strings if x.pulley is not None}
    found: list[Hoist] = []
    for wheel in parts:
        if wheel.glyph not in (BodyGlyph.PULLEY, BodyGlyph.DISC) or wheel.frame is None or wheel.name in taken:
            continue
        for load in parts:
            wound = None if load.glyph not in HUNG or load.point in used else _wound(motions, load, wheel, down)
            if wound is not None:
                wheel.glyph, wheel.radius = BodyGlyph.PULLEY, wound[1]
                found.append(Hoist(load, wheel, wound[0], down))
                break
    return found


def _wound(motions: Motions, load: Player, wheel: Player, down: Array) -> tuple[float, sp.Expr] | None:
    """The side of a wheel on which a load hangs that moves by R times its turn, and R, if that is a parameter."""
    hold = motions.holds[load.point]
    if hold.how is not HoldKind.SLIDE or not motions.still(hold.holder) or not motions.still(wheel.point):
        return None
    if load.direction is None or abs(float(load.direction @ down)) < 1 - 1e-9:
        return None
    fall, turn = down @ motions.views.J[0, load.point], motions.angle_slopes(wheel.frame or 0)
    square = float(turn @ turn)
    ratio = float(fall @ turn) / square if square > 1e-18 else 0.0
    radius = motions.named(abs(ratio)) if ratio and np.allclose(fall, ratio * turn, atol=1e-9) else None
    if radius is None:
        return None
    return (1.0 if ratio < 0 else -1.0), radius  # what turns counter-clockwise takes up what hangs on its right


def lay_hoists(board: Board, hoists: list[Hoist]) -> None:
    """Move loads below the sides of their wheels."""
    for one in hoists:
        centre, down = board.at(one.wheel.point), board.seen(one.down)
        spot = board.at(one.load.point)
        across = np.array([down[1], -down[0]])
        lack = max(0.0, _radius(board, one) + DEEP - float((spot - centre) @ down))
        by = (one.side * _radius(board, one) - float((spot - centre) @ across)) * across + lack * down
        x, y = board.shifts.get(one.load.point, (0.0, 0.0))
        board.shifts[one.load.point] = (x + float(by[0]), y + float(by[1]))


def draw_hoists(board: Board, hoists: list[Hoist], ties: list[Tie]) -> list[Tie]:
    """Draw the strings of loads, what holds their wheels, and their ties to the ground; return the other ties."""
    rest = list(ties)
    for one in hoists:
        k, centre, down = one.load.point, board.at(one.wheel.point), board.seen(one.down)
        across, radius = np.array([down[1], -down[0]]), _radius(board, one)
        base = board.stage.fixed(board.r[one.wheel.point].tolist())
        rim = centre + one.side * radius * across
        _rope(board, _from(board, base, rim), _from(board, k, board.at(k) - BLOCK[1] / 2 * down), (one.load.name,))
        top = centre - (radius + CEILING) * down
        board.put(
            line((0.0, 0.0), (0.0, radius + CEILING)),
            "rod",
            _axes(board, base, top),
            kind="pin",
            width=2.0,
            layer=BODY - 3,
        )
        _ground(board, base, top, pi)
        own = [
            t for t in rest if t.way == "slides" and t.a is None and t.b == k and t.element.kind in ("spring", "damper")
        ]
        rest = [t for t in rest if t not in own]
        if own:
            _tied(board, one, base, centre - one.side * radius * across, own)
    return rest


def _tied(board: Board, one: Hoist, base: int, rim: Array, ties: list[Tie]) -> None:
    """Ties side by side to the ground from the string's other end, which moves as far as the load, the other way."""
    position = board.stage.model.position
    there, now = position(board.stage.points[one.load.point]), board.r[one.load.point]
    centre = board.r[one.wheel.point]
    mirror = board.stage.add(0, [sp.Float(float(c + x), 17) - y for c, x, y in zip(centre, now, there, strict=True)])
    down = board.seen(one.down)
    across = np.array([down[1], -down[0]])
    end = rim + (HIGH + _radius(board, one)) * down
    _rope(board, _from(board, base, rim), _from(board, mirror, end), (one.load.name,))
    if len(ties) > 1:
        half = (len(ties) - 1) / 2 * APART
        beam = line((-half, 0.0), (half, 0.0))
        board.put(beam, "rod", _axes(board, mirror, end), kind="rod", width=2.4, layer=BODY)
    for n, tie in enumerate(ties):
        off = (n - (len(ties) - 1) / 2) * APART
        start, foot = end + off * across, end + off * across + TIED * down
        a, b = _from(board, mirror, start), _from(board, base, foot)
        shape = coil(6) if tie.element.kind == "spring" else dashpot()
        of, kind = (tie.element.name,), tie.element.kind
        place = Placement(a[0], b[0], "along", a[1], b[1])
        board.put(shape, ROLES[kind], place, of=of, kind=kind, width=1.7, layer=TIE)
        board.fence(start, foot)
        n_ = -one.side * across if off == 0 else float(np.sign(off)) * across
        board.wish(symbol_names(tie.element), (start + foot) / 2, n_, ROLES[kind], of, distance=12.0)
    _ground(board, base, end + TIED * down, 0.0)


def _radius(board: Board, one: Hoist) -> float:
    assert one.wheel.radius is not None
    return board.pixels(one.wheel.radius)


def _from(board: Board, k: int, spot: Array) -> tuple[int, tuple[float, float]]:
    """A place of the screen that moves with a point, as the point's anchor and a shift."""
    x, y = spot - board.scale * (board.view @ board.r[k])
    return board.anchor(k), (float(x), float(y))


def _axes(board: Board, k: int, spot: Array) -> Placement:
    anchor, shift = _from(board, k, spot)
    return Placement(anchor, shift=shift)


def _rope(
    board: Board, a: tuple[int, tuple[float, float]], b: tuple[int, tuple[float, float]], of: tuple[str, ...]
) -> None:
    place = Placement(a[0], b[0], "along", a[1], b[1])
    board.put(line((0.0, 0.0), (1.0, 0.0)), "rod", place, of=of, kind="rope", width=STRING, layer=BODY - 6)


def _ground(board: Board, base: int, spot: Array, angle: float) -> None:
    board.put(turned(floor(-26.0, 26.0), angle), "ground", _axes(board, base, spot), kind="wall", layer=GROUND)
    board.block(spot, 52.0, 16.0)
