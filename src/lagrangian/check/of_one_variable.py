"""The values of an expression of numbers and one variable, and its slope with them, also at complex places."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import reduce
from typing import Any

# mpmath has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownVariableType=false
# pyright: reportUnknownArgumentType=false
import mpmath
import sympy as sp

Dual = tuple[Any, Any]
"""A value and the slope there."""

_WAVES: dict[type, Callable[[Any], Dual]] = {
    sp.sin: lambda x: (mpmath.sin(x), mpmath.cos(x)),
    sp.cos: lambda x: (mpmath.cos(x), -mpmath.sin(x)),
    sp.tan: lambda x: (mpmath.tan(x), 1 + mpmath.tan(x) ** 2),
}


@contextmanager
def digits(count: int) -> Iterator[None]:
    """Compute with this many decimal digits."""
    with mpmath.workdps(count):
        yield


def number(expr: sp.Expr) -> Any:
    """A number of SymPy with the digits in use."""
    return mpmath.mpmathify(sp.N(expr, mpmath.mp.dps + 5))


def value_and_slope(expr: sp.Basic, variable: sp.Basic, at: Any) -> Dual | None:
    """f(at) and f′(at), for sums, products, constant powers, and sines, cosines and tangents; None where another
    function of the variable is met or a value is not finite."""
    try:
        found = _dual(expr, variable, (at, mpmath.mpf(1)))
    except (ArithmeticError, NotImplementedError, ValueError, TypeError):
        return None
    return found if all(mpmath.isfinite(x) for x in found) else None


def _dual(expr: sp.Basic, variable: sp.Basic, at: Dual) -> Dual:
    if expr == variable:
        return at
    if isinstance(expr, (sp.Integer, sp.Rational)):
        return mpmath.mpf(int(expr.p)) / int(expr.q), mpmath.mpf(0)
    if isinstance(expr, sp.Expr) and not expr.has(variable):
        return number(expr), mpmath.mpf(0)
    parts = [_dual(x, variable, at) for x in expr.args]
    if isinstance(expr, sp.Add):
        return sum(x for x, _ in parts), sum(slope for _, slope in parts)
    if isinstance(expr, sp.Mul):
        return reduce(lambda a, b: (a[0] * b[0], a[1] * b[0] + a[0] * b[1]), parts)
    if isinstance(expr, sp.Pow) and not expr.exp.has(variable):
        (x, slope), (n, _) = parts
        return x**n, n * x ** (n - 1) * slope
    if type(expr) in _WAVES:
        ((x, slope),) = parts
        f, rise = _WAVES[type(expr)](x)
        return f, rise * slope
    raise NotImplementedError(type(expr).__name__)
