r"""What stands beside the statements of right answers: labels of chapters, remarks in brackets or in italics, numbers
with units, another name of a command, and derivatives, rates and products that are written shortly.

Oracle: by hand, a puck m at the distance r on a rod with a spring, which a motor M turns,

    (J + m r²) φ̈ + 2 m r ṙ φ̇ = M,   m r̈ − m r φ̇² + k (r − a) = 0,

a pendulum on a cart, and a pendulum of which the handle d is pushed by F.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from small_systems import cart, rod

import lagrangian as lg
from lagrangian.derivation import Derivation

ROWS = "(J + m r^2) phi'' + 2 m r r' phi' = M\nm r'' - m r phi'^2 + k (r - a) = 0"
LATEX = (
    r"$(J + m r^2)\ddot\varphi + 2 m r\dot r\dot\varphi = M$" + "\n\n" + r"$m\ddot r - m r\dot\varphi^2 + k(r - a) = 0$"
)


def right(system: Derivation, answer: str) -> bool:
    """Whether an answer is judged right; one that is refused is not."""
    try:
        return system.check(answer, hint=0).right
    except lg.ParseError:
        return False


# -- labels and remarks -----------------------------------------------------------------------------------------------


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "labels", [("(II.1)", "(II.2)"), ("(A.1)", "(A.2)"), ("(2.3a)", "(2.3b)"), ("[IV.1]", "[IV.2]")]
)
@pytest.mark.parametrize("behind", [False, True])
def test_labels_with_the_number_of_a_chapter(labels: tuple[str, str], behind: bool) -> None:
    rows = ROWS.split("\n")
    answer = "\n".join(f"{row}   {x}" if behind else f"{x}   {row}" for row, x in zip(rows, labels, strict=True))
    assert right(rod(), answer)
    assert not right(rod(), answer.replace("2 m r", "m r"))


@pytest.mark.parametrize("label", [r"(\mathrm{II.1})\quad", "", r"(A.1)\quad", r"(II.1)\quad"])
def test_such_labels_in_latex(label: str) -> None:
    answer = LATEX.replace("$(J", f"${label}(J") if "mathrm" not in label else LATEX
    assert right(rod(), answer)
    assert not right(rod(), answer.replace("+ 2 m", "- 2 m"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("gap", [r"\quad", r"\;", " ", r"\qquad"])
@pytest.mark.parametrize(
    "words", [r"(\text{about the hinge})", r"[\text{bezüglich Lager}]", r"(\mbox{Steiner, of course})"]
)
def test_words_in_brackets_behind_a_formula(gap: str, words: str) -> None:
    """The value is kept: I is not read as J."""
    said = rf"$T = \tfrac12 I\dot\varphi^2 + \tfrac12 m\dot r^2,\qquad I = J + m r^2 {gap}{words}$" + "\n\n"
    answer = said + LATEX.replace("(J + m r^2)", "I")
    assert right(rod(), answer)
    assert not right(rod(), answer.replace("J + m r^2", "J + 2 m r^2"))


def test_words_in_brackets_that_are_a_term_are_none() -> None:
    assert not right(rod(), LATEX.replace("= M$", r"= (\text{motor}) + M$"))


REMARKS = [
    "*I depends on r!*",
    "I depends on r!",
    "_This I is no constant._",
    "*I is not constant, so it stays inside.*",
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("remark", REMARKS)
@pytest.mark.parametrize("gap", [" ", "\n"])
def test_a_sentence_about_a_name_behind_its_value(remark: str, gap: str) -> None:
    said = f"**T** = 1/2 I phi'^2 + 1/2 m r'^2 with the abbreviation I = J + m r^2.{gap}{remark}\n\n"
    answer = said + ROWS.replace("(J + m r^2)", "I")
    assert right(rod(), answer)
    assert not right(rod(), answer.replace("J + m r^2", "J + 3 m r^2"))


# -- LaTeX ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "said",
    [
        r"For $M = \SI{0}{N.m}$ it turns on.",
        r"With $M = \qty{0}{\newton\metre}$ it turns on.",
        r"For $M = \num{0}$ it turns on.",
        r"For $M = 0\,\unit{\newton\metre}$ it turns on.",
    ],
)
def test_numbers_of_siunitx(said: str) -> None:
    assert right(rod(), f"{LATEX}\n\n{said}")
    assert not right(rod(), f"{LATEX.replace('+ 2 m', '- 2 m')}\n\n{said}")


NUMBERS = r"""
$\SI{0.5}{\kilogram\metre\squared}\,\ddot\varphi + \num{2e0}\,\dot\varphi + \SI{1,5}{N.m}\sin\varphi = M$
"""


@cache
def swing() -> Derivation:
    """A damped pendulum with values."""
    s = lg.System("swing")
    phi = s.coordinate("phi")
    J, b, c = s.parameter("J", 0.5), s.parameter("b", 2), s.parameter("c", 1.5)
    s.kinetic(J * phi.diff() ** 2 / 2)
    s.potential(-c * sp.cos(phi))
    s.damper(b, deflection=phi)
    s.torque(s.input("M"), on=phi)
    return s.derive()


def test_numbers_of_siunitx_in_an_equation() -> None:
    assert right(swing(), NUMBERS)
    for a, b in (("0.5", "0.6"), ("2e0", "2e1"), ("1,5", "15"), ("{0.5}", "{-0.5}")):
        assert not right(swing(), NUMBERS.replace(a, b))


def test_a_unit_that_is_not_one_is_not_left_out() -> None:
    assert not right(swing(), NUMBERS.replace("{N.m}", "{kN.m}"))
    assert not right(swing(), NUMBERS.replace(r"\kilogram", r"\milli\gram"))


LET = r"\let\th\varphi" + "\n" + r"\let\oldphi=\phi" + "\n" + LATEX.replace(r"\varphi", r"\th ")


def test_another_name_of_a_command() -> None:
    assert right(rod(), LET)
    assert not right(rod(), LET.replace("+ 2 m", "- 2 m"))
    exchanged = r"\let\temp\phi \let\phi\varphi \let\varphi\temp" + "\n"
    assert right(rod(), exchanged + LATEX) and right(rod(), exchanged + LATEX.replace("varphi", "phi"))


CART = r"""
$T = \frac12 M\dot x^2 + \frac12 m(\dot x^2 + 2 l\dot x\dot\varphi\cos\varphi + l^2\dot\varphi^2)$

