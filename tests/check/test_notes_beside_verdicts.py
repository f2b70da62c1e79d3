"""No note says that a line was not judged which the table of lines judges.

Oracle: a momentum that is stated as a derivative of the Lagrangian and by its value, p = ∂L/∂φ′ = (J + m r² sin²φ) φ′.
"""

from __future__ import annotations

import pytest
from test_read_words_of_a_sentence import MOTION, crank

import lagrangian as lg

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


def test_a_second_value_of_a_name_does_not_vanish() -> None:
    """v² of one body is right, and that of another under the same name is told as not judged."""
    s = lg.System("two on a line")
    x, y = s.coordinates("x y")
    m, n = s.parameters("m n")
    s.particle(m, s.origin + (x, 0), name="cart")
    s.particle(n, s.origin + (y, x), name="sled")
    found = s.derive().check("cart: v² = x'²\nsled: v² = y'² + 2 x'²\nm x'' + n x'' = 0\nn y'' = 0")
    assert found.right
    assert [str(note) for note in found.notes if "another value" in str(note)] == [
        "'v² = y'² + 2 x'²' was not judged: v has another value, too."
    ]
