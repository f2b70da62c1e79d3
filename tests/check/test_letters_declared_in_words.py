"""Letters of an answer's own that sentences declare, in English and German, also letters that the system has.

Oracle: by hand, two carts on a spring k and a damper c,

    m1 ẍ + k (x − y) + c (ẋ − ẏ) = F,   m2 ÿ + k (y − x) + c (ẏ − ẋ) = 0
"""

from __future__ import annotations

import re
from functools import cache

import pytest
import sympy as sp

from built_in import derivation
from lagrangian import Derivation, ParseError, System
from lagrangian.check.reading import parse_answer

SHEET = "m1*x'' + k*(x - y) + c*(x' - y') = F\nm2*y'' + k*(y - x) + c*(y' - x') = 0"


@cache
def carts() -> Derivation:
    """Two carts, a spring and a damper between them, and a force on the first."""
    sys = System("two carts")
    x, y = sys.coordinates("x y")
    m1, m2, k, c = sys.parameters("m1 m2 k c")
    for name, mass, at in (("one", m1, x), ("two", m2, y)):
        sys.particle(mass, at=sys.point(name, (at, 0)))
    sys.spring(k, deflection=x - y)
    sys.damper(c, deflection=x - y)
    sys.generalized_force(x, sys.input("F"))
    return sys.derive()


def written(letters: dict[str, str]) -> str:
    """The equations of the system in other letters."""
    return re.sub(r"[a-zA-Z]\d?", lambda m: letters.get(m.group(), m.group()), SHEET)


def right(answer: str) -> bool:
    """Whether an answer is judged right; one that is refused is not."""
    try:
        return carts().check(answer, hint=0).right
    except ParseError:
        return False


SAID = {
    "Bezeichnungen: x₁ statt x (Wagen), x₂ statt y, D statt k, d statt c.": {
        "x": "x_1",
        "y": "x_2",
        "k": "D",
        "c": "d",
    },
    "Ich schreibe c statt k und d anstelle von c.": {"k": "c", "c": "d"},
    "My letters: u instead of x for the first cart, w instead of y.": {"x": "u", "y": "w"},
    "Here the spring constant is c (instead of k), and the damping b (instead of c)": {"k": "c", "c": "b"},
    "I write m for the first cart's mass (m1), M for the second one (m2).": {"m1": "m", "m2": "M"},
    "My sheet uses m_2 for the mass m1 of the first cart,\nm_1 for m2 and w for y.": {"m1": "m2", "m2": "m1", "y": "w"},
    "alpha = position of cart 1 (x in the sheet), k_s = stiffness (k), b = damper (c).": {
        "x": "alpha",
        "k": "k_s",
        "c": "b",
    },
    "Notation:\n- u: cart 1 (x)\n- w: cart 2 (y)": {"x": "u", "y": "w"},
    "p und q statt x und y": {"x": "p", "y": "q"},
    "Für k schreibe ich D, statt c schreibe ich d.": {"k": "D", "c": "d"},
    "D stands for k, d steht für c, M denotes the mass m1.": {"k": "D", "c": "d", "m1": "M"},
    "$D$ instead of $k$": {"k": "D"},
    "I write u for x, w for y and D for k.": {"x": "u", "y": "w", "k": "D"},
    "I write $u$ for $x$, $w$ for $y$, $D$ for $k$ and $M_a$ for m1.": {"x": "u", "y": "w", "k": "D", "m1": "M_a"},
    "I write $u$ for the position $x$, $w$ for the position $y$, $D$ for $k$": {"x": "u", "y": "w", "k": "D"},
    "u instead of x, w instead of y, D instead of k": {"x": "u", "y": "w", "k": "D"},
    "Ich schreibe u für x, w für y, D für k und d für c.": {"x": "u", "y": "w", "k": "D", "c": "d"},
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("said", "letters"), SAID.items(), ids=SAID)
def test_declared_letters_are_read(said: str, letters: dict[str, str]) -> None:
    equations = written(letters)
    if "$" in said:
        equations = "\n".join(rf"\[ {x} \]" for x in equations.replace("*", " ").split("\n"))
    answer = f"{said}\n\n{equations}"
    assert right(answer)
    told = " ".join(parse_answer(answer, carts().model).notes)
    assert all(re.search(rf"\bfor {own}\b", told) for own in letters)
    wrong = answer.replace("''", "'", 1)
    assert not right(wrong)


