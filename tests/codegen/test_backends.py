"""Every back end against the graph's interpreter.

On programs made by hand to 1e-12, on random ones to their rounding.
"""

import ctypes
import dataclasses
import shutil
import subprocess

import numpy as np
import pytest
from compile_programs import Ambiguous, double_pendulum, flat, oracle, program, random_programs, rounding
from hypothesis import HealthCheck, assume, given
from hypothesis import strategies as st

from lagrangian.codegen import compile, native, to_c, to_numpy
from lagrangian.codegen.build import Build, Options
from lagrangian.codegen.kernel import Kernel
from lagrangian.graph import Scalar
from size import also_in_full, sized

HOST = native.host()
NUMBERS = st.floats(-4, 4, allow_subnormal=False)


def machine(made, **options):
    return compile(made, keep=False, **options)


def without_fma(made):
    build = Build(made, Options(4, keep=False), dataclasses.replace(HOST, fma=False, splat=False))
    return Kernel(build, optional={}, threads=1)


def python(made):
    """The NumPy source, run."""
    space = {}
    exec(to_numpy(made, name="f"), space)
    return lambda *groups: dict(zip(made.outputs, _tuple(space["f"](*groups)), strict=True))


def _tuple(x):
    return x if isinstance(x, tuple) else (x,)


@pytest.fixture(scope="session")
def c_function(tmp_path_factory):
    """The C source, compiled with every warning an error, as a function of groups."""
    folder = tmp_path_factory.mktemp("c")
    kept = []

    def build(made, compiler="gcc"):
        if shutil.which(compiler) is None:
            pytest.skip(f"{compiler} is not installed")
        name = f"f{len(kept)}"
        source, header = to_c(made, name=name)
        (folder / f"{name}.c").write_text(source)
        (folder / f"{name}.h").write_text(header)
        strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"]
        command = [compiler, *strict, "-O1", "-shared", "-fPIC", f"{name}.c", "-o", f"{name}.so", "-lm"]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr + source
        library = ctypes.CDLL(str(folder / f"{name}.so"))
        kept.append(library)

        def call(*groups):
            arrays = [np.ascontiguousarray(g, float).ravel() for g in groups]
            outs = {n: np.full(len(o.ids), np.nan) for n, o in made.outputs.items()}
            getattr(library, name)(*[ctypes.c_void_p(a.ctypes.data) for a in (*arrays, *outs.values())])
            return outs

        return call

    return build


# Random programs -------------------------------------------------------------------------------------------------


def bounded(made, inputs):
    """Exact values with error bounds, or a discarded example where rounding decides a condition."""
    try:
        pairs = rounding(made, inputs)
    except Ambiguous:
        assume(False)
    return pairs


def check(results, pairs):
    values = flat(results)
    assert len(values) == len(pairs)
    for value, (exact, error) in zip(values, pairs, strict=True):
        assert abs(value - exact) <= 2 * error + 1e-300, (value, exact, error)


def points(draw_q, draw_p, t):
    return {"q": draw_q, "p": draw_p, "t": [t]}


@pytest.mark.slow
@sized(60, 5, suppress_health_check=list(HealthCheck))
@given(random_programs(), st.lists(NUMBERS, min_size=3, max_size=3), st.lists(NUMBERS, min_size=2, max_size=2), NUMBERS)
def test_machine_code_of_random_programs(made, q, p, t):
    pairs = bounded(made, points(q, p, t))
    kernel = machine(made)
    single = kernel(np.array(q), np.array(p), t)
    check(single, pairs)
    batch = kernel(np.tile(q, (11, 1)), np.array(p), np.full(11, t))
    sweep = kernel(np.array(q), np.tile(p, (11, 1)), t)
    for name in made.outputs:  # scalar code, lanes and a parameter set per lane round alike
        assert np.array_equal(batch[name], np.broadcast_to(single[name], batch[name].shape))
        assert np.array_equal(sweep[name], batch[name])


@sized(20, 4, suppress_health_check=list(HealthCheck))
@given(random_programs(), st.lists(NUMBERS, min_size=3, max_size=3), st.lists(NUMBERS, min_size=2, max_size=2), NUMBERS)
def test_machine_code_without_fused_operations(made, q, p, t):
    pairs = bounded(made, points(q, p, t))
    kernel = without_fma(made)
    single = kernel(np.array(q), np.array(p), t)
    check(single, pairs)
    batch = kernel(np.tile(q, (5, 1)), np.array(p), t)
    assert all(np.array_equal(batch[n], np.broadcast_to(single[n], batch[n].shape)) for n in made.outputs)


