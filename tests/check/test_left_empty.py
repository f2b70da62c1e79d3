"""T = with nothing behind it: the line below is what it says itself, and what is empty is told.

Oracle: V = ½ k x_2r² of the lecture's carts.
"""

from __future__ import annotations

import pytest

from built_in import derivation

T = "(m1 + m2)/2*x1'^2 + m2*x1'*x2r' + m2*x2r'^2/2"
V = "1/2*k*x2r^2"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "answer",
    [
        f"T =\nV = {V}",
        f"T* = \n\nV = {V}",
        f"T = ?\nV = {V}",
        f"T = ...\nV = {V}",
        f"T = ____\nV = {V}",
        f"V = {V}\nL =",
        r"\[T = \]" + "\n" + r"\[V = \frac12 k x_{2r}^2\]",
        r"\begin{align} T &= \\ V &= \frac12 k x_{2r}^2 \end{align}",
        f"Xi_1 =\nXi_2 = F\nV = {V}",
    ],
)
def test_what_stands_below_is_judged_by_itself(answer: str) -> None:
    checked = derivation("lecture-3b").check(answer)
    assert all(f.status.right and f.line.kind in ("V", "Xi") for f in checked.findings), checked.to_text()
    assert any(f.line.kind == "V" for f in checked.findings)
    assert "it has no right-hand side" in " ".join(checked.to_text().split())


def test_a_wrong_line_below_is_wrong() -> None:
    (finding,) = derivation("lecture-3b").check(f"T =\nV = -{V}").findings
    assert finding.line.kind == "V" and not finding.status.right


@pytest.mark.parametrize("answer", [f"T =\n{T}\nV = {V}", f"T =\n  {T}", f"T = {T} =\n{T}"])
def test_a_sum_goes_on_below(answer: str) -> None:
    assert derivation("lecture-3b").check(answer, hint=0).right
