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
import unicodedata
from collections.abc import Iterator, Sequence

from lagrangian.check.reading.drawn.layout import BARS, LayoutError, cells, in_line
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.quantities.source import Source
from lagrangian.records import dataclass

MOST_PIECES, HIGHEST, WIDEST, WINDOW = 40, 80, 4_000, 60
"""The most pieces of a drawing, lines and columns of one, and the columns of the narrowest window that cuts one."""
LARGEST, TOTAL = 60_000, 1_000_000
"""The most places of a drawing, and of all that are tried in one answer."""

OVERHANG = 3
"""By how many places a numerator may begin in front of its bar."""

_DRAWN = re.compile("[─━⎛⎡⎧╲]")
_TALL = re.compile("[⎛⎡⎧╲↪]")
_HYPHENS = re.compile(r"-{2,}")
_RAISED = re.compile(r"[ \t]*+\w{1,3}(?:[ \t]++\w{1,3}){0,40}+[ \t]*")
"""A line of powers alone."""
_STATES = re.compile(r"=|d\^2/dt\^2|['’′]{2}|[\u0308ẍÿẅ]")
_GOES_ON = re.compile(r"\s*(?:[+⋅·*/)=^,]|-\s)")
_OPEN_END = re.compile(r"[-+⋅·*/(=^,]\s*\Z")
_SAID = re.compile(
    r"(?<![^\W\d_])[^\W\d_]{3,}+[ \t]++[^\W\d_]{2,}+[ \t]++[^\W\d_]{2}|[^\W\d_]{2}:[ \t]*+\Z"
    r"|\A(?=[^=\n]{0,80}[^\W\d_]{3})[^=\n]{3,80}:[ \t]*+\Z"
    r"|\A[ \t]*(?:[(\[]%i\d{1,4}[)\]]|>{1,3}[ \t])|\A[^\W\d]\w{0,20};?[ \t]*\Z"
    r"|\A[ \t]*-{3,}[ \t](?:[^\W\d_]{2,20}[ \t:]{1,2}){1,4}-{3,}[ \t]*\Z"
)
"""A line of words, perhaps between strokes, or one that was typed, perhaps a name alone."""
_BAR = re.compile("[─━]+")
_SIDE_WITH_BAR = re.compile(r"[ \t]*(?P<side>[^=\n─━]{1,40}?)[ \t]*=[ \t]*(?P<bar>-{4,}|[─━]{4,})[ \t]*")
"""An equation of which all that stands on the right is a bar."""
_BARS_IN_SIDE = re.compile(r"(?<![-─━])(?:-{3,400}+|[─━]{2,400}+)(?![-─━])")
_SIGN = re.compile(r"^[ \t]*+-[ \t]", re.MULTILINE)
"""A program's minus in front of an equation, which is no bullet."""
_RIGHT_SIDE = re.compile(r"[ \t]{0,3}=[^=]")
"""What a program prints below a drawn side: = 0."""
_MISPLACED = re.compile(r"[-+−–·⋅*/=(][ ]{0,9}\^|\^\(\)")
"""A power of nothing: what stands higher belongs to something else."""
_FRAME = re.compile("[\u2502\u2503\u250c-\u254b]")
_ARROW = "↪"
_ON_ONE_LINE = "write it on one line, (a)/(b); in SymPy, print() in place of pprint()"
_ROUND = str.maketrans("⎛⎜⎝⎞⎟⎠", "⎡⎢⎣⎤⎥⎦")


@dataclass(frozen=True, slots=True)
class _Drawing:
    """Lines without a blank one between them, from ``start`` to ``end`` of a text."""

    start: int
    end: int
    lines: tuple[str, ...]


class _SpaceError(Exception):
    """Drawings are larger than what is looked at."""


@dataclass
class _Space:
    """How many places of drawings may still be looked at."""

    left: int = TOTAL

    def take(self, lines: Sequence[str]) -> None:
        """Count the places of a drawing; raise if they are too many."""
        size = len(lines) * max(map(len, lines), default=0)
        if size > min(LARGEST, self.left):
            raise _SpaceError
        self.left -= size


