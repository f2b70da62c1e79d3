"""Writes entries of columns that comments of a program list as the coordinates and rates that they are.

# q[0] = x, q[1] = phi; v = dq/dt; a = dv/dt          m*a[0] + c*v[0] + k*q[0] is m*x'' + c*x' + k*x
# q = [x, phi], qd and qdd its derivatives            qdd[1] is phi''
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from itertools import islice

from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

MOST = 60
"""The most comments, and entries in one, that are looked at."""

HEADER = re.compile(r"^[ \t]*+(?:function|def)[ \t]|@\(|\blambda\b", re.MULTILINE)
"""How a function of a program begins."""
_COMMENT = re.compile(r"(?:^|(?<=[ \t;,\])]))(?:[#%]|//)[^\n]*", re.MULTILINE)
_NAME = r"[^\W\d]\w{0,15}"
_ENTRY = re.compile(rf"(?<![\w.])(?P<of>{_NAME})[(\[](?P<at>\d)[)\]]")
_GIVEN = re.compile(rf"{_ENTRY.pattern}[ \t]*(?:=|:|is\b)[ \t]*(?P<name>{_NAME})(?![\w(\['’])[ \t]*[,;]?")
_LIST = re.compile(
    rf"(?<![\w.])(?P<of>{_NAME})[ \t]*(?:=|:|is\b)[ \t]*[(\[]"
    rf"(?P<names>[ \t]*{_NAME}(?:[ \t]*[,;][ \t]*{_NAME}){{0,7}}[ \t]*)[)\]]"
    r"(?:\.T|\^T|['’])?[ \t]*[,;]?"
)
_RATE = re.compile(
    rf"(?<![\w.])(?P<rate>{_NAME})[ \t]*(?:=|:|is\b)[ \t]*(?:d[ ]?(?P<quotient>{_NAME})[ ]?/[ ]?dt(?!\w)"
    rf"|(?P<primed>{_NAME})(?P<primes>['’]{{1,2}}|''))[ \t]*[,;]?"
)


def with_indexed_coordinates(
    written: TracedText, coordinates: Sequence[str], find: Callable[[str], tuple[list[str], int]]
) -> TracedText:
    """Return a program without functions in which the entries of such columns are coordinates, rates and accelerations;
    ``find`` says which names of the system one can mean."""
    text = written.text
    comments = [] if HEADER.search(text) else list(islice(_COMMENT.finditer(text), MOST))
    if not comments or _ENTRY.search(text) is None:
        return written
    edits: list[Edit] = []
    entries: dict[str, dict[int, str]] = {}
    orders: dict[str, tuple[str, int]] = {}
    for comment in comments:
        for match in islice(_GIVEN.finditer(text, *comment.span()), MOST):
            entries.setdefault(match["of"], {})[int(match["at"])] = match["name"]
            edits.append((*match.span(), " " * len(match.group())))
        for match in islice(_LIST.finditer(text, *comment.span()), MOST):
            entries[match["of"]] = dict(enumerate(re.findall(_NAME, match["names"]), start=-1))
            edits.append((*match.span(), " " * len(match.group())))
        for match in islice(_RATE.finditer(text, *comment.span()), MOST):
            orders[match["rate"]] = (match["quotient"] or match["primed"], len(match["primes"] or "'"))
            edits.append((*match.span(), " " * len(match.group())))
    columns = {of: _in_order(listed, coordinates, find) for of, listed in entries.items()}
    columns = {of: names for of, names in columns.items() if names}
    if not columns:
        return written
    first = 0 if any(int(m["at"]) == 0 for m in _ENTRY.finditer(text)) else 1
    spans = [x.span() for x in comments]
    accelerates = False
    for match in _ENTRY.finditer(text):
        if any(a <= match.start() < b for a, b in spans):
            continue
        of, order = _column(match["of"], columns, orders)
        at = int(match["at"]) - first
        if of is not None and 0 <= at < len(columns[of]):
            edits.append((*match.span(), columns[of][at] + "'" * order))
            accelerates |= order > 1
    return written.edited(apart(edits)) if accelerates else written


def _in_order(
    listed: Mapping[int, str], coordinates: Sequence[str], find: Callable[[str], tuple[list[str], int]]
) -> list[str]:
    """The coordinates of a column in their order; none if it does not list all of them, each once."""
    found = [find(listed[k])[0] for k in sorted(listed)]
    named = [x[0] for x in found if len(x) == 1]
    return named if sorted(named) == sorted(coordinates) and len(named) == len(found) else []


def _column(
    name: str, columns: Mapping[str, Sequence[str]], orders: Mapping[str, tuple[str, int]]
) -> tuple[str | None, int]:
    """The column of coordinates to which a name belongs, and how often it is differentiated there."""
    order = 0
    while name not in columns and name in orders and order < 2:
        name, more = orders[name]
        order += more
    if name in columns:
        return name, order
    return next(((stem, order + k) for k, stem in spelled_rates(name) if stem in columns), (None, 0))
