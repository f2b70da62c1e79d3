"""Mistakes in answers with letters of their own are named, and those that explain a line fit the lines below it."""

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.model import time


@pytest.fixture(scope="module")
def slider() -> lg.Derivation:
    """A slider with a spring on a rod that turns about its end, in the horizontal plane."""
    s = lg.System("slider")
    theta, r = s.coordinates("theta r")
    M, m, ell, ell_0, k = s.parameters("M m ell ell_0 k")
    tau = s.inputs("tau")
    rod = s.frame(theta, name="rod")
    s.rigid_body(M, M * ell**2 / 12, at=s.point("C", (ell / 2, 0), frame=rod), frame=rod, name="rod")
    s.particle(m, at=s.point("S", (r, 0), frame=rod), name="slider")
    s.spring(k, deflection=r - ell_0, name="spring")
    s.torque(tau, on=theta, name="motor")
    return s.derive()


TURN = "(M*l^2/3 + m*r^2)*theta'' + 2*m*r*r'*theta' = tau"
ALONG = "m*r'' - m*r*theta'^2 + k*(r - l0) = 0"


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("right", "wrong", "kinds", "element"),
    [
        ("2*m*r*r'*", "m*r*r'*", {"coriolis_half"}, None),
        ("= tau", "= -tau", {"force_sign"}, "torque 'motor'"),
        ("l^2/3", "2*l^2/3", {"half_forgotten"}, "rigid body 'rod'"),
        ("- l0", "+ l0", {"deflection_sign", "sign_in_a_sum"}, "spring 'spring'"),
    ],
)
def test_letters_of_the_answer_are_read_by_the_terms_that_agree(
    slider: lg.Derivation, right: str, wrong: str, kinds: set[str], element: str | None
) -> None:
    answer = f"{TURN}\n{ALONG}"
    assert slider.check(answer, hint=0).right
    (mistake,) = slider.check(answer.replace(right, wrong)).mistakes
    assert mistake.name in kinds and mistake.element == element, str(mistake.what)


@pytest.fixture(scope="module")
def drum() -> lg.Derivation:
    """A block on an elastic rope around a drum, which a spring and a damper hold at its small radius."""
    s = lg.System("drum")
    x, phi = s.coordinates("x phi")
    m, J, R, r, k1, k2, c = s.parameters("m J R r k1 k2 c")
    s.particle(m, at=s.point("A", (0, -x)), name="block")
    s.rigid_body(m, J, at=s.origin, frame=s.frame(phi, name="drum"), name="drum")
    s.gravity()
    s.spring(k1, deflection=x - R * phi, name="rope")
    s.spring(k2, deflection=r * phi, name="holder")
    s.damper(c, deflection=r * phi, name="brake")
    return s.derive()


@pytest.mark.slow
def test_a_mistake_in_v_has_the_extent_that_the_equations_show(drum: lg.Derivation) -> None:
    """R and r are exchanged in V; the brake of the equations, at r, is right."""
    V = "V = -m*g*x + k1*(x - r*phi)^2/2 + k2*R^2*phi^2/2"
    below = "m*x'' - m*g + k1*(x - r*phi) = 0\nJ*phi'' - k1*r*(x - r*phi) + k2*R^2*phi + c*r^2*phi' = 0"
    verdict = drum.check(f"{V}\n{below}")
    (mistake,) = verdict.mistakes
    assert (mistake.step == 3 and "V" in str(mistake.what)) or "springs" in str(mistake.what)
    assert [f.follows for f in verdict.findings] == [False, True, True]


def test_the_same_mistake_in_two_bodies_is_told_of_both() -> None:
    s = lg.System("two hanging blocks")
    x, y = s.coordinates("x y")
    m1, m2, m3 = s.parameters("m1 m2 m3")
    for m, h, name in ((m1, -x, "one"), (m2, x - y, "two"), (m3, x + y, "three")):
        s.particle(m, at=s.point(name, (0, h)), name=name)
    s.gravity()
    named = (
        s.derive()
        .check("(m1 + m2 + m3)*x'' + (m3 - m2)*y'' - m1*g = 0\n(m2 + m3)*y'' + (m3 - m2)*x'' + (m3 - m2)*g = 0")
        .mistakes
    )
    words = " ".join(str(m.what) for m in named)
    assert "'two'" in words and "'three'" in words


