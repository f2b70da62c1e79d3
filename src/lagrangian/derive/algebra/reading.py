"""Converts SymPy to the normal form: a rule for every kind of node, and each subexpression only once."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from fractions import Fraction
from math import comb, isqrt
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.derive.algebra.form import Form, OutOfReach, Ring
from lagrangian.derive.algebra.monomials import (
    LARGEST_EXPONENT,
    Packed,
    common_divisor,
    content,
    digits,
    turn,
    unit,
    whole,
)
from lagrangian.derive.algebra.variables import Symbolic

EXACT_TURNS = 12
"""cos(x + π·p/q) is expanded to cos x cos(πp/q) − sin x sin(πp/q) for q up to this, so that thirds cancel."""


LARGEST_POWER = 20_000
"""A power of a sum that may have more terms is left as it is."""

LARGEST_SQUARE = 500_000
"""A power whose last squaring would need more products of terms is left as it is."""

LARGEST_PRODUCT = 10_000
"""A product of sums that would need more products of their terms is left as it is."""


class FormReader:
    """Converts expressions to an algebra, and caches the results."""

    def __init__(self, algebra: Ring) -> None:
        self.algebra = algebra
        self._memo: dict[sp.Basic, Form] = {}
        self.left: dict[sp.Expr, None] = {}

    def form(self, expr: sp.Expr) -> Form:
        """Return the normal form of an expression."""
        if (known := self._memo.get(expr)) is None:
            known = self._memo[expr] = self._read(expr)
        return known

    def _read(self, expr: sp.Expr) -> Form:
        algebra = self.algebra
        if isinstance(expr, sp.Rational):
            return algebra.number(whole(Fraction(int(expr.p), int(expr.q))))
        if isinstance(expr, sp.Float):
            return algebra.number(whole(_decimal(expr)))
        if isinstance(expr, sp.Add):
            return algebra.total(self.form(a) for a in expr.args)
        if isinstance(expr, sp.Mul):
            result = algebra.number(1)
            for factor in sorted((self.form(a) for a in expr.args), key=lambda f: f.size):
                doubled = 1 + (any(h for h, _ in result.parts) and any(h for h, _ in factor.parts))
                predicted = doubled * result.size * factor.size
                if predicted > LARGEST_PRODUCT and predicted > max(result.size, factor.size):
                    return self._as_it_is(expr)
                result = result * factor
            return result
        if isinstance(expr, sp.Pow):
            return self._power(expr)
        if isinstance(expr, (sp.sin, sp.cos)):
            return self._trig(self.form(cast("sp.Expr", expr.args[0])), isinstance(expr, sp.sin))
        if isinstance(expr, (sp.Symbol, AppliedUndef)) or _of_time(expr):
            return algebra.monomial(unit(algebra.generators.index(expr)))
        return self._opaque(expr)

    # -- powers -----------------------------------------------------------------------------------------------------

    def _power(self, expr: sp.Pow) -> Form:
        base, exponent = expr.args
        if not isinstance(exponent, sp.Rational) or max(abs(exponent.p), exponent.q) > LARGEST_EXPONENT:
            return self._opaque(expr)
        inner = self.form(base)
        if exponent.q == 1 and exponent.p >= 0:
            half = _terms_of_power(inner, int(exponent.p) // 2)
            if _terms_of_power(inner, int(exponent.p)) > LARGEST_POWER or half**2 > LARGEST_SQUARE:
                return self._as_it_is(expr)
            return inner ** int(exponent.p)
        return self._inverse(inner, int(exponent.p), int(exponent.q))

    def _inverse(self, form: Form, p: int, q: int) -> Form:
        """form^(p/q) for a negative or fractional p/q: a number and a monomial are taken out, the rest is a generator.

        1/(2 m₁ + 2 m₂) = ½ (m₁ + m₂)⁻¹, √(4x² + 4y²) = 2 √(x² + y²). Only what is certainly positive is taken out of a
        root: a number that is a perfect power, and coordinates declared positive, √(r² m²) = r √(m²).
        """
        algebra = self.algebra
        if not form.parts:
            raise OutOfReach("an expression divides by zero")
        number = Fraction(content(c for poly in form.parts.values() for c in poly.values()), form.den)
        monomial = common_divisor(m for poly in form.parts.values() for m in poly)
        if q == 1:
            if form.parts[min(form.parts)][min(form.parts[min(form.parts)])] < 0:
                number = -number
            outside, lifted = _power_of(number, p), monomial
        else:
            root = _exact_root(number, q)
            number, outside = (number, _power_of(root, p)) if root else (Fraction(1), Fraction(1))
            lifted = self._distances(monomial, q)
            monomial = lifted * q
        rest = Form(
            algebra,
            {h: {m - monomial: c * number.denominator for m, c in poly.items()} for h, poly in form.parts.items()},
            form.den * number.numerator if number > 0 else -form.den * -number.numerator,
        )
        if rest.den < 0:
            rest = Form(algebra, {h: {m: -c for m, c in poly.items()} for h, poly in rest.parts.items()}, -rest.den)
        left = algebra.monomial(lifted * p).scaled(whole(outside))
        if q == 1 and rest.size == 1 and list(rest.parts) == [(0, 0)]:
            return left
        if rest.size == 1 and list(rest.parts) == [(0, 0)] and rest.parts[(0, 0)] == {0: 1} and rest.den == 1:
            return left
        generator = algebra.generators.root(rest, q)
        return algebra.reduced(left * algebra.monomial(unit(generator) * p))

    def _distances(self, monomial: int, q: int) -> int:
        """The q-th root of the positive coordinates in a monomial, in whole powers."""
        table, found = self.algebra.generators.table, 0
        for i, e in digits(monomial):
            entry = table[i]
            if e % q == 0 and isinstance(entry, Symbolic) and entry.role == "coordinate" and entry.expr.is_positive:
                found += unit(i) * (e // q)
        return found

    # -- sines and cosines ------------------------------------------------------------------------------------------

    def _trig(self, argument: Form, sine: bool) -> Form:
        """sin or cos of Σ k_j a_j: every term of the argument is a rational multiple of an angle."""
        algebra, generators = self.algebra, self.algebra.generators
        h: Packed = 0
        phase = Fraction(0)
        pi = unit(generators.opaque(sp.pi))
        for harmonic, poly in argument.parts.items():
            for m, c in poly.items():
                k = Fraction(c, argument.den)
                if m == pi and harmonic == (0, 0) and k.denominator <= EXACT_TURNS:
                    phase = k % 2
                elif max(abs(k.numerator), k.denominator) > LARGEST_EXPONENT:
                    h += turn(generators.angle(harmonic, m, k))
                else:
                    h += k * turn(generators.angle(harmonic, m))
        h = whole(h)
        if phase:
            turned = cast("sp.Expr", sp.pi * sp.Rational(phase))
            c, s = self._number(sp.cos(turned)), self._number(sp.sin(turned))
            bare_cos, bare_sin = self._plain(h, 0), self._plain(h, 1)
            return bare_sin * c + bare_cos * s if sine else bare_cos * c - bare_sin * s
        return self._plain(h, int(sine)) if h else Form(algebra, {} if sine else {(0, 0): {0: 1}})

    def _number(self, value: sp.Expr) -> Form:
        """cos or sin of a part of a turn: roots, or as it is where it has none, such as cos(π/7)."""
        return self._opaque(value) if isinstance(value, (sp.sin, sp.cos)) else self.form(value)

    def _plain(self, h: Packed, s: int) -> Form:
        if h == 0:
            return Form(self.algebra, {} if s else {(0, 0): {0: 1}})
        return Form(self.algebra, {(abs(h), s): {0: -1 if s and h < 0 else 1}})

    def _as_it_is(self, expr: sp.Expr) -> Form:
        """A product or power that would be too long as a sum becomes a generator, and is recorded for a note."""
        self.left[expr] = None
        return self._opaque(expr)

    # -- the rest ---------------------------------------------------------------------------------------------------

    def _opaque(self, expr: sp.Expr) -> Form:
        """A function of readable arguments becomes a generator."""
        if expr.has(sp.I, sp.zoo, sp.oo, sp.nan, sp.S.NegativeInfinity):
            raise OutOfReach(f"'{expr}' is not a finite real expression")
        generators = self.algebra.generators
        if expr.args and not expr.is_number and isinstance(expr, (sp.Function, sp.Pow)):
            arguments: list[Any] = [self.form(a).expr() if isinstance(a, sp.Expr) else a for a in expr.args]
            rebuilt = cast("sp.Expr", bounded.rebuilt(expr, arguments))
            if rebuilt.func is not expr.func:
                return self.form(rebuilt)
            expr = rebuilt
        return self.algebra.monomial(unit(generators.opaque(expr)))


def _terms_of_power(form: Form, exponent: int) -> int:
    """A bound on the number of terms of a power: a sine or cosine is two exponentials."""
    exponentials = {(sign * h, m) for (h, _), poly in form.parts.items() for m in poly for sign in (1, -1)}
    return comb(len(exponentials) + exponent - 1, exponent)


def _of_time(expr: sp.Expr) -> bool:
    return isinstance(expr, sp.Derivative) and isinstance(expr.expr, AppliedUndef)


def _decimal(number: sp.Float) -> Fraction:
    """The shortest decimal that equals this floating-point number exactly."""
    return Fraction(repr(float(number)))


def _power_of(number: Fraction, p: int) -> Fraction:
    return number**p


def _exact_root(number: Fraction, q: int) -> Fraction | None:
    """The q-th root if it is rational."""
    parts = [_integer_root(n, q) for n in (number.numerator, number.denominator)]
    return None if None in parts else Fraction(cast("int", parts[0]), cast("int", parts[1]))


def _integer_root(n: int, q: int) -> int | None:
    root = isqrt(n) if q == 2 else int(sp.integer_nthroot(n, q)[0])
    return root if root**q == n else None
