"""Energies in parts by kind of motion, T1, T2, T3 without a sum, and what words and other lines say of a distance.

Oracle: by hand, two seats at the ends of arms that rise by β on a wheel of inertia J:

    T = ½ J ψ̇² + m (a + c cos β)² ψ̇² + m c² β̇²    V = 2 m g c sin β
"""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

import lagrangian as lg


@cache
def ride(both: bool = True) -> lg.Derivation:
    """A wheel with one seat, or with two on opposite sides."""
    s = lg.System("ride")
    psi, beta = s.coordinates("psi beta")
    J, m, a, c, b = s.parameters("J m a c b")
    away = a + c * cos(beta)
    s.kinetic(J * psi.diff(s.t) ** 2 / 2, name="wheel")
    s.particle(m, at=s.point("P", (away * cos(psi), away * sin(psi), c * sin(beta))), name="seat A")
    if both:
        s.particle(m, at=s.point("Q", (-away * cos(psi), -away * sin(psi), c * sin(beta))), name="seat B")
    s.gravity((0, 0, -1))
    s.damper(b, deflection=psi, name="bearing")
    return s.derive()


PARTS = """Kinetic energies
  wheel     T1 = 1/2 J psi'^2
  carrying  T2 = m (a + c cos(beta))^2 psi'^2
  rising    T3 = m c^2 beta'^2
V = 2 m g c sin(beta)
"""
ROWS = """
dT/dpsi' = (J + 2 m (a + c cos(beta))^2) psi'
(J + 2 m (a + c cos(beta))^2) psi'' - 4 m c (a + c cos(beta)) sin(beta) beta' psi' = -b psi'
2 m c^2 beta'' + 2 m c (a + c cos(beta)) sin(beta) psi'^2 + 2 m g c cos(beta) = 0
"""


def statuses(found: lg.CheckedAnswer) -> dict[int, str]:
    """What is told of each line."""
    return {f.line.number: "right" if f.status.right else "follows" if f.follows else "wrong" for f in found.findings}


@pytest.mark.slow
def test_parts_by_kind_of_motion_that_are_right() -> None:
    found = ride().check(PARTS + ROWS)
    assert found.right and set(statuses(found).values()) == {"right"}, found.to_text()
    assert {2, 3, 4} <= statuses(found).keys() and "was not judged" not in found.to_text(), found.to_text()


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("right", "slip", "line"),
    [
        ("T3 = m c", "T3 = 1/2 m c", 4),
        ("T3 = m c^2", "T3 = m a^2", 4),
        ("T2 = m (", "T2 = 1/2 m (", 3),
        ("T2 = m (a + c cos(beta))", "T2 = m (a + c sin(beta))", 3),
        ("T1 = 1/2 J", "T1 = J", 2),
    ],
)
@pytest.mark.parametrize("summed", ["", "T = T1 + T2 + T3\n"])
def test_the_part_that_is_wrong_is_told(right: str, slip: str, line: int, summed: str) -> None:
    """A part that has whole terms of the energy is right, though it is of no one body."""
    found = ride().check(PARTS.replace(right, slip) + summed + ROWS)
    told = statuses(found)
    assert not found.right and all(told.get(k) != "wrong" for k in {2, 3, 4} - {line}), found.to_text()
    assert told[line] == "wrong", found.to_text()
    assert not summed or told[6] == "follows", found.to_text()


def test_parts_of_which_two_may_lack_a_term_are_not_told_apart() -> None:
    """T2 has whole terms, T1 has not, and what is missing has rates that T1 does not: nothing says whose it is."""
    answer = PARTS.replace("T1 = 1/2 J", "T1 = J").replace("(a + c cos(beta))^2", "(a^2 + c^2 cos(beta)^2)")
    found = ride().check(answer + ROWS)
    assert not found.right and statuses(found).get(3) != "right", found.to_text()


SHEET = """
distance from the axle  p = a + c {f}(beta)
height                  z = c sin(beta)
T = 1/2 J psi'^2 + {n} ((a + c {f}(beta))^2 psi'^2 + c^2 beta'^2)
V = {n} 2 g z
"""


@pytest.mark.sampled(6)
@pytest.mark.parametrize(("both", "n"), [(True, "m"), (False, "1/2 m")])
@pytest.mark.parametrize("more", ["", " + m g a beta"])
def test_a_distance_is_no_height_from_another_place(both: bool, n: str, more: str) -> None:
    right = ride(both).check(SHEET.format(f="cos", n=n) + ROWS * both)
    assert right.right and statuses(right)[2] == "right", right.to_text()
    wrong = ride(both).check(SHEET.format(f="sin", n=n).replace("g z", f"g z{more}"))
    told = statuses(wrong)
    assert not wrong.right and told.get(2) != "right" and told[3] == "right", wrong.to_text()
    if not more:
        assert told[2] == "wrong" and told[4] == "follows", wrong.to_text()


def test_a_distance_without_words_is_not_right_where_a_wrong_energy_moves_with_it() -> None:
    answer = "p = a + c sin(beta)\nT = 1/2 J psi'^2 + m p^2 psi'^2 + m c^2 beta'^2 + m a^2 beta'^2\n"
    assert statuses(ride().check(answer)).get(1) != "right"
    height = "h = a + c sin(beta)\nV = 2 m g h\nT = 1/2 J psi'^2 + m c^2 beta'^2\n"
    assert statuses(ride().check(height))[1] == "right"


SPEEDS = """
around the axle  v1 = (a + c cos(beta)) psi'
of the rising    v2 = {v2}
perpendicular:   v^2 = {square}
T = 1/2 J psi'^2 + m (a + c cos(beta))^2 psi'^2 + m {T} beta'^2
V = 2 m g c sin(beta)
"""


def test_a_sum_of_squares_of_a_wrong_speed_is_no_second_mistake() -> None:
    right = ride().check(SPEEDS.format(v2="c beta'", square="v1^2 + v2^2", T="c^2") + ROWS)
    assert right.right, right.to_text()
    wrong = ride().check(SPEEDS.format(v2="a beta'", square="v1^2 + v2^2", T="a^2"))
    told = statuses(wrong)
    assert told[2] == "right" and told[3] == "wrong" and told.get(4) != "wrong" and told[5] == "follows"
    assert len(wrong.mistakes) == 1, wrong.to_text()


def test_a_sum_of_squares_that_is_wrong_itself_is_told() -> None:
    answer = SPEEDS.format(v2="c beta'", square="v1^2 + 2 v2^2", T="2 c^2")
    told = statuses(ride().check(answer))
    assert told[3] == "right" and told.get(4) != "right" and told[5] != "right", told
