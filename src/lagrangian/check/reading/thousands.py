r"""Reads large numbers whose digits stand in groups of three.

40 000 x   40\,000 x   40~000 x        a gap, or in LaTeX a thin space
40'000 x   40_000*x                    a mark, as it is written in Switzerland and in programs
12,500 x + 0.5 y   40{,}000 x          a comma in front of a round number, in an answer with decimal points, or of zeros
40.000 x + 0,5 y                       a point in front of zeros alone, in an answer with decimal commas
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.traced_text import Edit, TracedText

MOST = 200
"""The most such numbers that are looked at."""

_GAP = "(?:[ \u00a0\u2009\u202f]|~|\\\\[,;: ]|\\{\\\\[,;]\\}|'|’|_)"
_COMMA = r"(?:,|\{,\})"
_BEFORE, _BEHIND = r"(?<![\w.,'’\\^}])(?<!\*\*)", r"(?!\d|['’′]|[.,]\d|\{,\}\d)"


def _form(sign: str, decimal: str) -> re.Pattern[str]:
    """A number with a sign between its groups, perhaps with decimals behind a sign of their own."""
    return re.compile(
        rf"{_BEFORE}(?P<whole>[1-9]\d{{0,2}}(?:{sign}\d{{3}}(?!\d)){{1,4}}+)(?:{decimal}\d{{1,9}}+)?{_BEHIND}"
    )


_WITH_GAP, _WITH_COMMA, _WITH_POINT = _form(_GAP, r"[.,]"), _form(_COMMA, r"\."), _form(r"\.", _COMMA)
_DECIMAL_COMMA, _DECIMAL_POINT = (
    re.compile(rf"(?<![\w.,'’\\}}])(?:\d{{1,9}}{sign}(?:\d{{1,2}}(?!\d)|\d{{4,9}})|0{sign}\d{{1,9}})(?![.,]\d)")
    for sign in (_COMMA, r"\.")
)
"""What only decimals are: 0,5 and 29,43."""
_ZEROS = re.compile(rf"\d{{1,3}}(?:(?:{_COMMA}|\.)000)+(?:{_COMMA}\d{{1,9}})?")
_SIGNS = re.compile(r"[^\d]")
_FIRST = re.compile(r"^[ \t]*(?P<number>\d)[ \t](?=\d)", re.MULTILINE)
"""A number at the beginning of a line, in front of another one, which may count the equations."""
_BRACKET = re.compile(r"(?<!\\)[()\[\]]")
_FAR = 400
"""The most characters in front of a number in which a bracket is sought."""
_DRAWN = re.compile("[|⎡-⎦\u2502]")
_GOES_ON = re.compile(r"[ \t]*[,;]")


def with_whole_numbers(written: TracedText, notes: dict[str, None]) -> TracedText:
    """Return an answer with such numbers in one piece, of which ``notes`` tell where the sign may also be that of
    decimals; what follows a number stays in its column.

    Numbers that may be entries of a matrix or of a list stay, and those behind numbers that count the lines.
    """
    text = written.text
    point, comma = (_is_used(text, form) for form in (_DECIMAL_POINT, _DECIMAL_COMMA))
    edits = list(_edits(text, _WITH_GAP, _counting(text), listed=False))
    signed = [x for x in _edits(text, _WITH_COMMA, frozenset(), listed=True) if not comma]
    signed = [x for x in signed if (point and _is_round(text[x[0] : x[1]])) or _ZEROS.fullmatch(text[x[0] : x[1]])]
    if comma and not point:
        signed = [x for x in _edits(text, _WITH_POINT, frozenset(), listed=True) if _ZEROS.fullmatch(text[x[0] : x[1]])]
    notes.update(dict.fromkeys(f"{text[a:b]} was read as {made.strip()}." for a, b, made in signed))
    return written.edited([*edits, *signed])


def _is_round(written: str) -> bool:
    """Whether a number with commas can hardly be a decimal one: 12,500 and 1,234,567, but not 4,905."""
    whole = written.partition(".")[0]
    return whole.endswith("00") or len(re.findall(_COMMA, whole)) > 1


def _is_used(text: str, form: re.Pattern[str]) -> bool:
    """Whether an answer has decimals of a form outside lists."""
    return any(not _is_in_list(text, m, listed=True) for m in islice(form.finditer(text), MOST))


def _counting(text: str) -> frozenset[int]:
    """Where numbers stand that count the lines: 1 205 x'' = …, and 2 3 x'' = … below it."""
    first = list(islice(_FIRST.finditer(text), MOST))
    counts = len(first) > 1 and [m["number"] for m in first] == [str(k + 1) for k in range(len(first))]
    return frozenset(m.start("number") for m in first) if counts else frozenset()


def _edits(text: str, form: re.Pattern[str], counting: frozenset[int], *, listed: bool) -> Iterator[Edit]:
    """The edits that write numbers in one piece; ``listed``: their sign may also be that between the entries of a
    list, otherwise blanks may stand between entries."""
    for match in islice(form.finditer(text), MOST):
        if match.start() in counting or _is_in_list(text, match, listed=listed):
            continue
        made = _SIGNS.sub("", match["whole"]) + text[match.end("whole") : match.end()]
        yield *match.span(), made.ljust(len(match.group()))


def _is_in_list(text: str, match: re.Match[str], *, listed: bool) -> bool:
    """Whether a number may be several entries of a matrix or a list."""
    first = text.rfind("\n", max(0, match.start() - _FAR), match.start()) + 1
    before = text[max(first, match.start() - _FAR) : match.start()]
    depth = 0
    for bracket in reversed(list(_BRACKET.finditer(before))):
        sign = bracket.group()
        depth += 1 if sign in ")]" else -1
        if depth < 0:
            behind = text[match.end() : match.end() + _FAR]
            if not listed:
                inside = before[bracket.end() :] + behind.partition("]")[0]
                return sign == "[" and "," not in inside
            alone = not before[bracket.end() :].strip() and behind.lstrip()[:1] == ")"
            return sign == "[" or alone or _GOES_ON.match(behind) is not None
    return not listed and _DRAWN.search(before) is not None
