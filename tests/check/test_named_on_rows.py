"""Mistakes in answers from which a constraint was eliminated, and two mistakes beside a multiplier: a yo-yo."""

from __future__ import annotations

import pytest
from sympy import cos, sin

import lagrangian as lg


def yo_yo() -> lg.System:
    """A yo-yo on a string r φ = y, with drag on its centre: (m + J/r²) y″ + b y′ = m g."""
    s = lg.System("yo-yo")
    y, phi = s.coordinate("y"), s.coordinate("phi")
    m, J, r, b = (s.parameter(x) for x in ("m", "J", "r", "b"))
    s.rigid_body(m, J, at=s.point("C", (0, -y)), frame=s.frame(phi, name="wheel"), name="yo-yo")
    s.gravity((0, -1), s.parameter("g"))
    s.damper(b, deflection=y, name="b")
    s.constraint(y - r * phi, name="string")
    return s


DERIVED = yo_yo().derive()


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ("y = r*phi\nJ*phi'' + b*r^2*phi' = m*g*r", "½mv² of rigid body 'yo-yo' is missing."),
        ("(m + J/r) y'' + b y' = m g", "there is the factor r too much."),
        ("(m + J/r^2) y'' + b y' = -m g", "The weight of rigid body 'yo-yo' has the wrong sign in V"),
        ("(m + J/r^2) y'' = m g", "Damper 'b' is missing."),
        ("y'' = (-m*g - b*y')/(m + J/r^2)\nphi'' = y''/r", "The weight of rigid body 'yo-yo' has the wrong sign in V"),
    ],
)
def test_one_mistake_in_a_reduced_equation(answer: str, said: str) -> None:
    verdict = DERIVED.check(answer)
    assert not verdict.right
    (mistake,) = verdict.mistakes
    assert said in str(mistake.what), str(mistake.what)
    assert "does not belong there" not in str(verdict)  # the terms are those of both equations together


def test_right_reduced_equations_stay_right() -> None:
    for answer in ("y = r*phi\n(J + m*r^2)*phi'' + b*r^2*phi' = m*g*r", "(m + J/r^2) y'' + b y' = m g\nphi'' = y''/r"):
        assert DERIVED.check(answer).right


def test_two_mistakes_beside_a_multiplier_are_two() -> None:
    verdict = DERIVED.check("m y'' = m g - b y' + S\n(J/2) phi'' = r S\ny = r phi")
    told = [str(m.what) for m in verdict.mistakes]
    assert len(told) == 2, told
    assert any("S has the wrong sign in the equation of y" in x for x in told), told
    assert any("counts half" in x for x in told), told


def test_a_term_that_the_constraint_hides_is_named_as_what_it_is() -> None:
    """On a ball r = R, so that r″ = 0: what lacks r θ′² lacks all that a particle adds there, but r″ was written."""
    s = lg.System("particle on a ball")
    r, theta = s.coordinates("r theta", positive=True)
    m, R = s.parameters("m R")
    s.particle(m, at=s.point("P", (r * sin(theta), r * cos(theta))), name="bead")
    s.gravity((0, -1), s.parameter("g"))
    s.constraint(r - R, name="contact")
    derived = s.derive()
    second = "\nm r^2 theta'' + 2 m r r' theta' - m g r sin(theta) = 0\nr = R"
    (mistake,) = derived.check("m r'' + m g cos(theta) = lambda" + second).mistakes
    assert "∂L/∂r" in str(mistake.what), str(mistake.what)
    assert "is not the force of a constraint" in str(derived.check("m g cos(theta) = lambda" + second))


def test_two_strands_of_a_belt_go_together() -> None:
    s = lg.System("belt")
    phi1, phi2 = s.coordinates("phi1 phi2")
    J1, J2, r1, r2, k, c = s.parameters("J1 J2 r1 r2 k c")
    for n, (J, phi) in enumerate(((J1, phi1), (J2, phi2)), 1):
        s.rigid_body(1, J, at=s.origin, frame=s.frame(phi, name=f"p{n}"), name=f"pulley {n}")
    s.spring(k, deflection=r1 * phi1 - r2 * phi2, name="tight")
    s.spring(k, deflection=r2 * phi2 - r1 * phi1, name="slack")
    s.spring(c, deflection=phi2, name="shaft")
    answer = "J1 phi1'' + 2 k r1 (r1 phi1 - r2 phi2) = 0\nJ2 phi2'' + 2 k r2 (r1 phi1 - r2 phi2) + c phi2 = 0"
    (mistake,) = s.derive().check(answer).mistakes
    assert "spring 'tight' and spring 'slack' add to the equation of phi2 has the wrong sign" in str(mistake.what)
