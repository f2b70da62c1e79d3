"""Says of a wrong sine or cosine in an equation in which of its terms, as it is written, it stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.narrowed import FUNCTIONS
from lagrangian.check.explain.own_terms import LINES
from lagrangian.check.explain.say import KINDS
from lagrangian.check.verdict import Finding, Mistake
from lagrangian.page.formula import text

SIGN = "_sign"
"""How the names of mistakes end that are a wrong sign of a part of a way or of a velocity."""


def in_written_terms(told: Sequence[Mistake], findings: Sequence[Finding]) -> tuple[Mistake, ...]:
    """The mistakes; a wrong function in an equation is told of the one term that has it as a factor."""
    open_ones = [f for f in findings if f.is_open]
    if len(told) == 1 and told[0].name.endswith(SIGN) and (angle := _other_angle(open_ones)) is not None:
        line = open_ones[0].line.title if len(open_ones) == 1 else "the equations"
        said = text(f"In {line}, the angle ", angle[0], " stands in place of ", angle[1], ".")
        brief = text(f"The angle in {line} is not right.")
        return (replace(told[0], name="angle", what=said, why=text(KINDS["angle"].why), brief=brief),)
    wrong = [f for f in open_ones if f.line.kind == "equation"]
    return tuple(_in_its_term(m, [f for f in wrong if f.coordinate == m.coordinate]) for m in told)


def _in_its_term(mistake: Mistake, wrong: Sequence[Finding]) -> Mistake:
    """A mistake in an equation that is ``wrong``: sin θ in place of cos θ as a factor of its only different term."""
    if mistake.step != LINES["equation"] or mistake.name not in FUNCTIONS or len(wrong) != 1:
        return mistake
    if any(isinstance(x, sp.Mul) for x in mistake.what.parts):  # its term is told
        return mistake
    differing = wrong[0].differences
    if len(differing) != 1 or 0 in (differing[0].written, differing[0].term):
        return mistake
    more, less = sp.fraction(bounded.cancel(differing[0].written / differing[0].term))
    if not all(isinstance(x, (sp.sin, sp.cos)) for x in (more, less)):
        return mistake
    said = ("In the term ", differing[0].written, ", the factor ", more, " stands in place of ", less, ".")
    return replace(mistake, what=text(*said))


def _other_angle(wrong: Sequence[Finding]) -> tuple[sp.Expr, sp.Expr] | None:
    """The angle that stands in place of another one, with which all terms that differ would be right; None if there is
    no such angle, or the line is wrong in other ways."""
    differing = [d for f in wrong for d in f.differences]
    if not differing or not all(f.differences for f in wrong) or any(0 in (d.written, d.term) for d in differing):
        return None
    first = differing[0]
    for own in sorted(_angles(first.written) - _angles(first.term), key=sp.default_sort_key):
        for right in sorted(_angles(first.term) - _angles(first.written), key=sp.default_sort_key):
            for sign in (1, -1):
                table = {sp.sin(own): sp.sin(sign * right), sp.cos(own): sp.cos(right)}
                if all(bounded.expand(cast("sp.Expr", d.written.xreplace(table)) - d.term) == 0 for d in differing):
                    return own, cast("sp.Expr", sign * right)
    return None


def _angles(expr: sp.Expr) -> set[sp.Expr]:
    """The angles of the sines and cosines of a term."""
    return {cast("sp.Expr", f.args[0]) for f in expr.atoms(sp.sin, sp.cos)}
