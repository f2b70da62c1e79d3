"""The names of an answer that is read with marks in the values that it gives them; see `marked_values`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.line_forms import Statement
from lagrangian.check.reading.marked_values import Marks, is_formula
from lagrangian.check.reading.names import Names, Value
from lagrangian.model import Model


class MarkedNames(Names):
    """Names whose values are marked; ``statements`` are those of the answer."""

    def __init__(self, model: Model, marks: Marks) -> None:
        super().__init__(model)
        self.marks, self.statements = marks, list[Statement]()
        self.derivatives = _Derivatives(marks)

    def define(self, written: str, value: Value) -> None:
        """Give a name of the answer its meaning, marked."""
        source = self.statements[self.statement].source if self.statement < len(self.statements) else None
        line = 0 if source is None else source.at(len(source.text)).line or 0
        if isinstance(value, MatrixBase) and any(map(is_formula, value.flat())):
            value = sp.ImmutableMatrix(self.marks.matrix(value, str(written), line))
        elif not isinstance(value, MatrixBase) and is_formula(value):
            value = self.marks.marked(value, str(written), line)
        super().define(written, value)


class _Derivatives(dict[tuple[Any, sp.Expr], Any]):
    """The derivatives that an answer takes; the marks in what is differentiated are lost."""

    def __init__(self, marks: Marks) -> None:
        super().__init__()
        self.marks = marks

    def __setitem__(self, of: tuple[Any, sp.Expr], value: Any) -> None:
        self.marks.lose([of[0]])
        super().__setitem__(of, value)


def begin(names: Names, statements: Sequence[Statement]) -> None:
    """Tell marked names the statements in which they are given their values."""
    if isinstance(names, MarkedNames):
        names.statements = list(statements)
