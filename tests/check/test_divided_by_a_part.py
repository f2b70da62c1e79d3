"""An equation that is divided by one mass, where two are moved, is told so, and not that terms are missing.

Oracle: by hand; in the equation of the cart both masses multiply ẍ.
"""

from __future__ import annotations

import pytest
import sympy as sp
from small_systems import cart

import lagrangian as lg

SECOND = "m l^2 phi'' + m l x'' cos(phi) + m g l sin(phi) = 0"
FIRST = "x'' = -[k x + m l (phi'' cos(phi) - phi'^2 sin(phi))]/(M + m)"


def test_a_mass_is_missing_in_what_is_divided_by() -> None:
    assert cart().check(f"{FIRST}\n{SECOND}").right
    verdict = cart().check(f"{FIRST.replace('(M + m)', 'M')}\n{SECOND}")
    assert not verdict.right


@pytest.mark.parametrize("wrong", [FIRST.replace("k x", "2 k x"), FIRST.replace("m l (phi''", "M l (phi''")])
def test_other_mistakes_are_none_of_a_divisor(wrong: str) -> None:
    verdict = cart().check(f"{wrong}\n{SECOND}")
    assert not verdict.right and all("divided by" not in str(m.what) for m in verdict.mistakes)


@pytest.mark.slow
def test_two_terms_missing_at_once_are_one_divisor() -> None:
    """The trailer and its load, which swings, lag behind the car: both accelerations lack the mass of the load."""
    s = lg.System("car and trailer")
    x, u, q = s.coordinates("x u q")
    M, a, b, k, l, g = s.parameters("M a b k l g")
    s.particle(M, at=s.point("C", (x, 0)), name="car")
    s.particle(a, at=s.point("A", (x - u, 0)), name="trailer")
    s.particle(b, at=s.point("B", (x - u + l * sp.sin(q), -l * sp.cos(q))), name="load")
    s.spring(k, deflection=u, name="hitch")
    s.gravity((0, -1), g)
    right = (
        "M x'' = -k u\nu'' = x'' - [k u - b l (q'' cos(q) - q'^2 sin(q))]/(a + b)\n"
        "l q'' + (x'' - u'') cos(q) + g sin(q) = 0"
    )
    assert s.derive().check(right).right
    verdict = s.derive().check(right.replace("(a + b)", "a"))
    assert [str(m.what) for m in verdict.mistakes] == ["Line 2 is divided by a; it should be divided by a + b."]
    assert not verdict.findings[1].differences
