"""Checks the pivots of multipliers: a row that depends on earlier rows gets the multiplier 0.

In a fixed order, the pivot of a multiplier is −s sin² of the angle, measured by M⁻¹, between its row and the span of
the earlier rows, where s is the size a M⁻¹ aᵀ of the row. Instead of s, the sum over the rows of one closure is used,
because near a position where a loop can move in more than one way, the size of a single row goes to zero along with its
pivot. A pivot at the level of rounding means that the row repeats what others say. Dividing by it would turn an error
of 1e-9 in the state into one of 1e-3 in the accelerations; a multiplier of 0 is one valid choice, and v̇ is unique.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from lagrangian.graph import Graph

LEAST_MARGIN = 1e-11
"""Part of its closure's size below which the pivot of a row is nothing but rounding."""

UNBOUNDED = 1e150
"""What a pivot that is nothing but rounding is replaced by: its reciprocal acts on nothing, has a derivative, and its
products are no subnormal numbers, which are slow."""


@dataclass
class Guard:
    """``closures``: multiplier → the group it is measured with. What is known of rows grows as they are taken.

    ``margins``; ``skipped``: what a row that is skipped still asks for, else 0; ``regular``: whether it is not skipped.
    """

    graph: Graph
    closures: Mapping[int, str]
    sizes: dict[int, int] = field(default_factory=dict[int, int])
    margins: dict[int, int] = field(default_factory=dict[int, int])
    skipped: dict[int, int] = field(default_factory=dict[int, int])
    regular: dict[int, int] = field(default_factory=dict[int, int])

    def __post_init__(self) -> None:
        """Gather the rows of every closure."""
        self.groups: dict[str, list[int]] = {}
        for row, closure in self.closures.items():
            self.groups.setdefault(closure, []).append(row)

    def gain(self, row: int, size: int) -> None:
        """Add what one rate gives to a row's size, a_k²/h_kk."""
        self.sizes[row] = self.graph.add(self.sizes.get(row, self.graph.zero), size)

    def size(self, row: int) -> int:
        """The size of a row's closure, as far as its rates are gone."""
        total = self.graph.zero
        for other in self.groups[self.closures[row]]:
            total = self.graph.add(total, self.sizes.get(other, self.graph.zero))
        return total

    def reciprocal(self, row: int, pivot: int, residual: int) -> int:
        """1/pivot, or nearly 0 where the pivot is rounding; there ``residual`` is what the row still asks for."""
        g = self.graph
        size, positive = self.size(row), g.neg(pivot)
        least = g.zero if positive == size else g.mul(g.const(LEAST_MARGIN), size)
        regular = self.regular[row] = g.lt(least, positive)
        self.margins[row] = g.select(g.lt(g.zero, size), g.div(positive, size), g.zero)
        self.skipped[row] = g.select(regular, g.zero, residual)
        return g.neg(g.div(g.one, g.select(regular, positive, g.const(UNBOUNDED))))

    def leave_out(self, row: int, residual: int) -> None:
        """Take note of a row without any pivot."""
        self.margins[row], self.skipped[row], self.regular[row] = self.graph.zero, residual, self.graph.zero

    def certain(self, row: int) -> None:
        """Take note of a row whose pivot cannot vanish."""
        self.margins[row], self.skipped[row], self.regular[row] = self.graph.one, self.graph.zero, self.graph.one
