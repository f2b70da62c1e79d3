"""What every body is drawn as: the rules, without any drawing."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from enum import Enum

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.holds import HoldKind, Motions
from lagrangian.model import Body, RigidBody, Rolling
from lagrangian.records import dataclass

Array = NDArray[np.float64]

FLAT = 0.04
"""A direction is horizontal or vertical up to this sine."""


class BodyGlyph(Enum):
    """The glyphs of bodies; the values are the words of `[look] kinds` and of descriptions."""

    BALL = "ball"
    CART = "cart"
    BLOCK = "block"
    WEDGE = "wedge"
    WHEEL = "wheel"
    PULLEY = "pulley"
    LINK = "link"
    PLATE = "plate"
    DISC = "disc"
    SHAFT = "disc on a shaft"
    BEAM = "beam"
    BAR = "bar"
    STAND = "turntable"
    RING = "ring"
    STAR = "frame with arms"
    NONE = "none"


CHOICES = {
    "ball": BodyGlyph.BALL, "cart": BodyGlyph.CART, "box": BodyGlyph.BLOCK, "wheel": BodyGlyph.WHEEL,
    "disk": BodyGlyph.DISC,
    "disc": BodyGlyph.DISC, "link": BodyGlyph.LINK,
    "plate": BodyGlyph.PLATE, "bar": BodyGlyph.BAR, "none": BodyGlyph.NONE,
}  # fmt: skip
"""What ``kinds`` may say of a body."""


@dataclass
class Player:
    """A body and what it is drawn as.

    ``point`` and ``frame`` are its numbers on the stage (``frame`` None for a particle); ``direction`` is the unit
    vector [fixed axes] along which it slides; ``radius`` is an expression [m]; ``points`` are those at rest in it.
    """

    body: Body
    point: int
    frame: int | None
    glyph: BodyGlyph
    direction: Array | None = None
    radius: sp.Expr | None = None
    points: tuple[int, ...] = ()
    spine: tuple[int, int] | None = None

    @property
    def name(self) -> str:
        """The name of the body."""
        return self.body.name


def cast(motions: Motions, kinds: Mapping[str, str]) -> list[Player]:
    """What each body is drawn as."""
    parts = [_part(motions, body) for body in motions.stage.model.bodies]
    on_shaft = [x for x in parts if x.glyph is BodyGlyph.DISC]
    centres = {x.point for x in on_shaft}
    for x in on_shaft:
        if sum(y.point == x.point for y in on_shaft) > 1 and len(centres) == 1:
            x.glyph = BodyGlyph.SHAFT
    _mesh(motions, parts)
    for x in parts:
        if any(_slides_on(motions, y, x) for y in parts) and x.glyph in (BodyGlyph.CART, BodyGlyph.BLOCK):
            x.glyph = BodyGlyph.WEDGE
        if x.glyph is BodyGlyph.DISC and any(_runs_on(motions, y, x) for y in parts):
            x.glyph = BodyGlyph.BEAM
        if x.name in kinds:
            _choose(motions, x, CHOICES[kinds[x.name]])
    return parts


def _choose(motions: Motions, part: Player, glyph: BodyGlyph) -> None:
    """Draw a body as a hint asks for, if it has what that needs: a frame, or a joint besides its centre."""
    if glyph in (BodyGlyph.LINK, BodyGlyph.PLATE, BodyGlyph.BAR) and part.frame is None:
        return
    if glyph in (BodyGlyph.LINK, BodyGlyph.PLATE) and part.spine is None:
        if not part.points:
            return
        linked(motions, part)
    if glyph in (BodyGlyph.WHEEL, BodyGlyph.DISC):
        if part.frame is None:
            return
        if part.radius is None:
            part.radius = sp.sqrt(2 * part.body.tensor[0][0] / part.body.mass)
    part.glyph = glyph


def _mesh(motions: Motions, parts: list[Player]) -> None:
    """Discs at different fixed centres whose angles keep a ratio are gears: their radii meet between the centres."""
    for one, two in itertools.combinations([x for x in parts if x.glyph is BodyGlyph.DISC], 2):
        radii = _pitch_radii(motions, one, two)
        if radii is not None:
            one.radius, two.radius = radii


def geared(motions: Motions, parts: Sequence[Player]) -> list[tuple[Player, Player]]:
    """The pairs of discs that are gears on one another."""
    discs = [x for x in parts if x.glyph is BodyGlyph.DISC] if motions.stage.dimension == 2 else []
    return [pair for pair in itertools.combinations(discs, 2) if _pitch_radii(motions, *pair) is not None]


def _pitch_radii(motions: Motions, one: Player, two: Player) -> tuple[sp.Symbol, sp.Symbol] | None:
    """The parameters that are the radii of two discs which turn in a ratio, each the other way, if they are gears."""
    if one.frame is None or two.frame is None or one.point == two.point:
        return None
    a, b = (motions.angle_slopes(x) for x in (one.frame, two.frame))
    size = float(np.linalg.norm(a)) * float(np.linalg.norm(b))
    if size < 1e-12 or float(a @ b) > -size * (1 - 1e-9):
        return None
    ratio = float(np.linalg.norm(a)) / float(np.linalg.norm(b))
    gap = float(np.linalg.norm(motions.views.r[0, one.point] - motions.views.r[0, two.point]))
    first, second = motions.named(gap / (1 + ratio)), motions.named(gap * ratio / (1 + ratio))
    return None if first is None or second is None else (first, second)


def _part(motions: Motions, body: Body) -> Player:
    stage = motions.stage
    point = stage.index(body.at)
    if not isinstance(body, RigidBody):
        return _particle(motions, body, point)
    frame = stage.frames.index(body.frame)
    part = Player(body, point, frame, BodyGlyph.BAR, points=carried_points(motions, point, frame))
    if _round(motions, part):
        return part
    hold = motions.holds[point]
    if part.points:
        linked(motions, part)
    elif motions.still(point) and motions.turns(frame):
        part.glyph = BodyGlyph.DISC
    elif hold.how is HoldKind.SLIDE and not motions.turns(frame):
        return _particle(motions, body, point)
    elif _rotor(motions, part):
        part.glyph = BodyGlyph.DISC
    if part.glyph is BodyGlyph.DISC:
        part.radius = sp.sqrt(2 * body.tensor[0][0] / body.mass)
    return part


def _rotor(motions: Motions, part: Player) -> bool:
    """Whether a body in the plane turns about its own centre on another body, and nothing else takes hold of it."""
    stage, hold = motions.stage, motions.holds[part.point]
    if hold.how is not HoldKind.ROD or set(motions.turns(part.frame)) <= set(hold.moving):
        return False
    if any(stage.index(p) == part.point for e in stage.model.constraints for _, p in e.points()):
        return False
    others = [x for x in stage.model.bodies if isinstance(x, RigidBody) and x is not part.body]
    return any(motions.carried(part.point, stage.index(x.at), stage.frames.index(x.frame)) for x in others)


def carried_points(motions: Motions, point: int, frame: int) -> tuple[int, ...]:
    """The points that are at rest in a body, apart from its centre.

    In space all points of a joint's axis are at rest in both bodies. Of those that another body carries too, only the
    one that holds the centre belongs to this one.
    """
    stage = motions.stage
    found = [
        k
        for k in range(len(stage.points))
        if k != point and _apart(motions, k, point) and motions.carried(k, point, frame)
    ]
    holder = motions.holds[point].holder
    for other in stage.model.bodies:
        if not isinstance(other, RigidBody) or other.at is stage.points[point]:
            continue
        home = stage.index(other.at), stage.frames.index(other.frame)
        if home[1] == frame or stage.frames[home[1]].serial > stage.frames[frame].serial:
            continue
        shared = [k for k in found if k == home[0] or motions.carried(k, *home)]
        if len(shared) > 1:
            found = [k for k in found if k not in shared or k == holder]
    return tuple(found)


def _apart(motions: Motions, k: int, centre: int) -> bool:
    return float(np.abs(motions.views.r[:, k] - motions.views.r[:, centre]).max()) > 1e-9 * motions.size


def _particle(motions: Motions, body: Body, point: int) -> Player:
    hold = motions.holds[point]
    part = Player(body, point, None, BodyGlyph.BALL)
    if hold.how is not HoldKind.SLIDE:
        return part
    part.direction = direction(motions.views.J[0, point] - motions.views.J[0, hold.holder])
    part.glyph = BodyGlyph.CART if abs(part.direction[1]) < FLAT else BodyGlyph.BLOCK
    return part


def direction(J: Array) -> Array:
    """The unit vector of the first column that is not small beside the longest."""
    sizes = np.linalg.norm(J, axis=0)
    column = J[:, int(np.argmax(sizes > 0.3 * sizes.max()))]
    return column / np.linalg.norm(column)


# -- what is round --------------------------------------------------------------------------------------------------


def _round(motions: Motions, part: Player) -> bool:
    """Whether a body in the plane is a wheel or a pulley: its frame turns by s/R, where s is a length."""
    stage, hold = motions.stage, motions.holds[part.point]
    rolling = rolling_radius(motions, part)
    if rolling is not None:
        part.glyph, part.radius = BodyGlyph.WHEEL, rolling
        J = motions.views.J[0, part.point]
        part.direction = direction(J) if J.any() else None
        return True
    assert part.frame is not None
    frame = stage.frames[part.frame]
    for i in motions.turns(part.frame):
        c = stage.model.coordinates[i]
        slope = sp.diff(stage.model.expand(frame.total_angle), c.symbol)
        if slope.is_number or slope.free_symbols - {p.symbol for p in stage.model.parameters}:
            continue
        radius = 1 / slope
        if radius.could_extract_minus_sign():
            radius = -radius
        if hold.how in (HoldKind.SLIDE, HoldKind.TRACK) and i in hold.moving:
            part.glyph, part.radius = BodyGlyph.WHEEL, radius
            part.direction = direction(motions.views.J[0, part.point] - motions.views.J[0, hold.holder])
            return True
        if motions.still(part.point) and any(h.how is HoldKind.SLIDE and i in h.moving for h in motions.holds):
            part.glyph, part.radius = BodyGlyph.PULLEY, radius
            return True
    return _rolls_along(motions, part) or _rolls_around(motions, part)


def _rolls_along(motions: Motions, part: Player) -> bool:
    """Whether a body rolls on a line: its centre moves with speed R ω, and R is a parameter."""
    hold, i = motions.holds[part.point], motions.holds[part.point].along
    if hold.how is not HoldKind.SLIDE or i is None or part.frame is None or motions.turns(part.frame) != (i,):
        return False
    moved = motions.views.J[:, part.point, :, i] - motions.views.J[:, hold.holder, :, i]
    turn = float(abs(motions.angle_slopes(part.frame)[i]))
    radius = motions.named(float(np.linalg.norm(moved[0])) / turn) if turn > 1e-9 else None
    if radius is None or not motions.even(part.point, hold.holder, i):
        return False
    part.glyph, part.radius, part.direction = BodyGlyph.WHEEL, radius, direction(moved[0][:, None])
    return True


def _rolls_around(motions: Motions, part: Player) -> bool:
    """Whether a body rolls on a circle: its centre moves about a fixed point with speed r ω, and r is a parameter."""
    hold = motions.holds[part.point]
    if hold.how is not HoldKind.ROD or not motions.still(hold.holder) or len(hold.moving) != 1 or part.frame is None:
        return False
    if motions.carried(hold.holder, part.point, part.frame) or motions.turns(part.frame) != hold.moving:
        return False
    i = hold.moving[0]
    turn = float(abs(motions.angle_slopes(part.frame)[i]))
    if turn < 1e-9:
        return False
    radius = motions.named(float(np.linalg.norm(motions.views.J[0, part.point, :, i])) / turn)
    if radius is None:
        return False
    part.glyph, part.radius = BodyGlyph.WHEEL, radius
    return True


def rolling_radius(motions: Motions, part: Player) -> sp.Expr | None:
    """The radius of a body that a `rolling` constraint lets roll: from its centre to the point of contact."""
    for element in motions.stage.model.elements:
        if isinstance(element, Rolling) and element.body is part.body:
            return motions.length(motions.stage.index(element.at), part.point)
    return None


# -- what is long ---------------------------------------------------------------------------------------------------


def linked(motions: Motions, part: Player) -> None:
    """A body with joints: a link if they lie on a line with its centre, otherwise a plate."""
    everything = [part.point, *part.points]
    offsets = np.array([motions.local(k, part.point, part.frame)[0][0] for k in everything])
    far = np.linalg.norm(offsets[:, None] - offsets[None, :], axis=2)
    a, b = (int(x) for x in np.unravel_index(int(np.argmax(far)), far.shape))
    e = (offsets[b] - offsets[a]) / far[a, b]
    along = (offsets - offsets[a]) @ e
    across = np.linalg.norm(offsets - offsets[a] - along[:, None] * e, axis=1).max()
    part.glyph = BodyGlyph.LINK if across < 0.08 * far[a, b] else BodyGlyph.PLATE
    part.spine = everything[a], everything[b]


def _slides_on(motions: Motions, above: Player, below: Player) -> bool:
    """Whether a body slides along another one that itself slides in another direction, neither along it nor across."""
    hold = motions.holds[above.point]
    if hold.how is not HoldKind.SLIDE or hold.holder != below.point or below.direction is None or above is below:
        return False
    e = direction(motions.views.J[0, above.point] - motions.views.J[0, below.point])
    return FLAT < float(abs(e @ below.direction)) < 0.999


def _runs_on(motions: Motions, above: Player, below: Player) -> bool:
    """Whether a body runs along a track that turns with another body."""
    hold = motions.holds[above.point]
    if hold.how is HoldKind.TELESCOPE and not _apart(motions, hold.holder, below.point):
        own = motions.stage.points[above.point].frame
        return own is not None and below.frame is not None and motions.stage.frames[below.frame] is own
    return hold.how is HoldKind.TRACK and hold.frame == below.frame and above is not below
