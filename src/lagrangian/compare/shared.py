"""Two systems in the same coordinates: ξ = φ(η) is substituted into everything of the first."""

from __future__ import annotations

from functools import cached_property
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.coordinates import Change
from lagrangian.derive import Derived
from lagrangian.model import Element, Model
from lagrangian.model.model import written_out

LARGEST_BLOCK = 4
"""If J has entries that move, its inverse is written out up to this number of rows."""
LARGEST_INVERSE = 60
"""If J is constant, its inverse is written out up to this number of rows."""


class Shared:
    """The equations, energies and forces of both systems in the coordinates η of the second."""

    def __init__(self, a: Derived, b: Derived, change: Change) -> None:
        self.derivation_a, self.derivation_b, self.change = a, b, change
        self.a: Model = a.model
        self.b: Model = b.model
        theirs = {d.name: d for d in b.model.definitions}
        alike = {
            d.name
            for d in a.model.definitions
            if not d.moving and d.name in theirs and theirs[d.name].expression == d.expression
        }
        self._constants = [
            {d.symbol: d.expression for d in m.definitions if d.name not in alike} for m in (a.model, b.model)
        ]

    @cached_property
    def J(self) -> sp.ImmutableMatrix:
        """∂ξ/∂η, with a row for each coordinate of the first system and a column for each of the second."""
        return self.change.jacobian

    def seen(self, expr: sp.Expr) -> sp.Expr:
        """An expression of the first system in η; definitions that the second does not have are written out."""
        return self.change.put_in(written_out(self.a.expand(expr), self._constants[0]))

    def own(self, expr: sp.Expr) -> sp.Expr:
        """An expression of the second system; definitions that the first does not have are written out."""
        return written_out(self.b.expand(expr), self._constants[1])

    @cached_property
    def rows_a(self) -> tuple[sp.Expr, ...]:
        """The equations of the first system in η, left minus right."""
        return tuple(self.seen(_residual(e)) for e in self.derivation_a.equations)

    @cached_property
    def rows_b(self) -> tuple[sp.Expr, ...]:
        """The equations of the second system, left minus right."""
        return tuple(self.own(_residual(e)) for e in self.derivation_b.equations)

    @cached_property
    def Xi_a(self) -> tuple[sp.Expr, ...]:
        """Ξ_ξ of the first system in η."""
        return tuple(self.seen(self.derivation_a.Xi[q]) for q in self.derivation_a.coordinates)

    @cached_property
    def Xi_b(self) -> tuple[sp.Expr, ...]:
        """Ξ_η of the second system."""
        return tuple(self.own(self.derivation_b.Xi[q]) for q in self.derivation_b.coordinates)

    def energies(self, column: str) -> tuple[sp.Expr, sp.Expr]:
        """T* or V of both in η."""
        ours, theirs = self.derivation_a, self.derivation_b
        pair = (ours.T, theirs.T) if column == "T*" else (ours.V, theirs.V)
        return self.seen(pair[0]), self.own(pair[1])

    def share(self, element: Element, column: str, index: int | None, *, first: bool) -> sp.Expr:
        """The contribution of an element to T*, to V, or to the Ξ of coordinate ``index`` of the second system."""
        model = self.a if first else self.b
        into = self.seen if first else self.own
        if column == "T*":
            return into(element.kinetic(model))
        if column == "V":
            return into(element.potential(model))
        assert index is not None
        rate = self.b.coordinates[index].rate
        total = sp.S.Zero
        for action in element.works(model):
            slope = sp.diff(into(action.rate), rate)
            if slope != 0:
                total += into(action.effort) * slope
        return total


def _residual(equation: sp.Eq) -> sp.Expr:
    return cast("sp.Expr", equation.lhs) - cast("sp.Expr", equation.rhs)


def inverse(J: sp.ImmutableMatrix) -> sp.ImmutableMatrix | None:
    """J⁻¹ if it is short enough to write out (J is constant, or few of its rows move), else None."""
    n = J.rows
    constant = all(x.is_number for x in J.flat())
    alone = [i for i in range(n) if sum(x != 0 for x in J.row(i)) == 1 and 1 in J.row(i)]
    if n > LARGEST_INVERSE or (n - len(alone) > LARGEST_BLOCK and not constant):
        return None
    inverted = J.inv(method="LU") if constant else J.inv(method="ADJ")
    return sp.ImmutableMatrix(inverted.applyfunc(lambda x: x if x.is_number else bounded.trigsimp(bounded.cancel(x))))
