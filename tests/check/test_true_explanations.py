"""Explanations that say nothing untrue: what they quote was written, and what they call wrong is wrong."""

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from lagrangian.model import time


def told(system: lg.Derivation, answer: str) -> str:
    """What an explanation of a wrong answer says went wrong."""
    verdict = system.check(answer)
    assert not verdict.right
    return " And: ".join(str(m.what) for m in verdict.mistakes)


@pytest.fixture(scope="module")
def gears() -> lg.Derivation:
    """A wheel that an arm carries around a gear; its bearing on the arm damps."""
    s = lg.System("gears")
    a, b = s.coordinates("a b")
    J, Ja, Js, R, r, c, M = s.parameters("J Ja Js R r c M")
    gamma = s.define("gamma", ((R + r) * a - R * b) / r)
    arm, sun, wheel = (s.frame(x, name=n) for x, n in ((a, "arm"), (b, "sun"), (gamma, "wheel")))
    for frame, inertia in ((arm, Ja), (sun, Js), (wheel, J)):
        s.rigid_body(mass=M, inertia=inertia, at=s.origin, frame=frame, name=frame.name or "")
    s.damper(c, deflection=gamma - a, name="bearing")
    return s.derive()


T = "T = Ja/2 a'^2 + Js/2 b'^2 + J/2 (((R + r) a' {} R b')/r)^2\n"
ROWS = """(Ja + J (R + r)^2/r^2) a'' {0} J R (R + r)/r^2 b'' + {1} = 0
(Js + J R^2/r^2) b'' {0} J R (R + r)/r^2 a'' - {1} = 0"""
DAMPED = "c (R/r)^2 (a' - b')"


@pytest.mark.slow
def test_a_rate_is_quoted_with_the_sign_that_was_written(gears: lg.Derivation) -> None:
    assert gears.check(T.format("-") + ROWS.format("-", DAMPED), hint=0).right
    words = told(gears, T.format("+"))
    assert "not (R*b' + (R + r)*a')/r" in words, words


def test_without_its_line_no_rate_is_said_to_be_written(gears: lg.Derivation) -> None:
    words = told(gears, ROWS.format("+", DAMPED))
    assert "The terms that couple the equations" in words and "The angular velocity" not in words, words


def test_the_ratio_that_is_missing_in_the_work_of_a_damper_is_named(gears: lg.Derivation) -> None:
    words = told(gears, "Q_a = -c R/r (a' - b')\nQ_b = c R/r (a' - b')")
    assert "In what damper 'bearing' adds to Ξ, the factor R/r is missing." in words, words
    words = told(gears, ROWS.format("-", "c (a' - b')"))
    assert "The rate of damper 'bearing' is taken as a' - b'" in words and "stands in place" not in words, words


def test_the_angular_velocity_of_a_body_is_named_where_a_damper_is_given_it(gears: lg.Derivation) -> None:
    words = told(gears, "D = c/2 (((R + r) a' - R b')/r)^2")
    assert "The rate of damper 'bearing' is taken as (-R*b' + (R + r)*a')/r; it is R*a'/r - R*b'/r." in words, words


@pytest.fixture(scope="module")
def swing() -> lg.Derivation:
    """A pendulum on a mast that rolls as prescribed, with a damper against the mast and a spring on a loose pulley."""
    s = lg.System("swing")
    phi, y = s.coordinates("phi y")
    m, a, H, A, Omega, c, d, M = s.parameters("m a H A Omega c d M")
    mast = s.frame(A * sp.sin(Omega * time), name="mast")
    arm = s.frame(phi, name="arm")
    s.particle(m, at=s.point("bob", (0, -a), relative_to=s.point("top", (0, H), frame=mast), frame=arm), name="bob")
    s.particle(M, at=s.point("load", (3 * H, y)), name="load")
    s.damper(c, deflection=phi - A * sp.sin(Omega * time), name="hinge")
    s.damper(d, deflection=2 * y, name="rope")
    return s.derive()


ENERGY = "B = A sin(Omega t)\nT = m/2 (H^2 B'^2 + a^2 phi'^2 {} 2 a H B' phi' cos(phi - B)) + M/2 y'^2"


@pytest.mark.slow
def test_a_length_is_no_motion_that_goes_the_other_way(swing: lg.Derivation) -> None:
    assert not swing.check(ENERGY.format("-")).mistakes
    words = told(swing, ENERGY.format("+"))
    assert "of the velocity of top and the velocity relative to it" in words and "goes the other way" not in words, (
        words
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("force", "said"),
    [
        ("Q_phi = -c phi'", "The rate of damper 'hinge' is taken as phi'; it is -A*Omega*cos(Omega*t) + phi'."),
        ("Q_y = -2 d y'", "In what damper 'rope' adds to the equation of y, the factor 2 is missing."),
    ],
)
def test_the_rate_and_the_arm_of_a_damper_are_named(swing: lg.Derivation, force: str, said: str) -> None:
    assert said in told(swing, force)


