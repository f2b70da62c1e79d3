"""What may be no part of a formula: names, numbers and words in front of it and behind it, and units.

(psi) [J + m r²] ψ″ = τ        which equation follows, or a factor
x:  m x″ + k x = F             likewise
m x″ + k x = F (driven)        a remark, or a factor
m x″ + k x = F     cart        a word that is far away

The most likely reading is tried first; these are tried where a line is not right or cannot be read. What is left out
is a short mark or consists of words: no sum, no power and no rate.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.prose.words import Words, function_of
from lagrangian.check.reading.prose.words_or_mathematics import ADDING, LINKING
from lagrangian.quantities.units import lookup

MOST = 6
"""The largest number of readings of a line."""

LONGEST = 2_000
"""The most characters of a line that is read in several ways."""

FAR = 200
"""The most characters that are left out in front of a formula or behind it."""

_MARK = r"(?:[^\W\d_]\w{0,12}+['’′″]{0,2}|\d{1,2}(?:\.\d{1,2})?[a-z]?['’′*]?)"
_IN_FRONT = (
    re.compile(rf"\s*+(?:\(\s?{_MARK}\s?\)|\[\s?{_MARK}\s?\]|\{{\s?{_MARK}\s?\}})\s?[.:]?(?=\s*+[^\s=+*/^)\]])"),
    re.compile(rf"\s*+{_MARK}(?:\s{_MARK})?\s?(?:[:)|]|[-–—=]?>)(?!=)"),
    re.compile(rf"\s*+{_MARK}(?:\s\s|\t)\s*+(?=[^\s=+*/^)])"),
)
"""Names and numbers in front: in brackets, with a sign behind, or far away."""
_LEADING = re.compile(r"\s*+(?:[^\W\d_][\w.’-]{0,20}+[,.:]?\s++){1,8}+(?=[^\s=+*/^)])")
_HEAD = re.compile(r"[^=:\n]{2,120}+:(?=[^:=]*=)|(?:\s*+[^\W\d_][\w.’]{0,20}+){1,8}+\s++[-–—](?=\s)")
_SHORT_BEHIND = re.compile(
    r"\s(?:\(\s?\w[\w.*'’-]{0,3}\s?\)|\[\s?\w[\w.*'’-]{0,3}\s?\]|[ \t][^\W\d_]\w{0,12}+)\s?[.,;]?\s?\Z"
)
_APART = re.compile(r"[ \t]{2}|\t|[,;|!:%#]|--|[–—]|//|<-|←|\.\.\.|…|[ \t](?=[(\[]|[^\W\d_]{2})")
"""Where words behind a formula may begin."""
_SAID = re.compile(r"[\s.,;:!?<←|…%#/–—-]*+(?:[(\[]?[^\W\d_][\w.’'-]{0,20}+[)\]]?[\s.,;:!?/-]*+){1,20}+\Z")
_BRACKETS = re.compile(r"\s(?P<whole>[(\[](?P<said>[^()\[\]=\n]{2,80})[)\]])")
_TEXT = re.compile(r"(?<![_^{])\\(?:text|textrm|textbf|textit|mbox|emph)\s?\{(?P<said>[^{}]{0,200})\}")
_UNIT = re.compile(r"(?<=[\w)\]])\s\s?\[?(?P<unit>[A-Za-zµΩ][A-Za-zµΩ·*/^²³⁻¹\d]{0,11}+)\]?\s?[.,;]?\s?\Z")
_WORD = re.compile(r"[^\W\d_]+")
_NAMES = re.compile(r"[^\W\d]\w*+")
_FORMULA = re.compile(r"[=+*^′″²³\u0307\u0308\\]|['’](?![a-z])|\d\s*[-/]|[-/]\s*\d")
_OPEN = re.compile(r"[-+*/·×^(\[,−–]\s*\Z")
_SHORTEST = 3


def readings(text: str, words: Words) -> list[str]:
    """The other readings of a statement: with what may be no part of the formula blank, each once."""
    if len(text) > LONGEST or "=" not in text:
        return []
    front, behind = list(_without_front(text, words)), list(_without_end(text, words))
    between = _without_remarks(text, words)
    both = [_both(x, y) for x in front[:1] for y in behind]
    found = dict.fromkeys(x for x in (*front, *behind, between, *both) if _is_whole(x))
    found.pop(text, None)
    return list(found)[:MOST]


def told_without(text: str, reading: str) -> str:
    """What a reading of a statement leaves out, in a note."""
    told = "".join("\n" if a == b and not a.isspace() else a for a, b in zip(text, reading, strict=True))
    parts = [" ".join(x.split()) for x in told.split("\n")]
    left = " and ".join(f"'{x}'" for x in parts if x)
    return f"'{' '.join(text.split())}' was read without {left}."


def _is_whole(text: str) -> bool:
    """Whether both sides of a statement are left, and no sign joins the last one to what was left out."""
    return all(side.strip() for side in text.split("=")) and _OPEN.search(text) is None


def _both(one: str, other: str) -> str:
    return "".join(" " if a != b else a for a, b in zip(one, other, strict=True))


def _without_front(text: str, words: Words) -> Iterator[str]:
    for form in _IN_FRONT:
        match = form.match(text)
        if match is not None and match.end() < len(text) and _is_mark(match.group(), words):
            yield blank(text, 0, match.end())
    if (head := _HEAD.match(text)) is not None and _speaks(head.group(), words):
        yield blank(text, 0, head.end())
    if (said := _LEADING.match(text)) is not None:
        ends = [m.end() for m in re.finditer(r"\S+\s+", said.group()) if _speaks(m.group(), words)]
        changed = any(x.lower() in ADDING for x in _WORD.findall(said.group()))
        if ends and not changed:
            yield blank(text, 0, ends[-1])


def _without_end(text: str, words: Words) -> Iterator[str]:
    start = max(text.rfind("=") + 1, len(text) - FAR)
    if (mark := _SHORT_BEHIND.search(text, start)) is not None and _is_mark(mark.group(), words):
        yield blank(text, mark.start(), len(text))
    for match in _APART.finditer(text, start):
        said = text[match.start() :]
        far = not match.group().isspace() or len(match.group()) > 1 or text[match.end() : match.end() + 1] in "(["
        more = far or (_begins(said, words) and len(_WORD.findall(said)) > 1)
        if more and _SAID.match(said) and _speaks(said, words):
            yield blank(text, match.start(), len(text))
            break
    unit = _UNIT.search(text, start)
    if unit is not None and not words.is_name(unit["unit"]) and lookup(unit["unit"]) is not None:
        yield blank(text, unit.start(), len(text))


def _is_mark(said: str, words: Words) -> bool:
    """Whether the names in a text are coordinates, or neither the system's nor found elsewhere in the answer."""
    listed = _NAMES.findall(said)
    return all(words.names.changes(x) or (not words.known(x) and words.count(x) <= 1) for x in listed)


def _without_remarks(text: str, words: Words) -> str:
    """A text without all that stands in brackets and consists of words."""
    for form in (_BRACKETS, _TEXT):
        for match in form.finditer(text):
            if _speaks(match["said"], words):
                start = match.start("whole") if form is _BRACKETS else match.start()
                text = blank(text, start, match.end())
    return text


def _speaks(said: str, words: Words) -> bool:
    """Whether a text holds a word that is no name and no function, and no formula."""
    listed = _WORD.findall(said)
    if _FORMULA.search(said) or any(x.lower() in ADDING or function_of(x) is not None for x in listed):
        return False
    return any(_is_word(x, words) for x in listed)


def _begins(said: str, words: Words) -> bool:
    """Whether the first word of a text is no name."""
    first = _WORD.search(said)
    return first is not None and (_is_word(first.group(), words) or first.group().lower() in LINKING)


def _is_word(written: str, words: Words) -> bool:
    return len(written) >= _SHORTEST and not words.readable(written) and not words.is_product(written)
