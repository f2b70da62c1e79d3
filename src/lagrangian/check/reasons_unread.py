"""No reason is given for a wrong term of which a line above that was not read says how it came about.

Weight of the lever | M g (l/2) sin θ δθ        a row that has the letters of the term, and no verdict
(J + …) θ'' = … + M g l sin θ                   the term is wrong; that a height was taken otherwise is not known
"""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from lagrangian.check.explain.quoted import letters_in
from lagrangian.check.explain.term_said import parted
from lagrangian.check.explain.terms_alone import WHY
from lagrangian.check.not_judged import tokens_of
from lagrangian.check.verdict import Mistake, Verdict
from lagrangian.read.letters import key

OF_PLACES = ("The height of ", "The position of ", "In the height of ", "In the position of ")
"""How reasons begin that speak of where a body is."""


def without_unread_reasons(verdict: Verdict, written: str) -> Verdict:
    """The verdict on a wrong answer, without reasons of which a line that was ``written`` and not read speaks."""
    if not verdict.unjudged or any(f.line.kind in ("V", "L") for f in verdict.findings):
        return verdict
    rows = written.split("\n")
    unread = [set(tokens_of(rows[n - 1])) for n in verdict.unjudged if n <= len(rows)]
    told = tuple(_without_reason(m, unread) for m in verdict.mistakes)
    if all(a is b for a, b in zip(told, verdict.mistakes, strict=True)):
        return verdict
    others = [m for m in verdict.alternatives if not str(m.what).startswith(OF_PLACES)]
    return replace(verdict, mistakes=told, alternatives=tuple(others))


def _without_reason(mistake: Mistake, unread: list[set[str]]) -> Mistake:
    """A mistake without a reason in where a body is, if a row that was not read has all letters of the term."""
    if (said := parted(mistake)) is None:
        return mistake
    certain, reason = said
    formulas = [x for x in certain.parts if isinstance(x, sp.Expr)]
    if not formulas or not str(reason).startswith(OF_PLACES):
        return mistake
    letters = {key(x.func.__name__ if x.is_Function else str(x)) for x in letters_in(formulas[0])}
    if not any(letters <= row for row in unread):
        return mistake
    return replace(mistake, what=certain, why=WHY)
