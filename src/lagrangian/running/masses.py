"""Masses and moments of inertia with the values that a run has: what no body has is refused, as it is in a file."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.graph import Program
from lagrangian.model import Model, RigidBody
from lagrangian.model.checks import check_body


def check_masses(model: Model, p: NDArray[np.float64], varied: Iterable[str] = ()) -> None:
    """Refuse bodies whose mass or inertia is none with the parameters ``p``; ``varied`` parameters count as unknown.

    Raises `ModelError`, which names the body.
    """
    unknown = set(varied)
    values = [None if q.name in unknown else float(x) for q, x in zip(model.parameters, p, strict=True)]
    if all(value is None or value == q.value for q, value in zip(model.parameters, values, strict=True)):
        return
    parameters = tuple(replace(q, value=x) for q, x in zip(model.parameters, values, strict=True))
    held = replace(model, parameters=parameters, _memo={})
    for body in held.bodies:
        check_body(held, body)


def varied_masses(model: Model, varied: Iterable[str]) -> Program | None:
    """The masses (``mass 0`` …) and moments of inertia (``inertia 0`` …) that varied parameters decide, if any.

    A program over x, u, p, t that reads p alone. In a run, masses are above 0 and moments of inertia not below.
    """
    names = set(varied)
    symbols = {q.symbol for q in model.parameters if q.name in names}
    found: dict[str, sp.Expr] = {}
    for body in model.bodies:
        listed = [("mass", body.mass)]
        if isinstance(body, RigidBody):
            listed += [("inertia", body.inertia[k, k]) for k in range(body.inertia.rows)]
        for word, expr in listed:
            if model.expand(expr, constants=True).free_symbols & symbols:
                found[f"{word} {len(found)}"] = expr
    return dynamics.observe_closed(model, found, {}) if found else None
