"""Energies in a letter that the system defines: L = T − V beside the length L of a rope.

Oracle: the equation of a trap door on a hinge, which a rope of the length L = 2 b cos(θ/2) holds with the force F:

    J θ̈ + c θ̇ − m g a sin θ = F b sin(θ/2)
"""

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verdict import Status

ENERGIES = "T = J theta'^2/2\nV = m g a cos(theta)\n"
EQUATION = "J theta'' + c theta' - m g a sin(theta) = F b sin(theta/2)"


@cache
def door() -> lg.Derivation:
    """A door that a rope holds, the length of which the system defines as L."""
    s = lg.System("trap door on a rope")
    theta = s.coordinate("theta")
    m, J, a, b, c, g = s.parameters("m J a b c g")
    L = s.define("L", 2 * b * sp.cos(theta / 2))
    s.particle(m, at=s.point("G", (a * sp.sin(theta), a * sp.cos(theta))), name="door")
    s.kinetic((J - m * a**2) * theta.diff() ** 2 / 2, name="rest")
    s.gravity(direction=(0, -1), g=g)
    s.damper(c, deflection=theta)
    s.force(-s.input("F"), deflection=L)
    return s.derive()


RIGHT = {
    "by names": "L = T - V",
    "written out": "L = J theta'^2/2 - m g a cos(theta)",
    "in two steps": "L = T - V = J theta'^2/2 - m g a cos(theta)",
    "with derivatives": "L = T - V\ndL/dtheta' = J theta'\ndL/dtheta = m g a sin(theta)",
    "beside the length": "L = T - V\nL = 2 b cos(theta/2)",
    "with the length alone": "L = 2 b cos(theta/2)",
}
WRONG = {
    "the sign": "L = T + V",
    "a sign of V": "L = J theta'^2/2 + m g a cos(theta)",
    "the half": "L = J theta'^2 - m g a cos(theta)",
    "a derivative": "L = T - V\ndL/dtheta = -m g a sin(theta)",
    "the length": "L = 2 b sin(theta/2)",
}


@pytest.mark.parametrize("said", RIGHT)
def test_a_lagrangian_in_the_letter_of_a_length_is_read(said: str) -> None:
    verdict = door().check(f"{ENERGIES}{RIGHT[said]}\n{EQUATION}")
    assert verdict.right
    kinds = [f.line.kind for f in verdict.findings]
    assert ("L" in kinds) == ("alone" not in said)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", WRONG)
def test_a_wrong_one_is_told(said: str) -> None:
    verdict = door().check(f"{ENERGIES}{WRONG[said]}\n{EQUATION}")
    assert verdict.status is Status.WRONG
    wrong = [f.line.number for f in verdict.findings if not f.status.right]
    assert wrong == [2 + len(WRONG[said].split("\n"))]
    told = str(verdict.mistake.what) if verdict.mistake is not None else ""
    assert said != "the sign" or "L = T* + V in place of" in told


def test_latex_too() -> None:
    said = r"$T = \frac12 J\dot\theta^2$, $V = m g a\cos\theta$, $L = T SIGN V$" + "\n\n"
    said += r"$J\ddot\theta + c\dot\theta - m g a\sin\theta = F b\sin\frac{\theta}{2}$"
    assert door().check(said.replace("SIGN", "-")).right
    assert door().check(said.replace("SIGN", "+")).status is Status.WRONG
