"""Numbers that a program gives to the letters of the system: any values, but no angle in degrees.

Oracle: a flap on a torsion spring that is relaxed at 60°, J θ″ + d θ′ + k (θ − θ₀) + m g a cos θ = 0, by hand.
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg
from lagrangian.check.verb import CheckedAnswer

MODEL = """
name = "flap"
[coordinates]
theta = "from the horizontal"
[parameters]
J = "2 kg*m^2"
m = "5 kg"
a = "0.4 m"
k = "30 N*m/rad"
theta_0 = "60 deg"
d = "0.8 N*m*s/rad"
g = "9.81 m/s^2"
[points]
G = ["a*cos(theta)", "a*sin(theta)"]
[[frame]]
name = "flap"
angle = "theta"
origin = "origin"
[[kinetic]]
name = "turning"
value = "J*theta'^2/2"
[[potential]]
name = "weight"
value = "m*g*a*sin(theta)"
[[spring]]
name = "hinge"
k = "k"
deflection = "theta"
rest = "theta_0"
[[damper]]
name = "friction"
b = "d"
deflection = "theta"
"""
PROGRAM = """function dz = flap(t, z)
th = z(1); w = z(2);
J = 2; m = 5; a = 0.4; k = 30; d = 0.8; g = 9.81;
th0 = 60*pi/180;
dz = [w; (-m*g*a*cos(th) - k*(th - th0) - d*w)/J];
end
"""


@cache
def flap() -> lg.Derivation:
    return lg.loads(MODEL).derive()


def told(*changes: tuple[str, str]) -> CheckedAnswer:
    program = PROGRAM
    for before, after in changes:
        assert before in program
        program = program.replace(before, after)
    return flap().check(program)


@pytest.mark.parametrize(
    "after",
    ["60*pi/180", "1.0471975511965976", "pi/3", "deg2rad(60)", "60; th0 = th0*pi/180", "60; th0 = deg2rad(th0)"],
)
def test_an_angle_in_radians_is_right(after: str) -> None:
    verdict = told(("60*pi/180", after))
    assert verdict.right and not any("other values" in str(note) for note in verdict.notes)


def test_an_angle_that_is_turned_into_radians_where_it_is_used_is_right() -> None:
    assert told(("60*pi/180", "60"), ("th - th0", "th - th0*pi/180")).right


def test_an_angle_in_degrees_is_wrong() -> None:
    verdict = told(("60*pi/180", "60"))
    assert not verdict.right and verdict.first_wrong is not None and verdict.first_wrong.line.number == 5
    assert "hinge" in str(verdict.mistake and verdict.mistake.element)


def test_other_values_are_noted() -> None:
    verdict = told(("m = 5", "m = 6"), ("k = 30", "k = 31"), ("60*pi/180", "0.5"))
    assert verdict.right
    note = "The program gives m, k and th0 other values than the system has: these were not judged."
    assert note in [str(x) for x in verdict.notes]
