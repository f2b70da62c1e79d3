"""The ways in which an answer is read where it can be read in several."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from functools import partial

from lagrangian.check.reading.answer import MarkedRow
from lagrangian.check.reading.marked_names import MarkedNames
from lagrangian.check.reading.marked_values import ValueMarks
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.plain.rows import AnswerRow
from lagrangian.check.reading.prose.marks import readings, told_without
from lagrangian.check.reading.prose.words import Words
from lagrangian.check.reading.said.dots_behind import DottedText
from lagrangian.errors import ParseError
from lagrangian.model import Model
from lagrangian.records import dataclass

_DIFFERENTIATES = re.compile(r"(?<!\w)D\[|(?<!\w)diff\(")
_MARKS = re.compile("(?<=[^\\W_])['’′\u0307\u0308](?!s\\b)|[ẋẍẏÿżṙṡ]")
"""Marks of rates."""
_RATES_WITH_D = re.compile(r"(?<![\w/])(?:d{1,2}[^\W\d]\w{0,12}[ \t]*=(?!=)|dd[^\W\d])|/[ \t]?d(?!t\b)[^\W\d]")
"""What only rates and differentials do: they are given a value, differentiated again, or divided by each other."""
MOST_AGAIN = 4
"""The largest number of readings of all rows that cannot be read."""


@dataclass(frozen=True)
class Choices:
    """How what can be read in two ways is read: denominators the other way, a minus in front as that of a list, letters
    after numbers as units, sums of angles without brackets as arguments, names that words call velocities or
    accelerations as the rates of coordinates, a letter d in front of what moves as a factor (``factored``) where a
    constant has this name, whether remarks beside the equations are left out (``bare``), whether
    ``comments`` with equations of motion are read, whether lines without an equals sign are ``wrapped``, so that they
    go on in the one "below" or the one "above", whether coordinates that are given in others are ``put`` into
    energies before these are differentiated, whether names with values of time alone are inputs (``driven``), whether
    dots of rates at the ends of lines are full stops (``stops``), and which rows, at the places in ``marks``, are
    without what may be no part of them, in the reading of this number."""

    flipped: bool = False
    listed: bool | None = None
    units: bool = False
    summed: bool = False
    rated: bool = False
    factored: bool | None = None
    bare: bool = False
    comments: bool = False
    wrapped: str = ""
    put: bool | None = None
    driven: bool = False
    stops: bool | None = None
    marks: tuple[tuple[int, int], ...] = ()
    values: ValueMarks | None = None
    """With which marks the values of names are read."""

    def names(self, model: Model) -> Names:
        """The names of an answer that is read so."""
        return Names(model) if self.values is None else MarkedNames(model, self.values)

    def puts(self, text: str) -> bool:
        """Whether coordinates that are given in others are put into energies: a program that differentiates does so."""
        return self.put if self.put is not None else _DIFFERENTIATES.search(text) is not None

    def factors(self, text: str) -> bool:
        """Whether a d in front of what moves is a factor: where marks, and no such letters, are the signs of rates."""
        if self.factored is not None:
            return self.factored
        return _MARKS.search(text) is not None and _RATES_WITH_D.search(text) is None

    def row(self, row: AnswerRow, words: Words) -> AnswerRow:
        """A row in the reading that is chosen for it, as a note tells."""
        chosen = next((k for start, k in self.marks if start == row.start), None)
        others = readings(row.text, words) if chosen is not None else []
        if chosen is None or chosen >= len(others):
            return row
        words.names.notes.setdefault(told_without(row.text, others[chosen]))
        return replace(row, text=others[chosen])

    def told(self) -> Iterator[str]:
        """What to say about a reading that is not the likeliest."""
        if self.flipped:
            yield "Denominators without brackets, as in a/b c, were read in the other way that is possible."
        if self.summed:
            yield "Arguments without brackets, as in cosθ1-θ2, were read as sums: cos(θ1-θ2)."
        if self.rated:
            yield "Names that words call velocities or accelerations were read as the rates of the coordinates."
        if self.factored is not None:
            of = "a factor" if self.factored else "that of rates"
            yield f"The d in front of names of what moves was read as {of}."
        if self.put:
            yield "What the answer says of coordinates was put into its energies before they were differentiated."
        if self.stops is not None:
            yield f"The dot at the end of a line was read as {'a full stop' if self.stops else 'that of a rate'}."
        if self.wrapped:
            yield f"Lines without an equals sign were read together with the line {self.wrapped} them."
        if self.listed is not None:
            of = "that of a list" if self.listed else "a minus"
            yield f"The sign at the beginning of a line was read as {of}."


LIKELIEST = Choices()
"""The reading that is tried first."""


def less_likely(
    words: Words, dots: DottedText, *, rated: bool, listed: bool | None, remarks: Collection[object], cut: bool
) -> Iterator[Choices]:
    """The other ways in which an answer may be read, as its ``words`` and its ``dots`` behind names leave them open."""
    if dots.open:
        yield Choices(stops=not dots.stops)
    if words.doubtful:
        yield Choices(units=True)
    if words.summed_asked:
        yield Choices(summed=True)
    if rated:
        yield Choices(rated=True)
    if words.asked:
        yield Choices(flipped=True)
    if listed is not None:
        yield Choices(listed=listed)
    if words.factored_asked:
        yield Choices(factored=not words.factored)
    if remarks:
        yield Choices(bare=True)
    if cut:
        yield from (Choices(wrapped=beside) for beside in ("below", "above"))


def marked_readings(rows: Sequence[MarkedRow], failed: Sequence[ParseError]) -> Iterator[Choices]:
    """The readings in which the rows that cannot be read are without what may be no part of them."""
    lines = {e.place.line for e in failed if e.place is not None}
    unread = [row for row in rows if row.line in lines]
    for k in range(min(MOST_AGAIN, max((row.count for row in unread), default=0))):
        yield Choices(marks=tuple((row.start, min(k, row.count - 1)) for row in unread))


def reads_flipped(reading: Callable[[], object]) -> bool:
    """Whether one of the other readings of an answer, which may be kept, is that of denominators the other way."""
    read = getattr(reading, "__wrapped__", reading)
    return isinstance(read, partial) and Choices(flipped=True) in [x for x in read.args if isinstance(x, Choices)]
