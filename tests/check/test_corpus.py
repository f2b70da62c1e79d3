"""The corpus of answers: no right one is rejected, no wrong one accepted, the planted mistake is named first.

``corpus/*.toml`` holds the answers, most of them written by ``write_corpus.py``, some by hand. ``is`` says what an
answer is, ``mistake`` what was planted, ``also`` which other mistakes give the very same answer, ``line`` the first
wrong one of a whole derivation.
"""

from __future__ import annotations

import tomllib
from collections import Counter
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import size
from built_in import derivation
from lagrangian import check
from lagrangian.check.verb import CheckedAnswer, check_answer

FILES = sorted((Path(__file__).parent / "corpus").glob("*.toml"))
CORPUS = [
    {"system": data.get("system")} | answer
    for data in (tomllib.loads(path.read_text(encoding="utf-8")) for path in FILES)
    for answer in data["answer"]
]
SYSTEMS = sorted({a["system"] for a in CORPUS})


def chosen(size: int) -> list[dict[str, Any]]:
    """For every system and what an answer is, the ``size`` answers that name the rarest mistakes."""
    rare = Counter(a.get("mistake") for a in CORPUS)
    listed = []
    for system in SYSTEMS:
        own = [a for a in CORPUS if a["system"] == system]
        for kind in sorted({a["is"] for a in own}):
            alike = sorted((a for a in own if a["is"] == kind), key=lambda a: (rare[a.get("mistake")], a["id"]))
            listed += alike[:size]
    return listed


LARGE = {"triple-pendulum", "acrobot", "three-masses", "planar-quadrotor", "two-disk-shaft", "lecture-2-absolute"}
LARGE |= {"ball-and-beam", "double-pendulum-relative", "crane", "robot-arm", "spring-net", "scara"}
"""Systems whose answers take long to check."""

FEW = 2
"""The number of answers of a kind to a large system that are checked for every change."""


def run() -> list[dict[str, Any]]:
    """All answers before a release, of large systems some among the tests that take long; a sample by default."""
    if size.EVERY:
        return CORPUS
    if size.FULL:
        return [a for a in CORPUS if a["system"] not in LARGE] + [a for a in chosen(FEW) if a["system"] in LARGE]
    return [a for a in chosen(1) if a["system"] not in LARGE]


RUN = run()

RIGHT = {
    "right": {check.Status.RIGHT, check.Status.EQUIVALENT},  # V may differ by a constant
    "scaled": {check.Status.EQUIVALENT, check.Status.RIGHT},
    "reordered": {check.Status.EQUIVALENT, check.Status.RIGHT},
    "combined": {check.Status.EQUIVALENT},
    "same motion": {check.Status.SAME_MOTION, check.Status.EQUIVALENT, check.Status.RIGHT},
    "other coordinates": {check.Status.OTHER_COORDINATES, check.Status.RIGHT, check.Status.EQUIVALENT},
}
WRONG = {"wrong": check.Status.WRONG, "incomplete": check.Status.INCOMPLETE}


@cache
def verdicts(system: str) -> list[tuple[dict[str, Any], CheckedAnswer]]:
    return [(a, check_answer(derivation(system), a["text"])) for a in RUN if a["system"] == system]


def named(answer: dict[str, Any], verdict: CheckedAnswer) -> bool:
    """Whether the mistake that is named first is the planted one, or one that gives the very same answer."""
    return verdict.mistake is not None and verdict.mistake.name in (answer["mistake"], *answer.get("also", ()))


def test_the_corpus_is_large_and_its_names_are_the_checker_s():
    counted = Counter(a["is"] for a in CORPUS)
    assert len(CORPUS) >= 300 and counted["wrong"] >= 120
    assert set(counted) == set(RIGHT) | set(WRONG)
    folder = Path(check.__file__).parent / "explain/misconceptions"
    names = {path.stem for path in folder.glob("*.py")} | {"sign_of_a_term", "term_forgotten"}  # of no misconception
    planted = {a["mistake"] for a in CORPUS if "mistake" in a}
    assert planted <= names and len(planted) >= 30
    assert len({a["id"] for a in CORPUS}) == len(CORPUS)


@pytest.mark.sampled(16)
@size.also_in_full
@pytest.mark.parametrize("system", SYSTEMS if size.FULL else sorted(set(SYSTEMS) - LARGE))
def test_no_right_answer_is_rejected_and_no_wrong_one_accepted(system):
    for answer, verdict in verdicts(system):
        told = f"{answer['id']} is {answer['is']}, called {verdict.status}\n{answer['text']}"
        if answer["is"] in RIGHT:
            assert verdict.right, told
            assert verdict.status in RIGHT[answer["is"]], told
        else:
            assert verdict.status is WRONG[answer["is"]], told


@pytest.mark.sampled(8)
@size.also_in_full
@pytest.mark.parametrize("system", SYSTEMS if size.FULL else sorted(set(SYSTEMS) - LARGE))
def test_the_first_wrong_line_is_named(system):
    for answer, verdict in verdicts(system):
        if "line" in answer:
            assert verdict.first_wrong is not None, answer["id"]
            assert verdict.first_wrong.line.number == answer["line"], (answer["id"], verdict.first_wrong.line)


@size.also_in_full
def test_the_planted_mistake_is_named_first():
    systems = SYSTEMS if size.FULL else sorted(set(SYSTEMS) - LARGE)[::8]  # those that the tests above have checked
    wrong = [(a, v) for system in systems for a, v in verdicts(system) if "mistake" in a]
    missed = [(a["id"], a["mistake"], v.mistake.name if v.mistake else None) for a, v in wrong if not named(a, v)]
    assert len(missed) <= len(wrong) // 10, missed
