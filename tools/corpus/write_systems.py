"""The corpus's systems from their physics, in SymPy alone: what moves, what pulls, what pushes. Nothing of the package.

Positions, deflections and rates were written out by hand; `write_corpus` proves every right answer against Kane's
equations (``tests/examples/kane_systems.py``) before it is stored.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import sympy as sp
import sympy.physics.mechanics as me
from sympy import Symbol, cos, sin, symbols

t = me.dynamicsymbols._t
g = Symbol("g")


@dataclass(frozen=True)
class Body:
    """A mass at ``at``, measured from ``parent``; ``turns`` holds (J, ω, ω of the parent)."""

    m: sp.Expr
    at: tuple[sp.Expr, ...]
    parent: tuple[sp.Expr, ...] | None = None
    turns: tuple[tuple[sp.Expr, sp.Expr, sp.Expr], ...] = ()
    pivot: sp.Expr | None = None
    height: sp.Expr | None = None
    cross: sp.Expr | None = None  # the product of rates in v², where a sum was squared

    def speed2(self) -> sp.Expr:
        return sum((x.diff(t) ** 2 for x in self.at), sp.S.Zero)


@dataclass(frozen=True)
class Spring:
    """``delta`` is the extension; ``ground`` what it would be from the ground; ``other`` another pair's."""

    k: sp.Expr
    delta: sp.Expr
    ground: sp.Expr | None = None
    other: sp.Expr | None = None
    unstretched: sp.Expr | None = None


@dataclass(frozen=True)
class Pair:
    """A damper or an input: ``f`` times the rate ``on`` minus ``reaction`` is its power."""

    f: sp.Expr
    on: sp.Expr
    reaction: sp.Expr = sp.S.Zero
    parent: int | None = None

    @property
    def rate(self) -> sp.Expr:
        return self.on - self.reaction


@dataclass(frozen=True)
class System:
    """Everything that Lagrange's equations are made of."""

    name: str
    q: tuple[Any, ...]
    bodies: tuple[Body, ...]
    springs: tuple[Spring, ...] = ()
    dampers: tuple[Pair, ...] = ()
    inputs: tuple[Pair, ...] = ()
    other: tuple[str, dict[Any, sp.Expr]] | None = None
    extra: dict[str, Any] = field(default_factory=dict)

    @property
    def v(self) -> list[sp.Expr]:
        return [x.diff(t) for x in self.q]

    @property
    def a(self) -> list[sp.Expr]:
        return [x.diff(t, 2) for x in self.q]

    def T(self) -> sp.Expr:
        return sum((kinetic(b) for b in self.bodies), sp.S.Zero)

    def weight(self) -> sp.Expr:
        return sum((b.m * g * b.height for b in self.bodies if b.height is not None), sp.S.Zero)

    def V(self) -> sp.Expr:
        return self.weight() + sum((s.k * s.delta**2 / 2 for s in self.springs), sp.S.Zero)

    def damping(self) -> list[sp.Expr]:
        return [sum((-d.f * d.rate * d.rate.diff(v) for d in self.dampers), sp.S.Zero) for v in self.v]

    def driving(self) -> list[sp.Expr]:
        return [sum((p.f * p.rate.diff(v) for p in self.inputs), sp.S.Zero) for v in self.v]

    def Xi(self) -> list[sp.Expr]:
        return [a + b for a, b in zip(self.damping(), self.driving(), strict=True)]

    def left(self, T: sp.Expr | None = None, V: sp.Expr | None = None) -> list[sp.Expr]:
        """Lagrange's left-hand sides, by SymPy's own method."""
        L = (self.T() if T is None else T) - (self.V() if V is None else V)
        method = me.LagrangesMethod(L, list(self.q))
        return list(method.form_lagranges_equations())

    def rows(
        self, T: sp.Expr | None = None, V: sp.Expr | None = None, Xi: list[sp.Expr] | None = None
    ) -> list[sp.Expr]:
        """Left minus right, for every coordinate."""
        left = self.left(T, V)
        return [a - b for a, b in zip(left, self.Xi() if Xi is None else Xi, strict=True)]


def kinetic(b: Body) -> sp.Expr:
    return b.m * b.speed2() / 2 + sum((J * w**2 / 2 for J, w, _ in b.turns), sp.S.Zero)


def q(names: str) -> tuple[Any, ...]:
    return tuple(me.dynamicsymbols(names + " _")[:-1])


