"""What a reader meets in the steps: nothing refers to a line that is not there, nothing is said twice."""

import re

from sympy import cos, sin

import lagrangian as lg


def rolling_disk() -> lg.System:
    """A disk that rolls by R φ, a pendulum from its centre."""
    system = lg.System("disk")
    phi, theta = system.coordinates("phi theta")
    mass, m, radius, length, inertia = system.parameters("M m R L J")
    centre = system.origin + (radius * phi, radius)
    system.rigid_body(mass, inertia, at=centre, frame=-phi, name="disk")
    system.particle(m, at=centre + (length * sin(theta), -length * cos(theta)), name="bob")
    system.gravity(direction=(0, -1))
    return system


def test_a_position_refers_only_to_positions_that_are_written() -> None:
    step = str(rolling_disk().derive().to_text()).split("2  Kinetic")[1].split("3  Potential")[0]
    assert "x₂ = x₁ + L sin θ" in step
    assert "y₂ = R − L cos θ" in step
    for name in re.findall(r"= ([xyz][₀-₉])", step):
        assert f"    {name} = " in step


def test_an_angle_that_rolls_is_an_angle() -> None:
    step = rolling_disk().derive().steps[1]
    assert "absolute: an angle from a fixed direction" in str(step.reasons[0])


def test_a_displacement_that_turns_a_pulley_stays_a_displacement() -> None:
    system = lg.System("pulley")
    x = system.coordinate("x")
    m, inertia, radius = system.parameters("m J R")
    system.particle(m, at=system.origin + (0, -x))
    system.rigid_body(m, inertia, at=system.origin, frame=-x / radius)
    assert "absolute: a displacement from a fixed place" in str(system.derive().steps[1].reasons[0])


def test_one_mass_has_one_line_for_its_energy() -> None:
    system = lg.System("pendulum")
    theta = system.coordinate("theta")
    m, length = system.parameters("m L")
    system.particle(m, at=system.origin + (length * sin(theta), -length * cos(theta)))
    derivation = system.derive()
    assert derivation.to_text().count("T* = ½ m") == 1
    assert derivation.to_text(brief=True).count("T* = ½ m") == 1
