"""Where strings over pulleys lie: the pose that shows both sides, the pulleys' places, and what is moved for them.

A string is to scale if the model says how long it is: the sum L of both lengths at the declared parameters is positive.
Where a model leaves a constant out (as one may: −x on one side and x on the other), its ends are moved on the screen.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import Board
from lagrangian.look.bodies import slide_heading
from lagrangian.look.cast import FLAT, BodyGlyph, Player, direction
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.look.kinematics import Views
from lagrangian.look.pose import Pose
from lagrangian.look.shapes import BLOCK
from lagrangian.look.strings import PulleyString, StringEnd
from lagrangian.records import dataclass

Array = NDArray[np.float64]

SHARES = (0.6, 0.4)
"""The share of a string on the first side: of those on fixed pulleys and of those on moving ones."""
SHORTEST = 90.0
"""The shortest side of a string whose length the model does not say [px]."""
WIDE, NARROW, SMALL, EYE = 50.0, 32.0, 14.0, 9.0
"""The radii [px] of pulleys that nothing gives: above a moving pulley, others, on a corner, where a mass swings."""
LOOP = 46.0
"""How far above a body the pulley is that it hangs on, in a loop of the string [px]."""


@dataclass
class Laid:
    """A string on the screen; all places are pixels.

    ``centre`` and ``radius`` are those of its pulley, ``starts`` the places where its straight parts leave the pulley,
    ``ends`` those where they end. ``second`` is another pulley's centre, if there are two. ``base`` is the point of the
    model with which the pulley moves.
    """

    string: PulleyString
    base: int
    centre: Array
    radius: float
    starts: tuple[Array, Array]
    ends: tuple[Array, Array]
    second: Array | None = None


# -- the pose ---------------------------------------------------------------------------------------------------------


def along(string: PulleyString, end: StringEnd, views: Views) -> Array:
    """The unit vector (d,) of the line of an end away from the pulley, with the parameters of the picture."""
    assert end.along is not None
    e = direction(views.J[0, end.point] - views.J[0, string.holder])
    return e if float(e @ end.along) > 0 else -e


def lengths(motions: Motions, string: PulleyString, views: Views) -> tuple[Array, float, float]:
    """The pulley's place [m], the length ℓ of the first side and that of the whole string at one state [m]."""
    r = views.r[0]
    a, b = string.ends
    known = [string.holder] if string.holder else [k for k in range(len(motions.holds)) if motions.still(k) or not k]
    best: tuple[Array, float, float] | None = None
    for k in known:
        centre = r[k] if string.parallel else _corner(motions, string, views)
        first, second = (_length(motions, string, centre, end, views) for end in (a, b))
        if best is None or (best[2] <= 0 < first + string.fold * second):
            best = centre, first, first + string.fold * second
    assert best is not None
    return best


def _length(motions: Motions, string: PulleyString, centre: Array, end: StringEnd, views: Views) -> float:
    r, k = views.r[0], end.point
    if end.along is None:
        return float(np.linalg.norm(r[k] - r[motions.holds[k].holder]))
    return float((r[k] - centre) @ along(string, end, views))


def _corner(motions: Motions, string: PulleyString, views: Views) -> Array:
    """Where the lines of both ends meet; for a string that swings, the place beside its holder."""
    a, b = string.ends
    r = views.r[0]
    if a.along is None or b.along is None:
        swings, slides = (a, b) if a.along is None else (b, a)
        e, home = along(string, slides, views), r[motions.holds[swings.point].holder]
        return r[slides.point] - float((r[slides.point] - home) @ e) * e
    one, two = along(string, a, views), along(string, b, views)
    s, _ = np.linalg.solve(np.array([one, -two]).T, r[b.point] - r[a.point])
    return r[a.point] + s * one


