"""Equations of an answer with energies that no line states: d/dt ∂L/∂ẋ − ∂L/∂x = F, ∂V/∂θ = m g l sin θ.

With the right energies they hold, or a note tells that they do not. Those of no coordinate, d/dt ∂L/∂ξ̇_i − ∂L/∂ξ_i =
Ξ_i, say nothing of the system.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading.placeholders import ENERGIES, slope
from lagrangian.check.reference import Reference
from lagrangian.check.rows import Kind, compare, zero_everywhere
from lagrangian.check.stated import dissipation
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive import Derived
from lagrangian.errors import listed
from lagrangian.model import time
from lagrangian.page.formula import Text, text
from lagrangian.records import dataclass


@dataclass(frozen=True)
class SlopeNamed:
    """A derivative of an energy that has no value: the energy's ``kind``, by what it is differentiated, and what is
    right."""

    kind: str
    orders: tuple[Any, ...]
    right: sp.Expr


def untrue_in_general(truth: Reference, lines: Sequence[AnsweredLine]) -> Iterator[Text]:
    """What to say of such equations that do not hold; of those with accelerations only where there are no multipliers,
    which have names and scales of the answer's own. A statement with a name only gives that a value."""
    for line in lines:
        if line.kind != "statement" or line.name is not None or not (used := slopes_of(truth, line.expr)):
            continue
        expr = cast("sp.Expr", line.expr.xreplace({x: slope.right for x, slope in used.items()}))
        if not bounded.letters(expr) <= truth.names:
            continue
        moving = expr.has(*[c.acceleration for c in truth.model.coordinates])
        if moving and truth.derivation.multipliers:
            continue
        holds = compare(truth, [expr]).rows[0].kind is not Kind.WRONG if moving else zero_everywhere(truth, expr)
        if not holds:
            named = listed(sorted({x.kind for x in used.values()}))
            yield text(
                f"'{line.text}' was not judged, since no line states {named}; with what is right for the system, "
                "it does not hold."
            )


def slopes_of(truth: Reference, expr: sp.Expr) -> dict[Any, SlopeNamed]:
    """The derivatives of energies without a value in an expression, as they are written."""
    known = _written(truth.derivation)
    found: dict[Any, SlopeNamed] = {}
    for form in expr.atoms(sp.Derivative, AppliedUndef) & known.keys():
        kind, orders = known[form]
        energy = dissipation(truth) if kind == "D" else truth.energies[kind]
        found[form] = SlopeNamed(kind, orders, bounded.diff(energy, *orders))
    return found


@lru_cache(maxsize=32)
def _written(derivation: Derived) -> dict[Any, tuple[str, tuple[Any, ...]]]:
    """How derivatives of energies may be written: the energy of each, and by what it is differentiated."""
    found: dict[Any, tuple[str, tuple[Any, ...]]] = {}
    for kind, name in ENERGIES.items():
        for c in derivation.model.coordinates:
            for by in (c.symbol, c.rate):
                alone = slope(str(name), (by,))
                found |= {sp.Derivative(name, by): (kind, (by,)), alone: (kind, (by,))}
                found[sp.Derivative(alone, time)] = kind, (by, time)
    return found
