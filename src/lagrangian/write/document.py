"""A Document: what a derivation says, in reading order, before it has a format."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from lagrangian.write.expression_tree import Math

Inline: TypeAlias = tuple[str | Math, ...]
"""Words and mathematics in a line."""


@dataclass(frozen=True)
class HeadingBlock:
    """A heading inside a section."""

    text: Inline


@dataclass(frozen=True)
class Paragraph:
    """A paragraph; its role is "", "what" (what a step did), "why" (the reason) or "note" (small print)."""

    text: Inline
    role: Literal["", "what", "why", "note"] = ""


@dataclass(frozen=True)
class Display:
    """A formula on a line of its own: a chain of equal sides, a number for boxed results, a note beside it."""

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
    """Something that was verified: in words, whether it holds (None: not checked), and the figure."""

    what: Inline
    holds: bool | None
    figure: str

    @property
    def mark(self) -> str:
        """✓, ✗, or – for what was not checked."""
        return {True: "✓", False: "✗", None: "–"}[self.holds]

    @property
    def standing(self) -> str:
        """The mark in a word."""
        return {True: "holds", False: "fails", None: "not checked"}[self.holds]


@dataclass(frozen=True)
class CheckLines:
    """What was verified, in a list."""

    verdicts: tuple[CheckLine, ...]


@dataclass(frozen=True)
class Details:
    """What is too long to read at once, under a summary; ``vast`` where even a browser would take long to set it."""

    summary: Inline
    blocks: tuple[Block, ...]
    vast: bool = False


Block: TypeAlias = HeadingBlock | Paragraph | Display | Boxed | TableBlock | CheckLines | Details


@dataclass(frozen=True)
class Section:
    """A step of the derivation, or what stands before and after the steps. ``number`` is the step's."""

    anchor: str
    title: Inline
    blocks: tuple[Block, ...]
    number: int | None = None


@dataclass(frozen=True)
class Document:
    """A title and sections; ``brief`` tells the one-page checklist from the whole derivation."""

    title: str
    sections: tuple[Section, ...]
    brief: bool = False
