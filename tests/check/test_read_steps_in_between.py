"""What stands between the first line and the equations: derivatives with an index, words in brackets behind letters,
marks in symmetric matrices, names behind formulas, letters in front of steps, tables for each coordinate, amounts.

Oracle: by hand, a puck on a spring along a rod that a motor turns:

    m r'' − m r φ'² + k (r − a) = 0,    (J + m r²) φ'' + 2 m r r' φ' = M

and, for the numbers, a rack on a spring that a motor moves by a pinion: (m + J/R²) x'' + k (x − d) = M/R.
"""

from __future__ import annotations

import pytest
from small_systems import rack, rod

ALONG = "m r'' - m r phi'^2 + k (r - a) = 0"
ROUND = "(J + m r^2) phi'' + 2 m r r' phi' = M"
ROWS = f"{ALONG}\n{ROUND}"


def accepted(text: str) -> bool:
    """Whether an answer to the rod is right."""
    return rod().check(text, hint=0).right


def judged(text: str) -> list[str]:
    """The kinds of the lines of a right answer to the rod."""
    verdict = rod().check(text)
    assert verdict.right, verdict.to_text()
    return [f.line.kind for f in verdict.findings]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("dot", ["ṙ φ̇", "r' phi'", "rd phid", "rdot phidot"])
def test_energies_with_what_they_are_differentiated_by_as_an_index(dot: str) -> None:
    r, phi = dot.split()
    steps = f"""L = 1/2 m (r'^2 + r^2 phi'^2) + 1/2 J phi'^2 - 1/2 k (r - a)^2
L_{r} = m {r}
L_r = m r {phi}^2 - k (r - a)
L_{phi} = (J + m r^2) {phi}
d/dt L_{r} - L_r = 0:
{ROWS}"""
    assert "p" in judged(steps)
    assert not accepted(steps.replace(f"L_{r} = m {r}", f"L_{r} = 2 m {r}"))
    assert not accepted(steps.replace(f"L_r = m r {phi}^2 -", f"L_r = m r {phi}^2 +"))


def test_energies_with_an_index_in_latex() -> None:
    steps = r"""$T_{\dot r} = m \dot r$, $T_r = m r \dot\varphi^2$, $V_r = k (r - a)$, $V_\varphi = 0$

$m \ddot r - m r \dot\varphi^2 + k (r - a) = 0$

$(J + m r^2) \ddot\varphi + 2 m r \dot r \dot\varphi = M$"""
    assert len(judged(steps)) > 4
    assert not accepted(steps.replace("V_r = k", "V_r = 2 k"))


def test_angular_momenta_and_parts_of_energies_have_an_index_too() -> None:
    assert accepted(f"L_phi = (J + m r^2) phi'\nL_phi' = M\n{ROWS}")
    parts = f"T = T_r + T_phi\nT_r = 1/2 m r'^2\nT_phi = 1/2 (J + m r^2) phi'^2\nT_r' = m r' r''\n{ROWS}"
    assert accepted(parts)
    assert not accepted(parts.replace("T_r = 1/2 m", "T_r = m"))


FORCES = (
    "F(spring) = -k (r - a)\nF(motor) = M\nm r'' - m r phi'^2 = F(spring)\n(J + m r^2) phi'' + 2 m r r' phi' = F(motor)"
)


