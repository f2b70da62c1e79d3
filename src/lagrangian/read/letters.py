"""The spellings of a name: Greek letters or their names, subscripts or digits, dots or primes.

A name is first looked up exactly (in Unicode's compatibility form NFKC, so ``θ₁`` is ``θ1``). If this finds nothing, a
Greek letter and its name are equivalent, and so are subscripts with and without an underscore:

    θ₁ = θ1 = θ_1 = theta1 = theta_1,      Lₐ = La = L_a

Dots may be on the first letter of a name or on its last: ẋ, θ̈₁, x1̇. A letter that has such a mark in a natural
language (ä, ż) is read as a dotted letter only if no name is written with it.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from functools import lru_cache

GREEK = {
    "α": "alpha",
    "β": "beta",
    "γ": "gamma",
    "δ": "delta",
    "ε": "epsilon",
    "ζ": "zeta",
    "η": "eta",
    "θ": "theta",
    "ι": "iota",
    "κ": "kappa",
    "λ": "lambda",
    "μ": "mu",
    "ν": "nu",
    "ξ": "xi",
    "ο": "omicron",
    "π": "pi",
    "ρ": "rho",
    "σ": "sigma",
    "ς": "sigma",
    "τ": "tau",
    "υ": "upsilon",
    "φ": "phi",
    "χ": "chi",
    "ψ": "psi",
    "ω": "omega",
}
"""Small Greek letters and their names; the names of capitals are capitalized."""

SPELLED = GREEK | {letter.upper(): word.capitalize() for letter, word in GREEK.items() if letter != "ς"}
_SPELL = str.maketrans(SPELLED)

DOTS = {"\u0307": 1, "\u0308": 2, "\u20db": 3, "\u20dc": 4}
"""Combining marks above a letter, and the number of dots that each means."""

# Letters of other scripts that look like a Latin one: Cyrillic, Greek capitals, and the dotless i.
_LATIN_TWINS = str.maketrans(
    "авеіјкмнорсԛѕтухгАВЕЗІЈКМНОРСЅТХУΑΒΕΖΗΙΚΜΝΟΡΤΥΧοıԁԝһ",
    "abeijkmhopcqstyxrABE3IJKMHOPCSTXYABEZHIKMNOPTYXoidwh",
)


def normal(name: str) -> str:
    """Return the name in the form in which it is looked up: NFKC."""
    return name if name.isascii() else unicodedata.normalize("NFKC", name)


@lru_cache(maxsize=4_096)
def spelled(name: str) -> str:
    """Return the name with its Greek letters spelled out: ``θ1`` → ``theta1``."""
    return normal(name).translate(_SPELL)


@lru_cache(maxsize=4_096)
def key(name: str) -> str:
    """Return the common form of equivalent spellings: Greek spelled out, without underscores."""
    return spelled(name).replace("_", "").replace("lamda", "lambda")


def twin(name: str) -> str:
    """Return the name with letters of other scripts replaced by the Latin letters that they resemble."""
    return normal(name).translate(_LATIN_TWINS)


def undotted(name: str) -> tuple[str, int]:
    """Remove the dots over the first or the last letter: ``θ̈₁`` → (``θ₁``, 2); for other names the number is 0."""
    return (name, 0) if name.isascii() else _undotted(str(name))


@lru_cache(maxsize=4_096)
def _undotted(name: str) -> tuple[str, int]:
    letters = unicodedata.normalize("NFD", name)
    marks = [i for i, c in enumerate(letters) if c in DOTS]
    if not marks:
        return normal(name), 0
    base = "".join(c for c in letters if c not in DOTS)
    consecutive = marks[-1] - marks[0] == len(marks) - 1
    if not consecutive or marks[0] not in (1, len(base)):
        return normal(name), 0
    return normal(base), sum(DOTS[letters[i]] for i in marks)


def dotted(name: str) -> str:
    """A name with dots in place of the primes behind it: ``h'`` → ``ḣ``."""
    bare = name.rstrip("'’′")
    return f"{bare}{chr(0x307) * (len(name) - len(bare))}"


def unaccented(word: str) -> str:
    """Return a word in the letters and digits of ASCII: ``Körper`` → ``Korper``."""
    return "".join(c for c in unicodedata.normalize("NFD", word) if c.isascii() and c.isalnum())


def find(name: str, known: Iterable[str]) -> list[str]:
    """Return the names among ``known`` that ``name`` can mean: the exact one alone, otherwise all equivalent ones."""
    names, whole = list(known), normal(name)
    exact = [k for k in names if normal(k) == whole]
    if exact:
        return exact[:1]
    mine = key(name)
    return [k for k in names if key(k) == mine]


def foreign(name: str) -> str | None:
    """Describe the first letter that is neither Latin nor Greek: ``'а' is U+0430 CYRILLIC SMALL LETTER A``."""
    for c in normal(name):
        title = unicodedata.name(c, "UNNAMED")
        if c.isalpha() and not title.startswith(("LATIN", "GREEK")):
            return f"'{c}' is U+{ord(c):04X} {title}"
    return None
