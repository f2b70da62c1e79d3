"""What is told first is true of the answer: it blames no line that is right, and no cause that the lines refute.

Oracle: by hand, from what each answer states. The systems are in their fixtures.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from small_systems import cart

import lagrangian as lg
from lagrangian.check.verb import CheckedAnswer

CART = """(M{before}) x'' - m l phi'^2 sin(phi) - m g sin(phi) cos(phi) + k x = 0
m l^2 phi'' + m l x'' cos(phi) + m g l sin(phi) = 0"""
"""The cart's equation with l φ̈ = −ẍ cos φ − g sin φ put in, so that M + m − m cos² φ multiplies ẍ."""


def first(verdict: CheckedAnswer) -> str:
    assert not verdict.right
    return str(verdict.mistakes[0].what)


def opened(verdict: CheckedAnswer) -> set[int]:
    """The lines that are called wrong and follow from none."""
    return {f.line.number for f in verdict.open_findings}


def test_no_fraction_is_blamed_in_a_line_without_one() -> None:
    assert cart().check(CART.format(before=" + m sin(phi)^2")).right
    verdict = cart().check(CART.format(before=""))
    assert opened(verdict) == {1}
    assert "numerator" not in first(verdict) and "denominator" not in first(verdict)
    assert "what multiplies x''" in first(verdict) and "sin(phi)^2" in first(verdict)
    assert not any(f.differences for f in verdict.findings)  # the line is no equation with both accelerations


def test_a_fraction_is_blamed_where_it_stands() -> None:
    solved = "x'' = (m l phi'^2 sin(phi) + m g sin(phi) cos(phi) - k x)/(M{})\n" + CART.split("\n")[1]
    assert cart().check(solved.format(" + m sin(phi)^2")).right
    assert "denominator" in first(cart().check(solved.format("")))


@cache
def wire() -> lg.Derivation:
    """A bead on a wire y = x²/(2 p), with a drag along the wire."""
    s = lg.System("bead on a wire")
    x = s.coordinate("x")
    m, p, c, g = s.parameters("m p c g")
    at = s.point("A", (x, x**2 / (2 * p)))
    s.particle(m, at=at, name="bead")
    s.gravity((0, -1), g)
    s.force((-c * x.diff(), -c * x * x.diff() / p), at=at, name="drag")
    return s.derive()


WIRE = """T = 1/2 m (1 + x^2/p^2) x'^2
V = m g x^2/(2 p)
Xi_x = -c {}x'
m (1 + x^2/p^2) x'' + m x x'^2/p^2 + m g x/p = -c {}x'"""


def test_no_arm_is_missing_where_one_of_two_terms_is() -> None:
    assert wire().check(WIRE.format(*2 * ["(1 + x^2/p^2) "])).right
    verdict = wire().check(WIRE.format("", ""))
    assert "arm" not in first(verdict)
    assert "x^2*x'/p^2 is missing" in first(verdict)


@cache
def discs() -> lg.Derivation:
    """A disc J that carries another one, I, which turns by ψ against it."""
    s = lg.System("two discs")
    theta, psi = s.coordinates("theta psi")
    J, I, c = s.parameters("J I c")
    s.rigid_body(mass=1, inertia=J, at=s.origin, frame=s.frame(theta, name="low"), name="low disc")
    s.rigid_body(mass=1, inertia=I, at=s.origin, frame=s.frame(theta + psi, name="high"), name="high disc")
    s.damper(c, deflection=psi, name="bearing")
    s.torque(s.input("M"), on=theta, name="motor")
    return s.derive()


def test_a_moment_of_inertia_is_called_so() -> None:
    rest = "I (theta'' + psi'') + c psi' = 0"
    assert discs().check(f"(J + I) theta'' + I psi'' = M\n{rest}").right
    verdict = discs().check(f"J theta'' + I psi'' = M\n{rest}")
    told = " ".join(str(m.what) for m in (*verdict.mistakes, *verdict.alternatives))
    assert "I*theta''" in first(verdict) and "mass" not in told
    assert "stands once" not in told  # it does not stand there at all


