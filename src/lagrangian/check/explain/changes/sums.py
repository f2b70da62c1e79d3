"""Changes of sums as they are printed: R in place of R − r, R in place of R + l sin θ, in T*, in V or in both."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.changes.change import LocalChange, Site, Words
from lagrangian.check.explain.changes.ring import Sum, TooLong, minus
from lagrangian.check.explain.changes.sites import Sites
from lagrangian.check.explain.misconceptions.base import partner
from lagrangian.model import time
from lagrangian.page.formula import Name

MOST_SUMMANDS = 4
MOST_SUMS = 12
"""The largest number of sums that are changed."""


class SumChanges:
    """What may stand in place of the sums of letters and positions in the energies of a system."""

    def __init__(self, sites: Sites, lengths: Sequence[sp.Symbol]) -> None:
        self.sites = sites
        self.lengths = list(lengths)
        d = sites.of.derivation
        self.T, self.V = cast("sp.Expr", sp.sympify(d.T)), cast("sp.Expr", sp.sympify(d.V))

    def changes(self) -> Iterator[LocalChange]:
        """A summand left out, with the wrong sign, or with sine for cosine, in T*, in V, and in both."""
        everywhere: Words = ("the whole derivation",)
        for whole in self._sums():
            in_T, in_V = self.T.has(whole), self.V.has(whole)
            for instead, cost in _instead(whole):
                T = self._difference(self.T, whole, instead) if in_T else {}
                V = self._difference(self.V, whole, instead) if in_V else {}
                if T is None or V is None:
                    continue
                if T:
                    yield self._of(cost, Site(words=(Name("T*"),), brief=(Name("T*"),), step=2, T=T), whole, instead)
                if V:
                    yield self._of(cost, Site(words=(Name("V"),), brief=(Name("V"),), step=3, V=V), whole, instead)
                if T and V:
                    site = Site(words=everywhere, brief=everywhere, step=1, T=T, V=V)
                    yield self._of(cost + 0.1, site, whole, instead)

    def _sums(self) -> list[sp.Expr]:
        """The sums of lengths and what moves inside T* and V, without squares and rates.

        A sum of products with other letters, m g + k y, is a common factor and no length.
        """
        s = self.sites.of
        found: dict[Any, None] = {}
        for energy in (self.T, self.V):
            for node in sp.preorder_traversal(energy):
                if isinstance(node, sp.Add) and node != energy and not node.has(*s.v):
                    found[node] = None
        held = {f: sp.S.One for x in found for f in x.atoms(sp.sin, sp.cos)}
        known = {*self.lengths, time}
        plain = [
            x
            for x in found
            if len(x.args) <= MOST_SUMMANDS
            and x.has(*s.q, *self.lengths)
            and not x.atoms(sp.Pow)
            and cast("sp.Expr", x.xreplace(held)).free_symbols <= known
        ]
        return plain[:MOST_SUMS]

    def _difference(self, energy: sp.Expr, whole: sp.Expr, instead: sp.Expr) -> Sum | None:
        s, ring = self.sites.of, self.sites.ring
        try:
            new = ring.of(s.expand(cast("sp.Expr", bounded.replaced(energy, {whole: instead}))))
            return ring.moving(minus(new, ring.of(s.expand(energy))))
        except TooLong:
            return None

    def _of(self, cost: float, site: Site, right: sp.Expr, written: sp.Expr) -> LocalChange:
        return LocalChange(kind="sum", cost=cost, site=site, effect=site, right=right, written=written)


def _instead(whole: sp.Expr) -> Iterator[tuple[sp.Expr, float]]:
    for part in sp.Add.make_args(whole):
        yield cast("sp.Expr", whole - part), 1.45
        if part != sp.Add.make_args(whole)[0]:
            yield cast("sp.Expr", whole - 2 * part), 1.75
        turned = part.atoms(sp.sin, sp.cos)
        if len(turned) == 1:
            [f] = turned
            yield cast("sp.Expr", whole - part + part.xreplace({f: partner(cast("sp.Expr", f))})), 1.6
