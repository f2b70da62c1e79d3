"""Lines of kinematics that no other line uses are judged: rates of points, deflections, velocities in words.

An energy in which one of them is another one is told by it.

Oracle: by hand, a wheel on a spring with a pendulum of length s at its axle, r counted to the right, heights upwards:

    (M + m + J/R²) ẍ + m s θ̈ cos θ − m s θ̇² sin θ + k x + b ẋ = 0
    m s² θ̈ + m s ẍ cos θ + m g s sin θ = 0
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

from lagrangian import CheckedAnswer, Derivation, System
from lagrangian.model import time

BOB = "m s^2 theta'' + m s x'' cos(theta) + m g s sin(theta) = 0"
WHEEL = "(M + m + J/R^2) x'' + m s theta'' cos(theta) - m s theta'^2 sin(theta) + k x + b x' = 0"
T = "T = 1/2 (M + J/R^2) x'^2 + 1/2 m (x'^2 + s^2 theta'^2 + 2 s x' theta' cos(theta))"


def turned(lines: str) -> str:
    """The lines with the other sign of the pendulum's velocity against that of the axle."""
    return (
        lines.replace("+ 2 s x'", "- 2 s x'").replace("+ m s theta''", "- m s theta''")
        .replace("- m s theta'^2", "+ m s theta'^2").replace("+ m s x''", "- m s x''")
    )  # fmt: skip


@cache
def wheel() -> Derivation:
    """A wheel that rolls, on a spring and a damper, with a pendulum at its axle."""
    sys = System("wheel with a pendulum")
    x, theta = sys.coordinates("x theta")
    M, J, R, m, s, k, b, g = sys.parameters("M J R m s k b g", M=9, J=2, R=0.4, m=0.7, s=0.6, k=30, b=2, g=9.81)
    axle = sys.point("A", (x, R))
    sys.rigid_body(M, J, at=axle, frame=sys.frame(-x / R, name="wheel"), name="wheel")
    sys.particle(m, at=sys.point("B", (x + s * sp.sin(theta), R - s * sp.cos(theta))), name="bob")
    sys.gravity(direction=(0, -1), g=g)
    sys.spring(k, deflection=x, name="spring")
    sys.damper(b, deflection=x, name="brake")
    return sys.derive()


@cache
def planet() -> Derivation:
    """A planet wheel on an arm around a wheel; its angle γ is defined in the system."""
    sys = System("planet")
    alpha, beta = sys.coordinates("alpha beta")
    J, Jp, Ja, R, r, c, M = sys.parameters("J J_p J_a R r c M")
    gamma = sys.define("gamma", ((R + r) * alpha - R * beta) / r)
    sys.rigid_body(1, J, at=sys.origin, frame=sys.frame(beta, name="sun"), name="sun")
    sys.rigid_body(1, Ja, at=sys.origin, frame=sys.frame(alpha, name="arm"), name="arm")
    sys.rigid_body(1, Jp, at=sys.origin, frame=sys.frame(gamma, name="planet"), name="planet")
    sys.damper(c, deflection=gamma - alpha, name="bearing")
    sys.torque(M, on=beta, name="motor")
    return sys.derive()


def found(verdict: CheckedAnswer) -> list[tuple[int, bool, bool]]:
    """The number of every line with a verdict, whether it is right, and whether it is wrong because of another."""
    return [(f.line.number, f.status.right, f.follows) for f in verdict.findings]


SAID = ["xB' = x' - s theta' cos(theta)", r"$\dot x_B = \dot x - s\dot\theta\cos\theta$"]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("said", [*SAID, "velocity of the bob to the right: x' - s theta' cos(theta)"])
def test_a_wrong_velocity_that_nothing_uses_is_the_mistake(said: str) -> None:
    verdict = wheel().check("\n".join([said, turned(T), turned(WHEEL), turned(BOB)]))
    assert found(verdict) == [(1, False, False), (2, False, True), (3, False, True), (4, False, True)]
    (mistake,) = verdict.mistakes
    assert str(mistake.what) == (
        "Line 1 is not right: the x component of the velocity of particle 'bob' is s*cos(theta)*theta' + x', "
        "not -s*cos(theta)*theta' + x': the term -s*cos(theta)*theta' has the wrong sign."
    )
    assert not any("not judged" in str(note) for note in verdict.notes)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("said", [*SAID, "velocity of the bob to the right: x' - s theta' cos(theta)"])
