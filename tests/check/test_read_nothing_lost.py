"""Nothing that an answer says is lost in silence: what is not judged is told, and what cannot be read is refused.

Oracle: the equation of the pendulum, m L² θ̈ + b θ̇ + m g L sin θ = 0; with something more on a side it is not right.
"""

from collections.abc import Iterator

import pytest
import sympy as sp

from built_in import derivation
from lagrangian import ParseError, System, loads
from lagrangian.check.reading import parse_answer
from lagrangian.check.reading.hypertext import without_tags
from lagrangian.check.reading.traced_text import TracedText

LEFT = "m L² θ'' + b θ' + m g L sin θ"
T = "1/2 m L² θ'²"


def judged_right(written: str, name: str = "pendulum") -> bool:
    """Whether an answer is judged right; one that is refused is not."""
    try:
        return derivation(name).check(written, hint=0).right
    except ParseError:
        return False


@pytest.mark.parametrize("behind", ["| : 5 = 3 b", "| - 3 b = 7 θ'", "<- b = 0", "← b = 0"])
def test_a_side_behind_a_stroke_or_an_arrow_stays(behind: str) -> None:
    assert not judged_right(f"{LEFT} {behind}")
    assert judged_right(f"{LEFT} = 0 {behind.split('=')[0]}")


@pytest.mark.parametrize(
    "written",
    [
        "θ' <b g> x",
        "x < b and y > 0",
        "x <i t> y",
        "x < sub > 2 < /sub> 3",
        "a <b g=0> c",
        "m <b/2> u < / b > v",
        "x' <b> 0",
    ],
)
def test_comparisons_are_no_tags(written: str) -> None:
    assert without_tags(TracedText(written)).text == written


def test_tags_are_taken_off() -> None:
    written = """<p class="a b">x<sub>1</sub> <b style='c'>y</b><br/><td align=center>z<br /><span id="q" lang="de">"""
    assert without_tags(TracedText(written)).text.split() == ["x_1", "y", "z"]
    assert not judged_right("m L² θ'' + b θ' <b g> + m g L sin θ = 0")


def test_a_letter_behind_a_subscript_of_a_web_page_is_another_name() -> None:
    data = "<p>I<sub>c</sub>&theta; and m<sub>1</sub>g l = 3, J + m<sub>1</sub>l<sup>2</sup>x = 2</p>"
    assert without_tags(TracedText(data)).text.strip() == "I_c θ and m_1 g l = 3, J + m_1 l^2 x = 2"
    assert without_tags(TracedText("x<sub>1</sub>ddot + x<sub>2</sub>&#775;")).text == "x_1ddot + x_2\u0307"
    pressed = "<p>m<sub>e</sub>L = 2, m<sub>e</sub>L<sup>2</sup> + J = 3</p>"
    assert without_tags(TracedText(pressed)).text.split("\n")[1] == "m_e L = 2, m_e L^2 + J = 3"


@pytest.mark.parametrize("unknown", ["∂A_1/∂θ - ∂B_1/∂θ'", "∂A_1/∂m - ∂B_1/∂m", "∂A_1/∂θ - ∂A_1/∂θ'"])
def test_derivatives_of_different_unknown_quantities_do_not_cancel(unknown: str) -> None:
    verdict = derivation("pendulum").check(f"{LEFT} = {unknown}")
    assert not verdict.right and "was not judged" in str(verdict.notes[0])
    told = derivation("pendulum").check(f"{LEFT} = 0\n{LEFT} = {unknown}").notes
    assert [str(note) for note in told] == [str(verdict.notes[0])]


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("T = T_1 + 5 T_2", "'T_1 + 5 T_2' was not judged: nothing says what T_1 and T_2 are."),
        ("T = T_1 + 3", "'T_1 + 3' was not judged: nothing says what T_1 is."),
        (f"T = ½ m v² = {T}", "'½ m v²' was not judged: nothing says what v is."),
        (f"m L² θ'' = M_r = -b θ' - {LEFT.split('+')[2]}", "'M_r' was not judged: nothing says what M_r is."),
        ("∑M = 5 θ''", "'∑M = 5 θ''' was not judged: nothing says what ∑ adds up."),
        ("5 b θ' + ∑M = m L² θ'' = -b θ' - m g L sin θ", "'5 b θ' + ∑M' was not judged: nothing says what ∑ adds up."),
    ],
)
def test_a_side_that_is_not_judged_is_told(written: str, said: str) -> None:
    verdict = derivation("pendulum").check(f"{written}\n{LEFT} = 0")
    assert verdict.right and said in map(str, verdict.notes), verdict.to_text()


def test_a_sum_of_moments_at_the_head_of_an_equation_needs_no_note() -> None:
    verdict = derivation("pendulum").check("∑M = m L² θ'' = -b θ' - m g L sin θ")
    assert verdict.right and not verdict.notes


