"""Reads a whole answer: recognizes the notation, splits it into statements, and converts these to lines."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

from lagrangian.check.reading.answer import Answer
from lagrangian.check.reading.latex import LatexParser
from lagrangian.check.reading.latex_rows import latex_rows
from lagrangian.check.reading.lines import Lines, Statement
from lagrangian.check.reading.parser import Parser
from lagrangian.check.reading.plain import PlainParser
from lagrangian.check.reading.rows import MAX_STATEMENTS, AnswerRow, plain_rows
from lagrangian.errors import Place
from lagrangian.model import Model
from lagrangian.quantities.source import Source

MAX_ANSWER = 60_000
"""The largest number of characters of an answer."""

_LATEX = re.compile(r"\\[A-Za-z(\[\\]|\$|[_^]\{")


def parse_answer(text: str, model: Model, *, name: str | None = None) -> Answer:
    """Return the content of an answer to ``model``, line by line.

    ``text`` is LaTeX, or plain text in the grammar of model files; ``name`` is the name of its file, for messages.
    Names that the model does not have are listed in ``unknown`` of the answer; they are not errors. Nothing in the text
    is executed; sizes, depths and exponents are bounded. Raises `ParseError` with line, column, caret and what was
    expected there.
    """
    source = Source(text, "the answer", Place(name) if name else None)
    source.check_text(MAX_ANSWER, "an equation, such as m*x'' + k*x = F")
    latex = bool(_LATEX.search(text))
    rows = latex_rows(text) if latex else plain_rows(text)
    if not rows:
        raise source.error(
            "this contains no equation and no energy", 0, fix="write an equation, such as m*x'' + k*x = 0"
        )
    if len(rows) > MAX_STATEMENTS:
        what = f"more than {MAX_STATEMENTS} statements"
        raise source.error(what, rows[MAX_STATEMENTS].start, fix="give the answer in several parts", code="E703")
    lines = Lines(model)
    parser = partial(LatexParser, known=lines.names.known, misspelled=lines.names.misspelled) if latex else PlainParser
    statements = [_parsed(source, row, parser) for row in rows]
    return Answer(lines.read(statements), "latex" if latex else "text", tuple(lines.names.unknown.values()))


def _parsed(source: Source, row: AnswerRow, parser: Callable[[Source], Parser]) -> Statement:
    """Parse one statement; its places refer to the whole answer."""
    start = row.start + len(row.text) - len(row.text.lstrip())
    own = Source(row.text.strip(), source.what, source.place, lambda offset: source.at(start + offset))
    return Statement(tuple(parser(own).sides()), own)
