"""What is said beside lines is true: excuses, where terms come from, what stands for what.

Oracle: two carts on springs between a wall and a damper, and a disc with a bob, with their equations by hand.
"""

from __future__ import annotations

from functools import cache, partial

import sympy as sp
from small_systems import two_carts

import lagrangian as lg
from lagrangian.check.verdict import Finding
from lagrangian.model import time

carts = partial(two_carts, between=True)
ENERGIES = "T = m x'^2/2 + n y'^2/2\nV = k x^2/2 + c (y - x)^2/2\n"
DAMPED = "m x'' + k x - c (y - x) - b (y' - x') = 0\nn y'' + c (y - x) + b (y' - x') = F"


def of_line(verdict: lg.Verdict, number: int) -> Finding:
    return next(f for f in verdict.findings if f.line.number == number)


def test_a_force_without_its_damper_is_excused_only_by_its_own_equation() -> None:
    forces = "Xi_x = 0\nXi_y = F - b (y' - x')\n"
    assert of_line(carts().check(f"{ENERGIES}Xi_x = 0\nXi_y = F\n{DAMPED}"), 3).status.right
    verdict = carts().check(f"{ENERGIES}{forces}{DAMPED.replace('- b (y', '+ 0 (y')}")
    assert not of_line(verdict, 3).status.right and of_line(verdict, 5).follows
    assert "eaction of damper 'between' is missing" in str(verdict.mistake.what if verdict.mistake else "")


def test_a_term_comes_from_an_element_that_adds_just_this_term() -> None:
    verdict = carts().check(f"{ENERGIES.replace('k x^2', 'k (x + y)^2')}{DAMPED.replace('m x', '2 m x')}")
    said = str(verdict)
    assert "½ k (x + y)² should be ½ k x². It comes from the outer spring in step 3." in " ".join(said.split())
    assert "It comes from the first particle." in said


def test_a_wrong_derivative_of_an_own_energy_is_no_wrong_equation() -> None:
    """∂V/∂y without the inner derivative stands beside its equation, not in place of it."""
    rows = DAMPED.replace("n y'' + c", "n y'' - c")
    lines = f"{ENERGIES}dV/dx = k x - c (y - x)\ndV/dy = c (x - y)\n{rows}"
    verdict = carts().check(lines)
    assert "follows from the energies" in str(of_line(verdict, 3).note)
    wrong = of_line(verdict, 4)
    assert not wrong.status.right and not wrong.differences and "not the derivative" in str(wrong.note)
    (mistake,) = verdict.mistakes
    assert mistake.coordinate == "y" and mistake.element == "spring 'inner'"


def test_equations_below_a_wrong_energy_have_its_mistake_and_another() -> None:
    """A spring counted twice in V, and a sign of the damper: not one other mistake that does the same as both."""
    rows = DAMPED.replace("k x", "2 k x").replace("b (y' - x') = F", "b (x' - y') = F")
    verdict = carts().check(f"{ENERGIES.replace('k x^2/2', 'k x^2')}{rows}")
    assert [m.element for m in verdict.mistakes] == ["spring 'outer'", "damper 'between'"]


@cache
def slope() -> lg.Derivation:
    """A block on the slope of a cart, with friction between them, and a force on the block along the ground."""
    s = lg.System("slope")
    x, u = s.coordinates("x u")
    M, m, b = s.parameters("M m b")
    alpha, g = s.parameter("alpha", unit="rad"), s.parameter("g")
    s.particle(M, at=s.point("cart", (x, 0)), name="cart")
    block = s.point("block", (x + u * sp.cos(alpha), u * sp.sin(alpha)))
    s.particle(m, at=block, name="block")
    s.gravity((0, -1), g)
    s.damper(b, deflection=u, name="friction")
    s.force((s.input("F"), 0), at=block, name="push")
    return s.derive()


def test_a_damper_with_the_absolute_speed_along_a_slope() -> None:
    verdict = slope().check("D = 1/2 b (u' + x' cos(alpha))^2")
    (mistake,) = verdict.mistakes
    assert mistake.name == "damper_other_velocity" and str(mistake.what).endswith("it is u'.")


