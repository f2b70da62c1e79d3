"""What is said beside a mistake is not what right lines of the answer refute, or what says nothing of the system.

Oracle: a crank with the inertia m l² and a slotted bar M at x = l cos φ, whose spring k pulls at x − h, by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verb import CheckedAnswer


@cache
def yoke() -> lg.Derivation:
    """A crank that stands in a vertical plane and moves a slotted bar on a spring."""
    s = lg.System("yoke")
    phi = s.coordinate("phi")
    m, M, l_, c, k, h, g = s.parameters("m M l c k h g")
    s.particle(m, at=s.point("P", (l_ * sp.cos(phi), l_ * sp.sin(phi))), name="pin")
    s.particle(M, at=s.point("B", (l_ * sp.cos(phi), 0)), name="bar")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=l_ * sp.cos(phi), rest=h, name="spring")
    s.damper(c, deflection=phi, name="bearing")
    s.torque(s.input("u"), on=phi, name="motor")
    return s.derive()


ENERGIES = """T = 1/2 m l^2 phi'^2 + 1/2 M l^2 sin(phi)^2 phi'^2
V = m g l sin(phi) + 1/2 k (l cos(phi){rest})^2
L = T - V
Xi_phi = u - c phi'
∂L/∂phi' = (m l^2 + M l^2 sin(phi)^2) phi'
d/dt ∂L/∂phi' = (m l^2 + M l^2 sin(phi)^2) phi'' + {twice}M l^2 sin(phi) cos(phi) phi'^2
d/dt ∂L/∂phi' - ∂L/∂phi = Xi_phi"""


def checked(rest: str = " - h", twice: str = "2 ") -> CheckedAnswer:
    return yoke().check(ENERGIES.format(rest=rest, twice=twice))


def wrong(verdict: CheckedAnswer) -> set[int]:
    return {f.line.number for f in verdict.findings if f.status.value == "wrong"}


def test_general_lines_are_not_called_wrong_below_a_wrong_energy() -> None:
    assert not wrong(checked())
    assert wrong(checked(rest="")) == {2, 3}  # L = T - V follows
    [mistake] = checked(rest="").mistakes
    assert "h" in str(mistake.what)


@pytest.mark.parametrize("line", ["L = T + V", "d/dt ∂L/∂phi' + ∂L/∂phi = Xi_phi"])
def test_a_general_line_that_is_wrong_itself_is_called_wrong(line: str) -> None:
    old = "L = T - V" if line.startswith("L") else "d/dt ∂L/∂phi' - ∂L/∂phi = Xi_phi"
    verdict = yoke().check(ENERGIES.format(rest=" - h", twice="2 ").replace(old, line))
    assert not verdict.right and wrong(verdict)


def test_a_lost_factor_in_a_derivative_has_no_lost_products_for_a_reason() -> None:
    [mistake] = checked(twice="").mistakes
    assert "the factor 2 is missing" in str(mistake.what) and "reason" not in str(mistake.what)


def test_what_would_be_wrong_of_weights_and_springs_is_not_asked_where_one_differs() -> None:
    row = "(m l^2 + M l^2 sin(phi)^2) phi'' + M l^2 sin(phi) cos(phi) phi'^2 + m g l cos(phi)"
    verdict = yoke().check(f"{row} - k l cos(phi) l sin(phi) = u - c phi'")
    assert not verdict.right and "weights and springs" not in str(verdict)


def test_all_weights_are_not_missing_where_one_is() -> None:
    s = lg.System("two")
    phi = s.coordinate("phi")
    m, M, l_, g, k = s.parameters("m M l g k")
    s.particle(m, at=s.point("P", (l_ * sp.sin(phi), -l_ * sp.cos(phi))), name="one")
    s.particle(M, at=s.point("Q", (2 * l_ * sp.sin(phi), -2 * l_ * sp.cos(phi))), name="other")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=phi, name="spring")
    verdict = s.derive().check("T = 1/2 m l^2 phi'^2 + 2 M l^2 phi'^2\nV = -m g l cos(phi) + 1/2 k phi^2")
    told = [str(m.what) for m in verdict.mistakes]
    assert told and not any(x.startswith("Gravity is missing") for x in told)
