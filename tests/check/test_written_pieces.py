"""Explanations are held against the terms as they are written: what stands there is neither missing nor halved."""

from functools import cache

import pytest
from sympy import cos, sin

import lagrangian as lg


@cache
def roller(J: str = "m*r^2/2") -> lg.Derivation:
    """A cylinder that rolls along a rail, on a spring."""
    s = lg.System("roller")
    x = s.coordinate("x")
    m, r, k = s.parameters("m r k")
    inertia = {"m*r^2/2": m * r**2 / 2, "m*r^2": m * r**2}[J]
    s.rigid_body(mass=m, inertia=inertia, at=s.point("C", (x, 0)), frame=s.frame(-x / r), name="roller")
    s.spring(k, deflection=x)
    return s.derive()


@cache
def dial() -> lg.Derivation:
    """A slider in the slot of a dial that turns; both have friction."""
    s = lg.System("dial")
    phi, r = s.coordinates("phi r")
    J, m, b, c = s.parameters("J m b c")
    M = s.input("M")
    s.rigid_body(mass=m, inertia=J, at=s.origin, frame=s.frame(phi), name="dial")
    s.particle(m, at=s.point("P", (r * sin(phi), -r * cos(phi))), name="slider")
    s.damper(b, deflection=r, name="slot")
    s.damper(c, deflection=phi, name="axle")
    s.torque(M, on=phi)
    return s.derive()


V = "\nV = 1/2 k x^2\n"


def told(system: lg.Derivation, answer: str) -> str:
    verdict = system.check(answer)
    assert not verdict.right
    return " / ".join(str(m.what) for m in (*verdict.mistakes, *verdict.alternatives))


@pytest.mark.parametrize(
    ("T", "row", "first", "untrue"),
    [
        ("1/2 m x'^2", "m x'' + k x = 0", "½Jω² of rigid body 'roller' is missing", "counts half"),
        ("1/2 m x'^2 + 1/2 (m r^2) (x'/r)^2", "2 m x'' + k x = 0", "is taken as m*r^2", "½ of ½Jω²"),
        ("1/2 m x'^2 + 1/2 (m r^2) (x'/r)^2", "2 m x'' + k x = 0", "is taken as m*r^2", "counts twice"),
        ("1/2 m x'^2 + (1/2 m r^2) (x'/r)^2", "2 m x'' + k x = 0", "The ½ of ½Jω²", "½mv²"),
        ("m x'^2 + 1/2*1/2 m r^2 (x'/r)^2", "5/2 m x'' + k x = 0", "The ½ of ½mv²", "moment of inertia"),
    ],
)
def test_a_piece_that_stands_in_full_is_not_called_missing_or_halved(T: str, row: str, first: str, untrue: str) -> None:
    said = told(roller(), f"T = {T}{V}{row}")
    assert first in said and untrue not in said, said


def test_latex_fractions_and_brackets_are_terms_as_well() -> None:
    T = r"T = \frac{1}{2} m \dot{x}^2 + \tfrac12 (m r^2) \left(\frac{\dot{x}}{r}\right)^2"
    said = told(roller(), rf"\[ {T} \] \[ V = \frac12 k x^2 \] \[ 2 m \ddot{{x}} + k x = 0 \]")
    assert said == "The moment of inertia of rigid body 'roller' is taken as m*r^2."


def test_the_terms_of_an_equation_count_where_no_energy_is_written() -> None:
    said = told(roller(), "m x'' + k x = 0")
    assert "½Jω² of rigid body 'roller' is missing" in said and "counts half" not in said


def test_a_piece_that_is_doubled_is_told() -> None:
    assert "The ½ of ½mv²" in told(roller("m*r^2"), f"T = m x'^2 + 1/2 m r^2 (x'/r)^2{V}3 m x'' + k x = 0")


def test_an_energy_of_one_body_is_held_against_its_own_terms() -> None:
    said = told(roller(), f"T_roller = 1/2 (3/2 m r^2) (x'/r)^2 + 1/2 m x'^2{V}5/2 m x'' + k x = 0")
    assert "½ of ½mv²" not in said and "3*m*x'^2/4, not 5*m*x'^2/4" in said


@pytest.mark.slow
def test_a_rate_that_is_right_in_the_other_coordinate_is_not_taken_as_a_whole_velocity() -> None:
    T = "T = J phi'^2/2 + m (r'^2 + r^2 phi'^2)/2\n"
    rows = "(J + m r^2) phi'' + 2 m r r' phi' = Q_phi\nm r'' - m r phi'^2 = Q_r"
    assert dial().check(T + "Q_phi = M - c phi'\nQ_r = -b r'\n" + rows).right
    said = told(dial(), T + "Q_phi = M - c r^2 phi'\nQ_r = -b r'\n" + rows)
    assert "whole velocity" not in said and "factor r^2 too much" in said
    whole = told(dial(), T + "Q_phi = M - c r^2 phi'\nQ_r = -b r' - c r'\n" + rows)
    assert "whole velocity" in whole


def test_a_letter_that_is_left_out_or_turned_is_no_reason_beside_one() -> None:
    rows = "m r^2 phi'' + 2 m r r' phi' = M - c phi'\nm r'' - m r phi'^2 = -b r'"
    verdict = dial().check(rows)
    said = told(dial(), rows)
    assert "J is left out" not in said and "J" in said, said
    assert verdict.mistakes[0].name != "left_out_of_a_sum"


def test_a_piece_that_stands_twice_with_its_half_has_not_lost_it() -> None:
    """½ M s² θ̇² within ½ (J + M s²) θ̇² and once more: J about the pivot, or counted twice, and no ½ is missing."""
    s = lg.System("flap")
    a = s.coordinate("a")
    J, M, n = s.parameters("J M n")
    flap = s.frame(a, name="flap")
    s.rigid_body(mass=M, inertia=J, at=s.point("C", (n, 0), frame=flap), frame=flap, name="flap")
    system = s.derive()
    twice = "T = 1/2 (J + M n^2) a'^2 + 1/2 M (n a')^2"
    first, *others = (x for v in [system.check(twice)] for x in (*v.mistakes, *v.alternatives))
    assert "as well" in str(first.what) and all("½" not in str(x.what) or "twice" in str(x.what) for x in others)
    lost = system.check("T = 1/2 J a'^2 + M (n a')^2")
    assert "The ½" in str(lost.mistakes[0].what), lost.mistakes
