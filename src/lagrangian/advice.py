"""Advice that names arguments, which is written ``step=0.01`` in Python and ``--step 0.01`` on the command line.

Advice is text in the form for Python; the arguments in it are stored as data, so that it can be rewritten.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from lagrangian.records import dataclass


@dataclass(frozen=True, slots=True)
class Argument:
    """An argument of a method: its name, an example of a value, and for a mapping the key: ``params={'k': 80}``."""

    name: str
    value: str | None = None
    key: str | None = None

    def __str__(self) -> str:
        """Return the argument as it is written in Python."""
        if self.value is None:
            return self.name
        return f"{self.name}={self.value}" if self.key is None else f"{self.name}={{'{self.key}': {self.value}}}"


@dataclass(frozen=True, slots=True)
class Verb:
    """A method of a system."""

    name: str

    def __str__(self) -> str:
        """Return the verb as it is written in Python."""
        return f"system.{self.name}()"


class Advice(str):
    """Text that contains arguments and verbs.

    >>> Advice("give ", Argument("step", "0.01"))
    'give step=0.01'
    """

    __slots__ = ("pieces",)
    pieces: tuple[str | Argument | Verb, ...]

    def __new__(cls, *pieces: str | Argument | Verb) -> Advice:
        """Join the pieces; pieces that are advice themselves are split into theirs."""
        made = super().__new__(cls, "".join(map(str, pieces)))
        made.pieces = tuple(_flat(pieces))
        return made

    def __getnewargs__(self) -> tuple[str | Argument | Verb, ...]:  # type: ignore[override]
        return self.pieces

    def spelled(self, spell: Callable[[Argument | Verb], str]) -> str:
        """Return the text with arguments and verbs written by another function."""
        return "".join(x if isinstance(x, str) else spell(x) for x in self.pieces)


def _flat(pieces: tuple[str | Argument | Verb, ...]) -> Iterator[str | Argument | Verb]:
    for piece in pieces:
        if isinstance(piece, Advice):
            yield from piece.pieces
        else:
            yield piece
