"""Numbers that an answer gives beside letters, R - r = 0.4 m: what the letters are with the values of the system."""

from __future__ import annotations

from typing import Any

import sympy as sp
from lark import Token, Tree

from lagrangian.check.reading.names import Value
from lagrangian.model import Model

ROUNDED = 1e-3
"""The relative difference of a value that was rounded."""


def amounts_to(value: Any, number: Any, model: Model, *, one: bool = False) -> bool:
    """Whether a number, perhaps with a unit that was read as parameters, is what a value in letters is with the values
    of the system: R - r = 0.4 m. ``one``: k g is 1 kg, too."""
    if not isinstance(value, sp.Expr) or not isinstance(number, sp.Expr) or not value.free_symbols:
        return False
    if not value.free_symbols <= model.values.keys():
        return False
    factor, unit = (number, sp.S.One) if number.is_number else number.as_coeff_Mul()  # 20° is π/9
    factors: Any = unit.args or [unit]
    if unit != 1 and not all(isinstance(x, sp.Expr) and x.as_base_exp()[0].is_Symbol for x in factors):
        return False
    amount = value.xreplace({p: sp.Float(v) for p, v in model.values.items()})
    return bool(amount.is_Float and abs(amount - factor) <= ROUNDED * abs(factor) and (one or factor != 1))


def parameter_given(value: Any, number: Any, model: Model) -> str | None:
    """The parameter that a name was said to be, if a number follows: th0 = theta0 = 20°, its value and not another of
    the name; None otherwise."""
    if not isinstance(number, sp.Expr) or not number.is_number or number == 0:
        return None
    return next((p.name for p in model.parameters if p.symbol == value), None)


def without_amounts(values: list[Value], sides: list[Tree], model: Model) -> tuple[list[Value], list[Tree]]:
    """The values and sides of an equation without the numbers that its first side is with the values of the system, if
    one of them has a unit that was read as parameters: m_1 + m_2 = 8.5 kg, J/r^2 = 0.01/0.01 = 1 kg."""
    pairs = list(zip(values, sides, strict=True))[1:]
    given = [amounts_to(values[0], x, model, one=_has_digits(side)) for x, side in pairs]
    if not any(out and x.free_symbols for out, (x, _) in zip(given, pairs, strict=True)):
        return values, sides
    kept = [0, *(k for k, out in enumerate(given, 1) if not out)]
    return [values[k] for k in kept], [sides[k] for k in kept]


def _has_digits(side: Tree) -> bool:
    return next(side.scan_values(lambda x: isinstance(x, Token) and x.type in ("NUMBER", "FRACTION")), None) is not None
