"""Constraints as they are described: their rows in two languages, files, and what is refused."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from constrained_systems import four_bar, pendulum_in_plane
from lagrangian.dynamics import Inputs, describe
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, Output, Program, evaluate
from lagrangian.model import Model
from lagrangian.model.rows import rows_of
from lagrangian.read import dumps


def spatial_loop() -> lg.System:
    """Every joint of space at once, on two arms that hang on one body that moves."""
    s = lg.System("joints in space")
    x, psi, a, b, c = s.coordinates("x psi a b c")
    m, length = s.parameters("m l", m=1.0, l=0.7)
    base = s.frame(psi, axis=(0, 0, 1), origin=s.point("B", (x, 0, 0)), name="base")
    one = s.frame(a, axis=(1, 0, 0), parent=base, origin=base.point(0.2, 0, 0), name="one")
    two = s.frame(b, axis=(0, 1, 0), parent=base, origin=base.point(0, 0.3, 0), name="two")
    three = s.frame(c, axis=(0, 0, 1), parent=two, origin=two.point(0, 0, length), name="three")
    body = None
    for frame in (base, one, two, three):
        body = s.rigid_body(m, (0.1, 0.2, 0.15), at=frame.point(0.1, 0.2, length / 2), frame=frame, name=frame.name)
    assert body is not None
    tip, end = one.point(0, 0, length), three.point(length, 0, 0)
    s.pin((tip, end), axis=(0, 1, 0), name="pin")
    s.ball((end, s.origin + (1, 1, 1)), name="ball")
    s.slider((tip, s.origin), (1, 2, 3), axes=base, bodies=(one, two), name="slider")
    s.weld((tip, s.origin + (0, 0, 1)), bodies=one, name="weld")
    s.rope((s.origin, tip, end), length, name="rope")
    s.constraint(between=(tip, end), axes=three, name="closure")
    s.rolling(body, s.point("C", (x, 0, 0)), [(1, 0, 0), (0, 1, 0)], name="roll")
    s.velocity_constraint(at=s["C"], body=body, along=(1, 0, 1), axes=one, name="blade")
    s.velocity_constraint(x.diff() * sp.cos(psi) + psi.diff() * sp.sin(s.t), name="stated")
    return s


def plane_joints() -> lg.System:
    s = lg.System("joints in the plane")
    x, y, phi, psi = s.coordinates("x y phi psi")
    m, r = s.parameters("m r", m=1.0, r=0.3)
    wheel = s.frame(phi, origin=s.point("W", (x, y)), name="wheel")
    arm = s.frame(psi, parent=wheel, origin=wheel.point(r, 0), name="arm")
    body = s.rigid_body(m, m * r**2 / 2, at=wheel.origin, frame=wheel, name="disc")
    s.rigid_body(m, m * r**2, at=arm.point(1, 0), frame=arm, name="rod")
    end = arm.point(2, 0)
    s.rolling(body, s.point("C", (x, 0)), (1, 0), name="roll")
    s.constraint(x - 2 * sp.sin(s.t) * y, name="driven")
    s.slider((end, s.origin), (1, 1), bodies=(arm, wheel), name="slider")
    s.weld((end, s.origin + (1, 1)), bodies=arm, name="weld")
    s.velocity_constraint(at=end, body=s["rod"], along=(0, 1), axes=arm, name="knife")
    return s


SYSTEMS: list[Callable[[], lg.System]] = [four_bar, pendulum_in_plane, spatial_loop, plane_joints]


def nodes(model: Model, q: Any, v: Any, t: float) -> tuple[np.ndarray, list[float | None]]:
    """c and f of every row as the machine computes them."""
    graph = Graph()
    inputs = Inputs.of(graph, model)
    rows = describe(model, graph, inputs).rows
    ids = [x for r in rows for x in (r.rate, r.rate if r.residual is None else r.residual)]
    values = {"q": q, "v": v, "p": [p.value for p in model.parameters], "t": [t], "u": []}
    groups = {key: tuple(f"{key}{i}" for i in range(len(x))) for key, x in values.items()}
    program = Program("rows", graph, groups, {"out": Output(tuple(ids), (len(ids),))}, {})
    out = evaluate(program, values)["out"]
    c = np.array(out[::2], float)
    return c, [None if r.residual is None else float(f) for r, f in zip(rows, out[1::2], strict=True)]


def expressions(model: Model, q: Any, v: Any, t: float) -> tuple[np.ndarray, list[float | None]]:
    """The same by SymPy from the rows' expressions."""
    table: dict[Any, Any] = {c.rate: x for c, x in zip(model.coordinates, v, strict=True)}
    table |= {c.symbol: x for c, x in zip(model.coordinates, q, strict=True)}
    table |= {p.symbol: p.value for p in model.parameters}
    table[lg.System("clock").t] = t

    def value(expr: sp.Expr | None) -> float | None:
        if expr is None:
            return None
        return float(expr.subs(table))

    found = rows_of(model)
    return np.array([value(r.rate) for r in found], float), [value(r.position) for r in found]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("make", SYSTEMS)