$V = \frac12 k x^2 - m g l\cos\varphi$

$(M + m)\ddot x + m l(\ddot\varphi\cos\varphi - \dot\varphi^2\sin\varphi) + k x = 0$

$m l^2\ddot\varphi + m l\ddot x\cos\varphi + m g l\sin\varphi = 0$
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "place", ["in the horizontal position of the rod", "at the height of the hinge", r"for $\varphi = \pi/2$, $x = 0$"]
)
def test_where_the_potential_energy_is_zero(place: str) -> None:
    said = f"($V = 0$ {place}.)\n\n"
    assert right(cart(), CART.replace("$(M", f"{said}$(M"))
    assert not right(cart(), CART.replace("- m g l", "+ m g l").replace("$(M", f"{said}$(M"))
    assert not right(
        cart(), "$V = 0$ in this problem.\n\n" + CART.replace(r"$V = \frac12 k x^2 - m g l\cos\varphi$", "")
    )


# -- rates, derivatives, products -------------------------------------------------------------------------------------


@cache
def handle() -> Derivation:
    """A pendulum of which the handle, d from its hinge, is pushed by F."""
    s = lg.System("pendulum with a handle")
    theta = s.coordinate("theta")
    m, l, d, g, c = s.parameters("m l d g c")
    s.particle(m, at=s.point("P", (l * sp.sin(theta), -l * sp.cos(theta))), name="bob")
    s.gravity((0, -1), g)
    s.damper(c, deflection=theta)
    s.force(s.input("F"), deflection=d * theta, name="hand")
    return s.derive()


def test_an_input_times_d_is_a_product() -> None:
    """No system has the rate of an input."""
    answer = "Q = Fd - c θ̇\nml² θ̈ + mgl sinθ + c θ̇ = Fd"
    assert right(handle(), answer)
    assert not right(handle(), answer.replace("Fd", "Fl")) and not right(handle(), answer.replace("Q = Fd", "Q = Fdd"))
    assert right(handle(), "m l^2 thetadd + c thetad + m g l sin(theta) = Fd")


