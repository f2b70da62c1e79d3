"""Draws circuits beside what they move: loops of wire with sources, resistors, coils, capacitors and windings."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from math import atan2, pi

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import BODY, EFFORT, JOINT, TIE, Board
from lagrangian.look.circuit_loops import LAWS, CircuitLoop, CircuitRow, PlacedBranch, moved_by, rows_of_loops
from lagrangian.look.shapes import arc, box, head, joined, line, lines, turned
from lagrangian.look.tie_glyphs import LOCAL, own_name
from lagrangian.model import CircuitBranch, MutualInductance, Transducer, VoltageSource
from lagrangian.page.scene import Disc, Flow, Pair, Path, Role

Array = NDArray[np.float64]

CELL, NARROW, LOW = 62.0, 104.0, 88.0
"""The length of wire for a branch, and the least width and height of a loop [px]."""
HALF, ROUND = 17.0, 13.0
"""Half the length of a branch's glyph, and the radius of a round one [px]."""
APART, BESIDE, BELOW = 40.0, 74.0, 40.0
"""Between two coils that share flux, between a circuit and what it moves, between two circuits [px]."""
INWARD = 30.0
"""How much wider a loop is whose coils are labelled inside it [px]."""
MESH = 17.0
"""The radius of the arrow around the name of a loop's charge [px]."""
INSIDE = 7.0
"""How far inside its wires the charge of a loop flows, so that neighbours can be told apart [px]."""
THICK = {"resistor": 6.0, "inductor": 7.0, "transducer": 15.0}
"""Half of how thick glyphs are, as far as not round [px]."""

USUAL = {"inductor": "L", "capacitor": "C", "resistor": "R", "mutual_inductance": "M"}
"""With which letter the constants of a branch begin: of a law with one of these, it is the label."""

ROLES: dict[str, Role] = {
    "inductor": "body", "mutual_inductance": "body", "capacitor": "stiffness", "resistor": "damping",
    "voltage_source": "input", "transducer": "input",
}  # fmt: skip


def draw_circuits(board: Board, beside: Array) -> None:
    """Draw all circuits, the middle of their right side left of a place [px]."""
    rows = rows_of_loops(board)
    if not rows:
        return
    heights = [_height(row) for row in rows]
    y = float(beside[1]) - (sum(heights) + BELOW * (len(rows) - 1)) / 2
    for row, height in zip(rows, heights, strict=True):
        widths = _widths(row)
        gaps = sum(APART for loop in row.loops if loop.coupled)
        _draw_row(board, row, widths, float(beside[0]) - BESIDE - sum(widths) - gaps, y)
        y += height + BELOW


def _width(loop: CircuitLoop) -> float:
    return max(NARROW + (INWARD if loop.labelled_inside else 0.0), CELL * len(loop.top), CELL * len(loop.bottom))


def _widths(row: CircuitRow) -> list[float]:
    """The widths of the loops of a row, together as wide as what lies below them."""
    found = [_width(loop) for loop in row.loops]
    wider = 1.0 if row.below is None else max(1.0, _width(row.below) / sum(found))
    return [wider * x for x in found]


def _height(row: CircuitRow) -> float:
    return _depth(row.loops) + (0.0 if row.below is None else _depth([row.below]))


def _depth(loops: list[CircuitLoop]) -> float:
    return max(LOW, *(CELL * len(side) for loop in loops for side in (loop.left, loop.right, loop.shared)))


def _draw_row(board: Board, row: CircuitRow, widths: list[float], x: float, y: float) -> None:
    """Loops from left to right; neighbours have a wire in common, or a gap between two coils."""
    wired, height, start = False, _depth(row.loops), x
    corners: list[Pair] = []
    for n, (loop, width) in enumerate(zip(row.loops, widths, strict=True)):
        a, b = x, x + width
        if not wired:
            _side(board, (a, y + height), (a, y), loop.left, (1.0 if n else -1.0, 0.0))
        _side(board, (a, y), (b, y), loop.top, (0.0, -1.0))
        _side(board, (b, y + height), (a, y + height), loop.bottom, (0.0, 1.0))
        corners += [(a, y + height), (b, y + height)]
        wired = n + 1 < len(row.loops) and loop.coupled is None
        inward = (-1.0 if loop.coupled is not None else 1.0, 0.0)
        _side(board, (b, y), (b, y + height), loop.shared if wired else loop.right, inward)
        for corner in ((b, y), (b, y + height)) if wired else ():
            _node(board, corner)
        _mesh(board, loop, (a, y, b, y + height))
        x = b
        if loop.coupled is not None:
            _flux(board, loop.coupled, (b + APART / 2, y + height / 2))
            if row.below is not None:
                _wire(board, np.array((b, y + height)), np.array((b + APART, y + height)))
            x += APART
    if row.below is not None:
        for corner in dict.fromkeys(c for c in corners if corners.count(c) == 1):
            _node(board, corner)
        _draw_below(board, row.below, (start, x), y + height)


