"""What a sentence says that was written is what was written: a squared speed, a deflection, and no reason besides.

Oracle: two equal wings on a sled; a lid with a coil spring, told by its angle from the vertical; a bar with its weight.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verdict import Verdict


def told(verdict: Verdict) -> str:
    return " ".join(str(verdict).split())


@cache
def sled(names: tuple[str, str]) -> lg.Derivation:
    """A sled with two equal wings that swing to the rear together."""
    s = lg.System("sled with wings")
    x, phi = s.coordinates("x phi")
    M, m, I, a, w = s.parameters("M m I a w")
    s.particle(M, at=s.point("S", (x, 0)), name="sled")
    for sign, name in zip((1, -1), names, strict=True):
        place = (x - a * sp.sin(phi), sign * (w + a * sp.cos(phi)))
        s.rigid_body(m, inertia=I, at=s.point(name.replace(" ", ""), place), frame=s.frame(sign * phi), name=name)
    s.force(s.input("F"), deflection=x, name="pull")
    return s.derive()


WINGS = """\
v_w^2 = x'^2 {sign} 2 a x' phi' cos(phi) + a^2 phi'^2
T = 1/2 M x'^2 + 2 * 1/2 m v_w^2 + 2 * 1/2 I phi'^2
V = 0
Xi_x = F
Xi_phi = 0"""


@pytest.mark.parametrize("names", [("left wing", "right wing"), ("wing 1", "wing 2")])
def test_a_squared_speed_is_quoted_as_it_is(names: tuple[str, str]) -> None:
    """Of two equal bodies that one formula is said of, both are meant."""
    assert "not right" not in told(sled(names).check(WINGS.format(sign="-")))
    said = told(sled(names).check(WINGS.format(sign="+")))
    assert f"'{names[0]}' and" in said and f"'{names[1]}'" in said
    assert "the term 2 a ẋ φ̇ cos φ has the wrong sign" in said and ")²" not in said.split("the term")[0]


@cache
def lid() -> lg.Derivation:
    """A lid with a coil spring that is relaxed at ρ, and its weight."""
    s = lg.System("lid")
    theta = s.coordinate("theta")
    m, a, g, k, rho, c = s.parameters("m a g k rho c")
    s.particle(m, at=s.point("P", (a * sp.cos(theta), a * sp.sin(theta))), name="lid")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=theta - rho, name="coil")
    s.damper(c, deflection=theta, name="hinge")
    return s.derive()


LID = """\
z = pi/2 - theta
T = 1/2 m a^2 z'^2
V = m g a cos(z) + 1/2 k ({deflection})^2
m a^2 z'' - m g a sin(z) + k ({deflection}) + c z' = 0"""


def test_a_deflection_is_quoted_as_it_is_squared() -> None:
    """The rest angle is counted from the horizontal, z from the vertical: π/2 is lost and a sign is wrong at once."""
    right = LID.format(deflection="z - pi/2 + rho")
    assert lid().check(right).right
    said = told(lid().check(LID.format(deflection="z - rho")))
    assert said.count("is taken as") == 1 and "is taken as z − ρ;" in said.replace("rho", "ρ")


@cache
def bar() -> lg.Derivation:
    """A uniform bar on a hinge, with a weight at its end and a damper."""
    s = lg.System("bar")
    theta = s.coordinate("theta")
    M, m, length, g, b = s.parameters("M m l g b")
    middle = s.point("G", (length / 2 * sp.sin(theta), length / 2 * sp.cos(theta)))
    s.rigid_body(M, inertia=M * length**2 / 12, at=middle, frame=s.frame(theta), name="bar")
    s.particle(m, at=s.point("E", (length * sp.sin(theta), length * sp.cos(theta))), name="knob")
    s.gravity(direction=(0, -1), g=g)
    s.damper(b, deflection=theta, name="hinge")
    return s.derive()


TABLE = """\
| force | virtual work |
|---|---|
| bar | M g (l/2) sin θ δθ |
| knob | m g l sin θ δθ |

"""
ROW = "(M l²/3 + m l²) θ'' = (M + m) g l sin θ − b θ'"


def test_no_reason_is_given_where_a_row_that_was_not_read_says_another() -> None:
    """The half stands in the table of virtual works, and is lost below it."""
    alone, below = told(bar().check(ROW)), told(bar().check(TABLE + ROW))
    for said in (alone, below):
        assert "should be ½ M g l sin θ" in said
    assert "A possible reason: The height" in alone
    assert "reason" not in below and "In the height of" not in below
