"""Names of which an answer only says what their rates are: w = angular velocity of the disc, so dw/dt = phi''.

Oracle: by hand, a puck on a spring along a rod that a motor turns,

    m (r̈ − r φ̇²) + k (r − a) = 0,   (J + m r²) φ̈ + 2 m r ṙ φ̇ = M
"""

import pytest
from small_systems import rod

from lagrangian.check.verdict import Status

EQUATIONS = """
T = m (r'^2 + r^2 w^2)/2 + J w^2/2
m (r'' - r w^2) + k (r - a) = 0
(J + m r^2) w' + 2 m r r' w = M"""
SAID = {
    "in a list": "w = angular velocity of the rod, so dw/dt = phi''.",
    "behind another name": "u = distance of the puck (= r of the sheet), w = angular velocity, so dw/dt = phi''.",
    "i.e.": "w = angular velocity of the rod, i.e. w' = phi''.",
    "in brackets": "w = angular velocity of the rod (dw/dt = phi'')",
    "alone": "w' = phi''",
    "below": "",
}


@pytest.mark.sampled(6)
@pytest.mark.parametrize("said", SAID)
def test_the_name_is_the_velocity(said: str) -> None:
    equations = EQUATIONS if said != "below" else EQUATIONS.strip() + "\nw' = phi''"
    equations = equations.replace("r", "u") if "another" in said else equations
    verdict = rod().check(SAID[said] + equations)
    assert verdict.right
    assert any("w was read as phi'" in str(x).replace("'w'", "w") for x in verdict.notes)
    for right, wrong in (("w^2)/2", "w^2)"), ("2 m r", "m r"), ("2 m u", "m u"), ("k (", "2 k (")):
        if right in equations:
            assert rod().check(SAID[said] + equations.replace(right, wrong)).status is Status.WRONG


def test_a_sum_and_a_multiple_of_rates() -> None:
    """v is the speed of the puck's image in a mirror, −2 ṙ, and w that of a wheel that turns with the rod."""
    equations = "v' = -2 r''\nw' = 3 phi''\nm (-v'/2 - r w^2/9) + k (r - a) = 0\n(J + m r^2) w'/3 - m r v w/3 = M"
    assert rod().check(equations).right
    assert not rod().check(equations.replace("w^2/9", "w^2/3")).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("rate", ["dw/dt", "w'", "wdot"])
def test_words_in_front_of_a_sum(rate: str) -> None:
    """v is the speed of a mark on a tape that the motor winds: v = a φ̇ + ṙ."""
    said = f"w = speed of the mark on the tape, so {rate} = r'' + a phi''.\n"
    equations = "m (r'' - r (w - r')^2/a^2) + k (r - a) = 0\n(J + m r^2) (w' - r'')/a + 2 m r r' (w - r')/a = M"
    assert rod().check(said + equations).right
    assert not rod().check(said.replace("a phi", "2 a phi") + equations).right
    assert not rod().check(said.replace("+ a phi", "- a phi") + equations).right


def test_latex_too() -> None:
    said = r"$\dot\omega = \ddot\varphi$, $m(\ddot r - r\omega^2) + k(r - a) = 0$, "
    said += r"$(J + m r^2)\dot\omega + 2 m r\dot r\omega = M$"
    assert rod().check(said).right
    assert not rod().check(said.replace("+ 2 m", "- 2 m")).right


def test_an_equation_of_motion_says_nothing_of_a_name() -> None:
    """w' = M/J is no rate of a coordinate, and a w that something else explains stays that."""
    explained = "w = phi'\nw' = phi''\nm (r'' - r w^2) + k (r - a) = 0\n(J + m r^2) w' + 2 m r r' w = M"
    verdict = rod().check(explained)
    assert verdict.right
    assert not any("what its rate is" in str(x) for x in verdict.notes)
    assert not rod().check(explained.replace("w = phi'", "w = 2 phi'")).right
