"""What people type on phones, in Word and in LaTeX around and inside their equations.

Oracle: the equation of the pendulum, m L² θ̈ + b θ̇ + m g L sin θ = 0, and those of the cart with a pole, in the grammar
of model files.
"""

import contextlib

import pytest

from built_in import derivation
from lagrangian import ParseError
from lagrangian.check.reading import parse_answer

PLAIN = "m L² θ'' + b θ' + m g L sin θ = 0"
CART = "(M + m) x'' + m l theta'' cos theta - m l theta'^2 sin theta + b x' = F"
POLE = "(J + m l^2) theta'' + m l x'' cos theta - m g l sin theta = 0"


@pytest.mark.parametrize(
    "written",
    [
        "mL^2 θ ̈+bθ ̇+mgL sin\u2061〖θ〗=0",
        "mL^2 (θ) ̈  + b(θ) ̇+mgL sin\u2061θ=0",
        "mL^2 (d^2 θ)/(dt^2 )+b dθ/dt+mgL sin\u2061θ=0",
        "mL^2 (d^2 θ)/〖dt〗^2 +b (dθ)/(dt)+m\u2062g\u2062L sin\u2061θ=0",
        "█(T=1/2 m(Lθ ̇ )^2@mL^2 θ ̈+bθ ̇+mgL sin\u2061θ=0)",
        "T=1/2 m〖(Lθ ̇)〗^2\nd/dt (∂T/(∂θ ̇ ))+bθ ̇=-mgL sin\u2061〖(2θ-θ)〗",
        "[■(mL^2 )][■(θ ̈ )]+[■(bθ ̇+mgL sin\u2061θ )]=[■(0)]#(1)",
        "m L^2 theta.. + b*theta. + m*g*L*sin(theta) = 0",
        "m L^2 θ¨ + b θ˙ + m g L sin θ = 0.",
        "m L^2 ¨θ + b ˙θ + m g L sin θ = 0",
    ],
)
def test_word_s_linear_format_and_dots_beside_letters(written: str) -> None:
    verdict = derivation("pendulum").check(written)
    assert verdict.right, verdict.to_text()


def test_word_s_matrices_and_indices() -> None:
    rows = "[■(M+m&ml cos\u2061θ@ml cos\u2061θ&J+ml^2 )][■(x ̈@θ ̈ )]"
    rows += "+[■(bx ̇-ml sin\u2061〖θ θ ̇^2 〗@-mgl sin\u2061θ )]=[■(F@0)]"
    assert derivation("cart-pole").check(rows).right
    model = derivation("lecture-3b").model
    plain = parse_answer("T = 1/2*m1*x1'^2 + 1/2*m2*(x1' + x2r')^2", model)
    assert parse_answer("T=1/2 m_1 x ̇_1^2+1/2 m_2 (x ̇_1+x ̇_(2r))^2", model).lines[0].rhs == plain.lines[0].rhs


@pytest.mark.parametrize(
    "written",
    [
        "\\newcommand{\\st}{\\sin\\theta}\n\\def\\dth{\\dot\\theta}\n\\[ mL^2\\ddot\\theta + b\\dth + mgL\\st = 0 \\]",
        "\\newcommand{\\of}[2][x]{#1\\left(#2\\right)}\n$mL^2\\ddot\\theta + b\\dot\\theta = -mgL\\of[\\sin]\\theta$",
        "\\DeclareMathOperator{\\sn}{sin}\n$mL^2\\ddot\\theta + b\\dot\\theta + mgL\\sn\\theta = 0$",
        r"$T = \frac m2 L^2\dot\theta^2$, $\dv{t}\pdv{T}{\dot\theta} + b\dv{\theta}{t} + mgL\sin\qty(\theta) = 0$",
        r"$mL^2\dv[2]{\theta}{t} + b\,\dv{\theta}{t} + mgL\sin\theta = 0$",
        r"Let $J(m) = mL^2$. Then $J(m)\ddot\theta + b\dot\theta + mgL\sin\theta = 0$.",
        r"With $q = (\theta, \dot\theta)^\top$: $mL^2\ddot\theta + b\dot\theta + mgL\sin\theta = 0$",
    ],
)
def test_macros_in_latex(written: str) -> None:
    verdict = derivation("pendulum").check(written)
    assert verdict.right, verdict.to_text()


