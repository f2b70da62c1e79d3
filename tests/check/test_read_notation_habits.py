r"""Habits of notation: numbers in groups, dots that lead to a number, tables with sides, lists in braces, determinants,
sums over an index, matrices in words, lines that are cut, fractions drawn in the middle of a line.

Oracle: the equations of a cart with a pendulum, and of a mass on a spring and a damper, written by hand; each has a
twin with a wrong sign, factor or term, which must not be accepted.
"""

from __future__ import annotations

import pytest
from small_systems import cart, mass

import lagrangian as lg
from lagrangian import ParseError
from lagrangian.check.reading.said.subscripts import with_index_behind_comma
from lagrangian.check.reading.thousands import with_whole_numbers
from lagrangian.check.reading.traced_text import TracedText

X = "(M + m) x'' + m l φ'' cos φ − m l φ'² sin φ + k x = 0"
PHI = "m l x'' cos φ + m l² φ'' + m g l sin φ = 0"
R = "R_1 = m l φ'² sin φ − k x, R_2 = −m g l sin φ"
MATRIX, FIRST, SECOND = (
    "[M + m, m l cos φ; m l cos φ, m l²]",
    "[R_1, m l cos φ; R_2, m l²]",
    "[M + m, R_1; m l cos φ, R_2]",
)


def accepted(answer: str, derivation: lg.Derivation | None = None) -> bool:
    """Whether an answer is read and right."""
    try:
        return (derivation or cart()).check(answer, hint=0).right
    except ParseError:
        return False


def told(answer: str, derivation: lg.Derivation | None = None) -> str:
    """What is told of an answer."""
    return " ".join((derivation or cart()).check(answer).to_text().split())


def loaded() -> lg.Derivation:
    """A mass on a stiff spring, with values."""
    return mass(m="2.5 kg", k="40000 N/m", b="350 N*s/m")


NUMBERS = ["40 000", "40\u2009000", "40'000", "40_000", "40,000", "40 000.0", "40\u00a0000"]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("number", NUMBERS)
def test_numbers_in_groups_of_three_are_one_number(number: str) -> None:
    assert accepted(f"2.5 x'' + 350 x' + {number} x = F", loaded())
    assert not accepted(f"2.5 x'' + 350 x' + {number.replace('40', '4')} x = F", loaded())


@pytest.mark.parametrize("number", [r"40\,000", "40~000", "40{,}000", r"40{\,}000", "40 000"])
def test_numbers_in_groups_of_three_in_latex(number: str) -> None:
    answer = rf"\[ 2.5\ddot x + 350\dot x + {number} x = F \]"
    assert accepted(answer, loaded())
    assert not accepted(answer.replace("000", "00"), loaded())


def test_a_point_between_groups_beside_decimal_commas() -> None:
    assert accepted("2,5 x'' + 350 x' + 40.000 x = F", loaded())
    assert "40.000 was read as 40000." in told("2,5 x'' + 350 x' + 40.000 x = F", loaded())
    assert not accepted("2.5 x'' + 350 x' + 40.000 x = F", loaded())  # 40


@pytest.mark.parametrize(
    "text",
    ["[1 200; 3 400]", "(1,200)", "t in [0,2], 1.250 x", "diff(x1,2) = 1.250 x", "phi^2 200 x", "m1 100", "| 1 200 |"],
)
def test_numbers_that_are_no_groups_stay(text: str) -> None:
    assert with_whole_numbers(TracedText(text), {}).text == text


def test_numbers_that_count_lines_are_no_groups() -> None:
    text = "1 205 x = F\n2 300 y = G"
    assert with_whole_numbers(TracedText(text), {}).text == text


@pytest.mark.sampled(4)
@pytest.mark.parametrize("between", [" ......... ", " . . . . ", " … ", " ---- ", "·····", " → ", " ==> ", " —— —— "])
@pytest.mark.parametrize("labels", [("(a)", "(b)"), ("(1)", "(2)"), ("[1]", "[2]"), ("(*)", "(**)"), ("(k)", "(l)")])
def test_what_leads_to_a_number_is_no_factor(between: str, labels: tuple[str, str]) -> None:
    answer = f"{X}{between}{labels[0]}\n{PHI}{between}{labels[1]}"
    assert accepted(answer)
    assert not accepted(answer.replace("− m l", "+ m l"))


