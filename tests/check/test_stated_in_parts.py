"""Energies and forces that an answer states bit by bit, in lines that go on with what stands above.

Oracle: two masses that hang on springs, by hand.
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg
from lagrangian.check import stated_apart
from lagrangian.check.lines import lines_of
from lagrangian.check.reading import parse_answer
from lagrangian.check.reference import truth_of


@cache
def hanging() -> lg.Derivation:
    """Two masses, one above the other, on two springs, with a damper and two forces."""
    s = lg.System("two masses")
    x, y = s.coordinates("x y")
    m, M, k, c, d = s.parameters("m M k c d")
    F, P = s.inputs("F P")
    s.particle(M, at=s.point("A", (0, -x)), name="upper")
    s.particle(m, at=s.point("B", (0, -y)), name="lower")
    s.gravity()
    s.spring(k, deflection=x)
    s.spring(c, deflection=y - x)
    s.damper(d, deflection=x)
    s.force(F, deflection=x)
    s.force(P, deflection=x)
    return s.derive()


ROWS = """
M x'' + d x' + k x - c (y - x) - M g = F + P
m y'' + c (y - x) - m g = 0
"""
TEX = r"""
\begin{align*}
M \ddot x + d \dot x + k x - c (y - x) - M g &= F + P\\
m \ddot y + c (y - x) - m g &= 0
\end{align*}
"""


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("first", "more", "wrong"),
    [
        ("V = 1/2 k x^2 + 1/2 c (y - x)^2", "V = ... - M g x - m g y", "V = ... + M g x - m g y"),
        ("V = 1/2 k x^2 + 1/2 c (y - x)^2", "V = … - M g x - m g y", "V = … - M g x + m g y"),
        ("V = 1/2 k x^2 + 1/2 c (y - x)^2", "V = V - M g x - m g y", "V = V - M g x"),
        ("T = 1/2 M x'^2", "T = ... + 1/2 m y'^2", "T = ... - 1/2 m y'^2"),
        ("Q_x = F", "Q_x = ... + P - d x'", "Q_x = ... - P - d x'"),
    ],
)
def test_a_line_may_go_on_with_what_stands_above(first: str, more: str, wrong: str) -> None:
    found = hanging().check(f"{first}\nand then\n{more}\n{ROWS}")
    assert found.right and "goes on with it" in found.to_text(), found.to_text()
    assert not hanging().check(f"{first}\n\n{wrong}\n{ROWS}").right


def test_a_line_in_latex_may_go_on_with_what_stands_above() -> None:
    first, more = r"$V = \frac12 k x^2 + \frac12 c (y - x)^2$", r"$V = \dots - M g x - m g y$"
    assert hanging().check(f"{first}\n\n{more}\n{TEX}").right
    assert not hanging().check(f"{first}\n\n{more.replace('- m g', '+ m g')}\n{TEX}").right


def test_an_energy_that_nothing_goes_on_with_is_wrong() -> None:
    assert not hanging().check(f"V = 1/2 k x^2 + 1/2 c (y - x)^2\n{ROWS}").right


def test_a_part_of_a_wrong_energy_is_not_the_whole() -> None:
    whole = "V = 1/2 k x^2 + 1/2 c y^2 - M g x - m g y"
    found = hanging().check(f"Gravity: V = -M g x - m g y.\n{whole}\n{ROWS}")
    assert [(f.line.number, f.status.right) for f in found.findings] == [(2, False), (4, True), (5, True)]
    assert all("missing" not in str(m.what) for m in found.mistakes)
    right = whole.replace("c y^2", "c (y - x)^2")
    assert not hanging().check(f"V = -M g x\n{right}\n{ROWS}").right


def test_what_is_stated_once_is_not_multiplied_out_to_see_whether_a_line_goes_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def compared(*_: object) -> None:
        pytest.fail("only lines of one name can go on with one another")

    answer = f"V = 1/2 k x^2 + 1/2 c (y - x)^2 - M g x - m g y\nQ_x = F + P - d x'\n{ROWS}"
    lines = lines_of(parse_answer(answer, hanging().model))
    truth = truth_of(hanging())
    with monkeypatch.context() as patch:
        patch.setattr(stated_apart, "_terms", compared)
        assert stated_apart.without_first_parts(truth, lines) == (lines, ())
    assert not hanging().check(f"V = 1/2 k x^2 + 1/2 c (y - x)^2\n{ROWS}").right
