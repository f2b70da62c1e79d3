"""Matrices drawn with brackets over several lines, and rows of a matrix whose entries are separated by blanks.

    [ M+m     m cos α ] [ẍ]   [ F      ]
    [ m cos α    m    ] [s̈] = [ −k s   ]      [M+m, m cos α; m cos α, m] [ẍ; s̈] = [F; −k s]

    [m 0; 0 m]*[x''; y'']                     [m, 0; 0, m]*[x''; y'']
    [M]{q''} = {0; F}    (x1 x2)^T            [M]q'' = [0; F]    [x1; x2]

    [x1 x2]'                                  [x1, x2]'
    ((m, 0), (0, m))                          [m, 0; 0, m]

Blanks also are products without a sign. They separate entries if the product of matrices has the right shape only so,
in a row that is transposed, or if the matrix is square and contains a number behind a blank, a sign that only what
follows touches, as in [k −k; −k k], or products with a sign.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from lagrangian.check.reading.drawn.matrices import without_drawings
from lagrangian.check.reading.drawn.side_by_side import side_by_side
from lagrangian.check.reading.listed_rows import TRANSPOSED, spaced_rows, transposed_sides, tuple_sides, tuples
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.records import dataclass

_TALL = re.compile("[⎡⎢⎣⎤⎥⎦]")
_PLAIN = str.maketrans("⎡⎢⎣⎤⎥⎦", "[[[]]]")
_BETWEEN = re.compile(
    r"[\s=+*·×.,;@−-]*(?:[*·]?[ \t]*(?:[qxXy]|xi|ξ)(?:['’′]{0,2}|dd?|_?d?dot|[\u0307\u0308])[\s=+,;.−-]*)?\Z"
)
"""What stands between brackets: signs, and a column of all coordinates by its letter."""
_CLOSED = {"[": "]", "(": ")"}
_GAP = re.compile(r"[ \t]+")
_LAST_WORD = re.compile(r"([^\W\d_]+)[²³]?\Z")
_SIGN = re.compile(r"[-+−–](?=\S)")
_OPERATOR = "+-−–*/^·×=,;"
_TIMES = re.compile(r"\s*[*·×@]?\s*")
_AT = re.compile(r"(?:(?<=[)\]])\s*@\s*|(?<=[\w)\]'])\s+@\s+)(?=[\w(\[])")
_ARRAY = re.compile(r"[■█]\s{0,9}\(")
"""A matrix or an array in the linear format of Word's equation editor."""
_BARE_NUMBER = re.compile(r"[-−]?\d+(?:\.\d+)?\Z")
_NAMED_ROW = re.compile(
    r"\s*+[^\W\d]\w*+(?:⁻¹|\^\(?-1\)?)?+\s*+(?:\([\w,; '’′\u0307]{1,24}\)\s*+)?=\s*+"
    r"(?:[^\[\]=;\n]{1,80}?[)\w²³][ \t]*+[*·×⋅]?[ \t]*+)?\[(?P<row>[^\[\]=;]++)(?P<close>\])\s*\Z"
)
_ROW_ALONE = re.compile(r"\s*+(?P<open>\[)(?P<row>[^\[\]=;]++)(?P<close>\])\s*\Z")
_ATOM = r"[^\W\d]\w{0,15}['’′]{0,2}"
_NAME_ALONE = re.compile(r"\s*+[^\W\d]\w{0,15}+\s*+\Z")
_BRACED_NAME = re.compile(rf"(?<![_^\w{{,])\{{[ \t]*+(?P<name>{_ATOM}|0)[ \t]*+\}}")
_BRACED_COLUMN = re.compile(r"(?<![_^\w{,])\{(?P<entries>[^{}=;]{0,200}(?:;[^{}=;]{0,200}){1,20})\}")
_MAX = 200
"""The largest number of matrices whose entries are looked at."""

_LATEX = r"(?:b|p|B|v|V|small)?matrix\}"
_MATRIX_END = re.compile(rf"\\end\{{{_LATEX}\s*(?:\\right\s*[\])|.])?\s*\Z")
_MATRIX_START = re.compile(rf"\s*(?:\\left\s*[\[(|.]\s*)?\\begin\{{{_LATEX}")
_GOES_ON = re.compile(r"\s*(?:=|[-+]|\\cdot|\\times)")
_OPEN_END = re.compile(r"(?:=|[-+]|\\cdot|\\times)\s*\Z")


