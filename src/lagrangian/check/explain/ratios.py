"""Ratios of two letters of one kind, r/a of a lever or of a strap: a factor of its own, and without a unit.

Where r/a is missing, no a stands in place of r: none is left of both.
"""

from __future__ import annotations

import sympy as sp

from lagrangian import bounded
from lagrangian.page.formula import Text, text

WHY = text(
    "How far, or how fast, does it move for each unit of the coordinate? Through a gear, a lever or a strap, with the "
    "ratio; for an energy with its square."
)


def of_ratio(term: sp.Expr, right: sp.Expr, more: sp.Expr, less: sp.Expr) -> tuple[str, Text] | None:
    """The name and the words for a term in which a ratio less/more is missing or too much; None if ``more`` stands
    there in place of ``less``."""
    above = [{f.as_base_exp()[0] for f in sp.Mul.make_args(sp.fraction(x)[0])} for x in (term, right)]
    ratio = less / more
    if more not in above[0]:
        left = bounded.cancel(term / ratio)
        if less in above[0] and not bounded.letters(left) & {less, more}:
            return "not_squared", text("In the term ", term, ", ", ratio, " stands once, and belongs there squared.")
        return "factor_missing", text("In the term ", term, ", the factor ", ratio, " is missing.")
    if less not in above[1]:
        return "foreign_factor", text("In the term ", term, " there is the factor ", 1 / ratio, " too much.")
    return None
