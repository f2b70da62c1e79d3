"""Equations of matrices with columns that have names, in which a letter is that of a matrix and of a constant.

Oracle: by hand, two rollers with a belt that stretches by δ = r β + 2 l sin θ, on a lever with a uniform rod,

    M q̈ + w (k δ + c wᵀ q̇) − (0, (m + M/2) g l cos θ)ᵀ = (τ, 0)ᵀ,   w = (r, 2 l cos θ)ᵀ,   q = (β, θ)ᵀ

with the matrix M = diag(J, (m + M/3) l²) and the rod's mass M.
"""

import re
from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from lagrangian.check.reading.drawn.matrices import without_drawings
from lagrangian.check.reading.traced_text import TracedText
from lagrangian.check.verdict import Status

LATEX = r"""Let $w(\theta) = (r,\; 2 l\cos\theta)^T$ be the gradient of $\delta = r\beta + 2 l\sin\theta$,
$q = (\beta, \theta)^T$.

$$ M\ddot q + w\,(k\delta + c\, w^T\dot q) + \begin{pmatrix}0\\ -(m+\tfrac M2) g l\cos\theta\end{pmatrix} =
\begin{pmatrix}\tau\\ 0\end{pmatrix} $$

with $M = \mathrm{diag}\left(J,\; (m+\tfrac M3) l^2\right)$."""
PLAIN = """w(theta) = [r, 2 l cos(theta)]^T, delta = r beta + 2 l sin(theta), q = [beta, theta]^T
M q'' + w (k delta + c w^T q') - [0; (m + M/2) g l cos(theta)] = [tau; 0]
with M = diag(J, (m + M/3) l^2)"""
SCALAR = r"w\,(k\delta + c\, w^T\dot q)"
COLUMN = r" + \begin{pmatrix}0\\ -(m+\tfrac M2) g l\cos\theta\end{pmatrix}"
RIGHT = {
    "as it is": LATEX,
    "in plain text": PLAIN,
    "the scalar in front": LATEX.replace(SCALAR, r"(k\delta + c\, w^T\dot q)\, w"),
    "multiplied out": LATEX.replace(SCALAR, r"k\delta w + c\, w w^T\dot q"),
    "called": LATEX.replace(SCALAR, r"w(\theta)\,(k\delta + c\, w(\theta)^T\dot q)"),
    "by the rate": LATEX.replace(SCALAR, r"w\,(k\delta + c\dot\delta)"),
    "bold where it is used": LATEX.replace(r"w\,(", r"\mathbf w\,(").replace(r"\, w^T\dot q", r"\,\mathbf w^T\dot q"),
    "an operator": LATEX.replace(r"\mathrm{diag}\left(", r"\operatorname{diag}(").replace(r"\right)", ")"),
    "a sum outside an entry": LATEX.replace(COLUMN, r" - (m+\tfrac M2) g l\cos\theta\, e_2").replace(
        "with $M", "with $e_2 = (0, 1)^T$ and $M"
    ),
}
WRONG = {
    "the column": (r"(r,\;", r"(-r,\;"),
    "its factor": (r"c\, w^T", r"2 c\, w^T"),
    "an entry": (r"\tfrac M2", "M"),
    "the diagonal": (r"\tfrac M3", r"\tfrac M{12}"),
}


@cache
def belt() -> lg.Derivation:
    """A roller that a belt joins with a lever."""
    s = lg.System("roller and lever")
    beta, theta = s.coordinates("beta theta")
    J, m, M, l, r, k, c, g = s.parameters("J m M l r k c g")
    s.kinetic(J * beta.diff() ** 2 / 2, name="roller")
    s.particle(m, at=s.point("D", (l * sp.cos(theta), -l * sp.sin(theta))), name="end")
    middle = s.point("G", (l / 2 * sp.cos(theta), -l / 2 * sp.sin(theta)))
    s.rigid_body(mass=M, inertia=M * l**2 / 12, at=middle, frame=s.frame(-theta, name="rod"), name="rod")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=r * beta + 2 * l * sp.sin(theta), name="belt")
    s.damper(c, deflection=r * beta + 2 * l * sp.sin(theta), name="friction")
    s.torque(s.input("tau"), on=beta)
    return s.derive()


@pytest.mark.sampled(4)
@pytest.mark.parametrize("form", RIGHT)
def test_the_mass_and_the_matrix_are_told_apart(form: str) -> None:
    verdict = belt().check(RIGHT[form])
    assert verdict.right
    equations = [f for f in verdict.findings if f.line.kind == "equation"]
    assert len(equations) == 2


@pytest.mark.sampled(6)
@pytest.mark.parametrize("what", WRONG)
def test_a_wrong_one_is_told(what: str) -> None:
    written, put = WRONG[what]
    for form in ("as it is", "multiplied out", "bold where it is used"):
        if written not in RIGHT[form]:
            continue
        assert belt().check(RIGHT[form].replace(written, put)).status is Status.WRONG
    plain = {"(r,": "[r,", "(-r,": "[-r,", r"\tfrac M2": "M/2", r"\tfrac M3": "M/3", r"\tfrac M{12}": "M/12"}
    for latex, text in (*plain.items(), (r"\;", ""), (r"\, ", " ")):
        written, put = written.replace(latex, text), put.replace(latex, text)
    assert written in PLAIN
    assert belt().check(PLAIN.replace(written, put)).status is Status.WRONG


def test_an_equation_with_a_column_that_is_not_given_is_told() -> None:
    """Nothing of it is judged: what else is right makes no right answer."""
    said = LATEX.replace(r"w\,(", r"\mathbf h\,(").replace(r"\, w^T\dot q", r"\dot\delta")
    verdict = belt().check(r"$\dot\delta = r\dot\beta + 2 l\cos\theta\,\dot\theta$." + "\n\n" + said)
    assert verdict.status is Status.INCOMPLETE
    assert any("nothing says what h is" in str(x) for x in verdict.notes)


