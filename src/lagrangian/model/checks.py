"""Checks what expressions depend on: rates in energies, kinks in positions, forces on something that is no
coordinate."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.codes import CodeText
from lagrangian.errors import ModelError, Place, did_you_mean
from lagrangian.model.elements.base import Element, Level, Use
from lagrangian.model.floating import Floating
from lagrangian.model.names import time
from lagrangian.model.symbols import Coordinate, Velocity
from lagrangian.page.plain import plain
from lagrangian.quantities.largest import SMALLER, too_large


def check_use(
    element: Element, use: Use, full: sp.Expr, inputs: Mapping[Any, str], velocities: Mapping[Any, str]
) -> None:
    """Raise an error if an expression (``full``: with definitions written out) depends on something not allowed there.

    ``inputs`` and ``velocities`` (quasi-velocities) are symbols with their names.
    """

    def error(what: str, fix: str, code: CodeText) -> ModelError:
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
                f"the {use.what} contains an acceleration, {name}{chr(39) * int(d.derivative_count)}",
                "energies and forces depend on coordinates, rates and t; accelerations come out of the equations",
                "E418",
            )
        if use.level < Level.VELOCITY:
            holds = "coordinates" if use.level == Level.POSITION else "parameters"
            instead = ": a constraint on rates is a velocity constraint" if element.kind == "constraint" else ""
            fix = f"it may depend on {holds} only, not on rates{instead}"
            raise error(f"the {use.what} contains a rate, {name}'", fix, "E419")
    for atom in sorted(full.atoms(AppliedUndef), key=str):
        if atom in velocities and use.level < Level.VELOCITY:
            holds = "coordinates" if use.level == Level.POSITION else "parameters"
            raise error(f"the {use.what} holds a velocity, {atom.func}", f"it may depend on {holds} only", "E419")
        if atom in inputs and not use.inputs:
            raise error(
                f"the {use.what} contains the input '{inputs[atom]}'",
                "a constraint may depend on t, but not on inputs: write the prescribed motion as an expression in t"
                if element.ledger == "λ"
                else "use parameters for constants; an input is a force, a torque or a prescribed rest length",
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


def checked_number(name: str, value: object, place: Place | None) -> float | None:
    """The value of a parameter as a number, or None if it has none; anything else raises an error."""
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
    if trouble := too_large(number):
        raise ModelError(f"parameter '{name}' {trouble}", place=place, fix=SMALLER, code="E101")
    return number


def check_position(
    full: sp.Expr, where: str, inputs: Mapping[Any, str], velocities: Mapping[Any, str], place: Place | None
) -> None:
    """Raise an error if a position contains anything but coordinates, parameters and time.

    ``full`` is the position with definitions written out.
    """
    rates = [f"{d.expr.func}'" for d in full.atoms(sp.Derivative)]
    for rate in sorted([*rates, *(name for v, name in velocities.items() if full.has(v))]):
        raise ModelError(
            f"{where} contains a rate, {rate}",
            place=place,
            fix="a position depends on coordinates, parameters and t only",
            code="E308",
        )
    for kink in sorted(full.atoms(sp.Abs, sp.sign, sp.Min, sp.Max, sp.Heaviside), key=str):
        if kink.has(AppliedUndef, time):
            raise ModelError(
                f"{where} contains {plain(kink)}: the velocity would jump at its kink",
                place=place,
                fix="a position needs two derivatives; use functions with kinks only in forces and energies",
                code="E308",
            )
    for atom in sorted(full.atoms(AppliedUndef) & inputs.keys(), key=str):
        raise ModelError(
            f"{where} contains the input '{inputs[atom]}', whose velocity is not known",
            place=place,
            fix="prescribe the motion as an expression in t, or make it a coordinate",
            code="E417",
        )


def check_acted_on(
    element: Element, coordinate: sp.Expr, known: Sequence[Coordinate | Velocity], floats: Sequence[Floating]
) -> None:
    """Raise an error if an element acts on an entry of a quaternion, or on neither a coordinate nor a velocity."""
    name = plain(coordinate)
    for floating in floats:
        if coordinate in floating.quaternion:
            raise ModelError(
                f"'{name}' is an entry of a quaternion: no force acts along it alone",
                element=element.title,
                place=element.place,
                fix=f"act on {' or '.join(v.name for v in floating.turning)}, moments about its own axes",
                code="E402",
            )
    if coordinate not in [x.symbol for x in known]:
        raise ModelError(
            f"'{name}' is not a coordinate",
            element=element.title,
            place=element.place,
            fix=did_you_mean(name, [x.name for x in known]),
            code="E402",
        )


def check_kind(given: object, kind: type, what: str, place: Place | None) -> None:
    """Raise an error for anything but a point or a frame where one is expected."""
    if given is not None and not isinstance(given, kind):
        raise ModelError(
            f"{what} must be a {kind.__name__.lower()} of this system (got {type(given).__name__})",
            place=place,
            fix=f'make one with system.{kind.__name__.lower()}(…), or look it up with system["name"]',
            code="E412",
        )
