"""Puts the picture of a system in space together: pose, scale, view, and then what is drawn, from back to front."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import Board
from lagrangian.look.cast import BodyGlyph
from lagrangian.look.constraint_glyphs import draw_constraints
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.look.pose import Pose, view_of
from lagrangian.look.space_bodies import SpaceBodies, tracks_of
from lagrangian.look.space_cast import SpacePlayer, cast_in_space
from lagrangian.look.space_efforts import SpaceEfforts, SpaceTies
from lagrangian.look.space_measures import SpaceMeasures, floating_coordinates, shifts_of
from lagrangian.look.space_solids import Solids
from lagrangian.look.space_supports import SpaceSupports
from lagrangian.look.space_turns import Spin, spins_of
from lagrangian.look.space_view import best_view
from lagrangian.look.ties import Resolver
from lagrangian.look.turning import Turn

Array = NDArray[np.float64]

LARGE, LONGEST = 270.0, 170.0
"""The size of a picture's structure and of its longest link [px]."""
SLIDES = (120.0, 84.0, 60.0)
"""How far things are drawn from the origin along one axis after another [px]."""
SPIN, LEAN = 0.75, 0.32
"""The angles of wheels about their axles, and of leaning, in the pose [rad]."""


def draw_in_space(
    motions: Motions,
    p: Array,
    asked: Mapping[str, float],
    kinds: Mapping[str, str],
    view: tuple[float | None, float | None],
    hidden: frozenset[str],
    lines: Sequence[tuple[str, tuple[str, ...]]],
) -> tuple[Board, list[SpacePlayer]]:
    """The board with everything of a system in space, and what its bodies are drawn as."""
    stage = motions.stage
    players = cast_in_space(motions, kinds)
    floating = floating_coordinates(stage.model)
    spins = spins_of(motions, floating)
    pose = Pose(motions, p, asked)
    q = _posed(motions, players, spins, pose, p)
    board = Board(stage, motions, q, p, view_of(motions, 0.7, 0.35), hidden=hidden)
    board.scale = _scale(board, players)
    board.posed(pose.closed(_slid(board, pose, floating)))
    links = [(h.holder, h.point) for h in motions.holds if h.how in (HoldKind.ROD, HoldKind.TELESCOPE, HoldKind.TRACK)]
    board.view = best_view(motions, spins, links, board.q, p, board.r, *view)
    board.scale = _scale(board, players)
    solids = Solids(board)
    tracks = tracks_of(board, solids)
    bodies = SpaceBodies(board, solids, players, spins, tracks)
    bodies.draw()
    supports = SpaceSupports(bodies)
    supports.draw()
    turns = _turns(motions, players, spins)
    resolver = Resolver(motions, list(players), turns)
    tied = [e for e in stage.model.elements if getattr(e, "between", None) or getattr(e, "deflection", None) is not None]
    ties = [resolver.resolve(e) for e in tied if e.ledger != "λ"]
    solids.sort()
    SpaceTies(bodies, ties).draw()
    SpaceEfforts(bodies, turns, ties, resolver).draw()
    SpaceMeasures(bodies, floating, supports.floor).draw()
    return board, players


def _turns(motions: Motions, players: list[SpacePlayer], spins: list[Spin]) -> list[Turn]:
    names = {x.frame: x.name for x in players if x.frame is not None}
    return [s.turn(len(motions.stage.inputs.q), names.get(s.frame, "")) for s in spins]


def _posed(motions: Motions, players: list[SpacePlayer], spins: list[Spin], pose: Pose, p: Array) -> Array:
    """The pose: wheels turned a little, what rolls leaning a little, else as in the plane."""
    q = pose.q.copy()
    rolls = any(x.glyph is BodyGlyph.WHEEL for x in players)
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
            q[spin.coordinate] = 0.6 if vertical else LEAN
    return pose.closed(q)


def _slid(board: Board, pose: Pose, floating: frozenset[int]) -> Array:
    """Lengths along fixed axes, long enough to be seen."""
    q = board.q.copy()
    for ways in shifts_of(board.motions).values():
        for n, (i, _) in enumerate(ways):
            name = pose.names[i]
            if i not in floating and name not in pose.asked and not pose.start.get(name):
                q[i] = SLIDES[n % 3] / board.scale
    return q


def _scale(board: Board, players: list[SpacePlayer]) -> float:
    """Pixels a metre, so that the structure fills the picture."""
    r, spots, longest = board.r, list[Array](), 0.0
    for k, hold in enumerate(board.motions.holds):
        if hold.how in (HoldKind.ROD, HoldKind.TELESCOPE, HoldKind.TRACK) and k != hold.holder:
            spots += [r[hold.holder], r[k]]
            longest = max(longest, float(np.linalg.norm(r[k] - r[hold.holder])))
    for x in players:
        size = 0.0
        if x.radius is not None and x.glyph in (BodyGlyph.WHEEL, BodyGlyph.DISC):
            size = board.stage.value(x.radius, board.q, board.p)
            longest = max(longest, 1.9 * size)
        elif x.glyph in (BodyGlyph.BLOCK, BodyGlyph.STAR) and x.glyph is BodyGlyph.BLOCK:
            size = float(x.half.max())
            longest = max(longest, 1.4 * size)
        reach = [float(np.linalg.norm(r[k] - r[x.point])) for k in x.points]
        if x.glyph is BodyGlyph.LINK and len(reach) == 1:
            spots.append(2 * r[x.point] - r[x.points[0]])
        longest = max([longest, *(1.2 * y for y in reach)])
        spots += [r[x.point] + size * board.view[0], r[x.point] - size * board.view[0], *(r[k] for k in x.points)]
    seen = np.array(spots or [np.zeros(3)]) @ board.view.T
    size = float(np.ptp(seen, axis=0).max())
    wanted = LARGE / size if size > 1e-9 else 100.0
    found = min(wanted, LONGEST / longest) if longest > 1e-9 else wanted
    return float(np.clip(found, 1e-6, 1e9))


__all__ = ["draw_constraints", "draw_in_space"]
