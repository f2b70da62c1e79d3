"""A wrong rate of a name of the answer's own is the mistake, and what holds with it follows from it.

Oracle: by hand, I = J + m r² has the rate 2 m r ṙ; a bob is at x + l sin φ.
"""

from __future__ import annotations

import pytest
import sympy as sp
from small_systems import cart, ramp, rod

import lagrangian as lg
from lagrangian.check.verb import CheckedAnswer

ROD = """I = J + m r^2
d/dt [I phi'] = M
I' = 2 m r r'
I phi'' + 2 m r r' phi' = M
m r'' - m r phi'^2 + k (r - a) = 0"""
CART = """x_B = x + l sin(phi), y_B = -l cos(phi)
x_B' = x' + l phi' cos(phi), y_B' = l phi' sin(phi)
x_B'^2 + y_B'^2 = x'^2 + 2 l x' phi' cos(phi) + l^2 phi'^2
T = 1/2 M x'^2 + 1/2 m (x'^2 + 2 l x' phi' cos(phi) + l^2 phi'^2)
V = 1/2 k x^2 - m g l cos(phi)
(M + m) x'' + m l phi'' cos(phi) - m l phi'^2 sin(phi) + k x = 0
m l^2 phi'' + m l x'' cos(phi) + m g l sin(phi) = 0"""


def wrong(system: lg.Derivation, answer: str) -> tuple[CheckedAnswer, dict[int, bool]]:
    """The verdict on a wrong answer, and its wrong lines with whether they follow."""
    verdict = system.check(answer)
    assert not verdict.right
    return verdict, {f.line.number: f.follows for f in verdict.findings if not f.status.right}


def test_a_term_of_a_rate_is_told_and_the_equation_follows() -> None:
    assert rod().check(ROD).right
    verdict, lines = wrong(rod(), ROD.replace("2 m r", "m r"))
    assert lines == {3: False, 4: True}
    assert "in the term m*r*r', the factor 2 is missing" in str(verdict.mistakes[0].what).replace("Derivative", "")
    assert len(verdict.mistakes) == 1


def test_an_equation_that_is_wrong_otherwise_does_not_follow() -> None:
    _, lines = wrong(rod(), ROD.replace("I' = 2 m r", "I' = m r").replace("= M\nm r''", "= -M\nm r''"))
    assert lines == {3: False, 4: False}


@pytest.mark.slow
@pytest.mark.parametrize("stated", ["", "wrong speed alone"])
def test_a_squared_speed_is_no_equation_of_motion(stated: str) -> None:
    assert cart().check(CART).right
    answer = CART.replace("+ 2 l x' phi' cos", "- 2 l x' phi' cos").replace("m l phi'' cos", "-m l phi'' cos")
    answer = answer.replace("m l x'' cos", "-m l x'' cos").replace("- m l phi'^2", "+ m l phi'^2").replace("+ -", "- ")
    answer = answer if stated else answer.replace("x_B' = x' +", "x_B' = x' -")
    verdict, lines = wrong(cart(), answer)
    root = 3 if stated else 2
    assert lines == (
        {3: False, 4: True, 6: True, 7: True} if stated else {2: False, 3: True, 4: True, 6: True, 7: True}
    )
    told = [d for f in verdict.findings if f.line.number == 3 for d in f.differences]
    assert not any(d.origins for d in told) and len(told) == bool(stated)
    said = " ".join(str(verdict).split())
    assert f"Look at line {root}: that is the first that is not right." in said
    assert "spring" not in said and "gravity" not in said


RAMP = """r(s) = a + s cos(beta), r_s = ∂r/∂s = cos(beta)
L = 1/2 J theta'^2 + 1/2 m (s'^2 + r^2 theta'^2) - 1/2 k s^2
∂L/∂s = m r r_s theta'^2 - k s = m r cos(beta) theta'^2 - k s
m s'' - m r cos(beta) theta'^2 + k s = 0
(J + m r^2) theta'' + 2 m r cos(beta) s' theta' = 0"""


def test_a_name_with_two_values_is_wrong_where_one_of_them_follows() -> None:
    assert ramp().check(RAMP).right
    first = RAMP.split("\n")[0]
    slope = RAMP.replace("= cos(beta)\n", "= 1\n").replace("m r cos(beta)", "m r")
    assert slope.startswith(first.replace("= cos(beta)", "= 1"))
    verdict, lines = wrong(ramp(), slope)
    assert lines == {1: False, 3: True, 4: True, 5: True}
    assert str(verdict.mistakes[0].what) == "Line 1 is not right: cos(beta) is not 1."
    _, lines = wrong(ramp(), slope.replace("- k s\n", "- 2 k s\n"))
    assert lines[3] is False


def test_small_angles_are_no_contradiction() -> None:
    """cos φ = 1 of a coordinate may be meant as a linearization, of which nothing is said."""
    verdict = cart().check("c = cos(phi) = 1\n" + CART.split("\n", 3)[3])
    assert not any(f.line.number == 1 and not f.status.right for f in verdict.findings)


SLOPES = """T = 1/2 M x'^2 + 1/2 m (x'^2 + 2 l x' phi' cos(phi) + l^2 phi'^2)
V = 1/2 k x^2 - m g l cos(phi)
dV/dx = k x
dV/dphi = m g l sin(phi)
(M + m) x'' + m l phi'' cos(phi) - m l phi'^2 sin(phi) + dV/dx = 0
m l^2 phi'' + m l x'' cos(phi) + dV/dphi = 0"""


