"""Draws constraints: pins, sliders, welds, ropes, rods, wheels that roll; and lines that a hint asks for."""

from __future__ import annotations

import itertools
from math import pi

import numpy as np

from lagrangian.look.board import BEHIND, BODY, GROUND, JOINT, Board
from lagrangian.look.cast import Player
from lagrangian.look.shapes import box, floor, heading, line, turned
from lagrangian.model import Ball, Constraint, Element, Pin, Rolling, Rope, Slider, VelocityConstraint, Weld
from lagrangian.page.scene import Disc, Role, Trace

LINE_KINDS: dict[str, tuple[Role, float]] = {
    "string": ("rod", 1.6), "rod": ("rod", 3.0), "wire": ("rod", 2.0),
    "wall": ("ground", 2.0), "floor": ("ground", 2.0),
}  # fmt: skip


def draw_constraints(board: Board, parts: list[Player], lines: tuple[tuple[str, tuple[str, ...]], ...]) -> None:
    """Draw every constraint that has points; an expression has nothing to show and is told."""
    for element in board.stage.model.constraints:
        if element.name not in board.hidden:
            _one(board, parts, element)
    names = {p.name: k for k, p in enumerate(board.stage.points) if p.name} | {"origin": 0}
    for kind, through in lines:
        role, width = LINE_KINDS[kind]
        numbers = [names[name] for name in through]
        anchors, shifts = tuple(board.anchor(k) for k in numbers), tuple(board.shift(k) for k in numbers)
        board.put(Trace(anchors, False, shifts), role, kind=kind, width=width, layer=BODY - 6)
        for a, b in itertools.pairwise(numbers):
            board.fence(board.at(a), board.at(b))


def _one(board: Board, parts: list[Player], element: Element) -> None:
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
        _contact(board, parts, element)
    elif isinstance(element, VelocityConstraint) and getattr(element, "at", None) is not None:
        k = board.stage.index(element.at)
        board.put(
            line((-13.0, 0.0), (13.0, 0.0)), "constraint", board.placed(k), of=of, kind="edge", width=4.0, layer=JOINT
        )
    else:
        board.lacks(f"{element.title} is not drawn, because it is an expression", "")


def _slider(board: Board, element: Slider) -> None:
    """A guide through the second point along its direction, and a sleeve at the first."""
    a, b = (board.stage.index(p) for p in element.between)
    along = [board.stage.value(x, board.q, board.p) for x in element.along]
    views = board.stage.views([board.q], board.p)
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


def _contact(board: Board, parts: list[Player], element: Rolling) -> None:
    """The ground under the point of contact."""
    k = board.stage.index(element.at)
    part = next((x for x in parts if x.body is element.body), None)
    if board.stage.dimension == 3 or part is None:
        board.put(
            Disc((0.0, 0.0), 3.0),
            "constraint",
            board.placed(k),
            of=(element.name,),
            kind="contact",
            filled=True,
            layer=JOINT,
        )
        return
    board.put(
        Disc((0.0, 0.0), 3.0),
        "constraint",
        board.placed(k),
        of=(element.name,),
        kind="contact",
        filled=True,
        layer=JOINT,
    )
