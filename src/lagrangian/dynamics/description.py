"""A model during its conversion to nodes: the inputs of a program, and the nodes of symbols, points and frames."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from lagrangian.dynamics.axes import Axes, PlaceMotion
from lagrangian.dynamics.motion import Motion
from lagrangian.dynamics.vectors import Vector
from lagrangian.graph import Graph, from_sympy
from lagrangian.model import Frame, Model, Point
from lagrangian.records import dataclass, field


@dataclass
class Inputs:
    """The input nodes of a program for a model: one for each coordinate, velocity, parameter, input, and for time."""

    q: list[int]
    v: list[int]
    u: list[int]
    p: list[int]
    t: int

    @classmethod
    def of(cls, graph: Graph, model: Model, *, state: bool = False) -> Inputs:
        """The groups q, v, u, p, t; with ``state``, x = [q; v] instead of q and v."""
        n = len(model.coordinates)
        q = [graph.input("x" if state else "q", i) for i in range(n)]
        v = [graph.input("x", n + i) if state else graph.input("v", i) for i in range(len(model.velocities))]
        u = [graph.input("u", i) for i in range(len(model.inputs))]
        p = [graph.input("p", i) for i in range(len(model.parameters))]
        return cls(q, v, u, p, graph.input("t", 0))


@dataclass
class Description:
    """A model during its conversion to nodes."""

    model: Model
    graph: Graph
    inputs: Inputs
    motion: Motion
    table: dict[Any, int]
    memo: dict[Any, int] = field(default_factory=dict)
    axes: dict[Frame, Axes] = field(default_factory=dict)
    places: dict[Point, PlaceMotion] = field(default_factory=dict)
    angles: dict[Frame, int] = field(default_factory=dict)

    def node(self, expr: Any, local: Mapping[Any, int] | None = None) -> int:
        """The node of an expression; ``local`` gives the meaning of symbols in this expression only."""
        if local:
            return from_sympy(self.graph, expr, {**self.table, **local})
        return from_sympy(self.graph, expr, self.table, self.memo)

    def nodes(self, exprs: Sequence[Any]) -> Vector:
        """The nodes of several expressions."""
        return [self.node(e) for e in exprs]
