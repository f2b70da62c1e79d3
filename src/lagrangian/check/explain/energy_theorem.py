"""The energy theorem in place of Lagrange's equations: Σ ξ̇_i W_i = 0, where W_i = 0 are the right equations.

It follows from them; of several coordinates it says one thing, and of one coordinate all, wherever that moves.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import sympy as sp

from lagrangian.check.align import agreed, slopes_of_equations
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.search import EXOTIC, Explanation, singles
from lagrangian.check.reference import Reference
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.page.formula import Text, text

NOTHING = 1e-9
"""The relative size below which an equation says nothing of a system at rest."""
FITS = 1e-8
"""The relative size below which the difference of two equations is 0."""


@lru_cache(maxsize=64)
def is_energy_theorem(truth: Reference, expr: sp.Expr) -> bool:
    """Whether an equation, left minus right, holds accelerations and vanishes at rest: each of its terms has a rate.

    A scaled equation of motion does not, since its accelerations are left.
    """
    if not expr.has(*[c.acceleration for c in truth.model.coordinates]):
        return False
    compiled, zeros = CompiledExpressions([expr]), np.zeros(truth.states.size)
    moving = compiled.at(truth.states)[0]
    still = compiled.at(truth.states, {c.rate: zeros for c in truth.model.coordinates})[0]
    seen = np.isfinite(moving).all() and np.isfinite(still).all()
    return bool(seen and np.abs(still).max() <= NOTHING * np.abs(moving).max())


def note_on(truth: Reference, expr: sp.Expr, *, right: bool) -> Text | None:
    """What the energy theorem proves and what it does not; None if an equation is something else."""
    if not is_energy_theorem(truth, expr):
        return None
    if right:
        mine, theorem = CompiledExpressions([expr, _theorem(truth)]).at(truth.states)
        multiple = float(mine @ theorem) / float(theorem @ theorem)
        if not np.abs(mine - multiple * theorem).max() <= FITS * np.abs(mine).max():
            return None
    q = truth.derivation.coordinates
    if truth.n == 1:
        said = text(
            "the energy theorem: the equation of ", q[0], " times its rate, and the same wherever that is not 0"
        )
    else:
        said = text(
            "the energy theorem: the sum of all equations, each times its rate. It follows from them, but says one "
            f"thing of {truth.n} coordinates: they do not follow from it"
        )
    return said if right else text("read as ", *said.parts)


def of_energy_theorem(pool: Pool, expr: sp.Expr) -> list[Explanation]:
    """The single mistakes that lead to a wrong energy theorem: what is wrong in it is f Σ ξ̇_i ΔW_i."""
    truth = pool.truth
    rates = [truth.states.of(c.rate) for c in truth.model.coordinates]
    theorem = _theorem(truth)
    P, right = CompiledExpressions([expr, theorem]).at(truth.states)
    effects = pool.kept("power", lambda: sum(v * pool.W[:, i] for i, v in enumerate(rates)))
    mine, own = slopes_of_equations(truth, [expr])[0], slopes_of_equations(truth, [theorem])[0]
    found: list[Explanation] = []
    for factor, _ in agreed(truth, mine, own):
        rest = P / factor - right
        if np.isfinite(rest).all() and np.abs(rest).max() > NOTHING * np.abs(P).max():
            found += singles(pool, [effects], rest[None])
    return sorted((e for e in found if e.cost <= EXOTIC), key=lambda e: e.cost)


@lru_cache(maxsize=16)
def _theorem(truth: Reference) -> sp.Expr:
    """Σ ξ̇_i W_i."""
    rates = [c.rate for c in truth.model.coordinates]
    return sp.Add(*[v * row for v, row in zip(rates, truth.rows, strict=True)])
