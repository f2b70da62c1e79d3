"""The elementary functions in machine code, against mpmath."""

import ctypes
import dataclasses
import math
import pathlib
import runpy

import mpmath
import numpy as np
import pytest

import size
from lagrangian.codegen import elementary, native
from lagrangian.codegen.ir import Function, Module


def _loop(f, count, results):
    """Close ``f``, whose lines turn %x, %y into ``results``, into a loop over blocks of ``lanes`` numbers."""
    lanes = f.lanes
    size = f"<{lanes} x double>" if lanes > 1 else "double"
    head = ["br label %loop", "loop:", "%k = phi i64 [0, %entry], [%next, %loop]"]
    for name in ("x", "y")[:count]:
        head += [
            f"%p{name} = getelementptr {size}, ptr %{name}s, i64 %k",
            f"%{name} = load {size}, ptr %p{name}, align 8",
        ]
    tail = []
    for j, result in enumerate(results):
        tail += [f"%o{j} = getelementptr {size}, ptr %out{j}, i64 %k", f"store {size} {result}, ptr %o{j}, align 8"]
    tail += ["%next = add i64 %k, 1", "%go = icmp slt i64 %next, %n", "br i1 %go, label %loop, label %end"]
    f.lines = ["  " + line for line in head] + f.lines + ["  " + line for line in tail] + ["end:", "  ret void"]
    f.finish("apply", "void", "ptr %xs, ptr %ys, ptr %out0, ptr %out1, i64 %n")


_kept = []