def show_strings(pose: Pose, strings: list[PulleyString]) -> list[PulleyString]:
    """Choose coordinates in which every string of known length has both sides; return these strings."""
    motions, stage = pose.motions, pose.stage
    views = stage.views([pose.q], pose.p)
    whole = [(x, *lengths(motions, x, views)[1:]) for x in strings]
    known = [(x, first, L) for x, first, L in whole if L > 1e-6]
    free = [
        i
        for i in pose.slides
        if pose.names[i] not in pose.asked and any(x.ends[0].slopes[0, i] or x.ends[1].slopes[0, i] for x, *_ in known)
    ]
    if not free or stage.model.constraints:
        return [x for x, *_ in known]
    rows = np.array([_slope(x, views)[free] for x, *_ in known])
    wanted = np.array([SHARES[bool(x.holder)] * L - first for x, first, L in known])
    pose.q[free] += np.linalg.lstsq(rows, wanted, rcond=None)[0]
    pose.slides = [i for i in pose.slides if i not in free]
    return [x for x, *_ in known]


def _slope(string: PulleyString, views: Views) -> Array:
    """∂ℓ/∂q (n,) of the first side, with the parameters of the picture."""
    end = string.ends[0]
    if end.along is None:
        return end.slopes[0]
    return along(string, end, views) @ (views.J[0, end.point] - views.J[0, string.holder])


def extent(board: Board, strings: list[PulleyString]) -> list[Array]:
    """The places [m, on the screen's axes] that a picture of strings to scale has to hold."""
    views = board.views
    spots = [lengths(board.motions, x, views)[0] for x in strings]
    spots += [board.r[end.point] for x in strings for end in x.ends]
    return [board.view @ x for x in spots]


# -- places on the screen ---------------------------------------------------------------------------------------------


def lay_strings(board: Board, parts: list[Player], strings: list[PulleyString]) -> list[Laid]:
    """Move the ends of strings to their places beside their pulleys, and return where the strings lie."""
    laid: list[Laid] = []
    carries = {x.holder for x in strings if x.holder}
    for string in strings:
        _lengthen(board, string)
        if any(end.along is None for end in string.ends):
            laid.append(_swinging(board, string))
        elif string.parallel:
            laid.append(_hanging(board, string, WIDE if any(e.point in carries for e in string.ends) else NARROW))
        else:
            laid.append(_around_corner(board, parts, string))
    for one in laid:
        for k, end in enumerate(one.string.ends):
            one.ends[k][:] = board.at(end.point) + _lift(board, parts, end.point)
    return laid


def _lengthen(board: Board, string: PulleyString) -> None:
    """Move both ends away from the pulley, as far as a string needs whose length is not known."""
    centre, _, _ = lengths(board.motions, string, board.views)
    place = board.at(string.holder) if string.holder else board.scale * (board.view @ centre)
    sides = [(end, _seen(board, string, end)) for end in string.ends if end.along is not None]
    lack = max(SHORTEST - float((board.at(end.point) - place) @ e) for end, e in sides)
    body = string.pulley
    lack += board.pixels(body.radius) if body is not None and body.radius is not None else 0.0
    known = lengths(board.motions, string, board.views)[2] * board.scale > SHORTEST
    for end, e in sides if lack > 0 and not known else ():
        _move(board, end.point, lack * e)


def _seen(board: Board, string: PulleyString, end: StringEnd) -> Array:
    """The direction of an end's line on the screen."""
    e = board.seen(along(string, end, board.views))
    return e / np.linalg.norm(e)


def _move(board: Board, k: int, by: Array) -> None:
    x, y = board.shifts.get(k, (0.0, 0.0))
    board.shifts[k] = (x + float(by[0]), y + float(by[1]))


