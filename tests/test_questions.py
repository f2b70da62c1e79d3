"""A question about a system of hard expressions ends after a number of calls, and leaves everything usable."""

import cProfile
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from types import FrameType
from typing import Any, cast

import pytest
import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

import built_in
from built_in import SOME
from effort import at_most
from lagrangian import ModelError, bounded, examples
from lagrangian.bounded import questions
from lagrangian.check import Status
from lagrangian.model import is_hard

a, b, c, d, e = sp.symbols("a b c d e")
q, w = dynamicsymbols("q w")

PLAIN = [sp.sin(q - w), sp.exp(-q / a), sp.sqrt(q**2 + a**2), (a + b) ** 3 / (q + c), a * sp.tanh(q / b), q**97]
HARD = [
    (a + q) ** 7,
    (q + w) ** -24,
    sp.exp(sp.sin(q)),
    sp.tanh(a + b * q + c * q**2 + d * q**3 + e),
    q ** (a + b) ** 30,
]


@pytest.mark.parametrize("expr", PLAIN)
def test_what_textbooks_contain_is_plain(expr: sp.Expr) -> None:
    assert not bounded.hard([expr])


@pytest.mark.parametrize("expr", HARD)
def test_high_powers_and_functions_of_functions_are_hard(expr: sp.Expr) -> None:
    assert bounded.hard([a + 1, expr])


def test_many_plain_expressions_are_hard() -> None:
    assert bounded.hard([sp.sin(q - w) * a] * 1_000)


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", examples.names())
def test_no_example_is_hard(name: str) -> None:
    assert not is_hard(built_in.system(name).model)


def _question(is_hard: bool) -> Callable[[Callable[[], object]], object]:
    return bounded.answered("this question", lambda routine: is_hard)(lambda routine: routine())


def _in_sympy() -> None:
    for k in range(10_000):
        sp.Add(a, sp.Integer(k))


def test_a_hard_question_ends_and_a_plain_one_is_not_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(questions, "QUESTION", 1_000)
    _question(False)(_in_sympy)
    with at_most(20_000), pytest.raises(ModelError, match="this question takes more than 1000 steps") as caught:
        _question(True)(_in_sympy)
    assert caught.value.code == "E601" and caught.value.fix is not None and "compile()" in caught.value.fix
    assert sys.getprofile() is None


def test_what_a_question_asks_and_searches_is_counted_with_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(questions, "QUESTION", 30_000)
    inner = _question(True)
    for part in (lambda: inner(_short), lambda: bounded.searched(_short, calls=20_000)):
        with at_most(200_000), pytest.raises(ModelError, match="30000"):
            _question(True)(lambda part=part: [part() for _ in range(50)])


def _short() -> None:
    for _ in range(100):
        sp.Add(a, sp.Dummy())


def test_a_search_that_has_a_limit_of_its_own_ends_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(questions, "QUESTION", 1_000_000)
    assert _question(True)(lambda: bounded.searched(_in_sympy, calls=500)) is None


def test_our_own_steps_are_not_interrupted(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is changed in several steps would be left half changed."""
    monkeypatch.setattr(questions, "QUESTION", 100)
    done: list[int] = []

    def step(k: int) -> None:
        done.append(k)

    _question(True)(lambda: [step(k) for k in range(1_000)])
    assert len(done) == 1_000


@pytest.mark.sampled(3)
@pytest.mark.parametrize("calls", [20_000, 60_000, 150_000])
def test_after_an_answer_that_was_given_up_others_are_judged(calls: int, monkeypatch: pytest.MonkeyPatch) -> None:
    system = built_in.system("double-pendulum")
    derivation = system.derive()
    right: list[Any] = list(derivation.equations)
    first, second = (cast("Any", c.symbol) for c in system.model.coordinates)
    hard = sp.tanh(sp.sin(first) * second) ** 3 * (first + second) ** 9
    with monkeypatch.context() as patch:
        patch.setattr(questions, "QUESTION", calls)
        with pytest.raises(ModelError, match="checking the answer takes more than"):
            derivation.check([sp.Eq(right[0].lhs + hard, right[0].rhs), right[1]])
    assert derivation.check(right).status is Status.RIGHT
    wrong = derivation.check([sp.Eq(2 * right[0].lhs + sp.diff(first, "t", 2), right[0].rhs), right[1]])
    assert not wrong.right


def test_whoever_profiles_goes_on_seeing_every_call() -> None:
    seen: list[str] = []

    def profile(frame: FrameType, event: str, argument: object) -> None:
        if event == "call":
            seen.append(frame.f_code.co_name)

    sys.setprofile(profile)
    try:
        _question(True)(lambda: bounded.searched(_short))
        assert sys.getprofile() is profile
    finally:
        sys.setprofile(None)
    assert seen.count("_short") == 1


@pytest.mark.slow
def test_a_profiler_of_the_standard_library_goes_on_afterwards() -> None:
    profiler = cProfile.Profile()
    profiler.enable()
    try:
        _question(True)(_short)
        _in_sympy()
    finally:
        profiler.disable()
    names = {entry.code.co_name for entry in profiler.getstats() if not isinstance(entry.code, str)}
    assert "_in_sympy" in names


def test_threads_count_for_themselves(monkeypatch: pytest.MonkeyPatch) -> None:
    """A question that is given up in one thread leaves those of the others alone."""
    monkeypatch.setattr(questions, "QUESTION", 50_000)
    inner = _question(True)
    with ThreadPoolExecutor(4) as pool:
        long = [pool.submit(inner, lambda: [_short() for _ in range(500)]) for _ in range(3)]
        short = [pool.submit(inner, _short) for _ in range(6)]
        assert all(isinstance(job.exception(), ModelError) for job in long)
        assert all(job.exception() is None for job in short)
    assert sys.getprofile() is None


def test_a_debugger_beside_the_count_goes_on() -> None:
    seen: list[str] = []

    def trace(frame: FrameType, event: str, argument: object) -> None:
        seen.append(frame.f_code.co_name)

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        _question(True)(_short)
    finally:
        sys.settrace(before)
    assert "_short" in seen
