"""The results of `System.check` and `Derivation.check`: the verdict on an answer, with the methods that write it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from lagrangian import check
from lagrangian.advice import Advice, Argument
from lagrangian.check.reading import Answer, decode_answer, parse_answer
from lagrangian.derive import Derived, derive
from lagrangian.errors import Error, ModelError, ParseError
from lagrangian.model import Model
from lagrangian.page.formula import text
from lagrangian.page.report import Report
from lagrangian.read import MAX_BYTES
from lagrangian.viewed import cut
from lagrangian.write.written import Written


@dataclass(frozen=True, eq=False, kw_only=True)
class CheckedAnswer(Written, check.Verdict):
    """Whether an answer is right, in what sense, or where it is wrong and why; see `lagrangian.check.Verdict`."""

    model: Model

    def report(self) -> Report[Model]:
        """Return the verdict as words and tables; ``hint`` limits how much it reveals."""
        return check.report(self, self.model)

    def __repr__(self) -> str:
        """Name the system and the verdict; ``print`` shows the whole result."""
        return cut(f"<CheckedAnswer, {self.model.name}: {self.status.value}>")


def check_answer(derivation: Derived, answer: Any, *, hint: int = 3, name: str | None = None) -> CheckedAnswer:
    """Check an answer: text or LaTeX, an `Answer` that was read, SymPy equations, or energies by name.

    ``hint`` limits how much the result reveals: 0 right or wrong, 1 the line, 2 the element and the step, 3 the term.
    ``name`` is the file of the answer, for messages. Raises `ParseError`, with the place, if a text cannot be read, and
    `ModelError` if the equations cannot be written in the coordinates alone.
    """
    if isinstance(hint, bool) or hint not in (0, 1, 2, 3):
        raise ModelError(f"a hint has a level from 0 to 3 (got {hint})", fix=Advice(Argument("hint", "2")), code="E406")
    if derivation.form == "structured":  # answers are compared in the coordinates alone
        derivation = derive(derivation.model)
    if isinstance(answer, str):
        answer = parse_answer(answer, derivation.model, name=name)
    if isinstance(answer, Answer):
        verdict = _of_readings(derivation, answer, hint)
    else:
        verdict = check.check(derivation, check.lines_from(answer), hint=hint)
    return CheckedAnswer(**vars(verdict), model=derivation.model)


def _of_readings(derivation: Derived, answer: Answer, hint: int) -> check.Verdict:
    """The verdict on an answer as it is most likely meant or, if only that is right, in one of its other readings."""
    for reading in (lambda: answer, *answer.others) if answer.others else ():
        try:
            other = reading()
        except ParseError:
            continue
        verdict = check.check(derivation, check.lines_of(other), hint=hint, explain=False)
        if verdict.right:
            return _told(verdict, other)
    return _told(check.check(derivation, check.lines_of(answer), hint=hint), answer)


def _told(verdict: check.Verdict, answer: Answer) -> check.Verdict:
    """The verdict with the notes of the reading, each once."""
    notes = {str(note): note for note in (*map(text, answer.notes), *verdict.notes)}
    return replace(verdict, notes=tuple(notes.values()))


def read_text(path: Path) -> str:
    """Return the text of an answer's file; raises `Error` if it cannot be read."""
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        what = f"cannot read '{path}': {(error.strerror or str(error)).lower()}"
        raise Error(what, fix="check the path; - is standard input", code="E702") from error
    return decode_answer(data, str(path))
