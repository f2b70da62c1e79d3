"""All variants of all known mistakes in a system, and their effect on every line of an answer at the random states.

All variants are computed at once, on one graph: ΔW_i = d/dt ∂ΔT/∂ξ̇_i − ∂ΔT/∂ξ_i + ∂ΔV/∂ξ_i − ΔΞ_i + Δrow_i.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property, lru_cache
from types import ModuleType

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions import MISCONCEPTIONS, Ingredients, Variant
from lagrangian.check.reference import Reference, without_time
from lagrangian.check.verdict import Mistake
from lagrangian.derive import Derived
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.errors import ModelError
from lagrangian.graph import jvp, vjp
from lagrangian.model import time
from lagrangian.page.formula import text
from lagrangian.records import dataclass

LONGEST_SYSTEM = 2_000
"""If T*, V and Ξ have more operations, times the number of coordinates, mistakes are reported only by their terms."""

WORK = 120_000
"""The total number of operations of all variants, likely ones first; those of a robot arm have half as many."""


@dataclass(frozen=True, eq=False)
class Wrong:
    """A variant of a misconception; ``rank`` is its place in the order of likelihood."""

    module: ModuleType
    variant: Variant
    rank: int

    @property
    def name(self) -> str:
        """The name of the misconception, which is the name of its file."""
        return self.module.__name__.rsplit(".", 1)[-1]

    @property
    def step(self) -> int:
        """The step of the lecture in which the mistake was made."""
        v = self.variant
        if v.step is not None:
            return v.step
        if v.rows or v.only is not None or ("L" in v.stated and "V" not in v.stated):
            own = {"T*": 2, "V": 3, "Ξ": 6}.get(v.element.ledger, 5) if v.element is not None else self.module.STEP
            return self.module.STEP if self.module.STEP in (1, 4, 5, own) else own if own == 6 else 5
        if v.Xi:
            return 6 if v.T == 0 and v.V == 0 else self.module.STEP
        return 2 if v.T != 0 and v.V == 0 else 3 if v.T == 0 else self.module.STEP

    def mistake(self, truth: Reference) -> Mistake:
        """The mistake as data."""
        v = self.variant
        name = truth.model.coordinates[v.coordinate].name if v.coordinate is not None else None
        title = v.element.title if v.element is not None else None
        first, *more = v.what.parts
        begins = isinstance(first, str) and title is not None and first.startswith(title)  # a title begins the sentence
        what = text(str(first)[:1].upper() + str(first)[1:], *more) if begins else v.what
        return Mistake(self.name, what, v.why or self.module.WHY, self.step, title, name, body=v.body)


class Effects:
    """The effects of every variant at every state."""

    def __init__(self, truth: Reference) -> None:
        self.truth = truth
        self.graph = CompiledExpressions([])
        c = truth.model.coordinates
        self._q = [self.graph.input(x.symbol) for x in c]
        self._v = [self.graph.input(x.rate) for x in c]
        self._a = [self.graph.input(x.acceleration) for x in c]
        self._moving = dict(zip((*self._q, *self._v), (*self._v, *self._a), strict=True))
        self._moving[self.graph.input(time)] = self.graph.graph.one
        variants = () if too_long(truth) else _variants(truth.derivation)
        if variants and variants[-1] is None:
            truth.tried_all = False
        self.wrongs = tuple(w for w in variants if w is not None and self._added(w))

    def _added(self, wrong: Wrong) -> bool:
        """Add the nodes of ΔT, ΔV, ΔΞ_i and ΔW_i of a variant; return False if it divides by 0 and is therefore not
        usable."""
        v = wrong.variant
        put = self.truth.put
        try:
            T, V = self.graph.node(put(v.T)), self.graph.node(without_time(self.truth, put(v.V)))
            Xi = [self.graph.node(put(sp.sympify(v.Xi.get(i, 0)))) for i in range(self.truth.n)]
            self.graph.ids += [T, V, *Xi, *self.rows(v, T, V, Xi)]
        except ModelError:
            return False
        return True

    def rows(self, v: Variant, T: int, V: int, Xi: Sequence[int]) -> list[int]:
        """The nodes of ΔW."""
        g, n = self.graph.graph, self.truth.n
        rows = [g.neg(x) for x in Xi]
        felt = range(n) if v.only is None else sorted(v.only)
        if v.T != 0:
            slopes = vjp(g, [T], [g.one], [*self._q, *self._v])
            rates = jvp(g, slopes[n:], self._moving)
            for i in felt:
                rows[i] = g.add(rows[i], g.sub(rates[i], slopes[i]))
        if v.V != 0:
            slopes = vjp(g, [V], [g.one], self._q)
            for i in felt:
                rows[i] = g.add(rows[i], slopes[i])
        for i, extra in v.rows.items():
            rows[i] = g.add(rows[i], self.graph.node(self.truth.put(sp.sympify(extra))))
        return rows

    @cached_property
    def _values(self) -> Array:
        """All quantities of every variant at every state, shape (variants, 2 + 2n, size)."""
        n = self.truth.n
        return self.graph.at(self.truth.states).reshape(len(self.wrongs), 2 + 2 * n, self.truth.states.size)

    @cached_property
    def T(self) -> Array:
        """ΔT for variants that are visible in a line of T*, otherwise 0, (variants, size)."""
        return self._values[:, 0] * self._shown("T")

    @cached_property
    def V(self) -> Array:
        """ΔV for variants that are visible in a line of V, otherwise 0, (variants, size)."""
        return self._values[:, 1] * self._shown("V")

    @cached_property
    def L(self) -> Array:
        """ΔT − ΔV for variants that are visible in a line of L, otherwise 0, (variants, size)."""
        return (self._values[:, 0] - self._values[:, 1]) * self._shown("L")

    @cached_property
    def Xi(self) -> Array:
        """ΔΞ for variants that are visible in a line of a Ξ, otherwise 0, (variants, n, size)."""
        return self._values[:, 2 : 2 + self.truth.n] * self._shown("Xi")[:, :, None]

    @cached_property
    def W(self) -> Array:
        """ΔW, (variants, n, size)."""
        return self._values[:, 2 + self.truth.n :]

    def momenta(self, i: int) -> Array:
        """∂ΔT/∂ξ̇_i for variants that are visible in a line of T*, otherwise 0, (variants, size)."""
        compiled = CompiledExpressions([])
        g, v = compiled.graph, compiled.input(self.truth.model.coordinates[i].rate)
        nodes = [compiled.node(self.truth.put(w.variant.T)) for w in self.wrongs]
        compiled.ids = [vjp(g, [node], [g.one], [v])[0] for node in nodes]
        return compiled.at(self.truth.states) * self._shown("T")

    def _shown(self, key: str) -> Array:
        """1 for the variants that are visible in a line of this kind, which excludes those of single equations."""
        shown = [key in w.variant.stated and w.variant.only is None for w in self.wrongs]
        return np.array(shown, dtype=float)[:, None]


@lru_cache(maxsize=16)
def ingredients_of(derivation: Derived) -> Ingredients:
    """The ingredients of a derivation's equations, collected once."""
    return Ingredients(derivation)


@lru_cache(maxsize=16)
def _variants(derivation: Derived) -> tuple[Wrong | None, ...]:
    """The variants of all misconceptions in a system, whatever its values; None at the end if some were left out."""
    found: list[Wrong | None] = []
    left = WORK
    for rank, module in enumerate(MISCONCEPTIONS):
        for variant in module.wrong(ingredients_of(derivation)):
            left -= _operations(variant)
            if left < 0:
                return (*found, None)
            found.append(Wrong(module, variant, rank))
    return tuple(found)


def too_long(truth: Reference) -> bool:
    """Whether a system is too large to try all variants of all mistakes."""
    return sum(bounded.size(x) for x in (truth.T, truth.V, *truth.Xi)) * truth.n > LONGEST_SYSTEM


def _operations(v: Variant) -> int:
    """The number of operations of a variant when it is written out."""
    return sum(bounded.size(sp.sympify(x)) for x in (v.T, v.V, *v.Xi.values(), *v.rows.values()))


@lru_cache(maxsize=32)
def effects_of(truth: Reference) -> Effects:
    """All variants in a system, computed once for the systems that were checked most recently."""
    return Effects(truth)
