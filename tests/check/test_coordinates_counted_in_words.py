"""Answers that keep the letters of the system and say in words that they count its coordinates otherwise.

Oracle: the equations of a lift on a spring, of a cart on springs and of a hanging rod, converted by hand.
"""

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.reading.said.conventions import stated_coordinates
from lagrangian.check.verdict import Status


@cache
def lift() -> lg.Derivation:
    """A weight on a spring and a damper; x grows downwards."""
    s = lg.System("weight on a spring")
    x = s.coordinate("x")
    m, k, c, g = s.parameters("m k c g")
    s.particle(m, at=s.point("P", (0, -x)), name="weight")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=x, name="spring")
    s.damper(c, deflection=x, name="damper")
    s.force(s.input("F"), deflection=x, name="push")
    return s.derive()


@cache
def rod() -> lg.Derivation:
    """A rod with a motor at its hinge; θ is counted from hanging, counterclockwise."""
    s = lg.System("rod")
    theta = s.coordinate("theta")
    m, l, J, g = s.parameters("m l J g")
    tip = s.point("C", (l * sp.sin(theta), -l * sp.cos(theta)))
    s.rigid_body(mass=m, inertia=J, at=tip, frame=s.frame(theta, name="rod"), name="rod")
    s.gravity(direction=(0, -1), g=g)
    s.torque(s.input("M"), on=theta, name="motor")
    return s.derive()


FROM_REST = (
    "x is measured from the position of rest.",
    "x counts from the static equilibrium, downwards.",
    "Measured from static equilibrium (k x_s = m g):",
    "Let x be the displacement from the equilibrium position.",
    r"Let $x$ be measured from the static equilibrium.",
    "x wird von der Ruhelage aus gemessen.",
    "x = 0 is the equilibrium position.",
    "The origin of x is at equilibrium.",
    "x is the deviation from rest.",
)
NOT_FROM_REST = (
    "x is measured from where the spring is relaxed.",
    "x is not measured from the equilibrium.",
    "x is measured from the rest length of the spring.",
    "At equilibrium the force from the spring is m g.",
    "The mass starts from equilibrium at t = 0.",
    "x starts from rest.",
    "The spring is stretched by x. About the equilibrium the motion is an oscillation.",
    "For small deviations from equilibrium it oscillates. x is the stretch of the spring.",
    "The damper acts against the motion from equilibrium. x downwards.",
    "",
)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", FROM_REST)
def test_the_weight_drops_out_from_the_position_at_rest(said: str) -> None:
    equation = "m x'' + c x' + k x = F" if "$" not in said else r"\[ m\ddot x + c\dot x + kx = F \]"
    verdict = lift().check(f"{said}\n{equation}")
    assert verdict.status is Status.OTHER_COORDINATES
    assert any("Counted as you write" in str(note) for note in verdict.notes)
    assert not lift().check(f"{said}\n{equation.replace('k', '2k')}").right


@pytest.mark.parametrize("said", NOT_FROM_REST)
def test_the_weight_stays_where_no_words_drop_it(said: str) -> None:
    assert not lift().check(f"{said}\nm x'' + c x' + k x = F").right


def test_energies_count_from_the_same_place() -> None:
    said = "x is measured from the position of rest.\nT = m x'^2/2\nV = {}\nQ = F - c x'"
    assert lift().check(said.format("k x^2/2")).right
    assert not lift().check(said.format("k x^2/2 + m g x")).right


def test_mistakes_are_named_as_the_answer_counts() -> None:
    verdict = lift().check("x is measured from the static equilibrium.\nm x'' + k x = F")
    assert verdict.mistake is not None
    assert verdict.mistake.element == "damper 'damper'"
    assert not any("x measured from another point" in str(note) for note in verdict.notes)


@pytest.mark.parametrize("said", ["x counted upwards", "x (positive upwards)", "Here x points up."])
def test_a_coordinate_is_positive_the_other_way(said: str) -> None:
    assert lift().check(f"{said}\nm x'' + c x' + k x = -m g - F").right
    assert not lift().check(f"{said}\nm x'' + c x' + k x = -m g + F").right


