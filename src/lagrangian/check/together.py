"""Energies and forces that are right together, though not each alone: a weight as a force, a coupling in ℒ."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import StatedQuantity, driving, given, index_of, left_sides
from lagrangian.check.verdict import AnsweredLine, Finding, Status
from lagrangian.model import time
from lagrangian.page.formula import text

_JUDGED = ("T", "V", "L", "D", "Xi")


def right_together(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with energies and forces that are only elsewhere than ours as right ones.

    A weight may be a force and not in V, a gyroscopic coupling a term of ℒ and no force: all is right if the whole ℒ
    that is stated gives, with D and every Ξ, the right equations,

        d/dt ∂ℒ/∂ξ̇_i − ∂ℒ/∂ξ_i + ∂D/∂ξ̇_i − Ξ_i = 0.

    What is not stated counts as ours; but dampers are in a D that is stated, or in Ξ. Derivatives of ℒ by a coordinate
    or its rate are right then if they are those of the ℒ that is stated.
    """
    lines = [f.line for f in findings if f.line.kind in _JUDGED]
    wrong = [f for f in findings if f.status is Status.WRONG and f.line.kind in _JUDGED]
    own = given(truth, lines)
    used = [x for x in (own.T, own.V, own.L, own.D, *own.Xi) if x is not None]
    whole = [replace(own, L=None)] if own.T is not None and own.V is not None else []
    whole += [own] if own.L is not None else []
    if not wrong or not whole or truth.derivation.multipliers or not any(x is not None for x in own.Xi):
        return list(findings)
    if any(all(f.line.expr is not x for x in used) for f in wrong) or not all(_is_right(truth, x) for x in whole):
        return list(findings)
    note = text("together with the other energies and forces, it gives the right equations")
    wrong += [f for f in findings if f.status is Status.WRONG and _is_derivative(truth, f.line, whole[0])]
    same = {id(f) for f in wrong}
    right = [replace(f, status=Status.EQUIVALENT, note=note, differences=(), follows=False) for f in findings]
    return [x if id(f) in same else f for f, x in zip(findings, right, strict=True)]


def _is_derivative(truth: Reference, line: AnsweredLine, own: StatedQuantity) -> bool:
    """Whether a line gives ∂ℒ/∂ξ, ∂ℒ/∂ξ̇ or the rate of this, of the ℒ that an answer states."""
    i = index_of(truth, line.name)
    if i is None or line.kind not in ("slope", "p", "p-rate"):
        return False
    c = truth.model.coordinates[i]
    value = bounded.diff(own.lagrangian(truth), c.symbol if line.kind == "slope" else c.rate)
    value = bounded.diff(value, time) if line.kind == "p-rate" else value
    return zero_everywhere(truth, line.expr - value)


def _is_right(truth: Reference, own: StatedQuantity) -> bool:
    """Whether what an answer states gives the right equations, with its Ξ as the whole or without what D adds."""
    lefts = left_sides(truth, own.lagrangian(truth) - truth.L)
    D = own.D if own.D is not None else sp.S.Zero
    whole, damped = True, own.D is not None
    for i, (c, left) in enumerate(zip(truth.model.coordinates, lefts, strict=True)):
        mine, right = own.Xi[i], truth.Xi[i]
        whole = whole and zero_everywhere(truth, left - (right if mine is None else mine) + right)
        undamped = driving(truth, i) if mine is None else mine
        damped = damped and zero_everywhere(truth, left + bounded.diff(D, c.rate) - undamped + right)
    return whole or damped
