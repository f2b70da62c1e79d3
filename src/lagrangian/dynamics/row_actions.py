"""What a constraint does to bodies: the forces on places and the torques on axes that its multipliers stand for.

Every row c = A v + a₀ has the power λ c: what multiplies a velocity in it, times λ, is the force there.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

from lagrangian.dynamics.axes import PlaceMotion
from lagrangian.dynamics.description import Description
from lagrangian.dynamics.vectors import Vector, cross, dot, scaled, times
from lagrangian.model import Frame, Point
from lagrangian.model.elements.base import Condition, difference
from lagrangian.model.elements.conditions import (
    Coincidence,
    NoSlip,
    OnLine,
    Perpendicular,
    SameTurn,
    Separation,
    Stated,
    Unmoved,
)
from lagrangian.records import dataclass


@dataclass(frozen=True)
class RowAction:
    """A force on a ``target`` (point), or a torque on one (frame), in the fixed axes; ``side``: which end it is."""

    target: Point | Frame
    vector: Vector
    side: int


def crossed(d: Description, a: Vector, b: Vector) -> Vector:
    """a × b in the fixed axes; in the plane one number."""
    g = d.graph
    return cross(g, a, b) if len(a) == 3 else [g.sub(g.mul(a[0], b[1]), g.mul(a[1], b[0]))]


def row_actions(d: Description, condition: Condition, multiplier: int) -> list[RowAction]:
    """What one row does with a given λ; nothing for an expression, which acts on coordinates."""
    found = ACTIONS[type(condition)](d, condition)
    return [RowAction(a.target, scaled(d.graph, multiplier, a.vector), a.side) for a in found]


def _in_root(d: Description, vector: Vector, frame: Frame | None) -> Vector:
    return list(vector) if frame is None else times(d.graph, d.motion.rotation(d.axes[frame]), vector)


def _opposite(d: Description, vector: Vector) -> Vector:
    return [d.graph.neg(x) for x in vector]


def _gap(d: Description, start: Point, end: Point) -> Vector:
    places: dict[Point, PlaceMotion] = d.places
    return d.motion.between(places[start], places[end])


def _coincidence(d: Description, s: Coincidence) -> list[RowAction]:
    unit = [d.graph.one if i == s.axis else d.graph.zero for i in range(d.motion.dimension)]
    e = unit if d.motion.dimension == 2 else _in_root(d, unit, s.frame)
    return [RowAction(s.start, e, 0), RowAction(s.end, _opposite(d, e), 1)]


def _separation(d: Description, s: Separation) -> list[RowAction]:
    found: list[RowAction] = []
    for side, (start, end) in enumerate(pairwise(s.points)):
        gap = _gap(d, start, end)
        e = scaled(d.graph, d.graph.div(d.graph.one, d.graph.sqrt(dot(d.graph, gap, gap))), gap)
        found += [RowAction(start, _opposite(d, e), side), RowAction(end, e, side + 1)]
    return found


def _same_turn(d: Description, s: SameTurn) -> list[RowAction]:
    one, second = [d.graph.one], s.second
    other = [] if second is None else [RowAction(second, _opposite(d, one), 1)]
    return [RowAction(s.first, one, 0), *other]


def _perpendicular(d: Description, s: Perpendicular) -> list[RowAction]:
    a, b = _in_root(d, d.nodes(s.along), s.first), _in_root(d, d.nodes(s.other), s.second)
    turn, second = crossed(d, a, b), s.second
    other = [] if second is None else [RowAction(second, _opposite(d, turn), 1)]
    return [RowAction(s.first, turn, 0), *other]


def _on_line(d: Description, s: OnLine) -> list[RowAction]:
    n = _in_root(d, d.nodes(s.normal), s.frame)
    found = [RowAction(s.start, n, 0), RowAction(s.end, _opposite(d, n), 1)]
    if s.frame is not None:  # the line turns with the frame
        found.append(RowAction(s.frame, crossed(d, n, _gap(d, s.end, s.start)), 1))
    return found


def _no_slip(d: Description, s: NoSlip) -> list[RowAction]:
    e = _in_root(d, d.nodes(s.along), s.axes)
    return [RowAction(s.centre, e, 0), RowAction(s.frame, crossed(d, _gap(d, s.centre, s.at), e), 0)]


def _held(d: Description, s: Unmoved) -> list[RowAction]:
    if s.between is None:
        return []
    start, end = s.between
    gap = _gap(d, start, end)
    apart = [k for k, x in enumerate(difference(d.model, start, end)) if x != 0]
    if len(apart) == 1:
        e = [d.graph.one if k == apart[0] else d.graph.zero for k in range(len(gap))]
    else:
        e = scaled(d.graph, d.graph.div(d.graph.one, d.graph.sqrt(dot(d.graph, gap, gap))), gap)
    return [RowAction(start, _opposite(d, e), 0), RowAction(end, e, 1)]


def _nothing(d: Description, s: Any) -> list[RowAction]:
    return []


ACTIONS: dict[type[Condition], Callable[[Description, Any], list[RowAction]]] = {
    Coincidence: _coincidence,
    Separation: _separation,
    Stated: _nothing,
    Unmoved: _held,
    SameTurn: _same_turn,
    Perpendicular: _perpendicular,
    OnLine: _on_line,
    NoSlip: _no_slip,
}
"""What each kind of row does with λ = 1."""
