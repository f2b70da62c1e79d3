"""A definition whose right value puts the lines right that use it is the mistake, wherever they use it.

Oracle: by hand, a wheel on a spring with a pendulum of length s at its axle, r counted to the right, heights upwards:

    (M + m + J/R²) ẍ + m s θ̈ cos θ − m s θ̇² sin θ + k x + b ẋ = 0
    m s² θ̈ + m s ẍ cos θ + m g s sin θ = 0

and a scanner with moments of inertia A, B, C on a mast that rolls by φ about its own axis x, turned by ψ about z:
ω = (φ̇ cos ψ, −φ̇ sin ψ, ψ̇), T* = ½ (J + A cos²ψ + B sin²ψ) φ̇² + ½ C ψ̇².
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
OF_BOB = "a = x'' + s theta'' cos(theta) - s theta'^2 sin(theta)"
BALANCE = "(M + J/R^2) x'' + m a = - k x - b x'"


@cache
def wheel() -> Derivation:
    """A wheel that rolls, on a spring and a damper, with a pendulum at its axle."""
    sys = System("wheel with a pendulum")
    x, theta = sys.coordinates("x theta")
    M, J, R, m, s, k, b, g = sys.parameters("M J R m s k b g", M=9, J=2, R=0.4, m=0.7, s=0.6, k=30, b=2, g=9.81)
    sys.rigid_body(M, J, at=sys.point("A", (x, R)), frame=sys.frame(-x / R, name="wheel"), name="wheel")
    sys.particle(m, at=sys.point("B", (x + s * sp.sin(theta), R - s * sp.cos(theta))), name="bob")
    sys.gravity(direction=(0, -1), g=g)
    sys.spring(k, deflection=x, name="spring")
    sys.damper(b, deflection=x, name="brake")
    return sys.derive()


@cache
def rail() -> Derivation:
    """A slider on a rail that turns, on a spring, with the rope of a weight: a_r = r̈ − r φ̇², a_φ = r φ̈ + 2 ṙ φ̇."""
    sys = System("slider on a rail")
    phi, r = sys.coordinates("phi r")
    J, m, M, c, d, g = sys.parameters("J m M c d g", J=3, m=2, M=5, c=4, d=1, g=9.81)
    tau = sys.input("tau")
    sys.rigid_body(1, J, at=sys.origin, frame=sys.frame(phi, name="rail"), name="rail")
    sys.particle(m, at=sys.point("A", (r * sp.cos(phi), r * sp.sin(phi))), name="slider")
    sys.kinetic(M * sp.diff(r, time) ** 2 / 2, name="weight")
    sys.potential(M * g * r, name="weight of the weight")
    sys.damper(c, deflection=r, name="rail friction")
    sys.damper(d, deflection=phi, name="bearing")
    sys.torque(tau, on=phi, name="motor")
    return sys.derive()


@cache
def roller() -> Derivation:
    """A wheel that rolls by a constraint, x = R φ, with a bar of length l at its axle, θ from the horizontal."""
    sys = System("roller with a bar")
    x, phi, theta = sys.coordinates("x phi theta")
    M, J, R, m, I, a, b, g = sys.parameters("M J R m I a b g", M=9, J=2, R=0.4, m=3, I=0.5, a=0.6, b=2, g=9.81)
    sys.rigid_body(M, J, at=sys.point("A", (x, R)), frame=sys.frame(-phi, name="wheel"), name="wheel")
    at = sys.point("C", (x + a * sp.cos(theta), R + a * sp.sin(theta)))
    sys.rigid_body(m, I, at=at, frame=sys.frame(theta, name="bar"), name="bar")
    sys.gravity(direction=(0, -1), g=g)
    sys.damper(b, deflection=phi + theta, name="hinge")
    sys.constraint(x - R * phi, name="rolling")
    return sys.derive()


@cache
def scanner() -> Derivation:
    """A scanner on a mast that rolls with a ship, with different moments of inertia about its axes."""
    sys = System("scanner")
    phi, psi = sys.coordinates("phi psi")
    m, J, A, B, C, K = sys.parameters("m J A B C K", m=2, J=30, A=2, B=5, C=6, K=9)
    ship = sys.frame(phi, axis=(1, 0, 0), name="ship")
    turned = sys.frame(psi, axis=(0, 0, 1), parent=ship, name="scanner")
    sys.rigid_body(m, (J, 0, 0), at=sys.origin, frame=ship, name="ship")
    sys.rigid_body(m, (A, B, C), at=sys.origin, frame=turned, name="scanner")
    sys.spring(K, deflection=phi, name="buoyancy")
    return sys.derive()


@cache
def railway() -> Derivation:
    """A car on four wheels and a drum that a rope turns."""
    sys = System("car")
    s = sys.coordinate("s")
    M, mw, Jw, r, J, R, k = sys.parameters("M m_w J_w r J R k")
    sys.particle(M, at=sys.point("A", (s, 0)), name="car")
    sys.rigid_body(4 * mw, 4 * Jw, at=sys.point("B", (s, 0)), frame=sys.frame(-s / r, name="wheel"), name="wheels")
    sys.rigid_body(0, J, at=sys.origin, frame=sys.frame(s / R, name="drum"), name="drum")
    sys.spring(k, deflection=s, name="spring")
    return sys.derive()


def found(verdict: CheckedAnswer) -> list[tuple[int, bool, bool]]:
    """The number of every line with a verdict, whether it is right, and whether it is wrong because of another."""
    return [(f.line.number, f.status.right, f.follows) for f in verdict.findings]


@pytest.mark.slow
@pytest.mark.parametrize("beside", ["", ", h = s (1 - cos(theta))"])
def test_a_wrong_acceleration_that_a_balance_of_another_body_uses_is_the_mistake(beside: str) -> None:
    """The row of θ is right: it was not made with this acceleration."""
    right = [OF_BOB + beside, BALANCE, WHEEL, BOB]
    assert wheel().check("\n".join(right)).right
    wrong = [x.replace("- s theta'^2", "+ s theta'^2").replace("- m s theta'^2", "+ m s theta'^2") for x in right]
    verdict = wheel().check("\n".join(wrong))
    told = [x for x in found(verdict) if x[0] != 1 or not x[1]]
    assert told == [(1, False, False), (2, False, True), (3, False, True), (4, True, False)]
    (mistake,) = verdict.mistakes
    assert str(mistake.what) == (
        "Line 1 is not right: the x component of the acceleration of particle 'bob' is "
        "-s*sin(theta)*theta'^2 + s*cos(theta)*theta'' + x'', not s*sin(theta)*theta'^2 + s*cos(theta)*theta'' + x'': "
        "the term s*sin(theta)*theta'^2 has the wrong sign."
    )


def test_a_right_acceleration_beside_a_wrong_balance_is_not_the_mistake() -> None:
    verdict = wheel().check("\n".join([OF_BOB, BALANCE.replace("- k x", "+ k x"), WHEEL, BOB]))
    assert found(verdict)[:2] == [(1, True, False), (2, False, False)] and not verdict.right


def test_another_mistake_beside_a_wrong_acceleration_stays_one() -> None:
    """Line 3 is wrong by the spring as well, which no acceleration changes."""
    wrong = [OF_BOB.replace("- s", "+ s"), BALANCE, WHEEL.replace("- m s", "+ m s").replace("+ k x", "- k x"), BOB]
    verdict = wheel().check("\n".join(wrong))
    assert found(verdict)[:3] == [(1, False, False), (2, False, True), (3, False, False)]


POLAR = """a_r = r'' - r phi'^2
a_phi = r phi'' + 2 r' phi'
m a_r = -S - c r'
m a_phi = N
J phi'' = tau - d phi' - N r
M r'' = S - M g
(J + m r^2) phi'' + 2 m r r' phi' + d phi' = tau
(m + M) r'' - m r phi'^2 + c r' + M g = 0"""


@pytest.mark.slow
def test_a_wrong_acceleration_across_is_told_where_it_was_said() -> None:
    right = rail().check(POLAR)
    assert right.right and all(f.status.right for f in right.findings)
    verdict = rail().check(POLAR.replace("2 r' phi'", "r' phi'").replace("2 m r r'", "m r r'"))
    wrong = {f.line.number: f.follows for f in verdict.findings if not f.status.right}
    assert wrong.pop(2) is False and all(wrong.values()) and 7 in wrong
    assert str(verdict.mistakes[0].what).endswith("r*phi'' + phi'*r': the term phi'*r' should be 2*phi'*r'.")


def test_a_wrong_balance_beside_right_accelerations_is_not_theirs() -> None:
    verdict = rail().check(POLAR.replace("- N r", "+ N r").replace("J + m r^2", "J - m r^2").replace("+ 2 m", "- 2 m"))
    assert not verdict.right
    assert all(f.status.right for f in verdict.findings if f.line.number in (1, 2))


BETA = """theta = pi/2 - beta
x = R phi
I_h = I + m a^2
T = 1/2 (M + m + J/R^2) x'^2 + m a x' beta' cos(beta) + 1/2 I_h beta'^2
(M + m + J/R^2) x'' + m a beta'' cos(beta) - m a beta'^2 sin(beta) + b/R (x'/R - beta') = 0
(I + m a^2) beta'' + m a x'' cos(beta) - m g a sin(beta) - b (x'/R - beta') = 0"""


def test_an_angle_counted_the_other_way_is_right_beside_a_constraint() -> None:
    assert roller().check(BETA).right
    assert not roller().check(BETA.replace("pi/2 - beta", "pi/2 + beta"), hint=0).right
    assert not roller().check(BETA.replace("- m g a", "+ m g a"), hint=0).right


@pytest.mark.slow
def test_a_sum_that_is_written_again_is_put_right_as_well() -> None:
    verdict = roller().check(BETA.replace("I + m a^2", "I + m R^2"))
    assert found(verdict) == [(2, True, False), (3, False, False), (4, False, True), (5, True, False), (6, False, True)]
    assert "is I + a^2*m, not I + R^2*m: the term R^2*m should be a^2*m" in str(verdict.mistakes[0].what)


def test_the_definitions_that_an_energy_uses_are_the_mistake_and_not_it() -> None:
    sheet = """xB' = x' + s theta' cos(theta)
