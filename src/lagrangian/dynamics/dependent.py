"""Rows whose coefficients depend on those of other rows in every state.

The elimination finds such a row because its pivot is zero by structure. If the row's residual is zero at every state,
the row repeats others: it is left out, and its multiplier is 0. If not, no motion satisfies all rows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, MutableMapping, Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from lagrangian.dynamics.accelerations import Quadratic
from lagrangian.dynamics.ordering import Order, cheapest_solution, found_solutions, solution_in
from lagrangian.dynamics.row_problem import DependentRow, Problem, RowSolution
from lagrangian.dynamics.rows import ConstraintRow
from lagrangian.errors import ModelError, RunError, listed
from lagrangian.graph import Graph, Output, Program, Valuation, evaluate, reached
from lagrangian.graph.variations import Variations

Array = NDArray[np.float64]

PLACES = 3
"""The number of random states at which a residual is computed."""

ROUNDING = 1e-8
"""A residual below this counts as zero."""


SHOWN = 6
"""The largest number of rows that a message names."""

Repeated = Mapping[str, tuple[str, ...]]
"""The names of rows that are left out, each with the names of the rows that say the same together."""

Known = tuple[Repeated, Order]
"""The rows that are left out, and the order in which the others are eliminated."""

CLEAR = 1e-7
"""Rows are independent without doubt if the smallest eigenvalue of their scaled products is above this."""

SHARE = 1e-9
"""A row has no part in another one if its factor is below this at every state."""


def quoted(names: Sequence[str]) -> str:
    """The names in a sentence: 'a', 'b' and 'c'; of many, the first ones."""
    shown = [f"'{name}'" for name in names[:SHOWN]]
    return listed([*shown, f"{len(names) - SHOWN} more"] if len(names) > SHOWN else shown)


def without_dependent(
    graph: Graph,
    rows: Sequence[ConstraintRow],
    v: Sequence[int],
    problems: Callable[[Sequence[ConstraintRow]], Iterator[Problem]],
    known: MutableMapping[tuple[str, ...], Known],
) -> tuple[RowSolution, Repeated]:
    """The cheapest solution subject to the independent rows, and the other rows.

    ``known`` remembers the choice for the programs of a model, each of which needs a solution in a graph of its own.
    Raises `ModelError` (E302) if a row contradicts the others.
    """
    asked = tuple(row.name for row in rows)
    found = None
    left_out: Repeated = {}
    if asked in known:
        left_out, order = known[asked]
        found = solution_in(order, problems([row for row in rows if row.name not in left_out]))
    if found is None:
        (found, order), left_out = _independent(graph, rows, v, lambda kept: cheapest_solution(problems(kept)))
        known[asked] = left_out, order
    return _filled(graph, found, [row.name not in left_out for row in rows]), left_out


def dependent_among(
    graph: Graph,
    rows: Sequence[ConstraintRow],
    v: Sequence[int],
    problems: Callable[[Sequence[ConstraintRow]], Iterator[Problem]],
    known: Mapping[tuple[str, ...], Known],
) -> Repeated:
    """The rows that are left out, from the first elimination that succeeds: none are compared.

    Raises `ModelError` (E302) if a row contradicts the others.
    """
    asked = tuple(row.name for row in rows)
    if asked in known:
        return known[asked][0]
    return _independent(graph, rows, v, lambda kept: next(found_solutions(problems(kept))))[1]


def independent_somewhere(graph: Graph, rows: Sequence[ConstraintRow], v: Sequence[int], H: Quadratic) -> bool:
    """Whether the rows are independent, and M is positive definite, at a random state: then no row depends on others
    in every state, and no elimination has to find that out.

    ``H`` gives M. False also where a row is not linear in the velocities, or a number is not finite.
    """
    rng = np.random.default_rng(1)
    bodies = list(H.rows)
    sizes = _sizes(graph, [*(row.rate for row in rows), *bodies, *(h for x in H.rows.values() for h in x.values())], v)
    place = {group: rng.uniform(0.3, 1.4, size) for group, size in sizes.items()}
    moved = {**place, "v": rng.uniform(0.3, 1.4, sizes["v"])}
    valuations = [Valuation(graph, {group: x.tolist() for group, x in at.items()}) for at in (place, moved)]
    slopes = Variations(graph, valuations, v)([*(row.rate for row in rows), *bodies])
    if not np.isfinite(slopes).all() or np.ptp(slopes, axis=0).max(initial=0.0) > ROUNDING * np.abs(slopes).max():
        return False
    A, J = slopes[0, :, : len(rows)].T, slopes[0, :, len(rows) :]
    inertia = np.array([[valuations[0].value(H.rows[i][k]) if k in H.rows[i] else 0.0 for k in bodies] for i in bodies])
    M = J @ inertia @ J.T
    return bool(np.isfinite(M).all()) and _regular(A @ A.T) and _regular(M)


def _regular(square: Array) -> bool:
    """Whether a symmetric matrix, scaled to a diagonal of ones, is positive definite by far."""
    scale = np.diag(square)
    if not (scale > 0).all():
        return False
    return bool(np.linalg.eigvalsh(square / np.sqrt(np.outer(scale, scale)))[0] > CLEAR)


Solved = TypeVar("Solved")


def _independent(
    graph: Graph,
    rows: Sequence[ConstraintRow],
    v: Sequence[int],
    solve: Callable[[Sequence[ConstraintRow]], Solved],
) -> tuple[Solved, Repeated]:
    """What ``solve`` makes of the rows that are independent, and the others."""
    kept = list(rows)
    left_out: dict[str, tuple[str, ...]] = {}
    while True:
        try:
            found = solve(kept)
            break
        except DependentRow as dependent:
            row = dependent.row
            vanishes, names = _vanishes(graph, dependent, rows, v, kept)
            if not vanishes:
                raise _contradiction(row, names) from None
            kept.remove(row)
            left_out[row.name] = names
    return found, {row.name: left_out[row.name] for row in rows if row.name in left_out}


def _contradiction(row: ConstraintRow, others: Sequence[str]) -> ModelError:
    return ModelError(
        f"the constraint '{row.name}' contradicts {quoted(others) or 'itself'}",
        fix="leave one of them out, or change it: no motion satisfies all of them",
        place=row.place,
        code="E302",
    )


def _filled(graph: Graph, found: RowSolution, kept: Sequence[bool]) -> RowSolution:
    """The solution with entries for the rows that were left out: multiplier 0, margin 1, residual 0."""

    def spread(ids: Sequence[int], nothing: int) -> list[int]:
        given = iter(ids)
        return [next(given) if keep else nothing for keep in kept]

    return RowSolution(
        found.vdot,
        spread(found.multipliers, graph.zero),
        spread(found.margins, graph.one),
        spread(found.residuals, graph.zero),
        spread(found.sizes, graph.zero),
        spread(found.regular, graph.zero),
        found.divisors,
        found.pressing,
    )


def _vanishes(
    graph: Graph,
    dependent: DependentRow,
    rows: Sequence[ConstraintRow],
    v: Sequence[int],
    kept: Sequence[ConstraintRow],
) -> tuple[bool, tuple[str, ...]]:
    """Whether the row's residual is zero at random states whose velocities satisfy all rows, and the names of the
    other ``kept`` rows with α_i ≠ 0.

    If c = Σ α_i c_i with the other rows, then ċ − Σ α_i ċ_i = Σ α̇_i c_i, which is zero if they are satisfied.
    """
    ids = [*(row.rate for row in rows), dependent.residual]
    sizes = _sizes(graph, ids, v)
    names = {group: tuple(f"{group}{k}" for k in range(size)) for group, size in sizes.items()}
    program = Program("rows", graph, names, {"c": Output(tuple(ids), (len(ids),))}, {})
    rng = np.random.default_rng(1)
    tried = [_vanishes_at(program, sizes, rng, [graph.nodes[i][1:] for i in v]) for _ in range(PLACES)]
    others = [row for row in kept if row is not dependent.row]
    here, there = rows.index(dependent.row), [rows.index(row) for row in others]
    shares = [_factors(A[here], A[there]) for _, A in tried if A is not None]
    has_part = np.abs([np.zeros(len(others)), *shares]).max(axis=0) > SHARE
    return all(vanishes for vanishes, _ in tried), tuple(
        row.name for row, part in zip(others, has_part, strict=True) if part
    )


def _sizes(graph: Graph, ids: Sequence[int], v: Sequence[int]) -> dict[str, int]:
    """How many numbers of every group of inputs nodes need, with the velocities ``v``."""
    sizes: dict[str, int] = {}
    for i in [*reached(graph, ids), *v]:
        node = graph.nodes[i]
        if node[0] == "input":
            sizes[node[1]] = max(sizes.get(node[1], 0), node[2] + 1)
    return sizes


def _factors(row: Array, others: Array) -> Array:
    """The factors α with row = Σ α_i others_i, 0 for what follows from the others before it."""
    found, basis = np.zeros(len(others)), []
    for k in range(len(others)):
        if np.linalg.matrix_rank(others[[*basis, k]], tol=ROUNDING * (1.0 + np.abs(others).max())) > len(basis):
            basis.append(k)
    if basis:
        found[basis] = np.linalg.lstsq(others[basis].T, row, rcond=None)[0]
    return found


def _vanishes_at(
    program: Program, sizes: Mapping[str, int], rng: np.random.Generator, v: Sequence[Any]
) -> tuple[bool, Array | None]:
    """Whether the last entry of c is zero at a random state, and A of the others."""
    state = {group: rng.uniform(0.3, 1.4, size) for group, size in sizes.items()}

    def values(velocities: Array) -> Array:
        for (group, k), x in zip(v, velocities, strict=True):
            state[group][k] = x
        return np.array(evaluate(program, {group: x.tolist() for group, x in state.items()})["c"])

    try:
        start = values(np.zeros(len(v)))[:-1]
        A = np.array([values(e)[:-1] - start for e in np.eye(len(v))]).T
        guess = rng.uniform(0.3, 1.4, len(v))
        found = values(guess - np.linalg.pinv(A, rcond=1e-9) @ (A @ guess + start))
    except RunError:  # no value there: nothing is known, so nothing is left out
        return False, None
    return bool(np.abs(found).max() < ROUNDING * (1.0 + np.abs(A).max() + np.abs(start).max())), A
