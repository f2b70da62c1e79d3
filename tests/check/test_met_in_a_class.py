"""Further habits of a class: matrices beside each other, g where there is none, periods, J about a pivot, divisions.

Oracle: two masses on springs, a bar on a hinge, and a mass on a spring, with equations by hand.
"""

from __future__ import annotations

import re
from functools import cache

import pytest
import sympy as sp

import built_in
import lagrangian as lg
from lagrangian.check.reading.characters import LATEX
from lagrangian.check.reading.drawn.side_by_side import side_by_side
from lagrangian.check.verb import check_answer


@cache
def skid() -> lg.Derivation:
    """Heave and tilt on two springs and a damper, without gravity."""
    s = lg.System("skid")
    y, theta = s.coordinates("y theta")
    m, J, a, b, k, c, d = s.parameters("m J a b k c d")
    s.particle(m, at=s.point("P", (0, y)))
    s.kinetic(J * theta.diff() ** 2 / 2)
    s.spring(k, deflection=y - a * theta, name="left")
    s.spring(c, deflection=y + b * theta, name="right")
    s.damper(d, deflection=y + b * theta, name="foot")
    s.force(s.input("F"), deflection=y)
    return s.derive()


ROWS = """m y'' + k (y - a theta) + c (y + b theta) + d (y' + b theta') = F
J theta'' - k a (y - a theta) + c b (y + b theta) + d b (y' + b theta') = 0"""
MATRICES = """M = [ m   0 ]     D = [ d     d b   ]     K = [ k + c         c b - k a     ]
    [ 0   J ]         [ d b   d b^2 ]         [ c b - k a   k a^2 + c b^2 ]

M [y''; theta''] + D [y'; theta'] + K [y; theta] = [F; 0]"""


@pytest.mark.slow
def test_named_matrices_may_stand_beside_each_other() -> None:
    assert skid().check(ROWS, hint=0).right
    assert skid().check(MATRICES, hint=0).right
    assert not skid().check(MATRICES.replace("[ d b   d b^2 ]", "[ d b   d a^2 ]"), hint=0).right
    assert not skid().check(MATRICES.replace("k + c  ", "k - c  "), hint=0).right


BELOW = """    | m   0 |         | d     d b   |         | k + c         c b - k a     |
M = | 0   J |     D = | d b   d b^2 |     K = | c b - k a   k a^2 + c b^2 |

M [y''; theta''] + D [y'; theta'] + K [y; theta] = [F; 0]"""


@pytest.mark.slow
@pytest.mark.parametrize("open_close", ["||", "[]"])
def test_the_names_of_matrices_may_stand_on_any_of_their_lines(open_close: str) -> None:
    text = re.sub(r"\|([^|\n]*)\|", lambda m: f"{open_close[0]}{m[1]}{open_close[1]}", BELOW)
    assert skid().check(text).right
    assert not skid().check(text.replace(" d b^2 ", " d a^2 ")).right
    assert not skid().check(text.replace("k + c  ", "k - c  ")).right


@pytest.mark.parametrize(
    "text",
    [
        "M = [ m   0 ]     D = [ d ]\nx = 3",
        "M = [ m   0 ]\n    [ 0   J ]",
        "M = [ m   0 ]     D = [ d ]\n    [ 0 ]     [ d ]",
        "M = [ m   0 ]     D = [ d ]\n    [ 0   1 ]",
    ],
)
def test_other_lines_with_brackets_stay(text: str) -> None:
    assert not list(side_by_side(text))


def test_a_weight_in_a_system_without_gravity_is_judged() -> None:
    verdict = skid().check(ROWS.replace("m y''", "m y'' + m g"))
    assert not verdict.right
    assert "g*m does not belong there" in str(verdict.mistakes[0].what)
    with pytest.raises(lg.ParseError):
        skid().check(ROWS.replace("m y''", "m y'' + m h"))


def test_a_period_is_no_kinetic_energy() -> None:
    s = lg.System("mass")
    x = s.coordinates("x")
    m, k = s.parameters("m k")
    s.kinetic(m * x.diff() ** 2 / 2)
    s.spring(k, deflection=x)
    derived = s.derive()
    assert derived.check("m x'' + k x = 0\nPeriod: T = 2 pi sqrt(m/k)", hint=0).right
    assert not derived.check("m x'' + k x = 0\nT = m x'^2", hint=0).right


def test_j_about_a_pivot_is_counted_twice_and_no_half_is_missing() -> None:
    s = lg.System("bed")
    phi = s.coordinates("phi")
    J, m, a = s.parameters("J_B m_b a")
    centre = s.point("G", (a * sp.cos(phi), a * sp.sin(phi)))
    s.rigid_body(m, J - m * a**2, at=centre, frame=phi, name="bed")
    verdict = s.derive().check("T_bed = 1/2 (J_B + m_b a^2) phi'^2\nT = T_bed")
    assert not verdict.right
    reason = str(verdict.mistakes[0].what).partition("A possible reason")[2]
    assert "J about its pivot" in reason
    assert "missing" not in reason


@pytest.mark.parametrize(
    ("text", "is_latex"),
    [("xdot = E\\(A*x + B*u);", False), (r"so\(x = 3\)", True), (r"\(x = 3\)", True), (r"a \frac{1}{2}", True)],
)
def test_a_division_from_the_left_is_no_latex(text: str, is_latex: bool) -> None:
    assert (LATEX.search(text) is not None) == is_latex


PENDULUM = "m L^2 theta'' + b theta' + m g L sin(theta) = 0"


@pytest.mark.parametrize(
    "remark",
    [
        "For small theta without friction: theta'' + g/L theta = 0, as in the book.",
        "Without gravity: m L^2 theta'' + b theta' = 0",
        "5. units: m g L = kg * m * 1/s^2 * m = N m, b theta' = N m",
        "Check: for $b=0$, $\\theta=0$ is an equilibrium. ✔",
        "Check: for $b=0$ and no gravity $\\dot\\theta=$ const., $\\theta=0$ is an equilibrium.",
    ],
)
def test_a_case_in_words_units_and_what_is_constant_are_beside_the_equations(remark: str) -> None:
    assert check_answer(built_in.derivation("pendulum"), f"{PENDULUM}\n{remark}").right


@pytest.mark.parametrize(
    "remark",
    [
        "Without gravity: m L^2 theta'' - b theta' = 0",
        "For small theta without friction: theta'' + 2 g/L theta = 0",
        "Without energies, by moments: m L^2 theta'' + b theta' - m g L sin(theta) = 0",
    ],
)
def test_a_wrong_equation_behind_words_is_none_of_a_special_case(remark: str) -> None:
    assert not check_answer(built_in.derivation("pendulum"), f"{PENDULUM}\n{remark}").right


def test_a_case_in_words_alone_is_no_answer() -> None:
    alone = "Without friction: m L^2 theta'' + m g L sin(theta) = 0"
    assert not check_answer(built_in.derivation("pendulum"), alone).right


def test_a_name_behind_a_sentence_with_a_plus_is_given_a_value() -> None:
    said = "Moments of the force at the hinge + acceleration of the centre of the rod about it give with Steiner"
    good = f"{said} Jh = m L^2:\nJh theta'' + b theta' + m g L sin(theta) = 0"
    assert check_answer(built_in.derivation("pendulum"), good).right
    assert not check_answer(built_in.derivation("pendulum"), good.replace("m L^2", "2 m L^2")).right
