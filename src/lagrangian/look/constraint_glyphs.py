"""Draws constraints: pins, sliders, welds, ropes, rods, wheels that roll."""

from __future__ import annotations

import itertools
from math import pi

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import BEHIND, BODY, GROUND, JOINT, Board
from lagrangian.look.cast import Player
from lagrangian.look.shapes import BAR, box, floor, heading, line, turned
from lagrangian.model import Ball, Constraint, Element, Frame, Pin, Rolling, Rope, Slider, VelocityConstraint, Weld
from lagrangian.page.scene import Disc, Trace

Array = NDArray[np.float64]


def draw_constraints(board: Board, parts: list[Player]) -> None:
    """Draw every constraint that has points; an expression has nothing to show and is told."""
    for element in board.stage.model.constraints:
        if element.name not in board.hidden:
            draw_one(board, parts, element)


def draw_one(board: Board, parts: list[Player], element: Element) -> None:
    """Draw one constraint."""
    of = (element.name,)
    if isinstance(element, Pin | Ball | Weld):
        k = board.stage.index(element.between[0])
        place = board.placed(k)
        if isinstance(element, Weld):
            board.put(box(11.0, 11.0), "constraint", place, of=of, kind="weld", filled=True, layer=JOINT + 3)
        else:
            board.put(
                Disc((0.0, 0.0), 4.4), "constraint", place, of=of, kind="pin", filled=True, layer=JOINT + 3, width=2.0
            )
        board.block(board.at(k), 11, 11)
        return
    if isinstance(element, Slider):
        _slider(board, element)
    elif isinstance(element, Rope):
        numbers = [board.stage.index(p) for p in element.through]
        anchors, shifts = tuple(board.anchor(k) for k in numbers), tuple(board.shift(k) for k in numbers)
        board.put(Trace(anchors, False, shifts), "constraint", of=of, kind="rope", width=1.8, layer=BODY - 6)
        for k in numbers[1:-1]:
            board.put(Disc((0.0, 0.0), 7.0), "ground", board.placed(k), kind="peg", filled=True, layer=BODY - 5)
            board.block(board.at(k), 15, 15)
        for a, b in itertools.pairwise(numbers):
            board.fence(board.at(a), board.at(b))
    elif isinstance(element, Constraint) and element.between:
        a, b = (board.stage.index(p) for p in element.between)
        if np.linalg.norm(board.at(a) - board.at(b)) > 2.0:
            board.put(
                line((0.0, 0.0), (1.0, 0.0)), "rod", board.towards(a, b), of=of, kind="rod", width=3.0, layer=BODY - 5
            )
            board.fence(board.at(a), board.at(b))
            for k in (a, b):
                if board.motions.still(k):
                    from lagrangian.look.supports import support

                    support(board, k, board.at(b if k == a else a) - board.at(k))
    elif isinstance(element, Rolling):
        _contact(board, element)
    elif not _of_expression(board, element):
        board.lacks(f"{element.title} is not drawn, because it is an expression", "")


def _of_expression(board: Board, element: Element) -> bool:
    """Draw a constraint that is an expression, if it keeps a point on a line, or from moving sideways."""
    if isinstance(element, Constraint):
        return _stop(board, element)
    return isinstance(element, VelocityConstraint) and _edge(board, element)


def _stop(board: Board, element: Constraint) -> bool:
    """The floor or wall of an expression that keeps a point on a horizontal or vertical line; whether it is one."""
    if board.stage.dimension == 3 or element.expression is None:
        return False
    rng, p = np.random.default_rng(9), board.motions.views.p
    states = [rng.uniform(0.4, 1.3, len(board.q)) for _ in range(2)]
    slopes = [board.stage.slopes(element.expression, q, p) for q in states]
    J = board.stage.views(states, p).J
    for k in range(1, len(board.stage.points)):
        for axis in (1, 0):
            for sign in (1.0, -1.0):
                if all(np.abs(sign * j[k, axis] - g).max() < 1e-9 for j, g in zip(J, slopes, strict=True)):
                    _wall(board, element, k, axis)
                    return True
    return False


