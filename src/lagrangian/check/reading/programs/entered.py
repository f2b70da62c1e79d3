"""Puts matrices together that a program enters one by one, where it solves with them for accelerations.

M = zeros(2);                         M = [a, 0; c, d];
M(1,1) = a;  M(2,1) = c;              qdd = M\\f
M(2,2) = d;  qdd = M\\f
A[0, 1] = A[1, 0] = b                 both entries
f[0] = a                              a column
"""

from __future__ import annotations

import re
from itertools import islice

from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.records import dataclass, field

_NAME = r"[^\W\d]\w{0,23}+"
_SOLVES = re.compile(
    rf"(?<![\w.])(?:(?P<under>{_NAME})[ ]?\\[ ]?(?P<right>{_NAME})(?!\w)"
    rf"|(?:\w{{1,6}}\.){{0,3}}solve\([ ]?(?P<of>{_NAME})[ ]?,[ ]?(?P<by>{_NAME})[ ]?\)"
    rf"|(?:\w{{1,6}}\.){{0,3}}inv\([ ]?(?P<inv>{_NAME})[ ]?\)[ ]?[*@][ ]?(?P<times>{_NAME})(?!\w)"
    rf"|(?P<own>{_NAME})\.(?:inv\(\)[ ]?[*@][ ]?|LUsolve\()(?P<column>{_NAME})(?!\w))"
)
"""A matrix and a column that a system of linear equations has."""
_INDEX = r"(?:\([ ]?[1-9](?:[ ]?,[ ]?[1-9])?[ ]?\)|\[[ ]?\d(?:[ ]?,[ ]?\d)?[ ]?\](?:\[\d\])?)"
_ENTERED = re.compile(
    rf"(?:^|(?<=[;\n]))[ \t]*+(?P<to>(?P<name>{_NAME}){_INDEX}[ \t]*+=(?!=)(?:[ \t]*+{_NAME}{_INDEX}[ \t]*+=(?!=))?)"
    rf"[ \t]*+(?P<value>[^\n;#%=]{{1,400}}+)(?P<end>;|$|(?=[#%]))",
    re.MULTILINE,
)
_PLACE = re.compile(rf"(?P<name>{_NAME})(?P<index>{_INDEX})")
_EMPTY = re.compile(
    rf"(?:^|(?<=[;\n]))[ \t]*+(?P<name>{_NAME})[ \t]*+=[ \t]*+(?:\w{{1,6}}\.)?(?:zeros|empty)\([\w(), ]{{1,20}}\)"
    r"[ \t]*+(?:;|$|(?=[#%]))",
    re.MULTILINE,
)
"""A matrix of zeros."""
_FROM_ONE = re.compile(r"^[ \t]*+function[ \t]", re.MULTILINE)
MOST, LARGEST = 100, 6
"""The most statements of a kind, and the most rows of a matrix."""


@dataclass
class _Entered:
    """The values of entries by row and column, counted from 0, and where these are assigned."""

    values: dict[tuple[int, int], str] = field(default_factory=dict)
    spans: list[tuple[int, int]] = field(default_factory=list)


def with_entries_together(written: TracedText) -> TracedText:
    """Return an answer in which every such matrix and column is one statement, where its last entry was."""
    text = written.text
    pairs = [[x for x in m.groups() if x] for m in islice(_SOLVES.finditer(text), MOST)]
    solving = {name for pair in pairs for name in pair}
    if not solving or not (found := _entries(text, solving)):
        return written
    edits: list[Edit] = []
    empty = [m for m in islice(_EMPTY.finditer(text), MOST) if m["name"] in found]
    zeros = {m["name"] for m in empty}
    for name, entered in found.items():
        rows, width = (max(at[k] for at in entered.values) + 1 for k in (0, 1))
        square = (len({*entered.values}) == rows * width) or name in zeros
        if not square or rows > LARGEST or width not in (1, rows):
            zeros.discard(name)
            continue
        listed = "; ".join(", ".join(entered.values.get((i, j), "0") for j in range(width)) for i in range(rows))
        *others, last = entered.spans
        edits += [(*span, "") for span in others]
        edits.append((*last, f"{name} = [{listed}];"))
    return written.edited([*edits, *((*m.span(), "") for m in empty if m["name"] in zeros)])


def _entries(text: str, names: set[str]) -> dict[str, _Entered]:
    """The entries of matrices with these names, in which earlier entries are written out."""
    found: dict[str, _Entered] = {}
    from_one = _FROM_ONE.search(text) is not None
    for match in islice((m for m in _ENTERED.finditer(text) if m["name"] in names), MOST):
        own = found.setdefault(match["name"], _Entered())
        value = _PLACE.sub(lambda m: _known(m, found, from_one=from_one), match["value"]).strip()
        for place in _PLACE.finditer(match["to"]):
            if place["name"] == match["name"]:
                own.values[_at(place["index"], from_one=from_one)] = value
        own.spans.append(match.span())
    return found


def _known(place: re.Match[str], found: dict[str, _Entered], *, from_one: bool) -> str:
    """The value of an entry above, in brackets; the text as it is for anything else."""
    own = found.get(place["name"])
    value = None if own is None else own.values.get(_at(place["index"], from_one=from_one))
    return place.group() if value is None else f"({value})"


def _at(index: str, *, from_one: bool) -> tuple[int, int]:
    """The row and the column of an index, counted from 0."""
    numbers = [int(x) - (from_one or index[0] == "(") for x in re.findall(r"\d", index)]
    return numbers[0], numbers[1] if len(numbers) > 1 else 0
