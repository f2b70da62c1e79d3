"""What students write around and inside their equations is read: labels, sentences, brackets, remarks, own names.

Oracle: by hand, a cart on a spring with a pendulum, and a puck on a cylinder with the contact as a constraint:

    (M + m) ẍ + m ℓ θ̈ cos θ − m ℓ θ̇² sin θ + k x = F_a
    m ℓ² θ̈ + m ℓ ẍ cos θ + m g ℓ sin θ = 0
    m r̈ − m r θ̇² + m g cos θ = λ,   m r² θ̈ + 2 m r ṙ θ̇ − m g r sin θ = 0,   r = R
"""

from functools import cache

import pytest
import sympy as sp

from constrained_systems import smooth_puck
from lagrangian import Derivation, ParseError, System

CART = "(M+m) x'' + m ell theta'' cos(theta) - m ell theta'^2 sin(theta) + k x = F_a"
BOB = "m ell^2 theta'' + m ell x'' cos(theta) + m g ell sin(theta) = 0"
T = "1/2 (M+m) x'^2 + m ell x' theta' cos(theta) + 1/2 m ell^2 theta'^2"


@cache
def cart() -> Derivation:
    """A cart on a spring with a pendulum, driven by a force on the cart."""
    sys = System("cart with a pendulum")
    x, theta = sys.coordinates("x theta")
    M, m, ell, k, g = sys.parameters("M m ell k g", M=2, m=0.7, ell=0.6, k=30, g=9.81)
    hinge = sys.point("A", (x, 0))
    sys.particle(M, at=hinge)
    sys.particle(m, at=sys.point("B", (x + ell * sp.sin(theta), -ell * sp.cos(theta))))
    sys.gravity(direction=(0, -1), g=g)
    sys.spring(k, deflection=x)
    sys.generalized_force(x, sys.input("F_a"))
    return sys.derive()


def accepted(written: str) -> bool:
    """Whether an answer is judged right; one that is refused is not."""
    try:
        return cart().check(written, hint=0).right
    except ParseError:
        return False


@pytest.mark.sampled(2)
@pytest.mark.parametrize("letter", ["ℓ", "l", "ell"])
def test_ell_is_read_as_the_letter_and_as_l(letter: str) -> None:
    assert accepted(f"{CART}\n{BOB}".replace("ell", letter))
    first = f"(M+m)ẍ + m{letter}θ̈cosθ − m{letter}θ̇²sinθ + kx = F_a"
    assert accepted(f"{first}\nm{letter}²θ̈ + m{letter}ẍcosθ + mg{letter}sinθ = 0")
    assert not accepted(f"{first}\nm{letter}²θ̈ + m{letter}ẍcosθ + mg{letter}²sinθ = 0")


def test_ell_in_latex() -> None:
    first = r"(M+m)\ddot x + m\ell\ddot\theta\cos\theta - m\ell\dot\theta^2\sin\theta + kx = F_a"
    assert accepted(rf"$${first}$$ $$m\ell^2\ddot\theta + m\ell\ddot x\cos\theta + mg\ell\sin\theta = 0$$")


def test_an_answer_that_says_what_l_is_does_not_mean_ell() -> None:
    assert accepted(f"l = 2*ell\n{CART}\n" + BOB.replace("m ell^2", "m l^2/4"))
    assert not accepted(f"l = 3*ell\n{CART}\n" + BOB.replace("m ell^2", "m l^2/4"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("T*: ", "V : "),
        ("gravity + spring: ", "x'': "),
        ("theta'':  ", "∂/∂θ: "),
        ("rod about A (parallel axes: 1/3*m + (m/2)^2): ", "bob, with the rod (slender):  "),
        ("cart   ", "bob2\t"),
        ("x-eq.  ", "theta-eq "),
        ("cart 1   ", "body 2 of 2   "),
        ("Newton/Euler: ", "T and V: "),
    ],
)
def test_labels_in_front_of_equations_are_no_factors(first: str, second: str) -> None:
    assert accepted(f"{first}{CART}\n{second}{BOB}")
    assert not accepted(f"{first}{CART}\n{second}{BOB.replace('g ell', 'g ell^2')}")


