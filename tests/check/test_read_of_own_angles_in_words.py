"""The motion of a body by an own coordinate in words, slopes of own lengths, elements named behind formulas, labels.

Oracle: a geared motor that winds a rope with a load, and a leaning bar, by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg


@cache
def winch() -> lg.Derivation:
    """A drum with a geared motor and a load on an elastic rope; s is how far the load has been lifted."""
    s = lg.System("winch")
    phi = s.coordinate("phi", description="drum, positive when it hoists")
    up = s.coordinate("s", description="load, upwards")
    J, Jm, n, m, r, k, b, g = s.parameters("J Jm n m r k b g")
    s.kinetic(J * phi.diff() ** 2 / 2, name="drum")
    s.kinetic(Jm * (n * phi.diff()) ** 2 / 2, name="rotor")
    s.particle(m, at=s.point("P", (0, up)), name="load")
    s.gravity((0, -1), g)
    s.spring(k, deflection=r * phi - up, name="rope")
    s.damper(b, deflection=up, name="guide")
    s.force(s.input("tau"), deflection=n * phi, name="motor")
    return s.derive()


OWN = """Coordinates: psi = angle of the MOTOR (SAID), s as given.
T = 1/2 (Jm + J/n^2) psi'^2 + 1/2 m s'^2
V = 1/2 k (r psi/n - s)^2 + m g s
(Jm + J/n^2) psi'' + k r/n (r psi/n - s) = tau
m s'' - k (r psi/n - s) + m g = - b s'
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "so the drum turns by psi/n",
        "the drum then turns with psi/n.",
        "drum rotates by psi/n",
        "the drum has turned psi/n",
    ],
)
def test_a_body_that_turns_by_an_own_angle_gives_its_coordinate(said: str) -> None:
    text = OWN.replace("SAID", said)
    assert winch().check(text).right
    assert not winch().check(text.replace("k r/n (", "k r (")).right
    assert not winch().check(text.replace(said, said.replace("psi/n", "psi"))).right


def test_a_coordinate_is_no_unit_of_its_own_equation() -> None:
    rows = "(J + n^2 Jm) phi'' + k r^2 phi - k r s = n tau\nm s'' + b s' + k s - k r phi = -m g"
    values = {"k": "2500", "b": "162", "m": "50"}
    numbers = rows
    for name, value in values.items():
        numbers = numbers.replace(f"{name} s", f"{value} s")
    given = "k = 2500, b = 162, m = 50\n"
    assert winch().check(given + numbers).right
    assert not winch().check(given + numbers.replace("2500 s ", "2600 s ")).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("label", ["(i) + (ii):  ", "(ii) + (i): ", "(2) - (1): "])
def test_a_sum_of_numbers_in_front_is_a_label(label: str) -> None:
    rows = "(i)   (J + n^2 Jm) phi'' + k r (r phi - s) = n tau\n(ii)  m s'' - k (r phi - s) + m g = -b s'\n"
    solved = "s'' = (k (r phi - s) - b s')/m - g"
    assert winch().check(f"{rows}{label}{solved}").right
    assert not winch().check(f"{rows}{label}{solved.replace('- b', '+ b')}").right


def test_elements_may_be_named_behind_formulas() -> None:
    said = "S = k (r phi - s) rope, D = b s' guide\n(J + n^2 Jm) phi'' = n tau - r S\nm s'' = S - D - m g"
    assert winch().check(said).right
    assert not winch().check(said.replace("- r S", "+ r S")).right
    assert not winch().check(said.replace("k (r phi - s)", "2 k (r phi - s)")).right


@cache
def bar() -> lg.Derivation:
    """A bar between two tracks, whose name d a spring's rest length has."""
    s = lg.System("leaning bar")
    theta = s.coordinate("theta")
    m, L, d, k = s.parameters("m L d k")
    s.particle(m, at=s.point("A", (L * sp.sin(theta), 0)), name="carriage")
    s.spring(k, deflection=d - L * sp.sin(theta))
    s.force(s.input("F"), deflection=L * sp.sin(theta))
    return s.derive()


@pytest.mark.slow
@pytest.mark.parametrize(("sign", "is_right"), [("-", True), ("+", False)])
def test_an_own_length_is_differentiated_by_an_own_angle(sign: str, is_right: bool) -> None:
    said = f"""My coordinate is alpha = pi/2 - theta.
x = L cos(alpha)  ->  x' = -L sin(alpha) alpha'
Xi = F dx/dalpha = {sign}F L sin(alpha)
m L^2 sin(alpha)^2 alpha'' + m L^2 sin(alpha) cos(alpha) alpha'^2 + k L sin(alpha) (d - L cos(alpha)) = Xi
"""
    assert bar().check(said).right is is_right
