"""Answers that say in words, marks, tables and legends what their names are, each beside a wrong one in the same form.

Oracle: by hand, from the equations of small systems.
"""

from __future__ import annotations

import pytest
from small_systems import geared, mass, pendulum, rod

import lagrangian as lg
from lagrangian.errors import ParseError

PUCK = "m r'' - m r phi'^2 + k (r - a) = 0"


def is_right(answer: str, of: lg.Derivation) -> bool:
    """Whether an answer is right; not one of which something is asked."""
    try:
        return of.check(answer).right
    except ParseError:
        return False


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("answer", "slip"),
    [
        pytest.param("c* stands for b/m.\n\nx'' + c*·x' + k x/m = F/m", ("b/m", "2 b/m"), id="a star in words"),
        pytest.param(
            "The law is m x'' = F - K - D.\nHere K is k*(x + 0), and D stands for b*x'.",
            ("k*(x + 0)", "2*k*x"),
            id="a letter in the other case",
        ),
        pytest.param(
            "I count from rest: x = x0 + x1 with k x0 = F0. Let F = F0 + F1.\nm x1'' + b x1' + k x1 = F1",
            ("k x0", "2 k x0"),
            id="deviations from rest",
        ),
        pytest.param(
            "m x^.. + b x^. + k x = F\nx^. means the velocity, x^.. the acceleration, and so on",
            ("+ b", "- b"),
            id="dots as exponents",
        ),
        pytest.param(
            "| coordinate | inertia | = forces |\n|---|---|---|\n| x | m x'' | F - b x' - k x |",
            ("- k", "+ k"),
            id="a table with the sides in its head",
        ),
        pytest.param(
            "| mass | left |  | right |\n|---|---|---|---|\n| cart | m x'' | = | F - b x' - k x |",
            ("- k", "+ k"),
            id="a table with a column of equals signs",
        ),
        pytest.param(
            "Let $x$ be the way and write $m_1$ for the mass, $m_2$ for the damper and $m_3$ for the spring "
            "($m$, $b$, $k$ on the sheet).\n\\[m_1\\ddot x + m_2\\dot x + m_3 x = F\\]",
            ("m_2\\dot x + m_3 x", "m_3\\dot x + m_2 x"),
            id="letters for things, and their names in brackets",
        ),
        pytest.param(
            "\\begin{align*}\n\\intertext{Forces:}\nP &= -b\\dot x - kx\n\\intertext{and the mass}\nN &= m\n"
            "\\intertext{so}\nN\\ddot x &= P + F\n\\end{align*}",
            ("- kx", "+ kx"),
            id="words between rows",
        ),
    ],
)
def test_explained_names_of_a_mass(answer: str, slip: tuple[str, str]) -> None:
    assert answer.count(slip[0]) == 1
    assert is_right(answer, mass())
    assert not is_right(answer.replace(*slip), mass())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("answer", "slip"),
    [
        pytest.param(
            f"I(r) phi'' + 2 m r r' phi' = M\nI(r) ... moment of inertia about the pin, J + m*r^2\n{PUCK}",
            ("J + m*r^2", "J + 2*m*r^2"),
            id="a function in a legend",
        ),
        pytest.param(
            "(J + m r^2) phipp + 2 m r rp phip = M\nm rpp - m r phip^2 + k (r - a) = 0",
            ("2 m r", "m r"),
            id="p for points",
        ),
        pytest.param(
            "(J + m r^2) tdd + 2 m r rd td = M     (t = phi, td, rd, tdd, rdd their derivatives)\n"
            "m rdd - m r td^2 + k (r - a) = 0",
            ("2 m r", "m r"),
            id="t for an angle",
        ),
        pytest.param(
            "Θ φ̈ + Θ′ ṙ φ̇ = M\nm r̈ − ½ Θ′ φ̇² + k (r − a) = 0\nwith:\n - Θ = J + m r²\n"
            " - Θ′ = 2 m r (derivative with respect to r)",
            ("Θ′ = 2 m r", "Θ′ = m r"),
            id="a prime that is no rate",
        ),
        pytest.param(
            f"The rod pushes the puck with A at the lever r.\nJ phi'' = M - A r\nm (r phi'' + 2 r' phi') = A\n{PUCK}",
            ("2 r'", "r'"),
            id="a force at a lever",
        ),
    ],
)
def test_explained_names_of_a_puck_on_a_rod(answer: str, slip: tuple[str, str]) -> None:
    assert answer.count(slip[0]) == 1
    assert is_right(answer, rod())
    assert not is_right(answer.replace(*slip), rod())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("answer", "slip"),
    [
        pytest.param(
            "A φ̈ + C φ̇ + G(φ) = M\nwith A = m l², C = b, G = m g l sinφ", ("sinφ", "cosφ"), id="a function of an angle"
        ),
        pytest.param(
            "m*l^2*phi'' + b*phi' + K = M\nK ... moment of the weight, (m*g)*l*sin(phi)",
            ("l*sin", "2*l*sin"),
            id="a formula that begins with a bracket",
        ),
        pytest.param(
            "x1 = phi\nx2 = phi'\nR = l cos(x1)\nx1' = x2\nx2' = (M - b x2 - m g R tan(x1))/(m l^2)",
            ("- m g", "+ m g"),
            id="a lever arm of states that is no dissipation",
        ),
        pytest.param("m l² φ̈ + b φ̇ + U′ = M\nU′ = m g l sin φ", ("sin φ", "cos φ"), id="the slope of an energy"),
    ],
)
def test_explained_names_of_a_pendulum(answer: str, slip: tuple[str, str]) -> None:
    assert answer.count(slip[0]) == 1
    assert is_right(answer, pendulum())
    assert not is_right(answer.replace(*slip), pendulum())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "answer",
    [
        "m l² n² φ̈ + b φ̇ + k φ + m g l n sin nφ = M",
        "m l^2 n^2 phi'' + b phi' + k phi + m g l n sin n phi = M",
        r"$m l^2 n^2\ddot\varphi + b\dot\varphi + k\varphi + mgln\sin n\varphi = M$",
    ],
)
def test_the_multiple_of_an_angle_without_brackets(answer: str) -> None:
    """sin n φ is sin(n φ) where the system turns by n φ, and the factor in front of it is still judged."""
    assert is_right(answer, geared())
    assert not is_right(answer.replace("l n sin", "l sin").replace(r"mgln\sin", r"mgl\sin"), geared())
    assert not is_right(answer.replace("sin", "cos"), geared())


