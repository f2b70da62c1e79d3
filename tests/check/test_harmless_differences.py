"""Energies that differ from those of the system by what changes no equation."""

from __future__ import annotations

import pytest
import sympy

import lagrangian as lg
from built_in import derivation
from lagrangian.model import time


@pytest.fixture(scope="module")
def carried() -> lg.Derivation:
    """A slider on an arm whose joint is carried around by a table that turns steadily."""
    s = lg.System("carried arm")
    theta, r = s.coordinates("theta r")
    m, M, J, a, k, Omega = s.parameters("m M J a k Omega")
    table = s.frame(Omega * time, name="table")
    arm = s.frame(theta, parent=table, name="arm")
    joint = s.point("joint", (a, 0), frame=table)
    s.rigid_body(mass=M, inertia=J, at=joint, frame=arm, name="arm")
    s.particle(m, at=s.point("slider", (r, 0), relative_to=joint, frame=arm), name="slider")
    s.spring(k, deflection=r)
    return s.derive()


SLIDER = "m/2*((r' + a*Omega*sin(theta))^2 + (r*(theta' + Omega) + a*Omega*cos(theta))^2)"
ROWS = """(J + m r^2) theta'' + 2 m r r' (Omega + theta') + m a Omega^2 r sin(theta) = 0
m r'' - m r (Omega + theta')^2 - m a Omega^2 cos(theta) + k r = 0
"""


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("energy", "right"),
    [
        (f"T = {SLIDER} + J/2*(theta' + Omega)^2", True),
        (f"T = {SLIDER} + J/2*(theta' + Omega)^2 + M*a^2*Omega^2", True),
        (f"L = {SLIDER} + J/2*(theta' + Omega)^2 - k/2*r^2", True),
        (f"T = {SLIDER} + J/2*theta'^2", False),
        (f"T = {SLIDER} + J/2*theta'^2 + J/2*Omega^2", False),  # J Omega theta' is no constant
        (f"T = {SLIDER.replace('a*Omega*cos(theta)', '0')} + J/2*(theta' + Omega)^2", False),
    ],
)
def test_what_no_coordinate_and_no_rate_changes_may_be_left_out(
    carried: lg.Derivation, energy: str, right: bool
) -> None:
    verdict = carried.check(f"{energy}\n{ROWS}")
    assert verdict.right is right, verdict.to_text()
    assert ("M a² Ω², which no coordinate and no rate changes" in " ".join(verdict.to_text().split())) is right


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("energy", "right"),
    [
        ("m/2*(L^2*theta'^2 + 2*a*omega*L*theta'*sin(omega*t)*sin(theta))", True),
        ("m/2*(L^2*theta'^2 + 2*a*omega*L*theta'*sin(omega*t))", False),
        ("m/2*L^2*theta'^2 + m/2*a^2*omega^2*sin(omega*t)^2", False),
    ],
)
def test_what_only_a_prescribed_motion_changes_may_be_left_out(energy: str, right: bool) -> None:
    rows = "m L^2 theta'' = m L (g - a*omega^2*cos(omega*t)) sin(theta) - b theta'"
    verdict = derivation("kapitza-pendulum").check(f"T = {energy}\n{rows}")
    assert verdict.right is right, verdict.to_text()


U = "-m*g*R*cos(theta) - m/2*Omega^2*R^2*sin(theta)^2"
RELATIVE, WHOLE = "m/2*R^2*theta'^2", "m/2*R^2*(theta'^2 + Omega^2*sin(theta)^2)"
BEAD = "m R^2 theta'' + m g R sin(theta) - m R^2 Omega^2 sin(theta) cos(theta) = 0"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("sheet", "right"),
    [
        (f"U = {U}\n{BEAD}", True),
        (f"U = {U} + m*g*R\nT = {RELATIVE}\n{BEAD}", True),
        (f"T = {WHOLE}\nV = -m*g*R*cos(theta)\nU = {U}\n{BEAD}", True),
        (f"L = {RELATIVE} - ({U})\nU = {U}\n{BEAD}", True),
        (f"U = {U.replace('- m/2', '+ m/2')}\n{BEAD}", False),
        (f"U = {U.replace('- m/2', '- m')}\n{BEAD}", False),
        (f"U = {U}\nT = {WHOLE}\n{BEAD}", False),
        (f"U = {U}\nL = {WHOLE} - ({U})\n{BEAD}", False),
        (f"U = {U}\nT = {RELATIVE.replace('/2', '')}\n{BEAD}", False),
        (f"U = {U}\n{BEAD.replace('- m R', '+ m R')}", False),
        (f"U = {U}", False),
        (f"T = {RELATIVE}\nV = -m*g*R*cos(theta)\n{BEAD}", False),
    ],
)
def test_an_effective_potential_is_right_with_what_fits_it(sheet: str, right: bool) -> None:
    verdict = derivation("bead-on-hoop").check(sheet)
    assert verdict.right is right, verdict.to_text()


def test_the_letter_of_a_kinetic_energy_may_be_that_of_the_hamiltonian() -> None:
    sheet = f"p = m R^2 theta'\nK = {U} + p^2/(2 m R^2)\n{BEAD}"
    verdict = derivation("bead-on-hoop").check(sheet)
    assert verdict.right and "K in line 2 was read as the Hamiltonian" in verdict.to_text()
    for wrong in (sheet.replace("- m/2", "+ m/2"), sheet.replace("K =", "T ="), sheet.replace("-m*g", "+m*g")):
        assert not derivation("bead-on-hoop").check(wrong, hint=0).right
    assert derivation("bead-on-hoop").check(f"K = {WHOLE}\n{BEAD}", hint=0).right


