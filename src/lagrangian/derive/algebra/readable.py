"""Converts the normal form to textbook form.

The terms are sorted and divided into classes: inertia, products of rates, damping, stiffness, gravity, inputs. Each
class is grouped separately, see `group`.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Literal, get_args

import sympy as sp

from lagrangian.derive.algebra.factor import FACTOR_TERMS, SEARCH, Flat, Shortener, Tree, order
from lagrangian.derive.algebra.form import Form, Term
from lagrangian.derive.algebra.generators import Generators
from lagrangian.derive.algebra.group import MIN_HARMONIC_TERMS, Grouper, letters, role_of
from lagrangian.derive.algebra.monomials import digits, unit
from lagrangian.derive.algebra.sums import MAX_SUMS, sums_in, with_sums
from lagrangian.derive.algebra.trig import displayed
from lagrangian.derive.algebra.variables import Root
from lagrangian.page.formula import TermKind

WRITTEN = 50
"""The cost of writing a term in SymPy, in products of terms in normal form."""

KINDS: tuple[TermKind, ...] = get_args(TermKind)
"""The kinds of terms, in the order in which they are written."""


def _merge_inputs(classes: dict[str, Flat], home_of: Callable[[int], str]) -> None:
    """Move inputs to the springs and dampers through which they act: k (x − u) is one term."""
    for m, c in list(classes.get("input", {}).items()):
        home = home_of(m)
        if home in classes:
            del classes["input"][m]
            classes[home][m] = c


def _with_square(flat: Flat, base: Flat, root: int) -> Flat:
    """Replace c·base by c·root² if all terms of it occur, so that k (d − l)² / 2 is recognized as a square."""
    first, lead_c = min(base.items(), key=lambda x: order(x[0]))
    out = dict(flat)
    for m, c in flat.items():
        times, factor = m - first, c / lead_c
        if all(out.get(times + n) == factor * v for n, v in base.items()):
            for n in base:
                del out[times + n]
            squared = out.get(times + 2 * root, 0) + factor
            if squared:
                out[times + 2 * root] = squared
            else:  # it stood there with the other sign
                del out[times + 2 * root]
    return out


class Writer:
    """Converts forms, and caches the results, because the same sums occur again and again."""

    def __init__(self, generators: Generators) -> None:
        self.generators = generators
        self.shortener = Shortener(generators.cost, generators.affords)
        self.grouper = Grouper(generators, self.shortener)
        self.sums: list[Flat] = []

    def learn(self, form: Form) -> None:
        """Remember the sums of parameters in a given energy; other forms may become shorter with them."""
        self.sums += [s for s in sums_in(form, self.generators) if s not in self.sums][: MAX_SUMS - len(self.sums)]

    def expr(self, form: Form) -> sp.Expr:
        """Return the form as one expression: by classes, or as one factored product if that is shorter."""
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
        """The form in displayed symbols; in l² + x² + h² − 2 l √(x² + h²), the square of the root is restored."""
        flat = displayed(form, self.generators)
        self.shortener.budget = max(SEARCH, 30 * len(flat))
        for i in {i for m in flat for i, e in digits(m) if e == 1 and i in self.generators.roots}:
            root = self.generators.roots[i]
            if root.q == 2 and root.base.size > 1:
                flat = _with_square(flat, displayed(root.base, self.generators), unit(i))
        return with_sums(flat, self.sums, self.generators)

    def role(self, letter: int) -> str:
        """Return the role of a symbol, see `role_of`."""
        return role_of(self.generators, letter)

    # -- classes ----------------------------------------------------------------------------------------------------

    def _classes(self, flat: Flat) -> list[tuple[TermKind, Tree]]:
        """All classes in readable form; constants are combined with stiffness or gravity if that is shorter."""
        classes: dict[str, Flat] = {}
        for m, c in flat.items():
            classes.setdefault(self.kind(m), {})[m] = c
        constant = classes.pop("constant", {})
        _merge_inputs(classes, self._bare)
        long = sum(len(p) for p in classes.values()) > MIN_HARMONIC_TERMS
        homes = [kind for kind in ("stiffness", "gravity") if kind in classes] or ["gravity"]
        ways: list[list[tuple[TermKind, Tree]]] = []
        for home in homes if constant else homes[:1]:
            dealt = {**classes, home: {**classes.get(home, {}), **constant}}
            ways.append(
                [
                    (kind, tree)
                    for kind in KINDS
                    if dealt.get(kind)
                    for tree in self.grouper.grouped(kind, dealt[kind], long)
                ]
            )
        best = min(ways, key=lambda way: sum(t.cost + 1 for _, t in way))
        listed: list[tuple[TermKind, TermKind, Tree]]
        listed = [(kind, self._kind_of(tree, kind), tree) for kind, tree in best]
        listed.sort(key=lambda x: KINDS.index(x[0] if x[0] == "damping" and x[1] == "velocity" else x[1]))
        return [(kind, tree) for _, kind, tree in listed]

    def _kind_of(self, tree: Tree, kind: TermKind) -> TermKind:
        """The kind of a finished term; a single constant or input is not stiffness, though it was grouped with it."""
        if kind not in ("stiffness", "damping"):
            return kind
        roles = {self.role(i) for i in letters(tree)}
        if kind == "damping" and roles & {"coordinate", "function", "trig"}:
            return "velocity"
        if roles & {"coordinate", "rate", "function"}:
            return kind
        return "input" if "input" in roles else "gravity"

    def _bare(self, monomial: int) -> Literal["", "damping", "stiffness"]:
        """The class for an input that is multiplied only by parameters: "stiffness", or "damping" for its rate."""
        moving = [(i, e) for i, e in digits(monomial) if self.role(i) != "parameter"]
        if len(moving) != 1:
            return ""
        return "damping" if isinstance(self.generators.power(moving[0][0], 1), sp.Derivative) else "stiffness"

    def kind(self, monomial: int) -> TermKind | Literal["constant"]:
        """The class of a displayed monomial; everything linear in the rates is grouped as damping."""
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
            return "damping" if rates == 1 else "velocity"
        if not moving:
            return "constant"
        return "gravity" if trig else "stiffness" if place else "other"

    # -- to SymPy ---------------------------------------------------------------------------------------------------

    def _balanced(self, tree: Tree) -> Tree:
        """The tree with its fractions in one style: ½ (J + ¼ m l²), not ⅛ (4 J + m l²).

        The fraction before a parenthesis is the largest of the numbers in it, if that leaves whole numbers and 1/n.
        """
        number = tree.coefficient
        sums: list[tuple[tuple[Tree, ...], int]] = []
        for terms, power in tree.sums:
            largest = max(abs(t.coefficient) for t in terms)
            inside = [t.coefficient / largest for t in terms]
            short = all(1 in (abs(c.numerator), c.denominator) for c in inside)
            bare = any(not t.monomial and not t.sums and c.denominator > 1 for t, c in zip(terms, inside, strict=True))
            if power == 1 and number.denominator > 1 and short and not bare and abs(number * largest) <= 1:
                number *= largest
                terms = tuple(replace(t, coefficient=c) for t, c in zip(terms, inside, strict=True))
            sums.append((terms, power))
        return replace(tree, coefficient=number, sums=tuple(sums))

    def sympy(self, tree: Tree) -> sp.Expr:
        """Return a tree as an expression that keeps its shape."""
        self.generators.algebra.spend(WRITTEN)
        tree = self._balanced(tree)
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
