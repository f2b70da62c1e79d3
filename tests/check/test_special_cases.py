"""What an answer says of special cases below right equations is judged in these: at rest, at the start, for J = 0.

Oracle: a puck on a spring along a turning rod, (J + m r²) φ'' + 2 m r r' φ' = M and m r'' − m r φ'² + k (r − a) = 0.
With φ' constant and r at rest, r = k a/(k − m φ'²); at the start, φ'' = M/(J + m a²); for J = 0,
φ'' = (M/r − 2 m r' φ')/(m r). A pendulum that a force F holds at an angle θ: F = m g sin θ.
"""

from __future__ import annotations

import pytest
import sympy as sp
from small_systems import rod
from test_beside_at_rest import FLIES, helicopter

import lagrangian as lg
from built_in import derivation
from lagrangian.check.reference import truth_of
from lagrangian.check.special_cases import INFINITE, follows
from lagrangian.check.verdict import Status

ROD = "(J + m r^2) phi'' + 2 m r r' phi' = M\nm r'' - m r phi'^2 + k (r - a) = 0\n\n"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("below", "right"),
    [
        ("Start from rest at r(0) = a, r'(0) = 0, phi'(0) = 0: phi''(0) = M/(J + m a^2)", True),
        ("Start from rest at r(0) = a, r'(0) = 0, phi'(0) = 0: phi''(0) = M/(J + m a)", False),
        ("Start: r = a, r' = 0, phi' = 0, so\n  phi'' = M/(J + m a^2)\n  r'' = 0", True),
        ("Start: r = a, r' = 0, phi' = 0, so\n  phi'' = M/(J - m a^2)", False),
        ("With constant phi' the puck stays where r (k - m phi'^2) = k a", True),
        ("With constant phi' the puck stays where r (k + m phi'^2) = k a", False),
        ("J → 0: r (m r phi'' + 2 m r' phi') = M remains", True),
        ("a massless rod turns with (here J = 0)\nm r^2 phi'' + 2 m r r' phi' = M", True),
        ("What if r' = 0 just then? (J + m r^2) phi'' = M, M does all for the rod.", True),
        ("I took t = 2 s for the plot.", True),
        ("Stiffness near the axis: K = k - m W^2", True),
        ("Linearized near rest: D = 0.61, T = 2.5 s", True),
        ("As in the lecture, where the bead has no spring: there r'' - r phi'^2 = 0.", True),
    ],
)
def test_what_is_said_of_a_case_below_right_equations_is_judged_there(below: str, right: bool) -> None:
    assert rod().check(ROD + below).right is right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("below", "right"),
    [
        ("Held at theta = 90°: F = m g", True),
        ("Which F holds it? theta' = theta'' = 0:\n   F = m g sin(theta)", True),
        ("Which F holds it? theta' = theta'' = 0:\n   F = m g cos(theta)", False),
        ("$\\dot\\theta = \\ddot\\theta = 0$: $F = m g \\sin\\theta$", True),
        ("$\\dot\\theta = \\ddot\\theta = 0$: $F = m g \\tan\\theta$", False),
    ],
)
def test_what_holds_a_position_is_judged_at_rest(below: str, right: bool) -> None:
    assert helicopter().check(FLIES + below).right is right


def test_a_case_that_is_right_is_told_with_what_it_holds_for() -> None:
    verdict = rod().check(ROD + "Start: r = a, r' = 0, phi' = 0, so\n  phi'' = M/(J + m a^2)")
    assert "is right for phi' = 0, r = a, r' = 0" in " ".join(map(str, verdict.notes))


@pytest.mark.parametrize("mark", ["[{}]", "({})"])
def test_numbers_behind_terms_that_lines_below_explain_are_no_factors(mark: str) -> None:
    one, two = mark.format(1), mark.format(2)
    terms = f"(J + m r^2) phi'' {one} + 2 m r r' phi' {{}} = M\nm r'' - m r phi'^2 + k (r - a) = 0\n\n"
    legend = f"{one} comes from the inertia of both\n{two} from d/dt of r^2, Coriolis"
    assert rod().check(terms.format(two) + legend).right
    assert rod().check(terms.format("") + legend).right
    wrong = terms.format(two).replace("2 m r r'", "m r r'")
    assert rod().check(wrong + legend).status is Status.WRONG


def test_an_equation_follows_from_those_of_motion_for_given_values_or_does_not() -> None:
    truth = truth_of(rod())
    r, phi = truth.model.coordinates
    m, J, k, a = (p.symbol for p in truth.model.parameters)
    M = truth.model.inputs[0].symbol
    zero = sp.S.Zero
    steady = r.symbol - k * a / (k - m * phi.rate**2)
    assert follows(truth, steady, {r.acceleration: zero, phi.acceleration: zero})
    assert not follows(truth, steady, {phi.acceleration: zero})
    assert not follows(truth, r.acceleration, {r.acceleration: zero})  # it only says the case
    assert not follows(truth, sp.Symbol("q") - M, {phi.rate: zero})  # the system has no q
    heavy = {J: INFINITE}
    assert follows(truth, phi.acceleration, heavy)
    assert not follows(truth, r.acceleration, heavy)
    start = {r.symbol: a, r.rate: zero, phi.rate: zero}
    assert follows(truth, phi.acceleration * (J + m * a**2) - M, start)
    assert not follows(truth, phi.acceleration * (J + m * a**2) - 2 * M, start)


