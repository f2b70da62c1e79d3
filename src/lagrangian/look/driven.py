"""Draws points that are moved as functions of time: on a circle with its radius, otherwise to and fro."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import BEHIND, Board
from lagrangian.look.shapes import arc, heading, line
from lagrangian.page.scene import Disc

Array = NDArray[np.float64]

TIMES = (0.0, 0.31, 0.83)
"""The times [s] at which a path is asked whether it is a circle."""

ROUND = 1e-9
"""A point moves on a circle if its radius and its velocity are at right angles up to this cosine."""


def driven(board: Board, k: int) -> None:
    """A double arrow beside a support that is moved as a function of time."""
    rate = board.seen(board.motions.views.rt[0, k])
    e = rate / (np.linalg.norm(rate) or 1.0)
    n = np.array([-e[1], e[0]])
    n = n if n[0] < 0 else -n
    at = board.at(k) + 32.0 * n
    board.arrow(at, at + 20.0 * e, "input", kind="driven", width=1.6)
    board.arrow(at, at - 20.0 * e, "input", kind="driven", width=1.6)


def driven_round(board: Board, k: int) -> bool:
    """The circle on which a point is moved, with its centre, radius and sense; whether there is one."""
    found = _circle(board, k, board.p)
    if board.stage.dimension == 3 or found is None:
        return False
    centre, radius, sense = found
    base, pixels = board.stage.fixed(centre.tolist()), board.scale * radius
    middle, at = board.at(base), board.at(k)
    place = board.placed(base)
    board.put(arc(pixels, 0.0, 2 * pi), "thin", place, kind="driven", width=1.2, dashed=True, layer=BEHIND)
    board.put(Disc((0.0, 0.0), 2.4), "ground", place, kind="driven", solid=True, layer=BEHIND)
    board.put(line((0.0, 0.0), (1.0, 0.0)), "thin", board.towards(base, k), kind="driven", width=1.2, layer=BEHIND)
    board.fence(middle, at)
    start = heading((float(at[0] - middle[0]), float(at[1] - middle[1])))
    board.bow(middle, pixels + 10.0, start - 0.5 * sense, start - 1.5 * sense, "input", kind="driven", width=1.6)
    known = _circle(board, k, board.motions.views.p)
    name = None if known is None else board.motions.named(known[1])
    if name is not None:
        away = at - middle
        board.wish((name.name,), (middle + at) / 2, (-away[1], away[0]), "thin", distance=3.0)
    return True


def _circle(board: Board, k: int, p: Array) -> tuple[Array, float, float] | None:
    """The centre [m], the radius [m] and the sense (1: counter-clockwise) of a point's path, if it is a circle."""
    views = [board.stage.views([board.q], p, t=t) for t in TIMES]
    (a, b, c), rates = [v.r[0, k] for v in views], [v.rt[0, k] for v in views]
    rows = np.array([b - a, c - a])
    if len(a) != 2 or abs(np.linalg.det(rows)) < ROUND * float(np.abs(rows).max()) ** 2:
        return None
    centre = a + np.linalg.solve(rows, [(x @ x) / 2 for x in rows])  # as far from a as from b and from c
    radius = float(np.linalg.norm(a - centre))
    for r, v in zip((a, b, c), rates, strict=True):
        if abs(float((r - centre) @ v)) > ROUND * radius * float(np.linalg.norm(v)):
            return None
    way = a - centre
    return centre, radius, float(np.sign(way[0] * rates[0][1] - way[1] * rates[0][0]))
