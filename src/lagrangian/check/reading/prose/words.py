"""Splits words into known names: mgLsin is m g L sin. If a word can be split in two ways, the reader asks.

A word is split only if it is no name itself. Longer names are preferred: no part of a name is split again.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from functools import cache, lru_cache
from unicodedata import normalize

from lagrangian.check.reading.names import COLUMNS, Names, spelled_rates
from lagrangian.check.reading.prose.splits import LONGEST, splits
from lagrangian.errors import ParseError, did_you_mean
from lagrangian.model.names import FUNCTIONS
from lagrangian.quantities.source import Source
from lagrangian.read.functions import ALIASES
from lagrangian.read.letters import DOTS, SPELLED, key, undotted

RECIPROCALS = {"cot": "tan", "sec": "cos", "csc": "sin", "cosec": "sin", "coth": "tanh", "sech": "cosh", "csch": "sinh"}
"""Functions of answers that are 1 over another."""

SPELLINGS = {
    **dict.fromkeys(["sen", "sén", "seno", "sinus"], "sin"),
    **dict.fromkeys(["coseno", "cosinus", "kosinus"], "cos"),
    **dict.fromkeys(["tang", "tangens", "tangente"], "tan"),
    **dict.fromkeys(["ctg", "cotg", "ctan", "cotan"], "cot"),
    **dict.fromkeys(["asen", "arcsen", "arcoseno"], "asin"),
    **dict.fromkeys(["arctg", "atg", "arctang"], "atan"),
    "senh": "sinh",
    "tgh": "tanh",
    **dict.fromkeys(["raiz", "raíz", "wurzel", "racine", "radice"], "sqrt"),
}
"""How other languages write functions."""

_REWRITES = (
    "expand simplify factor collect trigsimp nsimplify ratsimp ratexpand trigexpand trigreduce together cancel "
    "Expand ExpandAll Simplify FullSimplify Factor Collect TrigExpand TrigReduce TrigFactor Together Cancel"
)
REWRITES = frozenset(_REWRITES.split())
"""Functions of programs that write an expression, their first argument, in another way."""

MAX_WORDS = 500
"""The largest number of words in one answer that are tried to be split."""

MAX_TOLD = 6
"""The largest number of split words that a note lists."""

_WHOLE = frozenset(
    ["dt", "pi", "diff", "Derivative", "Matrix", "Hold", "HoldForm", "diag", "Eq", "piecewise", "ddot", "dot", "const"]
)
_ENERGIES = frozenset("TVUWELPHDA")
"""Letters of energies, work and power, of which dW is a small change."""
_NUMBER = re.compile(r"\d+")
_GREEK_LETTER = re.compile(r"(?![δΔ])[Α-ω][₀-₉]?")
"""A Greek letter, which is no word with the Latin letters beside it."""
_INDEXED = re.compile(r"(?!e_)[^\W\d_]_\w{1,12}")
"""A letter with an index, which is a name and no word: N_r; e_r is a unit vector."""

_LEADS = r"(?:^|[:;,]|\b(?:with|where|and|mit|wobei|und|avec|où)\b)"
_LED = re.compile(rf"{_LEADS}[^\S\n]*+([^\W\d]\w{{1,23}})['’′″]{{1,2}}[ \t]*+=(?![=>])", re.MULTILINE)
_DOTTED = re.compile(rf"{_LEADS}[^\S\n]*+([^\W\d][\w\u0307\u0308]{{1,23}})[ \t]*+=(?![=>])", re.MULTILINE)

_FORCE = re.compile(r"(?:lam|lmbda|lambda|mu)(?:_?\d)?")
"""Spellings of a multiplier."""
_COMPONENT = re.compile(r"[A-Z][xyz]")


def led_names(text: str) -> frozenset[str]:
    """The names whose rates stand alone on a left side, xS'' = x'' - … or ẋS = ẋ - …: of letters of the answer's own,
    they are no products."""
    dotted = (m[1] for m in _DOTTED.finditer(text) if normalize("NFD", m[1])[1:2] in DOTS)
    return frozenset(key(undotted(x)[0]) for x in (*(m[1] for m in _LED.finditer(text)), *dotted))


def function_of(word: str) -> str | None:
    """The function that a word means, in any case and under the names of other programs: Sin, arctan, tg; or None."""
    return _function_of(str(word))


@lru_cache(maxsize=4_096)
def _function_of(word: str) -> str | None:
    if word in FUNCTIONS or word in RECIPROCALS:
        return word
    for form in (word, word.lower(), word.lower().replace("_", "")):
        other = SPELLINGS.get(form) or ALIASES.get(form, form)
        if other in FUNCTIONS or other in RECIPROCALS:
            return other
    return None


def _is_moving_product(word: str) -> bool:
    """Whether dots stand in the middle of a word, so that it is no name but a product: m₁ẍ₁."""
    return bool(DOTS.keys() & set(normalize("NFD", undotted(word)[0])))


_SPELLED = frozenset(SPELLED.values())
LONGEST_SHORT = 3
"""The most letters of a Greek letter's name that may be a product: mu, eta, rho."""


