"""What is kept of one answer for the next changes no verdict, and makes no answer possible that was refused."""

from __future__ import annotations

import gc
from dataclasses import replace
from functools import _lru_cache_wrapper
from typing import Any

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from lagrangian import check
from lagrangian.bounded import questions
from lagrangian.bounded.effort import CallCount
from lagrangian.check import hardness, reference
from lagrangian.check.check import check as check_lines
from lagrangian.check.coordinates import tried
from lagrangian.check.judged import judged_lines
from lagrangian.check.reading import Answer, parse_answer
from lagrangian.check.reading.shortened import AnswerScope
from lagrangian.check.reference import truth_of
from lagrangian.derive import sampling
from lagrangian.errors import ModelError
from lagrangian.read.scope import Scope
from size import rest_slow

ANSWERS = {
    "lecture-3b": [
        "m1*x1'' = k*x2r - F\nm2*(x1'' + x2r'') = F - 3*k*x2r",
        "T = m1/2*x1'^2 + m2/2*x2r'^2\nV = k/2*x2r^2",
    ],
    "cart-pole": [
        "(M + m)*x'' + m*l*theta''*cos(theta) = F\nm*l^2*theta'' + m*l*x''*cos(theta) - 2*m*g*l*sin(theta) = 0",
        "T = M/2*x'^2 + m/2*(x'^2 + l^2*theta'^2)\nV = m*g*l*cos(theta)",
    ],
    "bead-on-hoop": ["m*R^2*theta'' - m*R^2*Omega^2*sin(theta)*cos(theta) - 2*m*g*R*sin(theta) = 0"],
    "wheel-on-incline": [
        "m*s'' = m*g*sin(alpha) - 2*lambda\nJ*phi'' = lambda*R\ns' = R*phi'",
        "T = m*s'^2 + J/2*phi'^2",
    ],
}


def verdict(made: lg.Derivation, answer: str) -> str:
    try:
        return made.check(answer).to_text()
    except lg.Error as error:
        return str(error)


def forget() -> None:
    """Empty whatever functions of the package keep."""
    for kept in [x for x in gc.get_objects() if isinstance(x, _lru_cache_wrapper)]:
        if getattr(kept, "__module__", "").startswith("lagrangian."):
            kept.cache_clear()
    sampling._recent.graphs.clear()


@pytest.mark.parametrize("name", rest_slow(ANSWERS, {"bead-on-hoop"}))
def test_a_verdict_is_the_same_with_what_is_kept_and_without(name: str) -> None:
    used = built_in.derivation(name)
    first = [verdict(used, x) for x in (*ANSWERS[name], *reversed(ANSWERS[name]))]
    assert first == [*first[: len(ANSWERS[name])], *reversed(first[: len(ANSWERS[name])])]
    forget()
    assert [verdict(lg.example(name).derive(), x) for x in ANSWERS[name]] == first[: len(ANSWERS[name])]


@pytest.mark.slow
def test_an_answer_that_is_refused_as_too_long_is_refused_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """The second time it would need a fifth of the steps: the small changes of the system are known."""
    monkeypatch.setattr(hardness, "WRITTEN", 0)
    counts: list[CallCount] = []

    def counted(*args: Any, **named: Any) -> CallCount:
        counts.append(CallCount(*args, **named))
        return counts[-1]

    monkeypatch.setattr(questions, "CallCount", counted)
    (answer, _), name = ANSWERS["lecture-3b"], "lecture-3b"
    for _ in range(2):  # the second time all is kept that systems have in common
        assert not lg.example(name).derive().check(answer).right
    steps = counts[-1].limit - counts[-1].left
    monkeypatch.setattr(questions, "QUESTION", steps - 2_000)
    made = lg.example(name).derive()
    for _ in range(3):
        with pytest.raises(ModelError, match=f"checking the answer takes more than {steps - 2_000} steps"):
            made.check(answer)
    monkeypatch.setattr(questions, "QUESTION", steps + 2_000)
    assert not made.check(answer).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("line", ["T = m1/2*x1'^2 + m2*x2r'^2", "Xi_x1 = 2*F", "L = m1/2*x1'^2 - k*x2r^2", "V = k*x2r"])
def test_in_which_terms_a_line_differs_is_only_said_where_it_is_asked(line: str) -> None:
    made = built_in.derivation("lecture-3b")
    lines = check.lines_of(parse_answer(line, made.model))
    told, plain = (judged_lines(truth_of(made), lines, compared=x) for x in (True, False))

    def without_terms(found: Any) -> list[Any]:
        return [(f.line, f.status, f.note, f.coordinate, f.follows) for f in found.findings]

    assert told.findings[0].differences and not plain.findings[0].differences
    assert (told.status, without_terms(told)) == (plain.status, without_terms(plain))
    assert check_lines(made, lines).findings[0].differences


@pytest.mark.parametrize("energy", ["T", "L"])
def test_changes_that_are_tried_together_are_those_that_hold_alone(
    energy: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    truth = truth_of(built_in.derivation("double-pendulum"))
    opposite = {q: -q for q in truth.derivation.coordinates}
    rows = [check.AnsweredLine("equation", row.xreplace(opposite).doit(), 1) for row in truth.rows]
    wrong = [replace(rows[0], expr=rows[0].expr + 1)]
    for lines in (rows, rows[1:], wrong, [check.AnsweredLine(energy, getattr(truth, energy), 1)]):
        every = list(tried.candidates(truth, lines))
        together = list(tried.QuickTest(truth, lines).possible(every))
        assert together == [x for x in every for _ in tried.QuickTest(truth, lines).possible([x])]
        monkeypatch.setattr(tried, "TRIED_TOGETHER", 3)
        assert together == list(tried.QuickTest(truth, lines).possible(iter(every)))
        monkeypatch.undo()
        assert bool(together) == (lines is not wrong)


def test_values_that_are_kept_are_few(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reference, "MAX_KEPT", 2)
    truth = reference.Reference(built_in.derivation("lecture-3b"))
    found = [truth.kept(k, lambda k=k: np.array([float(k)])) for k in (1, 2, 3, 1, 1)]
    assert [float(x[0]) for x in found] == [1, 2, 3, 1, 1]
    assert len(truth._kept) == 2 and found[3] is found[4]


def test_a_name_gets_a_new_meaning_whenever_the_answer_gives_it_one() -> None:
    scope = AnswerScope(Scope(built_in.derivation("cart-pole").model.symbols))
    assert scope.meanings("th") == (["theta"], 0) == scope.meanings("th")
    scope.meanings("th")[0].clear()
    assert scope.meanings("th") == (["theta"], 0)
    scope.learn(["th"], (), "")
    assert scope.meanings("th") == ([], 0)
    assert scope.meanings("al") == ([], 0)
    scope.add("al", sp.Symbol("al"))
    assert scope.meanings("al") == (["al"], 0)


def test_another_reading_is_read_once() -> None:
    made, count = built_in.derivation("lecture-3b"), [0]
    answer = parse_answer(ANSWERS["lecture-3b"][0], made.model)

    def other() -> Answer:
        count[0] += 1
        return replace(answer, program=True)

    assert not made.check(replace(answer, others=(other,))).right
    assert count == [1]
