"""The functions in expressions: their number of arguments, and the SymPy function."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import sympy as sp

from lagrangian import bounded
from lagrangian.records import dataclass


@dataclass(frozen=True)
class Known:
    """A function: its SymPy function and its number of arguments (``most`` None: any number)."""

    make: Callable[..., sp.Expr]
    least: int = 1
    most: int | None = 1


def _extremum(function: type[sp.Max] | type[sp.Min]) -> Callable[..., sp.Expr]:
    """Return a maximum or minimum whose arguments SymPy compares only if there are few: it takes O(n²) proofs."""

    def make(*args: sp.Expr) -> sp.Expr:
        count = sum(len(a.args) if isinstance(a, (sp.Max, sp.Min)) else 1 for a in args)
        if all(a.is_Rational for a in args) or count <= 4:
            return function(*args)
        return function(*args, evaluate=False)

    return make


FUNCTIONS: dict[str, Known] = {
    "sin": Known(sp.sin),
    "cos": Known(sp.cos),
    "tan": Known(sp.tan),
    "asin": Known(sp.asin),
    "acos": Known(sp.acos),
    "atan": Known(sp.atan),
    "atan2": Known(sp.atan2, 2, 2),
    "sinh": Known(sp.sinh),
    "cosh": Known(sp.cosh),
    "tanh": Known(sp.tanh),
    "asinh": Known(sp.asinh),
    "acosh": Known(sp.acosh),
    "atanh": Known(sp.atanh),
    "exp": Known(sp.exp),
    "log": Known(sp.log),
    "ln": Known(sp.log),
    "sqrt": Known(sp.sqrt),
    "abs": Known(partial(bounded.absolute, sp.Abs)),
    "sign": Known(partial(bounded.absolute, sp.sign)),
    "min": Known(_extremum(sp.Min), 1, 32),
    "max": Known(_extremum(sp.Max), 1, 32),
}
"""Every function except ``piecewise``, whose arguments alternate between conditions and values."""

ALIASES = {
    "arcsin": "asin",
    "arccos": "acos",
    "arctan": "atan",
    "arctan2": "atan2",
    "arcsinh": "asinh",
    "arccosh": "acosh",
    "arctanh": "atanh",
    "arsinh": "asinh",
    "arcosh": "acosh",
    "artanh": "atanh",
    "tg": "tan",
    "fabs": "abs",
    "Abs": "abs",
    "Max": "max",
    "Min": "min",
    "sgn": "sign",
    "signum": "sign",
    "Piecewise": "piecewise",
    "pow": "a^b",
    "cot": "1/tan(x)",
    "sec": "1/cos(x)",
    "csc": "1/sin(x)",
    "log10": "log(x)/log(10)",
    "log2": "log(x)/log(2)",
    "cbrt": "x^(1/3)",
    "diff": "x' for the rate of x",
    "Derivative": "x' for the rate of x",
    "heaviside": "piecewise(x < 0, 0, 1)",
    "Heaviside": "piecewise(x < 0, 0, 1)",
    "deg2rad": "pi/180*x",
    "radians": "pi/180*x",
}
"""Names in other languages, and what to write here."""
