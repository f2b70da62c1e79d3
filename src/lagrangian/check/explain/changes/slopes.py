"""The effect of monomials on the equations at random states, all monomials at once.

For a monomial μ = Π aᵉ the logarithm ℓ = Σ e ln a is linear in the exponents, so that the values of
d/dt ∂μ/∂ξ̇_i − ∂μ/∂ξ_i = μ (ℓ̇ ∂ℓ/∂ξ̇_i + d/dt ∂ℓ/∂ξ̇_i − ∂ℓ/∂ξ_i) need only the values and slopes of the atoms.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import sympy as sp

from lagrangian.check.explain.changes.ring import Monomial, SumRing
from lagrangian.check.reference import Reference
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.graph import jvp, vjp
from lagrangian.model import time


class AtomSlopes:
    """Values and slopes of all atoms of a ring at the states of a reference.

    ``value`` (K, S); ``by_q`` ∂a/∂ξ_i and ``by_v`` ∂a/∂ξ̇_i (K, n, S); ``rate`` da/dt (K, S); ``by_v_rate``
    d/dt ∂a/∂ξ̇_i (K, n, S).
    """

    def __init__(self, truth: Reference, ring: SumRing) -> None:
        n, size = truth.n, truth.states.size
        compiled = CompiledExpressions([])
        g, c = compiled.graph, truth.model.coordinates
        q, v = [compiled.input(x.symbol) for x in c], [compiled.input(x.rate) for x in c]
        a = [compiled.input(x.acceleration) for x in c]
        moving = dict(zip((*q, *v), (*v, *a), strict=True)) | {compiled.input(time): g.one}
        ids: list[int] = []
        atoms = [truth.put(atom) for atom in ring.atoms]
        nowhere = [k for k, atom in enumerate(atoms) if atom.has(sp.zoo, sp.nan, sp.oo)]  # 1/(r - r)
        for k, atom in enumerate(atoms):
            node = g.one if k in nowhere else compiled.node(atom)
            slopes = vjp(g, [node], [g.one], [*q, *v])
            ids += [node, *slopes, *jvp(g, [node, *slopes[n:]], moving)]
        compiled.ids = ids
        values = compiled.at(truth.states).reshape(len(ring.atoms), 2 + 3 * n, size)
        self.count, self.n, self.size = len(ring.atoms), n, size
        self.value = values[:, 0]
        with np.errstate(all="ignore"):
            inverse = 1.0 / self.value
            self.by_q = values[:, 1 : 1 + n] * inverse[:, None]
            by_v = values[:, 1 + n : 1 + 2 * n]
            self.by_v = by_v * inverse[:, None]
            self.rate = values[:, 1 + 2 * n] * inverse
            self.by_v_rate = values[:, 2 + 2 * n :] * inverse[:, None] - self.by_v * self.rate[:, None]
        self._without_undefined()
        self.value[nowhere] = np.nan

    def _without_undefined(self) -> None:
        """Give atoms that are not smooth somewhere the value NaN there, so that they spoil no other monomial."""
        finite = np.isfinite(self.value) & np.isfinite(self.rate)
        for slopes in (self.by_q, self.by_v, self.by_v_rate):
            finite &= np.isfinite(slopes).all(axis=1)
            slopes[~np.isfinite(slopes)] = 0.0
        self.rate[~np.isfinite(self.rate)] = 0.0
        self.value = np.where(finite, self.value, np.nan)

    def exponents(self, monomials: Sequence[Monomial]) -> Array:
        """The exponents of all atoms in every monomial, (M, K)."""
        table = np.zeros((len(monomials), self.count))
        for row, m in enumerate(monomials):
            for atom, e in m:
                table[row, atom] = e
        return table

    def values(self, monomials: Sequence[Monomial]) -> Array:
        """μ, (M, S)."""
        out = np.ones((len(monomials), self.size))
        with np.errstate(all="ignore"):
            for row, m in enumerate(monomials):
                for atom, e in m:
                    out[row] *= self.value[atom] if e == 1 else self.value[atom] ** e
        return out

    def lagrange(self, monomials: Sequence[Monomial]) -> Array:
        """d/dt ∂μ/∂ξ̇_i − ∂μ/∂ξ_i, (M, n, S)."""
        e = self.exponents(monomials)
        value = self.values(monomials)
        with np.errstate(all="ignore"):
            rate = e @ self.rate
            by_v = self._summed(e, self.by_v)
            inner = self._summed(e, self.by_v_rate - self.by_q)
            return value[:, None] * (rate[:, None] * by_v + inner)

    def slopes(self, monomials: Sequence[Monomial]) -> Array:
        """∂μ/∂ξ_i, (M, n, S)."""
        e = self.exponents(monomials)
        with np.errstate(all="ignore"):
            return self.values(monomials)[:, None] * self._summed(e, self.by_q)

    def momenta(self, monomials: Sequence[Monomial]) -> Array:
        """∂μ/∂ξ̇_i, (M, n, S)."""
        e = self.exponents(monomials)
        with np.errstate(all="ignore"):
            return self.values(monomials)[:, None] * self._summed(e, self.by_v)

    def _summed(self, e: Array, of_atoms: Array) -> Array:
        return (e @ of_atoms.reshape(self.count, -1)).reshape(len(e), self.n, self.size)
