"""Whether a program that computes another motion only gives the inputs a law of its own: F = −10 x − 2 ẋ, put in."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import SETS, Array, CompiledExpressions
from lagrangian.model import time

NEAR = 1e-8
"""The relative size of what is rounding."""


def only_drives(truth: Reference, lines: Sequence[AnsweredLine]) -> bool:
    """Whether equations without inputs hold for inputs that depend on the motion and on numbers alone: no element of
    the system is wrong in them, as its parameter would be in the law."""
    model, exprs = truth.model, [x.expr for x in lines if x.kind == "equation"]
    inputs, accelerations = [u.symbol for u in model.inputs], [c.acceleration for c in model.coordinates]
    if not inputs or truth.derivation.multipliers or len(exprs) != truth.n or any(x.has(*inputs) for x in exprs):
        return False
    if set[sp.Basic]().union(*map(bounded.letters, exprs)) - truth.names:
        return False
    moving = [x for c in model.coordinates for x in (c.symbol, c.rate)]
    values: dict[sp.Basic, Array] = {x: _first_set(truth.states.of(x)) for x in (*moving, time)}
    values |= {x: np.zeros(truth.states.size) for x in inputs}
    found = _affine(truth, exprs, accelerations, values)
    if found is None or (np.linalg.matrix_rank(found[0]) < truth.n).any():
        return False
    a = -np.linalg.solve(found[0], found[1][:, :, None])[:, :, 0]
    values |= dict(zip(accelerations, a.T, strict=True))
    driven = _affine(truth, truth.rows, inputs, values)
    if driven is None:
        return False
    A, b = driven
    u = -(np.linalg.pinv(A) @ b[:, :, None])[:, :, 0]
    scale = (np.abs(A) * np.abs(u[:, None, :])).sum(axis=2) + np.abs(b)
    holds = np.abs((A @ u[:, :, None])[:, :, 0] + b) <= NEAR * (1 + scale)
    by_set = u.reshape(SETS, -1, u.shape[1])
    return bool(holds.all() and np.abs(by_set - by_set[:1]).max() <= NEAR * (1 + np.abs(u).max()))


def _first_set(values: Array) -> Array:
    """The values with the first set of parameters, for every set."""
    return np.tile(values.reshape(SETS, -1)[0], SETS)


def _affine(
    truth: Reference, exprs: Sequence[sp.Expr], wanted: Sequence[sp.Expr], values: dict[sp.Basic, Array]
) -> tuple[Array, Array] | None:
    """Expressions that are A u + b in some quantities u, at every state; None if they are not finite."""
    still = values | dict.fromkeys(wanted, np.zeros(truth.states.size))
    compiled = CompiledExpressions(exprs)
    A = compiled.slopes(wanted).at(truth.states, still).reshape(len(exprs), len(wanted), -1).transpose(2, 0, 1)
    b = compiled.at(truth.states, still).T
    return (A, b) if np.isfinite(A).all() and np.isfinite(b).all() else None
