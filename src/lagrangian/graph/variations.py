"""Derivatives of nodes as numbers, along several directions at several places at once.

They are those of `jvp`, without a node for each of them: one array of slopes for every node that varies.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lagrangian.graph.autodiff import slopes
from lagrangian.graph.evaluate import Valuation
from lagrangian.graph.graph import CONDITIONS, Graph, Node, operands

Array = NDArray[np.float64]


class Variations:
    """The derivatives of nodes by the nodes ``directions``, at the places of ``valuations``; earlier ones are kept."""

    def __init__(self, graph: Graph, valuations: Sequence[Valuation], directions: Sequence[int]) -> None:
        self._graph, self._valuations = graph, valuations
        self._size = len(valuations), len(directions)
        self._seen: set[int] = set(directions)
        self._moving: dict[int, Array] = {}
        self._values: dict[int, Array] = {}
        for k, node in enumerate(directions):
            self._moving[node] = np.zeros(self._size)
            self._moving[node][:, k] = 1.0

    def __call__(self, ids: Sequence[int]) -> Array:
        """The derivatives, (places, directions, len(ids))."""
        graph, seen, moving = self._graph, self._seen, self._moving
        for valuation in self._valuations:
            valuation(ids)
        fresh: list[int] = []
        stack = list(ids)
        while stack:
            i = stack.pop()
            if i not in seen:
                seen.add(i)
                fresh.append(i)
                stack.extend(operands(graph.nodes[i]))
        with np.errstate(all="ignore"):
            for i in sorted(fresh):
                read = operands(graph.nodes[i])
                if graph.nodes[i][0] not in CONDITIONS and any(k in moving for k in read):
                    moving[i] = self._slope(i, graph.nodes[i], read)
        found = np.zeros((*self._size, len(ids)))
        for n, i in enumerate(ids):
            if i in moving:
                found[:, :, n] = moving[i]
        return found

    def _slope(self, i: int, node: Node, read: tuple[int, ...]) -> Array:
        """The derivatives of a node some of whose operands vary."""
        op, value, moving = node[0], self._value, self._moving
        if op in ("select", "min", "max"):
            a, b = (moving.get(k, 0.0) for k in read[-2:])
            return np.where(value(read[0]) != 0 if op == "select" else value(i) == value(read[0]), a, b)
        if op == "neg":
            return -moving[read[0]]
        a, b = moving.get(read[0]), moving.get(read[-1])
        if op == "add":
            return b if a is None else a if b is None else a + b  # type: ignore[return-value]
        if op == "sub":
            return -b if a is None else a if b is None else a - b  # type: ignore[operator]
        if op == "mul":
            parts = [value(other) * x for x, other in ((a, read[1]), (b, read[0])) if x is not None]
            return parts[0] if len(parts) == 1 else parts[0] + parts[1]
        if op == "div":
            top = 0.0 if a is None else a
            return (top if b is None else top - value(i) * b) / value(read[1])
        total = np.zeros(self._size)
        for k, partial in zip(read, slopes(self._graph, i), strict=True):
            if k in moving:
                total += np.where(moving[k] == 0, 0.0, value(partial) * moving[k])
        return total

    def _value(self, i: int) -> Array:
        """The values of a node, (places, 1)."""
        found = self._values.get(i)
        if found is None:
            found = self._values[i] = np.array([valuation.value(i) for valuation in self._valuations], float)[:, None]
        return found
