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
_SENTENCE = re.compile(r"^(?=[^.;=\n]{0,400}[+&])[^\W\d_][^.;=\n]{2,400}+\.(?=[ ][^\W\d_])", re.MULTILINE)
"""A sentence without an equals sign, with another behind it: I treat mast + arm as one body. Let …"""
_LED = re.compile(
    r"^(?=[^.;:=\n]{0,400}[+&])[^\W\d_][^.;:=\n]{2,400}+="
    r"(?:(?<=[^\W\d_]{3}[ ]\w[ ]=)|(?<=[^\W\d_]{3}[ ]\w\w[ ]=))",
    re.MULTILINE,
)
"""Words in front of a short name that gets a value: Hinge force + acceleration give with Steiner Jh = J + m l^2."""
_TWO = re.compile(rf"(?<!\w){_WORD}(?:{_SIGN}{_WORD}){{1,3}}(?!\w)")
_PARTS = re.compile(r"[^\W\d_]+")


def with_words_joined(text: str, words: Words) -> str:
    """Return an answer in plain text with blanks for the signs between such words, of which none is a name."""

    def are_words(said: str) -> bool:
        return all(x.isalpha() and not words.readable(x) and not words.is_product(x) for x in _PARTS.findall(said))

    def joined(match: re.Match[str]) -> str:
        return re.sub("[+&]", " ", match.group()) if are_words(match.group()) else match.group()  # m₁ẋ₁² is no word

    def as_one(match: re.Match[str]) -> str:
        """One word, because a gap would part what it stands between."""
        return (
            re.sub(_SIGN, lambda m: "and"[: len(m.group())], match.group())
            if are_words(match.group())
            else match.group()
        )

    for sentence in (_SENTENCE, _LED):
        text = sentence.sub(lambda m: _TWO.sub(as_one, m.group()), text)
    return _ASIDE.sub(joined, _JOINED.sub(joined, text))