@cache
def arm() -> lg.Derivation:
    """A rod J with a bob m at the end l, whose other bar leans by φ: places along both axes."""
    s = lg.System("arm")
    phi, theta = s.coordinates("phi theta")
    h, a, m, J, c = s.parameters("h a m J c")
    at = s.point("S", (-h * sp.sin(phi) + a * sp.sin(theta), h * sp.cos(phi) - a * sp.cos(theta)))
    s.rigid_body(mass=m, inertia=J, at=at, frame=s.frame(theta, name="stove"), name="stove")
    s.spring(c, deflection=phi, name="stay")
    s.torque(s.input("M"), on=phi, name="motor")
    return s.derive()


SPEEDS = """x = -h sin(phi) + a sin(theta)
y = h cos(phi) - a cos(theta)
xdot = -h cos(phi) phi' + a cos(theta) theta'
ydot = -h sin(phi) phi' + a sin(theta) theta'
v^2 = h^2 phi'^2 + a^2 theta'^2 - 2 h a phi' theta' cos(phi {0} theta)
T = 1/2 m (h^2 phi'^2 + a^2 theta'^2 - 2 h a phi' theta' cos(phi {0} theta)) + 1/2 J theta'^2
V = 1/2 c phi^2"""


def test_a_sign_that_a_right_line_has_is_no_reason() -> None:
    assert all(f.status.right for f in arm().check(SPEEDS.format("-")).findings)
    verdict = arm().check(SPEEDS.format("+"))
    assert first(verdict).startswith("Line 5 is not right")
    assert "wrong sign" not in " ".join(str(m.what) for m in (*verdict.mistakes, *verdict.alternatives))


ENERGY = """L = 1/2 M x'^2 + 1/2 m (x'^2 + l^2 phi'^2) + m g l cos(phi) - 1/2 k x^2
(M + m) x'' + {}k x = 0
m l^2 phi'' + m g l sin(phi) = 0"""


def test_no_half_is_missing_in_an_energy_that_has_it() -> None:
    verdict = cart().check(ENERGY.format("2 "))
    told = [str(m.what) for m in verdict.mistakes]
    assert any("2*k*x should be k*x" in x for x in told) and not any("energy of spring" in x for x in told)
    alone = cart().check(ENERGY.format("2 ").replace("1/2 k x^2", "k x^2"))  # here it is made in the energy
    assert any("spring" in str(m.what) and "½" in str(m.what) for m in alone.mistakes)


PROGRAM = """import sympy as sp
from sympy.physics.mechanics import dynamicsymbols
t = dynamicsymbols._t
x, phi = dynamicsymbols('x phi')
M, m, l, k, g = sp.symbols('M m l k g')
bob = sp.Matrix([x + l*sp.{}(phi), -l*sp.{}(phi)])
v = bob.diff(t)
T = M*x.diff(t)**2/2
T += m*v.dot(v)/2
V = k*x**2/2 + m*g*bob[1]
for q in (x, phi):
    print(sp.diff(sp.diff(T - V, q.diff(t)), t) - sp.diff(T - V, q), "= 0")
"""


def test_a_program_is_wrong_where_it_says_the_place_of_a_body() -> None:
    assert cart().check(PROGRAM.format("sin", "cos")).right
    verdict = cart().check(PROGRAM.format("cos", "sin"))
    assert opened(verdict) == {6}
    assert "position of particle 'bob'" in first(verdict)


NEWTON = """a_r = l phi'^2 {sign} x'' sin(phi)
M x'' = -k x + S sin(phi)
m (x'' + l phi'' cos(phi) - l phi'^2 sin(phi)) = -S sin(phi)
m (l phi'' sin(phi) + l phi'^2 cos(phi)) = S cos(phi) {weight} m g
(M + m) x'' + m l phi'' cos(phi) - m l phi'^2 sin(phi) + k x = 0
m l^2 phi'' + m l x'' cos(phi) + m g l sin(phi) = 0"""


