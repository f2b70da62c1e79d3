r"""Legends, lists and sentences in which an answer says what its letters, lengths and rates are.

Oracle: the equation of a damped pendulum with a push at its bob, and of a mass on a spring, and the same with another
factor or sign.
"""

from __future__ import annotations

from functools import cache

import pytest

from lagrangian.check.verb import check_answer
from lagrangian.derive import Derived
from lagrangian.read import loads
from lagrangian.structured.choose import derive_in_form

BOB_ON_A_ROD = """
name = "bob"

[coordinates]
theta = "from the vertical"

[parameters]
m = { unit = "kg" }
l = { unit = "m" }
b = { unit = "N*s/m" }
g = { unit = "m/s^2" }

[inputs]
F = "N"

[points]
P = ["l*sin(theta)", "-l*cos(theta)"]

[[particle]]
name = "bob"
mass = "m"
at = "P"

[[gravity]]
direction = [0, -1]
g = "g"

[[damper]]
name = "across"
b = "b"
deflection = "l*sin(theta)"

[[force]]
name = "push"
value = ["F", "0"]
at = "P"
"""

DRAGGED = """
name = "dragged"

[coordinates]
x = "m"

[parameters]
m = { unit = "kg" }
k = { unit = "N/m" }
b = { unit = "N*s/m" }
c = { unit = "N*s/m" }

[inputs]
F = "N"

[points]
P = ["x", "0"]

[[particle]]
name = "mass"
mass = "m"
at = "P"

[[spring]]
name = "spring"
k = "k"
deflection = "x"

[[damper]]
name = "damper"
b = "c"
deflection = "x"

[[force]]
name = "drag"
value = ["-b*x'", "0"]
at = "P"

[[force]]
name = "push"
value = "F"
deflection = "x"
"""

STRUT = """
name = "strut"

[coordinates]
theta = "rad"

[parameters]
J = "2 kg*m^2"
d = "0.4 m"
h = "0.3 m"
k = "600 N/m"
n = "0.8 m"

[inputs]
P = "N*m"

[define]
s = "sqrt(d^2 + h^2 + 2*d*h*sin(theta))"

[[kinetic]]
name = "bar"
value = "1/2*J*theta'^2"

[[spring]]
name = "strut"
k = "k"
deflection = "s"
rest = "n"

[[torque]]
name = "hand"
value = "P"
on = "theta"
"""


@cache
def derived(description: str) -> Derived:
    """The derivation of a system."""
    return derive_in_form(loads(description).model())


BOB = "m l² θ'' + b l² cos²θ θ' + m g l sin θ = F l cos θ"
TEX = r"m l^2\ddot\theta + b l^2\cos^2\theta\,\dot\theta + m g h = F l\cos\theta"


def accepted(description: str, written: str) -> bool:
    """Whether an answer about a system is right."""
    return check_answer(derived(description), written, hint=0).right


def right(written: str) -> bool:
    """Whether an answer about the bob is right."""
    return accepted(BOB_ON_A_ROD, written)


@pytest.mark.parametrize("bar", ["―", "⎯", "—", "‾", "─", "–"])
def test_a_fraction_is_drawn_with_any_horizontal_line(bar: str) -> None:
    drawn = f"        F cos θ - b l cos²θ θ' - m g sin θ\nθ'' = {bar * 38}\n                       m l"
    assert right(drawn)
    assert not right(drawn.replace("F cos", "F sin"))


@pytest.mark.parametrize("root", ["racine", "Wurzel", "raiz", "radice"])
def test_roots_in_other_languages(root: str) -> None:
    written = f"h = {root}(l² - l² cos²θ)\nm l² θ'' + b l² cos²θ θ' + m g l sin θ = F {root}(l²) cos θ"
    assert right(written)
    assert not right(written.replace("cos θ", "sin θ"))


@pytest.mark.parametrize("length", [r"\overline{AB}", r"\overline{A_1B}", r"\overline{ A_{1}B_{2} }"])
def test_a_line_over_two_points_names_their_distance(length: str) -> None:
    for written in (rf"with $h={length}=l\sin\theta$: $${TEX}$$", f"${length}=l\\sin\\theta$ $${TEX}$$"):
        answer = written if "h=" in written else written.replace("g h", f"g {length}")
        assert right(answer)
        assert not right(answer.replace(r"=l\sin", r"=l\cos"))


def test_a_script_l_that_moves_is_no_constant_l() -> None:
    written = rf"$\ell=l\sin\theta$ and $${TEX}$$".replace("g h", r"g \ell")
    assert right(written)
    assert not right(written.replace(r"\ell=l\sin", r"\ell=l\cos"))
    assert right(rf"$${TEX}$$".replace("g h", r"g \ell\sin\theta").replace("F l", r"F \ell"))


@pytest.mark.parametrize(
    "said",
    [
        "I = m l² = all inertia at the pin",
        "I: all that turns, seen from the pin, = m l²",
        "I: what turns = m l²",
        "I … everything that turns, = m l²",
    ],
)
def test_words_stand_beside_a_value(said: str) -> None:
    written = f"{said}\n{BOB.replace('m l²', 'I')}"
    assert right(written)
    assert not right(written.replace("= m l²", "= 2 m l²"))


