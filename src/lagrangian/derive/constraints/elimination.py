"""Rows that are solved for some of their rates, in the graph: the reduced echelon form at a generic point."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.derive.constraints.pfaffian import Sheet
from lagrangian.derive.constraints.spans import GenericPoint
from lagrangian.graph import operands, reached
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class Solved:
    """Rows with ``rows[r][pivots[r]] = 1``; all other rows are 0 in that column."""

    rows: list[list[int]]
    pivots: list[int]


def solved(sheet: Sheet, place: GenericPoint, rows: Sequence[Sequence[int]], columns: Sequence[int]) -> Solved:
    """Return the reduced echelon form of independent rows; pivots are in ``columns``.

    The pivot of a row is its simplest entry that is not zero: a number, then a constant, then the entry with the fewest
    operations; of equal ones the first in ``columns``.
    """
    graph = sheet.graph
    done: list[list[int]] = []
    pivots: list[int] = []
    for given in rows:
        row = list(given)
        for pivot, other in zip(pivots, done, strict=True):
            row = _less(sheet, row, row[pivot], other)
        free = [k for k in columns if k not in pivots and row[k] != graph.zero]
        free = [k for k, there in zip(free, place.nonzero([row[k] for k in free]), strict=True) if there]
        pivot = min(free, key=lambda k: (_price(sheet, row[k]), columns.index(k)))
        row = [graph.one if k == pivot else graph.div(x, row[pivot]) for k, x in enumerate(row)]
        for k, other in enumerate(done):
            done[k] = _less(sheet, other, other[pivot], row)
            done[k][pivot] = graph.zero
        for k in pivots:
            row[k] = graph.zero
        done.append(row)
        pivots.append(pivot)
    return Solved(done, pivots)


def _less(sheet: Sheet, row: list[int], factor: int, other: list[int]) -> list[int]:
    """Row − factor · other."""
    graph = sheet.graph
    if factor == graph.zero:
        return list(row)
    return [graph.sub(a, graph.mul(factor, b)) for a, b in zip(row, other, strict=True)]


PRICED = 2_000
"""The largest number of nodes that are counted to estimate the length of an entry."""


def _price(sheet: Sheet, node: int) -> tuple[bool, int]:
    """Whether an entry changes during a motion, and its number of operations, as far as they are counted."""
    seen = {node}
    stack = [node]
    while stack and len(seen) < PRICED:
        for k in operands(sheet.graph.nodes[stack.pop()]):
            if k not in seen:
                seen.add(k)
                stack.append(k)
    return any(x in seen for x in sheet.columns) or bool(stack), len(seen)


def fields(sheet: Sheet, solution: Solved) -> list[list[int]]:
    """Return the fields that span the kernel of the solved rows in (q, t): one for every column without a pivot."""
    graph, width = sheet.graph, len(sheet.columns)
    found: list[list[int]] = []
    for free in range(width):
        if free in solution.pivots:
            continue
        field = [graph.zero] * width
        field[free] = graph.one
        for row, pivot in zip(solution.rows, solution.pivots, strict=True):
            field[pivot] = graph.neg(row[free])
        found.append(field)
    return found


def kernel(
    sheet: Sheet, place: GenericPoint, vectors: Sequence[Sequence[int]], width: int, columns: Sequence[int]
) -> list[list[int]]:
    """Return a basis of the rows c with c · v = 0 for all of the independent ``vectors`` (of ``width`` entries)."""
    graph = sheet.graph
    solution = solved(sheet, place, vectors, columns)
    found: list[list[int]] = []
    for free in range(width):
        if free not in solution.pivots:
            row = [graph.zero] * width
            row[free] = graph.one
            for vector, pivot in zip(solution.rows, solution.pivots, strict=True):
                row[pivot] = graph.neg(vector[free])
            found.append(row)
    return found


def size(sheet: Sheet, rows: Sequence[Sequence[int]]) -> int:
    """Return the number of nodes in rows."""
    return len(reached(sheet.graph, [x for row in rows for x in row]))