def compiled(name, lanes, target):
    """A function of arrays (x, y) → (first result, second result or None)."""
    module = Module(target)
    f = Function(module, lanes)
    if name == "sincos":
        symbol = elementary.sincos(module, lanes)
        pair = f.put(f"call {{ {f.real}, {f.real} }} {symbol}({f.real} %x)")
        results = [f.put(f"extractvalue {{ {f.real}, {f.real} }} {pair}, {k}") for k in (0, 1)]
        count = 1
    else:
        symbol = elementary.function(module, name, lanes)
        count = 2 if name in ("atan2", "pow") else 1
        passed = ", ".join(f"{f.real} %{a}" for a in ("x", "y")[:count])
        results = [f.put(f"call {f.real} {symbol}({passed})")]
    _loop(f, count, results)
    loaded = native.Loaded(native.object_code(module.text(), target, 2), target)
    _kept.append(loaded)
    call = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4, ctypes.c_int64)(loaded.address("apply"))

    def run(x, y=None):
        x = np.asarray(x, float)
        size = -(-len(x) // lanes) * lanes
        xs, ys = np.ones(size), np.ones(size)
        xs[: len(x)] = x
        if y is not None:
            ys[: len(x)] = y
        first, second = np.empty(size), np.empty(size)
        call(xs.ctypes.data, ys.ctypes.data, first.ctypes.data, second.ctypes.data, size // lanes)
        return first[: len(x)], second[: len(x)]

    return run


def ulps(value, exact):
    """How far ``value`` is from the exact mpmath number, in units of the last place of the exact one."""
    if mpmath.isnan(exact):
        return 0.0 if math.isnan(value) else math.inf
    if mpmath.isinf(exact) or abs(exact) > mpmath.mpf(2) ** 1024 * (1 - mpmath.mpf(2) ** -54):
        return 0.0 if value == math.copysign(math.inf, float(mpmath.sign(exact))) else math.inf
    if not math.isfinite(value):
        return math.inf
    scale = max(mpmath.floor(mpmath.log(abs(exact), 2)) if exact else -1074, -1022)
    return float(abs(mpmath.mpf(float(value)) - exact) / mpmath.mpf(2) ** (scale - 52))


HOST = native.host()
PLAIN = dataclasses.replace(HOST, fma=False)
TARGETS = [(1, HOST), (2, HOST), (HOST.lanes, HOST), (1, PLAIN), (HOST.lanes, PLAIN)]


@pytest.fixture(params=TARGETS, ids=lambda p: f"{p[0]} lanes, {'fma' if p[1].fma else 'no fma'}")
def lanes_target(request):
    return request.param


def hard_angles():
    """Random angles of every size, and the doubles next to multiples of π/2, where reduction cancels."""
    random = np.random.default_rng(7)
    many = 10 if size.FULL else 1
    wide = random.uniform(-1e6, 1e6, 150 * many)
    small = random.uniform(-10, 10, 150 * many)
    spread = np.exp(random.uniform(-700, math.log(1e6), 50 * many)) * random.choice([-1.0, 1.0], 50 * many)
    n = np.concatenate([np.arange(1, 30 * many), random.integers(1, 636619, 120 * many)])
    with mpmath.workdps(40):
        near = np.array([float(int(k) * mpmath.pi / 2) for k in n])
        eighths = np.array([float((int(k) - mpmath.mpf(1) / 2) * mpmath.pi / 2) for k in n])
    return np.concatenate(
        [wide, small, spread, near, np.nextafter(near, 0), eighths, np.nextafter(eighths, 9e9), [0.0]]
    )


def worst_of(run, arguments, *exact, digits=60):
    with mpmath.workdps(digits):
        results = run(*arguments)
        lists = [[float(v) for v in a] for a in arguments]
        return [
            max(ulps(value, f(*point)) for value, *point in zip(result, *lists, strict=True))
            for result, f in zip(results, exact, strict=False)
        ]


@size.also_in_full
def test_sincos_is_within_two_ulp(lanes_target):
    run = compiled("sincos", *lanes_target)
    worst = worst_of(run, [hard_angles()], mpmath.sin, mpmath.cos)
    assert max(worst) <= 2.0, worst


def test_the_double_hardest_to_reduce_below_a_million():
    """Continued fractions of π/2 give the doubles m·2^e closest to a multiple of π/2: all of them, all exponents."""
    hard = []
    with mpmath.workdps(80):
        for e in range(-53, -32):
            ratio = mpmath.pi / 2 / mpmath.mpf(2) ** e
            a, b, c, d = 0, 1, 1, 0  # convergents h/k of ratio
            rest = ratio
            for _ in range(60):
                whole = int(mpmath.floor(rest))
                a, b, c, d = c, d, whole * c + a, whole * d + b
                if c >= 2**53:
                    break
                if c >= 2**52:
                    hard.append(math.ldexp(c, e))
                rest = 1 / (rest - whole)
    hard = np.array([x for x in hard if x < 1e6])
    assert len(hard) >= 5
    for lanes in (1, HOST.lanes):
        assert max(worst_of(compiled("sincos", lanes, HOST), [hard], mpmath.sin, mpmath.cos)) <= 2.0


def test_sincos_of_huge_infinite_and_missing_arguments(lanes_target):
    run = compiled("sincos", *lanes_target)
    huge = np.array(
        [1e7, -1e9, 2.0**30, np.nextafter(2.0**30, 9e99), 1e15, 6381956970095103.0 * 2.0**797, 1e300, -1.7e308]
    )
    # the last but two is the double closest to a multiple of π/2 of all; glibc itself is 8 ulp off there
    assert max(worst_of(run, [huge], mpmath.sin, mpmath.cos, digits=360)) <= 10.0
    s, c = run(np.array([math.inf, -math.inf, math.nan, 0.5]))
    assert np.isnan(s[:3]).all()
    assert np.isnan(c[:3]).all()
    assert s[3] == pytest.approx(math.sin(0.5), rel=1e-15)


RANGES = {
    "exp": (-745.0, 709.5, 1.5),
    "log": (1e-300, 1e300, 1.5),
    "atan": (-50.0, 50.0, 3),
    "asin": (-1.0, 1.0, 4),
    "acos": (-1.0, 1.0, 4),
    "sinh": (-710.0, 710.0, 3),
    "cosh": (-710.0, 710.0, 3),
    "tanh": (-20.0, 20.0, 4),
    "asinh": (-20.0, 20.0, 4),
    "acosh": (1.0, 20.0, 4),
    "atanh": (-0.999, 0.999, 4),
}


@pytest.mark.sampled(12)
@pytest.mark.parametrize("name", RANGES)
def test_other_functions_are_within_a_few_ulp(name, lanes_target):
    low, high, bound = RANGES[name]
    random = np.random.default_rng(3)
    x = random.uniform(low, high, 400)
    if name == "log":
        x = np.concatenate([np.exp(random.uniform(-700, 700, 300)), random.uniform(0.5, 2, 300), [5e-324, 1e-310, 1.0]])
    elif name == "exp":
        x = np.concatenate([x, random.uniform(-1, 1, 200), [0.0, 1e-300, -1e-20]])
    elif name not in ("acosh",):
        x = np.concatenate([x, random.uniform(low, high, 200) ** 5 / max(1, high) ** 4, [1e-200, 1e-9, -1e-5]])
    assert worst_of(compiled(name, *lanes_target), [x], getattr(mpmath, name))[0] <= bound


def test_atan2_all_round(lanes_target):
    random = np.random.default_rng(5)
    x, y = (random.normal(size=600) * 10.0 ** random.uniform(-8, 8, 600) for _ in range(2))
    assert worst_of(compiled("atan2", *lanes_target), [y, x], mpmath.atan2)[0] <= 3


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["exp", "log", "atan", "asin", "acos", "sinh", "cosh", "tanh"])
def test_ends_of_the_range_as_the_c_library(name, lanes_target):
    x = np.array([0.0, -0.0, 1.0, -1.0, 2.0, -2.0, 710.4, -710.4, 800.0, -800.0, math.inf, -math.inf, math.nan])
    with np.errstate(all="ignore"):
        expected = getattr(np, {"asin": "arcsin", "acos": "arccos", "atan": "arctan"}.get(name, name))(x)
    np.testing.assert_allclose(compiled(name, *lanes_target)(x)[0], expected, rtol=4e-16, atol=0)


def test_atan2_at_zeros_and_infinities_as_the_c_library(lanes_target):
    ends = [0.0, -0.0, 1.0, -1.0, 1e308, 5e-324, math.inf, -math.inf, math.nan]
    y, x = (np.ravel(a) for a in np.meshgrid(ends, ends))
    got = compiled("atan2", *lanes_target)(y, x)[0]
    np.testing.assert_allclose(got, np.arctan2(y, x), rtol=4e-16, atol=0)
    assert np.array_equal(np.signbit(got)[~np.isnan(got)], np.signbit(np.arctan2(y, x))[~np.isnan(got)])


def test_pow_calls_the_c_library(lanes_target):
    x, y = np.array([2.0, 0.5, 10.0, 0.0]), np.array([0.5, -3.0, 300.0, 2.0])
    np.testing.assert_allclose(compiled("pow", *lanes_target)(x, y)[0], x**y, rtol=1e-15)


def test_the_digits_are_those_of_remez_exchange():
    """A polynomial's greatest error, in 60 digits, against half an ulp of the result it goes into."""
    minimax = runpy.run_path(str(pathlib.Path(__file__).parents[2] / "tools" / "minimax.py"))
    with mpmath.workdps(minimax["DIGITS"]):
        for name, (f, weight, a, b, degree) in minimax["targets"]().items():
            digits = list(getattr(elementary, name))
            assert len(digits) == degree + 1
            exact = [mpmath.mpf(c) for c in digits]
            grid = [a + (b * (1 + mpmath.mpf(10) ** -6) - a) * k / 400 for k in range(1, 400)]
            assert max(abs(weight(x) * (f(x) - minimax["horner"](exact, x))) for x in grid) < 2.0**-56
