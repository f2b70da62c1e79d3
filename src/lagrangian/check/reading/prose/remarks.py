"""Tells lines that cannot be read and that complete equations beside them do not need from those that must be read.

used sin(2 theta) = 2 sin cos                        an identity in short
phi'' = (tau - ...)/J, in full:                      what is written out below
(d = d/dt, dd = second derivative)                   how rates are spelled
"""

from __future__ import annotations

import re

from lagrangian.check.reading.prose.words import Words
from lagrangian.check.reading.traced_text import TracedText

_COMMAND = re.compile(r"\\(?:text|mathrm|textrm|mbox|textit|textbf)\s*(?=\{)|\\([A-Za-z]+)")
_DOTS = re.compile(r"\.\.\.|…|⋯|\\[lc]?dots")
_ACCELERATES = re.compile(
    r"['’′]\s?['’′]|[″\"]|\u0308|[ẍÿẅ¨]|\\ddot|ddot|(?<=\w)dd\b|\bD\(\s*\w+\s*,\s*\w+\s*,\s*\w|[∂d]\s?(?:\^\{?2|²|2)|"
    r"\b[Dd]iff\w{0,9}\([^\n]{0,60}2|\bDerivative\b"
)
_TWICE = r"(?:\^?2|²)?"
_OPERATOR = re.compile(
    r"[\s(]*+(?:dd?ot|d{1,2}|['’′]{1,2}|[\"″˙¨])\s*+:?\s?=\s*+\(?\s?"
    rf"d\s?{_TWICE}\s?/\s?\(?dt\s?{_TWICE}[\s).;,]*+"
)
"""How derivatives are spelled: dot = d/dt, '' = d²/dt²."""
_GAP = r"(?:\.{2,3}|…|[*_~-])"
_MARK = r"(?:dd?ot|dd?|pp?|punkt|['’′]{1,2})"
_LEGEND = re.compile(
    rf"(?=[-.…*_~dp'’′])(?<![\w.)\]])(?:{_GAP}{_MARK}|{_MARK}{_GAP})(?![\w.])[ \t]?(?:=|:|is|are|means?|for)[ \t]?"
    r"(?:(?:the|a|first|second|1st|2nd|time|angular)[ \t-]){0,4}"
    r"(?:rates?|velocit(?:y|ies)|speeds?|derivatives?|accelerations?|d\^?[2²]?/dt\^?[2²]?)(?![\w/*(])",
    re.IGNORECASE,
)
"""The same with a place for the name: d.. = rate, ..dot = velocity."""
_NAMED = re.compile(r"(?<![\w∂/*^+'’′-])([^\W\d]\w{0,24})\s*(?::\s?=|=)(?![=>])")
"""A name alone in front of an equals sign."""


_BEHIND = re.compile(
    r"(?<=\S)[ \t]{3,150}+[^\W\d]\w{0,12}+(?:,[ \t][^\W\d]\w{0,12}+){0,3}[ \t]?:[ \t]+"
    r"(?:[^\W\d_]{2,24}[ \t,]{1,3}){2}[^\n=]*+$",
    re.MULTILINE,
)
"""What a name means, behind a gap at the end of a line: N: force of the yoke on the pin."""
_MEANT_IN_BRACKETS = re.compile(
    r"(?<=[\w)\]'’′²³\u0307\u0308])[ \t]{1,150}+\[[ \t]?(?P<names>[^\W\d]\w{0,12}+(?:,[ \t]?[^\W\d]\w{0,12}+){0,3})"
    r"(?:[ \t]?:[ \t]?|[ \t](?:is|are|denotes?|ist|sind|est)[ \t])(?=[^\[\]]{0,60}[^\W\d_]{3})"
    r"[^\[\]\n=+*/^()\d]{3,100}\](?=[ \t]*[.,;]?[ \t]*$)",
    re.MULTILINE,
)
"""The same in square brackets, also near the equation: [th: heel]."""
_TOLD_BEHIND = re.compile(
    r"(?<=[\w)\]'’′²³])[ \t]{4,150}+(?=[^\W\d_]{1,3}_)[^\W\d]\w{0,12}+(?:,[ \t][^\W\d]\w{0,12}+){0,3}[ \t]"
    r"(?:(?!(?:alpha|beta|gamma|delta|theta|phi|psi|omega|sin|cos|tan|sqrt|exp|sign|sgn|ddot|dot)\b)[a-zäöüß]{2,24}"
    r"[ \t]){2,8}(?![a-z]{0,24}[ \t]*[*/^+-])[a-zäöüß]{3,24}[ \t]*$",
    re.MULTILINE,
)
"""The same without a colon: a_x, a_y acceleration of the table."""
_MULTIPLIER = re.compile(
    r"(?<=[\w)²³\u0307])(?:[ \t]{3,60}+|,[ \t]{1,3}+(?:(?:with[ ])?multiplier[ ])?)"
    r"[(\[]?(?:\|[ \t]?)?(?:λ|μ|lambda|lam|mu)[_ ]?(?:\d|[₁₂₃])?[)\]]?[ \t]*$",
    re.MULTILINE,
)
"""The multiplier of a constraint, behind a gap or a comma at the end of its line."""
CONSTANT = frozenset(["const", "constant", "konst", "konstant", "cst", "cte"])
"""What is called a constant: one behind an energy changes no equation."""
_CONSTANT = re.compile(
    r"(?:\$\\?[A-Za-z]{1,12}[ \t]*=[ \t]*\$|(?:(?<=\()|(?<=, )|(?<=with ))[^\W\d]\w{0,11}[ ]?=)[ \t]*"
    r"(?:const|constant|konst|konstant|cst|cte|constante?)\b\.?"
    r"(?=[ \t]*(?:[,;)]|$|[ \t](?:is|are|and|as|for|ist|und|est|et)\b))",
    re.IGNORECASE | re.MULTILINE,
)
"""That a name is constant, in a formula and a word, $x =$ const., or beside a sentence: with w = const."""


