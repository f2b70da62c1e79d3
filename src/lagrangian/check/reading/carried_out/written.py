"""Writes what a program states in the grammar of answers."""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.printing.str import StrPrinter

from lagrangian.check.reading.carried_out.values import NAME, TIME, AbandonedError, is_scalar

LONGEST_LINE = 6_000
"""The most characters of a statement."""


class _Printer(StrPrinter):
    """Writes functions of time as names, and their derivatives with primes."""

    def _print_Function(self, expr: Any) -> str:
        if isinstance(expr, AppliedUndef):
            if expr.args != (TIME,):
                raise AbandonedError
            return str(expr.func)
        if isinstance(expr, sp.Abs):
            return f"abs({self._print(expr.args[0])})"
        return f"{expr.func.__name__}({', '.join(self._print(a) for a in expr.args)})"

    def _print_Derivative(self, expr: Any) -> str:
        if not isinstance(expr.expr, AppliedUndef) or set(expr.variables) != {TIME}:
            raise AbandonedError
        return f"{expr.expr.func}{chr(39) * len(expr.variables)}"

    def _print_Symbol(self, expr: Any) -> str:
        if NAME.fullmatch(expr.name) is None:
            raise AbandonedError
        return expr.name


def written(value: sp.Expr) -> str:
    """An expression in the grammar of answers."""
    if not is_scalar(value):
        raise AbandonedError
    made = _Printer().doprint(value)
    if len(made) > LONGEST_LINE:
        raise AbandonedError
    return made
