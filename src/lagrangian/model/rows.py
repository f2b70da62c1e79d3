"""The rows of a model's constraints, in order: f(q, t) = 0 or c(q, q̇, t) = 0, each with its multiplier λ."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.errors import ModelError, did_you_mean
from lagrangian.model.elements import Element, Friction, Words
from lagrangian.model.elements.answers import Unit
from lagrangian.model.elements.base import Condition
from lagrangian.model.elements.conditions import Stated
from lagrangian.model.model import Model
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class NamedCondition:
    """A row without its expressions: its name, its constraint and its condition.

    ``name`` is the constraint's, with a suffix if it has several rows ("loop.x").
    """

    name: str
    element: Element
    condition: Condition


@dataclass(frozen=True, eq=False)
class Row(NamedCondition):
    """One scalar constraint: ``rate`` = c, linear in the rates; ``position`` = f with c = ḟ, or None.

    ``unit`` is that of λ, or None if it follows from the unit of the expression. ``multiplier`` describes λ in words.
    """

    position: sp.Expr | None
    rate: sp.Expr
    unit: Unit | None
    multiplier: Words


def rows_of(model: Model) -> tuple[Row, ...]:
    """The rows of all constraints, in the order in which they were described."""
    return model.remembered("rows", lambda: tuple(_row(model, named) for named in named_conditions(model)))


def _row(model: Model, named: NamedCondition) -> Row:
    c = named.condition
    return Row(named.name, named.element, c, c.position(model), c.rate(model), c.unit, c.multiplier(model))


def named_conditions(model: Model) -> Iterator[NamedCondition]:
    """The rows of all constraints, in order, without their expressions, which are long for large systems."""
    for element in model.constraints:
        for condition in element.conditions(model):
            name = f"{element.name}.{condition.suffix}" if condition.suffix else element.name
            yield NamedCondition(name, element, condition)


def drive_symbol(name: str) -> sp.Symbol:
    """The symbol of a₀ of a row c = A v + a₀ in expressions of a run: the part of c that depends on time alone."""
    return sp.Symbol(f"a₀({name})", real=True)


def pressed_rows(model: Model) -> tuple[str, ...]:
    """The rows that press on friction alone, so that the signs of their multipliers matter, each once, in the order of
    the frictions."""
    return tuple(dict.fromkeys(f.pressing[0] for f in model.frictions if len(f.pressing) == 1))


def pressing_rows(model: Model) -> tuple[str, ...]:
    """All rows whose multipliers press on friction, alone or together with others."""
    return tuple(dict.fromkeys(row for f in model.frictions for row in f.pressing))


def with_pressing_rows(model: Model) -> Model:
    """The model in which every friction that is pressed by a constraint names the row.

    Raises `ModelError` if there is no such row (E402), or several for one name (E412).
    """
    if not pressing_rows(model):
        return model
    rows: dict[str, list[str]] = {}
    units: dict[str, Unit | None] = {}
    for named in named_conditions(model):
        rows.setdefault(named.element.name, []).append(named.name)
        units[named.name] = named.condition.unit
    known = {name: [name] for names in rows.values() for name in names}
    elements = tuple(
        _pressed(e, {**rows, **known}, units) if isinstance(e, Friction) and e.pressed_by else e for e in model.elements
    )
    return replace(model, elements=elements, _memo={})


def _pressed(friction: Friction, rows: dict[str, list[str]], units: dict[str, Unit | None]) -> Friction:
    names = tuple(_row_that_presses(friction, name, rows) for name in friction.pressing)
    if len(set(names)) < len(names):
        raise ModelError(
            f"the row '{next(n for n in names if names.count(n) > 1)}' is listed twice in pressed_by",
            element=friction.title,
            place=friction.place,
            fix="list rows along perpendicular directions",
            code="E412",
        )
    if len({units[name] for name in names}) > 1:
        raise ModelError(
            "some of the rows that press are forces, others torques: " + ", ".join(f"'{name}'" for name in names),
            element=friction.title,
            place=friction.place,
            fix="list rows along perpendicular directions, all of them forces",
            code="E412",
        )
    return friction.pressed(names[0] if len(names) == 1 else names)


def _row_that_presses(friction: Friction, name: str, rows: dict[str, list[str]]) -> str:
    found = rows.get(name)
    if found is None:
        raise ModelError(
            f"no row of a constraint is named '{name}'",
            element=friction.title,
            place=friction.place,
            fix=did_you_mean(name, rows) or "known: " + (", ".join(rows) or "none"),
            code="E402",
        )
    if len(found) > 1:
        listed = ", ".join(f"'{row}'" for row in found[:3])
        raise ModelError(
            f"the constraint '{name}' has {len(found)} rows, and it is not said which of them press",
            element=friction.title,
            place=friction.place,
            fix=f"pressed_by='{found[0]}' for one of them, pressed_by=[{listed}] for the size of their force",
            code="E412",
        )
    return found[0]


def check_rows(model: Model) -> None:
    """Raise `ModelError` for a constraint on velocities that contains no rate or is not linear in the rates."""
    rates: set[sp.Expr] = {*(v.symbol for v in model.velocities), *(c.rate for c in model.coordinates)}
    for element in model.constraints:
        for condition in element.conditions(model):
            if isinstance(condition, Stated) and condition.velocity:
                _check_linear(element, condition.rate(model), rates)


def _check_linear(element: Element, c: sp.Expr, rates: set[sp.Expr]) -> None:
    found = [v for v in rates if c.has(v)]
    if not found:
        raise ModelError(
            "the expression holds no rate",
            element=element.title,
            place=element.place,
            fix="a velocity constraint is linear in the rates, such as x' - r*phi'; write f(q, t) = 0 as a constraint",
            code="E301",
        )
    held = {v: sp.Dummy(str(i)) for i, v in enumerate(found)}
    flat = cast("sp.Expr", c.xreplace(held))
    for a in held.values():
        slope = bounded.diff(flat, a)
        if slope.free_symbols & set(held.values()):
            raise ModelError(
                "the expression is not linear in the rates",
                element=element.title,
                place=element.place,
                fix="a velocity constraint is a sum of terms a(q, t) · rate, and one a(q, t) alone",
                code="E301",
            )
