"""Directions in words, found from the geometry: which way a positive coordinate moves, and where a force points."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.model import Coordinate, Model, Point

AXES = {
    (1, 0): "to the right",
    (-1, 0): "to the left",
    (0, 1): "upward",
    (0, -1): "downward",
}
"""The directions along the fixed axes of the plane."""

WORDS = (
    ("to the right", "to the left"),
    ("rightward", "leftward"),
    ("upward", "downward"),
    ("up", "down"),
    ("counter-clockwise", "clockwise"),
    ("forward", "backward"),
)
"""Words for directions, with their opposites; some may end in s."""

_TURNED = {one: other for a, b in WORDS for one, other in ((a, b), (b, a))} | {"counterclockwise": "clockwise"}
_SENSES = frozenset([*AXES.values(), "counter-clockwise", "clockwise"])
"""The directions that the geometry tells."""
_DIRECTION = re.compile(
    r"(?<!straight )(?<!hanging )(?<!pointing )\b(?:(to the right|to the left|counter-?clockwise|clockwise"
    r"|(?:down|up|for|back|right|left)ward)(s?)|(down|up)(?= the \w+| from |$|[,;]))\b"
)
_OTHER = re.compile(
    r"\b(?:out of|into|towards?|away|apart|together|above|below|over|against|inwards?|outwards?|ahead|behind"
    r"|stretch\w*|extension|elongation|compression|length|height|depth|distance|depression|gap|opening)\b"
)
"""Words that say a direction, too, and have no opposite that fits everywhere."""


def turned_words(words: str, sense: str | None = None) -> str | None:
    """A description with the opposite of its only direction: "drum, clockwise" as "drum, counter-clockwise".

    What is measured or acts along the one is measured or acts along the other with the opposite sign. None if there is
    not one direction, or if it is not the ``sense`` that the geometry has.
    """
    found = list(_DIRECTION.finditer(words))
    if len(found) != 1 or _OTHER.search(words):
        return None
    (one,) = found
    word = one[1] or one[3]
    fixed = {"up": "upward", "down": "downward"}.get(word, word)
    if sense is not None and fixed in _SENSES and fixed != sense and " the " not in words[one.end() : one.end() + 5]:
        return None
    return f"{words[: one.start()]}{_TURNED[word]}{one[2] or ''}{words[one.end() :]}"


def says_direction(words: str) -> bool:
    """Whether a description says which way is positive."""
    return bool(_DIRECTION.search(words) or _OTHER.search(words) or "positive" in words)


def turned_round(sense: str) -> str:
    """Return the opposite direction."""
    return _TURNED[sense]


def positive_sense(model: Model, coordinate: Coordinate) -> str | None:
    """Return the direction in which a coordinate that grows moves its first body, in the plane; None if it varies.

    For a rotation r″ = −(r − centre), with primes for ∂/∂ξ, so (r − centre) × r′ says its sense.
    """
    if model.dimension != 2:
        return None
    q = coordinate.symbol
    for body in model.bodies:
        try:
            first, second, third = _slopes(model, body.at, q)
        except bounded.TooLarge:  # what is so long is neither a line nor a circle
            return None
        if all(value == 0 for value in first):
            continue
        if all(value == 0 for value in second):
            return along(first)
        if any(bounded.simplify(a + b) != 0 for a, b in zip(first, third, strict=True)):
            return None
        cross = bounded.simplify(first[0] * second[1] - first[1] * second[0])
        return "counter-clockwise" if _positive(cross) else "clockwise" if _positive(-cross) else None
    return None


def _slopes(model: Model, point: Point, q: sp.Expr) -> list[list[sp.Expr]]:
    """The first three derivatives of a position by a coordinate."""
    found = [[model.expand(value) for value in model.position(point)]]
    for _ in range(3):
        found.append([bounded.diff(value, q) for value in found[-1]])
    return found[1:]


def along(vector: Sequence[Any]) -> str | None:
    """Return the direction of a vector with one constant component, such as "to the left"; None for any other."""
    known = [x for x in vector if x != 0]
    if len(vector) != 2 or len(known) != 1 or not known[0].is_number:
        return None
    sign = 1 if known[0] > 0 else -1
    return AXES[(sign if vector[0] != 0 else 0, sign if vector[1] != 0 else 0)]


def _positive(expr: sp.Expr) -> bool:
    """Whether an expression of lengths is a square, or a number, with a positive factor."""
    factor, rest = expr.as_coeff_Mul()
    lengths = {s: sp.Dummy(positive=True) for s in rest.free_symbols}
    return bool((factor * rest.xreplace(lengths)).is_positive)
