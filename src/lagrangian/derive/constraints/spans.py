"""Ranks of vectors of nodes at a generic point: exact in a prime field, or with 50 digits and a gap."""

# mpmath has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownVariableType=false
# pyright: reportUnknownArgumentType=false

from __future__ import annotations

import random
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, TypeVar

import mpmath

from lagrangian.derive.constraints.pfaffian import Sheet
from lagrangian.graph import NotAlgebraic, Output, PrimePoint, Program, evaluate, reached
from lagrangian.graph.prime_field import Echelon

T = TypeVar("T")

DIGITS = 50
"""The number of decimal digits if exact computation is impossible."""

SAME, OTHER = mpmath.mpf(10) ** -35, mpmath.mpf(10) ** -10
"""Bounds on the remainder of a unit vector: below the first it is dependent, above the second independent.

Between the two nothing is decided.
"""


class OutsideError(Exception):
    """The rows contain an operation that cannot be decided exactly."""


class UnclearError(Exception):
    """Even 50 digits do not decide whether a vector depends on others."""


class GenericPoint(ABC):
    """A generic point, at which vectors of nodes are compared."""

    exact: bool

    @abstractmethod
    def span(self) -> Span:
        """Return an empty span."""

    @abstractmethod
    def renew(self) -> None:
        """Draw another point, if the kind of point needs it."""

    @abstractmethod
    def nonzero(self, ids: Sequence[int]) -> list[bool]:
        """Return which nodes are not zero."""


class Span(ABC):
    """The span of vectors that are taken one after the other."""

    @abstractmethod
    def take(self, name: int, ids: Sequence[int]) -> bool:
        """Keep a vector under a name if it is independent of those kept before; return whether it is."""

    @abstractmethod
    def made_of(self, ids: Sequence[int]) -> list[int] | None:
        """Return the names of the kept vectors of which a vector is a combination; None if it is independent."""

    @abstractmethod
    def __len__(self) -> int:
        """Return the rank."""


class ExactPlace(GenericPoint):
    """A point of a prime field. Raises `OutsideError` if the graph has an operation that a field does not have."""

    exact = True

    def __init__(self, sheet: Sheet) -> None:
        self._point = PrimePoint(sheet.graph, sheet.numbers, sheet.pi)

    @property
    def draws(self) -> int:
        """The number of times that the point was drawn again; earlier values are then useless."""
        return self._point.draws

    @property
    def prime(self) -> int:
        """The prime of the field."""
        return self._point.prime

    def values(self, ids: Sequence[int]) -> list[int]:
        """Return the values of nodes."""
        found = self._point.values(ids)
        if isinstance(found, NotAlgebraic):
            raise OutsideError(found.operation)
        return found

    def renew(self) -> None:
        """Do nothing: this point is generic."""

    def nonzero(self, ids: Sequence[int]) -> list[bool]:
        """Return which nodes are not 0."""
        return [x != 0 for x in self.values(ids)]

    def span(self) -> Span:
        """Return an empty span."""
        return _ExactSpan(self)


class _ExactSpan(Span):
    def __init__(self, place: ExactPlace) -> None:
        self._place, self._kept = place, dict[int, list[int]]()
        self._echelon, self._draws = Echelon(place.prime), place.draws

    def __len__(self) -> int:
        return len(self._kept)

    def take(self, name: int, ids: Sequence[int]) -> bool:
        row = self._row(ids)
        if not self._echelon.take(name, row):
            return False
        self._kept[name] = list(ids)
        return True

    def made_of(self, ids: Sequence[int]) -> list[int] | None:
        left, lost = self._echelon.reduce(self._row(ids))
        return None if any(left) else sorted(lost)

    def _row(self, ids: Sequence[int]) -> list[int]:
        row = self._place.values(ids)
        while self._draws != self._place.draws:  # another point: what was kept is looked at again there
            self._draws = self._place.draws
            rows = {name: self._place.values(kept) for name, kept in self._kept.items()}
            self._echelon = Echelon(self._place.prime)
            for name, kept in rows.items():
                self._echelon.take(name, kept)
            row = self._place.values(ids)
        return row


