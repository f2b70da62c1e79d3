"""Two balances of bodies are wrong, one by a term that stands in it: the other is told, and the right ones are right.

Oracle: by hand, a bar on two ropes from drums, whose ends are let down by r φ₁ and r φ₂:

    J φ₁″ = r S₁ − c φ₁′   J φ₂″ = r S₂   m y″ = m g − S₁ − S₂ − b y′   I ψ″ = a (S₁ − S₂)
    y = r (φ₁ + φ₂)/2      ψ = r (φ₂ − φ₁)/(2 a)
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg
from lagrangian.model import time


@cache
def bar() -> lg.Derivation:
    """A bar that is let down by two drums, of which one has a brake; the bar is damped."""
    s = lg.System("bar on two ropes")
    one, two = s.coordinates("phi1 phi2")
    J, m, I, r, a, c, b = s.parameters("J m I r a c b")
    y, psi = r * (one + two) / 2, r * (two - one) / (2 * a)
    s.kinetic(J * (one.diff() ** 2 + two.diff() ** 2) / 2, name="drums")
    s.kinetic(I * psi.diff(time) ** 2 / 2, name="turning bar")
    s.particle(m, at=s.point("C", (0, -y)), name="bar")
    s.gravity((0, -1))
    s.damper(c, deflection=one, name="brake")
    s.damper(b, deflection=y, name="dashpot")
    return s.derive()


SHEET = """Rope forces S1 and S2

y = r (phi1 + phi2)/2      y'' = r (phi1'' + phi2'')/2
w = r (phi2' - phi1')/(2 a)

drum 1:  J phi1'' = r S1 {brake}
drum 2:  J phi2'' = r S2
bar:     m y'' = m g - S1 - S2{b}
         I w' = {arm} (S1 - S2)

S1 = (m g{b} - m y'')/2 + I w'/(2 {arm})
S2 = (m g{b} - m y'')/2 - I w'/(2 {arm})

J phi1'' = r/2 (m g{b} - m y'') + r I w'/(2 {arm}) {brake}
J phi2'' = r/2 (m g{b} - m y'') - r I w'/(2 {arm})
"""
GOOD = {"brake": "- c phi1'", "b": " - b y'", "arm": "a"}
LINES = {"brake": 6, "b": 8, "arm": 9}


def wrong(found: lg.CheckedAnswer) -> set[int]:
    """The lines that are wrong of their own."""
    return {f.line.number for f in found.findings if not f.status.right and not f.follows}


def test_the_right_answer() -> None:
    assert bar().check(SHEET.format(**GOOD)).right


@pytest.mark.slow
@pytest.mark.parametrize("slips", [{"brake": "+ c phi1'", "b": ""}, {"brake": "- 2 c phi1'", "b": ""}])
def test_a_right_balance_is_not_wrong_by_forces_of_two_others(slips: dict[str, str]) -> None:
    found = bar().check(SHEET.format(**{**GOOD, **slips}))
    assert not found.right and wrong(found) == {LINES[x] for x in slips}, found.to_text()
    assert {7, 9} <= {f.line.number for f in found.findings if f.status.right}, found.to_text()
    assert "was not judged" not in found.to_text().split("Line by line")[0].split("was not judged.", 1)[-1]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("slip", [{"brake": "+ c phi1'"}, {"b": ""}, {"arm": "r"}])
def test_one_wrong_balance_is_told_as_before(slip: dict[str, str]) -> None:
    found = bar().check(SHEET.format(**{**GOOD, **slip}))
    assert not found.right and wrong(found) == {LINES[x] for x in slip}, found.to_text()


def test_no_right_balance_is_blamed_where_three_are_wrong() -> None:
    found = bar().check(SHEET.format(brake="+ c phi1'", b="", arm="r"))
    assert not found.right
    assert not any(f.status.right for f in found.findings if f.line.number in LINES.values()), found.to_text()
