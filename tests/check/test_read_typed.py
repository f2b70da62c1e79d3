"""What people type on phones, in Word and in LaTeX around and inside their equations.

Oracle: the equation of the pendulum, m L² θ̈ + b θ̇ + m g L sin θ = 0, and those of the cart with a pole, in the grammar
of model files.
"""

import io
import re
from pathlib import Path

import pytest

from built_in import derivation
from lagrangian import ParseError
from lagrangian.check.reading import decode_answer, parse_answer
from lagrangian.cli import main
from student_answers import CART, POLE

PLAIN = "m L² θ'' + b θ' + m g L sin θ = 0"
CHANGED = PLAIN.replace("θ", "theta")
DIAGONAL = r"\operatorname{diag}(m_1, m_2)\ddot x + K x = f"


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
    assert derivation("cart-pole").check(rows, hint=0).right
    model = derivation("lecture-3b").model
    plain = parse_answer("T = 1/2*m1*x1'^2 + 1/2*m2*(x1' + x2r')^2", model)
    assert parse_answer("T=1/2 m_1 x ̇_1^2+1/2 m_2 (x ̇_1+x ̇_(2r))^2", model).lines[0].rhs == plain.lines[0].rhs


@pytest.mark.parametrize(
    "written",
    [
        "\\newcommand{\\st}{\\sin\\theta}\n\\def\\dth{\\dot\\theta}\n\\[ mL^2\\ddot\\theta + b\\dth + mgL\\st = 0 \\]",
        "\\newcommand{\\st}{\\sin\\theta}\\newcommand{\\ct}{\\cos\\theta}\\newcommand{\\dth}{\\dot\\theta}"
        "\\[ mL^2\\ddot\\theta + b\\dth^2/\\dth + mgL\\st(\\st^2 + \\ct^{2}) = 0 \\]",
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


@pytest.mark.parametrize(
    "squared", [r"\cos[2](\theta)", r"\cos[2]\left(\theta\right)", r"\cos[2]{\theta}", r"\cos[2]\qty(\theta)"]
)
def test_powers_and_matrices_of_the_package_physics(squared: str) -> None:
    inertia = rf"\pqty{{J+ml^2-\flatfrac{{(ml)^2{squared}}}{{(M+m)}}}}\ddot\theta"
    gravity = r"mgl\sin\theta - \frac{ml\cos\theta}{M+m}\bqty{F - b\dot x + ml\sin(\theta)\dot\theta^2}"
    matrix = r"\mqty(M+m & ml\cos\theta \\ ml\cos\theta & J+ml^2) \mqty[\ddot x \\ \ddot\theta] = "
    force = r"\pmqty{F-b\dot{x}+ml\sin(\theta)\dot\theta^2 \\ mgl\sin\theta}"
    written = rf"\[{matrix}{force}\]" + "\n" + rf"\[{inertia} = {gravity}\]"
    verdict = derivation("cart-pole").check(written)
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


@pytest.mark.sampled(4)
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


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("written", "said"),
    [
        (f"{CART} (2)\n{POLE}".replace("= F (2)", "= F (2) + 0"), "'F' is not a function"),
        (f"{CART}\n{POLE} + foo bar", "a product must be written with *: found 'foo bar'"),
    ],
)
def test_a_number_amid_an_equation_is_no_label_and_a_name_no_word(written: str, said: str) -> None:
    with pytest.raises(ParseError, match=re.escape(said)):
        derivation("cart-pole").check(written)


@pytest.mark.slow
def test_a_number_in_brackets_is_a_factor() -> None:
    assert not derivation("cart-pole").check(f"{CART}\n{POLE.replace('m g l', 'm g l (0.5)')}", hint=0).right
    assert derivation("cart-pole").check(f"{CART}\n{POLE.replace('m g l', 'm g l (0.5) (2)')}", hint=0).right


def test_runs_of_letters_in_latex_are_split_or_asked_about() -> None:
    model = derivation("quarter-car").model
    one, other = (parse_answer(rf"$k_t{x}z_r = F$", model).lines[0].lhs for x in ("", r"\,"))
    assert one == other


def test_signs_in_front_of_all_lines_may_be_minus_signs() -> None:
    minus = "- F + (M + m) x'' + m s'' cos α = 0\n- m g sin α + m s'' + m x'' cos α = 0"
    for rows in (minus, minus.replace("- F", "- -F").replace("- m g", "- -m g")):
        assert derivation("wedge").check(rows, hint=0).right, rows
    assert not derivation("wedge").check(minus.replace("- F", "- 2 F"), hint=0).right


def test_a_chain_that_ends_in_the_force_is_an_equation() -> None:
    chain = "d/dt(∂L/∂x') = (M + m) x'' + m s'' cos α = {F}\nd/dt(∂L/∂s') - ∂L/∂s = m s'' + m x'' cos α - m g sin α = 0"
    assert derivation("wedge").check(chain.format(F="F"), hint=0).right
    assert not derivation("wedge").check(chain.format(F="2 F"), hint=0).right


@pytest.mark.parametrize(
    ("written", "encoding"),
    [
        *((f"\ufeffLösung:\n{PLAIN}", x) for x in ("utf-8", "utf-16-le", "utf-16-be", "utf-32-le")),
        *((CHANGED.replace("L²", "L^2"), x) for x in ("utf-16-le", "utf-16-be")),
        ("Die Lösung für den Winkel – “mit Dämpfer” – lautet:\nT = ½*m*L²*theta'²\n" + CHANGED, "cp1252"),
        ("L’équation du mouvement :\n" + CHANGED, "cp1252"),
    ],
)
def test_files_of_windows_are_read(written: str, encoding: str) -> None:
    text = decode_answer(written.encode(encoding), "answer.txt")
    assert derivation("pendulum").check(text, hint=0).right


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (PLAIN.encode("cp1253"), "not UTF-8"),  # θ is the byte of è
        ("m*L²*phi'' + m*g*L*sinφ = 0".encode("cp1253"), "not UTF-8"),  # φ that of ö
        ("φL = 2".encode("cp1253"), "not UTF-8"),
        ("T = ½*m".encode("cp850"), "not UTF-8"),
        ("Lösung: T = 1".encode("mac-roman"), "not UTF-8"),
        (b"\xff\xfeT\0 \xd8", "damaged"),
        (b"\xff\xfe\0\xd8T\0", "damaged"),
        (b"\x7fELF\0\0\0\0", "equations as text"),
        (b"T = 1\0\0\0", "zero byte"),
    ],
)
def test_what_may_have_other_letters_is_refused(data: bytes, said: str) -> None:
    with pytest.raises(ParseError, match=said) as caught:
        decode_answer(data, "answer.txt")
    assert caught.value.place is not None and caught.value.place.file == "answer.txt"