def test_a_macro_that_grows_is_refused_and_errors_keep_their_place() -> None:
    model = derivation("pendulum").model
    doubled = "".join(rf"\newcommand{{\{b}}}{{\{a}\{a}}}" for a, b in zip("abcdef", "bcdefg", strict=True))
    with pytest.raises(ParseError) as caught:
        parse_answer(rf"\newcommand{{\a}}{{{'x' * 4000}}}{doubled}" + r"$\g = 0$", model)
    assert caught.value.code == "E703"
    with pytest.raises(ParseError) as caught:
        parse_answer("\\newcommand{\\a}{\\a\\a}\n$\\a = 0$", model)
    assert caught.value.code == "E703"
    with pytest.raises(ParseError) as caught:
        parse_answer("\\newcommand{\\st}{\\sin\\theta}\n$mL\\st + \\nonsense = 0$", model)
    assert caught.value.place is not None
    assert (caught.value.place.line, caught.value.place.column) == (2, 10)


@pytest.mark.parametrize(
    ("before", "behind"),
    [
        *((x, "") for x in ("1.) ", "1: ", "Eq (1) ", "Gl. (1): ", "① ", "(I) ", "II. ", "a) (i) ", "▪ ", "* ", "⎧ ")),
        *((x, "") for x in ("∑M: ", "=> ", "Substituting gives:\n", "L'équation du mouvement est ", "DGL: ")),
        *(("", x) for x in (" …(1)", "....(1)", " (Gl. 1)", "(Eq. 3.1)", "\t(3.12)", " (*)", " ✓", " q.e.d.", "!")),
        *(("", x) for x in (" gilt.", " which is the EOM", " | : m", " <- EOM", " [Nm]", " und fertig")),
    ],
)
def test_what_stands_before_and_behind_an_equation(before: str, behind: str) -> None:
    verdict = derivation("pendulum").check(f"{before}{PLAIN}{behind}")
    assert verdict.right, verdict.to_text()


@pytest.mark.parametrize(
    "written",
    [
        f"(1){CART}\n(2){POLE}",
        f"{CART} (2.1)\n{POLE} (2.2)",
        f"{CART}(1)\n{POLE}(2)",
        f"* {CART}\n* {POLE}",
        f"{CART} sowie {POLE}",
        f"| x | {CART} |\n| θ | {POLE} |",
        f"{{{CART}; {POLE}}}",
        f"[{CART}]\n[{POLE}]",
    ],
)
def test_two_equations_in_a_list(written: str) -> None:
    verdict = derivation("cart-pole").check(written)
    assert verdict.right, verdict.to_text()


@pytest.mark.parametrize(
    "written",
    [
        f"{CART} (2)\n{POLE}".replace("= F (2)", "= F (2) + 0"),
        f"{CART}\n{POLE.replace('m g l', 'm g l (0.5)')}",
        f"{CART}\n{POLE} + foo bar",
    ],
)
def test_a_factor_is_no_number_of_an_equation_and_a_name_no_word(written: str) -> None:
    with contextlib.suppress(ParseError):
        assert not derivation("cart-pole").check(written).right


def test_runs_of_letters_in_latex_are_split_or_asked_about() -> None:
    model = derivation("quarter-car").model
    one, other = (parse_answer(rf"$k_t{x}z_r = F$", model).lines[0].lhs for x in ("", r"\,"))
    assert one == other


def test_a_chain_that_ends_in_the_force_is_an_equation() -> None:
    chain = "d/dt(∂L/∂x') = (M + m) x'' + m s'' cos α = {F}\nd/dt(∂L/∂s') - ∂L/∂s = m s'' + m x'' cos α - m g sin α = 0"
    assert derivation("wedge").check(chain.format(F="F")).right
    assert not derivation("wedge").check(chain.format(F="2 F")).right
