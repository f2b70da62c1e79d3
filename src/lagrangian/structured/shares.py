"""Which elements a term of a listing comes from: the same pass backwards with one element's forces alone."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

import sympy as sp

from lagrangian.derive import Origin
from lagrangian.derive.multipliers.step import AFTER
from lagrangian.dynamics.describe import moved
from lagrangian.dynamics.mechanics import Pairs
from lagrangian.model import Element
from lagrangian.records import dataclass
from lagrangian.structured.held_rows import pushes
from lagrangian.structured.listing import Listing
from lagrangian.structured.writing import ListingWriter, equalities


@dataclass(frozen=True, eq=False)
class ListedShares:
    """The contributions to every equation of a listing."""

    found: Listing
    write: ListingWriter

    def where(self, term: sp.Expr) -> tuple[Origin, ...]:
        """The elements behind every equation in which a term stands, each with its share of that whole equation.

        A sum over all that hangs on a joint comes from many elements; what each adds to it is what it adds to the
        equation.
        """
        wanted = sp.sympify(term)
        found: list[Origin] = []
        for i, equation in enumerate(equalities(self.found, self.write)):
            sides = (cast("sp.Expr", side) for side in equation.args)
            if any(wanted in sp.Add.make_args(side) or wanted == side for side in sides):
                found += self.of(i)
        return tuple(found)

    def of(self, index: int) -> Iterator[Origin]:
        """The share of every element in an equation."""
        name = moved(self.found.model)[index]
        for element, pairs, step in self._acting():
            share = self.found.mechanics.gathered(pairs)[index]
            if share != self.found.graph.zero:
                yield Origin(element, name, self.write(share), step)

    def _acting(self) -> Iterator[tuple[Element, Pairs, int]]:
        """Every element with its forces on velocities, and the step that counts it."""
        m = self.found.mechanics
        for b in self.found.bodies:
            yield b.body, b.inertial(), 2
        for element in self.found.model.elements:
            if (added := m.added.get(element.title)) is None:
                continue  # a constraint
            stored = [(rate, self.found.graph.neg(effort)) for rate, effort in added.stores]
            if stored:
                yield element, stored, 3
            dragged = [(drag.rate, effort) for drag, effort in self.found.slips if drag.friction.title == element.title]
            if acting := [*added.efforts, *dragged]:
                yield element, acting, 6
        for tie in self.found.ties:
            yield tie.row.element, pushes([tie]), AFTER
