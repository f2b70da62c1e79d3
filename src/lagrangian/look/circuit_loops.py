"""Finds the loops of a circuit that lie in a row, as they are drawn: which branches lie on which side of which loop.

A charge q of the description is that of a loop; a branch with the charge q₁ − q₂ lies on the wire between two loops.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import sympy as sp

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


def rows_of_loops(board: Board) -> list[list[CircuitLoop]]:
    """The circuits, each as its loops from left to right; circuits that cannot be drawn so are told."""
    model = board.stage.model
    charges = [c for c in model.charges if c.name not in board.hidden]
    supplied: list[sp.Expr] = []
    branches = [_factored(board, e, charges, supplied) for e in model.branches if e.name not in board.hidden]
    known = [*(CircuitLoop(c) for c in charges), *(CircuitLoop(None, x) for x in supplied)]
    rows: list[list[CircuitLoop]] = []
    for group in _connected(len(known), branches):
        mine = [b for b in branches if b.loops & set(group)]
        order = _row(group, mine) if all(b.in_a_row() for b in mine) else None
        loops = None if order is None else _filled(board, order, [known[i] for i in order], mine)
        if loops is None:
            names = ", ".join(known[i].name for i in group)
            board.lacks(
                f"the circuit of {'charges' if len(group) > 1 else 'charge'} {names} is not drawn",
                "its loops do not lie in a row, each branch in one of them or between two",
            )
        else:
            rows.append(loops)
    return rows


def _factored(board: Board, element: CircuitBranch, charges: list[Coordinate], supplied: list[sp.Expr]) -> _Branch:
    """A branch with the factors ∂charge/∂qᵢ; what is given of its charge is that of a loop, too, and joins the list."""
    model, found = board.stage.model, list[dict[int, float]]()
    for charge in element.charges:
        expr: Any = model.expand(charge)
        slopes = board.stage.slopes(charge, board.q, board.p)
        factors = {i: float(slopes[model.coordinates.index(c)]) for i, c in enumerate(charges) if expr.has(c.symbol)}
        given = sp.expand(expr.xreplace({c.symbol: sp.S.Zero for c in model.coordinates}))
        if given != 0:
            known = next((k for k, x in enumerate(supplied) if given in (x, sp.expand(-x))), None)
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


def _row(group: list[int], branches: list[_Branch]) -> list[int] | None:
    """The loops of a group in an order in which only neighbours have something in common, if there is one."""
    pairs = {frozenset(b.loops) for b in branches if len(b.loops) == 2}
    beside = {i: sorted(next(iter(p - {i})) for p in pairs if i in p) for i in group}
    if len(pairs) != len(group) - 1 or any(len(x) > 2 for x in beside.values()):
        return None
    at = next(i for i in group if len(beside[i]) < 2)
    order = [at]
    while len(order) < len(group):
        at = next(i for i in beside[at] if i not in order)
        order.append(at)
    return order


def _filled(
    board: Board, order: list[int], loops: list[CircuitLoop], branches: list[_Branch]
) -> list[CircuitLoop] | None:
    """The loops with their branches; None if no senses of the loops agree with all of them."""
    coils: set[CircuitBranch] = set()
    for n, (one, two) in enumerate(pairwise(loops)):
        pair = {order[n], order[n + 1]}
        common = [b for b in branches if b.loops == pair]
        shared = [b for b in common if len(b.factors) == 1]
        senses = {-one.sense * b.factors[0][order[n]] * b.factors[0][order[n + 1]] for b in shared} or {1.0}
        mutual = [b.element for b in common if isinstance(b.element, MutualInductance)]
        if len(senses) > 1 or len(mutual) > 1 or (mutual and shared):
            return None
        two.sense = senses.pop()
        one.shared = [PlacedBranch(b.element, b.factors[0][order[n]] * one.sense) for b in shared]
        for element in mutual:
            ends = [_coil(branches, i, coils) for i in (order[n], order[n + 1])]
            if None in ends:
                return None
            one.coupled, two.follows = element, True
            for loop, side, end in ((one, one.right, ends[0]), (two, two.left, ends[1])):
                assert end is not None
                coils.add(end.element)
                side.append(PlacedBranch(end.element, loop.sense * next(iter(end.factors[0].values()))))
    for n, loop in enumerate(loops):
        own = [b for b in branches if b.loops == {order[n]} and b.element not in coils]
        placed = [PlacedBranch(b.element, b.factors[0][order[n]] * loop.sense) for b in own]
        _lay(board, loop, placed, first=n == 0, last=n == len(loops) - 1)
    return loops


def _coil(branches: list[_Branch], loop: int, taken: set[CircuitBranch]) -> _Branch | None:
    """A coil in a loop that is not yet drawn beside another one."""
    return next(
        (b for b in branches if isinstance(b.element, Inductor) and b.loops == {loop} and b.element not in taken), None
    )


def _lay(board: Board, loop: CircuitLoop, placed: list[PlacedBranch], *, first: bool, last: bool) -> None:
    """Branches of one loop alone: sources on the left, what moves on the right, then a capacitor, others above."""
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
        elif len(loop.top) < WIDE or len(loop.top) <= len(loop.bottom):
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
