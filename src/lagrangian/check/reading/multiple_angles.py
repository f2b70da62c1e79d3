"""Angles that are a constant times a coordinate, as the system has them: sin nθ where a leg turns by n θ."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.nodes import Node, only_name
from lagrangian.model import Model

MOST_POINTS = 200
"""The most points and frames in which angles are sought."""


def is_multiple(first: Node, second: Node, names: Names) -> bool:
    """Whether two factors behind a sine or cosine are an angle of the system: a constant that is none by itself, and
    the coordinate that it multiplies."""
    pair = [only_name(x) for x in (first, second)]
    meant = [names.scope.meanings(x[0]) for x in pair if x is not None and x[1] == 0]
    if len(meant) < 2 or any(len(found) != 1 or dots for found, dots in meant):
        return False
    constant, coordinate = (names.scope[found[0]] for found, _ in meant)
    return (constant, coordinate) in _multiples(names.model)


def _multiples(model: Model) -> frozenset[tuple[sp.Basic, sp.Basic]]:
    """The constants and the coordinates that they multiply in the angles of a system."""

    def made() -> frozenset[tuple[sp.Basic, sp.Basic]]:
        constants = {p.symbol for p in model.parameters}
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
