r"""The general form M(q) q″ + h(q, q′) = f, whose matrices an answer gives by their entries, rows or columns.

Oracle: a cart M with a pendulum m on a spring and a damper that a force drives; the system has a length h and a mass M.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.reading.general_matrices import with_general_form
from lagrangian.check.reading.traced_text import TracedText
from lagrangian.errors import ParseError


@cache
def driven(damping: str = "c") -> lg.Derivation:
    s = lg.System("driven cart with a pendulum")
    x, phi = s.coordinates("x phi")
    M, m, l, k, g, h = s.parameters("M m l k g h")
    F, tau = s.inputs("F tau")
    s.particle(M, at=s.point("C", (x, 0)), name="cart")
    s.particle(m, at=s.point("B", (x + l * sp.sin(phi), -l * sp.cos(phi))), name="bob")
    s.spring(k, deflection=x, name="spring")
    s.damper(s.parameter(damping), deflection=x, name="damper")
    s.gravity((0, -1), g)
    s.force(F, deflection=x)
    s.force(tau, deflection=h * phi)
    return s.derive()


M11, M12, M22 = "M + m", "m l cos phi", "m l^2"
H1, H2 = "k x + c x' - m l phi'^2 sin phi", "m g l sin phi"
SQUARE = f"M11 = {M11}, M12 = M21 = {M12}, M22 = {M22}\n"
COLUMN = f"h1 = {H1}\nh2 = {H2}\n"
FORCES = "f1 = F, f2 = h tau"
FORM = "M(q) q'' + h(q,q') = f\n"
PLAIN = {
    "entries": FORM + SQUARE + COLUMN + FORCES,
    "entries above": SQUARE + COLUMN + FORCES + "\nso that M(q) q'' + h(q,q') = f.",
    "with": f"M q'' + h = f with\n{SQUARE}{COLUMN}{FORCES}",
    "dots": "M(q) q̈ + h(q,q̇) = f\n" + SQUARE + COLUMN + FORCES,
    "brackets": "[M]{q''} + {h} = {f}\n" + SQUARE + COLUMN + FORCES,
    "indices": FORM + (SQUARE + COLUMN + FORCES).replace("M1", "M_1").replace("M2", "M_2").replace("h2", "h_2"),
    "braces": FORM + "M_{11} = M + m, M_{12} = M_{21} = m l cos phi, M_{22} = m l^2\n" + COLUMN + FORCES,
    "small letters": FORM + SQUARE.replace("M1", "m1").replace("M2", "m2") + COLUMN + FORCES,
    "symmetric": FORM + SQUARE.replace("= M21 ", "") + COLUMN + FORCES,
    "column written out": "M(q) q'' + h(q,q') = [F; h tau]\n" + SQUARE + COLUMN,
    "on the right": "M q'' = f - h\n" + SQUARE + COLUMN + FORCES,
    "minus": "M q'' = -n\n" + SQUARE + f"n1 = {H1} - F\nn2 = {H2} - h tau",
    "products": "M q'' + C q' + K q + G = f\n"
    + SQUARE
    + "C11 = c, C12 = -m l phi' sin phi, C21 = 0, C22 = 0\n"
    + f"K11 = k, K12 = K21 = 0, K22 = 0\nG1 = 0, G2 = {H2}\n{FORCES}",
    "listed wholes": "M(q) q̈ + C(q, q̇) q̇ + D q̇ + G(q) = f\n"
    + SQUARE
    + "C11 = 0, C12 = -m l φ̇ sin phi, C21 = 0, C22 = 0\nD = diag(c, 0)\n"
    + f"G1 = k x\nG2 = {H2}\nf = (F, h tau)ᵀ",
    "table": f"{FORM}| entry | value |\n|---|---|\n| M₁₁ | {M11} |\n| M₁₂ = M₂₁ | {M12} |\n| M₂₂ | {M22} |\n"
    f"| h₁ | {H1} |\n| h₂ | {H2} |\n\n{FORCES}",
    "table without a title": f"{FORM}| M11 | {M11} |\n| M12 = M21 | {M12} |\n| M22 | {M22} |\n\n{COLUMN}{FORCES}",
    "rows": f"{FORM}Row 1 of M: [{M11}, {M12}]\nRow 2 of M: [{M12}, {M22}]\nh = [{H1}; {H2}]\nf = [F; h tau]",
    "counted rows": f"{FORM}1st row of M: [{M11}, {M12}]\n2nd row of M: [{M12}, {M22}]\n{COLUMN}f = [F; h tau]",
}
L11, L12, L22 = "M + m", r"m l \cos\varphi", "m l^2"
K1, K2 = r"k x + c\dot x - m l \dot\varphi^2\sin\varphi", r"m g l\sin\varphi"
IN_LINE = (
    rf"\[M_{{11}} = {L11},\quad M_{{12}} = M_{{21}} = {L12},\quad M_{{22}} = {L22}\]"
    + rf"\[h_1 = {K1},\quad h_2 = {K2},\quad f_1 = F,\quad f_2 = h\tau\]"
)
ALIGNED = (
    rf"\begin{{align}}M_{{11}} &= {L11}\\ M_{{12}} &= M_{{21}} = {L12}\\ M_{{22}} &= {L22}\\"
    rf" h_1 &= {K1}\\ h_2 &= {K2}\\"
    r" f_1 &= F\\ f_2 &= h\tau\end{align}"
)
WHOLE = (
    rf"\[\mathbf{{M}}(q) = \begin{{bmatrix}}{L11} & {L12}\\ {L12} & {L22}\end{{bmatrix}},\quad "
    rf"\mathbf{{h}} = \begin{{bmatrix}}{K1}\\ {K2}\end{{bmatrix}},\quad f = \begin{{bmatrix}}F\\ h\tau\end{{bmatrix}}\]"
)
LATEX = [
    r"\[M(q)\ddot{q} + h(q,\dot q) = f\]",
    r"\[\mathbf{M}(\mathbf{q})\ddot{\mathbf{q}} + \mathbf{h}(\mathbf{q},\dot{\mathbf{q}}) = \mathbf{f}\]",
    r"$\mathbf M \ddot{\mathbf q} + \mathbf h = \mathbf f$ with",
    r"\[M\left(q\right)\,\ddot q = f - h\left(q, \dot q\right)\]",
    r"\begin{equation} \boldsymbol{M} \ddot{\boldsymbol{q}} = \boldsymbol{f} - \boldsymbol{h} \end{equation} where",
    "$M(q) q'' + h(q, q') = f$ with",
]


def wrong(answer: str) -> list[str]:
    """The answer with one slip in a mass, in a spring or in the weight."""
    slips = (("m l^2", "m l"), ("k x", "2 k x"), ("= k,", "= 2 k,"), ("m g l", "m g"))
    return [answer.replace(*slip) for slip in slips if slip[0] in answer]


@pytest.mark.sampled(8)
@pytest.mark.parametrize("form", PLAIN)
def test_entries_rows_and_tables(form: str) -> None:
    assert driven().check(PLAIN[form]).right
    assert len(wrong(PLAIN[form])) >= 3 and not any(driven().check(x).right for x in wrong(PLAIN[form]))


def test_a_missing_entry_that_symmetry_gives_is_told() -> None:
    assert "M21 was read as M12: the matrix is symmetric." in map(str, driven().check(PLAIN["symmetric"]).notes)


@pytest.mark.sampled(12)
@pytest.mark.parametrize("given", [IN_LINE, ALIGNED, WHOLE])
@pytest.mark.parametrize("form", LATEX)
def test_the_form_in_latex(form: str, given: str) -> None:
    assert driven().check(f"{form}\n{given}").right
    assert not any(driven().check(f"{form}\n{x}").right for x in wrong(given))


def test_products_and_columns_in_latex() -> None:
    form = r"\[\mathbf M(q)\ddot q + \mathbf C(q,\dot q)\dot q + g(q) = \begin{bmatrix}F\\ h\tau\end{bmatrix}\]"
    more = r"\[C_{11} = c,\; C_{12} = -m l\dot\varphi\sin\varphi,\; C_{21} = 0,\; C_{22} = 0,\; g_1 = k x\]"
    answer = f"{form}\n{IN_LINE}{more}" + rf"\[g_2 = {K2}\]"
    assert driven().check(answer).right
    assert not driven().check(answer.replace("g_1 = k x", "g_1 = -k x")).right


@pytest.mark.parametrize("left_out", ["M22 = m l^2", f"h2 = {H2}\n", "M11 = M + m, "])
def test_a_form_without_all_its_entries_is_not_taken_for_right(left_out: str) -> None:
    with pytest.raises(ParseError):
        driven().check(PLAIN["entries"].replace(left_out, ""))


def test_an_entry_that_the_system_has_as_a_name_is_no_entry() -> None:
    """h1 is the damper there; with a value that moves it is the answer's own, as a note says."""
    verdict = driven("h1").check((FORM + SQUARE + COLUMN + FORCES).replace("c x'", "h1 x'"))
    assert not verdict.right or any("h1" in str(x) for x in verdict.notes)


