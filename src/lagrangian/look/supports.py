"""Rods, ropes and wires that hold points, joints, supports on the ground, and floors."""

from __future__ import annotations

import itertools
from math import pi

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import BEHIND, BODY, GROUND, JOINT, Board
from lagrangian.look.bodies import slide_heading, slope_angle
from lagrangian.look.cast import BodyGlyph, Player, direction
from lagrangian.look.couplers import couplers
from lagrangian.look.driven import driven, driven_round
from lagrangian.look.holds import HoldKind
from lagrangian.look.round_bodies import unwinds
from lagrangian.look.shapes import CART, INK, WHEEL, arc, floor, line, pin, turned
from lagrangian.look.ties import Tie
from lagrangian.page.scene import Disc, Placement, Trace

Array = NDArray[np.float64]

SOLE = CART[1] / 2 + 2 * WHEEL - 2
"""How far the floor is below the point of a cart [px]."""

WALL = 92.0
"""How far a wall is from the edge of the body that is tied to it [px]."""

MARGIN = 62.0
"""How far a floor reaches beyond the bodies on it [px]."""

LINKS = (BodyGlyph.LINK, BodyGlyph.PLATE, BodyGlyph.BAR, BodyGlyph.BEAM)

ROUND = (BodyGlyph.WHEEL, BodyGlyph.DISC, BodyGlyph.PULLEY)
"""Bodies at whose centre a rod lies in front of them."""


def draw_supports(board: Board, parts: list[Player], ties: list[Tie], ends: dict[int, list[Array]]) -> None:
    """Draw what holds the bodies; ``ends`` are the places [px] where the floors of some end, by their points."""
    needed = _needed(board, parts)
    springs = {t.b for t in ties if t.way == "telescope" and t.element.kind == "spring"}
    rods: list[tuple[int, int]] = []
    for k in needed:
        hold = board.motions.holds[k]
        if hold.how not in (HoldKind.ROD, HoldKind.TELESCOPE) or _within_body(parts, k, hold.holder):
            continue
        if any(part.point == k and part.glyph is BodyGlyph.WHEEL for part in parts):
            continue  # it rolls on a circle
        if hold.how is HoldKind.TELESCOPE and k in springs:
            rods.append((hold.holder, k))
            continue
        _rod(board, parts, hold.holder, k, rope=hold.how is HoldKind.TELESCOPE)
        rods.append((hold.holder, k))
    _brackets(board, parts, rods)
    for a, b in couplers(board.motions, parts):
        _rod(board, parts, a, b)
        rods += [(a, b), (b, a)]
    for k in (part.point for part in parts):
        hold, moved = board.motions.holds[k], board.motions.coordinates(k)
        if hold.how is HoldKind.FIRMLY and moved and hold.holder and not driven_round(board, k, hold.holder):
            driven(board, k)
    _wires(board, parts)
    _joints(board, parts, rods)
    _floors(board, parts, ends)


def _needed(board: Board, parts: list[Player]) -> list[int]:
    """The points of bodies and elements, and all that hold them."""
    stage, found = board.stage, set[int]()
    waiting = [part.point for part in parts]
    for element in stage.model.elements:
        waiting += [stage.index(point) for _, point in element.points()]
    while waiting:
        k = waiting.pop()
        if k in found or k >= len(board.motions.holds):
            continue
        found.add(k)
        waiting.append(board.motions.holds[k].holder)
    return sorted(found)


def _within_body(parts: list[Player], a: int, b: int) -> bool:
    """Whether two points belong to one rigid body, which is drawn itself."""
    return any(part.frame is not None and {a, b} <= {part.point, *part.points} for part in parts)


def _rod(board: Board, parts: list[Player], a: int, b: int, *, rope: bool = False) -> None:
    start, end = board.at(a), board.at(b)
    if np.linalg.norm(end - start) < 1.0:
        return
    names = [e.name for e in board.stage.model.bodies if board.stage.index(e.at) == b]
    round_at = any(x.point == a and x.glyph in ROUND for x in parts)
    board.put(
        line((0.0, 0.0), (1.0, 0.0)), "rod", board.towards(a, b), of=names, kind="rope" if rope else "rod",
        width=1.6 if rope else 3.0, layer=BODY + 1 if round_at else BODY - 5,
    )  # fmt: skip
    board.fence(start, end)
    length = board.motions.length(a, b)
    if isinstance(length, sp.Symbol) and not rope:
        n = np.array([end[1] - start[1], start[0] - end[0]])
        n = n if n[0] > 0 or (n[0] == 0 and n[1] < 0) else -n
        board.wish((length.name,), (start + end) / 2, n, "thin", names, distance=4.0)


