"""Sums of monomials in the atoms of a system: what the grammar of changes works on.

A monomial is a product of whole powers of atoms: parameters, coordinates, rates, accelerations, inputs, sines and
cosines of whole angles, and whatever else is not a sum or product. A sum maps every monomial to its number.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from math import isqrt
from typing import TypeAlias, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import partner
from lagrangian.errors import ModelError
from lagrangian.model import Model, time

Monomial: TypeAlias = "tuple[tuple[int, int], ...]"
"""The atoms of a product with their exponents, in the order of the atoms."""
Sum: TypeAlias = "dict[Monomial, Fraction]"
"""Monomials with their numbers; the empty sum is 0."""

ONE: Monomial = ()
MOST_MONOMIALS = 1000
"""A sum with more monomials is not written out."""


class TooLong(ModelError):
    """A sum that would have more than `MOST_MONOMIALS`."""


class SumRing:
    """The atoms of a system, numbered as they are met."""

    def __init__(self, model: Model) -> None:
        every = [x for c in model.coordinates for x in (c.acceleration, c.rate, c.symbol)]
        self._held: dict[sp.Basic, sp.Dummy] = {x: sp.Dummy() for x in every}
        self._back: dict[sp.Basic, sp.Basic] = {d: x for x, d in self._held.items()}
        self.atoms: list[sp.Expr] = []
        self._index: dict[sp.Basic, int] = {}
        self._known: dict[sp.Basic, Sum] = {}
        self._slopes: dict[tuple[int, sp.Expr], Sum] = {}
        self._rates: dict[int, Sum] = {}

    def atom(self, expr: sp.Expr) -> int:
        """The number of an atom."""
        if expr not in self._index:
            self._index[expr] = len(self.atoms)
            self.atoms.append(expr)
        return self._index[expr]

    def of(self, expr: sp.Expr) -> Sum:
        """An expression as a sum; raises `TooLong`."""
        if expr not in self._known:
            self._known[expr] = self._read(expr)
        return self._known[expr]

    def of_both(self, a: sp.Expr, b: sp.Expr) -> Sum | None:
        """The product of two expressions as a sum; None if it is too long."""
        try:
            return times(self.of(a), self.of(b))
        except TooLong:
            return None

    def _read(self, expr: sp.Expr) -> Sum:
        if isinstance(expr, (sp.Rational, sp.Float)):
            number = Fraction(str(expr)) if isinstance(expr, sp.Float) else Fraction(int(expr.p), int(expr.q))
            return {ONE: number} if number else {}
        if isinstance(expr, sp.Add):
            total: Sum = {}
            for part in cast("tuple[sp.Expr, ...]", expr.args):
                add(total, self.of(part))
            return total
        if isinstance(expr, sp.Mul):
            whole, *others = map(self.of, cast("tuple[sp.Expr, ...]", expr.args))
            for factor in others:
                whole = times(whole, factor)
            return whole
        if isinstance(expr, sp.Pow) and isinstance(expr.exp, sp.Rational):
            return self._power(expr)
        if isinstance(expr, sp.tan):  # so that 1 + tan² folds to 1/cos²
            sine, cosine = (self.atom(f(expr.args[0])) for f in (sp.sin, sp.cos))
            return {product([((sine, 1),), ((cosine, -1),)]): Fraction(1)}
        return {((self.atom(expr), 1),): Fraction(1)}

    def _power(self, expr: sp.Pow) -> Sum:
        base, exponent = cast("sp.Expr", expr.base), cast("sp.Rational", expr.exp)
        if exponent.q == 1 and 0 <= int(exponent) <= 12:
            return power(self.of(base), int(exponent))
        if exponent.q != 1:
            root = cast("sp.Expr", sp.Pow(base, sp.Rational(1, exponent.q)))
            return {((self.atom(root), int(exponent.p)),): Fraction(1)}
        inner = self.of(base)
        if len(inner) == 1 and abs(int(exponent)) <= 12:
            return inverse(power(inner, -int(exponent)))
        return {((self.atom(base), int(exponent)),): Fraction(1)}

    def expr(self, value: Sum) -> sp.Expr:
        """A sum as an expression."""
        return cast(
            "sp.Expr", sp.Add(*[self.product(m) * sp.Rational(c.numerator, c.denominator) for m, c in value.items()])
        )

    def product(self, monomial: Monomial) -> sp.Expr:
        """A monomial as an expression, with tan θ for sin θ/cos θ."""
        exponents = {self.atoms[a]: e for a, e in monomial}
        for f in [f for f in exponents if isinstance(f, sp.sin)]:
            cosine = cast("sp.Expr", sp.cos(f.args[0]))
            if 0 < exponents[f] <= -exponents.get(cosine, 0):
                both = exponents.pop(f)
                exponents[cosine] += both
                exponents[cast("sp.Expr", sp.tan(f.args[0]))] = both
        return cast("sp.Expr", sp.Mul(*[f**e for f, e in exponents.items()]))

    def root(self, value: Sum) -> sp.Expr:
        """The square root of a sum, as if all letters were positive: r of r²."""
        if len(value) == 1:
            [(m, c)] = value.items()
            above, below = isqrt(abs(c.numerator)), isqrt(c.denominator)
            plain = all(e % 2 == 0 and isinstance(self.atoms[a], sp.Symbol) for a, e in m)
            if plain and Fraction(above**2, below**2) == c:
                return self.expr({tuple((a, e // 2) for a, e in m): Fraction(above, below)})
        return cast("sp.Expr", sp.powdenest(sp.sqrt(self.expr(value)), force=True))

    def slope(self, value: Sum, by: sp.Expr) -> Sum:
        """∂value/∂by."""
        return self._derived(value, lambda a: self._slope_of(a, by))

    def rate(self, value: Sum) -> Sum:
        """d/dt of a sum."""
        return self._derived(value, self._rate_of)

    def _derived(self, value: Sum, inner: Callable[[int], Sum]) -> Sum:
        """The product rule, by the derivatives of atoms."""
        total: Sum = {}
        for m, c in value.items():
            for a, e in m:
                if by_atom := inner(a):
                    add(total, times({joined(m, ((a, -1),)): c * e}, by_atom))
        return total

    def _slope_of(self, a: int, by: sp.Expr) -> Sum:
        """The derivative of an atom."""
        if (a, by) not in self._slopes:
            self._slopes[a, by] = self._slope_found(self.atoms[a], by)
        return self._slopes[a, by]

    def _slope_found(self, atom: sp.Expr, by: sp.Expr) -> Sum:
        if atom == by:
            return {ONE: Fraction(1)}
        if isinstance(atom, (sp.Symbol, sp.Derivative, AppliedUndef)):
            return {}
        held = cast("sp.Expr", bounded.replaced(atom, self._held))
        inner = self._held.get(by, by)
        if not held.has(inner):
            return {}
        return self.of(cast("sp.Expr", bounded.replaced(bounded.diff(held, inner), self._back)))

    def _rate_of(self, a: int) -> Sum:
        """The derivative of an atom by time."""
        if a not in self._rates:
            self._rates[a] = self.of(bounded.diff(self.atoms[a], time))
        return self._rates[a]

    def fold(self, value: Sum) -> Sum:
        """The same with cos A cos B + sin A sin B = cos(A − B), sin² + cos² = 1 and the like, wherever they occur."""
        found = {m: c for m, c in value.items() if c}
        again = True
        while again:
            again = any(self._folded(found, m) for m in list(found) if m in found)
        return found

    def _folded(self, value: Sum, m: Monomial) -> bool:
        """Fold one monomial with its partner, in place; False if it has none."""
        turned = [(a, e, self.atoms[a]) for a, e in m if self.turns(a) and e > 0]
        for k, (a, e, f) in enumerate(turned):
            for b, _, g in turned[k if e > 1 else k + 1 :]:
                partners = self._partner(f), self._partner(g)
                if partners[0] is None or partners[1] is None:
                    continue
                rest = product([m, ((a, -1),), ((b, -1),)])
                partner = product([rest, ((partners[0], 1),), ((partners[1], 1),)])
                own, other = value[m], value.get(partner)
                if partner == m or other is None or not (folded := _folded_pair(f, g, own, other)):
                    continue
                taken, left, whole = folded
                add(value, {m: -taken, partner: -left})
                add(value, times({rest: Fraction(1)}, self.of(whole)), taken)
                return True
        return False

    def _partner(self, f: sp.Expr) -> int | None:
        """The number of the cosine of the same angle for a sine, and the other way round, if it is an atom."""
        return self._index.get(partner(f))

    def moving(self, value: Sum) -> Sum:
        """The monomials that contain something that changes with time."""
        return {m: c for m, c in value.items() if any(self.changes(a) for a, _ in m)}

    def turns(self, atom: int) -> bool:
        """Whether an atom is a sine or cosine."""
        return isinstance(self.atoms[atom], (sp.sin, sp.cos))

    def changes(self, atom: int) -> bool:
        """Whether an atom changes with time."""
        expr = self.atoms[atom]
        return not isinstance(expr, sp.Symbol) and expr.has(time)


def _folded_pair(f: sp.Expr, g: sp.Expr, own: Fraction, other: Fraction) -> tuple[Fraction, Fraction, sp.Expr] | None:
    """What own·f·g + other·(its partner with sines and cosines exchanged) folds to.

    How much is taken of each, and the function that stands for what was taken of the first; None if nothing folds.
    """
    A, B = cast("sp.Expr", f.args[0]), cast("sp.Expr", g.args[0])
    if f == g:
        taken = min(own, other, key=abs)
        return (taken, taken, sp.S.One) if own * other > 0 else None
    if A == B or abs(own) != abs(other):
        return None
    same = own == other
    if type(f) is type(g):
        whole = sp.cos(bounded.expand(A - B if same else A + B))
        return own, other, whole if same or isinstance(f, sp.cos) else -whole
    if isinstance(f, sp.cos):
        A, B = B, A
    return own, other, sp.sin(bounded.expand(A + B if same else A - B))


def add(total: Sum, other: Sum, number: Fraction | int = 1) -> Sum:
    """Add ``number`` times a sum to ``total``, in place."""
    for m, c in other.items():
        new = c if number == 1 else -c if number == -1 else c * number
        if m in total:
            new = total[m] + new
        if new:
            total[m] = new
        else:
            total.pop(m, None)
    return total


def minus(a: Sum, b: Sum) -> Sum:
    """a − b."""
    return add(dict(a), b, -1)


def plus(*sums: Sum) -> Sum:
    """The sum of sums."""
    total: Sum = {}
    for s in sums:
        add(total, s)
    return total


def scaled(a: Sum, number: Fraction | int) -> Sum:
    """A number times a sum."""
    return {m: c * number for m, c in a.items()} if number else {}


def times(a: Sum, b: Sum) -> Sum:
    """a · b; raises `TooLong`."""
    if len(a) * len(b) > 4 * MOST_MONOMIALS:
        raise TooLong("the sum is too long", fix="shorten it")
    total: Sum = {}
    for m, c in a.items():
        for n, d in b.items():
            key = joined(m, n)
            new = c * d if c != 1 else d
            if key in total:
                new = total[key] + new
            if new:
                total[key] = new
            else:
                total.pop(key, None)
    if len(total) > MOST_MONOMIALS:
        raise TooLong("the sum is too long", fix="shorten it")
    return total


def power(a: Sum, exponent: int) -> Sum:
    """a to a whole power of at least 0."""
    result: Sum = a if exponent else {ONE: Fraction(1)}
    for _ in range(exponent - 1):
        result = times(result, a)
    return result


def inverse(a: Sum) -> Sum:
    """1/a of a single monomial."""
    [(m, c)] = a.items()
    return {tuple((x, -e) for x, e in m): 1 / c}


def product(monomials: Iterable[Monomial]) -> Monomial:
    """The product of monomials."""
    whole: Monomial = ONE
    for m in monomials:
        whole = joined(whole, m)
    return whole


def joined(m: Monomial, n: Monomial) -> Monomial:
    """The product of two monomials."""
    if not m or not n:
        return m or n
    if m[-1][0] < n[0][0]:
        return m + n
    if n[-1][0] < m[0][0]:
        return n + m
    exponents = dict(m)
    for a, e in n:
        if a in exponents:
            e += exponents.pop(a)
        if e:
            exponents[a] = e
    return tuple(sorted(exponents.items()))


def raised(m: Monomial, atom: int, exponent: int) -> Monomial:
    """A monomial times a power of an atom."""
    return joined(m, ((atom, exponent),))


def put(value: Sum, atom: int, instead: Sum) -> Sum:
    """A sum with ``instead`` in place of an atom in every positive power; raises `TooLong`."""
    total: Sum = {}
    powers: dict[int, Sum | None] = {}
    for m, c in value.items():
        e = exponent(m, atom)
        if e and e not in powers:
            powers[e] = _whole_power(instead, e)
        stands = powers[e] if e else None
        if stands is None:
            add(total, {m: c})
        else:
            rest = tuple(x for x in m if x[0] != atom)
            add(total, times({rest: c}, stands))
    return total


def exponent(m: Monomial, atom: int) -> int:
    """The exponent of an atom in a monomial."""
    for a, e in m:
        if a == atom:
            return e
    return 0


def _whole_power(a: Sum, exponent: int) -> Sum | None:
    """a to a whole power; None for one below 0 if it is no monomial."""
    if exponent > 0:
        return power(a, exponent)
    return inverse(power(a, -exponent)) if len(a) == 1 else None
