"""Names that only one side of a chain of equal energies has, and linearly: the chain says what they are.

T = ½ (J + m a² sin²θ) θ'² = ½ I(θ) θ'²;  I θ'' + …        I is what makes the sides equal, J + m a² sin²θ
T = ½ m x'² + ½ J x'²/r² = ½ m_eff x'²;  m_eff x'' = …      and so is m_eff, m + J/r²
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise

import sympy as sp
from lark import Token, Tree
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading.meaning import Meaning
from lagrangian.check.reading.names import Names, Value, spelled_rates
from lagrangian.check.reading.nodes import Node, has_matrix, names_in, only_name
from lagrangian.check.reading.subject import Subject
from lagrangian.errors import ParseError
from lagrangian.read.letters import key, undotted

_PART = re.compile(r"(?:[TVUK]|E_?\{?(?:k|p)\w*)[_,*]*\{?\w{0,40}\}*")
"""The name of an energy, or of a part of one: T_cart."""
_DIVIDES = ("/", "÷", "∕")


def given_by_chains(turned: Mapping[int, tuple[Subject | None, Sequence[Tree]]], names: Names) -> dict[str, int]:
    """Record the names that chains of energies give, and return their keys with the numbers of the statements.

    The statements are given by what each is about and its sides, the name of the energy first. A name that the last
    side has may stand nowhere else; another must be used in other statements.
    """
    found: dict[str, int] = {}
    for i, (subject, sides) in turned.items():
        if subject is None or len(sides) < 3 or not _is_energy(subject) or any(map(has_matrix, sides)):
            continue
        new = [{key(undotted(x)[0]): (x, changes) for x, changes in _new_in(side, names)} for side in sides[1:]]
        held = [(k, *of) for k, own in enumerate(new) for of in own.items()]
        if len(held) != 1 or only_name(sides[held[0][0] + 1]) is not None:
            continue
        ((k, base, (token, changes)),) = held
        if changes or base in found or not _is_factor(base, sides[k + 1]):
            continue
        if k == len(new) - 1 or names.occurs(token) > 1:
            names.chained[i], found[base] = (token, k), i
    names.defined.update(found)
    return found


def _is_energy(subject: Subject) -> bool:
    if subject.kind in ("T", "V"):
        return True
    plain = subject.kind == "definition" and not subject.order and not subject.inverse
    return plain and _PART.fullmatch(str(subject.token)) is not None


def _new_in(side: Tree, names: Names) -> Iterator[tuple[Token, bool]]:
    """The names in a side that neither the system has nor a statement explains, and whether each has a rate there."""
    for token, changes in names_in(side):
        base, dots = undotted(token)
        rated = any(names.known(stem) or key(stem) in names.defined for _, stem in spelled_rates(token))
        if not rated and not names.known(token) and key(base) not in names.defined | names.implied.keys():
            yield token, changes or bool(dots)


def _is_factor(base: str, side: Node) -> bool:
    """Whether a name stands in a side as a factor of a term, in no power, denominator or function."""
    if not isinstance(side, Tree):
        return False
    inner = [x for x in side.children if x is not None]
    if side.data == "name":
        return key(undotted(str(inner[0]))[0]) == base and len(inner) == 1
    if side.data in ("power", "postfix"):
        return len(inner) == 1 and _is_factor(base, inner[0])
    above = (x for before, x in pairwise(("*", *inner)) if str(before) not in _DIVIDES)
    return side.data in ("sum", "product", "signed") and any(_is_factor(base, x) for x in above)


def define_chained(sides: Sequence[Tree], reader: Meaning) -> None:
    """Give the name of a chain its meaning, from the values between the equals signs, before these are read."""
    names = reader.names
    token, at = names.chained.get(names.statement, (None, 0))
    if token is None or len(sides) < 2 or at >= len(sides):
        return
    base = key(undotted(token)[0])
    others = [side for k, side in enumerate(sides) if k != at]
    if base in names.own:
        return
    for name, _ in names_in(sides[at]):
        if key(undotted(name)[0]) != base and not names.is_own(name):
            names.later(key(undotted(name)[0]))
    try:
        value = reader.value(others[-1])
        put = [_with(token, number, sides[at], reader) for number in (0, 1, 2)]
    except ParseError:
        return
    if not isinstance(value, sp.Expr) or not all(isinstance(x, sp.Expr) for x in put):
        return
    rest, factor, other = put[0], put[1] - put[0], put[2] - put[1]
    if not bounded.is_zero(factor) and bounded.expand(factor - other) == 0:
        found = _quotient(value - rest, factor)
        if found is not None and not any(map(names.is_unknown, bounded.letters(found))):
            names.define(token, found)


def _with(token: Token, number: int, side: Tree, reader: Meaning) -> Value:
    """The value of a side where the name has this one."""
    names = reader.names
    with names.redefined.unrecorded():
        names.own[key(undotted(token)[0])] = (str(token), sp.Integer(number))
        try:
            return Meaning(reader.source, names, reader.budget, "T" if reader.energy else None).value(side)
        finally:
            del names.own[key(undotted(token)[0])]


def _quotient(whole: sp.Expr, factor: sp.Expr) -> sp.Expr | None:
    """A quotient in which no rate is left and nothing that moves in the factor divides; None if it has none."""
    moving = bounded.atoms(factor, *_MOVING)
    expanded = bounded.expand(factor)
    forms: list[Callable[[], sp.Expr]] = [
        lambda: whole / factor,
        lambda: sp.Add(*[x / factor for x in sp.Add.make_args(whole)]),
        lambda: sp.Add(*[x / expanded for x in sp.Add.make_args(bounded.expand(whole))]),
        lambda: bounded.cancel(whole / factor),
    ]
    for form in forms:
        found = form()
        below = {x for p in found.atoms(sp.Pow) if p.exp.is_negative for x in bounded.atoms(p.base, *_MOVING)}
        if not bounded.atoms(found, sp.Derivative) and not below & moving:
            return found
    return None


_MOVING = (AppliedUndef, sp.Derivative)
