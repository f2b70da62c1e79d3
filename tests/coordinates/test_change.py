"""A system in other coordinates moves as before: its ξ̈ follows from the old one's by the chain rule, done by SymPy."""

from __future__ import annotations

import random
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

import built_in
import lagrangian as lg
from lagrangian.coordinates import changed, read_change
from lagrangian.model import Model, time
from size import rest_slow, sized


def _oracle_rows(model: Model) -> list[sp.Expr]:
    """Lagrange's equations by SymPy alone: d/dt(∂L/∂ξ̇) − ∂L/∂ξ − Ξ from the elements' own energies and actions."""
    T = sum((e.kinetic(model) for e in model.elements), sp.S.Zero)
    V = sum((e.potential(model) for e in model.elements), sp.S.Zero)
    rows = []
    for c in model.coordinates:
        xi = sum((a.effort * sp.diff(a.rate, c.rate) for e in model.elements for a in e.works(model)), sp.S.Zero)
        L = T - V
        rows.append(sp.diff(sp.diff(L, c.rate), time) - sp.diff(L, c.symbol) - xi)
    return [model.expand(r, constants=True) for r in rows]


def _accelerations(rows: list[sp.Expr], model: Model, state: dict[Any, Any]) -> Any:
    n = len(rows)
    accelerations = [c.acceleration for c in model.coordinates]
    order: list[Any] = sorted(state, key=lambda s: (s == time, -getattr(s, "derivative_count", 0)))

    def value(expr: sp.Expr) -> Any:
        for s in order:
            expr = expr.subs(s, state[s])
        return mpmath.mpf(str(sp.N(expr, 40)))

    zero = dict.fromkeys(accelerations, sp.S.Zero)
    M = mpmath.matrix(n, n)
    h = mpmath.matrix(n, 1)
    for i, row in enumerate(rows):
        h[i] = value(row.xreplace(zero))
        for j, a in enumerate(accelerations):
            M[i, j] = value(sp.diff(row, a))
    return mpmath.lu_solve(M, -h)


def assert_same_motion(old: Model, new: Model, table: dict[Any, sp.Expr]) -> None:
    """At a random state: ξ̈ of the old system = d²φ/dt² at the new system's η̈."""
    draw = random.Random(5)
    with mpmath.workdps(40):
        state: dict[Any, Any] = {}
        for c in new.coordinates:
            state[c.rate] = sp.Rational(draw.randrange(4, 16), 10)
            state[c.symbol] = sp.Rational(draw.randrange(4, 16), 10)
        rest: dict[Any, Any] = {time: sp.Rational(7, 10)}
        for p in [*old.parameters, *old.inputs]:
            rest[p.symbol] = sp.Rational(draw.randrange(4, 16), 10)
        eta = _accelerations(_oracle_rows(new), new, {**state, **rest})
        put = {c.acceleration: sp.Float(str(a), 40) for c, a in zip(new.coordinates, eta, strict=True)}

        def at(expr: sp.Expr) -> sp.Expr:
            for group in (put, {c.rate: state[c.rate] for c in new.coordinates}, state, rest):
                expr = expr.subs(group)
            return sp.N(expr, 40)

        moved: dict[Any, Any] = dict(rest)
        expected = []
        for c in old.coordinates:
            phi = table.get(c.symbol, c.symbol)
            moved[c.symbol], moved[c.rate] = at(phi), at(sp.diff(phi, time))
            expected.append(at(sp.diff(phi, time, 2)))
        found = _accelerations(_oracle_rows(old), old, moved)
        for x, y in zip(found, expected, strict=True):
            assert abs(x - mpmath.mpf(str(y))) < mpmath.mpf(10) ** -25 * (1 + abs(x))


def test_the_lecture_absolute_to_relative_is_its_example_3b() -> None:
    system = built_in.system("lecture-3a")
    found = system.in_coordinates({"x2": "x1 + x2r"}).derive()
    expected = built_in.derivation("lecture-3b")
    assert found.equations == expected.equations
    assert found.generalized_forces == expected.generalized_forces


def test_the_lecture_s_arm_with_the_same_letter_for_another_angle() -> None:
    absolute = built_in.system("lecture-2-absolute")
    relative = absolute.in_coordinates({absolute["theta2"]: absolute["theta1"] + absolute["theta2"]})
    assert relative.derive().equations == built_in.derivation("lecture-2").equations
    assert [p.name for p in relative.model.points] == ["P1", "P2", "P3"]
    assert relative.model.settings["initial"] == pytest.approx({"theta1": -1.5, "theta2": 0.6})


