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

from lagrangian.derive.normal_generators import Generators, Root, Symbolic, Trig
from lagrangian.derive.normal_monomials import digits, packed, unit
from lagrangian.derive.readable_factor import FACTOR_TERMS, SEARCH, Flat, Shortener, Tree, lead, order
from lagrangian.derive.readable_trig import displayed

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


def _merge_inputs(classes: dict[str, Flat], home_of: Callable[[int], str]) -> None:
    """Move bare inputs beside the springs and dampers they act through: k (x − u) is one term."""
    for m, c in list(classes.get("input", {}).items()):
        home = home_of(m)
        if home in classes:
            del classes["input"][m]
            classes[home][m] = c


def _letters(tree: Tree) -> set[int]:
    found = {i for i, _ in digits(tree.monomial)}
    for terms, _ in tree.sums:
        for t in terms:
            found |= _letters(t)
    return found


def _with_square(flat: Flat, base: Flat, root: int) -> Flat:
    """Replace c·base by c·root² wherever all terms of it are there: k (d − l)² / 2 can then be seen as a square."""
    first, lead_c = min(base.items(), key=lambda x: order(x[0]))
    out = dict(flat)
    for m, c in flat.items():
        times, factor = m - first, c / lead_c
        if all(out.get(times + n) == factor * v for n, v in base.items()):
            for n in base:
                del out[times + n]
            out[times + 2 * root] = out.get(times + 2 * root, 0) + factor
    return out


