"""What a kernel accepts, refuses and promises, whatever program it holds."""

import gc
import os
import pickle
import threading
from fractions import Fraction

import numpy as np
import pytest
import sympy
from compile_programs import double_pendulum, oracle, program

from lagrangian.codegen import Kernel, compile, workers
from lagrangian.errors import RunError

PENDULUM = double_pendulum()
BARE = double_pendulum()
P = {"m1": 1.0, "m2": 2.0, "l1": 0.7, "l2": 0.9, "g": 9.81}
BARE = type(BARE)("bare", BARE.graph, BARE.inputs, BARE.outputs, {})  # parameters without values
OPTIONAL = {"u": 0.0, "t": 0.0}


@pytest.fixture(scope="module")
def kernel():
    return compile(PENDULUM, optional=OPTIONAL, keep=False)


@pytest.fixture(scope="module")
def bare():
    return compile(BARE, optional=OPTIONAL, keep=False)


def states(*lead):
    random = np.random.default_rng(0)
    return random.uniform(-2, 2, (*lead, 2)), random.uniform(-2, 2, (*lead, 2))


def expected(q, v, u=0.0, p=P):
    return oracle(PENDULUM, {"q": q, "v": v, "u": [u], "p": list(p.values()), "t": [0.0]})


# Shapes ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("lead", [(), (1,), (3,), (8,), (100,), (2, 5), (3, 1, 4), (0,), (4, 0, 2)])
def test_any_leading_shape(kernel, lead):
    q, v = states(*lead)
    a = kernel(q, v)
    assert a.shape == (*lead, 2)
    for index in np.ndindex(*lead):
        np.testing.assert_allclose(a[index], expected(q[index], v[index]), rtol=1e-12)


def test_leading_shapes_are_broadcast(kernel):
    q, v = states(4, 1)[0], states(1, 3)[1]
    u = np.array([0.5])
    a = kernel(q, v, u)
    assert a.shape == (4, 3, 2)
    np.testing.assert_allclose(a[2, 1], expected(q[2, 0], v[0, 1], 0.5), rtol=1e-12)
    assert kernel(q[0, 0], v, t=np.linspace(0, 1, 3)).shape == (1, 3, 2)


def test_repeated_single_calls_do_not_share_results(kernel):
    q, v = states(2)
    first = kernel(q[0], v[0])
    kept = first.copy()
    second = kernel(q[1], v[1])
    np.testing.assert_array_equal(first, kept)
    assert not np.array_equal(first, second)


def test_calls_leave_nothing_behind(kernel):
    q, v = states()
    for _ in range(50):
        kernel(q.tolist(), v.tolist())
        kernel(q, v)
        with pytest.raises(RunError):
            kernel(q * np.nan, v)
    assert len(kernel._quick.stages) <= 2


def test_omitted_groups_take_their_value_again_after_being_given(kernel):
    q, v = states()
    plain = kernel(q, v)
    pushed = kernel(q, v, np.array([3.0]))
    assert not np.array_equal(plain, pushed)
    np.testing.assert_array_equal(kernel(q, v), plain)
    other = kernel(q, v, None, np.array([1.0, 2.0, 0.7, 0.9, 1.62]))
    assert not np.array_equal(other, plain)
    np.testing.assert_array_equal(kernel(q, v), plain)
    np.testing.assert_array_equal(kernel(q, v, None, np.array([1.0, 2.0, 0.7, 0.9, 1.62])), other)


@pytest.mark.parametrize(
    "change",
    [
        np.asfortranarray,
        lambda a: a[::-1][::-1],
        lambda a: np.repeat(a, 3, axis=0)[::3],
        lambda a: np.stack([a, a], axis=-1)[..., 0],
        lambda a: a.astype(">f8"),
        lambda a: a.tolist(),
        lambda a: np.frombuffer(b"x" + a.tobytes(), np.uint8)[1:].view(np.float64).reshape(a.shape),
    ],
)
def test_any_strides_and_byte_orders(kernel, change):
    q, v = states(19)
    np.testing.assert_array_equal(kernel(change(q), change(v)), kernel(q, v))
    np.testing.assert_array_equal(kernel(change(q)[3], change(v)[3]), kernel(q[3], v[3]))


