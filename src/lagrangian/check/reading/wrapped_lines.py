"""Joins the lines of an equation that was cut anywhere, as copying from a page and windows of mail do.

L²                                    L² (⅔ m + M cos² α) α'' − k L sin α = 0
(⅔ m + M cos² α) α''
− k L sin α = 0

A line without an equals sign belongs to the one below it, or to the one above it: both are readings that are possible
where no sign at an end says that a line goes on. Nothing goes on in a line with a label, x: …, and a line with a label
and without an equals sign says something by itself.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from lagrangian.check.reading.plain.ends import incomplete
from lagrangian.check.reading.prose.words import Words, function_of
from lagrangian.check.reading.prose.words_or_mathematics import is_sentence
from lagrangian.errors import ParseError

MOST, LONGEST = 200, 2_000
"""The most lines of an answer, and the most characters of one, that are looked at."""

_BEGINS = re.compile(r"\s*(?:[-+*/^=·×−–)\]]|#|%|//|[>|]|\w{1,12}[ ]?:)")
"""What goes on above, or begins something else."""
_LONG_NAME = re.compile(r"[^\W\d_]\w{2,}")
_MINUS = frozenset("-−–")
"""What begins a line that goes on, or another one."""
_EQUALS = re.compile(r"(?<![<>!:])=(?!>)")
_MATHEMATICS = re.compile(r"[\w)\]]")


def with_cut_lines(text: str, words: Words, beside: str) -> tuple[str, bool]:
    """A plain text with its cut lines together with those ``beside`` them, "below" or "above", if they are read so, and
    whether it may have some."""
    if not beside:
        return text, has_cut_lines(text, words)
    return with_lines_joined(text, words, below=beside == "below"), False


def refuse_unread(unread: Sequence[ParseError]) -> None:
    """Raise the first error of lines that cannot be read: one of them may be wrong."""
    if unread:
        raise unread[0]


def has_cut_lines(text: str, words: Words) -> bool:
    """Whether a line without an equals sign stands beside others of an equation, and nothing says which go on."""
    lines = text.split("\n")
    if len(lines) > MOST or not any("=" in line for line in lines):
        return False
    blocks = [block for block in _blocks(lines, words) if any(map(_EQUALS.search, block))]
    return any(_is_cut(above, line) for block in blocks for above, line in pairwise(block))


def _is_cut(above: str, line: str) -> bool:
    stated = sum(_EQUALS.search(x) is not None for x in (above, line))
    goes_on = _BEGINS.match(line)
    minus = stated == 0 and goes_on is not None and goes_on.group().strip() in _MINUS
    return stated < 2 and not incomplete(above) and (goes_on is None or minus)


def _is_mathematics(line: str, words: Words) -> bool:
    """Whether a line is part of an equation, and neither blank nor a sentence; one without an equals sign has no words,
    which are left out where it stands beside others, and no label."""
    if not line.strip() or len(line) > LONGEST or _MATHEMATICS.search(line) is None:
        return False
    if _EQUALS.search(line) is not None:
        return not is_sentence(line, words)
    named = [x.rstrip("⁰¹²³⁴⁵⁶⁷⁸⁹") for x in _LONG_NAME.findall(line)]
    return ":" not in line and all(words.readable(x) or words.is_product(x) or function_of(x) for x in named)


def with_lines_joined(text: str, words: Words, *, below: bool) -> str:
    """Return an answer in which a line without an equals sign goes on in the line ``below`` it, or else in the one
    above it; places stay."""
    joined = list[str]()
    for block in _blocks(text.split("\n"), words):
        stated = [_EQUALS.search(line) is not None for line in block]
        has_sign = stated[0]
        joined.append(block[0])
        for k in range(1, len(block)):
            goes_on = not any(stated[k:]) if below else not stated[k]
            joined.append(f"{' ' if goes_on or not has_sign else chr(10)}{block[k]}")
            has_sign = stated[k] or (has_sign and goes_on)
        joined.append("\n")
    return "".join(joined[:-1])


def _blocks(lines: Sequence[str], words: Words) -> Iterator[list[str]]:
    """The lines of mathematics that follow each other, together, and each other line alone."""
    block: list[str] = []
    for line in lines:
        if _is_mathematics(line, words):
            if ":" in line and block:
                yield block
                block = []
            block.append(line)
            continue
        if block:
            yield block
        block = []
        yield [line]
    if block:
        yield block
