"""How a name may be written: Greek letters or their spelling, subscripts or digits, dots or primes.

A name is looked up exactly first (in Unicode's compatibility form NFKC, so ``θ₁`` is ``θ1``). Where that finds nothing,
a Greek letter and its spelling are the same, and so are a subscript with and without its underscore:

    θ₁ = θ1 = θ_1 = theta1 = theta_1,      Lₐ = La = L_a

Dots stand on a name's first letter or on its last one: ẋ, θ̈₁, x1̇. A letter that carries such a mark in an ordinary
language (ä, ż) is taken as a dotted letter only where no name is written with it.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable

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
"""Small Greek letters and how they are spelled; the capitals are spelled with a capital."""

SPELLED = GREEK | {letter.upper(): word.capitalize() for letter, word in GREEK.items() if letter != "ς"}
_SPELL = str.maketrans(SPELLED)

DOTS = {"\u0307": 1, "\u0308": 2, "\u20db": 3, "\u20dc": 4}
"""Combining marks above a letter, and how many dots each has."""

# Letters of other scripts that look like a Latin one: Cyrillic, Greek capitals, and the dotless i.
_LATIN_TWINS = str.maketrans(
    "авеіјкмнорсԛѕтухгАВЕЗІЈКМНОРСЅТХУΑΒΕΖΗΙΚΜΝΟΡΤΥΧοıԁԝһ",
    "abeijkmhopcqstyxrABE3IJKMHOPCSTXYABEZHIKMNOPTYXoidwh",
)


def normal(name: str) -> str:
    """Return the name in the form it is looked up by: NFKC."""
    return unicodedata.normalize("NFKC", name)


def spelled(name: str) -> str:
    """Return the name with its Greek letters spelled out: ``θ1`` → ``theta1``."""
    return normal(name).translate(_SPELL)


def key(name: str) -> str:
    """Return what two ways of writing one name share: Greek spelled out, underscores left out."""
    return spelled(name).replace("_", "").replace("lamda", "lambda")


def twin(name: str) -> str:
    """Return the name with letters of other scripts replaced by the Latin letters they look like."""
    return normal(name).translate(_LATIN_TWINS)


def undotted(name: str) -> tuple[str, int]:
    """Split off the dots over the first or the last letter: ``θ̈₁`` → (``θ₁``, 2); other names come back with 0."""
    letters = unicodedata.normalize("NFD", name)
    marks = [i for i, c in enumerate(letters) if c in DOTS]
    if not marks:
        return normal(name), 0
    base = "".join(c for c in letters if c not in DOTS)
    consecutive = marks[-1] - marks[0] == len(marks) - 1
    if not consecutive or marks[0] not in (1, len(base)):
        return normal(name), 0
    return normal(base), sum(DOTS[letters[i]] for i in marks)


def find(name: str, known: Iterable[str]) -> list[str]:
    """Return the names among ``known`` that ``name`` can mean: the exact one alone, else all that share its key."""
    names = list(known)
    exact = [k for k in names if normal(k) == normal(name)]
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
