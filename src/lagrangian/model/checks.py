"""What may stand where: rates inside energies, masses that are not positive, inertias no body can have."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.errors import ModelError
from lagrangian.model.elements.base import Element, Level, Use
from lagrangian.model.elements.rigid_body import RigidBody
from lagrangian.model.model import Model
from lagrangian.model.names import time

RELATIVE_TOLERANCE = 1e-9
"""How far a principal moment may exceed the sum of the other two: rounding of a thin rod's."""


def check_use(
    element: Element, use: Use, full: sp.Expr, inputs: Mapping[Any, str], velocities: Mapping[Any, str]
) -> None:
    """Refuse an expression (``full``: definitions written out) that reaches further down than its place allows.

    ``inputs`` and ``velocities`` (quasi-velocities) are symbols with their names.
    """

    def error(what: str, fix: str, code: str) -> ModelError:
        return ModelError(what, element=element.title, place=element.place, fix=fix, code=code)

    for d in sorted(full.atoms(sp.Derivative), key=str):
        base, order = d.expr, d.derivative_count + (d.expr in velocities)
        name = str(base.func)
        if base in inputs:
            raise error(
                f"the {use.what} holds the derivative of input '{name}'",
                f"declare a second input for it, such as {name}_rate",
                "E417",
            )
        if order >= 2:
            raise error(
                f"the {use.what} holds an acceleration, {name}{chr(39) * int(d.derivative_count)}",
                "energies and forces depend on coordinates, rates and t; accelerations come out of the equations",
                "E418",
            )
        if use.level < Level.VELOCITY:
            holds = "coordinates" if use.level == Level.POSITION else "parameters"
            raise error(f"the {use.what} holds a rate, {name}'", f"it may depend on {holds} only, not on rates", "E419")
    for atom in sorted(full.atoms(AppliedUndef), key=str):
        if atom in velocities and use.level < Level.VELOCITY:
            holds = "coordinates" if use.level == Level.POSITION else "parameters"
            raise error(f"the {use.what} holds a velocity, {atom.func}", f"it may depend on {holds} only", "E419")
        if atom in inputs and not use.inputs:
            raise error(
                f"the {use.what} holds the input '{inputs[atom]}'",
                "use parameters for constants; an input is a force, a torque or a prescribed rest length",
                "E417",
            )
        if atom not in inputs and use.level == Level.CONSTANT:
            raise error(
                f"the {use.what} depends on the coordinate '{atom.func}'", "it must be made of parameters", "E419"
            )
    if use.key == "deflection" and not full.has(AppliedUndef):
        raise error(
            f"it acts on nothing: no coordinate moves its deflection {full}",
            "write the deflection with coordinates, such as x2 - x1",
            "E412",
        )
    if use.level == Level.CONSTANT and full.has(time):
        raise error(f"the {use.what} depends on time", "it must be made of parameters", "E419")


def number(model: Model, expr: sp.Expr) -> float | None:
    """The value of a constant expression with the parameters' values, or None while one of them has none."""
    full = model.expand(expr, constants=True)
    if full.free_symbols - model.values.keys():
        return None
    value = cast(
        "sp.Expr", full.xreplace({s: sp.Float(model.values[s]) for s in model.values.keys() & full.free_symbols})
    )
    return float(value) if value.is_real else float("nan")


def check_body(model: Model, body: Any) -> None:
    """Refuse a mass or an inertia that no body has, as far as values are known."""
    mass = number(model, body.mass)
    shown = f"mass {body.mass} = {mass:g} kg" if mass is not None and body.mass.free_symbols else f"mass = {mass} kg"

    def error(what: str, fix: str, code: str) -> ModelError:
        return ModelError(what, element=body.title, place=body.place, fix=fix, code=code)

    if mass is not None:
        if not mass == mass or abs(mass) == float("inf"):
            raise error(f"its mass must be a finite positive number (got {mass})", "give it a mass above 0", "E101")
        if mass < 0:
            raise error(f"its {shown} is negative", "give it a mass above 0", "E102")
        if mass == 0 and (not isinstance(body, RigidBody) or _moves(model, body)):
            raise error(f"its {shown} is zero", "give it a mass above 0, or leave it out", "E103")
    if isinstance(body, RigidBody):
        _check_inertia(model, body, error)


def _moves(model: Model, body: RigidBody) -> bool:
    """Whether the centre of mass can move."""
    return any(model.expand(x).has(AppliedUndef, time) for x in model.position(body.at))


def _check_inertia(model: Model, body: RigidBody, error: Any) -> None:
    entries = [number(model, x) for x in body.inertia]
    if any(x is None for x in entries):
        diagonal = [number(model, body.inertia[i, i]) for i in range(body.inertia.rows)]
        if any(x is not None and x < 0 for x in diagonal):
            raise error("a moment of inertia is negative", "moments of inertia are not negative", "E106")
        return
    if any(x != x or abs(x) == float("inf") for x in entries if x is not None):
        raise error("its inertia must be made of finite numbers", "give finite moments of inertia", "E101")
    if body.inertia.rows == 1:
        if entries[0] is not None and entries[0] < 0:
            raise error(f"its inertia {entries[0]:g} kg m² is negative", "J is not negative", "E106")
        return
    moments = np.linalg.eigvalsh(np.array(entries, float).reshape(3, 3)).tolist()
    listed = ", ".join(f"{x:.6g}" for x in moments)
    slack = RELATIVE_TOLERANCE * max(abs(moments[2]), 1e-300)
    if moments[0] < -slack:
        raise error(
            f"its inertia is not positive semidefinite (principal moments {listed})",
            "check the signs of the products: they are the tensor's elements (−∫xy dm)",
            "E106",
        )
    if moments[2] > moments[0] + moments[1] + slack:
        raise error(
            f"its inertia fits no body: principal moments {listed} violate "
            f"{moments[0]:.6g} + {moments[1]:.6g} ≥ {moments[2]:.6g}",
            "the two smaller principal moments add up to at least the largest",
            "E105",
        )
