"""Answers in plain text, read against expressions built by hand."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import sympy as sp

import built_in
from lagrangian.check.reading import generalized_force, parse_answer

t = sp.Symbol("t")


def model(name: str):
    return built_in.system(name).model


m1, m2, k = sp.symbols("m1 m2 k")
x1, x2r, F = (sp.Function(n)(t) for n in ("x1", "x2r", "F"))
a1, a2 = x1.diff(t, 2), x2r.diff(t, 2)


@pytest.mark.parametrize(
    "written",
    [
        "x2r''", "x_2r''", "x2r_ddot", "x2rddot", "ddot(x2r)", "d2x2r/dt2", "d^2x2r/dt^2", "d**2 x2r / dt**2",
        "d²x2r/dt²", "diff(x2r, t, 2)", "diff(x2r, t, t)", "Derivative(x2r(t), (t, 2))", "Derivative(x2r(t), t, t)",
        "d/dt(x2r')", "d/dt x2r'", "d(x2r')/dt", "dx2r'/dt", "(x2r)''", "ẍ2r", "x₂r″", "d/dt[x2r']", "d^2/dt^2(x2r)",
        "x2r_dd", "x2rdd", "d/dt(dx2r/dt)", "x2r''(t)",
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


@pytest.mark.parametrize(
    "written",
    [
        "Example 3B, second equation\n{}",
        "(2) {}",
        "2. {}",
        "b) {}",
        "EOM 2: {}",
        "=> {}",
        "We get {}",
        "The second equation of motion is {}.",
        "so, {}",
        "{}   (2r)",
        "{} where",
        "{};",
        "# a comment\n{}  # another",
        "with the stretch of the spring, {}",
    ],
)
def test_words_and_numbers_around_an_equation(written):
    (line,) = parse_answer(written.format("m2*x1'' + m2*x2r'' = F - k*x2r"), model("lecture-3b")).lines
    assert line.residual == m2 * a1 + m2 * a2 + k * x2r - F


@pytest.mark.parametrize(
    "written",
    [
        "m2*x1''\n + m2*x2r''\n= F\n - k*x2r",
        "m2*x1'' +\nm2*x2r'' = F - k*x2r",
        "m2*(x1''\n+ x2r'') = F - k*x2r",
        "m2*x1'' + m2*x2r'' = ...\nF - k*x2r",
        "m2*x1'' + ...\n... + m2*x2r'' - F + k*x2r",
        "m2*x1'' \\\n + m2*x2r'' - F + k*x2r",
        "F = m2*x1'' + m2*x2r''\n - (-k*x2r)",
    ],
)
def test_an_equation_over_several_lines(written):
    (line,) = parse_answer(written, model("lecture-3b")).lines
    assert sp.expand(line.residual**2 - (m2 * a1 + m2 * a2 + k * x2r - F) ** 2) == 0


def test_conditions_stand_in_piecewise():
    (line,) = parse_answer(
        "x1'' = piecewise(x1 > 1 and (k < 2 or not m1 >= 3), x1, (x1 + 1)*2 <= k, 5, 0)", model("lecture-3b")
    ).lines
    states = [{x1: a, k: b, m1: c} for a in (0.2, 3) for b in (1, 5) for c in (1, 4)]
    for at in states:
        first = at[x1] > 1 and (at[k] < 2 or not at[m1] >= 3)
        meant = at[x1] if first else 5 if (at[x1] + 1) * 2 <= at[k] else 0
        assert line.rhs.subs(at) == meant


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("max({}, k)", lambda value, k: max(value, k)),
        ("max(({}), k)", lambda value, k: max(value, k)),
        ("cos({})", lambda value, k: sp.cos(value)),
        ("sin²(({})*k)", lambda value, k: sp.sin(value * k) ** 2),
        ("piecewise(k > 2, 3*{}, k)", lambda value, k: 3 * value if k > 2 else k),
        ("piecewise({} > k, 1, 0)", lambda value, k: int(value > k)),
    ],
)
def test_a_piecewise_value_may_be_an_argument_of_a_function(written, meant):
    """Its comparison belongs to it, not to the function around it."""
    (line,) = parse_answer(f"x1'' = {written.format('piecewise(x1 > 1, m1, 2)')}", model("lecture-3b")).lines
    for at in ({x1: a, k: b, m1: 3} for a in (0.2, 3) for b in (1, 5)):
        assert line.rhs.subs(at) == meant(at[m1] if at[x1] > 1 else 2, at[k])


def test_several_statements_on_a_line_and_two_equations_that_begin_with_minus():
    answer = parse_answer("Xi_1 = 0, Xi_2 = F; V = k*x2r^2/2\n-F = -k*x2r\n-F = m1*x1''", model("lecture-3b"))
    assert [line.kind for line in answer.lines] == ["Xi", "Xi", "V", "equation", "equation"]


def test_names_of_the_person_are_written_out_wherever_they_are_defined():
    answer = parse_answer("T = m*v²/2\nV = m*g*h\nwhere h = L*(1 - cos(θ))\nv^2 = (L*θ')²", model("pendulum"))
    theta, L, m, g = sp.Function("theta")(t), *sp.symbols("L m g")
    T, V, h, v = answer.lines
    assert T.rhs == m * L**2 * theta.diff(t) ** 2 / 2
    assert V.rhs == m * g * L * (1 - sp.cos(theta))
    assert (h.kind, h.name, v.kind, v.name) == ("definition", "h", "definition", "v")


def test_a_chain_of_equal_signs_states_each_part():
    answer = parse_answer("T = m*v^2/2 = m*(L*θ')^2/2\nv = L*θ'", model("pendulum"))
    assert [line.kind for line in answer.lines] == ["T", "T", "definition"]
    assert sp.expand(answer.lines[0].rhs - answer.lines[1].rhs) == 0


def test_lines_of_lagrange_s_equations_themselves():
    answer = parse_answer(
        "T = m*L²*θ'²/2\nV = -m*g*L*cos(θ)\n∂T/∂θ' = m*L²*θ'\n∂L/∂θ' = m*L²*θ'\nd/dt(∂L/∂θ') = m*L²*θ''\n"
        "∂L/∂θ = -m*g*L*sin(θ)\nd/dt(∂L/∂θ') - ∂L/∂θ = Xi_1\nd/dt(∂L/∂θ') - ∂L/∂θ = m*L²*θ'' + m*g*L*sin(θ)",
        model("pendulum"),
    )
    assert [(x.kind, x.name) for x in answer.lines[3:]] == [
        ("p", "theta"), ("p-rate", "theta"), ("slope", "theta"), ("equation", None), ("left", "theta"),
    ]  # fmt: skip
    theta, L, m, g = sp.Function("theta")(t), *sp.symbols("L m g")
    left = m * L**2 * theta.diff(t, 2) + m * g * L * sp.sin(theta)
    assert answer.lines[6].residual == left - generalized_force("theta")


def test_unknown_names_are_noted_with_what_was_probably_meant():
    answer = parse_answer("m*L^2*thta'' + mg*L*sin(theta) + M*x_9 = 0", model("pendulum"))
    noted = {u.name: u for u in answer.unknown}
    assert set(noted) == {"thta", "M", "x_9"}
    assert answer.notes == ("Products without signs were read: mg as m g.",)
    assert "theta" in noted["thta"].suggestion and "'m'" in noted["M"].suggestion
    assert noted["thta"].symbol == sp.Function("thta")(t) and noted["M"].symbol == sp.Symbol("M")
    assert (noted["x_9"].place.line, noted["x_9"].place.column) == (1, 36)


def test_a_coordinate_in_new_ones_is_a_definition_of_it():
    answer = parse_answer("x2r = s - x1\nm2*s'' + k*(s - x1) = F", model("lecture-3b"))
    assert [(x.kind, x.name) for x in answer.lines] == [("definition", "x2r"), ("equation", None)]
    assert [u.symbol for u in answer.unknown] == [sp.Function("s")(t)]


def test_an_energy_gives_way_to_a_symbol_of_the_model():
    assert parse_answer("L = m*L^2*θ'^2/2", model("pendulum")).lines[0].kind == "L"
    assert parse_answer("2*L = 3", model("pendulum")).lines[0].lhs == 2 * sp.Symbol("L")
    assert parse_answer("D = b*θ'^2/2", model("pendulum")).lines[0].kind == "D"
    assert parse_answer("F = m2*x1''", model("lecture-3b")).lines[0].kind == "equation"
    assert parse_answer("f = m2*x1''", model("lecture-3b")).lines[0].kind == "equation"


@pytest.mark.parametrize("language", ["text", "latex"])
def test_the_manual_s_answers_are_read_and_right(language):
    paper = (Path(__file__).parents[2] / "docs" / "answers.md").read_text(encoding="utf-8")
    (written,) = re.findall(rf"```{language}\n(.*?)```", paper, re.DOTALL)
    answer = parse_answer(written, model("lecture-3b"))
    first, second = (m1 + m2) * a1 + m2 * a2, m2 * a1 + m2 * a2 + k * x2r - F
    assert [sp.expand(x.residual) for x in answer.equations] == [sp.expand(first), sp.expand(second)]
    T = m1 * x1.diff(t) ** 2 / 2 + m2 * (x1 + x2r).diff(t) ** 2 / 2
    assert sp.expand(answer.lines[0].rhs - T) == 0 and not answer.unknown


def test_a_bracket_with_numbered_names_is_no_remark() -> None:
    system = built_in.derivation("double-pendulum")
    right = "(m1+m2) L1^2 theta1'' + m2 L1 L2 (theta2'' cos(theta1 - theta2) + theta2'^2 sin(theta1 - theta2)) "
    right += "+ (m1+m2) g L1 sin(theta1) + m2 (theta2 - theta1) - m2 (theta2 - theta1) = 0"
    assert system.check(right).findings[0].status.right


def test_a_list_of_equations_below_other_lines_is_read() -> None:
    text = "T = m*L**2*Derivative(theta(t), t)**2/2\n[Eq(m*L**2*Derivative(theta(t), (t, 2)), 0)]"
    verdict = built_in.derivation("pendulum").check(text)
    assert [f.line.kind for f in verdict.findings] == ["T", "equation"] and not verdict.right


def test_one_bullet_below_a_heading_is_no_sign() -> None:
    text = "**Answer**\n\n- m L^2 theta'' + b theta' + m g L sin(theta) = 0"
    assert built_in.derivation("pendulum").check(text, hint=0).right


def test_a_partial_derivative_that_is_no_line_of_its_own_is_no_fault() -> None:
    """The printed checklist names ∂T*/∂ξ without values: it is judged, whatever the coordinates are taken for."""
    derived = built_in.derivation("lecture-3b")
    assert derived.check(derived.to_markdown(brief=True), hint=0).status