def _brackets(board: Board, parts: list[Player], rods: list[tuple[int, int]]) -> None:
    """From a body without joints of its own to a rod that hangs beside it."""
    for k in dict.fromkeys(a for a, _ in rods):
        owners = [x for x in parts if x.frame is None and x.point != k and not board.motions.coordinates(k, x.point)]
        owner = next((x for x in owners if board.motions.coordinates(k)), None)
        if owner is None or np.linalg.norm(board.at(k) - board.at(owner.point)) < CART[0] / 2:
            continue
        place = board.towards(owner.point, k)
        board.put(line((0.0, 0.0), (1.0, 0.0)), "body", place, of=(owner.name,), kind="rod", width=5.0, layer=BODY - 4)
        board.fence(board.at(owner.point), board.at(k))


def _wires(board: Board, parts: list[Player]) -> None:
    """The path of what moves along a curve."""
    stage = board.stage
    for part in parts:
        hold = board.motions.holds[part.point]
        if hold.how is not HoldKind.WIRE or hold.along is None:
            continue
        i, q0 = hold.along, float(board.q[hold.along])
        reach = 1.8 * max(abs(q0), 0.5)
        states: list[Array] = []
        for x in np.linspace(-reach, reach, 41):
            q = board.q.copy()
            q[i] = x
            states.append(q)
        path = stage.views(states, board.p).r[:, part.point]
        if not np.isfinite(path).all():
            continue
        anchors = [board.anchor(stage.fixed(r)) for r in path]
        board.put(Trace(tuple(anchors)), "rod", kind="wire", width=2.0, layer=BEHIND)
        spots = board.scale * path @ board.view.T
        for a, b in itertools.pairwise(spots):
            board.fence(a, b)


# -- joints and supports --------------------------------------------------------------------------------------------


def _joints(board: Board, parts: list[Player], rods: list[tuple[int, int]]) -> None:
    """A small circle where something turns about a point; a support where that point does not move."""
    hung: dict[int, list[Array]] = {}
    holds = board.motions.holds
    for a, b in rods:
        if board.motions.in_line(holds[a], holds[b]) is None or holds[b].holder != a or a == holds[a].holder:
            hung.setdefault(a, []).append(board.at(b) - board.at(a))
    for part in parts:
        if part.frame is None or part.glyph not in LINKS or not board.motions.turns(part.frame):
            continue
        centre = (part.point,) if board.motions.still(part.point) else ()
        for k in (*part.points, *centre):
            if _is_joint(board, parts, part, k):
                hung.setdefault(k, []).append(board.at(part.point) - board.at(k))
    for k, directions in hung.items():
        at = board.at(k)
        if board.motions.still(k):
            support(board, k, np.sum(directions, axis=0))
        elif not board.motions.coordinates(k) and not driven_round(board, k):
            support(board, k, np.sum(directions, axis=0))
            driven(board, k)
        board.put(Disc((0.0, 0.0), 3.6), "body", board.placed(k), kind="joint", filled=True, layer=JOINT, width=INK)
        board.block(at, 9.0, 9.0)


def _is_joint(board: Board, parts: list[Player], part: Player, k: int) -> bool:
    if k == board.motions.holds[part.point].holder or board.motions.still(k):
        return True
    others = [x for x in parts if x is not part and x.frame is not None]
    return any(k == x.point or k in x.points for x in others)


def support(board: Board, k: int, towards: Array) -> None:
    """The triangle of a support on hatched ground, away from what it holds."""
    up = towards[1] > 0.35 * abs(towards[0])
    angle = pi if up else 0.0
    triangle, ground = pin()
    if board.stage.dimension == 3:
        _stand(board, k)
        return
    board.put(turned(triangle, angle), "ground", board.placed(k), kind="pin", layer=BEHIND, filled=False)
    board.put(turned(ground, angle), "ground", board.placed(k), kind="pin", layer=BEHIND)
    board.block(board.at(k) + (0, -12 if up else 12), 40, 24)


def _stand(board: Board, k: int) -> None:
    """In space: a small ellipse of ground under the joint."""
    ring = arc(1.0, 0.0, 2 * pi)
    flat = type(ring)(
        tuple((c, tuple(v * (24.0 if i % 2 == 0 else 8.0) for i, v in enumerate(x))) for c, x in ring.commands)
    )
    board.put(flat, "ground", board.placed(k), kind="pin", layer=GROUND, width=1.2)
    board.block(board.at(k), 44, 14)


