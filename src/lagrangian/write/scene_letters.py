"""The letters of the labels of a scene: pieces of text, each raised or lowered, upright or italic."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from lagrangian.page.scene import Label, Scene
from lagrangian.records import dataclass
from lagrangian.write.expression_tree import GREEK, Letter, numbered
from lagrangian.write.names import letters
from lagrangian.write.text import clean

CAPITALS = "ΓΔΘΛΞΠΣΥΦΨΩ"
"""Greek capitals are upright, as in LaTeX."""

SMALLER = (1.0, 0.72, 0.55)
"""The size of letters, of subscripts, and of subscripts of these."""

LONGEST = 40
"""The base of a letter and each part of its subscript have at most this many characters."""


@dataclass(frozen=True)
class LetterPiece:
    """A text; ``lowered`` counts how deep a subscript it is."""

    text: str
    italic: bool = True
    lowered: int = 0


def scene_letters(scene: Scene) -> Mapping[str, Letter]:
    """Return the letter for every name in the labels of a scene; two names never look the same."""
    return _letters(dict.fromkeys(name for label in scene.labels for name in label.names))


def _letters(names: Iterable[str]) -> Mapping[str, Letter]:
    found = letters(names)
    return {name: replace(x, base=_short(x.base), sub=tuple(map(_short, x.sub))) for name, x in found.items()}


def pieces(label: Label, table: Mapping[str, Letter]) -> list[LetterPiece]:
    """Return a label as pieces of text: its names with commas."""
    listed: list[LetterPiece] = []
    for i, name in enumerate(label.names):
        if i:
            listed.append(LetterPiece(", ", italic=False))
        listed += _letter(table[name])
    return listed


def _letter(math: Letter) -> list[LetterPiece]:
    text = math.base if math.literal else GREEK.get(math.base, math.base)
    listed = [LetterPiece(text, italic=not math.literal and len(text) == 1 and text not in CAPITALS)]
    for i, part in enumerate(math.sub):
        if i:
            listed.append(LetterPiece(",", italic=False, lowered=1))
        listed += _sub(part)
    return listed


def _sub(part: str) -> list[LetterPiece]:
    """A part of a subscript: digits and words upright, single letters italic, numbered letters with a subscript."""
    if found := numbered(part):
        return [LetterPiece(GREEK.get(found[0], found[0]), lowered=1), LetterPiece(found[1], italic=False, lowered=2)]
    digits = len(part) - len(part.lstrip("0123456789"))
    head, tail = part[:digits], part[digits:]
    listed = [LetterPiece(head, italic=False, lowered=1)] if head else []
    if tail:
        text = GREEK.get(tail, tail)
        listed.append(LetterPiece(text, italic=len(text) == 1, lowered=1))
    return listed


def _short(text: str) -> str:
    text = clean(text)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"


def width_of(names: tuple[str, ...], size: float) -> float:
    """About how wide a label is [px]; a label is drawn in whatever serif font there is."""
    found = pieces(Label(names, (0.0, 0.0), "thin"), _letters(names))
    return sum(size * SMALLER[piece.lowered] * _advance(c) for piece in found for c in piece.text)


def _advance(c: str) -> float:
    """The width of a character, in sizes of the letters."""
    if c in "iljtfI,.'():; ":
        return 0.32
    if c in "mwMWΩ":
        return 0.85
    return 0.68 if c.isupper() else 0.52
