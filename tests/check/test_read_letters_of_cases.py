"""Letters of an answer's own: one that stands for several values in several cases, the components of a point, one that
is explained in brackets behind an equation, and words that only seem to say what a letter is.

Oracle: by hand, a trolley on a spring with a hanging rod, whose centre is e below the pin:

    (M + m) ẍ + m e φ̈ cos φ − m e φ̇² sin φ + k x = F
    (J + m e²) φ̈ + m e ẍ cos φ + m g e sin φ = 0

with the centre at x = x + e sin φ, y = −e cos φ. Every form has a wrong twin.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

from lagrangian import Derivation, System
from lagrangian.errors import ParseError

ALONG = "(M + m) x'' + m e phi'' cos(phi) - m e phi'^2 sin(phi) + k x = F"
ROUND = "(J + m e^2) phi'' + m e x'' cos(phi) + m g e sin(phi) = 0"
FALSE = ROUND.replace("+ m g e", "- m g e")


@cache
def trolley() -> Derivation:
    """A trolley on a spring with a rod that hangs from it."""
    sys = System("trolley with a rod")
    x, phi = sys.coordinate("x"), sys.coordinate("phi")
    M, m, J, e, k, g = sys.parameters("M m J e k g", M=3, m=2, J=0.4, e=0.5, k=80, g=9.81)
    sys.particle(M, at=sys.point("T", (x, 0)), name="trolley")
    centre = sys.point("C", (x + e * sp.sin(phi), -e * sp.cos(phi)))
    sys.rigid_body(mass=m, inertia=J, at=centre, frame=sys.frame(phi, name="rod"), name="rod")
    sys.gravity(direction=(0, -1), g=g)
    sys.spring(k, deflection=x)
    sys.force(sys.input("F"), deflection=x)
    return sys.derive()


def right(text: str) -> bool:
    """Whether an answer to the trolley is right."""
    return trolley().check(text, hint=0).right


def told(text: str) -> str:
    """What is told on an answer to the trolley."""
    return trolley().check(text).to_text()


def test_the_equations_are_right() -> None:
    assert right(f"{ALONG}\n{ROUND}")
    assert not right(f"{ALONG}\n{FALSE}")


CASES = [
    "s = 0 for the trolley, s = e for the rod",
    "At the trolley s = 0, at the centre of the rod s = e.",
    "trolley: mass M   (s = 0)\nrod: mass m       (s = e)",
    "(for the ends: s = 0 for the pin, s = 2 e for the tip)",
]
GENERAL = "a = x'' + s phi'' cos(phi) - s phi'^2 sin(phi)"


@pytest.mark.sampled(3)
@pytest.mark.parametrize("cases", CASES)
def test_a_letter_with_a_value_for_each_case_is_no_mistake(cases: str) -> None:
    said = told(f"{cases}\n{GENERAL}\n{ALONG}\n{ROUND}")
    assert "s stands for several values" in said and "not right" not in said
    assert right(f"{cases}\n{GENERAL}\n{ALONG}\n{ROUND}")
    assert not right(f"{cases}\n{GENERAL}\n{ALONG}\n{FALSE}")


def test_squares_of_speeds_by_body() -> None:
    speeds = "v² = x'² for the trolley, v² = x'² + 2 e x' phi' cos(phi) + e² phi'² for the rod"
    energy = "T = ½ M v² + ½ m v² + ½ J phi'²"
    assert right(f"{speeds}\n{energy}\n{ALONG}\n{ROUND}")
    assert not right(f"{speeds}\n{energy}\n{ALONG}\n{FALSE}")


@pytest.mark.parametrize(
    "cases",
    [
        "$s = 0$ for the trolley, $s = e$ for the rod.",
        "$s = 0$ for $T$, $s = e$ for $C$.",
        "At the trolley $s = 0$, at the centre $s = e$.",
    ],
)
def test_cases_in_latex(cases: str) -> None:
    cases += "\n$a = \\ddot x + s \\ddot\\varphi$ for small angles"
    along = r"\[(M + m) \ddot x + m e \ddot\varphi \cos\varphi - m e \dot\varphi^2 \sin\varphi + k x = F\]"
    round_ = r"\[(J + m e^2) \ddot\varphi + m e \ddot x \cos\varphi + m g e \sin\varphi = 0\]"
    assert right(f"{cases}\n{along}\n{round_}")
    assert not right(f"{cases}\n{along}\n{round_.replace('+ m g', '- m g')}")


def test_two_values_without_cases_contradict_each_other() -> None:
    assert not right(f"s = 2 e\ns = e\n{ALONG}\n{ROUND.replace('m e^2', 'm s^2')}")
    assert not right(f"s = 0 for the pin, s = 0 for the pin\n{ALONG}\n{ROUND.replace('m e^2', 'm s^2')}")


def test_a_value_holds_up_to_the_next_one() -> None:
    speeds = "v = x' for the trolley\nT1 = 1/2 M v^2\nv = {way} for the rod\nT2 = 1/2 m v^2 + {turning}"
    way, turning = "x' + e phi' cos(phi)", "1/2 m e^2 phi'^2 sin(phi)^2 + 1/2 J phi'^2"
    assert right(f"{speeds.format(way=way, turning=turning)}\n{ALONG}\n{ROUND}")
    assert not right(f"{speeds.format(way=way.replace('+', '-'), turning=turning)}\n{ALONG}\n{ROUND}")


def test_values_that_nothing_uses_are_judged() -> None:
    speeds = "v = x' for the trolley, v = x' + e phi' cos(phi) for the rod"
    assert "the x component of the velocity of rigid body 'rod'" in told(f"{speeds}\n{ALONG}\n{ROUND}")


def test_a_greek_letter_behind_its_quantity_is_no_product() -> None:
    masses = "pin: M    (u = 0)\ncentre: m    (u = e)\nFor a point mass mu at u: weight: -mu g u sin(phi) dphi"
    said = told(f"{masses}\n{ALONG}\n{ROUND}")
    assert "mu as m u" not in said and right(f"{masses}\n{ALONG}\n{ROUND}")
    assert not right(f"{masses}\n{ALONG}\n{FALSE}")


CENTRE = "S = (x + e sin(phi), -e cos(phi))"
BALANCES = "M x'' + m {x}'' + k x = F\nJ phi'' + m e {x}'' cos(phi) {sign} m e {y}'' sin(phi) + m g e sin(phi) = 0"


@pytest.mark.parametrize(("x", "y"), [("xS", "yS"), ("x_S", "y_S"), ("S_x", "S_y"), ("Sx", "Sy")])
def test_components_of_a_point_are_no_products(x: str, y: str) -> None:
    assert right(f"{CENTRE}\n{BALANCES.format(x=x, y=y, sign='+')}")
    assert not right(f"{CENTRE}\n{BALANCES.format(x=x, y=y, sign='-')}")


def test_the_rates_of_components_are_judged() -> None:
    rates = "with xS'' = x'' + e phi'' cos(phi) {} e phi'^2 sin(phi)\n     yS'' = e phi'' sin(phi) + e phi'^2 cos(phi)"
    balances = BALANCES.format(x="xS", y="yS", sign="+")
    assert right(f"{CENTRE}\n{rates.format('-')}\n{balances}")
    assert not right(f"{CENTRE}\n{rates.format('+')}\n{balances}")


@pytest.mark.sampled(4)
@pytest.mark.parametrize("axis", ["{}S", "{}_S", "S_{}"])
def test_rates_of_components_are_the_derivatives_of_the_point(axis: str) -> None:
    x, y = (axis.format(a) for a in "xy")
    rates = f"{x}' = x' + e phi' cos(phi), {y}' = {{}}e phi' sin(phi)"
    energy = f"T = 1/2 M x'^2 + 1/2 m ({x}'^2 + {y}'^2) + 1/2 J phi'^2"
    for said in (rates, f"{rates}\n{energy}"):
        answer = f"{CENTRE}\n{said}\n{ALONG}\n{ROUND}"
        assert right(answer.format(""))
        assert not right(answer.format("-"))
        assert not right(answer.format("").replace("S = (x + e", "S = (x - e"))


def test_energies_in_components_of_a_point() -> None:
    energies = "T = 1/2 M x'^2 + 1/2 m (xS'^2 {} yS'^2) + 1/2 J phi'^2\nV = 1/2 k x^2 + m g yS"
    assert right(f"{CENTRE}\n{energies.format('+')}\n{ALONG}\n{ROUND}")
    assert not right(f"{CENTRE}\n{energies.format('-')}\n{ALONG}\n{ROUND}")


@pytest.mark.parametrize("brackets", ["(a={})", "[a={}]", "( a = {} )."])
def test_a_letter_in_brackets_behind_an_equation_splits_products(brackets: str) -> None:
    glued = "(J+ma)phi''+mex''cos phi+mgesin phi=0   "
    assert right(f"{ALONG}\n{glued}{brackets.format('e^2')}")
    assert not right(f"{ALONG}\n{glued}{brackets.format('2e^2')}")


@pytest.mark.parametrize("said", ["[ph: swing]", "   [ph: swing of the rod, to the right]", " [ph is the swing]"])
def test_what_a_letter_means_in_square_brackets_is_no_factor(said: str) -> None:
    along, turning, false = (x.replace("phi", "ph") for x in (ALONG, ROUND, FALSE))
    assert right(f"{along} {said}\n{turning} {said}")
    assert not right(f"{along} {said}\n{false} {said}")


def test_a_factor_in_square_brackets_remains_one() -> None:
    factor = ALONG.replace("= F", "+ k x [phi] = F")
    assert not right(f"{factor}\n{ROUND}")


@pytest.mark.parametrize(
    "short", ["i.e. Steiner about the pin", "i.e. it is about the pin", "e.g. Steiner", "d.h. Steiner"]
)
def test_short_words_with_points_end_no_sentence(short: str) -> None:
    meant = f"where J is that of the centre\nand J_P = J {{}} m e^2, {short}"
    answer = f"{ALONG}\n{ROUND.replace('(J + m e^2)', 'J_P')}\n{meant}"
    assert right(answer.format("+"))
    assert not right(answer.format("-"))


def test_what_belongs_to_a_letter_is_not_the_letter() -> None:
    forces = "trolley: M x'' = F - k x - A\nrod: m (x'' + e phi'' cos(phi) - e phi'^2 sin(phi)) = A"
    said = "Moments: the lever arm of A is e cos(phi).\n"
    assert "'A' was read as" not in told(f"{forces}\n{said}{ROUND}")
    assert right(f"{forces}\n{said}{ROUND}")
    assert not right(f"{forces}\n{said}{FALSE}")
    value = f"The value of A is m e^2.\n{ALONG}\n{ROUND.replace('m e^2', 'A')}"
    assert right(value) and not right(value.replace("is m e^2", "is m e"))


def test_a_letter_of_cases_in_the_equations_is_asked_about() -> None:
    with pytest.raises(ParseError, match="'s'"):
        right(f"s = k for the trolley, s = k + M for the rod\n{ALONG}\n{ROUND.replace('(J', '(s + J')}")
