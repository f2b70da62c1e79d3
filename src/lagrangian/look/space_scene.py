"""Puts the picture of a system in space together: pose, scale, view, and then what is drawn, from back to front."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import Board
from lagrangian.look.cast import BodyGlyph
from lagrangian.look.constraint_glyphs import draw_one
from lagrangian.look.freedoms import say_unjoined
from lagrangian.look.hints import Hints
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.look.outlines import draw_hints
from lagrangian.look.pose import Pose, up_axis, view_of
from lagrangian.look.space_bodies import SpaceBodies, tracks_of
from lagrangian.look.space_cast import SpacePlayer, cast_in_space
from lagrangian.look.space_efforts import SpaceEfforts, SpaceTies, TrackResolver
from lagrangian.look.space_measures import SpaceMeasures, floating_coordinates, shifts_of
from lagrangian.look.space_solids import Solids
from lagrangian.look.space_strings import draw_strings_through, strings_through
from lagrangian.look.space_supports import SpaceSupports, hooped
from lagrangian.look.space_turns import Spin, axis_now, spins_of
from lagrangian.look.space_view import best_view
from lagrangian.look.ties import Resolver
from lagrangian.look.turning import Turn
from lagrangian.look.words import description
from lagrangian.model import Ball, Constraint, Element, Rolling

Array = NDArray[np.float64]

LARGE, LONGEST, MANY, ROOMIEST = 270.0, 170.0, 9, 3.0
"""The size of a picture's structure and of its longest link [px]; both are larger by a root of the number of bodies and
coordinates from the third number on, up to the fourth."""
SLIDES = (120.0, 84.0, 60.0)
"""How far things are drawn from the origin along one axis after another [px]."""
SPIN, LEAN, HEADING = 0.75, 0.32, 0.95
"""The angles of wheels about their axles, of leaning, and of a heading on the floor, in the pose [rad]."""


def draw_in_space(motions: Motions, p: Array, hints: Hints) -> tuple[Board, str]:
    """The board with everything of a system in space, and what is seen, in words."""
    stage = motions.stage
    players = cast_in_space(motions, hints.kinds)
    floating = floating_coordinates(stage.model)
    spins = spins_of(motions, floating)
    pose = Pose(motions, p, hints.pose)
    q = _posed(motions, players, spins, pose, p)
    board = Board(stage, motions, q, p, view_of(motions, 0.7, 0.35), hidden=frozenset(hints.hide))
    board.scale = _scale(board, players)
    board.posed(pose.closed(_slid(board, pose, floating)))
    links = [(h.holder, h.point) for h in motions.holds if h.how in (HoldKind.ROD, HoldKind.TELESCOPE, HoldKind.TRACK)]
    wheels = _wheels(board, players)
    rings = _rings(players, spins, board)
    board.view = best_view(motions, spins, links, wheels, rings, board.views, hints.azimuth, hints.elevation)
    board.scale = _scale(board, players)
    solids = Solids(board)
    tracks = tracks_of(board, solids)
    bodies = SpaceBodies(board, solids, players, spins, tracks)
    bodies.draw()
    strings = strings_through(motions, list(players), board.r)
    supports = SpaceSupports(bodies, {x.holder for x in strings})
    supports.draw()
    draw_strings_through(board, solids, strings)
    turns = _turns(motions, players, spins)
    resolver = TrackResolver(motions, list(players), turns, tracks)
    tied = [
        e for e in stage.model.elements if getattr(e, "between", None) or getattr(e, "deflection", None) is not None
    ]
    ties = [resolver.resolve(e) for e in tied if e.ledger != "λ"]
    solids.sort()
    _constraints(board, players)
    draw_hints(board, players, hints)
    say_unjoined(board, players, hints.lines, strings)
    SpaceTies(bodies, ties).draw()
    SpaceEfforts(bodies, turns, ties, resolver).draw()
    SpaceMeasures(bodies, floating, supports.floor).draw()
    plain = Resolver(motions, list(players), turns)
    told = [plain.resolve(e) for e in tied if e.ledger != "λ"]
    return board, description(board, list(players), told, turns, strings)


def _constraints(board: Board, players: list[SpacePlayer]) -> None:
    """What constraints have to show, apart from ball joints, and from those that keep a wheel on its floor."""
    for element in board.stage.model.constraints:
        if element.name not in board.hidden and not isinstance(element, Ball) and not _keeps_on_floor(board, element):
            draw_one(board, list(players), element)


def _keeps_on_floor(board: Board, element: Element) -> bool:
    """Whether an expression is the height of a point at which something rolls."""
    stage = board.stage
    if not isinstance(element, Constraint) or element.expression is None:
        return False
    contacts = [stage.index(e.at) for e in stage.model.elements if isinstance(e, Rolling)]
    motions = board.motions
    slopes = motions.slopes(element.expression)
    heights = np.einsum("skdn,d->skn", motions.views.J[:2], up_axis(motions))
    return any(
        all(min(np.abs(h[k] - g).max(), np.abs(h[k] + g).max()) < 1e-9 for h, g in zip(heights, slopes, strict=True))
        for k in contacts
    )


def _turns(motions: Motions, players: list[SpacePlayer], spins: list[Spin]) -> list[Turn]:
    names = {x.frame: x.name for x in players if x.frame is not None}
    return [s.turn(len(motions.stage.inputs.q), "" if s.frame is None else names.get(s.frame, "")) for s in spins]


def _posed(motions: Motions, players: list[SpacePlayer], spins: list[Spin], pose: Pose, p: Array) -> Array:
    """The pose: wheels turned a little, what rolls leaning a little, else as in the plane."""
    q = pose.q.copy()
    rolls = sum(x.glyph is BodyGlyph.WHEEL for x in players)
    heading = HEADING if rolls == 1 else 0.6 * HEADING
    up = np.array([0.0, 0.0, 1.0])
    for spin in spins:
        name = pose.names[spin.coordinate]
        if name in pose.asked or (pose.stage.model.constraints and pose.start.get(name)):
            continue
        own = next((x for x in players if x.point == spin.joint and x.frame == spin.frame), None)
        if own is not None and own.glyph in (BodyGlyph.WHEEL, BodyGlyph.DISC):
            q[spin.coordinate] = SPIN
        elif rolls:
            vertical = spin.axis is not None and spin.base is None and abs(float(spin.axis @ up)) > 0.9
            q[spin.coordinate] = heading if vertical else LEAN
    longest = max((motions.views.r[0, h.point] - motions.views.r[0, h.holder] for h in motions.holds), key=_norm)
    for hold in motions.holds:
        i = hold.along
        if hold.how is HoldKind.TRACK and i is not None and not (pose.start.get(pose.names[i]) or pose.asked):
            q[i] = 0.5 * _norm(longest)
    return pose.closed(q)


def _wheels(board: Board, players: list[SpacePlayer]) -> list[tuple[int, float, Array]]:
    """The wheels and boxes with their radii [m], each with the way along which what they carry is measured."""
    found: list[tuple[int, float, Array]] = []
    for x in players:
        if x.glyph is BodyGlyph.WHEEL and x.radius is not None:
            radius = board.stage.value(x.radius, board.q, board.p)
        elif x.glyph is BodyGlyph.BLOCK and not board.motions.still(x.point):
            radius = float(x.half.max())
        else:
            continue
        for k, ways in shifts_of(board.motions).items():
            at = board.r[k] - sum(float(board.q[i]) * e for i, e in ways)
            spots: list[Array] = []
            for i, e in ways:
                spots += [at + s * float(board.q[i]) * e for s in np.linspace(0, 0.9, 9)]
                at = at + float(board.q[i]) * e
            found.append((x.point, radius, np.array(spots)))
    return found


def _rings(players: list[SpacePlayer], spins: list[Spin], board: Board) -> list[Array]:
    """The axes of gimbals' rings, which should not be seen from the side."""
    found: list[Array] = []
    own = {s.frame: axis_now(s, board.views) for s in spins if s.frame is not None}
    for x in players:
        if x.glyph is BodyGlyph.RING and x.frame in own:
            inner = next((y for y in players if y.point == x.point and y.level == x.level - 1), None)
            if inner is not None and inner.frame in own:
                n = np.cross(own[x.frame], own[inner.frame])
                found += [n / _norm(n)] if _norm(n) > 1e-6 else []
    return found


