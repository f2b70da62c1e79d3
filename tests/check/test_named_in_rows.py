"""A slip in what one equation is solved for, and equations that are written more than once or beside other lines."""

from __future__ import annotations

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from lagrangian.model import time
from student_answers import told

CART = "(M+m)*x'' + b*x' + m*l*cos(theta)*theta'' - m*l*sin(theta)*theta'^2"
POLE = "(J+m*l^2)*theta'' + m*l*cos(theta)*x'' - m*g*l*sin(theta)"
DET = "((M+m)*(J+m*l^2) - m^2*l^2*cos(theta)^2)"
PUSH = "(F - b*x' + m*l*sin(theta)*theta'^2)"
SOLVED = (
    f"x'' = ((J+m*l^2)*{PUSH} - m^2*l^2*g*sin(theta)*cos(theta))/{DET}",
    f"theta'' = ((M+m)*m*g*l*sin(theta) - m*l*cos(theta)*{PUSH})/{DET}",
)


def test_solved_rows_are_right_as_they_stand() -> None:
    assert derivation("cart-pole").check("\n".join(SOLVED), hint=0).right


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("row", "right", "wrong", "kind", "words"),
    [
        (
            0,
            "- m^2*l^2*g",
            "+ m^2*l^2*g",
            "sign_of_a_term",
            "the term g*l^2*m^2*sin(theta)*cos(theta) has the wrong sign.",
        ),
        (1, "(M+m)*m*g*l", "m*g*l", "term_replaced", "the term g*l*m*sin(theta) stands where"),
        (1, " - b*x'", "", "term_forgotten", "the term b*l*m*cos(theta)*x' is missing."),
        (0, "(F - ", "(2*F - ", "element_twice", "force 'F' is counted twice."),
    ],
)
def test_a_slip_in_a_numerator(row: int, right: str, wrong: str, kind: str, words: str) -> None:
    rows = list(SOLVED)
    rows[row] = rows[row].replace(right, wrong)
    name, _, said = told("cart-pole", "\n".join(rows))
    symbol = ("x''", "theta''")[row]
    assert said.startswith(f"In what is solved for {symbol} alone: ") and words in said, said
    assert name == kind


def test_lines_that_are_no_equations_of_motion_hide_no_mistake() -> None:
    kind, element, _ = told("cart-pole", f"J*theta'^2/2 + m*l\n{CART} = F\n{POLE.replace('J+', '')} = 0")
    assert kind == "rotation_forgotten" and element == "rigid body 'pole'"


def test_equations_that_are_written_twice() -> None:
    again = f"{CART} = F\n{POLE} = 0\nx'' = (F - b*x' - m*l*cos(theta)*theta'' + m*l*sin(theta)*theta'^2)/M"
    kind, _, said = told("cart-pole", again)
    assert kind == "term_forgotten" and "m*x''" in said  # the equations above are right
    rod = "m*L^2*theta'' + b*theta' + m*g*sin(theta) = 0\ntheta'' = -b/(m*L^2)*theta' - g/L^2*sin(theta)"
    kind, element, _ = told("pendulum", rod)
    assert kind in ("lost", "factor_missing", "gravity_arm") and element == "gravity 'g'"


def slope() -> lg.Derivation:
    """A disc that rolls down a movable wedge."""
    s = lg.System("disc on a wedge")
    x, d = s.coordinates("x s")
    m, M, J, R, beta = s.parameters("m M J R beta")
    frame = s.frame(d / R)
    centre = s.origin + (x + d * sp.cos(beta), -d * sp.sin(beta))
    s.particle(M, at=s.origin + (x, 0), name="wedge")
    s.rigid_body(m, J, at=centre, frame=frame, name="disc")
    s.gravity()
    return s.derive()


@pytest.mark.slow
def test_a_rate_too_much_in_an_angular_velocity() -> None:
    answer = "T = M*x'^2/2 + m*(x'^2 + 2*x'*s'*cos(beta) + s'^2)/2 + J*(s' + x')^2/(2*R^2)"
    (mistake,) = slope().check(answer).mistakes
    assert mistake.name == "omega" and "s'/R + x'/R" in str(mistake.what)


def test_a_length_that_is_wrong_in_both_components_is_one_mistake() -> None:
    answer = "T = (M+m)*x'^2/2 + m*l*cos(theta)*x'*theta'/2 + (J + m*l^2/4)*theta'^2/2\nV = m*g*l*cos(theta)/2"
    kind, _, words = told("cart-pole", answer)
    assert kind == "segment_number" and "l/2 stands in place of l" in words


def test_a_sine_in_the_mass_matrix_is_no_matter_of_potential_energy() -> None:
    verdict = derivation("cart-pole").check(f"{CART.replace('cos', 'sin')} = F\n{POLE.replace('cos', 'sin')} = 0")
    assert verdict.mistakes and all(m.step != 3 for m in verdict.mistakes)


