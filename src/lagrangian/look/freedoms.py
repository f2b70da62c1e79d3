"""Counts the freedoms of what is drawn, and finds what moves together in the model and not in the picture.

Whoever reads a picture of a mechanism counts what can move: a body on a floor in one way, a rod about its joint in one,
a body in the air in two. The model has fewer freedoms where something else ties bodies together, such as a string over
a pulley, a pair of gears or a hidden rod. With v all velocities of points and angular velocities of frames, what is
drawn says A v = 0, and the model moves along the columns of M, A M = 0. The rows α with α M = 0 on the solutions of
A v = 0 are the connections that are not drawn.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import Board
from lagrangian.look.cast import BodyGlyph, Player, geared
from lagrangian.look.couplers import couplers
from lagrangian.look.gears import ArmGear
from lagrangian.look.hints import LookLine
from lagrangian.look.hoists import Hoist
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.look.pose import up_axis
from lagrangian.look.strings import PulleyString
from lagrangian.look.velocities import NONE, Drawn, complement, cross_of, turning
from lagrangian.model import Rolling

Array = NDArray[np.float64]

MOST = 4
"""How many bodies a message names."""


def say_unjoined(
    board: Board,
    parts: Sequence[Player],
    lines: Iterable[LookLine],
    strings: Iterable[PulleyString | Hoist | ArmGear] = (),
    told: Collection[str] = (),
) -> None:
    """Say which bodies move together without a part of the picture that shows why; of ``told`` it is said already."""
    through = [{board.stage.index(p) for p in line.through} for line in lines]
    for names in unjoined(board.motions, parts, strings, through):
        if board.hidden & set(names) or (told and set(told) <= set(names)):
            continue
        if len(names) == 1:
            board.lacks(f"what turns {names[0]} as it moves is not drawn", "name its radius in [parameters]")
            continue
        listed = ", ".join(f'"{name}"' for name in names[:MOST])
        *some, last = names if len(names) <= MOST else (*names[:MOST], "others")
        board.lacks(
            f"what makes {', '.join(some)} and {last} move together is not drawn",
            f'[[look.line]] with through = [{listed}] and kind = "string" or "rod" shows it',
        )


def unjoined(
    motions: Motions,
    parts: Sequence[Player],
    strings: Iterable[PulleyString | Hoist | ArmGear] = (),
    lines: Iterable[set[int]] = (),
) -> list[list[str]]:
    """Names of bodies that move together in the model and not in the picture, one list for each connection.

    ``strings`` are those that are drawn, ``lines`` the points that the lines of hints go through: what these join
    counts as drawn.
    """
    if not motions.views.J.size or not parts:
        return []
    drawn = Drawn(motions)
    for part in parts:
        drawn.point(part.point)
        if part.frame is not None:
            _framed(drawn, part.frame)
    for k in list(drawn.points):
        _held(drawn, k)
    for part in parts:
        _owned(drawn, part)
    _rods(drawn, parts)
    for string in strings:
        if isinstance(string, Hoist):
            _hoisted(drawn, string)
        elif isinstance(string, ArmGear):
            _geared(drawn, string)
        else:
            _strung(drawn, string)
    for one, two in geared(motions, parts):
        _meshing(drawn, one, two)
    _on_floor(drawn)
    return _told(drawn, parts, [*lines])


# -- what is drawn ----------------------------------------------------------------------------------------------------


def _framed(drawn: Drawn, f: int) -> None:
    """A frame turns about the axis of its joint in the frame that carries it."""
    if f in drawn.frames:
        return
    place, frames = drawn.frame(f), drawn.motions.stage.frames
    parent = frames[f].parent
    own = turning(drawn.motions, f)
    if parent is None:
        drawn.say((place, complement(own)))
        return
    home = frames.index(parent)
    _framed(drawn, home)
    rows = complement(own - turning(drawn.motions, home))
    drawn.say((place, rows), (drawn.frames[home], -rows))


def _known(drawn: Drawn, k: int) -> slice:
    """The place of a point's velocity, with what holds the point."""
    if k not in drawn.points:
        drawn.point(k)
        _held(drawn, k)
    return drawn.points[k]


