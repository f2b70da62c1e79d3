"""The general form of the equations in matrices whose entries, rows or columns stand elsewhere in an answer.

M(q) q'' + n(q, q') = f(q, q', τ)   with M11 = a, M12 = b, …, n1 = c, … and f = [d; e]
                                    [M11, M12; M21, M22]*q'' + [n1; n2] = f
Row 1 of M: [a, b]                  M = [a, b; c, d]
| M₁₁ | a |                         M₁₁ = a
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import islice

from lagrangian.check.reading.traced_text import Edit, TracedText

MOST = 6
"""The most rows of a matrix that is given so, and the most general forms of an answer that are looked at."""

_TABLE = re.compile(r"(?:^[ \t]*+\|[^\n]{1,2000}\|[ \t]*+(?:\n|\Z)){2,40}", re.MULTILINE)
_RULE = re.compile(r"[ \t]*\|(?:[ \t]*:?-{1,40}:?[ \t]*\|){1,9}[ \t]*")
_LOWERED = str.maketrans("₁₂₃₄₅₆", "123456")
_INDEX = r"_?\{?[1-6₁-₆]{1,2}\}?"
_ENTRY = rf"[A-Za-z]{_INDEX}"
_ENTRIES = re.compile(rf"{_ENTRY}(?:[ \t]*=[ \t]*{_ENTRY}){{0,3}}")
_ROW = re.compile(
    r"^[ \t]*(?:(?:row|Zeile)[ \t]+(?P<after>[1-6])|(?P<before>[1-6])(?:st|nd|rd|th|\.)[ \t]+(?:row|Zeile))[ \t]+"
    r"(?:of|von)[ \t]+(?P<name>[A-Z])[ \t]*[:=][ \t]*[\[(](?P<row>[^\[\]\n]{1,600})[\])][ \t]*[,;.]?[ \t]*$",
    re.MULTILINE | re.IGNORECASE,
)
_OF = r"(?:\((?:[^\W\d_][\w'’′\u0307\u0308]{0,8}[ \t]*,?[ \t]*){1,6}\))?"
"""What a matrix depends on, which says nothing: (q, q')."""
_COLUMN = r"(?P<column>[qxzξ])[ \t]*(?:''|″|’’|′′|\u0308)"
_TERM = rf"[\[{{]?[A-Za-z][\]}}]?{_OF}"
_GENERAL = re.compile(
    rf"(?<![\w'’′)+*/^=-])(?P<matrix>[A-Z]|[\[{{][A-Z][\]}}]){_OF}[ \t]*[·*]?[ \t]*(?:\{{[ \t]*)?{_COLUMN}(?:[ \t]*\}})?"
    rf"(?P<more>(?:[ \t]*[-+−][ \t]*{_TERM}){{0,3}})[ \t]*=[ \t]*(?P<right>{_TERM}(?:[ \t]*[-+−][ \t]*{_TERM}){{0,3}}|0)"
    r"(?=[ \t]*(?:$|[,;.:][ \t]*(?:$|[ \t])|[ \t](?:with|where|mit|wobei)\b))",
    re.MULTILINE,
)
_PART = re.compile(rf"(?P<sign>[-+−]?)[ \t]*[\[{{]?(?P<name>[A-Za-z])[\]}}]?{_OF}")


def with_general_form(written: TracedText, count: int) -> TracedText:
    """Return an answer with this form in the entries that it gives, ``count`` a column; only if it gives all of them."""
    if not 2 <= count <= MOST or not re.search(r"''|″|’’|′′|\u0308", written.text):
        return written
    written = _with_rows(_with_entries(written), count)
    edits: list[Edit] = []
    for match in islice(_GENERAL.finditer(written.text), MOST):
        matrix = match["matrix"].strip("[]{}")
        square = _given(matrix, written.text, count, square=True)
        sides = [_side(match[x], written.text, count) for x in ("more", "right")]
        if square is None or None in sides:
            continue
        start = "\n" if written.text[written.text.rfind("\n", 0, match.start()) + 1 : match.start()].strip() else ""
        edits.append((*match.span(), f"{start}{square}*{match['column']}''{sides[0]} = {sides[1]}\n"))
    return written.edited(edits)


def _side(side: str, text: str, count: int) -> str | None:
    """Columns that are added up on one side, each as its entries or by its name; None if one is not given."""
    if side == "0":
        return side
    found: list[str] = []
    for part in _PART.finditer(side):
        column = _given(part["name"], text, count, square=False)
        if column is None:
            return None
        found.append(f" {part['sign']} {column}".replace("−", "-") if part["sign"] else column)
    return "".join(found)


def _given(name: str, text: str, count: int, *, square: bool) -> str | None:
    """A matrix, or a column, by its entries or by its name, as an answer gives it; None if it does not."""
    numbers = [str(k + 1) for k in range(count)]
    entries = {m.translate(_LOWERED) for m in re.findall(rf"(?<![\w\\])({name}{_INDEX})[ \t]*=(?!=)", text)}
    plain = {re.sub(r"[_{}]", "", m): m for m in entries}
    rows = [[plain.get(f"{name}{i}{j}") for j in numbers] for i in numbers] if square else []
    column = [plain.get(f"{name}{i}") for i in numbers]
    if square and all(map(all, rows)):
        return "[" + "; ".join(", ".join(map(str, row)) for row in rows) + "]"
    if not square and all(column):
        return "[" + "; ".join(map(str, column)) + "]"
    return name if re.search(rf"(?<![\w\\]){name}{_OF}[ \t]*=[ \t\n]*\[", text) else None


def _with_entries(written: TracedText) -> TracedText:
    """An answer in which a table of entries and their values is a list of statements."""
    edits: list[Edit] = []
    for match in islice(_TABLE.finditer(written.text), MOST):
        lines = match.group().rstrip("\n").split("\n")
        cells = [[x.strip().strip("$`*") for x in line.strip()[1:-1].split("|")] for line in lines]
        body = [row for row, line in zip(cells, lines, strict=True) if _RULE.fullmatch(line) is None and any(row)]
        if body and all(len(row) == 2 and _ENTRIES.fullmatch(row[0]) for row in body):
            edits += _statements(match.start(), lines, cells)
    return written.edited(edits)


def _statements(at: int, lines: Sequence[str], cells: Sequence[Sequence[str]]) -> Iterator[Edit]:
    for line, row in zip(lines, cells, strict=True):
        stated = len(row) == 2 and _ENTRIES.fullmatch(row[0]) is not None
        yield at, at + len(line), f"{row[0]} = {row[1]}" if stated else ""
        at += len(line) + 1


def _with_rows(written: TracedText, count: int) -> TracedText:
    """An answer in which a matrix of which every row has a line of its own is stated as a whole, in the first one."""
    found: dict[str, dict[str, re.Match[str]]] = {}
    for match in islice(_ROW.finditer(written.text), MOST * MOST):
        found.setdefault(match["name"], {}).setdefault(match["after"] or match["before"], match)
    edits: list[Edit] = []
    for name, rows in found.items():
        if sorted(rows) == [str(k + 1) for k in range(count)]:
            listed = [rows[k] for k in sorted(rows)]
            whole = "; ".join(m["row"] for m in listed)
            edits += [(*m.span(), f"{name} = [{whole}]" if k == 0 else "") for k, m in enumerate(listed)]
    return written.edited(edits)