yB' = s theta' sin(theta)
T_B = 1/2 m (xB'^2 + yB'^2)
T_w = 1/2 (M + J/R^2) x'^2"""
    rows = [WHEEL, BOB]
    assert wheel().check("\n".join([sheet, *rows])).right
    turned = {"m s theta'' cos": "m s theta'' sin", "- m s theta'^2 sin": "+ m s theta'^2 cos", "x'' cos": "x'' sin"}
    wrong = [sheet.replace("cos", "COS").replace("sin", "cos").replace("COS", "sin")]
    for row in rows:
        for old, new in turned.items():
            row = row.replace(old, new)
        wrong.append(row)
    verdict = wheel().check("\n".join(wrong))
    assert found(verdict)[:3] == [(1, False, False), (2, False, False), (3, False, True)]


SCANNER = """w1 = phi' cos(psi)
w2 = -phi' sin(psi)
T = 1/2 (J + A cos(psi)^2 + B sin(psi)^2) phi'^2 + 1/2 C psi'^2
V = 1/2 K phi^2"""


def test_components_of_an_angular_velocity_are_told_where_they_are_said() -> None:
    assert not any("wrong" in f.status.value for f in scanner().check(SCANNER).findings)
    wrong = SCANNER.replace("phi' cos(psi)\nw2 = -phi' sin", "phi' sin(psi)\nw2 = phi' cos")
    wrong = wrong.replace("A cos(psi)^2 + B sin(psi)^2", "A sin(psi)^2 + B cos(psi)^2")
    verdict = scanner().check(wrong)
    assert found(verdict) == [(1, False, False), (2, False, False), (3, False, True), (4, True, False)]
    assert str(verdict.mistakes[0].what) == (
        "Line 1 is not right: the component of the angular velocity of rigid body 'scanner' along its first axis is "
        "cos(psi)*phi', not sin(psi)*phi'."
    )
    assert str(verdict.mistakes[1].what).endswith("second axis is -sin(psi)*phi', not cos(psi)*phi'.")


