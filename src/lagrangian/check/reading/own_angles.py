"""Angles of an answer's own that it gives by their cosine and their sine: cos β = s/√(s² + d²), sin β = d/√(s² + d²).

The sine alone leaves the sign of the cosine open.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp
from lark import Tree

from lagrangian import bounded
from lagrangian.check.reading.line_forms import Statement
from lagrangian.check.reading.meaning import Meaning
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.nodes import inside, only_name
from lagrangian.check.reading.reading_budget import ReadingBudget
from lagrangian.check.reading.subject import Subject
from lagrangian.read.letters import key


def own_angle(
    subject: Subject, value: Any, statements: Sequence[Statement], names: Names, budget: ReadingBudget
) -> Any:
    """What a name is of which a function has a value, atan2(d, s) where another statement gives the cosine, too."""
    for statement in statements if subject.inverse == "asin" else ():
        if len(statement.sides) == 2 and _is_cosine(statement.sides[0], str(subject.token)):
            angle = _by_both(value, Meaning(statement.source, names, budget).value(statement.sides[1]))
            if angle is not None:
                return angle
    return getattr(sp, subject.inverse)(value) if subject.inverse else value


def _is_cosine(tree: Tree, name: str) -> bool:
    """Whether a tree is the cosine of a name."""
    side = inside(tree)
    if not isinstance(side, Tree) or side.data != "call" or len(side.children) != 2:
        return False
    found = only_name(side.children[1])
    return str(side.children[0]) == "cos" and found is not None and not found[1] and key(str(found[0])) == key(name)


def _by_both(sine: Any, cosine: Any) -> sp.Expr | None:
    """The angle with a sine and a cosine over the same root, whose squares add up to 1; None for any others."""
    if not isinstance(sine, sp.Expr) or not isinstance(cosine, sp.Expr):
        return None
    (a, c), (b, d) = sine.as_numer_denom(), cosine.as_numer_denom()
    if c != d or c.as_base_exp()[1] != sp.S.Half or bounded.expand(a**2 + b**2 - c**2) != 0:
        return None
    return sp.atan2(a, b)