def test_the_cause_stands_above_what_follows_from_it() -> None:
    s = lg.System("press")
    th = s.coordinate("th")
    m, r, J, M = s.parameters("m r J M")
    s.rigid_body(mass=M, inertia=J, at=s.origin, frame=s.frame(th, name="pinion"), name="pinion")
    s.particle(m, at=s.point("ram", (0, r * th)), name="ram")
    s.torque(s.input("P"), on=th, name="hand")
    answer = "m r th'' = N\n{0} th'' = P - N r\n({0} + m r^2) th'' = P"
    press = s.derive()
    assert press.check(answer.format("J"), hint=0).right
    verdict = press.check(answer.format("2 J"))
    assert [(f.line.number, f.follows) for f in verdict.findings] == [(2, False), (3, True)], verdict.to_text()


def test_the_angle_that_moves_as_prescribed_is_differentiated_too(swing: lg.Derivation) -> None:
    energy, law = (
        ENERGY.format("-"),
        "\nd/dt dT/dphi' = m a^2 phi'' - m a H B'' cos(phi - B) + m a H B' {} sin(phi - B)",
    )
    assert not swing.check(energy + law.format("(phi' - B')")).mistakes
    assert "What the given motion in B - phi adds to" in told(swing, energy + law.format("phi'"))


@pytest.fixture(scope="module")
def sling() -> lg.Derivation:
    """A rod and a slider on it, whose joint is carried around by a table that turns steadily."""
    s = lg.System("sling")
    th, r = s.coordinates("th r")
    m, M, J, h, R, k, W = s.parameters("m M J h R k W")
    table = s.frame(W * time, name="table")
    rod = s.frame(th, parent=table, name="rod")
    joint = s.point("joint", (R, 0), frame=table)
    s.rigid_body(mass=M, inertia=J, at=s.point("G", (h, 0), relative_to=joint, frame=rod), frame=rod, name="rod")
    s.particle(m, at=s.point("slider", (r, 0), relative_to=joint, frame=rod), name="slider")
    s.spring(k, deflection=r, name="band")
    return s.derive()


@pytest.mark.slow
def test_a_product_with_a_sum_is_told_as_one_term(sling: lg.Derivation) -> None:
    rows = """(J + M h^2 + m r^2) th'' + 2 m r r' (W + th') {} (M h + m r) R W^2 sin(th) = 0
m r'' - m r (W + th')^2 - m R W^2 cos(th) + k r = 0"""
    assert sling.check(rows.format("+"), hint=0).right
    words = told(sling, rows.format("-"))
    assert words.startswith("The term -R*W^2*(M*h + m*r)*sin(th) of the equation of th has the wrong sign"), words


def test_the_wrong_arm_of_a_force_in_newtons_laws_is_named_by_its_letters() -> None:
    s = lg.System("hoist")
    phi, y = s.coordinates("phi y")
    J, m, R, r, k, K = s.parameters("J m R r k K")
    s.rigid_body(mass=m, inertia=J, at=s.origin, frame=s.frame(phi, name="drum"), name="drum")
    s.particle(m, at=s.point("load", (0, y)), name="load")
    s.spring(K, deflection=R * phi, name="hawser")
    s.spring(k, deflection=y - r * phi, name="rope")
    rows = "J phi'' = -K R^2 phi + {} S\nS = k (y - r phi)\nm y'' = -k (y - r phi)"
    hoist = s.derive()
    assert hoist.check(rows.format("r"), hint=0).right
    assert told(hoist, rows.format("R")).endswith("R stands in place of r.")


@pytest.fixture(scope="module")
def belt() -> lg.Derivation:
    """A roller that rolls on a belt which speeds up, with a pendulum on its axle."""
    s = lg.System("belt")
    x, phi, th = s.coordinates("x phi th")
    M, J, R, m, ell, k, c, a0 = s.parameters("M J R m l k c a0")
    axle = s.point("axle", (x, R))
    s.rigid_body(mass=M, inertia=J, at=axle, frame=s.frame(-phi, name="roller"), name="roller")
    s.particle(m, at=s.point("bob", (ell * sp.sin(th), -ell * sp.cos(th)), relative_to=axle), name="bob")
    s.spring(k, deflection=x, name="spring")
    s.damper(c, deflection=phi + th, name="friction")
    s.velocity_constraint(x.diff(time) - R * phi.diff(time) - a0 * time, name="rolling")
    return s.derive()


