"""Answers by Newton's laws with forces of their own: the wrong line and its term, where few lines have each force.

Oracle: systems solved by hand; each answer differs from the right one in one term of one line.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg

CART = (
    "M x'' = F + X",
    "m (x'' + l phi'' cos(phi) - l phi'^2 sin(phi)) = -X",
    "m (l phi'' sin(phi) + l phi'^2 cos(phi)) = Y - m g",
    "J phi'' = X l cos(phi) - Y l sin(phi)",
)


@cache
def pendulum() -> lg.Derivation:
    """A cart with a rod; X and Y act at the pin."""
    s = lg.System("cart with a rod")
    x, phi = s.coordinates("x phi")
    M, m, J, l, g = s.parameters("M m J l g")
    s.kinetic(M * x.diff() ** 2 / 2 + J * phi.diff() ** 2 / 2)
    P = s.point("P", (x + l * sp.sin(phi), -l * sp.cos(phi)))
    s.particle(m, at=P)
    s.gravity((0, -1), g)
    s.force(s.input("F"), deflection=x)
    return s.derive()


@cache
def ring() -> lg.Derivation:
    """A ring on two cords, each with a weight on a spring; a wheel beside it."""
    s = lg.System("ring on two cords")
    z, phi = s.coordinates("z phi")
    M, m, k, J, c, g = s.parameters("M m k J c g")
    s.kinetic((M + 2 * m) * z.diff() ** 2 / 2 + J * phi.diff() ** 2 / 2)
    s.potential(k * z**2 + M * g * z)
    s.damper(c, deflection=phi)
    return s.derive()


@cache
def rope() -> lg.Derivation:
    """Two weights on a rope over a pulley, with the constraint of the rope."""
    s = lg.System("two weights on a rope")
    x, y = s.coordinates("x y")
    M, m, I, r, b, g, h = s.parameters("M m I r b g h")
    s.kinetic(m * x.diff() ** 2 / 2 + M * y.diff() ** 2 / 2 + I * (y.diff() / r) ** 2 / 2)
    s.potential(-m * g * x - M * g * y)
    s.damper(b, deflection=x)
    s.constraint(x + y - h)
    return s.derive()


@cache
def crank() -> lg.Derivation:
    """A uniform rod on a cart; its moment of inertia is m l²/12."""
    s = lg.System("cart with a uniform rod")
    x, phi = s.coordinates("x phi")
    M, m, l, g = s.parameters("M m l g")
    s.kinetic(M * x.diff() ** 2 / 2)
    centre = s.point("C", (x + l * sp.sin(phi) / 2, -l * sp.cos(phi) / 2))
    s.rigid_body(m, m * l**2 / 12, at=centre, frame=s.frame(phi))
    s.gravity((0, -1), g)
    return s.derive()


def changed(lines: tuple[str, ...], number: int, wrong: str) -> str:
    """An answer with one line replaced."""
    return "\n".join((*lines[: number - 1], wrong, *lines[number:]))


def said(derivation: lg.Derivation, answer: str) -> list[str]:
    """What is said of a wrong answer."""
    verdict = derivation.check(answer)
    assert not verdict.right
    return [" ".join(str(m.what).split()) for m in verdict.mistakes]


TWO = ("m z'' = -Z - k z", "M z'' = 2 Z - M g", "J phi'' = -c phi'")
ROPE = ("m x'' = m g - b x' - S", "M y'' = M g - K", "I y''/r = r (K - S)", "y'' = -x''")
ROD = (
    "M x'' = X",
    "m (x'' + l/2 phi'' cos(phi) - l/2 phi'^2 sin(phi)) = -X",
    "m (l/2 phi'' sin(phi) + l/2 phi'^2 cos(phi)) = Y - m g",
    "m l^2/12 phi'' = X l/2 cos(phi) - Y l/2 sin(phi)",
)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("derive", "lines"), [(pendulum, CART), (ring, TWO), (crank, ROD)], ids=["cart", "ring", "rod"]
)
def test_right_balances_are_right(derive: object, lines: tuple[str, ...]) -> None:
    assert callable(derive)
    assert derive().check("\n".join(lines)).right


@pytest.mark.slow
def test_a_centripetal_acceleration_is_missing_in_its_own_balance() -> None:
    told = said(pendulum(), changed(CART, 3, "m l phi'' sin(phi) = Y - m g"))
    assert len(told) == 1 and "line 3" in told[0] and "is missing" in told[0] and "phi'^2" in told[0], told


def test_a_force_without_its_arm() -> None:
    told = said(pendulum(), changed(CART, 4, "J phi'' = X l cos(phi) - Y sin(phi)"))
    assert len(told) == 1 and "line 4" in told[0] and "Y" in told[0], told


def test_a_force_that_acts_twice() -> None:
    assert said(ring(), changed(TWO, 2, "M z'' = Z - M g")) == ["In line 2, on the right-hand side, Z should be 2*Z."]


def test_the_right_line_stays_right_where_a_force_acts_twice() -> None:
    verdict = ring().check(changed(TWO, 2, "M z'' = Z - M g"))
    assert {f.line.number: f.status.right for f in verdict.findings} == {1: True, 2: False, 3: True}


def test_an_own_force_that_is_missing() -> None:
    lines = (*CART[:3], "J phi'' = X l cos(phi)")
    told = said(pendulum(), "\n".join(lines))
    assert len(told) == 1 and "line 4" in told[0] and "Y" in told[0] and "is missing" in told[0], told


def test_a_damper_is_missing_beside_a_constraint() -> None:
    told = said(rope(), changed(ROPE, 1, "m x'' = m g - S"))
    assert told == ["In line 1, on the right-hand side, the term -b*x' is missing."]


def test_a_name_with_a_prime_is_another_force() -> None:
    lines = tuple(x.replace("K", "S'") for x in ROPE)
    told = said(rope(), changed(lines, 1, "m x'' = m g - S"))
    assert told == ["In line 1, on the right-hand side, the term -b*x' is missing."]


def test_the_moment_of_inertia_about_the_end_in_a_moment_about_the_centre() -> None:
    told = said(crank(), changed(ROD, 4, "m l^2/3 phi'' = X l/2 cos(phi) - Y l/2 sin(phi)"))
    assert len(told) == 1 and "line 4" in told[0] and "/3" in told[0] and "/12" in told[0], told


def test_what_lines_do_not_agree_is_no_matter_of_energies() -> None:
    """The sign of S may be wrong in either line: no cause is invented."""
    for wrong in ("M y'' = M g + S", "M y'' = M g - 3 S"):
        told = said(rope(), f"m x'' = m g - b x' - S\n{wrong}\ny'' = -x''")
        assert not any("∂" in x or "T*" in x for x in told), told


def test_two_wrong_balances_are_not_told_as_one() -> None:
    answer = changed(tuple(changed(CART, 3, "m l phi'' sin(phi) = Y - m g").split("\n")), 1, "M x'' = F + 3 X")
    assert all("line 3" not in x or "line 1" in x for x in said(pendulum(), answer))


def test_an_odd_factor_is_no_reason() -> None:
    row = "m l^2/3 phi'' + m l/2 x'' cos(phi) + m g l/2 sin(phi) = 0"
    told = said(crank(), f"(M + m) x'' + m l/2 phi'' cos(phi) + 9/16 m l phi'^2 sin(phi) = 0\n{row}")
    assert told and "phi'^2" in told[0] and " times" not in told[0], told


def test_the_acceleration_of_the_axis_is_missing_in_a_sum_of_moments() -> None:
    row = "(M + m) x'' + m l phi'' cos(phi) - m l phi'^2 sin(phi) = F"
    right = "(J + m l^2) phi'' = -m g l sin(phi) - m l x'' cos(phi)"
    lines = (*CART[:2], right, row)
    assert pendulum().check("\n".join(lines), hint=0).right
    verdict = pendulum().check("\n".join(lines).replace(" - m l x'' cos(phi)", ""))
    assert not verdict.right and len(verdict.mistakes) == 1
    [mistake] = verdict.mistakes
    assert " ".join(str(mistake.what).split()) == (
        "In line 3, on the right-hand side, the term -l*m*cos(phi)*x'' is missing."
    )
    assert "What carries the body" in str(mistake.why) and "∂" not in str(mistake.why)


@cache
def collar() -> lg.Derivation:
    """A collar on a vertical rod; a rope leads from it over a pulley at the distance h to a weight."""
    s = lg.System("collar and weight")
    y = s.coordinates("y")
    m, M, h, c, k, g = s.parameters("m M h c k g")
    length = sp.sqrt(h**2 + y**2)
    s.particle(m, at=s.point("A", (h, -y)), name="collar")
    s.particle(M, at=s.point("B", (0, length)), name="weight")
    s.gravity((0, -1), g)
    s.damper(c, deflection=length, name="dashpot")
    s.spring(k, deflection=y, name="spring")
    return s.derive()


LENGTH = "l = sqrt(h^2 + y^2), z'' = y y''/l + h^2 y'^2/l^3"
HANGING = (LENGTH, "m y'' = m g - k y - S y/l", "M z'' = S - M g - c y y'/l")
DRAWN = "m y'' = m g - k y - (y/l) (M z'' + M g + c y y'/l)"


def statuses(derivation: lg.Derivation, answer: str) -> dict[int, tuple[bool, bool]]:
    """Which lines below the first are right, and which are said not to fit another one."""
    verdict = derivation.check(answer)
    assert not verdict.right
    return {f.line.number: (f.status.right, bool(f.clash)) for f in verdict.findings if f.line.number > 1}


@pytest.mark.slow
def test_the_other_leg_of_a_slanting_rope_is_blamed_and_not_the_right_balance() -> None:
    assert collar().check("\n".join((*HANGING, DRAWN)), hint=0).right
    lines = changed(HANGING, 2, "m y'' = m g - k y - S h/l")
    for answer in (lines, f"{lines}\n{DRAWN.replace('(y/l)', '(h/l)')}"):
        found = statuses(collar(), answer)
        assert found[2] == (False, False) and found[3] == (True, False)
        (told,) = said(collar(), answer)
        assert "line 2" in told and "-S*h/" in told and "should be -S*y/" in told, told


@pytest.mark.slow
@pytest.mark.parametrize("other", ["M z'' = S - M g", "M z'' = S - M g - 3 k l"])
def test_of_two_wrong_balances_none_is_blamed_alone(other: str) -> None:
    lines = changed(HANGING, 2, "m y'' = m g - k y - S h/l").replace(HANGING[2], other)
    result = "m y'' = m g - k y - (h/l) (M z'' + M g)"
    found = statuses(collar(), f"{lines}\n{result}")
    assert found[2] == found[3] == (False, True)
    told = said(collar(), f"{lines}\n{result}")
    assert told == ["Lines 2 and 3, which have S, do not agree: at least one of them is wrong."]


def test_balances_that_follow_from_a_wrong_acceleration_are_not_told_as_disagreeing() -> None:
    answer = "\n".join((*HANGING, DRAWN)).replace(" + h^2 y'^2/l^3", "")
    verdict = collar().check(answer)
    assert [f.line.number for f in verdict.findings if not f.status.right and not f.follows] == [1]
    assert not any(f.clash for f in verdict.findings) and all("agree" not in x for x in said(collar(), answer))


@cache
def metronome() -> lg.Derivation:
    """A slider on a bar that turns."""
    s = lg.System("bar and slider")
    theta, x = s.coordinates("theta s")
    J, m, k, d, c, g = s.parameters("J m k d c g")
    s.kinetic(J * theta.diff() ** 2 / 2)
    s.particle(m, at=s.point("A", (x * sp.sin(theta), x * sp.cos(theta))), name="slider")
    s.gravity((0, -1), g)
    s.spring(k, deflection=theta, name="hinge")
    s.damper(d, deflection=x, name="slide")
    s.damper(c, deflection=theta, name="bearing")
    return s.derive()


SLIDING = (
    "m (s'' - s theta'^2) = -m g cos(theta) - d s'",
    "m (s theta'' + 2 s' theta') = N + m g sin(theta)",
    "J theta'' = -k theta - c theta' - N s",
    "(J + m s^2) theta'' + 2 m s s' theta' = m g s sin(theta) - k theta - c theta'",
)


def test_an_explained_line_is_blamed_alone_beside_a_right_balance() -> None:
    assert metronome().check("\n".join(SLIDING), hint=0).right
    answer = "\n".join((*SLIDING[:2], f"{SLIDING[2]} - d s' s", f"{SLIDING[3]} - d s' s"))
    found = statuses(metronome(), answer)
    assert found[3] == (False, False) and found.get(2, (True, False)) == (True, False)


def test_a_right_balance_is_not_blamed_for_two_mistakes_in_another() -> None:
    """The balance of the slider stands below the wrong one, whose force is put into it."""
    wrong = "J theta'' = -2 k theta - c theta'/2 - N s"
    result = SLIDING[3].replace("- k theta - c theta'", "- 2 k theta - c theta'/2")
    found = statuses(metronome(), "\n".join((SLIDING[0], wrong, SLIDING[1], result)))
    assert found[2] == found[3] == (False, True)


@cache
def boom() -> lg.Derivation:
    """A mast on a slanting spring from its tip to the ground, which lifts a weight on a rope."""
    s = lg.System("boom")
    theta = s.coordinates("theta")
    J, M, L, d, k, g, s0 = s.parameters("J M L d k g s0")
    s.kinetic(J * theta.diff() ** 2 / 2)
    s.particle(M, at=s.point("B", (2 * L, L * sp.sin(theta))), name="weight")
    s.gravity((0, -1), g)
    s.spring(k, deflection=sp.sqrt(L**2 + d**2 + 2 * L * d * sp.sin(theta)) - s0, name="guy")
    return s.derive()


@pytest.mark.slow
def test_the_arm_of_a_slanting_spring() -> None:
    lines = "s = sqrt(L^2 + d^2 + 2 L d sin(theta))\nJ theta'' = -k (s - s0) L d cos(theta)/s - S L cos(theta)"
    lines += "\nM (L theta'' cos(theta) - L theta'^2 sin(theta)) = S - M g"
    assert boom().check(lines, hint=0).right
    answer = lines.replace("L d cos(theta)/s", "L cos(theta)")
    assert statuses(boom(), answer) == {2: (False, False), 3: (True, False)}
    (told,) = said(boom(), answer)
    assert "line 2" in told and "(-s0 + s)" in told and "should be" in told and "*d*" in told, told


@cache
def roller() -> lg.Derivation:
    """A cylinder that rolls up a slope on a rope that a drum winds."""
    s = lg.System("roller")
    x, phi = s.coordinates("x phi")
    m, r, J, k, a, g = s.parameters("m r J k a g")
    s.kinetic(J * phi.diff() ** 2 / 2)
    centre = s.point("C", (x * sp.cos(a), x * sp.sin(a)))
    s.rigid_body(m, m * r**2 / 2, at=centre, frame=s.frame(-x / r), name="roller")
    s.gravity((0, -1), g)
    s.spring(k, deflection=r * phi - x, name="rope")
    s.torque(s.input("tau"), on=phi)
    return s.derive()


@pytest.mark.slow
def test_a_balance_and_the_force_solved_from_it_in_one_line() -> None:
    """The sign of H is wrong; half the mass in the result is not half the kinetic energy."""
    first = "J phi'' = tau - k r (r phi - x)\n"
    right = first + "m x'' = k (r phi - x) - H - m g sin(a)\n1/2 m r^2 x''/r = H r -> H = 1/2 m x''"
    assert roller().check(right, hint=0).right
    answer = right.replace("- H", "+ H") + "\n1/2 m x'' = k (r phi - x) - m g sin(a)"
    verdict = roller().check(answer)
    assert not verdict.right
    (told,) = said(roller(), answer)
    assert "H has the wrong sign" in told, told
    wrong = [f.line.number for f in verdict.findings if not f.status.right and not f.follows]
    assert len(wrong) == 1 and wrong[0] in (2, 3)
    assert not any(f.status.right and f.line.number == wrong[0] for f in verdict.findings)
