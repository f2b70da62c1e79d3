"""Answers in deviations from a position at rest: p = φ − φ₀, with constants that they say or leave open.

Oracle: the equations of a hoist, from which the weights are taken by hand.
"""

from functools import cache

import pytest

import lagrangian as lg


@cache
def hoist() -> lg.Derivation:
    """A drum that lifts a weight by an elastic rope."""
    s = lg.System("hoist")
    phi, x = s.coordinates("phi x")
    J, R, m, k, d, c, g = s.parameters("J R m k d c g")
    s.rigid_body(mass=1, inertia=J, at=s.origin, frame=s.frame(phi, name="drum"), name="drum")
    s.particle(m, at=s.point("P", (0, x)), name="load")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=R * phi - x, name="rope")
    s.damper(d, deflection=R * phi - x, name="rope damping")
    s.damper(c, deflection=phi, name="bearing")
    s.torque(s.input("tau"), on=phi, name="motor")
    return s.derive()


EQUATIONS = """
J p'' + c p' + d R (R p' - y') + k R (R p - y) = u
m y'' - d (R p' - y') - k (R p - y) = 0
"""
SAID = {
    "list": "p = phi - phi0\ny = x - x0\nu = tau - tau0",
    "sentence": "Let p = phi - phi0, y = x - x0 and u = tau - tau0 be the deviations from rest.",
    "sums": "phi = phi0 + p, x = x0 + y, tau = tau0 + u",
    "with rest": "p = phi - phi_s, y = x - x_s, u = tau - tau_s\nk (R phi_s - x_s) = m g, tau_s = m g R",
    "rest in words": "In phi0, x0 it stands still with tau0:\nk (R phi0 - x0) = m g      and      tau0 = R m g\n"
    "Let p = phi - phi0, y = x - x0, u = tau - tau0 (u is the additional torque).",
}


@pytest.mark.parametrize("said", SAID)
def test_the_weights_drop_out_of_deviations(said: str) -> None:
    assert hoist().check(SAID[said] + "\n" + EQUATIONS).right
    assert not hoist().check(SAID[said] + "\n" + EQUATIONS.replace("= 0", "= -m g")).right
    assert not hoist().check(SAID[said] + "\n" + EQUATIONS.replace("- k (R", "+ k (R")).right


@pytest.mark.parametrize("said", SAID)
def test_a_mistake_in_deviations_is_named(said: str) -> None:
    verdict = hoist().check(SAID[said] + "\n" + EQUATIONS.replace("c p' + ", ""))
    assert verdict.mistake is not None
    assert verdict.mistake.element == "damper 'bearing'"


def test_a_wrong_value_at_rest_makes_the_equations_wrong() -> None:
    said = SAID["with rest"].replace("tau_s = m g R", "tau_s = 2 m g R")
    assert said != SAID["with rest"]
    assert not hoist().check(said + "\n" + EQUATIONS).right