def _held(drawn: Drawn, k: int) -> None:
    """A point moves against what holds it as that lets it."""
    motions, place = drawn.motions, drawn.point(k)
    hold, d = motions.holds[k], motions.stage.dimension
    if not motions.coordinates(k):
        drawn.say((place, np.eye(d)))
        return
    parent = motions.stage.points[k].parent
    home = 0 if parent is None else motions.stage.index(parent)
    h = hold.holder if motions.coordinates(k, home) else home
    other = _known(drawn, h)
    own = motions.stage.points[k].frame
    f = None if own is None else motions.stage.frames.index(own)
    if f is None or hold.how in (HoldKind.FREE, HoldKind.SLIDE):
        _, D = motions.local(k, h, None)
        rows = complement(D[0], motions.size)
        drawn.say((place, rows), (other, -rows))
        return
    _framed(drawn, f)
    _, X = motions.local(k, h, f)
    rows = complement(motions.views.R[0, f] @ X[0], motions.size)
    lever = motions.views.r[0, k] - motions.views.r[0, h]
    drawn.say((place, rows), (other, -rows), (drawn.frames[f], -rows @ cross_of(lever)))


def _owned(drawn: Drawn, part: Player) -> None:
    """The joints of a rigid body are at rest in it; a wheel rolls, a pulley turns with what hangs on it."""
    motions = drawn.motions
    if part.frame is None:
        return
    turn = drawn.frames[part.frame]
    for k in part.points:
        if k in drawn.points and k != part.point:
            lever = motions.views.r[0, k] - motions.views.r[0, part.point]
            I = np.eye(motions.stage.dimension)
            drawn.say((drawn.points[k], I), (drawn.points[part.point], -I), (turn, -cross_of(lever)))
    if part.glyph is BodyGlyph.WHEEL and motions.stage.dimension == 2:
        h = motions.holds[part.point].holder
        moved = motions.views.J[0, part.point] - motions.views.J[0, h]
        i = int(np.argmax(np.abs(turning(motions, part.frame)[0])))
        e = moved[:, i] / (float(moved[:, i] @ moved[:, i]) or 1.0) * turning(motions, part.frame)[0, i]
        drawn.say((turn, np.eye(1)), (drawn.points[part.point], -e[None]), (_known(drawn, h), e[None]))


def _rods(drawn: Drawn, parts: Sequence[Player]) -> None:
    """Rods between bodies, and those that lie on one line from one joint: they are seen as one."""
    motions, d = drawn.motions, drawn.motions.stage.dimension
    r = motions.views.r
    for a, b in couplers(motions, list(parts)):
        e = (r[0, b] - r[0, a])[None]
        drawn.say((drawn.points[a], e), (drawn.points[b], -e))
    rods = [h for k in drawn.points if (h := motions.holds[k]).how is HoldKind.ROD and motions.coordinates(k)]
    for one, two in permutations(rods, 2):
        x = motions.in_line(one, two)
        if x is not None and (two.holder == one.point or one.point < two.point):
            ends = (two.point, 1.0), (two.holder, -1.0), (one.point, -x), (one.holder, x)
            drawn.say(*((drawn.points[k], c * np.eye(d)) for k, c in ends))


def _strung(drawn: Drawn, string: PulleyString) -> None:
    """What one side of a string gains, the other one loses; its pulley turns with it."""
    motions, blocks = drawn.motions, list[tuple[slice, Array]]()
    for end, fold in zip(string.ends, (1.0, float(string.fold)), strict=True):
        h = string.holder if end.along is not None else motions.holds[end.point].holder
        d = motions.views.r[0, end.point] - motions.views.r[0, h]
        e = (d / float(np.linalg.norm(d)) if end.along is None else end.along)[None]
        blocks += [(_known(drawn, end.point), fold * e), (_known(drawn, h), -fold * e)]
    drawn.say(*blocks)
    pulley = string.pulley
    if pulley is not None and pulley.frame is not None and pulley.frame in drawn.frames:
        own, run = turning(motions, pulley.frame)[0], string.ends[0].slopes[0]
        if float(own @ own) > 0:
            ratio = float(run @ own) / float(own @ own)
            drawn.say((drawn.frames[pulley.frame], np.full((1, 1), -ratio)), *blocks[:2])


def _hoisted(drawn: Drawn, hoist: Hoist) -> None:
    """A load falls by what its wheel unwinds."""
    fall, turn = (
        hoist.down @ drawn.motions.views.J[0, hoist.load.point],
        turning(drawn.motions, hoist.wheel.frame or 0)[0],
    )
    ratio = float(fall @ turn) / float(turn @ turn)
    drawn.say(
        (_known(drawn, hoist.load.point), hoist.down[None]),
        (drawn.frames[hoist.wheel.frame or 0], np.full((1, 1), -ratio)),
    )


def _geared(drawn: Drawn, gear: ArmGear) -> None:
    """A wheel turns −n times as far as the arm that it is geared to."""
    d = drawn.motions.views.r[0, gear.tip] - drawn.motions.views.r[0, gear.joint]
    turn = gear.ratio / float(d @ d) * np.array([[-d[1], d[0]]])
    tip, joint = _known(drawn, gear.tip), _known(drawn, gear.joint)
    drawn.say((drawn.frames[gear.wheel.frame or 0], np.eye(1)), (tip, -turn), (joint, turn))


