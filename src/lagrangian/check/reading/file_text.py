"""The text of an answer's file: UTF-8, UTF-16 as Windows writes it, or Windows-1252 if no letter is in doubt.

A file in another code page of Windows has the same bytes with other letters: θ of a Greek one is è. It is refused
unless everything beyond ASCII is a sign, ½ or ², or a letter in a word of a sentence: Lösung, énergie.
"""

from __future__ import annotations

import codecs
import re
from pathlib import Path

from lagrangian.check.reading.notebook_file import of_notebook
from lagrangian.errors import Error, ParseError, Place
from lagrangian.model.names import FUNCTIONS
from lagrangian.read import MAX_BYTES, decode

_MARKED = (
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_SIGNS = frozenset("½¼¾²³¹·×÷±°–—‘’‚“”„…•§´ \t™®©")
_LETTERS = frozenset("äöüÄÖÜßéèêëàâçôîïûùœæñóíúáÉÈÀÇ")
_KNOWN = _SIGNS | _LETTERS
_WORD = re.compile(r"[^\W\d_¹²³¼½¾]+")
_BEFORE = "^_²³*/+-−–=([)]|<>"
_BEHIND = "'’′″\"^_²³*/+-−–=([)]|<>"
_SHORTEST = 3
_MANY = 0.3
"""The share of zero bytes on one side from which a file without a mark is UTF-16: ASCII has one in every character."""


def decode_answer(data: bytes, name: str) -> str:
    """Return the text of an answer's file, of a notebook that of its cells; raises `ParseError` with its place if it is
    no text that can be told."""
    text = _text(data, name)
    found = of_notebook(text)
    return text if found is None else found


def read_text(path: Path) -> str:
    """Return the text of an answer's file; raises `Error` if it cannot be read."""
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        what = f"cannot read '{path}': {(error.strerror or str(error)).lower()}"
        raise Error(what, fix="check the path; - is standard input", code="E702") from error
    return decode_answer(data, str(path))


def _text(data: bytes, name: str) -> str:
    """The text of a file."""
    if len(data) > MAX_BYTES:
        raise _too_large(name)
    for mark, encoding in _MARKED:
        if data.startswith(mark):
            return _decoded(data, encoding, name)
    if (encoding := _unmarked(data)) is not None:
        return _decoded(data, encoding, name)
    if b"\0" not in data and (text := _of_windows(data)) is not None:
        return text
    if b"\0" in data:
        raise ParseError(
            "the file is no text: a picture, a PDF or a document (it contains a zero byte)",
            place=Place(name, data.count(b"\n", 0, data.index(b"\0")) + 1, 1),
            fix="give the equations as text, typed or in LaTeX",
            code="E702",
        )
    return decode(data, name)


def _too_large(name: str) -> ParseError:
    """The error for a file of more than the most that is read."""
    what = f"the file has more than {MAX_BYTES} bytes, and an answer has a few thousand"
    return ParseError(what, place=Place(name), fix="give the equations alone, as text", code="E703")


def _decoded(data: bytes, encoding: str, name: str) -> str:
    try:
        return data.decode(encoding)
    except UnicodeDecodeError:
        raise ParseError(
            f"the file is damaged: it begins as text in {encoding.upper()}, and does not go on so",
            place=Place(name),
            fix="save it again as text in UTF-8",
            code="E702",
        ) from None


def _unmarked(data: bytes) -> str | None:
    """The kind of UTF-16 that a file without a mark is; None if it is none."""
    if len(data) < 4 or len(data) % 2 or b"\0" not in data:
        return None
    high, low = (data[side::2].count(0) / (len(data) // 2) for side in (1, 0))
    if high > _MANY and low == 0:
        return "utf-16-le"
    return "utf-16-be" if low > _MANY and high == 0 else None


def _of_windows(data: bytes) -> str | None:
    """The text in Windows-1252; None if it is UTF-8, or if a letter may be another one."""
    try:
        data.decode("utf-8")
        return None
    except UnicodeDecodeError:
        pass
    try:
        text = data.decode("cp1252")
    except UnicodeDecodeError:
        return None
    return text if all(map(_is_sure, text.split("\n"))) else None


def _is_sure(line: str) -> bool:
    """Whether all characters of a line that are not ASCII are signs, or letters in words of a sentence."""
    if any(not c.isascii() and c not in _KNOWN for c in line):
        return False
    words = list(_WORD.finditer(line))
    ends = [0, *(word.end() for word in words)]
    starts = [*(word.start() for word in words), len(line)]
    equals, colon = line.find("="), line.rfind(":")
    for k, word in enumerate(words):
        if word.group().isascii():
            continue
        before, behind = line[ends[k] : word.start()].rstrip()[-1:], line[word.end() : starts[k + 1]].lstrip()[:1]
        stated = 0 <= equals < word.start() and colon < word.end()
        if stated or (before and before in _BEFORE) or (behind and behind in _BEHIND) or not _is_word(word.group()):
            return False
    return True


def _is_word(letters: str) -> bool:
    """Whether letters are a word of a sentence and no name: several, and no function."""
    if len(letters) < _SHORTEST:
        return False
    return not any(name in letters.lower() for name in FUNCTIONS if len(name) >= _SHORTEST)