class FloatPlace(GenericPoint):
    """A point with random real coordinates of 50 digits.

    ``smallest`` is the smallest remainder of an independent unit vector, ``largest`` the largest of a dependent one.
    The answer relies on the gap between them.
    """

    exact = False

    def __init__(self, sheet: Sheet, *, seed: int = 0, tries: int = 40) -> None:
        self._sheet, self._tries, self._draw = sheet, tries, random.Random(f"side {seed}")
        self._inputs: dict[int, Any] = {}
        self._negative = 0.5
        self.smallest, self.largest = mpmath.mpf(1), mpmath.mpf(0)

    def values(self, ids: Sequence[int]) -> list[Any]:
        """Return the values of nodes; another point is drawn if they are not finite."""
        for k in range(self._tries):
            found = self._at(ids)
            if all(mpmath.isfinite(x) for x in found):
                return found
            self._negative = 0.5 if k % 2 else 0.0  # roots and logarithms may want what is positive
            self._inputs = {}
        self._negative = 0.5
        raise UnclearError("no point was found at which the rows have finite values")

    def renew(self) -> None:
        """Forget the point."""
        self._inputs = {}

    def _at(self, ids: Sequence[int]) -> list[Any]:
        sheet = self._sheet
        wanted = list(ids)
        inputs = [i for i in reached(sheet.graph, wanted) if sheet.graph.nodes[i][0] == "input"]
        with mpmath.workdps(DIGITS):
            for i in inputs:
                if i not in self._inputs:
                    self._inputs[i] = self._value(i)
            return evaluated(sheet, wanted, {i: self._inputs[i] for i in inputs})

    def _value(self, i: int) -> Any:
        if i in self._sheet.numbers:
            number = self._sheet.numbers[i]
            return mpmath.mpf(number.numerator) / number.denominator
        if i == self._sheet.pi:
            return +mpmath.pi
        size = mpmath.mpf(self._draw.randrange(10**DIGITS)) / 10**DIGITS + mpmath.mpf("0.2")
        return -size if self._draw.random() < self._negative else size

    def nonzero(self, ids: Sequence[int]) -> list[bool]:
        """Return which nodes are not 0, compared with the largest."""
        found = self.values(ids)
        most = max([abs(x) for x in found], default=mpmath.mpf(0))
        return [self.told(abs(x) / most) if most else False for x in found]

    def span(self) -> Span:
        """Return an empty span."""
        return _FloatSpan(self)

    def told(self, left: Any) -> bool:
        """Return whether the remainder of a unit vector is not zero, and record the gap."""
        if left > OTHER:
            self.smallest = min(self.smallest, left)
            return True
        if left < SAME:
            self.largest = max(self.largest, left)
            return False
        raise UnclearError(f"a vector that depends on others but for {mpmath.nstr(left, 2)} of its length")


class _FloatSpan(Span):
    def __init__(self, place: FloatPlace) -> None:
        self._place, self._kept = place, dict[int, list[int]]()

    def __len__(self) -> int:
        return len(self._kept)

    def take(self, name: int, ids: Sequence[int]) -> bool:
        if self.made_of(ids) is not None:
            return False
        self._kept[name] = list(ids)
        return True

    def made_of(self, ids: Sequence[int]) -> list[int] | None:
        together = [*self._kept.values(), list(ids)]
        width = len(ids)
        flat = self._place.values([i for row in together for i in row])
        with mpmath.workdps(DIGITS):
            units = [_unit(flat[k * width : (k + 1) * width]) for k in range(len(together))]
            new, rows = units[-1], [row for row in units[:-1] if row is not None]
            if len(rows) < len(self._kept):
                raise UnclearError("a row vanishes in a part of the configurations")
            if new is None:
                return []
            lost: list[Any] = []
            if rows:
                columns = mpmath.matrix([list(column) for column in zip(*rows, strict=True)])
                lost = list(mpmath.lu_solve(columns, mpmath.matrix(new)))
                new = [x - sum(c * row[k] for c, row in zip(lost, rows, strict=True)) for k, x in enumerate(new)]
            if self._place.told(mpmath.norm(new)):
                return None
        return [name for name, share in zip(self._kept, lost, strict=True) if abs(share) > OTHER]


def _unit(row: list[Any]) -> list[Any] | None:
    size = mpmath.norm(row)
    return None if size == 0 else [x / size for x in row]


def evaluated(sheet: Sheet, ids: Sequence[int], values: Mapping[int, Any]) -> list[Any]:
    """Return nodes with 50 digits, given the values of the input nodes."""
    program, groups = asked(sheet, ids, values, mpmath.mpf(0))
    return [mpmath.mpf(x) for x in evaluate(program, groups, digits=DIGITS)["x"]]


def asked(sheet: Sheet, ids: Sequence[int], values: Mapping[int, T], nothing: T) -> tuple[Program, dict[str, list[T]]]:
    """Return the program whose output ``x`` are nodes, and its inputs; ``nothing`` stands for those without a value."""
    groups: dict[str, list[T]] = {}
    for i, value in values.items():
        _, group, k = sheet.graph.nodes[i]
        entries = groups.setdefault(group, [])
        entries += [nothing] * (k + 1 - len(entries))
        entries[k] = value
    names = {group: tuple(f"{group}{k}" for k in range(len(e))) for group, e in groups.items()}
    key = (tuple(ids), tuple(names.items()))
    if key not in sheet.programs:
        sheet.programs[key] = Program("rows", sheet.graph, names, {"x": Output(tuple(ids), (len(ids),))})
    return sheet.programs[key], groups
