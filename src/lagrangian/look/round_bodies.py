"""Draws wheels, pulleys and gears, the circles on which they roll, and the marks of centres of mass."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import itertools
from math import pi
from typing import Any

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.look.board import BODY, JOINT, Board
from lagrangian.look.cast import FLAT, BodyGlyph, Player
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.look.shapes import line, quarters
from lagrangian.model import RigidBody
from lagrangian.page.scene import Disc, Trace

HOOP = 5.0
"""The width of a hoop's line [px]."""
COG = 6.0
"""The radius of the mark of a centre of mass [px]."""


def mass_names(part: Player) -> tuple[str, ...]:
    """The symbols of the mass and, of a body that turns, of its inertia."""
    entries = [part.body.mass]
    if isinstance(part.body, RigidBody):
        tensor = part.body.tensor
        entries += [tensor[0][0]] if len(tensor) == 1 else []
    return tuple(str(x.name) for x in entries if isinstance(x, sp.Symbol))


def _track(board: Board, part: Player) -> None:
    """The circle on which a wheel rolls, inside or outside, if its radius is a parameter."""
    hold = board.motions.holds[part.point]
    if hold.how is not HoldKind.ROD or part.radius is None:
        return
    r = board.motions.views.r[0]
    orbit = float(np.linalg.norm(r[part.point] - r[hold.holder]))
    values: Any = {x.symbol: v for x, v in zip(board.stage.model.parameters, board.motions.views.p, strict=True)}
    own = values.get(part.radius)
    if own is None:
        return
    for outside, value in ((False, orbit + own), (True, abs(orbit - own))):
        radius = board.motions.named(value)
        if radius is None:
            continue
        size = board.stage.value(radius, board.q, board.p)
        way = board.r[part.point] - board.r[hold.holder]
        down = float(np.arctan2(way[1], way[0]))
        spots = [
            board.r[hold.holder] + size * np.array([np.cos(a), np.sin(a)])
            for a in (np.linspace(0, 2 * pi, 49) if outside else np.linspace(down - 1.2, down + 1.2, 33))
        ]
        anchors = tuple(board.anchor(board.stage.fixed(spot)) for spot in spots)
        board.put(Trace(anchors), "rod", kind="wire", width=2.2, layer=BODY - 6)
        seen = [board.scale * (board.view @ spot) for spot in spots]
        for a, b in itertools.pairwise(seen):
            board.fence(a, b)
        board.wish((radius.name,), seen[-3], seen[-3] - seen[len(seen) // 2], "thin", distance=4.0)
        return


def draw_wheel(board: Board, part: Player) -> None:
    """A circle with a spoke that turns with it, at its true radius."""
    assert part.radius is not None and part.frame is not None
    of, k = (part.name,), part.point
    _track(board, part)
    rim = board.stage.add(k, (part.radius, 0), board.stage.frames[part.frame])
    radius = float(np.linalg.norm(board.r[rim] - board.r[k])) * board.scale
    place = board.towards(k, rim, "both")
    if _is_hoop(part):
        board.put(Disc((0.0, 0.0), 1.0), "body", place, of=of, kind="hoop", width=HOOP, layer=BODY - 1)
    else:
        board.put(Disc((0.0, 0.0), 1.0), "body", place, of=of, kind="wheel", filled=True, layer=BODY - 1)
    board.put(line((0.0, 0.0), (1.0, 0.0)), "thin", place, of=of, kind="wheel", width=1.0, layer=BODY)
    cog(board, part, 5.0)
    at = board.at(k)
    board.block(at, 1.5 * radius, 1.5 * radius)
    board.wish(mass_names(part), at + (0.75 * radius, 0.4 * radius), (1.0, 0.35), "body", of, distance=0.3 * radius)
    if isinstance(part.radius, sp.Symbol):
        spoke = board.at(rim) - at
        board.wish(
            (part.radius.name,), at + spoke / 2, (spoke[1], -spoke[0]), "thin", of, distance=2.0, inside=radius > 30
        )


def _is_hoop(part: Player) -> bool:
    """Whether all mass of a wheel is on its rim: J = m R²."""
    if not isinstance(part.body, RigidBody) or part.radius is None:
        return False
    return bool(bounded.expand(part.body.tensor[0][0] - part.body.mass * part.radius**2) == 0)


def unwinds(motions: Motions, part: Player) -> bool:
    """Whether a wheel rolls up and down a vertical line under gravity: on a string, as a yo-yo."""
    vertical = part.direction is not None and abs(part.direction[0]) < FLAT and motions.stage.dimension == 2
    rolls = part.glyph is BodyGlyph.WHEEL and motions.holds[part.point].how is HoldKind.SLIDE
    return vertical and rolls and any(e.kind == "gravity" for e in motions.stage.model.elements)


def cog(board: Board, part: Player, radius: float) -> None:
    """The mark of a centre of mass: a circle with two black quarters."""
    of, place = (part.name,), board.placed(part.point)
    board.put(Disc((0.0, 0.0), radius), "body", place, of=of, kind="centre", width=1.2, filled=True, layer=JOINT + 1)
    for quarter in quarters(radius):
        board.put(quarter, "body", place, of=of, kind="centre", width=0.0, solid=True, layer=JOINT + 2)
    board.block(board.at(part.point), 2 * radius, 2 * radius)
