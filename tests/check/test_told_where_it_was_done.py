"""A mistake is told where it was done: in a derivative, a place of a body that is carried around, an acceleration.

Oracle: by hand. A seat m on a bar l that hangs from a crown at the distance a from its axis, which turns with Ω:

    T* = ½ m (l² θ̇² + Ω² (a + l sin θ)²),   ∂T*/∂θ = m Ω² (a + l sin θ) l cos θ,   V = −m g l cos θ

and a hammer (m) with a hinge on a disc (J), with friction in the hinge, β relative to the disc.
"""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

from lagrangian import Derivation, System
from lagrangian.model import time


@cache
def swing(*, lifted: bool = False) -> Derivation:
    """A seat on a bar, on a crown that turns and may be lifted."""
    sys = System("swing")
    theta = sys.coordinates("theta")
    m, l, a, Omega, c, g, A, w = sys.parameters("m l a Omega c g A w")
    crown = sys.frame(Omega * time, name="crown", axis=(0, 0, 1))
    height = A * sin(w * time) if lifted else 0
    sys.particle(m, at=crown.point(a + l * sin(theta), 0, height - l * cos(theta)), name="seat")
    sys.gravity((0, 0, -1), g)
    sys.damper(c, deflection=theta)
    return sys.derive()


@cache
def mill() -> Derivation:
    """A hammer on a disc."""
    sys = System("mill")
    phi, beta = sys.coordinates("phi beta")
    J, m, e, a, b, c = sys.parameters("J m e a b c")
    tau = sys.inputs("tau")
    disc, arm = sys.frame(phi, name="disc"), sys.frame(phi + beta, name="hammer")
    sys.rigid_body(0, J, at=sys.origin, frame=disc, name="disc")
    tip = (e * cos(phi) + a * cos(phi + beta), e * sin(phi) + a * sin(phi + beta))
    sys.rigid_body(m, 0, at=sys.point("S", tip), frame=arm, name="hammer")
    sys.damper(b, deflection=phi)
    sys.damper(c, deflection=beta)
    sys.torque(tau, on=phi)
    return sys.derive()


def told(system: Derivation, answer: str) -> list[str]:
    """What is said of a wrong answer, its best explanation first."""
    verdict = system.check(answer)
    assert not verdict.right
    return [" ".join(str(m.what).split()) for m in verdict.mistakes]


DERIVED = """T = 1/2 m (l^2 theta'^2 + Omega^2 (a + l sin(theta))^2)
V = -m g l cos(theta)
dT/dtheta = {}
m l^2 theta'' - ({}) + m g l sin(theta) = -c theta'"""
SLOPE = "m Omega^2 (a + l sin(theta)) l cos(theta)"


@pytest.mark.parametrize(
    ("slope", "said"),
    [
        ("m Omega^2 (a + l sin(theta))", "the factor l*cos(theta) is missing"),
        ("m Omega^2 (a + l sin(theta)) cos(theta)", "the factor l is missing"),
    ],
)
def test_the_inner_derivative_of_a_sum_is_told(slope: str, said: str) -> None:
    assert swing().check(DERIVED.format(SLOPE, SLOPE)).right
    first, *others = told(swing(), DERIVED.format(slope, slope))
    assert said in first and not others
    why = swing().check(DERIVED.format(slope, slope)).mistakes[0].why
    assert ("chain rule" in str(why)) == ("cos" in said)


def test_the_inner_derivative_of_a_deflection_is_told_without_a_sine() -> None:
    sys = System("lift")
    y, phi = sys.coordinates("y phi")
    m, J, r, k = sys.parameters("m J r k")
    sys.particle(m, at=sys.point("P", (0, y)), name="cabin")
    sys.rigid_body(0, J, at=sys.origin, frame=sys.frame(phi, name="drum"), name="drum")
    sys.spring(k, deflection=r * phi - y)
    answer = "T = 1/2 m y'^2 + 1/2 J phi'^2\nV = 1/2 k (r phi - y)^2\ndV/dphi = {}\nJ phi'' + {} = 0\n"
    answer += "m y'' - k (r phi - y) = 0"
    lift = sys.derive()
    assert lift.check(answer.format("k r (r phi - y)", "k r (r phi - y)")).right
    verdict = lift.check(answer.format("k (r phi - y)", "k (r phi - y)"))
    assert not verdict.right
    assert str(verdict.mistakes[0].why) == "The chain rule: r*phi - y has the inner derivative r."


def test_where_nothing_is_found_a_line_is_named() -> None:
    slope = "m Omega^2 (a + l cos(theta)) sin(theta)^3"
    verdict = swing().check(DERIVED.format(slope, slope))
    assert not verdict.right and not verdict.mistakes
    text = " ".join(verdict.to_text().split())
    assert "these are the places" not in text and "go through line 3 once more, term by term" in text


def test_what_belongs_to_one_relative_coordinate_is_counted_in_every_equation() -> None:
    answer = "T = 1/2 J phi'^2 + 1/2 m (e^2 phi'^2 + a^2 (phi' + beta')^2 + 2 e a phi' (phi' + beta') cos(beta))\n"
    answer += "Q_phi = tau - b phi' {}\nQ_beta = -c beta'"
    assert mill().check(answer.format("")).right
    assert "in every" in told(mill(), answer.format("- c beta'"))[0]


CARRIED = """r = {0}, z = -l cos(theta)
T = 1/2 m (l^2 theta'^2 + Omega^2 ({0})^2)
V = m g z
m l^2 theta'' - m Omega^2 ({0}) l cos(theta) + m g l sin(theta) = -c theta'"""