def test_rows_are_the_same_in_both_languages(make: Callable[[], lg.System]) -> None:
    """f everywhere; c where the row is on velocities, or is f's derivative in axes that both languages share."""
    model = make()._builder.model()  # more rows than can hold at once: notices would refuse them
    rng = np.random.default_rng(5)
    n = len(model.coordinates)
    q, v, t = rng.uniform(-1, 1, n), rng.uniform(-1, 1, n), 0.4
    c, f = nodes(model, q, v, t)
    c_expected, f_expected = expressions(model, q, v, t)
    for name, mine, wanted in zip((r.name for r in rows_of(model)), f, f_expected, strict=True):
        assert mine == pytest.approx(wanted, abs=1e-12), name
    turning = {
        r.name for r in rows_of(model) if getattr(r.condition, "frame", None) is not None and r.position is not None
    }
    for name, mine, wanted in zip((r.name for r in rows_of(model)), c, c_expected, strict=True):
        if name not in turning or name.startswith("slider"):
            assert mine == pytest.approx(wanted, abs=1e-12), name


def test_rows_in_a_bodys_axes_are_f_s_rate_where_the_points_meet() -> None:
    """c = Rᵀ (v_P − v_Q) differs from d/dt Rᵀ (r_P − r_Q) by what vanishes with f: equal where f = 0."""
    s = lg.System("door")
    a, b = s.coordinates("a b")
    post = s.frame(a, axis=(0, 0, 1), name="post")
    leaf = s.frame(b, axis=(1, 0, 0), parent=post, origin=post.point(1, 0, 0), name="leaf")
    s.rigid_body(1, (1, 1, 1), at=leaf.point(0, 1, 0), frame=leaf)
    s.ball((leaf.point(0, 0, 0), post.point(1, 0, 0)), name="shared")
    s.ball((leaf.point(0, 1, 0), s.origin + (1, 1, 0)), name="ground")
    model = s.model
    c, f = nodes(model, [0.0, 0.0], [0.3, -0.7], 0.0)
    expected, _ = expressions(model, [0.0, 0.0], [0.3, -0.7], 0.0)
    assert np.allclose([x or 0.0 for x in f], 0, atol=1e-15)
    assert np.allclose(c, expected, atol=1e-15)


@pytest.mark.parametrize("make", SYSTEMS)
def test_a_file_reads_back_as_the_same_constraints(make: Callable[[], lg.System]) -> None:
    s = make()
    text = dumps(s._builder.model())
    again = lg.loads(text)
    ours, theirs = s._builder.model(), again._builder.model()
    assert [e.kind for e in theirs.constraints] == [e.kind for e in ours.constraints]
    q = np.linspace(0.1, 0.7, len(ours.coordinates))
    mine, other = nodes(ours, q, -q, 0.2), nodes(theirs, q, -q, 0.2)
    assert np.allclose(mine[0], other[0], atol=1e-14)
    assert mine[1] == pytest.approx(other[1], abs=1e-14)
    assert dumps(lg.loads(dumps(theirs))._builder.model()) == dumps(theirs)


def test_multipliers_are_said_in_words_with_their_unit() -> None:
    (rod,) = rows_of(pendulum_in_plane().model)
    assert "".join(map(str, rod.multiplier)).endswith("the tension is its negative")
    assert rod.unit == (1, 1, -2)
    loop = rows_of(four_bar().model)
    assert [r.name for r in loop] == ["loop.x", "loop.y"]
    assert "".join(map(str, loop[0].multiplier)).startswith("the force along x on ")


