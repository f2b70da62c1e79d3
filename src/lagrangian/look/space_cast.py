"""What every body in space is drawn as: from its inertia, its joints, and what it rolls on. No drawing here."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.cast import CHOICES, BodyGlyph, Player, carried_points, linked, rolling_radius
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.model import Body, Force, RigidBody
from lagrangian.records import dataclass, field

Array = NDArray[np.float64]

ROUND, THIN = 1.2, 0.3
"""A moment is large if it is that many times the others; a body is slender if its least is below this part."""


@dataclass
class SpacePlayer(Player):
    """A body in space: ``direction`` is its axis in its own axes, ``moments`` are the principal ones and the mass.

    ``stem`` is a point on its axis on which it stands, ``half`` are half the edges of the box with its inertia [m],
    ``thickness`` is half that of its disc, ``level`` the place of a gimbal's ring, from the inside, ``track`` the point
    through which it slides.
    """

    moments: Array | None = None
    stem: int | None = None
    half: Array = field(default_factory=lambda: np.zeros(3))
    thickness: float = 0.0
    level: int = 0
    track: int | None = None
    tips: tuple[int, ...] = ()


def cast_in_space(motions: Motions, kinds: Mapping[str, str]) -> list[SpacePlayer]:
    """What each body is drawn as."""
    players = [_player(motions, body) for body in motions.stage.model.bodies]
    _gimbals(motions, players)
    for x in players:
        if x.name in kinds:
            x.glyph = CHOICES[kinds[x.name]]
            if x.glyph in (BodyGlyph.CART, BodyGlyph.BLOCK):
                x.glyph = BodyGlyph.BLOCK
    return players


def _player(motions: Motions, body: Body) -> SpacePlayer:
    stage = motions.stage
    point = stage.index(body.at)
    if not isinstance(body, RigidBody):
        return SpacePlayer(body, point, None, BodyGlyph.BALL)
    frame = stage.frames.index(body.frame)
    player = SpacePlayer(body, point, frame, BodyGlyph.BLOCK, points=_joints(motions, point, frame))
    player.moments = moments_of(motions, body)
    _sized(motions, player)
    hold = motions.holds[point]
    floats = stage.frames[frame].floating is not None
    if player.radius is not None and rolling_radius(motions, player) is not None:
        player.glyph = BodyGlyph.WHEEL
    elif _rotors(motions, player):
        player.glyph = BodyGlyph.STAR
    elif player.radius is not None and (not player.points or _on_axis(motions, player)):
        player.glyph = BodyGlyph.DISC
        player.stem = player.points[0] if player.points and not _mounted(motions, player) else None
    elif player.points and not _stands_up(player):
        linked(motions, player)
    elif player.points:
        player.stem = next((k for k in player.points if k == hold.holder), player.points[0])
    elif hold.how is HoldKind.TRACK:
        player.glyph = BodyGlyph.LINK
    elif motions.still(point) and motions.turns(frame) and not floats:
        player.glyph = BodyGlyph.STAND
    return player


def _joints(motions: Motions, point: int, frame: int) -> tuple[int, ...]:
    """The points at rest in a body; of those on one line along its own axis, the one that holds its centre."""
    found = carried_points(motions, point, frame)
    given = motions.stage.frames[frame].axis
    if given is None or len(found) < 2:
        return found
    n = np.array([float(x) for x in given])
    holder = motions.holds[point].holder
    kept: list[int] = []
    places: list[Array] = []
    for k in sorted(found, key=lambda k: k != holder):
        x = motions.local(k, point, frame)[0][0]
        x = x - (x @ n) * n
        if all(float(np.linalg.norm(x - y)) > 1e-9 * motions.size for y in places):
            kept.append(k)
            places.append(x)
    return tuple(sorted(kept))


def moments_of(motions: Motions, body: RigidBody) -> Array | None:
    """The three moments of a body about its own axes and its mass, as numbers; None where they are no numbers."""
    tensor = body.tensor
    diagonal = [tensor[i][i] for i in range(3)] if len(tensor) == 3 else [tensor[0][0]] * 3
    try:
        q = np.zeros(len(motions.stage.inputs.q))
        found = motions.stage.evaluated([sp.sympify(x) for x in [*diagonal, body.mass]], q, motions.stage.parameters())
    except (TypeError, ValueError, ArithmeticError):
        return None
    return found if np.isfinite(found).all() and found[3] > 0 and found[:3].max() > 0 else None


def _sized(motions: Motions, player: SpacePlayer) -> None:
    """The box and the disc with the inertia of a body: J_x = m (b² + c²)/12 and C = m r²/2, A = m (r²/4 + h²/12)."""
    rolling = rolling_radius(motions, player)
    if player.moments is None:
        player.half = np.full(3, 0.1 * motions.size)
        player.radius = rolling
        player.direction = np.array([0.0, 1.0, 0.0])
        return
    J, m = player.moments[:3], player.moments[3]
    player.half = np.sqrt(np.maximum(6 * (J.sum() - 2 * J) / m, 1e-3 * J.max() / m)) / 2
    axis = int(np.argmax(J))
    others = np.delete(J, axis)
    alike = abs(others[0] - others[1]) < 1e-9 * J[axis]
    if rolling is None and not (alike and J[axis] > ROUND * others[0]):
        return
    player.direction = np.eye(3)[axis]
    player.radius = rolling if rolling is not None else sp.Float(float(np.sqrt(2 * J[axis] / m)), 17)
    r = motions.stage.value(player.radius, np.zeros(len(motions.stage.inputs.q)), motions.stage.parameters())
    h = float(np.sqrt(max(0.0, 12 * (others[0] / m - r * r / 4)))) / 2
    player.thickness = 0.09 * r if rolling is not None else float(np.clip(h, 0.06 * r, 0.13 * r))


def _on_axis(motions: Motions, player: SpacePlayer) -> bool:
    """Whether all points of a disc lie on its axis."""
    assert player.direction is not None
    offsets = [motions.local(k, player.point, player.frame)[0][0] for k in player.points]
    return all(float(np.linalg.norm(np.cross(x, player.direction))) < 1e-6 * motions.size for x in offsets)


def _mounted(motions: Motions, player: SpacePlayer) -> bool:
    """Whether the centre of a disc is at rest in another body, which holds its axle."""
    for body in motions.stage.model.bodies:
        if isinstance(body, RigidBody) and body is not player.body:
            point, frame = motions.stage.index(body.at), motions.stage.frames.index(body.frame)
            if point != player.point and frame != player.frame and motions.carried(player.point, point, frame):
                return True
    return False


def _stands_up(player: SpacePlayer) -> bool:
    """Whether a body on one joint is a box rather than a link: none of its moments is small."""
    if player.moments is None or len(player.points) != 1:
        return False
    J = player.moments[:3]
    return bool(J.min() > THIN * J.max() and np.ptp(J) > 0.05 * J.max())


def _rotors(motions: Motions, player: SpacePlayer) -> bool:
    """Whether forces act at points of a body that is no joint's: then arms reach to these."""
    stage = motions.stage
    at = {stage.index(e.at) for e in stage.model.elements if isinstance(e, Force) and e.at is not None}
    pushed = tuple(k for k in player.points if k in at)
    if len(pushed) < 2:
        return False
    held = {stage.index(p) for e in stage.model.constraints for _, p in e.points()}
    others = [x.at for x in stage.model.bodies if x is not player.body]
    if held & set(player.points) or any(stage.index(x) in player.points for x in others):
        return False
    player.tips = pushed
    return True


def _gimbals(motions: Motions, players: list[SpacePlayer]) -> None:
    """Bodies about one centre, each turning in the one before: rings around the innermost."""
    stage = motions.stage
    for inner in players:
        nest = [x for x in players if x.point == inner.point and x.frame is not None and not x.points]
        nest.sort(key=lambda x: stage.frames[x.frame or 0].serial, reverse=True)
        if len(nest) < 2 or nest[0] is not inner:
            continue
        for level, player in enumerate(nest):
            assert player.frame is not None
            player.level = level
            if level and stage.frames[player.frame].floating is None:
                player.glyph = BodyGlyph.RING
            elif not level and player.glyph is BodyGlyph.STAND:
                player.glyph = BodyGlyph.BLOCK
