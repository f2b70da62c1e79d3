"""The rows of a model in normal form, each with the symbol of its multiplier."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

import re
from collections.abc import Collection, Container, Mapping
from dataclasses import replace

import sympy as sp

from lagrangian.derive.algebra import Form
from lagrangian.derive.context import Context
from lagrangian.derive.multiplier import Multiplier
from lagrangian.model import Friction, Model
from lagrangian.model.elements import answers
from lagrangian.model.names import moving_symbol
from lagrangian.model.rows import Row, named_conditions, rows_of
from lagrangian.page.formula import Text, text
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class RowForms:
    """A row in normal form: c, its slopes ∂c/∂ξ̇_i, what is left at ξ̇ = 0, ċ, and what λ adds to each equation."""

    row: Row
    symbol: sp.Expr
    rate: Form
    slopes: tuple[Form, ...]
    drive: Form
    second_rate: Form
    pushes: tuple[Form, ...]


UNITS = {answers.FORCE: "N", answers.ENERGY: "N m"}
"""How the unit of a multiplier is written."""

NO_UNITS: Mapping[str, str] = {}
"""The units of rows that are expressions, where no unit was given."""


def row_forms(context: Context, names: Collection[str]) -> tuple[RowForms, ...]:
    """The rows of a model with these names in normal form, in order."""
    model, algebra = context.model, context.algebra
    found: list[RowForms] = []
    symbols = multiplier_symbols(model)
    for row in (row for row in rows_of(model) if row.name in names):
        multiplier = symbols[row.name]
        rate = algebra.form(row.rate)
        slopes = tuple(rate.diff(c.rate) for c in model.coordinates)
        moved = [slope * algebra.form(c.rate) for slope, c in zip(slopes, model.coordinates, strict=True)]
        pushes = tuple(slope * algebra.form(multiplier) for slope in slopes)
        drive = rate - algebra.total(moved)
        found.append(RowForms(row, multiplier, rate, slopes, drive, rate.total_derivative(), pushes))
    return tuple(found)


def multiplier_symbols(model: Model) -> dict[str, sp.Expr]:
    """The symbol of every row's multiplier, by the names of the rows."""
    taken, found = {*model.symbols}, dict[str, sp.Expr]()
    for row in named_conditions(model):
        name = symbol_name(row.name, taken)
        taken.add(name)
        found[row.name] = moving_symbol(name)
    return found


def with_multipliers(model: Model) -> Model:
    """The model in which friction that a multiplier presses on holds that multiplier by its symbol on the page."""
    if not any(isinstance(e, Friction) and e.pressing for e in model.elements):
        return model
    symbols = multiplier_symbols(model)
    elements = tuple(
        e.with_multipliers([symbols[row] for row in e.pressing]) if isinstance(e, Friction) and e.pressing else e
        for e in model.elements
    )
    return replace(model, elements=elements, _memo={})


def symbol_name(row: str, taken: Container[str]) -> str:
    """The name of a row's multiplier, an identifier that nothing else in the system has."""
    name = "lambda_" + (re.sub(r"\W+", "_", row).strip("_") or "1")
    while name in taken:
        name += "_"
    return name


def multipliers(context: Context, forms: tuple[RowForms, ...], units: Mapping[str, str]) -> dict[str, Multiplier]:
    """The multipliers by the names of their rows; ``units`` are those of rows given as expressions."""
    return {f.row.name: _multiplier(context, f, units) for f in forms}


def _multiplier(context: Context, forms: RowForms, units: Mapping[str, str]) -> Multiplier:
    row = forms.row
    position = None if row.position is None else context.readable(row.position)
    words = text(*(context.readable(part) if isinstance(part, sp.Basic) else part for part in row.multiplier))
    lines = (position, forms.rate.expr(), forms.second_rate.expr())
    return multiplier_of(row, forms.symbol, words, lines, units)


def multiplier_of(
    row: Row,
    symbol: sp.Expr,
    words: Text,
    lines: tuple[sp.Expr | None, sp.Expr, sp.Expr],
    units: Mapping[str, str],
) -> Multiplier:
    """The multiplier of a row; ``lines`` are f, c and ċ as they are written, ``units`` those of rows by name."""
    unit = units.get(row.name, "") if row.unit is None else UNITS[row.unit]
    return Multiplier(row.name, symbol, unit, words, row.element, *lines)
