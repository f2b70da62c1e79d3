"""A node with operators, for writing formulas."""

from __future__ import annotations

from typing import Any

from lagrangian.graph.graph import Graph
from lagrangian.records import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class Scalar:
    """A node of a graph; an operator applied to it adds nodes to the graph.

    >>> g = Graph()
    >>> x = Scalar(g, g.input("x", 0))
    >>> (2 * x - x - x).id == g.zero
    True
    """

    graph: Graph
    id: int

    def _of(self, other: Scalar | float) -> int:
        if isinstance(other, Scalar):
            if other.graph is not self.graph:
                raise ValueError("the two scalars belong to different graphs")
            return other.id
        return self.graph.const(other)

    def __add__(self, other: Scalar | float) -> Scalar:
        return Scalar(self.graph, self.graph.add(self.id, self._of(other)))

    __radd__ = __add__

    def __sub__(self, other: Scalar | float) -> Scalar:
        return Scalar(self.graph, self.graph.sub(self.id, self._of(other)))

    def __rsub__(self, other: Scalar | float) -> Scalar:
        return Scalar(self.graph, self.graph.sub(self._of(other), self.id))

    def __mul__(self, other: Scalar | float) -> Scalar:
        return Scalar(self.graph, self.graph.mul(self.id, self._of(other)))

    __rmul__ = __mul__

    def __truediv__(self, other: Scalar | float) -> Scalar:
        return Scalar(self.graph, self.graph.div(self.id, self._of(other)))

    def __rtruediv__(self, other: Scalar | float) -> Scalar:
        return Scalar(self.graph, self.graph.div(self._of(other), self.id))

    def __pow__(self, other: Scalar | float) -> Scalar:
        if isinstance(other, int):
            return Scalar(self.graph, self.graph.powi(self.id, other))
        return Scalar(self.graph, self.graph.pow(self.id, self._of(other)))

    def __neg__(self) -> Scalar:
        return Scalar(self.graph, self.graph.neg(self.id))

    def __abs__(self) -> Scalar:
        return Scalar(self.graph, self.graph.abs(self.id))

    def apply(self, function: str, *others: Scalar | float) -> Scalar:
        """Apply a function of the graph by name: ``x.apply("sin")``, ``y.apply("atan2", x)``."""
        method: Any = getattr(self.graph, function)
        return Scalar(self.graph, method(self.id, *(self._of(o) for o in others)))
