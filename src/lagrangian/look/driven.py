"""Draws points that are moved as functions of time: on a circle with its radius, otherwise to and fro."""

from __future__ import annotations

from collections.abc import Iterable
from math import pi
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import BEHIND, BODY, Board
from lagrangian.look.shapes import arc, heading, line
from lagrangian.model import Element
from lagrangian.model.names import time
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
    to_and_fro(board, board.at(k) + 32.0 * n, e, moving_names(board, board.stage.model.position(board.stage.points[k])))


def to_and_fro(board: Board, at: Array, e: Array, names: tuple[str, ...]) -> None:
    """A double arrow at a place on the screen along the direction e, with the letters of the motion."""
    board.arrow(at, at + 20.0 * e, "input", kind="driven", width=1.6)
    board.arrow(at, at - 20.0 * e, "input", kind="driven", width=1.6)
    side = np.array([-e[1], e[0]])
    board.wish(names, at, side if side[0] < 0 else -side, "input", distance=5.0)


def moving_names(board: Board, expressions: Iterable[Any]) -> tuple[str, ...]:
    """The letters in what moves as a function of time, such as those of an amplitude and a frequency."""
    model = board.stage.model
    still = {c.symbol: sp.Dummy() for c in model.coordinates}
    found = list[sp.Expr]()
    moved: list[Any] = [model.expand(expr).xreplace(still) for expr in expressions]
    for term in (x for expr in moved for x in sp.Add.make_args(expr)):
        if term.has(time):
            functions = [f for f in term.atoms(sp.core.function.AppliedUndef) if f.args == (time,)]
            found += functions or [s for s in term.free_symbols if s != time and not isinstance(s, sp.Dummy)]
    return tuple(sorted({str(getattr(x, "name", None) or x.func) for x in found}))[:3]


def moved_by_time(board: Board, element: Element) -> bool:
    """Whether the other end of an element along a deflection is moved as a function of time."""
    deflection = getattr(element, "deflection", None)
    if deflection is None:
        return False
    model = board.stage.model
    still = {c.symbol: sp.Dummy() for c in model.coordinates}
    return bool(model.expand(deflection).xreplace(still).has(time))


def driven_round(board: Board, k: int, home: int = 0) -> bool:
    """The circle on which a point is moved against ``home``, with its centre, radius and sense; whether it is one."""
    found = _circle(board, k, home, board.p)
    if board.stage.dimension == 3 or found is None:
        return False
    centre, radius, sense = found
    base = home if home and not centre.any() else board.stage.add(home, [sp.Float(float(x), 17) for x in centre])
    pixels, layer = board.scale * radius, BODY + 1 if home else BEHIND
    middle, at = board.at(base), board.at(k)
    place = board.placed(base)
    board.put(arc(pixels, 0.0, 2 * pi), "thin", place, kind="driven", width=1.2, dashed=True, layer=layer)
    board.put(Disc((0.0, 0.0), 2.4), "ground", place, kind="driven", solid=True, layer=layer)
    board.put(line((0.0, 0.0), (1.0, 0.0)), "thin", board.towards(base, k), kind="driven", width=1.2, layer=layer)
    board.fence(middle, at)
    start = heading((float(at[0] - middle[0]), float(at[1] - middle[1])))
    begin, end = start - 0.5 * sense, start - 1.5 * sense
    board.bow(middle, pixels + 10.0, begin, end, "input", kind="driven", width=1.6)
    known = _circle(board, k, home, board.motions.views.p)
    name = None if known is None else board.motions.named(known[1])
    if name is not None:
        away = at - middle
        board.wish((name.name,), (middle + at) / 2, (-away[1], away[0]), "thin", distance=3.0)
    names = moving_names(board, board.stage.model.position(board.stage.points[k]))
    tip = np.array([np.cos(end), np.sin(end)])
    others = [x for x in names if name is None or x != name.name]
    board.wish(others, middle + (pixels + 10.0) * tip, tip, "input", distance=4.0)
    return True


def _circle(board: Board, k: int, home: int, p: Array) -> tuple[Array, float, float] | None:
    """The centre and radius [m] and the sense (1: counter-clockwise) of a point's path as seen from ``home``.

    None if that path is no circle.
    """
    views = [board.stage.views([board.q], p, t=t) for t in TIMES]
    (a, b, c), rates = [v.r[0, k] - v.r[0, home] for v in views], [v.rt[0, k] - v.rt[0, home] for v in views]
    rows = np.array([b - a, c - a])
    if len(a) != 2 or abs(np.linalg.det(rows)) < ROUND * float(np.abs(rows).max()) ** 2:
        return None
    centre = a + np.linalg.solve(rows, [(x @ x) / 2 for x in rows])  # as far from a as from b and from c
    radius = float(np.linalg.norm(a - centre))
    centre = np.where(np.abs(centre) < ROUND * radius, 0.0, centre)
    for r, v in zip((a, b, c), rates, strict=True):
        if abs(float((r - centre) @ v)) > ROUND * radius * float(np.linalg.norm(v)):
            return None
    way = a - centre
    return centre, radius, float(np.sign(way[0] * rates[0][1] - way[1] * rates[0][0]))
