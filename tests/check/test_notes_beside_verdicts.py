"""No note says that a line was not judged which the table of lines judges.

Oracle: a momentum that is stated as a derivative of the Lagrangian and by its value, p = ∂L/∂φ′ = (J + m r² sin²φ) φ′.
"""

from __future__ import annotations

import pytest
from test_read_words_of_a_sentence import MOTION, crank

VALUE = "(J + m r² sin²φ) φ'"
LATEX = (
    r"\[p_1 = \frac{\partial L}{\partial\dot\varphi} = (J + m r^2\sin^2\varphi)\dot\varphi\]"
    r"\[(J + m r^2\sin^2\varphi)\ddot\varphi + m r^2\sin\varphi\cos\varphi\dot\varphi^2 - m g r\sin\varphi"
    r" + b r^2\sin^2\varphi\dot\varphi = 0\]"
)


@pytest.mark.parametrize(
    "answer",
    [
        f"p1 = ∂L/∂φ' = {VALUE}\n{MOTION}",
        f"p = ∂L/∂φ' = {VALUE.replace('sin²φ', 'sin φ')}\n{MOTION}",
        f"p1 = ∂T/∂φ' = J φ' + m r² sin²φ φ'\n{MOTION}",
        f"p1 = ∂L/∂φ' = {VALUE}\n{MOTION.replace('- m g r', '- 2 m g r')}",
        LATEX,
    ],
)
def test_what_is_judged_by_its_value_is_not_said_to_be_not_judged(answer: str) -> None:
    verdict = crank().check(answer)
    assert any(f.line.number == 1 for f in verdict.findings)
    assert "not judged" not in verdict.to_text()


def test_what_has_no_value_is_said_to_be_not_judged() -> None:
    verdict = crank().check(f"p = ∂L/∂φ'\n{MOTION}")
    assert verdict.right and "'p = ∂L/∂φ'' was not judged" in verdict.to_text()
