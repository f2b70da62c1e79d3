"""Energies of bodies that stand alone: T_drum = … where nothing else uses T_drum, so that only its name judges it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import combinations
from typing import cast

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

_NUMBERED = re.compile(r"[TVUK]_?\{?\d\}?")
MOST_PIECES = 10
"""The most pieces of T* of which all sums are compared with what is written."""
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
        listed = {k for k in values if _NUMBERED.fullmatch(lines[k].name or "")}
        if any(_is_of_another(truth, lines[k], values[k], kind) for k in listed):
            values = {k: value for k, value in values.items() if k not in listed}  # T_2 is the second in a list
        for k, value in values.items():
            body = _owner(truth, lines[k], kind)
            if body is None or not _is_meant(truth, body, value, kind):
                continue
            if not _is_sum(truth, *_in_pieces(truth, body, value, kind)):
                note = text(f"it is not the {kind} energy of {body.title}: something is missing in it")
                if not _is_short(truth, body, value, kind):
                    note = text(f"it is neither the {kind} energy of {body.title} nor a part of it")
                found[k] = Finding(lines[k], Status.WRONG, note)
    return found


def _is_short(truth: Reference, body: Body, value: sp.Expr, kind: str) -> bool:
    """Whether a value has what its mass and each of its moments of inertia adds to the kinetic energy of a body, but
    for some of these."""
    if kind != "kinetic":
        return False
    s = ingredients_of(truth.derivation)
    whole = truth.put(s.kinetic(body))
    inertia = getattr(body, "inertia", sp.zeros(0, 0))
    letters = set[sp.Basic]().union(*(truth.put(s.expand(x)).free_symbols for x in (body.mass, *inertia)))
    parts = [cast("sp.Expr", p * bounded.diff(value, p)) for p in sorted(letters, key=str)]
    wholes = [cast("sp.Expr", p * bounded.diff(whole, p)) for p in sorted(letters, key=str)]
    right = (zero_everywhere(truth, x) or zero_everywhere(truth, x - y) for x, y in zip(parts, wholes, strict=True))
    return all(right) and zero_everywhere(truth, value - sp.Add(*parts))


def _in_pieces(truth: Reference, body: Body, value: sp.Expr, kind: str) -> tuple[list[sp.Expr], list[list[sp.Expr]]]:
    """A value and the energies of which it may be a sum, or the slopes of both."""
    if kind == "kinetic":
        return [value], _kinetic(truth, body)
    return [bounded.diff(value, c.symbol) for c in truth.model.coordinates], _potential(truth, body)


def _is_of_another(truth: Reference, line: AnsweredLine, value: sp.Expr, kind: str) -> bool:
    """Whether what a number calls the energy of a body is a sum of energies, and has no letter of this body."""
    body = _owner(truth, line, kind)
    if body is None or _is_meant(truth, body, value, kind):
        return False
    return _is_sum(truth, *_in_pieces(truth, body, value, kind))


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
        letters = truth.put(s.kinetic(body)).free_symbols
    else:
        fits = s.moves(value) and not value.has(*s.v)
        letters = truth.put(s.expand(body.mass)).free_symbols
    return fits and bool((letters & value.free_symbols) - {time} or (truth.values and kind == "kinetic"))


def _kinetic(truth: Reference, body: Body) -> list[list[sp.Expr]]:
    """The energies of translations and rotations, those of a body first, and of elements that are none."""
    s = ingredients_of(truth.derivation)
    bodies = [body, *(b for b in s.bodies if b is not body)]
    others = [s.kinetic(e) for e in s.model.elements if e.kind == "kinetic"]  # a pinion beside its rack
    return [
        [truth.put(x)] for x in (*(p for b in bodies for p in (s.translation(b), s.rotation(b))), *others) if x != 0
    ]


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