def _draw_below(board: Board, loop: CircuitLoop, ends: Pair, y: float) -> None:
    """The loop below a row, whose lower sides are its upper one."""
    a, b = ends
    low = y + _depth([loop])
    _side(board, (b, y), (b, low), loop.right, (1.0, 0.0))
    _side(board, (b, low), (a, low), loop.bottom, (0.0, 1.0))
    _side(board, (a, low), (a, y), loop.left, (-1.0, 0.0))
    _mesh(board, loop, (a, y, b, low))


def _node(board: Board, at: Pair) -> None:
    board.put(Disc(at, 2.6), "rod", width=0.0, solid=True, kind="node", layer=JOINT, moves=False)


def _mesh(board: Board, loop: CircuitLoop, corners: tuple[float, float, float, float]) -> None:
    """The charge of a loop, with an arrow in its sense; a charge that is given has its source instead."""
    if loop.coordinate is None:
        return
    left, top, right, bottom = corners
    inner = (left + INSIDE, top + INSIDE, right - INSIDE, bottom - INSIDE)
    board.flows.append(Flow(loop.coordinate.name, inner, loop.sense))
    centre = (left + right) / 2, (top + bottom) / 2
    start, end = (0.85 * pi, 2.4 * pi) if loop.sense > 0 else (0.15 * pi, -1.4 * pi)
    name = (loop.coordinate.name,)
    board.bow(centre, MESH, start, end, "coordinate", of=name, kind="coordinate")
    board.block(centre, 2 * MESH, 2 * MESH)
    board.wish(name, centre, (0.0, 0.0), "coordinate", name, inside=True)


def _side(board: Board, start: Pair, end: Pair, branches: list[PlacedBranch], out: Pair) -> None:
    """A wire from corner to corner with the glyphs of its branches, and their labels on its outer side."""
    a, b = np.array(start), np.array(end)
    e = (b - a) / float(np.linalg.norm(b - a))
    at = a
    for n, x in enumerate(branches):
        middle = a + (n + 0.5) / len(branches) * (b - a)
        _wire(board, at, middle - HALF * e)
        _branch(board, x, middle, atan2(e[1], e[0]), out)
        at = middle + HALF * e
    _wire(board, at, b)


def _wire(board: Board, a: Array, b: Array) -> None:
    board.put(line((float(a[0]), float(a[1])), (float(b[0]), float(b[1]))), "rod", kind="wire", layer=BODY, moves=False)
    board.fence(a, b)


def _branch(board: Board, x: PlacedBranch, middle: Array, angle: float, out: Pair) -> None:
    """One glyph, along a direction."""
    if x.element is None:
        _supply(board, x, middle, angle, out)
        return
    element, of = x.element, (x.element.name,)
    role = ROLES.get(element.kind, "rod")
    moving = isinstance(element, Transducer)
    for shape, filled, solid in _glyph(board, x):
        board.put(
            turned(shape, angle, float(middle[0]), float(middle[1])),
            role, of=of, kind=element.kind, filled=filled, solid=solid, width=0.0 if solid else 1.6, layer=TIE,
            moves=False,
        )  # fmt: skip
    if not moving and moved_by(board, element):
        tip, foot = (13.0, -14.0), (-13.0, 13.0)
        for shape, solid in ((line(foot, (10.0, -11.0)), False), (head(tip, (1.0, -1.0)), True)):
            board.put(
                turned(shape, 0.0, float(middle[0]), float(middle[1])),
                role, of=of, kind=element.kind, solid=solid, width=0.0 if solid else 1.4, layer=EFFORT, moves=False,
            )  # fmt: skip
    thick = THICK.get(element.kind, ROUND)
    board.block(middle, *((2 * HALF, 2 * thick) if abs(np.cos(angle)) > 0.5 else (2 * thick, 2 * HALF)))
    board.wish(branch_names(element), middle, out, role, of, distance=thick + 4.0)


