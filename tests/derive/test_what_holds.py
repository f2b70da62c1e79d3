"""What acts on a mass and what holds it: loads on bodies, every holder of a mass, and what Lagrange spares."""

from __future__ import annotations

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation


def vanishes(expr: sp.Expr) -> bool:
    return sp.simplify(sp.expand(expr)) == 0


def part(found: lg.Why, number: int) -> str:
    """The text of a part of the page in one line."""
    return " ".join(str(item) for item in found.parts[number].items)


# -- loads ----------------------------------------------------------------------------------------------------------

WINCH = """name = "winch"
[coordinates]
psi = "{sense}"
z = "bucket, downwards"
[parameters]
I = "0.3 kg*m^2"
M = "4 kg"
m = "2 kg"
r = "0.2 m"
k = "900 N/m"
d = "0.1 N*m*s"
[inputs]
Q = "N*m"
[[rigid_body]]
name = "wheel"
mass = "M"
inertia = "I"
at = [0, 0]
frame = "{angle}"
[[particle]]
name = "bucket"
mass = "m"
at = ["r", "-z"]
[[spring]]
name = "cable"
k = "k"
deflection = "z - r*psi"
[[damper]]
name = "axle"
b = "d"
deflection = "psi"
[[torque]]
name = "motor"
value = "Q"
on = "psi"
"""


@pytest.mark.parametrize(("sense", "angle", "sign"), [("counter-clockwise", "psi", 1), ("clockwise", "-psi", -1)])
def test_a_torque_acts_on_a_body_whichever_way_its_angle_is_counted(sense: str, angle: str, sign: int) -> None:
    """By hand: I ψ̈ = Q − d ψ̇ + r k (z − r ψ) about the axle; what the cable does is not described as a load."""
    d = lg.loads(WINCH.format(sense=sense, angle=angle)).derive()
    s, psi = d.model.symbols, d.model.coordinates[0]
    (moment,) = d.why.constraint_moments["wheel"]
    assert vanishes(moment - sign * (s["I"] * psi.acceleration + s["d"] * psi.rate - s["Q"]))
    said = part(d.why, 0)
    assert "without mass" not in said and "damper 'axle' and torque 'motor' act on it" in said.replace(
        "Damper", "damper"
    )
    assert "Spring 'cable' is described by how far it is stretched or turned." in said
    assert all(check.holds for check in d.why.checks)


def test_a_force_along_a_slide_on_a_body_that_turns_pushes_back_on_it() -> None:
    """A tool on an arm that turns with α: the force P on s pushes the tool outward, and the arm back through the tool's
    place, beside its centre of mass: about that the arm feels P c, with c the offset of the slide."""
    s = lg.System("tool on an arm")
    alpha, x, c, P = s.coordinate("alpha"), s.coordinate("s"), s.parameter("c"), s.input("P")
    arm = s.frame(alpha)
    s.rigid_body(s.parameter("M"), s.parameter("J"), at=s.origin, frame=arm, name="arm")
    s.particle(s.parameter("m"), at=arm.point(x, c), name="tool")
    s.force(P, deflection=x)
    why = s.derive().why
    assert "without mass" not in part(why, 0)
    J, turn = s.model.symbols["J"], s.model.coordinates[0].acceleration
    (moment,) = why.constraint_moments["arm"]
    assert vanishes(moment - (J * turn - P * c))
    assert all(check.holds for check in why.checks)


def test_an_energy_does_not_say_on_which_masses_it_acts() -> None:
    s = lg.System("field")
    x = s.coordinate("x")
    s.particle(s.parameter("m"), at=s.origin + (x, 0), name="bead")
    s.potential(s.parameter("c") * x**4, name="field")
    why = s.derive().why
    assert "described by an energy or a generalized force" in part(why, 0) and "without mass" not in part(why, 0)
    assert all(check.holds for check in why.checks)


@pytest.mark.parametrize("name", ("lecture-1", "lecture-2", "pendulum"))
def test_a_lever_without_mass_is_called_so(name: str) -> None:
    assert "at one end at least, on a part without mass" in part(derivation(name).why, 0)