@pytest.mark.parametrize(
    "text",
    [
        FORCES,
        FORCES.replace("(spring)", "[spring]").replace("(motor)", "[motor]"),
        FORCES.replace("(motor)", "(motor of the rod)"),
        FORCES.replace("F(spring)", "Q(r)").replace("F(motor)", "Q(phi)"),
        f"P(motor) = M phi'\nP(spring) = -k (r - a) r'\n{ROWS}\nd(T)/dt = P(motor) + P(spring)",
    ],
)
def test_words_in_brackets_tell_quantities_of_one_letter_apart(text: str) -> None:
    assert accepted(text)
    assert not accepted(text.replace("k (r - a)", "2 k (r - a)"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "matrix",
    [
        "[m, 0; *, J + m r^2]",
        "[m, *; 0, J + m r^2]",
        "[m, 0; sym., J + m r^2]",
        r"\begin{pmatrix} m & 0 \\ \ast & J + m r^2 \end{pmatrix}",
        r"\begin{bmatrix} m & 0 \\ \text{sym.} & J + m r^2 \end{bmatrix}",
    ],
)
def test_marks_in_symmetric_matrices(matrix: str) -> None:
    latex = matrix.startswith("\\")
    r, phi = (r"\ddot r", r"\ddot\varphi") if latex else ("r''", "phi''")
    rates = (r"m r \dot\varphi^2 - k (r - a)", r"M - 2 m r \dot r \dot\varphi")
    sides = rates if latex else ("m r phi'^2 - k (r - a)", "M - 2 m r r' phi'")
    made = (rf"\begin{{pmatrix}} {a} \\ {b} \end{{pmatrix}}" if latex else f"[{a}; {b}]" for a, b in ((r, phi), sides))
    text = f"{matrix} {' = '.join(made)}"
    text = f"$$ {text} $$" if latex else text
    assert accepted(text)
    assert not accepted(text.replace("J + m r^2", "J - m r^2"))
    assert not accepted(text.replace("0", "m"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "d/dt((J + m r^2) phi') = (J + m r^2) phi'' + 2 m r r' phi', which I call Z",
        "d/dt((J + m r^2) phi') = (J + m r^2) phi'' + 2 m r r' phi' (call it Z)",
        "The derivative of the momentum is (J + m r^2) phi'' + 2 m r r' phi', which we call Z.",
        "This gives (J + m r^2) phi'' + 2 m r r' phi' (in short Z).",
        r"$$\frac{d}{dt} (B \dot\varphi) = B \ddot\varphi + 2 m r \dot r \dot\varphi$$, which I denote by $Z$.",
    ],
)
def test_a_name_behind_its_formula_in_words(said: str) -> None:
    latex = "$" in said
    said = said.replace("B", "(J + m r^2)")
    rows = "$$m \\ddot r - m r \\dot\\varphi^2 + k (r - a) = 0$$\n\n$$Z - M = 0$$" if latex else f"{ALONG}\nZ - M = 0"
    assert accepted(f"{said}\n{rows}")
    assert not accepted(f"{said.replace('2 m', '3 m')}\n{rows}")


@pytest.mark.parametrize("marks", ["(a) (k) (m)", "(a) (b) (c)", "a) b) c)", "(i) (ii) (iii)"])
def test_letters_in_order_in_front_of_steps_are_no_factors(marks: str) -> None:
    first, second, third = marks.split()
    text = f"{first} kinematics: v = r phi'\n{second} V = 1/2 k (r - a)^2\n{third} equations\n{ROWS}"
    in_order = "k" not in marks
    assert ("V" in judged(text)) is in_order
    assert accepted(text.replace("V = 1/2", "V = ")) is not in_order


TABLE = """| | {0} | {1} |
|---|---|---|
| ∂T/∂q̇ | m r' | (J + m r²) phi' |
| ∂T/∂q | m r phi'² | 0 |
| ∂V/∂q | k (r - a) | 0 |
| Q | 0 | M |
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("head", ["q = r|q = phi", "q_k = r|q_k = phi", "for r|for phi", "r|phi"])
def test_the_head_of_a_table_says_of_which_coordinate_its_columns_are(head: str) -> None:
    table = TABLE.format(*head.split("|"))
    assert len(judged(f"{table}\n{ROWS}")) > 7
    assert not accepted(f"{table.replace('k (r - a)', 'k (r + a)')}\n{ROWS}")


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "list_of", ["m + J/R² = 13.2, J/R² = 0.3/0.25 (in kg)", "J/R² = 1.2\n250 R = 125", "k d = 60, 250 R = 125"]
)
def test_amounts_in_front_of_equations_in_numbers(list_of: str) -> None:
    row = "13.2 x'' + 300 x - 60 = M/0.5"
    rack_of = rack(m=12, J=0.3, R=0.5, k=300, d=0.2)
    verdict = rack_of.check(f"{list_of}\n{row}")
    assert verdict.right, verdict.to_text()
    assert not rack_of.check(f"{list_of}\n{row.replace('13.2', '12.2')}").right
    for number in ("= 0.3/0.25", "= 1.2", "= 60", "= 125"):
        assert number not in list_of or not rack_of.check(f"{list_of.replace(number, '= 3.4')}\n{row}").right


CART = """M = [ m   0 ]
    [ 0   J + m r² ]
det M = m (J + m r²)
M⁻¹ = 1/(m (J + m r²)) · [ J + m r²   0 ]
                         [ 0          m ]
h = [ m r φ'² - k (r - a) ; M_0 - 2 m r r' φ' ] =: [ h1 ; h2 ]
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "rows", ["[ r'' ; φ'' ] = M⁻¹ h", "[ r'' ; φ'' ] = M⁻¹ [ h1 ; h2 ]", "r'' = h1/m\nφ'' = h2/(J + m r²)"]
)
def test_determinants_and_inverses_of_matrices(rows: str) -> None:
    text = f"{CART}{rows}".replace("M_0", "M").replace("M =", "A =").replace("det M", "det A").replace("M⁻¹", "A⁻¹")
    assert accepted(text)
    assert not accepted(text.replace("det A = m (J +", "det A = m (J -"))
    assert not accepted(text.replace("[ 0          m ]", "[ 0        2 m ]"))
    assert not accepted(text.replace("- 2 m r r'", "+ 2 m r r'"))
    assert accepted(text.replace("det A", "|A|"))


def test_the_inverse_of_a_matrix_in_latex() -> None:
    text = r"""$$A = \begin{pmatrix} m & 0 \\ 0 & J + m r^2 \end{pmatrix}, \quad \det A = m (J + m r^2)$$

$$\begin{pmatrix} \ddot r \\ \ddot\varphi \end{pmatrix}
= A^{-1} \begin{pmatrix} m r \dot\varphi^2 - k (r - a) \\ M - 2 m r \dot r \dot\varphi \end{pmatrix}$$"""
    assert accepted(text)
    assert not accepted(text.replace("= m (J", "= m (2 J"))
    assert not accepted(text.replace("M - 2 m", "M + 2 m"))


ROUTH = """φ is cyclic, I use Routh.
p = (J + m r²) φ'
R = 1/2 m r'² - 1/2 k (r - a)² - p²/(2 (J + m r²))
∂R/∂r' = m r'
∂R/∂r = m r φ'² - k (r - a)
d/dt(∂R/∂r') - ∂R/∂r = 0
p' = M
"""


@pytest.mark.slow
@pytest.mark.parametrize("form", ["{}", "{}\nm r'' - m r φ'² + k (r - a) = 0\n(J + m r²) φ'' + 2 m r r' φ' = M"])
def test_a_routhian_holds_the_momentum(form: str) -> None:
    text = form.format(ROUTH)
    assert accepted(text)
    assert accepted(text.replace("p", "p_φ").replace("R =", "R(r, r', p_φ) ="))
    assert accepted(text.replace("R = 1/2 m r'²", "R = L - p φ' = 1/2 m r'²").replace("I use Routh", "so"))
    assert not accepted(text.replace("∂R/∂r = m r φ'² -", "∂R/∂r = -m r φ'² -"))
    assert not accepted(text.replace("- p²/(2", "+ p²/(2"))


def test_a_routhian_without_a_momentum_is_not_judged() -> None:
    text = "I use Routh's function R = 1/2 m r'² - 1/2 k (r - a)² - 1/2 (J + m r²) φ'²\n∂R/∂r = m r φ'² - k (r - a)\n"
    verdict = rod().check(f"{text}{ROWS}")
    assert verdict.right, verdict.to_text()
    assert not any(f.line.number == 2 for f in verdict.findings)


def test_letters_of_bodies_below_their_headings() -> None:
    text = f"Rod\n  w = phi', v = 0\nPuck\n  w = 0, v² = r'² + r² phi'²\nEquations\n{ROWS}"
    assert accepted(text)
    assert not accepted(text.replace("v² = r'²", "v² = 2 r'²").replace("Equations", "Equations with T = 1/2 m v²"))
    place = f"Rod:\ny = 0\nPuck:\ny = r sin phi, y' = r' sin phi + r phi' cos phi\nSum:\n{ROWS}"
    assert accepted(place)
    assert not accepted(place.replace("+ r phi' cos", "- r phi' cos"))
