"""Answers that state forces of constraints in their Ξ, in rates of momenta, or in two forms of one side."""

from __future__ import annotations

from functools import cache

import pytest
from sympy import sqrt

from lagrangian import Derivation, System
from size import rest_slow

ENERGIES = """T = 1/2 (J + m r^2) phi'^2 + 1/2 m r'^2 + 1/2 M z'^2
V = -M g z
"""
FORCES = """Q_phi = tau
Q_r = -b r' - S
Q_z = -S
"""
EQUATIONS = """(J + m r^2) phi'' + 2 m r r' phi' = tau
m r'' - m r phi'^2 = -b r' - S
M z'' - M g = -S
r + z = L
"""
REDUCED = """(J + m r^2) phi'' + 2 m r r' phi' = tau
(m + M) r'' - m r phi'^2 + b r' + M g = 0
z'' = -r''
"""


@cache
def spinner() -> Derivation:
    """A sleeve on a turning arm, and a load on its rope."""
    sys = System("spinner")
    phi, r, z = sys.coordinates("phi r z")
    J, m, M, L, b = sys.parameters("J m M L b")
    tau = sys.input("tau")
    sys.kinetic(J * phi.diff() ** 2 / 2 + m * (r.diff() ** 2 + r**2 * phi.diff() ** 2) / 2 + M * z.diff() ** 2 / 2)
    sys.potential(-M * sys.parameter("g") * z)
    sys.torque(tau, on=phi)
    sys.damper(b, deflection=r)
    sys.constraint(r + z - L, name="rope")
    return sys.derive()


@pytest.mark.parametrize("equations", [EQUATIONS, REDUCED])
def test_a_generalized_force_may_hold_the_force_of_a_constraint(equations: str) -> None:
    assert spinner().check(ENERGIES + FORCES + equations, hint=0).right


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("right", "wrong"),
    [("Q_z = -S", "Q_z = S"), ("Q_z = -S", "Q_z = -2 S"), ("- S\nQ_z", "+ S\nQ_z"), ("-b r' - S\nQ", "b r' - S\nQ")],
)
@pytest.mark.parametrize("equations", [EQUATIONS, REDUCED])
def test_the_force_of_a_constraint_in_a_generalized_force_is_judged(equations: str, right: str, wrong: str) -> None:
    assert right in FORCES and not spinner().check(ENERGIES + FORCES.replace(right, wrong) + equations, hint=0).right


def test_generalized_forces_alone_are_no_equations() -> None:
    assert not spinner().check(ENERGIES + FORCES, hint=0).right


@pytest.mark.sampled(2)
@pytest.mark.parametrize("energies", [ENERGIES, ""])
def test_the_rate_of_a_momentum_may_be_equal_to_forces(energies: str) -> None:
    turning, _, rest = EQUATIONS.partition("\n")
    assert turning and spinner().check(f"{energies}d/dt(dT/dphi') = tau\n{rest}", hint=0).right
    assert not spinner().check(f"{energies}d/dt(dT/dphi') = -tau\n{rest}", hint=0).right
    assert not spinner().check(f"{energies}d/dt(dT/dphi') = tau - b r'\n{rest}", hint=0).right


@cache
def puck() -> Derivation:
    """A sleeve with a spring on a turning arm."""
    sys = System("puck")
    phi, r = sys.coordinates("phi r")
    J, m, k, c = sys.parameters("J m k c")
    sys.kinetic(J * phi.diff() ** 2 / 2 + m * (r.diff() ** 2 + r**2 * phi.diff() ** 2) / 2)
    sys.spring(k, deflection=r)
    sys.damper(c, deflection=phi)
    sys.torque(sys.input("tau"), on=phi)
    return sys.derive()


@pytest.mark.sampled(2)
@pytest.mark.parametrize("energy", ["T = 1/2 (J + m r^2) phi'^2 + 1/2 m r'^2\n", ""])
def test_the_rate_of_a_momentum_is_an_equation_where_nothing_is_held(energy: str) -> None:
    last = "m r'' - m r phi'^2 + k r = 0"
    assert puck().check(f"{energy}d/dt(dT/dphi') = tau - c phi'\n{last}", hint=0).right
    assert not puck().check(f"{energy}d/dt(dT/dphi') = tau + c phi'\n{last}", hint=0).right
    assert not puck().check(f"{energy}d/dt(dT/dphi') = tau - c phi'\nd/dt(dT/dr') = -k r", hint=0).right