def test_the_sine_of_a_constant_times_a_coordinate_stays_a_product() -> None:
    """m g x sin α may be written m g sin α x where α is the angle of a slope."""
    s = lg.System("cart on a slope")
    x, alpha = s.coordinate("x"), s.parameter("alpha")
    m, g, k = s.parameters("m g k")
    up = s.frame(alpha, name="slope")
    s.particle(m, at=up.point(x, 0), name="cart")
    s.gravity((0, -1), g)
    s.spring(k, deflection=x)
    d = s.derive()
    assert d.check("T = m x'^2/2\nV = m g sin alpha x + k x^2/2").right
    assert not d.check("T = m x'^2/2\nV = m g cos alpha x + k x^2/2").right


def test_a_kilogram_is_no_product_of_a_stiffness_and_gravity() -> None:
    numbers = "Inertia about the pin 4 + 0.5 = 4.5 kg m².\n4.5 φ'' + 0.1 φ' + 4 φ + 29.43 sin(3 φ) = M"
    assert is_right(numbers, geared())
    assert not is_right(numbers.replace("29.43", "9.81"), geared())
    assert not is_right(numbers.replace("0.5 =", "0.7 ="), geared())
    assert is_right("m l² n² = 4.5 kg m²\nm l² n² φ'' + b φ' + k φ + m g l n sin(n φ) = M", geared())


@pytest.mark.parametrize(
    "legend",
    [
        "v ... speed of the mass, m/s",
        "x ... way of the mass, from the wall",
        "b ... damper of the oil, N*s/m",
        "P ... force of the hand, in newtons",
    ],
)
def test_a_legend_without_a_formula_says_no_value(legend: str) -> None:
    assert is_right(f"m x'' + b x' + k x = F\n{legend}", mass())
    assert not is_right(f"m x'' + b x' - k x = F\n{legend}", mass())


def test_a_unit_in_brackets_with_a_power_is_no_factor() -> None:
    row = "A = m l² n², D = A²\nD φ'' + A (b φ' + k φ + m g l n sin(n φ)) = A M\n"
    for unit in ("(kg m²)²", "(kg·m^2)^2", "(N m s²)²"):
        verdict = geared().check(f"{row}Numbers: A = 4.5 kg m², D = 20.25 {unit}.")
        assert verdict.right, str(verdict)
        assert all(f.status.right for f in verdict.findings), str(verdict)
        assert not is_right(f"{row.replace('+ k', '- k')}Numbers: D = 20.25 {unit}.", geared())


CRANK = """
name = "crank"
[coordinates]
alpha = "angle of the crank"
[parameters]
J = "2 kg*m^2"
c = "3 N*m*s"
r = "0.5 m"
k = "7 N/m"
n = "3"
[inputs]
Q = "N*m"
[[kinetic]]
name = "crank"
value = "J*alpha'^2/2"
[[spring]]
k = "k"
deflection = "r*alpha"
[[damper]]
b = "c"
deflection = "n*alpha"
[[torque]]
value = "Q"
on = "alpha"
"""


