"""A mistake is told where it was made: in a part that stands alone above the line which puts it in.

Oracle: by hand, a winch with a gear and a pendulum on a cart; see `small_systems`.
"""

from __future__ import annotations

import pytest
from small_systems import pushed_cart, winch

RIGHT_T = "T = 1/2 (m r² + J + n² I) φ'²\nV = - m g r φ\n"
LEFT = "(m r² + J + n² I) φ'' + c φ' - m g r"


def first(system: object, answer: str) -> tuple[int, str]:
    """The number of the first wrong line, and all that is told."""
    verdict = system.check(answer)  # type: ignore[attr-defined]
    assert not verdict.right and verdict.first_wrong is not None
    return verdict.first_wrong.line.number, " ".join(str(verdict).split())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("above", "force", "line"),
    [
        ("* foot: F (a/r) δφ\n* brake: −B δφ\n", "F a/r - B - c φ'", 4),
        ("φ alone: the foot goes down, W = F δφ\nbrake: W = -n B δφ\n", "F - n B - c φ'", 3),
        ("power of the bearing: P_c = -c (r φ')²\n", "F a/r - n B - c r² φ'", 3),
    ],
)
def test_work_and_power(above: str, force: str, line: int) -> None:
    number, said = first(winch(), f"{RIGHT_T}{above}Ξ_φ = {force}\n{LEFT} = {force} + c φ'")
    assert number == line and f"Look at line {line}" in said
    assert f"because of line {line}" in said


def test_a_list_of_the_terms_of_a_line() -> None:
    above = "Moments on the drum:\n  weight:  + m g r\n  brake:   − n B\n  foot:    + F a/r\n  bearing: + c φ'\n"
    number, said = first(winch(), f"{above}(m r² + J + n² I) φ'' = m g r - n B + F a/r + c φ'")
    assert number == 5 and "c φ̇ has the wrong sign" in said


def test_a_force_alone_is_not_blamed() -> None:
    """B is the right torque of the brake on its shaft: it is put in without its ratio."""
    number, _ = first(winch(), f"torque of the brake on its shaft: B\n{LEFT} = F a/r - B")
    assert number == 2


def test_signs_that_nothing_says_are_not_blamed() -> None:
    above = "weight: m g r\nbrake: n B\nfoot: F a/r\n"
    number, _ = first(winch(), f"{above}(m r² + J + n² I) φ'' + c φ' = m g r + n B + F a/r")
    assert number == 4


def test_half_a_term_is_not_blamed() -> None:
    """One of two weights is listed, which is right."""
    number, _ = first(winch(), f"gravity: m g r\nbrake: − n B\nfoot: + F a/r\n{LEFT} - m g r = F a/r - n B")
    assert number == 4


def test_a_derivative_said_of_what_stands_above() -> None:
    answer = (
        "dL/dx' = (M + m) x' + m l cos(theta) theta'\n"
        "  d/dt of it: (M + m) x'' + m l cos(theta) theta'' + m l sin(theta) theta'^2\n"
        "(M + m) x'' + m l cos(theta) theta'' + m l sin(theta) theta'^2 + k x = F - b x'\n"
        "m l cos(theta) x'' + m l^2 theta'' + m g l sin(theta) = F l cos(theta)"
    )
    number, _ = first(pushed_cart(), answer)
    assert number == 2


def test_the_place_behind_a_label() -> None:
    right = (
        "bob:  (x + l sin θ, −l cos θ)\n"
        "T = ½ M ẋ² + ½ m (ẋ² + 2 l ẋ θ̇ cos θ + l² θ̇²)\nV = ½ k x² − m g l cos θ\n"
        "(M + m) ẍ + m l cos θ θ̈ − m l sin θ θ̇² + k x = F − b ẋ\n"
        "m l cos θ ẍ + m l² θ̈ + m g l sin θ = F l cos θ"
    )
    assert pushed_cart().check(right).right
    wrong = (
        right.replace("(x + l sin", "(x − l sin").replace("+ 2 l ẋ", "− 2 l ẋ").replace("m l cos θ ẍ", "− m l cos θ ẍ")
    )
    wrong = wrong.replace("+ m l cos θ θ̈ − m l sin θ θ̇²", "− m l cos θ θ̈ + m l sin θ θ̇²")
    number, said = first(pushed_cart(), wrong)
    assert number == 1 and "the position of particle 'bob'" in said


def test_a_speed_in_a_table() -> None:
    answer = (
        "weight  v = r φ'\nshaft   turning φ'\n"
        "T = 1/2 m r² φ'² + 1/2 J φ'² + 1/2 I φ'²\nV = -m g r φ\n"
        "(m r² + J + I) φ'' + c φ' - m g r = F a/r - n B"
    )
    number, _ = first(winch(), answer)
    assert number == 2


def test_a_bold_beginning_is_no_product_that_goes_on() -> None:
    above = "**Speed of the bob.** It moves with l(θ̇ + ẋ) across the rod\n\n"
    wrong = "m l cos θ ẍ + m l² θ̈ − m g l sin θ = F l cos θ"
    _, said = first(pushed_cart(), f"{above}(M + m) ẍ + m l cos θ θ̈ − m l sin θ θ̇² + k x = F − b ẋ\n{wrong}")
    assert "line 1 above it was not judged" in said
    _, said = first(
        pushed_cart(), f"**Equation of θ̈**\n(M + m) ẍ + m l cos θ θ̈ − m l sin θ θ̇² + k x = F − b ẋ\n{wrong}"
    )
    assert "that is the first that is not right" in said and "of what was judged" not in said
