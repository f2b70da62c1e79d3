"""Every deliberate error of the package.

    Error                          base of them all; has what, where and fix
    ├── ModelError (ValueError)    the description of a system is wrong
    │   └── ParseError             a text cannot be read: file, line, column, caret
    ├── RunError (ValueError)      a value passed to a compiled system is wrong
    ├── NoSuchEntry (KeyError)     a result has no entry of that name; also a ModelError and a RunError
    └── MissingExtra (ImportError) an optional package is not installed

A message says what is wrong, where, and how to fix it. A `Notice` is not an error; results list their notices.
"""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING

from lagrangian.codes import Code, CodeText
from lagrangian.records import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


@dataclass(frozen=True, slots=True)
class Place:
    """A place in a file, or in a text that was typed.

    ``line`` and ``column`` count from 1; ``text`` is that line, for the caret. A missing number means "unknown".
    """

    file: str | None = None
    line: int | None = None
    column: int | None = None
    text: str | None = None

    def __str__(self) -> str:
        """Return ``file:line:column``, as far as known; without a file ``line 2, column 5`` or ``column 5``."""
        if self.file is None:
            said = [f"line {self.line}"] if self.line is not None and (self.line > 1 or self.column is None) else []
            return ", ".join(said + ([f"column {self.column}"] if self.column is not None else []))
        known = [self.line, self.column] if self.line is not None else []
        return ":".join([self.file, *(str(x) for x in known if x is not None)])

    def excerpt(self) -> str:
        """Return the line with a caret under the column, or an empty text if the line is unknown or blank."""
        if self.text is None or not self.text.strip():
            return ""
        text, column = self.text, self.column
        if len(text) > 100:  # of a very long line, show only what surrounds the column
            start = max(0, (column or 1) - 50)
            text = ("…" if start else "") + text[start : start + 100] + "…"
            column = None if column is None else column - start + (1 if start else 0)
        number = "" if self.line is None else str(self.line)
        lines = [f"{number} | {text}"]
        if column is not None:
            lines.append(" " * len(number) + " | " + " " * (column - 1) + "^")
        return "\n".join(lines)


class Error(Exception):
    """The base class of all errors of this package: what is wrong, where, and how to fix it.

    ``what`` is one sentence; ``element`` names the part of the model (``"spring 'k1'"``); ``place`` is the position in
    a file; ``fix`` says how to put it right; ``code`` is a short stable identifier (``"E102"``), a `Code`.
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

        Typed text has no file; then the place follows the element, which is the argument that was typed.
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
        """Return this error with ``place`` filled in if it was unknown."""
        if self.place is None:
            self.place = place
        return self


@dataclass(frozen=True, slots=True)
class Notice:
    """Something that you should know but that is not an error: ``text`` is one sentence about ``where``, with a stable
    ``code``.

    ``where`` names the part of the model, with file and line if these are known.
    """

    code: Code
    where: str
    text: str

    def __str__(self) -> str:
        """Return a line such as ``[E105] rigid body 'link 3': its inertia fits no body …``."""
        return f"[{self.code}] {self.where}: {self.text}"


class ModelError(Error, ValueError):
    """The description of a mechanical system is wrong."""


class ParseError(ModelError):
    """A text (an expression, a model file, an answer) cannot be read.

    ``others`` are the errors in other places of the same text; the message contains them, too.
    """

    others: tuple[ParseError, ...] = ()

    def with_others(self, others: Iterable[ParseError]) -> ParseError:
        """Return this error with those in other places of the same text."""
        self.others = tuple(others)
        return self

    def __str__(self) -> str:
        """Return the whole message, and those of the others."""
        return "\n".join([super().__str__(), *(str(error) for error in self.others)])


class RunError(Error, ValueError):
    """A value passed to a compiled system is wrong: a shape, a name, a number that is not finite."""


class NoSuchEntry(ModelError, RunError, KeyError):
    """A result does not have an entry of that name."""

    @classmethod
    def among(cls, what: str, name: str, known: Iterable[str]) -> NoSuchEntry:
        """Return the error "``what`` ``name``", with the nearest of the known names, or with all of them."""
        listed = list(known)
        fix = did_you_mean(name, listed) or f"known: {', '.join(listed) or 'none'}"
        return cls(f"{what} '{name[:64]}'", fix=fix if len(fix) < 500 else fix[:500] + " …", code="E402")


class MissingExtra(Error, ImportError):
    """An optional package is needed but not installed; the message contains the command that installs it."""


def listed(names: Sequence[str]) -> str:
    """The names in a sentence: ``a``, ``a and b``, ``a, b and c``."""
    return " and ".join(x for x in (", ".join(names[:-1]), *names[-1:]) if x)


def did_you_mean(name: str, known: Iterable[str]) -> str | None:
    """Return ``"Did you mean 'length'?"`` if one of the ``known`` names is similar, otherwise None."""
    close = get_close_matches(name, list(known), n=1, cutoff=0.6)
    return f"Did you mean '{close[0]}'?" if close else None
