"""Square brackets and commas for rows and columns that are written as lists: (x, y), ((a, b), (c, d)), [x \\; y]^T."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lagrangian.check.reading.traced_text import Edit

_UPRIGHT = r"(?:\\(?:mathrm|mathsf|mathbf|mathit|text|textsf|rm|sf)\s*\{?\s*)?"
TRANSPOSED = re.compile(rf"\s*(?:\.?['’](?!\w)|\^\s*[({{]?\s*(?:{_UPRIGHT}T|⊤|\\top|\\intercal)|ᵀ|\.T(?!\w))")
_RATE_OF_LIST = re.compile(r"(?<![=<>'′’″])=\s*\[[^\[\];=]*,[^\[\];=]*\](?P<mark>\.?['’])(?=[ \t]*(?:[,;.\n]|\Z))")
_PRIMED = re.compile(r"['′’″]\s*\Z|(?:dot|d{1,2})\s*\Z")
_TUPLE_SIDE = re.compile(r"=\s*(?P<open>\()")
_AFTER_SIDE = re.compile(r"[ \t]*(?:[,;.\n]|\Z)")
_UPRIGHT_T = rf"{_UPRIGHT}(?:T|\\top|\\intercal)(?![A-Za-z])"
_SPACED_ROW = re.compile(
    r"(?<!\\)[\[(](?P<row>(?:[^\[\]()=,;\n\\]|\\[ ,;:!]|\\[A-Za-z]++){1,400}?)"
    rf"(?:\\right\s*)?[\])]\s*\^\s*\{{?\s*{_UPRIGHT_T}"
)
_SPACE = re.compile(r"(?:\s*(?:\\[ ,;:!]|\\q?quad(?![A-Za-z])|~))+\s*")
_TUPLES = re.compile(r"(?<![\w)\]])\(\s*(?=\()")

_LONGEST = 2000
"""The most characters of a matrix in round brackets."""

_DEEPEST = 20
"""The most brackets around an entry of one."""


def spaced_rows(text: str) -> Iterator[Edit]:
    """Commas for the spaces of LaTeX between the entries of a row that is transposed, [x \\; y]^T."""
    for match in _SPACED_ROW.finditer(text) if "\\" in text else ():
        if "\\begin" in match["row"]:
            continue
        at = match.start("row")
        for gap in _SPACE.finditer(match["row"]):
            between = gap.start() > 0 and gap.end() < len(match["row"])
            yield at + gap.start(), at + gap.end(), ", " if between else " "


def tuples(text: str) -> list[Edit]:
    """The brackets and commas of rows in round brackets, ((a, b), (c, d)), as [a, b; c, d]."""
    edits: list[Edit] = []
    for match in _TUPLES.finditer(text):
        if edits and match.start() < edits[-1][1]:
            continue  # inside one that was read
        rows, depth, marks = 0, 0, list[Edit]()
        commas: list[int] = []
        for at in range(match.start(), min(len(text), match.start() + _LONGEST)):
            c = text[at]
            depth += (c in "([") - (c in ")]")
            if c == "(" and depth == 2 and text[match.start() + 1 : at].rstrip()[-1:] in ("", ","):
                rows += 1
                commas.append(0)
                marks.append((at, at + 1, ""))
            elif c == ")" and depth == 1:
                marks.append((at, at + 1, ""))
            elif c == "," and depth == 1:
                marks.append((at, at + 1, ";"))
            elif c == "," and depth == 2 and commas:
                commas[-1] += 1
            elif depth > _DEEPEST or (depth == 1 and not c.isspace() and at > match.start()):
                break  # a product of brackets, ((a + b) c)
            elif depth == 0:
                if rows > 1 and commas[0] and len(set(commas)) == 1:
                    edits += [(match.start(), match.start() + 1, "["), *marks, (at, at + 1, "]")]
                break
    return edits


def tuple_sides(text: str) -> Iterator[Edit]:
    """Square brackets for round ones around a list that is a whole side, q = (x, y), or a side that is transposed."""
    for match in _TUPLE_SIDE.finditer(text):
        first = match.start("open")
        depth, listed = 0, False
        for at in range(first, min(len(text), first + _LONGEST)):
            c = text[at]
            depth += (c in "([{") - (c in ")]}")
            listed = listed or (c == "," and depth == 1)
            if c in "=;\n" or depth > _DEEPEST:
                break
            if depth == 0:
                turned = TRANSPOSED.match(text, at + 1)
                if turned is not None or (listed and _AFTER_SIDE.match(text, at + 1)):
                    yield first, first + 1, "["
                    yield at, at + 1, "]"
                break


def transposed_sides(text: str) -> Iterator[Edit]:
    """^T for the mark of MATLAB behind a row that is the value of a name, q = [x, y]'; behind the value of a rate,
    q' = [x, y]', it is another rate."""
    for match in _RATE_OF_LIST.finditer(text):
        if not _PRIMED.search(text[max(0, match.start() - 8) : match.start()]):
            yield *match.span("mark"), "^T"