def test_a_letter_has_the_declared_meaning_alone() -> None:
    assert not right("c statt k, d statt c.\n\n" + written({"k": "d", "c": "c"}))
    assert not right("u statt x, w statt y.\n\n" + written({"x": "w", "y": "u"}))
    assert not right("m for the second mass (m2), M for the first (m1).\n\n" + written({"m1": "m", "m2": "M"}))


def test_a_declaration_against_its_own_use_is_told() -> None:
    verdict = carts().check(f"I write c instead of k.\n\n{SHEET}")
    assert "You write that c stands for k" in str(verdict)


def test_what_a_quantity_belongs_to_is_no_other_name() -> None:
    assert right(f"s = stretch of the spring (k), v = speed (x)\n\n{SHEET}")
    assert right(f"T = kinetic energy of cart 1 (m1) and cart 2 (m2)\n\n{SHEET}")


def test_a_relation_in_brackets_is_read() -> None:
    theta = "theta = angle of the wheel (clockwise, x = R*theta)"
    sys = System("cart with a wheel")
    x, R, k, m = sys.coordinates("x"), *sys.parameters("R k m")
    sys.particle(m, at=sys.point("A", (x, 0)))
    sys.spring(k, deflection=x / R)
    derived = sys.derive()
    assert derived.check(f"Coordinate: {theta}.\n\nm R^2 theta'' + k theta = 0", hint=0).right
    assert not derived.check(f"Coordinate: {theta}.\n\nm R^2 theta'' + k R theta = 0", hint=0).right


def test_what_holds_a_name_is_not_its_value() -> None:
    assert right(f"(k heißt hier K, die Federkraft ist K·x)\n\n{SHEET.replace('k', 'K')}")


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said", ["K stands for 2 k.", "K stands for k m1.", "K stands for k (m1 - m2).", "K means sin k."]
)
def test_a_letter_that_stands_for_an_expression_is_none_for_a_name_in_it(said: str) -> None:
    assert not right(f"{said}\n\n{SHEET.replace('k', 'K')}")
    assert "stands for k." not in " ".join(parse_answer(f"{said}\n\n{SHEET.replace('k', 'K')}", carts().model).notes)


def test_a_letter_that_stands_for_a_function_of_an_angle_has_that_value() -> None:
    sheet = "m*L^2*theta'' + b*theta' + m*g*L*p = 0"
    pendulum = derivation("pendulum")
    assert pendulum.check(f"p stands for sin theta.\n{sheet}", hint=0).right
    assert not pendulum.check(f"p stands for cos theta.\n{sheet}", hint=0).right


@pytest.mark.parametrize("said", ["K is twice k.", "K is half of k."])
def test_words_that_change_a_value_do_not_say_that_it_is_one(said: str) -> None:
    notes = parse_answer(f"{said}\n\n{SHEET.replace('k', 'K')}", carts().model).notes
    assert not any("as the words say" in note for note in notes)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("value", ["J + l^2 m", "J + m l^2 in what follows", "the inertia J + m l l", "l m l + J"])
def test_a_value_in_words_ends_with_its_expression(value: str) -> None:
    arm = derivation("dc-motor")
    rows = "K theta' + L q'' + R q' - u = 0\ng l m sin theta - K q' + b theta' + eta theta'' = 0"
    assert arm.check(f"I write eta for {value}.\n\n{rows}", hint=0).right
    assert not arm.check(f"I write eta for {value.replace('J', '2 J')}.\n\n{rows}", hint=0).right