def test_what_nothing_else_uses_is_not_called_right() -> None:
    assert cart().check(NEWTON.format(sign="-", weight="-")).right
    verdict = cart().check(NEWTON.format(sign="+", weight="+"))
    assert opened(verdict) == {4}
    assert 1 not in {f.line.number for f in verdict.findings}  # a_r stands in no other line
    assert "'a_r'" not in " ".join(str(n) for n in verdict.notes if "unknown force" in str(n))


@cache
def bell() -> lg.Derivation:
    """A bell J that hangs at c with a clapper of the length l, which turns by ψ against it."""
    s = lg.System("bell")
    phi, psi = s.coordinates("phi psi")
    J, c, l_, m = s.parameters("J c l m")
    s.rigid_body(mass=1, inertia=J, at=s.origin, frame=s.frame(phi, name="bell"), name="bell")
    at = s.point("P", (c * sp.sin(phi) + l_ * sp.sin(phi + psi), -c * sp.cos(phi) - l_ * sp.cos(phi + psi)))
    s.particle(m, at=at, name="clapper")
    return s.derive()


COLUMN = r"""$\vec r = (c\sin\phi + l\sin(\phi+\psi), -c\cos\phi - l\cos(\phi+\psi))$
\[ \dot{{\vec r}} = (c\dot\phi\cos\phi + l{0}\cos(\phi+\psi), c\dot\phi\sin\phi + l{0}\sin(\phi+\psi)) \]
\[ v^2 = c^2\dot\phi^2 + l^2{0}^2 + 2 c l\dot\phi{0}\cos\psi \]
\[ T = \frac12 J\dot\phi^2 + \frac12 m(c^2\dot\phi^2 + l^2{0}^2 + 2 c l\dot\phi{0}\cos\psi) \]"""


def test_the_rates_of_a_column_are_told_before_what_follows() -> None:
    assert all(f.status.right for f in bell().check(COLUMN.format(r"(\dot\phi+\dot\psi)")).findings)
    verdict = bell().check(COLUMN.format(r"\dot\psi"))
    assert opened(verdict) == {2}
    assert first(verdict).startswith("In line 2, the term l*cos(phi + psi)*phi' is missing")


@cache
def slide() -> lg.Derivation:
    """A crank J that moves a slide M along x = l sin φ."""
    s = lg.System("slide")
    phi = s.coordinate("phi")
    J, M, l_ = s.parameters("J M l")
    s.kinetic(J * phi.diff() ** 2 / 2, name="crank")
    s.particle(M, at=s.point("P", (l_ * sp.sin(phi), 0)), name="slide")
    s.torque(s.input("F"), on=phi, name="motor")
    return s.derive()


def test_multiples_that_are_written_otherwise_are_compared() -> None:
    row = "d/dt[(J {} M l^2 cos(phi)^2) phi'] + 1/2 M l^2 sin(2 phi) phi'^2 = F"
    assert slide().check(row.format("+")).right
    assert not slide().check(row.format("-")).right


@pytest.mark.parametrize("sign", ["+", "-"])
def test_nothing_above_is_blamed_for_a_solved_row(sign: str) -> None:
    verdict = cart().check(
        f"R = m l phi'^2 sin(phi) - k x\nD = M + m sin(phi)^2\nx'' = [R {sign} m g sin(phi) cos(phi)]/D\n"
        "phi'' = -[x'' cos(phi) + g sin(phi)]/l"
    )
    assert verdict.right if sign == "+" else opened(verdict) == {3}


