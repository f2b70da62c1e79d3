"""Answers in plain text, read against expressions built by hand."""

from __future__ import annotations

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian import examples
from lagrangian.read import parse_answer
from lagrangian.read.answers import generalized_force

t = sp.Symbol("t")


def model(name: str):
    return lg.loads(examples.text(name), name=name).model


m1, m2, k = sp.symbols("m1 m2 k")
x1, x2r, F = (sp.Function(n)(t) for n in ("x1", "x2r", "F"))
a1, a2 = x1.diff(t, 2), x2r.diff(t, 2)


@pytest.mark.parametrize(
    "written",
    [
        "x2r''", "x_2r''", "x2r_ddot", "x2rddot", "ddot(x2r)", "d2x2r/dt2", "d^2x2r/dt^2", "d**2 x2r / dt**2",
        "d²x2r/dt²", "diff(x2r, t, 2)", "diff(x2r, t, t)", "Derivative(x2r(t), (t, 2))", "Derivative(x2r(t), t, t)",
        "d/dt(x2r')", "d/dt x2r'", "d(x2r')/dt", "dx2r'/dt", "(x2r)''", "ẍ2r", "x₂r″", "d/dt[x2r']", "d^2/dt^2(x2r)",
        "x2r_dd", "d/dt(dx2r/dt)", "x2r''(t)",
    ],
)  # fmt: skip
def test_every_spelling_of_an_acceleration(written):
    (line,) = parse_answer(f"m2*x1'' + m2*{written} + k*x2r = F", model("lecture-3b")).lines
    assert line.kind == "equation"
    assert line.residual == m2 * a1 + m2 * a2 + k * x2r - F


def test_a_hand_derivation_is_read_line_by_line():
    answer = parse_answer(
        """# relative coordinates
T* = 1/2*m1*x1'^2 + ½*m2*(x1' + x2r')²
V = k*x2r^2/2     % the spring
L = T* - V
(1) ∂L/∂x1' = (m1 + m2)*x1' + m2*x2r'
(m1 + m2)*x1'' + m2*x2r''
    = Xi_x1
Xi_1 = 0, Ξ₂ = F
EOM 2: m2*(ẍ1 + x2r_ddot) = F - k*x2r    (2)
""",
        model("lecture-3b"),
    )
    kinds = [(line.kind, line.name) for line in answer.lines]
    assert kinds == [
        ("T", None), ("V", None), ("L", None), ("p", "x1"), ("equation", None),
        ("Xi", "x1"), ("Xi", "x2r"), ("equation", None),
    ]  # fmt: skip
    assert answer.lines[4].residual == (m1 + m2) * a1 + m2 * a2 - generalized_force("x1")
    assert [answer.lines[i].place.line for i in range(8)] == [2, 3, 4, 5, 6, 8, 8, 9]
    assert not answer.unknown


def test_a_matrix_equation_is_its_rows():
    answer = parse_answer("[m1+m2, m2; m2, m2]*[x1''; x2r''] + [0, k*x2r] = [0; F]", model("lecture-3b"))
    assert [line.residual for line in answer.lines] == [(m1 + m2) * a1 + m2 * a2, m2 * a1 + m2 * a2 + k * x2r - F]
