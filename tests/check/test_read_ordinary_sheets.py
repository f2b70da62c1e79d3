"""Ordinary sheets of students: products and brackets without signs, names of their own behind functions and indices,
points by their components, and declarations in words.

Oracle: by hand, a door on springy hinges with a lamp on a thread (a plank that swings with a hanging lamp), without
friction:

    (J + m a²) α̈ + m a l sin(α − β) β̈ − m a l cos(α − β) β̇² − m g a cos α + k α = τ
    m l² β̈ + m a l sin(α − β) α̈ + m a l cos(α − β) α̇² + m g l sin β = 0

with the lamp at x = −a cos α + l sin β, y = −a sin α − l cos β. Every form has a wrong twin.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

from lagrangian import Derivation, System

PLANK = "(J + m a^2) α'' + m a l sin(α - β) β'' - m a l cos(α - β) β'^2 - m g a cos α + k α = τ"
LAMP = "m l^2 β'' + m a l sin(α - β) α'' + m a l cos(α - β) α'^2 + m g l sin β = 0"
PLACE = "r = (-a cos α + l sin β, -a sin α - l cos β)"


@cache
def plank() -> Derivation:
    """A plank on a spring with a lamp on a thread at its end."""
    sys = System("plank with a lamp on a thread")
    alpha, beta = sys.coordinate("alpha"), sys.coordinate("beta")
    m, a, l, J, k = sys.parameters("m a l J k", m=2, a=0.8, l=0.5, J=1.5, k=90)
    (t,) = alpha.args
    sys.kinetic(J * alpha.diff(t) ** 2 / 2)
    lamp = sys.point("P", (-a * sp.cos(alpha) + l * sp.sin(beta), -a * sp.sin(alpha) - l * sp.cos(beta)))
    sys.particle(m, at=lamp)
    sys.gravity()
    sys.spring(k, deflection=alpha)
    sys.generalized_force(alpha, sys.input("tau"))
    return sys.derive()


def right(text: str) -> bool:
    """Whether an answer to the plank is right."""
    return plank().check(text, hint=0).right


def told(text: str) -> list[str]:
    """What is told beside the lines of an answer to the plank, which is right."""
    verdict = plank().check(text)
    assert verdict.right, verdict.to_text()
    return [str(x) for x in verdict.notes]


def test_the_equations_are_right() -> None:
    assert right(f"{PLANK}\n{LAMP}")
    assert not right(f"{PLANK}\n{LAMP.replace('+ m g l', '- m g l')}")


WORK = """\
{place}
δr = (a sin α δα + l cos β δβ, -a cos α δα + l sin β δβ)
w = (a sin α α'' + a cos α α'^2 + l cos β β'' - l sin β β'^2, -a cos α α'' + a sin α α'^2 + l sin β β'' + l cos β β'^2)
m w·δr = m [a^2 α'' + a l sin(α - β) β'' - a l cos(α - β) β'^2] δα + m [l^2 β'' + a l sin(α - β) α''\
 + a l cos(α - β) α'^2] δβ
