"""Draws strings over pulleys: their straight parts, the pulleys, and what these hang from."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import BODY, GROUND, JOINT, Board
from lagrangian.look.bodies import slide_heading
from lagrangian.look.cast import Player
from lagrangian.look.round_bodies import mass_names, unwinds
from lagrangian.look.shapes import INK, floor, line, turned
from lagrangian.look.string_layout import LOOP, Laid
from lagrangian.look.supports import sole_of
from lagrangian.page.scene import Disc, Placement

Array = NDArray[np.float64]

STRING = 1.6
"""The width of a string [px]."""
CEILING = 26.0
"""How far above a pulley the ceiling is [px]."""
DROP = 80.0
"""How far above a wheel that unwinds the ceiling is [px]."""
TABLE = 72.0
"""The height of the side of a table [px]."""


def draw_strings(board: Board, parts: list[Player], laid: list[Laid]) -> None:
    """Draw every string with its pulleys."""
    for one in laid:
        of = [part.name for part in parts for end in one.string.ends if part.point == end.point]
        for k, end in enumerate(one.string.ends):
            if end.along is None:
                continue  # the line that swings is drawn as what holds the mass
            if one.string.fold == 2 and k == 1:
                _loop(board, one, of)
            else:
                _straight(board, one, one.starts[k], end.point, one.ends[k], of)
        for centre in (one.centre,) if one.second is None else (one.centre, one.second):
            _pulley(board, parts, one, centre)
        if one.second is not None:
            _between(board, one, of)
        _hang(board, parts, one)


def draw_unwinding(board: Board, parts: list[Player]) -> None:
    """The strings of wheels that roll on one: from the point at rest on the rim, straight up to the ceiling."""
    for part in parts:
        i = board.motions.holds[part.point].along
        if part.radius is None or part.frame is None or i is None or not unwinds(board.motions, part):
            continue
        turn, moved = board.motions.angle_slopes(part.frame)[i], board.motions.views.J[0, part.point, 1, i]
        side = -1.0 if float(turn * moved) > 0 else 1.0  # there ω × r is the opposite of the centre's velocity
        radius = board.pixels(part.radius)
        start = board.at(part.point) + (side * radius, 0.0)
        top = start - (0.0, radius + DROP)
        base = board.stage.fixed(board.r[part.point].tolist())
        place = _towards(board, part.point, start, base, top)
        board.put(line((0.0, 0.0), (1.0, 0.0)), "rod", place, of=(part.name,), kind="rope", width=STRING)
        board.put(turned(floor(-26.0, 26.0), pi), "ground", _placed(board, base, top), kind="pin", layer=GROUND)
        board.fence(start, top)
        board.block(top, 52.0, 16.0)


def floor_ends(board: Board, parts: list[Player], laid: list[Laid]) -> dict[int, list[Array]]:
    """Where the floors of bodies end at a pulley [px], by the bodies' points."""
    found: dict[int, list[Array]] = {}
    for one in laid:
        if one.string.parallel or any(end.along is None for end in one.string.ends):
            continue
        for end in one.string.ends:
            part = next((x for x in parts if x.point == end.point), None)
            sole = None if part is None else sole_of(board, part)
            if part is None or sole is None:
                continue
            angle, normal = slide_heading(board, part)
            along = np.array([np.cos(angle), np.sin(angle)])
            foot = board.at(part.point) - sole * normal
            found.setdefault(part.point, []).append(foot + float((one.centre - foot) @ along) * along)
    return found


def _placed(board: Board, base: int, spot: Array) -> Placement:
    """Axes at a place of the screen that moves with a point."""
    x, y = spot - board.scale * (board.view @ board.r[base])
    return Placement(board.anchor(base), shift=(float(x), float(y)))


def _towards(board: Board, base: int, start: Array, other: int, end: Array) -> Placement:
    """Axes from a place that moves with one point to a place that moves with another one."""
    first, second = _placed(board, base, start), _placed(board, other, end)
    return Placement(first.at, second.at, "along", first.shift, second.shift)


def _straight(board: Board, one: Laid, start: Array, other: int, end: Array, of: list[str]) -> None:
    place = _towards(board, one.base, start, other, end)
    board.put(line((0.0, 0.0), (1.0, 0.0)), "rod", place, of=of, kind="rope", width=STRING, layer=BODY - 6)
    board.fence(start, end)


