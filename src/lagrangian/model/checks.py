"""What may stand where: rates inside energies, masses that are not positive, inertias no body can have."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.errors import ModelError, Place, did_you_mean
from lagrangian.model.elements.base import Element, Level, Use
from lagrangian.model.elements.raw import GeneralizedForce
from lagrangian.model.elements.rigid_body import RigidBody
from lagrangian.model.floating import Floating
from lagrangian.model.model import Model
from lagrangian.model.names import time
from lagrangian.model.plain import plain
from lagrangian.model.symbols import Coordinate, Velocity

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
    import numpy as np  # a tenth of a second that only bodies in space pay

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


def checked_number(name: str, value: object, place: Place | None) -> float | None:
    """The value of a parameter as a number, or None where it has none; anything else is refused."""
    if value is None:
        return None
    if isinstance(value, complex) or (isinstance(value, sp.Expr) and not value.is_real):
        raise ModelError(f"parameter '{name}' must be a real number (got {value})", place=place, code="E101")
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        raise ModelError(f"parameter '{name}' must be a number (got {value!r})", place=place, code="E406") from None
    if isinstance(value, bool):
        raise ModelError(f"parameter '{name}' must be a number (got {value})", place=place, code="E406")
    if not math.isfinite(number):
        raise ModelError(f"parameter '{name}' must be a finite number (got {number})", place=place, code="E101")
    return number


def check_position(
    full: sp.Expr, where: str, inputs: Mapping[Any, str], velocities: Mapping[Any, str], place: Place | None
) -> None:
    """Refuse a position (``full``: definitions written out) that holds more than coordinates, parameters and time."""
    rates = [f"{d.expr.func}'" for d in full.atoms(sp.Derivative)]
    for rate in sorted([*rates, *(name for v, name in velocities.items() if full.has(v))]):
        raise ModelError(
            f"{where} holds a rate, {rate}",
            place=place,
            fix="a position depends on coordinates, parameters and t only",
            code="E308",
        )
    for kink in sorted(full.atoms(sp.Abs, sp.sign, sp.Min, sp.Max, sp.Heaviside), key=str):
        if kink.has(AppliedUndef, time):
            raise ModelError(
                f"{where} holds {plain(kink)}: where it bends, the velocity would jump",
                place=place,
                fix="a position has two derivatives; let a force or an energy hold what bends",
                code="E308",
            )
    for atom in sorted(full.atoms(AppliedUndef) & inputs.keys(), key=str):
        raise ModelError(
            f"{where} holds the input '{inputs[atom]}', whose velocity is not known",
            place=place,
            fix="prescribe the motion as an expression in t, or make it a coordinate",
            code="E417",
        )


def check_acted_on(
    element: GeneralizedForce, known: Sequence[Coordinate | Velocity], floats: Sequence[Floating]
) -> None:
    """Refuse a generalized force on what is neither coordinate nor velocity, or on an entry of a quaternion."""
    name = plain(element.coordinate)
    for floating in floats:
        if element.coordinate in floating.quaternion:
            raise ModelError(
                f"'{name}' is an entry of a quaternion: no force acts along it alone",
                element=element.title,
                place=element.place,
                fix=f"act on {' or '.join(v.name for v in floating.velocities[3:])}, by a moment about its own axis",
                code="E402",
            )
    if element.coordinate not in [x.symbol for x in known]:
        raise ModelError(
            f"'{name}' is not a coordinate",
            element=element.title,
            place=element.place,
            fix=did_you_mean(name, [x.name for x in known]),
            code="E402",
        )


def check_kind(given: object, kind: type, what: str, place: Place | None) -> None:
    """Refuse what is not a point or a frame where one must stand."""
    if given is not None and not isinstance(given, kind):
        raise ModelError(
            f"{what} must be a {kind.__name__.lower()} of this system (got {type(given).__name__})",
            place=place,
            fix=f'make one with system.{kind.__name__.lower()}(…), or look it up with system["name"]',
            code="E412",
        )
