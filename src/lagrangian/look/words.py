"""A sentence that says what a picture shows, for those who cannot see it."""

from __future__ import annotations

from collections import Counter

from lagrangian.look.board import Board
from lagrangian.look.cast import Player

PLURALS = {"bar": "bars", "ball": "balls", "disc on a shaft": "discs on a shaft"}


def description(board: Board, parts: list[Player]) -> str:
    """The bodies by what they are drawn as, what ties them, and the coordinates."""
    model = board.stage.model
    bodies = Counter(part.glyph.value for part in parts)
    shown = [f"{_count(n)} {_plural(word, n)}" for word, n in bodies.items()]
    kinds = Counter(e.kind.replace("_", " ") for e in model.elements if e not in model.bodies)
    others = [f"{_count(n)} {_plural(word, n)}" for word, n in kinds.items() if word != "gravity"]
    text = f"{model.name}: {_listed(shown)}" if shown else model.name
    if others:
        text += f", with {_listed(others)}"
    text += ". " + _coordinates(board)
    return text


def _coordinates(board: Board) -> str:
    named = [f"{c.name} ({c.description})" if c.description else c.name for c in board.stage.model.coordinates[:12]]
    rest = len(board.stage.model.coordinates) - len(named)
    more = f" and {rest} more" if rest else ""
    return f"Coordinates: {', '.join(named)}{more}."


def _plural(word: str, n: int) -> str:
    return word if n == 1 else PLURALS.get(word, f"{word}s")


def _count(n: int) -> str:
    words = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
    return words[n] if n < len(words) else str(n)


def _listed(words: list[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"
