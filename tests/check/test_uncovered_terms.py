"""A term of a derivative that no mistake speaks of is told as one of its own, and no other one is.

Oracle: an upright bob on an axle, with a spring at the arm a that is stretched by e; its energies and forces by hand.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

import lagrangian as lg
from lagrangian.check.verdict import Verdict


@cache
def beater() -> lg.Derivation:
    """A bob that stands up on a rod, a spring and a damper at the axle, and a torque."""
    s = lg.System("beater")
    theta = s.coordinate("theta")
    m, length, g, k, e, a, b = s.parameters("m l g k e a b")
    s.particle(m, at=s.point("P", (length * sp.sin(theta), length * sp.cos(theta))), name="bob")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=e + a * theta, name="return spring")
    s.damper(b, deflection=theta, name="axle")
    s.torque(s.input("u"), on=theta, name="drive")
    return s.derive()


LINES = """\
T = 1/2 m l^2 theta'^2
V = {weight} m g l cos(theta) + 1/2 k (e + a theta)^2
Xi_theta = {force}
dL/dtheta = {pull} m g l sin(theta) - k {arm}(e + a theta)"""


def answer(weight: str = "", force: str = "u - b theta'", pull: str = "", arm: str = "a ") -> str:
    return LINES.format(weight=weight, force=force, pull=pull, arm=arm)


def told(verdict: Verdict) -> list[str]:
    return [str(m.what) for m in verdict.mistakes]


def test_a_factor_that_is_lost_in_a_derivative_is_told_beside_a_wrong_energy() -> None:
    assert "not right" not in str(beater().check(answer()))
    both = told(beater().check(answer(weight="-", pull="-", arm="")))
    assert len(both) == 2 and "weight" in both[0] and both[1].startswith("In line 4") and "k" in both[1]


def test_what_follows_is_not_told_again() -> None:
    """The weight in ∂L/∂θ follows from V."""
    alone = told(beater().check(answer(weight="-", pull="-")))
    assert len(alone) == 1 and "weight" in alone[0]


def test_what_follows_from_a_wrong_velocity_is_not_told_as_its_own() -> None:
    """The force that a wrong rate of a place leads to is no second mistake."""
    lines = (
        "y = l cos(theta)\ny' = -l cos(theta) theta'\nT = 1/2 m l^2 theta'^2\nV = m g l cos(theta)"
        " + 1/2 k (e + a theta)^2\nXi_theta = u - b theta'\ndL/dtheta = m g l cos(theta) - k a (e + a theta)"
    )
    assert not any(x.startswith("In line 6") for x in told(beater().check(lines))[1:])


def test_a_single_mistake_stays_alone() -> None:
    assert len(told(beater().check(answer(arm="")))) == 1
    assert len(told(beater().check(answer(force="u")))) == 1
