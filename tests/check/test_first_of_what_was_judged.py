"""A line is called the first that is not right only if no formula above it was left without a verdict.

Oracle: by hand, a puck on a spring along a rod that a motor turns; see `test_named_in_momenta`.
"""

from __future__ import annotations

import pytest
from small_systems import rod

import lagrangian as lg

WRONG = "m r'' + m r phi'^2 + k (r - a) = 0"
SECOND = "(J + m r^2) phi'' + 2 m r r' phi' = M"
FIRST = "that is the first that is not right."


def told(answer: str) -> str:
    """What is told of an answer, in one line."""
    verdict = rod().check(answer)
    assert not verdict.right
    return " ".join(str(verdict).split())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("above", "which"),
    [
        ("Forces on the puck: centrifugal m r φ'², spring -k (r - a)\n", "line 1 above it was not judged"),
        ("Spring on the puck: -k (r - a)\nMotor: M\n", "lines 1 and 2 above it were not judged"),
        ("The motor gives the rod the moment k phi.\n", "line 1 above it was not judged"),
        ("- the puck: $-m r^2$\n", "line 1 above it was not judged"),
        ("**Names**: $k_1 = k + m$, $v = r'$\n", "line 1 above it was judged only in part"),
        ("**Names**: $k_1 = k + m$\n", "line 1 above it was not judged"),
        ("kinetic: m r'^2 for the puck, with w = phi'\n", "line 1 above it was not judged"),
        ("| part | speed |\n|---|---|\n| puck, along | r' |\n| puck, across | r φ' |\n", "above it were not judged"),
    ],
)
def test_a_formula_without_a_verdict_may_be_the_first(above: str, which: str) -> None:
    wrong = WRONG.replace("k (r", "k_1 (r") if "k_1" in above else WRONG
    said = told(f"{above}{wrong}\n{SECOND}")
    assert "of what was judged, that is the first that is not right;" in said and which in said
    assert FIRST not in said


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("above", "wrong", "which"),
    [
        ("δs = dr + r dph\n", "m r'' + m r ph'^2 + k (r - a) = 0", "line 1 above it was not judged"),
        ("So the force is Z = m r phi'.\n", "S_2 = Z - m r'', S_2 = k (r - a)", "line 1 above it was not judged"),
    ],
)
def test_so_may_one_with_names_that_are_read_as_others_or_used_on_its_line(above: str, wrong: str, which: str) -> None:
    second = SECOND.replace("phi", "ph") if "ph'" in wrong else SECOND
    said = told(f"{above}{wrong}\n{second}")
    assert which in said and FIRST not in said


PROGRAM = """from sympy import *
t = symbols('t')
m, J, k, a, M = symbols('m J k a M')
r, phi = Function('r')(t), Function('phi')(t)
T = m*(r.diff(t)**2 + r**2*phi.diff(t)**2)/2 + J*phi.diff(t)**2/2
{line}
for q, Q in ((r, -k*(r - a)), (phi, M*{turned}.diff(phi))):
    eq = T.diff(q.diff(t)).diff(t) - T.diff(q) - Q
    print(simplify(eq))
"""


def test_a_value_in_a_program_without_a_verdict_may_be_the_first() -> None:
    assert rod().check(PROGRAM.format(line="xu = phi + r", turned="xu")).right
    said = told(PROGRAM.format(line="xu = 2*phi + r", turned="xu"))
    assert "line 6 above it was not judged" in said and FIRST not in said
    assert FIRST in told(PROGRAM.format(line="u = phi", turned="(2*phi)"))


@pytest.mark.parametrize(
    "above",
    [
        "",
        "The rod turns by phi, and the puck is at r.\n",
        "I = J + m r^2\n",
        "Exercise: 4\n",
        "Given: the rod turns, a puck slides on it\n",
        "T = 1/2 m (r'^2 + r^2 phi'^2)\n  + 1/2 J phi'^2\nV = 1/2 k (r - a)^2\n",
        "$$T = \\frac12 m (\\dot r^2 + r^2 \\dot\\varphi^2)\n + \\frac12 J \\dot\\varphi^2$$\n".replace(
            "varphi", "phi"
        ),
    ],
)
def test_words_and_judged_lines_leave_it_the_first(above: str) -> None:
    second = SECOND if "$" not in above else "$(J + m r^2) \\ddot\\phi + 2 m r \\dot r \\dot\\phi = M$"
    wrong = WRONG if "$" not in above else "$m \\ddot r + m r \\dot\\phi^2 + k (r - a) = 0$"
    assert FIRST in told(f"{above}{wrong}\n{second}")


def test_numbers_that_are_worked_out_rightly_may_stand_for_something_wrong() -> None:
    s = lg.System("swing")
    phi = s.coordinate("phi")
    J, M, e, k = s.parameters("J M e k", J=60.0, M=120.0, e=0.3, k=900.0)
    s.kinetic((J + M * e**2) * phi.diff() ** 2 / 2, name="seat")
    s.spring(k, deflection=phi)
    right = "inertia of the seat: 60 + 120*0.09 = 70.8\n70.8 phi'' + 900 phi = 0"
    assert s.derive().check(right).right
    said = " ".join(str(s.derive().check(right.replace("0.09 = 70.8", "0.3 = 96").replace("70.8", "96"))).split())
    assert "line 1 right: worked out rightly; what it stands for is not judged" in said
    assert FIRST not in said and "line 1 above it was not judged" in said
