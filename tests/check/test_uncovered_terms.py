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


@cache
def hoist() -> lg.Derivation:
    """A drum with a motor and a bearing, a block on its rope, and a load that hangs from it on a spring."""
    s = lg.System("hoist")
    phi, y = s.coordinates("phi y")
    J, m, M, r, g, k, b = s.parameters("J m M r g k b")
    s.rigid_body(mass=1, inertia=J, at=s.origin, frame=s.frame(phi, name="drum"), name="drum")
    s.particle(m, at=s.point("Y", (0, -y)), name="load")
    s.gravity(direction=(0, -1), g=g)
    s.particle(M, at=s.point("B", (0, r * phi)), name="block")
    s.spring(k, deflection=y - r * phi, name="sling")
    s.damper(b, deflection=phi, name="bearing")
    s.torque(s.input("u"), on=phi, name="motor")
    return s.derive()


BALANCES = """F = k (y {sign} r phi)
m y'' = m g - F
M r phi'' = S - M g
J phi'' = u + F r - S r{damper}
(J + M r^2) phi'' = u - M g r + k r (y {sign} r phi){damper}"""


def balances(sign: str = "-", damper: str = " - b phi'") -> str:
    return BALANCES.format(sign=sign, damper=damper)


def test_an_element_of_which_an_equation_has_nothing_is_told_beside_a_wrong_force() -> None:
    assert hoist().check(balances()).right
    force, damper = told(hoist().check(balances(sign="+", damper="")))
    assert force.startswith("Line 1 is not right") and ("bearing" in damper or "b*phi'" in damper)


def test_an_element_of_which_something_is_there_or_that_is_told_is_not_told_again() -> None:
    assert len(told(hoist().check(balances(sign="+")))) == 1
    assert len(told(hoist().check(balances(damper="")))) == 1
    assert not any("missing" in x for x in told(hoist().check(balances(sign="+", damper=" + b phi'"))))


@cache
def press() -> lg.Derivation:
    """A lever with a torsion spring whose pin at a lifts a plate."""
    s = lg.System("press")
    theta = s.coordinate("theta")
    M, J, a, g, k, q = s.parameters("M J a g k q")
    s.rigid_body(mass=1, inertia=J, at=s.origin, frame=s.frame(theta, name="lever"), name="lever")
    s.particle(M, at=s.point("Y", (0, a * sp.sin(theta))), name="plate")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=theta - q, name="torsion spring")
    return s.derive()


PLATE = """y = a sin(theta)
y'' = a cos(theta) theta'' {sign} a sin(theta) theta'^2
M y'' = S - M g
J theta'' = -S a cos(theta){spring}
(J + M a^2 cos(theta)^2) theta'' {sign} M a^2 sin(theta) cos(theta) theta'^2 + M g a cos(theta){left} = 0"""


def plate(sign: str = "-", spring: str = " - k (theta - q)", left: str = " + k (theta - q)") -> str:
    return PLATE.format(sign=sign, spring=spring, left=left)


def test_a_wrong_second_rate_is_told_before_a_wrong_balance_below_it() -> None:
    assert press().check(plate()).right
    rate, spring = told(press().check(plate(sign="+", spring="", left="")))
    assert rate == "In line 2, the term a*sin(theta)*theta'^2 has the wrong sign."
    assert spring.startswith("In line 4") and "torsion spring" in spring


def test_a_wrong_rate_and_a_wrong_balance_alone_are_told_alone() -> None:
    for answer in (plate(sign="+"), plate(spring="", left="")):
        assert len(told(press().check(answer))) == 1