def test_a_word_of_the_description_in_brackets_is_no_product() -> None:
    crank = lg.loads(CRANK).derive()
    answer = "so a = alpha (crank) and everything else like on the sheet\nJ a'' + c n^2 a' + k r^2 a = Q"
    assert crank.check(answer).right
    assert not crank.check(answer.replace("n^2", "n")).right
    assert crank.check(answer.replace("a = alpha (crank) and", "a = alpha (crank),")).right
    product = "J alpha'' + c n^2 alpha' = Q - F\nF = alpha (k r^2)"
    assert crank.check(product).right
    assert not crank.check(product.replace("k r^2", "k r")).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "where NAME is short for m l².",
        "NAME is an abbreviation for m l²",
        "where NAME is the product m l²",
        "Here NAME is shorthand for l² m.",
        "(NAME is m l²)",
        "(where NAME stands for m l²)",
        "NAME ist kurz für m l².",
        "I write the equation shortly: NAME is used for m l².",
        "NAME denotes m l²; it is the moment of inertia.",
    ],
)
@pytest.mark.parametrize("name", ["S", "J*"])
def test_a_name_that_words_say_to_be_short_for_a_formula(said: str, name: str) -> None:
    """With a star the name stays one: J* φ'' is no product of J."""
    answer = f"{name} φ'' + b φ' + m g l sin φ = M\n\n{said.replace('NAME', name)}".replace("S φ", "S*φ")
    assert is_right(answer, pendulum())
    for slip in ("2 m", "m² "):
        assert not is_right(answer.replace("m l²", f"{slip} l²").replace("l² m", f"l² {slip}"), pendulum())


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", ["φ = π also.", "φ = pi is unstable.", "Rest at φ = 0; φ = π as well.", "also φ = π."])
def test_pi_is_no_momentum(said: str) -> None:
    """Not that of φ, whose name ends with i; p_φ is one."""
    assert is_right(f"m l² φ'' + b φ' + m g l sin φ = M\n\n{said}", pendulum())
    assert is_right(f"p_φ = m l² φ'\nm l² φ'' + b φ' + m g l sin φ = M\n\n{said}", pendulum())
    assert not is_right(f"p_φ = 2 m l² φ'\nm l² φ'' + b φ' + m g l sin φ = M\n\n{said}", pendulum())
    assert not is_right(f"m l² φ'' + b φ' - m g l sin φ = M\n\n{said}", pendulum())


@pytest.mark.parametrize(
    "answer",
    [
        "p = m* φ'           m* = m l²\np' + b φ' + m g l sin φ = M",
        "m* = m l², p = m* φ'\np' + b φ' + m g l sin φ = M",
        "m* φ'' + b φ' + m g l sin φ = M   (m* = m l²)",
        "| m* = m l² |\nm* φ'' + b φ' + m g l sin φ = M",
        "m* := m l²\nm*φ'' + b φ' + m g l sin φ = M",
        "m l² =: m*\nm* φ'' + b φ' + m g l sin φ = M",
        "m l² = m*\nm* φ'' + b φ' + m g l sin φ = M",
    ],
)
def test_a_name_of_the_system_with_a_star_that_is_defined_anywhere_on_a_line(answer: str) -> None:
    assert is_right(answer, pendulum())
    assert not is_right(answer.replace("m l²", "2 m l²"), pendulum())
    assert not is_right(answer.replace("sin φ", "sin(φ)²"), pendulum())


def test_a_star_that_is_a_product_beside_a_name_with_a_star() -> None:
    assert is_right("m* = l^2\nm m* φ'' + b*φ' + m*g*l*sin φ = M", pendulum())
    assert not is_right("m* = l^2\nm*φ'' + b*φ' + m*g*l*sin φ = M", pendulum())
    assert is_right("m l² φ'' + b φ' + m g l sin φ = M*", pendulum()) is False


@pytest.mark.parametrize(
    "said",
    [
        "J_t about the pin: m l²",
        "J_t on shaft 1: m l²   (l from the pin)",
        "J_t (about the pin): m l².",
        "J_t, all that turns: m l²",
        "- J_t about the pin = m l²",
        "J_t about pin 1 is m l².",
    ],
)
def test_a_name_with_words_and_a_colon_has_the_formula_behind_it(said: str) -> None:
    answer = f"{said}\nJ_t φ'' + b φ' + m g l sin φ = M"
    assert is_right(answer, pendulum())
    assert not is_right(answer.replace("m l²", "2 m l²"), pendulum())
    assert not is_right(answer.replace("J_t φ''", "2 J_t φ''"), pendulum())
