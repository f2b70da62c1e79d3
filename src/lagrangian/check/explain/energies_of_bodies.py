"""Energies of bodies that stand alone: T_drum = … where nothing else uses T_drum, so that only its name judges it."""

from __future__ import annotations

import re
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
from lagrangian.model import Body, time
from lagrangian.page.formula import text
from lagrangian.read.letters import key

MOST_PIECES = 10
"""The most pieces of T* of which all sums are compared with what is written."""
_NUMBERED = re.compile(r"[\d₀-₉]\Z")
NEAR = 1e-9
"""The relative difference of values that is rounding."""


def untrue_of_bodies(truth: Reference, lines: Sequence[AnsweredLine]) -> dict[int, Finding]:
    """The findings for lines that say of a body, by a name that nothing else uses, what is no energy in the system; by
    the place of the line.

    A name may stand for the energy of its body, for that of its translation or its rotation, and for sums of such
    energies of several bodies; a potential energy for that of its weight and of springs, from any level. Names whose
    sum is T*, or V, share it out in their own way.
    """
    found: dict[int, Finding] = {}
    for kind in ("kinetic", "potential"):
        said = {k: x for k, x in enumerate(lines) if _owner(truth, x, kind) is not None and not _is_used(lines, x)}
        values = {k: value for k, x in said.items() if (value := in_names_of(truth, x)) is not None}
        every = sp.Add(*values.values())
        if not values or (zero_everywhere(truth, every - truth.T) if kind == "kinetic" else _level(truth, every)):
            continue
        counted = _counts_its_own(truth, lines, kind)
        for k, value in values.items():
            body = _owner(truth, lines[k], kind)
            if body is None or not _is_meant(truth, body, value, kind):
                continue
            if counted and _NUMBERED.search(lines[k].name or ""):
                continue
            pieces = _kinetic(truth, body) if kind == "kinetic" else _potential(truth, body)
            of = [value] if kind == "kinetic" else [bounded.diff(value, c.symbol) for c in truth.model.coordinates]
            if not _is_sum(truth, of, pieces):
                note = text(f"it is neither the {kind} energy of {body.title} nor a part of it")
                found[k] = Finding(lines[k], Status.WRONG, note)
    return found


def _counts_its_own(truth: Reference, lines: Sequence[AnsweredLine], kind: str) -> bool:
    """Whether the numbers of T_1, T_2, … count parts of the answer's own and no bodies of the system: one of them is of
    no body with this number, or has no letter of it."""
    for x in lines:
        if x.kind != "definition" or kinds_of(x.name or "") != (kind,) or not _NUMBERED.search(x.name or ""):
            continue
        body, value = owner_of(x.name or "", truth.model), in_names_of(truth, x)
        if body is None or (
            value is not None and not any(_is_meant(truth, b, value, kind) for b in truth.model.bodies)
        ):
            return True
    return False


def _owner(truth: Reference, line: AnsweredLine, kind: str) -> Body | None:
    """The body of which a definition says an energy, by its name."""
    if line.kind != "definition" or line.name is None or kinds_of(line.name) != (kind,):
        return None
    return owner_of(line.name, truth.model)


def _is_used(lines: Sequence[AnsweredLine], line: AnsweredLine) -> bool:
    """Whether another line has the name that a line defines."""
    name = key(line.name or "")
    others = (x for x in lines if not (x.kind == "definition" and key(x.name or "") == name))
    return any(name in x.names for x in others)


def _level(truth: Reference, V: sp.Expr) -> bool:
    """Whether an energy is V but for a constant."""
    return all(zero_everywhere(truth, bounded.diff(V - truth.V, c.symbol)) for c in truth.model.coordinates)


def _is_meant(truth: Reference, body: Body, value: sp.Expr, kind: str) -> bool:
    """Whether a value may be meant as the energy of a body: it has squares or products of rates, or positions alone,
    and a letter of the body's mass or moment of inertia. T_drum may be a torque or a tension."""
    s = ingredients_of(truth.derivation)
    if kind == "kinetic":
        fits = any(bounded.diff(value, v).has(*s.v) for v in s.v)
        letters = truth.put(s.kinetic(body)).free_symbols - {time}
    else:
        fits = s.moves(value) and not value.has(*s.v)
        letters = truth.put(s.expand(body.mass)).free_symbols
    return fits and bool(letters & value.free_symbols or (truth.values and kind == "kinetic"))


def _kinetic(truth: Reference, body: Body) -> list[list[sp.Expr]]:
    """The energies of translations and rotations, those of a body first, and then those that are given: of a pinion
    that turns with the carriage."""
    s = ingredients_of(truth.derivation)
    bodies = [body, *(b for b in s.bodies if b is not body)]
    listed = [x for b in bodies for x in (s.translation(b), s.rotation(b))]
    listed[2:2] = [s.kinetic(e) for e in truth.model.elements if e.kind == "kinetic"]
    return [[truth.put(x)] for x in listed if x != 0]


def _potential(truth: Reference, body: Body) -> list[list[sp.Expr]]:
    """The slopes of the energies of weights and springs, those of a body first."""
    s = ingredients_of(truth.derivation)
    stored = [V for _, b, V in sorted(s.weights(), key=lambda x: x[1] is not body)]
    stored += [V for _, _, V in s.springs()]
    return [[bounded.diff(truth.put(V), q) for q in s.q] for V in stored]


def _is_sum(truth: Reference, value: Sequence[sp.Expr], pieces: Sequence[Sequence[sp.Expr]]) -> bool:
    """Whether values are those of a sum of some pieces at every state; none is the sum of nothing."""
    exprs = [*value, *(x for piece in pieces[:MOST_PIECES] for x in piece)]
    wanted, *listed = np.split(CompiledExpressions(exprs).at(truth.states), len(exprs) // len(value))
    near = NEAR * (1 + np.abs(wanted).max())
    sums = (c for count in range(1, len(listed) + 1) for c in combinations(listed, count))
    return any(bool(np.abs(wanted - sum(chosen)).max() <= near) for chosen in sums)
