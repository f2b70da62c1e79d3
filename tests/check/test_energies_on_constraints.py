"""Energies and slopes with a constraint put in that is linear in no coordinate: a sin α = b sin β.

Oracle: with u = β̇/α̇ = a cos α/(b cos β), T* = ½ (I + m a² cos² α + J u²) α̇², and du/dα = −u tan α + u² tan β where β
moves with α.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg


@cache
def lid() -> lg.Derivation:
    """A lever that lifts a rod, and the rod a lid."""
    system = lg.System("lever and lid")
    alpha, beta = system.coordinates("alpha beta")
    inertia, m, a, J, M, s, b, g = system.parameters("I m a J M s b g")
    height = a * sp.sin(alpha)
    system.kinetic(inertia * alpha.diff() ** 2 / 2)
    system.kinetic(m * (a * sp.cos(alpha) * alpha.diff()) ** 2 / 2)
    system.kinetic(J * beta.diff() ** 2 / 2)
    system.potential(m * g * height + M * g * s * sp.sin(beta))
    system.force(system.input("P"), deflection=alpha)
    system.constraint(height - b * sp.sin(beta), name="rod on lid")
    return system.derive()


RATIO = "u = a cos(alpha)/(b cos(beta)), beta' = u alpha'\n"
ENERGIES = "T = 1/2 (I + m a^2 cos(alpha)^2 + J u^2) alpha'^2\nV = m g a sin(alpha) + M g s a/b sin(alpha)\n"
SLOPE = "du/dalpha = -u tan(alpha) + u^2 tan(beta)\n"
ROW = (
    "(I + m a^2 cos(alpha)^2 + J u^2) alpha'' + (J u (u^2 tan(beta) - u tan(alpha))"
    " - m a^2 sin(alpha) cos(alpha)) alpha'^2 + (m g a + M g s a/b) cos(alpha) = P"
)
ANSWER = RATIO + SLOPE + ENERGIES + ROW


def test_energies_and_a_slope_with_the_constraint_put_in_are_right() -> None:
    assert lid().check(RATIO.partition(",")[0] + "\n" + ENERGIES, hint=0).right
    assert lid().check(ANSWER, hint=0).right
    assert lid().check(ANSWER.replace("V = m g a sin(alpha)", "V = m g b sin(beta)"), hint=0).right
    latex = r"\frac{\mathrm{d}u}{\mathrm{d}\alpha} = -u\tan\alpha + u^2\tan\beta"
    tex = r"u = \frac{a\cos\alpha}{b\cos\beta}"
    assert lid().check(f"${tex}$\n\n${latex}$\n\n{ROW}", hint=0).right


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("written", "instead"),
    [
        ("+ J u^2) alpha'^2", "+ J u) alpha'^2"),
        ("+ J u^2) alpha'^2", "+ 2 J u^2) alpha'^2"),
        ("M g s a/b sin", "M g s b/a sin"),
        ("V = m g a sin(alpha)", "V = m g a sin(beta)"),
        ("-u tan(alpha) + u^2 tan(beta)\n", "-u tan(alpha) - u^2 tan(beta)\n"),
        ("-u tan(alpha) + u^2 tan(beta)\n", "-u tan(alpha) + u tan(beta)\n"),
        ("du/dalpha", "du/dbeta"),
    ],
)
def test_wrong_energies_and_slopes_stay_wrong(written: str, instead: str) -> None:
    assert written in ANSWER
    assert not lid().check(ANSWER.replace(written, instead), hint=0).right


THREE = """y - a sin(alpha) = 0 and y - b sin(beta) = 0
T = 1/2 I alpha'^2 + 1/2 m y'^2 + 1/2 J beta'^2
V = m g y + M g s sin(beta)
m y'' + m g = lambda1 + lambda2
I alpha'' = P - lambda1 a cos(alpha)
J beta'' + M g s cos(beta) = -lambda2 b cos(beta)
y = a sin(alpha)
y = b sin(beta)"""


def test_a_third_coordinate_with_two_constraints_is_right() -> None:
    assert lid().check(THREE, hint=0).right


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("written", "instead"),
    [
        ("lambda1 + lambda2", "lambda1 - lambda2"),
        ("- lambda1 a cos(alpha)", "- lambda1 a sin(alpha)"),
        ("-lambda2 b cos(beta)", "-lambda2 cos(beta)"),
        ("m y'' + m g", "m y''"),
        ("1/2 m y'^2", "m y'^2"),
        ("V = m g y", "V = -m g y"),
        ("y = b sin(beta)", "y = b cos(beta)"),
    ],
)
def test_a_mistake_beside_a_third_coordinate_stays_wrong(written: str, instead: str) -> None:
    assert written in THREE
    assert not lid().check(THREE.replace(written, instead), hint=0).right