def test_a_letter_of_the_answer_is_given_names_before_units() -> None:
    """2 m are two masses, not two metres, where the system has a mass m; a parameter of the system is given units."""
    arm = derivation("dc-motor")
    rows = "K theta' + L q'' + R q' - u = 0\ng l M/2 sin theta - K q' + b theta' + (J + m l^2) theta'' = 0"
    assert arm.check(f"M = 2 m\n{rows}", hint=0).right
    assert not arm.check(f"M = 2 l\n{rows}", hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said", ["tan β = b/(m g L)", "with sin(β) = b/√(b² + m² g² L²) and so on", r"$\tan\beta = \frac{b}{mgL}$"]
)
def test_an_angle_is_what_its_tangent_or_its_sine_says(said: str) -> None:
    row = "(m L² θ'' + m g L sin θ) cos β + m g L θ' sin β = 0"
    if "$" in said:
        row = r"$(m L^2 \ddot\theta + m g L \sin\theta)\cos\beta + m g L \dot\theta \sin\beta = 0$"
    assert derivation("pendulum").check(f"{row}\n{said}", hint=0).right
    assert not derivation("pendulum").check(f"{row}\n{said.replace('b/', '2 b/').replace('{b}', '{2b}')}", hint=0).right


def test_a_tangent_between_two_slopes_does_not_say_what_the_angle_is() -> None:
    said = "tan β = db/dm = b/(m g L), sin β = b/√(b² + m² g² L²)"
    assert derivation("pendulum").check(f"(m L² θ'' + m g L sin θ) cos β + m g L θ' sin β = 0\n{said}", hint=0).right


def test_a_condition_says_nothing_of_a_letter() -> None:
    with pytest.raises(ParseError, match="what is 'N'"):
        derivation("pendulum").check("Let N be the push on it (for θ > 0).\nm L² θ'' + b θ' + m g L sin N = 0")


def test_a_greek_letter_in_a_formula_is_not_split_at_a_word_of_the_sentence() -> None:
    """theta is no the·t·a, where the system has an a and a sentence says the."""
    sys = System("pendulum")
    phi, m, a = sys.coordinate("phi"), sys.parameter("m"), sys.parameter("a")
    sys.particle(m, at=sys.point("bob", (a * sp.sin(phi), -a * sp.cos(phi))))
    sys.gravity((0, -1))
    swing, row = sys.derive(), "m*a^2*theta'' + m*g*a*sin(theta) = 0"
    assert swing.check(f"I call the angle of the rod theta.\n{row}", hint=0).right
    assert not swing.check(f"I call the angle of the rod theta.\n{row.replace('g', '2*g')}", hint=0).right


@pytest.mark.parametrize(
    "said",
    [
        "With G for m1 + m2 the energy is",
        "Writing G for m1 + m2, we get",
        "With the abbreviation G for m1 + m2:",
        "Denote m1 + m2 by G.",
    ],
)
def test_a_letter_for_a_sum_is_read(said: str) -> None:
    answer = f"{said}\nT = G x'^2/2 + m2 (y'^2 - x'^2)/2\n{SHEET}"
    assert carts().check(answer, hint=0).right
    assert not carts().check(answer.replace("m1 + m2", "m1 + 2 m2"), hint=0).right


def test_powers_and_products_without_signs_stand_in_such_a_sum() -> None:
    pendulum = derivation("pendulum")
    answer = "With I for mL² the equation is\nI theta'' + b theta' + m g L sin(theta) = 0"
    assert pendulum.check(answer, hint=0).right and not pendulum.check(answer.replace("mL²", "2 mL²"), hint=0).right


