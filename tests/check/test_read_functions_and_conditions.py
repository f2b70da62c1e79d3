"""Functions of one coordinate with primes, conditions between products, and names behind words and numbers."""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

from built_in import derivation
from lagrangian import Derivation, System


@cache
def turntable() -> Derivation:
    """A turntable with two masses on a rope along its diameter: I(r) = J + m1 r² + m2 (l − r)²."""
    sys = System("turntable")
    phi, r = sys.coordinates("phi r")
    J, m1, m2, l, k, b = sys.parameters(
        "J m1 m2 l k b", J="3 kg*m^2", m1="2 kg", m2="1 kg", l="3 m", k="5 N/m", b="1 N*m*s"
    )
    tau = sys.input("tau")
    sys.rigid_body(0, J, at=sys.origin, frame=sys.frame(phi))
    for mass, distance in ((m1, r), (m2, r - l)):
        sys.particle(mass, at=sys.origin + (distance * cos(phi), distance * sin(phi)))
    sys.spring(k, deflection=r)
    sys.damper(b, deflection=phi)
    sys.torque(tau, on=phi)
    return sys.derive()


ALONG = "(m1+m2) r̈ - (m1 r - m2 (l-r)) φ̇² + k r = 0"
AROUND = "(J + m1 r² + m2 (l-r)²) φ̈ + 2 (m1 r - m2 (l-r)) ṙ φ̇ + b φ̇ = tau"

PRIMED = [
    "Θ(r) = J + m1 r² + m2 (l-r)²\nΘ φ̈ + Θ' ṙ φ̇ + b φ̇ = tau\n(m1+m2) r̈ - ½ Θ' φ̇² + k r = 0",
    "Θ(r) = J + m1 r² + m2 (l-r)², Θ'(r) = 2 m1 r - 2 m2 (l-r)\nΘ φ̈ + Θ'(r) ṙ φ̇ + b φ̇ = tau\n"
    "(m1+m2) r̈ - ½ Θ'(r) φ̇² + k r = 0",
    r"Let $\Theta(r) = J + m_1 r^2 + m_2(l-r)^2$."
    r" \[ \Theta\ddot\varphi + \Theta'\dot r\dot\varphi + b\dot\varphi = \tau \]"
    r" \[ (m_1+m_2)\ddot r - \tfrac12\Theta'\dot\varphi^2 + k r = 0 \]",
    "I(r) = J + m1 r^2 + m2 (l-r)^2\nI phi_dd + I' r_d phi_d + b phi_d = tau\n(m1+m2) r_dd - 1/2 I' phi_d^2 + k r = 0",
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("answer", PRIMED)
def test_a_prime_behind_a_function_of_a_coordinate_is_its_slope_where_rates_have_dots(answer: str) -> None:
    assert turntable().check(answer, hint=0).right
    assert not turntable().check(answer.replace("½", "").replace("1/2 I'", "I'").replace(r"\tfrac12", ""), hint=0).right


def test_a_prime_is_a_rate_where_rates_have_primes() -> None:
    around = "I(r) = J + m1 r^2 + m2 (l-r)^2\nI phi'' + I' phi' + b phi' = tau\n"
    along = "(m1+m2) r'' - (m1 r - m2 (l-r)) phi'^2 + k r = 0"
    assert turntable().check(around + along, hint=0).right
    assert not turntable().check(around.replace("I' phi'", "I' r' phi'") + along, hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "condition",
    [
        "If m₁r = m₂(l − r) there is no pull at all.",
        "There is no pull when m1 r = m2 (l - r).",
        "If m1*r = m2*(l - r), then the centre of mass stands on the axis.",
    ],
)
def test_a_condition_between_products_states_nothing(condition: str) -> None:
    assert turntable().check(f"{AROUND}\n{ALONG}\n{condition}", hint=0).right
    assert not turntable().check(f"{AROUND}\n{ALONG.replace('- (m1', '+ (m1')}\n{condition}", hint=0).right


def test_a_condition_in_latex_states_nothing() -> None:
    equations = r"""\[ (J + m_1 r^2 + m_2(l-r)^2)\ddot\varphi
    + 2(m_1r - m_2(l-r))\dot r\dot\varphi + b\dot\varphi = \tau \]
    \[ (m_1+m_2)\ddot r - (m_1 r - m_2 (l-r))\dot\varphi^2 + k r = 0 \]"""
    assert turntable().check(equations + "\nIf $m_1 r = m_2(l-r)$ there is no pull.", hint=0).right
    assert (
        not turntable()
        .check(equations.replace("+ k r", "- k r") + "\nIf $m_1 r = m_2(l-r)$ there is no pull.", hint=0)
        .right
    )


CART = "M_s x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + b x' = F"
POLE = "m l x'' cos theta + Js theta'' - m g l sin theta = 0"


@pytest.mark.parametrize(
    ("mass", "inertia"),
    [
        ("M_s = M + m", "Put Js = J + m l^2 (moment of inertia about the axle)."),
        ("2 M_s = 2 M + 2 m", "We write Js = J + m l^2."),
        ("and M_s = M + m", "For short Js = J + m l^2"),
    ],
)
def test_a_name_may_be_stated_behind_words_and_numbers(mass: str, inertia: str) -> None:
    assert derivation("cart-pole").check(f"{mass}\n{inertia}\n{CART}\n{POLE}", hint=0).right
    assert not derivation("cart-pole").check(f"{mass}\n{inertia.replace('+', '-')}\n{CART}\n{POLE}", hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("of", ["", "np.", "math."])
def test_degrees_turned_by_a_function_are_that_angle(of: str) -> None:
    slope = derivation("rolling-cylinder")
    right = f"(m + J/R^2)*x'' = m*g*sin(2*{of}radians(45) + {of}deg2rad(rad2deg(alpha)) - pi/2)"
    assert slope.check(right).right
    assert not slope.check(right.replace("45", "54")).right


@pytest.mark.parametrize(("angle", "right"), [("deg2rad(rad2deg(z(2)))", True), ("deg2rad(z(2))", False)])
def test_degrees_are_turned_in_programs_too(angle: str, right: bool) -> None:
    program = (
        f"function dz = cart(t, z)\nth = {angle}; w = z(4);\nA = [M + m, m*l*cos(th); m*l*cos(th), J + m*l^2];\n"
        "f = [F - b*z(3) + m*l*w^2*sin(th); m*g*l*sin(th)];\nqdd = A\\f;\ndz = [z(3); w; qdd(1); qdd(2)];\nend\n"
    )
    assert derivation("cart-pole").check(program).right is right
