"""Expressions as plain text in the grammar of model files: ``m*L^2*theta1'' + g*sin(theta1)``."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownVariableType=false
# pyright: reportUnknownArgumentType=false

from __future__ import annotations

from functools import lru_cache
from typing import Any, cast

import sympy as sp
from sympy.printing.precedence import precedence
from sympy.printing.str import StrPrinter


class _Plain(StrPrinter):
    """SymPy's printer of text, with primes for rates, names without ``(t)`` and ``^`` for powers."""

    _names = {"Abs": "abs", "Min": "min", "Max": "max"}  # noqa: RUF012 - a printer's table, never changed

    def _print_Derivative(self, expr: Any) -> str:
        return f"{self._print(expr.expr)}{chr(39) * expr.derivative_count}"

    def _print_Function(self, expr: Any) -> str:
        name = expr.func.__name__
        if isinstance(expr, sp.core.function.AppliedUndef):
            return name
        return f"{self._names.get(name, name)}({self.stringify(expr.args, ', ')})"

    def _print_Max(self, expr: Any) -> str:
        ordered = sorted(expr.args, key=sp.default_sort_key)  # the order of SymPy may change from run to run
        return f"{self._names[expr.func.__name__]}({self.stringify(ordered, ', ')})"

    _print_Min = _print_Max

    def _print_Abs(self, expr: Any) -> str:
        return self._print_Function(expr)

    def _print_Exp1(self, expr: Any) -> Any:
        return "exp(1)"

    def _print_Pow(self, expr: Any, rational: bool = False) -> str:
        return super()._print_Pow(expr, rational=rational).replace("**", "^")

    def _print_Piecewise(self, expr: Any) -> str:
        parts: list[str] = []
        for value, condition in expr.args:
            if condition == sp.true:
                parts.append(self._print(value))
            else:
                parts += [self._print(condition), self._print(value)]
        return "piecewise(" + ", ".join(parts) + ")"

    def _print_Heaviside(self, expr: Any) -> str:
        return self._print(as_cases(expr))

    def _print_Relational(self, expr: Any) -> str:
        left, right = (self.parenthesize(side, precedence(expr)) for side in expr.args)
        return f"{left} {expr.rel_op} {right}"


def as_cases(step: Any) -> sp.Piecewise:
    """Return SymPy's step function Heaviside(u, h) as cases: 0 if u < 0, 1 if u > 0, otherwise h."""
    u, half = step.args
    cases = (0, sp.Lt(u, 0, evaluate=False)), (1, sp.Gt(u, 0, evaluate=False)), (half, True)
    return cast("sp.Piecewise", sp.Piecewise(*cases, evaluate=False))


def plain(expr: sp.Basic) -> str:
    """Return ``expr`` as text that the grammar of expressions can read."""
    return _kept(expr) if isinstance(expr, sp.Expr) else _printed(expr)


@lru_cache(maxsize=5_000)
def _kept(expr: sp.Expr) -> str:
    """The text of a formula, kept: the same pieces stand in many sentences."""
    return _printed(expr)


def _printed(expr: sp.Basic) -> str:
    return _Plain({"order": None, "full_prec": False}).doprint(expr)
