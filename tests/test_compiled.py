"""The compiled system against the equations that people read, in every built-in example, and its manners."""

import ctypes
import importlib.util
import json
import pathlib
import shutil
import subprocess
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp
from sympy import cos, sin

import built_in
import lagrangian as lg
from built_in import FREE, SOME
from effort import at_most
from size import rest_slow

t = sp.Symbol("t")
random = np.random.default_rng(5)


def system(name: str) -> lg.System:
    return built_in.system(name)


def state(s: lg.System, *lead: int) -> dict[str, np.ndarray]:
    """Random coordinates, rates, inputs and parameters; everything positive, so that masses are masses."""
    model = s.model
    sizes = {"q": model.coordinates, "v": model.coordinates, "u": model.inputs, "p": model.parameters}
    return {key: random.uniform(0.5, 1.5, (*lead, len(entries))) for key, entries in sizes.items()}


def by_the_equations(s: lg.System, x: dict[str, np.ndarray], time: float) -> np.ndarray:
    """q̈ from the derived equations, solved as SymPy hands them over."""
    d, model = s.derive(), s.model
    values: dict[sp.Basic, sp.Expr] = {t: sp.Float(time, 30)}
    for entries, numbers in ((model.parameters, x["p"]), (model.inputs, x["u"])):
        values |= {e.symbol: sp.Float(n, 30) for e, n in zip(entries, numbers, strict=True)}
    rates = {c.rate: sp.Float(n, 30) for c, n in zip(model.coordinates, x["v"], strict=True)}
    places = {c.symbol: sp.Float(n, 30) for c, n in zip(model.coordinates, x["q"], strict=True)}
    definitions = {e.symbol: e.expression for e in reversed(model.definitions)}
    a = sp.symbols(f"a0:{len(model.coordinates)}")
    sides = []
    for equation in d.equations:
        side = (equation.lhs - equation.rhs).subs(definitions)
        side = side.xreplace({c.acceleration: s for c, s in zip(model.coordinates, a, strict=True)})
        sides.append(sp.expand(side.xreplace(rates).xreplace(places).xreplace(values).evalf(30)))
    M, rest = sp.linear_eq_to_matrix(sides, a)
    return np.linalg.solve(np.array(M, float), np.array(rest, float))[:, 0]


LONG = {"robot-arm", "scara", "triple-pendulum-relative", "spring-net", "ball-and-beam", "acrobot", "spinning-top"}


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", rest_slow(FREE, set(FREE) - LONG))
def test_forward_dynamics_solves_the_equations_that_people_read(name: str) -> None:
    s = system(name)
    x = state(s)
    a = s.compile().forward(x["q"], x["v"], x["u"], x["p"], 0.3)
    expected = by_the_equations(s, x, 0.3)
    np.testing.assert_allclose(a, expected, rtol=1e-9, atol=1e-9 * max(1.0, float(np.abs(expected).max())))


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "name",
    rest_slow(
        ["lecture-2", "furuta-pendulum", "spring-net", "bead-on-hoop", "spinning-top", "scara"],
        {"lecture-2", "bead-on-hoop"},
    ),
)
def test_the_methods_fit_together(name: str) -> None:
    s = system(name)
    dyn, n = s.compile(), len(s.model.coordinates)
    x = state(s, 40)
    q, v, u, p = x["q"], x["v"], x["u"], x["p"]
    a = dyn.forward(q, v, u, p, 0.1)
    scale = float(np.abs(dyn.mass_matrix(q, p, 0.1)).max() * max(1.0, np.abs(a).max()))
    np.testing.assert_allclose(dyn.inverse(q, v, a, u, p, 0.1), 0, atol=1e-11 * scale)
    M, h = dyn.mass_matrix(q, p, 0.1), dyn.bias(q, v, u, p, 0.1)
    np.testing.assert_allclose(np.einsum("bij,bj->bi", M, a) + h, 0, atol=1e-11 * scale)
    np.testing.assert_allclose(M, M.swapaxes(1, 2), atol=1e-14 * scale)
    assert (np.linalg.eigvalsh(M) > 0).all()
    np.testing.assert_allclose(dyn.rhs(0.1, np.concatenate([q, v], 1), u, p), np.concatenate([v, a], 1), rtol=1e-12)
    T, V = dyn.energies(q, v, u, p, 0.1)
    np.testing.assert_allclose(dyn.energy(q, v, u, p, 0.1), T + V, rtol=1e-14)
    if name != "bead-on-hoop":  # a motion prescribed in t adds to T* what no rate carries
        np.testing.assert_allclose(T, np.einsum("bi,bij,bj->b", v, M, v) / 2, rtol=1e-12)
    assert dyn.coriolis_matrix(q, v, p).shape == (40, n, n)


