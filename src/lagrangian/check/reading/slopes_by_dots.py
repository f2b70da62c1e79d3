"""Whose primes are slopes by the one coordinate, because only so all terms of a statement have equally many dots.

d/dt(I θ') − ½ I' θ'² + V' = Q      I' θ'² beside I θ'': with the rate of I, it has three dots and not two
I θ'' + ½ I' θ'² + V' = Q           an energy counts as two dots, m x'², and so does a force, ∂V/∂θ; a power is three
I θ' θ'' + ½ I' θ'² + V' = Q θ'     here only the rates fit
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from typing import cast

import sympy as sp
from lark import Token, Tree
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading.line_forms import Statement
from lagrangian.check.reading.meaning import Meaning
from lagrangian.check.reading.name_patterns import RAISED
from lagrangian.check.reading.names import Names, spelled_rates
from lagrangian.check.reading.nodes import Node, names_in
from lagrangian.check.reading.placeholders import is_placeholder
from lagrangian.check.reading.stated import ENERGY_NAMES, energy_of
from lagrangian.check.reading.subject import Subject
from lagrangian.check.reading.summed_energies import things_with
from lagrangian.read.letters import key, undotted
from lagrangian.records import dataclass

_PRIME = re.compile(r"(?:\([^()]{1,20}\))?[ ]?['’′](?!['’′])")
_BEHIND = re.compile(
    r"\\?[^\W_]{1,24}+(?:_(?:\w{1,12}+|\{(?:[^{}]|\{[^{}]{0,20}\}){1,30}\}))?[ ]?\}?"
    r"(?:\([^()]{1,20}\))?[ ]?['’′](?!['’′])"
)
r"""A name in LaTeX with one prime behind it: \Theta', M_{\rm e}'."""
MOST = 200
"""The most terms of a statement whose dots are counted."""


@dataclass(frozen=True)
class _Term:
    """The dots of a term, if primes of functions are rates and if they are slopes; whether all dots in it are known, as
    it has an acceleration or is ∂L/∂θ; whether it has such a prime; and the names whose rates stand in it."""

    rated: int = 0
    sloped: int = 0
    known: bool = False
    primed: bool = False
    rates: frozenset[str] = frozenset()

    def times(self, other: _Term, sign: int = 1) -> _Term:
        return _Term(
            self.rated + sign * other.rated,
            self.sloped + sign * other.sloped,
            self.known or other.known,
            self.primed or other.primed,
            self.rates | other.rates,
        )


class _Unclear(Exception):
    """The dots of a statement cannot be counted."""


def sloped(
    turned: Sequence[tuple[Subject | None, Sequence[Tree]]], statements: Sequence[Statement], names: Names
) -> dict[int, dict[str, str]]:
    """Return the names, by their keys, whose primes are slopes in a statement, by its number.

    These are the names that the answer defines and its potential energies, in equations with accelerations or ∂L/∂θ;
    and where a line says what such a prime is, I' = 2 m a² sin θ cos θ, and no rate stands in its value.
    """
    speeds = _speeds(turned, names)
    found = {i: own for i, x in enumerate(statements) if (own := _in_equation(x, speeds, names))}
    every = {base: name for own in found.values() for base, name in own.items()}
    for i, (subject, sides) in enumerate(turned) if every else ():
        base = "" if subject is None or subject.token is None else key(undotted(subject.token)[0])
        if i in found or base not in every or subject is None or subject.order != 1:
            continue
        if not any(_changes(x, changing, names) for side in sides[1:] for x, changing in names_in(side)):
            found[i] = {base: every[base]}
    return found


def _changes(written: str, changing: bool, names: Names) -> bool:
    """Whether a name is a rate where it stands."""
    spelled = not names.scope.meanings(written)[0] and any(names.changes(x) for _, x in spelled_rates(written))
    return changing or bool(undotted(written)[1]) or spelled


def _speeds(turned: Sequence[tuple[Subject | None, Sequence[Tree]]], names: Names) -> dict[str, int]:
    """The dots of the names that the answer gives values with rates: one of ω = θ'."""
    found: dict[str, int] = {}
    for subject, sides in turned:
        if subject is None or subject.kind != "definition" or subject.order or subject.inverse or len(sides) < 2:
            continue
        try:
            dots = {x.rated for x in _Counted({}, found, names).terms(sides[-1])}
        except _Unclear:
            continue
        if len(dots) == 1 and dots != {0}:
            found.setdefault(key(str(subject.token)), dots.pop())
    return found


