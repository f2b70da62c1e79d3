"""Quantities that an answer states without an argument and uses with one, J_P(θ), and relations beside numbers.

Oracle: the equation of a wheel whose centre of mass is beside its axle, which rolls; every answer has wrong twins.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from small_systems import ramp

import lagrangian as lg


@cache
def wheel() -> lg.Derivation:
    """A wheel with its centre of mass at the distance e from the axle; it rolls."""
    s = lg.System("eccentric wheel")
    x, theta = s.coordinates("x theta")
    m, J, R, e, g = s.parameters("m J R e g", m=2.0, J=0.3, R=0.5, e=0.1, g=9.81)
    speed = (x.diff() - e * theta.diff() * sp.cos(theta)) ** 2 + (e * theta.diff() * sp.sin(theta)) ** 2
    s.kinetic((m * speed + J * theta.diff() ** 2) / 2)
    s.potential(-m * g * e * sp.cos(theta))
    s.velocity_constraint(x.diff() - R * theta.diff(), name="rolling")
    return s.derive()


STATED = "J_P = J + m (R^2 + e^2 - 2 R e cos(theta))"
ROW = "J_P(theta) theta'' + m R e sin(theta) theta'^2 + m g e sin(theta) = 0"


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "answer",
    [
        f"{STATED}\n{ROW}",
        f"{STATED}\nT = 1/2 J_P(theta) theta'^2\n{ROW}",
        f"{STATED}\nJ_P(θ) θ̈ + ½ J_P′(θ) θ̇² = -m g e sin θ",
        r"\[ J_{P} = J + m (R^2 + e^2 - 2 R e \cos\theta) \]"
        r"\[ J_{P}(\theta) \ddot\theta + m R e \sin\theta \dot\theta^2 = -m g e \sin\theta \]",
    ],
)
def test_a_quantity_is_itself_with_what_it_depends_on(answer: str) -> None:
    assert wheel().check(answer, hint=0).right
    assert not wheel().check(answer.replace("2 R e", "R e"), hint=0).right
    assert not wheel().check(answer.replace("m g e", "2 m g e"), hint=0).right


def test_a_constant_times_a_coordinate_in_brackets_is_a_product() -> None:
    s = lg.System("two springs")
    x = s.coordinate("x")
    m, k1, k2 = s.parameters("m k1 k2")
    s.kinetic(m * x.diff() ** 2 / 2)
    s.potential((k1 + k2) * x**2 / 2)
    assert s.derive().check("k_g = k1 + k2\nm x'' + k_g(x) = 0", hint=0).right


NUMBERS = "(0.82 - 0.2 cos(theta)) theta'' + 0.1 sin(theta) theta'^2 + 1.962 sin(theta) = 0"


@pytest.mark.sampled(4)
@pytest.mark.parametrize("relation", ["x = R theta", "x' = R theta'", "x = 0.5 theta"])
def test_a_relation_in_letters_stands_beside_an_answer_in_numbers(relation: str) -> None:
    energies = "T = 1/2 (0.82 - 0.2 cos(theta)) theta'^2\nV = -1.962 cos(theta)"
    assert wheel().check(f"{relation}\n{energies}\n{NUMBERS}", hint=0).right
    assert not wheel().check(f"{relation}\n{energies}\n{NUMBERS.replace('1.962', '2.962')}", hint=0).right
    assert not wheel().check(f"{relation}\n{energies.replace('0.82', '0.72')}\n{NUMBERS}", hint=0).right
    wrong = relation.replace("R", "2 R").replace("0.5", "0.6")
    assert not wheel().check(f"{wrong}\n{energies}\n{NUMBERS}", hint=0).right


PLAIN = """I = J + m r(s)^2 with r = a + s cos(beta)

I θ'' + 2 m r cos β s' θ' = 0

m s'' - m r θ'^2 cos β + k s = 0"""
MARKED = r"""$I(s) = J + m\,r(s)^2$ with $r = a + s\cos\beta$.

$$I \ddot\theta + 2 m r \cos\beta \dot s \dot\theta = 0$$

$$m \ddot s - m r \dot\theta^2 \cos\beta + k s = 0$$"""


@pytest.mark.parametrize("answer", [PLAIN, MARKED])
def test_a_quantity_of_the_system_is_itself_with_its_coordinate(answer: str) -> None:
    assert ramp().check(answer).right
    assert not ramp().check(answer.replace("r(s)^2", "r(s)")).right
    assert not ramp().check(answer.replace("2 m r", "m r")).right
