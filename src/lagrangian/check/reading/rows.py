"""Splits an answer in plain text into statements: continued lines, comments, and numbers or labels around them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import pairwise

from lagrangian.check.reading.markup import blank, opened_list
from lagrangian.check.reading.prose import is_prose, without_lead, without_remarks
from lagrangian.check.reading.words import Words
from lagrangian.model.names import FUNCTIONS

MAX_STATEMENTS = 500
"""The largest number of statements in one answer."""


@dataclass(frozen=True, slots=True)
class AnswerRow:
    """A statement: ``text`` begins at ``start`` of the answer; comments and labels in it are blanked out."""

    start: int
    text: str


_COMMENT = re.compile(r"(?:#|%|//(?=\s)).*")
_ARROW = re.compile(r"\s*(?:=>|⇒|⟹|->|→|⟶|∴|•|>)\s*")
_NUMBERED = re.compile(
    r"\s*(?:\(\s*(?:\d{1,3}[a-z]?|[ivx]{1,4}|[A-Z]-?\d)\s*\)|\[\s*\d{1,3}[a-z]?\s*\]|\d{1,3}[a-z]?[.)]|[a-h]\))"
    r"(?=\s+[^\s*/^])"
)
_LABEL = re.compile(r"\s*(?=[^=:]*[^\W\d_])[\w(][\w\s().,#'’-]{0,60}:(?!=)")
_WORDS = r"(?:where|with|and|so|thus|then|hence|therefore|let|also|gives|we get|so that)"
_ENGLISH_LISTED = (
    "the is are of for we with that this these as get gets gives obtain find finds have has so and then "
    "thus hence where let therefore since because both every equation equations motion energy kinetic "
    "potential coordinate coordinates first second becomes follows which yields now finally using from by "
    "in at on to reads"
)
ENGLISH = frozenset(_ENGLISH_LISTED.split())
"""Words that are seldom names."""

_LEADING = re.compile(r"\s*(?:[^\W\d_]+[,:]?\s+)+(?=\S)")
_TRAIL = re.compile(rf"(?<=[\w)\]'’′²³])\s*,?\s+{_WORDS}\s*[,:]?\s*\Z", re.IGNORECASE)
_AFTER = re.compile(
    r"(?<=[\w)\]'’′″²³])(?:\s*[.,;])?\s+(?:\(\s*(?:\d{1,3}[a-z]?|[ivx]{1,4})\s*\)|\[\s*\d{1,3}[a-z]?\s*\])\s*[.,;]?\s*\Z"
)
_OPEN_END = re.compile(r"(?:[-+*/×·=(\[,^−]|\.\.\.|…|\\)\s*\Z")
_OPEN_START = re.compile(r"\s*(?:[+*/×·)\]^]|=(?!>))")
_MINUS_START = re.compile(r"\s*[-−–]")
_STATEMENT_SIGN = re.compile(r"[=+*/^()\[\]'′″\u0307\u0308]")
_DOTTED = re.compile(r"(?:\.\.\.|…|\\)(?=\s*\Z)")
_TAIL = re.compile(r"(?<!\.)[.,;:]\s*\Z")
_PLUS_END = re.compile(r"\+\s*\Z")
_PLUS_START = re.compile(r"\s*\+")
_GOES_ON = re.compile(r"\s*(?:\.\.\.|…)")

_ARROWS = "<?=>|⇒|⟹|⇔|⟺|<?-+>|→|⟶|↔|⟷|∴"
_LINKS = r"(?<=[\s,;])(?:and|where|with|so|thus|hence|therefore|implies|then|i\.e\.)(?=[\s,:])"
_BETWEEN = re.compile(rf"[(\[{{}}\])\n]|(?<=[^\s>])[ \t]*(?P<arrow>{_ARROWS}|\bimplies\b)|{_LINKS}")


def plain_rows(text: str, words: Words) -> list[AnswerRow]:
    """Return the statements of an answer in plain text; headings and remarks are ignored."""
    text = without_remarks(text, words)
    text = _separated(opened_list(text) if "\n\n" not in text.strip() else text)
    text = "\n".join(opened_list(line) if "Eq" in line else line for line in text.split("\n"))
    rows: list[AnswerRow] = []
    offset = 0
    open_row: AnswerRow | None = None
    for line in re.split(r"(?<=\n)", text):
        bare = _COMMENT.sub(lambda m: " " * len(m.group()), line.rstrip("\r\n"))
        if not bare.strip():
            open_row = None
        elif open_row is not None and (_continues(open_row.text, bare) or _GOES_ON.match(bare)):
            bare = _GOES_ON.sub(lambda m: " " * len(m.group()), bare, count=1)
            head = _DOTTED.sub(lambda m: " " * len(m.group()), open_row.text)
            if (repeated := _PLUS_END.search(head)) is not None and _PLUS_START.match(bare):
                head = blank(head, repeated.start(), len(head))  # "a + …" continues with "… + b"
            gap = offset - open_row.start - len(head)
            rows[-1] = open_row = AnswerRow(open_row.start, head + " " * gap + _after(bare))
        elif (stripped := _before(bare)).strip() and not plain_words(stripped):
            open_row = AnswerRow(offset, _after(stripped))
            rows.append(open_row)
        offset += len(line)
    split = [piece for row in rows for part in pieces(row, ";", always=True) for piece in pieces(part, ",")]
    found = [AnswerRow(row.start, without_lead(_without_lead(row).text, words)) for row in split]
    stated = [row for row in found if not is_prose(row.text, words)]
    return stated or found[:1]


def _separated(text: str) -> str:
    """Replace arrows and linking words between statements by semicolons: a = b ⇒ c = d, a = b and c = d."""
    depth = 0
    letters = list(text)
    for match in _BETWEEN.finditer(text):
        mark = match.group()
        if mark in "([{":
            depth += 1
        elif mark in ")]}":
            depth -= 1
        elif mark == "\n":
            depth = depth if depth > 0 else 0
        elif depth <= 0 and (match["arrow"] or _both(text, match.start(), match.end())):
            at = match.start()
            letters[at : match.end()] = ";" + " " * (match.end() - at - 1)
    return "".join(letters)


def _both(text: str, start: int, end: int) -> bool:
    """Whether there is an equals sign on the same line before and after a place."""
    first, last = text.rfind("\n", 0, start) + 1, text.find("\n", end)
    return "=" in text[first:start] and "=" in text[end : last if last >= 0 else len(text)]


def _before(line: str) -> str:
    """Blank out an arrow, a number or a label before a statement."""
    for form in (_ARROW, _NUMBERED, _LABEL, _ARROW):
        if match := form.match(line):
            line = blank(line, 0, match.end())
    return line


def _without_lead(row: AnswerRow) -> AnswerRow:
    """Blank out English words in front: "the kinetic energy is T = …"."""
    if (match := _LEADING.match(row.text)) is None:
        return row
    words = [w for w in re.finditer(r"[^\W\d_]+", match.group()) if w.group().lower() in ENGLISH]
    return AnswerRow(row.start, blank(row.text, 0, words[-1].end() + 1)) if words else row


def _after(line: str) -> str:
    """Blank out the number of an equation after it, and a full stop."""
    for form in (_TAIL, _TRAIL, _AFTER, _TAIL):
        if match := form.search(line):
            line = blank(line, match.start(), len(line))
    return line


def plain_words(line: str) -> bool:
    """Whether a line consists of words, without anything found in an expression or equation."""
    words = re.findall(r"[^\W\d_]{2,}", line)
    return len(words) >= 2 and not _STATEMENT_SIGN.search(line) and not FUNCTIONS & set(words)


def _remark(part: str) -> bool:
    """Whether a part of a line consists of words: "with the stretch s,"."""
    words = re.findall(r"[^\W\d_]+", part)
    return "=" not in part and any(w.lower() in ENGLISH for w in words) and not FUNCTIONS & set(words)


def _continues(before: str, line: str) -> bool:
    if incomplete(before) or _OPEN_START.match(line):
        return True
    if not _MINUS_START.match(line):
        return False
    return ("=" in before) != ("=" in line) or (line[:1].isspace() and "=" not in line)


def incomplete(text: str) -> bool:
    """Whether the statement must continue: it ends with an operator, or a bracket is open."""
    return bool(_OPEN_END.search(text)) or sum((c in "([") - (c in ")]") for c in text) > 0


def _stated(part: str) -> bool:
    """Whether a part of a row is a statement of its own."""
    return "=" in part or bool(re.match(r"\s*Eq\w*\s*[(\[]", part))


def pieces(row: AnswerRow, separators: str, *, always: bool = False) -> list[AnswerRow]:
    """Split a row at separators outside brackets; unless ``always``, only if every piece contains an =."""
    cuts, depth = [-1], 0
    for i, c in enumerate(row.text):
        depth += (c in "([{") - (c in ")]}")
        if depth == 0 and c in separators:
            cuts.append(i)
    cuts.append(len(row.text))
    parts = [(a + 1, row.text[a + 1 : b]) for a, b in pairwise(cuts)]
    if any(_stated(part) for _, part in parts):
        parts = [(at, part) for at, part in parts if not _remark(part)]
    if (
        len(parts) > 1
        and not always
        and sum(_stated(part) for _, part in parts) < sum(bool(part.strip()) for _, part in parts)
    ):
        return [row]
    return [AnswerRow(row.start + at, part) for at, part in parts if part.strip()]
