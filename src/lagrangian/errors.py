"""Every deliberate error of the package.

    Error                          base of them all; carries what, where and fix
    ├── ModelError (ValueError)    the description of a system is wrong
    │   └── ParseError             a text cannot be read: file, line, column, caret
    ├── RunError (ValueError)      what was handed to a compiled system is wrong
    └── MissingExtra (ImportError) an optional package is not installed

A message reads: what is wrong, where it stands, what would be right. A `Notice` stops nothing; results carry it.
"""

from __future__ import annotations

from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable


@dataclass(frozen=True, slots=True)
class Place:
    """Where in a file something stands.

    ``line`` and ``column`` count from 1; ``text`` is that line, for the caret. A missing number means "unknown".
    """

    file: str | None = None
    line: int | None = None
    column: int | None = None
    text: str | None = None

    def __str__(self) -> str:
        """Read as ``file:line:column``, as far as known."""
        parts = [self.file or "<text>"]
        if self.line is not None:
            parts.append(str(self.line))
            if self.column is not None:
                parts.append(str(self.column))
        return ":".join(parts)

    def excerpt(self) -> str:
        """Return the line with a caret under the column, or an empty text when the line is unknown."""
        if self.text is None:
            return ""
        text, column = self.text, self.column
        if len(text) > 100:  # keep the neighbourhood of the column of a very long line
            start = max(0, (column or 1) - 50)
            text = ("…" if start else "") + text[start : start + 100] + "…"
            column = None if column is None else column - start + (1 if start else 0)
        number = "" if self.line is None else str(self.line)
        lines = [f"{number} | {text}"]
        if column is not None:
            lines.append(" " * len(number) + " | " + " " * (column - 1) + "^")
        return "\n".join(lines)


class Error(Exception):
    """Base of every deliberate error: what is wrong, where, and what would be right.

    ``what`` is one sentence; ``element`` names the piece of the model (``"spring 'k1'"``); ``place`` is the position
    in a file; ``fix`` says what would be right; ``code`` is a stable short identifier (``"E102"``).
    """

    def __init__(
        self,
        what: str,
        *,
        element: str | None = None,
        place: Place | None = None,
        fix: str | None = None,
        code: str | None = None,
    ) -> None:
        self.what, self.element, self.place, self.fix, self.code = what, element, place, fix, code
        super().__init__(what)

    def __str__(self) -> str:
        """Return the whole message: place, code, element, what, the line with a caret, the fix."""
        head = ""
        if self.place is not None and (self.place.file or self.place.line):
            head += f"{self.place}: "
        if self.code:
            head += f"[{self.code}] "
        if self.element:
            head += f"{self.element}: "
        lines = [head + self.what]
        if self.place is not None and (excerpt := self.place.excerpt()):
            lines.append(excerpt)
        if self.fix:
            lines.append(f"Fix: {self.fix}")
        return "\n".join(lines)

    def at(self, place: Place | None) -> Error:
        """Return this error with ``place`` filled in where it was still unknown."""
        if self.place is None:
            self.place = place
        return self


@dataclass(frozen=True, slots=True)
class Notice:
    """Something to know that need not stop the work: ``text`` in one sentence, about ``where``, with a stable ``code``.

    ``where`` names the piece of the model, with file and line where these are known.
    """

    code: str
    where: str
    text: str

    def __str__(self) -> str:
        """Read as ``[E105] rigid body 'link 3': its inertia fits no body …``."""
        return f"[{self.code}] {self.where}: {self.text}"


class ModelError(Error, ValueError):
    """The description of a mechanical system is wrong."""


class ParseError(ModelError):
    """A text (an expression, a model file, an answer) cannot be read."""


class RunError(Error, ValueError):
    """What was handed to a compiled system is wrong: a shape, a name, a value that is not finite."""


class MissingExtra(Error, ImportError):
    """An optional package is needed and not installed; the message holds the line that installs it."""


def did_you_mean(name: str, known: Iterable[str]) -> str | None:
    """Return ``"Did you mean 'length'?"`` for a near miss among ``known``, else None."""
    close = get_close_matches(name, list(known), n=1, cutoff=0.6)
    return f"Did you mean '{close[0]}'?" if close else None
