"""Declared coordinates, parameters, inputs and definitions; every name is declared once."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.errors import ModelError, Notice, Place, did_you_mean
from lagrangian.model.body_checks import ConstantValues
from lagrangian.model.checks import checked_number
from lagrangian.model.floating import Floating
from lagrangian.model.geometry import as_expr
from lagrangian.model.model import Model, written_out
from lagrangian.model.names import check_name, moving_symbol, time
from lagrangian.model.symbols import Coordinate, Definition, Input, Parameter, Velocity
from lagrangian.quantities.quantity import parse_quantity


def _a(noun: str) -> str:
    """``a coordinate``, ``an input``."""
    return f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"


def _is_value(description: str) -> bool:
    """Whether a description is a number with a unit, such as ``10 m``, and says nothing of what is measured."""
    if not description[:1].isdigit() and description[:1] not in ("+", "-", "."):
        return False
    try:
        return not parse_quantity(description).is_bare
    except ModelError:
        return False


class Declarations:
    """The symbols of a description that is being built; an invalid declaration raises `ModelError`.

    Beside them it has what a file says of a run and of the picture, ``settings`` and ``look``, and notices of what the
    file says beside its mechanics, ``remarks``.
    """

    def __init__(self) -> None:
        self._coordinates: dict[str, Coordinate] = {}
        self._velocities: dict[str, Velocity] = {}  # quasi-velocities; rates of coordinates need no declaration
        self._quaternions: list[Floating] = []
        self._parameters: dict[str, Parameter] = {}
        self._values: dict[Any, float] = {}  # of the parameters that have one
        self._inputs: dict[str, Input] = {}
        self._definitions: dict[str, Definition] = {}
        self._symbols: set[Any] = {time}
        self.settings: dict[str, Any] = {}
        self.look: dict[str, Any] = {}
        self.remarks: list[Notice] = []
        self._frozen: Model | None = None

    @property
    def coordinates(self) -> tuple[Coordinate, ...]:
        """The coordinates declared so far, in order."""
        return tuple(self._coordinates.values())

    @property
    def floating(self) -> tuple[Coordinate | Velocity, ...]:
        """The coordinates and velocities of frames with a quaternion, in order."""
        return tuple(x for f in self._quaternions for x in (*f.coordinates, *f.velocities))

    def _claim(self, name: str, what: str, place: Place | None) -> str:
        self._frozen = None
        name = check_name(name, what, place=place)
        tables: tuple[tuple[str, Mapping[str, Any]], ...] = (
            ("coordinate", self._coordinates),
            ("velocity", self._velocities),
            ("parameter", self._parameters),
            ("input", self._inputs),
            ("definition", self._definitions),
        )
        for kind, table in tables:
            if name in table:
                before = table[name].place
                also = f" (line {before.line})" if before is not None and before.line is not None else ""
                raise ModelError(
                    f"'{name}' is defined twice: as {_a(kind)}{also} and as {_a(what)}"
                    if kind != what
                    else f"{kind} '{name}' is defined twice{also}",
                    place=place,
                    fix="give every coordinate, parameter, input and definition a name of its own",
                    code="E404",
                )
        return name

    def coordinate(
        self,
        name: str,
        *,
        description: str = "",
        unit: str | None = None,
        positive: bool = False,
        place: Place | None = None,
    ) -> Coordinate:
        """Add a generalized coordinate; ``positive`` if it is a distance that is always greater than 0."""
        name = self._claim(name, "coordinate", place)
        if positive is not True and positive is not False:
            raise ModelError(
                f"positive must be True or False for coordinate '{name}' (got {positive!r:.40})",
                place=place,
                code="E406",
            )
        if _is_value(description):
            raise ModelError(
                f"coordinate '{name}' has the value '{description}' in place of words: it moves, and has no value",
                place=place,
                fix="say what it measures; its value at the start is given to a run, as initial value",
                code="E406",
            )
        made = Coordinate(name, moving_symbol(name, positive=positive), description, unit, place, positive=positive)
        self._coordinates[name] = made
        self._symbols.add(made.symbol)
        return made

    def parameter(
        self,
        name: str,
        value: float | None = None,
        *,
        unit: str | None = None,
        description: str = "",
        place: Place | None = None,
    ) -> Parameter:
        """Add a constant, with its value in SI units if it has one."""
        name = self._claim(name, "parameter", place)
        made = Parameter(name, sp.Symbol(name), checked_number(name, value, place), unit, description, place)
        self._parameters[name] = made
        if made.value is not None:
            self._values[made.symbol] = made.value
        self._symbols.add(made.symbol)
        return made

    def input(self, name: str, *, description: str = "", unit: str | None = None, place: Place | None = None) -> Input:
        """Add a signal from outside."""
        name = self._claim(name, "input", place)
        made = Input(name, moving_symbol(name), description, unit, place)
        self._inputs[name] = made
        self._symbols.add(made.symbol)
        return made

    def quaternion(self, name: str, *, held: bool = False, place: Place | None = None) -> Floating:
        """Declare the coordinates and quasi-velocities of a frame that floats, or is ``held`` by a ball joint."""
        made = Floating.named(name, place, held=held)
        for x in (*made.coordinates, *made.velocities):
            self._claim(x.name, "coordinate" if x in made.coordinates else "velocity", place)
        self._coordinates.update((c.name, c) for c in made.coordinates)
        self._velocities.update((v.name, v) for v in made.velocities)
        self._symbols.update(x.symbol for x in (*made.coordinates, *made.velocities))
        self._quaternions.append(made)
        return made

    def define(self, name: str, expression: object, *, place: Place | None = None) -> Definition:
        """Give an expression a name, which stays visible. It may use what was declared before it."""
        expr = as_expr(expression, f"the definition of '{name}'", place=place)
        name = self._claim(name, "definition", place)
        self._check_known(expr, f"definition '{name}'", place)
        moving = expr.has(AppliedUndef, time, sp.Derivative)
        symbol = moving_symbol(name) if moving else sp.Symbol(name)
        made = Definition(name, symbol, expr, place)
        self._definitions[name] = made
        self._symbols.add(made.symbol)
        return made

    def _check_known(self, expr: sp.Expr, where: str, place: Place | None, local: Iterable[sp.Symbol] = ()) -> None:
        """Raise an error, with the nearest name, for a symbol that was not declared."""
        known = self._symbols
        atoms = {*expr.free_symbols, *expr.atoms(AppliedUndef)}
        for atom in sorted(atoms - known - {*local}, key=str):
            name = getattr(atom, "name", str(atom.func))
            kind = "moving symbol" if isinstance(atom, AppliedUndef) else "symbol"
            names = [getattr(k, "name", str(getattr(k, "func", k))) for k in known]
            if name in names:
                raise ModelError(
                    f"'{name}' in {where} is not the symbol that was declared under that name",
                    place=place,
                    fix=f'use the symbol that the declaration returned, or system["{name}"]',
                    code="E402",
                )
            hint = did_you_mean(name, names)
            fix = hint or f'declare it: coordinates("{name}"), parameters("{name}") or input("{name}")'
            raise ModelError(f"unknown {kind} '{name}' in {where}", place=place, fix=fix, code="E402")

    @property
    def _numbers(self) -> ConstantValues:
        """The values of constant expressions, as far as they are declared."""
        return ConstantValues(self._values, {d.symbol: d.expression for d in self._definitions.values()})

    def _written_out(self, expr: sp.Expr) -> sp.Expr:
        return written_out(expr, {d.symbol: d.expression for d in self._definitions.values()})

    def standard_gravity(self, value: float) -> sp.Expr:
        """Return the parameter g; declare it with ``value`` [m/s²] if the user has not."""
        if "g" in self._parameters:
            return self._parameters["g"].symbol
        if "g" in self._definitions:
            return self._definitions["g"].symbol
        if "g" in self._coordinates or "g" in self._inputs:
            raise ModelError(
                "the name 'g' is already in use, so gravity needs a symbol for its strength",
                fix="gravity(..., g=another symbol)",
                code="E404",
            )
        return self.parameter("g", value, unit="m/s^2", description="gravitational acceleration").symbol
