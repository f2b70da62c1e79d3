"""Advice that names arguments, which everyone writes in his own way: ``step=0.01`` in Python, else ``--step 0.01``.

Advice is text, the Python way of writing it; the arguments in it are kept beside it as data.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Argument:
    """An argument of a method: its name, a value as an example, and the key of a mapping: ``params={'k': 80}``."""

    name: str
    value: str | None = None
    key: str | None = None

    def __str__(self) -> str:
        """Read as it is written in Python."""
        if self.value is None:
            return self.name
        return f"{self.name}={self.value}" if self.key is None else f"{self.name}={{'{self.key}': {self.value}}}"


@dataclass(frozen=True, slots=True)
class Verb:
    """A method of a system."""

    name: str

    def __str__(self) -> str:
        """Read as it is written in Python."""
        return f"system.{self.name}()"


class Advice(str):
    """Words with arguments and verbs among them.

    >>> Advice("give ", Argument("step", "0.01"))
    'give step=0.01'
    """

    __slots__ = ("pieces",)
    pieces: tuple[str | Argument | Verb, ...]

    def __new__(cls, *pieces: str | Argument | Verb) -> Advice:
        """Join the pieces; advice among them is taken apart."""
        made = super().__new__(cls, "".join(map(str, pieces)))
        made.pieces = tuple(_flat(pieces))
        return made

    def __getnewargs__(self) -> tuple[str | Argument | Verb, ...]:  # type: ignore[override]
        return self.pieces

    def spelled(self, spell: Callable[[Argument | Verb], str]) -> str:
        """The words with the arguments and verbs written another way."""
        return "".join(x if isinstance(x, str) else spell(x) for x in self.pieces)


def _flat(pieces: tuple[str | Argument | Verb, ...]) -> Iterator[str | Argument | Verb]:
    for piece in pieces:
        if isinstance(piece, Advice):
            yield from piece.pieces
        else:
            yield piece
