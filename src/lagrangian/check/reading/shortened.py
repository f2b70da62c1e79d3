"""Names of Greek letters that are written out, as a letter, or shortened: ε = epsilon = eps, θ₁ = th1, ℓ = l = ell."""

from __future__ import annotations

import re
from collections.abc import Iterable
from unicodedata import normalize

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.read.letters import GREEK, key, undotted
from lagrangian.read.scope import Scope

LONGEST = 100
"""The length of a word above which it shortens no name."""

_SHORT = {
    "epsilon": ("eps", "ep"),
    "theta": ("th", "tht", "thet"),
    "phi": ("ph", "fi"),
    "alpha": ("alp", "alph", "alfa", "alf"),
    "beta": ("bet",),
    "gamma": ("gam", "gamm"),
    "delta": ("delt",),
    "lambda": ("lam", "lamb", "lmbda"),
    "omega": ("om", "omg", "omeg"),
    "sigma": ("sig", "sigm"),
    "kappa": ("kap", "kapp"),
}
"""How people shorten the names of Greek letters."""

_WHOLE = {short: word for word, listed in _SHORT.items() for short in listed} | {word: word for word in GREEK.values()}
_WHOLE |= {"l": "ell", "ell": "ell"}
_INDEXED = re.compile(r"([A-Za-z]+)(\d*)")
_OF_ANGLE = re.compile(r"(?<!\w)(?:sin|cos|tan)[ ]?\([ ]?([^\W\d]\w{0,24}+)(?=[ ]?[-+−)])")
_WORD = re.compile(r"(?<![^\W_])[A-Za-z](?![^\W_])")
_RATED = re.compile(r"(?<![\w'’′])(?P<name>[A-Za-z]{2,4}\d{0,2})(?:['’′″](?!s\b)|_?dd?ot(?!\w)|_?dd(?!\w))")
"""A name with a mark of a rate."""
_MOVING = re.compile(
    r"\\d?dot[ ]?\{?[ ]?\\?(?P<latex>[^\W\d_]\w{0,15}+)"
    r"|(?<![\w\\])(?P<plain>[^\W\d_]\w{0,15}?)(?:[\u0307\u0308'’′″]|_?dd?ot(?!\w)|_?dd(?!\w))"
)
"""A name with the marks of a rate, in any notation."""
_TWO_LETTERS = re.compile(r"([A-Za-z][a-z])_?(\d*)")


def moving_names(text: str) -> frozenset[str]:
    """The names with rates in a text, in their common form."""
    found = _MOVING.finditer(normalize("NFD", text))
    return frozenset(key(m["plain"] or m["latex"].removeprefix("var")) for m in found)


