"""Takes the layout of other programs off an answer: Markdown, code fences, the brackets of a list of equations.

Everything is replaced by spaces, so that all places stay the same.
"""

from __future__ import annotations

import re

from lagrangian.check.reading.ruled import without_rules
from lagrangian.check.reading.traced_text import TracedText

_FENCE = re.compile(r"^[ \t]*(?:```|~~~)[^\n]*$", re.MULTILINE)
_RULE = re.compile(r"^[ \t]*(?:[-=_~–—][ \t]*){3,}$|^[ \t]*(?:\*[ \t]*){3,}$", re.MULTILINE)
_CODE = re.compile(r"(?<!`)(`{1,2})(?!`)([^`\n]+)\1(?!`)")
_STATED_CODE = re.compile(r"(?<=, )`(?P<code>[^\W\d]\w{0,11} ?=(?![=>])[^`=\n]{1,80})`(?=[.;,]?[ \t]*$)", re.MULTILINE)
"""A value as a piece of code at the end of a sentence: the ropes `A`, `B`, `mu = M + I/r^2`."""
_BOLD = re.compile(r"(?<![\w)\]'*])(\*\*|__)(?=[^\s*_])([^*\n]*?[^\s*])\1(?![\w(*])")
_BOLD_LINE = re.compile(
    r"^(?P<lead>[ \t]*+)\*\*(?=[^\s*])(?P<line>(?:(?<=[\w)])\*\*(?=[\w(])|\*(?!\*)|[^*\n])*)\*\*(?=[ \t]*$)",
    re.MULTILINE,
)
"""A whole line that is bold, which may hold stars of products."""
_ITALIC = re.compile(r"(?<=[\s(,])(\*|_)(?=[^\W\d_]{3})([^\W\d_]+(?:[ -][^\W\d_]+[\d₀-₉]?){0,8}:?)\1(?=[\s.,;:)!?]|\Z)")
"""A word or some between single marks: *clockwise*, *for θ1*."""
_ITALIC_NAME = re.compile(
    r"(?:(?<=^)|(?<=^[-+•*][ ])|(?<=[,;:(.][ ])|(?<=(?<!\w)and[ ]))(\*|_)([^\W\d_][\w\u0307\u0308]{0,12}['’′]{0,2})\1"
    r"(?=(?:\([^()\n]{1,12}\))?[ \t]{0,3}:?=(?![=>]))",
    re.MULTILINE,
)
"""A name between single marks in front of its value: *p* = m x'."""
_ITALIC_REMARK = re.compile(r"(?<=[ \t])(\*|_)(\([^\W\d_]{2}[^()*=\n]{1,60}\))\1(?=[ \t.,;]*$)", re.MULTILINE)
"""A remark in brackets between single marks at the end of a line: *(divided by 2)*."""
_ITALIC_SENTENCE = re.compile(
    r"(?:(?<=^)|(?<=[.;:!?)][ ]))(\*|_)"
    r"((?=[^\n]{0,160}[^\W\d_]{4})(?=\S{1,40}[ ]\S{1,40}[ ]\S)[^\W\d][^*=+/^\n]{8,160}[.!?])\1(?=[ \t]*$)",
    re.MULTILINE,
)
"""A sentence of words between single marks, which may begin with a name: *I depends on r!*"""
_HEADING = re.compile(r"^[ \t]{0,3}#{1,6}[ \t][^\n]*$", re.MULTILINE)
_QUOTE = re.compile(r"^[ \t]*(?:>[ \t]*)+", re.MULTILINE)
_OF_CODE = re.compile(r"^[ \t]*[-*+•–][ \t]+(?=`)", re.MULTILINE)
"""What stands in front of a piece of code, which is no minus."""
_LISTS = re.compile(r"\s*(?:(?P<open>[\[{(])|\w+\s*=\s*(?P<named>[\[{]))\s*(?=\S)")
_STATED = re.compile(r"==|\bEq\s*\(|\bEquality\s*\(")
_BREAK = re.compile(r"(?:(?<=[\w)\]'’′″²])(?P<next>\n)(?=[ \t]*+[^\s=+*/^)−-][^\n=]*=[^=])|\n)")
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