# -- floors ---------------------------------------------------------------------------------------------------------


def _floors(board: Board, parts: list[Player], ends: dict[int, list[Array]]) -> None:
    """The lines on which bodies slide or roll."""
    lines: list[tuple[float, Array, Array, list[Array], list[int]]] = []
    for part in parts:
        sole = sole_of(board, part)
        if sole is None or part.direction is None:
            continue
        angle, normal = slide_heading(board, part)
        foot = board.at(part.point) - sole * normal
        for known, start, along, feet, points in lines:
            if abs(known - angle) < 1e-6 and abs((foot - start) @ np.array([-along[1], along[0]])) < 3.0:
                feet.append(foot)
                points.append(part.point)
                break
        else:
            along = np.array([np.cos(angle), np.sin(angle)])
            lines.append((angle, foot, along, [foot], [part.point]))
    for angle, start, along, feet, points in lines:
        feet += [start + x * along for x in _walls(board, points, start, along)]
        _floor(board, angle, start, along, feet, points[0], [end for k in points for end in ends.get(k, ())])


def _floor(
    board: Board, angle: float, start: Array, along: Array, feet: list[Array], k: int, ends: list[Array]
) -> None:
    """The line below bodies, from margin to margin or as far as the pulley at its end."""
    ways = [float((foot - start) @ along) for foot in feet]
    left = min(ways) - MARGIN
    right = max(ways) + MARGIN
    if k in board.sole:
        right += 150.0
    stops = [float((end - start) @ along) for end in ends]
    left = max([x for x in stops if x < min(ways)], default=left)
    right = min([x for x in stops if x > max(ways)], default=right)
    base = board.stage.fixed(board.r[k])
    x, y = start - board.scale * (board.view @ board.r[k])
    place = Placement(board.anchor(base), shift=(float(x), float(y)))
    board.put(turned(floor(left, right), angle), "ground", place, kind="table" if ends else "floor", layer=GROUND)
    board.fence(start + left * along, start + right * along)
    if abs(np.sin(angle)) > 0.04:
        moved = board.motions.views.J[0, k] - board.motions.views.J[0, board.motions.holds[k].holder]
        name = board.motions.slope_name(direction(moved))
        _incline(board, angle, start + (right if angle > 0 else left) * along, along, name)


def _walls(board: Board, points: list[int], start: Array, along: Array) -> list[float]:
    """Where along a floor bodies are tied to walls [px], less the margin of the floor."""
    way = 1.0 if along[0] > 0 or (abs(along[0]) < 1e-9 and along[1] < 0) else -1.0
    reach = CART[0] / 2 + WALL - MARGIN
    return [float((board.at(k) - start) @ along) + way * s * reach for k, s in board.walled if k in points]


def _incline(board: Board, angle: float, corner: Array, along: Array, name: str) -> None:
    """The angle of a slope against the horizontal, with the parameter that it is."""
    sense = -1.0 if angle > 0 else 1.0
    flat = corner + (sense * 80.0, 0.0)
    board.put(line(tuple(corner), tuple(flat)), "thin", kind="angle", dashed=True, layer=GROUND, moves=False, width=1.0)
    e = sense * along
    slope_angle(board, corner, 0.0 if sense > 0 else pi, float(np.arctan2(e[1], e[0])), name)


def sole_of(board: Board, part: Player) -> float | None:
    """How far the floor is below a body's point [px]; None for a body without a floor."""
    hold = board.motions.holds[part.point]
    if hold.how is not HoldKind.SLIDE or not _grounded(board, part):
        return None
    if part.glyph is BodyGlyph.CART:
        return SOLE
    if part.glyph is BodyGlyph.WEDGE:
        return board.sole.get(part.point)
    if part.glyph is BodyGlyph.WHEEL and part.radius is not None and not unwinds(board.motions, part):
        return board.pixels(part.radius)
    if part.glyph is BodyGlyph.BLOCK:
        angle, _ = slide_heading(board, part)
        return 0.0 if abs(np.sin(angle)) < 0.96 else None
    return None


def _grounded(board: Board, part: Player) -> bool:
    """Whether a body slides on the ground: its slide does not move, or moves along the same line."""
    holder = board.motions.holds[part.point].holder
    if board.motions.still(holder):
        return True
    J = board.motions.views.J[0, holder]
    if part.direction is None or not J.any():
        return False
    return float(abs(direction(J) @ part.direction)) > 0.9999