@pytest.mark.slow
def test_a_wrong_denominator_of_one_row() -> None:
    wrong = SOLVED[0].replace(f"/{DET}", f"/{DET.replace('- m^2', '+ m^2')}")
    kind, _, words = told("cart-pole", wrong)
    assert kind.startswith("denominator") and "numerator of x''" in words


def test_terms_of_a_solved_row_that_nothing_explains_are_those_of_its_numerator() -> None:
    wrong = (
        SOLVED[0]
        .replace("(F - b*x'", "(F + 3*b*x' - theta'")
        .replace("l*sin(theta)*theta'^2)", "l*cos(theta)*theta'^2)")
    )
    verdict = derivation("cart-pole").check(f"{wrong}\n{SOLVED[1]}")
    assert not verdict.mistakes
    differing = {str(d.term) for d in verdict.findings[0].differences}
    assert len(differing) == 3 and not any("(t, 2)" in term or "/" in term for term in differing), differing


def test_a_part_of_an_equation_beside_it_is_no_mistake_of_its_own() -> None:
    rows = "m*L^2*theta'' = 0\nm*L^2*theta'' + b*theta' - m*g*L*sin(theta) = 0"
    kind, element, _ = told("pendulum", rows)
    assert element == "gravity 'g'" and "sign" in kind


def test_a_wrong_solved_row_beside_right_equations() -> None:
    wrong = SOLVED[0].replace(f"/{DET}", f"/{DET.replace('- m^2', '+ m^2')}")
    kind, _, _ = told("cart-pole", f"{CART} = F\n{POLE} = 0\n{wrong}\n{POLE} = 0")
    assert kind.startswith("denominator")


def test_the_wrong_term_of_a_denominator_is_told() -> None:
    wrong = SOLVED[0].replace(f"/{DET}", f"/{DET.replace('cos(theta)^2', 'cos(theta)')}")
    kind, _, words = told("cart-pole", f"{CART} = F\n{POLE} = 0\n{wrong}\n{POLE} = 0")
    assert kind.startswith("denominator")
    assert words.endswith("In it, -l^2*m^2*cos(theta) should be -l^2*m^2*cos(theta)^2."), words


PAIR = "(m1+m2)*x1'' + m2*x2r'' = 0\nm2*(x1'' + x2r'') + k*x2r = F\n"


def test_solved_equations_that_follow_from_a_wrong_one_need_no_correction() -> None:
    """Without m2 x1″ in the second equation, x2r″ = (F − k x2r)/m2, and x1″ follows as well."""
    solved = "x2r'' = (F - k*x2r)/m2\nx1'' = -(F - k*x2r)/(m1+m2)"
    verdict = derivation("lecture-3b").check(PAIR.replace("m2*(x1'' + x2r'')", "m2*x2r''") + solved)
    (mistake,) = verdict.mistakes
    assert str(mistake.what) == "x1'' is missing in the equation of x2r."
    assert [f.follows for f in verdict.findings] == [False, False, True, True]
    (differing,) = verdict.findings[1].differences  # not as if it were solved: F and k x2r are there
    assert str(differing.term) == "m2*Derivative(x1(t), (t, 2))"


def test_a_slip_in_a_sum_of_fractions_is_told_as_it_is_written() -> None:
    row = "x2r'' = F/m2 - k*x2r/m2 - k*x2r/m1"
    _, _, said = told("lecture-3b", PAIR + row)
    assert said == "In what is solved for x2r'' alone: the term F/m1 is missing."


@pytest.mark.slow
def test_a_wrong_ratio_of_a_spring_and_the_damper_beside_it_is_told_once() -> None:
    s = lg.System("geared shaft")
    a, b = s.coordinates("a b")
    J, n, c, d, e = s.parameters("J n c d e")
    for angle, name in ((a, "rotor"), (b, "arm")):
        s.rigid_body(0, J, at=s.origin, frame=s.frame(angle, name=name), name=name)
    s.spring(c, deflection=a / n - b, name="shaft")
    s.damper(d, deflection=a / n - b, name="losses")
    s.damper(e, deflection=a, name="bearing")
    wrong = "V = c*(n*a - b)^2/2\nXi_a = -n*d*(n*a' - b')\nXi_b = d*(n*a' - b')\n"
    rows = "J*a'' + n*d*(n*a' - b') + n*c*(n*a - b) = 0\nJ*b'' - d*(n*a' - b') - c*(n*a - b) = 0"
    first, second = s.derive().check(wrong + rows).mistakes
    assert "wrong side of the fraction line" in str(first.what) and "'bearing' is missing" in str(second.what)


def test_coordinates_with_other_names_are_told_by_these_names() -> None:
    rows = f"{CART} = F\n{POLE.replace('*x', '*2*x')} = 0".replace("theta", "alpha")
    verdict = derivation("cart-pole").check(rows)
    (mistake,) = verdict.mistakes
    assert "alpha" in str(mistake.what) and mistake.coordinate in ("alpha", None), str(mistake.what)
    (difference,) = verdict.findings[1].differences
    assert difference.term.has(sp.Function("alpha")(time)) and difference.coordinate == "alpha"