def _in_equation(statement: Statement, speeds: Mapping[str, int], names: Names) -> dict[str, str]:
    """The names whose primes are slopes in an equation, with their spelling; none unless all primes of them are."""
    sides, own, rates, accents = statement.sides, dict[str, str](), set[str](), True
    for token in (x for side in sides for x in _primed_in(side)):
        base, dots = undotted(token)
        if key(base) in speeds or names.scope.meanings(base)[0]:
            accents = accents and not has_prime(token, statement.source.text)
            continue
        if dots or not has_prime(token, statement.source.text):
            rates.add(key(base))  # dI/dt
        elif _weight(base, names) is not None:
            own[key(base)] = base
    if not own or rates & own.keys():
        return {}
    try:
        terms = [term for side in sides for term in _Counted(own, speeds, names).terms(side)]
    except _Unclear:
        return {}
    whole = {x.sloped for x in terms if x.known and not x.primed}
    primed = [x for x in terms if x.primed]
    if len(whole) != 1 or not primed or (not accents and any(len(x.rates) > 1 for x in primed)):
        return {}  # I' r' θ', where rates have primes
    (dots,) = whole
    return own if all(x.sloped == dots != x.rated for x in primed) else {}


def has_prime(token: Token, text: str) -> bool:
    """Whether one prime is written behind a name in the text of its statement."""
    start = token.start_pos or 0
    return any(x is not None for x in (_PRIME.match(text, start + len(token)), _BEHIND.match(text, start)))


def _primed_in(side: Tree) -> list[Token]:
    """The names with a prime in a side."""
    named = (x.children for x in side.iter_subtrees() if x.data == "name")
    return [cast("Token", token) for token, primes in named if primes is not None and len(str(primes)) == 1]


def _weight(base: str, names: Names) -> int | None:
    """The dots that a function of a coordinate may stand for: two, those of an energy; None of any other name."""
    if names.scope.meanings(base)[0]:
        return None
    if key(base) in names.defined:
        return 2 if ENERGY_NAMES.get(base) == "V" else 0
    return 2 if energy_of(base, names.model, lhs=True) == "V" else None


class _Counted:
    """Counts the dots of the terms of a statement, in which some names have primes."""

    def __init__(self, own: Mapping[str, str], speeds: Mapping[str, int], names: Names) -> None:
        self.own, self.speeds, self.names = own, speeds, names

    def terms(self, tree: Node) -> list[_Term]:
        """The terms of a tree that is multiplied out; an unclear one raises."""
        inner = [x for x in tree.children if x is not None] if isinstance(tree, Tree) else []
        if not isinstance(tree, Tree):
            raise _Unclear
        known: dict[str, Callable[[list[Node]], list[_Term]]] = {
            "number": lambda _: [_Term()],
            "name": lambda _: [self._name(tree)],
            "sum": lambda of: [x for part in of if isinstance(part, Tree) for x in self.terms(part)],
            "signed": lambda of: self.terms(of[-1]),
            "product": self._product,
            "power": self._power,
            "postfix": self._power,
            "rate": self._rate,
            "partial": lambda of: [self._partial(of)],
            "call": self._call,
        }
        if tree.data not in known:
            raise _Unclear
        found = known[tree.data](inner)
        if len(found) > MOST:
            raise _Unclear
        return found

    def _name(self, tree: Tree) -> _Term:
        token, primes = cast("tuple[Token, Token | None]", tree.children)
        base, dots = undotted(token)
        order, weight = len(primes or "") + dots, _weight(base, self.names)
        weight = self.speeds.get(key(base), weight)
        if order and key(base) in self.own:
            slope = primes is not None and not dots and order == 1
            if not slope:
                raise _Unclear
            return _Term((weight or 0) + 1, weight or 0, False, True)
        if not self.names.scope.meanings(token)[0] and weight is None:
            spelled = [k for k, x in spelled_rates(base) if self.names.changes(x)]
            order = order or max(spelled, default=0)
        else:
            order = order or self.names.scope.meanings(token)[1]
        whole = (weight or 0) + order
        known = order > 1 or (order > 0 and key(base) in self.speeds)
        return _Term(whole, whole, known, False, frozenset([key(base)] if whole else []))

    def _product(self, of: list[Node]) -> list[_Term]:
        found, sign = [_Term()], 1
        for part in of:
            if not isinstance(part, Tree):
                sign = -1 if str(part) in ("/", "÷", "∕") else 1
                continue
            factor = self.terms(part)
            if sign < 0 and len({(x.rated, x.sloped) for x in factor}) != 1:
                raise _Unclear
            factor = factor[:1] if sign < 0 else factor
            if len(found) * len(factor) > MOST:
                raise _Unclear
            found, sign = [a.times(b, sign) for a, b in product(found, factor)], 1
        return found

    def _power(self, of: list[Node]) -> list[_Term]:
        base = self.terms(of[0])
        if len(of) == 1:
            return base
        exponent = _whole(of[1:])
        if exponent is None or len({(x.rated, x.sloped) for x in base}) != 1:
            if any(x.rated or x.sloped for x in base):
                raise _Unclear
            return base[:1]
        term = base[0]
        return [_Term(exponent * term.rated, exponent * term.sloped, term.known, term.primed, term.rates)]

    def _rate(self, of: list[Node]) -> list[_Term]:
        inner, order = self.terms(of[0]), int(of[1])
        return [_Term(x.rated + order, x.sloped + order, x.known or x.rated > 0, x.primed, x.rates) for x in inner]

    def _partial(self, of: list[Node]) -> _Term:
        what, by = str(of[0]), self.terms(of[1])
        weight = 2 if what in ("T", "V", "L", "ℒ") else _weight(what, self.names)
        if weight is None or len(by) != 1:
            raise _Unclear
        return _Term(weight - by[0].rated, weight - by[0].sloped, what in ("T", "V", "L", "ℒ"))

    def _call(self, of: list[Node]) -> list[_Term]:
        if any(x.rated or x.sloped for part in of[1:] for x in self.terms(part)):
            raise _Unclear
        return [_Term()]


