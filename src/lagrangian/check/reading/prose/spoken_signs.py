"""Reads the words for signs between mathematics: (J + m l^2) times theta'' minus m g l sin theta equals 0."""

from __future__ import annotations

import re

from lagrangian.check.reading.prose.words import Words

_SPOKEN = {"plus": "+", "minus": "-", "times": "*", "divided by": "/", "over": "/", "equals": "="}
_WORD = re.compile(rf"(?<=\s)(?P<sign>{'|'.join(_SPOKEN)})(?=\s)")
_LEFT = re.compile(r"(?:(?P<name>[^\W\d]\w{0,30})|[\d)\]'’′″²³])\s{0,40}\Z")
_RIGHT = re.compile(r"\s{1,40}(?:(?P<name>[^\W\d]\w{0,30})|[\d(\[½¼])")
_NEAR = 80
_ANNOUNCED = re.compile(r"[ \t]*+(?:minus|plus|times|divided by)[ \t][^\n]{1,40}:[ \t]*+")
"""A line that says what was done with the equation above it: divided by l:"""


def with_spoken_signs(text: str, words: Words) -> str:
    """Return an answer in plain text with signs for such words, where names, numbers or brackets stand on both sides;
    places stay the same."""
    for match in list(_WORD.finditer(text)):
        left = _LEFT.search(text[max(0, match.start() - _NEAR) : match.start()])
        right = _RIGHT.match(text, match.end())
        if left is None or right is None or _ANNOUNCED.fullmatch(*_line(text, match)) is not None:
            continue
        if all(x["name"] is None or words.readable(x["name"]) or words.is_product(x["name"]) for x in (left, right)):
            sign = _SPOKEN[match["sign"]].ljust(len(match["sign"]))
            text = text[: match.start()] + sign + text[match.end() :]
    return text


def _line(text: str, match: re.Match[str]) -> tuple[str, int, int]:
    """The text, and where the line of a match begins and ends."""
    end = text.find("\n", match.end())
    return text, text.rfind("\n", 0, match.start()) + 1, len(text) if end < 0 else end
