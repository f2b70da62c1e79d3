r"""Mends what copying leaves of Markdown and LaTeX: signs behind a backslash, delimiters that lost theirs.

m\*x'' + k\_1\*x = 0                m*x'' + k_1*x = 0         Markdown
[↵m \ddot{x} + k x = 0↵]            \[↵m \ddot{x} + k x = 0↵\]        what a window shows of a conversation
( m \ddot{x} = F ) follows          \( m \ddot{x} = F \) follows
{{a}\over{b}}                       \frac{a}{b}           plain TeX, as Maxima prints it
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.latex.layout import closing
from lagrangian.check.reading.traced_text import Edit, TracedText

MOST, LONGEST = 200, 4_000
"""The most marks of one kind, and the most characters of a line, that are looked at."""

_STAR = re.compile(r"(?<!\\)\\\*")
_LINE = re.compile(r"(?<=\w)\\_(?=\w)")
_ESCAPED = re.compile(r"(?<!\\)\\(?=[-+.#>~|=])")
_COMMAND = re.compile(r"\\[A-Za-z(\[\\]|\$")
_BRACKET = re.compile(r"^[ \t]*+(?P<sign>[\[\]])[ \t]*+$", re.MULTILINE)
_WHOLE = re.compile(r"^(?P<open>[ \t]*+\[)[ \t](?P<inside>[^\n]{1,4000})[ \t](?P<close>\])[ \t]*+[.,]?$", re.MULTILINE)
_TEX = re.compile(r"\\[A-Za-z]")
_DELIMITED = re.compile(r"\\[\[(]|\$|\\begin\{(?:equation|align|gather|cases)")
_OVER = re.compile(r"\\over(?![A-Za-z])")

_PROVED = re.compile(
    r"[ \t,.;]{0,9}(?:∎|□|■|\\(?:qed|blacksquare|square|Box)(?![A-Za-z]))[ \t.]{0,9}$"
    r"|(?<!\w)[,.;]?[ \t]{0,9}(?:[(\[])?(?:[qQ]\.[ ]?[eE]\.[ ]?[dD]\.?|[wW]\.[ ]?[zZ]\.[ ]?[bB]\.[ ]?[wW]\.?"
    r"|Q\.?E\.?D\.?|qed|wzbw|WZBW)[)\]]?[ \t.!]{0,9}$",
    re.MULTILINE,
)
"""What says at the end of a line that something is proved: q.e.d., w.z.b.w., ∎."""


def without_proved(written: TracedText) -> TracedText:
    """Return an answer without q.e.d. and its like, which are no part of the equation in front of them."""
    return written.sub(_PROVED, lambda m: "")


def without_copying(written: TracedText) -> TracedText:
    """Return an answer in which these marks are as they were before it was copied."""
    if "\\" not in written.text:
        return written
    written = written.sub(_STAR, lambda m: "*").sub(_LINE, lambda m: "_")
    if not _COMMAND.search(written.text):
        return written.sub(_ESCAPED, lambda m: "")
    if not _DELIMITED.search(written.text):
        written = written.edited(_delimiters(written.text))
    while (edits := list(_fraction(written.text))) and len(written.text) < MOST * LONGEST:
        written = written.edited(edits)
    return written


def _delimiters(text: str) -> Iterator[Edit]:
    """The backslashes of square brackets around equations in LaTeX."""
    signs = list(islice(_BRACKET.finditer(text), MOST))
    if [m["sign"] for m in signs] == ["[", "]"] * (len(signs) // 2):
        yield from ((m.start("sign"), m.start("sign"), "\\") for m in signs)
    for match in islice(_WHOLE.finditer(text), MOST):
        if "=" in match["inside"] and _TEX.search(match["inside"]):
            yield match.end("open") - 1, match.end("open") - 1, "\\"
            yield match.start("close"), match.start("close"), "\\"


def _fraction(text: str) -> Iterator[Edit]:
    r"""The edits that write the first {a \over b} as \frac{a}{b}."""
    match = _OVER.search(text)
    if match is None:
        return
    depth, first = 1, match.start()
    while first > 0 and depth:
        first -= 1
        if text[first] in "{}" and text[first - 1 : first] != "\\":
            depth += 1 if text[first] == "}" else -1
    end = closing(text, match.end())
    if not depth and text[end - 1 : end] == "}":
        above, below = (_is_group(x) for x in (text[first + 1 : match.start()], text[match.end() : end - 1]))
        yield first, first + 1, "\\frac" if above else "\\frac{"
        yield *match.span(), f"{'' if above else '}'}{'' if below else '{'}"
        yield end - 1, end, "" if below else "}"


def _is_group(text: str) -> bool:
    """Whether a text is something in braces."""
    text = text.strip()
    return text[:1] == "{" and closing(text, 1) == len(text)
