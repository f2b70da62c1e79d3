"""Angles that are a constant times a coordinate, behind functions without brackets or with a sum in brackets.

Oracle: the energies and the equation of a planet gear with a bead, with the brackets written.
"""

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg


@cache
def planet() -> lg.Derivation:
    """A bead on a planet gear that turns by n φ backwards while its arm of length l turns by φ."""
    s = lg.System("bead on a planet gear")
    phi = s.coordinate("phi")
    m, d, l, n, g = s.parameters("m d l n g")
    bead = (l * sp.sin(phi) - d * sp.sin(n * phi), -l * sp.cos(phi) - d * sp.cos(n * phi))
    s.particle(m, at=s.point("B", bead), name="bead")
    s.gravity(direction=(0, -1), g=g)
    s.torque(s.input("M"), on=phi)
    return s.derive()


PLAIN = """V = -m g (l cos phi + d {COS})
m (l^2 + n^2 d^2 - 2 n l d {SUM}) phi'' + m n (n+1) l d {SINE} phi'^2 + m g l sin phi + m g n d {SIN} = M"""
LATEX = r"""\[ m\left(l^2+n^2d^2-2nld{SUM}\right)\ddot\varphi+mn(n+1)ld{SINE}\,\dot\varphi^2
+mgl\sin\varphi+mgnd{SIN}=M \]"""
FORMS = {
    "plain": PLAIN.format(COS="cos n phi", SUM="cos((n+1) phi)", SINE="sin((n+1) phi)", SIN="sin n phi"),
    "plain, sums": PLAIN.format(COS="cos(n phi)", SUM="cos(n+1)phi", SINE="sin(n+1) phi", SIN="sin(n phi)"),
    "own name": "q = n + 1\n" + PLAIN.format(COS="cos n phi", SUM="cos q phi", SINE="sin q phi", SIN="sin n phi"),
    "latex": LATEX.format(SUM=r"\cos((n+1)\varphi)", SINE=r"\sin((n+1)\varphi)", SIN=r"\sin n\varphi"),
    "latex, sums": LATEX.format(SUM=r"\cos(n+1)\varphi", SINE=r"\sin(n+1)\varphi", SIN=r"\sin n\varphi"),
    "latex, own name": r"Let $\rho=n+1$. "
    + LATEX.format(SUM=r"\cos\rho\varphi", SINE=r"\sin\rho\varphi", SIN=r"\sin(\rho-1)\varphi"),
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize("form", FORMS)
def test_a_constant_before_a_coordinate_belongs_to_the_angle(form: str) -> None:
    written = FORMS[form]
    assert planet().check(written).right
    assert not planet().check(written.replace("n + 1", "n - 1").replace("n+1", "n-1").replace("n^2", "n")).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("form", FORMS)
def test_so_does_one_before_an_angle_with_another_name(form: str) -> None:
    """An own θ, whose rates the answer writes, stands for the angle of the arm: sin n θ is sin(n θ)."""
    written = FORMS[form].replace("phi", "theta").replace(r"\vartheta", r"\theta")
    assert planet().check(written).right
    assert not planet().check(written.replace("n + 1", "n - 1").replace("n+1", "n-1").replace("n^2", "n")).right


def test_a_coordinate_behind_another_sine_is_a_factor() -> None:
    s = lg.System("block on a slope")
    x = s.coordinate("x")
    m, k, alpha, g = s.parameters("m k alpha g")
    s.particle(m, at=s.point("P", (x * sp.cos(alpha), -x * sp.sin(alpha))), name="block")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=x)
    assert s.derive().check("V = k x^2/2 - m g sin alpha x").right
    assert s.derive().check(r"\[ V = \tfrac12kx^2-mg\sin\alpha x \]").right


def test_the_value_of_what_the_system_defines_is_no_equation() -> None:
    s = lg.System("geared drum")
    phi = s.coordinate("phi")
    J, I = s.parameters("J I")
    R, r = s.parameter("R", 0.12), s.parameter("r", 0.04)
    n = s.define("n", R / r)
    s.kinetic(J * phi.diff() ** 2 / 2, name="drum")
    s.kinetic(I * (n * phi.diff()) ** 2 / 2, name="motor")
    s.torque(s.input("M"), on=phi)
    derivation = s.derive()
    row = "(J + n^2 I) phi'' = M\n"
    assert derivation.check(row + "Should I put n = 3?").right
    assert derivation.check(row + "n = 3").right
    assert not derivation.check(row + "n = 2").right
    assert not derivation.check("(J + 3 I) phi'' = M\nn = 3").right