def test_a_place_on_what_turns_by_itself_is_judged_though_only_its_value_is_used() -> None:
    right = swing().check(CARRIED.format("a + l sin(theta)"))
    assert right.right and not right.notes
    wrong = CARRIED.format("l sin(theta)")
    first, *others = told(swing(), wrong)
    assert first.startswith("Line 1 is not right") and "is a + l*sin(theta), not l*sin(theta)" in first and not others
    assert [f.follows for f in swing().check(wrong).findings if not f.status.right] == [False, True, True]


@cache
def bridge() -> Derivation:
    """A leaf with a weight on a rope, h = 2 l sin(θ/2)."""
    sys = System("bridge")
    theta = sys.coordinates("theta")
    J, m, l, c, g = sys.parameters("J m l c g")
    F = sys.inputs("F")
    leaf = sys.frame(-theta, name="leaf")
    sys.rigid_body(0, J, at=sys.origin, frame=leaf, name="leaf")
    weight = sys.point("W", (0, 2 * l * sin(theta / 2)))
    sys.particle(m, at=weight, name="weight")
    sys.gravity((0, -1), g)
    sys.damper(c, deflection=theta)
    sys.force((0, -F), at=weight)
    return sys.derive()


BALANCES = """weight: m h'' = S - m g - F, h'' = {}
leaf: J theta'' = -S l cos(theta/2) - c theta'
(J + m l^2 cos(theta/2)^2) theta'' {} + c theta' + (m g + F) l cos(theta/2) = 0"""
FULL = ("l cos(theta/2) theta'' - l/2 sin(theta/2) theta'^2", "- m l^2/2 sin(theta/2) cos(theta/2) theta'^2")


@pytest.mark.slow
def test_a_wrong_acceleration_is_told_before_what_follows_from_it() -> None:
    assert bridge().check(BALANCES.format(*FULL)).right
    for short in ("l cos(theta/2) theta''", "-l cos(theta/2) theta''"):
        first, *others = told(bridge(), BALANCES.format(short, ""))
        assert first.startswith("Line 1 is not right: the y component of the acceleration") and not others
    turned = told(bridge(), BALANCES.format(FULL[0].replace("l/2", "l"), FULL[1].replace("l^2/2", "l^2")))
    assert turned[0].startswith("Line 1 is not right")
    other = told(bridge(), BALANCES.format(FULL[0], ""))  # the acceleration is right: the equation has it wrong
    assert "Line 1" not in other[0]


FROM_A_LENGTH = """s = 2 l sin({0}), s' = {1} theta'
T = 1/2 J theta'^2 + 1/2 m ({1})^2 theta'^2
V = 2 m g l sin({0})
Q = {2}"""


def test_a_force_on_a_body_follows_from_its_wrong_place() -> None:
    force = "-c theta' - F ({})"
    right = ("theta/2", "l cos(theta/2)")
    assert bridge().check(FROM_A_LENGTH.format(*right, force.format(right[1]))).right
    wrong = ("theta", "2 l cos(theta)")
    first, *others = told(bridge(), FROM_A_LENGTH.format(*wrong, force.format(wrong[1])))
    assert first.startswith("Line 1 is not right: the y coordinate") and not others
    assert first.endswith("is 2*l*sin(theta/2), not 2*l*sin(theta).")


@pytest.mark.parametrize("force", ["-c theta' - F l", "-c theta' + 2 F l cos(theta)", "-F l cos(theta/2)"])
def test_what_is_said_first_comes_first_where_something_else_is_wrong_below(force: str) -> None:
    first, second = told(bridge(), FROM_A_LENGTH.format("theta", "2 l cos(theta)", force))
    assert first.startswith("Line 1 is not right: the y coordinate")
    assert not second.startswith("Line 1 ")


def test_a_place_is_counted_from_where_the_answer_counts_it() -> None:
    wrong = FROM_A_LENGTH.format("theta", "2 l cos(theta)", "-c theta' - 2 F l cos(theta)")
    above = wrong.replace("s = 2 l sin(theta)", "s = 2 l sin(theta) + 3 l")
    first = told(bridge(), above)[0]
    assert "2*l*sin(theta/2) + 3*l, not 2*l*sin(theta) + 3*l" in first


PUT_TOGETHER = "m l^2 theta'' - m A w^2 l sin(theta) sin(w t) {} + m g l sin(theta) = -c theta'"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("term", "said", "squares"),
    [
        ("- 2 m Omega^2 (a + l sin(theta)) l cos(theta)", ": it counts twice.", True),
        ("- m Omega^2 (a + l sin(theta)) l cos(theta)/2", ": it counts half.", False),
        (
            "- m Omega^2 (a + l sin(theta)) l sin(theta)",
            "(a + l*sin(theta))*sin(theta), the factor sin(theta) stands in place of cos(theta).",
            False,
        ),
    ],
)
def test_what_differs_in_a_product_is_told_of_its_term(term: str, said: str, squares: bool) -> None:
    assert swing(lifted=True).check(PUT_TOGETHER.format("- m Omega^2 (a + l sin(theta)) l cos(theta)")).right
    verdict = swing(lifted=True).check(PUT_TOGETHER.format(term))
    assert not verdict.right
    first = verdict.mistakes[0]
    assert str(first.what).endswith(said), str(first.what)
    assert ("derivative of a square" in str(first.why)) == squares


def test_a_weight_that_counts_twice_is_derived_from_no_square() -> None:
    answer = PUT_TOGETHER.format("- m Omega^2 (a + l sin(theta)) l cos(theta)").replace("m g", "2 m g")
    verdict = swing(lifted=True).check(answer)
    assert not verdict.right and "derivative of a square" not in str(verdict.mistakes[0].why)
