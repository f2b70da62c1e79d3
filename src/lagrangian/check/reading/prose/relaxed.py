r"""Sets aside where a spring is said to be relaxed, which no motion keeps to: the spring is relaxed when x = R θ/2."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText

_RELAXED = re.compile(
    r"(?<!\w)(?:un(?:stretched|stressed|strained|deformed|deflected|loaded|tensioned|twisted)|relaxed|untensioned"
    r"|(?:force|stress|tension)[ -]?free"
    r"|entspannt|ungespannt|ungedehnt|unverformt|unbelastet|spannungs(?:los|frei)|kraft(?:los|frei)|détendue?)(?!\w)",
    re.IGNORECASE,
)
_SENTENCE = re.compile(r"(?:[^.;\n]|\.(?!\s))+")
_LEFT = re.compile(r"(?<![\w\\*/^+'’′)\]}-])(?P<open>\$[ \t]*+|)(?P<name>\\?[^\W\d]\w{0,15}+)[ \t]*&?=(?![=>])[ \t]*")
_TOKEN = re.compile(
    r"[ \t]*(?:\\(?P<command>[A-Za-z]+)|(?P<name>[^\W\d_](?:\w|_\{\w{1,8}\})*+)|\d+(?:[.,]\d+)?"
    r"|[-+−–*/·×^²³¼½¾(){}]|\\[,;! ])"
)
_COMMANDS = frozenset(["frac", "tfrac", "dfrac", "cdot", "left", "right", "pi"])
_ENDS = re.compile(r"[ \t]*(?:(?P<close>\$)|[,:)\]]|$|(?=[^\W\d_]{3}|(?:is|so|at|in|of|an|we|or|am|im)\b))")
_ZERO = re.compile(r"0(?![\w.,]?\d)")
_FIRST = re.compile(r"(?:^|[,;:(\n]|[^\W\d_]{4,23})[ \t]*\Z")
"""What stands before a coordinate that is 0 and no factor: x = 0 with the spring relaxed."""
_CLAUSES = re.compile(r"[,;:()]")
LONGEST = 120
"""The most characters of a part of a sentence on each side."""
MOST = 200
"""The most sentences that are looked at."""


def without_relaxed(
    written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool], notes: dict[str, None]
) -> TracedText:
    """Return an answer without the positions of coordinates of the system at which its sentences say that something is
    relaxed, as notes tell; ``moves``: whether a name is a coordinate, ``taken``: whether the system has it."""
    found = list(_positions(written.text, moves, taken))
    for start, end, _ in found:
        said = " ".join(written.text[start:end].strip(" \t$").split())
        notes.setdefault(f"'{said}' was not judged: it says where something is relaxed.")
    return written.edited(found)


def _positions(text: str, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> Iterator[Edit]:
    """Blanks for the positions in sentences with words for what is relaxed."""
    for relaxed in [m for _, m in zip(range(MOST), _SENTENCE.finditer(text), strict=False) if "=" in m.group()]:
        if _RELAXED.search(relaxed.group()) is None:
            continue
        for left in _LEFT.finditer(text, relaxed.start(), relaxed.end()):
            name = left["name"].lstrip("\\")
            if not taken(name) or not moves(name):
                continue
            zero = _ZERO.match(text, left.end()) if _is_first(text, left.start(), relaxed) else None
            end = zero.end() if zero is not None else _end(text, left.end(), relaxed.end(), taken)
            close = _ENDS.match(text, end, relaxed.end()) if end > left.end() else None
            if close is not None and (close["close"] is None) == (left["open"] == ""):
                end = close.end("close") if close["close"] else end
                yield left.start("open"), end, " " * (end - left.start("open"))


def _is_first(text: str, at: int, said: re.Match[str]) -> bool:
    """Whether no factor stands before a coordinate, and words for what is relaxed do in the same part of a sentence."""
    before = text[max(said.start(), at - LONGEST) : at]
    behind = text[at : min(said.end(), at + LONGEST)]
    clause = _CLAUSES.split(before)[-1] + _CLAUSES.split(behind)[0]
    return _FIRST.search(before) is not None and _RELAXED.search(clause) is not None


def _end(text: str, at: int, last: int, taken: Callable[[str], bool]) -> int:
    """Where the value ends that consists of names of the system, functions and numbers; where it begins if it holds no
    name."""
    begin, named, depth = at, False, 0
    while (token := _TOKEN.match(text, at, last)) is not None:
        word = token["name"] or token["command"]
        if word is not None and not _is_read(word, token["command"] is not None, taken):
            break
        mark = token.group().strip()
        depth += (mark in ("(", "{")) - (mark in (")", "}"))
        if depth < 0:
            break
        named, at = named or word is not None, token.end()
    return at if named and depth <= 0 else begin


def _is_read(word: str, command: bool, taken: Callable[[str], bool]) -> bool:
    """Whether a word is a name of the system, a product of a few such letters, a function or a command between them."""
    if command and word in _COMMANDS:
        return True
    return taken(word) or function_of(word) is not None or (len(word) < 4 and all(map(taken, word)))
