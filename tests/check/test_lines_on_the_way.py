"""Lines between others are read for what they are, and the one wrong term of an equation put together is told.

Oracle: by hand. A wheel (m, J, r) on an arm at the distance s from a post (I), which rolls on a pan, r φ̇ = s ψ̇:

    (I + m s² + J s²/r²) ψ̈ + (2 m + J/r²) s ṡ ψ̇ + c s² ψ̇/r² = τ,     m s̈ − m s ψ̇² + k s = 0

and a sledge M with a slider m at x + y, on a spring:   (M + m) ẍ + m ÿ = 0,   m (ẍ + ÿ) + k y = 0.
"""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

from lagrangian import Derivation, System


@cache
def mill() -> Derivation:
    """A wheel that rolls around a post, and slides along its arm."""
    sys = System("mill")
    psi, s, phi = sys.coordinates("psi s phi")
    I, m, J, r, k, c = sys.parameters("I m J r k c")
    tau = sys.inputs("tau")
    post = sys.frame(psi, name="post")
    sys.rigid_body(0, I, at=sys.origin, frame=post, name="post")
    sys.rigid_body(m, J, at=post.point(s, 0), frame=sys.frame(phi, name="turn"), name="wheel")
    sys.spring(k, deflection=s)
    sys.damper(c, deflection=phi, name="bearing")
    sys.torque(tau, on=psi, name="motor")
    sys.velocity_constraint(s * psi.diff() - r * phi.diff())
    return sys.derive()


@cache
def sledge() -> Derivation:
    """A slider on a sledge, with a spring between them."""
    sys = System("sledge")
    x, y = sys.coordinates("x y")
    M, m, k, _l = sys.parameters("M m k l")
    sys.particle(M, at=sys.point("A", (x, 0)), name="sledge")
    sys.particle(m, at=sys.point("B", (x + y, 0)), name="slider")
    sys.spring(k, deflection=y)
    return sys.derive()


@cache
def crank() -> Derivation:
    """A weight that a rope lifts over a pulley: z + 2 l sin(ψ/2) = L."""
    sys = System("crank")
    psi, z = sys.coordinates("psi z")
    m, J, l, M, L, g = sys.parameters("m J l M L g")
    leaf = sys.frame(-psi, name="leaf")
    sys.rigid_body(m, J, at=leaf.point(0, l / 2), frame=leaf, name="leaf")
    sys.particle(M, at=sys.point("W", (0, l - z)), name="weight")
    sys.gravity((0, -1), g)
    sys.constraint(z + 2 * l * sin(psi / 2) - L, name="rope")
    return sys.derive()


