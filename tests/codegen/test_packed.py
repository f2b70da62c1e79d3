"""The loop for packed arrays gives, number for number, what one state at a time and the loop for any strides give."""

import numpy as np
import pytest

from lagrangian.codegen import compile
from lagrangian.errors import RunError
from lagrangian.graph import Graph, Output, Program


def mixed(sizes, outputs):
    """A program of groups a, b, c … and t with so many entries, every output a sum over all inputs, and some sines."""
    g = Graph()
    names = "abcdefg"[: len(sizes)]
    inputs = [g.input(name, k) for name, n in zip(names, sizes, strict=True) for k in range(n)]
    t = g.input("t", 0)
    made, number = {}, 0
    for j, n in enumerate(outputs):
        ids = []
        for _ in range(n):
            number += 1
            total = g.sin(g.add(inputs[number % len(inputs)], t))
            for k, x in enumerate(inputs):
                total = g.add(total, g.mul(g.const(float((k * number) % 7 + 1)), x))
            ids.append(total)
        made[f"y{j}"] = Output(tuple(ids), (n,))
    groups = {name: tuple(f"{name}{k}" for k in range(n)) for name, n in zip(names, sizes, strict=True)}
    return Program("mixed", g, {**groups, "t": ("t",)}, made, {})


SHAPES = [
    ((2, 2), (2,)),
    ((1,), (1,)),
    ((3, 4), (3, 1)),
    ((5, 6), (5,)),
    ((7, 8), (9,)),
    ((9, 0, 2), (4, 2)),
    ((17,), (5,)),
]


@pytest.mark.sampled(8)
@pytest.mark.parametrize("lanes", [2, 4, 8])
@pytest.mark.parametrize(("sizes", "outputs"), SHAPES)
def test_packed_rows_are_the_same_numbers(sizes, outputs, lanes):
    kernel = compile(mixed(sizes, outputs), optional={"t": 0.0}, lanes=lanes, threads=1, keep=False)
    assert kernel.build.short is not None
    rng = np.random.default_rng(4)
    for count in (lanes, 2 * lanes - 1, 2 * lanes, 2 * lanes + 1, 5 * lanes - 1, 6 * lanes, 50):
        packed = [rng.normal(size=(count, n)) for n in sizes]
        apart = [np.repeat(x, 2, axis=1)[:, ::2] for x in packed]  # the same numbers, two steps apart
        times = rng.normal(size=count)
        for t in (0.3, times):
            one, other = kernel(*packed, t), kernel(*apart, t)
            for name in kernel.program.outputs:
                found, expected = (x[name] if isinstance(x, dict) else x for x in (one, other))
                np.testing.assert_array_equal(found, expected)
                for k in (0, count // 2, count - 1):
                    single = kernel(*[x[k] for x in packed], np.ravel(t)[k % np.size(t)])
                    single = single[name] if isinstance(single, dict) else single
                    np.testing.assert_allclose(found[k], single, rtol=1e-13, atol=1e-13)


def test_one_row_for_all_states_is_repeated():
    kernel = compile(mixed((3, 5), (4,)), optional={"t": 0.0}, threads=1, keep=False)
    rng = np.random.default_rng(5)
    a, b = rng.normal(size=(40, 3)), rng.normal(size=5)
    np.testing.assert_array_equal(kernel(a, b), kernel(a, np.tile(b, (40, 1))))


@pytest.mark.sampled(3)
@pytest.mark.parametrize("where", [0, 7, 8, 15, 16, 23, 31, 32, 38, 39])
def test_the_first_state_that_is_not_finite_is_named(where):
    kernel = compile(mixed((2, 3), (2,)), optional={"t": 0.0}, threads=1, keep=False)
    a, b = np.ones((40, 2)), np.ones((40, 3))
    a[where, 1] = np.nan
    b[min(39, where + 3), 0] = np.inf
    with pytest.raises(RunError, match=rf"'a1' is nan at state {where}\b"):
        kernel(a, b)
    a[where, 1], b[min(39, where + 3), 0] = 1.0, 1.0
    a[where] = 1e308
    with pytest.raises(RunError, match=rf"too large to compute with: 1e\+308; .* at state {where}\b"):
        kernel(a, b)


def test_a_long_body_stays_a_function():
    kernel = compile(mixed((20, 20), (40,)), optional={"t": 0.0}, lanes=8, keep=False)
    assert kernel.build.short is None