def on_one_line(written: TracedText) -> TracedText:
    """Return an answer with matrices in one line, and with commas between their entries."""
    written = written.edited(list(side_by_side(written.text)))
    written = without_drawings(written.edited(spaced_rows(written.text)))
    if "\\begin{" in written.text:
        return _joined(written)
    drawn = [line.lstrip()[0] for line in written.text.split("\n") if _TALL.search(line)]
    if drawn and all(_TALL.match(first) for first in drawn):  # products of matrices, which have no name
        written = TracedText(written.text.translate(_PLAIN), written.origins)
    if "\\" not in written.text:
        written = written.sub(_BRACED_NAME, lambda m: m["name"]).sub(_BRACED_COLUMN, lambda m: f"[{m['entries']}]")
    written = _blocks(_named_rows(written.edited(_named_in_the_middle(written.text))))
    if "@" in written.text and not _ARRAY.search(written.text):  # in which @ ends a row
        written = written.sub(_AT, lambda match: " * ")
    written = written.edited(tuples(written.text))
    written = written.edited(tuple_sides(written.text))
    if "[" not in written.text:
        return written
    written = written.edited(_row_ends(written.text))
    written = written.edited(_entry_gaps(written.text))
    return written.edited(transposed_sides(written.text))


def _named_in_the_middle(text: str) -> Iterator[Edit]:
    """A matrix whose rows are in lines below each other, with brackets above each other, and whose name stands in front
    of one that is not the first, in one line behind its name."""
    block: list[tuple[int, int, re.Match[str]]] = []
    at = 0
    for line in [*text.split("\n"), ""]:
        row = (_ROW_ALONE.match(line) or _NAMED_ROW.match(line)) if len(line) < 2000 else None
        opens = -1 if row is None else row.start("row") - 1
        if block and opens != block[-1][1]:
            yield from _named_before(text, block)
            block = []
        if row is not None:
            block.append((at, opens, row))
        at += len(line) + 1


def _named_before(text: str, block: Sequence[tuple[int, int, re.Match[str]]]) -> Iterator[Edit]:
    """The edits of such a matrix, if one of these rows has a name, and not the first."""
    names = [(at, row) for at, _, row in block if row.re is _NAMED_ROW]
    if len(names) != 1 or block[0][2].re is _NAMED_ROW or len({_commas(row["row"]) for _, _, row in block}) > 1:
        return
    at, named = names[0]
    yield block[0][0], block[0][0] + block[0][1], text[at : at + named.start("row") - 1].strip() + " "
    for (above, _, row), (below, opens, _) in pairwise(block):
        yield above + row.start("close"), below + opens + 1, "; "


def _named_rows(written: TracedText) -> TracedText:
    """A matrix with a name and rows in brackets in lines below each other, M = [a  b], [c  d], as M = [a  b; c  d]; so
    also its inverse, M⁻¹ = 1/D [c  -b], [-b  a], with a factor.

    Rows whose entries have commas between them have the same number of entries.
    """
    edits: list[Edit] = []
    above, at, end = -1, 0, 0
    for line in written.text.split("\n"):
        row = _ROW_ALONE.match(line) if above >= 0 and len(line) < 2000 else None
        if row is not None and _commas(row["row"]) == above:
            edits.append((end, at + row.end("open"), "; "))
        else:
            row = None
        match = row or (_NAMED_ROW.match(line) if len(line) < 2000 else None)
        above = _commas(match["row"]) if match is not None else -1
        end = at + match.start("close") if match is not None else 0
        at += len(line) + 1
    return written.edited(edits)


def _commas(row: str) -> int:
    """The number of commas between the entries of a row, and not in brackets."""
    depths, commas = 0, 0
    for c in row:
        depths += (c == "(") - (c == ")")
        commas += c == "," and not depths
    return commas


def _joined(written: TracedText) -> TracedText:
    """LaTeX's matrices in lines of their own, as one statement."""
    edits: list[Edit] = []
    above, at = "", 0
    for line in written.text.split("\n"):
        ends = _MATRIX_END.search(above) is not None
        starts = _MATRIX_START.match(line) is not None
        both = "=" in above and "=" in line
        if (ends and (_GOES_ON.match(line) or (starts and not both))) or (starts and _OPEN_END.search(above)):
            edits.append((at - 1, at, " "))
            above = f"{above} {line}"
        else:
            above = line
        at += len(line) + 1
    return written.edited(edits)


# -- brackets over several lines ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Row:
    """A line that consists of brackets: where they begin and end, and what stands between them."""

    groups: tuple[tuple[int, int], ...]
    gaps: tuple[str, ...]