HOSTILE = [
    "M(" * 5000 + "q''",
    "M(a a a a a a a a " * 3000 + "q''",
    "M q'' + h" + " + h" * 8000 + " = 0",
    r"\[M\ddot q" + "+h(q" * 9000 + r"\]",
    r"\mathbf{" * 6000 + r"\ddot q",
    "M" + " " * 30_000 + "q''",
    "M q'' =" + " " * 30_000 + "x",
    "M11 = " * 8000 + " q''",
    "| M11 | " * 6000 + "\n q''",
    "|" + " " * 30_000 + "| q''",
    r"M \, " * 8000 + r"\ddot q",
    r"\begin{bmatrix} a" * 3000 + r"\ddot q",
    "[a, " * 10_000 + "q''",
    "Row 1 of M: [a, b]" + " " * 30_000 + "x q''",
]


@pytest.mark.parametrize("latex", [False, True])
def test_hostile_texts_stay_about_as_long_as_they_are(latex: bool) -> None:
    for text in HOSTILE:
        found = with_general_form(TracedText(text), ["x", "y"], lambda _: False, {}, latex=latex)
        assert len(found.text) <= len(text) + 1_000


LONGER = {
    "a column": "Mass matrix form:  Mq * [x''; phi''] + h = f\n",
    "transposed": "Mq [x'' phi'']^T + h = f\n",
    "a tuple": "Mq * (x'', phi'')^T + h = f\n",
    "with arguments": "Mq(q) * [x''; phi''] + h(q, q') = f(q)\n",
    "on the right": "Mq [x''; phi''] = f - h\n",
    "a letter": "Mq q'' + h = f\n",
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["Mq", "M_q", "Mm", "A"])
@pytest.mark.parametrize("form", LONGER)
def test_the_matrix_of_entries_may_have_a_longer_name(form: str, name: str) -> None:
    answer = (LONGER[form].replace("Mq", name) + SQUARE.replace("M1", f"{name}1").replace("M2", f"{name}2")) + "\n"
    answer += COLUMN + "f1 = F\nf2 = h tau"
    assert accepted(answer)
    assert not accepted(answer.replace("= m l cos phi", "= -m l cos phi"))
    assert not accepted(answer.replace("[x''", "[phi''").replace("; phi''", "; x''").replace("h2 = ", "h2 = -"))


DRAWN = """M_ q'' + B q' + K q + n = f  with q = [x; phi]

       [ M + m        m l cos phi ]
M_  =  [ m l cos phi  m l^2       ]

       [ c   0 ]
B   =  [ 0   0 ]

K   =  [ k   0 ]
       [ 0   0 ]
n   =  [ -m l phi'^2 sin phi ; m g l sin phi ]
f   =  [ F ; h tau ]
"""


def test_a_drawn_matrix_may_have_its_name_beside_any_row() -> None:
    assert accepted(DRAWN)
    assert accepted(DRAWN.replace("M_", "A "))
    assert not accepted(DRAWN.replace("[ c   0 ]", "[ -c   0 ]"))
    assert not accepted(DRAWN.replace("K   =  [ k   0 ]\n       [ 0   0 ]", "       [ 0   0 ]\nK   =  [ 0   k ]"))


def accepted(answer: str) -> bool:
    """Whether an answer is read and right."""
    try:
        return driven().check(answer, hint=0).right
    except ParseError:
        return False