def test_read_only_inputs_and_inputs_left_alone(kernel):
    q, v = states(20)
    before = q.copy(), v.copy()
    q.flags.writeable = v.flags.writeable = False
    kernel(q, v)
    kernel(q[0], v[0])
    np.testing.assert_array_equal(q, before[0])
    np.testing.assert_array_equal(v, before[1])


@pytest.mark.parametrize("convert", [np.float32, np.float16, np.int64, np.int8, np.uint64])
def test_narrower_numbers_are_widened(kernel, convert):
    q = np.array([[1, 2], [3, 1]]).astype(convert)
    np.testing.assert_array_equal(kernel(q, q), kernel(q.astype(float), q.astype(float)))


def test_exact_numbers_are_accepted(kernel):
    q = [sympy.pi / 4, Fraction(1, 3)]
    np.testing.assert_allclose(kernel(q, [0, 0]), expected([np.pi / 4, 1 / 3], [0, 0]), rtol=1e-12)


def test_one_entry_groups_take_plain_numbers(kernel):
    q, v = states()
    np.testing.assert_array_equal(kernel(q, v, 2.0), kernel(q, v, [2.0]))
    np.testing.assert_array_equal(kernel(q, v, 2, None, 0), kernel(q, v, [2.0], None, 0.0))


def test_an_only_coordinate_may_be_called_like_its_group():
    k = compile(program(lambda g, x: {"a": [x["q"] * x["t"]]}, q=("q",), t=("t",)), keep=False)
    assert k(np.array([2.0]), 3.0).tolist() == [6.0]
    assert k(np.array([[2.0], [3.0]]), np.array([1.0, 2.0])).tolist() == [[2.0], [6.0]]
    with pytest.raises(RunError, match="q has 2 values"):
        k(np.array([2.0, 3.0]), 3.0)


def test_a_lone_number_comes_back_as_a_number():
    k = compile(program(lambda g, x: {"e": x["a"] * x["b"]}, q=("a", "b")), keep=False)
    assert k([2.0, 3.0]) == 6.0
    assert k(np.array([2.0, 3.0])) == 6.0
    assert k(np.ones((5, 2))).shape == (5,)


# out ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "layout", [lambda s: np.empty(s), lambda s: np.empty(s[::-1]).T, lambda s: np.empty((*s, 2))[..., 1]]
)
def test_out_is_written_and_returned(kernel, layout):
    for lead in [(), (3,), (4, 5)]:
        q, v = states(*lead)
        out = layout((*lead, 2))
        assert kernel(q, v, out=out) is out
        np.testing.assert_array_equal(out, kernel(q, v))


def test_out_may_be_an_input(kernel):
    q, v = states(33)
    want = kernel(q, v)
    kernel(q, v, out=v)
    np.testing.assert_array_equal(v, want)


@pytest.mark.parametrize("out", [np.empty((5, 2)), np.empty((4, 2), np.float32), np.empty((4, 3)), [[0, 0]] * 4, "x"])
def test_out_that_does_not_fit(kernel, out):
    with pytest.raises(RunError, match="out"):
        kernel(*states(4), out=out)
    readonly = np.empty((4, 2))
    readonly.flags.writeable = False
    with pytest.raises(RunError, match="writable"):
        kernel(*states(4), out=readonly)


def test_a_prepared_call_reads_its_arrays_anew(kernel):
    q, v = states(30)
    out = np.empty((30, 2))
    batch = kernel.prepared(q, v, out=out)
    assert batch() is out
    np.testing.assert_array_equal(out, kernel(q, v))
    q *= -0.5
    batch()
    np.testing.assert_array_equal(out, kernel(q, v))
    q[17, 1] = np.nan
    with pytest.raises(RunError, match="coordinate 'b' is nan at state 17"):
        batch()
    own = kernel.prepared(v, v, p={"g": 1.0})
    np.testing.assert_array_equal(own(), kernel(v, v, p={"g": 1.0}))
    assert own() is own() or np.shares_memory(own(), own())


