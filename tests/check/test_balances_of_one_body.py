"""Balances of single bodies are told by their own Newton and Euler equations, names by those of the answer.

Oracle: equations by hand of a trolley with two equal rods that swing in opposite senses, and of a camera on the axis of
a rotor in a fork that turns.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg


@cache
def trolley() -> lg.Derivation:
    """A trolley M on a spring k, and two rods m, J, with their centres at a, at the angles φ and −φ; a slider n on it,
    pushed from the trolley with F."""
    s = lg.System("trolley with rods")
    x, u, phi = s.coordinates("x u phi")
    M, n, m, J, a, k = s.parameters("M n m J a k")
    s.particle(M, at=s.point("T", (x, 0)), name="trolley")
    s.particle(n, at=s.point("S", (x + u, 0)), name="slider")
    for sign, name in ((1, "front rod"), (-1, "back rod")):
        at = s.point(f"G{name[0]}", (x + a * sp.sin(phi), sign * a * sp.cos(phi)))
        s.rigid_body(m, inertia=J, at=at, frame=s.frame(sign * phi, name=name[:5].strip()), name=name)
    s.spring(k=k, deflection=x)
    F, tau = s.inputs("F tau")
    s.force(F, deflection=u)
    s.torque(tau, on=phi)
    return s.derive()


RODS = """rod, x: m (x'' + a phi'' cos(phi) - a phi'^2 sin(phi)) = H
slider: n (x'' + u'') = F
trolley: M x'' = -k x - F - 2 H
rods about their hinges: 2 (J + m a^2) phi'' + 2 m a x'' cos(phi) = tau
M x'' + 2 m (x'' + a phi'' cos(phi) - a phi'^2 sin(phi)) + k x + F = 0"""
LACKING = RODS.replace(" - F - 2 H", " - F").replace(" + 2 m (x'' + a phi'' cos(phi) - a phi'^2 sin(phi))", "")


def told(derivation: lg.Derivation, answer: str) -> str:
    verdict = derivation.check(answer)
    assert not verdict.right
    return " ".join(verdict.to_text().split())


@pytest.mark.slow
def test_right_balances_are_right() -> None:
    assert trolley().check(RODS).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("title", ["trolley: ", "trolley, forces along x: ", ""])
def test_a_reaction_that_is_not_drawn(title: str) -> None:
    page = told(trolley(), LACKING.replace("trolley: ", title))
    assert "In line 3, on the right-hand side, the term −2 H is missing." in page
    assert "line 5 not right, but only because of line 3" in page
    assert "does not belong" not in page


def test_a_reaction_is_the_one_that_the_other_balance_gives() -> None:
    page = told(trolley(), LACKING.replace("= H", "= -H"))
    assert "In line 3, on the right-hand side, the term 2 H is missing." in page


def test_a_balance_with_another_mistake_lacks_no_reaction() -> None:
    page = told(trolley(), LACKING.replace("= -k x - F", "= -2 k x - F").replace("+ k x", "+ 2 k x"))
    assert "H is missing" not in page


def test_a_balance_of_one_body_is_not_compared_with_the_equation_of_all() -> None:
    rows = LACKING.split("\n", 1)[1].replace("M x'' = -k x", "M x'' = -2 k x").rsplit("\n", 1)[0]
    page = told(trolley(), rows)
    assert "Line 2, the balance of particle 'trolley', does not hold." in page
    assert "does not belong" not in page and "comes from" not in page


def test_a_mass_that_is_counted_twice_does_not_belong() -> None:
    wrong = RODS.replace("trolley: M x''", "trolley: (M + n) x''").replace("\nM x''", "\n(M + n) x''")
    assert "the term n ẍ does not belong there" in told(trolley(), wrong)


@cache
def rotor() -> lg.Derivation:
    """A rotor A, B, B in a fork that turns by ψ, tilted by θ, with a camera m at a on its axis, all beside the vertical
    by e."""
    s = lg.System("rotor in a fork")
    psi, theta = s.coordinates("psi theta")
    A, B, C, M, m, a, e, c = s.parameters("A B C M m a e c")
    fork = s.frame(psi, axis=(0, 0, 1), name="fork")
    tilted = s.frame(theta, axis=(0, -1, 0), parent=fork, name="rotor")
    middle = s.point("O", (0, e, 0), frame=fork)
    s.rigid_body(M, inertia=(A, B, B), at=middle, frame=tilted, name="rotor")
    s.particle(m, at=s.point("K", (a, 0, 0), relative_to=middle, frame=tilted), name="camera")
    s.kinetic(C * psi.diff() ** 2 / 2, name="fork")
    s.damper(c, deflection=theta)
    s.torque(s.inputs("tau"), on=theta)
    return s.derive()


TILT = "(B + m*a^2)*theta'' + m*a*e*psi''*sin(theta) + (m*a^2{})*psi'^2*sin(theta)*cos(theta) = tau - c*theta'"
EULER = f"""w1 = psi'*sin(theta)
w2 = -theta'
w3 = psi'*cos(theta)
-N = B*w2' - (B - A)*w3*w1
N = tau - c*theta' - m*a^2*theta'' - m*a^2*psi'^2*sin(theta)*cos(theta) - m*a*e*psi''*sin(theta)
L = (C + (M + m)*e^2 + A*sin(theta)^2 + (B + m*a^2)*cos(theta)^2)*psi' + m*a*e*theta'*sin(theta)
L' = 0
{TILT.format(" + B - A")}"""
SHORT = EULER.replace(" - (B - A)*w3*w1", "").replace(" + B - A)*psi'^2", ")*psi'^2")


@pytest.mark.slow
def test_euler_s_equation_without_its_gyroscopic_term() -> None:
    assert rotor().check(EULER).right
    for added in ("", "\nN = B*theta''"):
        first, second = SHORT.split("\nN = ", 1)
        page = told(rotor(), f"{first}{added}\nN = {second}")
        assert "In line 4, on the right-hand side, the term (A − B) ψ̇² sin θ cos θ is missing." in page
        assert "line 4 right" not in page


T_CAMERA = "m/2*((e^2 + a^2*cos(theta)^2)*psi'^2 + a^2*theta'^2 {} 2*a*e*psi'*theta'*sin(theta))"
SPEED = """v = ({} - a*theta'*sin(theta), a*psi'*cos(theta), a*theta'*cos(theta))
T = (C + M*e^2)/2*psi'^2 + (A*sin(theta)^2 + B*cos(theta)^2)/2*psi'^2 + B/2*theta'^2 + {}"""


def test_a_velocity_along_axes_that_turn_is_compared_along_these() -> None:
    page = told(rotor(), SPEED.format("e*psi'", T_CAMERA.format("-")))
    assert "along the axes of fork is (−e ψ̇ − a θ̇ sin θ, a ψ̇ cos θ, a θ̇ cos θ)" in page
    assert "the term e ψ̇ has the wrong sign" in page


SOLVED = """M11 = C + (M + m)*e^2 + A*sin(theta)^2 + (B + m*a^2)*cos(theta)^2
M12 = m*a*e*sin(theta)
M22 = B + m*a^2
r1 = 2*(B - A + m*a^2)*psi'*theta'*sin(theta)*cos(theta) - m*a*e*theta'^2*cos(theta)
r2 = tau - c*theta' - (B - A + m*a^2)*psi'^2*sin(theta)*cos(theta)
M11*psi'' + M12*theta'' = r1
M12*psi'' + M22*theta'' = r2
D = M11*M22 - M12^2
psi'' = (M22*r1 - M12*r2)/D
theta'' = (M11*r2 - M12*r1)/D"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong", "said"),
    [
        ("(M11*r2 - M12*r1)", "(M22*r2 - M12*r1)", "In line 10, M₂₂ r₂ should be M₁₁ r₂."),
        ("(M22*r1 - M12*r2)", "(M11*r1 - M12*r2)", "In line 9, M₁₁ r₁ should be M₂₂ r₁."),
        ("(M11*r2 - M12*r1)", "(M11*r2 + M12*r1)", "has the wrong sign."),
    ],
)
def test_a_name_for_another_one_in_what_was_solved(right: str, wrong: str, said: str) -> None:
    assert rotor().check(SOLVED).right
    assert said in told(rotor(), SOLVED.replace(right, wrong))


COMPONENTS = """ax = -a*theta''*sin(theta) - a*theta'^2*cos(theta) - e*psi'' - a*psi'^2*cos(theta)
moment of the camera's inertia force about the tilted axis: m*ax*a*sin(theta)
(C + (M + m)*e^2 + A*sin(theta)^2 + (B + m*a^2)*cos(theta)^2)*psi'' \
- 2*(B + m*a^2 - A)*psi'*theta'*sin(theta)*cos(theta) \
+ m*a*e*theta''*sin(theta) + m*a*e*theta'^2*cos(theta) = 0
"""


@pytest.mark.slow
def test_a_moment_of_an_acceleration_that_has_a_name() -> None:
    answer = COMPONENTS + TILT.format(" + B - A")
    assert rotor().check(answer).right
    wrong = answer.replace("C + (M + m)*e^2 +", "C + M*e^2 +").replace(
        "+ m*a*e*theta''*sin(theta) + m*a*e*theta'^2*cos(theta) = 0", "- m*a*e*psi'^2*cos(theta) = 0"
    )
    assert "the term −m e ax is missing" in told(rotor(), wrong)
    assert "ax is missing" not in told(rotor(), answer.replace("C + (M + m)*e^2 +", "C + M*e^2 +"))


def test_what_is_advised_fits_the_term() -> None:
    answer = COMPONENTS + TILT.format(" + B - A")
    for right, wrong, advice in (
        ("m*a*e*theta''*sin(theta) +", "2*m*a*e*theta''*sin(theta) +", "Such a factor couples two coordinates"),
        ("(B + m*a^2)*theta''", "2*(B + m*a^2)*theta''", "What stands before an acceleration is a mass"),
        ("theta'^2*cos(theta) = 0", "theta'^2*cos(theta)/2 = 0", "The square of one rate comes from"),
    ):
        assert right in answer
        assert advice in told(rotor(), answer.replace(right, wrong))


def test_an_energy_that_lacks_a_term_is_a_part() -> None:
    page = told(rotor(), f"T_rotor = M*e^2*psi'^2/2 + B/2*(theta'^2 + psi'^2*cos(theta)^2)\n{TILT.format(' + B')}")
    assert "nor a part of it" not in page and "something is missing in it" in page
