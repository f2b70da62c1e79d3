r"""Rates and rows as students type them: (θ')² behind a letter, dots and _dot behind names, an index t, rows of LaTeX.

Oracle: the equations of a cart with a pendulum, of a mass on a spring and of a puck on a rod, by hand. Every
form has a wrong twin.
"""

from __future__ import annotations

import pytest
from small_systems import cart, rod

import lagrangian as lg


def assert_read(system: lg.Derivation, written: str, *wrong: tuple[str, str]) -> None:
    """An answer is right, and each of its wrong twins is not."""
    verdict = system.check(written)
    assert verdict.right, verdict.to_text()
    for old, new in wrong:
        assert old in written, old
        assert not system.check(written.replace(old, new), hint=0).right, (old, new)


SWUNG = """u = -x.   p = phi
(M + m) u'' - m l cos(p) p'' + m l sin(p) (p')^2 + k u = 0
m l^2 p'' - m l cos(p) u'' + m g l sin(p) = 0"""


def test_a_letter_in_front_of_the_square_of_a_rate_is_a_factor() -> None:
    # the value of a letter ends with its sentence, and a power behind a rate in brackets is one of the rate
    right = "s = r.   p = phi\nJ p'' + m s² p'' + 2 m s s' p' = M\nm s'' - m s (p')^2 + k (s - a) = 0"
    assert_read(rod(), right, ("m s (p')^2", "m s p'"), ("m s (p')^2", "m s²"), ("- m s (p')", "+ m s (p')"))
    assert_read(cart(), SWUNG, ("(p')^2", "p'"), ("+ m l sin(p) (p')", "- m l sin(p) (p')"))


def test_a_function_of_a_glued_letter_in_front_of_a_rate_in_brackets_is_no_name() -> None:
    written = """T = ½ M ẋ² + ½ m (ẋ² + 2 l cosφ φ̇ ẋ + l² (φ̇)²)
V = ½ k x² − m g l cosφ
(M + m) ẍ + m l cosφ φ̈ − m l sinφ (φ̇)² + k x = 0
m l² φ̈ + m l cosφ ẍ + m l sinφ cosφ (φ̇)² + m g l sinφ = m l sinφ cosφ (φ̇)²"""
    assert_read(
        cart(), written, ("= m l sinφ cosφ (φ̇)²", "= m l sinφ cosφ φ̇"), ("cosφ φ̈", "sinφ φ̈"), ("sinφ (φ̇)²", "sinφ φ̇")
    )


@pytest.mark.parametrize("begins", [r"\displaystyle\qquad{}", r"\displaystyle{}", r"\displaystyle\quad", r"\qquad"])
@pytest.mark.parametrize("kind", ["cases", "aligned", "array"])
def test_a_row_that_begins_with_an_operator_goes_on_in_any_style(begins: str, kind: str) -> None:
    opened = f"{kind}}}{{l}}" if kind == "array" else f"{kind}}}"
    written = rf"""\[
\begin{{{opened}
\displaystyle (M+m)\,\ddot x + m l\cos\phi\;\ddot\phi\\[6pt]
{begins}- m l\sin\phi\;\dot\phi^2 + k x = 0\\[10pt]
\displaystyle m l^2\ddot\phi + m l\cos\phi\;\ddot x + m g l\sin\phi = 0
\end{{{kind}}}
\]"""
    assert_read(cart(), written, ("- m l", "+ m l"), ("k x = 0", "2 k x = 0"), ("+ m g l", "- m g l"))


@pytest.mark.parametrize(
    "remark",
    [
        r"\text{(everything about the pin, arm at }90^\circ)",
        r"\text{(bob, arm at }\phi\text{ from the vertical)}",
        r"\mbox{(largest for }(\phi)\mbox{ small)}",
    ],
)
def test_a_bracket_of_words_may_end_in_mathematics(remark: str) -> None:
    written = rf"""\[
\begin{{array}}{{ll}}
 A = m\,l^2 & {remark}\\
 B = m\,l & \text{{(static moment)}}
\end{{array}}
\]
\[ (M+m)\ddot x + B\cos\phi\,\ddot\phi - B\sin\phi\,\dot\phi^2 + k x = 0 \]
\[ A\,\ddot\phi + B\cos\phi\,\ddot x + B\,g\sin\phi = 0 \]"""
    assert_read(cart(), written, (r"A = m\,l^2", r"A = 2 m\,l^2"), (r"B = m\,l ", r"B = m\,l^2 "), ("- B", "+ B"))