def test_a_product_behind_words_and_an_equals_sign_is_a_value() -> None:
    written = "G: the moment of the weight, = ½ m g l\n" + BOB.replace("m g l", "2 G")
    assert right(written)
    assert not right(written.replace("2 G", "G"))


def test_a_formula_in_brackets_is_the_value_of_a_name() -> None:
    written = f"h = distance from the vertical (= l sin θ). Then:\n{BOB.replace('m g l sin θ', 'm g h')}"
    assert right(written)
    assert not right(written.replace("(= l sin θ)", "(= l cos θ)"))


def test_dots_of_a_legend_are_a_colon() -> None:
    head = "my letters:\n - q ... angle of the rod (theta)\n - M ... mass of the bob (m)\n - P ... push (F)\n\n"
    written = head + "M l^2 q'' + b l^2 cos(q)^2 q' + M g l sin(q) = P l cos(q)"
    assert right(written)
    assert not right(written.replace("M g", "2 M g"))


@pytest.mark.parametrize(
    "said",
    [
        "w = theta dot, a = theta double dot",
        "dots: w = theta dot, a = theta two dots",
        "w = theta Punkt; a = theta zwei Punkte",
        "w = theta point; a = theta deux points",
        "w = theta-dot, a = theta ddot",
    ],
)
def test_rates_in_words_have_primes(said: str) -> None:
    written = f"{said}\nm l^2 a + b l^2 cos(theta)^2 w + m g l sin(theta) = F l cos(theta)"
    assert right(written)
    assert not right(written.replace("m g", "2 m g"))


def test_a_name_that_is_also_a_word_of_a_condition_is_a_factor() -> None:
    written = "si=sin(theta), w = theta'\nm l^2 theta''+b l^2 w-b l^2 si^2 w+m g l si w/w=F l cos(theta)"
    assert right(written)
    assert not right(written.replace("+m g", "-m g"))


def test_a_coordinate_in_degrees_is_one_position() -> None:
    assert right(f"{BOB}\nVérification : pour θ = 90° il reste m l² θ'' = -m g l")
    assert right(f"{BOB}\nCheck: for θ = 90° the lever is l, what remains is m l² θ'' = -m g l.")
    assert not right(f"{BOB.replace('+ b', '- b')}\nCheck: for θ = 90° what remains is m l² θ'' = -m g l.")


@pytest.mark.parametrize("blank", ["", " "])
def test_definitions_with_only_a_blank_between_them_are_parted(blank: str) -> None:
    written = (
        f"C{blank}={blank}cos(theta) S{blank}={blank}sin(theta)\nm l^2 theta'' + b l^2 C^2 theta' + m g l S = F l C"
    )
    assert right(written)
    assert not right(written.replace("sin", "cos"))


def test_a_factor_that_is_explained_parts_no_chain() -> None:
    written = "h = l sin(theta)\nK = m g h = m g l sin(theta)\n" + BOB.replace("m g l sin θ", "K")
    assert right(written)
    assert right("K = m g S = m g l sin(theta)\nS is the distance l sin(theta).\n" + BOB.replace("m g l sin θ", "K"))
    assert right("K = m l² = l m l\n" + BOB.replace("m l²", "K"))


@pytest.mark.parametrize(
    "said", ["for all θ*:\n", "Pour tout θ* : ", "für alle θ*: ", "∀ θ*: ", "for all virtual δθ:\n"]
)
def test_for_which_virtual_motions_an_equation_holds_is_no_factor(said: str) -> None:
    assert right(f"{said}{BOB}")
    assert not right(f"{said}{BOB}".replace("+ b", "- b"))


def test_a_word_introduces_a_name_behind_a_sentence() -> None:
    written = "a) Bob about the pin (it rests: no θ'' of it, l θ'^2 inwards). With ω = θ':\n" + BOB.replace("θ''", "ω'")
    assert right(written)
    assert not right(written.replace("ω = θ'", "ω = 2 θ'"))


def test_a_dissipation_function_may_hold_forces_that_resist() -> None:
    written = "T = ½ m x'²\nV = ½ k x²\nD = ½ c x'² + ½ b x'²\nm x'' + (c + b) x' + k x = F"
    assert accepted(DRAGGED, written)
    assert not accepted(DRAGGED, written.replace("½ b", "b"))
    assert not accepted(DRAGGED, written.replace("½ c x'² + ", ""))


@pytest.mark.slow
def test_what_a_length_is_in_numbers_does_not_stand_in_lines_of_letters() -> None:
    letters = "s = sqrt(d² + h² + 2 d h sin θ)\nJ θ'' + k (s - n) d h cos θ/s = P\n"
    numbers = "in numbers: s = sqrt(0.25 + 0.24 sin θ)\n2 θ'' + 72 (1 - 0.8/s) cos θ = P"
    assert accepted(STRUT, letters + numbers)
    assert not accepted(STRUT, letters.replace("(s - n)", "(s + n)") + numbers)
    assert not accepted(STRUT, letters + numbers.replace("72", "70"))
    assert not accepted(STRUT, letters + numbers.replace("0.24", "0.26"))