def u(names: str) -> Any:
    made = me.dynamicsymbols(names + " _")[:-1]
    return made[0] if len(made) == 1 else made


SYSTEMS: dict[str, Callable[[], System]] = {}


def system(make: Callable[[], System]) -> Callable[[], System]:
    SYSTEMS[make.__name__.replace("_", "-")] = make
    return make


def fallen(b: Body, up: int = 1) -> Body:
    """The body with its height, the component ``up`` of its place."""
    return replace(b, height=b.at[up])


@system
def lecture_1() -> System:
    (th,) = c = q("theta")
    m, Lm, k, Lk, b, Lb = symbols("m L_m k L_k b L_b")
    bob = fallen(Body(m, (Lm * sin(th), -Lm * cos(th))))
    damper = Pair(b, Lb * th.diff(t))
    return System("lecture-1", c, (bob,), (Spring(k, Lk * th),), (damper,), (Pair(u("tau"), th.diff(t)),))


def arm(name: str, relative: bool) -> System:
    c = q("theta1 theta2")
    one, two = c
    angle = one + two if relative else two
    a, b, l, m1, m2, m3 = symbols("L_a L_b L_c m1 m2 m3")
    p1, p2 = ((r * cos(one), r * sin(one)) for r in (a, a + b))
    p3 = (p2[0] + l * cos(angle), p2[1] + l * sin(angle))
    bodies = tuple(fallen(x) for x in (Body(m1, p1), Body(m2, p2, p1), Body(m3, p3, p2)))
    torque = Pair(u("tau"), angle.diff(t), one.diff(t), parent=0)
    phi = me.dynamicsymbols("phi")
    return System(name, c, bodies, (), (), (torque,), ("phi", {two: phi - one if relative else phi + one}))


SYSTEMS["lecture-2"] = lambda: arm("lecture-2", True)
SYSTEMS["lecture-2-absolute"] = lambda: arm("lecture-2-absolute", False)


def carts(name: str, coordinates: str, relative: bool) -> System:
    c = q(coordinates)
    one = c[0]
    two = one + c[1] if relative else c[1]
    m1, m2, k = symbols("m1 m2 k")
    cross = one.diff(t) * c[1].diff(t) if relative else None
    bodies = (Body(m1, (one,)), Body(m2, (two,), (one,), cross=cross))
    spring = Spring(k, two - one, ground=two, other=two - 2 * one if relative else two + one)
    push = Pair(u("F"), two.diff(t), one.diff(t), parent=0)
    new = me.dynamicsymbols("y")
    return System(name, c, bodies, (spring,), (), (push,), ("y", {c[1]: new - one if relative else new + one}))


SYSTEMS["lecture-3a"] = lambda: carts("lecture-3a", "x1 x2", False)
SYSTEMS["lecture-3b"] = lambda: carts("lecture-3b", "x1 x2r", True)
SYSTEMS["two-carts"] = lambda: carts("two-carts", "x1 x2", True)


@system
def pendulum() -> System:
    (th,) = c = q("theta")
    m, L, b = symbols("m L b")
    bob = fallen(Body(m, (L * sin(th), -L * cos(th))))
    return System("pendulum", c, (bob,), (), (Pair(b, th.diff(t)),), (), ("psi", {th: -me.dynamicsymbols("psi")}))


@system
def cart_pole() -> System:
    x, th = c = q("x theta")
    M, m, l, J, b = symbols("M m l J b")
    cart = Body(M, (x, sp.S.Zero))
    pole = Body(
        m, (x + l * sin(th), l * cos(th)), (x, sp.S.Zero), ((J, th.diff(t), 0),),
        pivot=l, height=l * cos(th), cross=l * cos(th) * x.diff(t) * th.diff(t),
    )  # fmt: skip
    return System("cart-pole", c, (cart, pole), (), (Pair(b, x.diff(t)),), (Pair(u("F"), x.diff(t)),))


def chain(name: str, n: int, relative: bool) -> System:
    c = q(" ".join(f"theta{i + 1}" for i in range(n)))
    bodies: list[Body] = []
    at: tuple[sp.Expr, ...] = (sp.S.Zero, sp.S.Zero)
    for i in range(n):
        angle = sp.Add(*c[: i + 1]) if relative else c[i]
        m, L = symbols(f"m{i + 1} L{i + 1}")
        before, at = at, (at[0] + L * sin(angle), at[1] - L * cos(angle))
        bodies.append(fallen(Body(m, at, before if i else None)))
    other = None
    if n == 2:
        phi = me.dynamicsymbols("phi")
        other = ("phi", {c[1]: phi - c[0] if relative else phi + c[0]})
    return System(name, c, tuple(bodies), other=other)


