"""Two balances of which one has their common force with the wrong sign, and nothing says which."""

from __future__ import annotations

from typing import cast

import sympy as sp

from lagrangian.check.explain.balance_terms import Mend, mends
from lagrangian.check.explain.solved_forces import Balances, left_out
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Mistake
from lagrangian.page.formula import text

NAME = "wrong_balance"
"""The name of the mistake."""
WHY = text("What one body does to another, this one does back to it: with a plus in one balance, a minus in the other.")


def sign_in_one_of_two(truth: Reference, balances: Balances) -> Mistake | None:
    """That the same force has the wrong sign in one of two lines; None if one of them may have anything else wrong."""
    apart = left_out(balances)
    if len(apart) != 2:
        return None
    common: set[sp.Basic] = set(balances.forces)
    for i in apart:
        u = balances.forces_without(i)
        if u is None:
            return None
        found = mends(truth, balances.lines[i].expr, truth.accelerations | u, list(u))
        common &= _turned(found, balances)
    if len(common) != 1:
        return None
    one, other = sorted(balances.lines[i].number for i in apart)
    if one == other:
        return None
    lines = f"In line {one} or in line {other}, "
    what = text(lines, cast("sp.Expr", common.pop()), " has the wrong sign: the two do not fit each other.")
    return Mistake(NAME, what, WHY, 5, brief=text(f"Lines {one} and {other} do not fit each other."))


def _turned(found: list[Mend], balances: Balances) -> set[sp.Basic]:
    """The forces whose sign alone may be wrong in a line; none if the plainest that may be wrong is something else."""
    best = found[0].term if found else None
    if best is None or best.factor != -1:
        return set()
    return {f for f in balances.forces if best.term.has(f)}