def test_equations_that_name_a_wrong_slope_are_not_called_right_first() -> None:
    assert cart().check(SLOPES).right
    said = " ".join(str(cart().check(SLOPES.replace("m g l sin(phi)", "m g l cos(phi)"))).split())
    assert "Look at line 4: that is the first that is not right." in said
    assert "Your equations of motion are right" not in said


def test_no_terms_of_another_equation_are_told_of_one_that_is_solved() -> None:
    rows = "\n".join(CART.split("\n")[3:])
    solved = "\n(M + m sin(phi)^2) x'' - m g sin(phi) cos(phi) - m l phi'^2 sin(phi) + k x = 0"
    assert cart().check(rows + solved).right
    verdict, lines = wrong(cart(), rows + solved.replace("- m l phi'^2", "+ m l phi'^2"))
    assert lines == {5: False} or lines == {6: False}, lines
    assert str(verdict.mistakes[0].what).startswith("In what is solved for x'' alone: ")
    assert "phi''" not in str(verdict).split("Line by line")[1]


def test_a_dissipation_with_the_square_of_a_wrong_rate_follows() -> None:
    s = lg.System("plunger")
    phi = s.coordinate("phi")
    J, m, r, b = s.parameters("J m r b")
    x = s.define("x", r * sp.sin(phi))
    s.kinetic(J * phi.diff() ** 2 / 2, name="crank")
    s.particle(m, at=s.point("P", (x, 0)), name="plunger")
    s.damper(b, deflection=x, name="hay")
    right = (
        "x = r sin(phi)\nx' = r phi' cos(phi)\nT = 1/2 (J + m r^2 cos(phi)^2) phi'^2\n"
        "D = 1/2 b r^2 cos(phi)^2 phi'^2\n"
        "(J + m r^2 cos(phi)^2) phi'' - m r^2 phi'^2 sin(phi) cos(phi) + b r^2 cos(phi)^2 phi' = 0"
    )
    assert s.derive().check(right).right
    wrong_rate = right.replace("r phi' cos(phi)\n", "-r phi' sin(phi)\n").replace("r^2 cos(phi)^2", "r^2 sin(phi)^2")
    verdict, lines = wrong(s.derive(), wrong_rate.replace("- m r^2 phi'^2", "+ m r^2 phi'^2"))
    assert lines == {2: False, 3: True, 4: True, 5: True}
    assert "But for its sign" not in str(verdict) and len(verdict.mistakes) == 1


def test_a_slope_with_a_prime_lacks_no_rate() -> None:
    answer = ROD.replace("I' = 2 m r r'", "I' = 2 m r, its derivative by r")
    assert "the factor r' is missing" not in " ".join(str(rod().check(answer)).split())


SQUARE, HALF = "x_B'^2 + y_B'^2 = x'^2 + 2 l x'", "m (x'^2 + 2 l x'"


def test_an_energy_follows_from_a_wrong_square_of_a_speed() -> None:
    """The term is told on the side and with the factor that stand in that line, and not as a term of T*."""
    answer = CART.replace(SQUARE, SQUARE.replace("2 l", "l")).replace(HALF, HALF.replace("2 l", "l"))
    verdict, lines = wrong(cart(), answer)
    assert lines == {3: False, 4: True}
    [mistake] = verdict.mistakes
    assert str(mistake.what) == "In line 3, on the right-hand side, l*cos(phi)*phi'*x' should be 2*l*cos(phi)*phi'*x'."
    assert mistake.step == 2


@pytest.mark.parametrize("energy", ["m (x'^2 + 2 l phi'", "(M + m) (x'^2 + l x'"])
def test_an_energy_with_another_term_does_not_follow(energy: str) -> None:
    answer = CART.replace(SQUARE, SQUARE.replace("2 l", "l")).replace(HALF, energy)
    _, lines = wrong(cart(), answer)
    assert lines == {3: False, 4: False}


def test_a_term_of_an_energy_is_not_told_of_another_line() -> None:
    """Beside a wrong line that is no equation of a coordinate, a wrong term of T* keeps its own factor."""
    answer = CART.replace("1/2 M x'^2", "M x'^2").replace(SQUARE, SQUARE.replace("2 l", "4 l^2"))
    verdict, lines = wrong(cart(), answer)
    assert lines == {3: False, 4: False}
    assert not any("line 3" in str(m.what) and "M" in str(m.what) for m in verdict.mistakes)


ACCELERATED = """x_B = x + l sin(phi)
y_B = -l cos(phi)
x_B'' = x'' + l cos(phi) phi'' - l sin(phi) phi'^2
y_B'' = l sin(phi) phi'' + l cos(phi) phi'^2
(M + m) x'' + m l phi'' cos(phi) - m l phi'^2 sin(phi) + k x = 0
m l^2 phi'' + m l x'' cos(phi) + m g l sin(phi) = 0"""


def test_a_term_of_a_second_rate_is_told_as_such_and_the_balance_follows() -> None:
    """What the acceleration has too much, times m l sin φ, is what the moment has too much."""
    answer = ACCELERATED.replace("+ l cos(phi) phi'^2", "- l cos(phi) phi'^2")
    assert cart().check(ACCELERATED).right
    row = "m l x'' cos(phi) - 2 m l^2 sin(phi) cos(phi) phi'^2"
    verdict, lines = wrong(cart(), answer.replace("m l x'' cos(phi)", row))
    assert lines == {4: False, 6: True}
    [mistake] = verdict.mistakes
    assert str(mistake.what) == "In line 4, the term -l*cos(phi)*phi'^2 has the wrong sign."
    _, lines = wrong(cart(), answer.replace("m l x'' cos(phi)", f"{row} + k l"))
    assert lines == {4: False, 6: False}