def test_a_right_velocity_is_marked_and_not_blamed(said: str) -> None:
    right = said.replace(" - s", " + s").replace(r"- s\dot", r"+ s\dot")
    verdict = wheel().check("\n".join([right, T, WHEEL, BOB]))
    assert verdict.right and verdict.findings[0].line.number == 1 and verdict.findings[0].status.right
    wrong = wheel().check("\n".join([right, turned(T), turned(WHEEL), turned(BOB)]))
    assert found(wrong)[:2] == [(1, True, False), (2, False, False)]


@pytest.mark.slow
def test_a_velocity_that_explains_nothing_is_neither_blamed_nor_right() -> None:
    """The bob's velocity is wrong in its line alone; another sign is wrong in T*."""
    verdict = wheel().check("\n".join(["xB' = x' - 2 s theta' cos(theta)", turned(T), turned(WHEEL), turned(BOB)]))
    assert not verdict.right and found(verdict)[0] == (2, False, False)
    assert wheel().check("\n".join(["xB' = x' - 2 s theta' cos(theta)", T, WHEEL, BOB]), hint=0).right


@pytest.mark.parametrize(
    "said", ["velocity of the bob relative to the axle: s theta'", "kinetic energy: x' + s theta'"]
)
def test_what_is_relative_or_no_velocity_is_not_judged(said: str) -> None:
    wrong = T.replace("x'^2 + s^2 theta'^2 + 2 s x' theta' cos(theta)", "(s theta')^2")
    verdict = wheel().check("\n".join([said, wrong, "V = 1/2 k x^2 - m g s cos(theta)"]))
    assert not verdict.right and verdict.findings[0].line.number == 2


def test_a_wrong_deflection_is_the_mistake_of_V_and_of_D() -> None:
    """w is no angular velocity here, since it has no rates."""
    rows = [T, "V = 1/2 k (2 x)^2 - m g s cos(theta)", "D = 1/2 b (2 x')^2"]
    verdict = wheel().check("\n".join(["w = 2 x", *rows]))
    assert found(verdict) == [(1, False, False), (2, True, False), (3, False, True), (4, False, True)]
    assert str(verdict.mistakes[0].what).startswith("Line 1 is not right: the deflection of spring 'spring'")


ENERGIES = "T = 1/2 J beta'^2 + 1/2 J_a alpha'^2 + 1/2 J_p ((R + r) alpha' - R beta')^2/r^2\nV = 0"
D = "D = 1/2 c R^2/r^2 (alpha' - beta')^2\nQ_beta = M"


@pytest.mark.sampled(2)
@pytest.mark.parametrize("said", ["gamma' = ((R + r) alpha' - R beta')/r", "gamma' - alpha' = R/r (alpha' - beta')"])
def test_a_wrong_rate_of_an_angle_of_the_system_is_the_mistake(said: str) -> None:
    sheet = f"{said}\n{ENERGIES}\n{D}"
    assert planet().check(sheet, hint=0).right
    wrong = sheet.replace("- R beta'", "+ R beta'").replace("alpha' - beta'", "alpha' + beta'")
    verdict = planet().check(wrong)
    assert found(verdict)[:2] == [(1, False, False), (2, False, True)]
    assert [m.name for m in verdict.mistakes] == ["definition_wrong"]
    assert all(f.follows or f.status.right for f in verdict.findings[1:])
    slip = said.replace("- R", "+ R").replace("alpha' - beta'", "alpha' + beta'")
    assert not planet().check(f"{slip}\n{ENERGIES}\n{D}", hint=0).right


