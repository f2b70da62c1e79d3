"""LaTeX as people typeset it, matrices by name, and prose around statements: read, and right.

Oracle: the equations of the built-in examples, written by hand.
"""

import pytest
from small_systems import pendulum, rod

import lagrangian as lg
from built_in import derivation

ONE = r"mL^2\ddot\theta + b\dot\theta + mgL\sin\theta = 0"
MATRICES = r"M = \begin{bmatrix} m_1 & 0\\0&m_2\end{bmatrix}, \quad K = \begin{bmatrix} k & -k\\-k&k\end{bmatrix}"


@pytest.mark.parametrize(
    "written",
    [
        r"T = \frac12 mL^2\dot\theta^2,\; V = -mgL\cos\theta,\; " + ONE,
        r"T = \frac12 mL^2\dot\theta^2 \Rightarrow " + ONE,
        r"V=-mgL\cos\theta \quad\Leftrightarrow\quad " + ONE,
        r"\underbrace{mL^2\ddot\theta}_{\text{inertia}} + \underbrace{b\dot\theta}_{damping} + mgL\sin\theta = 0",
        r"mL^2\ddot\theta + b\dot\theta = -mgL/\csc\theta",
        r"L^{2} m \frac{d^{2}}{d t^{2}} \theta{\left(t \right)} + L g m \sin{\left(\theta{\left(t \right)} \right)}"
        r" + b \frac{d}{d t} \theta{\left(t \right)} = 0",
        r"0{,}25\ddot\theta + 0,02\dot\theta + 4.905\sin\theta = 0",
        r"0.25\,\mathrm{kg\,m^2}\,\ddot\theta + 0.02\dot\theta+4.905\sin\theta \overset{!}{=} 0",
        "Step 2 - the kinetic co-energy:\n" + r"\textbf{so}:" + "\n" + ONE,
    ],
)
def test_the_pendulum_in_latex(written: str) -> None:
    verdict = derivation("pendulum").check(written)
    assert verdict.right, verdict.to_text()


@pytest.mark.parametrize(
    "written",
    [
        "M = [m1, 0; 0, m2]\nK = [k, -k; -k, k]\nM q'' + K q = f\nf = [-F; F]",
        "M = [[m1, 0], [0, m2]], K = [[k, -k], [-k, k]]\nM*[x1''; x2''] + K*[x1; x2] = [-F; F]",
        MATRICES
        + r"\\ M\ddot q + K q = \begin{bmatrix}-F\\F\end{bmatrix}, \; q = \begin{bmatrix}x_1\\x_2\end{bmatrix}",
    ],
)
def test_a_letter_that_is_given_a_matrix_is_that_matrix(written: str) -> None:
    assert derivation("lecture-3a").check(written, hint=0).right


