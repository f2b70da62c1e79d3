"""Draws what pulls a sliding body: the magnet of a coil, or the plate of a capacitor, that its position changes.

A coil pulls towards where its co-energy grows at the same current, a capacitor to where its energy shrinks at the same
charge.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from math import pi

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import BODY, GROUND, TIE, Board
from lagrangian.look.cast import BodyGlyph, Player
from lagrangian.look.circuit_glyphs import branch_names
from lagrangian.look.circuit_loops import moved_by
from lagrangian.look.shapes import BLOCK, CART, box, floor, heading, line, lines, turned
from lagrangian.look.ties import Resolver
from lagrangian.model import Capacitor, CircuitBranch, Coordinate, Inductor
from lagrangian.page.scene import Path, Placement, Role

Array = NDArray[np.float64]

GAP, LEAST, MOST = 34.0, 16.0, 80.0
"""How far a magnet is from the body that it pulls, unless the coordinate counts from it, and the bounds [px]."""
CORE = 30.0
"""The length of a magnet's core [px]."""


def draw_pulls(board: Board, parts: list[Player], resolver: Resolver) -> None:
    """Draw the magnets and plates that pull bodies along lines, where these have nothing else on that side."""
    by_point = {part.point: part for part in parts}
    for element in board.stage.model.branches:
        moving = moved_by(board, element)
        if element.name in board.hidden or len(moving) != 1:
            continue
        slope = _slope(board, element, moving[0])
        tie = resolver.driven(element, moving[0].symbol)
        part = by_point.get(tie.b) if isinstance(tie.b, int) and tie.way == "slides" and tie.a is None else None
        if part is None or part.direction is None or part.glyph not in (BodyGlyph.CART, BodyGlyph.BLOCK):
            continue
        if not slope or not np.isfinite(slope):
            continue
        e = np.sign(slope) * tie.sign * board.seen(part.direction)
        e = e / np.linalg.norm(e)
        if (part.point, 1.0 if e[0] - e[1] > 0 else -1.0) not in board.walled:
            _draw(board, element, part, board.stage.model.coordinates.index(moving[0]), e)


def _slope(board: Board, element: CircuitBranch, coordinate: Coordinate) -> float:
    """The force along a coordinate [N] at a current of 1 A or a charge of 1 C."""
    model, stage = board.stage.model, board.stage
    if isinstance(element, Inductor):
        work = element.coenergy_of_current()
    elif isinstance(element, Capacitor):
        work = -element.energy if element.C is None else -1 / (2 * element.C)
    else:
        return 0.0
    unit = model.expand(work).subs({s: sp.S.One for s in work.free_symbols if str(s) in ("current", "charge")})
    return float(stage.slopes(unit, board.q, board.p)[model.coordinates.index(coordinate)])


def _draw(board: Board, element: CircuitBranch, part: Player, number: int, e: Array) -> None:
    """A magnet or plate at rest beside a body, on the side given by e."""
    k, of = part.point, (element.name,)
    w, h = CART if part.glyph is BodyGlyph.CART else BLOCK
    half = w / 2 if abs(e[0]) > 0.5 else h / 2
    way = board.scale * board.seen(board.views.J[0, k, :, number]) * board.q[number]
    home = -float(way @ e) - half  # from the edge to where the coordinate counts from
    gap = float(np.clip(home, LEAST, MOST)) if home > LEAST else GAP
    x, y = board.shift(k)
    base, angle = board.stage.fixed(board.r[k]), heading((float(e[0]), float(e[1])))
    face = board.at(k) + (half + gap) * e

    def put(path: Path, role: Role, *, body: float | None = None, filled: bool = False, width: float = 1.6) -> None:
        far = half + gap if body is None else half + body
        anchor = board.anchor(base if body is None else k)
        place = Placement(anchor, shift=(x + far * float(e[0]), y + far * float(e[1])))
        board.put(
            turned(path, angle), role, place, of=of if role != "ground" else (), kind="pull", filled=filled,
            width=width, layer=GROUND if role == "ground" else BODY if filled else TIE,
        )  # fmt: skip

    if isinstance(element, Inductor):
        role, long = "body", CORE
        core = turned(box(CORE, 22.0), 0.0, CORE / 2, 0.0)
        put(core, role, filled=True)
        put(lines(*(((s, -13.0), (s + 5.0, 13.0)) for s in np.arange(4.0, CORE - 6.0, 5.0))), role, width=1.8)
    else:
        role, long = "stiffness", 14.0
        put(lines(((0.0, -20.0), (0.0, 20.0))), role, width=3.0)
        put(line((0.0, 0.0), (long, 0.0)), role)
        put(lines(((2.5, -20.0), (2.5, 20.0))), role, body=0.0, width=3.0)
    put(turned(floor(-22.0, 22.0), -pi / 2, long, 0.0), "ground")
    middle = face + long / 2 * e
    board.block(
        middle + 6.0 * e, (long + 14.0) * abs(e[0]) + 44.0 * abs(e[1]), (long + 14.0) * abs(e[1]) + 44.0 * abs(e[0])
    )
    across = np.array([-e[1], e[0]])
    board.wish(branch_names(element), middle, across if across[0] - across[1] > 0 else -across, role, of, distance=16.0)
