"""Angles that are a constant times a coordinate, as the system has them: sin nθ where a leg turns by n θ."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy as sp
from lark import Token, Tree

from lagrangian import bounded
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.nodes import Node, names_in, only_name
from lagrangian.model import Model
from lagrangian.read.letters import key

MOST_POINTS = 200
"""The most points and frames in which angles are sought."""


def is_multiple(first: Node, second: Node, names: Names) -> bool:
    """Whether two factors behind a sine or cosine are an angle of the system: a constant that is none by itself, or a
    name or a sum in brackets of such constants, and a coordinate that is multiplied so in the system.

    A name of the answer's own whose rate it writes may stand for any of these coordinates.
    """
    multiples = _multiples(names.model)
    of = only_name(second)
    if not multiples or of is None or of[1] != 0:
        return False
    coordinate = _meaning(of[0], names)
    if coordinate is None and key(of[0]) in names.scope.moving:
        inside = [] if isinstance(first, Tree) and first.data == "call" else _constants(first, names)
        return bool(inside) and {None, *(c for c, _ in multiples)}.issuperset(inside)
    if coordinate is None or coordinate not in {x for _, x in multiples}:
        return False
    alone = only_name(first)
    if alone is not None:
        constant = _meaning(alone[0], names)
        return alone[1] == 0 and (constant is None or (constant, coordinate) in multiples)
    inside = [] if not isinstance(first, Tree) or first.data == "call" else list(names_in(first))
    found = [_meaning(x, names) for x, changing in inside if not changing]
    return bool(found) and len(found) == len(inside) and all(x is None or (x, coordinate) in multiples for x in found)


def _constants(first: Node, names: Names) -> list[sp.Basic | None]:
    """What the names in a factor are in the system; one that moves is itself."""
    alone = only_name(first)
    listed = [alone] if alone is not None else list(names_in(first)) if isinstance(first, Tree) else []
    moving = names.scope.moving
    return [sp.Symbol(str(x)) if changing or key(x) in moving else _meaning(x, names) for x, changing in listed]


def _meaning(written: Token, names: Names) -> sp.Basic | None:
    """What a name is in the system; None for one that it does not have, a letter that names it twice for itself."""
    found, dots = names.scope.meanings(written)
    if len(found) != 1:
        return None if not found else sp.Symbol(str(written))
    return names.scope[found[0]] if not dots else sp.Symbol(str(written))


def _multiples(model: Model) -> frozenset[tuple[sp.Basic, sp.Basic]]:
    """The constants and the coordinates that they multiply in the angles of a system."""

    def made() -> frozenset[tuple[sp.Basic, sp.Basic]]:
        constants = {p.symbol for p in model.parameters} | {d.symbol for d in model.definitions if not d.moving}
        coordinates = {c.symbol for c in model.coordinates}
        terms = [x for angle in _angles(model) for x in sp.Add.make_args(bounded.expand(angle))]
        alone = {x for term in terms if not term.has(*coordinates) for x in term.free_symbols}
        found = (
            ([x for x in term.args if x in constants], [x for x in term.args if x in coordinates])
            for term in terms
            if term.is_Mul and all(x.is_number or x in constants | coordinates for x in term.args)
        )
        return frozenset((a[0], b[0]) for a, b in found if len(a) == len(b) == 1 and a[0] not in alone)

    return model.remembered("multiple angles", made)


def _angles(model: Model) -> Iterator[Any]:
    """The angles of frames, and those in the places of points."""
    for frame in model.frames[:MOST_POINTS]:
        if frame.dimension == 2:
            yield model.expand(frame.angle)
    for point in model.points[:MOST_POINTS]:
        for place in point.offset:
            yield from (x.args[0] for x in model.expand(place).atoms(sp.sin, sp.cos))
