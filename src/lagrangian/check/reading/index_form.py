r"""Writes the equations of one row, with the letter i for its number, as the equation of whole matrices.

Σ_j M_ij q̈_j + h_i = Q_i for i = 1, 2                      M q'' + h = Q
M_ij q̈_j = f_i                                             M q'' = f              whose sum is understood
\sum_{j=1}^{2} M_{ij} \ddot q_j + h_i = Q_i, \quad i = 1, 2    M \ddot q + h = Q
"""

from __future__ import annotations

import re
from itertools import islice

from lagrangian.check.reading.traced_text import TracedText

MOST = 4
"""The most such forms of an answer."""

_GAP = r"(?:[ \t]|\\[,;!: ]){0,3}"
_ROW, _OTHER, _BOTH = (
    r"_?\{?i\}?(?![A-Za-z])",
    r"_?\{?[jk]\}?(?![A-Za-z])",
    r"_?\{?[ ]?i[ ]?,?[ ]?[jk][ ]?\}?(?![A-Za-z])",
)
_OF = r"(?:\([^()\n=]{1,40}\))?"
_SET = r"(?:[^{}\n\\]|\\(?!\{)|\\?\{[^{}\n]{1,30}\}){1,40}"
_SUM = r"(?:\\sum(?![A-Za-z])(?:\\limits)?|[∑Σ]|(?<!\w)sum(?=_))"
_TOTAL = rf"(?:{_SUM}{_GAP}(?:_?[{{(]{_SET}[}})]|_[jk])?(?:\^\{{?\w\}}?)?{_GAP})?"
_RATES = {
    False: rf"(?:q\u0308{_OTHER}|q{_OTHER}(?:''|″|’’|′′|\u0308)|q(?:''|″|’’|′′){_OTHER})",
    True: rf"\\ddot[ ]?\{{?[ ]?q[ ]?(?:{_OTHER}[ ]?\}}?|\}}{_OTHER})",
}
_TERM = rf"[A-Za-z]{_ROW}{_OF}"
_SIGN = r"[ \t]{0,3}[-+−][ \t]{0,3}"
_BEHIND = (
    r"(?:[ \t]{0,3}[,(]?(?:\\q?quad|\\text\{|\\[,;: ]|[ \t]){0,4}(?:for[ ](?:all[ ])?|für[ ])?\}?[ \t]{0,3}\$?"
    r"i[ ]?(?:=|∈|\\in)(?:[^\n=(){}.;:\[\]$\\]|\\(?![{\[\]])|\\?\{[^\n=(){}$]{1,30}\}){1,30}(?<!,)\)?)?"
)


def _form(*, latex: bool) -> re.Pattern[str]:
    right = rf"(?:0(?![\w.])|[-−]?{_TERM}(?:{_SIGN}{_TERM}){{0,2}})"
    return re.compile(
        rf"(?<![\w^*/+=-]){_TOTAL}(?P<matrix>[A-Z]){_BOTH}{_OF}{_GAP}[·*]?{_GAP}{_RATES[latex]}"
        rf"(?P<more>(?:{_SIGN}{_TERM}){{0,3}})[ \t]{{0,3}}&?=[ \t]{{0,3}}(?P<right>{right})"
        rf"{_BEHIND}(?:,?[ \t]{{0,3}}(?=where|with|wobei|mit))?"
    )


_FORMS = {latex: _form(latex=latex) for latex in (False, True)}
_INDEX = re.compile(rf"(?<=[A-Za-z])(?:{_ROW})")


def with_index_form(written: TracedText, *, latex: bool) -> TracedText:
    """Return an answer with such a row as an equation of matrices; what says over which numbers is left out."""
    text = written.text
    rate = "\\ddot" if latex else "q"
    if rate not in text or re.search(_BOTH, text) is None:
        return written
    edits: list[tuple[int, int, str]] = []
    for match in islice(_FORMS[latex].finditer(text), MOST):
        more, right = (_INDEX.sub("", match[x]) for x in ("more", "right"))
        acceleration = r" \ddot{q}" if latex else " q''"
        ends = "" if latex else "\n"
        edits.append((*match.span(), f"{match['matrix']}{acceleration}{more} = {right}{ends}"))
    return written.edited(edits)
