"""The variables of the normal form: symbols, roots, functions treated as symbols, sines and sums as symbols."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from typing import ClassVar, cast

import sympy as sp

from lagrangian.derive.algebra.form import Form, Harmonic
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class Symbolic:
    """A symbol: time, a parameter, or a function of time with ``order`` dots. ``role`` is its meaning.

    Roles: "coordinate", "rate", "acceleration" (and higher derivatives), "input", "time", "parameter".
    """

    time: ClassVar[sp.Symbol] = sp.Symbol("t")
    expr: sp.Expr
    role: str
    order: int = 0


@dataclass(frozen=True, eq=False)
class Root:
    """g = b^(1/q) of a form b; with q = 1 it represents denominators, 1/b being g⁻¹. Relation: g^q = b.

    ``inverse`` is 1/b of a product b that moves, such as the square in √(x²): then g⁻¹ = g^(q−1)/b.
    """

    base: Form
    q: int
    moving: bool
    inverse: Form | None = None

    def lowers(self, exponent: int) -> bool:
        """Whether g to this power is written with another one."""
        return exponent >= self.q or (exponent < 0 and self.inverse is not None)

    def whole(self, times: int) -> Form:
        """b to a power, which is negative only if there is an ``inverse``."""
        return self.base**times if times >= 0 else cast("Form", self.inverse) ** -times

    @property
    def expr(self) -> sp.Expr:
        """b^(1/q) with the base in readable form."""
        return self.base.expr() ** sp.Rational(1, self.q)


@dataclass(frozen=True, eq=False)
class Opaque:
    """A function treated as a symbol, such as exp(−x/l) or tanh(v/v₀); ``inside`` are the symbols on which it
    depends."""

    expr: sp.Expr
    inside: tuple[sp.Expr, ...]
    moving: bool


@dataclass(frozen=True, eq=False)
class Trig:
    """A sine or cosine as a symbol on the page; forms store harmonics and never contain one."""

    harmonic: Harmonic
    expr: sp.Expr
    moving: bool


@dataclass(frozen=True, eq=False)
class Sum:
    """A sum of parameters as a symbol on the page, such as L_a + L_b; forms store its symbols and never contain one."""

    expr: sp.Expr
    moving: ClassVar[bool] = False


Generator = Symbolic | Root | Opaque | Trig | Sum


def reciprocal(base: Form) -> Form | None:
    """1/b if b is one monomial."""
    if base.size > 1 or list(base.parts) != [(0, 0)]:
        return None
    ((monomial, c),) = base.parts[0, 0].items()
    sign = 1 if c > 0 else -1
    return Form(base.algebra, {(0, 0): {-monomial: sign * base.den}}, sign * c)