"""


@pytest.mark.slow
def test_a_dot_product_of_rows_is_a_number() -> None:
    work = WORK.format(place=PLACE)
    assert right(f"{work}\n{PLANK}\n{LAMP}")
    assert not right(f"{work}\n{PLANK}\n{LAMP.replace('+ m g l', '- m g l')}")
    assert right(f"{PLACE}\nv = r'\nT = 1/2 m v·v + 1/2 J α'^2\n{PLANK}\n{LAMP}")
    assert not right(f"{PLACE}\nv = r'\nT = m v·v + 1/2 J α'^2\n{PLANK}\n{LAMP}")


def test_a_wrong_virtual_displacement_of_a_point_is_not_passed_over() -> None:
    wrong = WORK.format(place=PLACE).split("\n")[1].replace("+ l cos β", "- l cos β")
    notes = told(f"{PLACE}\n{wrong}\n{PLANK}\n{LAMP}")
    assert any("virtual displacements" in x for x in notes)
    notes = told(f"{PLACE}\n{WORK.format(place=PLACE).splitlines()[1]}\n{PLANK}\n{LAMP}")
    assert not any("virtual displacements" in x for x in notes)


def test_a_cross_product_of_rows_in_the_plane_is_its_component_out_of_it() -> None:
    moment = "N = (0, -m g)\np = (-a cos α, -a sin α)\np × N = m g a cos α"
    assert right(f"{moment}\n{PLANK}\n{LAMP}")
    assert not right(f"{moment.replace('= m g a', '= -m g a')}\n{PLANK}\n{LAMP}")


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "inertia",
    [
        "[J + 3m a²/2 − m a² (1 − cos 2α)/2 − (m a²) ½ cos 2α]",
        "[J + m a² sin² α + m a² cos² α]",
        "[J + 2 m a² − (m a²) cos 0]",
        "[J + m a² (sin 1)² + (m a²) cos² 1]",
    ],
)
def test_a_square_bracket_around_a_sum_is_no_row_of_a_matrix(inertia: str) -> None:
    rest = PLANK.split("α''", 1)[1]
    assert right(f"{inertia} α'' {rest}\n\n{LAMP}")
    assert not right(f"{inertia.replace('J', '2 J')} α'' {rest}\n\n{LAMP}")


def test_a_matrix_with_functions_and_blanks_is_still_one() -> None:
    mass = "[J+m*a^2 m*a*l*sin(α-β); m*a*l*sin(α-β) m*l^2]"
    rest = "[-m*a*l*cos(α-β)*β'^2-m*g*a*cos(α)+k*α; m*a*l*cos(α-β)*α'^2+m*g*l*sin(β)]"
    assert right(f"{mass}*[α''; β''] + {rest} = [τ; 0]")
    assert not right(f"{mass}*[α''; β''] + {rest} = [-τ; 0]")


NEWTON = """\
x'' = a sin α α'' + a cos α α'^2 + l cos β β'' - l sin β β'^2
y'' = -a cos α α'' + a sin α α'^2 + l sin β β'' + l cos β β'^2
m x'' = Fx
m y'' = Fy - m g
- l cos β Fx - l sin β Fy = 0
J α'' = -k α + τ + a cos α Fy - a sin α Fx
"""


@pytest.mark.sampled(6)
@pytest.mark.parametrize(("first", "second"), [("Fx", "Fy"), ("Sa", "Sb"), ("FH", "FV"), ("Hx", "Hy")])
def test_a_force_of_ones_own_stands_behind_the_argument_of_a_function(first: str, second: str) -> None:
    rows = NEWTON.replace("Fx", first).replace("Fy", second)
    assert right(rows)
    assert not right(rows.replace("- m g", "+ m g"))


def test_a_name_with_an_index_of_one_letter_stands_in_front_of_letters_in_latex() -> None:
    head = r"With $D_s = J + ma^2$, $c_b = mal$, $R_2 = \tau - k\alpha$:"
    one = r"$D_s\ddot\alpha + c_b\sin(\alpha-\beta)\ddot\beta - c_b\cos(\alpha-\beta)\dot\beta^2 - mga\cos\alpha = R_2$"
    two = r"$ml^2\ddot\beta + c_b\sin(\alpha-\beta)\ddot\alpha + c_b\cos(\alpha-\beta)\dot\alpha^2 = -mgl\sin\beta$"
    product = one.replace("D_s", "D_sl").replace("c_b", "c_bl").replace("mga", "c_bg").replace("R_2", "lR_2")
    for form in (one, product):
        assert right(f"{head}\n{form}\n{two}")
        assert not right(f"{head}\n{form.replace('R_2', '2R_2')}\n{two}")


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "α = plank angle, k = spring stiffness, τ pushes the plank down",
        "α = plank angle",
        "plank angle = α",
        "β = angle thread - vertical, α = angle below the horizontal",
        "α = Winkel Brett - Horizontale, β = Fadenwinkel",
        "`α` = plank angle, `β` = thread angle",
        "Given: m, a, l = lengths, k = spring stiffness, J = plank inertia",
        "1. coordinates: `α` (plank, + = down), `β` (thread, + = right)",
        "Coordinates are α (positive: down) and β.",
        "plank of length a, thread of length l, lamp m at the end.",
        "thread angle β, plank angle α",
        "Equations of motion: left side = right side.",
        "f = 2 degrees of freedom",
        "2 DOF, q = (α, β)",
        "The thread has length l and carries the lamp m",
        "(angle α counts positive when the plank goes down)",
        "Step 1: α, β.",
    ],
)
def test_words_that_state_no_mathematics_cause_no_notice(said: str) -> None:
    assert told(f"{said}\n\n{PLANK}\n{LAMP}") == []
    assert not right(f"{said}\n\n{PLANK}\n{LAMP.replace('+ m g l', '- m g l')}")


@pytest.mark.parametrize(
    "said",
    [
        "E = plank energy, W = m g a plus the work of the spring",
        "inertia force = spring force",
        "velocity of the lamp = velocity of the plank's end + swing",
        "α = twice the plank angle",
        "J is the inertia m a^2/3 times three",
    ],
)
def test_mathematics_in_words_is_told_and_no_line_twice(said: str) -> None:
    notes = told(f"{said}\n\n{PLANK}\n{LAMP}")
    assert notes
    assert sum(x.startswith("Line 1 ") for x in notes) <= 1


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "said",
    [
        "The other spring is relaxed when α = 2 β.",
        "At α = l β/a nothing is stretched, the thread is unstressed.",
        "unstretched: α = β/2",
        r"The spring is relaxed for $\alpha = \frac{l\beta}{a}$.",
    ],
)
def test_where_a_spring_is_relaxed_is_no_equation_of_every_motion(said: str) -> None:
    rows = f"{PLANK}\n{LAMP}"
    if "$" in said:
        rows = r"$(J + m a^2)\ddot\alpha + mal\sin(\alpha-\beta)\ddot\beta - mal\cos(\alpha-\beta)\dot\beta^2"
        rows += r" - mga\cos\alpha + k\alpha = \tau$ and $ml^2\ddot\beta + mal\sin(\alpha-\beta)\ddot\alpha"
        rows += r" + mal\cos(\alpha-\beta)\dot\alpha^2 + mgl\sin\beta = 0$"
    assert any("relaxed" in x for x in told(f"{said}\n\n{rows}"))
    without = said.replace("relaxed", "here").replace("unstressed", "here").replace("unstretched", "here")
    assert not right(f"{without}\n\n{rows}")


def test_a_sine_written_onto_its_angle_is_no_unit() -> None:
    assert not any("0.00" in x for x in told(f"x = 2l cosα, so nothing\n\n{PLANK}\n{LAMP}"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "h = lamp drop = a sin α + l cos β",
        "α = plank drop angle (down +), h = lamp drop = a sin α + l cos β",
        "h = drop of the lamp = a sin α + l cos β, S1 and S2 = thread forces",
    ],
)
def test_a_side_in_words_stands_beside_other_words(said: str) -> None:
    energies = "V = -m g h + k α²/2 (+ a constant)"
    verdict = plank().check(f"{said}\n{energies}\n{PLANK}\n{LAMP}")
    assert verdict.right
    assert not verdict.notes
    assert any(f.line.kind == "V" for f in verdict.findings)
    assert not right(f"{said}\n{energies.replace('-m g h', 'm g h')}\n{PLANK}\n{LAMP}")


def test_an_energy_behind_its_name_has_letters_that_stand_behind_a_comma() -> None:
    swings = "m a² α'²/2 + m l² β'²/2 + m a l sin(α - β) α' β'"
    text = f"kinetic energy: 1/2 I α'² + 1/2 m l² β'² + m a l sin(α - β) α' β',  I = J + m a²\n{PLANK}\n{LAMP}"
    verdict = plank().check(text)
    assert verdict.right
    assert any(f.line.kind == "T" for f in verdict.findings), verdict.to_text()
    assert not right(text.replace("I = J", "I = 2 J"))
    assert right(f"kinetic energy: {swings} + J α'²/2\n{PLANK}\n{LAMP}")


@pytest.mark.slow
def test_a_component_beside_another_is_no_product_of_names_of_the_system() -> None:
    sys = System("sledge on springs that carries a hanging mass")
    z, phi = sys.coordinate("z"), sys.coordinate("phi")
    M, m, l, k, F = *sys.parameters("M m l k", M=3, m=1, l=0.5, k=80), sys.input("F")
    sys.particle(M, at=sys.point("A", (0, z)))
    sys.particle(m, at=sys.point("B", (l * sp.cos(phi), z + l * sp.sin(phi))))
    sys.gravity()
    sys.spring(k, deflection=z)
    sys.generalized_force(z, F)
    derived = sys.derive()
    rows = """m (z'' + l φ'' cos φ - l φ'^2 sin φ) = Fz - m g
m (-l φ'' sin φ - l φ'^2 cos φ) = Fx
M z'' = F - Fz - M g - k z
0 = Fz cos φ - Fx sin φ"""
    assert derived.check(rows, hint=0).right
    assert not derived.check(rows.replace("F - Fz", "F + Fz"), hint=0).right
    assert not derived.check(rows.replace("- k z", "+ k z"), hint=0).right


def test_a_name_behind_words_is_given_a_value() -> None:
    rows = "x1' = x3\nx2' = x4\nm l x4' + m a sin(x1 - x2) x3' + m a cos(x1 - x2) x3^2 = -m g sin x2\n"
    rows += "(J + m a^2) x3' + m a l sin(x1 - x2) x4' - m a l cos(x1 - x2) x4^2 - m g a cos x1 = τ - k x1"
    said = "As a first-order system with x1 = α, x2 = β, x3 = α', x4 = β':"
    verdict = plank().check(f"{PLANK}\n{LAMP}\n\n{said}\n{rows}")
    assert verdict.right, verdict.to_text()
    assert not right(f"{PLANK}\n{LAMP}\n\n{said}\n{rows.replace('- m g a', '+ m g a')}")
    assert not right(f"{PLANK}\n{LAMP}\n\n{said.replace('x1 = α, x2 = β', 'x1 = β, x2 = α')}\n{rows}")


@cache
def windlass() -> Derivation:
    """A load on a rope that runs off a drum, with a multiplier."""
    s = System("windlass")
    x, phi = s.coordinates("x phi")
    m, J, r, g = s.parameters("m J r g")
    s.kinetic(m * x.diff() ** 2 / 2 + J * phi.diff() ** 2 / 2)
    s.potential(-m * g * x)
    s.torque(s.input("M"), on=phi)
    s.constraint(x - r * phi, name="rope")
    return s.derive()


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "words", ["{}, the rope has no stretch", "The rope runs without stretch: {}", "{}, unstretched"]
)
def test_a_relation_of_a_rope_is_no_position_at_rest(words: str) -> None:
    rows = "m x'' = m g - S\nJ phi'' = M + S r\n"
    assert windlass().check(rows + words.format("x = r phi")).right
    assert not windlass().check(rows + words.format("x = 2 r phi")).right


def test_a_generalized_force_beside_one_of_no_coordinate_is_judged() -> None:
    """Q_y = 0 does not make Q_x the component of a force, if nothing uses both."""
    s = System("cart")
    x = s.coordinate("x")
    m, k, c = s.parameters("m k c")
    s.particle(m, at=s.point("P", (x, 0)), name="cart")
    s.spring(k, deflection=x)
    s.damper(c, deflection=x)
    s.force(s.input("F"), deflection=x)
    cart, energies = s.derive(), "\nT = m x'^2/2\nV = k x^2/2"
    assert cart.check("Q_x = F - c x'\nQ_y = 0" + energies).right
    assert not cart.check("Q_x = F + c x'\nQ_y = 0" + energies).right
    assert not cart.check("Xi_x = 2 F - c x'\nXi_y = 0" + energies).right
