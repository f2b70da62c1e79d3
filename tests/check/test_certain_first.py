"""What is certain is said before what may be a reason, and nothing is said that what is written refutes.

Oracle: the answers, whose mistakes are made here one by one beside right ones.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.explain.certain_first import with_certain_terms
from lagrangian.check.verb import CheckedAnswer, check_answer
from lagrangian.check.verdict import Mistake
from lagrangian.derive import Derived
from lagrangian.page.formula import text
from lagrangian.read import loads
from lagrangian.structured.choose import derive_in_form

CART = lg.example("cart-pole").derive()
BAR = """
name = "bar"
[coordinates]
phi = "crank, from the top"
[parameters]
J = "0.7 kg*m^2"
m = "0.7 kg"
r = "0.7 m"
k = "0.7 N/m"
g = "9.81 m/s^2"
[inputs]
tau = "N*m"
[define]
y = "r*cos(phi)"
[points]
N = ["0", "y"]
[[particle]]
name = "bar"
mass = "m"
at = "N"
[[kinetic]]
name = "wheel"
value = "J*phi'^2/2"
[[gravity]]
direction = [0, -1]
g = "g"
[[torque]]
name = "motor"
value = "tau"
on = "phi"
"""
"""A bar that a crank moves up and down by a yoke."""
SLIDE = """
name = "slide"
[coordinates]
x = { description = "box", unit = "m" }
h = { description = "handle, from the box", unit = "m" }
[parameters]
M = "0.7 kg"
m = "0.7 kg"
K = "0.7 N/m"
k = "0.7 N/m"
[inputs]
F = "N"
[[particle]]
name = "box"
mass = "M"
at = ["x", "0"]
[[particle]]
name = "handle"
mass = "m"
at = ["x + h", "0"]
[[spring]]
name = "bungee"
k = "K"
deflection = "x"
[[spring]]
name = "cord"
k = "k"
deflection = "h"
[[force]]
name = "pull"
value = "F"
deflection = "h"
"""
"""A box on a bungee, and a handle that moves along with it."""


@cache
def derived(text: str) -> Derived:
    return derive_in_form(loads(text).model())


def told(answer: str, model: str) -> CheckedAnswer:
    return check_answer(derived(model), answer)


def first(answer: str, model: str) -> str:
    """The first mistake that is told of a wrong answer."""
    found = told(answer, model)
    assert not found.right
    return str(found.mistakes[0].what)


BAR_ROW = "(J + m r^2 sin(phi)^2) phi'' + m r^2 sin(phi) cos(phi) phi'^2 - m g r sin(phi) = tau"


def test_a_term_that_is_written_and_taken_away_again_is_too_much_and_not_missing() -> None:
    right = "T = 1/2 M x'^2 + 1/2 m (x'^2 + 2 x' h' + h'^2)"
    assert told(right, SLIDE).status.name != "WRONG"
    said = first(f"{right} - 1/2 m h'^2", SLIDE)
    assert "does not belong there" in said and "missing" not in said
    assert "missing" in first("T = 1/2 M x'^2 + 1/2 m (x'^2 + 2 x' h')", SLIDE)


def test_no_half_is_missing_that_is_written() -> None:
    V = "T = 1/2 M x'^2 + 1/2 m (x' + h')^2\nV = {} + 1/2 K x^2"
    assert told(V.format("1/2 k h^2"), SLIDE).status.name != "WRONG"
    assert "½" not in first(V.format("2 * 1/2 k h^2"), SLIDE)
    assert first(V.format("k h^2"), SLIDE).startswith("The ½ in the energy of spring 'cord' is missing")


def test_a_spring_at_the_ground_is_not_said_to_be_taken_for_one() -> None:
    said = first("T = 1/2 M x'^2 + 1/2 m (x' + h')^2\nV = 1/2 k h^2 + 1/2 K (x + h)^2", SLIDE)
    assert "bungee" in said and "ground" not in said


def test_a_wrong_second_derivative_is_told_and_what_follows_is_marked() -> None:
    lines = (
        "y = r cos(phi)\ny'' = -r sin(phi) phi'' {} r cos(phi) phi'^2\nm y'' = N - m g\nJ phi'' = tau + N r sin(phi)\n"
    )
    assert told(lines.format("-") + BAR_ROW, BAR).right
    wrong = BAR_ROW.replace("phi'' + m", "phi'' - m")
    found = told(lines.format("+") + wrong, BAR)
    assert found.first_wrong is not None and found.first_wrong.line.number == 2
    assert [f.line.number for f in found.findings if f.follows] == [5]
    assert str(found.mistakes[0].what).startswith("y'' is ")


def test_a_slip_in_the_definition_of_an_acceleration_is_told_there() -> None:
    lines = "a = -r sin(phi) phi''{}\nm a = N - m g\nN = m a + m g\nJ phi'' = tau + N r sin(phi)\n"
    assert told(lines.format(" - r cos(phi) phi'^2") + BAR_ROW, BAR).right
    wrong = BAR_ROW.replace(" + m r^2 sin(phi) cos(phi) phi'^2", "")
    found = told(lines.format("") + wrong, BAR)
    assert found.first_wrong is not None and found.first_wrong.line.number == 1


def test_a_name_of_the_system_that_is_stated_wrongly_is_told_by_what_it_is() -> None:
    said = first("y = 2 r cos(phi)\n" + BAR_ROW, BAR)
    assert said == "y is r*cos(phi), not 2*r*cos(phi)."


@pytest.mark.slow
@pytest.mark.parametrize(
    ("below", "said"),
    [
        ("J + m l^2 - m^2 l^2 sin(theta)^2/(M + m)", "cos(theta)^2"),
        ("J - m^2 l^2 cos(theta)^2/(M + m)", "is missing"),
    ],
)
def test_the_term_of_a_denominator_that_is_wrong_is_told(below: str, said: str) -> None:
    """θ̈ of a cart-pole without ẍ: the right denominator is J + m l² − m² l² cos²θ/(M + m)."""
    numerator = "(m g l sin(theta) - m l cos(theta) (F - b x' + m l theta'^2 sin(theta))/(M + m))"
    row = "x'' = (F - b x' + m l theta'^2 sin(theta) - m l theta'' cos(theta))/(M + m)"
    right = "J + m l^2 - m^2 l^2 cos(theta)^2/(M + m)"
    assert CART.check(f"{row}\ntheta'' = {numerator}/({right})").right
    found = CART.check(f"{row}\ntheta'' = {numerator}/({below})")
    words = str(found.mistakes[0].what)
    assert not found.right and "denominator" in words and said in words, words


def test_a_constant_p_is_a_force() -> None:
    """P = m g is no potential energy, and not the kinetic energy of what hangs there."""
    found = CART.check(
        "the weight pulls with P = m g\n(M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + b x' = F\n"
        "m l x'' cos(theta) + J theta'' - m g l sin(theta) = 0"
    )
    assert not found.right and found.first_wrong is not None and found.first_wrong.line.number == 3
    assert not any(f.line.kind == "V" for f in found.findings)


def test_an_equation_that_was_compared_with_its_negative_has_no_list_of_terms() -> None:
    """x'' = (−S − c x')/M for (S − c x')/M: S has the wrong sign, and neither x'' nor all the others."""
    found = told("h'' = (F - k h)/m - x''\nx'' = (-K x - k h + F)/M", SLIDE)
    assert not found.right
    assert not any(d.kind == "sign" and d.written.is_Derivative for f in found.findings for d in f.differences)


@pytest.mark.parametrize("label", ["and solved for ẍ:", "Solved for ẍ:", "for ẍ:", "solved:", "then ẍ:"])
def test_an_equation_behind_the_acceleration_for_which_it_is_solved_is_judged(label: str) -> None:
    """A wrong one below right equations is no remark: "for ẍ: ẍ = …" names no special case."""
    rows = "(M + m) ẍ + m ḧ + K x = 0\nm ẍ + m ḧ + k h = F\n"
    assert told(f"{rows}{label} ẍ = -(m ḧ + K x)/(M + m)", SLIDE).right
    found = told(f"{rows}{label} ẍ = -(m ḧ + K x)/M", SLIDE)
    assert not found.right and found.first_wrong is not None and found.first_wrong.line.number == 3


def test_a_force_without_an_index_is_that_of_the_only_coordinate_of_the_answer() -> None:
    lines = "beta = -phi\nQ = {}\n(J + m r^2 sin(beta)^2) beta'' + m r^2 sin(beta) cos(beta) beta'^2"
    lines += " - m g r sin(beta) = -tau"
    assert told(lines.format("-tau"), BAR).right
    found = told(lines.format("tau"), BAR)
    assert not found.right and {f.line.number for f in found.findings if not f.status.right} == {2}


def test_a_number_and_a_name_in_brackets_behind_a_factor_are_no_number_of_an_equation() -> None:
    assert told("2 (M + m) x'' + 2 m h'' = -K (2x)\nm x'' + m h'' = F - k h", SLIDE).right
    assert not told("(M + m) x'' + m h'' = -K (2x)\nm x'' + m h'' = F - k h", SLIDE).right
    assert told("(M + m) x'' + m h'' + K x = 0  (2a)\nm x'' + m h'' + k h = F  (2b')", SLIDE).right


def test_an_answer_of_energies_and_forces_says_which_energy_it_has_not() -> None:
    """T* and Ξ alone are right as far as they go: V is not taken for stated, also where one spring's energy is."""
    T, Xi = "T = 1/2 M x'^2 + 1/2 m (x' + h')^2", "Q_x = 0\nQ_h = F"
    for V, silent in (("V = 1/2 K x^2 + 1/2 k h^2", False), ("V1 = 1/2 K x^2", True), ("", True)):
        notes = [str(x) for x in told(f"{T}\n{V}\n{Xi}", SLIDE).notes]
        assert any(x.startswith("V is missing") for x in notes) == silent, notes


