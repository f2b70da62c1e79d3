"""Which quantities of a listing are worth a name, and their definitions in SymPy.

A name is dropped where what it stands for is no sum and short, or short and used once. A node without a name that is
used twice and is long gets one, z_k. Full formulas and a listing are the two ends of this one rule: short rows come out
written in full, long ones in names.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from string import ascii_uppercase
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.derive import NamedQuantity
from lagrangian.dynamics.vectors import bare
from lagrangian.graph import operands, reached, to_sympy
from lagrangian.model import time
from lagrangian.structured.listing import Listing
from lagrangian.structured.names import FreeNames
from lagrangian.structured.quantities import Candidate
from lagrangian.write.expression import INWARD

SHORT = 14
"""Characters up to which a formula is written instead of a name for it."""

MOST_ANGLES = 3
"""A sum of more angles gets a name."""

LONG = 26
"""Characters above which a part that is used twice gets a name."""


def length(expr: sp.Basic) -> int:
    """How many characters an expression takes, about, as it is written."""
    if isinstance(expr, sp.Symbol):
        return 1 + len(expr.name.replace("_", "")[1:]) if len(expr.name) < 6 else 5
    if isinstance(expr, (AppliedUndef, sp.Derivative)):
        return 2
    if isinstance(expr, sp.Number):
        return len(str(expr))
    inside = sum(length(a) for a in expr.args)
    if isinstance(expr, sp.Add):
        return inside + 3 * (len(expr.args) - 1) + 2
    if isinstance(expr, sp.Function):
        return inside + 4
    return inside + len(expr.args) - 1


class ListingWriter:
    """Writes the nodes of a listing in SymPy, with names for what is worth one.

    Without ``names`` everything is written in the coordinates.
    """

    def __init__(self, found: Listing, *, names: bool = True) -> None:
        self.found, self.graph, self.model = found, found.graph, found.model
        self.leaves = _leaves(found)
        self.names = FreeNames(s for s in found.model.symbols)
        self.symbols: dict[int, sp.Expr] = dict(self.leaves)
        self.quantities: dict[int, NamedQuantity] = {}
        self._sums: dict[int, str] = {}
        self._other_angles: dict[int, str] = {}
        self._live = set(reached(self.graph, found.outputs()))
        if not names:
            return
        chosen = self._worth_a_name([*self._angles(), *self._turns(), *found.candidates])
        self._define(self._with_shared(chosen))

    def __call__(self, node: int) -> sp.Expr:
        """A node in SymPy, in the names of the listing."""
        return to_sympy(self.graph, node, self.symbols)

    # -- candidates ---------------------------------------------------------------------------------------------------

    def _angles(self) -> list[Candidate]:
        """Sums of more than three angles, from which further ones are counted; all sums where names have two digits."""
        most = MOST_ANGLES if len(self.model.coordinates) < 10 else 1
        nodes = self.graph.nodes
        found: list[Candidate] = []
        for frame, angle in self.found.description.angles.items():
            if nodes[angle][0] in ("add", "sub") and len(sp.Add.make_args(self(angle))) > most:
                index = self.found.indices.axes[self.found.description.axes[frame]]
                self._sums[angle] = index
                found.append(Candidate(angle, "turn", "phi", (index,), f"frame {index}"))
        return found

    def _turns(self) -> list[Candidate]:
        """cos and sin of every angle."""
        found: list[Candidate] = []
        for i in sorted(self._live):
            node = self.graph.nodes[i]
            if node[0] in ("cos", "sin"):
                found.append(Candidate(i, "turn", node[0][0], (self._angle_index(node[1]),), "angle"))
        return found

    def _angle_index(self, node: int) -> str:
        """The numbers of the coordinates in a sum of angles: 23 of θ₂ + θ₃."""
        if node in self._sums:
            return self._sums[node]
        own: dict[sp.Expr, str] = {p.symbol: p.name for p in self.model.parameters}
        own |= self.found.indices.coordinates
        angle = self(node)
        parts = [own[a] for a in sp.Add.make_args(angle) if a in own]
        if len(parts) != len(sp.Add.make_args(angle)) or not parts:  # a difference, for example: A, B, …
            return self._other_angles.setdefault(node, ascii_uppercase[len(self._other_angles) % 26])
        if all(p.isdigit() and len(p) == 1 for p in parts):
            return "".join(sorted(parts))
        return "_".join(sorted(parts))

    # -- choosing -----------------------------------------------------------------------------------------------------

    def _worth_a_name(self, candidates: Sequence[Candidate]) -> dict[int, Candidate]:
        """The candidates that keep their names, by node."""
        first: dict[int, Candidate] = {}
        for c in candidates:
            node, negative = bare(self.graph, c.node)
            if node in self._live and self.graph.nodes[node][0] not in ("input", "const"):
                first.setdefault(node, replace(c, node=node, negative=negative))
        kept: dict[int, Candidate] = {}
        table: dict[int, sp.Expr] = dict(self.leaves)
        sizes: dict[int, int] = {}
        for node in sorted(first):
            expr = to_sympy(self.graph, node, table)
            sizes[node] = length(expr)
            if not isinstance(expr, sp.Add) and sizes[node] <= SHORT and first[node].kind != "turn":
                continue
            kept[node] = first[node]
            table[node] = sp.Dummy("name")
        uses = self._uses(set(kept))
        return {n: c for n, c in kept.items() if uses[n] > 1 or (sizes[n] > SHORT and c.kind != "turn")}

    def _uses(self, names: set[int]) -> Counter[int]:
        """How often each node is written when those in ``names`` are written out once each."""
        uses: Counter[int] = Counter(self.found.outputs())
        for i in sorted(self._live, reverse=True):
            times = 1 if i in names else uses[i]
            for k in operands(self.graph.nodes[i]):
                uses[k] += times
        return uses

    def _with_shared(self, chosen: dict[int, Candidate]) -> dict[int, Candidate]:
        """The same with names for long parts that are used twice."""
        uses = self._uses(set(chosen))
        table: dict[int, sp.Expr] = dict(self.leaves)
        made = dict(chosen)
        for node in sorted(self._live):
            if node in table:
                continue
            if node in chosen:
                table[node] = sp.Symbol(_named(chosen[node]))
            elif uses[node] > 1 and self.graph.nodes[node][0] not in ("const", "neg"):
                expr = to_sympy(self.graph, node, table)
                if length(expr) > LONG:
                    made[node] = Candidate(node, "shared", "z", ("#",), "")
                    table[node] = sp.Dummy("z")
        return made

    def _define(self, chosen: dict[int, Candidate]) -> None:
        number = 0
        for node in sorted(chosen):
            c = chosen[node]
            if c.kind == "shared":
                number += 1
                c = replace(c, index=(str(number),))
            expr = to_sympy(self.graph, node, self.symbols)
            name = self.names.take(c.letter, *c.index, last=INWARD.strip("_") if c.inward else "")
            symbol = sp.Symbol(name, real=True)
            self.symbols[node] = -symbol if c.negative else symbol
            meaning = -expr if c.negative else expr
            self.quantities[node] = NamedQuantity(symbol, meaning, c.kind, c.words, c.inward, c.elements)


def _named(c: Candidate) -> str:
    return "_".join([c.letter, *c.index])


def _leaves(found: Listing) -> dict[int, sp.Expr]:
    """The symbols of the inputs of the graph."""
    g, model, inputs = found.graph, found.model, found.description.inputs
    table: dict[int, sp.Expr] = {inputs.t: time}
    for q, c in zip(inputs.q, model.coordinates, strict=True):
        table[q] = c.symbol
    for i, (v, velocity) in enumerate(zip(inputs.v, model.velocities, strict=True)):
        table[v] = velocity.symbol
        table[g.input("a", i)] = cast("sp.Expr", sp.Derivative(velocity.symbol, time))
    table.update(zip(inputs.u, (u.symbol for u in model.inputs), strict=True))
    table.update(zip(inputs.p, (p.symbol for p in model.parameters), strict=True))
    table.update((tie.multiplier, tie.symbol) for tie in found.ties)
    return table


def equalities(found: Listing, write: ListingWriter) -> tuple[sp.Eq, ...]:
    """The equations of motion as ``Eq(left-hand side, Ξ)``."""
    right = [write(force) for force in found.forces]
    if found.ties:
        right = [sp.Add(force, write(push), evaluate=True) for force, push in zip(right, found.pushes, strict=True)]
    pairs = zip(found.rows, right, strict=True)
    return tuple(cast("sp.Eq", sp.Eq(write(row), force, evaluate=False)) for row, force in pairs)