def test_the_command_and_classes_read_utf_16(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "anna.txt"
    file.write_bytes(PLAIN.encode("utf-16"))
    assert main(["check", "-e", "pendulum", str(file)]) == 0
    assert main(["check", "-e", "pendulum", str(tmp_path)]) == 0
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(PLAIN.encode("utf-16"))))
    assert main(["check", "-e", "pendulum", "-"]) == 0


@pytest.mark.parametrize(
    ("name", "written"),
    [
        ("pendulum", "m L² theta_pp + b theta_p + m g L sin(theta) = 0"),
        ("pendulum", "m L² θpunktpunkt + b θpunkt + mgL sinθ = 0"),
        ("pendulum", "(m + m)L²θ'' + 2bθ' + (m + m)gLsinθ = 0"),
        ("pendulum", "∑M = m L² θ'' = -b θ' - m g L sin θ"),
        ("pendulum", "T=1/2 m L² θ'²   V=-m g L cos θ\nm L² θ'' = -b θ' - m g L sin θ   | : mL"),
        ("pendulum", "m L² θ'' = -b θ' - m g L sin θ   | : mL\n=> L θ'' = -b/(mL) θ' - g sin θ"),
        ("pendulum", r"$\omega_0^2 \coloneqq g/L$, $mL^2\ddot\theta + b\dot\theta + mL^2\omega_0^2\sin\theta = 0$"),
        ("lecture-3a", "M x'' + K x = f\nM = [m1 0; 0 m2]\nK = [k -k; -k k]\nf = [-F; F]"),
        ("lecture-3a", "M x'' + K x = f\nM = diag(m1, m2)\nK = [k, -k; -k, k]\nf = [-F; F]"),
        ("lecture-3a", rf"${DIAGONAL}, K = \begin{{bmatrix}}k&-k\\-k&k\end{{bmatrix}}, f = [-F, F]^\top$"),
    ],
)  # fmt: skip
def test_customs_of_notebooks(name: str, written: str) -> None:
    verdict = derivation(name).check(written)
    assert verdict.right, verdict.to_text()


@pytest.mark.slow
def test_sums_of_angles_without_brackets() -> None:
    rows = "(m1+m2)L1θ1'' + m2L2θ2''cosθ1{s}θ2 + m2L2θ2'²sinθ1-θ2 + (m1+m2)g sinθ1 = 0\n"
    rows += "L2θ2'' + L1θ1''cosθ1-θ2 - L1θ1'²sinθ1-θ2 + g sinθ2 = 0"
    verdict = derivation("double-pendulum").check(rows.format(s="-"))
    assert verdict.right and "read as sums: cos(θ1-θ2)" in " ".join(map(str, verdict.notes))
    assert not derivation("double-pendulum").check(rows.format(s="+"), hint=0).right
    assert not derivation("double-pendulum").check(rows.format(s=" - "), hint=0).right


def test_products_in_a_column_stay_products() -> None:
    columns = "[(M + m) x'' + m s'' cos α; m s'' + m x'' cos α] = [F; m g sin α]"
    assert derivation("wedge").check(columns, hint=0).right
    assert derivation("pendulum").check("[m L² θ''] + [b θ'] = [-m g L sin θ]", hint=0).right
