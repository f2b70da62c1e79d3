"""The one term that is wrong in a relation of lengths and angles: l² = a² + d² + 2 a d cos θ for − 2 a d cos θ."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import numpy as np
import sympy as sp

from lagrangian.check.align import LARGEST
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Finding, Mistake
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.page.formula import text

NEAR = 1e-9
"""The relative difference of values that is rounding."""
INSTEAD = {2.0: -sp.S.One, 0.5: sp.S.Half, -1.0: sp.Integer(2)}
"""How many times a term is there too much, and what times it belongs there: its negative, half of it, twice as much."""
WHY = text("Put in a position that the sketch shows, an angle of zero or a right one. Does the line hold there?")


def of_relation(truth: Reference, findings: Sequence[Finding]) -> tuple[Mistake, ...]:
    """What is wrong in the first wrong line, if it is a relation of positions that one other term would make hold."""
    first = next((f.line for f in findings if f.is_open), None)
    if first is None or first.kind != "equation" or truth.derivation.multipliers or not first.summands:
        return ()
    terms = [truth.expand(sp.Mul(*ways[0])) for ways in first.summands]
    exprs = [truth.put(x) for x in (truth.expand(first.expr), *terms)]
    inputs = [x.symbol for x in truth.model.inputs]
    if any(x.has(sp.Derivative, *inputs) or x.free_symbols - truth.names for x in (first.expr, *exprs)):
        return ()
    values = CompiledExpressions(exprs).at(truth.states)
    size = np.abs(values).max() if np.isfinite(values).all() else np.inf
    if size > LARGEST or np.abs(values[1:].sum(axis=0) - values[0]).max() > NEAR * size:
        return ()
    found = [
        (ways[0], instead)
        for ways, term in zip(first.summands, values[1:], strict=True)
        for times, instead in INSTEAD.items()
        if np.abs(values[0] - times * term).max() <= NEAR * size
    ]
    if len(found) != 1:
        return ()
    [(factors, instead)] = found
    written = cast("sp.Expr", sp.Mul(*factors))
    shown = -written if written.could_extract_minus_sign() else written
    what = text(f"In {first.title}, ", shown, " has the wrong sign.")
    if instead != -1:
        what = text(f"In {first.title}, ", shown, " should be ", cast("sp.Expr", instead * shown), ".")
    brief = text(f"A term in {first.title} is not right.")
    return (Mistake("relation_wrong", what, WHY, 1, None, None, brief),)
