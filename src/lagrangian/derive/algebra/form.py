"""The trigonometric normal form: one Fourier sum for every expression, exact and canonical.

    f = Σ_h  C_h cos(h·a) + S_h sin(h·a)

The a_j are the angles that occur inside sines and cosines (coordinates, Ω·t, the angle α of a slope, x/R of a wheel),
h their rational multiples, C_h and S_h polynomials with rational coefficients in everything else: lengths, masses,
rates, accelerations. Products become sums, sin² + cos² disappears, cos θ₁ cos θ₂ + sin θ₁ sin θ₂ becomes
cos(θ₁ − θ₂); two expressions are equal when their forms are. What is not polynomial (a square root, 1/(R + r), exp)
is a generator of its own with its derivative, see `generators`.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from fractions import Fraction
from typing import Any, Protocol

import sympy as sp

from lagrangian.derive.algebra.monomials import (
    LARGEST_EXPONENT,
    OutOfReach,
    Packed,
    Poly,
    content,
    digits,
    multiples,
    product,
    unit,
)
from lagrangian.page.formula import TermKind
from lagrangian.records import dataclass

LARGEST_FORM = 1_000_000
"""A product with more terms is refused, because nobody could read it or store it."""

Harmonic = tuple[Packed, int]
"""A packed multiple of the angles, never negative, and 0 for its cosine, 1 for its sine; (0, 0) is the constant 1."""

Key = tuple[Harmonic, int]
"""The variable part of a term: its harmonic, and the monomial of everything that moves in it."""

Rate = Callable[[int], "int | Form | None"]
"""A derivative's table: index → its derivative as a monomial, as a form, or None where it is zero."""


@dataclass(frozen=True, eq=False)
class Term:
    """A readable term of an equation, and its kind, which depends on its factors.

    Kinds: "inertia" with an acceleration; "velocity" with a product of rates, or a rate and another moving factor;
    "damping" with a single rate; "stiffness" with coordinates and without sines; "gravity" with sines of coordinates,
    or constant; "input"; "other".
    """

    expr: sp.Expr
    kind: TermKind


class Ring(Protocol):
    """The requirements of a form on its algebra; see `lagrangian.derive.algebra.algebra.Algebra`."""

    generators: Any
    writer: Any

    def spend(self, operations: int) -> None:
        """Count operations on terms; raise `OutOfReach` if there are too many."""
        ...

    def form(self, expr: sp.Expr) -> Form:
        """Return the normal form of an expression."""
        ...

    def number(self, value: Packed) -> Form:
        """Return a rational constant."""
        ...

    def monomial(self, packed: int) -> Form:
        """Return a monomial of generators."""
        ...

    def total(self, forms: Iterable[Form]) -> Form:
        """Return the sum of forms."""
        ...

    def reduced(self, form: Form) -> Form:
        """Return the form with every power of a root replaced."""
        ...


