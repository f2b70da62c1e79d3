"""Takes off signs that join words of a phrase: J_0 = J + m l²/3 for drum + lever, I = … (rod & disc)."""

from __future__ import annotations

import re

from lagrangian.check.reading.prose.words import Words

_SHORTEST = 3
"""The fewest letters of a word that is joined."""
_WORD = rf"[^\W\d_]{{{_SHORTEST},20}}+(?:-[^\W\d_]{{{_SHORTEST},20}}+)?"
_SIGN = r"[ ]?[+&][ ]?"
_SAID = rf"(?:(?:{_WORD}[ ]){{0,2}}{_WORD}(?:{_SIGN}(?:{_WORD}[ ]){{0,2}}{_WORD}){{1,3}})"
_JOINED = re.compile(
    rf"(?<!\w)(?:for|of|from|about|including|für|von|aus|um|pour|de|des|du)[ ]{_SAID}"
    r"(?=[ \t]*(?:$|[,.;:)\]]|(?<=[ \t])(?:and|und|et)[ \t]))",
    re.MULTILINE,
)
_ASIDE = re.compile(rf"(?<=[ \t])\({_SAID}\)(?=[ \t]*(?:$|[,.;:]))", re.MULTILINE)
_PARTS = re.compile(r"[^\W\d_]+")


def with_words_joined(text: str, words: Words) -> str:
    """Return an answer in plain text with blanks for the signs between such words, of which none is a name."""

    def joined(match: re.Match[str]) -> str:
        listed = _PARTS.findall(match.group())
        if any(not x.isalpha() or words.readable(x) or words.is_product(x) for x in listed):  # m₁ẋ₁² is no word
            return match.group()
        return re.sub("[+&]", " ", match.group())

    return _ASIDE.sub(joined, _JOINED.sub(joined, text))