@sized(20, 4, suppress_health_check=list(HealthCheck))
@given(random_programs(), st.lists(NUMBERS, min_size=3, max_size=3), st.lists(NUMBERS, min_size=2, max_size=2), NUMBERS)
def test_machine_code_in_short_pieces(made, q, p, t):
    pairs = bounded(made, points(q, p, t))
    kernel = Kernel(Build(made, Options(HOST.lanes, chunk=4, keep=False), HOST), optional={}, threads=1)
    check(kernel(np.array(q), np.array(p), t), pairs)
    batch = kernel(np.tile(q, (9, 1)), np.array(p), t)
    check({n: b[4] for n, b in batch.items()}, pairs)


@pytest.mark.slow
@sized(60, 12, suppress_health_check=list(HealthCheck))
@given(random_programs(), st.lists(NUMBERS, min_size=3, max_size=3), st.lists(NUMBERS, min_size=2, max_size=2), NUMBERS)
def test_numpy_source_of_random_programs(made, q, p, t):
    pairs = bounded(made, points(q, p, t))
    run = python(made)
    check(run(q, p, t), pairs)
    many = run(np.tile(q, (2, 3, 1)), p, t)
    check({n: a[1, 2] for n, a in many.items()}, pairs)


@pytest.mark.slow
@also_in_full
def test_c_source_of_random_programs(c_function):
    @sized(25, 6, suppress_health_check=list(HealthCheck))
    @given(
        random_programs(), st.lists(NUMBERS, min_size=3, max_size=3), st.lists(NUMBERS, min_size=2, max_size=2), NUMBERS
    )
    def run(made, q, p, t):
        pairs = bounded(made, points(q, p, t))
        check(c_function(made)(q, p, [t]), pairs)

    run()


# Programs made by hand -------------------------------------------------------------------------------------------

PENDULUM = double_pendulum()
P = np.array([1.0, 2.0, 0.7, 0.9, 9.81])


def pendulum_states(count):
    random = np.random.default_rng(1)
    return random.uniform(-3, 3, (count, 2)), random.uniform(-3, 3, (count, 2)), random.uniform(-5, 5, (count, 1))


def expected(q, v, u, p=P):
    rows = [oracle(PENDULUM, {"q": a, "v": b, "u": c, "p": p, "t": [0.0]}) for a, b, c in zip(q, v, u, strict=True)]
    return np.array(rows)


@pytest.mark.parametrize("lanes", [1, 2, 4, 8])
def test_double_pendulum_in_any_number_of_lanes(lanes):
    q, v, u = pendulum_states(37)
    kernel = machine(PENDULUM, lanes=lanes, optional={"t": 0.0})
    np.testing.assert_allclose(kernel(q, v, u), expected(q, v, u), rtol=1e-12)
    np.testing.assert_array_equal(kernel(q, v, u)[5], kernel(q[5], v[5], u[5]))


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_double_pendulum_in_c(c_function, compiler):
    q, v, u = pendulum_states(20)
    call = c_function(PENDULUM, compiler)
    got = [call(a, b, c, P, [0.0])["acc"] for a, b, c in zip(q, v, u, strict=True)]
    np.testing.assert_allclose(got, expected(q, v, u), rtol=1e-12)


def test_double_pendulum_in_numpy():
    q, v, u = pendulum_states(20)
    run = python(PENDULUM)
    np.testing.assert_allclose(run(q, v, u, P, 0.0)["acc"], expected(q, v, u), rtol=1e-12)
    assert run(q.reshape(4, 5, 2), v.reshape(4, 5, 2), u.reshape(4, 5, 1), P, 0.0)["acc"].shape == (4, 5, 2)


def test_numpy_source_runs_alone(tmp_path):
    """In a fresh interpreter without this package on its path."""
    file = tmp_path / "pendulum.py"
    file.write_text(
        to_numpy(PENDULUM, name="acc") + "\nprint(repr(acc([0.1, 0.2], [0, 0], [0], PARAMETERS, 0.0).tolist()))\n"
    )
    import sys

    done = subprocess.run([sys.executable, "-I", str(file)], capture_output=True, text=True, check=True)
    want = oracle(PENDULUM, {"q": [0.1, 0.2], "v": [0, 0], "u": [0], "p": P, "t": [0.0]})
    np.testing.assert_allclose(np.array(done.stdout.strip("[]\n").split(","), float), want, rtol=1e-12)