def _norm(x: Array) -> float:
    return float(np.linalg.norm(x))


def _slid(board: Board, pose: Pose, floating: frozenset[int]) -> Array:
    """Lengths along fixed axes, long enough to be seen."""
    q, closed = board.q.copy(), bool(board.stage.model.constraints)
    for ways in shifts_of(board.motions).values():
        for n, (i, _) in enumerate(ways):
            name = pose.names[i]
            if not (i in floating and closed) and name not in pose.asked and not pose.start.get(name):
                q[i] = SLIDES[n % 3] / board.scale
    return q


def _scale(board: Board, players: list[SpacePlayer]) -> float:
    """Pixels a metre, so that the structure fills the picture."""
    r, spots, longest = board.r, list[Array](), 0.0
    for k, hold in enumerate(board.motions.holds):
        if hold.how in (HoldKind.ROD, HoldKind.TELESCOPE, HoldKind.TRACK) and k != hold.holder:
            spots += [r[hold.holder], r[k]]
            reach = float(np.linalg.norm(r[k] - r[hold.holder]))
            longest = max(longest, reach)
            if hooped(board, k) is not None:
                longest = max(longest, 1.6 * reach)
    for x in players:
        size = 0.0
        if x.radius is not None and x.glyph in (BodyGlyph.WHEEL, BodyGlyph.DISC):
            size = board.stage.value(x.radius, board.q, board.p)
            longest = max(longest, 1.9 * size)
        elif x.glyph in (BodyGlyph.BLOCK, BodyGlyph.STAR) and x.glyph is BodyGlyph.BLOCK:
            size = float(x.half.max())
            longest = max(longest, 2.2 * size)
        reach = [float(np.linalg.norm(r[k] - r[x.point])) for k in x.points]
        if x.glyph is BodyGlyph.LINK and len(reach) == 1:
            spots.append(2 * r[x.point] - r[x.points[0]])
        longest = max([longest, *(1.2 * y for y in reach)])
        spots += [r[x.point] + size * board.view[0], r[x.point] - size * board.view[0], *(r[k] for k in x.points)]
    seen = np.array(spots or [np.zeros(3)]) @ board.view.T
    size = float(np.ptp(seen, axis=0).max())
    room = min(ROOMIEST, max(1.0, (len(board.stage.model.coordinates) + len(players)) / MANY)) ** 0.5
    wanted = room * LARGE / size if size > 1e-9 else 100.0
    found = min(wanted, room * LONGEST / longest) if longest > 1e-9 else wanted
    return float(np.clip(found, 1e-6, 1e9))
