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


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ("y = r*phi\nJ*phi'' + b*r^2*phi' = m*g*r", "½mv² of rigid body 'yo-yo' is missing."),
        ("(m + J/r) y'' + b y' = m g", "r is not squared in what rigid body 'yo-yo' adds to the equations."),
        ("(m + J/r^2) y'' + b y' = -m g", "The weight of rigid body 'yo-yo' has the wrong sign"),
        ("(m + J/r^2) y'' = m g", "Damper 'b' is missing."),
        ("y'' = (-m*g - b*y')/(m + J/r^2)\nphi'' = y''/r", "The weight of rigid body 'yo-yo' has the wrong sign"),
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
        assert DERIVED.check(answer, hint=0).right


def test_two_mistakes_beside_a_multiplier_are_two() -> None:
    verdict = DERIVED.check("m y'' = m g - b y' + S\n(J/2) phi'' = r S\ny = r phi")
    told = [str(m.what) for m in verdict.mistakes]
    assert len(told) == 2, told
    assert any("S has the wrong sign in the equation of y" in x for x in told), told
    assert any("counts half" in x for x in told), told


@pytest.mark.slow
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


@pytest.mark.slow
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


def scotch_yoke() -> lg.System:
    """A yoke that a pin on a crank drives, x = r cos θ, with a torque on the crank and a load on the yoke."""
    s = lg.System("scotch yoke")
    theta, x = s.coordinates("theta x")
    J, M, r = s.parameters("J M r")
    tau, P = s.inputs("tau P")
    s.rigid_body(0, J, at=s.origin, frame=s.frame(theta, name="crank"), name="crank")
    s.particle(M, at=s.origin + (x, 0), name="yoke")
    s.force(tau, deflection=theta, name="motor")
    s.force(-P, deflection=x, name="load")
    s.constraint(x - r * cos(theta), name="pin")
    return s


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ("(J + M r^2 sin(theta)^2) theta'' + 2 M r^2 sin(theta) cos(theta) theta'^2 = tau + P r sin(theta)", "∂"),
        ("T = 1/2 (J + M r^2) theta'^2\n(J + M r^2) theta'' = tau + P r sin(theta)", "sin(theta)^2 is missing"),
        (
            r"\[ f = x - r\cos\theta = 0,\qquad \frac{\partial f}{\partial\theta} = -r\sin\theta \]"
            r"\begin{align} J\ddot\theta &= \tau - \lambda r\sin\theta\\ M\ddot x &= -P + \lambda\\"
            r"x - r\cos\theta &= 0 \end{align}",
            "no derivative of constraint 'pin' by a coordinate. The factors of the multiplier follow",
        ),
    ],
)
def test_mistakes_where_a_coordinate_of_the_system_was_eliminated(answer: str, said: str) -> None:
    verdict = scotch_yoke().derive().check(answer)
    (mistake,) = verdict.mistakes
    assert said in str(mistake.what), str(mistake.what)
