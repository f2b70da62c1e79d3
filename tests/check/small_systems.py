"""Small systems, each for several tests."""

from __future__ import annotations

from functools import cache

import sympy as sp

import lagrangian as lg


@cache
def mass() -> lg.Derivation:
    """A mass on a spring and a damper that an input pushes."""
    s = lg.System("mass on a spring")
    x = s.coordinate("x")
    m, k, b = s.parameters("m k b")
    s.particle(m, at=s.point("C", (x, 0)), name="mass")
    s.spring(k, deflection=x)
    s.damper(b, deflection=x)
    s.force(s.input("F"), deflection=x)
    return s.derive()


@cache
def rod() -> lg.Derivation:
    """A puck on a spring along a rod that a motor turns."""
    s = lg.System("puck on a rod")
    r, phi = s.coordinates("r phi")
    m, J, k, a = s.parameters("m J k a")
    s.rigid_body(mass=1, inertia=J, at=s.origin, frame=s.frame(phi, name="rod"), name="rod")
    s.particle(m, at=s.point("P", (r * sp.cos(phi), r * sp.sin(phi))), name="puck")
    s.spring(k, deflection=r, rest=a, name="spring")
    s.torque(s.input("M"), on=phi, name="motor")
    return s.derive()


@cache
def geared() -> lg.Derivation:
    """A pendulum that turns n times as fast as its crank, with a spring and a damper on the crank."""
    s = lg.System("pendulum on a gear")
    phi = s.coordinate("phi")
    m, l, g = s.parameter("m", 2), s.parameter("l", 0.5), s.parameter("g", 9.81)
    n, b, k = s.parameter("n", 3), s.parameter("b", 0.1), s.parameter("k", 4)
    s.particle(m, at=s.frame(n * phi - sp.pi / 2, name="arm").point(l, 0), name="bob")
    s.gravity((0, -1), g)
    s.spring(k, deflection=phi)
    s.damper(b, deflection=phi)
    s.torque(s.input("M"), on=phi, name="motor")
    return s.derive()


@cache
def pendulum() -> lg.Derivation:
    """A pendulum with a damper that a motor turns."""
    s = lg.System("pendulum")
    phi = s.coordinate("phi")
    m, l, g, b = s.parameters("m l g b")
    s.particle(m, at=s.point("P", (l * sp.sin(phi), -l * sp.cos(phi))), name="bob")
    s.gravity((0, -1), g)
    s.damper(b, deflection=phi)
    s.torque(s.input("M"), on=phi, name="motor")
    return s.derive()