def _whole(exponent: Sequence[Node]) -> int | None:
    """The number of an exponent; None if it is no whole one."""
    text = "".join(str(x) for part in exponent for x in _leaves(part))
    text = text.translate(RAISED).lstrip("^*")
    return int(text) if len(text) < 4 and text.lstrip("-").isdigit() else None


def _leaves(part: Node) -> Iterator[object]:
    return part.scan_values(bool) if isinstance(part, Tree) else iter([part])


def with_slopes(reader: Meaning) -> bool:
    """Let a reader take the primes of names as slopes where its statement says so, if each of them has one."""
    names = reader.names
    own = names.sloped.get(names.statement, {})
    values = {name: _value(base, name, names) for base, name in own.items()}
    if not own or any(_coordinate_of(x, names) is None for x in values.values()):
        return False
    if any(ENERGY_NAMES.get(name) == "V" and not _is_energy(x, names) for name, x in values.items()):
        return False
    reader.slopes = own
    tell_slopes(own, names)
    return True


def tell_slopes(own: Mapping[str, str], names: Names) -> None:
    """Tell that primes of names were read as slopes."""
    for name in sorted(own.values()):
        names.notes.setdefault(f"{name}' was read as the slope of {name}: only so the terms beside it fit.")


def _value(base: str, name: str, names: Names) -> object:
    """What the answer says that a name is."""
    if base not in names.own:
        names.later(base)
    if base in names.own:
        return names.own[base][1]
    return names.energy(energy_of(name, names.model, lhs=True) or "")


def _is_energy(value: object, names: Names) -> bool:
    """Whether a value has a letter of a stiffness or of a weight, if the system has such letters: V = l θ has none."""
    things = things_with(names.model, "V")
    letters = {key(str(x)) for x in bounded.letters(value)} if isinstance(value, sp.Expr) else set[str]()
    return not things or any(own & letters for own in things)


def _coordinate_of(value: object, names: Names) -> sp.Expr | None:
    """The one coordinate of which a value is a function, perhaps with inputs, and of no rate."""
    if not isinstance(value, sp.Expr):
        return None
    expr = names.model.expand(value)
    within = bounded.atoms(expr, AppliedUndef)
    moving = within & names.moving_symbols
    if bounded.atoms(expr, sp.Derivative) or any(map(is_placeholder, within)) or any(map(names.is_unknown, within)):
        return None
    return next(iter(moving)) if len(moving) == 1 else None
