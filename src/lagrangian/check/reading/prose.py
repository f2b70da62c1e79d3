"""Tells words from mathematics in plain text: headings, remarks in brackets, words before a statement."""

from __future__ import annotations

import re

from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.words import Words

_REMARK = re.compile(r"(?<=\s)\(([^\W\d_][^()=+*/^\n]*)\)")
_MATHEMATICS = re.compile(r"\s[-−]\s|['′]{1,2}(?:\s|$)")
_IDENTIFIER = re.compile(r"[^\W\d]\w*")
_WORD = re.compile(r"[^\W\d_]+(?:['’-][^\W\d_]+)*")
_LEADING = re.compile(r"\s*((?:[^\W\d_]{2,}(?:-[^\W\d_]+)*[,:]?\s+)+)(?=\S)")
_NUMBER_ALONE = re.compile(r"\s*[(\[]?\s*\d{0,3}[a-z]?\s*[)\]]?\s*[.,;:]?\s*\Z")
_SINGLE = re.compile(r"\s*[^\W\d_]+[.,:]?\s*\Z")
_SHORTEST = 3
"""The fewest letters of a word that cannot be a name."""


def without_remarks(text: str, words: Words) -> str:
    """Return an answer without words in brackets: T (kinetic), u = y + l θ (front end)."""
    for match in reversed(list(_REMARK.finditer(text))):
        listed = _WORD.findall(match[1])
        if _MATHEMATICS.search(match[1]) or any(words.known(x) for x in _IDENTIFIER.findall(match[1]) if len(x) > 2):
            continue
        if any(_is_word(x, words) for x in listed) and not any(len(x) > 2 and words.is_name(x) for x in listed):
            text = blank(text, match.start(), match.end())
    return text


def without_lead(text: str, words: Words) -> str:
    """Return a statement without the words in front of it: absolute displacements x1 = w1 + s."""
    match = _LEADING.match(text)
    if match is None or "=" not in text:
        return text
    end = match.start(1)
    for word in re.finditer(r"\S+\s+", match[1]):
        if not _is_word(word.group().strip(" \t,:"), words):
            break
        end = match.start(1) + word.end()
    return blank(text, 0, end) if end > match.start(1) else text


def is_prose(text: str, words: Words) -> bool:
    """Whether a row without an equals sign is no expression: it contains a word, or only a number."""
    if "=" in text or re.search(r"\bEq\w*\s*[(\[]", text):
        return False
    if _NUMBER_ALONE.match(text) or _SINGLE.match(text):
        return True
    return any(_is_word(x, words) for x in _WORD.findall(text))


def _is_word(written: str, words: Words) -> bool:
    """Whether this is a word and no name: long enough, and nothing that the system or the answer has."""
    parts = re.split(r"['’-]", written)
    return any(
        len(x) >= _SHORTEST and not words.readable(x) and not words.is_product(x) and not words.names.known(x)
        for x in parts
    )