@pytest.mark.parametrize("said", ["x counted downwards", "x (positive downwards)", "Here x points down."])
def test_the_way_of_the_system_changes_nothing(said: str) -> None:
    assert lift().check(f"{said}\nm x'' + c x' + k x = m g + F").right
    assert not lift().check(f"{said}\nm x'' + c x' + k x = -m g - F").right


def test_upwards_and_from_rest() -> None:
    said = "Let x be the displacement from static equilibrium, positive upward.\nm x'' + c x' + k x = {}F"
    assert lift().check(said.format("-")).right
    assert not lift().check(said.format("")).right


@pytest.mark.slow
def test_an_angle_is_counted_from_another_axis() -> None:
    level = "(J + m l^2) theta'' + m g l cos(theta) = M"
    assert rod().check(f"theta is measured from the horizontal\n{level}").right
    assert not rod().check(f"theta is measured from the vertical\n{level}").right
    assert not rod().check(f"theta is measured from the horizontal\n{level.replace('= M', '= -2 M')}").right
    above = "(J + m l^2) theta'' - m g l sin(theta) = M"
    assert rod().check(f"theta is measured from the upward vertical\n{above}").right
    assert not rod().check(f"theta is measured from the downward vertical\n{above}").right


def test_clockwise_or_not() -> None:
    other = "(J + m l^2) theta'' + m g l sin(theta) = -M"
    assert rod().check(f"theta counted clockwise\n{other}").right
    assert not rod().check(f"theta counted counterclockwise\n{other}").right


def test_what_words_say_is_found_by_coordinate() -> None:
    said = stated_coordinates(
        "x and y are deviations from equilibrium; phi clockwise. z is small.", ["x", "y", "phi", "z"]
    )
    assert said.rest == {"x", "y"}
    assert said.ways == (("phi", "clockwise"),)
    assert stated_coordinates("y is taken from the upper vertical", ["y"]).axes == (("y", "upright"),)
    assert not stated_coordinates("the spring is at rest. x' = 0", ["x"])


def test_degrees_in_words_are_added_to_an_angle() -> None:
    said = "My angle is called u, so theta = u + 90 deg\n(J + m l^2) u'' + m g l {}(u) = M"
    assert rod().check(said.format("cos")).right
    assert not rod().check(said.format("sin")).right
    assert not rod().check(said.format("cos").replace("90", "180")).right


@cache
def hoist() -> lg.Derivation:
    """A drum with a motor that holds a load on an elastic rope, at any height."""
    s = lg.System("hoist")
    phi, x = s.coordinates("phi x")
    J, R, m, k, n, g = s.parameters("J R m k n g")
    s.kinetic(J * phi.diff() ** 2 / 2, name="drum")
    s.particle(m, at=s.point("A", (0, x)), name="load")
    s.spring(k, deflection=R * phi - x, name="rope")
    s.gravity((0, -1), g)
    s.torque(s.input("tau"), on=n * phi, name="motor")
    return s.derive()


HELD = "\n\nJ φ'' + k R (R φ - x) = n u\n\nm x'' + k (x - R φ) = 0"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "I measure both coordinates from the position at rest, in which the motor holds with τ0 = m g R/n, and write "
        "u = τ − τ0 for the change of the torque.",
        "All coordinates are measured from the equilibrium.\nτ0 = m g R/n\nu = τ − τ0",
        "x and φ count from the position at rest, where τ = τ0 = m g R/n, and u = τ − τ0.",
    ],
)
def test_a_system_that_an_input_holds_anywhere_counts_from_rest(said: str) -> None:
    """At rest k (R φ − x) = m g, for every φ, and n τ0 = m g R."""
    assert hoist().check(said + HELD).right
    assert hoist().check(said + HELD.replace("n u", "n τ - m g R")).right
    assert not hoist().check(said.replace("m g R", "2 m g R") + HELD).right
    assert not hoist().check(said + HELD.replace("n u", "n τ")).right
    assert not hoist().check(said + HELD.replace("k R (R φ - x)", "k R (R φ + x)")).right
    assert not hoist().check("With u = τ − m g R/n:" + HELD, hint=0).right
