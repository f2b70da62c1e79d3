r"""Mends what copying leaves of Markdown and LaTeX: signs behind a backslash, delimiters that lost theirs.

m\*x'' + k\_1\*x = 0                m*x'' + k_1*x = 0         Markdown
[↵m \ddot{x} + k x = 0↵]            \[↵m \ddot{x} + k x = 0↵\]        what a window shows of a conversation
( m \ddot{x} = F ) follows          \( m \ddot{x} = F \) follows
{{a}\over{b}}                       \frac{a}{b}           plain TeX, as Maxima prints it
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import islice

from lagrangian.check.reading.traced_text import Edit, TracedText

MOST = 200
"""The most marks of one kind that are looked at."""

_STAR = re.compile(r"(?<!\\)\\\*")
_LINE = re.compile(r"(?<=\w)\\_(?=\w)")
_ESCAPED = re.compile(r"(?<!\\)\\(?=[-+.#>~|=])")
_COMMAND = re.compile(r"\\[A-Za-z(\[\\]|\$")
_BRACKET = re.compile(r"^[ \t]*+(?P<sign>[\[\]])[ \t]*+$", re.MULTILINE)
_WHOLE = re.compile(r"^(?P<open>[ \t]*+\[)[ \t](?P<inside>[^\n]{1,4000})[ \t](?P<close>\])[ \t]*+[.,]?$", re.MULTILINE)
_TEX = re.compile(r"\\[A-Za-z]")
_DELIMITED = re.compile(r"\\[\[(]|\$|\\begin\{(?:equation|align|gather|cases)")
_GROUPED = re.compile(r"\\over(?![A-Za-z])|(?<!\\)[{}]")

_PROVED = re.compile(
    r"[ \t,.;]{0,9}(?:∎|□|■|\\(?:qed|blacksquare|square|Box)(?![A-Za-z]))[ \t.]{0,9}$"
    r"|(?<!\w)[,.;]?[ \t]{0,9}(?:[(\[])?(?:[qQ]\.[ ]?[eE]\.[ ]?[dD]\.?|[wW]\.[ ]?[zZ]\.[ ]?[bB]\.[ ]?[wW]\.?"
    r"|Q\.?E\.?D\.?|qed|wzbw|WZBW)[)\]]?[ \t.!]{0,9}$",
    re.MULTILINE,
)
"""What says at the end of a line that something is proved: q.e.d., w.z.b.w., ∎."""


_NUMBERED = re.compile(
    r"(?<=[\w)\]}'’′²³\u0307\u0308])[ \t]{0,9}(?:(?:\.[ \t]{0,3}){3,160}+|…{1,80}+|[·•∙⋅]{3,160}+"
    r"|[-–—_](?:[ ]?[-–—_]){2,160}+"
    r"|\\(?:dotfill|hrulefill|dots|ldots|cdots)(?![A-Za-z])|-{1,2}>|=>|→|⟶|⇒|←|⟵)[ \t]{0,9}"
    r"[(\[<{][ ]?[\w*†‡#]{1,4}(?:[.-]\w{1,3})?[*'’′]{0,2}[ ]?[)\]>}][ \t.]{0,9}$",
    re.MULTILINE,
)
"""The number of an equation behind a row of dots, a rule or an arrow: = F ......... (a)."""
_LEADERS = re.compile(r"(?<=[\w)\]}'’′²³\u0307\u0308])[ \t]{1,9}(?:\.[ \t]{0,3}){4,160}+$", re.MULTILINE)
"""A row of dots that leads to nothing."""


_CIRCLED = re.compile(r"[①-⑳]")


def with_plain_numbers(written: TracedText) -> TracedText:
    """Return an answer in which numbers of equations in circles stand in brackets: ① as (1)."""
    return written.sub(_CIRCLED, lambda m: f"({ord(m.group()) - ord('①') + 1})")


def without_leaders(written: TracedText) -> TracedText:
    """Return an answer without the dots behind equations and the numbers to which they lead, which are no factors."""
    text = written.text

    def blank(match: re.Match[str]) -> str:
        states = "=" in text[text.rfind("\n", 0, match.start()) + 1 : match.start()]
        return " " * len(match.group()) if states else match.group()

    return written.sub(_NUMBERED, blank).sub(_LEADERS, blank) if "=" in text else written


def without_proved(written: TracedText) -> TracedText:
    """Return an answer without q.e.d. and its like, which are no part of the equation in front of them."""
    return written.sub(_PROVED, lambda m: "")


_TYPED_ARRAY = re.compile(r"\\(?:(?P<matrix>[bp]?matrix)|eqarray)[ ]{0,3}(?=\()")
"""A matrix or equations as they are typed in Word's equation editor."""


def with_typed_arrays(written: TracedText) -> TracedText:
    """Return an answer with the signs of Word's equation editor for matrices that are typed as words, if these are its
    only commands."""
    text = written.text
    if "\\" not in text or len(_TYPED_ARRAY.findall(text)) != text.count("\\"):
        return written
    return written.sub(_TYPED_ARRAY, lambda m: "■" if m["matrix"] else "█")


def without_copying(written: TracedText) -> TracedText:
    """Return an answer in which these marks are as they were before it was copied."""
    if "\\" not in written.text:
        return written
    written = written.sub(_STAR, lambda m: "*").sub(_LINE, lambda m: "_")
    if not _COMMAND.search(written.text):
        return written.sub(_ESCAPED, lambda m: "")
    if not _DELIMITED.search(written.text):
        written = written.edited(_delimiters(written.text))
    return written.edited(sorted(_fractions(written.text)))


def _delimiters(text: str) -> Iterator[Edit]:
    """The backslashes of square brackets around equations in LaTeX."""
    signs = list(islice(_BRACKET.finditer(text), MOST))
    if [m["sign"] for m in signs] == ["[", "]"] * (len(signs) // 2):
        yield from ((m.start("sign"), m.start("sign"), "\\") for m in signs)
    for match in islice(_WHOLE.finditer(text), MOST):
        if "=" in match["inside"] and _TEX.search(match["inside"]):
            yield match.end("open") - 1, match.end("open") - 1, "\\"
            yield match.start("close"), match.start("close"), "\\"


def _fractions(text: str) -> Iterator[Edit]:
    r"""The edits that write every {a \over b} as \frac{a}{b}; none behind one that has no braces around it."""
    opened: list[tuple[int, list[re.Match[str]]]] = []
    plain: dict[int, int] = {}  # the groups that stay, by where they begin
    for match in _GROUPED.finditer(text):
        if match.group() == "{":
            opened.append((match.start(), []))
        elif not opened and match.group() == "}":
            continue
        elif not opened:
            return
        elif match.group() == "}":
            first, overs = opened.pop()
            if len(overs) != 1:
                plain[first] = match.end()
                continue
            (over,) = overs
            above = _is_group(text, first + 1, over.start(), plain)
            below = _is_group(text, over.end(), match.start(), plain)
            yield first, first + 1, "\\frac" if above else "\\frac{"
            yield *over.span(), f"{'' if above else '}'}{'' if below else '{'}"
            yield *match.span(), "" if below else "}"
        else:
            opened[-1][1].append(match)


def _is_group(text: str, start: int, end: int, groups: Mapping[int, int]) -> bool:
    """Whether one of the ``groups`` in braces is all that stands between two places."""
    inside = text[start:end]
    return groups.get(end - len(inside.lstrip())) == start + len(inside.rstrip())
