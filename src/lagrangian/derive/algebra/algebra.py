"""The polynomial ring for the expressions of a system, and Lagrange's equations in it."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Collection, Iterable
from math import lcm
from typing import Protocol

import sympy as sp

from lagrangian.advice import Advice, Verb
from lagrangian.bounded import Budget
from lagrangian.derive.algebra.form import LARGEST_FORM, Form, Harmonic, OutOfReach
from lagrangian.derive.algebra.generators import WRITING, Generators
from lagrangian.derive.algebra.monomials import Packed, Poly, digits, unit
from lagrangian.derive.algebra.readable import Writer
from lagrangian.derive.algebra.reading import FormReader
from lagrangian.derive.algebra.variables import Symbolic

WORK = 5_000_000
"""The number of operations on terms for one system; textbook examples need a hundredth of it."""


LETTERS = 128
"""The number of symbols of a term that cost one operation."""


def _spent(limit: int) -> OutOfReach:
    verbs = Verb("simulate"), ", ", Verb("linearize"), ", ", Verb("export")
    return OutOfReach(
        f"writing the equations out takes more than {limit} products of terms",
        fix=Advice("use ", *verbs, " or, in Python, compile(), which do not need the written equations"),
        code="E601",
    )


class HasCoordinates(Protocol):
    """The requirements of the algebra on a model: its coordinates, in order, each with a ``symbol``."""

    @property
    def coordinates(self) -> Collection[HasSymbol]:
        """The generalized coordinates."""
        ...


class HasSymbol(Protocol):
    """Something that has a symbol."""

    @property
    def symbol(self) -> sp.Expr:
        """The symbol, a function of time."""
        ...


class Algebra:
    """The polynomial ring for the expressions of a system, made once.

    ``model`` gives the coordinates, whose order is the order of terms. ``expressions`` are converted first, so that the
    shape of later results does not depend on the order of requests.
    """

    def __init__(self, model: HasCoordinates, expressions: Iterable[sp.Expr] = ()) -> None:
        self.work = Budget(WORK, _spent)
        self.generators = Generators(self, [c.symbol for c in model.coordinates])
        self.reader = FormReader(self)
        self.writer = Writer(self.generators)
        for expr in expressions:
            self.writer.learn(self.form(expr))
        self.generators.forget()

    def spend(self, operations: int) -> None:
        """Count operations on terms, whose length is the number of symbols. Raises `OutOfReach` above `WORK`."""
        self.work.spend(operations * (1 + len(self.generators.table) // LETTERS))

    def renew(self) -> None:
        """Restart the count, for another answer or another page."""
        self.work.left, self.generators.writing = self.work.limit, WRITING

    def form(self, expr: sp.Expr) -> Form:
        """Return the normal form; raise `OutOfReach` if it would be too long or is not a real expression."""
        return self.reader.form(sp.sympify(expr))

    def number(self, value: Packed) -> Form:
        """Return a rational constant."""
        return Form(self, {(0, 0): {0: value.numerator}}, value.denominator)

    def monomial(self, packed: int) -> Form:
        """Return a monomial of generators."""
        return Form(self, {(0, 0): {packed: 1}})

    def total(self, forms: Iterable[Form]) -> Form:
        """Return the sum of any number of forms."""
        forms = [f for f in forms if f.parts]
        if not forms:
            return Form(self, {})
        if len(forms) == 1:
            return forms[0]
        self.spend(sum(f.size for f in forms))
        den = lcm(*(f.den for f in forms))
        out: dict[Harmonic, Poly] = {}
        for f in forms:
            scale = den // f.den
            for h, p in f.parts.items():
                here = out.setdefault(h, {})
                for m, c in p.items():
                    here[m] = here.get(m, 0) + c * scale
        result = Form(self, out, den)
        if result.size > LARGEST_FORM:
            raise OutOfReach(f"a sum of {result.size} terms is too long to write out")
        return result

    def reduced(self, form: Form) -> Form:
        """Return the form with g^q replaced by b for every generator g = b^(1/q)."""
        roots = self.generators.roots
        if not roots:
            return form
        keep: dict[Harmonic, Poly] = {}
        extra: dict[tuple[int, int], dict[Harmonic, Poly]] = {}
        for h, p in form.parts.items():
            for m, c in p.items():
                for i, e in digits(m):
                    if i in roots and roots[i].lowers(e):
                        times = e // roots[i].q
                        lower = m - unit(i) * times * roots[i].q
                        extra.setdefault((i, times), {}).setdefault(h, {})[lower] = c
                        break
                else:
                    keep.setdefault(h, {})[m] = c
        if not extra:
            return form
        replaced = [Form(self, parts, form.den) * roots[i].whole(times) for (i, times), parts in extra.items()]
        return self.total([Form(self, keep, form.den), *replaced])


def equations(
    kinetic: Iterable[Form], potential: Iterable[Form], coordinates: Iterable[sp.Expr], algebra: Algebra
) -> list[Form]:
    """Return d/dt(∂T*/∂ξ̇_i) − ∂T*/∂ξ_i + ∂V/∂ξ_i for every coordinate."""
    T, V = algebra.total(kinetic), algebra.total(potential)
    sides: list[Form] = []
    for q in coordinates:
        momentum = T.diff(sp.Derivative(q, Symbolic.time))
        sides.append(algebra.total([momentum.total_derivative(), -T.diff(q), V.diff(q)]))
    return sides
