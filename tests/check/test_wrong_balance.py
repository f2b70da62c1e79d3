"""One wrong line among balances of single bodies with forces of the answer's own: the right ones stay right.

Oracle: a drum from which a reel unwinds, by Newton and Euler; each answer differs from the right one in one line.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg

DRUM = "J phi'' = tau + S r - c phi'"
LOAD = "m z'' = m g - S"
REEL = "I (z'' - r phi'')/a = S a"
RIGHT = f"{DRUM}\n{LOAD}\n{REEL}"
SOLVED = "S = I (z'' - r phi'')/a^2"


@cache
def drum() -> lg.Derivation:
    """A drum on whose rope a reel hangs that unwinds."""
    s = lg.System("drum and reel")
    phi, z = s.coordinates("phi z")
    J, m, I, r, a, c, g = s.parameters("J m I r a c g")
    s.kinetic(J * phi.diff() ** 2 / 2 + m * z.diff() ** 2 / 2 + I * ((z.diff() - r * phi.diff()) / a) ** 2 / 2)
    s.potential(-m * g * z)
    s.damper(c, deflection=phi)
    s.torque(s.input("tau"), on=phi)
    return s.derive()


def verdicts(answer: str) -> dict[int, bool]:
    """Which lines of a wrong answer are right."""
    verdict = drum().check(answer)
    assert not verdict.right
    return {f.line.number: f.status.right for f in verdict.findings}


def said(answer: str) -> list[str]:
    """What is said of a wrong answer."""
    return [" ".join(str(m.what).split()) for m in drum().check(answer).mistakes]


@pytest.mark.parametrize("answer", [RIGHT, f"{RIGHT}\n{SOLVED}", f"S = m g - m z''\n{DRUM}\n{REEL}"])
def test_right_balances_are_right(answer: str) -> None:
    assert drum().check(answer, hint=0).right


@pytest.mark.sampled(10)
@pytest.mark.parametrize(
    ("line", "wrong", "told"),
    [
        (1, "J phi'' = tau - S r - c phi'", "-S*r has the wrong sign"),
        (1, "J phi'' = tau + S - c phi'", "S should be S*r"),
        (1, "J phi'' = tau + S r - 2 c phi'", "-2*c*phi' should be -c*phi'"),
        (1, "J phi'' = tau + S r", "the term -c*phi' is missing"),
        (2, "m z'' = -S", "the term g*m is missing"),
        (2, "m z'' = m g + S", "S has the wrong sign"),
        (2, "m z'' = -m g - S", "-g*m has the wrong sign"),
        (2, "m z'' = m g - S - c z'", "-c*z' does not belong there"),
        (3, "I (z'' - r phi'')/a = -S a", "-S*a has the wrong sign"),
        (3, "I (z'' - r phi'')/a = S r", "S*r should be S*a"),
    ],
)
def test_the_wrong_line_is_blamed_alone(line: int, wrong: str, told: str) -> None:
    lines = RIGHT.split("\n")
    lines[line - 1] = wrong
    assert verdicts("\n".join(lines)) == {k: k != line for k in (1, 2, 3)}
    (only,) = said("\n".join(lines))
    assert f"line {line}" in only and told in only, only


@pytest.mark.slow
def test_a_force_that_is_solved_from_a_wrong_line_follows() -> None:
    results = "J phi'' = tau - I r (z'' - r phi'')/a^2 - c phi'\nm z'' = m g + I (z'' - r phi'')/a^2"
    answer = f"{DRUM}\n{LOAD}\nI (z'' - r phi'')/a = -S a\nS = -I (z'' - r phi'')/a^2\n{results}"
    verdict = drum().check(answer)
    assert [(f.line.number, f.status.right, f.follows) for f in verdict.findings] == [
        (1, True, False),
        (2, True, False),
        (3, False, False),
        (4, False, True),
        (5, False, True),
        (6, False, True),
    ]
    assert "-S*a has the wrong sign" in said(answer)[0]


def test_a_force_that_is_solved_wrongly_is_blamed_and_no_balance() -> None:
    answer = f"{RIGHT}\nS = -I (z'' - r phi'')/a^2\nm z'' = m g + I (z'' - r phi'')/a^2"
    verdict = drum().check(answer)
    assert [(f.line.number, f.status.right, f.follows) for f in verdict.findings] == [
        (1, True, False),
        (2, True, False),
        (3, True, False),
        (4, False, False),
        (5, False, True),
    ]


def test_a_balance_solved_for_its_force_is_blamed() -> None:
    assert verdicts(f"S = m g + m z''\n{DRUM}\n{REEL}") == {1: False, 2: True, 3: True}


def test_two_wrong_balances_leave_none_that_is_called_right() -> None:
    answer = f"J phi'' = tau - S r - c phi'\nm z'' = 2 m g - S\n{REEL}"
    verdict = drum().check(answer)
    assert not verdict.right
    assert all(m.name != "wrong_balance" for m in verdict.mistakes)


def test_a_factor_of_either_side_is_not_guessed() -> None:
    answer = f"{DRUM}\n{LOAD}\nI (z'' - r phi'')/a = 2 S a"
    assert verdicts(answer) == {1: True, 2: True, 3: False}
    assert said(answer) == ["Line 3 does not agree with the other lines that have these forces, and those are right."]


@cache
def sprung() -> lg.Derivation:
    """The same with a spring between the rim of the drum and the reel."""
    s = lg.System("drum, spring and reel")
    phi, z = s.coordinates("phi z")
    J, m, I, r, a, k, g = s.parameters("J m I r a k g")
    s.kinetic(J * phi.diff() ** 2 / 2 + m * z.diff() ** 2 / 2 + I * ((z.diff() - r * phi.diff()) / a) ** 2 / 2)
    s.potential(-m * g * z)
    s.spring(k, deflection=r * phi - z)
    return s.derive()


@pytest.mark.slow
def test_a_missing_force_of_several_terms_is_told_as_one() -> None:
    right = "J phi'' = S r - k r (r phi - z)\nm z'' = m g - S + k (r phi - z)\nI (z'' - r phi'')/a = S a"
    assert sprung().check(right, hint=0).right
    verdict = sprung().check(right.replace(" + k (r phi - z)", ""))
    assert {f.line.number: f.status.right for f in verdict.findings} == {1: True, 2: False, 3: True}
    (only,) = (" ".join(str(m.what).split()) for m in verdict.mistakes)
    assert "line 2" in only and "is missing" in only and "phi" in only and "z" in only, only


@cache
def gangway() -> lg.Derivation:
    """A wagon on a ramp that turns; a rope over a pulley at the hinge leads to a counterweight."""
    s = lg.System("gangway")
    theta, x, z = s.coordinates("theta s z")
    J, m, M, I, r, l_, b, d = s.parameters("J m M I r l b d")
    tau = s.inputs("tau")
    s.kinetic(J * theta.diff() ** 2 / 2, name="ramp")
    s.kinetic(I * z.diff() ** 2 / (2 * r**2), name="pulley")
    s.particle(m, at=s.point("W", (x * sp.cos(theta), -x * sp.sin(theta))), name="wagon")
    s.particle(M, at=s.point("G", (0, -z)), name="counterweight")
    s.gravity()
    s.damper(b=b, deflection=x, name="brake")
    s.damper(b=d, deflection=theta, name="hinge")
    s.force(-tau, deflection=theta, name="drive")
    s.constraint(x + z - l_, name="rope")
    return s.derive()


BALANCES = """m (s'' - s theta'^2) = m g sin(theta) - S1 - b s'
m (s theta'' + 2 s' theta') = m g cos(theta) - N
M z'' = M g - S2
I z''/r = (S2 - S1) r
J theta'' = N s - tau - d theta'
z'' = -s''
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong", "line", "said"),
    [
        ("- tau - d theta'", "- tau", 5, "d*theta' is missing"),
        ("(S2 - S1) r", "(S2 - S1)", 4, ""),
        ("M g - S2", "2 M g - S2", 3, "2*M*g should be M*g"),
    ],
)
def test_the_wrong_balance_beside_a_constraint_is_found(right: str, wrong: str, line: int, said: str) -> None:
    assert gangway().check(BALANCES).right
    verdict = gangway().check(BALANCES.replace(right, wrong))
    assert not verdict.right
    assert [f.line.number for f in verdict.findings if not f.status.right] == [line]
    assert said in str(verdict.mistakes[0].what)