COLUMNS = [
    "M = [ m1  0\n      0   m2 ]\nK = [ k -k\n     -k  k ]\nf = [{F1}  F]'\nM*q'' + K*q = f,   q = [x1 x2]'",
    "M(q) q'' + K q = f\nq = [x1; x2]\nM = [ m1,  0 ]\n    [  0, m2 ]\nK = [k, -k]\n    [-k, k]\nf = [{F1} ; F]",
    "M q'' + K q = Q, q = (x1, x2)\nM = ((m1, 0), (0, m2)), K = ((k, -k), (-k, k)), Q = ({F1}, F)",
    "M q'' + K q = Q, q = (x1 x2)^T\nM = [m1 0; 0 m2], K = [k -k; -k k], Q = ({F1} F)^T",
    r"$\mathbf{M}\ddot{\mathbf{x}} + \mathbf{K}\mathbf{x} = \mathbf{f}$, with $\mathbf{x} = [x_1\ x_2]^T$, "
    r"$\mathbf{M} = \mathrm{diag}(m_1, m_2)$, $\mathbf{K} = \begin{bmatrix}k&-k\\-k&k\end{bmatrix}$, "
    r"$\mathbf{f} = [\,{F1} \;\; F\,]^{\mathrm T}$",
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("written", COLUMNS)
def test_rows_and_columns_are_lists(written: str) -> None:
    assert derivation("lecture-3a").check(written.replace("{F1}", "-F"), hint=0).right
    assert not derivation("lecture-3a").check(written.replace("{F1}", "F"), hint=0).right


def test_brackets_around_factors_are_no_list() -> None:
    written = "m1 x1'' = (-(F) - (k (x1 - x2)))\nm2 x2'' + ((x2 - x1) k) = (F)"
    assert derivation("lecture-3a").check(written, hint=0).right


def test_a_matrix_may_have_the_letter_of_a_mass_in_it() -> None:
    written = (
        "M = [M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2]\nq = [x; theta]\n"
        "h = [b*x' - m*l*sin(theta)*theta'^2; -m*g*l*sin(theta)]\nM*q'' + h = [F; 0]"
    )
    assert derivation("cart-pole").check(written, hint=0).right


def test_a_column_of_forces_that_holds_weights_is_the_answers_own() -> None:
    written = (
        "M q'' + h = Q, q = (x, theta)\nM = [M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2]\n"
        "h = [-m*l*sin(theta)*theta'^2; 0]\nQ = [F - b*x'; m*g*l*sin(theta)]"
    )
    assert derivation("cart-pole").check(written, hint=0).right
    verdict = derivation("cart-pole").check(written.replace("J + m*l^2", "J + m*l"))
    assert [f.line.kind for f in verdict.findings if not f.status.right] == ["equation", "definition"]
    assert "l is not squared" in verdict.to_text() or "m l²" in verdict.to_text()


@pytest.mark.parametrize(
    "written",
    [
        "Solution\n--------\nLagrangian\nEq. 1: m*L^2*theta'' + b*theta' + m*g*L*sin(theta) = 0,   (1)",
        "syms theta(t) m L b g\neqn1 = m*L^2*diff(theta(t), t, 2) + b*diff(theta(t), t) == -m*g*L*sin(theta(t));",
        "s = L*theta (arc length)\n=>\nm*L*s'' + b*theta' + m*g*L*sin(theta) = 0. (1)",
        "with the arc length s := L*theta we get\n=> m*L*s'' + b*theta' + m*g*L*sin(theta) = 0",
        "m = 1 kg; L = 0,5 m; b = 0.02 N*m*s\n0.25 θ'' + 0.02 θ' + 0.5 g sin θ = 0",
    ],
)
def test_words_and_values_around_the_pendulum(written: str) -> None:
    verdict = derivation("pendulum").check(written)
    assert verdict.right, verdict.to_text()


ENTRIES = "M11 = M + m\nM12 = M21 = m l cos(theta)\nM22 = J + m l^2\n"
MATRIX = "M = [M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2]\n"
FORCES = "f = [F - b*x' + m*l*theta'^2*sin(theta); m*g*l*sin(theta)]\n"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "written",
    [
        f"{ENTRIES}C_1 = b x' - m l theta'^2 sin(theta)\nG_2 = -m g l sin(theta)\n"
        "M*[x''; theta''] + [C_1; G_2] = [F; 0]",
        f"{ENTRIES}h1 = b x' - m l theta'^2 sin(theta) - F\nh2 = -m g l sin(theta)\nM q'' + h = 0",
        f"{MATRIX}{FORCES}qdd = M\\f",
        f"{MATRIX}{FORCES}[x''; theta''] = inv(M)*f",
        f"{MATRIX}{FORCES}q'' = M^-1 f",
        MATRIX.replace("M =", "M(q) =")
        + "C(q,qdot) = [b, -m*l*sin(theta)*thetadot; 0, 0]\nG(q) = [0; -m*g*l*sin(theta)]\n"
        + "M(q) qddot + C(q,qdot) qdot + G(q) = [F; 0]",
    ],
)
def test_matrices_entry_by_entry_inverted_and_with_what_they_depend_on(written: str) -> None:
    assert derivation("cart-pole").check(written, hint=0).right
    for old, new in (("l*cos(theta)", "l*sin(theta)"), ("l cos(theta)", "l sin(theta)"), ("J +", "J -")):
        assert old not in written or not derivation("cart-pole").check(written.replace(old, new), hint=0).right


@pytest.mark.parametrize(("stiffness", "right"), [("-k/J2", True), ("k/J2", False)])
def test_rows_of_a_stacked_state_are_equations(stiffness: str, right: bool) -> None:
    """x' = A x + B u, where x is a name of the answer's own for the column of coordinates and rates."""
    rows = f"0 0 1 0; 0 0 0 1; -k/J1 k/J1 -b/J1 b/J1; k/J2 {stiffness} b/J2 -(b+b_load)/J2"
    answer = f"z = [phi1; phi2; phi1'; phi2']\nz' = [{rows}]*z + [0; 0; 1/J1; 0]*tau"
    verdict = derivation("two-disk-shaft").check(answer)
    assert verdict.right == right
    assert right or [m.element for m in verdict.mistakes] == ["spring 'shaft'"]


SAID = [
    "Lagrange's second kind gives this.\n",
    "The steps were T and V. ",
    "Here it is - hope it's right!\n",
    "Exercise 3b)\n",
]


