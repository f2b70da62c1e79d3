"""A piece of text with its place, so that every error can point at the wrong character."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable

from lagrangian.codes import CodeText
from lagrangian.errors import ParseError, Place
from lagrangian.records import dataclass


def shown(text: str, limit: int = 40) -> str:
    """Return the text in single quotes, cut after ``limit`` characters, with control characters escaped."""
    cut = text if len(text) <= limit else text[: limit - 1] + "…"
    return "'" + "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in cut) + "'"


def character(c: str) -> str:
    """Return a character for a message: itself if it can be printed, with its code point if it is not ASCII."""
    if c.isascii():
        return f"'{c}'" if c.isprintable() else f"the control character U+{ord(c):04X}"
    shown_as = f"'{c}' " if c.isprintable() else "a character that does not print "
    return f"{shown_as}(U+{ord(c):04X} {unicodedata.name(c, 'unnamed')})"


@dataclass(frozen=True)
class Source:
    """A ``text`` from a user. ``what`` describes it (``"k of spring 's1'"``); ``place`` is where it begins.

    ``example`` is what a right one looks like. ``locate`` returns the place of each character of a text inside a file,
    in which it may continue over lines and contain escapes. Without it, the text is in the file as it is.
    """

    text: str
    what: str
    place: Place | None = None
    locate: Callable[[int], Place] | None = None
    example: str = "40 N/m"

    def at(self, offset: int) -> Place:
        """Return the place of the character at ``offset``."""
        offset = max(0, min(offset, len(self.text)))
        if self.locate is not None:
            return self.locate(offset)
        start = self.place or Place()
        if start.line is not None and start.column is None:
            return start
        before = self.text[:offset]
        row = before.count("\n")
        first = self.text.rfind("\n", 0, offset) + 1
        last = self.text.find("\n", offset)
        line = self.text[first : last if last >= 0 else len(self.text)]
        if row == 0 and start.line is not None and start.column is not None:
            return Place(start.file, start.line, start.column + offset, printable(start.text))
        return Place(start.file, (start.line or 1) + row, offset - first + 1, printable(line))

    def error(self, message: str, offset: int, *, fix: str | None = None, code: CodeText = "E701") -> ParseError:
        """Return a `ParseError` whose place is that of ``offset``."""
        return ParseError(message, element=self.what or None, place=self.at(offset), fix=fix, code=code)

    def check_text(self, limit: int, example: str, *, shorter: str | None = None) -> None:
        """Raise an error if the text is not a string, is empty, or has more than ``limit`` characters.

        ``shorter`` says how it becomes shorter.
        """
        if not isinstance(self.text, str):
            kind = type(self.text).__name__
            raise ParseError(f"this must be text (got {kind})", element=self.what, place=self.place, code="E406")
        if len(self.text) > limit:
            raise ParseError(
                f"the text has {len(self.text)} characters; at most {limit} are read",
                element=self.what,
                place=self.place,
                fix=shorter or f"write it briefly, such as {example}",
                code="E703",
            )
        if not self.text.strip():
            raise self.error("the text is empty", 0, fix=f"write {example}", code="E406")


def printable(line: str | None) -> str | None:
    """Return a line with one printable character for each of its characters, so that the caret is under the right
    one."""
    if line is None or line.isprintable():
        return line
    return "".join(c if c.isprintable() else " " for c in line)
