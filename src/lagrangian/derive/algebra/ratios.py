"""Quotients of normal forms, and the inverse of a small mass matrix with such entries, in textbook form."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Algebra, Form, OutOfReach
from lagrangian.derive.algebra.form import Ring
from lagrangian.records import dataclass

MAX_INVERSE_ROWS = 4
"""The inverse of a block of M is written out up to this number of rows."""

TERMS = 3000
"""A determinant is written out up to this number of terms."""


@dataclass(frozen=True, eq=False)
class FormRatio:
    """over / under, in normal form."""

    over: Form
    under: Form

    def expr(self) -> sp.Expr:
        """The quotient in textbook form, after cancelling common factors."""
        return written(self.over.expr() / self.under.expr(), self.over.algebra)


def written(expr: sp.Expr, algebra: Ring) -> sp.Expr:
    """A quotient after cancelling common factors, with readable numerator and denominator."""
    if expr == 0:
        return sp.S.Zero
    over, under = sp.fraction(bounded.cancel(bounded.together(expr)))
    lower = algebra.form(under).expr()
    upper = algebra.form(over).expr()
    number, lower = lower.as_coeff_Mul()
    return upper / number / lower


def blocks(matrix: Sequence[Sequence[Form]]) -> list[list[int]]:
    """The rows of a symmetric matrix that are coupled by nonzero entries."""
    n = len(matrix)
    left = list(range(n))
    found: list[list[int]] = []
    while left:
        block: list[int] = []
        fresh = [left[0]]
        while fresh:
            i = fresh.pop()
            if i in block:
                continue
            block.append(i)
            fresh += [j for j in left if j not in block and not matrix[i][j].is_zero]
        found.append(sorted(block))
        left = [i for i in left if i not in block]
    return found


def determinant(matrix: Sequence[Sequence[Form]], algebra: Algebra) -> Form:
    """The determinant, by expansion along the first row."""
    if not matrix:
        return algebra.number(1)
    terms: list[Form] = []
    for j, entry in enumerate(matrix[0]):
        if not entry.parts:
            continue
        minor = determinant([[*row[:j], *row[j + 1 :]] for row in matrix[1:]], algebra)
        terms.append(entry * minor if j % 2 == 0 else -(entry * minor))
    total = algebra.total(terms)
    if total.size > TERMS:
        raise OutOfReach(f"a determinant of {total.size} terms is too long to write out")
    return total


def inverse(matrix: Sequence[Sequence[Form]], algebra: Algebra) -> list[list[FormRatio]]:
    """The inverse of a symmetric matrix, block by block: adjugate over determinant.

    Raises `OutOfReach` if a block has more than `MAX_INVERSE_ROWS` rows or its determinant has too many terms.
    """
    n = len(matrix)
    one, zero = algebra.number(1), algebra.number(0)
    result = [[FormRatio(zero, one) for _ in range(n)] for _ in range(n)]
    for block in blocks(matrix):
        if len(block) > MAX_INVERSE_ROWS:
            raise OutOfReach(f"the inverse of a mass matrix with {len(block)} coupled rows is too long to write out")
        part = [[matrix[i][j] for j in block] for i in block]
        under = determinant(part, algebra)
        for a, i in enumerate(block):
            for b, j in enumerate(block):
                if a <= b:
                    minor = [[x for k, x in enumerate(row) if k != b] for m, row in enumerate(part) if m != a]
                    over = determinant(minor, algebra)
                    result[i][j] = result[j][i] = FormRatio(over if (a + b) % 2 == 0 else -over, under)
    return result
