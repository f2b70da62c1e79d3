"""A line that equates functions of one angle alone, sin(ψ/2) cos(ψ/2) = 2 sin ψ: an identity, and no constraint."""

from __future__ import annotations

from typing import cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.explain.search import simple_number
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Mistake
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.model import time
from lagrangian.page.formula import text

WHY = text(
    "Put in a special angle, such as a right one. With the double angle, sin 2a = 2 sin a cos a and "
    "cos 2a = 2 cos² a − 1 = 1 − 2 sin² a."
)
NEAR = 1e-9
"""The relative difference of values that is rounding."""


def identity_slip(truth: Reference, line: AnsweredLine) -> tuple[Mistake, int] | None:
    """The mistake in such a line, and 0; None for any other line."""
    expr = line.expr
    if expr.free_symbols - {time} or len(expr.atoms(AppliedUndef)) != 1 or expr.has(sp.Derivative):
        return None
    if not expr.has(sp.sin, sp.cos, sp.tan):
        return None
    title = line.opening
    what, parts = text(f"{title} is no identity."), [cast("sp.Expr", x) for x in sp.Add.make_args(expr)]
    if len(parts) == 2:
        one, other = sorted(parts, key=lambda x: -len(x.atoms(sp.sin, sp.cos, sp.tan)))
        values = CompiledExpressions([one, other]).at(truth.states)
        times = float(values[0] @ values[1]) / float(values[1] @ values[1])
        number = simple_number(times)
        if number is not None and np.abs(values[0] - times * values[1]).max() <= NEAR * np.abs(values[0]).max():
            right = sp.Rational(number.numerator, number.denominator) * other
            if one.could_extract_minus_sign():
                one, right, other = -one, -right, -other
            shown = (cast("sp.Expr", x) for x in (one, right, -other))
            left, is_, written = shown
            what = text(f"{title} is no identity: ", left, " is ", is_, ", not ", written, ".")
    return Mistake("identity_wrong", what, WHY, 5, None, None, text(f"{title} is no identity.")), 0
