"""A line is called the first that is not right only if no formula above it was left without a verdict.

Oracle: by hand, a puck on a spring along a rod that a motor turns; see `test_named_in_momenta`.
"""

from __future__ import annotations

import pytest
from small_systems import rod

WRONG = "m r'' + m r phi'^2 + k (r - a) = 0"
SECOND = "(J + m r^2) phi'' + 2 m r r' phi' = M"
FIRST = "that is the first that is not right."


def told(answer: str) -> str:
    """What is told of an answer, in one line."""
    verdict = rod().check(answer)
    assert not verdict.right
    return " ".join(str(verdict).split())


@pytest.mark.parametrize(
    ("above", "which"),
    [
        ("Forces on the puck: centrifugal m r φ'², spring -k (r - a)\n", "line 1 above it was not judged"),
        ("| part | speed |\n|---|---|\n| puck, along | r' |\n| puck, across | r φ' |\n", "above it were not judged"),
    ],
)
def test_a_formula_without_a_verdict_may_be_the_first(above: str, which: str) -> None:
    said = told(f"{above}{WRONG}\n{SECOND}")
    assert "of what was judged, that is the first that is not right;" in said and which in said
    assert FIRST not in said


@pytest.mark.parametrize(
    "above",
    [
        "",
        "The rod turns by phi, and the puck is at r.\n",
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