SOLVED = "So S1 = M g - (M + I/r^2) z'' = M g + (M + I/r^2) s''"


def test_a_force_that_is_solved_from_two_balances_leaves_both_right() -> None:
    """S2 stands in two lines, of which one has S1, which has a value: neither is the equation of a multiplier."""
    assert gangway().check(BALANCES + SOLVED).right


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("right", "wrong"), [("M g - S2", "2 M g - S2"), ("(S2 - S1) r", "(S1 - S2) r"), ("I z''/r =", "I z'' r =")]
)
def test_a_wrong_balance_stays_wrong_where_a_force_is_solved_from_two(right: str, wrong: str) -> None:
    assert not gangway().check((BALANCES + SOLVED).replace(right, wrong)).right


@cache
def lever() -> lg.Derivation:
    """A lever J that lifts a weight M by a rope over a pulley I of radius r: z = l sin ψ."""
    s = lg.System("lever with a pulley")
    psi, z = s.coordinates("psi z")
    J, M, I, r, l, g = s.parameters("J M I r l g")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=s.frame(psi, name="lever"), name="lever")
    s.rigid_body(mass=0, inertia=I, at=s.point("P", (l, l)), frame=s.frame(z / r, name="pulley"), name="pulley")
    s.particle(M, at=s.point("W", (2 * l, z)), name="weight")
    s.gravity((0, -1), g)
    s.torque(s.input("tau"), on=psi)
    s.constraint(z - l * sp.sin(psi), name="rope")
    return s.derive()


