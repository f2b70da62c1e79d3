"""Converts the settings of a run in a model file: the initial state ξ(0), ξ̇(0) becomes η(0), η̇(0).

φ(η, 0) = ξ      J η̇ = ξ̇ − ∂φ/∂t
"""

from __future__ import annotations

from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian.coordinates.change import Change
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, Output, Program, evaluate, from_sympy
from lagrangian.model import Coordinate, Model, time
from lagrangian.quantities.quantity import parse_quantity

SMALL = 1e-10
"""The largest residual of φ(η) = ξ, relative to 1 + |ξ|, of an initial state."""


def carried_settings(model: Model, change: Change) -> dict[str, Any]:
    """Return the settings of the model with the initial state in the new coordinates.

    Raises `ModelError` if no initial state corresponds to it, or if a parameter that is needed has no value.
    """
    settings = dict(model.settings)
    gone = [c.name for c, _ in change.replaced if c.name in settings.get("fixed", ())]
    if gone:
        raise ModelError(
            f"'{gone[0]}', which [simulate] holds fixed, is no coordinate any more",
            fix="remove 'fixed' from [simulate] before the change, and name coordinates that stay fixed afterwards",
            code="E210",
        )
    given = settings.get("initial")
    if not given or not change.replaced:
        return settings
    old = {name: _number(name, value) for name, value in given.items()}
    found = _solved(model, change, old)
    settings["initial"] = {name: value for name, value in found.items() if value != 0.0}
    return settings


def solved_pose(model: Model, change: Change, pose: dict[str, Any]) -> dict[str, float]:
    """Return the new coordinates of a pose that gives all the old ones. Raises `ModelError` if there are none."""
    found = _solved(model, change, {name: _number(name, value) for name, value in pose.items()})
    return {c.name: found[c.name] for c in change.new}


def _number(name: str, value: Any) -> float:
    return parse_quantity(value, what=f"the initial {name}").value if isinstance(value, str) else float(value)


def _solved(model: Model, change: Change, given: dict[str, float]) -> dict[str, float]:
    position = np.array([given.get(c.name, c.start) for c in change.old])
    rate = np.array([given.get(f"{c.name}'", 0.0) for c in change.old])
    program = _program(model, change)
    parameters = [model.values[p.symbol] for p in model.parameters if p.symbol in model.values]

    def at(eta: Any) -> dict[str, Any]:
        got = evaluate(program, {"q": list(map(float, eta)), "p": parameters})
        return {key: np.array(value, float) for key, value in got.items()}

    import scipy.optimize  # imported here because it is slow to load and rarely needed

    find = cast("Any", scipy.optimize).root  # SciPy has no types, and inferring this one takes half a minute
    n = len(change.new)
    for start in (position, position + 0.5, np.ones(n), np.linspace(0.3, 1.7, n)):
        try:
            root = find(
                lambda eta: at(eta)["phi"] - position, start, jac=lambda eta: at(eta)["J"].reshape(n, n), tol=1e-14
            )
            values = at(root.x)
        except (ZeroDivisionError, ValueError, OverflowError):
            continue
        if np.abs(values["phi"] - position).max() > SMALL * (1 + np.abs(position).max()):
            continue
        J = values["J"].reshape(n, n)
        if np.linalg.matrix_rank(J, tol=1e-9) == n:
            rates = np.linalg.solve(J, rate - values["drift"])
            names = [*(c.name for c in change.new), *(f"{c.name}'" for c in change.new)]
            return {k: _short(float(v)) for k, v in zip(names, [*root.x, *rates], strict=True)}
    raise ModelError(
        "the initial state under [simulate] corresponds to no state in the new coordinates, or to several",
        fix="remove 'initial' from [simulate] before the change, and give the initial state afterwards",
        code="E210",
    )


def _short(value: float) -> float:
    """Round off the last digits, which contain the rounding errors of a solver."""
    near = float(f"{value:.12g}")
    return 0.0 if abs(near) < 1e-13 else near


def _program(model: Model, change: Change) -> Program:
    """φ, J and ∂φ/∂t at t = 0 as a program of the new coordinates."""
    phi = [model.expand(change.table[c.symbol], constants=True) for c in change.old]
    exprs = {"phi": phi, "J": [sp.diff(e, c.symbol) for e in phi for c in change.new]}
    exprs["drift"] = [sp.diff(e, time).xreplace(_still(change.new)) for e in phi]
    graph = Graph()
    known = [p for p in model.parameters if p.symbol in model.values]
    table: dict[sp.Basic, int] = {c.symbol: graph.input("q", i) for i, c in enumerate(change.new)}
    table |= {p.symbol: graph.input("p", i) for i, p in enumerate(known)}
    table[time] = graph.const(0.0)
    for e in phi:
        for s in sorted(e.free_symbols - table.keys(), key=str):
            raise ModelError(
                f"parameter '{s}' has no value, so the initial state under [simulate] cannot be converted",
                fix=f"give {s} a value, or remove 'initial' from [simulate]",
                code="E401",
            )
    outputs = {
        key: Output(tuple(from_sympy(graph, e, table) for e in listed), (len(listed),)) for key, listed in exprs.items()
    }
    names = {"q": tuple(c.name for c in change.new), "p": tuple(p.name for p in known)}
    return Program("change", graph, names, outputs, {})


def _still(coordinates: tuple[Coordinate, ...]) -> dict[sp.Basic, sp.Expr]:
    """Return zero for every rate."""
    return {c.rate: sp.S.Zero for c in coordinates}