def test_the_index_of_a_moment_of_inertia_says_whose_angular_velocity_it_is() -> None:
    rest = "om_d = s'/R\nT = 1/2 (M + 4 m_w + 4 J_w/r^2 + J/R^2) s'^2\nV = 1/2 k s^2"
    assert all(f.status.right for f in railway().check(f"om_w = s'/r\n{rest}").findings)
    verdict = railway().check(f"om_w = s'/R\n{rest}".replace("J_w/r^2", "J_w/R^2"))
    assert found(verdict) == [(1, False, False), (2, True, False), (3, False, True), (4, True, False)]
    assert "angular velocity of rigid body 'wheels' is s'/r, not s'/R" in str(verdict.mistakes[0].what)


@cache
def panel() -> Derivation:
    """A panel on a hub that turns about z, hinged by θ at a distance R, with its centre a distance s further."""
    sys = System("panel")
    phi, theta = sys.coordinates("phi theta")
    J, m, R, s, k = sys.parameters("J m R s k", J=3, m=2, R=0.5, s=0.4, k=9)
    hub = sys.frame(phi, axis=(0, 0, 1), name="hub")
    sys.rigid_body(1, (0, 0, J), at=sys.origin, frame=hub, name="hub")
    at = sys.point("S", (R + s * sp.cos(theta), 0, s * sp.sin(theta)), frame=hub)
    sys.particle(m, at=at, name="panel")
    sys.spring(k, deflection=theta, name="hinge")
    return sys.derive()


