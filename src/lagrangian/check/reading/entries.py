"""Matrices that an answer gives entry by entry, or moves to the other side: what programs and robotics write.

M11 = a, M12 = M21 = b, M22 = c, and M*q'' + h = f          M = [M11, M12; M21, M22] is added, so is Mq of Mq11
q'' = M \\ f,  q'' = inv(M)*f,  q'' = M^-1 f                 M*(q'') = f
[a, b; *, c],  [a, b; sym., c]                              [a, b; b, c]
det M = a c - b^2                                           |M| = a c - b^2
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from itertools import islice, pairwise

from lagrangian.check.reading.name_patterns import LOWERED
from lagrangian.check.reading.traced_text import Edit, TracedText

_ENTRY = re.compile(r"(?<![\w\\.])(?P<name>[A-Za-z](?:_?[a-z]{1,2})?)_?\{?(?P<place>[1-6₁-₆]{1,2})\}?(?=\s*=(?!=))")
_BOLD_ENTRY = re.compile(
    r"\\(?:mathbf|boldsymbol|bm)[ ]?\{?[ ]?(?P<name>[A-Za-z])[ ]?\}?[ ]?_\{?(?P<place>[1-6]{2})\}?(?=\s*&?\s*=(?!=))"
)
_DELIMITED = re.compile(r"\$|\\[\[(]|\\begin\{(?![bBpvV]?matrix|small|array|cases|aligned)")
_MATRIX = re.compile(r"(?<![\w\\.])([A-Za-z]\w{0,9})\s*=\s*\[")
_MATRIX_IN_LATEX = re.compile(r"(?<![\w\\.])([A-Za-z])\s*&?=\s*(?:\\left\s*[\[(]\s*)?\\begin\{[bp]?(?:matrix|array)\}")
_DETERMINANT = re.compile(
    r"(?P<called>(?<![\w\\|])\\?[A-Za-z]\w{0,9}[ ]?=[ ]?)?(?P<of>(?<!\w)(?:\\?det|Det)"
    r"(?:[ ]?\([ ]?(?P<round>[A-Za-z]\w{0,9})[ ]?\)|[ ]?(?<![a-z](?=[A-Za-z]))(?P<bare>[A-Za-z]\w{0,9}))(?!\w))"
)
_CHAINED = re.compile(r"[ ]?=(?!=)[^=;,\n$\\]{1,300}(?=[ \t]*$)", re.MULTILINE)
"""What else a determinant with a name equals: D = det M = a c - b^2."""
_SOLVED = re.compile(
    r"^(?P<left>[^=\n]{1,200})=[ \t]*(?:inv\([ \t]*(?P<inv>[A-Za-z]\w{0,9})[ \t]*\)[ \t]*[*·]?"
    r"|(?P<raised>[A-Za-z]\w{0,9})[ \t]*\^[ \t]*[({]?-1[)}]?[ \t]*[*·]?|(?P<under>[A-Za-z]\w{0,9})[ \t]*\\)"
    r"[ \t]*(?P<right>[^=\n;%]{1,400}?)[ \t]*;?[ \t]*(?=$|%)",
    re.MULTILINE,
)
_ACCELERATIONS = re.compile(r"q?acc(?:el(?:erations?)?)?|a|sol|ans")
_ONE_FACTOR = re.compile(r"[A-Za-z]\w{0,9}|\([^()]*(?:\([^()]*\)[^()]*)*\)|\[[^\[\]]*\]")


_COLUMN = r"(?:\*\*)?(?:\([ ]?[qxzξ][ ]?\))?[ \t]*[*·]?[ \t]*(?:\[|q(?:_?dd?(?:ot)?)?(?![A-Za-z0-9_])|\\)"
"""What a matrix is multiplied with: M*[x''; y''], M q'', M qddot; M q1'' is a mass."""

_SIDE = (
    r"^(?![^\n]*∂)[^\n]*[=+-][ \t]*(?:\*\*)?NAME(?![\w(])(?:\*\*)?[ \t]*"
    r"(?:=|[.,;:]?[ \t]*$|,?[ \t]+(?:with|where|in which|mit|wobei|wo)\b)"
)
_REST_ZERO = re.compile(
    r"(?:(?:all|the)[ \t]+){0,2}(?:other|remaining)[ \t]+(?:entries|elements|components|ones)"
    r"[ \t]+(?:(?:are|be)[ \t]+(?:all[ \t]+)?(?:0(?![.\d])|zero)|vanish)"
    r"|alle[ \t]+(?:anderen|übrigen)[ \t]+(?:Einträge|Elemente)[ \t]+(?:sind[ \t]+(?:0(?![.\d])|null)|verschwinden)",
    re.IGNORECASE,
)
"""What says that the entries that are not given are 0."""
MOST = 6
"""The most rows of a matrix that is given entry by entry."""
MOST_MATRICES = 60
"""The most matrices of which marks are looked at."""
_AMPERSAND, _SEMICOLON, _WIDE = re.compile(r"(?<!\\)&"), re.compile(";"), re.compile(r"[ \t]{2,}")

_IN_LATEX = re.compile(
    r"\\begin\{(?:[bpBvV]?matrix|smallmatrix)\}(?P<inside>[^{}\\]*+(?:(?!\\(?:begin|end)\{)[\\{}][^{}\\]*+)*+)\\end\{"
)
_MIRRORED = re.compile(
    r"[*∗⋆★]|\\(?:ast|star)|\\(?:text|mathrm|mbox)\s?\{[ ]?symm?(?:\.|etric|etrisch)?[ ]?\}|symm?(?:\.|etric|etrisch)?",
    re.IGNORECASE,
)
"""What stands in a symmetric matrix for the entry on the other side of its diagonal."""
_ROW_IN_LATEX = re.compile(r"\\\\(?:\[[^\]\n]{0,9}\])?")
_ROWS_OF_LINES = re.compile(r"(?:^[^\[\]\n]{0,40}\[[^\[\]\n=;]{1,300}\][^\n]{0,600}(?:\n|\Z)){2,6}", re.MULTILINE)
_ROW_OF_LINE = re.compile(r"^[^\[\]\n]{0,40}\[(?P<row>[^\[\]\n=;]{1,300})\]", re.MULTILINE)
_ONE_LINE = re.compile(r"\[(?P<inside>[^\[\]=]{3,1500};[^\[\]=]{1,1500})\]")
_Cell = tuple[int, int, str]


def with_symmetric_entries(written: TracedText, notes: dict[str, None]) -> TracedText:
    """Return an answer in which the entries of symmetric matrices that only a mark stands for are written out, as a
    note tells; the other entry must be given."""
    text, edits = written.text, list[Edit]()
    for match in islice(_IN_LATEX.finditer(text), MOST_MATRICES):
        rows = list(_parts(text, *match.span("inside"), _ROW_IN_LATEX))
        edits += _mirrored([list(_parts(text, a, b, _AMPERSAND)) for a, b, x in rows if x])
    if "\\begin{" not in text:
        for match in islice(_ONE_LINE.finditer(text), MOST_MATRICES):
            rows = list(_parts(text, *match.span("inside"), _SEMICOLON))
            edits += _mirrored([list(_entries(text, a, b)) for a, b, x in rows if x])
        for block in islice(_ROWS_OF_LINES.finditer(text), MOST_MATRICES):
            spans = [m.span("row") for m in _ROW_OF_LINE.finditer(text, *block.span())]
            edits += _mirrored([list(_entries(text, *x)) for x in spans])
    if edits:
        notes.setdefault("Marks in a symmetric matrix were read as the entries on the other side of its diagonal.")
    return written.edited(edits)


def _parts(text: str, start: int, end: int, between: re.Pattern[str]) -> Iterator[_Cell]:
    """The parts of a piece of a text between marks, each with its place and without the blanks around it."""
    cuts = [(start, start), *(m.span() for m in between.finditer(text, start, end)), (end, end)]
    for (_, a), (b, _) in pairwise(cuts):
        yield a, b, text[a:b].strip()


def _entries(text: str, start: int, end: int) -> Iterator[_Cell]:
    """The entries of a row in plain text: between commas, or else between several blanks."""
    row = text[start:end]
    depths = [row.count("(", 0, k) - row.count(")", 0, k) for k in range(len(row))]
    commas = [start + k for k, c in enumerate(row) if c == "," and not depths[k]]
    if not commas:
        lead, trail = len(row) - len(row.lstrip()), len(row) - len(row.rstrip())
        return _parts(text, start + lead, end - trail, _WIDE)
    cuts = [start, *(x + 1 for x in commas)]
    return ((a, b, text[a:b].strip()) for a, b in zip(cuts, [*commas, end], strict=True))


def _mirrored(rows: list[list[_Cell]]) -> Iterator[Edit]:
    """The entries of a square matrix that marks stand for: each is the one on the other side of the diagonal; where one
    mark stands for all, the others are empty, or the rows end with those from the diagonal on."""
    size = len(rows)
    given = [[x for x in row if x[2] and _MIRRORED.fullmatch(x[2]) is None] for row in rows]
    if not 2 <= size <= MOST or not any(_MIRRORED.fullmatch(x[2]) for row in rows for x in row):
        return
    if any(len(row) != size for row in rows):
        if all(len(row) == size - i for i, row in enumerate(given)):
            yield from _with_first_entries(rows, given)
        return
    open_ones = [(i, j) for i, row in enumerate(rows) for j, x in enumerate(row) if x not in given[i]]
    if all(i != j and rows[j][i] in given[j] for i, j in open_ones):
        yield from ((*rows[i][j][:2], f" {rows[j][i][2]} ") for i, j in open_ones)


def _with_first_entries(rows: list[list[_Cell]], given: list[list[_Cell]]) -> Iterator[Edit]:
    """The entries in front of the diagonal in rows that begin with it, instead of the mark that stands for them."""
    for i, row in enumerate(rows):
        yield from ((*x[:2], "") for x in row if x not in given[i])
        at = given[i][0][0]
        yield at, at, "".join(f"{given[j][i - j][2]}   " for j in range(i))


def with_determinants(written: TracedText) -> TracedText:
    """Return an answer in which the determinant of a matrix that it gives is written with bars, det M as |M|.

    Of D = det M = a c - b^2 the second part is stated by itself.
    """
    text = written.text
    given = set(_MATRIX.findall(text)) | set(_MATRIX_IN_LATEX.findall(text))
    edits: list[Edit] = []
    for match in islice(_DETERMINANT.finditer(text), MOST_MATRICES) if given else ():
        name = match["round"] or match["bare"]
        if name not in given:
            continue
        edits.append((*match.span("of"), f"|{name}|"))
        if match["called"] and (chain := _CHAINED.match(text, match.end())) is not None:
            edits.append((*match.span("called"), ""))
            edits.append((chain.end(), chain.end(), f"; {match['called'].strip()} |{name}|"))
    return written.edited(edits)


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


def _listed(form: re.Pattern[str], text: str) -> dict[str, dict[str, str]]:
    """The entries that a text gives of matrices and columns, by the names of these and by their places."""
    found: dict[str, dict[str, str]] = {}
    for match in form.finditer(text):
        found.setdefault(match["name"], {}).setdefault(match["place"].translate(LOWERED), match.group().strip())
    return found


def _rows(entries: Mapping[str, str], count: int, zero: str | None) -> list[list[str | None]]:
    """The rows of a matrix; ``zero`` is what stands for the entries that are not given."""
    numbers = [str(k + 1) for k in range(count)]
    return [[entries.get(i + j, zero if len(max(entries)) > 1 else None) for j in numbers] for i in numbers]


def entered_matrices(written: TracedText, count: int, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer with a statement in front for each matrix, or column, that is given entry by entry and used.

    A column is a side of an equation that is no general one with ∂, or is added there: T = T_1 + T_2 is none.
    ``count`` is the number of coordinates; ``taken`` says whether a name belongs to the system: then only a matrix is
    added, which is used in front of a column, M*q'' or M*[x''; y'']. Of a matrix the entries that are not given may be
    said to be 0.
    """
    if not 2 <= count <= MOST:
        return written
    given, zero = set(_MATRIX.findall(written.text)), "0" if _REST_ZERO.search(written.text) else None
    added: list[str] = []
    for name, entries in _listed(_ENTRY, written.text).items():
        if name in given:
            continue
        rows = _rows(entries, count, zero)
        column = [entries.get(str(k + 1)) for k in range(count)]
        if all(map(all, rows)) and re.search(rf"(?<![\w\\]){name}{_COLUMN}", written.text):
            added.append(f"{name} = [" + "; ".join(", ".join(map(str, row)) for row in rows) + "]\n")
        elif all(column) and not taken(name) and re.search(_SIDE.replace("NAME", name), written.text, re.MULTILINE):
            added.append(f"{name} = [" + "; ".join(map(str, column)) + "]\n")
    return written.edited([(0, 0, "".join(added))] if added else [])


def entered_in_latex(written: TracedText, count: int) -> TracedText:
    """Return an answer in LaTeX with a statement in front for each matrix in bold of which it gives all entries that
    are not said to be 0, and which is used in front of rates: \\mathbf{M}\\ddot{q}."""
    if not 2 <= count <= MOST:
        return written
    zero = "0" if _REST_ZERO.search(written.text) else None
    added, around = "", "$$" if _DELIMITED.search(written.text) else ""
    for name, entries in _listed(_BOLD_ENTRY, written.text).items():
        bold = rf"\\(?:mathbf|boldsymbol|bm)\s?\{{?\s?{name}\s?\}}?"
        rows = _rows(entries, count, zero)
        used = re.search(rf"{bold}\s?(?:\\,)?\s?\\d?dot(?![a-z])", written.text)
        if all(map(all, rows)) and used and not re.search(rf"{bold}\s*&?=", written.text):
            listed = r" \\ ".join(" & ".join(map(str, row)) for row in rows)
            added += rf"{around}\mathbf{{{name}}} = \begin{{bmatrix}} {listed} \end{{bmatrix}}{around}" + "\n"
    return written.edited([(0, 0, added)] if added else [])
