"""Systems with constraints for the tests of several rooms."""

from functools import cache

import sympy as sp

import lagrangian as lg

G = 9.81


def rod(length=1.5):
    """A pendulum in x and y on a rod."""
    s = lg.System("rod")
    g, m, l = s.parameter("g", G), s.parameter("m", 2.0), s.parameter("l", length)
    x, y = s.coordinate("x"), s.coordinate("y")
    at = s.origin + (x, y)
    s.particle(m, at=at, name="bob")
    s.gravity((0, -1), g)
    s.constraint(between=(at, s.origin), distance=l, name="rod")
    return s


def pendulum_in_plane(*, weight=False):
    """A particle in x and y that a rod keeps at a distance l from the origin."""
    s = lg.System("pendulum in x, y")
    x, y = s.coordinates("x y")
    m, length = s.parameters("m l", m=1.0, l=2.0)
    bob = s.point("P", (x, y))
    s.particle(m, at=bob)
    if weight:
        s.gravity()
    s.constraint(between=(bob, s.origin), distance=length, name="rod")
    return s


def four_bar(*, weight=False):
    """Three links by absolute angles; the last end is pinned to the ground."""
    s = lg.System("four-bar")
    a, b, c = s.coordinates("a b c")
    l1, l2, l3, d, m = s.parameters("l1 l2 l3 d m", l1=0.5, l2=1.2, l3=0.9, d=1.0, m=2.0)
    tip = s.origin
    for angle, length in ((a, l1), (b, l2), (c, l3)):
        frame = s.frame(angle, origin=tip)
        s.rigid_body(m, m * length**2 / 12, at=frame.point(length / 2, 0), frame=frame)
        tip = frame.point(length, 0)
    if weight:
        s.gravity()
    s.pin((tip, s.origin + (d, 0)), name="loop")
    return s


def cart_pole(*, redundant):
    """A pole on a cart; with redundant coordinates the bob has coordinates of its own, and a pin at the pole."""
    s = lg.System("cart-pole")
    numbers = {"M": 1.2, "m": 0.3, "l": 0.7, "g": G, "b": 0.2, "J": 0.02}
    M, m, l, g, b, J = (s.parameter(name, value) for name, value in numbers.items())
    F = s.input("F")
    x, theta = s.coordinate("x"), s.coordinate("theta")
    cart = s.origin + (x, 0)
    tip = at = s.origin + (x + l * sp.sin(theta), l * sp.cos(theta))
    if redundant:
        X, Y = s.coordinate("X"), s.coordinate("Y")
        at = s.origin + (X, Y)
        s.constraint(between=(at, tip), name="pin")
    s.particle(M, at=cart, name="cart")
    s.rigid_body(m, J, at=at, frame=s.frame(theta), name="bob")
    s.gravity((0, -1), g)
    s.force((F, 0), at=cart)
    s.damper(b, deflection=x)
    return s


def slider_crank():
    """A crank with a weight, a rod without mass of its own worth mentioning, and a piston that a force pushes."""
    s = lg.System("slider-crank")
    numbers = {"r": 0.05, "l": 0.15, "m": 2.0, "g": G}
    r, l, m, g = (s.parameter(name, value) for name, value in numbers.items())
    F = s.input("F")
    phi, psi, x = (s.coordinate(name) for name in ("phi", "psi", "x"))
    pin = s.origin + (r * sp.cos(phi), r * sp.sin(phi))
    end = pin + (l * sp.cos(psi), l * sp.sin(psi))
    piston = s.origin + (x, 0)
    s.rigid_body(m, 0.001, at=pin, frame=s.frame(phi), name="crank")
    s.rigid_body(1e-6, 1e-6, at=pin, frame=s.frame(psi), name="connecting rod")
    s.particle(0.4, at=piston, name="piston")
    s.gravity((0, -1), g)
    s.force((-F, 0), at=piston)
    s.constraint(between=(end, piston), name="loop")
    return s


def disc():
    """A thin disc that rolls without slip (Neimark and Fufaev, Dynamics of Nonholonomic Systems, 1972)."""
    s = lg.System("disc")
    numbers = {"m": 1.0, "r": 0.3, "I": 0.0225, "K": 0.045, "g": G}
    m, r, I, K, g = (s.parameter(name, value) for name, value in numbers.items())
    x, y, psi, theta, phi = (s.coordinate(name) for name in ("x", "y", "psi", "theta", "phi"))
    heading = s.frame(psi, axis=(0, 0, 1))
    leaning = s.frame(theta, axis=(1, 0, 0), parent=heading)
    turning = s.frame(phi, axis=(0, 1, 0), parent=leaning)
    contact = s.origin + (x, y, 0)
    body = s.rigid_body(m, (I, K, I), at=leaning.point(0, 0, r, at=contact), frame=turning, name="disc")
    s.gravity((0, 0, -1), g)
    s.rolling(body, at=contact, along=[(1, 0, 0), (0, 1, 0)], name="floor")
    return s, numbers


def sleigh():
    """A knife edge on a table that slopes along x."""
    s = lg.System("sleigh")
    m, J, w = s.parameter("m", 1.5), s.parameter("J", 0.2), s.parameter("w", 3.0)
    x, y, theta = (s.coordinate(name) for name in ("x", "y", "theta"))
    at = s.origin + (x, y)
    s.rigid_body(m, J, at=at, frame=s.frame(theta), name="sleigh")
    s.force((w, 0), at=at)
    s.velocity_constraint(y.diff() * sp.cos(theta) - x.diff() * sp.sin(theta), name="edge")
    return s


PEAUCELLIER = {"alpha": 0.3, "beta1": 0.6, "beta2": -0.4, "x": 1.2, "y": 0.1}
"""A rough guess for `peaucellier`; its point then moves along x = (1² − ½²)/(2 · 0.3) = 1.25."""


def peaucellier():
    """Peaucellier's linkage of four particles, two long arms, a crank, and four short rods: P moves on a line."""
    s = lg.System("Peaucellier's linkage")
    alpha, first, second, x, y = s.coordinates("alpha beta1 beta2 x y")
    long, short, d, m = s.parameters("L l d m", L=1.0, l=0.5, d=0.3, m=1.0)
    points = {
        "B": s.point("B", (d + d * sp.cos(alpha), d * sp.sin(alpha))),
        "A1": s.point("A1", (long * sp.cos(first), long * sp.sin(first))),
        "A2": s.point("A2", (long * sp.cos(second), long * sp.sin(second))),
        "P": s.point("P", (x, y)),
    }
    for name, at in points.items():
        s.particle(m, at=at, name=name)
    for k, (a, b) in enumerate((("A1", "B"), ("A2", "B"), ("A1", "P"), ("A2", "P"))):
        s.constraint(between=(points[a], points[b]), distance=short, name=f"rod {k}")
    s.gravity()
    return s


@cache
def smooth_puck():
    """A puck on a cylinder with the contact as a constraint, derived: m r̈ − m r θ̇² + m g cos θ = λ, r = R."""
    s = lg.System("puck")
    r, theta = s.coordinate("r", positive=True), s.coordinate("theta")
    m, R, g = s.parameters("m R g", m=0.4, R=1.2, g=9.81)
    (t,) = r.args
    s.kinetic(m * (r.diff(t) ** 2 + r**2 * theta.diff(t) ** 2) / 2)
    s.potential(m * g * r * sp.cos(theta))
    s.constraint(r - R, name="contact")
    return s.derive()
