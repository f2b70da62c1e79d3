"""Refuses sentences that quote what the student did not write.

A sentence such as "r₂ stands in place of r₁" says that r₂ stands in the answer. The effect of a mistake on the
equations may be that of another mistake in which no r is left at all; the sentence would then be false.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.check.verdict import AnsweredLine, Mistake
from lagrangian.model import time

LINE = re.compile(r"\b[Ll]ine (?P<number>\d{1,6})\b")
"""How words name a line of the answer."""
BEFORE = (
    "is taken as ",
    "are taken as ",
    "made of ",
    "stretched by ",
    " feels ",
    "turns with ",
    "has the mass ",
    ", not ",
    "added as numbers, ",
    "the factor is ",
    "replaced by ",
    " stands ",
)
"""Words after which a sentence says what was written."""
AFTER = (" stands in place of ", " stands once", " stands squared", " stands on the wrong side", " too much")
"""Words before which it does."""


def letters_of(lines: Sequence[AnsweredLine]) -> set[sp.Basic]:
    """The letters, coordinates and inputs in the lines of an answer."""
    return {x for line in lines for x in letters_in(line.expr)}


def is_quotable(mistake: Mistake, written: set[sp.Basic]) -> bool:
    """Whether all letters that the words of a mistake say were written stand in the answer."""
    return all(letters_in(expr) <= written for expr in claimed(mistake))


def claimed(mistake: Mistake) -> Iterator[sp.Expr]:
    """What the words of a mistake say was written."""
    parts = mistake.what.parts
    for k, part in enumerate(parts):
        before = parts[k - 1] if k else ""
        after = parts[k + 1] if k + 1 < len(parts) else ""
        if not isinstance(part, sp.Expr):
            continue
        said = isinstance(before, str) and before.endswith(BEFORE)
        if said or (isinstance(after, str) and after.startswith(AFTER)):
            yield part


def letters_in(expr: sp.Expr) -> set[Any]:
    """The letters, coordinates and inputs in an expression."""
    return {x for x in bounded.letters(expr) if x != time}
