"""`System.check` and `Derivation.check`: what they take, and what they refuse."""

from typing import Any

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check import Status


def oscillator() -> tuple[lg.System, Any, Any]:
    s = lg.System("oscillator")
    x = s.coordinates("x")
    m, k = s.parameters("m k")
    s.particle(m, at=s.origin + (x, 0))
    s.spring(k, deflection=x)
    return s, x, (m, k)


def test_text_latex_equations_expressions_and_energies() -> None:
    s, x, (m, k) = oscillator()
    a = x.diff().diff()
    for answer in (
        "m*x'' + k*x = 0",
        r"m \ddot{x} = -k x",
        [sp.Eq(m * a, -k * x)],
        sp.Eq(m * a, -k * x),
        m * a + k * x,
        [m * a + k * x],
        sp.Matrix([m * a + k * x]),
        {"T": m * x.diff() ** 2 / 2, "V": k * x**2 / 2, x: 0},
    ):
        assert s.check(answer, hint=0).status is Status.RIGHT, answer
    assert not s.check("m*x'' - k*x = 0", hint=0).right


def test_what_is_no_answer_is_refused_in_words() -> None:
    s, x, _ = oscillator()
    for answer in (3, None, b"m*x''", ["m*x''"], {"W": x}, {"T": "m"}):
        with pytest.raises(lg.ModelError, match=r"answer|neither"):
            s.check(answer)
    with pytest.raises(lg.ModelError, match="hint"):
        s.check("m*x'' + k*x = 0", hint=4)


def test_every_format() -> None:
    s, _, _ = oscillator()
    verdict = s.derive().check("m*x'' - k*x = 0")
    assert "Not right yet" in verdict.to_text()
    for text in (verdict.to_markdown(), verdict.to_html(), verdict.to_latex(), verdict._repr_html_()):
        assert "spring" in text
    assert verdict.to_dict()["mistakes"]