class AnswerScope(Scope):
    """The names of a system, which an answer may shorten.

    A shortened name is read if one name of the system alone can be meant, and if the answer does not define it:
    ``taken`` are the names that it does. The index 0 of a constant may be left out: ε is ``eps_0``. ℓ, which is the
    letter l to Unicode, is ``ell`` where the system has no l. Two letters alone, al for alpha, are a name only where
    the answer uses them as one: ``used``, or any if that is None, as in a program. Letters that might be a product of
    constants are a name if they have a rate: al'' is alpha'', and no a l''. A letter twice, II or jj, is the letter, in
    either case, that the answer does not use otherwise.
    """

    def __init__(self, symbols: Scope) -> None:
        self._letters: dict[tuple[str, str], list[str]] = {}
        self.taken: frozenset[str] = frozenset()
        self.used: frozenset[str] | None = frozenset()
        self._doubled: dict[str, str] = {}
        self._rated: frozenset[str] = frozenset()
        self.moving: frozenset[str] = frozenset()
        """The keys of the names of which the answer writes rates."""
        self._meant: dict[str, tuple[list[str], int]] = {}
        super().__init__(symbols)
        for name in symbols:
            if (letter := _letter(name)) is not None:
                self._letters.setdefault(letter, []).append(name)

    def learn(self, own: Iterable[str], used: Iterable[str], text: str) -> None:
        """Take from an answer what it defines and what it uses as names, such as those of a sine or cosine: cos(al)."""
        self._meant.clear()
        self.taken = frozenset(map(key, own))
        self._rated = frozenset(m["name"] for m in _RATED.finditer(text))
        self.moving = moving_names(text)
        self.used = frozenset(used) | self._rated | frozenset(m[1] for m in _OF_ANGLE.finditer(text))
        doubled = [x for x in self.used if len(x) == 2 and x[0] == x[1] and key(x) not in self.taken]
        doubled = [x for x in doubled if x.isupper() or x[0] not in self]  # aa is a²
        words = set(_WORD.findall(text)) if doubled else set()
        for name in doubled:
            meant = [x for x in dict.fromkeys([name[0].upper(), name[0].lower()]) if x in self and x not in words]
            if len(meant) == 1 and not super().meanings(name)[0]:
                self._doubled[name] = meant[0]

    def meanings(self, written: str) -> tuple[list[str], int]:
        """Return the names that ``written`` can mean, in full or shortened, and its number of dots."""
        written = str(written)
        if written not in self._meant:
            self._meant[written] = self._all_meanings(written)
        found, dots = self._meant[written]
        return list(found), dots

    def add(self, name: str, value: sp.Basic) -> None:
        """Add a name, or give it a new meaning."""
        self._meant.clear()
        super().add(name, value)

    def _all_meanings(self, written: str) -> tuple[list[str], int]:
        found, dots = super().meanings(written)
        if found or not self._letters:
            return found, dots
        base, dots = undotted(written)
        if base in self._doubled:
            return [self._doubled[base]], dots
        return self._shortened(base), dots

    def _shortened(self, base: str) -> list[str]:
        if len(base) > LONGEST or key(base) in self.taken or self._is_product(key(base)):
            return []
        found = self._short_for(base)
        rated = base in self._rated and self._is_product(key(base), rated=False)
        return found if not rated or all(map(self._moves, found)) else []

    def _short_for(self, base: str) -> list[str]:
        """The names of which this may be a short form."""
        letter = _letter(base)
        if letter is None:
            return self._begun(base)
        same = self._letters.get(letter, [])
        if same or letter[1] not in ("", "0") or letter[0] == "ell":
            return same if len(same) == 1 else []
        near = self._letters.get((letter[0], "" if letter[1] else "0"), [])
        return near if len(near) == 1 else []

    def _begun(self, base: str) -> list[str]:
        """The name that begins with these two letters, if the answer uses them as a name and it is the only one."""
        match = _TWO_LETTERS.fullmatch(base)
        if match is None or (self.used is not None and base not in self.used):
            return []
        stem, number = match[1], match[2]
        begun = [x for (word, digits), x in self._letters.items() if word.startswith(stem) and digits == number]
        return begun[0] if len(begun) == 1 and len(begun[0]) == 1 else []

    def _is_product(self, word: str, *, rated: bool = True) -> bool:
        """Whether a shortened name is two names of the system next to each other: al as a·l; the second one moves if
        the name is ``rated`` in the answer."""
        known = super().meanings
        for k in range(1, len(word) if word not in GREEK.values() else 0):
            if not known(word[:k])[0] or not (last := known(word[k:])[0]):
                continue
            if not (rated and word in self._rated and not any(map(self._moves, last))):
                return True
        return False

    def _moves(self, name: str) -> bool:
        """Whether a name of the system changes with time."""
        return bool(self[name].atoms(AppliedUndef))


def meant(written: str, names: Iterable[str]) -> list[str]:
    """The names that ``written`` may be, spelled in another way or shortened."""
    listed, letter = list(names), _letter(written)
    same = [x for x in listed if key(x) == key(written)]
    return same or [x for x in listed if letter is not None and _letter(x) == letter]


def _letter(name: str) -> tuple[str, str] | None:
    """The Greek letter that a name is, written out, and its number; None if it is none."""
    match = _INDEXED.fullmatch(key(name))
    if match is None:
        return None
    stem = match[1]
    word = _WHOLE.get(stem.lower())
    if word is None or stem[1:] != stem[1:].lower():
        return None
    return word.capitalize() if stem[0].isupper() else word, match[2]