SYSTEMS["double-pendulum"] = lambda: chain("double-pendulum", 2, False)
SYSTEMS["double-pendulum-relative"] = lambda: chain("double-pendulum-relative", 2, True)
SYSTEMS["triple-pendulum"] = lambda: chain("triple-pendulum", 3, False)


@system
def elastic_pendulum() -> System:
    r, th = c = q("r theta")
    m, k, L0 = symbols("m k L_0")
    bob = fallen(Body(m, (r * sin(th), -r * cos(th))))
    spring = Spring(k, r - L0, unstretched=r)
    s = me.dynamicsymbols("s")
    return System("elastic-pendulum", c, (bob,), (spring,), other=("s", {r: s + L0}))


@system
def quarter_car() -> System:
    s, w = c = q("z_s z_u")
    ms, mu, ks, bs, kt = symbols("m_s m_u k_s b_s k_t")
    road, F = u("z_r F")
    springs = (Spring(ks, s - w, ground=s), Spring(kt, w - road, ground=w))
    damper = Pair(bs, s.diff(t), w.diff(t))
    push = Pair(F, s.diff(t), w.diff(t))
    return System("quarter-car", c, (Body(ms, (s,)), Body(mu, (w,))), springs, (damper,), (push,))


@system
def three_masses() -> System:
    c = x1, x2, x3 = q("x1 x2 x3")
    k1, k2, k3, k4, b = symbols("k1 k2 k3 k4 b")
    springs = (
        Spring(k1, x1),
        Spring(k2, x2 - x1, ground=x2, other=x3 - x1),
        Spring(k3, x3 - x2, ground=x3),
        Spring(k4, x3),
    )
    bodies = tuple(Body(Symbol(f"m{i + 1}"), (x,)) for i, x in enumerate(c))
    damper = Pair(b, x3.diff(t), x2.diff(t))
    return System("three-masses", c, bodies, springs, (damper,), (Pair(u("F"), x2.diff(t)),))


@system
def acrobot() -> System:
    one, two = c = q("theta1 theta2")
    m1, m2, L1, l1, l2, J1, J2, b1, b2 = symbols("m1 m2 L1 l1 l2 J1 J2 b1 b2")
    both = one + two
    joint = (L1 * sin(one), -L1 * cos(one))
    upper = Body(m1, (l1 * sin(one), -l1 * cos(one)), None, ((J1, one.diff(t), sp.S.Zero),), pivot=l1)
    lower = Body(m2, (joint[0] + l2 * sin(both), joint[1] - l2 * cos(both)), joint, ((J2, both.diff(t), one.diff(t)),))
    dampers = (Pair(b1, one.diff(t)), Pair(b2, both.diff(t), one.diff(t)))
    motor = Pair(u("tau"), both.diff(t), one.diff(t), parent=0)
    return System("acrobot", c, (fallen(upper), fallen(lower)), (), dampers, (motor,))


@system
def two_disk_shaft() -> System:
    one, two = c = q("phi1 phi2")
    J1, J2, k, b, bl = symbols("J1 J2 k b b_load")
    bodies = tuple(Body(sp.S.Zero, (sp.S.Zero,), None, ((J, x.diff(t), sp.S.Zero),)) for J, x in ((J1, one), (J2, two)))
    dampers = (Pair(b, two.diff(t), one.diff(t)), Pair(bl, two.diff(t)))
    spring = Spring(k, two - one, ground=two)
    return System("two-disk-shaft", c, bodies, (spring,), dampers, (Pair(u("tau"), one.diff(t)),))


@system
def wedge() -> System:
    x, s = c = q("x s")
    M, m, alpha = symbols("M m alpha")
    block = Body(
        m, (x + s * cos(alpha), -s * sin(alpha)), (x, sp.S.Zero),
        height=-s * sin(alpha), cross=cos(alpha) * x.diff(t) * s.diff(t),
    )  # fmt: skip
    return System("wedge", c, (Body(M, (x, sp.S.Zero)), block), (), (), (Pair(u("F"), x.diff(t)),))