@pytest.mark.slow
def test_the_rate_of_a_function_of_a_coordinate_is_no_slope() -> None:
    """I′ is İ where its value holds a rate, and ∂I/∂r where it holds none."""
    rows = "I φ̈ + 2 m r ṙ φ̇ = M\nm r̈ − m r φ̇² + k (r − a) = 0"
    for said in ("I' = 2 m r dr/dt = 2 m r ṙ", "I' = 2 m r dr/dt", "I' = 2 m r ṙ"):
        answer = f"I(r) = J + m r², donc {said}\n{rows}"
        assert right(rod(), answer)
        assert not right(rod(), answer.replace("2 m r ṙ\n", "m r ṙ\n").replace("dr/dt\n", "m dr/dt\n"))
        assert not right(rod(), answer.replace("+ 2 m r ṙ φ̇", "− 2 m r ṙ φ̇"))
    slope = f"I(r) = J + m r², I' = 2 m r\n{rows}"
    assert right(rod(), slope) and right(rod(), slope.replace("2 m r ṙ φ̇", "I' ṙ φ̇"))
    assert not right(rod(), slope.replace("2 m r ṙ φ̇", "2 I' ṙ φ̇"))


def test_a_product_with_a_point_is_no_name_of_what_is_zero() -> None:
    """m·ax uses the acceleration ax, which another line says."""
    answer = (
        "ax = x'' + l·φ''·cos φ - l·φ'²·sin φ\nay = l·φ''·sin φ + l·φ'²·cos φ\n"
        "M·x'' + m·ax + k·x = 0\n(m·ax)·l·cos φ + m·(g + ay)·l·sin φ = 0"
    )
    assert right(cart(), answer)
    assert not right(cart(), answer.replace("+ l·φ''·cos φ -", "- l·φ''·cos φ -"))


@pytest.mark.parametrize("arrow", ["→", "="])
def test_the_derivative_by_time_of_the_line_above_beside_latex(arrow: str) -> None:
    head = CART[: CART.index("$(M")]
    lines = (
        f"- ∂L/∂ẋ = (M + m) ẋ + m l φ̇ cos φ\n- d/dt {arrow} (M + m) ẍ + m l (φ̈ cos φ − φ̇² sin φ)\n- ∂L/∂x = −k x\n\n"
    )
    answer = f"{head}{lines}{CART[CART.index('$(M') :]}"
    found = cart().check(answer)
    assert found.right and [f.line.kind for f in found.findings][2:5] == ["p", "p-rate", "slope"]
    assert not right(cart(), answer.replace("− φ̇² sin φ)\n", "+ φ̇² sin φ)\n"))
    assert not right(cart(), answer.replace("= −k x", "= k x"))


def test_derivatives_of_an_energy_beside_forces_that_it_lacks() -> None:
    """The spring is in Q and not in V: ∂L/∂r is that of the L which is stated."""
    answer = (
        "T = 1/2 (J + m r²) φ̇² + 1/2 m ṙ²\nV = 0\nQ_r = −k (r − a)\nQ_φ = M\n{}\n(J + m r²) φ̈ + 2 m r ṙ φ̇ = M\n"
        "m r̈ − m r φ̇² = −k (r − a)"
    )
    assert right(rod(), answer.format("∂L/∂r = m r φ̇²"))
    assert not right(rod(), answer.format("∂L/∂r = −m r φ̇²"))
    assert not right(rod(), answer.format("∂L/∂r = m r φ̇²").replace("Q_r = −k", "Q_r = k"))


@cache
def strut() -> Derivation:
    """A gate with a spring from its handle to a point above its hinge."""
    s = lg.System("gate with a spring")
    theta = s.coordinate("theta")
    J, a, b, k = s.parameters("J a b k")
    s.kinetic(J * theta.diff() ** 2 / 2)
    handle, above = s.point("H", (a * sp.sin(theta), -a * sp.cos(theta))), s.point("B", (0, b))
    s.spring(k, between=(handle, above), name="spring")
    return s.derive()


@pytest.mark.slow
def test_a_value_at_a_position_that_words_say() -> None:
    """ρ is √(a² + b²) at θ = 90° alone."""
    said = r"$\rho = \sqrt{a^2 + b^2 + 2 a b\cos\theta}$, $V = \frac12 k\rho^2$" + "\n\n"
    said += r"$\frac{\partial\rho}{\partial\theta} = -\frac{a b\sin\theta}{\rho}$" + "\n\n"
    said += r"$J\ddot\theta - k\rho\frac{a b\sin\theta}{\rho} = 0$" + "\n\n"
    for place in ("At θ = 90°", "**Bei θ = π/2**", r"With the hand at $\theta = \pi/2$ (horizontal)"):
        assert right(strut(), rf"{said}{place}: $\rho = \sqrt{{a^2 + b^2}}$")
        assert not right(strut(), rf"{said}{place}: $\rho = \sqrt{{a^2 - b^2}}$")
    assert not right(strut(), rf"{said}At θ = 60°: $\rho = \sqrt{{a^2 + b^2}}$")