def pendulum() -> lg.System:
    s = lg.System("pendulum")
    th = s.coordinates("theta")
    m, L = s.parameters("m L", m=2.0)
    tau = s.input("tau")
    s.particle(m, s.origin + (L * sin(th), -L * cos(th)))
    s.gravity()
    s.torque(tau, on=th)
    return s


def test_parameters_and_inputs_go_by_name_by_symbol_or_in_order() -> None:
    s = pendulum()
    dyn = s.compile()
    expected = (3.0 - 2.0 * 9.81 * 0.5 * np.sin(0.4)) / (2.0 * 0.25)
    for u, p in (
        ({"tau": 3.0}, {"L": 0.5}),
        ({s["tau"]: 3.0}, {s["L"]: 0.5}),
        ([3.0], [2.0, 0.5, 9.81]),
        (np.array([3.0]), {"L": 0.5, "m": 2.0, "g": 9.81}),
    ):
        np.testing.assert_allclose(dyn.forward([0.4], [0.0], u, p), [expected], rtol=1e-14)


def test_symbols_as_keys_and_one_input_alone_need_no_closer_look() -> None:
    s = pendulum()
    dyn = s.compile()
    expected = dyn.forward([0.4], [0.0], [3.0], {"L": 0.5})
    quick = dyn._kernel("forward").quick
    for u, p in (
        ({s["tau"]: 3.0}, {s["L"]: 0.5}),
        ({s["tau"]: 3.0}, {s["L"]: 0.5, s["m"]: 2.0, s["g"]: 9.81}),
        (3.0, {"L": 0.5}),
    ):
        np.testing.assert_array_equal(quick(([0.4], [0.0], u, p, 0.0)), expected)
    assert quick(([0.4], [0.0], 3.0, {s["theta"]: 0.5}, 0.0)) is None
    turned = {s["L"]: 0.5, s["g"]: 9.81, s["m"]: 2.0}  # in another order, twice: it is known then
    for _ in range(2):
        np.testing.assert_array_equal(quick(([0.4], [0.0], {s["tau"]: 3.0}, turned, 0.0)), expected)
    assert quick(([0.4], [0.0], 3.0, {s["L"]: 0.5, s["g"]: 9.81, "l": 2.0}, 0.0)) is None
    np.testing.assert_array_equal(quick(([0.4], [0.0], 3.0, {"L": 0.5, "m": 2.0, "g": 9.81}, 0.0)), expected)


@pytest.mark.parametrize(
    ("arguments", "fragments"),
    [
        (([0.4], [0.0]), ["parameter 'L' has no value"]),
        (([0.4], [0.0], None, {"LL": 1.0, "L": 1.0}), ["unknown parameter 'LL'", "Did you mean 'L'"]),
        (([0.4, 0.1], [0.0], None, {"L": 1.0}), ["q has 2 values", "1: theta"]),
        (([float("nan")], [0.0], None, {"L": 1.0}), ["'theta' is nan"]),
        (([0.4], [0.0], {"tau": float("inf")}, {"L": 1.0}), ["'tau' is inf"]),
        ((["a"], [0.0], None, {"L": 1.0}), ["'q'"]),
        (([0.4], [0.0], None, {"L": 0.0}), ["M is singular at theta = 0.4", "'theta' moves no mass"]),
    ],
)
def test_what_does_not_fit_is_named(arguments: tuple, fragments: list[str]) -> None:
    with pytest.raises(lg.RunError) as caught:
        pendulum().compile().forward(*arguments)
    assert all(f in str(caught.value) for f in fragments), str(caught.value)