REDUCED = """Rolling: r phi' = s psi'
(I + m s^2 + J s^2/r^2) psi'' + (2 m + J/r^2) s s' psi' + c s^2/r^2 psi' = tau
m s'' - m s psi'^2 + k s = 0"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong", "told"),
    [
        ("J s^2/r^2", "J s^2/r", "J*s^2*psi''/r should be J*s^2*psi''/r^2"),
        ("(2 m + J/r^2) s", "2 m s", "the term J*s*psi'*s'/r^2 is missing"),
        ("c s^2/r^2", "c s/r^2", "c*s*psi'/r^2 should be c*s^2*psi'/r^2"),
    ],
)
def test_the_wrong_term_is_told_where_velocities_are_constrained(right: str, wrong: str, told: str) -> None:
    assert mill().check(REDUCED).right
    verdict = mill().check(REDUCED.replace(right, wrong, 1))
    assert not verdict.right and told in str(verdict.mistakes[0].what)


SOLVED = """Rolling: r phi' = s psi'
psi'' = (tau - (2 m + J/r^2) s s' psi' - c s^2/r^2 psi')/(I + m s^2 + J s^2/r^2)
s'' = s psi'^2 - k s/m"""


def test_the_wrong_term_of_a_denominator_is_told_where_velocities_are_constrained() -> None:
    assert mill().check(SOLVED).right
    verdict = mill().check(SOLVED.replace("J s^2/r^2)", "J s/r^2)"))
    assert not verdict.right
    assert str(verdict.mistakes[0].what).endswith(" J*s/r^2 should be J*s^2/r^2."), verdict.mistakes[0].what


WITH_FORCE = """post   T1 = I psi'^2/2
wheel  T2 = m (s psi')^2/2 + m s'^2/2 + J phi'^2/2
condition s psi' - r phi' = 0 with multiplier lam
psi)  (I + m s^2) psi'' + 2 m s s' psi' = tau + lam s
s)    m s'' - m s psi'^2 + k s = 0
phi)  J phi'' = - c phi' - lam r"""


@pytest.mark.slow
def test_an_energy_from_which_an_equation_follows_is_told_beside_multipliers() -> None:
    assert mill().check(WITH_FORCE).right
    verdict = mill().check(WITH_FORCE.replace("m s'^2/2 + ", "").replace("m s'' - ", "- "))
    assert not verdict.right and str(verdict.mistakes[0].what).startswith("Line 2 is not right: the kinetic energy")
    later = mill().check(WITH_FORCE.replace("m s'' - ", "- "))
    assert not later.right and all("Line 2" not in str(m.what) for m in later.mistakes)


ROWS = "(M + m) x'' + m y'' = 0\n"


def test_what_was_done_with_an_equation_is_no_part_of_it() -> None:
    text = f"l m (x'' + y'') + k y l = 0\ndivided by l:\nm (x'' + y'') + k y = 0\n{ROWS}"
    assert sledge().check(text).right
    verdict = sledge().check(text.replace("+ k y = 0", "+ k y l = 0"))
    assert [f.line.number for f in verdict.findings if not f.status.right] == [3]


def test_a_heading_may_end_with_a_star() -> None:
    text = f"factor of x*:\n{ROWS}factor of y*:\nm (x'' + y'') + k y = 0"
    assert sledge().check(text).right
    assert not sledge().check(text.replace("+ k y", "- k y")).right


PARTS = """Energies body by body
 sledge  T = 1/2*M*x'^2
 slider  T = 1/2*m*x'^2
         T = m*x'*y' + 1/2*m*y'^2
V = 1/2 k y^2
(M + m) x'' + m y'' = 0
m (x'' + y'') + k y = 0"""


def test_a_second_row_of_a_part_is_added_up() -> None:
    assert sledge().check(PARTS).right
    wrong = sledge().check(PARTS.replace("m*x'*y' +", "m*x'*y'/2 +"))
    assert not wrong.right
    later = sledge().check(PARTS.replace("+ k y = 0", "= 0"))
    assert [f.line.number for f in later.findings if not f.status.right] == [7]


DERIVED = """T = 1/2 M x'^2
T = 1/2 m (x' + y')^2
V = 1/2 k y^2
dT/dx' = M x' + m (x' + y')
(M + m) x'' + m y'' = 0
m (x'' + y'') + k y = 0"""


def test_a_derivative_is_that_of_all_parts() -> None:
    assert sledge().check(DERIVED).right
    wrong = sledge().check(DERIVED.replace("dT/dx' = M x' + m", "dT/dx' = M x' - m"))
    assert [f.line.number for f in wrong.findings if not f.status.right] == [4]


PROGRAM = """z[t_] := L - 2 l Sin[psi[t]/2]
T = (J + m l^2/4)/2 psi'[t]^2 + M/2 z'[t]^2;
V = m g l/2 Cos[psi[t]] - M g z[t];
eq = D[D[T - V, psi'[t]], t] - D[T - V, psi[t]] == 0"""


@pytest.mark.slow
def test_a_program_puts_in_what_it_has_given() -> None:
    assert crank().check(PROGRAM).right
    verdict = crank().check(PROGRAM.replace("m l^2/4", "m l^2/3"))
    assert not verdict.right and all("weight" not in str(m.what) for m in verdict.mistakes)


ON_ROPE = """f = z + 2 l sin(psi/2) - L
(J + m l^2/4) psi'' - m g l/2 sin(psi) = lambda l cos(psi/2)
M z'' - M g = lambda
z'' + l cos(psi/2) psi'' - l/2 sin(psi/2) psi'^2 = 0"""


def test_what_f_is_decides_which_factor_is_wrong() -> None:
    assert crank().check(ON_ROPE).right
    verdict = crank().check(ON_ROPE.replace("lambda l cos", "2 lambda l cos"))
    assert [f.line.number for f in verdict.findings if not f.status.right] == [2]


def test_a_wrong_identity_is_told() -> None:
    right = "sin(psi/2) cos(psi/2) = sin(psi)/2\n" + ON_ROPE
    assert crank().check(right).right
    verdict = crank().check(right.replace("sin(psi)/2\n", "2 sin(psi)\n"))
    assert not verdict.right and str(verdict.mistakes[0].what).startswith("Line 1 is no identity: ")
    assert str(verdict.mistakes[0].what).endswith("is sin(psi)/2, not 2*sin(psi).")


@cache
def wagon() -> Derivation:
    """A wagon on four wheels, and two balls that hang from it."""
    sys = System("wagon")
    x, theta = sys.coordinates("x theta")
    M, m, J, r, b, l, g, c = sys.parameters("M m J r b l g c")
    at = sys.point("A", (x, 0))
    sys.particle(M, at=at, name="body")
    sys.rigid_body(4 * m, 4 * J, at=at, frame=sys.frame(-x / r, name="wheel"), name="wheels")
    for k in (1, 2):
        sys.particle(b, at=at + (l * sin(theta), -l * cos(theta)), name=f"ball {k}")
        sys.damper(c, deflection=theta, name=f"joint {k}")
    sys.gravity((0, -1), g)
    return sys.derive()


OF_WAGON = """Kinetic energy
  body        M x'^2/2
  one wheel   m x'^2/2 + J x'^2/(2 r^2)     (4 of them)
Equations
(M + 4 m + 2 b + 4 J/r^2) x'' + 2 b l cos(theta) theta'' - 2 b l sin(theta) theta'^2 = 0
2 b l^2 theta'' + 2 b l cos(theta) x'' + 2 b g l sin(theta) + 2 c theta' = 0"""


def test_an_energy_of_one_of_several_equal_parts_is_not_called_missing() -> None:
    verdict = wagon().check(OF_WAGON.replace("M + 4 m +", "M +"))
    assert not verdict.right and str(verdict.mistakes[0].what).startswith("The term 4*m*x'' of the equation of x is")


def test_a_mistake_in_one_of_two_equal_elements_says_so() -> None:
    verdict = wagon().check("\n".join(OF_WAGON.splitlines()[4:]).replace("2 c theta'", "c theta'"))
    assert not verdict.right
    assert str(verdict.mistakes[0].what).startswith("One of damper 'joint 1' and damper 'joint 2' ")


@cache
def hoist() -> Derivation:
    """A drum with a brake and a slider on a spring lower a weight: z = r φ + x."""
    sys = System("hoist")
    phi, x, z = sys.coordinates("phi x z")
    J, m, M, r, k, c, g = sys.parameters("J m M r k c g")
    tau = sys.inputs("tau")
    sys.rigid_body(0, J, at=sys.origin, frame=sys.frame(phi, name="turn"), name="drum")
    sys.particle(m, at=sys.point("S", (x, 0)), name="slider")
    sys.particle(M, at=sys.point("W", (0, -z)), name="weight")
    sys.gravity((0, -1), g)
    sys.spring(k, deflection=x)
    sys.damper(c, deflection=phi, name="brake")
    sys.torque(tau, on=phi, name="motor")
    sys.constraint(z - r * phi - x, name="rope")
    return sys.derive()


def test_a_force_that_is_put_in_without_its_arm_is_told() -> None:
    right = """z'' = r phi'' + x''
m x'' + k x + M (r phi'' + x'') - M g = 0
J phi'' + c phi' - tau + r (M (r phi'' + x'') - M g) = 0"""
    assert hoist().check(right).right
    verdict = hoist().check(right.replace("+ r (M (r phi'' + x'') - M g)", "+ M (r phi'' + x'') - M g"))
    assert not verdict.right
    assert str(verdict.mistakes[0].what) == (
        "In line 3, -M*g + M*(r*phi'' + x'') should be r*(-M*g + M*(r*phi'' + x''))."
    ), verdict.mistakes[0].what


def test_a_drum_turns_with_its_motor_and_its_brake() -> None:
    sys = System("winch")
    s = sys.coordinates("s")
    M, J, a, c = sys.parameters("M J a c")
    tau = sys.inputs("tau")
    sys.particle(M, at=sys.point("P", (s, 0)), name="load")
    sys.kinetic(J * (2 * s.diff() / a) ** 2 / 2, name="drum")
    sys.torque(tau, on=2 * s / a, name="motor")
    sys.damper(c, deflection=2 * s / a, name="brake")
    derivation = sys.derive()
    right = "the drum turns: psi' = 2 s'/a\n(M + 4 J/a^2) s'' + 4 c s'/a^2 = 2 tau/a"
    assert derivation.check(right).right
    verdict = derivation.check("the drum turns: psi' = s'/a\n(M + J/a^2) s'' + c s'/a^2 = tau/a")
    assert not verdict.right
    assert str(verdict.mistakes[0].what).startswith(
        "Line 1 is not right: the angular velocity of 'drum' is 2*s'/a, not"
    )


@cache
def bead() -> Derivation:
    """A bead that slides on a rod that turns, pulled back by a spring, with friction along the rod."""
    s = System("bead on a turning rod")
    u, w = s.coordinates("u w")
    m, J, k, c = s.parameters("m J k c")
    s.kinetic(J * w.diff() ** 2 / 2 + m * u.diff() ** 2 / 2 + m * u**2 * w.diff() ** 2 / 2)
    s.spring(k, deflection=u, name="spring")
    s.damper(c, deflection=u, name="friction")
    return s.derive()


def test_an_equation_of_two_wrong_derivatives_follows_and_none_of_its_terms_is_told_as_wrong() -> None:
    T, V = "T = J w'^2/2 + m u'^2 + m u^2 w'^2/2", "V = k u^2/2"
    p, slope = "∂L/∂u' = 2 m u'", "∂L/∂u = m u w'^2/2 - k u"
    own = "2 m u'' - m u w'^2/2 + k u = -c u'"
    verdict = bead().check("\n".join([T, V, p, slope, own]))
    findings = {f.line.number: f for f in verdict.findings}
    assert findings[5].follows and "line 5:" not in str(verdict) and "line 5," not in str(verdict)
    other = {f.line.number: f for f in bead().check("\n".join([T, V, p, slope, own.replace("= -", "= ")])).findings}
    assert not other[5].follows and not other[5].status.right
