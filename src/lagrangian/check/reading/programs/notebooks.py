r"""Reads notebooks of Python: what a cell shows belongs to what stands on its last line, and columns have entries.

T⏎ Out[2]: $\frac{m \dot{x}^{2}}{2}$            $T = \frac{m \dot{x}^{2}}{2}$       the value of a name
Out[3]: $m \ddot{x} - F$                        $m \ddot{x} - F = 0$                an expression that is zero
LM.forcing⏎ Out[4]: Matrix([[u], [v]])          forcing = Matrix([[u], [v]])            a matrix
P = Matrix([x, 0])   V = m*g*P[1]               P = [x, 0]   V = m*g*(0)
v = P.diff(t)   v[0]                            v = P.diff(t)   (x).diff(t)
v.dot(v)   (v.T*v)[0]                           abs(v)^2
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.programs.sessions import MOST, closes
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

_NAME = r"[A-Za-z]\w{0,23}+"
_SHOWN = re.compile(
    r"^[ \t]*+Out[ \t]?\[\d{1,4}\][ \t]*+:?[ \t]*+\n?[ \t]*+(?P<opens>\$\$?(?:[ \t]*+\\displaystyle)?)?"
    r"(?P<value>[^$\n=]{1,2000}+)(?P<closes>\$\$?|$)",
    re.MULTILINE,
)
_DRAWN = re.compile(r"\n[ \t]*+(?!```|In[ \t]?\[|\[\d|>>>)\S")
"""A line directly below a value: this is drawn over several lines."""
_TYPED = r"(?:^|[;\n]|>>>|julia>|sage:|(?:In[ \t]?)?\[\d{1,4}\]:)[ \t]*+"
_ABOVE = re.compile(rf"{_TYPED}(?P<name>{_NAME})[ \t]*+(?:\n[ \t]*+(?:```[^\n]*+)?)*+\Z")
_MATRIX = re.compile(
    r"^[^\S\n]*+(?:>>>|julia>|sage:|(?:In[ \t]?)?\[\d{1,4}\]:)?[ \t]*+"
    rf"(?P<typed>(?:\w{{1,10}}\(){{0,3}}(?:{_NAME}\.)?(?P<name>{_NAME})\){{0,3}};?)[ \t]*+\n"
    r"\s{0,20}(?:(?:Out[ \t]?)?\[\d{1,4}\]:?=?)?\s{0,20}?"
    r"(?:(?P<call>(?=(?:\w{1,8}\.)?(?:Immutable|Mutable)?(?:Dense)?Matrix\())|(?P<drawn>^(?:[ \t]*+[⎡⎢⎣][^\n]*+\n?)+))",
    re.MULTILINE,
)
"""A name alone on a line, perhaps in a call that prints it, and a matrix below it."""
_MOVES = re.compile(r"\u0308|[ẍÿẅ¨]|dt(?!\w)|''|″|,\s*2\)|ddot|\.diff")
"""What shows that the entries of a matrix are equations."""
_OF_SYMPY = ("mass_matrix", "forcing")
"""What SymPy calls the matrix and the column of the equations M q'' = f."""
_ACCELERATES = re.compile(r"\\ddot(?![a-z])|d\^\{?2\}?\s?\}?\s?\{\s?d\s?t")
_COLUMN = re.compile(
    rf"^[ \t]*+(?P<name>{_NAME})[ \t]*+=[ \t]*+(?P<call>(?:\w{{1,6}}\.)?(?:Matrix|array)\()(?=\[)", re.MULTILINE
)
_DERIVED = re.compile(
    rf"^[ \t]*+(?P<name>{_NAME})[ \t]*+=[ \t]*+(?:(?P<of>{_NAME})\.diff\(t\)"
    rf"|(?:\w{{1,6}}\.)?diff\((?P<by>{_NAME}), ?t\))[ \t]*+(?:$|#)",
    re.MULTILINE,
)
"""The rate of a column."""
_SQUARE = re.compile(
    rf"(?<![\w.])(?P<of>{_NAME})\.dot\((?P=of)\)"
    rf"|\((?P<row>{_NAME})\.(?:T|transpose\(\)) ?[*@] ?(?P=row)\)\[0(?:, ?0)?\]"
)
_SPEED = re.compile(rf"({_NAME}) - ({_NAME}'|Derivative\({_NAME}\(t\), t\))")
_SPEEDS = re.compile(rf"^[ \t]*+(?P<list>\[{_SPEED.pattern}(?:, {_SPEED.pattern}){{0,9}}\])[ \t]*+$", re.MULTILINE)
"""Kane's kinematic equations, which are zero: [u1 - x', u2 - theta']."""
LONGEST = 400
"""The most characters of an entry that is put in the place of its index."""


