"""The equations of the cart with a pole in SymPy, for tests of what SymPy draws."""

from __future__ import annotations

import sympy as sp

t, M, m, l, J, g, b, F = sp.symbols("t M m l J g b F")
x, theta = sp.Function("x")(t), sp.Function("theta")(t)


def cart(sign: int) -> tuple[sp.Expr, sp.Expr]:
    """The two equations, which are zero; with -1 the weight has the wrong sign."""
    first = (M + m) * x.diff(t, 2) + m * l * sp.cos(theta) * theta.diff(t, 2) + b * x.diff(t) - F
    second = (J + m * l**2) * theta.diff(t, 2) + m * l * sp.cos(theta) * x.diff(t, 2) - sign * m * g * l * sp.sin(theta)
    return first - m * l * sp.sin(theta) * theta.diff(t) ** 2, second
