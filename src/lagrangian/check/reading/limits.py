"""How long an answer may be, and how many statements it may have."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.check.reading.latex.macros import ExpandedLatex
from lagrangian.check.reading.plain.rows import MAX_STATEMENTS, AnswerRow
from lagrangian.quantities.source import Source

MAX_ANSWER = 60_000
"""The largest number of characters of an answer."""


def check_length(source: Source) -> None:
    """Raise `ParseError` if an answer whose notation is written out is too long."""
    if len(source.text) > MAX_ANSWER:
        longest = f"written out, the answer has more than {MAX_ANSWER} characters"
        raise source.error(longest, 0, fix="give the equations alone", code="E703")


def check_number(rows: Sequence[AnswerRow], source: Source, latex: ExpandedLatex | None) -> None:
    """Raise `ParseError` if an answer has no statements, or too many."""
    if not rows:
        raise source.error(
            "this contains no equation and no energy", 0, fix="write an equation, such as m*x'' + k*x = 0"
        )
    if len(rows) > MAX_STATEMENTS:
        at = rows[MAX_STATEMENTS].start if latex is None else latex.origin(rows[MAX_STATEMENTS].start)
        what = f"more than {MAX_STATEMENTS} statements"
        raise source.error(what, at, fix="give the answer in several parts", code="E703")
