"""What a student is told: the verdict at a hint level, the points, and what is missing; as a page and in short."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagrangian.check.classes.marks import PartMark
from lagrangian.check.verb import CheckedAnswer
from lagrangian.check.verdict import Status
from lagrangian.check.words import step_title
from lagrangian.errors import listed
from lagrangian.model import Model
from lagrangian.page.formula import Table, Text, text
from lagrangian.page.report import Part, Report


def number(value: float) -> str:
    """Points in words: no more digits than needed."""
    return f"{round(value, 2):g}"


def in_letters(said: Text) -> str:
    """A sentence as plain text, in which a generalized force has the letter that it has everywhere else."""
    return _FORCE.sub("Ξ", str(said))


_FORCE = re.compile(r"\bXi(?![^\W_])")


def feedback_report(
    verdict: CheckedAnswer, lacks: Sequence[str], earned: Sequence[PartMark], *, moved: bool
) -> Report[Model]:
    """The page for a student: the verdict at its hint level, with the points and what is missing.

    At hint level 0 only the sum of the points is told, because those of the parts would say where it is wrong.
    """
    page = verdict.report()
    parts = list(page.parts)
    if notes := [text(words) for words in _demands(verdict, lacks, moved=moved)]:
        head = parts[0].items[1:] if verdict.right else parts[0].items
        parts[0] = Part(parts[0].title, (*notes, *head), parts[0].checks)
    if earned:
        parts.append(Part(text("Points"), (_points(earned, verdict.hint),)))
    return Report(page.title, page.model, tuple(parts), page.data)


def words_report(model: Model, words: Sequence[str]) -> Report[Model]:
    """The page for a student whose answer has no verdict."""
    return Report(f"Your answer: {model.name}", model, (Part(text("Is it right?"), tuple(map(text, words))),))


def _demands(verdict: CheckedAnswer, lacks: Sequence[str], *, moved: bool) -> Iterator[str]:
    """What was asked for and is not given, in sentences."""
    if moved:
        yield "Right, but in other coordinates than those asked for."
    if lacks:
        begin = "Right as far as it goes, but this is missing" if verdict.right else "This is missing"
        yield f"{begin}: {listed(lacks)}."


def _points(earned: Sequence[PartMark], hint: int) -> Text | Table:
    total, most = sum(m.points for m in earned), sum(m.of for m in earned)
    if hint == 0:
        return text(f"{number(total)} of {number(most)}.")
    rows = [(text(m.title), text(number(m.points)), text(number(m.of)), text(m.why)) for m in earned]
    rows.append((text("all"), text(number(total)), text(number(most)), text("")))
    return Table((text("part"), text("points"), text("of"), text("because")), tuple(rows))


def comment(verdict: CheckedAnswer, lacks: Sequence[str], earned: Sequence[PartMark], *, moved: bool) -> Iterator[str]:
    """The feedback in a few plain sentences, for a cell of a table; the hint level limits how much it reveals."""
    demands = list(_demands(verdict, lacks, moved=moved))
    if not (demands and verdict.right):
        yield _headline(verdict)
    yield from demands
    if verdict.status is Status.INCOMPLETE and verdict.hint and not verdict.missing:
        yield from map(str, verdict.told)
    wrong = [f for f in verdict.findings if not f.status.right]
    if verdict.hint >= 1 and verdict.status is Status.WRONG:
        own = [f.line.title for f in wrong if not f.follows]
        after = [f.line.title for f in wrong if f.follows]
        yield f"Not right: {listed(own or after)}."
        if own and after:
            yield f"Only because of that: {listed(after)}."
    if verdict.hint >= 2:
        for m in verdict.mistakes:
            place = f"step {m.step}, {step_title(m.step)}" + (
                f", {listed(found)}" if (found := verdict.concerned(m)) else ""
            )
            if verdict.hint >= 3:
                yield f"{in_letters(m.what)} ({place})"
            else:
                yield f"{in_letters(m.hinted())} ({place})"
    if earned and verdict.hint >= 1:
        said = ", ".join(f"{m.title} {number(m.points)}/{number(m.of)}" for m in earned)
        yield f"Points: {said}."


def _headline(verdict: CheckedAnswer) -> str:
    match verdict.status:
        case Status.WRONG:
            return "Not right yet."
        case Status.INCOMPLETE:
            named = ", ".join(map(str, verdict.missing if verdict.hint else ()))
            return f"Right as far as it goes, but something is missing{f': {named}' if named else ''}."
        case _:
            return f"{verdict.status.value[:1].upper()}{verdict.status.value[1:]}."
