"""Energies of coils and capacitors that an answer states apart: W_m = ½ L i² beside T*, W_e = q²/(2 C) beside V."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import sympy as sp

from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model.elements.branch import CircuitBranch
from lagrangian.page.formula import Text, text

MOST_PARTS, MOST_ADDED = 8, 3
"""The most definitions that are tried, and the most that are added up."""


def with_energies_apart(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]:
    """The lines, with the energy of all coils added to a T* without any, and that of all capacitors to a V without any,
    where a name of the answer has exactly this value, or a sum of names; and notes that say so."""
    elements = [e for e in truth.model.elements if isinstance(e, CircuitBranch)]
    found = tuple(lines)
    notes: list[Text] = []
    for kind, words, energies in (
        ("T", "magnetic co-energy", [e.kinetic(truth.model) for e in elements]),
        ("V", "electric energy", [e.potential(truth.model) for e in elements]),
    ):
        stored = truth.expand(sp.Add(*energies))
        moving = [c.rate if kind == "T" else c.symbol for c in truth.model.coordinates]
        moving = [x for x in moving if stored.has(x)]
        lacking = [line for line in found if line.kind == kind and not line.expr.has(*moving)] if moving else []
        if lacking and (names := _names(truth, found, stored, moving)):
            found = tuple(replace(x, expr=x.expr + stored) if x in lacking else x for x in found)
            notes.append(
                text(f"The {words}, which is stated apart as {' + '.join(names)}, was added to {_CALLED[kind]}.")
            )
    return found, tuple(notes)


_CALLED = {"T": "T*", "V": "V"}


def _names(
    truth: Reference, lines: Sequence[AnsweredLine], stored: sp.Expr, moving: Sequence[sp.Expr]
) -> tuple[str, ...]:
    """The names of the answer whose values add up to an energy; none if there are none."""
    told = {line.name: truth.expand(line.expr) for line in lines if line.kind == "definition" and line.name}
    parts = [(name, value) for name, value in told.items() if value.has(*moving)][:MOST_PARTS]
    for count in range(1, min(MOST_ADDED, len(parts)) + 1):
        for chosen in combinations(parts, count):
            if zero_everywhere(truth, sp.Add(*[value for _, value in chosen]) - stored):
                return tuple(name for name, _ in chosen)
    return ()
