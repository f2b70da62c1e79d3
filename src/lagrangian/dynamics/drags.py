"""Friction whose normal force is a multiplier: the friction f_i = a_i N_i acts on the motion that N_i's rows keep.

N is the multiplier λ of one row, with its sign, or √(λ₁² + λ₂² + …) of several. In an elimination every f_i is a
further unknown, on the right-hand side: it adds −f_i v̇_i to the form, and nothing eliminates it. What is left when all
else is eliminated is affine in f,

    λ_r = λ⁰_r + Σ_i Λ_ri a_i N_i = λ⁰_r + Σ_k G_rk N_k

The N of single rows are eliminated from this small system. What remains is N_j = |c_j + Σ_k D_jk N_k|, where c_j and
D_jk have one entry for each row of the group j: for one group a quadratic equation, for several Newton's method, which
starts at |c| and reaches rounding after a few steps.

There is one solution for each direction of slip as long as the determinant of 1 − G is positive whatever the signs of
the λ of single rows are, so that −|a| ≤ a ≤ |a| cannot make it vanish (the matrix is then a P-matrix, and elimination
in any order has positive pivots), and as long as N ↦ |c + D N| is a contraction: the leading minors of 1 − |D_jk| are
positive. Beyond that are Painlevé's paradoxes: no acceleration agrees with Coulomb's law, or several do. (For several
groups that couple strongly, a contraction is more than is needed: a run may end early there.)
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import product

from lagrangian.dynamics.rows import Drag
from lagrangian.dynamics.vectors import Matrix, Vector, bare, dot
from lagrangian.errors import ModelError
from lagrangian.graph import Graph
from lagrangian.model import Friction
from lagrangian.model.without_friction import advice_for
from lagrangian.records import dataclass

MOST_PRESSING = 6
"""The largest number of normal forces of friction that slips at the same time."""

NEWTON_STEPS = 7
"""The steps of Newton's method for several forces of several rows."""

SOLVED = 1e-10
"""The largest difference, relative to the forces, with which those forces count as found."""

Group = tuple[int, ...]
"""The rows, by number, whose multipliers press together."""


@dataclass(frozen=True)
class AttachedDrag:
    """A friction in an elimination: it acts on ``node`` times ``sign`` with ``factor`` times the force of ``rows``."""

    node: int
    sign: int
    factor: int
    rows: Group

    @classmethod
    def of(cls, graph: Graph, drag: Drag, rows: Sequence[str]) -> AttachedDrag:
        """A friction with its rate's own node, whatever its sign; ``rows`` are the names of the rows that are kept."""
        for row in drag.rows:
            if row not in rows:
                raise undetermined(row, drag.friction)
        node, negative = bare(graph, drag.rate)
        sign = graph.negative if negative else graph.one
        return cls(node, sign, slip_factor(drag), tuple(rows.index(row) for row in drag.rows))


def slip_factor(drag: Drag) -> int:
    """∓μ of a friction that slips; raises `ModelError` (E311) where it is not known whether it does."""
    if drag.factor is None:
        raise ModelError(
            "it sticks or slips, and accelerations at rest are no smooth function of the state",
            element=drag.friction.title,
            place=drag.friction.place,
            fix=advice_for(drag.friction),
            code="E311",
        )
    return drag.factor


def undetermined(row: str, friction: Friction) -> ModelError:
    """The error about the normal force of a friction that the equations leave open."""
    return ModelError(
        f"the row '{row}' presses on friction and follows from other rows: its share of their force cannot be told",
        element=friction.title,
        place=friction.place,
        fix="leave out the rows that say the same, or give the normal force as an expression",
        code="E310",
    )


def pressing_force(g: Graph, multipliers: Sequence[int]) -> int:
    """λ of one row, with its sign, or √(λ₁² + λ₂² + …) of several."""
    return multipliers[0] if len(multipliers) == 1 else g.sqrt(dot(g, multipliers, multipliers))


def dragged_by(g: Graph, drags: Sequence[Drag], multipliers: Mapping[str, int]) -> list[tuple[int, int]]:
    """(rate, effort) of frictions that slip in known senses, with the multipliers of rows by their names."""
    return [(d.rate, g.mul(slip_factor(d), pressing_force(g, [multipliers[row] for row in d.rows]))) for d in drags]


