"""A mistake that says the same on both sides says nothing and is not told."""

from dataclasses import replace

import sympy as sp
from small_systems import rod

from lagrangian.check.explain.told_truly import told_truly
from lagrangian.check.verdict import Mistake
from lagrangian.page.formula import text

m, r = sp.symbols("m r")
WRONG = "(J + m*r^2)*phi'' + m*r*r'*phi' = M\nm*r'' - m*r*phi'^2 + k*(r - a) = 0"


def test_the_same_on_both_sides_is_not_told() -> None:
    verdict = rod().check(WRONG)
    (true,) = verdict.mistakes
    for said in (" should be ", " is not ", ", not "):
        idle = Mistake("factor_of_a_term", text("The term ", 2 * m * r, said, m * r * 2, "."), text("why"), 5)
        told = told_truly(replace(verdict, mistakes=(idle,)))
        assert all(x.what is not idle.what for x in told.mistakes)
        assert told.mistakes  # what differs is told in its place
    other = replace(true, what=text("The term ", m * r, " should be ", 2 * m * r, "."))
    assert told_truly(replace(verdict, mistakes=(other,))).mistakes == (other,)