Q, V, U = np.array([0.1, 0.2]), np.array([0.3, 0.1]), np.array([0.5])
P, X = np.array([1.0, 0.2, 0.3, 0.006, 0.1, 9.81]), np.concatenate([Q, V])
COLUMN = np.ones((512, 1))
MANY = COLUMN * Q, COLUMN * V
CALLS = {
    "forward": (2, lambda c, p: c.forward(Q, V)),
    "forward, all arrays": (3, lambda c, p: c.forward(Q, V, U, P, 0.25)),
    "forward, new parameters": (3, lambda c, p: c.forward(Q, V, p=p)),
    "forward, mappings": (6, lambda c, p: c.forward(Q, V, {"F": 0.5}, dict(zip(c.parameters, P, strict=True)))),
    "forward, a new mapping": (4, lambda c, p: c.forward(Q, V, None, dict(zip(c.parameters, p, strict=True)))),
    "forward, lists": (4, lambda c, p: c.forward([0.1, 0.2], [0.3, 0.1])),
    "inverse": (3, lambda c, p: c.inverse(Q, V, V, U, P)),
    "mass_matrix, new parameters": (3, lambda c, p: c.mass_matrix(Q, p)),
    "energy": (3, lambda c, p: c.energy(Q, V)),
    "rhs": (3, lambda c, p: c.rhs(0.25, X, U, P)),
    "many, new parameters": (15, lambda c, p: c.forward(*MANY, p=p)),
    "many, a set for each": (18, lambda c, p: c.forward(*MANY, p=COLUMN * p)),
    "a few, new parameters": (16, lambda c, p: c.forward(MANY[0][:3], MANY[1][:3], p=p)),
}


@pytest.mark.parametrize(("most", "call"), CALLS.values(), ids=CALLS)
def test_a_call_is_little_work_for_python(most: int, call: Callable[..., Any]) -> None:
    """Counted in calls of Python's functions, once machine code is there."""
    c = system("cart-pole").compile(threads=1)
    for k in range(8):
        call(c, P * (1 + 1e-3 * k))
    with at_most(most + 3):  # and three that the test makes
        call(c, P * 1.5)