@pytest.mark.parametrize("said", SAID)
def test_words_around_latex_without_delimiters_are_no_part_of_it(said: str) -> None:
    """Also before a line that begins with a minus, which goes on with a formula above it, never with a sentence."""
    row = r"-mgL\sin\theta = mL^2\ddot\theta + b\dot\theta"
    found = derivation("pendulum").check(f"{said}{row}\nThat's it :)")
    assert found.right and not found.notes
    assert not derivation("pendulum").check(f"{said}{row.replace('+ b', '- b')}\nDone.", hint=0).right
    assert (
        derivation("pendulum")
        .check(f"mL^2\\ddot\\theta + b\\dot\\theta\n{row.partition('=')[0]} = -2mgL \\sin\\theta", hint=0)
        .right
    )


@pytest.mark.parametrize(("half", "is_right"), [(r"\frac m2", True), (r"\frac{m}{2}", True), (r"\frac m3", False)])
def test_the_argument_of_a_fraction_is_one_letter_even_if_that_and_a_number_are_a_name(
    half: str, is_right: bool
) -> None:
    s = lg.System("two masses")
    x = s.coordinate("x")
    m, m2, k = s.parameters("m m2 k")
    s.particle(m / 2 + m2, at=s.point("P", (x, 0)))
    s.spring(k, deflection=x)
    assert s.derive().check(rf"\left(m_2 + {half}\right)\ddot x + k x = 0", hint=0).right == is_right


def test_a_bold_letter_with_its_arguments_is_not_the_letter_of_the_system() -> None:
    """g(q) as a column beside the g of gravity."""
    answer = r"""$q=[x,\;\theta]^{\mathsf T}$, $\mathbf M(q)\ddot q+\mathbf g(q)=\mathbf f$ with
\[ \mathbf M=\begin{bmatrix}M+m&ml\cos\theta\\ml\cos\theta&J+ml^2\end{bmatrix},\quad
\mathbf g=\begin{bmatrix}0\\-mgl\sin\theta\end{bmatrix},\quad
\mathbf f=\begin{bmatrix}F-b\dot x+ml\dot\theta^2\sin\theta\\0\end{bmatrix}. \]"""
    assert derivation("cart-pole").check(answer, hint=0).right
    assert derivation("cart-pole").check(answer.replace("-mgl", "mgl"), hint=0).status == "wrong"


def test_matrices_of_the_column_of_coordinates() -> None:
    answer = (
        r"With $q=(x,\theta)^T$ we get $A(q)\ddot q+C(q,\dot q)\dot q+K(q)=Q$ where "
        r"\[A=\begin{pmatrix}M+m&ml\cos\theta\\ml\cos\theta&J+ml^2\end{pmatrix},\quad "
        r"C=\begin{pmatrix}b&-ml\sin\theta\dot\theta\\0&0\end{pmatrix},\quad "
        r"K=\begin{pmatrix}0\\-mgl\sin\theta\end{pmatrix},\quad "
        r"Q=\begin{pmatrix}F\\0\end{pmatrix}.\]"
    )
    cart = derivation("cart-pole")
    assert cart.check(answer, hint=0).right
    for old, new in (("-mgl", "mgl"), ("b&-ml", "b&ml"), ("q+C(q,", "q-C(q,")):
        assert not cart.check(answer.replace(old, new), hint=0).right


def test_a_bold_command_without_braces_takes_one_letter() -> None:
    said = r"$q=(x_1,x_{2r})^T$. The equations are $\mathbf M\ddot q+\mathbf Kq=\mathbf f$ with"
    rows = (
        r"\[\mathbf M=\begin{pmatrix}m_1+m_2&m_2\\m_2&m_2\end{pmatrix},\quad"
        r"\mathbf K=\begin{pmatrix}0&0\\0&k\end{pmatrix},\quad\mathbf f=\begin{pmatrix}0\\F\end{pmatrix}.\]"
    )
    carts = derivation("lecture-3b")
    assert carts.check(f"{said}\n{rows}").right
    assert not carts.check(f"{said}\n{rows.replace('0&k', '0&-k')}").right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("sign", "right"), [("+", True), ("-", False)])
@pytest.mark.parametrize("gap", [r"& \quad \quad {} ", r"& \quad ", r"&\qquad{}", r"\quad", "&", ""])
@pytest.mark.parametrize("start", ["R &=", r"\dot p - Q &="])
def test_a_side_that_goes_on_over_indented_rows(start: str, gap: str, sign: str, right: bool) -> None:
    rows = rf"\[ {start} mL^2\ddot\theta \\ {gap} {sign} b\dot\theta \\ {gap} + mgL\sin\theta \\ &= 0 \]"
    before = r"\[ p = m L^2\dot\theta, \qquad Q = -b\dot\theta - mgL\sin\theta \] "
    verdict = derivation("pendulum").check(before * ("p" in start) + rows)
    assert verdict.right is right, verdict.to_text()