def test_a_change_given_the_other_way_round_is_solved() -> None:
    system = built_in.system("lecture-3a")
    assert system.in_coordinates({"x2r": "x2 - x1"}).derive().equations == (built_in.derivation("lecture-3b").equations)


def _everything() -> lg.System:
    s = lg.System("every kind of element")
    x, y, phi = s.coordinates("x y phi")
    m, J, k, b, c = s.parameters("m J k b c")
    F, tau = s.inputs("F tau")
    L = s.define("L", 2 * c)
    h = s.define("h", y - x / 2)
    P = s.point("P", (x, h))
    R = s.frame(phi, name="R", origin=P)
    G = s.point("G", (L, 0), frame=R)
    s.particle(m, at=P)
    s.rigid_body(2 * m, J, at=G, frame=R)
    s.gravity(g=9)
    s.spring(k, between=(s.origin + (3, 4), G), rest=c)
    s.spring(law=lambda delta: k * delta + c * delta**3, deflection=phi - x)
    s.damper(b, deflection=y + x)
    s.damper(law=lambda rate: b * rate**3, deflection=phi)
    s.force((F, 2), at=G, axes=R)
    s.force(F, between=(s.origin + (-3, 1), P))
    s.torque(tau, on=phi, reaction=x)
    s.torque(tau, on=R)
    s.potential(k * x * y)
    s.kinetic(m * x.diff() * phi.diff() / 5)
    s.dissipation(b * (x.diff() - y.diff()) ** 2)
    s.generalized_force(y, F * x)
    return s


CHANGES: dict[str, dict[str, str]] = {
    "linear": {"y": "x + 2*z", "phi": "psi - x"},
    "polar": {"x": "r*cos(a)", "y": "r*sin(a)"},
    "moving": {"x": "u + c*sin(2*t)", "y": "v + u*t"},
    "curved": {"x": "u + u^3/5", "phi": "phi + u*y"},
}


@pytest.mark.thinned(2)
@pytest.mark.parametrize("name", rest_slow(CHANGES, ()))
def test_every_kind_of_element_is_carried_over(name: str) -> None:
    system = _everything()
    change = read_change(system.model, CHANGES[name])
    new = changed(system.model, CHANGES[name])
    assert_same_motion(system.model, new, dict(change.table))
    assert {e.kind for e in new.elements} == {e.kind for e in system.elements}
    assert [d.name for d in new.definitions] == ["L", "h"]


@pytest.mark.slow
def test_in_space_parents_stay_parents() -> None:
    system = built_in.system("scara")
    old = system.model
    names = [c.name for c in old.coordinates]
    new = changed(old, {names[1]: f"{names[1]}_abs - {names[0]}"})
    assert_same_motion(old, new, dict(read_change(old, {names[1]: f"{names[1]}_abs - {names[0]}"}).table))
    for before, after in zip(old.points, new.points, strict=True):
        assert before.name == after.name
        assert (before.parent and before.parent.name) == (after.parent and after.parent.name)


def test_a_generalized_force_acts_on_every_new_coordinate_that_moves_its_own() -> None:
    x1, x2 = (sp.Function(n)(time) for n in ("x1", "x2"))
    F, m = sp.Function("F")(time), sp.Symbol("m")
    s = lg.System.from_energies((x1, x2), T=m * (x1.diff() ** 2 + x2.diff() ** 2) / 2, Xi={x2: F})
    new = s.in_coordinates({"x2": "x1 + x2r"}).derive()
    assert list(new.Xi.values()) == [F, F]


def test_a_file_in_other_coordinates_is_read_back() -> None:
    new = built_in.system("lecture-2").in_coordinates({"theta2": "theta2 - theta1"})
    again = lg.loads(new.to_toml())
    assert again.derive().equations == new.derive().equations