@cache
def table() -> lg.Derivation:
    """A wheel in a vertical plane with a mass at its rim and a second one on a spoke, held by a spring."""
    s = lg.System("wheel with two masses")
    r, phi = s.coordinates("r phi")
    m, M, J, R, k, h, g = s.parameters("m M J R k h g")
    s.rigid_body(mass=1, inertia=J, at=s.origin, frame=s.frame(phi, name="wheel"), name="wheel")
    s.particle(M, at=s.point("A", (R * sp.cos(phi), R * sp.sin(phi))), name="rim")
    s.particle(m, at=s.point("B", (r * sp.cos(phi), r * sp.sin(phi))), name="bead")
    s.gravity(direction=(-1, 0), g=g)
    s.spring(k, deflection=r, rest=h, name="spring")
    return s.derive()


WHEEL = """m (r'' - r phi'^2) = -k (r - h) - m g cos(phi)
(J + M R^2 + m r^2) phi''{coriolis} - M g R {arm}(phi) - m g r sin(phi) = 0"""
TURNED = Mistake("segment_direction", text("In the position of particle 'rim', R is turned."), text(""), 2)


@pytest.mark.parametrize("coriolis", [" + 2 m r r' phi'", ""])
def test_the_terms_of_two_elements_are_told_in_place_of_a_position_that_is_written_nowhere(coriolis: str) -> None:
    """The arm of a weight with the cosine for the sine: its inertia is right, and so is its position."""
    assert table().check(WHEEL.format(coriolis=" + 2 m r r' phi'", arm="sin")).right
    verdict = table().check(WHEEL.format(coriolis=coriolis, arm="cos"))
    told = [str(m.what) for m in with_certain_terms(replace(verdict, mistakes=(TURNED,))).mistakes]
    assert told[0] == "In line 2, -M*R*g*cos(phi) should be -M*R*g*sin(phi)."
    assert told[1:] == ([] if coriolis else ["In line 2, the term 2*m*r*phi'*r' is missing."])