@pytest.mark.sampled(8)
@pytest.mark.parametrize("factor", ["k  ", "M_x  ", "2   ", "mk  ", "F_a   ", "m ell  ", "twice  "])
def test_factors_far_in_front_of_an_equation_stay(factor: str) -> None:
    assert not accepted(f"{CART}\n{factor}m ell theta'' + m x'' cos(theta) + m g sin(theta) = 1")
    assert not accepted(f"{factor}(M+m) x'' = F_a - k x\n{BOB}")


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "said",
    [
        "My answer (I wrote mu = M + m for both masses, and J = m*ell^2 about A):",
        "I used the sum mu = M + m of both masses, the inertia J = m ell^2 (about the hinge). Then",
        "For convenience I call the total mass mu = M + m, and the inertia about the hinge is J = m ell^2:",
        "times 4, and with mu = M + m, J = m*ell^2 from now on:",
        "mu = M + m     (both masses)\nJ = m ell^2    (so J = m*ell^2 about A)",
    ],
)
def test_sentences_define_names(said: str) -> None:
    equations = f"mu{CART[5:]}\nJ{BOB[7:]}"
    assert accepted(f"{said}\n{equations}")
    assert not accepted(f"{said}\n{equations}".replace("M + m", "M - m"))
    assert not accepted(f"{said}\n{equations}".replace("J = m", "J = 2*m"))


@pytest.mark.parametrize(
    "said",
    [
        "I used cos(a - b) = cos(a) cos(b) + sin(a) sin(b).",
        "I divided nothing by m*ell^2.",
        "(where sin(theta)^2 + cos(theta)^2 = 1)",
        "V = 0 at the height of the cart, and theta = 0 is downwards:",
        "The bob B=(x + ell sin(theta), -ell cos(theta)) has the height -ell cos(theta).",
    ],
)
def test_sentences_with_mathematics_are_no_equations_of_motion(said: str) -> None:
    assert accepted(f"{said}\n{CART}\n{BOB}")


def test_what_is_left_out_with_numbers_or_names_is_told() -> None:
    verdict = cart().check(f"{CART}, friction 5 k\n{BOB}")
    assert "'friction 5 k' was not judged: it has no equals sign." in map(str, verdict.notes)
    verdict = cart().check(f"V = 0 at the pivot\n{CART}\n{BOB}")
    assert "'V = 0 at the pivot' was not judged: it says where V is 0." in map(str, verdict.notes)
    assert not accepted(f"V = 0\n{CART}\n{BOB}")


@pytest.mark.sampled(4)
@pytest.mark.parametrize("word", ["twice", "half", "minus", "double"])
def test_words_that_change_a_value_are_not_left_out(word: str) -> None:
    assert accepted(f"the sum of masses mu = M + m\nmu{CART[5:]}\n{BOB}")
    assert not accepted(f"{word} the sum of masses mu = M + m\nmu{CART[5:]}\n{BOB}")


@pytest.mark.parametrize("first", ["thd = theta'", "thdd = theta''"])
def test_rates_are_declared_in_any_order_and_without_commas(first: str) -> None:
    declared = ["thd = theta'", "thdd = theta''", "xdd = x''"]
    declared.sort(key=lambda x: x != first)
    equations = f"{CART}\n{BOB}".replace("theta''", "thdd").replace("theta'", "thd").replace("x''", "xdd")
    for between in (", ", " ", "; ", "\n"):
        assert accepted(f"{between.join(declared)}\n{equations}")
    assert not accepted(f"{', '.join(declared)}\n{equations}".replace("thdd = theta''", "thdd = 2*theta''"))


def test_rates_of_other_letters_are_declared_before_the_velocity() -> None:
    equations = f"{CART}\n{BOB}".replace("theta''", "wd").replace("theta'", "w")
    assert accepted(f"wd = theta'', w = theta'\n{equations}")
    assert not accepted(f"wd = theta'', w = x'\n{equations}")


def test_indices_with_dots_and_products_with_indices() -> None:
    assert accepted(f"q₁ = x, q₂ = θ\n(M+m) q̈₁ + m ℓ q̈₂ cos q₂ − m ℓ q̇₂² sin q₂ + k q₁ = F_a\n{BOB}")
    assert accepted("m₁ = m\nM ẍ + m₁ẍ + m₁ℓθ̈ cosθ − m₁ℓθ̇² sinθ + kx = F_a\nm₁ẍ cosθ = −m₁ℓθ̈ − m₁g sinθ")
    assert not accepted(f"{CART}\nmẍ cosθ = −mℓθ̈ + mg sinθ")


