"""Rates of an answer's own names, without the names themselves: velocities xs' of a point, momenta p' = F + H.

Oracle: by hand, a wheel on a spring with a pendulum of length s at its axle:

    (M + m + J/R²) ẍ + m s θ̈ cos θ − m s θ̇² sin θ + k x = F
    m s² θ̈ + m s ẍ cos θ + m g s sin θ = 0
"""

from functools import cache

import pytest
import sympy as sp

from lagrangian import Derivation, ParseError, System

WHEEL = "(M + m + J/R^2) x'' + m s theta'' cos(theta) - m s theta'^2 sin(theta) + k x = F"
BOB = "m s^2 theta'' + m s x'' cos(theta) + m g s sin(theta) = 0"
VELOCITIES = "xs' = x' + s theta' cos(theta)\nys' = s theta' sin(theta)"
T = "T = 1/2 (M + J/R^2) x'^2 + 1/2 m (xs'^2 + ys'^2)"


@cache
def wheel() -> Derivation:
    """A wheel that rolls, on a spring, with a pendulum at its axle."""
    sys = System("wheel with a pendulum")
    x, theta = sys.coordinates("x theta")
    M, J, R, m, s, k, g = sys.parameters("M J R m s k g", M=9, J=2, R=0.4, m=0.7, s=0.6, k=30, g=9.81)
    axle = sys.point("A", (x, R))
    sys.rigid_body(M, J, at=axle, frame=sys.frame(-x / R, name="wheel"), name="wheel")
    sys.particle(m, at=sys.point("B", (x + s * sp.sin(theta), R - s * sp.cos(theta))))
    sys.gravity(direction=(0, -1), g=g)
    sys.spring(k, deflection=x)
    sys.generalized_force(x, sys.input("F"))
    return sys.derive()


def accepted(written: str) -> bool:
    """Whether an answer is judged right; one that is refused is not."""
    try:
        return wheel().check(written, hint=0).right
    except ParseError:
        return False


@pytest.mark.sampled(4)
@pytest.mark.parametrize("sheet", [f"{VELOCITIES}\n{T}", f"{T}\n{VELOCITIES}", f"{T}\nwith {VELOCITIES}"])
def test_the_rate_of_a_point_is_a_name_though_its_letters_are_a_product(sheet: str) -> None:
    assert accepted(f"{sheet}\n{WHEEL}\n{BOB}")
    assert not accepted(f"{sheet.replace('= x', '= -x')}\n{WHEEL}\n{BOB}")
    assert not accepted(f"{sheet}\n{WHEEL}\n{BOB.replace('+ m g', '- m g')}")


def test_dots_stand_over_the_first_letter_of_such_a_name() -> None:
    sheet = "ẋs = ẋ + s θ̇ cos(θ)\nẏs = s θ̇ sin(θ)\nT = ½(M + J/R²)ẋ² + ½m(ẋs² + ẏs²)"
    assert accepted(f"{sheet}\n{WHEEL}\n{BOB}")
    assert not accepted(f"{sheet.replace('ẋ + s', 'ẋ - s')}\n{WHEEL}\n{BOB}")


@pytest.mark.slow
def test_a_velocity_in_an_own_coordinate_may_stand_below_the_energy() -> None:
    rows = f"{WHEEL}\n{BOB}".replace("theta", "p")
    velocities = VELOCITIES.replace("theta", "p")
    assert accepted(f"theta is p.\n{T}\n{velocities}\n{rows}")
    assert not accepted(f"theta is p.\n{T}\n{velocities.replace('sin', 'cos')}\n{rows}")


MOMENTUM = "p = (M + m) x' + m s theta' cos(theta)"


@pytest.mark.sampled(4)
@pytest.mark.parametrize("rate", ["p' =", "dp/dt =", "d/dt p ="])
def test_the_rate_of_a_momentum_with_a_force_that_accelerates_is_an_equation(rate: str) -> None:
    sheet = f"{MOMENTUM}\n{rate} F - k x + H\nJ x''/R = -H R\nso H = -J x''/R^2"
    assert accepted(f"{sheet}\n{WHEEL}\n{BOB}")
    assert accepted(f"{sheet}\n{BOB}")
    assert not accepted(f"{sheet.replace('- k x', '+ k x')}\n{BOB}")
    assert not accepted(f"{sheet.replace('-J', 'J')}\n{WHEEL}\n{BOB}")
    assert not accepted(sheet)


def test_a_wrong_derivative_of_a_momentum_stays_wrong() -> None:
    rate = "p' = (M + m) x'' + m s theta'' cos(theta) - m s theta'^2 sin(theta)"
    assert accepted(f"{MOMENTUM}\n{rate}\n{WHEEL}\n{BOB}")
    assert not accepted(f"{MOMENTUM}\n{rate.replace(' - ', ' + ')}\n{WHEEL}\n{BOB}")


@cache
def dragged() -> Derivation:
    """A cart with a pendulum whose bob is dragged through oil."""
    sys = System("bob in oil")
    x, theta = sys.coordinates("x theta")
    M, m, s, d = sys.parameters("M m s d")
    square = x.diff() ** 2 + 2 * s * x.diff() * theta.diff() * sp.cos(theta) + s**2 * theta.diff() ** 2
    sys.kinetic(M * x.diff() ** 2 / 2 + m * square / 2)
    sys.dissipation(d * square / 2)
    return sys.derive()


SPEED = "vB = (x' + s theta' cos(theta)) ex + s theta' sin(theta) ey\n"
SQUARE = "vB^2 = x'^2 + 2 s x' theta' cos(theta) + s^2 theta'^2\n"
DRAG = """Q_x = - d vB . dvB/dx' = - d (x' + s theta' cos(theta))
Q_theta = - d vB . dvB/dtheta' = - d (s^2 theta' + s x' cos(theta))
"""
MOTION = """T = 1/2 M x'^2 + 1/2 m vB^2
(M + m) x'' + m s theta'' cos(theta) - m s theta'^2 sin(theta) = - d (x' + s theta' cos(theta))
m s^2 theta'' + m s x'' cos(theta) = - d (s^2 theta' + s x' cos(theta))"""


@pytest.mark.parametrize("above", [SQUARE, SPEED + SQUARE])
def test_a_point_between_spaces_in_front_of_a_derivative_is_a_product(above: str) -> None:
    answer = above + DRAG + MOTION
    assert dragged().check(answer, hint=0).right
    assert not dragged().check(answer.replace("- d vB . dvB/dx'", "- 2 d vB . dvB/dx'"), hint=0).right
    assert not dragged().check(answer.replace("= - d (x' + s theta' cos(theta))\nQ", "= - d x'\nQ"), hint=0).right


def test_a_statement_may_begin_behind_a_point_with_the_derivative_of_an_energy() -> None:
    assert dragged().check(SQUARE + MOTION.replace("vB^2\n", "vB^2 . dT/dx = 0\n"), hint=0).right
