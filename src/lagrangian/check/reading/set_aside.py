"""Parts of an answer that cannot be read and that its equations do without: they do not decide alone.

> sol := solve({eq1, eq2}, …):            a command above the solved equations
m1 = 2 kg, d = 4 Ns/m                     values below the result
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import sympy as sp

from lagrangian.check.reading.answer import AnswerLine
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reading.prose.remarks import CONSTANT, is_remark
from lagrangian.errors import ParseError, Place

MOST_TOLD = 5
"""The largest number of errors that are reported at once."""

MOST_LACKING = 12
"""With as many errors, the rest is not read, and the answer does not do without them."""

_SPELLED = re.compile(r"dot\s?dot|p_?p\b|\w\.\.(?!\.)")
"""Accelerations in letters and in dots behind names."""
_NOTED = re.compile(r"Line (?P<line>\d+) (?:has a part that was not read|(?P<why>could not be read))")
_MATRIX = re.compile(r"\\begin\{[a-zA-Z]{0,8}(?:matrix|array)|[\[(][^\n=\])]{0,200}[;&]")


def may_be_result(text: str) -> bool:
    """Whether a part that cannot be read may be an equation of motion: accelerations or a matrix stand in it."""
    found = not is_remark(text) or any(form.search(text) for form in (_SPELLED, _MATRIX))
    return "=" in text and found


def does_without(
    errors: Sequence[ParseError], results: Sequence[ParseError], lines: Sequence[AnswerLine], free: int
) -> bool:
    """Whether an answer may be right without the parts of ``errors``.

    There is an equation for each of ``free`` accelerations, and none of the ``results``, the parts that may be the
    result, is behind the last of these.
    """
    moving = [x.place for x in lines if x.kind in ("equation", "left") and accelerates(sp.sympify(x.residual))]
    if len(moving) < max(free, 1) or len(errors) >= MOST_LACKING or any(e.code == "E703" for e in errors):
        return False
    last = max(map(_at, moving))
    return all(_at(e.place) < last for e in results if any(e is x for x in errors))


def told(errors: Sequence[ParseError], remarks: Sequence[ParseError]) -> list[str]:
    """What to say about parts that were not read: of those that are no remarks, also why."""
    said = [f"Line {_line(e)} has a part that was not read: the equations do without it." for e in remarks[:MOST_TOLD]]
    why = (f"Line {_line(e)} could not be read ({e.what}): the equations do without it." for e in errors[:MOST_TOLD])
    return [*said, *why]


def once(notes: Sequence[str]) -> list[str]:
    """Notes on parts that were not read, one for each line: the one that says why, or the first."""
    about: dict[str, str] = {}
    for note in notes:
        if (match := _NOTED.match(note)) is not None and (match["line"] not in about or match["why"]):
            about[match["line"]] = note
    return [x for x in notes if (match := _NOTED.match(x)) is None or about[match["line"]] == x]


def _line(error: ParseError) -> int:
    return (error.place.line or 1) if error.place is not None else 1


def _at(place: Place | None) -> tuple[int, int]:
    return (0, 0) if place is None else (place.line or 0, place.column or 0)


def without_names_of_rates(lines: Sequence[AnswerLine], given: str) -> tuple[AnswerLine, ...]:
    """The lines without those that only say how a rate is called, xp = x Punkt, which say x' = x' when they are read,
    or of which the answer as it is ``given`` says in words what thdd is; all of them if there are no others."""

    def is_name(line: AnswerLine) -> bool:
        if not isinstance(line.lhs, sp.Derivative) or line.lhs != line.rhs:
            return False
        left, *rest = (side.strip() for side in line.text.split("="))
        return rest == [left] or (line.text not in given and all(x[:1] == left[:1] for x in rest))

    return tuple(x for x in lines if not is_name(x)) or tuple(lines)


def unused(name: str) -> str:
    """Why the definition of a name is not judged that nothing else uses."""
    return "it says that something is constant" if name.lower() in CONSTANT else f"nothing else uses {name}"