@pytest.mark.slow
def test_a_prepared_call_keeps_its_code():
    q, v = states(30)
    batch = compile(PENDULUM, optional=OPTIONAL, keep=False).prepared(q, v)
    gc.collect()
    np.testing.assert_array_equal(batch(), compile(PENDULUM, optional=OPTIONAL, keep=False)(q, v))


def test_a_prepared_call_with_an_empty_group():
    k = compile(program(lambda g, x: {"f": [x["a"]]}, q=("a",), u=()), keep=False)
    assert k.prepared(np.ones((20, 1)), np.ones((20, 0)))().shape == (20, 1)


def test_a_prepared_call_copies_nothing(kernel):
    q, v = states(30)
    kernel.prepared(q[::2], v[:15])()
    kernel.prepared(q[0], v)()
    for wrong in (q[:3], q.astype(np.float32), np.zeros((2, 3, 30, 2)).transpose(1, 2, 0, 3)):
        with pytest.raises(RunError, match="'q' cannot be read in place"):
            kernel.prepared(wrong, v[0])


# Parameters --------------------------------------------------------------------------------------------------------


def test_parameters_by_name_in_order_and_by_default(kernel, bare):
    q, v = states(12)
    want = kernel(q, v)
    for p in (P, list(P.values()), np.array(list(P.values())), dict(reversed(P.items()))):
        np.testing.assert_array_equal(kernel(q, v, p=p), want)
        np.testing.assert_array_equal(bare(q, v, p=p), want)
        np.testing.assert_array_equal(bare(q[3], v[3], p=p), want[3])
    moon = kernel(q, v, p={"g": 1.62})
    np.testing.assert_allclose(moon[0], expected(q[0], v[0], p=P | {"g": 1.62}), rtol=1e-12)


def test_symbols_name_parameters(kernel):
    q, v = states()
    np.testing.assert_array_equal(kernel(q, v, p={sympy.Symbol("g"): 1.62}), kernel(q, v, p={"g": 1.62}))


def test_a_parameter_set_for_every_state(kernel):
    q, v = states(21)
    g = np.linspace(0, 20, 21)
    swept = kernel(q, v, p={"g": g})
    for k in (0, 7, 20):
        np.testing.assert_array_equal(swept[k], kernel(q[k], v[k], p={"g": g[k]}))
    grid = kernel(q[0], v[0], p={"g": g[:, None], "m1": np.array([1.0, 2.0])})
    assert grid.shape == (21, 2, 2)
    np.testing.assert_array_equal(grid[4, 1], kernel(q[0], v[0], p={"g": g[4], "m1": 2.0}))
    array = np.tile(list(P.values()), (21, 1))
    np.testing.assert_array_equal(kernel(q, v, p=array), kernel(q, v))


def test_many_parameter_sets_are_not_all_kept(kernel):
    q, v = states()
    for g in np.linspace(1, 2, 200):
        np.testing.assert_allclose(kernel(q, v, p={"g": g}), expected(q, v, p=P | {"g": g}), rtol=1e-12)
    assert len(kernel._blocks) <= 64


@pytest.mark.parametrize(
    ("p", "message"),
    [
        ({"lenght": 1.0}, "unknown parameter 'lenght'"),
        ({"mm1": 1.0}, "Did you mean 'm1'"),
        ({"g": float("nan")}, "parameter 'g' is nan"),
        ({"g": -np.inf}, "parameter 'g' is -inf"),
        ({"g": [1.0, np.nan, 2.0]}, r"parameter 'g' is nan at state 1"),
        ({"g": "9.81"}, "parameter 'g' must be real numbers"),
        ({"g": 1j}, "must be real"),
        ({"g": [1.0, 2.0], "m1": [1.0, 2.0, 3.0]}, "do not fit together"),
        ([1.0, 2.0], "p has 2 values"),
        (3.0, "p is a single number"),
        ("g", "must be real numbers"),
    ],
)
def test_wrong_parameters(kernel, p, message):
    q, v = states(3)
    with pytest.raises(RunError, match=message):
        kernel(q, v, p=p)