@cache
def lift() -> Derivation:
    """A lever that lifts a platform by a rod."""
    sys = System("lift")
    theta, z = sys.coordinates("theta z")
    J, m, a, length, c = sys.parameters("J m a l c", J=1.0, m=10.0, a=0.9, l=0.7, c=1.2)
    lever = sys.frame(theta)
    tip = sys.point("tip", (a, 0), frame=lever)
    platform = sys.point("platform", (c, z))
    sys.kinetic(J * theta.diff() ** 2 / 2)
    sys.particle(m, at=platform)
    sys.gravity()
    sys.torque(sys.input("tau"), on=theta)
    sys.constraint(between=(platform, tip), distance=length, name="rod")
    return sys.derive()


TWO_FORMS = """S = tension in the rod
m z'' = -m g - S (z - a sin(theta))/l
J theta'' = tau + S/l [a cos(theta) (z - a sin(theta)) - a sin(theta) (c - a cos(theta))]
  = tau + S a (z cos(theta) - c sin(theta))/l
(c - a cos(theta))^2 + (z - a sin(theta))^2 = l^2"""


@pytest.mark.slow
def test_a_side_may_be_written_in_two_forms() -> None:
    assert lift().check(TWO_FORMS, hint=0).right
    assert not lift().check(TWO_FORMS.replace("= tau + S a (z", "= tau + S a (2 z"), hint=0).right
    assert not lift().check(TWO_FORMS.replace("/l [a cos", "/l [-a cos"), hint=0).right


TENSION = """m r'' - m r phi'^2 = -b r' - S
(J + m r^2) phi'' + 2 m r r' phi' = tau
M z'' = M g - S
r_ddot = -z_ddot
"""
REMARKS = [
    "check: no rotation, no friction: r_ddot = -M g/(m + M), as Atwood",
    "S is the tension. Statics check: with everything at rest S = M g. Good.",
    "Limits: m = 0 gives M r'' = -b r' - M g",
    "tau = 0, small b: m r'' = m r phi'^2 - M g - M r''",
]


@pytest.mark.sampled(6)
@pytest.mark.parametrize("remark", REMARKS)
def test_special_cases_are_remarks_where_constraints_hold(remark: str) -> None:
    assert spinner().check(f"{TENSION}\n{remark}", hint=0).right
    assert not spinner().check(f"{TENSION.replace('M g - S', 'M g + S')}\n{remark}", hint=0).right
    assert not spinner().check(f"{TENSION.replace('- m r phi', '+ m r phi')}\n{remark}", hint=0).right


ROOT = """w = sqrt(l^2 - (c - a cos(theta))^2)
z = a sin(theta) + w
u = a cos(theta) - a sin(theta) (c - a cos(theta))/w
T = 1/2 (J + m u^2) theta'^2
V = m g (a sin(theta) + w)
(J + m u^2) theta'' + m u u' theta' + m g u = tau"""


TWINS_OF_ROOT = {
    "cos(theta) - a sin": "cos(theta) + a sin",
    "z = a sin(theta) + w": "z = a sin(theta) - w",
    "+ m g u = tau": "- m g u = tau",
    "V = m g (a": "V = 2 m g (a",
    "1/2 (J + m u^2)": "1/2 (J + 2 m u^2)",
    "sqrt(l^2": "sqrt(2 l^2",
}