class Writer:
    """Writes forms; keeps what it found, since the same sums come again and again."""

    def __init__(self, generators: Generators) -> None:
        self.generators = generators
        self.shortener = Shortener(generators.cost)

    def expr(self, form: Form) -> sp.Expr:
        """Return the whole as one expression: by classes, or as one factored product where that is shorter."""
        if not form.parts:
            return sp.S.Zero
        flat = self._letters(form)
        classes = self._classes(flat)
        whole = self.shortener.summed(tree for _, tree in classes)
        if 1 < len(flat) <= FACTOR_TERMS:
            product = self.shortener.factored(flat)
            if product is not None and product.cost < whole.cost:
                whole = product
        return self.sympy(whole)

    def terms(self, form: Form) -> list[Term]:
        """Return the terms, class by class."""
        if not form.parts:
            return []
        return [Term(self.sympy(tree), kind) for kind, tree in self._classes(self._letters(form))]

    def _letters(self, form: Form) -> Flat:
        """The form in letters for the page; l² + x² + h² − 2 l √(x² + h²) with the square of the root put back."""
        flat = displayed(form, self.generators)
        self.shortener.budget = max(SEARCH, 30 * len(flat))
        for i in {i for m in flat for i, e in digits(m) if e == 1 and i in self.generators.roots}:
            root = self.generators.roots[i]
            if root.q == 2 and root.base.size > 1:
                flat = _with_square(flat, displayed(root.base, self.generators), unit(i))
        return flat

    def role(self, letter: int) -> str:
        """Return "trig", "function", or the role of the symbol; a function of parameters alone is a parameter."""
        entry = self.generators.table[letter]
        if isinstance(entry, Symbolic):
            return entry.role
        if not entry.moving:
            return "parameter"
        return "trig" if isinstance(entry, Trig) else "function"

    # -- classes ----------------------------------------------------------------------------------------------------

    def _classes(self, flat: Flat) -> list[tuple[str, Tree]]:
        """Every class made readable; constants go with the stiffness or the gravity, where they make it shorter."""
        classes: dict[str, Flat] = {}
        for m, c in flat.items():
            classes.setdefault(self.kind(m), {})[m] = c
        constant = classes.pop("constant", {})
        _merge_inputs(classes, self._bare)
        long = sum(len(p) for p in classes.values()) > 12
        homes = [kind for kind in ("stiffness", "gravity") if kind in classes] or ["gravity"]
        ways: list[list[tuple[str, Tree]]] = []
        for home in homes if constant else homes[:1]:
            dealt = {**classes, home: {**classes.get(home, {}), **constant}}
            ways.append(
                [
                    (self._kind_of(tree, kind), tree)
                    for kind in KINDS
                    if dealt.get(kind)
                    for tree in self._grouped(kind, dealt[kind], long)
                ]
            )
        best = min(ways, key=lambda way: sum(t.cost + 1 for _, t in way))
        return sorted(best, key=lambda x: KINDS.index(x[0]))

    def _kind_of(self, tree: Tree, kind: str) -> str:
        """The kind of a finished term: a constant or an input alone is not stiffness, though it was dealt with it."""
        if kind not in ("stiffness", "damping"):
            return kind
        roles = {self.role(i) for i in _letters(tree)}
        if roles & {"coordinate", "rate", "function"}:
            return kind
        return "input" if "input" in roles else "gravity"

    def _bare(self, monomial: int) -> str:
        """Where an input stands alone with parameters: beside "stiffness", its rate beside "damping"; else nowhere."""
        moving = [(i, e) for i, e in digits(monomial) if self.role(i) != "parameter"]
        if len(moving) != 1:
            return ""
        return "damping" if isinstance(self.generators.power(moving[0][0], 1), sp.Derivative) else "stiffness"

    def kind(self, monomial: int) -> str:
        """Classify a displayed monomial."""
        rates = moving = 0
        trig = place = False
        for i, e in digits(monomial):
            role = self.role(i)
            if role == "acceleration":
                return "inertia"
            if role == "input":
                return "input"
            if role == "rate":
                rates += abs(e)
            elif role != "parameter":
                moving += 1
                trig = trig or role == "trig"
                place = place or role == "coordinate" or isinstance(self.generators.table[i], Root)
        if rates:
            return "damping" if rates == 1 and not moving else "velocity"
        if not moving:
            return "constant"
        return "gravity" if trig else "stiffness" if place else "other"

    def _grouped(self, kind: str, poly: Flat, long: bool) -> list[Tree]:
        """The terms of one class in the best of the groupings that fit it; of equals, the first."""
        if len(poly) == 1:
            return [self.shortener.short(poly)]
        if kind == "inertia":
            ways = [self._by(poly, self._role("acceleration"))]
            if long:
                ways.append(self._by(poly, self._role("trig")))
        elif kind == "velocity":
            ways = [
                self._by(poly, self._role("trig")),
                self._by(poly, self._role("rate")),
                self._by(poly, self._but("trig", "rate"), merge=True),
            ]
        elif kind == "input":
            ways = [self._by(poly, self._role("input"))]
        elif kind in ("gravity", "other"):
            ways = [self._by(poly, self._role("trig", "coordinate"))]
            if any(self.role(i) == "function" for m in poly for i, _ in digits(m)):
                ways.append(self._whole(poly, spread=True))
            if len(poly) == 2 and any(self.kind(m) == "constant" for m in poly):
                ways.append([self.shortener.short(poly)])
        else:
            ways = [
                self._by(poly, self._but("coordinate", "rate", "input", "function"), merge=True),
                self._whole(poly),
                self._by(poly, self._role("coordinate", "rate")),
            ]
        return min(ways, key=lambda way: sum(t.cost for t in way) + len(way))

    def _role(self, *roles: str) -> Callable[[int], int]:
        """The part of a monomial made of letters with these roles."""
        role = self.role
        return lambda m: int(packed((i, e) for i, e in digits(m) if role(i) in roles))

    def _but(self, *roles: str) -> Callable[[int], int]:
        role = self.role
        return lambda m: int(packed((i, e) for i, e in digits(m) if role(i) not in roles))

    def _by(self, poly: Flat, key: Callable[[int], int], *, merge: bool = False) -> list[Tree]:
        """One tree a group, in the order of first terms; with ``merge``, groups that differ by a factor are one."""
        groups: dict[int, Flat] = {}
        for m, c in poly.items():
            groups.setdefault(key(m), {})[m] = c
        dealt = list(groups.values())
        if merge:
            alike: dict[Hashable, Flat] = {}
            for g in groups.values():
                first = g[min(g, key=order)]
                cofactor = frozenset((m - key(m), c / first) for m, c in g.items())
                alike.setdefault(cofactor, {}).update(g)
            dealt = list(alike.values())
        return [tree for g in sorted(dealt, key=lead) for tree in self._whole(g)]

    def _whole(self, poly: Flat, *, spread: bool = False) -> list[Tree]:
        """The best factored sum, each of its terms one term; with ``spread`` what they share is put into each.

        k (x₁ − x₂) stays one term; g (m₁ L₁ sin θ₁ + m₂ L₂ sin θ₂) is spread into two.
        """
        tree = self.shortener.short(poly)
        if len(tree.sums) != 1 or tree.sums[0][1] != 1:
            return [tree]
        plain = tree.monomial == 0 and (abs(tree.coefficient) == 1 or tree.coefficient.numerator == 1)
        if not (plain or spread):
            return [tree]
        return [self.shortener.times(t, tree.coefficient, tree.monomial) for t in tree.sums[0][0]]

    # -- to SymPy ---------------------------------------------------------------------------------------------------

    def sympy(self, tree: Tree) -> sp.Expr:
        """Return a tree as an expression that keeps its shape."""
        factors: list[sp.Expr] = [self.generators.power(i, e) for i, e in digits(tree.monomial)]
        for terms, power in tree.sums:
            factors.append(sp.Add(*[self.sympy(t) for t in terms]) ** power)
        c = tree.coefficient
        number = sp.Rational(c.numerator, c.denominator)
        if number == 1:
            return sp.Mul(*factors)
        if len(factors) == 1 and isinstance(factors[0], sp.Add):
            return sp.Mul(number, factors[0], evaluate=False)
        return sp.Mul(number, *factors)