def _between(board: Board, one: Laid, of: list[str]) -> None:
    """The string from the top of one pulley to that of the next."""
    assert one.second is not None
    up = np.array([0.0, -one.radius])
    a, b = one.centre + up, one.second + up
    shape = line((0.0, 0.0), (float(b[0] - a[0]), float(b[1] - a[1])))
    board.put(shape, "rod", _placed(board, one.base, a), of=of, kind="rope", width=STRING, layer=BODY - 6)
    board.fence(a, b)


def _loop(board: Board, one: Laid, of: list[str]) -> None:
    """A body below a pulley that hangs in a loop of the string, whose end is fixed to the ceiling."""
    k, end, start = one.string.ends[1].point, one.ends[1], one.starts[1]
    side = 1.0 if start[0] > one.centre[0] else -1.0
    radius = abs(float(end[0] - start[0]))
    middle = end - (0.0, LOOP)
    board.put(
        Disc((0.0, 0.0), radius), "body", _placed(board, k, middle), of=of, kind="pulley", filled=True, layer=BODY - 1
    )
    board.put(Disc((0.0, 0.0), 2.6), "body", _placed(board, k, middle), of=of, kind="pulley", solid=True, layer=BODY)
    hook = line((0.0, 0.0), (0.0, LOOP))
    board.put(hook, "rod", _placed(board, k, middle), of=of, kind="rod", width=2.2, layer=BODY - 2)
    top = np.array([end[0] + side * radius, one.centre[1] - one.radius - CEILING])
    for a, b in ((start, middle - (side * radius, 0.0)), (top, middle + (side * radius, 0.0))):
        _straight(board, one, a, k, b, of)
    _ceiling(board, one, top)
    board.block(middle, 2 * radius, 2 * radius)


def _pulley(board: Board, parts: list[Player], one: Laid, centre: Array) -> None:
    """The circle of a pulley and its axle, unless a body with a frame is it and is drawn itself."""
    body = one.string.pulley
    if body is not None and body.frame is not None and body.radius is not None:
        return
    place = _placed(board, one.base, centre)
    of = () if body is None else (body.name,)
    board.put(Disc((0.0, 0.0), one.radius), "body", place, of=of, kind="pulley", filled=True, layer=BODY - 1)
    board.put(Disc((0.0, 0.0), 2.6), "body", place, of=of, kind="pulley", solid=True, layer=JOINT)
    board.block(centre, 2 * one.radius, 2 * one.radius)
    if body is not None:
        board.wish(mass_names(body), centre + (one.radius, 0.0), (1.0, -0.4), "body", of)


def _ceiling(board: Board, one: Laid, at: Array) -> None:
    board.put(turned(floor(-26.0, 26.0), pi), "ground", _placed(board, one.base, at), kind="pin", layer=GROUND)
    board.block(at, 52.0, 16.0)


def _hang(board: Board, parts: list[Player], one: Laid) -> None:
    """What a fixed pulley is held by: the ceiling above it, or the corner of the table beside it."""
    if one.base:
        return
    if one.string.parallel or one.second is not None:
        for centre in (one.centre,) if one.second is None else (one.centre, one.second):
            if any(end.along is None for end in one.string.ends) and centre is not one.centre:
                continue  # the support of what swings
            top = centre - (0.0, one.radius + CEILING)
            rod = line((0.0, 0.0), (0.0, one.radius + CEILING))
            board.put(rod, "rod", _placed(board, 0, top), kind="pin", width=2.0, layer=BODY - 3)
            _ceiling(board, one, top)
        return
    ends = floor_ends(board, parts, [one])
    upright = [end for end in one.string.ends if end.point not in ends]
    for (corner,) in ends.values():
        if np.linalg.norm(corner - one.centre) > 2.0:
            x, y = corner - one.centre
            rod = line((0.0, 0.0), (float(x), float(y)))
            board.put(rod, "rod", _placed(board, 0, one.centre), kind="pin", width=2.4, layer=BODY - 3)
        if upright:
            inward = float(np.sign(np.mean([board.at(k)[0] for k in ends]) - corner[0])) or -1.0
            shape = turned(floor(0.0, TABLE), pi / 2) if inward < 0 else turned(floor(-TABLE, 0.0), -pi / 2)
            board.put(shape, "ground", _placed(board, 0, corner), kind="wall", layer=GROUND)
            board.fence(corner, corner + (0.0, TABLE))
    if not ends and any(end.along is not None for end in one.string.ends):
        board.put(Disc((0.0, 0.0), 3.6), "ground", _placed(board, 0, one.centre), kind="pin", layer=JOINT, width=INK)
