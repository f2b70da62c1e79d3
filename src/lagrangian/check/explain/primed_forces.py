"""Forces with a prime: S' beside S, action and reaction, is a name and no rate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.eliminated import unknown_in
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine


def primes_as_names(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines with S' beside S as a name, if the system has no S: a force is not differentiated."""
    told = [x.expr for x in lines if x.kind == "equation"]
    rates = set[sp.Basic]().union(*(e.atoms(sp.Derivative) for e in told))
    own = unknown_in(truth, lines)
    put = {
        d: sp.Symbol(f"{d.args[0].func}'")
        for d in rates
        if isinstance(d, sp.Derivative) and d.derivative_count == 1 and d.args[0] in own
    }
    moving = {d.args[0] for d in rates if isinstance(d, sp.Derivative) and d.derivative_count > 1}
    if not put or any(d.args[0] in moving for d in put):
        return tuple(lines)
    return tuple(replace(x, expr=bounded.replaced(x.expr, put)) for x in lines)