class Form:
    """An expression in normal form: Σ_h C_h cos(h·a) + S_h sin(h·a), divided by ``den``.

    ``parts`` contains the polynomials by harmonic, with integer coefficients that have no common divisor with ``den``.
    A form never changes; ``==`` decides equality exactly (except for relations between functions that it does not know,
    such as tan = sin/cos, cosh² − sinh² = 1, or √2·√3 = √6).
    """

    __hash__ = None  # type: ignore[assignment] # equality is decided by clearing denominators, so no key stands for it
    __slots__ = ("algebra", "den", "parts")

    def __init__(self, algebra: Ring, parts: dict[Harmonic, Poly], den: int = 1) -> None:
        kept: dict[Harmonic, Poly] = {}
        for h, p in parts.items():
            if not all(p.values()):
                p = {m: c for m, c in p.items() if c}
            if p:
                kept[h] = p
        if den != 1 and (g := content([den, *(c for p in kept.values() for c in p.values())])) > 1:
            den //= g
            kept = {h: {m: c // g for m, c in p.items()} for h, p in kept.items()}
        self.algebra, self.parts, self.den = algebra, kept, den if kept else 1

    # -- arithmetic -------------------------------------------------------------------------------------------------

    def __add__(self, other: Form) -> Form:
        return self.algebra.total([self, other])

    def __sub__(self, other: Form) -> Form:
        return self.algebra.total([self, -other])

    def __neg__(self) -> Form:
        return self.scaled(-1)

    def scaled(self, factor: Packed) -> Form:
        """Return a rational multiple."""
        n, d = factor.numerator, factor.denominator
        return Form(self.algebra, {h: {m: c * n for m, c in p.items()} for h, p in self.parts.items()}, self.den * d)

    def __mul__(self, other: Form | int | Fraction) -> Form:
        """Multiply by a form or a number.

        cos a cos b = ½ cos(a−b) + ½ cos(a+b), sin a sin b = ½ cos(a−b) − ½ cos(a+b),
        sin a cos b = ½ sin(a+b) + ½ sin(a−b).
        """
        if not isinstance(other, Form):
            return self.scaled(other)
        if self.size * other.size > 4 * LARGEST_FORM:
            raise OutOfReach(f"a product of sums with {self.size} and {other.size} terms is too long to write out")
        self.algebra.spend(2 * self.size * other.size + 4 * len(self.parts) * len(other.parts))
        whole: list[tuple[Packed, int, Poly, int]] = []
        half: list[tuple[Packed, int, Poly, int]] = []
        for (a, s), p in self.parts.items():
            for (b, r), q in other.parts.items():
                pq = product(p, q)
                if a == 0 or b == 0:
                    whole.append((a + b, s + r, pq, 1))
                elif s == r:
                    half.append((a - b, 0, pq, 1))
                    half.append((a + b, 0, pq, -1 if s else 1))
                else:
                    half.append((a + b, 1, pq, 1))
                    half.append((a - b, 1, pq, 1 if s else -1))
        out: dict[Harmonic, Poly] = {}
        _gather(out, whole, 2 if half else 1)
        _gather(out, half, 1)
        return self.algebra.reduced(Form(self.algebra, out, self.den * other.den * (2 if half else 1)))

    __rmul__ = __mul__

    def __pow__(self, exponent: int) -> Form:
        """Raise to a small nonnegative whole power."""
        if not 0 <= exponent <= LARGEST_EXPONENT:
            raise OutOfReach(f"an exponent of {exponent} is outside 0 … {LARGEST_EXPONENT}")
        result, base = self.algebra.number(1), self
        while exponent:
            if exponent & 1:
                result = result * base
            exponent >>= 1
            if exponent:
                base = base * base
        return result

    # -- derivatives ------------------------------------------------------------------------------------------------

    def diff(self, symbol: sp.Expr) -> Form:
        """Return the partial derivative by a coordinate, a rate, an acceleration, a parameter or time."""
        generators = self.algebra.generators
        g = generators.index(symbol)
        return self._derived(lambda i: generators.partial(i, g), lambda j: generators.angle_partial(j, g))

    def total_derivative(self) -> Form:
        """Return d/dt: coordinates become rates, rates become accelerations, and dt/dt = 1."""
        generators = self.algebra.generators
        return self._derived(generators.rate, generators.angle_rate)

    def _derived(self, of_generator: Rate, of_angle: Rate) -> Form:
        """Σ ∂f/∂g · g' over the generators, and d cos(h·a) = −(Σ k_j a_j') sin(h·a), d sin(h·a) = (Σ k_j a_j') cos."""
        algebra = self.algebra
        algebra.spend(4 * self.size)
        out: dict[Harmonic, Poly] = {}
        slow: list[Form] = []
        for (h, s), p in self.parts.items():
            here = out.setdefault((h, s), {})
            by_form: dict[tuple[int, bool], tuple[Form, Poly]] = {}
            for m, c in p.items():
                for i, e in digits(m):
                    rate = of_generator(i)
                    if rate is None:
                        continue
                    lower = m - unit(i)
                    ramp = algebra.generators.ramp(i) if e > 1 else None
                    if ramp is not None:  # max(0, u)² has the derivative 2 max(0, u) u'
                        if (i, True) not in by_form:
                            by_form[i, True] = ramp._derived(of_generator, of_angle), {}
                        by_form[i, True][1][lower] = c * e
                    elif isinstance(rate, int):
                        here[lower + rate] = here.get(lower + rate, 0) + c * e
                    else:
                        by_form.setdefault((i, False), (rate, {}))[1][lower] = c * e
            slow += [Form(algebra, {(h, s): q}, self.den) * rate for rate, q in by_form.values()]
            for j, k in multiples(h):
                rate = of_angle(j)
                if rate is None:
                    continue
                k = k if s else -k
                if isinstance(rate, int) and isinstance(k, int):
                    turned = out.setdefault((h, 1 - s), {})
                    for m, c in p.items():
                        turned[m + rate] = turned.get(m + rate, 0) + c * k
                else:
                    factor = algebra.monomial(rate) if isinstance(rate, int) else rate
                    slow.append((Form(algebra, {(h, 1 - s): p}, self.den) * factor).scaled(k))
        return algebra.total([algebra.reduced(Form(algebra, out, self.den)), *slow])

    # -- questions --------------------------------------------------------------------------------------------------

    @property
    def size(self) -> int:
        """The number of terms."""
        return sum(len(p) for p in self.parts.values())

    @property
    def is_number(self) -> bool:
        """Whether it is a rational number."""
        return not any(h[0] or m for h, p in self.parts.items() for m in p)

    @property
    def turns(self) -> bool:
        """Whether a sine or a cosine stands in it, of parameters alone or not."""
        return any(h[0] for h in self.parts)

    @property
    def moves(self) -> bool:
        """Whether it changes with time."""
        generators = self.algebra.generators
        return any(h[0] and generators.turning(h[0]) for h in self.parts) or any(
            generators.moving(m) for p in self.parts.values() for m in p
        )

    @property
    def is_zero(self) -> bool:
        """Whether it vanishes identically, which is decided after clearing denominators."""
        form = self
        while form.parts:
            factor = self.algebra.generators.denominators(form)
            if factor == 0:
                return False
            form = form * self.algebra.monomial(factor)
        return True

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Form) and (self - other).is_zero

    def __bool__(self) -> bool:
        raise TypeError("a Form has no truth value; ask for is_zero")

    def keys(self) -> frozenset[Key]:
        """Return the variable factors of its terms: the harmonic, and the monomial of everything that moves."""
        moving = self.algebra.generators.moving
        return frozenset((h, moving(m)) for h, p in self.parts.items() for m in p)

    def restricted(self, keys: Collection[Key]) -> Form:
        """Return the terms with these variable factors."""
        moving = self.algebra.generators.moving
        parts = {h: {m: c for m, c in p.items() if (h, moving(m)) in keys} for h, p in self.parts.items()}
        return Form(self.algebra, parts, self.den)

    def opaque(self) -> tuple[sp.Expr, ...]:
        """Return the subexpressions that are treated as symbols because they are not polynomials in sines and
        cosines."""
        return self.algebra.generators.kept(m for p in self.parts.values() for m in p)

    # -- reading ----------------------------------------------------------------------------------------------------

    def expr(self) -> sp.Expr:
        """Return the expression in textbook form: the shortest of the shapes that were tried."""
        return self.algebra.writer.expr(self)

    def terms(self) -> list[Term]:
        """Return the readable terms in textbook order: inertia, products of rates, damping, stiffness, gravity."""
        return self.algebra.writer.terms(self)

    def raw(self) -> sp.Expr:
        """Return the plain Fourier sum, term by term."""
        g = self.algebra.generators
        terms = [sp.Rational(c, self.den) * g.expr(m) * g.trig(h) for h, p in self.parts.items() for m, c in p.items()]
        return sp.Add(*terms)

    def __repr__(self) -> str:
        return f"Form({self.raw()})"


def _gather(out: dict[Harmonic, Poly], pieces: list[tuple[Packed, int, Poly, int]], scale: int) -> None:
    """Add harmonics that may still be negative: cos(−h) = cos h, sin(−h) = −sin h, sin 0 = 0."""
    for h, s, p, sign in pieces:
        if h < 0:
            h, sign = -h, -sign if s else sign
        elif h == 0 and s:
            continue
        if isinstance(h, Fraction) and h.denominator == 1:
            h = h.numerator
        here = out.setdefault((h, s), {})
        factor = sign * scale
        for m, c in p.items():
            here[m] = here.get(m, 0) + c * factor