def slipping_by(g: Graph, drags: Sequence[Drag], multipliers: Mapping[str, int]) -> list[tuple[Drag, int]]:
    """Every friction with its effort where it slips: −μ |N| sign(δ̇), or what that is where sense and side are known."""
    found: list[tuple[Drag, int]] = []
    for drag in drags:
        normal = pressing_force(g, [multipliers[row] for row in drag.rows])
        if drag.factor is not None:
            found.append((drag, g.mul(drag.factor, normal)))
            continue
        size = normal if len(drag.rows) > 1 else g.abs(normal)
        found.append((drag, g.neg(g.mul(g.mul(drag.coefficient, size), g.sign(drag.rate)))))
    return found


@dataclass(frozen=True)
class Pressing:
    """The equations λ_r = λ⁰_r + Σ_k G_rk N_k: ``given`` λ⁰ and ``gain`` G of every row that presses, and the groups
    whose forces N_k are."""

    graph: Graph
    groups: tuple[Group, ...]
    given: Mapping[int, int]
    gain: Mapping[int, Vector]

    @classmethod
    def of(
        cls,
        graph: Graph,
        drags: Sequence[AttachedDrag],
        given: Mapping[int, int],
        slopes: Sequence[Mapping[int, int]],
    ) -> Pressing:
        """From λ⁰ of every row, and for every drag how the λ of every row change with its force."""
        groups = tuple(sorted(dict.fromkeys(drag.rows for drag in drags), key=lambda group: len(group) > 1))
        gain = {row: [graph.zero] * len(groups) for row in given}
        for drag, slope in zip(drags, slopes, strict=True):
            k = groups.index(drag.rows)
            for row, column in gain.items():
                column[k] = graph.add(column[k], graph.mul(slope[row], drag.factor))
        return cls(graph, groups, given, gain)

    @cached_property
    def singles(self) -> int:
        """The number of groups of one row; they come first."""
        return sum(len(group) == 1 for group in self.groups)

    def solved(self) -> dict[Group, int]:
        """N of every group."""
        g, n = self.graph, self.singles
        columns = self._eliminated([g.one] * n)
        forces = self._together(*self._left(columns))
        single = [g.add(row[0], dot(g, row[1:], forces)) for row in columns]
        return dict(zip(self.groups, [*single, *forces], strict=True))

    def regularity(self) -> int:
        """The least of the determinants for all signs of single rows: 1 without coupling, 0 or less at a paradox, or
        where the forces of several rows were not found."""
        g, n = self.graph, self.singles
        if len(self.groups) > MOST_PRESSING:
            raise ModelError(
                f"{len(self.groups)} rows, or sets of rows, press on friction that slips at the same time",
                fix=f"at most {MOST_PRESSING}; give normal forces that do not depend on the friction as expressions",
                code="E601",
            )
        least = g.one
        for signs in product((g.one, g.negative), repeat=n):
            least = g.min(least, determinant(g, self._matrix(signs)))
            for minor in self._contracting(self._left(self._eliminated(signs))[1]) if n < len(self.groups) else ():
                least = g.min(least, minor)
        return g.select(self._missed(), g.zero, least) if len(self.groups) - n > 1 else least

    # -- single rows --------------------------------------------------------------------------------------------

    def _matrix(self, signs: Sequence[int]) -> Matrix:
        """1 − G of the single rows, with the multipliers of the columns times ``signs``."""
        g, rows = self.graph, [group[0] for group in self.groups[: self.singles]]
        return [
            [g.sub(g.one if i == k else g.zero, g.mul(self.gain[row][k], sign)) for k, sign in enumerate(signs)]
            for i, row in enumerate(rows)
        ]

    def _eliminated(self, signs: Sequence[int]) -> Matrix:
        """The N of single rows as 1 and the N of the other groups make them: a constant and one factor for each."""
        g, n, matrix = self.graph, self.singles, self._matrix(signs)
        right = [[self.given[group[0]], *self.gain[group[0]][n:]] for group in self.groups[:n]]
        for k in range(n):
            over = g.div(g.one, matrix[k][k])
            for i in range(k + 1, n):
                part = g.mul(matrix[i][k], over)
                right[i] = [g.sub(x, g.mul(part, y)) for x, y in zip(right[i], right[k], strict=True)]
                for j in range(k + 1, n):
                    matrix[i][j] = g.sub(matrix[i][j], g.mul(part, matrix[k][j]))
        for k in reversed(range(n)):
            for j in range(k + 1, n):
                right[k] = [g.sub(x, g.mul(matrix[k][j], y)) for x, y in zip(right[k], right[j], strict=True)]
            over = g.div(g.one, matrix[k][k])
            right[k] = [g.mul(x, over) for x in right[k]]
        return right

    # -- several rows -------------------------------------------------------------------------------------------

    def _left(self, columns: Matrix) -> tuple[list[Vector], list[Matrix]]:
        """c_j and D_jk of the groups of several rows, one entry for each row, after the single rows are eliminated."""
        g, n = self.graph, self.singles
        constants, factors = list[Vector](), list[Matrix]()
        for group in self.groups[n:]:
            made = [
                [
                    g.add(own, dot(g, self.gain[row][:n], [column[k] for column in columns]))
                    for k, own in enumerate((self.given[row], *self.gain[row][n:]))
                ]
                for row in group
            ]
            constants.append([row[0] for row in made])
            factors.append([[row[1 + k] for row in made] for k in range(len(self.groups) - n)])
        return constants, factors

    def _together(self, c: list[Vector], D: list[Matrix]) -> Vector:
        """The solution of N_j = |c_j + Σ_k D_jk N_k|."""
        g = self.graph
        if len(c) == 1:  # (1 − D²) N² − 2 c·D N − c² = 0
            (given,), ((factor,),) = c, D
            rest, half = g.sub(g.one, dot(g, factor, factor)), dot(g, given, factor)
            root = g.sqrt(g.add(g.mul(half, half), g.mul(rest, dot(g, given, given))))
            return [g.div(g.add(half, root), rest)]
        found = [g.sqrt(dot(g, given, given)) for given in c]
        for _ in range(NEWTON_STEPS if c else 0):
            found = self._newton(c, D, found)
        return found

    def _newton(self, c: list[Vector], D: list[Matrix], found: Vector) -> Vector:
        """N_j − Σ_k (e_j·D_jk) N_k = e_j·c_j, with the directions e_j of the forces so far."""
        g, n = self.graph, len(c)
        directions: list[Vector] = []
        for force in self._forces(c, D, found):
            size = g.sqrt(dot(g, force, force))
            over = g.select(g.lt(g.zero, size), g.div(g.one, size), g.zero)
            directions.append([g.mul(x, over) for x in force])
        matrix = [
            [g.sub(g.one if j == k else g.zero, dot(g, directions[j], D[j][k])) for k in range(n)] for j in range(n)
        ]
        whole = determinant(g, matrix)
        right = [dot(g, directions[j], c[j]) for j in range(n)]
        return [
            g.div(determinant(g, [[*row[:k], x, *row[k + 1 :]] for row, x in zip(matrix, right, strict=True)]), whole)
            for k in range(n)
        ]

    def _forces(self, c: list[Vector], D: list[Matrix], found: Vector) -> Iterator[Vector]:
        """c_j + Σ_k D_jk N_k."""
        g = self.graph
        for given, factors in zip(c, D, strict=True):
            yield [g.add(x, dot(g, [factor[i] for factor in factors], found)) for i, x in enumerate(given)]

    def _missed(self) -> int:
        """Whether Newton's method did not find the forces."""
        g = self.graph
        c, D = self._left(self._eliminated([g.one] * self.singles))
        found = self._together(c, D)
        error, size = g.zero, g.zero
        for force, normal in zip(self._forces(c, D, found), found, strict=True):
            error = g.max(error, g.abs(g.sub(g.sqrt(dot(g, force, force)), normal)))
            size = g.max(size, g.abs(normal))
        return g.lt(g.mul(g.const(SOLVED), size), error)

    def _contracting(self, D: list[Matrix]) -> Iterator[int]:
        """The leading minors of 1 − |D_jk|."""
        g = self.graph
        matrix = [
            [g.sub(g.one if j == k else g.zero, g.sqrt(dot(g, x, x))) for k, x in enumerate(row)]
            for j, row in enumerate(D)
        ]
        for size in range(1, len(matrix) + 1):
            yield determinant(g, [row[:size] for row in matrix[:size]])


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
