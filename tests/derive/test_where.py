"""Where a term comes from: a short reading, and a reason where it comes from nowhere."""

from __future__ import annotations

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian import examples


def test_an_origin_reads_in_one_line() -> None:
    s = lg.loads(examples.text("lecture-3b"))
    (origin,) = s.derive().where(s["k"] * s["x2r"])
    assert repr(origin) == "Origin(spring 'k', equation of x2r, step 3, share k*x2r)"


def test_a_term_that_stands_nowhere_is_told() -> None:
    s = lg.loads(examples.text("lecture-3b"))
    d = s.derive()
    with pytest.raises(lg.ModelError, match="no equation of motion holds the term") as caught:
        d.where(s["k"] * s["x1"])
    assert "k*x2r" in str(caught.value.fix)
    with pytest.raises(lg.ModelError, match="nothing is named 'x2'") as caught:
        d.where(s["k"] * sp.Function("x2")(s.t))
    assert "x2r" in str(caught.value.fix)


def test_text_is_not_run() -> None:
    d = lg.loads(examples.text("lecture-3b")).derive()
    with pytest.raises(lg.ModelError, match="must be a number or a SymPy expression"):
        d.where("__import__('os').getcwd()")  # type: ignore[arg-type]