def every_function(graph, x):
    a, b, c = x["a"], x["b"], x["c"]
    inside = a / (1.0 + a * a)
    rows = [inside.apply(f) for f in ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh")]
    rows += [inside.apply("atanh"), (1.5 + a * a).apply("acosh"), b.apply("exp"), (a * a + 0.1).apply("log")]
    rows += [abs(b), b.apply("sign"), b.apply("atan2", a), a.apply("min", b), a.apply("max", b)]
    rows += [(a * a).apply("sqrt"), (a * a + 1.0) ** -3, (a * a) ** 1.5, (a * a + 0.5) ** -2.5, (a * a + 0.5) ** b]
    rows += [(1.0 + 0.001 * a * a) ** 100, a / c, b / c, a / 3.0, c * 2.0, c, b, a - a + 7.0]
    return {"f": rows}


@pytest.mark.slow
def test_every_function_by_hand(c_function):
    made = program(every_function, q=("a", "b"), p=("c",))
    random = np.random.default_rng(2)
    q, p = random.uniform(-3, 3, (40, 2)), np.array([1.7])
    want = np.array([oracle(made, {"q": row, "p": p}) for row in q])
    np.testing.assert_allclose(machine(made)(q, p), want, rtol=1e-12)
    np.testing.assert_allclose(machine(made)(q, np.tile(p, (40, 1))), want, rtol=1e-12)
    np.testing.assert_allclose(without_fma(made)(q, p), want, rtol=1e-12)
    np.testing.assert_allclose(python(made)(q, p)["f"], want, rtol=1e-12)
    call = c_function(made)
    np.testing.assert_allclose([call(row, p)["f"] for row in q], want, rtol=1e-12)


@pytest.mark.sampled(2)
@pytest.mark.skipif(not HOST.triple.startswith("x86_64"), reason="these are generations of x86-64")
@pytest.mark.parametrize(("cpu", "lanes", "fma"), [("x86-64", 2, False), ("x86-64-v3", 4, True)])
def test_older_processors(cpu, lanes, fma):
    """Code for the first and the third generation, run here: nothing in it needs the widest registers."""
    if lanes > HOST.lanes or fma > HOST.fma:
        pytest.skip("this processor is older")
    target = dataclasses.replace(HOST, cpu=cpu, features="", lanes=lanes, fma=fma)
    made = program(every_function, q=("a", "b"), p=("c",))
    kernel = Kernel(Build(made, Options(lanes, keep=False), target), optional={}, threads=1)
    q, p = np.random.default_rng(4).uniform(-3, 3, (21, 2)), np.array([1.7])
    want = np.array([oracle(made, {"q": row, "p": p}) for row in q])
    np.testing.assert_allclose(kernel(q, p), want, rtol=1e-12)
    np.testing.assert_allclose(kernel(q[3], p), want[3], rtol=1e-12)
    np.testing.assert_allclose(kernel(q, np.tile(p, (21, 1))), want, rtol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("triple", "cpu", "lanes"),
    [
        ("aarch64-unknown-linux-gnu", "", 2),
        ("x86_64-pc-windows-msvc-elf", "x86-64-v3", 4),
        ("x86_64-unknown-linux-gnu", "x86-64-v4", 8),
    ],
)
def test_object_code_asks_nobody_for_a_symbol(tmp_path, triple, cpu, lanes):
    """No linker has to find a C library: on no system is there a name left to resolve."""
    if shutil.which("nm") is None:
        pytest.skip("nm is not installed")
    native.llvm.initialize_all_targets()
    native.llvm.initialize_all_asmprinters()
    target = dataclasses.replace(HOST, triple=triple, cpu=cpu, features="", lanes=lanes, fma=True)
    build = Build(program(every_function, q=("a", "b"), p=("c",)), Options(lanes, keep=False), target)
    for kind in ("single", "batch", "sweep"):
        (tmp_path / "x.o").write_bytes(native.object_code(build.text(kind), target, 2))
        done = subprocess.run(["nm", "-u", "x.o"], cwd=tmp_path, capture_output=True, text=True, check=True)
        assert not done.stdout.split()


def long_chain(links=400):
    """A recursion with one sine and some products a link, and values that reach across the whole program."""

    def build(graph, x):
        total, early = x["a"], []
        for k in range(links):
            s, c = (total + 0.01 * k).apply("sin"), (total + 0.01 * k).apply("cos")
            total = 0.3 * total + s * x["b"] - 0.2 * c * c + x["k"] * 0.1
            early.append(total)
        for value in reversed(early):
            total = 0.5 * total + value * x["b"]
        return {"f": [total, early[0], x["k"], x["a"]]}

    return program(build, q=("a", "b"), p=("k",))


@pytest.mark.slow
def test_long_programs_are_cut_into_functions(c_function):
    made = long_chain()
    q, p = np.array([[0.3, 0.5], [-1.0, 0.2], [0.1, -0.4]]), np.array([0.6])
    want = np.array([oracle(made, {"q": row, "p": p}) for row in q])
    kernel = machine(made)
    assert "body_1_2" in kernel.build.text("single")
    np.testing.assert_allclose(kernel(q, p), want, rtol=1e-12)
    np.testing.assert_allclose(kernel(q[0], p), want[0], rtol=1e-12)
    source, _ = to_c(made, name="f")
    assert "part_2" in source
    call = c_function(made)
    np.testing.assert_allclose([call(row, p)["f"] for row in q], want, rtol=1e-12)


def test_what_depends_on_parameters_alone_runs_once():
    kernel = machine(PENDULUM)
    body, prologue = kernel.build.lowered.body, kernel.build.lowered.prologue
    assert prologue.operations >= 6  # (m1+m2)·l1², m2·l2², gravity's torques, …
    assert not any(op[0] == "div" for op in prologue.ops)
    assert body.operations + prologue.operations <= 60


def test_matrices_and_lone_numbers():
    made = program(
        lambda g, x: {"M": [[x["a"], x["a"] * x["b"]], [x["b"] * x["a"], x["b"]]], "e": x["a"] + x["b"]}, q=("a", "b")
    )
    kernel = machine(made)
    one = kernel(np.array([2.0, 3.0]))
    assert one["M"].tolist() == [[2.0, 6.0], [6.0, 3.0]]
    assert one["e"] == 5.0
    many = kernel(np.full((2, 5, 2), 2.0))
    assert many["M"].shape == (2, 5, 2, 2)
    assert many["e"].shape == (2, 5)
    assert python(made)(np.full((2, 5, 2), 2.0))["M"].shape == (2, 5, 2, 2)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("n", [1, 2, 3, 5, 6, 7, 8, 9, 12, 15, 17, 31])
@pytest.mark.parametrize("lanes", [1, 2, 4, 8])
def test_rows_of_any_length_are_transposed(n, lanes):
    """Each output is one input: only the moves between arrays and blocks are tested."""
    names = tuple(f"x{k}" for k in range(n))
    made = program(lambda g, x: {"f": [x[k] for k in reversed(names)]}, q=names)
    kernel = machine(made, lanes=lanes)
    a = np.random.default_rng(n).normal(size=(23, n))
    np.testing.assert_array_equal(kernel(a), a[:, ::-1])
    np.testing.assert_array_equal(kernel(np.asfortranarray(a)), a[:, ::-1])
    np.testing.assert_array_equal(kernel(a[:3]), a[:3, ::-1])
    wide = np.random.default_rng(n).normal(size=(23, 2 * n))
    np.testing.assert_array_equal(kernel(wide[::-2, ::2]), wide[::-2, ::2][:, ::-1])


# Hostile names -----------------------------------------------------------------------------------------------------

NASTY = (
    "*/ int x; /*",
    "int",
    'a"; import os; os.system("true") #',
    "new\nline",
    "θ\u202e1",
    "back\\",
    "??/",
    "in_q",
    "x" * 500,
)


def test_names_never_become_code(c_function):
    made = program(lambda g, x: {"out": [x[n] * 2.0 for n in NASTY]}, q=NASTY, p=("*/", "x0"))
    made = dataclasses.replace(made, name='evil */ "\n', defaults={"*/": 1.0, "x0": None})
    q = np.arange(1.0, len(NASTY) + 1)
    np.testing.assert_array_equal(c_function(made)(q, [1.0, 2.0])["out"], 2 * q)
    np.testing.assert_array_equal(python(made)(q, [1.0, 2.0])["out"], 2 * q)
    for text in (*to_c(made), to_numpy(made)):
        assert text.isascii()
        assert "os.system" not in text.replace("os.system(_true_)", "")


def test_exported_functions_may_be_named():
    source, header = to_c(PENDULUM, name="pendulum_step")
    assert "void pendulum_step(" in header
    assert "#ifndef PENDULUM_STEP_H" in header
    assert '#include "pendulum_step.h"' in source
    assert "def lag(" in to_numpy(PENDULUM, name="lag")
    with pytest.raises(ValueError, match="plain C identifier"):
        to_c(PENDULUM, name="a b")
    with pytest.raises(ValueError, match="cannot name"):
        to_numpy(PENDULUM, name="class")


def test_what_depends_on_no_input_is_part_of_exported_source(c_function):
    """sinh 800 is no double, so that it is left to the machine; a source has no prologue to hold it."""
    made = program(lambda g, x: {"f": x["a"] / Scalar(g, g.sinh(g.const(800.0)))}, q=("a",))
    assert c_function(made)(np.array([2.0]))["f"] == 0.0
