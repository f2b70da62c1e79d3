"""Draws bodies, the rods that hold them, the supports of these, and the floors on which bodies slide."""

from __future__ import annotations

from math import pi

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import BODY, JOINT, Board
from lagrangian.look.cast import FLAT, BodyGlyph, Player, direction
from lagrangian.look.holds import HoldKind
from lagrangian.look.round_bodies import COG, cog, draw_wheel, mass_names
from lagrangian.look.shapes import (
    BAR,
    BLOCK,
    BOB,
    CART,
    INK,
    WHEEL,
    arc,
    box,
    heading,
    line,
    turned,
)
from lagrangian.page.scene import Disc, Trace

Array = NDArray[np.float64]

TURNING = (HoldKind.ROD, HoldKind.TELESCOPE)


def draw_bodies(board: Board, parts: list[Player]) -> None:
    """Draw every body as what it was cast."""
    for part in parts:
        if part.glyph is not BodyGlyph.NONE:
            if part.radius is not None or part.glyph is not BodyGlyph.PULLEY:  # others are drawn with their string
                DRAWERS[part.glyph](board, part)
            board.handles.append(board.anchor(part.point))


def slide_heading(board: Board, part: Player) -> tuple[float, Array]:
    """The angle on the screen of what a body slides on, between −90° and 90°, and the outward normal (upward)."""
    assert part.direction is not None
    hold = board.motions.holds[part.point]
    views = board.views
    e = board.seen(direction(views.J[0, part.point] - views.J[0, hold.holder]))
    angle = heading((float(e[0]), float(e[1])))
    angle = (angle + pi / 2) % pi - pi / 2
    return angle, np.array([np.sin(angle), -np.cos(angle)])


# -- one function a glyph -------------------------------------------------------------------------------------------


def _ball(board: Board, part: Player) -> None:
    of = (part.name,)
    board.put(Disc((0.0, 0.0), BOB), "body", board.placed(part.point), of=of, kind="ball", filled=True, layer=BODY + 2)
    at = board.at(part.point)
    board.block(at, 2 * BOB, 2 * BOB)
    board.wish(mass_names(part), at, (1.0, 0.25), "body", of, distance=BOB + 4)


def _cart(board: Board, part: Player) -> None:
    of, (w, h) = (part.name,), CART
    place = board.placed(part.point)
    board.put(box(w, h, round_by=4.0), "body", place, of=of, kind="cart", filled=True, layer=BODY)
    for x in (-w / 4, w / 4):
        board.put(Disc((x, h / 2 + WHEEL - 2), WHEEL), "body", place, of=of, kind="cart", filled=True, layer=BODY + 1)
    at = board.at(part.point)
    board.block(at + (0, 5), w, h + 10)
    hinged = any(h.holder == part.point and h.how in TURNING for h in board.motions.holds)
    spot = at - (w / 4, 0.0) if hinged or part.point in board.pinned else at
    board.wish(mass_names(part), spot, (0.0, 0.0), "body", of, inside=True)


def _block(board: Board, part: Player) -> None:
    of, (w, h) = (part.name,), BLOCK
    place, at = board.placed(part.point), board.at(part.point)
    if part.direction is not None:
        angle, _ = slide_heading(board, part)
        if abs(np.sin(angle)) < 1 - FLAT:  # on a slope: it lies on the line through its point
            shape = turned(box(44.0, h, y=-h / 2, round_by=3.0), angle)
            board.put(shape, "body", place, of=of, kind="block", filled=True)
            middle = at + h / 2 * np.array([np.sin(angle), -np.cos(angle)])
            board.block(middle, 50, 34)
            board.wish(mass_names(part), middle, (0, 0), "body", of, inside=True)
            return
    board.put(box(w, h, round_by=3.0), "body", place, of=of, kind="block", filled=True)
    board.block(at, w, h)
    spot = at - (w / 4, 0.0) if part.point in board.pinned else at
    board.wish(mass_names(part), spot, (0.0, 0.0), "body", of, inside=True)


def _wedge(board: Board, part: Player) -> None:
    """A triangle with the slope of what slides on it, its top at the body's point, or its foot if that moves upward."""
    of, stage = (part.name,), board.stage
    J = board.views.J[0]
    rider = next(k for k in range(len(stage.points)) if _on_slope(board, k, part))
    e = board.seen(direction(J[rider] - J[part.point]))
    if e[1] < 0:
        e = -e
    slope = float(abs(e[1] / e[0])) if e[0] else 1.0
    width = 175.0 if slope < 0.75 else 130.0 / max(slope, 0.3)
    height = slope * width
    sense = 1.0 if e[0] > 0 else -1.0
    climbs = float(board.seen(board.r[rider] - board.r[part.point])[1]) < -1e-9
    x, y = (-0.88 * sense * width, -0.88 * height) if climbs else (0.0, 0.0)
    shape = line((x, y), (x, y + height), (x + sense * width, y + height), closed=True)
    board.put(shape, "body", board.placed(part.point), of=of, kind="wedge", filled=True, layer=BODY - 2)
    at = board.at(part.point) + (x, y)
    board.fence(at, at + (sense * width, height))
    board.fence(at + (0, height), at + (sense * width, height))
    board.wish(mass_names(part), at + (sense * width * 0.28, height * 0.72), (0, 0), "body", of, inside=True)
    J = board.motions.views.J[0]
    name = board.motions.slope_name(direction(J[rider] - J[part.point]))
    slope_angle(board, at + (sense * width, height), pi if sense > 0 else 0.0, heading((-e[0], -e[1])), name)
    board.sole[part.point] = y + height
    board.faces[part.point] = (x, y + height / 2, -sense)