@pytest.mark.parametrize(("value", "right"), [("21.8", True), ("21.8°", True), ("25.8°", False)])
def test_a_rounded_angle_is_one_of_the_number_that_its_tangent_has(value: str, right: bool) -> None:
    s = lg.System("lever at rest")
    theta = s.coordinate("theta")
    m, a, b, g = s.parameters("m a b g", m=2, a=0.4, b=1, g=10)
    s.particle(m, at=s.point("P", (a * sp.cos(theta) - b * sp.sin(theta), -a * sp.sin(theta) - b * sp.cos(theta))))
    s.gravity((0, -1), g)
    equation = "m (a^2 + b^2) theta'' - m g a cos(theta) + m g b sin(theta) = 0\n"
    angle = value if value.endswith("°") else f"{value}°"
    answer = f"{equation}\nequilibrium: tan(theta_0) = a/b = 0.4/1 = 0.4 → theta_0 = {angle}"
    assert s.derive().check(answer).right is right


@pytest.mark.parametrize(
    "table",
    [
        "J phi''      kg m^2 / s^2 = N m   ok\nm r r' phi'  kg m m/s /s = N m  ok",
        "k (r - a)     (N/m) m = N",
        "J φ̈      kg m² / s² = N m",
    ],
)
def test_terms_with_their_units_are_no_statements(table: str) -> None:
    assert rod().check(f"{ROD}Units:\n{table}").right


@pytest.mark.parametrize(("force", "right"), [("k (r - a)", True), ("2 k (r - a)", False)])
def test_units_in_square_brackets_behind_terms_are_no_factors(force: str, right: bool) -> None:
    second = f"m r''    [kg m/s² = N]\n- m r phi'^2    [kg m /s² = N]\n+ {force}   [N/m · m = N]\n= 0\n"
    assert rod().check("(J + m r^2) phi'' + 2 m r r' phi' = M\n" + second).right is right


@pytest.mark.parametrize(("coriolis", "right"), [("2 m r r' phi'", True), ("m r r' phi'", False)])
def test_equations_may_stand_beside_virtual_displacements(coriolis: str, right: bool) -> None:
    one = f"Only phi moves: [M - (J + m r^2) phi'' - {coriolis}] δphi = 0"
    assert rod().check(f"{one}\nOnly r moves: [m r phi'^2 - k (r - a) - m r''] δr = 0").right is right


@pytest.mark.parametrize("letter", ["δ₁", "δ1", "δ_1"])
def test_a_letter_delta_with_a_number_is_no_variation(letter: str) -> None:
    answer = f"With {letter} = r - a:\n" + ROD.replace("(r - a)", letter)
    assert rod().check(answer).right
    assert not rod().check(answer.replace("r - a:", "r + a:")).right


def test_small_motions_about_a_tilted_rest_are_of_first_order_in_every_angle() -> None:
    s = lg.System("bob on a slope")
    x, theta = s.coordinates("x theta")
    m, M, l, g, alpha = s.parameters("m M l g alpha")
    s.particle(M, at=s.point("A", (x, 0)))
    s.particle(m, at=s.point("B", (x + l * sp.sin(theta - alpha), -l * sp.cos(theta - alpha))))
    s.gravity((-sp.sin(alpha), -sp.cos(alpha)), g)
    s.force(s.input("F"), deflection=x)
    derivation = s.derive()
    exact = (
        "(M + m) x'' + m l theta'' cos(theta - alpha) - m l theta'^2 sin(theta - alpha) + (M + m) g sin(alpha) = F\n"
        "m l^2 theta'' + m l x'' cos(theta - alpha) + m g l sin(theta) = 0\n\nSmall motions, F = F0 + f:\n"
    )
    small = "(M + m) x'' + m l cos(alpha) theta'' = F - (M + m) g sin(alpha)\n"
    second = "m l^2 theta'' + m l cos(alpha) x'' + m g l theta = 0"
    assert derivation.check(exact + small + second).right
    assert not derivation.check(exact + small.replace("cos(alpha)", "sin(alpha)") + second).right


@pytest.mark.parametrize(
    "said",
    [
        "Divided by sin θ, which fails where sin θ = 0. So the equation above is kept.",
        "This cannot be solved where sin θ = 0 or cos θ = 0, at the ends.",
        "It fails wherever sin(θ) = 0",
        "Dividing by it fails where\nsin θ = 0.",
    ],
)
def test_where_a_function_vanishes_is_no_equation(said: str) -> None:
    row = "m L^2 θ'' + b θ' + m g L sin θ = 0"
    assert derivation("pendulum").check(f"{row}\n{said}").right
    assert not derivation("pendulum").check(f"{row.replace('+ b', '- b')}\n{said}").right
    assert not derivation("pendulum").check(f"{row.replace('sin θ', 's')}\nwhere s = cos θ = 0").right


@pytest.mark.parametrize(("inertia", "right"), [("2mL²/3", True), ("2mL^2/3", True), ("mL²/3", False)])
def test_a_product_glued_to_a_number_is_no_volume(inertia: str, right: bool) -> None:
    s = lg.System("two rods on a shaft")
    theta = s.coordinate("theta")
    m, L = s.parameters("m L")
    s.kinetic(2 * m * L**2 / 3 * theta.diff() ** 2 / 2)
    s.torque(s.input("M"), on=theta)
    assert s.derive().check(f"I0 theta'' = M\nwhere I0 = {inertia}").right is right
