"""The input and the output of an elimination with rows."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from lagrangian.dynamics.accelerations import Quadratic
from lagrangian.dynamics.drags import AttachedDrag, Pressing
from lagrangian.dynamics.guard import Spared
from lagrangian.dynamics.rows import ConstraintRow
from lagrangian.dynamics.tape import EliminationTape
from lagrangian.dynamics.vectors import bare
from lagrangian.errors import ModelError
from lagrangian.graph import Graph
from lagrangian.model.spare import SpareRows
from lagrangian.records import dataclass


class DependentRow(ModelError):
    """A row whose coefficients depend on those of other rows in every state: ``row``, and the node of its ``residual``.

    If the residual is zero, the row repeats others. If it is not, the rows contradict each other.
    """

    def __init__(self, row: ConstraintRow, residual: int) -> None:
        self.row, self.residual = row, residual
        super().__init__(
            f"the constraint '{row.name}' depends on the other constraints in every position",
            fix="leave it out",
            code="E202",
        )


@dataclass(frozen=True)
class AttachedRow:
    """A row in an elimination: the ``node`` whose rate, times ``sign`` (±1 as a node), changes by −``value``."""

    row: ConstraintRow
    node: int
    sign: int
    value: int

    @classmethod
    def of(cls, graph: Graph, row: ConstraintRow, value: int) -> AttachedRow:
        """A row with its rate's own node, whatever its sign."""
        node, negative = bare(graph, row.rate)
        return cls(row, node, graph.negative if negative else graph.one, value)


@dataclass(frozen=True)
class Problem:
    """The input of an elimination: H and g along a tape, subject to rows. The result is added to ``reference``.

    With ``strict``, a row without a pivot raises `DependentRow`, and a rate without inertia is an error too. ``spare``
    are sets of rows in which some are known to follow from others along the motion. ``drags`` are frictions that
    multipliers press on. The unknowns of the rows are −λ of `rows`, or λ if ``positive``.
    """

    graph: Graph
    tape: EliminationTape
    H: Quadratic
    linear: Mapping[int, int]
    rows: Sequence[AttachedRow]
    rates: Sequence[int]
    reference: Sequence[int]
    names: Mapping[int, str]
    constant: Callable[[Sequence[int]], bool]
    strict: bool = True
    positive: bool = False
    spare: Sequence[SpareRows] = ()
    drags: Sequence[AttachedDrag] = ()

    def signed(self, x: int) -> int:
        """λ from the unknown of a row, or the other way round."""
        return x if self.positive else self.graph.neg(x)

    def drag_key(self, k: int) -> int:
        """The key of the force of a drag: it follows those of the multipliers."""
        return -1 - len(self.rows) - k

    def spared(self, order: Sequence[int]) -> dict[int, Spared]:
        """The sets with spare rows by multiplier, if multipliers are eliminated by pivots in this order."""
        found: dict[int, Spared] = {}
        for group in self.spare:
            rows = tuple(key for key in order if self.rows[-1 - key].row.name in group.names)
            if len(rows) >= group.count:
                found.update(dict.fromkeys(rows, Spared(rows, group.count)))
        return found


@dataclass(frozen=True)
class RowSolution:
    """``vdot``, and one node for each row of the following.

    These are λ with the sign of `rows` (nearly 0 for a skipped row), the margin, the residual of a skipped row (else
    0), the sum of the magnitudes that cancel in it, and whether the row was used. ``divisors`` are divisors that no
    margin watches, with the names of their rows. ``pressing`` are the equations of multipliers that press on friction.
    """

    vdot: list[int]
    multipliers: list[int]
    margins: list[int]
    residuals: list[int]
    sizes: list[int]
    regular: list[int]
    divisors: list[tuple[str, int]]
    pressing: Pressing | None = None