def _meshing(drawn: Drawn, one: Player, two: Player) -> None:
    a, b = drawn.frames[one.frame or 0], drawn.frames[two.frame or 0]
    first, second = turning(drawn.motions, one.frame or 0)[0], turning(drawn.motions, two.frame or 0)[0]
    ratio = float(first @ second) / float(first @ first)
    drawn.say((a, np.full((1, 1), ratio)), (b, np.full((1, 1), -1.0)))


def _on_floor(drawn: Drawn) -> None:
    """Where something rolls on a floor in space, the point of contact keeps its height."""
    stage = drawn.motions.stage
    if stage.dimension == 2:
        return
    up = up_axis(drawn.motions)[None]
    for element in stage.model.elements:
        if isinstance(element, Rolling):
            k = stage.index(element.at)
            if np.abs(up @ drawn.motions.views.J[0, k]).max() < NONE:
                drawn.say((_known(drawn, k), up))


# -- what is not ------------------------------------------------------------------------------------------------------


def _told(drawn: Drawn, parts: Sequence[Player], lines: list[set[int]]) -> list[list[str]]:
    """The bodies of every connection that is missing."""
    groups = _groups(drawn, lines)
    joined = [any(sum(drawn.points.get(k) in group for k in line) > 1 for line in lines) for group in groups]
    A, M = drawn.matrix(), drawn.model()
    bases: list[Array] = []
    owners: list[int] = []
    for number, group in enumerate(groups):
        columns = np.concatenate([np.arange(drawn.size)[place] for place in group])
        local = A[:, columns]
        local = local[np.abs(local).max(axis=1) > NONE] if len(local) else local
        free = complement(local.T) if len(local) else np.eye(len(columns))
        basis = np.zeros((drawn.size, len(free)))
        basis[columns] = free.T
        bases.append(basis)
        owners += [number] * len(free)
    N = np.hstack(bases)
    rows = _reduced(complement(N.T @ M))
    found: list[list[str]] = []
    for row in rows:
        touched = {owners[j] for j in np.flatnonzero(np.abs(row) > NONE)}
        if len(touched) == 1 and joined[min(touched)]:
            continue
        places = [place for number in touched for place in groups[number]]
        names = [
            x.name
            for x in parts
            if drawn.points[x.point] in places or (x.frame is not None and drawn.frames[x.frame] in places)
        ]
        found += [names] if names else []
    return _merged(found)


def _groups(drawn: Drawn, lines: list[set[int]]) -> list[list[slice]]:
    """The velocities that rows or lines tie together; those of points at rest tie nothing."""
    motions = drawn.motions
    fixed = {place.start for k, place in drawn.points.items() if not motions.coordinates(k)}
    home = {place.start: place.start for place in (*drawn.points.values(), *drawn.frames.values())}

    def root(x: int) -> int:
        while home[x] != x:
            x = home[x]
        return x

    ties = [[place.start for place, block in blocks if np.abs(block).max(initial=0.0) > NONE] for blocks in drawn.rows]
    ties += [[drawn.points[k].start for k in line if k in drawn.points] for line in lines]
    for tie in ties:
        moving = [x for x in tie if x not in fixed]
        for x in moving[1:]:
            home[root(x)] = root(moving[0])
    found: dict[int, list[slice]] = {}
    for place in (*drawn.points.values(), *drawn.frames.values()):
        found.setdefault(root(place.start), []).append(place)
    return [*found.values()]


def _reduced(rows: Array) -> Array:
    """The reduced row echelon form: every row touches as few columns as it can."""
    A, r = rows.copy(), 0
    for j in range(A.shape[1]):
        if r == len(A):
            break
        pivot = r + int(np.argmax(np.abs(A[r:, j])))
        if abs(A[pivot, j]) < NONE:
            continue
        A[[r, pivot]] = A[[pivot, r]]
        A[r] /= A[r, j]
        for i in range(len(A)):
            if i != r:
                A[i] -= A[i, j] * A[r]
        r += 1
    return A[:r]


def _merged(found: list[list[str]]) -> list[list[str]]:
    """Connections that have a body in common, as one."""
    merged: list[list[str]] = []
    for names in found:
        shared = [x for x in merged if set(x) & set(names)]
        for x in shared:
            merged.remove(x)
        merged.append(list(dict.fromkeys([n for x in shared for n in x] + names)))
    return merged