@system
def crane() -> System:
    x, l, th = c = q("x l theta")
    M, m, b = symbols("M m b")
    F, hoist = u("F F_h")
    load = Body(m, (x + l * sin(th), -l * cos(th)), (x, sp.S.Zero), height=-l * cos(th))
    inputs = (Pair(F, x.diff(t)), Pair(hoist, -l.diff(t)))
    return System("crane", c, (Body(M, (x, sp.S.Zero)), load), (), (Pair(b, x.diff(t)),), inputs)


@system
def bead_on_hoop() -> System:
    (th,) = c = q("theta")
    m, R, Om = symbols("m R Omega")
    at = (R * sin(th) * cos(Om * t), R * sin(th) * sin(Om * t), -R * cos(th))
    return System("bead-on-hoop", c, (fallen(Body(m, at), 2),))


@system
def rolling_cylinder() -> System:
    (x,) = c = q("x")
    m, R, J, alpha = symbols("m R J alpha")
    roller = Body(m, (x * cos(alpha), -x * sin(alpha)), None, ((J, -x.diff(t) / R, sp.S.Zero),))
    return System("rolling-cylinder", c, (fallen(roller),))


@system
def ball_and_beam() -> System:
    r, th = c = q("r theta")
    m, R, J, mb, Jb = symbols("m R J m_b J_b")
    at = (r * cos(th) - R * sin(th), r * sin(th) + R * cos(th))
    ball = fallen(Body(m, at, None, ((J, th.diff(t) - r.diff(t) / R, th.diff(t)),)))
    beam = Body(mb, (sp.S.Zero, sp.S.Zero), None, ((Jb, th.diff(t), sp.S.Zero),))
    return System("ball-and-beam", c, (ball, beam), (), (), (Pair(u("tau"), th.diff(t)),))


@system
def atwood() -> System:
    (x,) = c = q("x")
    m1, m2, J, R = symbols("m1 m2 J R")
    pulley = Body(sp.S.Zero, (sp.S.Zero,), None, ((J, x.diff(t) / R, sp.S.Zero),))
    return System("atwood", c, (Body(m1, (-x,), height=-x), Body(m2, (x,), height=x), pulley))


@system
def swinging_atwood() -> System:
    r, th = c = q("r theta")
    M, m = symbols("M m")
    return System("swinging-atwood", c, (Body(M, (r,), height=r), fallen(Body(m, (r * sin(th), -r * cos(th))))))


@system
def segway() -> System:
    x, th = c = q("x theta")
    mw, Jw, R, mr, Jr, l = symbols("m_w J_w R m_r J_r l")
    wheels = Body(mw, (x, sp.S.Zero), None, ((Jw, x.diff(t) / R, sp.S.Zero),))
    rider = Body(
        mr, (x + l * sin(th), l * cos(th)), (x, sp.S.Zero), ((Jr, th.diff(t), sp.S.Zero),),
        pivot=l, height=l * cos(th), cross=l * cos(th) * x.diff(t) * th.diff(t),
    )  # fmt: skip
    motor = Pair(u("tau"), x.diff(t) / R, th.diff(t))
    return System("segway", c, (wheels, rider), (), (), (motor,))


@system
def planar_quadrotor() -> System:
    x, y, th = c = q("x y theta")
    m, J, L, b = symbols("m J L b")
    F1, F2 = u("F1 F2")
    hull = Body(m, (x, y), None, ((J, th.diff(t), sp.S.Zero),), height=y)
    up = cos(th) * y.diff(t) - sin(th) * x.diff(t)
    inputs = (Pair(F1, up + L * th.diff(t)), Pair(F2, up - L * th.diff(t)))
    drag = (Pair(b, x.diff(t)), Pair(b, y.diff(t)))
    return System("planar-quadrotor", c, (hull,), (), drag, inputs)


@system
def bead_on_parabola() -> System:
    (x,) = c = q("x")
    m, k = symbols("m c")
    return System("bead-on-parabola", c, (fallen(Body(m, (x, k * x**2))),))


@system
def spherical_pendulum() -> System:
    th, ph = c = q("theta phi")
    m, L = symbols("m L")
    at = (L * sin(th) * cos(ph), L * sin(th) * sin(ph), -L * cos(th))
    return System("spherical-pendulum", c, (fallen(Body(m, at), 2),))
