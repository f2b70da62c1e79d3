"""The ways in which an answer is read where it can be read in several."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.reading.words import Words
from lagrangian.records import dataclass


@dataclass(frozen=True)
class Choices:
    """How what can be read in two ways is read: denominators the other way, a minus in front as that of a list, letters
    after numbers as units, sums of angles without brackets as arguments, names that words call velocities or
    accelerations as the rates of coordinates, and whether remarks beside the equations are left out (``bare``)."""

    flipped: bool = False
    listed: bool | None = None
    units: bool = False
    summed: bool = False
    rated: bool = False
    bare: bool = False

    def told(self) -> Iterator[str]:
        """What to say about a reading that is not the likeliest."""
        if self.flipped:
            yield "Denominators without brackets, as in a/b c, were read in the other way that is possible."
        if self.summed:
            yield "Arguments without brackets, as in cosθ1-θ2, were read as sums: cos(θ1-θ2)."
        if self.rated:
            yield "Names that words call velocities or accelerations were read as the rates of the coordinates."
        if self.listed is not None:
            of = "that of a list" if self.listed else "a minus"
            yield f"The sign at the beginning of a line was read as {of}."


LIKELIEST = Choices()
"""The reading that is tried first."""


def less_likely(words: Words, *, rated: bool, listed: bool | None, remarks: bool) -> Iterator[Choices]:
    """The other ways in which an answer may be read, as its ``words`` leave them open."""
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
    if remarks:
        yield Choices(bare=True)