def refuse(make: Callable[[lg.System], object], *needed: str) -> None:
    s = lg.System("bad")
    x, y = s.coordinates("x y")
    s.input("F")
    s.parameters("l m")
    s.particle(s["m"], at=s.point("P", (x, y)))
    with pytest.raises(ModelError) as caught:
        make(s)
        _ = s.model
    text = str(caught.value)
    for part in needed:
        assert part in text, text


BAD: dict[str, tuple[Callable[[lg.System], object], tuple[str, ...]]] = {
    "nothing": (lambda s: s.constraint(), ("E412", "two points or an expression")),
    "both": (lambda s: s.constraint(s["x"], between=(s["P"], s.origin)), ("E412", "got both")),
    "a rate": (lambda s: s.constraint(s["x"].diff()), ("E419", "rate")),
    "an input": (lambda s: s.constraint(s["x"] - s["F"]), ("E417", "input")),
    "no coordinate": (lambda s: s.constraint(s["l"] - 1), ("E410", "restricts nothing")),
    "no coordinate but time": (lambda s: s.constraint(sp.sin(s.t) - 1), ("E410", "restricts nothing")),
    "one point twice": (lambda s: s.constraint(between=(s["P"], s["P"])), ("E410", "same point")),
    "one point": (lambda s: s.constraint(between=(s["P"],)), ("E410", "two points")),
    "three points": (lambda s: s.pin((s["P"], s.origin, s["P"])), ("E412", "two points")),
    "a negative distance": (lambda s: s.constraint(between=(s["P"], s.origin), distance=-1), ("E406", "above 0")),
    "a distance alone": (lambda s: s.constraint(s["x"], distance=1), ("E412", "two points")),
    "an unknown symbol": (lambda s: s.constraint(s["x"] - sp.Symbol("zz")), ("E402", "zz")),
    "text": (lambda s: s.constraint("x - y"), ("E406", "SymPy")),
    "fixed points": (lambda s: s.constraint(between=(s.origin + (1, 0), s.origin)), ("E410", "restricts nothing")),
    "quadratic rates": (lambda s: s.velocity_constraint(s["x"].diff() ** 2 - 1), ("E301", "linear")),
    "a product of rates": (lambda s: s.velocity_constraint(s["x"].diff() * s["y"].diff()), ("E301", "linear")),
    "no rate": (lambda s: s.velocity_constraint(s["x"] - s["y"]), ("E301", "no rate")),
    "an acceleration": (lambda s: s.velocity_constraint(s["x"].diff(s.t, 2)), ("E418", "acceleration")),
    "an input in a rate": (lambda s: s.velocity_constraint(s["x"].diff() - s["F"]), ("E417", "input")),
    "half a contact": (lambda s: s.velocity_constraint(at=s["P"]), ("E412", "at, body and along")),
    "a particle that rolls": (lambda s: s.rolling(s["m"], s["P"], (1, 0)), ("E412", "rigid body")),
    "a rope to one point": (lambda s: s.rope((s["P"],), 1), ("E410", "two points")),
    "a rope of no length": (lambda s: s.rope((s["P"], s.origin), 0), ("E406", "above 0")),
    "a pin with an axis in the plane": (lambda s: s.pin((s["P"], s.origin), axis=(0, 0, 1)), ("E414", "no axis")),
    "a slider along nothing": (lambda s: s.slider((s["P"], s.origin), (0, 0)), ("E409", "no direction")),
    "a slider of three components": (lambda s: s.slider((s["P"], s.origin), (0, 0, 1)), ("E414", "components")),
    "a weld of points alone": (lambda s: s.weld((s["P"], s.origin)), ("E412", "bodies")),
    "another system's point": (lambda s: s.pin((s["P"], lg.System("b").origin)), ("E412", "another system")),
    "a coordinate's name": (lambda s: s.constraint(s["x"], name="y"), ("E404", "taken by a coordinate")),
    "a name taken": (
        lambda s: (s.constraint(s["x"], name="a"), s.constraint(s["y"], name="a")),
        ("E404", "taken"),
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_what_makes_no_sense_is_refused_with_a_cure(case: str) -> None:
    make, needed = BAD[case]
    refuse(make, *needed)
