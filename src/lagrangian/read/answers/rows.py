"""An answer cut into statements: lines and their continuations, comments, numbers and labels before or after them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import pairwise

MAX_STATEMENTS = 500
"""Most statements in one answer."""


@dataclass(frozen=True, slots=True)
class Row:
    """A statement: ``text`` begins at ``start`` of the answer, with comments and labels blanked out."""

    start: int
    text: str


_COMMENT = re.compile(r"(?:#|%|//(?=\s)).*")
_ARROW = re.compile(r"\s*(?:=>|⇒|⟹|->|→|⟶|∴|•|>)\s*")
_NUMBERED = re.compile(r"\s*(?:\(\s*\w{1,4}\s*\)|\[\s*\d{1,3}[a-z]?\s*\]|\d{1,3}[a-z]?[.)])(?=\s+\S)")
_LABEL = re.compile(r"\s*(?=[^=:]*[^\W\d_])[\w(][\w\s().,#'’-]{0,60}:(?!=)")
_WORDS = r"(?:where|with|and|so|thus|then|hence|therefore|let|also|gives|we get|so that)"
_LEAD = re.compile(rf"\s*{_WORDS}\b[,:]?(?=\s+\S)", re.IGNORECASE)
_TRAIL = re.compile(rf"(?<=[\w)\]'’′²³])\s*,?\s+{_WORDS}\s*[,:]?\s*\Z", re.IGNORECASE)
_AFTER = re.compile(
    r"(?<=[\w)\]'’′²³])\s+(?:\(\s*(?:\d{1,3}[a-z]?|[ivx]{1,4})\s*\)|\[\s*\d{1,3}[a-z]?\s*\])\s*[.,;]?\s*\Z"
)
_OPEN_END = re.compile(r"(?:[-+*/×·=(\[,^−]|\.\.\.|…|\\)\s*\Z")
_OPEN_START = re.compile(r"\s*[+*/×·=)\]^]")
_MINUS_START = re.compile(r"\s*[-−–]")
_STATEMENT_SIGN = re.compile(r"[=+*/^()\[\]]|\d")
_DOTTED = re.compile(r"(?:\.\.\.|…|\\)(?=\s*\Z)")
_TAIL = re.compile(r"[.,;]\s*\Z")


def blank(text: str, start: int, end: int) -> str:
    """Return the text with [start, end) replaced by as many spaces, so that every place stays where it was."""
    return text[:start] + " " * (end - start) + text[end:]


def plain_rows(text: str) -> list[Row]:
    """Return the statements of an answer in plain text."""
    rows: list[Row] = []
    offset = 0
    open_row: Row | None = None
    for line in re.split(r"(?<=\n)", text):
        bare = _COMMENT.sub(lambda m: " " * len(m.group()), line.rstrip("\r\n"))
        if not bare.strip():
            open_row = None
        elif open_row is not None and _continues(open_row.text, bare):
            head = _DOTTED.sub(lambda m: " " * len(m.group()), open_row.text)
            gap = offset - open_row.start - len(head)
            rows[-1] = open_row = Row(open_row.start, head + " " * gap + _after(bare))
        elif (stripped := _before(bare)).strip() and not plain_words(stripped):
            open_row = Row(offset, _after(stripped))
            rows.append(open_row)
        offset += len(line)
    return [piece for row in rows for part in pieces(row, ";", always=True) for piece in pieces(part, ",")]


def _before(line: str) -> str:
    """Blank out an arrow, a number or a label before a statement."""
    for form in (_ARROW, _NUMBERED, _LABEL, _ARROW, _LEAD):
        if match := form.match(line):
            line = blank(line, 0, match.end())
    return line


def _after(line: str) -> str:
    """Blank out the number of an equation behind it, and a full stop."""
    for form in (_TAIL, _TRAIL, _AFTER, _TAIL):
        if match := form.search(line):
            line = blank(line, match.start(), len(line))
    return line


def plain_words(line: str) -> bool:
    """Whether a line is words: nothing in it that an expression or equation has."""
    words = re.findall(r"[^\W\d_]{2,}", line)
    return len(words) >= 2 and not _STATEMENT_SIGN.search(line)


def _continues(before: str, line: str) -> bool:
    if incomplete(before) or _OPEN_START.match(line):
        return True
    if not _MINUS_START.match(line):
        return False
    return ("=" in before) != ("=" in line) or (line[:1].isspace() and "=" not in line)


def incomplete(text: str) -> bool:
    """Whether something must follow: an operator stands at the end, or a bracket is open."""
    return bool(_OPEN_END.search(text)) or sum((c in "([") - (c in ")]") for c in text) > 0


def pieces(row: Row, separators: str, *, always: bool = False) -> list[Row]:
    """Split a row at separators outside brackets, unless ``always`` only where every piece has an =."""
    cuts, depth = [-1], 0
    for i, c in enumerate(row.text):
        depth += (c in "([{") - (c in ")]}")
        if depth == 0 and c in separators:
            cuts.append(i)
    cuts.append(len(row.text))
    parts = [(a + 1, row.text[a + 1 : b]) for a, b in pairwise(cuts)]
    if (
        len(parts) > 1
        and not always
        and sum("=" in part for _, part in parts) < sum(bool(part.strip()) for _, part in parts)
    ):
        return [row]
    return [Row(row.start + at, part) for at, part in parts if part.strip()]