def _on_slope(board: Board, k: int, part: Player) -> bool:
    """Whether a point slides along a wedge, in another direction than the wedge itself and not across it."""
    hold = board.motions.holds[k]
    if k == part.point or hold.holder != part.point or hold.how is not HoldKind.SLIDE or part.direction is None:
        return False
    J = board.views.J[0]
    return FLAT < abs(float(direction(J[k] - J[part.point]) @ part.direction)) < 0.999


def slope_angle(board: Board, corner: Array, start: float, end: float, name: str) -> None:
    """The arc of a slope's angle, with the name of the parameter that it is."""
    if not name:
        return
    turn = (end - start + pi) % (2 * pi) - pi
    shape = turned(arc(34.0, 0.0, turn), start, float(corner[0]), float(corner[1]))
    board.put(shape, "thin", kind="angle", layer=JOINT, moves=False, width=1.0)
    middle = start + turn / 2
    out = np.array([np.cos(middle), np.sin(middle)])
    board.wish((name,), corner + 34.0 * out, out, "thin", distance=3.0)


def _link(board: Board, part: Player) -> None:
    """A capsule between its farthest points; one that ends at its centre of mass goes on as far again."""
    assert part.spine is not None
    a, b = part.spine
    holder = board.motions.holds[part.point].holder
    if part.point in (a, b) and holder in (a, b) and holder != part.point:
        joint = b if part.point == a else a
        position, start = board.stage.model.position, board.stage.points
        gap = [2 * (x - y) for x, y in zip(position(start[part.point]), position(start[joint]), strict=True)]
        a, b = joint, board.stage.add(joint, gap)
    draw_bar(board, a, b, part)
    cog(board, part, COG)
    middle = board.at(part.point)
    e = board.at(b) - board.at(a)
    board.wish(
        mass_names(part),
        middle,
        (-e[1], e[0]) if e[0] < 0 else (e[1], -e[0]),
        "body",
        (part.name,),
        distance=BAR / 2 + 3,
    )
    board.tips[part.point] = b
    _lengths(board, part, e)


def _lengths(board: Board, part: Player, e: Array) -> None:
    """The names of a link's lengths: to its centre of mass along a thin line, to its other joints beside it."""
    holder, k = board.motions.holds[part.point].holder, part.point
    if holder not in part.points:
        return
    reach = board.motions.length(holder, k)
    name = reach.name if isinstance(reach, sp.Symbol) else ""
    side = -1.0 if e[0] > 0 else 1.0
    if name:
        board.measure(holder, k, name, side * (BAR / 2 + 8.0))
    for other in part.points:
        length = board.motions.length(holder, other)
        if other != holder and isinstance(length, sp.Symbol):
            middle = (board.at(holder) + board.at(other)) / 2
            n = side * np.array([-e[1], e[0]])
            board.wish((length.name,), middle, n, "thin", (part.name,), distance=BAR / 2 + (14.0 if name else 4.0))


def draw_bar(board: Board, a: int, b: int, part: Player) -> None:
    """A rigid bar between two points."""
    of, place = (part.name,), board.towards(a, b)
    shape = line((0.0, 0.0), (1.0, 0.0))
    board.put(shape, "body", place, of=of, kind="link", width=BAR, layer=BODY)
    board.put(shape, "body", place, of=of, kind="link", width=BAR - 2 * INK, layer=BODY, inside=True)
    start, end = board.at(a), board.at(b)
    e = (end - start) / (np.linalg.norm(end - start) or 1.0)
    n = BAR / 2 * np.array([-e[1], e[0]])
    board.fence(start + n, end + n)
    board.fence(start - n, end - n)


