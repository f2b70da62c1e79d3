"""A program for masses and inertias that depend only on the parameters."""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.graph import Graph, Output, Program, from_sympy
from lagrangian.model import Model, time


def body_numbers(model: Model, names: Iterable[str], *, inertias: bool = True) -> Program | None:
    """p → the masses [kg] and inertias [kg m²] that depend on the parameters ``names``; None if there are none.

    The outputs are ``mass k`` of bodies that move and ``resting mass k`` of those that only turn, shape (), and
    ``inertia k``, shape (d, d), where k is the index of the body; ``inertias``: whether these are wanted.
    """
    wanted = set(names)
    symbols = {p.symbol for p in model.parameters if p.name in wanted}
    graph = Graph()
    table = {p.symbol: graph.input("p", i) for i, p in enumerate(model.parameters)}
    outputs: dict[str, Output] = {}

    def add(name: str, exprs: list[sp.Expr], shape: tuple[int, ...]) -> None:
        full = [model.expand(x, constants=True) for x in exprs]
        if any(x.free_symbols & symbols for x in full):
            outputs[name] = Output(tuple(from_sympy(graph, x, table) for x in full), shape)

    for k, body in enumerate(model.bodies):
        rests = body.axes is not None and not any(
            model.expand(x).has(AppliedUndef, time) for x in model.position(body.at)
        )
        add(f"resting mass {k}" if rests else f"mass {k}", [body.mass], ())
        if inertias and body.axes is not None:
            add(f"inertia {k}", [x for row in body.tensor for x in row], (len(body.tensor),) * 2)
    if not outputs:
        return None
    parameters = tuple(p.name for p in model.parameters)
    return Program("bodies", graph, {"p": parameters}, outputs, {p.name: p.value for p in model.parameters})