@pytest.mark.parametrize("turned", rest_slow([False, True], {False}))
def test_a_constraint_may_be_solved_with_a_root(turned: bool) -> None:
    assert lift().check(ROOT.replace("w = sqrt", "w = -sqrt") if turned else ROOT, hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("turned", rest_slow([False, True], {False}))
@pytest.mark.parametrize("right", rest_slow(TWINS_OF_ROOT, {"cos(theta) - a sin", "+ m g u = tau"}))
def test_wrong_twins_of_a_constraint_that_is_solved_with_a_root(right: str, turned: bool) -> None:
    answer = ROOT.replace("w = sqrt", "w = -sqrt") if turned else ROOT
    assert right in answer
    assert not lift().check(answer.replace(right, TWINS_OF_ROOT[right]), hint=0).right


PRESSED = """a cos(theta) + l cos(beta) = c
a sin(theta) + l sin(beta) = z
J theta'' = tau - N a sin(beta - theta)
m z'' = N sin(beta) - m g"""
TWO_MULTIPLIERS = """a cos(theta) + l cos(beta) - c = 0      lambda1
a sin(theta) + l sin(beta) - z = 0      lambda2
J theta'' = tau - lambda1 a sin(theta) + lambda2 a cos(theta)
m z'' + m g = -lambda2
0 = -lambda1 l sin(beta) + lambda2 l cos(beta)"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("answer", "changes"),
    [
        (
            PRESSED,
            [
                ("tau - N", "tau + N"),
                ("(beta - theta)", "(beta + theta)"),
                ("sin(theta) + l sin(beta)", "sin(theta) + 2 l sin(beta)"),
                ("a cos(theta) + l", "a cos(theta) - 2 l"),
                ("N sin(beta) -", "N cos(beta) -"),
            ],
        ),
        (
            TWO_MULTIPLIERS,
            [
                ("0 = -lambda1", "0 = lambda1"),
                ("tau - lambda1", "tau + lambda1"),
                ("= -lambda2", "= lambda2"),
                ("m z''", "2 m z''"),
                ("+ l cos(beta) - c", "+ 2 l cos(beta) - c"),
            ],
        ),
    ],
)
def test_the_geometry_says_what_an_angle_of_the_answer_is(answer: str, changes: list[tuple[str, str]]) -> None:
    assert lift().check(answer, hint=0).right
    for right, wrong in changes:
        assert right in answer and not lift().check(answer.replace(right, wrong), hint=0).right


def test_a_general_equation_with_names_of_forces_is_read() -> None:
    left = r"\frac{d}{dt}\frac{\partial L}{\partial\dot q_i} - \frac{\partial L}{\partial q_i}"
    general = rf"${left} + \frac{{\partial D}}{{\partial\dot q_i}} = Q_i + \lambda a_i$"
    rows = r"\[m\ddot r - m r\dot\phi^2 + b\dot r = \lambda\]\[(J + m r^2)\ddot\phi + 2 m r\dot r\dot\phi = \tau\]"
    last = r"\[M\ddot z - M g = \lambda\]\[r + z = L\]"
    assert spinner().check(f"{general}\n{rows}{last}", hint=0).right
    assert not spinner().check(f"{general}\n{rows}{last.replace('= ', '= -')}", hint=0).right


@cache
def winch() -> Derivation:
    """A collar on a pole, on a rope through a ring to a drum."""
    sys = System("winch")
    s, phi = sys.coordinates("s phi")
    m, J, r, d, l0 = sys.parameters("m J r d l_0")
    sys.kinetic(m * s.diff() ** 2 / 2 + J * phi.diff() ** 2 / 2)
    sys.potential(-m * sys.parameter("g") * s)
    sys.constraint(sqrt(s**2 + d**2) - l0 - r * phi, name="rope")
    return sys.derive()


PULLED = """m s'' = m g - S cos(alpha)
J phi'' = S r
cos(alpha) = s/sqrt(s^2 + d^2)
sqrt(s^2 + d^2) = l_0 + r phi
"""


@pytest.mark.slow
def test_one_line_says_what_the_cosine_of_an_angle_of_the_answer_is() -> None:
    assert winch().check(PULLED, hint=0).right
    assert winch().check(PULLED.replace("cos(alpha)", "sin(alpha)"), hint=0).right
    for right, wrong in [
        ("= s/sqrt", "= d/sqrt"),
        ("= s/sqrt", "= -s/sqrt"),
        ("- S cos", "+ S cos"),
        ("- S cos(alpha)", "- S sin(alpha)"),
        ("sqrt(s^2 + d^2) = l_0", "sqrt(s^2 - d^2) = l_0"),
    ]:
        assert right in PULLED and not winch().check(PULLED.replace(right, wrong), hint=0).right
