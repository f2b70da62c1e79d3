"""Which positions that an answer writes are those of points at which no body is: the handle at which a force pulls.

Such a position is right for its point. It is not a wrong position of the nearest body.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np
import sympy as sp

from lagrangian.check.explain.quantities import quantities_of
from lagrangian.check.explain.which_said import owner_said
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import Array, CompiledExpressions

NEAR = 1e-9
"""The relative difference of values that is rounding."""
_CENTRE = re.compile(r"\bcent(?:re|er)\b|\bc\.?o\.?m\b|schwerpunkt|massenmittelpunkt", re.IGNORECASE)
"""Words that say that the place of a body is meant."""


def is_of_another_point(truth: Reference, line: AnsweredLine, said: Sequence[sp.Expr]) -> bool:
    """Whether a column that starts in ``line`` is the position, or the velocity, of a point at which no body is."""
    if owner_said(truth, line) is not None or _CENTRE.search(line.words):
        return False
    others = _others(truth)
    if len(said) != truth.model.dimension or not len(others):
        return False
    own = CompiledExpressions([truth.put(x) for x in said]).at(truth.states)
    return bool(np.isfinite(own).all()) and any(_is_near(own, x) for x in others)


def _is_near(one: Array, other: Array) -> bool:
    return bool(np.abs(one - other).max() <= NEAR * (1 + np.abs(other).max()))


@lru_cache(maxsize=16)
def _others(truth: Reference) -> list[Array]:
    """The positions and velocities of the points at which no body is."""
    s = quantities_of(truth).of
    bodies = [_values(truth, s.position(b)) for b in s.bodies]
    found: list[Array] = []
    for position in _points(truth):
        values = _values(truth, position)
        if np.isfinite(values).all() and np.ptp(values, axis=1).any() and not any(_is_near(values, x) for x in bodies):
            found += [values, _values(truth, [s.rate(x) for x in position])]
    return found


def _points(truth: Reference) -> Iterator[Sequence[sp.Expr]]:
    """The positions of all points, each once."""
    model, s = truth.model, quantities_of(truth).of
    named = {id(p): p for p in model.points}
    acting = {id(p): p for e in model.elements for _, p in e.points()}
    for p in (named | acting).values():
        yield [s.expand(x) for x in model.position(p)]


def _values(truth: Reference, exprs: Sequence[sp.Expr]) -> Array:
    return CompiledExpressions([truth.put(x) for x in exprs]).at(truth.states)