_DIRECTION = re.compile(
    r"(?<=[(,;:])[ \t]*+(?:[-+−–±]|positive?|pos\.|positiv)[ \t]*+(?:=|:)[ \t]*+"
    r"[^\W\d_]{2,24}(?:[ \t-][^\W\d_]{1,24}){0,5}[ \t]*+(?=[),;.]|$)",
    re.MULTILINE,
)
"""Which direction counts, in words: (drum, + = lowering)."""


_COUNTS = re.compile(r"\((?:[^\W\d_]{3,24}[ \t]){1,4}[+−-]\)")
"""The sign behind what counts so: (unwinding +)."""
_ADDED = re.compile(
    r"(?<=[\w)\]²³])[ \t]*+"
    r"(?:\([ \t]?[+±][ \t]?(?:an?[ \t]|eine[ \t])?(?:const(?:ant)?|[Kk]onst(?:ante)?|constante)\.?\)"
    r"|\+[ \t]?(?:an?[ \t]|eine[ \t])?(?:constant|[Kk]onst(?:ante)?|constante)\.?)(?=[ \t]*(?:[.,;]|$))",
    re.MULTILINE,
)
"""A constant that is added in words."""


def without_legend(written: TracedText) -> TracedText:
    """Return an answer without the parts that only say how rates are spelled, what a name on the line means, which
    direction counts, which multiplier belongs to a constraint, or that something is constant."""
    written = written.sub(_LEGEND, _blank).sub(_DIRECTION, _blank).sub(_COUNTS, _blank)
    written = written.sub(_ADDED, lambda m: " + const" if "=" in _line_of(m) else m.group())
    for form in (_BEHIND, _MEANT_IN_BRACKETS, _TOLD_BEHIND):
        written = written.sub(form, lambda m: _blank(m) if "=" in _line_of(m) else m.group())
    written = written.sub(_CONSTANT, _blank)
    return written.sub(_MULTIPLIER, lambda m: _blank(m) if "=" in _line_of(m) else m.group())


def _blank(match: re.Match[str]) -> str:
    return " " * len(match.group())


def _line_of(match: re.Match[str]) -> str:
    """The line up to a match."""
    return match.string[match.string.rfind("\n", 0, match.start()) + 1 : match.start()]


def is_remark(text: str) -> bool:
    """Whether complete equations can do without a part of a line that cannot be read.

    No equation of motion is a remark, unless dots stand in it for what it leaves out. A name of the answer's own that
    only a remark explains stays unknown.
    """
    if _OPERATOR.fullmatch(text) is not None:
        return True
    return _ACCELERATES.search(text) is None or _DOTS.search(text) is not None


def accelerates_in(text: str) -> bool:
    """Whether a second derivative, in any spelling, stands in a text."""
    return _ACCELERATES.search(text.replace('\\"', "")) is not None


def may_redefine(text: str, words: Words) -> bool:
    """Whether a part of a line may say what a name of the system means, so that equations are not wrong for sure."""
    return any(words.names.scope.meanings(x)[0] for x in _NAMED.findall(_COMMAND.sub(" ", text)))
