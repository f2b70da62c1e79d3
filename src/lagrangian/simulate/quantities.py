"""What is asked of runs as text: expressions, and the multipliers of constraints by the names of their rows."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from lagrangian import read
from lagrangian.errors import ModelError, did_you_mean
from lagrangian.model import Model
from lagrangian.model.names import multiplier_symbol
from lagrangian.model.rows import Row, named_conditions, rows_of
from lagrangian.page.plain import plain

ENERGIES = {
    "energy": "energy",
    "total": "energy",
    "e": "energy",
    "t": "kinetic",
    "kinetic": "kinetic",
    "v": "potential",
    "potential": "potential",
    "supplied": "supplied",
    "imbalance": "imbalance",
}
"""What energies are called → the attributes of a run."""


def quantity(model: Model, text: str, what: str) -> sp.Expr:
    """The expression that a text stands for; the name of a constraint's row, or of its one row, stands for its
    multiplier λ.

    A symbol of the model comes before a row of the same name. Raises `ModelError` for what is neither.
    """
    name = text.strip()
    names = [row.name for row in named_conditions(model)]
    if name in names and name not in model.symbols:
        return multiplier_symbol(name)
    whole = [row for row in names if row.partition(".")[0] == name and "." in row]
    if len(whole) == 1 and name not in model.symbols:
        return multiplier_symbol(whole[0])
    if whole and name not in model.symbols:
        raise ModelError(
            f"the constraint '{name[:64]}' has {len(whole)} multipliers",
            fix=f"ask for one of {', '.join(whole)}",
            code="E402",
        )
    try:
        return read.parse_expression(text, read.Scope(model.symbols), what=what)
    except ModelError:
        meant = _energy_meant(name) or _row_meant(model, name, names)
        if meant is None:
            raise
        raise ModelError(f"there is no quantity and no constraint row '{name[:64]}'", fix=meant, code="E402") from None


def _energy_meant(name: str) -> str | None:
    """The attribute of a run that an energy is; None for other names."""
    word = name.casefold().replace("energies", "energy").removesuffix(" energy").removesuffix("*")
    attribute = ENERGIES.get(word)
    return attribute and f"energies are attributes: run.{attribute}; run.plot(energy=True) shows them"


def _row_meant(model: Model, name: str, rows: Sequence[str]) -> str | None:
    """The question whether a row was meant; None if the name is more like that of something else."""
    known = [*model.symbols, *rows]
    same = [other for other in known if other.casefold() == name.casefold()]
    found = f"Did you mean '{same[0]}'?" if same else did_you_mean(name, known)
    return found if any(found == f"Did you mean '{row}'?" for row in rows) else None


def row_of(model: Model, expr: object) -> Row | None:
    """The row whose multiplier an expression is, or None."""
    if not isinstance(expr, sp.Symbol) or not expr.name.startswith("λ("):
        return None
    return next((row for row in rows_of(model) if multiplier_symbol(row.name) == expr), None)


def multiplier_words(model: Model, row: Row) -> str:
    """What a row's multiplier is, in words: "the force along x on point 'P'"."""
    return f"multiplier of '{row.name}': " + "".join(x if isinstance(x, str) else plain(x) for x in row.multiplier)
