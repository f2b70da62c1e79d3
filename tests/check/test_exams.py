"""Answers of imagined classes to machines and toys that are no examples: right ones are accepted, wrong ones are not.

Oracle: their authors, who had not seen the checker and held every answer against the model by a program of their own.
``exams/*.toml`` holds a model with the answers to it: ``is`` says what one is, ``planted`` what went wrong, and
``lines`` in which lines. ``open`` marks a right answer that is not accepted so far, or a wrong one that is not read,
with the reason. ``says`` is what is told of a wrong one that was told something untrue before.
"""

from __future__ import annotations

import tomllib
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from lagrangian.check.verb import CheckedAnswer, check_answer
from lagrangian.errors import ParseError
from lagrangian.read import loads
from lagrangian.structured.choose import derive_in_form

FOLDER = Path(__file__).parent / "exams"
SYSTEMS = sorted(path.stem for path in FOLDER.glob("*.toml"))


@cache
def judged(system: str) -> list[tuple[dict[str, Any], CheckedAnswer | ParseError]]:
    """The answers to a system with what is said of them."""
    data = tomllib.loads((FOLDER / f"{system}.toml").read_text(encoding="utf-8"))
    derivation = derive_in_form(loads(data["model"]).model())
    found: list[tuple[dict[str, Any], CheckedAnswer | ParseError]] = []
    for answer in data["answer"]:
        try:
            found.append((answer, check_answer(derivation, answer["text"], name=answer["file"])))
        except ParseError as error:
            found.append((answer, error))
    return found


@pytest.mark.sampled(("citrus-press", "chop-saw"))
@pytest.mark.parametrize("system", SYSTEMS)
def test_answers_are_judged_and_what_is_told_is_true_of_them(system: str) -> None:
    """One test, for the answers to a system are judged in the process that runs it."""
    for answer, verdict in judged(system):
        told = f"{answer['file']} is {answer['is']}: {verdict}"
        if "open" in answer:
            assert answer["is"] == "right" or not (isinstance(verdict, CheckedAnswer) and verdict.right), told
        elif answer["is"] == "right":
            assert isinstance(verdict, CheckedAnswer) and verdict.right, told
        else:
            assert isinstance(verdict, CheckedAnswer) and not verdict.right, told
        if "says" in answer:
            assert isinstance(verdict, CheckedAnswer)
            assert [str(m.what) for m in verdict.mistakes] == answer["says"], told


@pytest.mark.slow
def test_most_wrong_answers_are_told_at_the_line_in_which_the_mistake_was_made() -> None:
    """Of those with one wrong line; six of seven, and of nearly all others it is said that this line was not judged."""
    counted, missed, untrue = 0, list[str](), list[str]()
    for system in SYSTEMS:
        for answer, verdict in judged(system):
            if len(answer.get("lines", ())) != 1 or not isinstance(verdict, CheckedAnswer):
                continue
            counted += 1
            first, (line,) = verdict.first_wrong, answer["lines"]
            if first is None or first.line.number != line:
                said = f"{system} {answer['file']}: {first and first.line.number}, not {line}"
                missed.append(said)
                apart = first is not None and first.clash
                untrue += [] if apart or line in (*verdict.unjudged, *verdict.partly) else [said]
    assert counted > 270 and len(missed) <= counted / 7, (counted, missed)
    assert len(untrue) <= 0.05 * counted, untrue