_BEHIND_FORMULA = re.compile(
    r"(?:(?<=[\^*/]\d)(?<!\./\d)|(?<=['’′²³]))\."
    r"(?=[ \t]{1,9}[^\W\d][\w/'’′]{0,23}+(?:[ \t]{0,3}+[-−+*/·^]?[ \t]{0,3}+\w{1,8}+){0,6}+[ \t]{0,9}+=(?!=))"
)
"""The full stop behind a formula, where a statement follows: P = F x' - d s'^2. dE/dt = P; a = π/6. m R + J = 2."""
_WORDS_BEHIND = re.compile(
    r"^(?P<stated>[^\n=]{0,80}=[^\n=]{1,200}?[\w)²³'’′\u0307\u0308])\.[ ]"
    r"(?=[A-Z][a-z]{1,15}[ ][a-z]{2,15}[ ][^\n=]{0,60}[-−+*/_][^\n=]{1,60}$)",
    re.MULTILINE,
)
"""A statement and a full stop, where a sentence with a formula in it follows: N = k s. The block feels -N."""
_BEHIND_SENTENCE = re.compile(
    r"^(?P<sentence>[ \t]*+(?:[^\W\d_]{1,20}[,:]?[ ]){2,30}[^\W\d_]{1,20}[.!?])[ ]"
    r"(?=(?:[*•-]|\(\w{1,3}\)|\d{1,2}[.)])[ ][^\n]*=)",
    re.MULTILINE,
)
"""A sentence of words in front of a bullet or a label: The steps were T and V. (1) m x'' = F."""
_ABOUT_NAME = re.compile(
    r"(?<=[\w)²³])(?<![ieIE]\.[eg])(?<![dDzZ]\.[hBb])\.[ ](?=[*_]?[^\W\d_]\w{0,11}[ ]"
    r"(?:depends|varies|changes|is|isn['’]t|hängt|ändert|ist|dépend|varie|n['’]est)[ ][^=+/^²·\n]{1,80}$)",
    re.MULTILINE,
)
"""The full stop of a statement behind which a sentence says something of a name: … = J + m r². I depends on r!"""
_LABELLED = re.compile(r"^[ \t]*+[A-Z][a-z]{2,15}(?:[ ][a-z]{2,12}){0,3}:[ ][^\n]{1,400}$", re.MULTILINE)
_NEXT_LABEL = re.compile(r"(?<![^\W\d_]{3})\.[ ](?=[A-Z][a-z]{2,15}(?:[ ][a-z]{2,12}){0,3}:[ ])")
"""The full stop behind a formula with a label, where another label follows: Cart: ½ M x'^2. Rod: ½ J φ'^2."""
_FACTOR = re.compile(
    r"(?:power|energy|function|energie|leistung|funktion|dissipation)[ \t]+(?P<factor>\d)[ \t]*$", re.IGNORECASE
)


def without_markup(text: str) -> str:
    """Return an answer without Markdown; what is not mathematics is blank."""
    text = without_rules(text)
    for form in (_FENCE, _RULE, _HEADING, _QUOTE, _WHOLE_LINE, _OF_CODE):
        text = form.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)
    text = _FRAME.sub(" ", text)
    text = _TABLE.sub(lambda m: m.group().replace("|", ";"), text)
    text = _BOLD_LINE.sub(lambda m: f"{m['lead']}  {m['line']}  ", text)
    text = _STATED_CODE.sub(lambda m: f";{m['code']};", text)
    for form in (_BOLD, _CODE, _ITALIC, _ITALIC_NAME, _ITALIC_REMARK, _ITALIC_SENTENCE):
        text = form.sub(lambda m: " " * len(m[1]) + m[2] + " " * len(m[1]), text)
    return text


def sentences_apart(text: TracedText) -> TracedText:
    """Return an answer in which a bullet or a label behind a sentence of words begins a line, and a statement behind a
    formula that a full stop ends, or a sentence with a formula in it; so does each of several labels with a formula on
    one line, and a sentence of words about a name."""
    text = text.sub(_ABOUT_NAME, lambda _: ".\n").sub(_LABELLED, lambda m: _NEXT_LABEL.sub(".\n", m.group()))
    text = text.sub(_WORDS_BEHIND, lambda m: f"{m['stated']}.\n")
    return text.sub(_BEHIND_SENTENCE, lambda m: f"{m['sentence']}\n").sub(_BEHIND_FORMULA, lambda _: ";")


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
    return _one_a_line(blank(blank(text, end, end + 1), match.start(), at + 1))


def _one_a_line(text: str) -> str:
    """The entries of a list on one line; between those that stand on a line each is a semicolon."""
    return _BREAK.sub(lambda m: ";" if m["next"] else " ", text)


def before_factor(text: str, end: int) -> int:
    """Where a name at ``end`` begins with its factor, where words stand in front: lost power 2 D; the number of a part
    is none, as in case 2 D."""
    found = _FACTOR.search(text, 0, end)
    return end if found is None else found.start("factor")
