"""From the normal form to what a textbook prints.

The letters are ordered and grouped, each class of terms by itself: inertia, products of rates, damping, stiffness,
gravity, inputs. In a class the groupings by acceleration, by harmonic, by product of rates and by parameter are tried
and the shortest is taken; where it is no shorter by much, the lecture's grouping by acceleration stays.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import sympy as sp

from lagrangian.derive.normal_generators import Generators
from lagrangian.derive.normal_monomials import digits, packed
from lagrangian.derive.readable_factor import Flat, Shortener, Tree, lead
from lagrangian.derive.readable_trig import Display, displayed

if TYPE_CHECKING:
    from lagrangian.derive.normal import Form

KINDS = ("inertia", "velocity", "damping", "stiffness", "gravity", "other", "input")
"""The kinds of terms, in the order in which they are written."""


@dataclass(frozen=True, eq=False)
class Term:
    """A readable term of an equation and its kind, judged by what it is a multiple of.

    Kinds: "inertia" with an acceleration; "velocity" with a product of rates, or a rate and something else that moves;
    "damping" with one bare rate; "stiffness" with coordinates and no sine; "gravity" with sines of coordinates, or
    constant; "input"; "other".
    """

    expr: sp.Expr
    kind: str


PRODUCT_TERMS = 16
"""Sums of up to this many terms are tried as one product."""


def _is_product(tree: Tree, alike: bool) -> bool:
    """Whether a tree is worth writing as one product: its sums flat, and a square or two of them or terms alike."""
    flat = all(not t.sums for terms, _ in tree.sums for t in terms)
    return flat and (alike or len(tree.sums) > 1 or any(power > 1 for _, power in tree.sums))


class Writer:
    """Writes forms; keeps what it found, since the same sums come again and again."""

    def __init__(self, generators: Generators) -> None:
        self.generators = generators
        self.display = Display(generators)
        self.shortener = Shortener(self.display.cost)

    def expr(self, form: Form) -> sp.Expr:
        """Return the whole as one expression: by classes, or as one factored product where that is shorter."""
        if not form.parts:
            return sp.S.Zero
        flat = displayed(form, self.display)
        classes = self._classes(flat)
        whole = self.shortener.summed(tree for _, tree in classes)
        if 1 < len(flat) <= PRODUCT_TERMS:
            product = self.shortener.short(flat)
            if product.cost < whole.cost and _is_product(product, len({kind for kind, _ in classes}) == 1):
                whole = product
        return self.sympy(whole)

    def terms(self, form: Form) -> list[Term]:
        """Return the terms, class by class."""
        if not form.parts:
            return []
        return [Term(self.sympy(tree), kind) for kind, tree in self._classes(displayed(form, self.display))]

    # -- classes ----------------------------------------------------------------------------------------------------

    def _classes(self, flat: Flat) -> list[tuple[str, Tree]]:
        classes: dict[str, Flat] = {}
        for m, c in flat.items():
            classes.setdefault(self.kind(m), {})[m] = c
        found: list[tuple[str, Tree]] = []
        long = sum(len(p) for p in classes.values()) > 12
        for kind in KINDS:
            if kind in classes:
                found += [(kind, tree) for tree in self._grouped(kind, classes[kind], long)]
        return found

    def kind(self, monomial: int) -> str:
        """Classify a displayed monomial."""
        display = self.display
        rates = moving = 0
        trig = place = False
        for i, e in digits(monomial):
            role = display.role(i)
            if role == "acceleration":
                return "inertia"
            if role == "input":
                return "input"
            if role == "rate":
                rates += abs(e)
            elif role != "parameter":
                moving += 1
                trig = trig or role == "trig"
                place = place or role == "coordinate"
        if rates:
            return "damping" if rates == 1 and not moving else "velocity"
        if not moving or (trig and not place):
            return "gravity"
        return "stiffness" if place and not trig else "other"

    def _grouped(self, kind: str, poly: Flat, long: bool) -> list[Tree]:
        """The terms of one class in the best of the groupings that fit it."""
        ways: list[list[Tree]] = []
        if kind == "inertia":
            ways = [self._by(poly, self._role("acceleration")), self._by(poly, self._role("trig"))]
            if not long:
                ways = ways[:1]
        elif kind == "velocity":
            ways = [
                self._by(poly, self._role("trig")),
                self._by(poly, self._role("rate")),
                self._by(poly, self._but("trig", "rate")),
            ]
        elif kind == "input":
            ways = [self._by(poly, self._role("input"))]
        elif kind in ("gravity", "other"):
            ways = [self._by(poly, self._role("trig", "coordinate"))]
        else:
            ways = [self._whole(poly), self._by(poly, self._role("coordinate", "rate"))]
        return min(ways, key=lambda way: sum(t.cost for t in way) + len(way))

    def _role(self, *roles: str) -> Callable[[int], Hashable]:
        """The part of a monomial made of letters with these roles."""
        role = self.display.role
        return lambda m: packed((i, e) for i, e in digits(m) if role(i) in roles)

    def _but(self, *roles: str) -> Callable[[int], Hashable]:
        role = self.display.role
        return lambda m: packed((i, e) for i, e in digits(m) if role(i) not in roles)

    def _by(self, poly: Flat, key: Callable[[int], Hashable]) -> list[Tree]:
        """One tree a group, in the order of their first terms."""
        groups: dict[Hashable, Flat] = {}
        for m, c in poly.items():
            groups.setdefault(key(m), {})[m] = c
        return [tree for g in sorted(groups.values(), key=lead) for tree in self._whole(g)]

    def _whole(self, poly: Flat) -> list[Tree]:
        """The best factored sum, each of its terms one term."""
        tree = self.shortener.short(poly)
        if tree.coefficient == 1 and tree.monomial == 0 and len(tree.sums) == 1 and tree.sums[0][1] == 1:
            return list(tree.sums[0][0])
        return [tree]

    # -- to SymPy ---------------------------------------------------------------------------------------------------

    def sympy(self, tree: Tree) -> sp.Expr:
        """Return a tree as an expression that keeps its shape."""
        factors: list[sp.Expr] = [self.display.power(i, e) for i, e in digits(tree.monomial)]
        for terms, power in tree.sums:
            factors.append(sp.Add(*[self.sympy(t) for t in terms]) ** power)
        c = tree.coefficient
        number = sp.Rational(c.numerator, c.denominator)
        if number == 1:
            return sp.Mul(*factors)
        if len(factors) == 1 and isinstance(factors[0], sp.Add):
            return sp.Mul(number, factors[0], evaluate=False)
        return sp.Mul(number, *factors)