def test_missing_parameters_are_all_named(bare):
    q, v = states()
    with pytest.raises(RunError, match=r"parameter 'm2' has no value. Missing: m2, l2, g") as caught:
        bare(q, v, p={"m1": 1.0, "l1": 1.0})
    assert caught.value.code == "E401"
    with pytest.raises(RunError, match="Missing: m1, m2, l1, l2, g"):
        bare(q, v)


def test_other_groups_can_be_held_too():
    """Inputs held over many states go to the prologue with the parameters."""
    held = compile(PENDULUM, hoist=("u", "p"), optional=OPTIONAL, keep=False)
    free = compile(PENDULUM, optional=OPTIONAL, keep=False)
    q, v = states(10)
    assert held.operations <= free.operations
    for u, p in ((None, None), (np.array([2.0]), None), (None, np.array(list(P.values())) * 1.5), (2.0, {"g": 0.0})):
        np.testing.assert_allclose(held(q, v, u, p), free(q, v, u, p), rtol=1e-13)
        for _ in range(2):
            np.testing.assert_allclose(held(q[0], v[0], u, p), free(q[0], v[0], u, p), rtol=1e-13)
    pushed = np.linspace(-1, 1, 10)[:, None]
    np.testing.assert_allclose(held(q, v, pushed), free(q, v, pushed), rtol=1e-13)
    nothing = compile(PENDULUM, hoist=(), optional=OPTIONAL, keep=False)
    np.testing.assert_allclose(nothing(q, v), free(q, v), rtol=1e-13)
    np.testing.assert_allclose(nothing(q[0], v[0]), free(q[0], v[0]), rtol=1e-13)


# Refusals ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([0.1, 0.2, 0.3], [0.0, 0.0]), r"q has 3 values \(shape \(3,\)\), but needs 2: a, b"),
        ((0.1, [0.0, 0.0]), "q is a single number"),
        (([0.1, 0.2], [[0.0], [0.0]]), "v has 1 values"),
        ((np.zeros((3, 2)), np.zeros((4, 2))), "leading shapes do not fit together"),
        (([0.1, np.nan], [0.0, 0.0]), "coordinate 'b' is nan"),
        (([0.1, 0.2], [np.inf, 0.0]), "velocity 'va' is inf"),
        (([0.1, 0.2], [0.0, 0.0], [-np.inf]), "input 'tau' is -inf"),
        (([0.1, 0.2], [0.0, 0.0], 0.0, None, np.nan), "'t' is nan"),
        ((["0.1", "0.2"], [0.0, 0.0]), "must be real numbers"),
        (([0.1j, 0.2], [0.0, 0.0]), "must be real numbers"),
        (([None, 0.2], [0.0, 0.0]), "must be real numbers"),
        (([[0.1, 0.2], [0.3]], [0.0, 0.0]), "ragged"),
        (([sympy.Symbol("x"), 0], [0.0, 0.0]), "must be real numbers"),
        (([10**400, 0], [0.0, 0.0]), "must be real numbers"),
        ((np.ma.array([0.1, 0.2], mask=[True, False]), [0.0, 0.0]), "masked"),
        (([0.1, 0.2], [0.0, 0.0], 0.0, None, 0.0, 1.0), "6 arrays for 5 groups"),
        (([0.1, 0.2],), "velocity 'va' has no value"),
        ((), "coordinate 'a' has no value"),
        (({"a": 0.1}, [0.0, 0.0]), "coordinate 'b' has no value"),
        (({"a": 0.1, "bb": 0.0}, [0.0, 0.0]), "unknown coordinate 'bb'"),
    ],
)
def test_wrong_arguments(kernel, arguments, message):
    with pytest.raises(RunError, match=message):
        kernel(*arguments)
    q, v = states()
    np.testing.assert_allclose(kernel(q, v), expected(q, v), rtol=1e-12)  # and the kernel is none the worse