def with_shown_values(written: TracedText) -> TracedText:
    """Return an answer in which what a cell shows is a statement: of the name on its last line, or that an expression
    with accelerations is zero."""
    text = written.text
    edits: list[Edit] = []
    for match in islice(_SHOWN.finditer(text), MOST):
        above = _ABOVE.search(text, max(0, match.start() - 80), match.start())
        if bool(match["opens"]) != ("$" in match["closes"]):
            continue
        if not match["opens"] and _DRAWN.match(text, match.end()):
            continue
        if above is not None:
            edits.append((match.start("value"), match.start("value"), f" {above['name']} = "))
            edits.append((*above.span("name"), ""))
        elif match["opens"] and _ACCELERATES.search(match["value"]):
            edits.append((match.end("value"), match.end("value"), " = 0"))
    return written.edited(apart(edits))


def with_named_matrices(written: TracedText) -> TracedText:
    """Return an answer in which a matrix that a program shows below a name is the value of this name, and the mass
    matrix and the forces of SymPy make equations."""
    text = written.text
    found = [m for m in islice(_MATRIX.finditer(text), MOST) if not _MOVES.search(_matrix(text, m))]
    edits: list[Edit] = []
    for match in found:
        edits.append((*match.span("typed"), ""))
        name = f"{match['name']} = "
        if match["drawn"] is None:
            edits.append((match.start("call"), match.start("call"), name))
            continue
        starts = [match.start("drawn") + m.start() for m in re.finditer("^(?=.)", match["drawn"], re.MULTILINE)]
        middle = len(starts) // 2
        edits += [(at, at, name if k == middle else " " * len(name)) for k, at in enumerate(starts)]
    if {m["name"] for m in found}.issuperset(_OF_SYMPY):
        end = len(text)
        for listed in _SPEEDS.finditer(text):
            said = ", ".join(f"{a} = {b}" for a, b in _SPEED.findall(listed["list"]))
            edits.append((*listed.span("list"), said))
        edits.append((end, end, "\n\n{}*q'' = {}".format(*_OF_SYMPY)))
    return written.edited(apart(edits))


def _matrix(text: str, match: re.Match[str]) -> str:
    """A matrix that is shown below a name."""
    if match["drawn"] is not None:
        return match["drawn"]
    return text[match.end() : closes(text, text.index("(", match.end())) + 1]


def with_columns(written: TracedText) -> TracedText:
    """Return an answer in which columns of Python are lists, and their entries stand where an index names them."""
    text, edits = written.text, list[Edit]()
    columns: dict[str, list[str]] = {}
    for match in islice(_COLUMN.finditer(text), MOST):
        end = closes(text, match.end("call") - 1)
        entries = list(_entries(text, match.end(), closes(text, match.end())))
        if end < 0 or not entries or any("[" in x or len(x) > LONGEST for x in entries):
            continue
        if _is_given_once(match["name"], text):
            edits += [(*match.span("call"), ""), (end, end + 1, "")]
            columns[match["name"]] = entries
    for match in islice(_DERIVED.finditer(text), MOST):
        if (of := columns.get(match["of"] or match["by"])) is not None and _is_given_once(match["name"], text):
            columns[match["name"]] = [f"({x}).diff(t)" for x in of]
    for name, entries in columns.items():
        indexed = [m for m in re.finditer(rf"(?<![\w.]){name}\[(\d)\](?![ \t]*+=)", text) if int(m[1]) < len(entries)]
        edits += [(*m.span(), f"({entries[int(m[1])]})") for m in islice(indexed, MOST)]
    return written.edited(apart(edits)).sub(_SQUARE, lambda m: f"abs({m['of'] or m['row']})^2")


def _is_given_once(name: str, text: str) -> bool:
    """Whether only one statement gives a name its value."""
    return len(re.findall(rf"^[ \t]*+{name}[ \t]*+=(?!=)", text, re.MULTILINE)) == 1


def _entries(text: str, start: int, end: int) -> Iterator[str]:
    """The entries of a list that opens at a place and is closed at another."""
    depth, first = 0, start + 1
    for at in range(start + 1, max(end, start + 1)):
        depth += (text[at] in "([{") - (text[at] in ")]}")
        if text[at] == "," and depth == 0:
            yield text[first:at].strip()
            first = at + 1
    if text[first:end].strip():
        yield text[first:end].strip()