@pytest.mark.parametrize("packed", [True, False])
@pytest.mark.parametrize("count", [1, 3, 37])
def test_a_set_of_parameters_is_refused_wherever_it_is_among_those_of_all_states(count: int, packed: bool) -> None:
    """Machine code looks at all of them at once: neither the first nor the last number may escape it."""
    c = system("cart-pole").compile(threads=1)
    sets = np.tile(P, (count, 1 if packed else 2))[:, : len(P)]
    states = COLUMN[:count] * Q, COLUMN[:count] * V
    for _ in range(2):
        c.forward(COLUMN[:37] * Q, COLUMN[:37] * V, p=np.tile(P, (37, 1)))
    c.forward(*states, p=sets)
    for k in {0, count // 2, count - 1}:
        place = f"at state {k}" if count > 1 else ""
        for j, name in enumerate(c.parameters):
            for wrong, code in ((np.nan, "E502"), (-np.inf, "E502"), (2e150, "E101"), (-2e150, "E101")):
                kept, sets[k, j] = sets[k, j], wrong
                with pytest.raises(lg.Error, match=rf"\[{code}\] parameter '{name}' is .*{place}"):
                    c.forward(*states, p=sets)
                sets[k, j] = kept
        sets[k, 0], kept = -sets[k, 0], sets[k, 0]
        with pytest.raises(lg.Error, match="mass"):
            c.forward(*states, p=sets)
        sets[k, 0] = kept
    assert np.isfinite(c.forward(*states, p=sets)).all()


def test_no_states_with_a_parameter_set_for_each_are_no_accelerations() -> None:
    c = system("crane").compile()
    none = np.empty((0, len(c.coordinates)))
    for _ in range(2):  # the second call comes without a closer look
        assert c.forward(none, none, p=np.empty((0, len(c.parameters)))).shape == none.shape


def test_a_singular_configuration_is_named_with_its_coordinates() -> None:
    """At the pole of spherical angles, turning about the vertical moves nothing."""
    s = lg.System("spherical")
    th, ph = s.coordinates("theta phi")
    m, L = s.parameters("m L", m=1, L=1)
    s.particle(m, s.origin + (L * sin(th) * cos(ph), L * sin(th) * sin(ph), -L * cos(th)))
    dyn = s.compile()
    with pytest.raises(lg.RunError, match=r"singular at theta = 0, phi = 0.3: 'phi' moves no mass"):
        dyn.forward([0.0, 0.3], [0.1, 0.2])
    assert np.isfinite(dyn.forward([0.1, 0.3], [0.1, 0.2])).all()


@pytest.mark.parametrize("given", [[0.4], {"theta": 0.4}, 0.4])
def test_a_singular_configuration_is_named_however_it_was_given(given: Any) -> None:
    dyn, p, q = pendulum().compile(), {"L": 0.0}, given
    state: Any = {**given, "theta'": 0.0} if isinstance(given, dict) else [0.4, 0.0]
    for call in (lambda: dyn.forward(q, [0.0], None, p), lambda: dyn.rhs(0.0, state, None, p)):
        with pytest.raises(lg.RunError, match=r"M is singular at theta = 0\.4"):
            call()


def test_a_points_jacobian_carries_rates_to_its_velocity() -> None:
    s = lg.System("arm")
    a, b = s.coordinates("a b")
    m = s.parameter("m", 1.0)
    elbow = s.point("elbow", (2 * cos(a), 2 * sin(a)))
    s.particle(m, elbow)
    s.particle(m, s.point("tip", (cos(a + b), sin(a + b)), relative_to=elbow))
    dyn = s.compile()
    q, v = random.uniform(-1, 1, (9, 2)), random.uniform(-1, 1, (9, 2))
    tip = dyn.point("tip", q, v)
    outer = q.sum(1)
    expected = np.stack([2 * np.cos(q[:, 0]) + np.cos(outer), 2 * np.sin(q[:, 0]) + np.sin(outer)], 1)
    np.testing.assert_allclose(tip["r"], expected, rtol=1e-13, atol=1e-13)
    row_x = np.stack([-2 * np.sin(q[:, 0]) - np.sin(outer), -np.sin(outer)], 1)
    np.testing.assert_allclose(tip["J"][:, 0], row_x, rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(np.einsum("bij,bj->bi", tip["J"], v), tip["v"], rtol=1e-13, atol=1e-13)
    with pytest.raises(lg.ModelError, match="no point 'top'"):
        dyn.point("top", q)


def test_python_source_runs_alone_and_agrees(tmp_path: pathlib.Path) -> None:
    s = system("cart-pole")
    (path,) = s.export(tmp_path / "cart.py")
    assert "lagrangian" not in path.read_text(encoding="utf-8")
    spec = importlib.util.spec_from_file_location("cart", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    x, dyn = state(s, 7), s.compile()
    got = module.cart_forward(x["q"], x["v"], x["u"], x["p"], 0.0)
    np.testing.assert_allclose(got, dyn.forward(x["q"], x["v"], x["u"], x["p"]), rtol=1e-12)
    np.testing.assert_allclose(
        module.cart_mass_matrix(x["q"], x["v"], x["u"], x["p"], 0.0), dyn.mass_matrix(x["q"], x["p"]), rtol=1e-12
    )


@pytest.mark.skipif(shutil.which("gcc") is None, reason="no C compiler on this machine")
def test_c_source_compiles_without_a_warning_and_agrees(tmp_path: pathlib.Path) -> None:
    s = system("furuta-pendulum")
    s.export(tmp_path / "furuta.c")
    library = tmp_path / "furuta.so"
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O1", "-shared", "-fPIC"]
    subprocess.run(["gcc", *flags, "-o", str(library), str(tmp_path / "furuta.c"), "-lm"], check=True)
    function = ctypes.CDLL(str(library)).furuta_forward
    x, dyn = state(s), s.compile()
    out = np.empty(2)
    arrays = [x["q"], x["v"], x["u"], x["p"], np.zeros(1), out]
    function(*[a.ctypes.data_as(ctypes.c_void_p) for a in arrays])
    np.testing.assert_allclose(out, dyn.forward(x["q"], x["v"], x["u"], x["p"]), rtol=1e-12)


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_javascript_source_runs_in_node_and_agrees(tmp_path: pathlib.Path) -> None:
    s = system("furuta-pendulum")
    (path,) = s.export(tmp_path / "furuta.js")
    x, dyn = state(s), s.compile()
    given = json.dumps([x[group].tolist() for group in ("q", "v", "u", "p")])
    code = f"const f = require('./{path.name}'); const g = {given};"
    code += "console.log(JSON.stringify([...f.furuta_forward(...g, 0), ...f.furuta_energy(...g, 0)]))"
    done = subprocess.run(["node", "-e", code], cwd=tmp_path, capture_output=True, text=True, check=True)
    expected = [*dyn.forward(x["q"], x["v"], x["u"], x["p"]), *dyn.energies(x["q"], x["v"], x["u"], x["p"])]
    np.testing.assert_allclose(json.loads(done.stdout), expected, rtol=1e-12)
    assert "theta1 [rad]" in path.read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_webassembly_is_exported_with_what_runs_it(tmp_path: pathlib.Path) -> None:
    s = system("furuta-pendulum")
    assert sorted(p.name for p in s.export(tmp_path / "furuta.wasm")) == ["furuta.js", "furuta.json", "furuta.wasm"]
    code = """const { lagrangianSolver, furuta } = require("./furuta.js"), fs = require("fs");
    const layout = JSON.parse(fs.readFileSync("furuta.json", "utf8"));
    lagrangianSolver.load(fs.readFileSync("furuta.wasm"), layout, furuta)
      .then((s) => console.log(JSON.stringify(Array.from(s.solve({t1: 1, samples: 2}).final))));"""
    done = subprocess.run(["node", "-e", code], cwd=tmp_path, capture_output=True, text=True, check=True)
    np.testing.assert_allclose(json.loads(done.stdout), s.simulate(1.0, samples=2).y[:, -1], rtol=1e-9)
    with pytest.raises(lg.RunError, match="cannot name a constant"):
        s.export(tmp_path / "class.wasm")


@pytest.mark.parametrize("name", ["x.f90", "x", "1x.c", "a b.py"])
def test_an_export_that_cannot_be_named_is_refused(name: str, tmp_path: pathlib.Path) -> None:
    with pytest.raises(lg.ModelError):
        pendulum().export(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ending", ["c", "py", "js"])
def test_a_long_name_of_an_export_is_a_name_all_the_same(tmp_path, ending) -> None:
    system = built_in.system("pendulum")
    files = system.export(tmp_path / f"{'a' * 60}.{ending}")
    assert f"{'a' * 60}_forward" in files[0].read_text()
    with pytest.raises(lg.ModelError, match="has 300 characters"):
        system.export(tmp_path / f"{'a' * 300}.{ending}")
