"""A quantity that is taken wrongly is named as that quantity: the rate of a damper, a moment of inertia, a factor.

Oracle: a wheel and a tube that roll, a rod on the wheel, a load on a drum and a sleeve on a rod, by hand.
"""

from functools import cache

import pytest
from test_true_explanations import told

import lagrangian as lg


@cache
def lift() -> lg.Derivation:
    """A drum that lifts a load y, a flap φ with a damper in its hinge, and a sleeve at r on a rod θ with a damper."""
    s = lg.System("lift")
    y, phi, r, theta = s.coordinates("y phi r theta")
    J, R, A, B, m, b, d = s.parameters("J R A B m b d")
    drum, flap, rod = (s.frame(x, name=n) for x, n in ((y / R, "drum"), (phi, "flap"), (theta, "rod")))
    for frame, inertia in ((drum, J), (flap, A), (rod, B)):
        s.rigid_body(mass=0, inertia=inertia, at=s.origin, frame=frame, name=frame.name or "")
    s.particle(m, at=s.point("P", (r, 0), frame=rod), name="sleeve")
    s.damper(b, deflection=phi, name="hinge")
    s.damper(d, deflection=r, name="oil")
    return s.derive()


@cache
def rolling() -> lg.Derivation:
    """A solid wheel and a thin tube that roll, with a bar that rubs in the axle of the wheel."""
    s = lg.System("rolling")
    x, z, phi = s.coordinates("x z phi")
    M, R, m, r, J, c, k = s.parameters("M R m r J c k")
    F = s.input("F")
    for name, mass, inertia, q, radius in (("wheel", M, M * R**2 / 2, x, R), ("tube", m, m * r**2, z, r)):
        at, frame = s.point(f"P_{name}", (q, 0)), s.frame(-q / radius, name=f"on_{name}")
        s.rigid_body(mass=mass, inertia=inertia, at=at, frame=frame, name=name)
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=s.frame(phi, name="on_bar"), name="bar")
    s.damper(c, deflection=phi + x / R, name="axle")
    s.spring(k, deflection=z - x, name="rope")
    s.force(F, deflection=2 * x)
    return s.derive()


D = "D = b/2 ({hinge})^2 + d/2 ({oil})^2"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("hinge", "oil", "said"),
    [
        ("phi' - y'/R", "r'", "the velocity of damper 'hinge' is phi', not phi' - y'/R"),
        ("phi'", "r theta'", "the velocity of damper 'oil' is r', not r*theta'"),
    ],
)
def test_a_wrong_bracket_in_the_dissipation_is_the_rate_of_a_damper(hinge: str, oil: str, said: str) -> None:
    assert lift().check(D.format(hinge="phi'", oil="r'"), hint=0).right
    words = told(lift(), D.format(hinge=hinge, oil=oil))
    assert said in words and "rigid body" not in words and "And:" not in words, words


ROLLING = """{T}
Q_x = 2 F - c/R (phi' + x'/R)
Q_phi = -c (phi' + x'/R)
(3/2 M {more}) x'' + k (x - z) = 2 F - c/R (phi' + x'/R)
{tube} m z'' + k (z - x) = 0
J phi'' = -c (phi' + x'/R)"""
RIGHT = {"T": "", "more": "", "tube": "2"}


@pytest.mark.slow
def test_an_element_that_belongs_to_every_force_is_not_counted_in_every_force_wrongly() -> None:
    assert rolling().check("Q_x = 2 F - c/R (phi' + x'/R)\nQ_phi = -c (phi' + x'/R)", hint=0).right
    words = told(rolling(), "Q_x = 2 F - c (phi' + x'/R)\nQ_phi = -c (phi' + x'/R)")
    assert "the factor 1/R is missing" in words and "in every" not in words, words


def test_half_of_an_energy_of_what_rolls_is_another_moment_of_inertia() -> None:
    said = "The moment of inertia of rigid body 'tube' is taken as m*r^2/2."
    words = told(rolling(), "T = 1/2 M x'^2 + 1/2 (M R^2/2) x'^2/R^2 + 1/2 m z'^2 + 1/4 m z'^2 + 1/2 J phi'^2")
    assert words == said, words
    words = told(rolling(), ROLLING.format(**RIGHT | {"tube": "3/2"}))
    assert words.endswith(said) and "½mv²" not in words, words


def test_a_stated_moment_of_inertia_is_told_before_the_energy_in_the_same_line() -> None:
    line = "J_w = {} M R^2, w = x'/R, so T_w = 1/2 M x'^2 + 1/2 {} M R^2 (x'/R)^2"
    wrong = ROLLING.format(**RIGHT | {"T": line.format("", ""), "more": "+ 1/2 M"})
    assert rolling().check(ROLLING.format(**RIGHT | {"T": line.format("1/2", "1/2")}), hint=0).right
    words = told(rolling(), wrong)
    assert words == "Line 1 is not right: the moment of inertia of rigid body 'wheel' is M*R^2/2, not M*R^2.", words


def test_the_deflection_in_a_stated_energy_is_told_where_it_was_taken_twice_as_far() -> None:
    line = "V_rope = 1/2 k ({} (z - x))^2\n"
    assert rolling().check(line.format("") + ROLLING.format(**RIGHT), hint=0).right
    wrong = ROLLING.format(**RIGHT).replace("k (", "4 k (")
    words = told(rolling(), line.format("2") + wrong)
    assert "the deflection of spring 'rope' is -x + z, not -2*x + 2*z" in words.replace("2*(-x + z)", "-2*x + 2*z"), (
        words
    )
    words = told(rolling(), "V_rope = k (z - x)^2\n" + ROLLING.format(**RIGHT).replace("k (", "2 k ("))
    assert "½" in words and "not 2" not in words, words


@cache
def sleeve() -> lg.Derivation:
    """A sleeve at r on a rod θ, which a motor turns, with a brake; what stands in front of θ̈ is no constant."""
    s = lg.System("sleeve")
    r, theta = s.coordinates("r theta")
    J, m, b, d = s.parameters("J m b d")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=s.frame(theta, name="rod"), name="bar")
    s.particle(m, at=s.point("P", (r, 0), frame=s.frame(theta, name="turned")), name="mass")
    s.damper(b, deflection=theta, name="brake")
    s.damper(d, deflection=r, name="oil")
    s.torque(s.input("tau"), on=theta)
    return s.derive()


SOLVED = "r'' = r theta'^2 - d r'/m\ntheta'' = (tau - b theta' - 2 m r r' theta')/({})"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("below", "said"),
    [
        (
            "J + m r",
            "In the denominator's term m*r^2 of the equation of theta, r stands once, and belongs there squared.",
        ),
        ("J", "The denominator's term m*r^2 of the equation of theta is missing."),
        ("J - m r^2", "The denominator's term m*r^2 of the equation of theta has the wrong sign."),
    ],
)
def test_a_wrong_denominator_is_told_by_its_own_term(below: str, said: str) -> None:
    assert sleeve().check(SOLVED.format("J + m r^2"), hint=0).right
    words = told(sleeve(), SOLVED.format(below))
    assert words.startswith(said) and "bar" not in words, words


def test_a_wrong_numerator_is_not_in_the_denominator() -> None:
    words = told(sleeve(), SOLVED.format("J + m r^2").replace("2 m", "m"))
    assert "denominator" not in words, words