LEVER = """J psi'' = tau - S l cos(psi)
M z'' = K - M g
I z''/r = S r - K r
z' = l psi' cos(psi)
z'' = l psi'' cos(psi) - l psi'^2 sin(psi)
K = M z'' + M g
S = K + I z''/r^2
(J + (M + I/r^2) l^2 cos(psi)^2) psi'' - (M + I/r^2) l^2 psi'^2 sin(psi) cos(psi) + M g l cos(psi) = tau"""
FLAT = LEVER.replace(" - l psi'^2 sin(psi)\n", "\n").replace(" - (M + I/r^2) l^2 psi'^2 sin(psi) cos(psi)", "")


def test_balances_beside_a_wrong_derivative_of_a_constraint_are_right() -> None:
    assert lever().check(LEVER).right
    verdict = lever().check(FLAT)
    wrong = {f.line.number: f.follows for f in verdict.findings if not f.status.right}
    assert wrong == {5: False, 8: True}, wrong
    assert "on the right-hand side, the term -l*sin(psi)*psi'^2 is missing" in str(verdict.mistakes[0].what)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("old", ["tau - S l cos(psi)", "K - M g", "S r - K r"])
def test_a_wrong_balance_beside_a_wrong_derivative_of_a_constraint_is_not_called_right(old: str) -> None:
    number = next(k for k, x in enumerate(LEVER.split("\n"), 1) if old in x)
    verdict = lever().check(FLAT.replace(old, old.replace(" - ", " + "), 1))
    assert not verdict.right
    assert all(f.line.number != number for f in verdict.findings if f.status.right)