@pytest.mark.parametrize(
    "gap",
    [
        r"\mathrel{\phantom{=}} {}",
        r"\phantom{=}",
        r"\phantom{{}={}}",
        r"\hphantom{=}{}",
        r"\mathrel{\hphantom{=}}",
        r"\quad {}",
    ],
)
def test_what_is_not_printed_is_no_sign(gap: str) -> None:
    answer = rf"""\begin{{align}}
(M+m)\ddot x &\mathrel{{=}} ml\dot\phi^2\sin\phi - ml\ddot\phi\cos\phi \\
&{gap} - kx, \\
ml\ddot x\cos\phi + ml^2\ddot\phi &= -mgl\sin\phi
\end{{align}}"""
    assert accepted(answer)
    assert not accepted(answer.replace("- kx", "+ kx"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("space", [r"\,", r"\;", "~", r"\ ", r"\quad", ""])
@pytest.mark.parametrize("box", ["boxed", "Aboxed", "fbox"])
def test_space_at_the_end_of_a_row_is_no_operator(space: str, box: str) -> None:
    first = r"(M+m)\ddot x + ml\ddot\phi\cos\phi - ml\dot\phi^2\sin\phi + kx = 0"
    second = r"ml\ddot x\cos\phi + ml^2\ddot\phi + mgl\sin\phi = 0"
    boxes = [rf"\{box}{{{space} {x}{space}}}" for x in (first, second)]
    answer = f"\\begin{{gather}}\n{boxes[0]}\n\\intertext{{and for the bob}}\n{boxes[1]}\n\\end{{gather}}"
    assert accepted(answer)
    assert not accepted(answer.replace("+ mgl", "- mgl"))
    assert accepted(rf"\begin{{align}} {first.replace('=', '= ' + space + chr(92) * 2)} \\ {second} \end{{align}}")


ROWS = "| x | (M + m) x'' + m l φ'' cos φ − m l φ'² sin φ | −k x |\n| φ | m l x'' cos φ + m l² φ'' | −m g l sin φ |\n"


@pytest.mark.parametrize(
    "head",
    [
        "| coordinate | left side | right side |",
        "| | LHS | RHS |",
        "| q | Left-hand side | Right-hand side |",
        "| | linke Seite | rechte Seite |",
        "| | left side (inertia) | right side (forces) |",
    ],
)
def test_columns_that_are_called_sides_are_equal(head: str) -> None:
    answer = f"{head}\n|---|---|---|\n{ROWS}"
    assert accepted(answer)
    assert accepted(f"{answer}\nLeft side = right side in every row.\n")
    assert not accepted(answer.replace("| −k x |", "| k x |"))


@pytest.mark.parametrize(
    "said", ["In every row the left side equals the right side.", "The second column equals the third column."]
)
def test_words_say_that_columns_are_equal(said: str) -> None:
    answer = f"| q | inertia | forces |\n|---|---|---|\n{ROWS}\n{said}\n"
    assert accepted(answer)
    assert not accepted(answer.replace("− m l φ'²", "+ m l φ'²"))


@pytest.mark.slow
def test_t_behind_a_comma_is_a_derivative() -> None:
    for mark in ("_{,%s}", "_,%s", ",%s", "_{, %s}"):
        answer = X.replace("''", mark % "tt").replace("'", mark % "t") + "\n" + PHI.replace("''", mark % "tt")
        for said in ("", "( ),t is the time derivative.\n", "(·)_{,t} = d(·)/dt\n", "A comma and t mean d/dt:\n"):
            assert accepted(said + answer)
            assert not accepted(said + answer.replace("k x", "k"))
    found = with_index_behind_comma(TracedText("x_{1,t} + x_1,t"), lambda name: name == "x_1")
    assert found.text == "x_1' + x_1,t"
    latex = r"\[ (M+m) x_{,tt} + m l \cos\varphi\, \varphi_{,tt} - m l \sin\varphi\, \varphi_{,t}^2 + k x = 0 \]"
    assert accepted(latex + "\n" + r"\[ m l \cos\varphi\, x_{,tt} + m l^2 \varphi_{,tt} + m g l \sin\varphi = 0 \]")


@pytest.mark.parametrize("sign", [" ", ".", "*", "·", "x", "•"])
def test_a_sign_between_tall_brackets_is_a_product(sign: str) -> None:
    answer = rf"""/ M + m       m l cos(φ) \   / x'' \     / m l φ'^2 sin(φ) - k x \
|                        | {sign} |     |  =  |                       |
\ m l cos(φ)  m l^2      /   \ φ'' /     \ -m g l sin(φ)         /
"""
    assert accepted(answer)
    assert not accepted(answer.replace("- k x", "+ k x"))


LISTS = "{{M + m, m*l*Cos[φ[t]]}, {m*l*Cos[φ[t]], m*l^2}}"
COLUMN, FORCES = "{x''[t], φ''[t]}", "{m*l*φ'[t]^2*Sin[φ[t]] - k*x[t], -m*g*l*Sin[φ[t]]}"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "form",
    [
        "A . Q == F",
        "A.Q==F",
        "Thread[A . Q == F]",
        "eqs = A . Q - F == {0, 0}",
        "mm = A;\nff = F;\nThread[mm . Q == ff]",
        "Dot[A, Q] == F",
        "MatrixForm[A].MatrixForm[Q] == MatrixForm[F]",
        "Q == LinearSolve[A, F]",
        "Q == Inverse[A] . F",
    ],
)
def test_lists_in_braces_are_matrices(form: str) -> None:
    answer = form.replace("LinearSolve", "%").replace("MatrixForm", "@").replace("Inverse", "#").replace("ff", "$")
    for name, value in (("A", LISTS), ("Q", COLUMN), ("F", FORCES)):
        answer = answer.replace(name, value.replace("m", "µ"))
    for sign, word in (("µ", "m"), ("%", "LinearSolve"), ("@", "MatrixForm"), ("#", "Inverse"), ("$", "ff")):
        answer = answer.replace(sign, word)
    assert accepted(answer)
    assert not accepted(answer.replace("- k*x", "+ k*x"))
    assert not accepted(answer.replace("m*l^2", "m*l"))


@pytest.mark.parametrize("opened, closed", [("[■(", ")]"), ("■(", ")"), ("(■(", "))"), (r"\matrix(", ")")])
def test_rows_in_the_linear_format_end_at_their_sign(opened: str, closed: str) -> None:
    matrix = f"{opened}M+m&ml cos(φ)@ml cos(φ)&ml^2{closed}"
    answer = f"{matrix}{opened}x ̈@φ ̈{closed}={opened}ml φ ̇^2 sin(φ)-kx@-mgl sin(φ){closed}"
    assert accepted(answer)
    assert not accepted(answer.replace("-kx", "+kx"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "begin, end",
    [
        (r"\begin{vmatrix}", r"\end{vmatrix}"),
        (r"\left|\begin{matrix}", r"\end{matrix}\right|"),
        (r"\det\begin{pmatrix}", r"\end{pmatrix}"),
        (r"\operatorname{det}\begin{bmatrix}", r"\end{bmatrix}"),
    ],
)
def test_determinants_in_latex(begin: str, end: str) -> None:
    whole, first, second = (
        f"{begin} {x} {end}"
        for x in (
            r"M+m & ml\cos\phi \\ ml\cos\phi & ml^2",
            r"R_1 & ml\cos\phi \\ R_2 & ml^2",
            r"M+m & R_1 \\ ml\cos\phi & R_2",
        )
    )
    answer = rf"""With $R_1 = ml\dot\phi^2\sin\phi - kx$ and $R_2 = -mgl\sin\phi$:
\[ \ddot x = \frac{{{first}}}{{{whole}}}, \qquad \ddot\phi = \frac{{{second}}}{{{whole}}} \]"""
    assert accepted(answer)
    assert not accepted(answer.replace("R_2 & ml^2", "R_2 & ml"))


def test_bars_around_columns_are_brackets() -> None:
    answer = r"""\[ \begin{vmatrix} M+m & ml\cos\phi \\ ml\cos\phi & ml^2 \end{vmatrix}
\begin{vmatrix} \ddot x\\ \ddot\phi\end{vmatrix} =
\begin{vmatrix} ml\dot\phi^2\sin\phi - kx \\ -mgl\sin\phi \end{vmatrix} \]"""
    assert accepted(answer)
    assert not accepted(answer.replace("- kx", "+ kx"))


@pytest.mark.parametrize(
    "answer",
    [
        f"{R}\nx'' = det({FIRST})/det({MATRIX})\nφ'' = det({SECOND})/det({MATRIX})",
        f"{R}\nA = {MATRIX}\nΔ = det(A)\nx'' = det {FIRST}/Δ\nφ'' = det {SECOND}/Δ",
        f"{R}\nA = {MATRIX}, A_1 = {FIRST}, A_2 = {SECOND}\nx'' = |A_1|/|A|\nφ'' = |A_2|/|A|",
    ],
)
def test_determinants_in_text(answer: str) -> None:
    assert accepted(answer)
    assert not accepted(answer.replace("R_2, m l²", "R_2, m l"))


MASSES = """m_1 = M, m_2 = m
Σ_{i=1}^{2} m_i x'' + m_2 l φ'' cos φ − m_2 l φ'² sin φ + k x = 0
m_2 l x'' cos φ + m_2 l² φ'' + m_2 g l sin φ = 0"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("total", ["Σ_{i=1}^{2}", "∑_(i=1)^2", "Σ_{i∈{1,2}}", "Σ_i", "sum_{i=1}^2", "Σ_{i=1,2}"])
def test_sums_over_an_index_are_written_out(total: str) -> None:
    answer = MASSES.replace("Σ_{i=1}^{2}", total)
    assert accepted(answer)
    assert not accepted(answer.replace("m_2 = m", "m_2 = M"))


def test_a_sum_over_other_numbers_is_another_one() -> None:
    assert not accepted(MASSES.replace("Σ_{i=1}^{2}", "Σ_{i=2}^{2}"))
    latex = r"""With $m_1 = M$, $m_2 = m$: \begin{align*}
\Big(\sum_{i=1}^{2} m_i\Big)\,\ddot x + m_2 l\ddot\phi\cos\phi - m_2 l\dot\phi^2\sin\phi + kx &= 0\\
m_2 l\ddot x\cos\phi + m_2 l^2\ddot\phi + \sum_{i\in\{2\}} m_i\, g l\sin\phi &= 0 \end{align*}"""
    assert accepted(latex)
    assert not accepted(latex.replace(r"i\in\{2\}", r"i\in\{1\}"))


ENTRIES = "M_11 = M + m, M_12 = M_21 = m l cos φ, M_22 = m l²\nf_1 = m l φ'² sin φ − k x, f_2 = −m g l sin φ"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "form",
    [
        "Σ_{j=1}^{2} M_ij q̈_j = f_i for i = 1, 2, where q_1 = x, q_2 = φ,",
        "Σ_j M_ij q̈_j = f_i, i = 1, 2, with q₁ = x, q₂ = φ",
        "M_ij q̈_j = f_i (i = 1, 2), q_1 = x, q_2 = φ",
        "Σ_{j∈{x,φ}} M_ij q̈_j = f_i for i ∈ {x, φ}, where q = (x, φ),",
    ],
)
def test_the_form_of_one_row_is_that_of_all(form: str) -> None:
    entries = ENTRIES
    if "∈" in form:
        for number, name in (
            ("_11", "_xx"),
            ("_12", "_xφ"),
            ("_21", "_φx"),
            ("_22", "_φφ"),
            ("_1", "_x"),
            ("_2", "_φ"),
        ):
            entries = entries.replace(number, name)
    assert accepted(f"{form}\n{entries}")
    assert not accepted(f"{form}\n{entries.replace('− k x', '+ k x')}")
    assert not accepted(f"{form}\n{entries.replace('= m l cos φ', '= −m l cos φ')}")


ROW_LIST = "[M + m, m l cos φ], [m l cos φ, m l²]"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "form",
    [
        "Mass matrix, row by row: {rows}. It multiplies {q}ᵀ, and the product equals\n{f}ᵀ.",
        "Rows of the mass matrix: {rows}. Multiplied by {q}ᵀ this equals {f}ᵀ.",
        "The matrix with the rows: {rows}\ntimes {q} = {f}",
        "A = {rows}\nA {q}ᵀ = {f}ᵀ",
    ],
)
def test_a_matrix_by_its_rows_in_words(form: str) -> None:
    answer = form.format(rows=ROW_LIST, q="(x'', φ'')", f="(m l φ'² sin φ − k x, −m g l sin φ)")
    assert accepted(answer)
    assert not accepted(answer.replace("− k x", "+ k x"))
    assert not accepted(answer.replace("m l²]", "m l]"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("at", ["m l φ''", "cos φ", "− m l", "φ'²", "k x"])
def test_lines_that_are_cut_anywhere(at: str) -> None:
    answer = f"The equations of motion are\n{X.replace(f' {at}', chr(10) + at, 1)}\n\n{PHI}"
    assert accepted(answer)
    assert not accepted(answer.replace("k x", "2 k x"))


def test_a_factor_alone_on_its_line() -> None:
    assert accepted(f"We find\nm l\n(x'' cos φ\n+ l φ'' + g sin φ) = 0\n\n{X}")
    assert not accepted(f"We find\nm l\n(x'' cos φ\n+ l φ'' − g sin φ) = 0\n\n{X}")


def test_cut_lines_hide_no_wrong_line() -> None:
    """A wrong line beside one without an equals sign is judged, whatever can be read of both together."""
    wrong = "x'' = 3 φ''\nof the cart k x"
    assert not accepted(f"{X}\n{PHI}\n{wrong}")
    T = "1/2 (M + m) x'² + m l x' φ' cos φ + 1/2 m l² φ'²"
    energies = f"T: {T}\nV: 1/2 k x² + m g l cos φ\nx: {X}\nφ: {PHI}"
    assert not accepted(energies)
    assert accepted(energies.replace("+ m g l cos φ", "− m g l cos φ"))


def test_a_fraction_drawn_in_the_middle_of_a_line() -> None:
    answer = """
              b x' + k x
x'' = F/m  -  -----------
                   m
"""
    assert accepted(answer, mass())
    assert not accepted(answer.replace("+ k x", "- k x"), mass())
    counted = "          b ẋ + k x\nẍ = F/m − -----------\n             m"  # with the marks above letters
    assert accepted(counted, mass())
    assert not accepted(counted.replace("+ k x", "+ k"), mass())


def test_no_note_tells_how_a_line_was_read_that_was_not() -> None:
    answer = "m (= 2.5 kg) moves with x, b = 350 N s/m.\n2.5 x'' + 350 x' + 40000 x = F"
    assert accepted(answer, loaded())
    assert "kg as k g" not in told(answer, loaded())


def test_only_values_that_the_equations_have_are_substituted() -> None:
    s = lg.System("mass above the floor")
    x = s.coordinate("x")
    m, k, h, g = s.parameter("m", 2), s.parameter("k", 8), s.parameter("h", 3), s.parameter("g", 9.81)
    s.particle(m, at=s.point("C", (x, h)), name="mass")
    s.spring(k, deflection=x)
    s.gravity((0, -1), g)
    derivation = s.derive()
    assert "The values of k, m are substituted." in told("2 x'' + 8 x = 0", derivation)
    assert "The value of k is substituted." in told("m x'' + 8 x = 0", derivation)


def test_what_says_how_a_rate_is_called_is_no_line() -> None:
    answer = "xp = x Punkt (first time derivative), xpp = x zwei Punkt (second).\nm xpp + b xp + k x = F"
    assert accepted(answer, mass())
    assert "0 = 0" not in told(answer, mass())
    marks = "(d = dot, dd = double dot)\nm*xdd + b*xd + k*x = F"
    assert accepted(marks, mass())
    assert "not read" not in told(marks, mass())
    assert not accepted(marks.replace("b*xd", "b*xdd"), mass())
