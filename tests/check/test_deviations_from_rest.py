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


@pytest.mark.sampled(6)
@pytest.mark.parametrize("said", SAID)
def test_the_weights_drop_out_of_deviations(said: str) -> None:
    assert hoist().check(SAID[said] + "\n" + EQUATIONS).right
    assert not hoist().check(SAID[said] + "\n" + EQUATIONS.replace("= 0", "= -m g")).right
    assert not hoist().check(SAID[said] + "\n" + EQUATIONS.replace("- k (R", "+ k (R")).right


@pytest.mark.sampled(3)
@pytest.mark.parametrize("said", SAID)
def test_a_mistake_in_deviations_is_named(said: str) -> None:
    verdict = hoist().check(SAID[said] + "\n" + EQUATIONS.replace("c p' + ", ""))
    assert verdict.mistake is not None
    assert verdict.mistake.element == "damper 'bearing'"


def test_a_wrong_value_at_rest_makes_the_equations_wrong() -> None:
    said = SAID["with rest"].replace("tau_s = m g R", "tau_s = 2 m g R")
    assert said != SAID["with rest"]
    assert not hoist().check(said + "\n" + EQUATIONS).right


IN_WORDS = {
    "tilde": "Let $\\tilde\\varphi$ and $\\tilde x$ be the deviations from the position of rest and "
    "$\\tilde\\tau=\\tau-mgR$.\n",
    "Delta": "$\\Delta\\varphi$ and $\\Delta x$ are the deviations from equilibrium, $\\tilde\\tau=\\tau-mgR$.\n",
}
LATEX = r"""\begin{align*}
J\ddot{\tilde\varphi}+c\dot{\tilde\varphi}+dR(R\dot{\tilde\varphi}-\dot{\tilde x})
+kR(R\tilde\varphi-\tilde x)&=\tilde\tau\\
m\ddot{\tilde x}-d(R\dot{\tilde\varphi}-\dot{\tilde x})-k(R\tilde\varphi-\tilde x)&=0
\end{align*}"""


@pytest.mark.parametrize("said", IN_WORDS)
def test_words_say_that_marked_letters_are_deviations(said: str) -> None:
    written = IN_WORDS[said] + LATEX
    if said == "Delta":
        for letter in ("\\varphi", "x"):
            for dots in ("\\ddot", "\\dot"):
                written = written.replace(
                    f"{dots}{{\\tilde{letter}}}" if letter != "x" else f"{dots}{{\\tilde x}}",
                    f"\\Delta{dots}{{{letter}}}",
                )
            written = written.replace(f"\\tilde{letter}" if letter != "x" else "\\tilde x", f"\\Delta {letter}")
    assert hoist().check(written).right
    assert "-k(R" in written
    assert not hoist().check(written.replace("-k(R", "+k(R")).right


def test_letters_are_listed_with_their_coordinates() -> None:
    said = "With the deviations p, y of phi, x from the position of rest and u = tau - m g R:\n"
    assert hoist().check(said + EQUATIONS).right
    assert not hoist().check(said.replace("of phi, x", "of x, phi") + EQUATIONS).right


def test_the_work_of_a_holding_torque_is_in_the_potential_energy() -> None:
    said = "Let p = phi - phi0, y = x - x0 and u = tau - m g R be the deviations from rest.\n"
    energies = "T = J p'^2/2 + m y'^2/2\nV = k (R p - y)^2/2\nD = d (R p' - y')^2/2 + c p'^2/2\n"
    assert hoist().check(said + energies + EQUATIONS).right
    assert not hoist().check(said + energies.replace("k (R p - y)^2/2", "k (R p - y)^2/2 + m g y") + EQUATIONS).right
