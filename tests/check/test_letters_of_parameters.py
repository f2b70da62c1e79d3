"""Letters of parameters that an answer uses for the sine or cosine of a coordinate: c = cos φ beside a damper's c.

Oracle: the equation of a pendulum on a cart that is held by a spring and a damper with the constant c.
"""

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verdict import Status

EQUATIONS = """(M + m) x'' + m l C phi'' - m l S phi'^2 + k x = -DAMPER x'
m l C x'' + m l^2 phi'' + m g l S = 0"""
SAID = {
    "before": "With c = cos phi, s = sin phi; the damper's constant is d.\n",
    "latex": r"Let $c = \cos\varphi$ and $s = \sin\varphi$, $d$ is the damper." + "\n",
    "lines": "c = cos(phi)\ns = sin(phi)\n",
}


@cache
def cart() -> lg.Derivation:
    """A pendulum on a cart with a spring and a damper."""
    s = lg.System("pendulum on a cart")
    x, phi = s.coordinates("x phi")
    M, m, l, k, c, g = s.parameters("M m l k c g")
    s.particle(M, at=s.point("K", (x, 0)), name="cart")
    s.particle(m, at=s.point("B", (x + l * sp.sin(phi), -l * sp.cos(phi))), name="bob")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=x)
    s.damper(c, deflection=x)
    return s.derive()


def equations(cosine: str, sine: str, damper: str) -> str:
    """The equations with letters for cos φ, sin φ and the damper's constant."""
    return EQUATIONS.replace("DAMPER", damper).replace("C", cosine).replace("S", sine)


@pytest.mark.parametrize("said", SAID)
def test_a_cosine_may_have_the_letter_of_a_constant(said: str) -> None:
    verdict = cart().check(SAID[said] + equations("c", "s", "d"))
    assert verdict.right
    assert any("c was read as your own" in str(x) for x in verdict.notes)
    assert not cart().check(SAID[said] + equations("s", "c", "d")).right


def test_a_letter_that_stands_for_both_is_told() -> None:
    verdict = cart().check(SAID["lines"] + equations("c", "s", "c"))
    assert [f.line.number for f in verdict.findings if not f.status.right] == [3]
    assert verdict.mistake is not None
    assert "-cos(phi)*x' should be -c*x'" in str(verdict.mistake.what)


def test_a_constant_without_such_a_value_is_that_of_the_system() -> None:
    assert cart().check(equations("cos(phi)", "sin(phi)", "c")).right
    assert not cart().check("c = cos(alpha)\n" + equations("c", "sin(phi)", "d")).right


def test_forces_without_an_energy_are_no_whole() -> None:
    kinetic = "T = M x'^2/2 + m/2 (x'^2 + 2 l x' phi' cos phi + l^2 phi'^2)\n"
    forces = "Q_x = -c x'\nQ_phi = 0"
    assert cart().check(kinetic).right
    verdict = cart().check(kinetic + forces)
    assert verdict.status is Status.INCOMPLETE
    assert any("V is missing" in str(x) for x in verdict.notes)
    assert cart().check(f"{kinetic}V = k x^2/2 - m g l cos phi\n{forces}").right


def test_letters_behind_equations_count_them_beside_roman_numbers() -> None:
    written = """M x'' = -k x - c x' - N                                   (a)
m (x'' + l phi'' cos phi - l phi'^2 sin phi) = N          (b)
m l x'' cos phi + m l^2 phi'' + m g l sin phi = 0         (c)
(a) + (b):
(M + m) x'' + m l cos(phi) phi'' - m l sin(phi) phi'^2 + k x = -c x'     (I)
m l cos(phi) x'' + m l^2 phi'' + m g l sin(phi) = 0                      (II)"""
    assert cart().check(written).right
    assert not cart().check(written.replace("k x = -c x'", "k x = c x'")).right


@pytest.mark.parametrize("prime", ["g'", "g’", r"$g'$", "m'"])
def test_a_prime_of_a_constant_is_a_part_of_a_name(prime: str) -> None:
    if "m" in prime:
        said = "m' = m + M is the whole mass\n"
        rows = EQUATIONS.replace("(M + m)", "m'").replace("DAMPER", "c").replace("C", "cos phi").replace("S", "sin phi")
    elif "$" in prime:
        said = r"With $g' = g/l$ and $\mu = m/(M+m)$" + "\n"
        rows = r"\[ (M+m)\ddot x + ml\cos\varphi\,\ddot\varphi - ml\sin\varphi\,\dot\varphi^2 + kx = -c\dot x \]" + "\n"
        rows += r"\[ \cos\varphi\,\ddot x + l\ddot\varphi + l g'\sin\varphi = 0 \]"
    else:
        said = f"{prime} = g/l (no derivative)\n"
        rows = equations("cos phi", "sin phi", "c").replace("m g l", f"m {prime} l^2")
    assert cart().check(said + rows).right
    assert not cart().check(said.replace("m + M", "m").replace("g/l", "g/l^2") + rows).right


def test_an_angular_momentum_with_squares_of_lengths_is_no_lagrangian() -> None:
    s = lg.System("drum with a rim")
    phi = s.coordinate("phi")
    J, m, R, c = s.parameters("J m R c")
    s.rigid_body(mass=1, inertia=J, at=s.origin, frame=s.frame(phi, name="drum"), name="drum")
    s.kinetic(m * R**2 * phi.diff() ** 2 / 2, name="rim")
    s.damper(c, deflection=phi)
    s.torque(s.input("M"), on=phi)
    derivation = s.derive()
    momentum = "Angular momentum about O:\nL = J phi' + m R^2 phi'\nL' = M - c phi'\n"
    row = "J phi'' + m R^2 phi'' = M - c phi'"
    assert derivation.check(momentum + row).right
    assert not derivation.check(momentum.replace("m R^2", "m R^2/2") + row).right
    assert not derivation.check("L = J phi'^2/2 + m R^2 phi'^2\n" + row).right


def test_a_label_adds_bodies_by_their_letters() -> None:
    written = equations("cos phi", "sin phi", "c").split("\n")
    labelled = f"cart + B:   {written[0]}\nrod and B:  {written[1]}"
    assert cart().check(labelled).right
    assert not cart().check(labelled.replace("= 0", "= m g l")).right


def test_an_angular_momentum_called_d_is_no_dissipation() -> None:
    momentum = "Along the rail: D = (M + m) x' + m l phi' cos phi\n"
    written = equations("cos phi", "sin phi", "c")
    assert cart().check(momentum + written).right
    other = cart().check(momentum.replace("m l", "2 m l") + written)
    assert not any(f.line.number == 1 for f in other.findings)
    assert any("D = (M + m)" in str(note) for note in other.notes)
    assert not cart().check("D = c x'/2\n" + written).right


def test_a_coordinate_in_place_of_another_is_related_before_a_comma() -> None:
    said = "Instead of x I use z, the stretch from the length d: x = M l/m + z, so x' = z', x'' = z''.\n"
    rows = equations("cos phi", "sin phi", "c").replace("x", "z").replace("k z", "k (z + M l/m)")
    assert cart().check(said + rows).right
    assert not cart().check(said + rows.replace("k (z + M l/m)", "k z")).right


def test_a_name_below_a_bar_is_asked_about_and_is_no_error_of_ours() -> None:
    with pytest.raises(lg.ParseError):
        cart().check(equations("cos phi", "sin phi", "c").replace("k x", "k x/q^2").replace("g S", "g S/q"))