@pytest.mark.slow
def test_the_distance_from_an_axis_is_judged_as_an_arm() -> None:
    T = "T = 1/2 J phi'^2 + 1/2 m (R + s cos(theta))^2 phi'^2 + 1/2 m s^2 theta'^2"
    sheet = f"rho = R + s cos(theta)\n{T}\nV = 1/2 k theta^2"
    assert all(f.status.right for f in panel().check(sheet).findings)
    verdict = panel().check(sheet.replace("cos", "sin"))
    assert found(verdict) == [(1, False, False), (2, False, True), (3, True, False)]
    assert "is R + s*cos(theta), not R + s*sin(theta)" in str(verdict.mistakes[0].what)
    half = panel().check(sheet.replace("1/2 m (R", "m (R"))
    assert found(half)[:2] == [(1, True, False), (2, False, False)]


def test_a_rate_may_be_said_of_one_body_after_another() -> None:
    said = "axle: X' = x', Y' = 0\nbob: X' = x' + s theta' cos(theta), Y' = s theta' sin(theta)"
    assert wheel().check("\n".join([said, T, WHEEL, BOB])).right
    wrong = wheel().check("\n".join([said.replace("+ s", "- 2 s"), T, WHEEL, BOB]))
    assert not wrong.right and wrong.first_wrong is not None and wrong.first_wrong.line.number == 2


@pytest.mark.parametrize(
    "said", ["Acceleration of the bob to the right: {}", "Accelerations of the bob:\n- to the right: {}"]
)
def test_an_acceleration_in_words_is_judged(said: str) -> None:
    """An expression behind such words is no equation of motion."""
    right = said.format(OF_BOB.removeprefix("a = "))
    assert wheel().check("\n".join([right, WHEEL, BOB])).right
    wrong = right.replace("- s theta'^2", "+ s theta'^2")
    bob = BOB.replace(" + m s x''", " + 2 m s^2 theta'^2 sin(theta) cos(theta) + m s x''")
    verdict = wheel().check("\n".join([wrong, WHEEL.replace("- m s theta'^2", "+ m s theta'^2"), bob]))
    assert [x[1:] for x in found(verdict)] == [(False, False), (False, True), (False, True)]
    assert str(verdict.mistakes[0].what).endswith("the term s*sin(theta)*theta'^2 has the wrong sign.")


def test_an_energy_of_a_translation_alone_is_told_as_that() -> None:
    """T₃ is the energy of the same body's rotation."""
    sheet = "T_1 = 1/2 m (x'^2 + s^2 theta'^2 + 2 s x' theta' cos(theta))\nT_2 = {} M x'^2\nT_3 = 1/2 J x'^2/R^2"
    assert wheel().check("\n".join([sheet.format("1/2"), WHEEL, BOB])).right
    verdict = wheel().check("\n".join([sheet.format("1/4"), WHEEL.replace("(M +", "(1/2 M +"), BOB]))
    wrong = {f.line.number: f.follows for f in verdict.findings if not f.status.right}
    assert wrong == {2: False, 4: True}
    assert "the kinetic energy of the translation of rigid body 'wheel' is" in str(verdict.mistakes[0].what)


def test_a_wrong_potential_beside_a_constraint_is_told_where_it_is_said() -> None:
    rows = """x - R phi = 0
x'' - R phi'' = 0
(M + m) x'' - m a theta'' sin(theta) - m a theta'^2 cos(theta) = mu
J phi'' = -b (phi' + theta') - R mu
(I + m a^2) theta'' - m a x'' sin(theta) + m g a cos(theta) = -b (phi' + theta')"""
    V = "V_1 = m g a sin(theta)"
    assert roller().check(f"{V}\n{rows}").right
    verdict = roller().check(f"{V.replace('g a', '2 g a')}\n{rows.replace('m g a', '2 m g a')}")
    assert found(verdict)[0] == (1, False, False) and found(verdict)[-1] == (6, False, True)
    assert "potential energy of the weight" in str(verdict.mistakes[0].what)
