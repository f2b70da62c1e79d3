"""Kinetic energies of bodies that stand alone: T_drum = … where nothing else uses T_drum, so that only its name judges
it."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.candidates import ingredients_of
from lagrangian.check.explain.meant import kinds_of, owner_of
from lagrangian.check.explain.said_wrongly import in_names_of
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Status
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.model import Body
from lagrangian.page.formula import text
from lagrangian.read.letters import key

MOST_PIECES = 10
"""The most pieces of T* of which all sums are compared with what is written."""
NEAR = 1e-9
"""The relative difference of values that is rounding."""


def untrue_of_bodies(truth: Reference, lines: Sequence[AnsweredLine]) -> dict[int, Finding]:
    """The findings for lines that say of a body, by a name that nothing else uses, what is no kinetic energy in the
    system; by the place of the line.

    A name may stand for the energy of its body, for that of its translation or its rotation, and for sums of such
    energies of several bodies. Names whose sum is T* share it out in their own way.
    """
    said = {k: x for k, x in enumerate(lines) if _owner(truth, x) is not None and not _is_used(lines, x)}
    values = {k: value for k, x in said.items() if (value := in_names_of(truth, x)) is not None}
    if not values or zero_everywhere(truth, sp.Add(*values.values()) - truth.T):
        return {}
    found: dict[int, Finding] = {}
    for k, value in values.items():
        body = _owner(truth, lines[k])
        if body is not None and _is_meant(truth, body, value) and not _is_sum_of_pieces(truth, body, value):
            note = text(f"it is neither the kinetic energy of {body.title} nor a part of it")
            found[k] = Finding(lines[k], Status.WRONG, note)
    return found


def _owner(truth: Reference, line: AnsweredLine) -> Body | None:
    """The body of which a definition says the kinetic energy, by its name."""
    if line.kind != "definition" or line.name is None or kinds_of(line.name) != ("kinetic",):
        return None
    return owner_of(line.name, truth.model)


def _is_used(lines: Sequence[AnsweredLine], line: AnsweredLine) -> bool:
    """Whether another line has the name that a line defines."""
    name = key(line.name or "")
    others = (x for x in lines if not (x.kind == "definition" and key(x.name or "") == name))
    return any(name in x.names for x in others)


def _is_meant(truth: Reference, body: Body, value: sp.Expr) -> bool:
    """Whether a value may be meant as the kinetic energy of a body: it has squares or products of rates, and a letter
    of the body's mass or moment of inertia. T_drum may be a torque or a tension."""
    s = ingredients_of(truth.derivation)
    square = any(bounded.diff(value, v).has(*s.v) for v in s.v)
    own = {x for x in truth.put(s.kinetic(body)).free_symbols if x in value.free_symbols}
    return square and bool(own or truth.values)


def _is_sum_of_pieces(truth: Reference, body: Body, value: sp.Expr) -> bool:
    """Whether a value is a sum of energies of translations and rotations."""
    s = ingredients_of(truth.derivation)
    others = [b for b in s.bodies if b is not body]
    pieces = [truth.put(x) for b in (body, *others) for x in (s.translation(b), s.rotation(b))]
    wanted, *listed = CompiledExpressions([value, *[x for x in pieces if x != 0][:MOST_PIECES]]).at(truth.states)
    sums = (c for count in range(1, len(listed) + 1) for c in combinations(listed, count))
    near = NEAR * (1 + np.abs(wanted).max())
    return any(bool(np.abs(wanted - sum(chosen)).max() <= near) for chosen in sums)
