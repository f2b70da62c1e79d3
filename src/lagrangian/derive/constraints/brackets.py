"""The growth vector: the number of directions that brackets add to the fields that satisfy the rows.

The fields X span the kernel of the rows in (q, t). If [X, Y] = (∂Y) X − (∂X) Y is not in their span, a small loop of
allowed motions leads in a direction in which no allowed motion goes directly: the rows are not integrable. By
Frobenius' theorem the system is holonomic if no bracket leaves the span. By Chow's theorem the configurations that
can be reached have the dimension of the closure under brackets.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lagrangian.derive.constraints.pfaffian import Sheet
from lagrangian.derive.constraints.spans import GenericPoint
from lagrangian.graph import Tangents
from lagrangian.records import dataclass

MAX_NODES = 100_000
"""No more brackets are computed when the graph has this many nodes."""


@dataclass(frozen=True, eq=False)
class Closure:
    """The growth (the rank after each depth of brackets, without the direction of time) and the independent brackets.

    ``complete`` says whether no further bracket can raise the rank; if not, ``depth`` is the last complete depth.
    """

    growth: tuple[int, ...]
    brackets: list[list[int]]
    complete: bool
    depth: int


def closure(
    sheet: Sheet, place: GenericPoint, generators: Sequence[Sequence[int]], *, limit: int = MAX_NODES
) -> Closure:
    """Close the fields under brackets with the generators; a bracket is kept if it raises the rank."""
    graph, width = sheet.graph, len(sheet.columns)
    span = place.span()
    for k, field in enumerate(generators):
        span.take(k, field)
    growth = [len(generators) - 1]
    along = [Tangents(graph, _moving(sheet, field)) for field in generators]
    kept: list[list[int]] = []
    newest = [list(field) for field in generators]
    start = len(graph)
    while newest and len(span) < width:
        added: list[list[int]] = []
        for i, j in _pairs(len(generators), len(newest), among=not kept):
            if len(graph) - start > limit:
                reached = [*growth, len(span) - 1] if added else growth
                return Closure(tuple(reached), kept + added, False, len(growth))
            field = newest[j]
            own = along[j] if not kept else Tangents(graph, _moving(sheet, field))
            first, second = along[i](field), own(generators[i])
            bracket = [graph.sub(a, b) for a, b in zip(first, second, strict=True)]
            if span.take(len(generators) + len(kept) + len(added), bracket):
                added.append(bracket)
            if len(span) == width:
                break
        kept += added
        newest = added
        if added:
            growth.append(len(span) - 1)
    return Closure(tuple(growth), kept, True, len(growth))


def _pairs(generators: int, fields: int, *, among: bool) -> Iterator[tuple[int, int]]:
    """Every generator with every field; each pair only once if the fields are the generators."""
    for j in range(fields):
        for i in range(j if among else generators):
            yield i, j


def _moving(sheet: Sheet, field: Sequence[int]) -> dict[int, int]:
    return dict(zip(sheet.columns, field, strict=True))
