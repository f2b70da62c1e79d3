"""Converts constraints to rows of nodes: a quantity that must be zero, its rate, and the rate of its rate.

The distance between two points is measured along the paths from the place that carries both; the motion of that place
does not enter. In space, rows have components along the axes of a body, because the velocities there are already nodes
of the tape. If the points coincide, these rows have the same multipliers as the derivatives of f.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise, takewhile
from typing import Any

from lagrangian.dynamics.axes import Accelerations, Axes, PlaceMotion
from lagrangian.dynamics.description import Description
from lagrangian.dynamics.rows import ConstraintRow
from lagrangian.dynamics.vectors import Vector, cross, dot, minus, plus, times, transposed, zeros
from lagrangian.model import Point
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
from lagrangian.model.rows import named_conditions

Made = tuple[int, int | None, Callable[[Accelerations], int] | None]
"""c, f (None for a row on velocities), and the function that computes ċ from accelerations."""


def rows(d: Description) -> list[ConstraintRow]:
    """The rows of all constraints, in order."""
    found: list[ConstraintRow] = []
    for named in named_conditions(d.model):
        c, f, acceleration = CONDITIONS[type(named.condition)](d, named.condition)
        element = named.element
        found.append(ConstraintRow(named.name, element.name, c, f, acceleration, place=element.place))
    return found


def _coincidence(d: Description, s: Any) -> Made:
    motion, g = d.motion, d.graph
    start, end = d.places[s.start], d.places[s.end]
    gap = motion.between(end, start)
    if motion.dimension == 2 or s.frame is None:
        c = motion.rate([gap[s.axis]])[0]
        return c, gap[s.axis], None
    axes = d.axes[s.frame]
    f = times(g, transposed(motion.rotation(axes)), gap)[s.axis]
    closure = Gap(d, start, end)
    velocity = minus(g, closure.velocity(start, axes), closure.velocity(end, axes))
    return velocity[s.axis], f, closure.acceleration(axes, s.axis)


class Gap:
    """The velocities of two places relative to the place that carries both, in the axes of a body."""

    def __init__(self, d: Description, start: PlaceMotion, end: PlaceMotion) -> None:
        self.motion, self.graph = d.motion, d.graph
        self.start, self.end = start, end
        above = set(_upwards(start))
        self.common = next(place for place in _upwards(end) if place in above)

    @property
    def grounded(self) -> bool:
        """Whether the common place is at rest: velocities relative to it are then absolute."""
        return self.common.parent is None

    def velocity(self, place: PlaceMotion, axes: Axes) -> Vector:
        """v_place − v_common, for axes that do not rotate with the common place."""
        motion, g = self.motion, self.graph
        if self.grounded:
            return motion.turned(place.velocity, place.axes, axes)
        chain: list[PlaceMotion] = []
        while place is not self.common:
            chain.append(place)
            assert place.parent is not None
            place = place.parent
        total, at = zeros(g, 3), motion.root
        for step in reversed(chain):
            carried = motion.turned(total, at, step.axes)
            total = plus(g, plus(g, carried, cross(g, self._omega(step.axes), step.offset)), step.offset_rate)
            at = step.axes
        return motion.turned(total, at, axes)

    def _omega(self, axes: Axes) -> Vector:
        """The angular velocity ω of the axes relative to the common place, along the axes themselves."""
        home = self.common.axes
        chain: list[Axes] = []
        at: Axes | None = axes
        while at is not None and at is not home:
            chain.append(at)
            at = at.parent
        if at is None:
            return axes.omega
        total = zeros(self.graph, 3)
        for below in reversed(chain):
            total = plus(self.graph, times(self.graph, transposed(below.turn), total), below.own)
        return total

    def acceleration(self, axes: Axes, axis: int) -> Callable[[Accelerations], int] | None:
        """a_start − a_end in ``axes``; None if the common place moves, and c must be differentiated instead."""
        if not self.grounded:
            return None
        motion, g = self.motion, self.graph

        def difference(acc: Accelerations) -> int:
            start = motion.turned(acc.a[self.start], self.start.axes, axes)
            end = motion.turned(acc.a[self.end], self.end.axes, axes)
            return g.sub(start[axis], end[axis])

        return difference


def _upwards(place: PlaceMotion) -> Iterator[PlaceMotion]:
    at: PlaceMotion | None = place
    while at is not None:
        yield at
        at = at.parent


def _differentiated(d: Description, f: int) -> Made:
    return d.motion.rate([f])[0], f, None


def _separation(d: Description, s: Any) -> Made:
    g = d.graph
    total = g.neg(d.node(s.length))
    for start, end in pairwise(s.points):
        gap = d.motion.between(d.places[start], d.places[end])
        total = g.add(total, g.sqrt(dot(g, gap, gap)))
    return _differentiated(d, total)


def _stated(d: Description, s: Any) -> Made:
    if s.velocity:
        return d.node(s.rate(d.model)), None, None
    return _differentiated(d, d.node(s.value))


def _held(d: Description, s: Any) -> Made:
    return _stated(d, s) if s.between is None else (slip_rate(d, *s.between), None, None)


def slip_rate(d: Description, start: Point, end: Point) -> int:
    """δ̇ of two points from their velocities: along the one fixed line on which they are apart, or of their distance."""
    g, motion = d.graph, d.motion
    places = d.places[start], d.places[end]
    gap = motion.between(*places)
    a, b = (motion.turned(place.velocity, place.axes, motion.root) for place in places)
    velocity = minus(g, b, a)
    apart = [k for k, x in enumerate(difference(d.model, start, end)) if x != 0]
    if len(apart) == 1:
        return velocity[apart[0]]
    return g.div(dot(g, gap, velocity), g.sqrt(dot(g, gap, gap)))


def _same_turn(d: Description, s: Any) -> Made:
    g = d.graph
    other = d.angles[s.second] if s.second is not None else g.zero
    return _differentiated(d, g.sub(g.sub(d.angles[s.first], other), d.node(s.angle)))


def _perpendicular(d: Description, s: Any) -> Made:
    """f = a · b, ḟ = (ω_first − ω_second) · (a × b), in the axes of the second."""
    motion, g = d.motion, d.graph
    first = d.axes[s.first]
    second = motion.root if s.second is None else d.axes[s.second]
    a, b = motion.turned(d.nodes(s.along), first, second), d.nodes(s.other)
    turning = minus(g, motion.turned(first.omega, first, second), second.omega)
    return dot(g, turning, cross(g, a, b)), dot(g, a, b), None


def _on_line(d: Description, s: Any) -> Made:
    motion, g = d.motion, d.graph
    gap = motion.between(d.places[s.end], d.places[s.start])
    normal = d.nodes(s.normal)
    if s.frame is not None:
        normal = times(g, motion.rotation(d.axes[s.frame]), normal)
    return _differentiated(d, dot(g, normal, gap))


def _no_slip(d: Description, s: Any) -> Made:
    """c = e · (v_centre + ω × (r_at − r_centre)), in the axes of e."""
    motion, g = d.motion, d.graph
    centre, body = d.places[s.centre], d.axes[s.frame]
    target = motion.root if s.axes is None else d.axes[s.axes]
    arm = motion.between(centre, d.places[s.at])
    e = d.nodes(s.along)
    if motion.dimension == 2:
        w = body.omega[0]
        velocity = plus(g, centre.velocity, [g.neg(g.mul(w, arm[1])), g.mul(w, arm[0])])
        if s.axes is not None:
            e = times(g, target.turn, e)
        return dot(g, e, velocity), None, None
    velocity = _matter(d, centre, d.places[s.at], body, target)
    if velocity is None:
        if target is not motion.root:
            arm = times(g, transposed(motion.rotation(target)), arm)
        omega = motion.turned(body.omega, body, target)
        velocity = plus(g, motion.turned(centre.velocity, centre.axes, target), cross(g, omega, arm))
    return dot(g, e, velocity), None, None


def _matter(d: Description, centre: PlaceMotion, at: PlaceMotion, body: Axes, target: Axes) -> Vector | None:
    """The velocity of a body's matter ``at`` a place, from the place Q that carries this one and the centre:

        v = v_Q + Σ_steps to the centre ((ω_step − ω_body) × offset + its rate) + Σ_steps to the place ω_body × offset

    What turns both the body and the steps to its centre does not enter: of a disc that rolls, its own turn is left.
    None where a place on the way floats.
    """
    motion, g = d.motion, d.graph
    above = set(_upwards(centre))
    common = next(place for place in _upwards(at) if place in above)
    ways = [list(takewhile(lambda p: p is not common, _upwards(end))) for end in (centre, at)]
    if any(place.slide is not None for way in ways for place in way):
        return None
    total = motion.turned(common.velocity, common.axes, target)
    for step in ways[0]:
        moved = plus(g, cross(g, _spin_between(d, step.axes, body), step.offset), step.offset_rate)
        total = plus(g, total, motion.turned(moved, step.axes, target))
    for step in ways[1]:
        moved = cross(g, motion.turned(body.omega, body, step.axes), step.offset)
        total = plus(g, total, motion.turned(moved, step.axes, target))
    return total


def _spin_between(d: Description, axes: Axes, other: Axes) -> Vector:
    """ω_axes − ω_other along ``axes``: the turns between the two alone."""
    g, total = d.graph, zeros(d.graph, 3)
    a, b = axes, other
    while a is not b:
        if b.parent is None or (a.parent is not None and a.depth > b.depth):
            total = plus(g, total, d.motion.turned(a.own, a, axes))
            assert a.parent is not None
            a = a.parent
        else:
            total = minus(g, total, d.motion.turned(b.own, b, axes))
            b = b.parent
    return total


CONDITIONS: dict[type[Condition], Callable[[Description, Any], Made]] = {
    Coincidence: _coincidence,
    Separation: _separation,
    Stated: _stated,
    Unmoved: _held,
    SameTurn: _same_turn,
    Perpendicular: _perpendicular,
    OnLine: _on_line,
    NoSlip: _no_slip,
}
"""The function that converts each kind of condition to nodes."""