def test_rows_of_matrices_still_must_fit() -> None:
    with pytest.raises(lg.ParseError):
        belt().check(PLAIN.replace("[tau; 0]", "[tau; 0; 0]"))


ENTRIES = r"""\[ (M + m)\ddot x + m l\ddot\theta\cos\theta - m l\dot\theta^2\sin\theta + b\dot x = F \]
\[ m l\ddot x\cos\theta + (J + m l^2)\ddot\theta - m g l\sin\theta = 0 \]
\[ \mathbf M\ddot{\mathbf q} + \mathbf C\dot{\mathbf q} + \mathbf G = \boldsymbol\Xi \]
\[ \mathbf q = \begin{bmatrix} x \\ \theta \end{bmatrix}, \quad
\mathbf C = \begin{bmatrix} 0 & -m l\dot\theta\sin\theta \\ 0 & 0 \end{bmatrix} \]
\[ \begin{aligned} \mathbf M_{11} &= M + m \\ \mathbf M_{12} &= \mathbf M_{21} = m l\cos\theta \\
\mathbf M_{22} &= J + m l^2 \end{aligned} \]
\[ \mathbf G = \begin{bmatrix} 0 \\ -m g l\sin\theta \end{bmatrix}, \quad
\boldsymbol\Xi = \begin{bmatrix} F - b\dot x \\ 0 \end{bmatrix} \]"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("bold", [r"\mathbf ", r"\boldsymbol ", r"\bm "])
@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("", ""),
        ("(M + m)", "(M - m)"),
        (r"\boldsymbol\Xi =", r"\boldsymbol\Xi = -"),
        (r"\cos\theta + (J", r"\cos\theta - (J"),
    ],
)
def test_a_bold_letter_with_entries_is_no_mass(bold: str, old: str, new: str) -> None:
    written = ENTRIES.replace(old, new)
    assert (written == ENTRIES) is (not old)
    verdict = derivation("cart-pole").check(written.replace(r"\mathbf ", bold))
    assert verdict.right is (not old), verdict.to_text()


SPARSE = """M q'' + C q' + G = Q
M11 = M + m
M12 = M21 = m l cos(theta)
M22 = J + m l^2
C11 = b
C12 = -m l theta' sin(theta)
all other entries are 0
G = [0; -m g l sin(theta)]
Q = [F; 0]"""
SPARSE_IN_LATEX = r"""\[ \mathbf M\ddot{\mathbf q} + \mathbf C\dot{\mathbf q} + \mathbf G = \mathbf Q \]
\begin{align} \mathbf M_{11} &= M + m \\ \mathbf M_{12} &= \mathbf M_{21} = m l\cos\theta \\
\mathbf M_{22} &= J + m l^2 \\ \mathbf C_{11} &= b \\ \mathbf C_{12} &= -m l\dot\theta\sin\theta \\
& \text{all other entries are 0} \end{align}
\[ \mathbf G = \begin{bmatrix} 0 \\ -m g l\sin\theta \end{bmatrix}, \quad
\mathbf Q = \begin{bmatrix} F \\ 0 \end{bmatrix} \]"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("written", [SPARSE, SPARSE_IN_LATEX])
@pytest.mark.parametrize("said", ["all other entries are 0", "The remaining elements are zero", "other entries vanish"])
@pytest.mark.parametrize(("old", "new"), [("", ""), ("= -m l", "= m l"), ("= M +", "= M -"), ("= b", "= -b")])
def test_entries_that_are_said_to_be_zero(written: str, said: str, old: str, new: str) -> None:
    answer = written.replace("all other entries are 0", said).replace(old, new)
    verdict = derivation("cart-pole").check(answer)
    assert verdict.right is (not old), verdict.to_text()


@pytest.mark.parametrize("last", ["⎣ sym.              c ⎦", "⎣            sym.   c ⎦"])
def test_a_drawn_symmetric_matrix_may_begin_its_rows_at_the_diagonal(last: str) -> None:
    drawn = f"    ⎡ a   m l cos θ   0 ⎤\nM = ⎢        b        d ⎥\n    {last}\n"
    made = without_drawings(TracedText(drawn)).text
    assert re.sub(r"\s+", " ", made).strip() == "M = [a, m l cos θ, 0; m l cos θ, b, d; 0, d, c]"
    assert without_drawings(TracedText(drawn.replace("sym.", ""))).text == drawn.replace("sym.", "")


LISTED = """M(q) q'' + n = Q with q = [x; theta]
M11 = M + m
M12 = m l cos(theta)
M21 = m l cos(theta)
M22 = J + m l^2
n1 = -m l sin(theta) theta'^2 + b x'
n2 = -m g l sin(theta)
Q1 = F
Q2 = 0"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("line", "right", "wrong"),
    [
        (4, "M21 = m l cos", "M21 = -m l cos"),
        (4, "M21 = m l cos", "M21 = m l sin"),
        (3, "M12 = m l cos", "M12 = m cos"),
        (3, "m l cos", "2 m l cos"),
    ],
)
def test_an_entry_beside_the_diagonal_is_told_where_it_is_stated(line: int, right: str, wrong: str) -> None:
    cart = derivation("cart-pole")
    assert cart.check(LISTED).right
    verdict = cart.check(LISTED.replace(right, wrong))
    first = verdict.first_wrong
    assert first is not None and first.line.number == line
    assert str(verdict.mistakes[0].what).startswith(f"Line {line} is not right: the factor of ")
