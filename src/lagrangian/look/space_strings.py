"""Strings through a hole, in space: one body turns about it at a distance, another one hangs on its other end.

A model says nothing of the string. What it says is that the distances of both bodies from a point at rest have a
constant sum: ∂ℓ_a/∂q + ∂ℓ_b/∂q = 0 at all states, where one body moves along a line through that point.
"""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import BODY, GROUND, JOINT, Board
from lagrangian.look.cast import Player, direction
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.look.shapes import INK, line
from lagrangian.look.space_solids import Solids, across
from lagrangian.look.strings import PulleyString, StringEnd
from lagrangian.page.scene import Disc, Trace

Array = NDArray[np.float64]

SAME = 1e-8
"""Slopes that differ by less than this share are equal."""
BEYOND = 1.25
"""How far the table reaches beyond the body on it."""


def strings_through(motions: Motions, players: list[Player], r: Array) -> list[PulleyString]:
    """The strings of a system in space; ``r`` (points, 3) are the positions [m] of the picture."""
    found: list[PulleyString] = []
    reeled = [x for x in players if motions.holds[x.point].how is HoldKind.TELESCOPE]
    hanging = [x for x in players if motions.slides(x.point, 0)] if reeled else []
    for one in reeled:
        hold = motions.holds[one.point]
        if not motions.still(hold.holder):
            continue
        d, D = motions.local(one.point, hold.holder, None)
        first = StringEnd(one.point, None, np.einsum("sd,sdn->sn", d, D) / np.linalg.norm(d, axis=1)[:, None])
        for two in hanging:
            end = None if two is one else _hanging(motions, two.point, hold.holder, first.slopes)
            if end is not None and float((r[two.point] - r[hold.holder]) @ end.along) > 0:
                found.append(PulleyString(hold.holder, (first, end)))
    return found


def _hanging(motions: Motions, k: int, hole: int, slopes: Array) -> StringEnd | None:
    """The end of a string at a sliding body, if its line goes through the hole and gains what the other end loses."""
    d, J = motions.local(k, hole, None)
    e = direction(J[0])
    if np.abs(np.cross(d, e)).max() > SAME * motions.size:
        return None
    own = np.einsum("d,sdn->sn", e, J)
    for sign in (1.0, -1.0):
        if np.abs(slopes + sign * own).max() < SAME * float(np.abs(slopes).max()):
            return StringEnd(k, sign * e, sign * own)
    return None


def draw_strings_through(board: Board, solids: Solids, strings: list[PulleyString]) -> None:
    """The hanging part of every string, its hole, and the rim of the table on which the other end turns."""
    for string in strings:
        hole, (first, second) = string.holder, string.ends
        of = [b.name for b in board.stage.model.bodies if board.stage.index(b.at) == second.point]
        with solids.item(hole, second.point, radius=2.0):
            place = board.towards(hole, second.point)
            board.put(line((0.0, 0.0), (1.0, 0.0)), "rod", place, of=of, kind="rope", width=1.6, layer=BODY)
        board.fence(board.at(hole), board.at(second.point))
        board.put(Disc((0.0, 0.0), 3.6), "ground", board.placed(hole), kind="hole", width=INK, layer=JOINT)
        _table(board, hole, first.point, second.along)


def _table(board: Board, hole: int, k: int, normal: Array | None) -> None:
    """A circle about the hole across the hanging string, if the body on the other end stays in that plane."""
    r, J = board.motions.views.r, board.motions.views.J
    if normal is None or max(np.abs((r[:, k] - r[:, hole]) @ normal).max(), np.abs(normal @ J[0, k]).max()) > SAME:
        return
    u, v = across(normal)
    radius = BEYOND * float(np.linalg.norm(board.r[k] - board.r[hole]))
    turns = np.linspace(0.0, 2 * pi, 49)
    spots = board.r[hole] + radius * (np.cos(turns)[:, None] * u + np.sin(turns)[:, None] * v)
    anchors = tuple(board.anchor(board.stage.fixed(spot)) for spot in spots)
    board.put(Trace(anchors), "ground", kind="table", width=1.2, layer=GROUND)
    seen = board.scale * (spots @ board.view.T)
    for a, b in zip(seen[:-1:3], seen[3::3], strict=True):
        board.fence(a, b)
