"""Random mechanisms: the readable equations against the definition, differentiated without any of our algebra."""

import random

import pytest
import sympy as sp
from hypothesis import HealthCheck, given
from hypothesis import strategies as st
from sympy import cos, sin

import lagrangian as lg
from size import sized

t = sp.Symbol("t")


@st.composite
def mechanisms(draw: st.DrawFn) -> lg.System:
    """A plane tree of links and sliders, each absolute or relative, with springs, dampers, a force and gravity."""
    s = lg.System("random mechanism")
    n = draw(st.integers(1, 3))
    q = [s.coordinate(f"q{i}") for i in range(n)]
    s.parameters(" ".join(f"m{i} l{i}" for i in range(n)) + " k b k2")
    F = s.input("F")
    places, angles = [s.origin], [sp.Integer(0)]
    for i in range(n):
        parent = draw(st.integers(0, i))
        base, angle = places[parent], angles[parent]
        m, length = s[f"m{i}"], s[f"l{i}"]
        kind = draw(st.sampled_from(["absolute link", "relative link", "slider", "rod"]))
        if kind == "slider":
            place, turned = base + (q[i] * cos(angle), q[i] * sin(angle)), angle
        else:
            turned = q[i] if kind == "absolute link" else angle + q[i]
            place = base + (length * cos(turned), length * sin(turned))
        if kind == "rod":
            s.rigid_body(m, m * length**2 / 12, at=place, frame=turned)
        else:
            s.particle(m, place)
        places.append(place)
        angles.append(turned)
    if draw(st.booleans()):
        s.gravity(direction=draw(st.sampled_from([(0, -1), (1, 0), (3, -4)])))
    if draw(st.booleans()):
        s.spring(s["k"], deflection=q[-1] - q[0] / 2, rest=sp.Rational(1, 3))
    if draw(st.booleans()):
        s.spring(s["k2"], between=(s.origin, places[-1]))
    if draw(st.booleans()):
        s.damper(s["b"], deflection=q[-1])
    if draw(st.booleans()):
        s.force((F, 2 * F), at=places[-1])
    return s


def by_definition(s: lg.System) -> list[sp.Expr]:
    """d/dt(∂L/∂q̇) − ∂L/∂q − Ξ straight from the definition, unsimplified."""
    model = s.model
    lagrangian = sp.Integer(0)
    for body in model.bodies:
        x, y = body.at.position
        v2 = x.diff(t) ** 2 + y.diff(t) ** 2
        lagrangian += body.mass * v2 / 2
        if hasattr(body, "frame"):
            lagrangian += body.inertia[0, 0] * body.frame.angle.diff(t) ** 2 / 2
        for e in model.elements:
            if e.kind == "gravity":
                nx, ny = e.direction
                lagrangian += body.mass * e.g * (nx * x + ny * y)
    for e in model.elements:
        if e.kind == "spring" and e.between:
            x, y = e.between[1].position
            lagrangian -= e.k * (x**2 + y**2) / 2
        elif e.kind == "spring":
            lagrangian -= e.k * (e.deflection - e.rest) ** 2 / 2
    sides = []
    for c in model.coordinates:
        side = lagrangian.diff(c.rate).diff(t) - lagrangian.diff(c.symbol)
        for e in model.elements:
            if e.kind == "damper":
                side += e.b * e.deflection.diff(t) * e.deflection.diff(c.symbol)
            elif e.kind == "force":
                side -= sum(f * x.diff(c.symbol) for f, x in zip(e.value, e.at.position, strict=True))
        sides.append(side)
    return sides


def value(expr: sp.Expr, state: dict[sp.Basic, sp.Expr]) -> sp.Expr:
    high = {k: v for k, v in state.items() if isinstance(k, sp.Derivative) and k.derivative_count == 2}
    rates = {k: v for k, v in state.items() if isinstance(k, sp.Derivative) and k.derivative_count == 1}
    rest = {k: v for k, v in state.items() if not isinstance(k, sp.Derivative)}
    return sp.N(expr.xreplace(high).xreplace(rates).xreplace(rest), 30)


@pytest.mark.slow
@sized(25, 4, suppress_health_check=list(HealthCheck))
@given(mechanisms())
def test_readable_equations_are_the_definition(s: lg.System) -> None:
    source = random.Random(7)
    d = s.derive()
    assert all(check.holds for check in d.verified), [str(c.what) for c in d.verified if not c.holds]
    symbols: list[sp.Basic] = [p.symbol for p in s.model.parameters] + [i.symbol for i in s.model.inputs]
    for c in s.model.coordinates:
        symbols += [c.symbol, c.rate, c.acceleration]
    state = {x: sp.Rational(source.randint(200, 1800), 1000) for x in symbols}
    for equation, side in zip(d.equations, by_definition(s), strict=True):
        ours, theirs = value(equation.lhs - equation.rhs, state), value(side, state)
        assert ours == pytest.approx(theirs, rel=1e-20, abs=1e-20)
