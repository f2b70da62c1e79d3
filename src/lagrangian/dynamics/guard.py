"""Checks the pivots of multipliers: a row that depends on earlier rows gets the multiplier 0.

In a fixed order, the pivot of a multiplier is −s sin² of the angle, measured by M⁻¹, between its row and the span of
the earlier rows, where s is the size a M⁻¹ aᵀ of the row. Instead of s, the sum over the rows of one closure is used,
because near a position where a loop can move in more than one way, the size of a single row goes to zero along with its
pivot. A pivot at the level of rounding means that the row repeats what others say. Dividing by it would turn an error
of 1e-9 in the state into one of 1e-3 in the accelerations; a multiplier of 0 is one valid choice, and v̇ is unique.

Where it is known that k rows of a set follow from the others along the whole motion (`SpareRows`), exactly k of them
are skipped, whatever their pivots are at a state that is a little off the constraints: the first ones whose pivot is
not clear, otherwise the last ones. Which ones they are changes along the motion, because no choice is valid throughout:
of three parallel cranks, each row can be spared only while its own share of the redundant forces is not 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lagrangian.graph import Graph
from lagrangian.records import dataclass, field

LEAST_MARGIN = 1e-11
"""Part of its closure's size below which the pivot of a row is nothing but rounding."""

LEAST_BESIDE_SPARE = 1e-9
"""The same for rows of a set that has lost its spare rows: a state off the constraints moves their pivots more."""

CLEAR_MARGIN = 1e-3
"""Part of its closure's size above which the pivot of a row shows that it is independent of the rows before it,
although some rows of its set are known to depend on others."""

UNBOUNDED = 1e150
"""What a pivot that is nothing but rounding is replaced by: its reciprocal acts on nothing, has a derivative, and its
products are no subnormal numbers, which are slow."""


@dataclass(frozen=True)
class Spared:
    """The rows of a set with spare ones that are eliminated by a pivot, as multipliers in the order of elimination."""

    rows: tuple[int, ...]
    count: int

    def later(self, row: int) -> int:
        """How many of them follow after a row."""
        return len(self.rows) - 1 - self.rows.index(row)


@dataclass
class Guard:
    """``closures``: multiplier → the group it is measured with. What is known of rows grows as they are taken.

    ``margins``; ``skipped``: what a row that is skipped still asks for, else 0; ``regular``: whether it is not skipped.
    ``spared``: for multipliers of sets in which some rows are known to follow from others. ``taken``: the multipliers
    that were eliminated by a pivot, in order.
    """

    graph: Graph
    closures: Mapping[int, str]
    spared: Mapping[int, Spared] = field(default_factory=dict[int, Spared])
    taken: list[int] = field(default_factory=list[int])
    sizes: dict[int, int] = field(default_factory=dict[int, int])
    margins: dict[int, int] = field(default_factory=dict[int, int])
    skipped: dict[int, int] = field(default_factory=dict[int, int])
    regular: dict[int, int] = field(default_factory=dict[int, int])

    def __post_init__(self) -> None:
        """Gather the rows of every closure."""
        self.groups: dict[str, list[int]] = {}
        for row, closure in self.closures.items():
            self.groups.setdefault(closure, []).append(row)

    def join(self, rows: Sequence[int]) -> None:
        """Measure the closures of some rows together, because combinations of these rows are taken."""
        whole = list(dict.fromkeys(x for row in rows for x in self.groups[self.closures[row]]))
        self.groups.update({self.closures[row]: whole for row in rows})

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
        margin = g.select(g.lt(g.zero, size), g.div(positive, size), g.zero)
        regular = g.lt(least, positive)
        if row in self.spared:
            regular, margin = self._chosen(self.spared[row], row, positive, size, margin)
        self.regular[row], self.margins[row] = regular, margin
        self.taken.append(row)
        self.skipped[row] = g.select(regular, g.zero, residual)
        return g.neg(g.div(g.one, g.select(regular, positive, g.const(UNBOUNDED))))

    def _chosen(self, among: Spared, row: int, positive: int, size: int, margin: int) -> tuple[int, int]:
        """Whether a row of a set with spare rows is used, and its margin: 1 for a row that is spared."""
        g, skipped = self.graph, self._skipped(among)
        may = g.lt(skipped, g.const(among.count - 0.5))
        clear, fair = (g.lt(g.mul(g.const(x), size), positive) for x in (CLEAR_MARGIN, LEAST_BESIDE_SPARE))
        used = g.select(may, clear, fair)
        if (least := among.count - among.later(row)) > 0:
            used = g.select(g.lt(skipped, g.const(least - 0.5)), g.zero, used)
        return used, g.select(used, margin, g.select(may, g.one, margin))

    def _skipped(self, among: Spared) -> int:
        """How many rows of a set are skipped so far."""
        g, total = self.graph, self.graph.zero
        for row in among.rows:
            if row in self.regular:
                total = g.add(total, g.select(self.regular[row], g.zero, g.one))
        return total

    def leave_out(self, row: int, residual: int) -> None:
        """Take note of a row without any pivot."""
        self.taken.append(row)
        self.margins[row], self.skipped[row], self.regular[row] = self.graph.zero, residual, self.graph.zero

    def certain(self, row: int) -> None:
        """Take note of a row whose pivot cannot vanish."""
        self.margins[row], self.skipped[row], self.regular[row] = self.graph.one, self.graph.zero, self.graph.one
