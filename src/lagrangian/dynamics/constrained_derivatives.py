"""Derivatives of accelerations under constraints: the multipliers are differentiated along with them.

    M a + h = Ξ + Aᵀ λ        A a + γ = 0

define a and λ in every state, whether it satisfies the constraints or not. With both held constant in

    D = ∂(M a + h − Ξ − Aᵀ λ)/∂x        E = ∂(A a + γ)/∂x

the changes δa and δλ solve the same equations: M δa + D = Aᵀ δλ, A δa + E = 0. Held accelerations and multipliers are
inputs of the graph until D and E are differentiated, as in `derivatives`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.dynamics.ordering import Order, cheapest_solution, solution_in
from lagrangian.dynamics.row_problem import Problem
from lagrangian.dynamics.rows import ConstraintRow
from lagrangian.dynamics.vectors import Matrix, Vector, minus, transposed, zeros
from lagrangian.graph import Tangents, replaced, vjp


class ConstrainedChange:
    """δa for given D and E, by the elimination with the fewest operations for the first that is asked for."""

    def __init__(self, m: Mechanics, rows: Sequence[ConstraintRow]) -> None:
        self._m, self._rows = m, rows
        self._order: Order | None = None

    def _problems(self, loads: Sequence[int], changes: Sequence[int]) -> Iterator[Problem]:
        m = self._m
        pairs, asked = list(zip(m.v, loads, strict=True)), list(zip(self._rows, changes, strict=True))
        for links in m.distinct_groupings:
            yield from m.problems(links, pairs, asked, zeros(m.graph, len(m.v)))

    def __call__(self, loads: Sequence[int], changes: Sequence[int]) -> Vector:
        """δa with M δa + loads = Aᵀ δλ and A δa + changes = 0."""
        if self._order is not None:
            found = solution_in(self._order, self._problems(loads, changes))
            if found is not None:
                return found.vdot
        found, self._order = cheapest_solution(self._problems(loads, changes), multipliers=False)
        return found.vdot


def constrained_slopes(m: Mechanics, columns: Sequence[dict[int, int]]) -> tuple[Vector, Matrix, Matrix]:
    """a, ∂a/∂Ξ, and ∂a along every direction (input node → tangent), for a system without friction on its rows."""
    g, n = m.graph, len(m.v)
    solution, dependent = m.settled
    kept = [k for k, row in enumerate(m.rows) if row.name not in dependent]
    rows = [m.rows[k] for k in kept]
    a, lam = [g.input("a", i) for i in range(n)], [g.input("lam", k) for k in range(len(rows))]
    rates = [row.rate for row in rows]
    missing = minus(g, m.inverse(a), vjp(g, rates, lam, list(m.v)))
    changing = m.row_accelerations(m.accelerations(a))  # the γ of `forward`, also where c is not 0
    ends = [*missing, *(changing[k][1] for k in kept)]
    values = dict(zip([*a, *lam], [*solution.vdot, *(solution.multipliers[k] for k in kept)], strict=True))
    change = ConstrainedChange(m, rows)
    still = zeros(g, len(rows))
    by_force = transposed([change([g.negative if i == k else g.zero for i in range(n)], still) for k in range(n)])
    found: Matrix = []
    for column in columns:
        slopes = replaced(g, Tangents(g, column)(ends), values)
        found.append(change(slopes[:n], slopes[n:]))
    return solution.vdot, by_force, transposed(found) or [[] for _ in range(n)]