def test_a_letter_is_left_out_only_where_it_stands() -> None:
    rows = "(M+m)*x'' + m*cos(alpha)*u'' = F\nm*u'' + m*cos(alpha)*x'' + m*g*sin(alpha) + b*u' = F"
    verdict = slope().check(rows)
    said = [str(m.what) for m in (*verdict.mistakes, *verdict.alternatives)]
    assert said and not any("'friction'" in x for x in said), said


def test_a_second_choice_is_another_cause() -> None:
    verdict = carts().check(f"{ENERGIES.replace('c (y - x)^2', 'c (y + x)^2')}{DAMPED}")
    said = [str(m.what) for m in (*verdict.mistakes, *verdict.alternatives)]
    assert len([x for x in said if "x + y" in x or "y + x" in x]) == 1, said


def test_energies_of_parts_of_a_system_are_added_up() -> None:
    for parts in ("T (first) = m x'^2/2\nT (second) = n y'^2/2\n", "T = m x'^2/2, energy of the other: n y'^2/2\n"):
        verdict = carts().check(f"{parts}V = k x^2/2 + c (y - x)^2/2\n{DAMPED}")
        assert verdict.right and any("those in line" in str(note) for note in verdict.notes)
    verdict = carts().check(f"T (first) = m x'^2/2\nT (second) = n y'^2\n{DAMPED.replace('n y', '2 n y')}")
    assert [m.element for m in verdict.mistakes] == ["particle 'second'"]
    assert not carts().check(f"T = m x'^2/2\nT = m x'^2/2 + n y'^2/2\n{DAMPED}", hint=0).right  # twice the whole


@cache
def disc() -> lg.Derivation:
    """A disc that rolls on a table, with a spring to a wall that is shaken, and a force and a torque."""
    s = lg.System("disc")
    phi = s.coordinate("phi")
    M, J, k, a, w = s.parameters("M J k a w")
    R = s.parameter("R", unit="m")
    z = s.define("z", a * sp.sin(w * time))
    s.rigid_body(M, J, at=s.point("centre", (R * phi, R)), frame=s.frame(-phi), name="disc")
    s.spring(k, deflection=R * phi - z, name="k")
    s.force(s.input("F"), deflection=R * phi, name="push")
    s.torque(s.input("tau"), on=phi, name="motor")
    return s.derive()


def test_a_definition_tells_which_of_two_causes_it_was() -> None:
    """M R² twice: the ½ of ½mv² forgotten, or J about the point of contact and ½mv² as well, as J_A shows."""
    row = "(J_A + M R^2) phi'' + k R (R phi - z) = F R + tau"
    assert disc().check(row.replace("J_A", "J + M R^2")).mistakes[0].name == "half_forgotten"
    assert disc().check(f"J_A = J + M R^2\n{row}").mistakes[0].name == "inertia_about_pivot"


def test_a_force_with_which_another_line_goes_on_is_not_the_whole() -> None:
    row = "(J + M R^2) phi'' + k R (R phi - z) = F + tau"
    verdict = disc().check(f"The force pushes: Q_phi = F\nQ_phi = F + tau\n{row}")
    assert verdict.first_wrong is not None and verdict.first_wrong.line.number == 2
    assert [m.name for m in verdict.mistakes] == ["force_arm"]
    assert disc().check(f"Q_phi = F R + tau\n{row.replace('= F', '= F R')}", hint=0).right


def test_a_prescribed_motion_is_no_equation() -> None:
    row = "(J + M R^2) phi'' + k R (R phi - z) = F R + tau"
    verdict = disc().check(f"z = a sin(w t), z' = a w cos(w t)\n{row}")
    assert verdict.right and len(verdict.findings) == 1
    verdict = disc().check(f"z = a sin(w t), z' = a cos(w t)\n{row}")
    assert [str(m.what) for m in verdict.mistakes] == ["z' is a*w*cos(t*w), not a*cos(t*w)."]
    assert not verdict.findings[0].differences


def test_no_list_of_terms_where_it_would_not_be_true() -> None:
    """A constant of V is nobody's mistake, and a solved form has divisors that no right term has."""
    verdict = carts().check("V = k x^2 + c (y - x)^2/2 + k")
    assert len(verdict.findings[0].differences) == 1
    solved = "x'' = (c (y - x) - k x + b (y' - x'))/(m + n)\nn y'' + c (y - x) + b (y' - x') = F"
    verdict = carts().check(solved)
    assert not verdict.right and not any(" + n)" in str(d.term) for f in verdict.findings for d in f.differences)
