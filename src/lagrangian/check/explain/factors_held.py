"""Factors that a line d/dt ∂L/∂ξ̇ holds constant though they move: 2 m R s cos φ of the term 2 m R s cos φ · φ̇."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions import product_rule
from lagrangian.check.verdict import Mistake
from lagrangian.model import Coordinate, time
from lagrangian.page.formula import Left, Total, text


def factor_held(
    title: Left, momentum: sp.Expr, more: sp.Expr, coordinates: Sequence[Coordinate], i: int
) -> Mistake | None:
    """The factor of one rate in ``momentum`` whose change in time its derivative, called ``title``, lacks; ``more`` is
    what the line has too much. None if that is not all."""
    if not isinstance(title, Total):
        return None
    rates = [c.rate for c in coordinates]
    for term in sp.Add.make_args(bounded.expand(momentum)):
        own = [v for v in rates if term.has(v)]
        factor = term / own[0] if len(own) == 1 else None
        if factor is None or factor.has(*rates):
            continue
        lost = bounded.diff(factor, time) * own[0]
        if lost != 0 and bounded.expand(more + lost) == 0:
            brief = text("A factor in ", title, " was not differentiated.")
            what = text(
                "In ", title, ", the derivative of the factor ", factor, " is missing: ", sp.factor_terms(lost), "."
            )
            return Mistake("product_rule", what, product_rule.WHY, 5, None, coordinates[i].name, brief)
    return None