def test_a_direction_is_no_value() -> None:
    """H is the friction in $+x$: H is not x."""
    answer = "The friction $H$ acts on the cart, it is counted in $SIGNx$.\n$$m_1 \\ddot x = F - k (x - y) - H$$\n"
    rows = (
        r"$$m_1\ddot x + k (x - y) + c(\dot x - \dot y) = F$$"
        "\n"
        r"$$m_2 \ddot y + k (y - x) + c (\dot y - \dot x) = 0$$"
    )
    for sign in ("+", "-"):
        assert carts().check(answer.replace("SIGN", sign) + rows, hint=0).right


RATES = """(M + m) x2 + m l cos(theta) p2 - m l sin(theta) p1^2 + b x1 = F
(J + m l^2) p2 + m l cos(theta) x2 - m g l sin(theta) = 0"""


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "legend",
    [
        "x1, x2 are the first and second derivative of x, p1, p2 those of theta",
        "x1, x2 = first and second derivative of x; p1, p2 of theta",
        "Legend: x1 and x2: velocity and acceleration of x, p1 and p2 of theta.",
        "Here x1 = dx/dt, x2 = d^2x/dt^2 and p1, p2 likewise for theta.",
        "(x1, x2: velocity and acceleration of x; p1, p2: angular velocity and angular acceleration of theta)",
    ],
)
def test_two_names_for_the_rate_and_the_acceleration_of_a_coordinate(legend: str) -> None:
    pole = derivation("cart-pole")
    assert pole.check(f"{legend}\n{RATES}", hint=0).right
    assert not pole.check(f"{legend}\n{RATES.replace('p1^2', 'x1^2')}", hint=0).right
    assert not pole.check(
        f"{legend.replace('x1', 'y1').replace('x2', 'x1').replace('y1', 'x2')}\n{RATES}", hint=0
    ).right
    assert not pole.check(f"{legend}\n{RATES.replace('+ b x1', '- b x1')}", hint=0).right


LATEX_COMMENTS = r"""import sympy as sp
x, th = sp.symbols('x theta', cls=sp.Function)
# (M+m)\ddot{x} + m l \ddot{\theta}\cos\theta - m l \dot{\theta}^2\sin\theta + b\dot{x} = F
# (J+m l^2)\ddot{\theta} + m l \ddot{x}\cos\theta - m g l \sin\theta = 0
print("done")"""


def test_latex_in_comments_of_a_program_is_read_where_no_other_line_is_an_equation() -> None:
    pole = derivation("cart-pole")
    verdict = pole.check(LATEX_COMMENTS)
    assert verdict.right and any("though it is a comment" in str(note) for note in verdict.notes)
    assert not pole.check(LATEX_COMMENTS.replace(r"+ b\dot", r"- b\dot"), hint=0).right
    energies = r"T = \frac{1}{2} (M+m) \dot x^2" + "\n" + LATEX_COMMENTS.replace("#", "%").partition("\n% ")[2]
    assert not pole.check(energies, hint=0).right


SOLVED = """xdd = ((J+m*l^2)*(F - b*xd + m*l*thetad^2*sin(theta)) - m^2*l^2*g*sin(theta)*cos(theta))/Delta
thetadd = ((M+m)*m*g*l*sin(theta) - m*l*cos(theta)*(F - b*xd + m*l*thetad^2*sin(theta)))/Delta
% where Delta = (M+m)*(J+m*l^2) - m^2*l^2*cos(theta)^2"""


@pytest.mark.slow
def test_a_comment_may_say_what_a_name_is_that_nothing_else_defines() -> None:
    pole = derivation("cart-pole")
    assert pole.check(SOLVED, hint=0).right
    assert not pole.check(SOLVED.replace(") - m^2*l^2*cos", ") + m^2*l^2*cos"), hint=0).right
    defined = f"Delta = (M+m)*(J+m*l^2) - (m*l*cos(theta))^2\n{SOLVED.partition('%')[0]}"
    assert pole.check(f"{defined}% Delta = (M+m)*(J+m*l^2)", hint=0).right
    assert not pole.check(f"{defined.replace(') - (m', ') + (m')}% Delta = (M+m)*(J+m*l^2)", hint=0).right