def _wall(board: Board, element: Constraint, k: int, axis: int) -> None:
    """Hatched ground at a point: below it, or on the side away from the other bodies."""
    middle = np.mean([board.at(board.stage.index(b.at)) for b in board.stage.model.bodies], axis=0)
    away = board.at(k) - middle
    upright, level = (pi / 2 if away[0] < 0 else -pi / 2), (0.0 if away[1] >= 0 else pi)
    angle = level if axis == 1 else upright
    base = board.stage.fixed(board.r[k])
    half = BAR / 2 * np.array([-np.sin(angle), np.cos(angle)])
    place = board.placed(base, float(half[0]), float(half[1]))
    shape = turned(floor(-70.0, 70.0), angle)
    board.put(shape, "ground", place, of=(element.name,), kind="floor", layer=GROUND)
    e = 70.0 * np.array([np.cos(angle), np.sin(angle)])
    board.fence(board.at(k) + half - e, board.at(k) + half + e)


def _edge(board: Board, element: VelocityConstraint) -> bool:
    """What cannot move sideways, seen from above: a wheel at its point; whether there is such a point."""
    if board.stage.dimension == 3:
        return False
    found = _named_edge(board, element) if element.expression is None else _found_edge(board, element)
    if found is None:
        return False
    k, along, frame = found
    offset = [sp.Float(float(x) * 20.0 / board.scale) for x in along]
    tip = board.stage.add(k, offset, frame)
    place = board.towards(k, tip, "none")
    of = (element.name,)
    board.put(box(30.0, 9.0, round_by=3.0), "constraint", place, of=of, kind="wheel", filled=True, layer=JOINT)
    board.block(board.at(k), 24, 24)
    return True


def _named_edge(board: Board, element: VelocityConstraint) -> tuple[int, Array, Frame | None] | None:
    """The point of a row with one direction that is given, and the direction in which it can move."""
    rows = [element.along] if not isinstance(element.along[0], tuple) else list(element.along)
    if len(rows) != 1:
        return None
    across = np.array([board.stage.value(x, board.q, board.p) for x in rows[0]])
    return board.stage.index(element.at), np.array([across[1], -across[0]]), element.axes


def _found_edge(board: Board, element: VelocityConstraint) -> tuple[int, Array, Frame | None] | None:
    """The point and frame of which a row says n·v = 0, with n at rest in the frame; found by numbers."""
    stage, views = board.stage, board.motions.views
    rng = np.random.default_rng(7)
    states = [rng.uniform(0.4, 1.3, len(board.q)) for _ in range(3)]
    seen = stage.views(states, views.p)
    rows = [stage.rate_slopes(element.expression, q, views.p) for q in states]
    for k in range(1, len(board.motions.holds)):
        normals = [np.linalg.lstsq(J[k].T, row, rcond=None)[0] for J, row in zip(seen.J, rows, strict=True)]
        fits = [np.abs(J[k].T @ n - row).max() < 1e-9 for J, row, n in zip(seen.J, rows, normals, strict=True)]
        if not all(fits) or min(float(np.linalg.norm(n)) for n in normals) < 1e-6:
            continue
        for f, frame in enumerate(stage.frames):
            own = np.array([R[f].T @ (n / np.linalg.norm(n)) for R, n in zip(seen.R, normals, strict=True)])
            if np.ptp(own, axis=0).max() < 1e-9:
                return k, np.array([own[0][1], -own[0][0]]), frame
    return None


def _slider(board: Board, element: Slider) -> None:
    """A guide through the second point along its direction, and a sleeve at the first."""
    a, b = (board.stage.index(p) for p in element.between)
    along = [board.stage.value(x, board.q, board.p) for x in element.along]
    views = board.views
    if element.axes is not None:
        along = list(views.R[0, board.stage.frames.index(element.axes)] @ np.array(along))
    e = board.seen(along)
    size = float(np.linalg.norm(e))
    if size < 1e-6:
        return
    angle = heading((float(e[0]), float(e[1])))
    of, place = (element.name,), board.placed(a)
    if board.motions.still(b):
        for side in (-1.0, 1.0):
            guide = turned(floor(-58.0, 58.0), angle + (pi if side < 0 else 0.0))
            n = side * 19.0 * np.array([-np.sin(angle), np.cos(angle)])
            board.put(
                guide, "ground", board.placed(b, *(board.at(a) - board.at(b) + n)), of=of, kind="guide", layer=GROUND
            )
        board.block(board.at(a), 60, 46)
    board.put(
        turned(box(30.0, 20.0, round_by=2.0), angle),
        "constraint",
        place,
        of=of,
        kind="slider",
        filled=True,
        layer=BEHIND + 14,
    )


def _contact(board: Board, element: Rolling) -> None:
    """The point of contact."""
    k = board.stage.index(element.at)
    board.put(
        Disc((0.0, 0.0), 3.0),
        "constraint",
        board.placed(k),
        of=(element.name,),
        kind="contact",
        filled=True,
        layer=JOINT,
    )
