"""Friction whose normal force is a multiplier: the friction f_i = a_i λ_r(i) acts on the motion that λ keeps.

In an elimination every f_i is a further unknown, on the right-hand side: it adds −f_i v̇_i to the form, and nothing
eliminates it. What is left when all else is eliminated is affine in f,

    λ_r = λ⁰_r + Σ_i Λ_ri f_i,        so that        Σ_s (δ_rs − Σ_{i: r(i) = s} Λ_ri a_i) λ_s = λ⁰_r

which is a small system for the λ_r that press. It has one solution for each direction of slip as long as its
determinant is positive whatever the signs of the λ_s are, so that −|a| ≤ a ≤ |a| cannot make it vanish (the matrix is
then a P-matrix, and elimination in any order has positive pivots). Beyond that are Painlevé's paradoxes: no
acceleration agrees with Coulomb's law, or several do.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from lagrangian.dynamics.rows import Drag
from lagrangian.dynamics.vectors import Matrix, Vector, bare
from lagrangian.errors import ModelError
from lagrangian.graph import Graph

MOST_PRESSING = 6
"""The largest number of rows that press on friction that slips at the same time."""


@dataclass(frozen=True)
class AttachedDrag:
    """A friction in an elimination: it acts on ``node`` times ``sign`` with ``factor`` times the multiplier ``row``."""

    node: int
    sign: int
    factor: int
    row: int

    @classmethod
    def of(cls, graph: Graph, drag: Drag, rows: Sequence[str]) -> AttachedDrag:
        """A friction with its rate's own node, whatever its sign; ``rows`` are the names of the rows that are kept."""
        if drag.row not in rows:
            raise undetermined(drag.row)
        node, negative = bare(graph, drag.rate)
        sign = graph.negative if negative else graph.one
        return cls(node, sign, slip_factor(drag), rows.index(drag.row))


def slip_factor(drag: Drag) -> int:
    """∓μ of a friction that slips; raises `ModelError` (E311) where it is not known whether it does."""
    if drag.factor is None:
        raise ModelError(
            f"the friction that '{drag.row}' presses on sticks or slips, and its force depends on which",
            fix="use simulate, ensemble or sweep; or system.regime(…), which says what slips and what sticks",
            code="E311",
        )
    return drag.factor


def undetermined(row: str) -> ModelError:
    """The error about a normal force that the equations leave open."""
    return ModelError(
        f"the row '{row}' presses on friction and follows from other rows: its share of their force cannot be told",
        fix="leave out the rows that say the same, or give the normal force as an expression",
        code="E310",
    )


@dataclass(frozen=True)
class Pressing:
    """The equations of the multipliers that press: ``given`` λ⁰ and ``gain`` G of (1 − G) λ = λ⁰, by rows in order."""

    graph: Graph
    rows: tuple[int, ...]
    given: Vector
    gain: Matrix

    @classmethod
    def of(
        cls,
        graph: Graph,
        drags: Sequence[AttachedDrag],
        given: Mapping[int, int],
        slopes: Sequence[Mapping[int, int]],
    ) -> Pressing:
        """From λ⁰ of every row, and for every drag how the λ of every row change with its force."""
        rows = tuple(dict.fromkeys(drag.row for drag in drags))
        gain = [[graph.zero] * len(rows) for _ in rows]
        for drag, slope in zip(drags, slopes, strict=True):
            k = rows.index(drag.row)
            for i, row in enumerate(rows):
                gain[i][k] = graph.add(gain[i][k], graph.mul(slope[row], drag.factor))
        return cls(graph, rows, [given[row] for row in rows], gain)

    def solved(self) -> dict[int, int]:
        """λ of every row that presses."""
        g, n = self.graph, len(self.rows)
        matrix, right = self._matrix([g.one] * n), list(self.given)
        for k in range(n):
            over = g.div(g.one, matrix[k][k])
            for i in range(k + 1, n):
                part = g.mul(matrix[i][k], over)
                right[i] = g.sub(right[i], g.mul(part, right[k]))
                for j in range(k + 1, n):
                    matrix[i][j] = g.sub(matrix[i][j], g.mul(part, matrix[k][j]))
        for k in reversed(range(n)):
            for j in range(k + 1, n):
                right[k] = g.sub(right[k], g.mul(matrix[k][j], right[j]))
            right[k] = g.mul(right[k], g.div(g.one, matrix[k][k]))
        return dict(zip(self.rows, right, strict=True))

    def regularity(self) -> int:
        """The least determinant of 1 − G for all signs of the multipliers: 1 without coupling, 0 at a paradox."""
        g, n = self.graph, len(self.rows)
        if n > MOST_PRESSING:
            raise ModelError(
                f"{n} rows press on friction that slips at the same time",
                fix=f"at most {MOST_PRESSING}; give normal forces that do not depend on the friction as expressions",
                code="E601",
            )
        least = g.one
        for signs in product((g.one, g.negative), repeat=n):
            least = g.min(least, determinant(g, self._matrix(signs)))
        return least

    def _matrix(self, signs: Sequence[int]) -> Matrix:
        """1 − G with the multipliers of the columns times ``signs``."""
        g = self.graph
        return [
            [g.sub(g.one if i == k else g.zero, g.mul(row[k], sign)) for k, sign in enumerate(signs)]
            for i, row in enumerate(self.gain)
        ]


def determinant(g: Graph, matrix: Matrix) -> int:
    """The determinant, by expansion along the first row."""
    if not matrix:
        return g.one
    total = g.zero
    for k, x in enumerate(matrix[0]):
        if x != g.zero:
            minor = determinant(g, [[*row[:k], *row[k + 1 :]] for row in matrix[1:]])
            part = g.mul(x, minor)
            total = g.sub(total, part) if k % 2 else g.add(total, part)
    return total
