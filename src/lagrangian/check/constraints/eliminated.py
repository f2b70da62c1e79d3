"""Eliminates the constraint forces that an answer by Newton's laws names: m x'' = m g - S, J x''/R = S R."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time
from lagrangian.page.formula import Text, text
from lagrangian.page.plain import plain
from lagrangian.records import dataclass

MAX_FORCES = 12
"""The largest number of forces that are eliminated."""

FEWEST_STATEMENTS = 2
"""The fewest statements in which a force occurs; one that occurs in a single one says nothing."""

LONGEST = 2_000
"""The largest number of operations of an equation in which a force is written out."""


@dataclass(frozen=True)
class Eliminated:
    """The lines without the forces, what to say about them, the forces, and which of them stood in each line."""

    lines: tuple[AnsweredLine, ...]
    note: Text
    names: tuple[str, ...]
    held: tuple[frozenset[sp.Basic], ...]


def without_forces(
    truth: Reference, lines: Sequence[AnsweredLine], kept: Set[sp.Basic] = frozenset()
) -> Eliminated | None:
    """Return the lines with every unknown name that is not ``kept`` written out that a line determines, without this
    line.

    A name is determined by a line in which it occurs linearly, and must occur in another statement that is judged.
    Returns None if there is none, or if a name remains.
    """
    left = unknown_in(truth, lines) - kept
    if not left or len(left) > MAX_FORCES:
        return None
    if any(d.has(*left) for line in lines for d in line.expr.atoms(sp.Derivative)):
        return None  # a name that moves is a coordinate of the answer's own, and no force
    names = sorted(map(plain, left))
    told = [line for line in lines if line.kind != "definition"]  # a definition is written out where it is used
    if any(len({line.text for line in told if line.expr.has(x)}) < FEWEST_STATEMENTS for x in left):
        return None
    out, held = list(lines), [frozenset[sp.Basic]()] * len(lines)
    while left:
        found = min(
            (
                (len(unknown_in(truth, [line]) - kept), k, name)
                for k, line in enumerate(out)
                if line.kind == "equation"
                for name in sorted(left, key=str)
                if slope_of(line.expr, name) is not None
            ),
            default=None,
            key=lambda x: x[:2],
        )
        if found is None:
            return None
        _, k, name = found
        slope = slope_of(out[k].expr, name)
        assert slope is not None
        value = -cast("sp.Expr", out[k].expr.xreplace({name: sp.S.Zero})) / slope
        of_value = held[k] | {name}
        del out[k], held[k]
        held = [x | of_value if line.expr.has(name) else x for x, line in zip(held, out, strict=True)]
        out = [replace(x, expr=cast("sp.Expr", x.expr.xreplace({name: value}))) for x in out]
        left = left - {name}
        if any(bounded.operations(x.expr) > LONGEST for x in out):
            return None
    verb = "were" if len(names) > 1 else "was"
    note = text(f"{', '.join(names)} {verb} eliminated: your equations say what they are.")
    return Eliminated(tuple(out), note, tuple(names), tuple(held))


def unknown_in(truth: Reference, lines: Sequence[AnsweredLine]) -> set[sp.Basic]:
    """The names in equations that the system does not have."""
    model = truth.model
    known: set[sp.Basic] = {time, *(p.symbol for p in model.parameters), *(c.symbol for c in model.coordinates)}
    known |= {*(u.symbol for u in model.inputs), *(d.symbol for d in model.definitions)}
    told = [line.expr for line in lines if line.kind == "equation"]
    return {x for expr in told for x in bounded.letters(expr)} - known


def slope_of(expr: sp.Expr, name: sp.Basic) -> sp.Expr | None:
    """The factor of a name in an expression that is linear in it; None if it is not, or if the factor accelerates, so
    that the name is an inertia and no force."""
    if not expr.has(name) or any(d.has(name) for d in expr.atoms(sp.Derivative)):
        return None
    slope = bounded.diff(expr, name)
    return None if slope == 0 or slope.has(name) or accelerates(slope) else slope
