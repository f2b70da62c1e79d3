"""Finds formulas that programs draw over several lines, and puts each on one line.

                2
       ⎛     2⎞ d
>>>  m⋅⎝L + 1 ⎠⋅───(x(t)) = F             m⋅(L + 1^2)⋅d^2/dt^2 (x(t)) = F
                  2
                dt

Long ones are cut into pieces, which arrows ↪ mark in newer versions of SymPy, and which have the same height.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagrangian.check.reading.layout import BARS, LayoutError, cells, in_line
from lagrangian.check.reading.traced_text import TracedText
from lagrangian.quantities.source import Source
from lagrangian.records import dataclass

MOST, MOST_PIECES, HIGHEST, WIDEST = 100, 40, 80, 4_000
"""The most drawings, pieces of one, lines of one, and columns."""

_DRAWN = re.compile("[─━⎛⎡⎧╲]")
_HYPHENS = re.compile(r"-{2,}")
_RAISED = re.compile(r"[ \t]*+\w{1,3}(?:[ \t]++\w{1,3}){0,40}+[ \t]*")
"""A line of powers alone."""
_STATES = re.compile(r"=|d\^2/dt\^2|['’′]{2}|[\u0308ẍÿẅ]")
_GOES_ON = re.compile(r"\s*(?:[+⋅·*/)=^,]|-\s)")
_OPEN_END = re.compile(r"[-+⋅·*/(=^,]\s*\Z")
_SAID = re.compile(r"[^\W\d_]{3,}[ \t]+[^\W\d_]{2,}[ \t]+[^\W\d_]{2,}|[^\W\d_]{2,}:[ \t]*\Z|\A[ \t]*\(%i\d{1,4}\)")
"""A line of words, or one that was typed."""
_BAR = re.compile("[─━]+")
_FRAME = re.compile("[\u2502\u2503\u250c-\u254b]")
_ARROW = "↪"
_ROUND = str.maketrans("⎛⎜⎝⎞⎟⎠", "⎡⎢⎣⎤⎥⎦")


@dataclass(frozen=True, slots=True)
class _Drawing:
    """Lines without a blank one between them, from ``start`` to ``end`` of a text."""

    start: int
    end: int
    lines: tuple[str, ...]


def without_drawn_formulas(written: TracedText, typed: Source) -> TracedText:
    """Return an answer in which such formulas are on one line each; ``typed`` is the answer as it was written.

    Raises `ParseError` for one with a fraction bar that cannot be put together: its lines would be another equation.
    """
    text = written.text
    if not (_DRAWN.search(text) or _HYPHENS.search(text) or any(map(_RAISED.fullmatch, text.split("\n")))):
        return written
    edits: list[tuple[int, int, str]] = []
    waiting = list(_drawings(text))[::-1]
    while waiting and len(edits) < MOST:
        drawing = waiting.pop()
        made, taken = _made(drawing, waiting[::-1])
        if made is not None:
            end = waiting[-taken].end if taken else drawing.end
            del waiting[len(waiting) - taken :]
            edits.append((drawing.start, end, f"{made}\n"))
        elif _is_fraction(drawing.lines):
            raise typed.error(
                "a formula that is drawn over several lines, whose parts do not fit together",
                written.origins[drawing.start] if written.origins else drawing.start,
                fix="write it on one line, (a)/(b); in SymPy, print() in place of pprint()",
            )
        elif _BAR.search(text, drawing.start, drawing.end) is None:
            round_ones = text[drawing.start : drawing.end].translate(_ROUND)
            edits.append((drawing.start, drawing.end, round_ones))
    return written.edited([e for e in edits if e[2] != text[e[0] : e[1]]])


def _drawings(text: str) -> Iterator[_Drawing]:
    """What may be a drawing: two or more lines without a blank one between them, or one of words."""
    start, lines, at = 0, list[str](), 0
    for line in [*text.split("\n"), ""]:
        if line.strip() and not _SAID.search(line):
            start = start if lines else at
            lines.append(line)
        elif lines:
            if 1 < len(lines) <= HIGHEST and max(map(len, lines)) <= WIDEST and not re.search(r"[\\$]", "".join(lines)):
                yield _Drawing(start, at - 1, tuple(lines))
            lines = []
        at += len(line) + 1


def _made(drawing: _Drawing, behind: Sequence[_Drawing]) -> tuple[str | None, int]:
    """A drawing on one line, and how many of those behind it are pieces of it."""
    pieces = [drawing]
    for following in behind[:MOST_PIECES]:
        arrows = all(x.rstrip().endswith(_ARROW) for x in pieces[-1].lines)
        if len(following.lines) != len(drawing.lines) or (not arrows and not _DRAWN.search("".join(drawing.lines))):
            break
        if not arrows:
            above, below = _one(_joined(pieces)), _one(following.lines)
            whole = above is not None and not _OPEN_END.search(above) and _balanced(above)
            if whole and below is not None and not _GOES_ON.match(below):
                break
        pieces.append(following)
    while pieces:
        made = _one(_joined(pieces))
        if made is not None and _balanced(made):
            return made, len(pieces) - 1
        pieces.pop()
    return None, 0


def _joined(pieces: Sequence[_Drawing]) -> list[str]:
    """The lines of pieces side by side, without the arrows between them."""
    rows = [""] * len(pieces[0].lines)
    for k, piece in enumerate(pieces):
        bare = [x.rstrip() for x in piece.lines]
        cut = all(x.endswith(_ARROW) for x in bare)
        lines = [x[:-2] if cut else x for x in bare] if cut else list(piece.lines)
        if k and all(x.startswith(_ARROW) for x in lines):
            lines = [x[2:] for x in lines]
        wide = max(len(cells(x)) for x in lines)
        rows = [row + x + " " * (wide - len(cells(x))) for row, x in zip(rows, lines, strict=True)]
    return rows


def _one(lines: Sequence[str]) -> str | None:
    """A drawing on one line; None if it is none, or says nothing."""
    text = "\n".join(lines)
    drawn, hyphens = _DRAWN.search(text) is not None, _HYPHENS.search(text) is not None
    raised = any(map(_RAISED.fullmatch, lines))
    if not (drawn or hyphens or raised) or (_is_plain_matrix(lines) and drawn):
        return None
    for ascii_bars in (False, True) if hyphens and not drawn else (False,):
        try:
            made = in_line(lines, ascii_bars=ascii_bars)
        except LayoutError:
            continue
        if _STATES.search(made) or (drawn and not _is_rule(lines)):
            return made
    return None


def _is_plain_matrix(lines: Sequence[str]) -> bool:
    """Whether brackets are drawn around rows that follow each other without a blank one, and nothing else."""
    text = "\n".join(lines)
    if "⎡" not in text or re.search("[─━⎛⎧╲]", text):
        return False
    return not any(re.search(r"⎢[ \t]*⎥", x) for x in lines)


def _is_rule(lines: Sequence[str]) -> bool:
    """Whether the only drawing is a bar that is alone on its line."""
    text = "".join(lines)
    return re.search("[⎛⎡⎧╲]", text) is None and all(not set(x) & BARS or not set(x) - BARS - {" "} for x in lines)


def _balanced(written: str) -> bool:
    return all(written.count(a) == written.count(b) for a, b in ("()", "[]", "{}"))


def _is_fraction(lines: Sequence[str]) -> bool:
    """Whether a bar stands beside other signs of mathematics and between something above and below."""
    if any(map(_FRAME.search, lines)):
        return False
    for above, line, below in zip(lines, lines[1:], lines[2:], strict=False):
        for bar in _BAR.finditer(line):
            rest = line[: bar.start()] + line[bar.end() :]
            beside = re.search(r"[=+⋅·*(-]", rest) is not None
            if beside and above[slice(*bar.span())].strip() and below[slice(*bar.span())].strip():
                return True
    return False
