"""Energies, forces and whole hand derivations, line by line; and answers that are none."""

from functools import cache

import pytest

import lagrangian as lg
from built_in import derivation as derived
from effort import at_most
from lagrangian.check import Status

HAND = """
# example 3B by hand
T = m1*x1'^2/2 + m2*(x1' + x2r')^2/2
V = k*x2r^2/2
L = T - V
L = m1*x1'^2/2 + m2*(x1'^2 + 2*x1'*x2r' + x2r'^2)/2 - k*x2r^2/2
Xi_x1 = 0
Xi_x2r = F
dL/dx1' = m1*x1' + m2*(x1' + x2r')
(1) (m1 + m2)*x1'' + m2*x2r'' = 0
(2) m2*x1'' + m2*x2r'' + k*x2r = F
"""


CALLS = 10_000_000
"""Of Python functions, that any one of these takes at most."""


def test_a_right_derivation() -> None:
    verdict = derived("lecture-3b").check(HAND)
    assert verdict.status is Status.RIGHT
    assert {f.line.kind for f in verdict.findings} >= {"T", "V", "L", "Xi", "p", "equation"}


def test_the_first_wrong_line_is_named_and_what_follows_is_said_to_follow() -> None:
    wrong = HAND.replace("m2*(x1' + x2r')^2", "m2*x2r'^2").replace("(x1'^2 + 2*x1'*x2r' + x2r'^2)", "x2r'^2")
    wrong = wrong.replace("m1*x1' + m2*(x1' + x2r')\n", "m1*x1'\n")
    wrong = wrong.replace("(m1 + m2)*x1'' + m2*x2r'' = 0", "m1*x1'' = 0").replace("m2*x1'' + m2*x2r''", "m2*x2r''")
    verdict = derived("lecture-3b").check(wrong)
    assert verdict.status is Status.WRONG
    assert verdict.first_wrong is not None and verdict.first_wrong.line.kind == "T"
    later = [f for f in verdict.findings if not f.status.right][1:]
    assert len(later) >= 4 and all(f.follows for f in later)
    assert [m.name for m in verdict.mistakes] == ["relative_speed"]


def test_a_second_mistake_does_not_follow() -> None:
    wrong = HAND.replace("V = k*x2r^2/2", "V = k*x2r^2").replace("Xi_x1 = 0", "Xi_x1 = -F")
    verdict = derived("lecture-3b").check(wrong)
    assert {m.name for m in verdict.mistakes} == {"spring_half_forgotten", "counted_without_work"}
    assert not any(f.follows for f in verdict.findings if f.line.kind in ("V", "Xi"))


@pytest.mark.parametrize(
    ("name", "answer", "status"),
    [
        ("pendulum", "V = m*g*L*(1 - cos(theta))", Status.EQUIVALENT),
        ("pendulum", "V = -m*g*L*cos(theta)", Status.RIGHT),
        ("pendulum", "V = -m*g*L*cos(theta) + theta", Status.WRONG),
        ("pendulum", "L = m*L^2*theta'^2/2 + m*g*L*cos(theta) + 3*theta'*theta^2", Status.EQUIVALENT),
        ("pendulum", "L = m*L^2*theta'^2/2 + m*g*L*cos(theta) + theta'^3", Status.WRONG),
        ("pendulum", "T = m*((L*cos(theta)*theta')^2 + (L*sin(theta)*theta')^2)/2", Status.RIGHT),
        ("pendulum", "T = m*L^2*theta'^2", Status.WRONG),
        ("pendulum", "Xi = -b*theta'", Status.RIGHT),
        ("pendulum", "Xi = 0", Status.WRONG),
        ("pendulum", "Xi = 0\nm*L^2*theta'' + b*theta' + m*g*L*sin(theta) = 0", Status.EQUIVALENT),
        ("quarter-car", "V = k_s*(z_s - z_u)^2/2 + k_t*z_u^2/2 - k_t*z_u*z_r", Status.EQUIVALENT),
        ("lecture-3b", "Xi_x1 = 0", Status.RIGHT),
        ("lecture-3b", "Xi_x2r = F", Status.RIGHT),
        ("lecture-3b", "Xi_x1 = -F", Status.WRONG),
        ("two-disk-shaft", "D = b*(phi1' - phi2')^2/2 + b_load*phi2'^2/2", Status.RIGHT),
    ],
)
def test_energies_and_forces(name: str, answer: str, status: Status) -> None:
    assert derived(name).check(answer).status is status


def test_what_says_nothing() -> None:
    pendulum = derived("pendulum")
    assert pendulum.check("0 = 0").status is Status.INCOMPLETE
    assert pendulum.check("m*L^2*theta'' + b*theta' + m*g*L*sin(theta) = 0\n0 = 0").right
    empty = pendulum.check("h = L*(1 - cos(theta))")
    assert not empty.right and "Nothing is stated" in empty.to_text()


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "answer",
    [
        "(theta + theta' + theta'' + m + L + g + b + 1)^60*(theta + theta'' + 2)^60 = 0",
        " + ".join(f"sin({k}*theta)*cos(theta')^{k}*theta''" for k in range(1, 40)) + " = 0",
        "sqrt(theta - 100)*theta'' = 0",
        "1/(theta - theta + m - m + 1e-30)*theta'' = 0",
        "theta''/sin(theta - theta + 0.5) + exp(exp(exp(exp(theta)))) = 0",
        "m*L^2*theta'' + b*theta' + m*g*L*sin(theta) = 1e-40*theta",
        "abs(theta'')*m*L^2 + b*theta' + m*g*L*sin(theta) = 0",
        "m*L^2*theta'' + b*theta' + m*g*L*sqrt(1 - cos(theta)^2) = 0",
        "m*L^2*theta'' + b*theta' + m*g*L*sin(theta) + piecewise(theta > 100, theta, 0) = 0",
        "m*L^2*theta'' + b*theta' + m*g*L*sin(theta) + piecewise(theta > 10000000, theta, 0) = 0",
        "m*L^2*theta'' + b*max(theta', -20) + m*g*L*sin(theta) = 0",
    ],
)
def test_odd_answers_are_wrong_with_bounded_effort(answer: str) -> None:
    known = derived("pendulum")
    with at_most(CALLS):
        assert not known.check(answer).right


