"""Answers for friction that slips, pressed by several rows: √(X² + Y²) of an answer's own multipliers.

With X = s₁ c λ₁ and Y = s₂ c λ₂, where s₁, s₂ = ±1 and c > 0 are the answer's choice, and N = √(λ₁² + λ₂²),

    √(X² + Y²) = s₁ (λ₁/N) X + s₂ (λ₂/N) Y,

which is linear in the answer's multipliers, as all other terms are. So each size in an answer is replaced by this sum,
for both signs and any order of the rows; the rest is judged as always, and the multipliers that are found must have
these signs. |X| is the same with one row, whose N is ±λ on the side that is known.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice, permutations, product
from typing import TypeAlias, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import Friction, Model
from lagrangian.model.rows import rows_of
from lagrangian.records import dataclass

Group: TypeAlias = tuple[str, ...]

MOST_READINGS = 64
"""The largest number of readings of an answer."""

NEAR = 1e-6
"""The relative difference below which a size is what it was read as."""


def _groups(model: Model) -> dict[Group, float]:
    """The rows that press together on frictions that slip in a known sense, with the side of one row, else 0."""
    frictions = [e for e in model.elements if isinstance(e, Friction) and e.sense is not None and e.pressing]
    return {f.pressing: 0.0 if f.side is None else float(cast("sp.Expr", f.side)) for f in frictions}


def directions(model: Model, multipliers: Sequence[float]) -> dict[sp.Basic, float]:
    """λ_i/N of every row that presses, by the symbol that stands for it, from all multipliers."""
    found: dict[sp.Basic, float] = {}
    for group, side in _groups(model).items():
        lam = _of(model, multipliers, group)
        size = float(np.linalg.norm(lam))
        for row, x in zip(group, lam, strict=True):
            found[_direction(group, row)] = side or (x / size if size else 0.0)
    return found


def _of(model: Model, multipliers: Sequence[float], group: Group) -> list[float]:
    known = {row.name: float(x) for row, x in zip(rows_of(model), multipliers, strict=True)}
    return [known[row] for row in group]


def _direction(group: Group, row: str) -> sp.Symbol:
    return sp.Symbol(f"{row} of |{', '.join(group)}|", real=True)


def direction_symbols(model: Model) -> set[sp.Basic]:
    """The symbols that stand for λ_i/N."""
    return {_direction(group, row) for group in _groups(model) for row in group}


@dataclass(frozen=True, eq=False)
class SizeReading:
    """An answer in which the sizes of its multipliers are written linearly: size → the sum, and the rows."""

    model: Model
    lines: Sequence[AnsweredLine]
    sizes: Mapping[sp.Expr, tuple[sp.Expr, Group]]

    def fits(self, own: Mapping[sp.Basic, float], multipliers: Sequence[float]) -> bool:
        """Whether the sizes are what they were read as: the answer's multipliers at a state, beside the system's."""
        values = {**own, **directions(self.model, multipliers)}
        sides = _groups(self.model)
        for size, (linear, group) in self.sizes.items():
            beyond = sides[group] * _of(self.model, multipliers, group)[0] < 0  # the state is not on the known side
            found, meant = (_number(e, values) for e in (linear, -size if beyond else size))
            if abs(found - meant) > NEAR * (1.0 + abs(meant)):
                return False
        return True


def _number(expr: sp.Expr, values: Mapping[sp.Basic, float]) -> complex:
    return complex(cast("sp.Expr", expr.xreplace(values)).evalf())


def readings(model: Model, lines: Sequence[AnsweredLine]) -> Iterator[SizeReading]:
    """The answer with sizes of its multipliers written linearly, in all ways; none where it has no such sizes."""
    known: set[sp.Basic] = {x.symbol for x in (*model.parameters, *model.coordinates, *model.inputs)}
    sizes = sorted({s for line in lines for s in _sizes(line.expr, known)}, key=sp.default_sort_key)
    if not sizes:
        return
    ways = [[(way, group) for group in _groups(model) for way in _ways(group, _letters(size))] for size in sizes]
    for chosen in islice(product(*ways), MOST_READINGS):
        read = dict(zip(sizes, chosen, strict=True))
        table = {size: way for size, (way, _) in read.items()}
        made = [replace(line, expr=cast("sp.Expr", line.expr.xreplace(table))) for line in lines]
        yield SizeReading(model, made, read)


def _sizes(expr: sp.Expr, known: set[sp.Basic]) -> Iterator[sp.Expr]:
    """|X| and √(X² + Y² + …) of names that are not the system's."""
    found: list[tuple[sp.Expr, sp.Expr]] = [(size, size.args[0] ** 2) for size in expr.atoms(sp.Abs)]
    found += [(power, power.base) for power in expr.atoms(sp.Pow) if power.exp == sp.S.Half]
    for size, squares in found:
        letters = _letters(size)
        if letters and not known & set(letters) and squares == sp.Add(*(x**2 for x in letters)):
            yield size


def _letters(size: sp.Expr) -> list[sp.Expr]:
    letters = bounded.letters(size) - {sp.Symbol("t")}
    return cast("list[sp.Expr]", sorted(letters, key=str))


def _ways(group: Group, letters: Sequence[sp.Expr]) -> Iterator[sp.Expr]:
    """The size of the letters as a sum of these, if they are multipliers of the group's rows."""
    if len(letters) != len(group):
        return
    for order in permutations(group):
        for signs in product((1, -1), repeat=len(group)):
            terms = zip(signs, order, letters, strict=True)
            yield sp.Add(*(sign * _direction(group, row) * letter for sign, row, letter in terms))
