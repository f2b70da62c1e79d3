"""Says in words where a multiplier of an answer stands wrong: in one equation, or in one of two that do not fit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.terms.alike import put_together
from lagrangian.check.verdict import Mistake
from lagrangian.page.formula import text
from lagrangian.records import dataclass

CLASH = text("The factors of the multiplier in two equations do not fit each other.")
WHY = text(
    "The force of a constraint f = 0 enters the equation of ξ as λ·∂f/∂ξ: one λ for all equations, and ∂f/∂ξ for each."
)


@dataclass(frozen=True, eq=False)
class Pushing:
    """The factor of a multiplier on the right-hand side of an equation, beside the right one in the same scale."""

    row: int
    written: sp.Expr
    right: sp.Expr


def unfitting(truth: Reference, titles: Sequence[str], pushes: Sequence[Pushing], s: Any, wrong: Mistake) -> Mistake:
    """Two lines whose factors of a multiplier do not fit each other, in the reading in which the first is right.

    ``wrong`` is the mistake that one of the two has then.
    """
    one, other = pushes
    q, p = (truth.derivation.coordinates[x.row] for x in (one, other))
    kind = "sign" if zero_everywhere(truth, other.written + other.right) else "factor"
    what = text(
        "On the right-hand sides, the multiplier ",
        s,
        " has the factor ",
        one.written,
        f" in {titles[0]}, the equation of ",
        q,
        ", and ",
        other.written,
        f" in {titles[1]}, the equation of ",
        p,
        f". By {wrong.element} the two are as ",
        one.written,
        " : ",
        other.right,
        f": one of them has the wrong {kind}.",
    )
    return replace(wrong, what=what, coordinate=None, brief=CLASH)


def of_multiplier(truth: Reference, i: int, s: Any, x: Any, written: sp.Expr, right: sp.Expr) -> Mistake:
    """A multiplier that is missing in an equation, or has the wrong sign or factor there, in words."""
    q, name = truth.derivation.coordinates[i], truth.model.coordinates[i].name
    multiplier = next(m for m in truth.derivation.multipliers.values() if m.symbol == x)
    title = multiplier.element.title
    if written == 0:
        kind, what = "multiplier_missing", text("The multiplier ", s, " is missing in the equation of ", q, ".")
    elif zero_everywhere(truth, written + right):
        words = " has the wrong sign in the equation of "
        kind, what = "multiplier_sign", text("The multiplier ", s, words, q, ": it does not fit the other equations.")
    else:
        words = (" stands with the factor ", written, " in the equation of ", q, "; to fit the others, ")
        short = put_together(right) if right.has(sp.tan) else right
        kind, what = "multiplier_factor", text("The multiplier ", s, *words, short, " belongs there.")
    brief = text("The multiplier does not stand in the equation of ", q, " as it should.")
    return Mistake(kind, what, WHY, 6, title, name, brief)