@pytest.mark.slow
@pytest.mark.parametrize("force", ["λ", "N_c", "2λ", "−λ"])
def test_a_multiplier_beside_a_name_is_a_factor(force: str) -> None:
    radial, turning = f"m r'' - m r θ'^2 + m g cos θ = {force}", "m r^2 θ'' + 2 m r r' θ' = m g r sin θ"
    assert smooth_puck().check(f"{radial}\n{turning}\nr = R", hint=0).right
    assert smooth_puck().check(f"r m r'' - r m r θ'^2 + r m g cos θ = {force} r\n{turning}\nr = R", hint=0).right
    assert not smooth_puck().check(f"{radial}\n{turning.replace('sin', 'cos')}\nr = R", hint=0).right


def test_a_bracket_that_is_missing_at_the_end_alone_is_closed() -> None:
    verdict = cart().check(f"m ell theta'' + m x'' cos(theta) = -m g sin(theta\n{CART}")
    assert verdict.right and "Line 1 lacks a bracket, which was closed at its end." in map(str, verdict.notes)
    assert not accepted(f"m ell (theta'' + x'' cos(theta) + g sin(theta) = 0\n{CART}")
    assert not accepted(f"m (ell theta'' + x'' cos(theta) = -m g sin(theta)\n{CART}")


def test_plain_lines_beside_latex_are_read() -> None:
    equations = r"""$$\mu\ddot x + m\ell\ddot\theta\cos\theta - m\ell\dot\theta^2\sin\theta + kx = F_a$$
$$J\ddot\theta + m\ell\ddot x\cos\theta + mg\ell\sin\theta = 0$$"""
    assert accepted(f"mu = M + m,  J = m ell^2   (about the hinge)\n\n{equations}")
    assert not accepted(f"mu = M + m,  J = 2 m ell^2\n\n{equations}")
    assert not accepted(f"mu = M + m,  J = m ell^2\n{equations}\nm ell theta'' + m x'' = 0")


def test_expressions_of_programs_are_no_words() -> None:
    written = "Derivative(x(t), (t, 2))*(M + m) + m*ell*Derivative(theta(t), (t, 2))*cos(theta(t)) + k*x(t) - F_a"
    written = f"{written} - m*ell*sin(theta(t))*Derivative(theta(t), t)**2"
    assert accepted(f"{written}\n{BOB}")


def test_a_list_with_an_item_in_two_lines_is_read() -> None:
    assert accepted(f"- cart 1: −k x = {CART.replace(' + k x', '').replace('= F_a', '- F_a')}\n- bob, in N m:\n  {BOB}")


FIRST = r"(M+m)\ddot x + m\ell\ddot\theta\cos\theta - m\ell\dot\theta^2\sin\theta + kx &= F_a"
SECOND = r"m\ell\ddot\theta + m\ddot x\cos\theta &= -mg\sin\theta"


@pytest.mark.parametrize(
    "written",
    [
        rf"\[\left\{{\begin{{aligned}} {FIRST} \\ {SECOND} \end{{aligned}}\right.\]",
        rf"$$\left.\begin{{split}} {FIRST} \\ {SECOND} \end{{split}}\right\}}$$",
        rf"\begin{{align}} \mathrm{{(1)}}\quad {FIRST} \\ \text{{(2)}}\quad {SECOND} \end{{align}}",
    ],
)
def test_systems_in_braces_and_numbers_in_upright_letters(written: str) -> None:
    assert accepted(written)
    assert not accepted(written.replace("-mg", "mg"))


def test_empty_entries_of_a_matrix_are_zeros() -> None:
    first = r"m\ell\ddot\theta\cos\theta-m\ell\dot\theta^2\sin\theta+kx"
    terms = rf"\begin{{pmatrix}}{first}\\m\ddot x\cos\theta+mg\sin\theta\end{{pmatrix}}"
    for blank, right in ((r"M+m\\&m\ell", True), (r"&M+m\\m\ell", False), (r"M+m&\\&m\ell", True)):
        mass = rf"\begin{{pmatrix}}{blank}\end{{pmatrix}}\begin{{pmatrix}}\ddot x\\\ddot\theta\end{{pmatrix}}"
        written = rf"$${mass}+{terms}=\begin{{pmatrix}}F_a\\0\end{{pmatrix}}$$"
        assert accepted(written) == right
    verdict = cart().check(rf"$${mass}+{terms}=\begin{{pmatrix}}F_a\\0\end{{pmatrix}}$$")
    assert "Empty entries of a matrix were read as 0." in map(str, verdict.notes)