@pytest.mark.parametrize(
    "written",
    [
        f"T = T_1 + T_2 = 99 Z = {T}\n{LEFT} = 0",
        "m L² θ'' = Q + Z = -b θ' - m g L sin θ = W = -b θ' - m g L sin θ",
    ],
)
def test_a_side_with_another_name_is_no_side_to_leave_out(written: str) -> None:
    verdict = derivation("pendulum").check(written)
    assert not verdict.right and "The system has no 'Z'." in map(str, verdict.notes), verdict.to_text()


@pytest.mark.parametrize(
    ("matrix", "entries"),
    [
        (r"\left(\begin{pmatrix}1&2\\3&4\end{pmatrix}\right)^T", [1, 3, 2, 4]),
        ("([1, 2; 3, 4])^T", [1, 3, 2, 4]),
        ("[1, 2; 3, 4]^T", [1, 3, 2, 4]),
        ("Matrix([[1,2],[3,4]])^T", [1, 3, 2, 4]),
    ],
)
def test_a_matrix_in_brackets_is_transposed(matrix: str, entries: list[int]) -> None:
    assert list(_multiplied(matrix)) == entries


@pytest.mark.parametrize(
    ("matrix", "width"),
    [("[3, 4]^T", 1), ("((3, 4))^T", 1), (r"\left(3, 4\right)^\top", 1), ("[3; 4]^T", 2), ("[[3], [4]]^T", 2)],
)
def test_a_list_is_a_column_and_a_column_is_transposed(matrix: str, width: int) -> None:
    other = "[1, 0; 0, 1]" if "\\" not in matrix else r"\begin{pmatrix}1&0\\0&1\end{pmatrix}"
    if width == 2:
        assert list(_multiplied(f"{matrix}*{other}")) == [3, 4]
    else:
        assert list(_multiplied(f"{other} {matrix}" if "\\" in matrix else f"{other}*{matrix}")) == [3, 4]


def _multiplied(matrix: str) -> Iterator[sp.Expr]:
    """The entries of a matrix, row by row, which the equations matrix · θ'' = 0 show."""
    model = derivation("pendulum").model
    written = rf"${matrix} \ddot\theta = 0$" if "\\" in matrix else f"{matrix}*theta'' = 0"
    for line in parse_answer(written, model).equations:
        assert line.lhs is not None
        yield line.lhs / model.coordinates[0].symbol.diff("t", 2)


def test_names_of_the_system_are_no_rates() -> None:
    s = System("driven")
    x = s.coordinates("x")
    m, k, x_p = s.parameters("m k x_p")
    s.particle(m, at=s.origin + (x, 0))
    s.spring(k, deflection=x - x_p)
    answer = parse_answer("m*x_pp + k*(x - x_p) = 0", s.model)
    assert answer.lines[0].lhs == parse_answer("m*x'' + k*(x - x_p) = 0", s.model).lines[0].lhs
    assert s.derive().check("m*x_pp + k*(x - x_p) = 0", hint=0).right


ENERGIES_ALONE = """T = 1/2 (M+m) x'^2 + m l x' theta' cos(theta) + 1/2 (J + m l^2) theta'^2
V = m g l cos(theta)
Q_x = F - b x', Q_theta = 0
"""


@pytest.mark.parametrize(
    "result",
    [
        "so that the first equation is (M+m) times the acceleration plus the rest of it = F - b x', see ## above",
        "and so Lagrange's two equations of motion are (M+m) x°° + m l cos(theta) theta°° + sin = F and the second one",
    ],
)
def test_energies_alone_are_not_right_in_front_of_a_result_that_was_not_read(result: str) -> None:
    pole = derivation("cart-pole")
    assert pole.check(ENERGIES_ALONE, hint=0).right
    with pytest.raises(ParseError):
        pole.check(f"{ENERGIES_ALONE}{result}")
    assert pole.check(f"{result}\n{ENERGIES_ALONE}", hint=0).right
    assert pole.check(
        f"{ENERGIES_ALONE}The zero of the height is at the axle, where V = 0 as it should be", hint=0
    ).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("slope", ["d delta/d theta", "ddelta/dtheta", "d delta / dtheta", "∂delta/∂theta"])
def test_a_slope_of_a_quantity_in_long_letters_is_no_product_with_a_damper(slope: str) -> None:
    flap = loads(
        """
        name = "flap"
        [coordinates]
        theta = {}
        [parameters]
        J = {}
        k = {}
        a = {}
        d = {}
        [[frame]]
        name = "flap"
        angle = "theta"
        [[rigid_body]]
        mass = "1"
        inertia = "J"
        at = ["0", "0"]
        frame = "flap"
        [[spring]]
        k = "k"
        deflection = "a*sin(theta)"
        [[damper]]
        b = "d"
        deflection = "theta"
        """
    ).derive()
    row = "J theta'' + d theta' + k a^2 sin(theta) cos(theta) = 0\ndelta = a sin(theta)\n"
    assert flap.check(f"{row}{slope} = a cos(theta)", hint=0).right
    assert not flap.check(f"{row}{slope} = a sin(theta)", hint=0).right
