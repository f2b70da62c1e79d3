"""Takes the layout of other programs off an answer: Markdown, code fences, lists, the brackets of a list of equations.

Everything is replaced by spaces, so that all places stay the same.
"""

from __future__ import annotations

import re
from itertools import pairwise

from lagrangian.check.reading.ruled import without_rules
from lagrangian.check.reading.traced_text import TracedText

_FENCE = re.compile(r"^[ \t]*(?:```|~~~)[^\n]*$", re.MULTILINE)
_RULE = re.compile(r"^[ \t]*(?:[-=_~–—][ \t]*){3,}$|^[ \t]*(?:\*[ \t]*){3,}$", re.MULTILINE)
_CODE = re.compile(r"(?<!`)(`{1,2})(?!`)([^`\n]+)\1(?!`)")
_BOLD = re.compile(r"(?<![\w)\]'*])(\*\*|__)(?=[^\s*_])([^*\n]*?[^\s*])\1(?![\w(*])")
_ITALIC = re.compile(r"(?<=[\s(,])(\*|_)(?=[^\W\d_]{3})([^\W\d_]+(?:[ -][^\W\d_]+){0,8})\1(?=[\s.,;:)!?])")
"""A word or some between single marks: *clockwise*."""
_HEADING = re.compile(r"^[ \t]{0,3}#{1,6}[ \t][^\n]*$", re.MULTILINE)
_QUOTE = re.compile(r"^[ \t]*(?:>[ \t]*)+", re.MULTILINE)
_BULLET = re.compile(r"^[ \t]*[-*+•–][ \t]+(?=\S)", re.MULTILINE)
_OF_FORCE = re.compile(r"^[ \t]*[-–][ \t]+(?=(?:Q|Ξ|Xi)_?\w{1,12}[ \t]*=)", re.MULTILINE)
"""What stands in front of a generalized force that a line states is no minus."""
_OF_CODE = re.compile(r"^[ \t]*[-*+•–][ \t]+(?=`)", re.MULTILINE)
"""Nor is what stands in front of a piece of code."""
_TERM = re.compile(
    r"[ \t]*[-–][ \t]+(?![$]|\\[(\[]|[^\W\d]\w*(?:\{\w{1,12}\})?['’′]{0,2}[ \t]*[:=]"
    r"|[^\W\d_]{2,}:?[ \t]+[^\W\d_]{2,}(?!\w)[ \t:])"
)
"""A line that begins with a minus or a bullet and goes on with a formula, not with words or a name and its value."""
_PRINTED = re.compile(r"\{\\left\(t \\right\)\}|\\frac\{d(?:\^\{2\})?\}\{d t")
"""How SymPy prints LaTeX, in which a blank stands behind a minus."""
_SIGNED = re.compile(r"[ \t]*[-+–]")
_UNFINISHED = re.compile(r"^(?=[^=]*['′″²³*^()\u0307\u0308])[^=:]*[^\s=:.,;][ \t]*$")
"""A line that ends in mathematics and has no equals sign."""
_PARAGRAPHS = re.compile(r"(\n[ \t]*\n)")
_LISTS = re.compile(r"\s*(?:(?P<open>[\[{(])|\w+\s*=\s*(?P<named>[\[{]))\s*(?=\S)")
_STATED = re.compile(r"==|\bEq\s*\(|\bEquality\s*\(")
_ANY = re.compile(r"=|\bEq\w*\s*\(")
_FRAME = re.compile("[\u2500-\u257f]")
_TABLE = re.compile(r"^[ \t]*\|(?=\s).*\s\|[ \t]*$", re.MULTILINE)
_CLOSED = {"[": "]", "{": "}", "(": ")"}
_WHOLE_LINE = re.compile(r"^[ \t]*(?:In\[\d+\]:?=|Out\[\d+\]=|>>>|\.\.\.(?= )|>>)", re.MULTILINE)


def blanked(text: str, start: int, end: int) -> str:
    """Return the text with [start, end) replaced by as many spaces and the same line breaks."""
    return text[:start] + re.sub(r"[^\n]", " ", text[start:end]) + text[end:]


def blank(text: str, start: int, end: int) -> str:
    """Return the text with [start, end) replaced by as many spaces, so that all places stay the same."""
    return text[:start] + " " * (end - start) + text[end:]


