"""A text in which pieces were replaced by others of any length, and where each character was before."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import TypeAlias

from lagrangian.errors import Place
from lagrangian.quantities.source import Source
from lagrangian.records import dataclass

Edit: TypeAlias = tuple[int, int, str]
"""The start and the end of a piece, and what takes its place."""


@dataclass(frozen=True)
class TracedText:
    """A ``text``; ``origins`` are the places that its characters have in the text as written, None if all are the
    same."""

    text: str
    origins: tuple[int, ...] | None = None

    def sub(self, form: re.Pattern[str], make: Callable[[re.Match[str]], str]) -> TracedText:
        """Return the text with every match replaced by what ``make`` returns for it."""
        return self.edited((*m.span(), made) for m in form.finditer(self.text) if (made := make(m)) != m.group())

    def edited(self, edits: Iterable[Edit]) -> TracedText:
        """Return the text with pieces replaced, which must not overlap."""
        listed = sorted(edits)
        if not listed:
            return self
        before = self.origins or tuple(range(len(self.text) + 1))
        text: list[str] = []
        origins: list[int] = []
        at = 0
        for start, end, made in listed:
            text += [self.text[at:start], made]
            last = max(start, end - 1)
            origins += before[at:start]
            origins += before[start : min(start + len(made), last + 1)]
            origins += [before[last]] * (start + len(made) - last - 1)
            at = end
        text.append(self.text[at:])
        origins += before[at:]
        return TracedText("".join(text), tuple(origins))

    def rearranged(self, start: int, end: int, pieces: Iterable[tuple[str, int]]) -> TracedText:
        """Return the text with [start, end) replaced by pieces of it, each with the place where it was."""
        before = self.origins or tuple(range(len(self.text) + 1))
        made: list[str] = []
        origins: list[int] = []
        for piece, at in pieces:
            same = self.text.startswith(piece, at)
            made.append(piece)
            origins += before[at : at + len(piece)] if same else [before[at]] * len(piece)
        text = f"{self.text[:start]}{''.join(made)}{self.text[end:]}"
        return TracedText(text, (*before[:start], *origins, *before[end:]))

    def source(self, written: Source, text: str) -> Source:
        """Return ``text``, which has the same length as this one, with the places of what was ``written``."""
        origins = self.origins
        if origins is None:
            return Source(text, written.what, written.place)

        def locate(at: int) -> Place:
            return written.at(origins[at])

        return Source(text, written.what, written.place, locate)


def line_end(text: str, start: int) -> int:
    """Return where the line ends in which a place is."""
    end = text.find("\n", start)
    return len(text) if end < 0 else end


def apart(edits: Iterable[Edit]) -> list[Edit]:
    """Edits in their order, without those that overlap an earlier one."""
    kept: list[Edit] = []
    for edit in sorted(edits):
        if not kept or edit[0] >= kept[-1][1]:
            kept.append(edit)
    return kept
