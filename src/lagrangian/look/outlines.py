"""Draws what hints ask for: lines without mass and force, and outlines in the axes of frames and bodies."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from lagrangian.look.board import BODY, GROUND, Board
from lagrangian.look.cast import CHOICES, BodyGlyph, Player
from lagrangian.look.hints import Hints, LookLine, Outline
from lagrangian.look.shapes import floor, heading, turned
from lagrangian.page.scene import Role, Trace

LINES: dict[str, tuple[Role, float]] = {
    "string": ("rod", 1.6), "rod": ("rod", 3.0), "wire": ("rod", 2.0), "wall": ("ground", 2.0),
    "floor": ("ground", 2.0),
}  # fmt: skip
"""The role and the width [px] of every kind of line."""

LARGEST = 1500.0
"""A part of a hint that is larger than this [px] is not drawn."""


def draw_hints(board: Board, parts: Sequence[Player], hints: Hints) -> None:
    """Draw the lines and shapes that hints ask for, and say which bodies could not be drawn as they ask."""
    for part in parts:
        kind = hints.kinds.get(part.name)
        if kind is not None and part.glyph not in (CHOICES[kind], BodyGlyph.DISC):
            board.lacks(
                f"body '{part.name}' cannot be drawn as '{kind}'", "it has no frame, or no point besides its centre"
            )
    for shape in hints.shapes:
        _outline(board, shape)
    for one in hints.lines:
        _line(board, one)


def _line(board: Board, hint: LookLine) -> None:
    """A line; walls and floors at rest are hatched on the right-hand side of the way from the first to the last."""
    numbers = [board.stage.index(p) for p in hint.through]
    if _too_large(board, numbers, f"the {hint.kind} through {_names(hint)}"):
        return
    role, width = LINES[hint.kind]
    if role == "ground" and all(map(board.motions.still, numbers)):
        for a, b in itertools.pairwise(numbers):
            d = board.at(b) - board.at(a)
            hatched = turned(floor(0.0, float(np.linalg.norm(d))), heading((float(d[0]), float(d[1]))))
            board.put(hatched, role, board.placed(a), kind="wall", width=width, layer=GROUND)
    else:
        anchors, shifts = tuple(map(board.anchor, numbers)), tuple(map(board.shift, numbers))
        board.put(Trace(anchors, False, shifts), role, kind=hint.kind, width=width, layer=BODY - 6)
    for a, b in itertools.pairwise(numbers):
        board.fence(board.at(a), board.at(b))


def _names(hint: LookLine) -> str:
    return ", ".join(p.name or "a point" for p in hint.through[:4])


def _outline(board: Board, hint: Outline) -> None:
    stage = board.stage
    at = stage.index(hint.at)
    numbers = [stage.add(at, corner, hint.frame) for corner in hint.corners]
    if _too_large(board, numbers, f"the shape of '{hint.owner}'"):
        return
    anchors, shifts = tuple(map(board.anchor, numbers)), tuple(map(board.shift, numbers))
    owners = [b.name for b in stage.model.bodies if b.name == hint.owner or (hint.frame and b.axes is hint.frame)]
    closed = len(numbers) > 2
    board.put(Trace(anchors, closed, shifts), "body", of=owners, kind="shape", filled=closed, layer=BODY - 2)
    for a, b in itertools.pairwise([*numbers, numbers[0]]):
        board.fence(board.at(a), board.at(b))


def _too_large(board: Board, numbers: Sequence[int], what: str) -> bool:
    spots = np.array([board.at(k) for k in numbers])
    large = not np.isfinite(spots).all() or float(np.ptp(spots, axis=0).max()) > LARGEST
    if large:
        board.lacks(f"{what} is not drawn, because it is many times as large as the rest", "check its units in [look]")
    return large