@pytest.mark.slow
def test_a_force_may_be_solved_in_a_line_that_says_more() -> None:
    both = "K = M z'' + M g. With z'' = l psi'' cos(psi):  K = M l psi'' cos(psi) + M g"
    verdict = lever().check(FLAT.replace("K = M z'' + M g", both).replace("z'' = l psi'' cos(psi)\n", "", 1))
    assert not verdict.right
    assert all(f.status.right for f in verdict.findings if f.line.number < 4)


@pytest.mark.slow
def test_what_a_force_is_may_stand_far_behind_its_line() -> None:
    far = LEVER.replace("K - M g\n", f"K - M g{60 * ' '}K: pull of the rope on the weight\n", 1)
    assert lever().check(far).right and not lever().check(far.replace("= K - M g ", "= K + M g ")).right


@pytest.mark.slow
@pytest.mark.parametrize("lost", [" + I/r^2", " + M g l cos(psi)"])
def test_a_wrong_result_beside_right_balances_is_judged_alone(lost: str) -> None:
    *balances, result = LEVER.split("\n")
    verdict = lever().check("\n".join([*balances, result.replace(lost, "")]))
    assert [f.line.number for f in verdict.findings if not f.status.right] == [8]
    assert verdict.mistakes and not any(m.name.startswith("multiplier") for m in verdict.mistakes)


@cache
def planet() -> lg.Derivation:
    """A planet P of radius r on a carrier C of length a + r that rolls on a fixed wheel of radius a."""
    s = lg.System("planet on a carrier")
    psi = s.coordinate("psi")
    C, P, m, a, r, g, b = s.parameters("C P m a r g b")
    s.rigid_body(mass=0, inertia=C, at=s.origin, frame=s.frame(psi, name="carrier"), name="carrier")
    at = s.point("Q", ((a + r) * sp.sin(psi), (a + r) * sp.cos(psi)))
    s.rigid_body(mass=m, inertia=P, at=at, frame=s.frame((a + r) * psi / r, name="planet"), name="planet")
    s.gravity((0, -1), g)
    s.damper(b, deflection=(a + r) * psi / r)
    s.torque(s.input("tau"), on=psi)
    return s.derive()


PLANET = """s = a + r
Planet (force N of the carrier and tooth force H, both along its path, counted with psi):
m s psi'' = N + H + m g sin(psi)
P (s/r) psi'' = -H r - b (s/r) psi'
Carrier: C psi'' = tau - N s
From the planet
H = -(s/r^2) (P psi'' + b psi')
N = m s psi'' - m g sin(psi) + (s/r^2) (P psi'' + b psi')
In the carrier: (C + m s^2 + P s^2/r^2) psi'' + b s^2/r^2 psi' - m g s sin(psi) = tau"""


@pytest.mark.slow
def test_a_balance_that_a_force_was_solved_from_below_is_the_wrong_line() -> None:
    assert planet().check(PLANET).right
    verdict = planet().check(PLANET.replace("-H r", "-H a").replace("r^2", "(a r)"))
    wrong = {f.line.number: f.follows for f in verdict.findings if not f.status.right}
    assert wrong == {4: False, 7: True, 8: True, 9: True}, wrong
    assert "line 4, on the right-hand side, -H*a should be -H*r" in " ".join(str(verdict.mistakes[0].what).split())


@pytest.mark.slow
def test_a_balance_that_only_says_what_a_force_is_is_not_called_right() -> None:
    wrong = PLANET.replace("= N + H", "= N + 3 H").replace("-H r", "-H a").replace("r^2", "(a r)")
    for term in ("+ (s/(a r))", "+ P s^2", "+ b s^2"):
        wrong = wrong.replace(term, f"+ 3{term[1:]}")
    verdict = planet().check(wrong)
    assert not verdict.right
    assert not [f for f in verdict.findings if f.status.right and f.line.number in (3, 4)]
    assert all(f.line.number != 1 for f in verdict.findings)  # s is a length, and nothing that moves


