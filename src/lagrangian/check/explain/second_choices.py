"""Leaves out of second choices what only repeats a mistake that is told, in other words.

"The weight of the bob has the wrong sign" says nothing new beside "The weight of the bob has the wrong sign in V", and
"In V, R stands in place of r" nothing beside "R stands in place of r in the energy of the spring".
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from lagrangian.check.verdict import Mistake

FAMILIES = (
    ("sign", ("sign", "xi_sign", "plus_potential")),
    ("left out", ("forgotten", "left_out", "missing", "lost", "no_arm", "not_squared", "without")),
    ("number", ("half", "twice", "number", "factor_of", "energy_for")),
    ("letter", ("swapped", "letter", "exchanged", "wrong_angle", "angle")),
    ("function", ("sine", "function", "turned")),
)
"""What was done, by parts of the names of mistakes."""


def distinct(others: Sequence[Mistake], told: Sequence[Mistake]) -> tuple[Mistake, ...]:
    """The second choices that name another cause than what is told, and than each other."""
    kept: list[Mistake] = []
    for m in others:
        if not any(_repeats(m, x) for x in (*told, *kept)):
            kept.append(m)
    return tuple(kept)


def _repeats(mistake: Mistake, other: Mistake) -> bool:
    """Whether both say that the same was done, to the same letters or to the same element.

    x + y in place of y - x, and x + y where it is y - x, is the same, whatever it is called.
    """
    one, two = _written(mistake), _written(other)
    quoted, others = _quoted(mistake), _quoted(other)
    replaced = len(one) > 1 and len(two) > 1 and mistake.element in (other.element, None)
    if replaced and (one == two or (len(quoted) > 1 and quoted == others)):
        return True
    if _family(mistake) != _family(other):
        return False
    if quoted and others and mistake.element == other.element:
        return quoted <= others or others <= quoted or _without_rates(quoted) == _without_rates(others)
    if quoted and others:
        return quoted == others
    return mistake.element is None or other.element is None or mistake.element == other.element


def _written(mistake: Mistake) -> set[sp.Expr]:
    """The formulas in the words, of two signs the same one."""
    exprs = (x for x in mistake.what.parts if isinstance(x, sp.Expr))
    return {-x if x.could_extract_minus_sign() else x for x in exprs}


def _family(mistake: Mistake) -> str:
    """What was done, in a word; the name itself if it is of no family."""
    return next((f for f, parts in FAMILIES if any(p in mistake.name for p in parts)), mistake.name)


def _quoted(mistake: Mistake) -> set[sp.Basic]:
    """The letters, coordinates and rates that the words quote."""
    exprs = [x for x in mistake.what.parts if isinstance(x, sp.Expr)]
    return {atom for x in exprs for atom in (x.free_symbols | x.atoms(sp.Function, sp.Derivative)) - {sp.Symbol("t")}}


def _without_rates(quoted: set[sp.Basic]) -> set[sp.Basic]:
    """What is quoted, with coordinates in place of their rates: J φ̈ of an equation is ½ J φ̇² of T*."""
    return {x.expr if isinstance(x, sp.Derivative) else x for x in quoted}
