"""Reads references to an answer's own numbered lines: [5] L = [2] + [3] - [4] as L = T_1 + T_2 - V; so also
L = (1) - (2) where the lines have their numbers behind them. Numbers behind terms are none that lines below explain:
m x'' [1] + k x [2] = F with "[1] the inertia" below."""

from __future__ import annotations

import re
from itertools import islice

from lagrangian.check.reading.traced_text import TracedText

_NUMBERED = re.compile(
    r"^[ \t]*+(?:\[(?P<square>\d{1,2})\]|\((?P<round>\d{1,2})\))[ \t]*+(?P<name>[^\W\d][\w*]{0,23}+)[ \t]*+=(?!=)",
    re.MULTILINE,
)
_NAMED = re.compile(r"^[ \t]*+(?P<name>[^\W\d][\w*]{0,23}+)[ \t]*+=(?!=)(?P<rest>[^\n]*+)$", re.MULTILINE)
_BEHIND = re.compile(r"(?:[ \t]{2}|\t)[\[(](\d{1,2})[\])][ \t]*\Z")
"""The number of a line far behind it."""
_TERM = r"(?:\[\d{1,2}\]|\(\d{1,2}\))"
_ALONE = re.compile(
    rf"(?<==)[ \t]*+(?:[-+−][ \t]*+)?{_TERM}(?:[ \t]*+[-+−][ \t]*+{_TERM}){{1,20}}+"
    rf"(?=[ \t]*+[.;]?(?:[ \t]*+{_TERM})?[ \t]*+$)",
    re.MULTILINE,
)
_REFERENCE = re.compile(r"[\[(](\d{1,2})[\])]")
_EXPLAINS = re.compile(
    r"^[ \t]*+(?P<mark>\[\d{1,2}\]|\(\d{1,2}\)|\[[a-z*]\])[ \t]*+[:=]?[ \t]*+(?P<words>(?:[^\W\d_]{2,24}[ \t,]++){2})?",
    re.MULTILINE,
)
"""A line that says what stands at a number, and whether it does in words."""
_MARKED = re.compile(
    r"(?<=[\w)\]'’′²³\u0307\u0308])[ \t]?(?P<mark>\[\d{1,2}\]|\(\d{1,2}\)|\[[a-z*]\])(?=[ \t]*+(?:[-+−=.,;]|$))",
    re.MULTILINE,
)
"""A number behind a term."""
FEWEST = 2
"""The fewest numbers behind terms: a single one may be a factor."""
MOST = 60
"""The most numbered lines, and sides of references, that are looked at."""


def without_marks_of_terms(written: TracedText) -> TracedText:
    """Return an answer without the numbers behind terms of formulas that other lines explain in words."""
    listed = list(islice(_EXPLAINS.finditer(written.text), MOST))
    explained = {m["mark"]: m.start() for m in listed}
    in_formulas = {m["mark"] for m in islice(_MARKED.finditer(written.text), MOST)} & explained.keys()
    if not any(m["words"] for m in listed) or len(in_formulas) < FEWEST:
        return written

    def blank(match: re.Match[str]) -> str:
        start = match.string.rfind("\n", 0, match.start()) + 1
        goes_on = match.string[match.end() :].partition("\n")[0]
        inside = "=" in goes_on or ("=" in match.string[start : match.start()] and goes_on.strip(" .,;"))
        known = match["mark"] in explained and explained[match["mark"]] != start
        return " " * len(match.group()) if inside and known else match.group()

    return written.sub(_MARKED, blank)


def without_references(written: TracedText) -> TracedText:
    """Return an answer in which sides that consist of numbers of its lines have the names that these lines define."""
    numbered = list(islice(_NUMBERED.finditer(written.text), MOST))
    names: dict[str, str] = {m["square"] or m["round"]: m["name"] for m in reversed(numbered)}
    for match in islice(_NAMED.finditer(written.text), MOST):
        if (number := _BEHIND.search(match["rest"][-20:])) is not None:
            names.setdefault(number[1], match["name"])
    if not names:
        return written

    def named(match: re.Match[str]) -> str:
        known = all(x in names for x in _REFERENCE.findall(match.group()))
        return _REFERENCE.sub(lambda m: names[m[1]], match.group()) if known else match.group()

    return written.sub(_ALONE, named)
