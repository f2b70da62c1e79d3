"""½ wᵀ M⁻¹ w as a sum of squares with simple denominators: LDLᵀ with the constant pivots first.

    M = L D Lᵀ,  z = L⁻¹ w:        ½ wᵀ M⁻¹ w = Σ_i z_i² / (2 d_i)

Rows whose pivot is not constant come last; if there is more than one, they form one quotient, adjugate over
determinant.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.derive.algebra import Algebra, Form, OutOfReach
from lagrangian.derive.algebra.ratios import MAX_INVERSE_ROWS, TERMS, blocks, determinant
from lagrangian.errors import RunError
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class SquarePiece:
    """coefficient · Π form^exponent, in factored form."""

    coefficient: Fraction
    factors: tuple[tuple[Form, int], ...]

    def expr(self) -> sp.Expr:
        """The piece as an expression."""
        number = sp.Rational(self.coefficient.numerator, self.coefficient.denominator)
        return cast("sp.Expr", sp.Mul(number, *(form.expr() ** e for form, e in self.factors)))

    def diff(self, symbol: Any) -> list[SquarePiece]:
        """The derivative, with one piece for every factor that changes."""
        found = []
        for k, (form, e) in enumerate(self.factors):
            slope = form.diff(symbol)
            if slope.parts:
                rest = [f for i, f in enumerate(self.factors) if i != k]
                kept = [(form, e - 1)] if e != 1 else []
                found.append(SquarePiece(self.coefficient * e, (*rest, *kept, (slope, 1))))
        return found


def half_square(matrix: Sequence[Sequence[Form]], w: Sequence[Form], algebra: Algebra) -> list[SquarePiece]:
    """½ wᵀ M⁻¹ w.

    Raises `OutOfReach` if too many rows with moving pivots are coupled, and `RunError` if M is singular.
    """
    pieces: list[SquarePiece] = []
    for block in blocks(matrix):
        part = {i: {j: matrix[i][j] for j in block} for i in block}
        left = {i: w[i] for i in block}
        while left:
            constant = [i for i in left if not _moves(part[i][i])]
            if not constant:
                break
            k = min(constant, key=lambda i: (part[i][i].size, i))
            d = part[k][k]
            if d.is_zero:
                raise RunError(
                    "the mass matrix is singular: the momenta cannot be solved for the rates",
                    fix="give every coordinate a mass or an inertia that it moves",
                    code="E203",
                )
            pieces.append(SquarePiece(Fraction(1, 2), ((left[k], 2), (d, -1))))
            inverse = algebra.form(1 / d.expr())
            others = [i for i in left if i != k]
            ratio = {i: part[i][k] * inverse for i in others}
            if len(others) == 1 and _is_fraction(ratio[others[0]]):
                pieces.append(_cleared(part, left, k, others[0]))
                left = {}
                break
            for i in others:
                left[i] = left[i] - ratio[i] * left[k]
                for j in others:
                    part[i][j] = part[i][j] - ratio[i] * part[k][j]
            del left[k]
            _bounded([*left.values(), *(part[i][j] for i in left for j in left)])
        pieces += _rest(part, left, algebra)
    return [p for p in pieces if all(form.parts for form, _ in p.factors)]


def _is_fraction(form: Form) -> bool:
    """Whether a sum is in the denominator."""
    return bool(sp.fraction(bounded.together(form.expr()))[1].has(sp.Add))


def _cleared(part: dict[int, dict[int, Form]], left: dict[int, Form], k: int, i: int) -> SquarePiece:
    """The last square with denominators inside it cleared: (d w_i − m w_k)² / (2 d (d M_ii − m²))."""
    d, m = part[k][k], part[i][k]
    return SquarePiece(Fraction(1, 2), ((d * left[i] - m * left[k], 2), (d, -1), (d * part[i][i] - m * m, -1)))


def _rest(part: dict[int, dict[int, Form]], left: dict[int, Form], algebra: Algebra) -> list[SquarePiece]:
    """The rows with moving pivots: one square, or the quotient of adjugate and determinant."""
    rows = list(left)
    if not rows:
        return []
    if len(rows) == 1:
        return [SquarePiece(Fraction(1, 2), ((left[rows[0]], 2), (part[rows[0]][rows[0]], -1)))]
    if len(rows) > MAX_INVERSE_ROWS:
        raise OutOfReach(f"the inverse of a mass matrix with {len(rows)} coupled rows is too long to write out")
    matrix = [[part[i][j] for j in rows] for i in rows]
    terms = []
    for a, i in enumerate(rows):
        for b, j in enumerate(rows):
            minor = [[x for k, x in enumerate(row) if k != b] for m, row in enumerate(matrix) if m != a]
            term = determinant(minor, algebra) * left[i] * left[j]
            terms.append(term if (a + b) % 2 == 0 else -term)
    over = algebra.total(terms)
    _bounded([over])
    return [SquarePiece(Fraction(1, 2), ((over, 1), (determinant(matrix, algebra), -1)))]


def _moves(form: Form) -> bool:
    """Whether a form contains coordinates or time."""
    return bool(form.raw().has(AppliedUndef, sp.Symbol("t")))


def _bounded(forms: Sequence[Form]) -> None:
    largest = max((f.size for f in forms), default=0)
    if largest > TERMS:
        raise OutOfReach(f"a sum of {largest} terms is too long to write out")


def summed(pieces: Sequence[SquarePiece]) -> sp.Expr:
    """The sum of pieces as an expression."""
    return cast("sp.Expr", sp.Add(*(p.expr() for p in pieces)))