def _supply(board: Board, x: PlacedBranch, middle: Array, angle: float, out: Pair) -> None:
    """A source of current: a circle with an arrow along it."""
    leads = lines(((-HALF, 0.0), (-ROUND, 0.0)), ((ROUND, 0.0), (HALF, 0.0)))
    arrow = line((-8.0 * x.sense, 0.0), (3.0 * x.sense, 0.0))
    tip = head((9.0 * x.sense, 0.0), (x.sense, 0.0))
    for shape, filled, solid in (
        (leads, False, False),
        (_circle(), True, False),
        (arrow, False, False),
        (tip, False, True),
    ):
        board.put(
            turned(shape, angle, float(middle[0]), float(middle[1])),
            "input", kind="current_source", filled=filled, solid=solid, width=0.0 if solid else 1.6, layer=TIE,
            moves=False,
        )  # fmt: skip
    board.block(middle, 2 * ROUND, 2 * ROUND)
    assert x.supplied is not None
    names = sorted({str(s) for s in x.supplied.free_symbols} - {*LOCAL})[:2]
    board.wish(names, middle, out, "input", distance=ROUND + 4.0)


def _glyph(board: Board, x: PlacedBranch) -> list[tuple[Path, bool, bool]]:
    """The shapes of a branch along x from −17 to 17, each with whether it is filled with paper or with its colour."""
    element = x.element
    assert element is not None
    leads = lines(((-HALF, 0.0), (-ROUND, 0.0)), ((ROUND, 0.0), (HALF, 0.0)))
    match element.kind:
        case "resistor":
            return [(box(2 * HALF, 11.0), True, False)]
        case "inductor":
            return [(_windings(), False, False)]
        case "capacitor":
            plates = ((-3.5, -12.0), (-3.5, 12.0)), ((3.5, -12.0), (3.5, 12.0))
            return [(lines(((-HALF, 0.0), (-3.5, 0.0)), *plates, ((3.5, 0.0), (HALF, 0.0))), False, False)]
        case "voltage_source":
            side = x.sense * _sign(board, element)
            plus, minus = 6.5 * side, -6.5 * side
            signs = lines(
                ((plus - 3.5, 0.0), (plus + 3.5, 0.0)), ((plus, -3.5), (plus, 3.5)), ((minus, -3.5), (minus, 3.5))
            )
            return [(leads, False, False), (_circle(), True, False), (signs, False, False)]
        case "transducer" if element.name in board.straight:
            moved = lines(((-9.0, 12.0), (9.0, 12.0)))
            heads = joined(
                head((14.0, 12.0), (1.0, 0.0), length=7.0, width=5.0),
                head((-14.0, 12.0), (-1.0, 0.0), length=7.0, width=5.0),
            )
            return [(_windings(), False, False), (moved, False, False), (heads, False, True)]
        case "transducer":  # a rotor between two brushes
            brushes = [turned(box(5.0, 9.0), 0.0, s * ROUND) for s in (-1.0, 1.0)]
            return [(leads, False, False), (_circle(), True, False), (joined(*brushes), False, True)]
        case _:
            return [(line((-HALF, 0.0), (HALF, 0.0)), False, False)]


def _circle() -> Path:
    return joined(arc(ROUND, 0.0, 2 * pi), Path((("Z", ()),)))


def _windings() -> Path:
    """Four half circles along x."""
    r = HALF / 4
    first, *rest = (arc(r, pi, 2 * pi, x=-HALF + (2 * n + 1) * r) for n in range(4))
    return Path((*first.commands, *(c for x in rest for c in x.commands[1:])))


def _sign(board: Board, element: CircuitBranch) -> float:
    """The side on which a source of a positive input is positive."""
    if not isinstance(element, VoltageSource) or not isinstance(element.value, sp.Expr):
        return 1.0
    return -1.0 if board.stage.value(element.value, board.q, board.p, u=1.0) < 0 else 1.0


def _flux(board: Board, element: MutualInductance, centre: Pair) -> None:
    """What two coils share: the two lines of a core, and the name of the mutual inductance above them."""
    x, y = centre
    of = (element.name,)
    core = lines(*(((x + s, y - 19.0), (x + s, y + 19.0)) for s in (-2.5, 2.5)))
    board.put(core, "body", of=of, kind=element.kind, layer=TIE, moves=False)
    board.block(centre, 9.0, 38.0)
    board.wish(branch_names(element), (x, y - 19.0), (0.0, -1.0), "body", of, distance=3.0)


def branch_names(element: CircuitBranch) -> tuple[str, ...]:
    """The letter of a branch; where its law is more than a letter, its own name, or else the letters in it."""
    letter = element.suggested_name()
    if letter:
        return (letter,)
    if own := own_name(element):
        return own
    laws = [x for key in LAWS if isinstance(x := getattr(element, key, None), sp.Expr)]
    names = sorted({str(x) for law in laws[:1] for x in law.free_symbols} - {*LOCAL})
    usual = [name for name in names if name.startswith(USUAL.get(element.kind, " "))]
    return tuple(usual[:1] or names[:2])
