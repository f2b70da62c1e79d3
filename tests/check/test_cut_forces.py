"""A line that says what a cut force is, from a balance of its own, is held against the balances that use it.

Oracle: a well's drum with a counterweight and a pail on an elastic rope, and a hoop that rolls with a beam at its axle
that a damper brakes; each answer is the right one but for what it says of one force.
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg

DRUM = "J phi'' = tau + Z R - S a - d phi'"
PAIL = "p y'' = S - p g"
ROPE = "S = k (a phi - y)"
RIGHT, RESTING = "Z = q (g - R phi'')", "Z = q g"
SUM = "J phi'' + k a (a phi - y) + d phi' = tau + q g R"
WHOLE = "(J + q R^2) phi'' + k a (a phi - y) + d phi' = tau + q g R"

HOOP = "M x'' = P - f - X"
BEAM = "m x'' = X\nI beta'' = -c (beta' + x'/a) - k beta"
SOLVED = "f = J x''/a^2"


@cache
def well() -> lg.Derivation:
    """A drum with a counterweight q at the radius R and a pail p on an elastic rope at the radius a."""
    s = lg.System("well")
    phi, y = s.coordinates("phi y")
    A, J, q, p, k, d, a, R, g = s.parameters("A J q p k d a R g")
    s.rigid_body(mass=A, inertia=J, at=s.point("O", (0, 0)), frame=s.frame(phi, name="drum"), name="drum")
    s.particle(q, at=s.point("C", (R, -R * phi)), name="counterweight")
    s.particle(p, at=s.point("E", (-a, y)), name="pail")
    s.gravity((0, -1), g)
    s.spring(k, deflection=a * phi - y, name="rope")
    s.damper(d, deflection=phi, name="bearing")
    s.torque(s.input("tau"), on=phi)
    return s.derive()


@cache
def hoop() -> lg.Derivation:
    """A hoop of radius a that rolls, with a beam at its axle that a spring holds and a damper between both."""
    s = lg.System("hoop and beam")
    x, beta = s.coordinates("x beta")
    M, J, m, I, k, c, a = s.parameters("M J m I k c a")
    O = s.point("O", (x, a))
    s.rigid_body(mass=M, inertia=J, at=O, frame=s.frame(-x / a, name="hoop"), name="hoop")
    s.rigid_body(mass=m, inertia=I, at=O, frame=s.frame(beta, name="beam"), name="beam")
    s.spring(k, deflection=beta, name="band")
    s.damper(c, deflection=beta + x / a, name="hub")
    s.force((s.input("P"), 0), at=O)
    return s.derive()


def told(derivation: lg.Derivation, answer: str) -> tuple[dict[int, bool], str]:
    """Which lines of a wrong answer are right, or follow, and what is said of it."""
    verdict = derivation.check(answer)
    assert not verdict.right
    lines = {f.line.number: f.status.right or f.follows for f in verdict.findings}
    return lines, " ".join(" ".join(str(m.what).split()) for m in verdict.mistakes)


def test_right_answers_are_right() -> None:
    assert well().check("\n".join([DRUM, PAIL, ROPE, RIGHT, WHOLE]), hint=0).right
    right = f"{HOOP}\nJ x''/a = f a - c (beta' + x'/a)\n{BEAM}\nf = J x''/a^2 + c (beta' + x'/a)/a"
    assert hoop().check(right, hint=0).right


@pytest.mark.parametrize("first", [True, False])
def test_a_rope_force_taken_as_the_weight_is_blamed_and_no_balance_that_uses_it(first: bool) -> None:
    own = [RESTING, ROPE, DRUM, PAIL, SUM] if first else [DRUM, PAIL, ROPE, RESTING, SUM]
    lines, said = told(well(), "\n".join(own))
    at = own.index(RESTING) + 1
    assert {k for k, right in lines.items() if not right} == {at}, lines
    assert f"In line {at}" in said and "q*R*phi''" in said.replace("R*q", "q*R") and "is missing" in said, said


def test_a_balance_that_is_wrong_beside_a_right_force_stays_the_wrong_one() -> None:
    lines, said = told(well(), "\n".join([DRUM.replace("Z R", "Z a"), PAIL, ROPE, RIGHT]))
    assert not lines[1] and lines.get(4, True) and "line 4" not in said, said


def test_a_weight_is_no_force_that_lacks_an_acceleration() -> None:
    _, said = told(well(), "\n".join(["W = q g", DRUM.replace("Z", "W"), PAIL, ROPE]))
    assert "In line 1" not in said, said


def test_a_moment_that_lacks_a_damper_is_blamed_where_a_force_is_solved_from_it() -> None:
    result = "(M + m + J/a^2) x'' = P"
    lines, said = told(hoop(), f"{HOOP}\nJ x''/a = f a\n{BEAM}\n{SOLVED}\n{result}")
    assert {k for k, right in lines.items() if not right} == {2}, lines
    assert said == "In line 2, the force of damper 'hub' is missing.", said
