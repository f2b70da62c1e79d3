"""Outputs y = h(x, u, p, t) with C = ∂y/∂x and D = ∂y/∂u."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp

from lagrangian import dynamics, read
from lagrangian.advice import Advice, Argument
from lagrangian.errors import RunError
from lagrangian.graph import Graph, Output, Program
from lagrangian.linear.jacobians import with_jacobians
from lagrangian.model import Model, as_expr
from lagrangian.page.plain import plain
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class Measured:
    """Named outputs, and the program x, u, p, t → "y", "C" and "D"."""

    names: tuple[str, ...]
    program: Program


def measured(model: Model, outputs: Any, rhs: Program) -> Measured:
    """The requested outputs; by default, the coordinates.

    Text is read in the grammar of model files. Raises `ModelError` for symbols that the model does not have, and
    `RunError` if two outputs have the same name.
    """
    if outputs is None:
        names = rhs.inputs["x"][: len(model.coordinates)]
        graph = Graph()
        ids = tuple(graph.input("x", i) for i in range(len(names)))
        return _differentiated(names, Program("outputs", graph, rhs.inputs, {"y": _vector(ids)}, rhs.defaults))
    wanted = _named(model, outputs)
    seen = dynamics.observe(model, wanted)
    ids = tuple(i for output in seen.outputs.values() for i in output.ids)
    return _differentiated(
        tuple(wanted), Program("outputs", seen.graph, seen.inputs, {"y": _vector(ids)}, rhs.defaults)
    )


def _vector(ids: tuple[int, ...]) -> Output:
    return Output(ids, (len(ids),))


def _differentiated(names: tuple[str, ...], program: Program) -> Measured:
    return Measured(names, with_jacobians(program, {"C": ("y", "x"), "D": ("y", "u")}))


def _named(model: Model, outputs: Any) -> dict[str, sp.Expr]:
    """Name → expression; an item of a list without a name is called by its own text."""
    if isinstance(outputs, Mapping):
        given = [(str(name), _expression(model, value)) for name, value in outputs.items()]
    else:
        listed = outputs if isinstance(outputs, Sequence) and not isinstance(outputs, str) else [outputs]
        given = [(plain(expr), expr) for expr in (_expression(model, value) for value in listed)]
    if not given:
        raise RunError(
            "no output is given",
            fix="write outputs=[expression, …], or leave outputs out: then the coordinates are the outputs",
            code="E401",
        )
    names = [name for name, _ in given]
    if (twice := next((n for n in names if names.count(n) > 1), None)) is not None:
        raise RunError(
            f"two outputs are called '{twice}'", fix=Advice("name them: ", Argument("outputs", "…", "a")), code="E404"
        )
    return dict(given)


def _expression(model: Model, value: Any) -> sp.Expr:
    if isinstance(value, str):
        return read.parse_expression(value, read.Scope(model.symbols), what="output")
    return as_expr(value, "output")
