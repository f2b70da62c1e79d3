"""Parses the statements of an answer one by one, and keeps the errors of those that cannot be parsed."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from itertools import islice

from lagrangian.check.reading.answer import MarkedRow
from lagrangian.check.reading.choices import Choices
from lagrangian.check.reading.latex.formula import LatexParser
from lagrangian.check.reading.latex.macros import ExpandedLatex
from lagrangian.check.reading.line_forms import Statement
from lagrangian.check.reading.lines import Lines
from lagrangian.check.reading.listed_items import holds_in_a_case, listed_items
from lagrangian.check.reading.name_patterns import NAME
from lagrangian.check.reading.parser import Parser
from lagrangian.check.reading.plain.ends import missing_brackets
from lagrangian.check.reading.plain.formula import PlainParser
from lagrangian.check.reading.plain.rows import AnswerRow
from lagrangian.check.reading.plain.spans import statements
from lagrangian.check.reading.plain.tokens import with_points
from lagrangian.check.reading.prose.descriptions import states_nothing
from lagrangian.check.reading.prose.marks import readings
from lagrangian.check.reading.prose.remarks import is_remark, may_redefine
from lagrangian.check.reading.prose.words import Words
from lagrangian.check.reading.prose.words_or_mathematics import LINKING, has_words, in_words
from lagrangian.check.reading.set_aside import MOST_LACKING, MOST_TOLD, may_be_result
from lagrangian.check.reading.unit_vectors import is_vector
from lagrangian.errors import ParseError, Place
from lagrangian.quantities.source import Source
from lagrangian.read.letters import key
from lagrangian.records import dataclass

FEWEST_NAMES = 3
"""The fewest names of the system in a sentence that may hold a result."""
MANY_WORDS = 2
"""English words in a row that make it a sentence."""

_LETTERS = r"[^\W\d]\w{0,11}"
_MEANING = re.compile(
    rf"(?:^|[,;])[ \t]{{0,9}}(?P<said>(?P<name>{_LETTERS})[ \t]{{0,3}}=[ \t]{{0,3}}"
    rf"(?P<value>{_LETTERS}(?:[ \t]?[-+*/][ \t]?{_LETTERS}){{0,3}}))"
    r"(?=[ \t]*(?:[,;.)]|$))"
)
"""A name with a value in names, between commas."""


def parsers_of(
    rows: Sequence[AnswerRow], in_words: Sequence[AnswerRow], words: Words, lines: Lines
) -> list[tuple[AnswerRow, Callable[[Source], Parser]]]:
    """Rows with what reads them: as text or, if they are not among those ``in_words``, as LaTeX."""
    in_text: Callable[[Source], Parser] = partial(PlainParser, words=words)
    in_latex: Callable[[Source], Parser] = partial(LatexParser, names=lines.names)
    return [(row, in_text if row in in_words else in_latex) for row in rows]


def parsed(
    source: Source,
    rows: Sequence[tuple[AnswerRow, Callable[[Source], Parser]]],
    latex: ExpandedLatex | None,
    words_of: Words,
    lines: Lines,
    reading: Choices,
) -> tuple[list[Statement], list[ParseError], list[str]]:
    """Return the statements, whose places refer to the whole answer, the errors of those that cannot be parsed, and
    notes about rows that are no statements about the system and were left out."""
    found: list[Statement] = []
    errors: list[ParseError] = []
    words: list[ParseError] = []
    silent: list[ParseError] = []
    for typed, parser in rows:
        row = reading.row(typed, words_of)
        own = _source(row, source, latex)
        written = own.text
        whole = written if latex is not None else source.text[row.start : row.start + len(row.text)]
        remark = partial(is_remark, whole)
        try:
            found.append(replace(_statement(own, parser, lines, words_of), remark=remark))
        except ParseError as error:
            if error.code != "E703" and (parts := _spans(own, parser, lines, words_of)):
                found += [replace(part, remark=remark) for part in parts]
                continue
            if error.code != "E703" and latex is None and (part := _list(own, parser, lines, words_of)) is not None:
                found += [replace(x, remark=remark) for x in part.read]
                (lines.remarks if part.equated else words).append(error)
                lines.doubts += [error] if part.redefines else []
                continue
            if error.code != "E703" and latex is None and states_nothing(whole, words_of):
                silent.append(error)
                found += [replace(x, remark=remark) for x in _meanings(own, parser, lines, words_of)]
                continue
            lines.failed.append(error)
            lines.unread.update(key(x) for x in re.findall(NAME, whole))
            stated = _is_stated(written, whole, words_of) and not is_vector(written, lines.names)
            if stated and error.code != "E703" and remark():
                lines.remarks.append(error)
                lines.doubts += [error] if may_redefine(whole, words_of) else []
                continue
            (errors if stated or error.code == "E703" else words).append(error)
            if not stated and latex is None:
                found += [replace(x, remark=remark) for x in _meanings(own, parser, lines, words_of)]
            lines.results += [error] if may_be_result(whole) else []
            words_of.unread += [error] if _may_hide_result(whole, words_of) else []
            if len(errors) >= MOST_LACKING or error.code == "E703":
                break
    aside = dict.fromkeys(e.place.line for e in words if e.place is not None and e.place.line) if found else {}
    notes = [f"Line {line} has a part that was not read and not judged." for line in list(aside)[:MOST_TOLD]]
    return found, errors if found or errors or lines.remarks else [*words, *silent][:1], notes


def _may_hide_result(whole: str, words: Words) -> bool:
    """Whether a sentence has an equals sign and several names of the system, so that it may say an equation of motion
    in words."""
    return "=" in whole and len({x for x in re.findall(NAME, whole) if words.is_name(x)}) >= FEWEST_NAMES


def places_of_marks(
    rows: Sequence[AnswerRow], source: Source, latex: ExpandedLatex | None, words: Words
) -> tuple[MarkedRow, ...]:
    """Return the rows that have other readings, with the line where each begins."""
    counted = ((row, len(readings(row.text, words))) for row in rows)
    return tuple(MarkedRow(_source(row, source, latex).at(0).line or 1, row.start, n) for row, n in counted if n)


def _source(row: AnswerRow, source: Source, latex: ExpandedLatex | None) -> Source:
    """The text of a row, with its places in the whole answer."""
    start = row.start + len(row.text) - len(row.text.lstrip())
    written = row.text.strip() if latex is not None else with_points(row.text.strip())
    return Source(written, source.what, source.place, partial(_place, source, latex, start))


def _spans(own: Source, parser: Callable[[Source], Parser], lines: Lines, words: Words) -> list[Statement]:
    """The statements in a row of plain text that cannot be parsed as a whole; none if one of them cannot be parsed."""
    if "\\" in own.text:
        return []
    found: list[Statement] = []
    try:
        for span in statements(own.text, words):
            part = Source(own.text[span.start : span.end], own.what, own.place, lambda at, k=span.start: own.at(k + at))
            found.append(_statement(part, parser, lines, words))
    except ParseError:
        return []
    return found


@dataclass(frozen=True, slots=True)
class _List:
    """What was read of a list, whether a part that was not read has an equals sign, and whether it may redefine a name
    of the system."""

    read: tuple[Statement, ...]
    equated: bool
    redefines: bool


def _list(own: Source, parser: Callable[[Source], Parser], lines: Lines, words: Words) -> _List | None:
    """The definitions of new names in a list that cannot be read as a whole; None if a row is no such list."""
    read, rest = list[Statement](), list[str]()
    items = listed_items(own.text, words, lines.names.known) if "\\" not in own.text else []
    for item in items:
        part = Source(item.text, own.what, own.place, lambda at, k=item.start: own.at(k + at))
        found = _spans(part, parser, lines, words) if item.defines else []
        if item.defines and not found:
            return None
        read += found
        rest += [] if found else [item.text]
    if not items:
        return None
    lines.unread.update(key(x) for text in rest for x in re.findall(NAME, text))
    equated = [text for text in rest if "=" in text]
    return _List(tuple(read), bool(equated), any(may_redefine(text, words) for text in equated))


def _meanings(own: Source, parser: Callable[[Source], Parser], lines: Lines, words: Words) -> list[Statement]:
    """What a row of words says in passing of names that the system does not have: th = angle, Om = Omega."""
    found: list[Statement] = []
    if holds_in_a_case(own.text):
        return []
    for match in islice(_MEANING.finditer(own.text), MOST_LACKING):
        named = re.findall(NAME, match["value"])
        if lines.names.known(match["name"]) or not named or not all(words.is_name(x) for x in named):
            continue
        start = match.start("said")
        part = Source(match["said"], own.what, own.place, lambda at, k=start: own.at(k + at))
        try:
            found.append(_statement(part, parser, lines, words))
        except ParseError:
            continue
    return found


def _statement(own: Source, parser: Callable[[Source], Parser], lines: Lines, words: Words) -> Statement:
    """The statement of a row; a bracket that is missing at its end alone is closed there, which a note tells. Of one
    that cannot be read, no note tells how its words and numbers were read."""
    notes, splits = dict(lines.names.notes), words.splits()
    try:
        return Statement(tuple(parser(own).sides()), own)
    except ParseError as error:
        lines.names.notes.clear()
        lines.names.notes.update(notes)
        words.forget(splits)
        if error.code == "E703" or len(end := missing_brackets(own.text)) != 1 or end == "?" or "=" not in own.text:
            raise
        try:
            sides = tuple(parser(replace(own, text=own.text + end)).sides())
        except ParseError:
            words.forget(splits)
            raise error from None
        at = error.place.line if error.place is not None and error.place.line else 1
        lines.names.notes.setdefault(f"Line {at} lacks a bracket, which was closed at its end.")
        return Statement(sides, own)


def _is_stated(row: str, whole: str, words: Words) -> bool:
    """Whether a row that cannot be read is a statement, and no heading and no sentence; ``whole`` has the words in
    front of it."""
    linked = sum(word.lower() in LINKING for word in re.findall(r"[^\W\d_]+", whole))
    return "=" in row and linked < MANY_WORDS and not has_words(row, words) and not in_words(row, words)


def _place(source: Source, latex: ExpandedLatex | None, start: int, offset: int) -> Place:
    return source.at(start + offset if latex is None else latex.origin(start + offset))
