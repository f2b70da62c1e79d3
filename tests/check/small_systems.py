"""Small systems, each for several tests."""

from __future__ import annotations

from functools import cache

import sympy as sp

import lagrangian as lg


@cache
def mass(**values: str) -> lg.Derivation:
    """A mass on a spring and a damper that an input pushes."""
    s = lg.System("mass on a spring")
    x = s.coordinate("x")
    m, k, b = s.parameters("m k b", **values)
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
def rack(**values: float) -> lg.Derivation:
    """A rack on a spring that is relaxed at x = d, which a motor moves by a pinion."""
    s = lg.System("rack and pinion")
    x = s.coordinate("x")
    m, J, R, k, d = s.parameters("m J R k d", **values)
    s.particle(m, at=s.point("C", (x, 0)), name="rack")
    s.kinetic(J * (x.diff() / R) ** 2 / 2, name="pinion")
    s.spring(k, deflection=x, rest=d, name="spring")
    s.force(s.input("M"), deflection=x / R, name="motor")
    return s.derive()


@cache
def winch() -> lg.Derivation:
    """A drum with a gear to a weight: a motor's torque and a brake act on its shaft, which turns n times as fast."""
    s = lg.System("winch with a gear")
    phi = s.coordinate("phi")
    m, J, I, r, a, n, c, g = s.parameters("m J I r a n c g")
    s.particle(m, at=s.point("W", (0, -r * phi)), name="weight")
    s.kinetic(J * phi.diff() ** 2 / 2, name="drum")
    s.kinetic(I * (n * phi.diff()) ** 2 / 2, name="shaft")
    s.gravity(direction=(0, -1), g=g)
    s.damper(c, deflection=phi, name="bearing")
    s.generalized_force(phi, -n * s.input("B"), name="brake")
    s.force(s.input("F"), deflection=a / r * phi, name="foot")
    return s.derive()


@cache
def cart() -> lg.Derivation:
    """A cart on a spring with a pendulum."""
    s = lg.System("cart with a pendulum")
    x, phi = s.coordinates("x phi")
    M, m, l, k, g = s.parameters("M m l k g")
    s.particle(M, at=s.point("C", (x, 0)), name="cart")
    s.particle(m, at=s.point("B", (x + l * sp.sin(phi), -l * sp.cos(phi))), name="bob")
    s.spring(k, deflection=x, name="spring")
    s.gravity((0, -1), g)
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
def wheels() -> lg.Derivation:
    """A drum on a torsion spring that a roller with a motor drives at its rim."""
    s = lg.System("drum and roller")
    phi = s.coordinate("phi")
    A, B, R, r, k, c = s.parameters("A B R r k c")
    s.kinetic(A * phi.diff() ** 2 / 2, name="drum")
    s.kinetic(B * (R / r * phi.diff()) ** 2 / 2, name="roller")
    s.spring(k, deflection=phi, name="torsion spring")
    s.damper(c, deflection=R / r * phi, name="bearing")
    s.force(s.input("M"), deflection=R / r * phi, name="motor")
    return s.derive()


@cache
def ramp() -> lg.Derivation:
    """A mass on a ramp of a turntable, at the distance r that the system defines by s."""
    s = lg.System("ramp on a turntable")
    theta, u = s.coordinates("theta s")
    J, m, a, beta, k = s.parameters("J m a beta k")
    r = s.define("r", a + u * sp.cos(beta))
    s.kinetic(J * theta.diff() ** 2 / 2)
    s.particle(m, at=s.point("P", (r * sp.cos(theta), r * sp.sin(theta), u * sp.sin(beta))), name="mass")
    s.spring(k, deflection=u)
    return s.derive()


@cache
def seesaw() -> lg.Derivation:
    """A seesaw with a weight below its pivot and a counterweight above."""
    s = lg.System("seesaw with a counterweight")
    phi = s.coordinate("phi")
    M, m, l, d, k, g = s.parameters("M m l d k g")
    s.particle(m, at=s.point("S", (l * sp.sin(phi), -l * sp.cos(phi))), name="seat")
    s.particle(M, at=s.point("C", (-d * sp.sin(phi), d * sp.cos(phi))), name="counterweight")
    s.gravity((0, -1), g)
    s.spring(k, deflection=phi, name="torsion bar")
    return s.derive()


@cache
def pushed_cart() -> lg.Derivation:
    """A pendulum on a cart on a spring, which a force pushes at the cart and another at the bob."""
    s = lg.System("pendulum on a cart")
    x, theta = s.coordinates("x theta")
    M, m, l, k, b, g = s.parameters("M m l k b g")
    bob = s.point("S", (x + l * sp.sin(theta), -l * sp.cos(theta)))
    s.particle(M, at=s.point("C", (x, 0)), name="cart")
    s.particle(m, at=bob, name="bob")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=x, name="spring")
    s.damper(b, deflection=x, name="damper")
    s.force((s.input("F"), 0), at=bob, name="wind")
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


@cache
def loop() -> lg.Derivation:
    """A winch, a block in the loop of its rope, and a load on a spring and a damper below."""
    s = lg.System("loop")
    phi, w = s.coordinates("phi w")
    J, r, m, I, a, M, g, k, c = s.parameters("J r m I a M g k c")
    s.rigid_body(mass=1, inertia=J, at=s.origin, frame=s.frame(phi, name="winch"), name="winch")
    turned = s.frame(r * phi / (2 * a), name="block")
    s.rigid_body(mass=m, inertia=I, at=s.point("B", (0, r * phi / 2)), frame=turned, name="block")
    s.particle(M, at=s.point("W", (1, w)), name="load")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=r * phi / 2 - w, name="hook")
    s.damper(c, deflection=r * phi / 2 - w, name="guide")
    s.torque(s.input("u"), on=phi, name="motor")
    return s.derive()


@cache
def two_carts(*, between: bool) -> lg.Derivation:
    """Two carts on springs in a row, a push on the second, and a damper between them or of the first alone."""
    s = lg.System("two carts")
    x, y = s.coordinates("x y")
    m, n, k, c, b = s.parameters("m n k c b")
    for mass, q, name in ((m, x, "first"), (n, y, "second")):
        s.particle(mass, at=s.point(name, (q, 0)), name=name)
    s.spring(k, deflection=x, name="outer")
    s.spring(c, deflection=y - x, name="inner")
    s.damper(b, deflection=y - x if between else x, name="between" if between else "ground damper")
    s.force(s.input("F"), deflection=y, name="push")
    return s.derive()