_BEHIND_SENTENCE = re.compile(
    r"^(?P<sentence>[ \t]*+(?:[^\W\d_]{1,20}[,:]?[ ]){2,30}[^\W\d_]{1,20}[.!?])[ ](?=(?:[*•-]|\(\w{1,3}\))[ ][^\n]*=)",
    re.MULTILINE,
)
"""A sentence of words in front of a bullet or a label: The steps were T and V. (1) m x'' = F."""


def without_markup(text: str) -> str:
    """Return an answer without Markdown; what is not mathematics is blank."""
    text = without_rules(text)
    for form in (_FENCE, _RULE, _HEADING, _QUOTE, _WHOLE_LINE, _OF_FORCE, _OF_CODE):
        text = form.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)
    text = _FRAME.sub(" ", text)
    text = _TABLE.sub(lambda m: m.group().replace("|", ";"), text)
    for form in (_BOLD, _CODE, _ITALIC):
        text = form.sub(lambda m: " " * len(m[1]) + m[2] + " " * len(m[1]), text)
    return text


def sentences_apart(text: TracedText) -> TracedText:
    """Return an answer in which a bullet or a label behind a sentence of words begins a line."""
    return text.sub(_BEHIND_SENTENCE, lambda m: f"{m['sentence']}\n")


def bullets(text: str) -> int:
    """Return how many statements begin with what may be a bullet: - m x'' + k x = 0."""
    return 0 if are_signs(text) else len(_BULLET.findall(text))


def may_be_signs(text: str) -> bool:
    """Whether what begins lines may be a minus as well as a bullet: all with an equals sign begin with it, and nothing
    shows that they are a list, such as words in front of an equation or a name that one defines."""
    stated = [line for line in text.split("\n") if "=" in line and _BULLET.match(line)]
    return bool(stated) and all(map(_TERM.match, stated))


def are_signs(text: str) -> bool:
    """Whether lines that may begin with a minus are those of a program that puts a blank behind it."""
    return _PRINTED.search(text) is not None and may_be_signs(text)


def all_bullets(text: str, *, marked: bool = False) -> bool:
    """Whether several lines with an equals sign begin with the same bullet, and none without; one if Markdown is used
    elsewhere (``marked``)."""
    lines = text.split("\n")
    stated = [line for line in lines if "=" in line]
    if any("=" in line and _SIGNED.match(line) and _UNFINISHED.search(above) for above, line in pairwise(lines)):
        return False  # an equation goes on in the next line
    marks = [m.group().strip() if (m := _BULLET.match(line)) else "" for line in stated]
    if not marked and are_signs(text):
        return False
    return len(marks) > (0 if marked else 1) and len(set(marks)) == 1 and marks[0] != ""


def listed(text: str, chosen: bool | None, notes: dict[str, None], *, marked: bool) -> str:
    """Return an answer in which what may be bullets at the beginning of lines is blank where it is read so, which a
    note tells if it may be a minus: in the whole answer, or in a paragraph of several such lines. ``chosen`` decides
    for all if it is not None."""
    if chosen is not None:
        return without_bullets(text) if chosen else text
    if all_bullets(text, marked=marked):
        found, signs = without_bullets(text), may_be_signs(text)
    else:
        parts = _PARAGRAPHS.split(text)
        lists = [not are_signs(text) and all_bullets(x) for x in parts]
        found = "".join(without_bullets(x) if own else x for own, x in zip(lists, parts, strict=True))
        signs = any(own and may_be_signs(x) for own, x in zip(lists, parts, strict=True))
    if signs:
        notes.setdefault("The sign at the beginning of lines was read as that of a list.")
    return found


def without_bullets(text: str) -> str:
    """Return the text with bullets replaced by spaces."""
    return _BULLET.sub(lambda m: " " * len(m.group()), text)


def opened_list(text: str) -> str:
    """Return a list of equations of a program without its brackets: [Eq(a, b), Eq(c, d)], {a == b, c == d}."""
    match = _LISTS.match(text)
    if match is None:
        return text
    kind = "open" if match["open"] else "named"
    at, opening = match.start(kind), match[kind]
    stated = _ANY if kind == "open" and opening in "[{" else _STATED
    if not stated.search(text, at):
        return text
    depth = 0
    for end in range(at, len(text)):
        depth += (text[end] in "[{(") - (text[end] in "]})")
        if depth == 0:
            break
    else:
        return text
    if text[end] != _CLOSED[opening] or text[end + 1 :].strip(" \t\n;,.") or not stated.search(text, at, end):
        return text
    inside = text[at + 1 : end]
    if opening == "(" and "," not in inside:
        return text
    return blank(blank(text, end, end + 1), match.start(), at + 1).replace("\n", " ")
