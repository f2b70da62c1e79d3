"""Braces that group a sum in plain text are brackets; those of lists, indices and labels are not."""

from __future__ import annotations

import pytest

from lagrangian.check.reading.braces import with_round_brackets
from student_answers import CART, POLE, right

BRACED = "(M + m) x'' + m l {theta'' cos theta - theta'^2 sin theta} + b x' = F"


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "written",
    [
        f"{BRACED}\n{{J + m l^2}} theta'' + m l {{x'' cos theta - g sin theta}} = 0",
        f"{BRACED}\n(J + m l^2) theta'' + m {{ l [x'' cos theta\n   - g sin theta] }} = 0",
        f"x'' = {{F - b x' + m l [theta'^2 sin theta - theta'' cos theta]}}/(M + m)\n{POLE}",
        f"{{{CART.replace('=', '==')}, {{J + m l^2}} theta'' + m l {{x'' cos theta - g sin theta}} == 0}}",
    ],
)
def test_braces_group_a_sum(written: str) -> None:
    assert right(written)
    for wrong in (written.replace("- g", "+ g"), written.replace("- theta", "+ theta")):
        assert wrong == written or not right(wrong)


@pytest.mark.parametrize(
    "written", ["D[x[t], {t, 2}]", "{a + b == 0, c == 0}", "x_{n+1}", "{1} a + b", "{{a + b}, {c}}", "{a + [b} + c]"]
)
def test_other_braces_stay(written: str) -> None:
    assert with_round_brackets(written) == written