def without_drawn_formulas(written: TracedText, typed: Source) -> TracedText:
    """Return an answer in which such formulas are on one line each; ``typed`` is the answer as it was written.

    Raises `ParseError` for one with a fraction bar that cannot be put together: its lines would be another equation.
    """
    text = written.text
    if not (_DRAWN.search(text) or _HYPHENS.search(text) or any(map(_RAISED.fullmatch, text.split("\n")))):
        return written
    edits: list[Edit] = []
    space = _Space()
    drawings = list(_drawings(text))
    at = 0
    while at < len(drawings):
        drawing = drawings[at]
        place = written.origins[drawing.start] if written.origins else drawing.start
        try:
            made, count = _made(drawings, at, space)
        except _SpaceError:
            what = "formulas that are drawn over several lines take too much space"
            raise typed.error(what, place, fix=_ON_ONE_LINE, code="E703") from None
        if made is not None:
            made = _SIGN.sub("-", made) if _BAR.search(text, drawing.start, drawing.end) else made
            edits.append((drawing.start, drawings[at + count - 1].end, f"{made}\n"))
        elif count > 1 or _is_fraction(drawing.lines) or _is_piece(drawing.lines):
            what = "a formula that is drawn over several lines, whose parts do not fit together"
            raise typed.error(what, place, fix=_ON_ONE_LINE)
        elif _BAR.search(text, drawing.start, drawing.end) is None:
            edits.append((drawing.start, drawing.end, text[drawing.start : drawing.end].translate(_ROUND)))
        at += count
    return written.edited(e for e in edits if e[2] != text[e[0] : e[1]])


def _drawings(text: str) -> Iterator[_Drawing]:
    """What may be a drawing: two or more lines without a blank one between them, or one of words."""
    start, lines, at = 0, list[str](), 0
    for line in [*text.split("\n"), ""]:
        if lines and lines[-1].startswith(_ARROW) and not line.startswith(_ARROW):  # the last piece ends
            yield from _drawing(start, at - 1, lines)
            lines = []
        if line.strip(" \t;") and not _SAID.search(line):
            start = start if lines else at
            lines.append(line)
        elif lines:
            yield from _drawing(start, at - 1, lines)
            lines = []
        at += len(line) + 1


def _drawing(start: int, end: int, lines: Sequence[str]) -> Iterator[_Drawing]:
    if 1 < len(lines) <= HIGHEST and max(map(len, lines)) <= WIDEST and not re.search(r"[\\$]", "".join(lines)):
        yield _Drawing(start, end, tuple(lines))


def _made(drawings: Sequence[_Drawing], at: int, space: _Space) -> tuple[str | None, int]:
    """The drawing at a place on one line, and how many drawings are its pieces.

    What goes on in a drawing of the same height is never read without it: then there is no line.
    """
    pieces = [drawings[at]]
    rows = _joined(pieces)
    made = _one(rows, space)
    for following in drawings[at + 1 : at + MOST_PIECES]:
        arrows = all(x.rstrip().endswith(_ARROW) for x in pieces[-1].lines)
        if len(following.lines) != len(rows) or not (arrows or _DRAWN.search("".join(rows))):
            break
        if not arrows and all(x.rstrip().endswith(_ARROW) for x in following.lines):  # arrows would be here, too
            break
        if not arrows and (_is_plain_matrix(rows) or not _is_drawn(following.lines)):
            break
        if not arrows and not _goes_on(made, _one(following.lines, space), rows):
            break
        pieces.append(following)
        space.take(rows)
        rows = _joined(pieces)
        made = None if all(x.rstrip().endswith(_ARROW) for x in following.lines) else _one(rows, space)
    made = made if made is not None and _balanced(made) else None
    return _stacked(rows, space) if made is None and len(pieces) == 1 else made, len(pieces)


def _stacked(lines: Sequence[str], space: _Space) -> str | None:
    """Several drawings, as pprint puts them below each other, each on one line; None if they are none or unclear."""
    found: dict[int, list[list[str]]] = {len(lines): [[]]}
    for start in range(len(lines) - 2, -1, -1):
        ways: list[list[str]] = []
        for end in (k for k in range(start + 2, len(lines) + 1) if found.get(k)):
            made = _one(lines[start:end], space)
            if made is not None and _balanced(made) and _STATES.search(made):
                ways += [[made, *rest] for rest in found[end]]
        found[start] = ways[:2]
    whole = [way for way in found[0] if len(way) > 1] if len(lines) > 3 else []
    return "\n".join(whole[0]) if len(whole) == 1 else None


