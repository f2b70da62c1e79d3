"""Corrections of a state, the constraint rows themselves, and a second route to accelerations and multipliers.

A state that does not satisfy its rows is moved onto them by the least motion, measured by the kinetic energy:

    δq = −N M⁻¹ Aᵀ (A M⁻¹ Aᵀ)⁺ f            δv = −M⁻¹ Aᵀ (A M⁻¹ Aᵀ)⁺ (A v + a₀)

The same elimination gives both: it minimises ½ δᵀ M δ subject to A δ + f = 0. The second is what an impact on the
constraints would do, so it never adds energy where the rows do not depend on time.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import TypeAlias

from lagrangian.dynamics.guard import LEAST_MARGIN
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.dynamics.ordering import Order, cheapest_solution, solution_in
from lagrangian.dynamics.row_problem import Problem, RowSolution
from lagrangian.dynamics.rows import ConstraintRow
from lagrangian.dynamics.vectors import Matrix, Vector, dot, times, zeros
from lagrangian.graph import Graph, jvp, replaced, vjp
from lagrangian.records import dataclass


def position_rows(m: Mechanics) -> list[ConstraintRow]:
    """The rows on positions."""
    return [row for row in m.rows if row.residual is not None]


def kept_by_steps(m: Mechanics) -> bool:
    """Whether all rows have constant coefficients: every Runge–Kutta step then satisfies them up to rounding."""
    changes = m.motion.second_rate([row.rate for row in m.rows], zeros(m.graph, len(m.v)))
    return all(x == m.graph.zero for x in changes)


Correction: TypeAlias = tuple[Vector, RowSolution, Order]
"""A step, the solution that it comes from, and the order of its elimination."""


def position_correction(m: Mechanics, fixed: Collection[int] = (), order: Order | None = None) -> Correction | None:
    """Return δq; None without rows on positions.

    ``fixed``: coordinates (numbers) that stay as they are. ``order``: that of an elimination with the same rows, which
    this one then shares.
    """
    rows = position_rows(m)
    if not rows:
        return None
    found, order = _correction(m, rows, [row.residual or m.graph.zero for row in rows], fixed, order)
    return jvp(m.graph, m.motion.rates, dict(zip(m.v, found.vdot, strict=True))), found, order


def velocity_correction(m: Mechanics, fixed: Collection[int] = ()) -> Correction | None:
    """Return δv; None without rows. The rates of ``fixed`` coordinates stay."""
    if not m.rows:
        return None
    found, order = _correction(m, m.rows, [row.rate for row in m.rows], fixed)
    return found.vdot, found, order


def _correction(
    m: Mechanics,
    rows: Sequence[ConstraintRow],
    values: Sequence[int],
    fixed: Collection[int],
    order: Order | None = None,
) -> tuple[RowSolution, Order]:
    """The least δ with A δ = −values.

    A fixed coordinate whose rate is a velocity loses its column; any other fixed coordinate gets a row.
    """
    held, asked = set[int](), list(zip(rows, values, strict=True))
    for i in fixed:
        rate = m.motion.rates[i]
        if rate in m.v:
            held.add(m.v.index(rate))
        else:
            asked.append((ConstraintRow(f"fixed {i}", "fixed", rate), m.graph.zero))
    nothing = zeros(m.graph, len(m.v))

    def problems() -> Iterator[Problem]:
        for links in m.distinct_groupings:
            yield from m.problems(links, [], asked, nothing, held, strict=False)

    if order is not None and (found := solution_in(order, problems())) is not None:
        return found, order
    return cheapest_solution(problems(), multipliers=False)


def gap(m: Mechanics, rows: Sequence[ConstraintRow], values: Sequence[int]) -> int:
    """The largest |value| of the rows, each divided by its scale."""
    g, total = m.graph, m.graph.zero
    for row, value in zip(rows, values, strict=True):
        total = g.max(total, g.div(g.abs(value), g.const(row.scale)))
    return total


def least(g: Graph, ids: Sequence[int]) -> int:
    """The smallest of some nodes; 1 if there are none."""
    total = g.one
    for x in ids:
        total = g.min(total, x)
    return total


def matrix(m: Mechanics) -> Matrix:
    """A, row by row, with one backward pass for each row."""
    return [vjp(m.graph, [row.rate], [m.graph.one], list(m.v)) for row in m.rows]


def drive(m: Mechanics) -> Vector:
    """a₀: the rows at v = 0."""
    return replaced(m.graph, [row.rate for row in m.rows], dict.fromkeys(m.v, m.graph.zero))


def second_rates(m: Mechanics) -> Vector:
    """γ: the rows' rates at v̇ = 0."""
    return m.motion.second_rate([row.rate for row in m.rows], zeros(m.graph, len(m.v)))


# -- the second route -------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Factors:
    """S = L D Lᵀ of a symmetric matrix: ``lower`` below the diagonal, and the reciprocals of D."""

    lower: Matrix
    reciprocals: Vector

    def solve(self, g: Graph, right: Sequence[int]) -> Vector:
        """S⁻¹ right."""
        n, x = len(self.lower), list(right)
        for i in range(n):
            x[i] = g.sub(x[i], dot(g, self.lower[i][:i], x[:i]))
        x = [g.mul(r, y) for r, y in zip(self.reciprocals, x, strict=True)]
        for i in reversed(range(n)):
            x[i] = g.sub(x[i], dot(g, [self.lower[k][i] for k in range(i + 1, n)], x[i + 1 :]))
        return x


def factored(g: Graph, S: Matrix, sizes: Sequence[int] | None = None) -> Factors:
    """The factors of S. A pivot that is small compared with ``sizes`` is rounding: its reciprocal is set to 0."""
    n = len(S)
    lower, reciprocals = [zeros(g, n) for _ in range(n)], zeros(g, n)
    scaled = [zeros(g, n) for _ in range(n)]  # L D
    for j in range(n):
        pivot = g.sub(S[j][j], dot(g, lower[j][:j], scaled[j][:j]))
        reciprocals[j] = g.div(g.one, pivot)
        if sizes is not None:
            regular = g.lt(g.mul(g.const(LEAST_MARGIN), sizes[j]), pivot)
            reciprocals[j] = g.select(regular, reciprocals[j], g.zero)
        for i in range(j + 1, n):
            scaled[i][j] = g.sub(S[i][j], dot(g, lower[i][:j], scaled[j][:j]))
            lower[i][j] = g.mul(scaled[i][j], reciprocals[j])
    return Factors(lower, reciprocals)


def dual(m: Mechanics) -> tuple[Vector, Vector]:
    """v̇ and λ by A M⁻¹ Aᵀ λ = A M⁻¹ h − γ and M v̇ = Aᵀ λ − h: the independent route, of dense matrices.

    The mass matrix must be regular without the rows. A row that depends on earlier ones gets the multiplier 0.
    """
    g = m.graph
    M, A = factored(g, m.mass_matrix()), matrix(m)
    columns = [M.solve(g, row) for row in A]
    free = M.solve(g, m.bias())
    S = [[dot(g, row, column) for column in columns] for row in A]
    groups: dict[str, int] = {}
    for i, row in enumerate(m.rows):
        groups[row.closure] = g.add(groups.get(row.closure, g.zero), S[i][i])
    right = [g.sub(x, y) for x, y in zip(times(g, A, free), second_rates(m), strict=True)]
    lam = factored(g, S, [groups[row.closure] for row in m.rows]).solve(g, right)
    vdot = [g.sub(dot(g, [column[k] for column in columns], lam), x) for k, x in enumerate(free)]
    return vdot, lam