def _row(text: str, start: int, end: int) -> _Row | None:
    """The brackets of a line without an equals sign in them; None if something else stands in it."""
    opening = text[start:end].lstrip()[:1]
    if opening not in _CLOSED:
        return None
    groups: list[tuple[int, int]] = []
    gaps: list[str] = []
    depth, last = 0, start
    for at in range(start, end):
        c = text[at]
        if c == opening:
            if depth == 0:
                gaps.append(text[last:at])
                last = at + 1
            depth += 1
        elif c == _CLOSED[opening]:
            depth -= 1
            if depth < 0:
                return None
            if depth == 0:
                groups.append((last, at))
                last = at + 1
    gaps.append(text[last:end])
    plain = all(_BETWEEN.match(gap) for gap in gaps) and not any("=" in text[a:b] for a, b in groups)
    return _Row(tuple(groups), tuple(gaps)) if depth == 0 and plain and len(groups) > 1 else None


def _blocks(written: TracedText) -> TracedText:
    """Matrices whose rows are in lines below each other, in one line."""
    text = written.text
    run: list[tuple[int, int, _Row]] = []
    found: list[tuple[int, int, list[tuple[str, int]]]] = []
    at = 0
    for line in [*text.split("\n"), ""]:
        row = _row(text, at, at + len(line)) if len(line) < 2000 else None
        if row is None or (run and len(row.groups) != len(run[0][2].groups)):
            found += _block(text, run)
            run = []
        if row is not None:
            run.append((at, at + len(line), row))
        at += len(line) + 1
    for start, end, pieces in reversed(found):
        written = written.rearranged(start, end, pieces)
    return written


def _block(text: str, run: Sequence[tuple[int, int, _Row]]) -> Iterator[tuple[int, int, list[tuple[str, int]]]]:
    """The place of the block that lines below each other are, and its pieces in the order of one line."""
    rows = [row for _, _, row in run]
    between = [[row.gaps[i].strip() for row in rows] for i in range(len(rows[0].gaps))] if len(rows) > 1 else []
    signs = [[gap for gap in column if gap] for column in between]
    if not signs or any(len(x) > 1 for x in signs[:-1]) or signs[0]:
        return
    equal = [i for i, x in enumerate(signs) if x and "=" in x[0]]
    if len(equal) > 1 and not (equal == [len(signs) - 3, len(signs) - 2] and _names_last(text, rows)):
        return
    pieces: list[tuple[str, int]] = []
    for i in range(len(rows[0].groups)):
        inside = [row.groups[i] for row in rows if text[slice(*row.groups[i])].strip()]
        if not inside:
            return
        pieces += [(" ", inside[0][0]), (" ".join(signs[i]), inside[0][0]), (" [", inside[0][0])]
        for k, (a, b) in enumerate(inside):
            pieces += [("; " if k else "", a), (text[a:b], a)]
        pieces.append(("]", inside[-1][1]))
    yield run[0][0], run[-1][1], pieces


def _names_last(text: str, rows: Sequence[_Row]) -> bool:
    """Whether the last column consists of names: [M] [q''] = [f] = [p ; r]."""
    return all(_NAME_ALONE.match(text, *row.groups[-1]) for row in rows)


def _row_ends(text: str) -> Iterator[Edit]:
    """Semicolons for the ends of lines inside square brackets; blanks behind a semicolon and inside an entry. The
    marks of a display in LaTeX are no brackets."""
    depth, opened, ends = 0, 0, list[int]()
    for at, c in enumerate(text):
        if c in "[]" and text[at - 1 : at] == "\\":
            continue
        if c == "[":
            depth += 1
            opened = opened if depth > 1 else at
            ends = ends if depth > 1 else []
        elif c == "]" and depth:
            depth -= 1
            inside = text[opened + 1 : at]
            if depth == 0 and "=" not in inside and "[" not in inside:
                row_ends = (_ends_row(text[opened + 1 : x], text[x:at]) for x in ends)
                yield from ((x, x + 1, "; " if new else " ") for x, new in zip(ends, row_ends, strict=True))
        elif c == "\n" and depth:
            ends.append(at)
            if text[at : at + 2] == "\n\n":
                depth = 0


def _ends_row(above: str, below: str) -> bool:
    last, first = above.rstrip()[-1:], below.lstrip()
    goes_on = re.match(r"[*/^·×;)]|[-+−]\s", first) is not None
    return bool(first) and bool(last) and last not in f"{_OPERATOR}(." and not goes_on


# -- entries separated by blanks ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Matrix:
    """A matrix in square brackets: its place, and the places of its rows."""

    start: int
    end: int
    rows: tuple[tuple[int, int], ...]