def test_what_is_said_once_more_of_the_rate_follows() -> None:
    said = "gamma' = ((R + r) alpha' + R beta')/r\ngamma' - alpha' = R/r (alpha' + beta')"
    wrong = f"{ENERGIES}\n{D}".replace("- R beta'", "+ R beta'").replace("alpha' - beta'", "alpha' + beta'")
    assert found(planet().check(f"{said}\n{wrong}"))[:2] == [(1, False, False), (2, False, True)]


@cache
def carried() -> Derivation:
    """A disc at a point that is moved in a prescribed way, on a spring and a damper that hang on what moves it, and a
    counterweight at half the way of a block on a turning arm."""
    sys = System("carried")
    phi, s = sys.coordinates("phi s")
    J, m, M, k, b, A, W = sys.parameters("J m M k b A W")
    u = sys.define("u", A * sp.sin(W * time))
    frame = sys.frame(phi, name="arm")
    sys.rigid_body(1, J, at=sys.origin, frame=frame, name="arm")
    sys.particle(m, at=frame.point(s, 0), name="block")
    sys.particle(M, at=frame.point(-s / 2, 0), name="counterweight")
    sys.spring(k, deflection=phi - u, name="coil")
    sys.damper(b, deflection=phi - u, name="oil")
    return sys.derive()


ARM = "1/2 J {arm}^2 + 1/2 m (s'^2 + s^2 phi'^2) + 1/2 M ({half}^2 + s^2 phi'^2/4)"
PARTS = {"arm": "phi'", "half": "(s'/2)", "coil": "(phi - u)", "oil": "(phi' - u')"}


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("part", "wrong", "told"),
    [
        ("arm", "(phi' - u')", "the angular velocity of rigid body 'arm' is phi', not phi' - u'"),
        ("arm", "(phi'/2)", "the angular velocity of rigid body 'arm' is phi', not phi'/2"),
        (
            "half",
            "s'",
            "the component of the velocity of particle 'counterweight' along the x axis turned by phi is s'/2",
        ),
    ],
)
def test_an_energy_with_another_rate_is_told_by_the_rate(part: str, wrong: str, told: str) -> None:
    right = ARM.format(**PARTS)
    V = "V = 1/2 k (phi - u)^2"
    assert "not right" not in carried().check(f"T = {right}\n{V}").to_text()
    verdict = carried().check(f"T = {ARM.format(**(PARTS | {part: wrong}))}\n{V}")
    assert str(verdict.mistakes[0].what).startswith(f"Line 1 is not right: {told}")
    assert len(verdict.mistakes) == 1


def test_a_damper_without_the_rate_of_a_driven_end_is_told_so() -> None:
    sheet = f"T = {ARM.format(**PARTS)}\nV = 1/2 k (phi - u)^2\nQ_phi = -b (phi' - u')\nQ_s = 0"
    assert carried().check(sheet, hint=0).right
    verdict = carried().check(sheet.replace("(phi' - u')", "phi'"))
    assert str(verdict.mistakes[0].what) == "The rate of damper 'oil' is taken as phi'; it is phi' - u'."


def test_a_rate_in_D_that_is_not_that_of_the_damper_is_told() -> None:
    absolute = D.replace("R^2/r^2 (alpha' - beta')^2", "((R + r) alpha' - R beta')^2/r^2")
    verdict = planet().check(f"{ENERGIES}\n{absolute}")
    assert "of damper 'bearing' is" in str(verdict.mistakes[0].what)
    assert "R*alpha'/r - R*beta'/r" in str(verdict.mistakes[0].what)
    assert verdict.mistakes[0].element == "damper 'bearing'"


def test_twice_an_energy_is_no_other_velocity() -> None:
    verdict = carried().check(f"T = {ARM.format(**PARTS).replace('1/2 J', 'J')}\nV = 1/2 k (phi - u)^2")
    assert "angular velocity" not in str(verdict.mistakes[0].what)
