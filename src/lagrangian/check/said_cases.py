"""In which case, of those that words say, a line follows from the equations of motion: at rest, for θ = 90°, b = 0."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from functools import reduce
from itertools import chain, islice, product
from typing import Any, cast

import sympy as sp

from lagrangian.check.reading.prose.values_said import AT, START, STEADY, STILL
from lagrangian.check.reference import Reference
from lagrangian.check.special_cases import INFINITE, follows
from lagrangian.check.verdict import AnsweredLine
from lagrangian.records import dataclass

MOST = 16
"""The most cases that are tried for a line."""
MOST_TOGETHER = 4
"""The most ways to give several names one of the values that words say."""


@dataclass(frozen=True)
class SaidCase:
    """What words say of a case, and the values of what moves and of constants in it."""

    said: str
    given: Mapping[Any, sp.Expr]

    def and_as(self, other: SaidCase) -> SaidCase:
        """Both at once; values of this one count."""
        return SaidCase(f"{self.said}, {other.said.removeprefix('for ')}", {**other.given, **self.given})


def where_it_holds(truth: Reference, line: AnsweredLine) -> str | None:
    """In which case that words say beside a line the line follows from the equations of motion; None if in none."""
    cases = islice((x for x in _cases(truth, line.near) if not _holds_gone(line.expr, x)), MOST)
    return next((case.said for case in cases if follows(truth, line.expr, case.given)), None)


def values_near(truth: Reference, near: Collection[str]) -> list[SaidCase]:
    """The cases of one value each that words say near a line, in an order that does not depend on that of sets."""
    model = truth.model
    named = {x.name: x for x in (*model.coordinates, *model.parameters, *model.inputs)}
    return [_value(named, x) for x in sorted(near) if x.startswith(AT) and _is_known(named, x)]


def _is_known(named: Collection[str], said: str) -> bool:
    """Whether a value that words say is one of a name, and in names, of the system as it is described: not of θ where
    an answer has γ in its place."""
    left, _, right = said.removeprefix(AT).partition(" = ")
    value = right.removeprefix("-")
    return left.rstrip("'") in named and (value in named or value[:1].isdigit() or value.startswith("oo"))


def _holds_gone(expr: sp.Expr, case: SaidCase) -> bool:
    """Whether an expression holds what is 0 in a case: then it is about another."""
    bare = expr.xreplace({x: sp.Dummy() for x in expr.atoms(sp.Derivative) if x not in case.given})
    return any(value == 0 and bare.has(x) for x, value in case.given.items())


def _cases(truth: Reference, near: Collection[str]) -> Iterator[SaidCase]:
    """The cases of which words speak: each value that they say, all of them, and these with how the system moves."""
    values = values_near(truth, near)
    choices: dict[Any, list[SaidCase]] = {}
    for case in values:
        choices.setdefault(next(iter(case.given)), []).append(case)
    whole = [reduce(SaidCase.and_as, x) for x in islice(product(*choices.values()), MOST_TOGETHER) if x]
    alone = values if len(choices) > 1 else []
    kinds = [kind for cue, kind in _kinds(truth).items() if cue in near]
    yield from chain(alone, kinds, whole, (x.and_as(kind) for kind in kinds for x in (*alone, *whole)))


def _kinds(truth: Reference) -> dict[str, SaidCase]:
    """The motions that words may speak of."""
    rates = {c.rate: cast("sp.Expr", sp.S.Zero) for c in truth.model.coordinates}
    accelerations = {c.acceleration: cast("sp.Expr", sp.S.Zero) for c in truth.model.coordinates}
    return {
        STILL: SaidCase("at rest", rates | accelerations),
        STEADY: SaidCase("at constant rates", accelerations),
        START: SaidCase("at a start from rest", rates),
    }


def _value(named: Mapping[str, Any], said: str) -> SaidCase:
    """The case of one value: at theta'' = 0."""
    left, _, right = said.removeprefix(AT).partition(" = ")
    name = left.rstrip("'")
    own, order = named[name], len(left) - len(name)
    symbol = own.symbol if not order else own.rate if order == 1 else own.acceleration
    return SaidCase(f"for {left} = {_shown(right)}", {symbol: _number(right, named)})


def _shown(value: str) -> str:
    """A value as words say it: 90°, pi/2."""
    return (
        f"{value.removesuffix('*pi/180')}°"
        if value.endswith("*pi/180")
        else value.replace("1*pi", "pi").removesuffix("/1")
    )


def _number(written: str, named: Mapping[str, Any]) -> sp.Expr:
    """A value such as 90*pi/180, -1*pi/2, 0.5, a name, or infinity, as a large number."""
    sign, bare = (-1, written[1:]) if written.startswith("-") else (1, written)
    if bare in named:
        return cast("sp.Expr", sign * named[bare].symbol)
    factor, _, divisor = bare.partition("*pi/")
    size = INFINITE if factor == "oo" else sp.Rational(factor)
    return cast("sp.Expr", sign * size * (sp.pi / int(divisor) if divisor else 1))