def _matrices(text: str) -> list[_Matrix]:
    """The innermost square brackets without commas and equals signs between entries."""
    found: list[_Matrix] = []
    for match in re.finditer(r"\[([^\[\]]*)\]", text):
        cuts, depth = [match.start()], 0
        for at in range(match.start(1), match.end(1)):
            c = text[at]
            depth += (c in "({") - (c in ")}")
            if depth == 0 and c in ",=":
                break
            if depth == 0 and c == ";":
                cuts.append(at)
        else:
            cuts.append(match.end(1))
            rows = tuple((a + 1, b) for a, b in pairwise(cuts) if text[a + 1 : b].strip())
            found.append(_Matrix(match.start(), match.end(), rows))
        if len(found) >= _MAX:
            break
    return found


def _entry_gaps(text: str) -> Iterator[Edit]:
    """Commas for the blanks between the entries of matrices."""
    found = {matrix.start: matrix for matrix in _matrices(text)}
    listed = any(_shows_list(text, matrix) for matrix in found.values())
    for matrix in found.values():
        behind = _TIMES.match(text, matrix.end)
        factor = found.get(behind.end()) if behind is not None else None
        height = len(matrix.rows)
        every, broad = ([_gaps(text, a, b, wide=wide) for a, b in matrix.rows] for wide in (False, True))
        zeros = [[gap for gap in row if _beside_zero(text, gap)] for row in every]
        mixed = [sorted({*row, *more}) for row, more in zip(broad, zeros, strict=True)]
        for wide, gaps in ((True, broad), (False, every), (None, zeros), (None, mixed)):
            width = len(gaps[0]) + 1 if gaps else 1
            if width == 1 or any(len(x) + 1 != width for x in gaps):
                continue
            fits = factor is not None and height > 1 and len(factor.rows) == width
            if (
                fits
                or (height == 1 and TRANSPOSED.match(text, matrix.end))
                or (factor is None and height == width and (wide is not False or listed))
            ):
                yield from ((start, end, ", ") for row in gaps for start, end in row)
                break


def _shows_list(text: str, matrix: _Matrix) -> bool:
    """Whether a square matrix, or a row that is transposed, shows that in this answer blanks are no products in it."""
    height = len(matrix.rows)
    if height == 1:
        return bool(_gaps(text, *matrix.rows[0], wide=False)) and TRANSPOSED.match(text, matrix.end) is not None
    for wide in (True, False):
        gaps = [_gaps(text, a, b, wide=wide) for a, b in matrix.rows]
        if all(len(x) + 1 == height for x in gaps):
            return _is_listed(text, matrix, gaps)
    return False


def _beside_zero(text: str, gap: tuple[int, int]) -> bool:
    """Whether an entry that is 0 stands on a side of a gap."""
    return re.search(r"(?:^|[\s\[;])0\Z", text[max(0, gap[0] - 3) : gap[0]]) is not None or (
        re.match(r"0(?:[\s\];]|$)", text[gap[1] : gap[1] + 2]) is not None
    )


def _is_listed(text: str, matrix: _Matrix, gaps: Sequence[Sequence[tuple[int, int]]]) -> bool:
    """Whether the entries of a square matrix show that blanks are no products in it."""
    if "*" in text[matrix.start : matrix.end]:
        return True
    behind: list[str] = []
    for row, (_, end) in zip(gaps, matrix.rows, strict=True):
        ends = [*(start for start, _ in row[1:]), end]
        behind += (text[gap[1] : stop].strip() for gap, stop in zip(row, ends, strict=True))
    return any(_BARE_NUMBER.match(entry) or _SIGN.match(entry) for entry in behind)


def _gaps(text: str, start: int, end: int, *, wide: bool) -> list[tuple[int, int]]:
    """Where blanks separate entries of a row; ``wide``: only several blanks do."""
    found: list[tuple[int, int]] = []
    depth, at = 0, start
    while at < end:
        c = text[at]
        depth += (c in "({") - (c in ")}")
        gap = _GAP.match(text, at, end) if depth == 0 else None
        if gap is None:
            at += 1
            continue
        at = gap.end()
        before, behind = text[start : gap.start()].rstrip(), text[at:end]
        if not before or not behind.strip() or (wide and len(gap.group()) == 1):
            continue
        word = _LAST_WORD.search(before[-20:])
        if before[-1] in _OPERATOR or (word is not None and function_of(word[1]) is not None):
            continue
        if behind[0] in _OPERATOR and not _SIGN.match(behind):
            continue
        found.append((gap.start(), at))
    return found
