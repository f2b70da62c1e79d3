"""Matrices that an answer gives entry by entry, or moves to the other side: what programs and robotics write.

M11 = a, M12 = M21 = b, M22 = c, and M*q'' + h = f          M = [M11, M12; M21, M22] is added
q'' = M \\ f,  q'' = inv(M)*f,  q'' = M^-1 f                 M*(q'') = f
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.name_patterns import LOWERED
from lagrangian.check.reading.traced_text import Edit, TracedText

_ENTRY = re.compile(r"(?<![\w\\.])(?P<name>[A-Za-z])_?\{?(?P<place>[1-6₁-₆]{1,2})\}?(?=\s*=(?!=))")
_MATRIX = re.compile(r"(?<![\w\\.])([A-Za-z]\w{0,9})\s*=\s*\[")
_SOLVED = re.compile(
    r"^(?P<left>[^=\n]{1,200})=[ \t]*(?:inv\([ \t]*(?P<inv>[A-Za-z]\w{0,9})[ \t]*\)[ \t]*[*·]?"
    r"|(?P<raised>[A-Za-z]\w{0,9})[ \t]*\^[ \t]*[({]?-1[)}]?[ \t]*[*·]?|(?P<under>[A-Za-z]\w{0,9})[ \t]*\\)"
    r"[ \t]*(?P<right>[^=\n;%]{1,400}?)[ \t]*;?[ \t]*(?=$|%)",
    re.MULTILINE,
)
_ACCELERATIONS = re.compile(r"q?acc(?:el(?:erations?)?)?|a|sol|ans")
_ONE_FACTOR = re.compile(r"[A-Za-z]\w{0,9}|\([^()]*(?:\([^()]*\)[^()]*)*\)|\[[^\[\]]*\]")


_COLUMN = r"(?:\*\*)?[ \t]*[*·]?[ \t]*(?:\[|q(?:_?dd?(?:ot)?)?(?![A-Za-z0-9_])|\\)"
"""What a matrix is multiplied with: M*[x''; y''], M q'', M qddot; M q1'' is a mass."""

_SIDE = (
    r"^(?![^\n]*∂)[^\n]*[=+-][ \t]*(?:\*\*)?NAME(?![\w(])(?:\*\*)?[ \t]*"
    r"(?:=|[.,;:]?[ \t]*$|,?[ \t]+(?:with|where|in which|mit|wobei|wo)\b)"
)
MOST = 6
"""The most rows of a matrix that is given entry by entry."""


def solved_matrices(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which the matrix stands on the left that was inverted on the right.

    A name that nothing else uses, and that says that it is the accelerations, stands for q''; one of the system's
    (``taken``) does not. Only a single factor may be behind an inverse with a sign of multiplication; all that is
    behind ``\\`` is divided.
    """
    given = set(_MATRIX.findall(written.text))
    edits: list[Edit] = []
    for match in _SOLVED.finditer(written.text):
        name = match["inv"] or match["raised"] or match["under"]
        if name in given and _ONE_FACTOR.fullmatch(match["right"]) is not None:
            left = match["left"].strip()
            if _ACCELERATIONS.fullmatch(left) is not None and not taken(left) and _occurs_once(left, written.text):
                left = "q''"
            edits.append((*match.span(), f"{name}*({left}) = {match['right']}"))
    return written.edited(edits)


def _occurs_once(name: str, text: str) -> bool:
    return len(re.findall(rf"(?<!\w){name}(?!\w)", text)) == 1


def entered_matrices(written: TracedText, count: int, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer with a statement in front for each matrix, or column, that is given entry by entry and used.

    A column is a side of an equation that is no general one with ∂, or is added there: T = T_1 + T_2 is none.
    ``count`` is the number of coordinates; ``taken`` says whether a name belongs to the system: then only a matrix is
    added, which is used in front of a column, M*q'' or M*[x''; y''].
    """
    if not 2 <= count <= MOST:
        return written
    found: dict[str, dict[str, str]] = {}
    for match in _ENTRY.finditer(written.text):
        found.setdefault(match["name"], {}).setdefault(match["place"].translate(LOWERED), match.group().strip())
    given = set(_MATRIX.findall(written.text))
    numbers = [str(k + 1) for k in range(count)]
    added: list[str] = []
    for name, entries in found.items():
        if name in given:
            continue
        rows = [[entries.get(i + j) for j in numbers] for i in numbers]
        column = [entries.get(i) for i in numbers]
        if all(map(all, rows)) and re.search(rf"(?<![\w\\]){name}{_COLUMN}", written.text):
            added.append(f"{name} = [" + "; ".join(", ".join(map(str, row)) for row in rows) + "]\n")
        elif all(column) and not taken(name) and re.search(_SIDE.replace("NAME", name), written.text, re.MULTILINE):
            added.append(f"{name} = [" + "; ".join(map(str, column)) + "]\n")
    return written.edited([(0, 0, "".join(added))] if added else [])
