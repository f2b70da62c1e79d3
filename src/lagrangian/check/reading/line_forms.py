"""What the values of statements are: general, accelerating, rows of a matrix equation; and several errors as one."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy as sp
from lark import Tree
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.check.reading.answer import AnswerLine, Kind
from lagrangian.check.reading.meaning import Meaning
from lagrangian.check.reading.names import Value
from lagrangian.check.reading.nodes import start_of
from lagrangian.check.reading.placeholders import is_force, is_placeholder
from lagrangian.errors import ParseError
from lagrangian.quantities.source import Source
from lagrangian.records import dataclass


@dataclass(frozen=True)
class Statement:
    """The syntax trees between the equals signs of a statement, its text, and whether that is a line of words."""

    sides: tuple[Tree, ...]
    source: Source
    remark: Callable[[], bool] = bool


def together(errors: Sequence[ParseError]) -> ParseError:
    """Return one error for several places, in their order; one at the same place counts once."""
    placed = {(e.place.line or 0, e.place.column or 0) if e.place is not None else (0, 0): e for e in reversed(errors)}
    first, *others = [placed[at] for at in sorted(placed)]
    return first.with_others(others)


def is_general(value: sp.Expr) -> bool:
    """Whether an expression contains energies or variations that have no value."""
    return any(is_placeholder(x) and not is_force(x) for x in value.atoms(AppliedUndef))


def accelerates(value: sp.Expr) -> bool:
    """Whether an expression contains an acceleration."""
    return any(d.derivative_count > 1 for d in value.atoms(sp.Derivative))


def solves(rate: sp.Expr, value: sp.Expr) -> bool:
    """Whether the rate of a name of the answer equals something else than its derivative: omega' = -g/L*sin(theta).

    The name is a rate up to a constant, or the value contains no acceleration.
    """
    if not accelerates(rate) or bounded.expand(rate - value) == 0:
        return False
    alone = rate / next(d for d in rate.atoms(sp.Derivative) if d.derivative_count > 1)
    return not accelerates(value) or not alone.atoms(AppliedUndef)


def matrix_rows(left: Value, right: Value, node: Tree, reader: Meaning) -> list[tuple[sp.Expr, sp.Expr]]:
    """The equations of a matrix equation, row by row; a plain 0 is a column of zeros."""
    shape = left.shape if isinstance(left, MatrixBase) else right.shape
    both = []
    for value in (left, right):
        if not isinstance(value, MatrixBase):
            if value != 0:
                reader.fail("a matrix equals a number", node, fix="write a column [a; b] on both sides")
            value = sp.zeros(*shape)
        both.append(value)
    if both[0].shape != both[1].shape:
        a, b = (f"{s[0]} × {s[1]}" for s in (both[0].shape, both[1].shape))
        reader.fail(f"the left side is {a}, the right side {b}", node, fix="give both sides the same number of rows")
    return list(zip(both[0], both[1], strict=True))


def made_line(
    kind: Kind, lhs: sp.Expr | None, rhs: sp.Expr, name: str | None, a: Tree, b: Tree, reader: Meaning
) -> AnswerLine:
    """Make the line; its place is that of its first side."""
    source = reader.source
    start = min(start_of(a), start_of(b))
    return AnswerLine(kind, lhs, rhs, name, source.at(start), " ".join(source.text.split()))
