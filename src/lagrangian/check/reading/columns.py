"""What is computed with rows and columns that an answer gives by their entries: their length, their products."""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.matrices.matrixbase import MatrixBase


def crossed(one: MatrixBase, other: MatrixBase) -> Any:
    """The cross product of two columns of three, or the component out of the plane of two in it."""
    return one.cross(other) if len(one) == 3 else one[0] * other[1] - one[1] * other[0]


def square(column: MatrixBase) -> sp.Expr:
    """The sum of the squares of the components."""
    return sp.Add(*[x**2 for x in column.flat()])


def is_transposed(one: Any, other: Any) -> bool:
    """Whether one is a row and the other a column, of as many entries."""
    shapes = [x.shape for x in (one, other) if isinstance(x, MatrixBase)]
    return len(shapes) == 2 and 1 in shapes[0] and shapes[0] == shapes[1][::-1] != shapes[1]


def shown_shape(shape: Any) -> str:
    """How many rows and columns a matrix has, or that it is none, in words."""
    return shape if isinstance(shape, str) else f"a matrix of {shape[0]} × {shape[1]}"
