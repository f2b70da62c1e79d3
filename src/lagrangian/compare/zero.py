"""Decides whether an expression is 0: by its normal form if there is one, else at random states with 50 digits."""

from __future__ import annotations

from collections.abc import Sequence

import mpmath
import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Algebra, Form, OutOfReach
from lagrangian.derive.sampling import DIGITS, CompiledExpressions, States
from lagrangian.errors import ModelError
from lagrangian.model import Model
from lagrangian.records import dataclass

ENOUGH = 5
"""The number of states at which 50 digits are compared."""
EXACTLY = mpmath.mpf(10) ** -35
LONGEST = 20_000
"""The normal form is not tried for expressions with more operations."""


@dataclass(frozen=True)
class ZeroVerdict:
    """Whether an expression vanishes, and how that was decided."""

    holds: bool
    figure: str


class Zero:
    """Decides in the polynomial ring of one model."""

    def __init__(self, model: Model, expressions: Sequence[sp.Expr]) -> None:
        self.algebra = Algebra(model, expressions)
        self._states = States(model, 4)

    def form(self, expr: sp.Expr) -> Form | None:
        """The normal form, or None if it would be too long."""
        if bounded.operations(expr) > LONGEST:
            return None
        try:
            return self.algebra.form(expr)
        except (OutOfReach, OverflowError, ValueError):
            return None

    def readable(self, expr: sp.Expr) -> sp.Expr:
        """The expression in textbook form, or unchanged if it is too long for that."""
        form = self.form(expr)
        return expr if form is None else form.expr()

    def vanishes(self, terms: Sequence[tuple[sp.Expr, sp.Expr]]) -> ZeroVerdict:
        """Whether Σ factor · expression, over all pairs, is 0. Raises `ModelError` if it has no value at any state."""
        exact = self._exactly(terms)
        if exact is True:
            return ZeroVerdict(True, "exact")
        return self._numerically([f * e for f, e in terms])

    def _exactly(self, terms: Sequence[tuple[sp.Expr, sp.Expr]]) -> bool | None:
        total: list[Form] = []
        for factor, expr in terms:
            f, e = self.form(factor), self.form(expr)
            if f is None or e is None:
                return None
            try:
                total.append(f * e)
            except (OutOfReach, OverflowError):
                return None
        try:
            return self.algebra.total(total).is_zero
        except OutOfReach:
            return None

    def _numerically(self, summands: Sequence[sp.Expr]) -> ZeroVerdict:
        """The largest |Σ| / Σ|summand| at random states; states without a value are skipped."""
        parts = [t for s in summands for t in sp.Add.make_args(s)]
        if not parts:
            return ZeroVerdict(True, "exact")
        compiled = CompiledExpressions(parts)
        worst, seen = mpmath.mpf(0), 0
        for index in range(self._states.size):
            try:
                values = compiled.exactly(self._states, index)
            except (ZeroDivisionError, ValueError, OverflowError, TypeError):
                continue
            with mpmath.workdps(DIGITS):
                if not all(isinstance(v, mpmath.mpf) and mpmath.isfinite(v) for v in map(mpmath.mpmathify, values)):
                    continue
                size = mpmath.fsum(abs(v) for v in values)
                worst = max(worst, abs(mpmath.fsum(values)) / size if size else mpmath.mpf(0))
            seen += 1
            if seen == ENOUGH:
                break
        if not seen:
            raise ModelError(
                "the expressions to compare have no finite value at any random state",
                fix="look for a root or a logarithm of a negative number",
                code="E503",
            )
        figure = f"{float(worst):.0e} at {seen} random states with {DIGITS} digits"
        return ZeroVerdict(
            bool(worst < EXACTLY), figure if worst else f"0 at {seen} random states with {DIGITS} digits"
        )
