"""What is said to be missing is not written, and what is said of a virtual work is said of one coordinate.

Oracle: a wagon on a slope with a pendulum; an arm on a turntable; both with their equations by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verdict import Verdict


@cache
def wagon() -> lg.Derivation:
    """A wagon with a pendulum on a slope; x is counted upwards along the slope."""
    s = lg.System("wagon on a slope")
    x, theta = s.coordinates("x theta")
    M, m, length, alpha, g, b = s.parameters("M m l alpha g b")
    s.particle(M, at=s.point("W", (x, 0)), name="wagon")
    s.particle(m, at=s.point("B", (x + length * sp.sin(theta), -length * sp.cos(theta))), name="bob")
    s.gravity(direction=(-sp.sin(alpha), -sp.cos(alpha)), g=g)
    s.damper(b, deflection=theta, name="hinge")
    s.force(s.input("F"), deflection=x, name="pull")
    return s.derive()


T = "T = 1/2 M x'^2 + 1/2 m ((x' + l theta' cos(theta))^2 + l^2 theta'^2 sin(theta)^2)"
V = "V = M g x sin(alpha) + m g {bob} - m g l cos(theta) cos(alpha)"


def told(verdict: Verdict) -> str:
    return " ".join(str(verdict).split())


def test_not_all_terms_are_missing_where_one_is_written() -> None:
    """The height of the bob lacks x, and has l sin θ sin α."""
    lines = f"{T}\n{V}\nXi_x = F\nXi_theta = -b theta'"
    assert told(wagon().check(lines.format(bob="(x + l sin(theta)) sin(alpha)"))).count("not right") == 0
    said = told(wagon().check(lines.format(bob="l sin(theta) sin(alpha)")))
    assert "The terms with m g sin α" not in said
    assert "m g x sin α" in said


def test_all_terms_are_missing_where_none_is_written() -> None:
    said = told(wagon().check(f"{T}\nV = M g x sin(alpha)\nXi_x = F\nXi_theta = -b theta'"))
    assert "Not all terms" not in said and "missing" in said


@pytest.mark.parametrize("work", ["F δx - F δtheta - b theta' δtheta", "F δx - b theta' δtheta - F δtheta"])
def test_a_virtual_work_is_not_named_for_the_force_on_a_coordinate(work: str) -> None:
    """The pull belongs in δW, with δx: it is in the force on θ that it does not belong."""
    verdict = wagon().check(f"{T}\n{V.format(bob='(x + l sin(theta)) sin(alpha)')}\nδW = {work}")
    assert not verdict.right
    assert "counted in δW" not in told(verdict)
    assert "the Ξ of θ as well" in told(verdict)


@cache
def arm() -> lg.Derivation:
    """An arm with a bob, on the pin of a turntable."""
    s = lg.System("arm on a turntable")
    psi, beta = s.coordinates("psi beta")
    J, m, R, e, b = s.parameters("J m R e b")
    s.kinetic(J * psi.diff() ** 2 / 2, name="turntable")
    place = (R * sp.cos(psi) + e * sp.cos(psi + beta), R * sp.sin(psi) + e * sp.sin(psi + beta))
    s.particle(m, at=s.point("P", place), name="bob")
    s.damper(b, deflection=beta, name="pin")
    return s.derive()


def test_whole_terms_are_missing_and_not_a_letter_in_them() -> None:
    """The moments about the pin without what the pin's own acceleration adds."""
    first = (
        "(J + m R^2 + m e^2 + 2 m R e cos(beta)) psi'' + (m e^2 + m R e cos(beta)) beta''"
        " - m R e sin(beta) (2 psi' beta' + beta'^2) = 0"
    )
    whole = "m e^2 (psi'' + beta'') + m R e (psi'' cos(beta) + psi'^2 sin(beta)) = -b beta'"
    assert arm().check(f"{first}\n{whole}").right
    verdict = arm().check(f"{first}\nm e^2 (psi'' + beta'') = -b beta'")
    assert "left out" not in told(verdict)
    assert "the terms with R are missing" in told(verdict)
