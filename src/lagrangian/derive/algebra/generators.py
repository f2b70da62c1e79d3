"""The table of the variables of the normal form, their derivatives, and the angles inside sines."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.derive.algebra.form import Form, Harmonic, Ring
from lagrangian.derive.algebra.monomials import Packed, digits, multiples, packed, unit
from lagrangian.derive.algebra.variables import Generator, Opaque, Root, Sum, Symbolic, Trig, reciprocal

WRITING = 15_000
"""The number of terms that the search for shorter forms may examine for one system."""


class Generators:
    """The table of generators and angles of an algebra, which grows as new ones are met."""

    def __init__(self, algebra: Ring, coordinates: Sequence[sp.Expr]) -> None:
        self.algebra = algebra
        self.table: list[Generator] = []
        self.roots: dict[int, Root] = {}
        self.angles: list[Form] = []
        self._index: dict[object, int] = {}
        self._angle: dict[tuple[Harmonic, int, Fraction | None], int] = {}
        self._slopes: dict[tuple[str, int, int], int | Form | None] = {}
        self._moving: dict[int, int] = {}
        self._trig: dict[Harmonic, sp.Expr] = {}
        self._costs: dict[int, int] = {}
        self._bases: dict[int, sp.Expr] = {}
        self.writing = WRITING
        self._coordinates = frozenset(coordinates)
        self._speeds: set[sp.Expr] = set()
        self.placeholders: dict[sp.Expr, sp.Expr] = {}
        for q in coordinates:
            self.angle((0, 0), unit(self.index(q)))
        for order in (1, 2):
            for q in coordinates:
                self.index(sp.Derivative(q, (Symbolic.time, order)))

    # -- finding and making -----------------------------------------------------------------------------------------

    def index(self, symbol: sp.Expr) -> int:
        """Return the number of a symbol, a function of time or a derivative of one."""
        if symbol not in self._index:
            found = self._symbolic(symbol)
            self._index[symbol] = len(self.table)
            self.table.append(found)
            if not isinstance(symbol, sp.Symbol):
                self.placeholders[symbol] = sp.Symbol(f"u{self._index[symbol]}")
        return self._index[symbol]

    def add_speed(self, symbol: sp.Expr) -> None:
        """Let a function of time be a rate that is no coordinate's, before it is first met."""
        self._speeds.add(symbol)

    def _symbolic(self, symbol: sp.Expr) -> Symbolic:
        if symbol == Symbolic.time:
            return Symbolic(symbol, "time")
        if symbol in self._speeds:
            return Symbolic(symbol, "rate", 1)
        if isinstance(symbol, sp.Derivative):
            order = int(symbol.derivative_count)
            if symbol.expr in self._speeds:
                return Symbolic(symbol, "acceleration", order + 1)
            if symbol.expr not in self._coordinates:
                return Symbolic(symbol, "input", order)
            return Symbolic(symbol, "rate" if order == 1 else "acceleration", order)
        if isinstance(symbol, AppliedUndef):
            return Symbolic(symbol, "coordinate" if symbol in self._coordinates else "input")
        return Symbolic(symbol, "parameter")

    def root(self, base: Form, q: int) -> int:
        """Return the number of base^(1/q)."""
        key = (q, base.den, frozenset((h, frozenset(p.items())) for h, p in base.parts.items()))
        if key not in self._index:
            moving = any(h[0] and self.turning(h[0]) for h in base.parts) or any(
                self.moving(m) for p in base.parts.values() for m in p
            )
            self._index[key] = i = len(self.table)
            self.roots[i] = root = Root(base, q, moving, reciprocal(base) if moving and q > 1 else None)
            self.table.append(root)
        return self._index[key]

    def opaque(self, expr: sp.Expr) -> int:
        """Return the number of a function that is treated as a symbol."""
        if expr not in self._index:
            atoms = _outermost(expr)
            inside = tuple(sorted(atoms, key=self.index))
            moving = any(self.is_moving(self.index(a)) for a in inside)
            self._index[expr] = len(self.table)
            self.table.append(Opaque(expr, inside, moving))
        return self._index[expr]

    def trig_letter(self, harmonic: Harmonic) -> int:
        """Return the number of a sine or cosine on the page; a sine has the sign that SymPy preserves."""
        key = ("trig", harmonic)
        if key not in self._index:
            expr = self.trig(harmonic) * (self.sign(harmonic[0]) if harmonic[1] else 1)
            made = Trig(harmonic, expr, self.turning(harmonic[0]))
            self._index[key] = len(self.table)
            self.table.append(made)
        return self._index[key]

    def sum_letter(self, base: Mapping[int, Fraction]) -> int:
        """Return the number of a sum of parameters on the page; ``base`` is its polynomial."""
        key = ("sum", frozenset(base.items()))
        if key not in self._index:
            terms = [sp.Rational(c.numerator, c.denominator) * self.expr(m) for m, c in base.items()]
            made = Sum(sp.Add(*terms))
            self._index[key] = len(self.table)
            self.table.append(made)
        return self._index[key]

    def sign(self, h: Packed) -> int:
        """Return −1 if SymPy converts sin(h·a) to −sin(−h·a), which is then the sine on the page."""
        return -1 if self.trig((h, 1)).could_extract_minus_sign() else 1

    def angle(self, harmonic: Harmonic, monomial: int, scale: Fraction | None = None) -> int:
        """Return the number of the angle that is this one term: a monomial, or a monomial times a sine or cosine.

        ``scale`` belongs to the angle if it is too long a fraction for counting multiples.
        """
        key = (harmonic, monomial, scale)
        if key not in self._angle:
            n, d = (scale.numerator, scale.denominator) if scale else (1, 1)
            self._angle[key] = len(self.angles)
            self.angles.append(Form(self.algebra, {harmonic: {monomial: n}}, d))
        return self._angle[key]

    # -- derivatives ------------------------------------------------------------------------------------------------

    def partial(self, i: int, g: int) -> int | Form | None:
        """∂(generator i)/∂(generator g)."""
        if i == g:
            return 0
        entry = self.table[i]
        if isinstance(entry, Symbolic):
            return None
        key = ("partial", i, g)
        if key not in self._slopes:
            symbol = cast("Symbolic", self.table[g]).expr
            if isinstance(entry, Root):
                self._slopes[key] = self._root_slope(i, entry, entry.base.diff(symbol))
            else:
                self._slopes[key] = self._opaque_slope(cast("Opaque", entry), symbol)
        return self._slopes[key]

    def rate(self, i: int) -> int | Form | None:
        """d(generator i)/dt."""
        key = ("rate", i, 0)
        if key not in self._slopes:
            self._slopes[key] = self._rate(i, self.table[i])
        return self._slopes[key]

    def _rate(self, i: int, entry: Generator) -> int | Form | None:
        if isinstance(entry, Symbolic):
            if entry.role == "parameter":
                return None
            if entry.role == "time":
                return 0
            of, taken = entry.expr, 0
            if isinstance(of, sp.Derivative):
                of, taken = of.expr, int(of.derivative_count)
            return unit(self.index(sp.Derivative(of, (Symbolic.time, taken + 1))))
        if not entry.moving:
            return None
        if isinstance(entry, Root):
            return self._root_slope(i, entry, entry.base.total_derivative())
        pieces: list[Form] = []
        entry = cast("Opaque", entry)
        for symbol in entry.inside:
            by, slope = self.index(symbol), self._opaque_slope(entry, symbol)
            rate = self.rate(by)
            if isinstance(rate, int) and slope is not None:
                pieces.append(slope * self.algebra.monomial(rate))
        return _or_none(self.algebra.total(pieces))

    def _root_slope(self, i: int, entry: Root, slope: Form) -> Form | None:
        """d b^(1/q) = (1/q) g^(1−q) db."""
        return _or_none((slope * self.algebra.monomial(unit(i) * (1 - entry.q))).scaled(Fraction(1, entry.q)))

    def _opaque_slope(self, entry: Opaque, symbol: sp.Expr) -> Form | None:
        """SymPy's derivative, with real symbols for the moving ones, so that |x| has the derivative sign(x)."""
        if symbol not in entry.inside:
            return None
        real = {a: sp.Dummy(f"u{k}", real=True) for k, a in enumerate(entry.inside)}
        back = {v: k for k, v in real.items()}
        slope = bounded.diff(cast("sp.Expr", bounded.replaced(entry.expr, real)), real[symbol])
        return _or_none(self.algebra.form(cast("sp.Expr", bounded.replaced(slope, back))))

    def ramp(self, i: int) -> Form | None:
        """u if generator i is max(0, u) or min(0, u)."""
        entry = self.table[i]
        if not (isinstance(entry, Opaque) and isinstance(entry.expr, (sp.Max, sp.Min)) and len(entry.expr.args) == 2):
            return None
        first, second = sorted(entry.expr.args, key=sp.default_sort_key)
        return self.algebra.form(cast("sp.Expr", second)) if first == 0 else None

    def angle_partial(self, j: int, g: int) -> int | Form | None:
        """∂(angle j)/∂(generator g)."""
        key = ("angle", j, g)
        if key not in self._slopes:
            self._slopes[key] = _simple(self.angles[j].diff(cast("Symbolic", self.table[g]).expr))
        return self._slopes[key]

    def angle_rate(self, j: int) -> int | Form | None:
        """d(angle j)/dt."""
        key = ("turning", j, 0)
        if key not in self._slopes:
            self._slopes[key] = _simple(self.angles[j].total_derivative())
        return self._slopes[key]

    # -- questions --------------------------------------------------------------------------------------------------

    def is_moving(self, i: int) -> bool:
        """Whether a generator changes with time."""
        entry = self.table[i]
        return entry.role != "parameter" if isinstance(entry, Symbolic) else entry.moving

    def moving(self, monomial: int) -> int:
        """Return the part of a monomial that changes with time."""
        if monomial not in self._moving:
            self._moving[monomial] = int(packed((i, e) for i, e in digits(monomial) if self.is_moving(i)))
        return self._moving[monomial]

    def turning(self, harmonic: Packed) -> bool:
        """Whether an angle changes with time."""
        return any(self.angle_rate(j) is not None for j, _ in multiples(harmonic))

    def by_coordinates(self, harmonic: Packed) -> bool:
        """Whether an angle changes with a coordinate, and not only with time."""
        inside = {
            i for j, _ in multiples(harmonic) for p in self.angles[j].parts.values() for m in p for i, _ in digits(m)
        }
        return any(self.is_moving(i) and not self._timed(i) for i in inside)

    def _timed(self, i: int) -> bool:
        entry = self.table[i]
        return isinstance(entry, Symbolic) and entry.role in ("time", "input")

    def denominators(self, form: Form) -> int:
        """Return the monomial that clears all denominators of a form, 0 if there are none."""
        least: dict[int, int] = {}
        for p in form.parts.values():
            for m in p:
                for i, e in digits(m):
                    if e < 0 and i in self.roots:
                        least[i] = min(least.get(i, 0), e)
        return int(packed((i, -e) for i, e in least.items()))

    def kept(self, monomials: Iterable[int]) -> tuple[sp.Expr, ...]:
        """Return the roots and functions that occur in these monomials."""
        found = {i for m in monomials for i, _ in digits(m) if not isinstance(self.table[i], Symbolic)}
        return tuple(self.table[i].expr for i in sorted(found))

    def forget(self) -> None:
        """Forget how roots are written: other sums of parameters are letters now."""
        self._bases.clear()

    def affords(self, operations: int) -> bool:
        """Count operations of a search for a shorter form; return False once none are left."""
        self.writing -= operations
        bounded.count_operations(operations)
        if self.writing < 0:
            self.writing = -1
        return self.writing >= 0

    # -- back to SymPy ----------------------------------------------------------------------------------------------

    def cost(self, i: int) -> int:
        """Return the operations inside a generator, where every symbol, rate and acceleration counts as a name."""
        if i not in self._costs:
            self._costs[i] = bounded.operations(bounded.replaced(self.table[i].expr, self.placeholders))
        return self._costs[i]

    def power(self, i: int, exponent: int) -> sp.Expr:
        """Return generator i to a power."""
        entry = self.table[i]
        if isinstance(entry, Root):
            if i not in self._bases:
                self._bases[i] = entry.base.expr()
            return self._bases[i] ** sp.Rational(exponent, entry.q)
        return entry.expr**exponent

    def expr(self, monomial: int) -> sp.Expr:
        """Return a monomial."""
        return sp.Mul(*[self.power(i, e) for i, e in digits(monomial)])

    def angle_expr(self, harmonic: Packed) -> sp.Expr:
        """Return Σ k_j a_j."""
        return sp.Add(*[sp.Rational(k) * self.angles[j].raw() for j, k in multiples(harmonic)])

    def trig(self, harmonic: Harmonic) -> sp.Expr:
        """Return cos(h·a), sin(h·a), or 1."""
        if harmonic not in self._trig:
            h, s = harmonic
            argument = self.angle_expr(h)
            self._trig[harmonic] = sp.sin(argument) if s else sp.cos(argument) if h else sp.S.One
        return self._trig[harmonic]


def _or_none(form: Form) -> Form | None:
    return form if form.parts else None


def _simple(form: Form) -> int | Form | None:
    """The monomial of a form that is a single monomial; None for zero."""
    if not form.parts:
        return None
    if form.den == 1 and list(form.parts) == [(0, 0)]:
        (poly,) = form.parts.values()
        if list(poly.values()) == [1]:
            return next(iter(poly))
    return form


def _outermost(expr: sp.Expr) -> set[sp.Expr]:
    """The symbols on which an expression depends; derivatives as a whole, functions of time without t."""
    found: set[sp.Expr] = set()
    stack: list[sp.Basic] = [expr]
    while stack:
        node = stack.pop()
        if isinstance(node, (AppliedUndef, sp.Derivative, sp.Symbol)):
            found.add(cast("sp.Expr", node))
        else:
            stack.extend(node.args)
    return found
