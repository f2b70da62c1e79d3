"""Equations that are divided by a sum, as those that are solved for an acceleration, times that sum."""

from __future__ import annotations

import sympy as sp

from lagrangian import bounded


def cleared(expr: sp.Expr) -> sp.Expr:
    """An equation that is solved for an acceleration, times its denominator, if that is a sum."""
    divided = any(x.exp.is_negative and isinstance(x.base, sp.Add) for x in expr.atoms(sp.Pow))
    return sp.fraction(bounded.together(expr))[0] if divided else expr
