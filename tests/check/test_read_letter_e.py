r"""e is a letter of the answer where it is defined or squared, and Euler's number in e^{-t}.

Oracle: a drum that stretches a string, by hand: V = ½ k (ρ α − x)².
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.model import time


@cache
def drum() -> lg.Derivation:
    s = lg.System("drum and cart")
    x, alpha = s.coordinates("x alpha")
    M, J, k, rho = s.parameters("M J k rho")
    s.particle(M, at=s.point("C", (x, 0)), name="cart")
    s.kinetic(J * alpha.diff(time) ** 2 / 2, name="drum")
    s.spring(k, deflection=rho * alpha - x, name="string")
    return s.derive()


ROWS = "M x'' - k (rho alpha - x) = 0\nJ alpha'' + k rho (rho alpha - x) = 0"
IN_LATEX = r"\[ M\ddot x - k(\rho\alpha - x) = 0 \]" "\n" r"\[ J\ddot\alpha + k\rho(\rho\alpha - x) = 0 \]"


@pytest.mark.parametrize(
    "said",
    [
        "\\[ e = \\rho\\alpha - x . \\]\n\\[ V = \\tfrac12 k e^2 \\]",
        "\\(e = \\rho\\alpha - x\\)\n\\[ V = \\tfrac12 k e^{2} \\]",
        "\\begin{equation} e = \\rho\\alpha - x \\end{equation}\n\\[ V = \\frac{k}{2} e^2 \\]",
        "\\begin{align*}\ne &= \\rho\\alpha - x\\\\\nV &= \\tfrac12 k e^2\n\\end{align*}",
    ],
)
def test_a_letter_that_is_defined_in_a_display_is_squared(said: str) -> None:
    assert drum().check(f"{said}\n{IN_LATEX}").right
    wrong = drum().check(f"{said.replace('- x', '+ x')}\n{IN_LATEX}")
    assert not wrong.right


@pytest.mark.parametrize("answer", [f"V = 1/2 k e^2\n{ROWS}", f"\\[ V = \\tfrac12 k e^2 \\]\n{IN_LATEX}"])
def test_the_square_of_an_unknown_e_is_no_number(answer: str) -> None:
    verdict = drum().check(answer)
    assert any("was not judged" in str(note) for note in verdict.notes) and not verdict.mistakes


def test_a_power_of_e_that_is_no_number_is_the_exponential() -> None:
    s = lg.System("shrinking spring")
    x = s.coordinate("x")
    m, k, a = s.parameters("m k a")
    s.particle(m, at=s.point("P", (x, 0)), name="block")
    s.potential(k * sp.exp(-a * x), name="field")
    block = s.derive()
    assert block.check("m x'' - a k e^(-a x) = 0").right
    assert block.check(r"\[ m\ddot x - a k e^{-a x} = 0 \]").right