REDUCED = """phi' = (x' - a0 t)/R
(M + m + {0}) x'' - a0 ({0}) + m l cos(th) th'' - m l sin(th) th'^2 + k x + (c/R) ((x' - a0 t)/R + th') = 0
m l cos(th) x'' + m l^2 th'' + c ((x' - a0 t)/R + th') = 0"""


@pytest.mark.slow
def test_a_radius_is_missed_where_a_turn_on_a_moving_belt_was_eliminated(belt: lg.Derivation) -> None:
    assert belt.check(REDUCED.format("J/R^2"), hint=0).right
    words = told(belt, REDUCED.format("J/R"))
    assert (
        "rotation of rigid body 'roller'" in words and "one divisor R is missing" in words and "damper" not in words
    ), words
    words = told(belt, REDUCED.format("J/R^2").replace("(c/R)", "c"))
    assert "In what damper 'friction' adds to the equation of x, the factor 1/R is missing." in words, words


FORCES = """x' - R phi' = a0 t
(M + m) x'' + m l th'' cos(th) - m l th'^2 sin(th) + k x{1} = lambda
J phi'' + c (phi' + th') = -R lambda
m l x'' cos(th) + m l^2 th''{2} + c (phi' + th') = 0
{0}"""
LOST = """x'' = R phi'', lambda = -J x''/R^2 - c (phi' + th')/R
(M + m + J/R^2) x'' + m l th'' cos(th) - m l th'^2 sin(th) + k x + (c/R) (phi' + th') = 0"""


@pytest.mark.slow
def test_what_is_lost_when_a_constraint_is_differentiated_is_the_cause_of_what_follows(belt: lg.Derivation) -> None:
    verdict = belt.check(FORCES.format(LOST, "", ""))
    assert [str(m.what) for m in verdict.mistakes] == [
        "Line 5 is not the derivative of velocity constraint 'rolling': on the right-hand side, the term a0 is missing."
    ], verdict.to_text()
    assert [f.line.number for f in verdict.findings if not f.status.right and not f.follows] == [5]


def test_a_spring_that_is_tied_to_another_body_is_named(belt: lg.Derivation) -> None:
    answer = FORCES.format("", " + k l sin(th)", " + k (x + l sin(th)) l cos(th)")
    assert "The deflection of spring 'spring' is taken as l*sin(th) + x; it is x." in told(belt, answer)


@pytest.fixture(scope="module")
def mast() -> lg.Derivation:
    """A block on a mast, which a rod holds up from a cart."""
    s = lg.System("mast")
    x, d, h = s.coordinates("x d h")
    m1, m2, m3, ell, g = s.parameters("m1 m2 m3 l g")
    s.particle(m1, at=s.point("trolley", (x, 0)), name="trolley")
    tail, block = s.point("tail", (x + d, 0)), s.point("block", (x, h))
    s.particle(m2, at=tail, name="tail")
    s.particle(m3, at=block, name="block")
    s.gravity(direction=(0, -1), g=g)
    s.constraint(d**2 + h**2 - ell**2, name="rod")
    return s.derive()


LAWS = """d^2 + h^2 = l^2
m1 x'' = -N
m3 x'' = N - S {0}/l
m3 h'' = S {1}/l - m3 g
m2 (x'' + d'') = S {0}/l"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize("dropped", ["", "m1 x'' = -N\nm3 x'' = N - S {0}/l\n"])
def test_factors_of_a_force_that_are_exchanged_are_one_mistake(mast: lg.Derivation, dropped: str) -> None:
    laws = LAWS.replace(dropped, "(m1 + m2 + m3) x'' + m2 d'' = 0\n") if dropped else LAWS
    assert mast.check(laws.format("d", "h"), hint=0).right
    verdict = mast.check(laws.format("h", "d"))
    assert not verdict.right and verdict.findings[0].status.right, verdict.to_text()
    (mistake,) = verdict.mistakes
    assert "The factors of the multiplier S are exchanged" in str(mistake.what), verdict.to_text()


def test_a_line_without_unknown_forces_is_judged_beside_them(mast: lg.Derivation) -> None:
    verdict = mast.check(
        "d^2 + h^2 = l^2\n(m1 + m2 + m3) x'' + m2 d'' = 0\nm3 h'' = S + N - P\nm2 (x'' + d'') = S P - N"
    )
    assert [f.status.right for f in verdict.findings] == [True, True, False, False], verdict.to_text()


@pytest.mark.slow
def test_the_velocity_term_that_is_missing_is_told_where_a_root_was_put_in(mast: lg.Derivation) -> None:
    rows = """h = sqrt(l^2 - d^2)
