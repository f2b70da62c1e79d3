"""Which mistakes were not made, as the kinetic energy of a body that an answer states by itself is right.

T_A = ½ m ẋ²  right:  neither the ½ of T_A nor "the ½ of every kinetic energy" is missing, whatever is wrong elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from lagrangian.check.explain.changes.pool import Pool, Possible
from lagrangian.check.explain.meant import kinds_of
from lagrangian.check.explain.quantities import quantities_of
from lagrangian.check.explain.said_wrongly import NEAR, in_names_of, right_quantities
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import CompiledExpressions

PARTS = range(2, 9)
"""How many equal parts a body may have."""


def against_bodies(pool: Pool, lines: Sequence[AnsweredLine]) -> set[int]:
    """The possible mistakes, by their identity, that would change the energy of a body that is right."""
    truth = pool.truth
    said = {q.owner for x in lines if x.kind == "definition" for q in right_quantities(truth, x) if q.kind == "kinetic"}
    said |= {owner for x in lines if (owner := _of_one(pool, x)) is not None}
    if not said:
        return set()
    s = quantities_of(truth).of
    letters = {e: s.kinetic(e).free_symbols for e in s.model.elements if e.ledger == "T*"}
    others = set[Any]().union(*(x for e, x in letters.items() if e not in said))
    own = set[Any]().union(*(letters.get(e, set[Any]()) for e in said)) - others
    shown = [pool.all[k] for k in np.flatnonzero(np.abs(pool.T).max(axis=1) > 1e-9)]
    return {id(p) for p in shown if p.element in said or not _letters(pool, p).isdisjoint(own)}


def _of_one(pool: Pool, line: AnsweredLine) -> Any:
    """What is made of several equal parts, four wheels, of which a definition has the kinetic energy of one."""
    value = in_names_of(pool.truth, line) if kinds_of(line.name or "") == ("kinetic",) else None
    if value is None:
        return None
    every, own = quantities_of(pool.truth), CompiledExpressions([value]).at(pool.truth.states)[0]
    for q, right in zip(every.all, every.values, strict=True):
        if q.kind == "kinetic" and not q.also and np.abs(own).max() > NEAR:
            number = round(float(right @ own) / float(own @ own))
            if number in PARTS and np.abs(right - number * own).max() <= NEAR * np.abs(right).max():
                return q.owner
    return None


def _letters(pool: Pool, possible: Possible) -> set[Any]:
    """The letters in what a mistake adds to T*."""
    if possible.change is not None:
        atoms = pool.sites.ring.atoms
        return {atoms[a] for m in possible.change.effect.T for a, _ in m}
    return set(possible.wrong.variant.T.free_symbols) if possible.wrong is not None else set()
