"""One mistake in an angular velocity in space is told as one, not by the terms of T* in which it shows.

Oracle: by hand, a wheel (A across, C about its axis) in a gimbal on a turntable, ω = (θ̇, ψ̇ + Ω sin θ, Ω cos θ).
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg
from lagrangian.check.explain.meant import owner_of

ALONG, ACROSS = "psi' + Omega*sin(theta)", "Omega*cos(theta)"
ENERGY = "T = A*(theta'^2 + ({across})^2)/2 + C*({along})^2/2 + m*l^2*(theta'^2 + ({across})^2)/2"


@cache
def gyro() -> lg.Derivation:
    """A wheel with a mass on its gimbal, driven by tau against the gimbal."""
    return lg.loads("""
name = "gyro"
[coordinates]
theta = ""
psi = ""
[parameters]
A = "0.003 kg*m^2"
C = "0.005 kg*m^2"
m = "0.1 kg"
m_w = "2 kg"
l = "0.1 m"
k = "0.6 N*m"
Omega = "2 rad/s"
[inputs]
tau = "N*m"
[[frame]]
name = "table"
axis = [0, 0, 1]
angle = "Omega*t"
[[frame]]
name = "gimbal"
parent = "table"
axis = [1, 0, 0]
angle = "theta"
[[frame]]
name = "wheel"
parent = "gimbal"
axis = [0, 1, 0]
angle = "psi"
[points]
trim = { frame = "gimbal", offset = ["0", "l", "0"] }
[[rigid_body]]
name = "wheel"
mass = "m_w"
inertia = ["A", "C", "A"]
at = "origin"
frame = "wheel"
[[particle]]
name = "trim"
mass = "m"
at = "trim"
[[spring]]
k = "k"
deflection = "theta"
[[torque]]
value = "tau"
on = "wheel"
reaction = "gimbal"
""").derive()


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("along", "across", "said"),
    [
        ("psi'", ACROSS, "In the component psi' + Omega*sin(theta) of {omega}, Omega*sin(theta) is left out."),
        (
            "psi' + Omega*cos(theta)",
            ACROSS,
            "In the component {along} of {omega}, Omega*cos(theta) stands in place of Omega*sin(theta).",
        ),
        (
            "psi' + Omega*cos(theta)",
            "Omega*sin(theta)",
            "In T*, Omega*cos(theta) and Omega*sin(theta) are exchanged.",
        ),
    ],
)
def test_one_mistake_in_an_angular_velocity_is_one(along: str, across: str, said: str) -> None:
    (mistake,) = gyro().check(ENERGY.format(along=along, across=across)).mistakes
    words = said.format(along="Omega*sin(theta) + psi'", omega="the angular velocity of rigid body 'wheel'")
    assert sorted(str(mistake.what)) == sorted(words), mistake.what
    assert mistake.step == 2


def test_the_right_angular_velocity_is_right() -> None:
    verdict = gyro().check(ENERGY.format(along=ALONG, across=ACROSS))
    assert verdict.findings[0].status.right


ROWS = """I = A + m*l^2
theta'' = (-(I - C)*Omega^2*sin(theta)*cos(theta) + C*Omega*cos(theta)*psi'{spring})/I
psi'' = u/C - Omega*cos(theta)*theta'"""


@pytest.mark.parametrize("spring", ["", " - k*theta"])
def test_an_input_by_another_name_is_no_mistake_beside_one(spring: str) -> None:
    """u is the torque; where the spring is missing, that alone is wrong."""
    verdict = gyro().check(ROWS.format(spring=spring))
    assert verdict.right == bool(spring)
    assert verdict.findings[-1].status.right
    if not spring:
        assert [m.name for m in verdict.mistakes] == ["element_forgotten"]


INERTIA, CENTRIFUGAL = "(A + m*l^2)*theta''", "(A + m*l^2)*Omega^2*sin(theta)*cos(theta)"


def test_the_right_energy_of_a_body_speaks_against_a_mistake_in_every_energy() -> None:
    """C counts twice in both equations: not every ½ is missing, as that of the mass on the gimbal stands there."""
    rows = f"""{INERTIA} + {CENTRIFUGAL} - 2*C*Omega*cos(theta)*({ALONG}) + k*theta = -3*A*Omega*theta'
2*C*(psi'' + Omega*cos(theta)*theta') = tau"""
    assert "in every kinetic energy" in str(gyro().check(rows).mistakes[0].what)
    verdict = gyro().check(f"T_trim = m*l^2*(theta'^2 + ({ACROSS})^2)/2\n{rows}")
    assert verdict.findings[0].status.right and verdict.mistakes
    assert not any("in every" in str(m.what) for m in verdict.mistakes)


def test_a_moment_of_inertia_has_no_sign_of_its_own() -> None:
    row = f"{INERTIA} + {CENTRIFUGAL} + C*Omega*cos(theta)*({ALONG}) + k*theta = 0"
    verdict = gyro().check(f"{row}\nC*(psi'' + Omega*cos(theta)*theta') = tau")
    assert "The term C*Omega*(" in str(verdict.mistakes[0].what) and "has the wrong sign" in str(
        verdict.mistakes[0].what
    )


def test_an_index_may_be_that_of_a_mass() -> None:
    """m_w is the mass of the wheel, and T_w its energy."""
    owners = {name: owner_of(name, gyro().model) for name in ("T_w", "T_wheel", "T_trim", "T_v", "T")}
    named = {name: None if body is None else body.name for name, body in owners.items()}
    assert named == {"T_w": "wheel", "T_wheel": "wheel", "T_trim": "trim", "T_v": None, "T": None}