def test_a_letter_by_which_an_equation_was_divided_names_no_element(drum: lg.Derivation) -> None:
    answer = "m*x'' - m*g + k1*(x - R*phi) = 0\nJ*phi''/c - k1*R*(x - R*phi)/c + k2*r^2*phi/c + r^2*phi' - m*g*R/c = 0"
    (mistake,) = drum.check(answer).mistakes
    assert "brake" not in str(mistake.what) and mistake.element != "damper 'brake'"


def test_a_heading_with_the_form_of_the_equations_is_no_equation(drum: lg.Derivation) -> None:
    rows = (
        "M q'' + K q = f:\nm*x'' - m*g + k1*(x - R*phi) = 0\nJ*phi'' - k1*R*(x - R*phi) + k2*r^2*phi + c*r^2*phi' = 0"
    )
    assert drum.check(rows, hint=0).right
    verdict = drum.check(rows.replace("k2*r^2", "k2*r"))
    (mistake,) = verdict.mistakes
    assert mistake.element == "spring 'holder'"
    with pytest.raises(lg.ParseError, match="what is 'K'"):
        drum.check("M q'' + K q = f")


def test_a_spring_may_be_given_the_way_of_a_drum() -> None:
    """s is already the elongation of the second rope; s − r φ was taken for it."""
    s = lg.System("winch")
    phi, way = s.coordinates("phi s")
    m, J, r, k = s.parameters("m J r k")
    s.rigid_body(m, J, at=s.origin, frame=s.frame(phi, name="drum"), name="drum")
    s.particle(m, at=s.point("A", (0, -r * phi - way)), name="load")
    s.spring(k, deflection=way, name="rope")
    d = s.derive()
    (mistake,) = d.check(
        "(J + m*r^2)*phi'' + m*r*s'' - k*r*(s - r*phi) = 0\nm*(r*phi'' + s'') + k*(s - r*phi) = 0"
    ).mistakes
    assert mistake.element == "spring 'rope'" and "-r*phi + s" in str(mistake.what)


# -- lengths and angles that are sums, what rolls, what is carried -----------------------------------------------------


@pytest.fixture(scope="module")
def trough() -> lg.Derivation:
    """A cylinder that rolls in a trough on a cart, which is shaken: ω = −(R − r) φ'/r."""
    s = lg.System("trough")
    x, phi = s.coordinates("x phi")
    M, m, R, r, J, k, A, nu = s.parameters("M m R r J k A nu")
    at = s.point("C", (x + A * sp.sin(nu * s.t), 0))
    s.particle(M, at=at, name="cart")
    turning = s.frame(-(R - r) / r * phi, name="cylinder")
    s.rigid_body(m, J, at=at + ((R - r) * sp.sin(phi), -(R - r) * sp.cos(phi)), frame=turning, name="cylinder")
    s.gravity()
    s.spring(k, deflection=x, name="spring")
    return s.derive()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("slip", "said"),
    [
        ("radius", "R stands in place of R - r"),
        ("omega", "not phi'"),
        ("rolling", "x'/r"),
        ("spring", "The deflection of spring 'spring' is taken as -A*sin(nu*t) + x"),
    ],
)
def test_sums_rolling_and_carried_ends(trough: lg.Derivation, slip: str, said: str) -> None:
    """T* and V are written by hand with the slip, the equations by SymPy from them."""
    (x, phi), model = trough.coordinates, trough.model
    M, m, R, r, J, k, A, nu, g = (p.symbol for p in model.parameters)
    a = R if slip == "radius" else R - r
    carried, angle = x + A * sp.sin(nu * time), a * phi / r
    angle = {"omega": phi, "rolling": angle + x / r}.get(slip, angle)
    u, w = carried.diff(time), a * phi.diff(time)
    T = M * u**2 / 2 + m * (u**2 + 2 * u * w * sp.cos(phi) + w**2) / 2 + J * angle.diff(time) ** 2 / 2
    delta = x - A * sp.sin(nu * time) if slip == "spring" else x
    V = k * delta**2 / 2 - m * g * (R - r) * sp.cos(phi)
    rows = [sp.Eq((T.diff(q.diff(time)).diff(time) - T.diff(q) + V.diff(q)).doit(), 0) for q in (x, phi)]
    (mistake,) = trough.check(rows).mistakes
    assert said in str(mistake.what), str(mistake.what)
