"""A Document: the content of a page in reading order, independent of the format."""

from __future__ import annotations

from typing import Literal, TypeAlias

from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief
from lagrangian.write.expression_tree import Math

Inline: TypeAlias = tuple[str | Math, ...]
"""Words and mathematics within a line."""


@dataclass(frozen=True)
class HeadingBlock:
    """A heading inside a section."""

    text: Inline


@dataclass(frozen=True)
class Paragraph:
    """A paragraph; its role is "", "what" (what a step did), "why" (the reason), "see" (where to read on) or "note"
    (small print). ``link`` is the anchor of the section to read, in formats with links.
    """

    text: Inline
    role: Literal["", "what", "why", "see", "note"] = ""
    link: str = ""


@dataclass(frozen=True)
class Display:
    """A formula on its own line: a chain of equal sides, a number for boxed results, and a note beside it."""

    sides: tuple[Math, ...]
    anchor: str
    number: int | None = None
    note: Inline = ()


@dataclass(frozen=True)
class Boxed:
    """Results in one box."""

    displays: tuple[Display, ...]


@dataclass(frozen=True)
class TableBlock:
    """A table with one header row."""

    header: tuple[Inline, ...]
    rows: tuple[tuple[Inline, ...], ...]


@dataclass(frozen=True)
class CheckLine:
    """A check: its description, whether it holds (None: not checked), and its figure."""

    what: Inline
    holds: bool | None
    figure: str

    @property
    def mark(self) -> str:
        """✓, ✗, or – for a check that was not made."""
        return {True: "✓", False: "✗", None: "–"}[self.holds]

    @property
    def standing(self) -> str:
        """The meaning of the mark, in a word."""
        return {True: "holds", False: "fails", None: "not checked"}[self.holds]


@dataclass(frozen=True)
class CheckLines:
    """A list of checks."""

    verdicts: tuple[CheckLine, ...]


@dataclass(frozen=True)
class Details:
    """Text that is too long to read at once, under a summary; ``vast`` if even a browser would take long to lay it
    out."""

    summary: Inline
    blocks: tuple[Block, ...]
    vast: bool = False


Block: TypeAlias = HeadingBlock | Paragraph | Display | Boxed | TableBlock | CheckLines | Details


@dataclass(frozen=True)
class Section:
    """A step of the derivation, or a section before or after the steps. ``number`` is the number of the step.

    A ``minor`` section is not in the table of contents: it belongs to the one before it.
    """

    anchor: str
    title: Inline
    blocks: tuple[Block, ...]
    number: int | None = None
    minor: bool = False


@dataclass(frozen=True)
class HeadPicture(Brief):
    """A picture at the head of a document: as SVG for HTML, as TikZ, and in words.

    ``size`` is its width and height [px]. ``trouble`` says why there is none, and the texts are empty then.
    """

    svg: str = field(repr=False)
    tikz: str = field(repr=False)
    description: str
    size: tuple[float, float] = (0.0, 0.0)
    trouble: str = ""


@dataclass(frozen=True)
class Document:
    """A title and sections; ``brief`` distinguishes the one-page checklist from the whole derivation.

    ``picture`` stands before the sections where the format has pictures. ``named``: many short definitions, several of
    which may share a line in print.
    """

    title: str
    sections: tuple[Section, ...]
    brief: bool = False
    picture: HeadPicture | None = None
    named: bool = False