@cache
def roller() -> lg.Derivation:
    """A disc A, B of radius a with a mass m at the distance e that rolls, pulled back by a band off its top."""
    s = lg.System("roller with a band")
    u = s.coordinate("u")
    A, B, m, a, e, k, g = s.parameters("A B m a e k g")
    s.rigid_body(mass=A, inertia=B, at=s.point("O", (a * u, a)), frame=s.frame(-u, name="disc"), name="disc")
    s.particle(m, at=s.point("H", (a * u + e * sp.sin(u), a + e * sp.cos(u))), name="lump")
    s.gravity((0, -1), g)
    s.spring(k, deflection=2 * a * u, name="band")
    return s.derive()


ROLLER = """Z = 2 k a u, pull of the band
A x_O'' + m x_H'' = -Z - h
B u'' + m e cos(u) x_H'' - m e sin(u) y_H'' = h a + m g e sin(u) - Z a
x_O'' = a u''
x_H'' = a u'' + e cos(u) u'' - e sin(u) u'^2
y_H'' = -e sin(u) u'' - e cos(u) u'^2
(B + A a^2 + m (a^2 + e^2 + 2 a e cos(u))) u'' - m a e sin(u) u'^2 - m g e sin(u) + 4 k a^2 u = 0"""


@pytest.mark.slow
def test_a_balance_that_lacks_a_force_which_others_have_by_name_is_the_wrong_one() -> None:
    assert roller().check(ROLLER).right
    verdict = roller().check(ROLLER.replace(" - Z a", "").replace("4 k a^2", "2 k a^2"))
    wrong = {f.line.number: f.follows for f in verdict.findings if not f.status.right}
    assert wrong == {3: False, 7: True}, wrong
    told = " ".join(str(verdict.mistakes[0].what).split())
    assert "2*a^2*k*u is missing" in told and told.startswith("In line 3,")


WEIGHT = ROLLER.replace("h a + m g e", "h a - m g e").replace("- m g e sin(u) +", "+ m g e sin(u) +")


def test_accelerations_may_stand_below_the_balances_that_use_them() -> None:
    verdict = roller().check(WEIGHT)
    wrong = {f.line.number: f.follows for f in verdict.findings if not f.status.right}
    assert wrong == {3: False, 7: True}, wrong
    told = " ".join(str(verdict.mistakes[0].what).split())
    assert told == "In line 3, on the right-hand side, -e*g*m*sin(u) has the wrong sign."
    assert not any("was not judged" in str(x) or "no single body" in str(x) for x in verdict.notes)


@cache
def hanging() -> lg.Derivation:
    """A block M on a vertical spring from which a mass m hangs by a rod l."""
    s = lg.System("block and pendulum")
    y, theta = s.coordinates("y theta")
    M, m, l, k, g = s.parameters("M m l k g")
    s.particle(M, at=s.point("B", (0, y)), name="block")
    s.particle(m, at=s.point("P", (l * sp.sin(theta), y - l * sp.cos(theta))), name="bob")
    s.gravity((0, -1), g)
    s.spring(k, deflection=y, name="spring")
    return s.derive()


@pytest.mark.slow
def test_components_of_a_force_are_no_generalized_forces() -> None:
    answer = """m x_P'' = Q_x
m y_P'' = Q_y - m g
M y'' = -Q_y - M g - k y
Q_x cos(theta) + Q_y sin(theta) = 0
x_P'' = l cos(theta) theta'' - l sin(theta) theta'^2
y_P'' = y'' + l sin(theta) theta'' + l cos(theta) theta'^2"""
    assert hanging().check(answer).right
    verdict = hanging().check(answer.replace("- m g", "+ m g"))
    wrong = {f.line.number: f.follows for f in verdict.findings if not f.status.right}
    assert wrong == {2: False}, wrong
    assert not any("not true" in str(x) or "no single body" in str(x) for x in verdict.notes)