@pytest.mark.parametrize("below", ["M - m sin(phi)^2", "M + 2 m sin(phi)^2"])
def test_a_wrong_denominator_is_wrong_where_it_is_defined(below: str) -> None:
    rest = (
        "\nR = m l phi'^2 sin(phi) - k x\nx'' = [R + m g sin(phi) cos(phi)]/D\nphi'' = -[x'' cos(phi) + g sin(phi)]/l"
    )
    assert cart().check(f"D = M + m sin(phi)^2{rest}").right
    verdict = cart().check(f"D = {below}{rest}")
    assert opened(verdict) == {1}
    assert first(verdict).startswith("Line 1 is not right: D is not what multiplies the acceleration")
    assert ("has the wrong sign" in first(verdict)) is ("-" in below)
    assert ("2*m*sin(phi)^2 should be m*sin(phi)^2" in first(verdict)) is ("2" in below[:6])


def test_a_right_denominator_is_not_blamed_for_a_factor_of_the_row() -> None:
    rest = "R = m l phi'^2 sin(phi) - k x\nphi'' = -[x'' cos(phi) + g sin(phi)]/l"
    verdict = cart().check(f"D = M + m sin(phi)^2\n{rest}\nx'' = 2 [R + m g sin(phi) cos(phi)]/D")
    assert opened(verdict) == {4}


@cache
def post() -> lg.Derivation:
    """A post J with a block M at the distance a, along which a puck m slides."""
    s = lg.System("post")
    r, phi = s.coordinates("r phi")
    J, M, m, a = s.parameters("J M m a")
    s.kinetic(J * phi.diff() ** 2 / 2, name="post")
    s.particle(M, at=s.point("A", (a * sp.cos(phi), a * sp.sin(phi))), name="block")
    s.particle(m, at=s.point("P", (r * sp.cos(phi), r * sp.sin(phi))), name="puck")
    s.torque(s.input("Q"), on=phi, name="motor")
    return s.derive()


@pytest.mark.parametrize("row", ["d/dt[(I + m r^2) phi'] = Q", "(I + m r^2) phi'' + 2 m r r' phi' = Q"])
def test_a_constant_is_wrong_where_it_is_defined_and_not_in_d_dt_of_it(row: str) -> None:
    rest = f"\n{row}\nm r'' - m r phi'^2 = 0"
    assert post().check(f"I = J + M a^2{rest}").right
    verdict = post().check(f"I = J - M a^2{rest}")
    assert opened(verdict) == {1}
    assert first(verdict).startswith("Line 1 is not right: the value of I is") and "reason" not in first(verdict)


@cache
def swing() -> lg.Derivation:
    """A bench on two links, on which a crate slides."""
    s = lg.System("swing")
    th, u = s.coordinates("th s")
    M, m, l_, k, g = s.parameters("M m l k g")
    at = (l_ * sp.sin(th), -l_ * sp.cos(th))
    s.particle(M, at=s.point("B", at), name="bench")
    s.particle(m, at=s.point("C", (at[0] + u, at[1])), name="crate")
    s.spring(k, deflection=u, name="spring")
    s.gravity((0, -1), g)
    return s.derive()


CHAIN = """from sympy import *
t, M, m, l, k, g = symbols("t M m l k g")
th, s = Function("th")(t), Function("s")(t)
xb, yb = l*sin(th), -l*{}(th)
xc, yc = xb + s, yb
T = M*(xb.diff(t)**2 + yb.diff(t)**2)/2 + m*(xc.diff(t)**2 + yc.diff(t)**2)/2
V = M*g*yb + m*g*yc + k*s**2/2
L = T - V
for q in (th, s):
    print(simplify(L.diff(q.diff(t)).diff(t) - L.diff(q)), "= 0")
"""


def test_a_place_that_is_made_of_a_wrong_one_follows() -> None:
    assert swing().check(CHAIN.format("cos")).right
    assert opened(swing().check(CHAIN.format("sin"))) == {4}


def test_nothing_is_called_right_beside_terms_of_which_nothing_is_known() -> None:
    verdict = cart().check(CART.format(before="").replace("k x", "k x + k l phi + M g - m g phi"))
    said = verdict.to_text()
    assert any(not d.origins for f in verdict.findings for d in f.differences)
    assert "Right in line" not in said and "What differs" not in said
