"""Adds exact derivatives to programs, computed on the graph, as additional outputs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.errors import RunError
from lagrangian.graph import Output, Program, evaluate, jacobian, reached
from lagrangian.model import Model

Arrays = dict[str, NDArray[np.float64]]


def with_jacobians(program: Program, wanted: Mapping[str, tuple[str, str]]) -> Program:
    """Return ``program`` with additional outputs: name → (output y, group x) adds ∂y/∂x, shape (len y, len x)."""
    outputs = dict(program.outputs)
    for name, (of, by) in wanted.items():
        outputs[name] = _matrix(program, program.outputs[of].ids, by)
    return Program(program.name, program.graph, program.inputs, outputs, program.defaults)


def _matrix(program: Program, ids: tuple[int, ...], by: str) -> Output:
    graph, width = program.graph, len(program.inputs[by])
    entries = jacobian(graph, ids, [graph.input(by, k) for k in range(width)])
    flat = tuple(entries.get((i, k), graph.zero) for i in range(len(ids)) for k in range(width))
    return Output(flat, (len(ids), width))


def rates(model: Model) -> Program:
    """x, u, p, t → ẋ as "xdot", with A = ∂ẋ/∂x and B = ∂ẋ/∂u."""
    return with_jacobians(dynamics.rhs(model), {"A": ("xdot", "x"), "B": ("xdot", "u")})


def forces(model: Model) -> Program:
    """q, v, u, p, t → "h" = C q̇ + G − Ξ with "K" = ∂h/∂q, "D" = ∂h/∂q̇ and "S" = ∂h/∂u."""
    return with_jacobians(dynamics.bias(model), {"K": ("h", "q"), "D": ("h", "v"), "S": ("h", "u")})


def values(program: Program, **groups: Any) -> Arrays:
    """The outputs as arrays, evaluated by the interpreter at one point in double precision."""
    found = evaluate(program, {name: np.atleast_1d(given).tolist() for name, given in groups.items()})
    return {name: np.asarray(value, float).reshape(program.outputs[name].shape) for name, value in found.items()}


def reads(program: Program, output: str, group: str) -> frozenset[int]:
    """The entries of ``group`` on which ``output`` depends, according to the graph."""
    nodes = program.graph.nodes
    met = (nodes[i] for i in reached(program.graph, program.outputs[output].ids))
    return frozenset(node[2] for node in met if node[0] == "input" and node[1] == group)


KINKED = frozenset({"abs", "sign", "min", "max", "select"})
"""Operations that have no derivative somewhere."""


def may_kink(program: Program, output: str) -> bool:
    """Whether an output contains an operation that may have no derivative somewhere."""
    nodes = program.graph.nodes
    return any(nodes[i][0] in KINKED for i in reached(program.graph, program.outputs[output].ids))


class QuickValues:
    """`values` in machine code, for many points of the same programs."""

    def __init__(self) -> None:
        self._kernels: dict[int, tuple[Program, machine.Kernel]] = {}

    def __call__(self, program: Program, **groups: Any) -> Arrays:
        """The outputs as arrays; values that are not finite are returned unchanged."""
        if id(program) not in self._kernels:
            self._kernels[id(program)] = (program, machine.compile(program))
        try:
            found = self._kernels[id(program)][1](**groups)
        except RunError:  # kernels refuse values that are not finite; the interpreter returns them
            return values(program, **groups)
        return found if isinstance(found, dict) else {next(iter(program.outputs)): found}