TURNING = "J/2*(theta' + Omega)^2"
EXPANDED = "m/2*(r'^2 + r^2*(theta' + Omega)^2 + a^2*Omega^2 + {}*(r'*sin(theta) + r*(theta' + Omega)*cos(theta)))"
RELATIVE_ALONE = "In the velocity of particle 'slider', theta' alone stands in place of Omega + theta'."


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("energy", "name", "words"),
    [
        (f"{SLIDER.replace(chr(39) + ' + Omega', chr(39))} + {TURNING}", "relative_rate", RELATIVE_ALONE),
        (f"{EXPANDED.format('a*Omega')} + {TURNING}", "wrong_number", "count half"),
        (f"{EXPANDED.format('4*a*Omega')} + {TURNING}", "wrong_number", "count twice"),
        (f"{EXPANDED.format('(-2)*a*Omega')} + {TURNING}", "wrong_sign", "The products, in ½mv² of"),
        (f"{SLIDER} + J/2*theta'^2", "omega|left_out_of_a_sum", "Omega"),
    ],
)
@pytest.mark.parametrize("constant", ["", " + M/2*a^2*Omega^2", " + M*a^2*Omega^2"])
def test_a_mistake_is_named_whatever_constant_stands_beside_it(
    carried: lg.Derivation, energy: str, name: str, words: str, constant: str
) -> None:
    verdict = carried.check(f"T = {energy}{constant}")
    assert not verdict.right, verdict.to_text()
    assert len(verdict.mistakes) == 1 and verdict.mistakes[0].name in name.split("|"), verdict.to_text()
    assert words in " ".join(str(verdict.mistakes[0].what).split())
    if "omega" not in name:
        assert "the arm" not in verdict.to_text()  # nothing but a constant of it is missing


def test_a_constant_is_no_difference_of_a_wrong_energy(carried: lg.Derivation) -> None:
    energy = f"T = {SLIDER} + 7*r*theta'"
    [finding] = carried.check(f"{energy} + {TURNING}").findings
    assert {o.element for d in finding.differences for o in d.origins} <= {"particle 'slider'"}


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong", "named"),
    [
        ("2 m r r' (Omega + theta')", "2 m r r' theta'", True),
        ("m r (Omega + theta')^2", "m r theta'^2", True),
        ("m r (Omega + theta')^2", "m r (theta'^2 + Omega^2)", False),
        ("m r (Omega + theta')^2", "m r (2*Omega + theta')^2", False),
    ],
)
def test_a_relative_rate_in_one_equation_is_named(carried: lg.Derivation, right: str, wrong: str, named: bool) -> None:
    verdict = carried.check(ROWS.replace(right, wrong))
    assert verdict.status.value == "wrong"
    assert ("stands in place of θ̇ + Ω" in " ".join(verdict.to_text().split())) is named, verdict.to_text()
    assert carried.check(ROWS, hint=0).right


@pytest.mark.parametrize(("sign", "right"), [("-", True), ("+", False), ("- 2*", False)])
def test_a_potential_of_apparent_forces_is_right_beside_right_equations(sign: str, right: bool) -> None:
    s = lg.System("carried pendulum")
    theta = s.coordinate("theta")
    m, l, a, Omega = s.parameters("m l a Omega")
    pin = s.point("pin", (a * sympy.cos(Omega * time), a * sympy.sin(Omega * time)))
    s.particle(m, at=s.point("bob", (l * sympy.sin(theta), -l * sympy.cos(theta)), relative_to=pin))
    s.gravity(direction=(0, -1))
    sheet = f"""U = -m g l cos(theta) {sign} m l a Omega^2 sin(theta - Omega t)
m l^2 theta'' + m g l sin(theta) - m l a Omega^2 cos(theta - Omega t) = 0
"""
    assert s.derive().check(sheet, hint=0).right is right


def test_constants_are_not_what_is_told_of_a_wrong_energy() -> None:
    """A constant that belongs to another term, and what moves as prescribed alone, are in no term that is told."""
    sys = lg.System("shaken")
    x, y = sys.coordinates("x y")
    m, J, g, l, e, Omega, alpha = sys.parameters("m J g l e Omega alpha")
    sys.kinetic(J * sympy.diff(y, time) ** 2 / 2, name="wheel")
    place = (e * sympy.cos(Omega * time), x + y + e * sympy.sin(Omega * time))
    sys.particle(m, at=sys.point("P", place), name="bob")
    sys.potential(m * g * (x * sympy.sin(alpha) + l * (1 - sympy.cos(y))), name="weight")
    shaken = sys.derive()
    kinetic, potential = (
        "T = J y'^2/2 + m (x' + y' + e Omega cos(Omega t))^2/2",
        "V = m g x sin(alpha) + m g l (1 - cos(y))",
    )
    assert shaken.check(f"{kinetic}\n{potential}").right
    found = shaken.check(f"{kinetic}\nV = m g l (1 - cos(y))")
    assert not found.right
    assert [(d.kind, d.written) for f in found.findings for d in f.differences] == [("missing", 0)]
    found = shaken.check(kinetic.replace("x' + y'", "x'") + f"\n{potential}")
    assert not found.right
    assert not any(d.term.has(sympy.sin) for f in found.findings for d in f.differences)
