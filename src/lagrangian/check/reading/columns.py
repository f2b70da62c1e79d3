"""What is computed with matrices that an answer gives by their entries: length, products, determinant, inverse."""

from __future__ import annotations

from typing import Any, cast

import sympy as sp
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded


def crossed(one: MatrixBase, other: MatrixBase) -> Any:
    """The cross product of two columns of three, or the component out of the plane of two in it."""
    return one.cross(other) if len(one) == 3 else one[0] * other[1] - one[1] * other[0]


def square(column: MatrixBase) -> sp.Expr:
    """The sum of the squares of the components."""
    return sp.Add(*[x**2 for x in column.flat()])


MOST_ROWS = 3
"""The most rows of a matrix of which the determinant and the inverse are computed."""


def is_square(value: Any) -> bool:
    """Whether a value is a square matrix whose determinant is computed."""
    return isinstance(value, MatrixBase) and 1 < value.shape[0] == value.shape[1] <= MOST_ROWS


def inverse(matrix: MatrixBase) -> MatrixBase | None:
    """The inverse of a square matrix; None if its determinant is 0."""
    below = bounded.expand(cast("sp.Expr", matrix.det()))
    return None if below == 0 else matrix.adjugate() / below


def is_transposed(one: Any, other: Any) -> bool:
    """Whether one is a row and the other a column, of as many entries."""
    shapes = [x.shape for x in (one, other) if isinstance(x, MatrixBase)]
    return len(shapes) == 2 and 1 in shapes[0] and shapes[0] == shapes[1][::-1] != shapes[1]


def shown_shape(shape: Any) -> str:
    """How many rows and columns a matrix has, or that it is none, in words."""
    return shape if isinstance(shape, str) else f"a matrix of {shape[0]} × {shape[1]}"
