"""Every deliberate error of the package.

    Error                          base of them all; carries what, where and fix
    ├── ModelError (ValueError)    the description of a system is wrong
    │   └── ParseError             a text cannot be read: file, line, column, caret
    ├── RunError (ValueError)      what was handed to a compiled system is wrong
    ├── NoSuchEntry (KeyError)     a result has nothing of that name; it is a ModelError and a RunError too
    └── MissingExtra (ImportError) an optional package is not installed

A message reads: what is wrong, where it stands, what would be right. A `Notice` stops nothing; results carry it.
"""

from __future__ import annotations

from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING

from lagrangian.codes import Code, CodeText

if TYPE_CHECKING:
    from collections.abc import Iterable


@dataclass(frozen=True, slots=True)
class Place:
    """Where in a file, or in a text that was typed, something stands.

    ``line`` and ``column`` count from 1; ``text`` is that line, for the caret. A missing number means "unknown".
    """

    file: str | None = None
    line: int | None = None
    column: int | None = None
    text: str | None = None

    def __str__(self) -> str:
        """Read as ``file:line:column``, as far as known; without a file as ``line 2, column 5`` (``column 5``)."""
        if self.file is None:
            said = [f"line {self.line}"] if self.line is not None and (self.line > 1 or self.column is None) else []
            return ", ".join(said + ([f"column {self.column}"] if self.column is not None else []))
        known = [self.line, self.column] if self.line is not None else []
        return ":".join([self.file, *(str(x) for x in known if x is not None)])

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
    in a file; ``fix`` says what would be right; ``code`` is a stable short identifier (``"E102"``), a `Code`.
    """

    def __init__(
        self,
        what: str,
        *,
        element: str | None = None,
        place: Place | None = None,
        fix: str | None = None,
        code: CodeText | Code | None = None,
    ) -> None:
        self.what, self.element, self.place, self.fix = what, element, place, fix
        self.code = Code(code) if code else None
        super().__init__(what)

    def __str__(self) -> str:
        """Return the whole message: file and place, code, element, what, the line with a caret, the fix.

        A text that was typed has no file; its place stands after the element, the argument that was typed.
        """
        place = str(self.place) if self.place is not None else ""
        typed = self.place is not None and self.place.file is None
        head = f"{place}: " if place and not typed else ""
        if self.code:
            head += f"[{self.code}] "
        if subject := ", ".join(x for x in (self.element, place if typed else "") if x):
            head += f"{subject}: "
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

    code: Code
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


class NoSuchEntry(ModelError, RunError, KeyError):
    """A result was asked for a name that it does not have."""

    @classmethod
    def among(cls, what: str, name: str, known: Iterable[str]) -> NoSuchEntry:
        """Return the error that says ``what`` of ``name``, with the nearest of the names that are known, or all."""
        listed = list(known)
        fix = did_you_mean(name, listed) or f"known: {', '.join(listed) or 'none'}"
        return cls(f"{what} '{name[:64]}'", fix=fix if len(fix) < 500 else fix[:500] + " …", code="E402")


class MissingExtra(Error, ImportError):
    """An optional package is needed and not installed; the message holds the line that installs it."""


def did_you_mean(name: str, known: Iterable[str]) -> str | None:
    """Return ``"Did you mean 'length'?"`` for a near miss among ``known``, else None."""
    close = get_close_matches(name, list(known), n=1, cutoff=0.6)
    return f"Did you mean '{close[0]}'?" if close else None
