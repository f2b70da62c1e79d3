"""Data that all steps share: the model, its algebra, what each coordinate moves, and limits on formulas."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from functools import cached_property

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Algebra, Form, Term
from lagrangian.derive.wiggle import Wiggle
from lagrangian.model import Model
from lagrangian.page.formula import Elided, Left, Name, Terms
from lagrangian.records import dataclass, field

READABLE = 400
"""Operations above which a formula is summarised; the full text is one option away."""


@dataclass(frozen=True, eq=False)
class Context:
    """The shared data, made once for a derivation and passed to every step."""

    model: Model
    algebra: Algebra
    wiggle: Wiggle
    _memo: dict[sp.Expr, sp.Expr] = field(default_factory=dict[sp.Expr, sp.Expr])
    _terms: dict[int, tuple[Form, list[Term]]] = field(default_factory=dict[int, tuple[Form, list[Term]]])

    @cached_property
    def symbols(self) -> tuple[sp.Expr, ...]:
        """The coordinates."""
        return tuple(c.symbol for c in self.model.coordinates)

    def form(self, expr: sp.Expr) -> Form:
        """The normal form of an expression."""
        return self.algebra.form(expr)

    def written(self, form: Form) -> Left:
        """A form as a sum of readable terms in textbook order."""
        return fit_terms(tuple(t.expr for t in self.terms(form)))

    def terms(self, form: Form) -> list[Term]:
        """The readable terms of a form; each form is converted only once."""
        kept = self._terms.get(id(form))
        if kept is None or kept[0] is not form:
            kept = self._terms[id(form)] = (form, form.terms())
        return kept[1]

    def readable(self, expr: sp.Expr) -> sp.Expr:
        """The expression in textbook form."""
        if expr not in self._memo:
            self._memo[expr] = self.algebra.form(expr).expr()
        return self._memo[expr]


def fit(expr: sp.Expr) -> Left:
    """Return the expression, or its summary if it is too long to read."""
    operations = bounded.operations(expr)
    return expr if operations <= READABLE else Elided(expr, operations)


def fit_terms(terms: tuple[sp.Expr, ...]) -> Left:
    """Return the sum with its terms in this order, or its summary if it is too long to read."""
    operations = bounded.operations(*terms)
    if operations <= READABLE:
        return Terms(terms)
    return Elided(sp.Add(*terms, evaluate=False) if terms else sp.S.Zero, operations, terms)


def xi(index: int) -> Name:
    """The lecture's name of a coordinate, ξ_i."""
    return Name("xi", str(index + 1))


def big_xi(index: int) -> Name:
    """The lecture's name of a generalized force, Ξ_i."""
    return Name("Xi", str(index + 1))
