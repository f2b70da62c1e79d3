"""Every built-in example once more, from its physics, with SymPy's mechanics: frames, points, forces on bodies.

Springs and dampers are forces between the bodies they join, written out by hand; nothing is read from the model files.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import sympy as sp
import sympy.physics.mechanics as me
from circuits_by_hand import BY_HAND, ByHand
from kane_route import Kane, Residual, t
from sympy import Symbol, cos, sin, symbols

g = Symbol("g")
SYSTEMS: dict[str, Callable[[], Kane | ByHand]] = {**BY_HAND}


def system(*names: str) -> Callable[[Callable[[], Kane]], Callable[[], Kane]]:
    def keep(make: Callable[[], Kane]) -> Callable[[], Kane]:
        SYSTEMS.update(dict.fromkeys(names, make))
        return make

    return keep


@cache
def oracle(name: str) -> Residual:
    return SYSTEMS[name]().residual()


@system("lecture-1")
def lever() -> Kane:
    s = Kane("theta")
    m, L_m, k, L_k, b, L_b, tau = symbols("m L_m k L_k b L_b tau")
    (theta,), (rate,) = s.q, s.v
    lever = s.turned(theta, s.N.z)
    s.particle(m, s.point(-L_m * lever.y))
    s.weights(g, s.N.y)
    # along its arc each pulls with k (L_k θ) or b (L_b θ̇), at its own arm, across the lever
    s.force(-k * L_k * theta * lever.x, s.point(-L_k * lever.y))
    s.force(-b * L_b * rate * lever.x, s.point(-L_b * lever.y))
    s.torque(tau * s.N.z, lever)
    return s


def arm(relative: bool) -> Kane:
    s = Kane("theta1 theta2")
    a, b, c, m1, m2, m3, tau = symbols("L_a L_b L_c m1 m2 m3 tau")
    one = s.turned(s.q[0], s.N.z)
    two = s.turned(s.q[1], one.z if relative else s.N.z, one if relative else s.N)
    end = s.point((a + b) * one.x)
    s.particle(m1, s.point(a * one.x))
    s.particle(m2, end)
    s.particle(m3, s.point(c * two.x, end))
    s.weights(g, s.N.y)
    s.torque(tau * s.N.z, two, one)
    return s


SYSTEMS["lecture-2"] = lambda: arm(True)
SYSTEMS["lecture-2-absolute"] = lambda: arm(False)


def carts(coordinates: str, relative: bool) -> Kane:
    s = Kane(coordinates)
    m1, m2, k, F = symbols("m1 m2 k F")
    one = s.point(s.q[0] * s.N.x)
    two = s.point(s.q[1] * s.N.x, one if relative else s.O)
    s.particle(m1, one)
    s.particle(m2, two)
    stretch = me.dot(two.pos_from(one), s.N.x)
    s.force((F - k * stretch) * s.N.x, two, one)
    return s


SYSTEMS["lecture-3a"] = lambda: carts("x1 x2", False)
SYSTEMS["lecture-3b"] = lambda: carts("x1 x2r", True)
SYSTEMS["two-carts"] = lambda: carts("x1 x2", True)


@system("pendulum")
def pendulum() -> Kane:
    s = Kane("theta")
    m, L, b = symbols("m L b")
    rod = s.turned(s.q[0], s.N.z)
    s.particle(m, s.point(-L * rod.y))
    s.weights(g, s.N.y)
    s.torque(-b * s.v[0] * s.N.z, rod)
    return s


@system("cart-pole")
def cart_pole() -> Kane:
    s = Kane("x theta")
    M, m, l, J, b, F = symbols("M m l J b F")
    cart = s.point(s.q[0] * s.N.x)
    rod = s.turned(-s.q[1], s.N.z)
    s.particle(M, cart)
    s.body(m, (0, 0, J), s.point(l * rod.y, cart), rod)
    s.weights(g, s.N.y)
    s.force((F - b * s.v[0]) * s.N.x, cart)
    return s


def chain(n: int, relative: bool) -> Kane:
    s = Kane(" ".join(f"theta{i}" for i in range(1, n + 1)))
    frame, end = s.N, s.O
    for i in range(n):
        frame = s.turned(s.q[i], s.N.z, frame if relative else s.N)
        end = s.point(-Symbol(f"L{i + 1}") * frame.y, end)
        s.particle(Symbol(f"m{i + 1}"), end)
    s.weights(g, s.N.y)
    return s


SYSTEMS["double-pendulum"] = lambda: chain(2, False)
SYSTEMS["double-pendulum-relative"] = lambda: chain(2, True)
SYSTEMS["triple-pendulum"] = lambda: chain(3, False)
SYSTEMS["triple-pendulum-relative"] = lambda: chain(3, True)


@system("elastic-pendulum")
def elastic_pendulum() -> Kane:
    s = Kane("r theta")
    m, k, L_0 = symbols("m k L_0")
    line = s.turned(s.q[1], s.N.z)
    bob = s.point(-s.q[0] * line.y)
    s.particle(m, bob)
    s.weights(g, s.N.y)
    s.force(k * (s.q[0] - L_0) * line.y, bob)
    return s


@system("spherical-pendulum")
def spherical_pendulum() -> Kane:
    s = Kane("theta phi")
    m, L = symbols("m L")
    heading = s.turned(s.q[1], s.N.z)
    rod = s.turned(-s.q[0], heading.y, heading)
    s.particle(m, s.point(-L * rod.z))
    s.weights(g, s.N.z)
    return s


@system("furuta-pendulum")
def furuta() -> Kane:
    s = Kane("theta1 theta2")
    m1, m2, L1, l1, l2 = symbols("m1 m2 L1 l1 l2")
    J1, A1, J2, A2, b1, b2, tau = symbols("J1 A1 J2 A2 b1 b2 tau")
    arm = s.turned(s.q[0], s.N.z)
    rod = s.turned(s.q[1], arm.x, arm)
    joint = s.point(L1 * arm.x)
    s.body(m1, (A1, J1, J1), s.point(l1 * arm.x), arm)
    s.body(m2, (J2, J2, A2), s.point(-l2 * rod.z, joint), rod)
    s.weights(g, s.N.z)
    s.torque((tau - b1 * s.v[0]) * s.N.z, arm)
    s.torque(-b2 * s.v[1] * arm.x, rod, arm)
    return s


@system("quarter-car")
def quarter_car() -> Kane:
    s = Kane("z_s z_u")
    m_s, m_u, k_s, b_s, k_t, z_r, F = symbols("m_s m_u k_s b_s k_t z_r F")
    body, wheel = s.point(s.q[0] * s.N.y), s.point(s.q[1] * s.N.y)
    s.particle(m_s, body)
    s.particle(m_u, wheel)
    between = F - k_s * (s.q[0] - s.q[1]) - b_s * (s.v[0] - s.v[1])
    s.force(between * s.N.y, body, wheel)
    s.force(k_t * (z_r - s.q[1]) * s.N.y, wheel)
    return s


@system("bead-on-hoop")
def bead_on_hoop() -> Kane:
    s = Kane("theta")
    m, R, Omega = symbols("m R Omega")
    hoop = s.turned(Omega * t, s.N.z)
    spoke = s.turned(-s.q[0], hoop.y, hoop)
    s.particle(m, s.point(-R * spoke.z))
    s.weights(g, s.N.z)
    return s


@system("atwood")
def atwood() -> Kane:
    s = Kane("x")
    m1, m2, m_p, J, R = symbols("m1 m2 m_p J R")
    s.particle(m1, s.point(-R * s.N.x - s.q[0] * s.N.y))
    s.particle(m2, s.point(R * s.N.x + s.q[0] * s.N.y))
    s.body(m_p, (0, 0, J), s.O, s.turned(s.q[0] / R, s.N.z))
    s.weights(g, s.N.y)
    return s


@system("swinging-atwood")
def swinging_atwood() -> Kane:
    s = Kane("r theta")
    M, m = symbols("M m")
    line = s.turned(s.q[1], s.N.z)
    s.particle(M, s.point(s.q[0] * s.N.y))
    s.particle(m, s.point(-s.q[0] * line.y))
    s.weights(g, s.N.y)
    return s


@system("wedge")
def wedge() -> Kane:
    s = Kane("x s")
    M, m, alpha, F = symbols("M m alpha F")
    slope = s.turned(-alpha, s.N.z)
    wedge = s.point(s.q[0] * s.N.x)
    s.particle(M, wedge)
    s.particle(m, s.point(s.q[1] * slope.x, wedge))
    s.weights(g, s.N.y)
    s.force(F * s.N.x, wedge)
    return s


@system("three-masses")
def three_masses() -> Kane:
    s = Kane("x1 x2 x3")
    k1, k2, k3, k4, b, F = symbols("k1 k2 k3 k4 b F")
    x1, x2, x3 = s.q
    at = [s.point(x * s.N.x) for x in s.q]
    for i, point in enumerate(at, 1):
        s.particle(Symbol(f"m{i}"), point)
    s.force(-k1 * x1 * s.N.x, at[0])
    s.force(k2 * (x1 - x2) * s.N.x, at[1], at[0])
    s.force((k3 * (x2 - x3) + b * (s.v[1] - s.v[2])) * s.N.x, at[2], at[1])
    s.force(-k4 * x3 * s.N.x, at[2])
    s.force(F * s.N.x, at[1])
    return s


@system("kapitza-pendulum")
def kapitza() -> Kane:
    s = Kane("theta")
    m, L, a, omega, b = symbols("m L a omega b")
    rod = s.turned(s.q[0], s.N.z)  # the other way round than the model file: symmetric, θ and its torque both turn
    pivot = s.point(a * cos(omega * t) * s.N.y)
    s.particle(m, s.point(L * rod.y, pivot))
    s.weights(g, s.N.y)
    s.torque(-b * s.v[0] * s.N.z, rod)
    return s


@system("planar-quadrotor")
def quadrotor() -> Kane:
    s = Kane("x y theta")
    m, J, L, b, F1, F2 = symbols("m J L b F1 F2")
    hull = s.turned(s.q[2], s.N.z)
    centre = s.point(s.q[0] * s.N.x + s.q[1] * s.N.y)
    s.body(m, (0, 0, J), centre, hull)
    s.weights(g, s.N.y)
    s.force(F1 * hull.y, s.point(L * hull.x, centre))
    s.force(F2 * hull.y, s.point(-L * hull.x, centre))
    s.force(-b * (s.v[0] * s.N.x + s.v[1] * s.N.y), centre)
    return s


@system("rolling-cylinder")
def rolling_cylinder() -> Kane:
    s = Kane("x")
    m, R, J, alpha = symbols("m R J alpha")
    slope = s.turned(-alpha, s.N.z)
    s.body(m, (0, 0, J), s.point(s.q[0] * slope.x), s.turned(-s.q[0] / R, s.N.z))
    s.weights(g, s.N.y)
    return s


@system("ball-and-beam")
def ball_and_beam() -> Kane:
    s = Kane("r theta")
    m, R, J, m_b, J_b, tau = symbols("m R J m_b J_b tau")
    beam = s.turned(s.q[1], s.N.z)
    ball = s.turned(s.q[1] - s.q[0] / R, s.N.z)
    s.body(m, (0, 0, J), s.point(s.q[0] * beam.x + R * beam.y), ball)
    s.body(m_b, (0, 0, J_b), s.O, beam)
    s.weights(g, s.N.y)
    s.torque(tau * s.N.z, beam)
    return s


@system("spinning-top")
def spinning_top() -> Kane:
    s = Kane("phi theta psi")
    m, l, A, C = symbols("m l A C")
    top = me.ReferenceFrame("top")
    top.orient_body_fixed(s.N, s.q, "ZXZ")
    s.body(m, (A, A, C), s.point(l * top.z), top)
    s.weights(g, s.N.z)
    return s


@system("scara")
def scara() -> Kane:
    s = Kane("theta1 theta2 d theta4")
    m1, m2, m3, L1, L2, l1, l2 = symbols("m1 m2 m3 L1 L2 l1 l2")
    J1, J2, J3, b, tau1, tau2, F, tau4 = symbols("J1 J2 J3 b tau1 tau2 F tau4")
    one = s.turned(s.q[0], s.N.z)
    two = s.turned(s.q[1], s.N.z, one)
    shaft = s.turned(s.q[3], s.N.z, two)
    joint = s.point(L1 * one.x)
    guide = s.point(L2 * two.x, joint)
    gripper = s.point(-s.q[2] * s.N.z, guide)
    s.body(m1, (J1, J1, J1), s.point(l1 * one.x), one)
    s.body(m2, (J2, J2, J2), s.point(l2 * two.x, joint), two)
    s.body(m3, (J3, J3, J3), gripper, shaft)
    s.weights(g, s.N.z)
    s.torque(tau1 * s.N.z, one)
    s.torque(tau2 * s.N.z, two, one)
    s.torque(tau4 * s.N.z, shaft, two)
    s.force(-(F - b * s.v[2]) * s.N.z, gripper, guide)
    return s


@system("robot-arm")
def robot_arm() -> Kane:
    s = Kane("q1 q2 q3")
    m1, m2, m3, L2, l2, l3 = symbols("m1 m2 m3 L2 l2 l3")
    J1, A2, B2, A3, B3, tau1, tau2, tau3 = symbols("J1 A2 B2 A3 B3 tau1 tau2 tau3")
    waist = s.turned(s.q[0], s.N.z)
    upper = s.turned(-s.q[1], waist.y, waist)
    fore = s.turned(-s.q[2], waist.y, upper)
    s.body(m1, (J1, J1, J1), s.O, waist)
    s.body(m2, (A2, B2, B2), s.point(l2 * upper.x), upper)
    s.body(m3, (A3, B3, B3), s.point(L2 * upper.x + l3 * fore.x), fore)
    s.weights(g, s.N.z)
    s.torque(tau1 * s.N.z, waist)
    s.torque(-tau2 * waist.y, upper, waist)
    s.torque(-tau3 * waist.y, fore, upper)
    return s


@system("two-disk-shaft")
def two_disk_shaft() -> Kane:
    s = Kane("phi1 phi2")
    J1, J2, m1, m2, k, b, b_load, tau = symbols("J1 J2 m1 m2 k b b_load tau")
    one, two = (s.turned(q, s.N.z) for q in s.q)
    s.body(m1, (0, 0, J1), s.O, one)
    s.body(m2, (0, 0, J2), s.O, two)
    s.torque(tau * s.N.z, one)
    s.torque((k * (s.q[0] - s.q[1]) + b * (s.v[0] - s.v[1])) * s.N.z, two, one)
    s.torque(-b_load * s.v[1] * s.N.z, two)
    return s


@system("bead-on-parabola")
def bead_on_parabola() -> Kane:
    s = Kane("x")
    m, c = symbols("m c")
    s.particle(m, s.point(s.q[0] * s.N.x + c * s.q[0] ** 2 * s.N.y))
    s.weights(g, s.N.y)
    return s


@system("spring-net")
def spring_net() -> Kane:
    s = Kane("x1 y1 x2 y2")
    m1, m2, D, k1, k2, k3, L_0, b, F = symbols("m1 m2 D k1 k2 k3 L_0 b F")
    one, two = (s.point(x * s.N.x + y * s.N.y) for x, y in (s.q[:2], s.q[2:]))
    hook = s.point(D * s.N.x)
    s.particle(m1, one)
    s.particle(m2, two)
    s.weights(g, s.N.y)

    def pull(start: me.Point, end: me.Point) -> tuple[sp.Expr, me.Vector]:
        arrow = end.pos_from(start)
        length = sp.sqrt(arrow.dot(arrow))
        return length, arrow / length

    length, along = pull(s.O, one)
    s.force(-k1 * (length - L_0) * along, one)
    length, along = pull(one, two)
    apart = (two.vel(s.N) - one.vel(s.N)).dot(along)
    s.force((F - k2 * (length - L_0) - b * apart) * along, two, one)
    length, along = pull(hook, two)
    s.force(-k3 * (length - L_0) * along, two)
    return s


@system("acrobot")
def acrobot() -> Kane:
    s = Kane("theta1 theta2")
    m1, m2, L1, l1, l2, J1, J2, b1, b2, tau = symbols("m1 m2 L1 l1 l2 J1 J2 b1 b2 tau")
    upper = s.turned(s.q[0], s.N.z)
    lower = s.turned(s.q[1], s.N.z, upper)
    s.body(m1, (0, 0, J1), s.point(-l1 * upper.y), upper)
    s.body(m2, (0, 0, J2), s.point(-L1 * upper.y - l2 * lower.y), lower)
    s.weights(g, s.N.y)
    s.torque(-b1 * s.v[0] * s.N.z, upper)
    s.torque((tau - b2 * s.v[1]) * s.N.z, lower, upper)
    return s


@system("segway")
def segway() -> Kane:
    s = Kane("x theta")
    m_w, J_w, R, m_r, J_r, l, tau = symbols("m_w J_w R m_r J_r l tau")
    wheel = s.turned(-s.q[0] / R, s.N.z)
    rider = s.turned(-s.q[1], s.N.z)
    axle = s.point(s.q[0] * s.N.x)
    s.body(m_w, (0, 0, J_w), axle, wheel)
    s.body(m_r, (0, 0, J_r), s.point(l * sin(s.q[1]) * s.N.x + l * cos(s.q[1]) * s.N.y, axle), rider)
    s.weights(g, s.N.y)
    s.torque(-tau * s.N.z, wheel, rider)
    return s


@system("crane")
def crane() -> Kane:
    s = Kane("x l theta")
    M, m, b, F, F_h = symbols("M m b F F_h")
    rope = s.turned(s.q[2], s.N.z)
    trolley = s.point(s.q[0] * s.N.x)
    load = s.point(-s.q[1] * rope.y, trolley)
    s.particle(M, trolley)
    s.particle(m, load)
    s.weights(g, s.N.y)
    s.force((F - b * s.v[0]) * s.N.x, trolley)
    s.force(F_h * rope.y, load, trolley)
    return s


@system("duffing")
def duffing() -> Kane:
    s = Kane("x")
    m, b, k, k3, F_0, omega = symbols("m b k k3 F_0 omega")
    (x,), (v,) = s.q, s.v
    mass = s.point(x * s.N.x)
    s.particle(m, mass)
    s.force((F_0 * cos(omega * t) - k * x - k3 * x**3 - b * v) * s.N.x, mass)
    return s
