"""Finds the loops of a circuit that lie in a row, as they are drawn: which branches lie on which side of which loop.

A charge q of the description is that of a loop; a branch with the charge q₁ − q₂ lies on the wire between two loops.
One more loop may lie below the row and have wires in common with all of it, as in a bridge.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.look.board import Board
from lagrangian.model import (
    Capacitor,
    CircuitBranch,
    Coordinate,
    Inductor,
    MutualInductance,
    Resistor,
    Transducer,
    VoltageSource,
)
from lagrangian.page.plain import plain
from lagrangian.records import dataclass, field

LAWS = ("L", "C", "R", "M", "k", "value", "law", "coenergy", "energy")
"""The fields of which one says what a branch is."""

WIDE = 3
"""So many branches lie on the upper side of a loop before others go to its lower side."""


@dataclass(frozen=True)
class PlacedBranch:
    """A branch on a side of a loop, and whether its charge flows clockwise around that loop (1) or not (−1).

    A source of current is no element of the model, but the reason why a charge is given: ``supplied``, as a function of
    time.
    """

    element: CircuitBranch | None
    sense: float
    supplied: sp.Expr | None = None


@dataclass
class CircuitLoop:
    """A loop: its charge, the sense of that (1 is clockwise), and the branches on its sides, each in clockwise order.

    The charge is a coordinate, or given: ``supplied``, as a function of time.

    ``shared`` are those on the wire to the next loop, from top to bottom. ``coupled`` is the flux that is shared with
    the next loop, if the two have no common wire.
    """

    coordinate: Coordinate | None
    supplied: sp.Expr | None = None
    sense: float = 1.0
    left: list[PlacedBranch] = field(default_factory=list[PlacedBranch])
    top: list[PlacedBranch] = field(default_factory=list[PlacedBranch])
    right: list[PlacedBranch] = field(default_factory=list[PlacedBranch])
    bottom: list[PlacedBranch] = field(default_factory=list[PlacedBranch])
    shared: list[PlacedBranch] = field(default_factory=list[PlacedBranch])
    coupled: MutualInductance | None = None
    follows: bool = False
    """Whether the loop before it shares flux with it."""

    @property
    def name(self) -> str:
        """Its charge in words."""
        return plain(self.supplied) if self.supplied is not None else getattr(self.coordinate, "name", "")

    @property
    def labelled_inside(self) -> bool:
        """Whether it has a coil beside that of another loop, so that its label is inside."""
        return self.follows or self.coupled is not None


@dataclass
class CircuitRow:
    """The loops of a circuit from left to right, and the one that lies below all of them, if there is one."""

    loops: list[CircuitLoop]
    below: CircuitLoop | None = None


@dataclass(frozen=True)
class _Branch:
    """A branch with the factors of its charges, by the number of the charge."""

    element: CircuitBranch
    factors: tuple[dict[int, float], ...]

    @property
    def loops(self) -> set[int]:
        return {i for found in self.factors for i in found}

    def in_a_row(self) -> bool:
        """Whether it lies in one loop or between two, or couples two."""
        one = 2 if len(self.factors) == 1 else 1
        return all(len(x) <= one and all(abs(k) == 1.0 for k in x.values()) for x in self.factors)


def rows_of_loops(board: Board) -> list[CircuitRow]:
    """The circuits, each as its loops from left to right; circuits that cannot be drawn so are told."""
    model = board.stage.model
    charges = [c for c in model.charges if c.name not in board.hidden]
    supplied: list[sp.Expr] = []
    branches = [_factored(board, e, charges, supplied) for e in model.branches if e.name not in board.hidden]
    known: list[Coordinate | sp.Expr] = [*charges, *supplied]
    rows: list[CircuitRow] = []
    for group in _connected(len(known), branches):
        row = _laid(board, group, [b for b in branches if b.loops & set(group)], known)
        if row is None:
            names = ", ".join(_loop_of(known[i]).name for i in group)
            board.lacks(
                f"the circuit of {'charges' if len(group) > 1 else 'charge'} {names} is not drawn",
                "its loops do not lie in a row, with at most one more below it, each branch in one loop or between two",
            )
        else:
            rows.append(row)
    return rows


def _loop_of(charge: Coordinate | sp.Expr) -> CircuitLoop:
    return CircuitLoop(charge) if isinstance(charge, Coordinate) else CircuitLoop(None, charge)


def _laid(
    board: Board, group: list[int], branches: list[_Branch], known: Sequence[Coordinate | sp.Expr]
) -> CircuitRow | None:
    """The loops of a group as a row, or as a row with one loop below it; None if they are neither."""
    senses = _senses(group, branches)
    if senses is None or not all(b.in_a_row() for b in branches):
        return None
    driven = {i for b in branches if isinstance(b.element, VoltageSource) for i in b.loops}
    others = sorted(group, key=lambda i: i not in driven) if len(group) > 2 else []
    for below in (None, *others):
        inner = [b for b in branches if below not in b.loops]
        outer = [b for b in branches if below in b.loops and len(b.loops) == 2]
        order = _row([i for i in group if i != below], inner, joined=below is None)
        if order is None or any(len(b.factors) > 1 for b in outer):
            continue
        loops = {i: _loop_of(known[i]) for i in group}
        for i, loop in loops.items():
            loop.sense = senses[i] * senses[order[0]]
        for b in outer:
            (i,) = b.loops - {below}
            loops[i].bottom.append(PlacedBranch(b.element, b.factors[0][i] * loops[i].sense))
        if not _filled(board, order, [loops[i] for i in order], inner, free=below is None):
            continue
        if below is None:
            return CircuitRow([loops[i] for i in order])
        own = [b for b in branches if b.loops == {below}]
        _lay_below(loops[below], [PlacedBranch(b.element, b.factors[0][below] * loops[below].sense) for b in own])
        return CircuitRow([loops[i] for i in order], loops[below])
    return None


def _senses(group: Sequence[int], branches: Sequence[_Branch]) -> dict[int, float] | None:
    """The sense of every loop in which the charges on all common wires are differences; None if there are none."""
    found: dict[int, float] = {}
    for start in group:
        waiting = [] if start in found else [start]
        found.setdefault(start, 1.0)
        while waiting:
            i = waiting.pop()
            for b in branches:
                if len(b.factors) != 1 or len(b.loops) != 2 or i not in b.loops:
                    continue
                (j,) = b.loops - {i}
                sense = -found[i] * b.factors[0][i] * b.factors[0][j]
                if j not in found:
                    waiting.append(j)
                if found.setdefault(j, sense) != sense:
                    return None
    return found


def _factored(board: Board, element: CircuitBranch, charges: list[Coordinate], supplied: list[sp.Expr]) -> _Branch:
    """A branch with the factors ∂charge/∂qᵢ; what is given of its charge is that of a loop, too, and joins the list."""
    model, found = board.stage.model, list[dict[int, float]]()
    for charge in element.charges:
        expr: Any = model.expand(charge)
        slopes = board.stage.slopes(charge, board.q, board.p)
        factors = {i: float(slopes[model.coordinates.index(c)]) for i, c in enumerate(charges) if expr.has(c.symbol)}
        given = bounded.expand(expr.xreplace({c.symbol: sp.S.Zero for c in model.coordinates}))
        if given != 0:
            known = next((k for k, x in enumerate(supplied) if given in (x, bounded.expand(-x))), None)
            if known is None:
                known = len(supplied)
                supplied.append(-given if given.could_extract_minus_sign() else given)
            factors[len(charges) + known] = 1.0 if given == supplied[known] else -1.0
        found.append(factors)
    return _Branch(element, tuple(found))


def _connected(count: int, branches: list[_Branch]) -> list[list[int]]:
    """The loops that branches connect, group by group."""
    group = list(range(count))
    for branch in branches:
        met = {group[i] for i in branch.loops}
        group = [min(met) if g in met else g for g in group]
    return [[i for i in range(count) if group[i] == g] for g in sorted(set(group))]


def _row(group: list[int], branches: list[_Branch], *, joined: bool) -> list[int] | None:
    """The loops of a group in an order in which only neighbours have something in common, if there is one.

    ``joined``: all neighbours must have something in common; otherwise a wire without a branch may lie between them.
    """
    pairs = {frozenset(b.loops) for b in branches if len(b.loops) == 2}
    beside = {i: sorted(next(iter(p - {i})) for p in pairs if i in p) for i in group}
    if any(len(x) > 2 for x in beside.values()) or (joined and len(pairs) != len(group) - 1):
        return None
    order: list[int] = []
    while len(order) < len(group):
        at = next((i for i in group if i not in order and len(beside[i]) < 2), None)
        if at is None:  # the others are a ring
            return None
        while at is not None:
            order.append(at)
            at = next((i for i in beside[at] if i not in order), None)
    return order


def _filled(board: Board, order: list[int], loops: list[CircuitLoop], branches: list[_Branch], *, free: bool) -> bool:
    """Lay the branches on the sides of a row of loops; False if two loops share flux and wire, or too few coils.

    ``free``: the lower sides of the loops are their own.
    """
    coils: set[CircuitBranch] = set()
    for n, (one, two) in enumerate(pairwise(loops)):
        common = [b for b in branches if b.loops == {order[n], order[n + 1]}]
        shared = [b for b in common if len(b.factors) == 1]
        mutual = [b.element for b in common if isinstance(b.element, MutualInductance)]
        if len(mutual) > 1 or (mutual and shared):
            return False
        one.shared = [PlacedBranch(b.element, b.factors[0][order[n]] * one.sense) for b in shared]
        for element in mutual:
            ends = [_coil(branches, i, coils) for i in (order[n], order[n + 1])]
            if None in ends:
                return False
            one.coupled, two.follows = element, True
            for loop, side, end in ((one, one.right, ends[0]), (two, two.left, ends[1])):
                assert end is not None
                coils.add(end.element)
                side.append(PlacedBranch(end.element, loop.sense * next(iter(end.factors[0].values()))))
    for n, loop in enumerate(loops):
        own = [b for b in branches if b.loops == {order[n]} and b.element not in coils]
        placed = [PlacedBranch(b.element, b.factors[0][order[n]] * loop.sense) for b in own]
        _lay(board, loop, placed, first=n == 0, last=n == len(loops) - 1, free=free)
    return True


def _coil(branches: list[_Branch], loop: int, taken: set[CircuitBranch]) -> _Branch | None:
    """A coil in a loop that is not yet drawn beside another one."""
    return next(
        (b for b in branches if isinstance(b.element, Inductor) and b.loops == {loop} and b.element not in taken), None
    )


def _lay_below(loop: CircuitLoop, placed: list[PlacedBranch]) -> None:
    """Branches of the loop below a row: sources on the left, what moves on the right, others below."""
    if loop.supplied is not None:
        loop.left.append(PlacedBranch(None, loop.sense, loop.supplied))
    for x in placed:
        source, moves = isinstance(x.element, VoltageSource), isinstance(x.element, Transducer)
        (loop.left if source else loop.right if moves else loop.bottom).append(x)


def _lay(
    board: Board, loop: CircuitLoop, placed: list[PlacedBranch], *, first: bool, last: bool, free: bool = True
) -> None:
    """Branches of one loop alone: sources on the left, what moves on the right, then a capacitor, others above.

    ``free``: others lie on the lower side, too, where there are many.
    """
    rest: list[PlacedBranch] = []
    if loop.supplied is not None:
        side = loop.left if first else loop.right if last else loop.top
        side.append(PlacedBranch(None, loop.sense, loop.supplied))
    for x in placed:
        if first and isinstance(x.element, VoltageSource):
            loop.left.append(x)
        elif last and (isinstance(x.element, Transducer) or (x.element is not None and moved_by(board, x.element))):
            loop.right.append(x)
        else:
            rest.append(x)
    for x in rest:
        if last and not loop.right and isinstance(x.element, Capacitor):
            loop.right.append(x)
        elif not free or len(loop.top) < WIDE or len(loop.top) <= len(loop.bottom):
            loop.top.append(x)
        else:
            loop.bottom.append(x)
    if last and not (first or loop.right) and len(loop.top) > 1 and isinstance(loop.top[-1].element, Resistor):
        loop.right.append(loop.top.pop())  # what the loops before it supply
    loop.top.sort(key=lambda x: isinstance(x.element, Capacitor | Inductor))  # resistors stand beside the source


def moved_by(board: Board, element: CircuitBranch) -> list[Coordinate]:
    """The coordinates, apart from charges, that change a branch, such as a gap that changes an inductance."""
    model = board.stage.model
    laws = [getattr(element, key, None) for key in LAWS if key not in ("k", "value")]
    met = {x for law in laws if isinstance(law, sp.Expr) for x in model.expand(law).atoms(sp.Function)}
    return [c for c in model.coordinates if c.symbol in met and c not in model.charges]