def _hanging(board: Board, string: PulleyString, usual: float) -> Laid:
    """Both ends beside one another under a pulley, or each under its own."""
    a, b = string.ends
    e = _seen(board, string, a)
    n = np.array([e[1], -e[0]])  # to the right, where e points downward
    place = lengths(board.motions, string, board.views)[0]
    centre = board.at(string.holder) if string.holder else board.scale * (board.view @ place)
    left, right = (float(board.at(end.point) @ n) for end in (a, b))
    gap = abs(right - left)
    side = 1.0 if right >= left - 1e-6 else -1.0
    pulley, radius = string.pulley, usual
    if pulley is not None and pulley.radius is not None:
        centre = board.at(pulley.point)
        radius = board.pixels(pulley.radius)
    elif gap > 30.0:
        radius = max(gap / 2, usual if usual == WIDE else 0.0) if gap < 150.0 else SMALL
        if not string.holder:
            centre = centre + ((left + right) / 2 - float(centre @ n)) * n
    second = None
    if gap >= 150.0 and string.fold == 1 and (pulley is None or pulley.radius is None):
        middle = (left + right) / 2
        centre, second = (centre + side * k * (gap / 2 - radius) * n for k in (-1.0, 1.0))
        starts = centre - side * radius * n, second + side * radius * n
        targets = left, right
    else:
        middle = float(centre @ n)
        starts = centre - side * radius * n, centre + side * radius * n
        loop = NARROW * 0.6 if string.fold == 2 else 0.0
        targets = middle - side * radius, middle + side * (radius + loop)
    for end, wanted in zip((a, b), targets, strict=True):
        _move(board, end.point, (wanted - float(board.at(end.point) @ n)) * n)
    return Laid(string, string.holder, centre, radius, starts, (np.zeros(2), np.zeros(2)), second)


def _swinging(board: Board, string: PulleyString) -> Laid:
    """A mass that swings below one pulley, its counterweight below another one beside it."""
    a, b = string.ends
    swings, slides = (a, b) if a.along is None else (b, a)
    e = _seen(board, string, slides)
    home = board.at(board.motions.holds[swings.point].holder)
    way = board.at(slides.point) - home
    foot = home + way - float(way @ e) * e
    beside = float(np.linalg.norm(foot - home))
    if beside < 2 * EYE:
        n = np.array([-e[1], e[0]])
        _move(board, slides.point, home + EYE * n - foot)
        first, second, start = home, None, home + EYE * n
    else:
        first, second, start = foot + EYE * (home - foot) / beside, home, foot
    starts = (home, start) if a is swings else (start, home)
    return Laid(string, 0, first, EYE, starts, (np.zeros(2), np.zeros(2)), second)


def _around_corner(board: Board, parts: list[Player], string: PulleyString) -> Laid:
    """A pulley where two lines meet: it touches both."""
    a, b = string.ends
    one, two = _seen(board, string, a), _seen(board, string, b)
    p, q = (board.at(end.point) + _lift(board, parts, end.point) for end in (a, b))
    s, _ = np.linalg.solve(np.array([one, -two]).T, q - p)
    corner = p + s * one
    half = float(np.arccos(np.clip(one @ two, -1.0, 1.0))) / 2
    middle = (one + two) / np.linalg.norm(one + two)
    pulley = string.pulley
    radius = SMALL if pulley is None or pulley.radius is None else board.pixels(pulley.radius)
    centre = corner + radius / np.sin(half) * middle
    if pulley is not None:
        by = board.at(pulley.point) - centre
        _move(board, a.point, by)
        _move(board, b.point, by)
        centre, corner = centre + by, corner + by
    starts = corner + radius / np.tan(half) * one, corner + radius / np.tan(half) * two
    return Laid(string, string.holder, centre, radius, starts, (np.zeros(2), np.zeros(2)))


def _lift(board: Board, parts: list[Player], k: int) -> Array:
    """From a body's point to where its string ends: half the height of a block that lies on its line."""
    part = next((x for x in parts if x.point == k), None)
    if part is None or part.glyph is not BodyGlyph.BLOCK or part.direction is None:
        return np.zeros(2)
    angle, normal = slide_heading(board, part)
    upright = board.motions.holds[k].how is not HoldKind.SLIDE or abs(np.sin(angle)) >= 1 - FLAT
    return np.zeros(2) if upright else BLOCK[1] / 2 * normal
