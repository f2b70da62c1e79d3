"""What is wrong in a determinant, in the rate of a sine or in twice a function is told there; what is made with it
follows.

Oracle: by hand, a pendulum on a cart; see `small_systems`.
"""

from __future__ import annotations

import pytest
from small_systems import mass, pushed_cart

ROWS = (
    "(M + m) x'' + m l cos(theta) theta'' - m l sin(theta) theta'^2 + k x = F - b x'\n"
    "m l cos(theta) x'' + m l^2 theta'' + m g l sin(theta) = F l cos(theta)\n"
)
SOLVED = (
    "A = M + m, B = m l cos(theta), I = m l^2\n"
    "P = F - b x' - k x + m l sin(theta) theta'^2\nQ = F l cos(theta) - m g l sin(theta)\n"
    "Delta = A I - B^2\nx'' = (I P - B Q)/Delta\ntheta'' = (A Q - B P)/Delta\n"
)


def told(answer: str) -> tuple[int | None, str]:
    """The number of the first wrong line, None for a right answer, and all that is told."""
    verdict = pushed_cart().check(answer)
    number = None if verdict.right or verdict.first_wrong is None else verdict.first_wrong.line.number
    return number, " ".join(str(verdict).split())


@pytest.mark.slow
def test_a_determinant() -> None:
    assert told(SOLVED)[0] is None
    number, said = told(SOLVED.replace("A I - B^2", "A I + B^2"))
    assert number == 4 and "line 5" in said and "right as written, but Delta of line 4 is not" in said
    assert "in it has the wrong sign" in said


def test_the_rate_of_a_cosine() -> None:
    answer = (
        "T = 1/2 (M + m) x'^2 + m l cos(theta) x' theta' + 1/2 m l^2 theta'^2\n"
        "d/dt cos(theta) = theta' sin(theta)\n"
        "d/dt(dT/dx') = (M + m) x'' + m l cos(theta) theta'' + m l sin(theta) theta'^2\n"
        "(M + m) x'' + m l cos(theta) theta'' + m l sin(theta) theta'^2 + k x = F - b x'\n"
        f"{ROWS.splitlines()[1]}"
    )
    number, said = told(answer)
    assert number == 2 and "the derivative of cos θ by time is −θ̇ sin θ, not θ̇ sin θ" in said
    assert "does not belong there" not in said


def test_a_term_beside_a_name_is_wrong_as_written() -> None:
    inertia = "J_0 = m l^2 + m x^2\n"
    first, second = ROWS.splitlines()
    named = second.replace("m l^2 theta''", "J_0 theta''")
    assert "right as written, but J_0 of line 1 is not" in told(f"{inertia}{first}\n{named}")[1]
    number, said = told(f"{inertia}{first}\n{named.replace(' = F', ' + 2 m x x` theta` = F').replace('`', chr(39))}")
    assert number == 1 and "right as written" not in said


@pytest.mark.parametrize("head", ["lost power 2 D", "2 D", "dissipation: 2 D"])
def test_twice_a_function(head: str) -> None:
    assert told(f"{head} = b x'^2\n{ROWS}")[0] is None
    number, said = told(f"{head} = b (x' + l theta')^2\n{ROWS}")
    assert number == 1 and "½ b" in said


def test_a_momentum_without_its_factor() -> None:
    answer = (
        "T = 1/2 (M + m) x'^2 + m l cos(theta) x' theta' + 1/2 m l^2 theta'^2\n"
        "V = 1/2 k x^2 - m g l cos(theta)\n"
        "dL/dtheta' = m l cos(theta) x' + 1/2 m l^2 theta'\n"
        "d/dt dL/dtheta' = m l cos(theta) x'' - m l sin(theta) theta' x' + 1/2 m l^2 theta''\n"
        f"{ROWS.splitlines()[0]}\n"
        "m l cos(theta) x'' + 1/2 m l^2 theta'' + m g l sin(theta) = F l cos(theta)"
    )
    number, said = told(answer)
    assert number == 3 and "Coriolis" not in said
    assert said.count("the divisor 2 too much") == 1
    assert "only because of line 3" in said


def test_components_of_a_point_by_their_index() -> None:
    answer = (
        "S = (x + l sin(theta), -l cos(theta))\nT = 1/2 M x'^2 + 1/2 m (S_x'^2 + S_y'^2)\nV = 1/2 k x^2 + m g S_y\n"
    )
    number, said = told(answer + ROWS)
    assert number is None and "T*" in said and "was not judged" not in said


def test_a_force_of_a_program() -> None:
    program = (
        "function dz = cart(t, z, F)\n"
        "M = 2; m = 1; k = 3; b = 4;\n"
        "x = z(1); v = z(2);\n"
        "f = F - k*x + b*v;\n"
        "dz = [v; f/m];\n"
        "end\n"
    )
    assert mass().check(program.replace("+ b*v", "- b*v")).right
    verdict = mass().check(program.replace("k*x + b", "2*k*x - b"))
    assert verdict.first_wrong is not None and verdict.first_wrong.line.number == 4, verdict