def _goes_on(above: str | None, below: str | None, rows: Sequence[str]) -> bool:
    """Whether a drawing without arrows, which is ``above`` on one line, goes on in the one below it."""
    if above is None or _OPEN_END.search(above) or not _balanced(above):
        return above is not None or _is_wide(rows)
    if below is None or ("=" in above and "=" in below):  # two equations
        return below is None and _is_wide(rows)
    return _GOES_ON.match(below) is not None or (_is_wide(rows) and "=" in below and "=" not in above)


def _is_drawn(lines: Sequence[str]) -> bool:
    """Whether lines have pieces of a drawing, or powers on a line of their own."""
    return _DRAWN.search("".join(lines)) is not None or any(map(_RAISED.fullmatch, lines))


def _is_wide(rows: Sequence[str]) -> bool:
    """Whether a drawing may be cut at the edge of a window."""
    return max(len(x.rstrip()) for x in rows) >= WINDOW


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


def _one(lines: Sequence[str], space: _Space) -> str | None:
    """A drawing on one line; None if it is none, or says nothing. A right side printed below belongs to it."""
    if len(lines) > 2 and _RIGHT_SIDE.match(lines[-1]) and not any("=" in x for x in lines[:-1]):
        made = _one(lines[:-1], space)
        return f"{made} {lines[-1].strip()}" if made is not None else None
    if (fraction := _plain_fraction(lines)) is not None:
        return fraction
    text = "\n".join(lines)
    drawn, hyphens = _DRAWN.search(text) is not None, _HYPHENS.search(text) is not None
    raised, tall = any(map(_RAISED.fullmatch, lines)), _TALL.search(text) is not None
    if not (drawn or hyphens or raised) or (_is_plain_matrix(lines) and drawn):
        return None
    counted = (False, True) if any(map(unicodedata.combining, text)) else (False,)
    for ascii_bars in (False, True) if hyphens and not drawn else (False,):
        for marks in counted:
            if len(lines) * max(map(len, lines)) > LARGEST and not (tall or _is_fraction(lines)):
                return None
            space.take(lines)
            try:
                made = in_line(lines, ascii_bars=ascii_bars, counted=marks)
            except LayoutError:
                continue
            if _MISPLACED.search(made) or not _balanced(made):
                continue
            if _STATES.search(made) or (drawn and not _is_rule(lines)):
                return made
    return _fraction_in_side(lines)


def _plain_fraction(lines: Sequence[str]) -> str | None:
    """Three lines, x'' = with a bar between what stands indented above and below it, that need not be as wide as it."""
    if len(lines) != 3 or (bar := _SIDE_WITH_BAR.fullmatch(lines[1])) is None:
        return None
    over, under = lines[0], lines[2]
    if any(not x.startswith("  ") or "=" in x or not x.strip() or not _balanced(x) for x in (over, under)):
        return None
    left, right = bar.start("bar") - OVERHANG, bar.end("bar")
    if any(not left <= len(x) - len(x.lstrip()) < right or len(x.rstrip()) <= bar.start("bar") for x in (over, under)):
        return None
    return f"{bar['side']} = ({over.strip()})/({under.strip()})"


def _fraction_in_side(lines: Sequence[str]) -> str | None:
    """Three lines, x'' = a + with one bar between what stands above and below it alone, that need not be as wide."""
    bars = list(_BARS_IN_SIDE.finditer(lines[1])) if len(lines) == 3 else []
    if len(bars) != 1 or lines[1].count("=") != 1:
        return None
    (bar,) = bars
    over, under = lines[0], lines[2]
    moved = sum(unicodedata.combining(c) != 0 for c in lines[1][: bar.start()])
    for x in (over, under):
        first, last = len(x) - len(x.lstrip()), len(x.rstrip())
        beside = not bar.start() - OVERHANG - moved <= first < bar.end() or not bar.start() - moved < last
        if "=" in x or not x.strip() or not _balanced(x) or beside or last > bar.end() + OVERHANG + moved:
            return None
    return f"{lines[1][: bar.start()]}(({over.strip()})/({under.strip()})){lines[1][bar.end() :]}"


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


def _is_piece(lines: Sequence[str]) -> bool:
    """Whether tall round brackets or roots stand in a drawing without an equals sign, which may belong to another."""
    text = "".join(lines)
    return "=" not in text and re.search("[⎛⎝╲]", text) is not None and re.search(r"[+⋅·*-]", text) is not None


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