ONE_ROW = r"""\[ \mathbf M \ddot{\mathbf q} + \mathbf G = \mathbf A^T \boldsymbol\lambda \]
\[ \mathbf M = \begin{bmatrix} m & 0 \\ 0 & m \end{bmatrix}, \quad \mathbf G = \begin{bmatrix} 0 \\ mg \end{bmatrix} \]
\[ \mathbf A = \begin{bmatrix} x & y \end{bmatrix}, \quad
\boldsymbol\gamma = \begin{bmatrix} \dot x^2 + \dot y^2 \end{bmatrix} \]
\[ \boldsymbol\lambda = \begin{bmatrix} \lambda \end{bmatrix} \]
\[ \boldsymbol\gamma + \mathbf A \ddot{\mathbf q} = 0 \]"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("old", "new"), [("", ""), ("^2 + ", "^2 - "), ("^2 + ", "^2 + x")])
def test_a_row_times_a_column_beside_a_matrix_of_one_entry(old: str, new: str) -> None:
    verdict = derivation("rod-pendulum").check(ONE_ROW.replace(old, new))
    assert verdict.right is (not old), verdict.to_text()


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "written",
    [
        "\\[\n(J + m r^2)\\ddot\\varphi\n\\]\n\\[\n{}+ 2 m r\\dot r\\dot\\varphi = M\n\\]",
        r"$$(J + m r^2)\ddot\varphi$$ $$+ 2 m r\dot r\dot\varphi = M$$",
        "\\[(J + m r^2)\\ddot\\varphi +\\]\n\\[2 m r\\dot r\\dot\\varphi = M\\]",
        "\\[(J + m r^2)\\ddot\\varphi\\]\n\n\\[\\qquad + 2 m r\\dot r\\dot\\varphi\\]\n\\[= M\\]",
        "\\begin{align}\n(J+mr^2)\\ddot\\varphi\\end{align}\\begin{align}+ 2 m r\\dot r\\dot\\varphi = M\\end{align}",
        "$(J + m r^2)\\ddot\\varphi$\n$+ 2 m r\\dot r\\dot\\varphi = M$",
        "\\[(J + m r^2)\\ddot\\varphi = M\\]\n\\[{} - 2 m r\\dot r\\dot\\varphi\\]",
    ],
)
def test_an_equation_over_several_displays(written: str) -> None:
    puck = r"\[m\ddot r - m r\dot\varphi^2 + k(r - a) = 0\]" + "\n\n"
    assert rod().check(puck + written).right
    assert not rod().check(puck + written.replace("2 m r", "3 m r")).right


def test_displays_that_each_state_something_stay_apart() -> None:
    puck = r"\[- k(r - a) = m\ddot r - m r\dot\varphi^2\]"
    assert (
        rod()
        .check(r"\[\tfrac12 m\dot r^2\]" + puck + r"\[(J + m r^2)\ddot\varphi + 2 m r\dot r\dot\varphi = M\]")
        .right
    )
    assert rod().check(r"\[(J + m r^2)\ddot\varphi + 2 m r\dot r\dot\varphi = M\]" + puck).right


IN_WORDS = "m l^2 \\ddot φ + b \\dot φ + m g l sinφ = M      (*)\n\n"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "For |φ| << 1, (*) becomes the oscillator m l^2 \\ddot φ + b \\dot φ + m g l φ = M.",
        "Linearised, (*) gives m l^2 \\ddot φ + b \\dot φ + m g l φ = M.",
        "For small φ the equation becomes\nm l^2 \\ddot φ + b \\dot φ + m g l φ = M",
        "The weight acts like a spring in (*), and the support force does not appear.",
    ],
)
def test_dots_of_latex_among_words(said: str) -> None:
    """Words and dots alone make no document of LaTeX; (*) is the number of an equation."""
    for number in ("(*)", "(**)", "(1)", "[*]"):
        written = (IN_WORDS + said).replace("(*)", number)
        assert pendulum().check(written).right, written
    assert pendulum().check((IN_WORDS + said).replace("φ", r"\varphi ").replace(r"|\varphi |", "|φ|")).right
    assert pendulum().check("(*) " + (IN_WORDS + said).replace("      (*)", "", 1)).right
    assert not pendulum().check(IN_WORDS.replace("+ b", "- b") + said).right
    assert not pendulum().check(IN_WORDS.replace("sinφ", "cosφ") + said).right


@pytest.mark.parametrize("kind", ["multline", "align", "equation"])
def test_displays_whose_equations_go_on_over_their_rows_stay_apart(kind: str) -> None:
    first, second = (
        r"(J + m r^2)\ddot\varphi \\ + 2 m r\dot r\dot\varphi = M",
        r"-k(r - a) \\ + m r\dot\varphi^2 = m\ddot r",
    )
    written = "\n".join(rf"\begin{{{kind}}} {x} \end{{{kind}}}" for x in (first, second))
    assert rod().check(written).right
    assert not rod().check(written.replace("-k(r", "k(r")).right