def _plate(board: Board, part: Player) -> None:
    """The hull of its points, with round corners."""
    of = (part.name,)
    everything = [part.point, *part.points]
    spots = np.array([board.at(k) for k in everything])
    order = hull(spots)
    anchors = tuple(board.anchor(everything[i]) for i in order)
    shape = Trace(anchors, True, tuple(board.shift(everything[i]) for i in order))
    board.put(shape, "body", of=of, kind="plate", width=12.0, layer=BODY)
    board.put(shape, "body", of=of, kind="plate", width=12.0 - 2 * INK, filled=True, layer=BODY, inside=True)
    for i, j in zip(order, [*order[1:], order[0]], strict=True):
        board.fence(spots[i], spots[j])
    cog(board, part, COG)
    board.wish(mass_names(part), board.at(part.point), (1.0, 0.5), "body", of, distance=COG + 4)


def hull(points: Array) -> list[int]:
    """The convex hull of points on the screen, counter-clockwise: the numbers of its corners."""
    order = sorted(range(len(points)), key=lambda i: (points[i, 0], points[i, 1]))

    def half(numbers: list[int]) -> list[int]:
        out: list[int] = []
        for i in numbers:
            while len(out) > 1 and _turn(points[out[-2]], points[out[-1]], points[i]) <= 0:
                out.pop()
            out.append(i)
        return out[:-1]

    return half(order) + half(order[::-1])


def _turn(a: Array, b: Array, c: Array) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _bar(board: Board, part: Player) -> None:
    """A free rigid body: a bar as long as a rod with its inertia, √(12 J/m), along its x axis."""
    assert part.frame is not None
    stage = board.stage
    half = sp.sqrt(3 * part.body.tensor[0][0] / part.body.mass)
    frame = stage.frames[part.frame]
    a = stage.add(part.point, (half, 0), frame)
    b = stage.add(part.point, (-half, 0), frame)
    draw_bar(board, b, a, part)
    cog(board, part, COG)
    e = board.at(a) - board.at(b)
    board.wish(mass_names(part), board.at(part.point), (e[1], -e[0]), "body", (part.name,), distance=BAR / 2 + 3)
    board.tips[part.point] = a


def _beam(board: Board, part: Player) -> None:
    """What something runs along: a bar about its centre, long enough for what runs on it."""
    assert part.frame is not None
    stage, frame = board.stage, board.stage.frames[part.frame]
    frames = [
        None if p.frame is None else stage.frames.index(p.frame) for p in stage.points[: len(board.motions.holds)]
    ]
    lengths = (HoldKind.TRACK, HoldKind.TELESCOPE)
    runner = next(h.point for h in board.motions.holds if h.how in lengths and frames[h.point] == part.frame)
    _, X = board.motions.local(runner, part.point, part.frame)
    i = board.motions.holds[runner].along
    assert i is not None
    e = X[0, :, i] / np.linalg.norm(X[0, :, i])
    half = 1.6 * max(abs(float(board.q[i])), 1e-3)
    a = stage.add(part.point, [sp.Float(-half * x) for x in e], frame)
    b = stage.add(part.point, [sp.Float(half * x) for x in e], frame)
    of, shape = (part.name,), line((0.0, 0.0), (1.0, 0.0))
    below = board.at(b) - board.at(a)
    n = 4.0 * np.array([-below[1], below[0]]) / np.linalg.norm(below)
    n = n if n[1] > 0 else -n
    place = board.towards(a, b)
    board.put(shape, "body", place, of=of, kind="beam", width=8.0, layer=BODY - 4)
    board.put(shape, "body", place, of=of, kind="beam", width=8.0 - 2 * INK, layer=BODY - 4, inside=True)
    board.fence(board.at(a), board.at(b))
    board.wish(mass_names(part), board.at(a), (-0.3, 1.0), "body", of, distance=8.0)
    board.tips[part.point] = b


def _shaft(board: Board, part: Player) -> None:
    """One of several discs on a common axle, seen from the side; what turns is told by its arrow."""
    x = 100.0 * len(board.shaft_spots)
    of = (part.name,)
    place = board.placed(part.point, x, 0.0)
    board.put(box(15.0, 68.0, round_by=2.0), "body", place, of=of, kind="disc", filled=True, layer=BODY)
    at = board.at(part.point) + (x, 0.0)
    board.block(at, 15.0, 68.0)
    names = mass_names(part)[-1:]
    board.wish(names, at + (0, -34.0), (0.0, -1.0), "body", of, distance=4.0)
    board.shaft_spots[part.body.name] = at


DRAWERS = {
    BodyGlyph.BALL: _ball,
    BodyGlyph.CART: _cart,
    BodyGlyph.BLOCK: _block,
    BodyGlyph.WEDGE: _wedge,
    BodyGlyph.WHEEL: draw_wheel,
    BodyGlyph.PULLEY: draw_wheel,
    BodyGlyph.LINK: _link,
    BodyGlyph.PLATE: _plate,
    BodyGlyph.DISC: draw_wheel,
    BodyGlyph.SHAFT: _shaft,
    BodyGlyph.BEAM: _beam,
    BodyGlyph.BAR: _bar,
}
"""A function for every glyph of the plane."""
