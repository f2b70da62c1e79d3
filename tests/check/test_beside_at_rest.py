"""What right equations have beside them is judged where it says something: positions at rest, and checks.

Oracle: two hanging masses, k1 y1 = 2 m g and k2 (y2 − y1) = m g at rest; a lever of two ropes, which rests for
m1 R = m2 r alone.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from test_forces_between_bodies import wheel

import lagrangian as lg

HANGING = "m y1'' + k1 y1 - k2 (y2 - y1) = m g\nm y2'' + k2 (y2 - y1) = m g"
DRUM = "(J + m_2 r^2) phi'' + k R (R phi - y) + m_2 g r = tau\nm_1 y'' - k (R phi - y) = m_1 g"


@cache
def hanging() -> lg.Derivation:
    s = lg.System("two hanging masses")
    y1, y2 = s.coordinates("y1 y2")
    m, k1, k2, g = s.parameters("m k1 k2 g")
    for name, y in (("A", y1), ("B", y2)):
        s.particle(m, at=s.point(name, (0, -y)))
    s.gravity((0, -1), g)
    s.spring(k=k1, deflection=y1)
    s.spring(k=k2, deflection=y2 - y1)
    return s.derive()


@cache
def drum() -> lg.Derivation:
    s = lg.System("drum")
    phi, y = s.coordinates("phi y")
    J, m_1, m_2, R, r, k, g = s.parameters("J m_1 m_2 R r k g")
    wheel = s.frame(-phi, name="drum")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=wheel, name="drum")
    s.particle(m_1, at=s.point("load", (R, -y)))
    s.particle(m_2, at=s.point("weight", (-r, r * phi)))
    s.gravity((0, -1), g)
    s.spring(k=k, deflection=y - R * phi)
    s.torque(s.inputs("tau"), on=phi)
    return s.derive()


@cache
def helicopter() -> lg.Derivation:
    """A pendulum that a rotor F raises, and a disc that its drag c F turns and a second rotor P holds."""
    s = lg.System("helicopter")
    theta, psi = s.coordinates("theta psi")
    J, m, l, c, d, g = s.parameters("J m l c d g")
    F, P = s.inputs("F P")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=s.frame(psi, name="disc"), name="disc")
    s.particle(m, at=s.point("ballast", (l * sp.sin(theta), -l * sp.cos(theta))))
    s.gravity((0, -1), g)
    s.torque(l * F, on=theta)
    s.torque(d * P - c * F, on=psi)
    return s.derive()


FLIES = "m l^2 theta'' + m g l sin(theta) = l F\nJ psi'' = d P - c F\n\n"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("line", "right"),
    [
        ("Rest with psi constant: F = m g sin(theta) and P = c F/d", True),
        ("At rest: l F = m g l sin(theta), d P = c F", True),
        ("Hovering at theta requires F = m g sin(theta), P = c m g sin(theta)/d.", True),
        ("One needs F = m g sin(theta) to hold it there.", True),
        ("Static: m g sin(theta) = F", True),
        ("Hover: F = m g cos(theta)", False),
        ("One needs P = -c F/d to hold it there.", False),
        ("One needs F = m g sin(theta) + c theta' to hold it there.", False),
        ("m g l sin(theta) = l F", False),  # nothing says that it is about rest
    ],
)
def test_what_inputs_hold_a_position(line: str, right: bool) -> None:
    assert helicopter().check(FLIES + line, hint=0).right is right


def test_what_inputs_hold_does_not_stand_for_an_equation_of_motion() -> None:
    rows = FLIES.replace("m l^2 theta'' + ", "")
    assert not helicopter().check(rows + "At rest: F = m g sin(theta)", hint=0).right
    assert not helicopter().check(FLIES.replace("d P - c F", "d P + c F") + "At rest: P = c F/d", hint=0).right


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("line", "right"),
    [
        ("y2 - y1 = m g/k2", True),
        ("y2 - y1 = -m g/k2", False),
        ("y1 = -2*m*g/k1", False),
        ("k1 y1 = 2 m g", True),
        ("At rest k1 y1 = m g", False),
        ("Statics: k1 y1 = 2 k2 (y2 - y1)", True),
        ("Im Gleichgewicht ist k1 y1 = k2 (y2 - y1)", False),
        ("k1 y1 = 2 k2 (y2 - y1)", False),  # nothing says that it is about rest
        ("Equilibrium:\nk1 y1 = 2 m g\ny2 = 2 m g/k1 + m g/k2", True),
        ("Equilibrium:\nk1 y1 = 2 m g\nk2 y2 = 2 m g", False),
        ("At t = 0 it is at rest: y1 = 0, y2 = 0", True),
        ("Check: the sum is m y1'' + m y2'' + k1 y1 = 2 m g", True),
        ("Check: the sum is m y1'' + m y2'' + k1 y1 = m g", False),
        ("Note: m y2'' - k2 (y2 - y1) = m g", False),
        ("Check: without gravity m y2'' + k2 (y2 - y1) = 0", True),
        ("Check: in free fall of the upper mass m y2'' + k2 y2 = m g", True),  # lacks a term, which words may explain
        ("Check: for y1 = 0 we have m y2'' + k2 y2 = m g", True),
    ],
)
def test_positions_at_rest_and_checks_are_judged(line: str, right: bool) -> None:
    verdict = hanging().check(f"{HANGING}\n{line}")
    assert verdict.right is right
    assert right or (verdict.motion and verdict.first_wrong.line.number > 2)


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("line", "right"),
    [
        ("Let e = y - R phi. In equilibrium with tau = 0 we have k e = m_1 g, so m_1 R = m_2 r.", True),
        ("Let e = y - R phi. In equilibrium with tau = 0 we have k e = m_1 g, so m_1 r = m_2 R.", False),
        ("Let e = y - R phi. In equilibrium k e = -m_1 g.", False),
        ("At rest tau = (m_2 r - m_1 R) g", True),
    ],
)
def test_rest_for_certain_parameters_alone(line: str, right: bool) -> None:
    assert drum().check(f"{DRUM}\n{line}", hint=0).right is right


@pytest.mark.slow
def test_forces_of_constraints_at_rest_are_a_remark() -> None:
    rows = "(m + M) x'' = F - k x - H\nJ phi'' = R H\nx' = R phi'"
    said = "Sanity: everything at rest -> F = k x, H = 0. OK!"
    assert wheel().check(f"{rows}\n{said}").right
    assert not wheel().check(f"{rows.replace('- H', '+ H')}\n{said}").right
    assert not wheel().check(f"{rows.rpartition(chr(10))[0].replace('R H', 'H')}\n{said}").right


@cache
def hoist() -> lg.Derivation:
    """A drum that hauls a load by a rope with damping, whose force holds rates."""
    s = lg.System("hoist")
    theta, x = s.coordinates("theta x")
    J, M, R, k, d, c, g = s.parameters("J M R k d c g")
    s.kinetic(J * theta.diff() ** 2 / 2, name="drum")
    s.particle(M, at=s.point("L", (0, x)), name="load")
    s.gravity((0, -1), g)
    s.spring(k, deflection=R * theta - x, name="rope")
    s.damper(d, deflection=R * theta - x, name="damping of the rope")
    s.damper(c, deflection=x, name="drag")
    s.torque(s.input("tau"), on=theta)
    return s.derive()


HOIST = "S = k (R θ − x) + d (R θ' − x')\nJ θ'' = τ - S R\nM x'' = S - c x' - M g\n"


@pytest.mark.parametrize(
    ("said", "forces"),
    [
        ("Check: at rest S = M g and τ = R M g. Plausible.", ["S = M g"]),
        ("Check: at rest S = M g, τ = M g R.", ["S = M g"]),
        ("At rest τ = R M g and S = M g.", ["S = M g"]),
        ("In equilibrium: S = M g, x = R θ - M g/k", ["S = M g", "x = R θ - M g/k"]),
        ("Check: S = M g and τ = R M g at rest.", ["S = M g"]),
        ("Check: at rest S = M g and\nτ = R M g.", ["S = M g"]),
        ("at rest S = τ/R", ["S = τ/R"]),
    ],
)
def test_all_that_words_of_rest_introduce_is_about_rest(said: str, forces: list[str]) -> None:
    verdict = hoist().check(HOIST + said)
    notes = [str(x) for x in verdict.notes]
    assert verdict.right
    assert all(f"'{force}' was not judged: it is about the position at rest." in notes for force in forces)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "Check: at rest S = 2 M g and τ = R M g.",
        "At rest τ = R M g and S = M g R.",
        "at rest S = τ R",
        "Check: S = M g",
        "S = M g and τ = R M g.",
    ],
)
def test_a_force_that_is_wrong_at_rest_or_not_said_to_be_there_is_wrong(said: str) -> None:
    assert not hoist().check(HOIST + said).right