class Words:
    """What the words of one answer may mean, before its statements are read.

    ``own`` are the names that the answer defines, ``alone`` all its words as often as they occur, and ``used`` those
    with primes or next to an operator, which are names; ``primed`` are those that never stand without primes, and
    ``led`` those whose rates stand alone on a left side. ``spoken`` are common words that stand in front of words, and
    are no products.
    """

    def __init__(
        self,
        names: Names,
        own: Iterable[str],
        alone: Iterable[str],
        used: Iterable[str] = (),
        primed: Iterable[str] = (),
        led: frozenset[str] = frozenset(),
        spoken: frozenset[str] = frozenset(),
        virtual: bool = False,
    ) -> None:
        self.names = names
        self._counts = Counter(key(x) for x in alone)
        self._own = {key(x) for x in own if function_of(x) is None and not _is_moving_product(x)}
        self._alone = self._counts.keys()
        self._used = {key(x) for x in used if function_of(x) is None}
        self._primed = frozenset(primed)
        self._led, self._spoken = led, spoken
        self._split: dict[str, str] = {}
        self._products: dict[str, bool] = {}
        self.flipped = False
        """Whether the denominators that can be read in two ways are read in the less likely one."""
        self.asked = False
        """Whether there was such a denominator."""
        self.units = False
        """Whether letters after a number are a unit even if they are names of the system."""
        self.doubtful = False
        """Whether there were such letters."""
        self.summed = False
        """Whether cosθ1-θ2, written without gaps, is read as cos(θ1 - θ2)."""
        self.summed_asked = False
        """Whether there was such an argument."""
        self.factored = False
        """Whether the letter d in front of what moves, dω, is a constant of that name, and no sign of a rate."""
        self.factored_asked = False
        """Whether there was such a letter, without a mark of a rate behind it."""
        self.virtual = virtual
        """Whether the answer speaks of virtual work, so that δx is a displacement even if δ is a name."""
        self.unread: list[ParseError] = []
        """The errors of sentences with an equals sign and names of the system that were not read."""

    def known(self, word: str) -> bool:
        """Whether a word is a name of the system or of the answer, or the rate of one in letters."""
        if self.names.known(word) or key(undotted(word)[0]) in self._own:
            return True
        if word[:1] == "d" and (undotted(word)[1] or word in self._primed) and self.is_name("d"):
            return False  # dφ̇ and dphi' are d φ̇, where d is a damper
        rates = (stem for _, stem in spelled_rates(word) if not self._is_input_times(stem, word))
        return any(self.names.changes(stem) or key(stem) in self._own for stem in rates)

    def _is_input_times(self, stem: str, word: str) -> bool:
        """Whether a word is the product of an input, of which no system has a rate, and of a d of the system: Fd."""
        behind = set(word.removeprefix(stem)) == {"d"} and bool(self.names.scope.meanings("d")[0])
        return behind and self.names.scope.meanings(stem)[0][:1] in [[x.name] for x in self.names.model.inputs]

    def is_name(self, word: str) -> bool:
        """Whether the system or the answer has this name; energies do not count."""
        return bool(self.names.scope.meanings(word)[0]) or key(undotted(word)[0]) in self._own

    def is_used(self, word: str) -> bool:
        """Whether the answer uses a word as a name: with primes, next to an operator, or between a number and a sum."""
        return key(word) in self._used

    def is_own(self, word: str) -> bool:
        """Whether the answer defines this name, and the system does not have it."""
        return key(word) in self._own and not self.names.scope.meanings(word)[0]

    def readable(self, word: str) -> bool:
        """Whether a word may be a factor of a product without a sign: known, a function, or a single letter, which may
        be a spelled Greek one."""
        if word in ("dot", "ddot", "diff", "Derivative") or _INDEXED.fullmatch(word):
            return True
        named = self.known(word) or function_of(word) is not None or key(word) in self._used
        named = named or any(stem in COLUMNS for _, stem in spelled_rates(word))  # qddot
        named = named or self._is_component(word)
        named = named or self._is_force(word) or len(key(word)) > len(word) or word in _SPELLED
        return named or len(re.sub(r"[\W\d_]", "", undotted(word)[0])) == 1

    def _is_force(self, word: str) -> bool:
        """Whether a word is a short spelling of a multiplier, perhaps with a number, where there are constraints."""
        return _FORCE.fullmatch(word) is not None and bool(self.names.model.constraints)

    def _is_component(self, word: str) -> bool:
        """Whether a word is a component of a vector of the answer's own, which has another one: Ax, where Ay is. Beside
        an F of the system, that one is no product: Fz, where Fx is and the system has no x."""
        others = self._other_axes(word)
        return bool(others) and not (self.is_name(word[0]) and all(map(self.is_name, others)))

    def _other_axes(self, word: str) -> list[str]:
        """The axes of the other components of a vector of which a word may be one."""
        if _COMPONENT.fullmatch(word) is None:
            return []
        return [axis for axis in "xyz" if axis != word[1] and key(word[0] + axis) in self._alone]

    def alone(self, word: str) -> bool:
        """Whether a word occurs in the answer elsewhere than after a number."""
        return key(word) in self._alone

    def count(self, word: str) -> int:
        """How often a word occurs in the answer."""
        return self._counts[key(word)]

    def is_product(self, word: str) -> bool:
        """Whether a word can be split into names of the system; short forms of these that stand nowhere else are none:
        the is no th·e of θ and e."""
        if word not in self._products:
            few = 1 < len(word) <= LONGEST and len(self._products) < MAX_WORDS and word not in self._spoken
            split = self._splits(word, called=False, extra=False) if few else ()
            self._products[word] = any(not any(map(self._is_new_short_form, parts)) for parts in split) or any(
                function_of(x) is not None
                for parts in split
                for x in parts  # mgLsinth
            )
        return self._products[word]

    def _is_new_short_form(self, part: str) -> bool:
        """Whether a part of a word is a short form of a name that no other word of the answer is."""
        named = self.names.scope.meanings(part)[0]
        return bool(named) and len(part) > 1 and key(part) not in map(key, named) and not self.count(part)

    def factors(self, word: str) -> list[str]:
        """The names of the system of which a word consists, coarsest first; the word itself if it is no product."""
        return next(iter(self._splits(word, called=True, extra=False)), [word]) if self.is_product(word) else [word]

    def is_function(self, word: str) -> bool:
        """Whether a word is a function and no name."""
        return function_of(word) is not None and not self.is_name(word)

    def calls(self, word: str) -> bool:
        """Whether a word before a bracket is a function, perhaps misspelled, and not a factor."""
        if self.known(word):
            return False
        return self.is_function(word) or (len(word) > 2 and did_you_mean(word.lower(), FUNCTIONS) is not None)

    def behind_factor(self, word: str, *, rated: bool = False) -> str | None:
        """What moves behind the letter d that is the name of a constant: θ in dθ', where a mark of a ``rated`` one
        follows; without it only where such letters are factors. None if d is none."""
        stem = word[1:]
        if word[:1] != "d" or not stem or self.is_name(word) or not self.is_name("d") or self.names.changes("d"):
            return None
        spelled = (x for _, x in spelled_rates(stem) if stem[:1] != "d" and key(stem).endswith(("d", "dot")))
        rated = rated or any(map(self.names.changes, spelled))
        own = self.is_own(stem) and stem not in _ENERGIES
        if not (own or self.names.changes(stem) or any(self.names.changes(x) for _, x in spelled_rates(stem))):
            return None
        if stem[:1] == "d" and not self.is_name(stem):
            return None  # ddθ
        self.factored_asked = self.factored_asked or not rated
        return stem if rated or self.factored else None

    def parts(self, word: str, source: Source, start: int, *, called: bool) -> list[str]:
        """The names of which a word consists, the word itself if it is a name or cannot be split.

        ``called``: a bracket or an argument follows, so that the last part may be a function. Raises an error that
        names both readings if there are two.
        """
        if not 1 < len(word) <= LONGEST or word in _WHOLE or self.known(word) or function_of(word) is not None:
            return [word]
        if word in self._spoken or (len(word) > LONGEST_SHORT and word in _SPELLED):
            return [word]  # lambda is no l a m b d a
        if self._is_force(word) or not all(map(self.is_name, self._other_axes(word))):
            return [word]  # lam1 is no l a m1
        led = key(undotted(word)[0]) in self._led
        whole = led or (self._is_component(word) and not self.is_name(word[1]))
        whole = whole or (word in _SPELLED and self.is_used(word))  # theta is no the*t*a
        rated = led or word in self._primed
        for extra in (False,) if whole else (False, True):
            found = self._splits(word, called, extra)
            found = [x for x in found if not (rated and self._is_constant(x[-1]))]  # ys' is no y s'
            if len(found) > 1:
                one, other = ("*".join(x) for x in found[:2])
                what = f"'{word}' can mean {one} or {other}"
                raise source.error(what, start, fix="write the product that you mean with its *", code="E402")
            if found:
                if not self._is_differential(found[0]):
                    self._split.setdefault(word, " ".join(found[0]))
                return found[0]
        return [word]

    def _is_differential(self, parts: list[str]) -> bool:
        """Whether a word is d and a name, where d is no name: dx of dx/dθ."""
        return len(parts) == 2 and parts[0] == "d" and not self.known("d") and "d" not in self._own

    def _is_constant(self, name: str) -> bool:
        """Whether the system has this name, and it does not change with time."""
        return bool(self.names.scope.meanings(name)[0]) and not self.names.changes(name)

    def _splits(self, word: str, called: bool, extra: bool) -> list[list[str]]:
        """The coarsest ways to split a word; with ``extra``, also into names that only the answer has, time and π. A
        capital letter twice, CC, is a name: a square is written C^2."""
        if word.isupper() and word == word[0] * len(word):
            return []

        @cache
        def fits(part: str, last: bool, after: bool) -> bool:
            if function_of(part) is not None and part not in ("t", "pi"):
                return not last or called
            if after and _NUMBER.fullmatch(part):
                return not last
            return self._is_part(part, extra, word)

        return splits(word, fits, lambda part: function_of(part) is not None)

    def _is_part(self, part: str, extra: bool, word: str) -> bool:
        if part[0] in "_0123456789" or part.endswith("_"):
            return False
        if self.names.scope.meanings(part)[0] or key(undotted(part)[0]) in self._own:
            return True
        if any(self.names.changes(stem) and len(part) - len(stem) > 2 for _, stem in spelled_rates(part)):
            return True
        if (
            part[0] == "d"
            and part != word
            and self._is_differential_of(part.removeprefix("dd").removeprefix("d"), part)
        ):
            return True
        if not extra or part in ("t", "pi"):
            return extra
        if _GREEK_LETTER.fullmatch(part):
            return True  # 2λx
        if part in ("a", "I") and key(part) not in self._used:
            return False  # words of sentences: ax is no a x
        alone = key(part) in self._alone or key(undotted(part)[0]) in self._alone
        return alone and key(part) != key(word) and not self.is_product(part)

    def _is_differential_of(self, stem: str, part: str) -> bool:
        """Whether a part of a word is the rate of what moves, dθ in bdθ, where no constant is called d; a Latin letter,
        dy in body, only if dy stands elsewhere, too."""
        if not stem or self.is_name("d") or not self.names.changes(stem):
            return False
        return not stem.isascii() or stem in _SPELLED or key(part) in self._alone

    def note_split(self, word: str, parts: str) -> None:
        """Note how a word was split."""
        self._split.setdefault(word, parts)

    def splits(self) -> frozenset[str]:
        """The words that were split so far."""
        return frozenset(self._split)

    def forget(self, but: Collection[str]) -> None:
        """Forget which words were split, but those that were before."""
        self._split = {word: parts for word, parts in self._split.items() if word in but}

    def notes(self) -> Iterator[str]:
        """How words were split, in one sentence."""
        if self._split:
            told = [f"{word} as {parts}" for word, parts in list(self._split.items())[:MAX_TOLD]]
            more = ", …" if len(self._split) > MAX_TOLD else ""
            yield f"Products without signs were read: {', '.join(told)}{more}."
