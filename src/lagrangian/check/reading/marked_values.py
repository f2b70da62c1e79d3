"""Marks in the values that an answer gives to names of its own, with which it is read once more: where a mark appears
in an equation, the value stands there.

A value v becomes k v + d: at k = 1 and d = 0 nothing has changed, and the slope of an equation by k is what it has of
v.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeAlias, TypeVar

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.records import dataclass

MOST_MARKS = 80
"""The most values that are marked."""
SCALE, ADDED = "wk_", "wd_"
"""The beginnings of the names of k and d."""
T = TypeVar("T")
Place: TypeAlias = tuple[int, int]


@dataclass(frozen=True, eq=False)
class MarkedValue:
    """A value that is marked: its name, the line on which it stands, its row and column in a matrix, and k and d."""

    name: str
    line: int
    text: str
    at: Place | None
    scale: sp.Symbol
    added: sp.Symbol


class Marks:
    """The marks of one answer, in the order in which it gives names their values."""

    def __init__(self, text: str) -> None:
        self.lines = text.split("\n")
        self.values: list[MarkedValue] = []
        self.lost: set[sp.Basic] = set()
        """The marks of values that are differentiated: what these add to an equation is not proportional to them."""

    @property
    def plain(self) -> dict[Any, Any]:
        """Every mark, with what it is where nothing is changed."""
        return {x.scale: sp.S.One for x in self.values} | {x.added: sp.S.Zero for x in self.values}

    def marked(self, value: sp.Expr, name: str, line: int, at: Place | None = None, rows: int = 1) -> sp.Expr:
        """A value with its marks; ``line`` is the last line of its statement, ``rows`` are those of its matrix."""
        if len(self.values) >= MOST_MARKS:
            return value
        count = len(self.values)
        scale, added = sp.Symbol(f"{SCALE}{count}"), sp.Symbol(f"{ADDED}{count}")
        number = self._line(name, line, at, rows)
        text = self.lines[number - 1].strip() if 0 < number <= len(self.lines) else name
        self.values.append(MarkedValue(name, number, text, at, scale, added))
        return scale * value + added

    def matrix(self, value: MatrixBase, name: str, line: int) -> MatrixBase:
        """A matrix with marks in its entries."""
        rows, columns = value.shape
        made = [self.marked(value[i, j], name, line, (i, j), rows) for i in range(rows) for j in range(columns)]
        return sp.Matrix(rows, columns, made)

    def lose(self, values: Iterable[Any]) -> None:
        """Count the marks in some values as lost."""
        for value in values:
            self.lost |= {x for part in _parts(value) for x in part.free_symbols if str(x).startswith((SCALE, ADDED))}

    def _line(self, name: str, last: int, at: Place | None, rows: int) -> int:
        """The line on which an entry stands: that of its row, if every row has one."""
        begins = re.compile(rf"[ \t]*+{re.escape(name)}[ \t]*+=")
        before = range(min(last, len(self.lines)), max(last - 2 * rows - 2, 0), -1)
        first = next((k for k in before if begins.match(self.lines[k - 1])), last) if at is not None else last
        return first + at[0] if at is not None and last - first + 1 == rows else first


def with_marks(text: str, read: Callable[[Marks], T]) -> tuple[T, Marks]:
    """What ``read`` makes of an answer with marks, and these."""
    marks = Marks(text)
    return read(marks), marks


def is_formula(value: Any) -> bool:
    """Whether a value is a single quantity, and no name."""
    named = isinstance(value, (AppliedUndef, sp.Derivative, MatrixBase))
    return isinstance(value, sp.Expr) and bool(value.args) and not named


def _parts(value: Any) -> Iterator[sp.Expr]:
    if isinstance(value, sp.Expr):
        yield value
    elif isinstance(value, (list, tuple, MatrixBase)):
        for x in value:
            yield from _parts(x)