def test_named_matrices_with_rows_below_each_other() -> None:
    forces = "f = [F_a - k*x + m*ell*sin(theta)*theta'^2 ; -m*g*ell*sin(theta)]"
    mass = "M_q = [ M+m   m*ell*cos(theta) ]\n      [ m*ell*cos(theta)   m*ell^2 ]"
    assert accepted(f"M_q q'' = f\n{mass}\n{forces}")
    assert not accepted(f"M_q q'' = f\n{mass.replace('ell^2', 'ell')}\n{forces}")


def test_an_arrow_of_two_lines_and_a_remark_begin_an_equation() -> None:
    assert accepted(f"T = {T}\n==> {CART}\n===> {BOB}")
    assert accepted(f"(cart) {CART}\n(bob) {BOB}")
    assert accepted(f"{CART}\n{BOB}".replace("theta''", "diff(theta, 2)").replace("theta'^2", "diff(theta)^2"))


@pytest.mark.slow
def test_sums_of_numbers_and_energies_before_a_colon() -> None:
    V = "1/2 k x^2 - m g ell cos(theta)"
    assert accepted(f"- T: {T}\n- V: {V}\n- x: {CART}\n- theta: {BOB}")
    assert accepted(f"T: {T}\nV: {V}\n(1): {CART}\n(1) + 2·(2): {BOB}")
    assert accepted(f"T*: cart, bob's speed (x' + ell theta')\nT* = {T}\n{CART}\n{BOB}")
    assert not accepted(f"T: {T}\nV: {V.replace('- m', '+ m')}\n(1): {CART}\n(2): {BOB}")
    first = CART.replace("F_a", f"F_a + {BOB.partition(chr(61))[0]}")
    assert accepted(f"(1) - (2): {first}\n(2): {BOB}")
    assert not accepted(f"(1) - (2): {CART}\n(2) 3: {BOB.replace('g ell', 'g')}")


def test_second_derivatives_of_brackets() -> None:
    for two in ("²", "^2"):
        assert accepted(f"(M + m) x'' + m ell d{two}(sin θ)/dt{two} + k x = F_a\n{BOB}")
        assert not accepted(f"(M + m) x'' + m ell d{two}(cos θ)/dt{two} + k x = F_a\n{BOB}")


def test_an_energy_of_energies_without_values_is_told_if_it_says_more() -> None:
    verdict = cart().check(f"L = T - V + k x\n{CART}\n{BOB}")
    assert "'L = T - V + k x' was not judged: an energy in it has no value." in map(str, verdict.notes)
    assert not cart().check(f"L = T - V\n{CART}\n{BOB}").notes


def test_letters_with_d_are_rates_of_what_moves_alone() -> None:
    sheet = "kd = k/2\nF_ad = F_a - kd x\nmd = M + m\n" + CART.replace("(M+m)", "md")
    sheet = sheet.replace("+ k x = F_a", "+ kd x = F_ad") + "\n" + BOB
    assert accepted(sheet)
    assert not accepted(sheet.replace("kd = k/2", "kd = k"))
    assert accepted(f"{CART}\n{BOB}".replace("x''", "xdd").replace("theta'", "thetad").replace("thetad'", "thetadd"))


def test_a_legend_of_rates_is_no_equation() -> None:
    legend = "(th = theta, d.. = rate, dd.. = acceleration; m is the bob)\n"
    rows = f"{CART}\n{BOB}".replace("theta''", "ddth").replace("theta'", "dth").replace("x''", "ddx")
    assert accepted(f"{rows}\n{legend}".replace("(theta)", "(th)"))
    assert accepted(f"..' = velocity, ..'' = second derivative\n{CART}\n{BOB}")


def test_a_derivative_of_positions_is_no_equation_of_motion() -> None:
    verdict = cart().check(f"(chain rule with d/dt(x + ell sin(theta)) = x' + cos(theta) theta')\n{CART}\n{BOB}")
    assert [f.line.kind for f in verdict.findings] == ["identity", "equation", "equation"]
    assert [f.status.right for f in verdict.findings] == [False, True, True]
    assert accepted(f"d/dt(x + ell sin(theta)) = x' + ell cos(theta) theta'\n{CART}\n{BOB}")