(m1 + m2 + m3) x'' + m2 d'' = 0
m2 x'' + (m2 + m3 d^2/(l^2 - d^2)) d'' - m3 g d/sqrt(l^2 - d^2){} = 0"""
    assert mast.check(rows.format(" + m3 l^2 d d'^2/(l^2 - d^2)^2"), hint=0).right
    words = told(mast, rows.format(""))
    assert "The term" in words and "of the equation of d is missing" in words and "d'^2" in words, words


def test_a_line_that_says_nothing_once_a_force_is_written_out_stands_for_no_equation(belt: lg.Derivation) -> None:
    rows = """x' - R phi' = a0 t
J phi'' + c (phi' + th') = -R F
m l x'' cos(th) + m l^2 th'' + c (phi' + th') = 0
F = -J phi''/R - c (phi' + th')/R
"""
    first = "(M + m) x'' + m l th'' cos(th) {} m l th'^2 sin(th) + k x = F"
    assert belt.check(rows + first.format("-"), hint=0).right
    assert not belt.check(rows, hint=0).right
    verdict = belt.check(rows + first.format("+"))
    assert not verdict.right and not verdict.motion, verdict.to_text()


def test_derivatives_of_the_right_energy_beside_a_wrong_one_are_right() -> None:
    rows = "T = {} m L^2 theta'^2\n∂T/∂theta' = m L^2 theta'\nd/dt ∂T/∂theta' = m L^2 theta''\n"
    rows += "m L^2 theta'' + b theta' + m g L sin(theta) = 0"
    pendulum = derivation("pendulum")
    verdict = pendulum.check(rows.format("1/2"))
    assert verdict.right, verdict.to_text()
    verdict = pendulum.check(rows.format(""))
    assert [f.line.number for f in verdict.findings if not f.status.right] == [1], verdict.to_text()
    verdict = pendulum.check(rows.format("").replace("∂theta' = m L^2 theta'\n", "∂theta' = 3 m L^2 theta'\n"))
    assert [f.line.number for f in verdict.findings if not f.status.right][:2] == [1, 2], verdict.to_text()


def test_an_arm_that_is_called_R_is_no_dissipation_beside_a_wrong_equation() -> None:
    s = lg.System("bob")
    theta = s.coordinates("theta")
    m, e, ell, g, c = s.parameters("m e l g c")
    s.kinetic(m * (e + ell * sp.cos(theta)) ** 2 * theta.diff() ** 2 / 2)
    s.potential(m * g * ell * sp.sin(theta))
    s.damper(c, deflection=theta)
    rows = "R = e + l*cos(theta)\nA = m*R^2\n{} - m*l*R*sin(theta)*theta'^2 + c*theta' + m*g*l*cos(theta) = 0"
    derived = s.derive()
    assert derived.check(rows.format("A*theta''")).right
    verdict = derived.check(rows.format("A*R*theta''"))
    assert all(f.line.kind != "D" for f in verdict.findings), verdict.to_text()
    assert not any("amper" in str(m.what) for m in verdict.mistakes), verdict.to_text()
    rows = "R = 1/2 c theta^2\n(m*(e + l*cos(theta))^2) theta'' - m*l*(e + l*cos(theta))*sin(theta)*theta'^2"
    wrong = derived.check(rows + " + c*theta + m*g*l*cos(theta) = 0")
    assert wrong.findings[0].line.kind == "D" and not wrong.findings[0].status.right, wrong.to_text()


def test_values_in_a_wrong_program_are_not_wrong() -> None:
    s = lg.System("rope over an edge")
    r, z = s.coordinates("r z")
    m1, m2, b, L, g = s.parameters("m1 m2 b L g")
    s.kinetic((m1 * r.diff() ** 2 + m2 * z.diff() ** 2) / 2)
    s.potential(-m2 * g * z)
    s.damper(b, deflection=r)
    s.constraint(r + z - L)
    program = """function dx = rope(t, x)
% x = [r; r_dot], z = L - r
m1 = 1.5; m2 = 2; b = 5; g = 9.81;
r = x(1);
rd = x(2);
rdd = ({}-m2*g) / (m1 + m2);
dx = [rd; rdd];
end"""
    derived = s.derive()
    assert derived.check(program.format("-b*rd ")).right
    verdict = derived.check(program.format(""))
    assert [f.line.number for f in verdict.findings if not f.status.right] == [6], verdict.to_text()