@cache
def seat() -> lg.Derivation:
    """A seat on a spring, a damper and an actuator on a car that heaves z and pitches p."""
    s = lg.System("seat on a car")
    z, p, w = s.coordinates("z p w")
    M, J, m, k, b, e = s.parameters("M J m k b e")
    s.rigid_body(M, J, at=s.origin + (0, z), frame=s.frame(p, name="car"), name="car")
    s.particle(m, at=s.origin + (e, w), name="driver")
    s.spring(k, deflection=w - z - e * p, name="spring")
    s.damper(b, deflection=w - z - e * p, name="damper")
    s.force(s.inputs("u"), deflection=w - z - e * p, name="actuator")
    return s.derive()


ENERGIES = "T = M*z'^2/2 + J*p'^2/2 + m*w'^2/2\nV = k*(w - z - e*p)^2/2\nD = b*(w' - z' - e*p')^2/2\n"
FORCES = "Xi_z = -u\nXi_p = -e*u\nXi_w = u\n"
SEAT = (
    "M*z'' - b*(w' - z' - e*p') - k*(w - z - e*p) = -u\n"
    "J*p'' - e*b*(w' - z' - e*p') - e*k*(w - z - e*p) = -e*u\n"
    "m*w'' + b*(w' - z' - e*p') + k*(w - z - e*p) = u"
)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("wrong", "right", "said"),
    [
        (
            "- e*p",
            "+ e*p",
            "deflection of spring 'spring' and damper 'damper' is taken as e*p + w - z",
        ),  # the deflection in V and in D
        ("Xi_z = -u\nXi_p = -e*u", "Xi_z = 0\nXi_p = 0", "to the equations of z and p is missing"),
    ],
)
def test_equations_follow_from_wrong_energies_beside_a_dissipation_function(wrong: str, right: str, said: str) -> None:
    """Ξ is written without the damper, which D holds; only the lines above the equations need a correction."""
    force = "Xi" in right
    rows = SEAT.replace("= -u", "= 0").replace("= -e*u", "= 0") if force else SEAT.replace("- e*", "+ e*")
    verdict = seat().check((ENERGIES + FORCES).replace(wrong, right) + rows)
    assert all(f.follows or f.status.right for f in verdict.findings if f.line.kind == "equation")
    said_first, *more = [str(m.what) for m in verdict.mistakes]
    assert said in said_first and len(more) == 0, (said_first, more)


def test_a_force_that_is_right_elsewhere_is_not_explained() -> None:
    """Q_1 may be meant as that of another coordinate."""
    verdict = derived("lecture-3b").check("Xi_x1 = 0\nXi_x1 = F")
    assert not verdict.right and not verdict.mistakes


@pytest.mark.slow
def test_letters_exchanged_in_springs_and_dampers_are_one_mistake() -> None:
    s = lg.System("beam")
    z, p = s.coordinates("z p")
    M, J, k, e, b, d = s.parameters("M J k e b d")
    a, c = (s.parameter(x, unit="m") for x in ("a", "c"))
    s.rigid_body(M, J, at=s.origin + (0, z), frame=s.frame(p, name="beam"), name="beam")
    for size, along, name in ((k, z + a * p, "front"), (e, z - c * p, "rear")):
        s.spring(size, deflection=along, name=f"{name} spring")
    s.damper(b, deflection=z + a * p, name="front damper")
    s.damper(d, deflection=z - c * p, name="rear damper")
    lines = "T = M*z'^2/2 + J*p'^2/2\nV = k*(z + c*p)^2/2 + e*(z - a*p)^2/2\nD = b*(z' + c*p')^2/2 + d*(z' - a*p')^2/2"
    (mistake,) = s.derive().check(lines).mistakes
    assert mistake.name == "exchanged" and "whole derivation" in str(mistake.what), str(mistake.what)


def test_a_mistake_in_a_derivative_is_told_at_its_line() -> None:
    rate = "d/dt(dL/dx') = (M+m)*x'' + m*l*cos(theta)*theta''\n"
    pole = "(J+m*l^2)*theta'' + m*l*cos(theta)*x'' - m*g*l*sin(theta) = 0\n"
    row = "(M+m)*x'' + b*x' + m*l*cos(theta)*theta'' = F"
    for rows in (pole, f"{pole}{row}"):
        verdict = derived("cart-pole").check(rate + rows)
        (mistake,) = verdict.mistakes
        assert mistake.name == "product_rule" and verdict.first_wrong.line.number == 1, str(mistake.what)