def test_wrong_names_of_arguments(kernel):
    q, v = states()
    with pytest.raises(RunError, match="unknown argument 'w'"):
        kernel(q, v, w=1)
    with pytest.raises(RunError, match=r"'v' is given twice"):
        kernel(q, v, v=v)
    with pytest.raises(RunError, match="lanes must be"):
        compile(PENDULUM, lanes=3)
    with pytest.raises(RunError, match="threads must be"):
        compile(PENDULUM, threads=0)


@pytest.mark.parametrize("count", [1, 5, 8, 30, 20_000])
def test_a_value_that_is_not_finite_is_found_anywhere(kernel, count):
    q, v = states(count)
    for bad in {0, count // 2, count - 1}:
        w = v.copy()
        w[bad, 1] = np.nan
        with pytest.raises(RunError, match=rf"velocity 'vb' is nan at state {bad}\b"):
            kernel(q, w)
        with pytest.raises(RunError, match=rf"at state \({bad}, 0\)"):
            kernel(q[:, None], w[:, None])


def test_a_result_that_is_not_finite_is_an_error():
    k = compile(
        program(lambda g, x: {"f": [x["a"], 1.0 / x["a"]], "r": x["a"].apply("sqrt")}, q=("a", "b")), keep=False
    )
    assert k([4.0, 0.0])["r"] == 2.0
    with pytest.raises(RunError, match=r"output 'f'\[1\] is inf"):
        k([0.0, 1.0])
    k(np.array([4.0, 0.0]))
    with pytest.raises(RunError, match=r"output 'f'\[1\] is inf") as caught:
        k(np.array([0.0, 1.0]))
    assert caught.value.code == "E503"
    a = np.ones((40, 2))
    a[29, 0] = -1.0
    with pytest.raises(RunError, match=r"output 'r' is -?nan at state 29"):
        k(a)


# The quick ways: the same answers without a closer look
# -----------------------------------------------------------------------------------------

ROW = np.array(list(P.values()))
QUICK = {
    "states alone": lambda q, v: (q, v),
    "every group": lambda q, v: (q, v, np.array([0.5]), ROW, 0.25),
    "new parameters": lambda q, v: (q, v, None, ROW * (1 + q.flat[0] ** 2)),
    "parameters by name": lambda q, v: (q, v, None, dict(P), 1),
    "some parameters by name": lambda q, v: (q, v, {"tau": 2.0}, {"g": 1.62}),
    "lists": lambda q, v: (q, v, [0.5], list(P.values()), np.float64(0.5)),
    "strides": lambda q, v: (np.repeat(q, 3, axis=0)[::3] if q.ndim == 2 else q, v[..., ::-1]),
    "one row for all": lambda q, v: (q, v.reshape(-1, 2)[0], np.array([0.5])),
}


@pytest.mark.parametrize("count", [None, 1, 3, 8, 21])
@pytest.mark.parametrize("form", QUICK.values(), ids=QUICK)
def test_usual_calls_need_no_closer_look(kernel, monkeypatch, form, count):
    """The quick ways answer, with the general way's numbers, and every answer is an array of its own."""
    q, v = states() if count is None else states(count)
    given = form(q, v)
    want = kernel(*given, out=np.empty(q.shape))
    kernel(*given)
    general: list[object] = []
    whole = Kernel._general
    monkeypatch.setattr(Kernel, "_general", lambda self, *a: general.append(a) or whole(self, *a))
    first = kernel(*given)
    kept = first.copy()
    second = kernel(*form(-q, v))
    assert not general
    np.testing.assert_array_equal(first, kept)
    np.testing.assert_array_equal(first, want)
    assert first.shape == q.shape and first.flags.writeable and not np.may_share_memory(first, second)


@pytest.mark.parametrize("parameters", [None, "one set", "a set for every state"])
def test_few_states_are_broadcast_against_as_many_as_lanes(kernel, parameters):
    """After calls that went well too, where few states are filled up to the lanes of the machine code."""
    lanes = kernel.lanes
    q, v = states(lanes)
    p = None if parameters is None else ROW if parameters == "one set" else ROW * np.linspace(0.5, 2, lanes)[:, None]
    want = kernel(np.repeat(q[:1], lanes, axis=0), v, None, p)
    kernel(q, v, None, p)
    np.testing.assert_array_equal(kernel(q[:1], v, None, p), want)
    np.testing.assert_array_equal(kernel(v, v, None, p, np.zeros(lanes)), kernel(v, v, None, p))
    assert kernel(q[:1], v[:1], None, None, np.zeros(lanes)).shape == (lanes, 2)
    if lanes > 2:
        with pytest.raises(RunError, match="leading shapes do not fit together"):
            kernel(q[:2], v, None, p)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("p", [np.array(9.81), np.ones((3, 4)), np.ones((0, 5)), np.ones((2, 5))])
def test_wrong_parameters_are_named_before_anything_looks_at_them(p):
    looked = compile(PENDULUM, optional=OPTIONAL, keep=False)
    seen = []
    looked.admit = lambda p: seen.append(p.shape)
    q, v = states(21)
    looked(q, v)
    looked(q, v, None, np.tile(ROW, (21, 1)))
    with pytest.raises(RunError, match="E501"):
        looked(q, v, None, p)
    assert all(shape in {(5,), (21, 5), p.shape} and shape[-1:] == (5,) for shape in seen)


def test_a_prepared_call_for_no_states(kernel):
    assert kernel.prepared(np.empty((0, 2)), np.empty((0, 2)))().shape == (0, 2)


def test_parameters_for_every_state_need_no_closer_look_either(kernel, monkeypatch):
    q, v = states(21)
    p = ROW * np.linspace(0.5, 2, 21)[:, None]
    want = kernel(q, v, None, p)
    monkeypatch.setattr(Kernel, "_general", None)
    np.testing.assert_array_equal(kernel(q, v, None, p), want)
    np.testing.assert_array_equal(kernel(q[:3], v[:3], None, p[:3]), want[:3])


@pytest.mark.parametrize("count", [None, 3, 21])
@pytest.mark.parametrize("name", list(P))
def test_a_parameter_that_is_not_finite_is_named_on_every_way(kernel, name, count):
    """Even where the answer does not depend on it, and after calls that went well."""
    q, v = states() if count is None else states(count)
    fine = kernel(q, v, None, ROW)
    for bad in (np.nan, np.inf):
        wrong = ROW.copy()
        wrong[list(P).index(name)] = bad
        for given in (wrong, wrong.tolist(), P | {name: bad}):
            with pytest.raises(RunError, match=f"parameter '{name}' is {bad}"):
                kernel(q, v, None, given)
    np.testing.assert_array_equal(kernel(q, v, None, ROW), fine)


@pytest.mark.parametrize("wrong", [[True, 0.5], ["1", "2"], [1j, 0], [10**400, 1.0], [1.0], [None, 1.0]])
def test_the_quick_ways_take_no_liberties(kernel, wrong):
    """What is refused, or read in its own way, is so after calls that went well too."""
    q, v = states()
    kernel(q, v)
    if wrong == [True, 0.5]:
        np.testing.assert_array_equal(kernel(wrong, v), kernel(np.array([1.0, 0.5]), v))
    else:
        with pytest.raises(RunError):
            kernel(wrong, v)
    for unknown in ({"h": 1.0}, dict.fromkeys("hm12l", 1.0)):
        with pytest.raises(RunError, match="unknown parameter 'h'"):
            kernel(q, v, None, unknown)
    huge = 10**400
    for given in ((q, v, None, None, huge), (q, v, [huge]), (q, v, None, [huge] * 5), (q, v, None, P | {"g": huge})):
        with pytest.raises(RunError, match="must be real numbers"):
            kernel(*given)


def test_names_may_stand_in_any_order(kernel):
    q, v = states()
    wanted = kernel(q, v, None, ROW)
    for _ in range(2):
        np.testing.assert_array_equal(kernel(q, v, {"tau": 0}, dict(reversed(P.items()))), wanted)
        np.testing.assert_array_equal(kernel(q, v, {}, {"g": P["g"]}), wanted)


SIGNS = [
    ([1.0, 2.0], 0),
    ([1.0, 0.0], 0),
    ([1.0, -0.0], 0),
    ([5e-324, 1.0], 0),
    ([0.0, 1.0], 2),
    ([-1.0, 1.0], 2),
    ([1.0, -5e-324], 2),
    ([np.nan, 1.0], 2),
    ([1.0, np.nan], 2),
    ([np.inf, 1.0], 2),
    ([1.0, np.inf], 2),
]


def test_signs_are_looked_at_in_every_row():
    """The first number must be above 0, the second not below, both finite; 2 is a doubt."""
    look = compile(program(lambda g, x: {"n": [x["a"], x["b"]]}, p=("a", "b")), hoist=(), keep=False).signs(1)
    for row, doubt in SIGNS:
        assert look(np.array([row])) == doubt, row
        for k in range(3):
            rows = np.ones((3, 2))
            rows[k] = row
            assert look(rows) == doubt


def test_machine_code_looks_at_parameters_in_the_place_of_python():
    """What it finds beyond doubt is not shown again, one state or many; what is in doubt is. No set is kept."""
    look = compile(program(lambda g, x: {"n": [x["g"]]}, p=tuple(P)), hoist=(), keep=False).signs(1)
    looked = compile(PENDULUM, optional=OPTIONAL, keep=False)
    shown: list[float] = []
    looked.admit = lambda p: shown.append(p[-1]) or look
    free = compile(PENDULUM, optional=OPTIONAL, keep=False)
    q, v = states(21)
    looked(q[0], v[0])
    looked(q, v)
    looked(q[0], v[0], None, ROW * 2)
    kept, shown[:] = len(looked._blocks), []
    for g in (9.0, 8.0, -7.0, 6.0, 0.0, 5.0):
        row = np.array([*ROW[:-1], g])
        for at in (0, slice(None), slice(3)):
            np.testing.assert_array_equal(looked(q[at], v[at], None, row), free(q[at], v[at], None, row))
    assert shown == [-7.0, 0.0]
    assert len(looked._blocks) == kept


# Threads, processes, lifetimes
# -----------------------------------------------------------------------------------------


def test_results_do_not_depend_on_the_number_of_threads(monkeypatch):
    monkeypatch.setattr(workers, "GRAIN", 1000)
    q, v = states(10_007)
    results = [compile(PENDULUM, optional=OPTIONAL, threads=n, keep=False)(q, v) for n in (1, 2, 3, 7)]
    for result in results[1:]:
        np.testing.assert_array_equal(result, results[0])


def test_calls_from_many_threads(kernel):
    q, v = states(400)
    want = kernel(q, v)
    wrong = []

    def work(start):
        for k in range(start, 400, 4):
            if not np.array_equal(kernel(q[k], v[k]), want[k]):
                wrong.append(k)
        if not np.array_equal(kernel(q, v), want):
            wrong.append(start)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_parameters_of_one_thread_do_not_reach_another(kernel):
    """Every thread has its own parameters, new ones at every call, one state and many in turns."""
    q, v = states(12)
    sets = [[ROW * (1 + k + 0.01 * j) for j in range(40)] for k in range(4)]
    want = [[kernel(q, v, None, row) for row in rows] for rows in sets]
    wrong = []

    def work(k):
        for row, right in zip(sets[k], want[k], strict=True):
            for j in (0, 7):
                if not np.array_equal(kernel(q[j], v[j], None, row), right[j]):
                    wrong.append((k, j))
            if not np.array_equal(kernel(q, v, None, row), right):
                wrong.append((k, None))

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_an_exception_in_a_worker_arrives(monkeypatch):
    monkeypatch.setattr(workers, "GRAIN", 1)

    def task(start, stop):
        raise RuntimeError(f"{start}")

    with pytest.raises(RuntimeError):
        workers.over(1000, 8, 10, 4, task)
    assert workers.over(1000, 8, 10, 4, lambda start, stop: start if start >= 500 else -1) >= 500
    assert workers.over(1000, 8, 10, 4, lambda start, stop: -1) == -1


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
@pytest.mark.filterwarnings("ignore:This process")
def test_a_forked_child_can_use_threads_again(monkeypatch):
    monkeypatch.setattr(workers, "GRAIN", 1000)
    k = compile(PENDULUM, optional=OPTIONAL, threads=3, keep=False)
    q, v = states(5000)
    want = k(q, v)
    child = os.fork()
    if child == 0:
        os._exit(0 if np.array_equal(k(q, v), want) else 1)
    assert os.waitpid(child, 0)[1] == 0


def test_kernels_can_be_sent_to_other_processes(kernel):
    copy = pickle.loads(pickle.dumps(kernel))
    q, v = states(9)
    assert isinstance(copy, Kernel)
    np.testing.assert_array_equal(copy(q, v), kernel(q, v))


def test_raw_functions(kernel):
    """The pointers for callers in machine code, called by hand."""
    import ctypes

    q, v = states(kernel.lanes)
    shared = kernel.shared()
    for lanes in (1, kernel.lanes):
        raw = kernel.raw(lanes)
        assert (raw.inputs, raw.outputs, raw.lanes) == (6, 2, lanes)
        block = np.concatenate([q.T, v.T, np.zeros((2, kernel.lanes))])[:, :lanes]
        spare = np.empty(8 * (raw.inputs + raw.outputs + raw.scratch) * lanes // 8 + 24)
        base = spare[(-spare.ctypes.data % 64) // 8 :]
        block_in, out = base[: 6 * lanes], base[6 * lanes + (-6 * lanes) % 8 :][: 2 * lanes]
        block_in[:] = block.ravel()
        call = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4)(raw.address)
        call(block_in.ctypes.data, shared.ctypes.data, out.ctypes.data, None)
        np.testing.assert_array_equal(out.reshape(2, lanes).T, kernel(q, v)[:lanes])
    with pytest.raises(RunError, match="no code for 3 lanes"):
        kernel.raw(3)


def test_others_can_print_code_around_the_tapes(kernel):
    """One explicit Euler step of [q; v] in the same module: x + h [v; a]."""
    import ctypes

    from lagrangian.codegen import aligned

    def euler(module, build):
        build.emit_tapes(module, 1)
        lines = ["call void @body_1(ptr %x, ptr %shared, ptr %a, ptr %scratch)"]
        for k in range(4):
            source = f"ptr %x, i64 {k + 2}" if k < 2 else f"ptr %a, i64 {k - 2}"
            lines += [f"%r{k} = getelementptr double, {source}", f"%d{k} = load double, ptr %r{k}"]
        for k in range(4):
            lines += [f"%p{k} = getelementptr double, ptr %x, i64 {k}", f"%o{k} = load double, ptr %p{k}"]
            lines += [f"%m{k} = fmul double %d{k}, %h", f"%n{k} = fadd double %o{k}, %m{k}"]
            lines += [f"store double %n{k}, ptr %p{k}"]
        arguments = "ptr %x, ptr %shared, ptr %a, ptr %scratch, double %h"
        module.define("euler", "\n".join([f"define void @euler({arguments}) {{", *lines, "ret void", "}"]))

    loaded = kernel.build.extended("euler 1", euler)
    assert kernel.build.extended("euler 1", euler) is loaded
    step = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4, ctypes.c_double)(loaded.address("euler"))
    q, v = states()
    x, a, shared = aligned(6), aligned(2), kernel.shared()
    x[:] = [*q, *v, 0, 0]
    step(x.ctypes.data, shared.ctypes.data, a.ctypes.data, None, 0.01)
    np.testing.assert_allclose(x[:4], [*(q + 0.01 * v), *(v + 0.01 * kernel(q, v))], rtol=1e-14)


def test_what_a_kernel_says_of_itself(kernel):
    assert repr(kernel) == "<Kernel 'double pendulum': q[2], v[2], u[1], p[5], t[1] -> acc[2]>"
    assert 20 < kernel.operations < 60
