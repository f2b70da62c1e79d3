"""Explanations of a weight that counts twice or half: likelier by its height where the number stands beside the arm.

M*g*2*a*cos(theta) shows that the arm was taken as 2 a, and m g (l/2) sin φ that it was taken as l/2.
2*M*g*a shows neither.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.all_forces import letters_of_gravity
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.misconceptions.gravity_arm import HALF
from lagrangian.check.explain.search import Explanation
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.read.letters import key

SEEN = 0.7
"""What it spares that the number stands beside the arm."""
_NAME = r"\\?([^\W\d]\w{0,30}+)(?:_\{(\w{1,20})\})?(?![\w(])"
_TIMES = r"\s{0,2}(?:[*·⋅×]|\\cdot\b|\\[,;])?\s{0,2}\(?\s{0,2}"
_TWICE = re.compile(rf"(?<![\w.^}}{{/])2{_TIMES}{_NAME}")
_HALF = re.compile(
    rf"(?<![\w.])(?:½|0\.5|1/2|\(1/2\)|\\[td]?frac(?:12|\{{1\}}\{{2\}})){_TIMES}{_NAME}"
    rf"|(?<!\w)(?<!\w\\){_NAME}\s{{0,2}}/\s{{0,2}}2(?![\w.^])"
    rf"|\\[td]?frac\s?\{{\s{{0,2}}{_NAME}\s{{0,2}}\}}\s{{0,2}}\{{\s{{0,2}}2\s{{0,2}}\}}"
)
"""A number directly before or below a name."""


def by_lengths(pool: Pool, found: Sequence[Explanation], lines: Sequence[AnsweredLine]) -> list[Explanation]:
    """The explanations, the cheapest first; those by which a height is taken twice or half as far are likelier where a
    line shows just that."""
    seen = {id(e) for e in found if len(e.told) == 1 and _shows(pool, e, lines)}
    if not seen:
        return list(found)
    return sorted((replace(e, cost=e.cost - SEEN) if id(e) in seen else e for e in found), key=lambda e: e.cost)


def _shows(pool: Pool, explanation: Explanation, lines: Sequence[AnsweredLine]) -> bool:
    """Whether a line with g has the number of a height that was taken wrongly beside a length of it."""
    wrong = explanation.told[0].mistake.wrong
    if wrong is None or wrong.name != "gravity_arm":
        return False
    half = f"taken {HALF} as far" in str(wrong.variant.what)
    arms = _lengths(pool.truth, wrong.variant.V)
    weights = letters_of_gravity(pool.truth)
    for line in lines:
        if not line.expr.has(*weights) or not arms:
            continue
        if any(key(name) in arms for name in _beside(line.text, half)):
            return True
    return False


def _lengths(truth: Reference, energy: sp.Expr) -> set[str]:
    """The keys of the lengths of a weight that stand in V without a number; a number beside others may be right."""
    others = letters_of_gravity(truth)
    others |= {x for b in truth.model.bodies for x in bounded.letters(sp.sympify(b.mass))}
    own = {p.symbol for p in truth.model.parameters} & bounded.letters(energy) - others
    terms = sp.Add.make_args(bounded.expand(truth.V))
    numbered = {x for t in terms if t.as_coeff_Mul()[0] not in (1, -1) for x in bounded.letters(t)}
    return {key(str(x)) for x in own - numbered}


def _beside(written: str, half: bool) -> Iterator[str]:
    """The names beside which a 2, or a ½, stands in a text."""
    for match in (_HALF if half else _TWICE).finditer(written):
        parts = [x for x in match.groups() if x]
        yield "_".join(parts)