@pytest.mark.slow
@sized(6, 2)
@given(
    st.integers(2, 3).flatmap(
        lambda n: st.lists(st.lists(st.integers(-2, 2), min_size=n, max_size=n), min_size=n, max_size=n)
    )
)
def test_random_linear_changes_of_random_chains(rows: list[list[int]]) -> None:
    A, n = sp.Matrix(rows), len(rows)
    s = lg.System("chain")
    xs = [s.coordinate(f"x{i}") for i in range(n)]
    ms = [s.parameter(f"m{i}") for i in range(n)]
    for i, x in enumerate(xs):
        s.particle(ms[i], at=s.origin + (x, 0))
        s.spring(i + 1, deflection=x - (xs[i - 1] if i else 0))
    s.force(s.input("F"), deflection=xs[-1] - xs[0])
    etas = [sp.Function(f"y{i}")(time) for i in range(n)]
    table = dict(zip(xs, A * sp.Matrix(etas), strict=True))
    if A.det() == 0:
        with pytest.raises(lg.ModelError, match="E210"):
            s.in_coordinates(table)
        return
    new = s.in_coordinates(table).derive()
    old = _oracle_rows(s.model)
    swap = {**{sp.Derivative(x, (time, 2)): sp.diff(e, time, 2) for x, e in table.items()}, **table}
    expected = A.T * sp.Matrix([row.xreplace(swap) for row in old])
    of = dict(zip(etas, expected, strict=True))
    for q, equation in zip(new.coordinates, new.equations, strict=True):
        row = of[q]
        assert sp.expand(equation.lhs - equation.rhs - row) == 0


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({}, "is a mapping"),
        ({"x2": "x1 + 3"}, "1 coordinate is replaced .x2. by 0 new"),
        ({"x2": "u + v"}, "by 2 new"),
        ({"x2": "x1' + r"}, "contains a rate"),
        ({"x2": "F + r"}, "an input"),
        ({"x3": "u", "x2": "x1 + r"}, "no coordinate 'x3'"),
        ({"x1": "u + v", "x2": "2*u + 2*v"}, "singular: u and v"),
        ({"r": "x2^2"}, "cannot be solved"),
        ({"x2": sp.Symbol("z")}, "unknown symbol 'z'"),
        ({"x2": "x1 + m1*k(3)"}, "not a function"),
        ({"x2": "__import__('os')"}, "E70|E402"),
        ({"x2": "9^9^9^9*r"}, "E70"),
        ({3: 3}, "its symbol or its name"),
        ({"x2": "x1 + k", "x1": "k"}, "by 1 new"),
        ({"x2": [1]}, "must be a number"),
        ({"x_2": "u"}, "no coordinate 'x_2'.*\\n.*Did you mean 'x2'"),
        ({"x3": "u + 1", "x4": "v"}, "no coordinate 'x3'"),
        ({"x2r": "x2 - xx1"}, "unknown coordinate 'xx1'.*\\n.*Did you mean 'x1'"),
    ],
)
def test_what_is_no_change_is_refused_and_told_why(change: dict[Any, Any], words: str) -> None:
    system = built_in.system("lecture-3a")
    with pytest.raises(lg.ModelError, match=words) as caught:
        system.in_coordinates(change)
    assert caught.value.fix
    assert caught.value.code


def test_what_floats_is_carried_along_and_stays_as_it_is() -> None:
    s = lg.System("floating base with an arm")
    base = s.floating_frame("base")
    q, r = s.coordinates("q r")
    m = s.parameter("m")
    s.rigid_body(m, (1, 2, 3), base.origin, base, name="trunk")
    hinge = s.frame(q, axis=(0, 0, 1), parent=base, name="hinge")
    knee = s.frame(r, axis=(0, 1, 0), parent=hinge, name="knee")
    s.rigid_body(m, (1, 2, 2), knee.point(1, 0, 0), knee, name="leg")
    s.generalized_force(s["base_wz"], 2)
    new = s.in_coordinates({"r": "q + p"})
    assert [c.name for c in new.model.coordinates][-2:] == ["q", "p"]
    assert [v.name for v in new.model.velocities] == [v.name for v in s.model.velocities][:-1] + ["p'"]
    assert new["knee"].parent.parent.floating is not None
    with pytest.raises(lg.ModelError, match="which has a quaternion"):
        s.in_coordinates({"base_x": "u + q"})


@pytest.mark.sampled(2)
@pytest.mark.parametrize("change", [{"x2": "x1 + x2"}, {"x2": "x1 + d"}])
def test_a_feedback_of_the_file_is_written_in_the_new_coordinates(change: dict[str, str]) -> None:
    """Two carts and F = −k x2 − b x2' on the second: the same motion, whichever coordinate says where x2 is."""
    text = """
name = "two carts"

[coordinates]
x1 = "left"
x2 = "right"

[parameters]
m = "1 kg"
k = "4 N/m"
b = "0.5 N*s/m"

[inputs]
F = "N, on the right one"

[points]
left = ["x1", "0"]
right = ["x2", "0"]

[[particle]]
mass = "m"
at = "left"

[[particle]]
mass = "m"
at = "right"

[[spring]]
k = "k"
deflection = "x2 - x1"

[[force]]
value = ["F", "0"]
at = "right"

[simulate]
duration = "2 s"
initial = { x2 = "0.5 m" }
inputs = { F = "-k*x2 - b*x2'" }
"""
    old = lg.loads(text)
    new = old.in_coordinates(change)
    place = "x1 + " + new.model.coordinates[1].name
    assert np.allclose(new.simulate()[place], old.simulate()["x2"], rtol=1e-7, atol=1e-9)
