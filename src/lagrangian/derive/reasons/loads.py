"""The forces that act on the bodies themselves, element by element, and what reaches them through massless parts.

A spring between two bodies, a weight, a force at a point of a body act on bodies: each is a `Load`. A torque on a lever
without mass, or a damper whose deflection is an angle of such a lever, acts on no body: the lever passes it on, so
that it is in the constraint forces of the masses that the lever carries. Nor is it known on which bodies a rope pulls
that is described by how far it is stretched, or what has an energy alone. Each of these is a `PassedOn`.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false
# pyright: reportUnknownVariableType=false

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Literal, TypeAlias

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Form
from lagrangian.derive.context import Context
from lagrangian.derive.reasons.fixed import FixedPoints
from lagrangian.derive.reasons.motion import Column, Moving, dot, in_body_axes
from lagrangian.model import Body, Damper, Element, Force, Frame, Friction, Gravity, Point, Spring, Torque, time
from lagrangian.model.elements.base import difference
from lagrangian.model.elements.spring import DELTA
from lagrangian.model.elements.vectors import norm
from lagrangian.records import dataclass
from lagrangian.viewed import Brief


@dataclass(frozen=True, eq=False)
class Load(Brief):
    """What an element does to a body: a force [N] in the fixed axes, and a torque [N m] about its centre of mass.

    The torque is in the axes of the body, empty for a particle.
    """

    element: Element
    body: Body
    force: tuple[sp.Expr, ...]
    torque: tuple[sp.Expr, ...]


Through: TypeAlias = Literal["part", "deflection", "energy"]


@dataclass(frozen=True, eq=False)
class PassedOn(Brief):
    """An effort that is known as a load on no body; its virtual work is effort · ∂rate/∂ξ̇_j δξ_j.

    ``through`` says why: it acts on a "part" without mass; a "deflection" of bodies does not say where it acts on them;
    an "energy" or a generalized force says nothing of bodies.
    """

    element: Element
    effort: sp.Expr
    rate: sp.Expr
    through: Through = "part"


@dataclass(frozen=True, eq=False)
class AppliedLoads:
    """All loads on the bodies, and all efforts that massless parts pass on."""

    loads: tuple[Load, ...]
    passed: tuple[PassedOn, ...]


def applied_loads(context: Context, moving: tuple[Moving, ...]) -> AppliedLoads:
    """The loads of all elements that act."""
    places = FixedPoints(context, moving)
    loads: list[Load] = []
    passed: list[PassedOn] = []
    for element in context.model.elements:
        for item in _of(places, element) if element.ledger in ("V", "Ξ") else ():
            loads += [item] if isinstance(item, Load) else []
            passed += [item] if isinstance(item, PassedOn) else []
    return AppliedLoads(tuple(loads), tuple(passed))


def load_work(context: Context, moving: tuple[Moving, ...], load: Load, index: int) -> Form:
    """F·∂r/∂ξ_j + τ·∂ω/∂ξ̇_j."""
    parts = [
        dot(context, [context.form(x) for x in (load.torque if m.turning else load.force)], m.columns[index])
        for m in moving
        if m.body is load.body and (load.torque if m.turning else load.force)
    ]
    return context.algebra.total(parts)


def passed_work(context: Context, item: PassedOn, index: int) -> Form:
    """effort · ∂rate/∂ξ̇_j."""
    return context.form(item.effort * bounded.diff(item.rate, context.model.coordinates[index].rate))


def on_body(context: Context, loads: Sequence[Load], m: Moving) -> Column:
    """The sum of the loads on a translation or a rotation."""
    mine = [load.torque if m.turning else load.force for load in loads if load.body is m.body]
    size = len(m.velocity)
    listed = [v for v in mine if v]
    return tuple(context.algebra.total([context.form(v[i]) for v in listed]) for i in range(size))


# -- one element ----------------------------------------------------------------------------------------------------


def _of(places: FixedPoints, element: Element) -> Iterator[Load | PassedOn]:
    model = places.context.model
    if isinstance(element, Gravity):
        for body in model.bodies:
            force = tuple(body.mass * element.g * n for n in element.direction)
            yield Load(element, body, force, _no_torque(body))
    elif isinstance(element, Torque):
        yield from _torque(places, element)
    elif isinstance(element, Force) and element.is_vector:
        force = element.components(model)
        yield from _at(places, element, element.at, force)
        if element.reaction is not None:
            yield from _at(places, element, element.reaction, tuple(-f for f in force))
    elif isinstance(element, (Spring, Damper, Force, Friction)):
        yield from _deflected(places, element)
    elif element.ledger == "V":
        energy = element.potential(model)
        for c in model.coordinates:
            if (slope := bounded.diff(energy, c.symbol)) != 0:
                yield PassedOn(element, -slope, c.rate, "energy")
    else:
        for action in element.works(model):
            yield PassedOn(element, action.effort, action.rate, "energy")


def _no_torque(body: Body) -> tuple[sp.Expr, ...]:
    return (sp.S.Zero,) * len(body.tensor)


def _at(places: FixedPoints, element: Element, point: Point, force: tuple[sp.Expr, ...]) -> Iterator[Load | PassedOn]:
    """A force at a point: on the body in which the point is fixed, with its moment about the centre of mass."""
    model = places.context.model
    if places.still(point):
        return
    body = places.body_of(point)
    if body is None:
        for f, v in zip(force, model.velocity(point), strict=True):
            if f != 0:
                yield PassedOn(element, f, v)
        return
    yield _load_at(places, element, body, point, force)


def _load_at(places: FixedPoints, element: Element, body: Body, point: Point, force: tuple[sp.Expr, ...]) -> Load:
    """A force on a body at a point, with its moment about the centre of mass."""
    model = places.context.model
    if not body.tensor:
        return Load(element, body, force, ())
    arm = difference(model, body.at, point)
    if len(arm) == 2:
        moment: tuple[sp.Expr, ...] = (arm[0] * force[1] - arm[1] * force[0],)
    else:
        moment = tuple(arm[i] * force[j] - arm[j] * force[i] for i, j in ((1, 2), (2, 0), (0, 1)))
    return Load(element, body, force, tuple(map(model.expand, in_body_axes(body, moment))))


def _deflected(places: FixedPoints, element: Spring | Damper | Force | Friction) -> Iterator[Load | PassedOn]:
    """A pair of forces along the line of two points, or an effort on a deflection."""
    model = places.context.model
    if isinstance(element, Spring):
        extension = element.extension(model)
        slope = element.k * extension if element.k is not None else _law(element, extension)
        effort, rate, displacement = -slope, bounded.diff(extension, time), extension
    else:
        (action,) = element.works(model)
        assert action.displacement is not None
        effort, rate, displacement = action.effort, action.rate, action.displacement
    if element.between is not None and isinstance(element, Spring) and _moves(places, element.rest):
        yield PassedOn(element, effort, rate, "deflection")
    elif element.between is not None:
        start, end = element.between
        delta = difference(model, start, end)
        length: sp.Expr = norm(delta)
        if not isinstance(element, Spring) and places.context.form(displacement) == places.context.form(
            sp.Add(*delta)  # along one axis a damper and a friction count the signed separation
        ):
            length = sp.Add(*delta)
        along = tuple(effort * x / length for x in delta)
        yield from _at(places, element, end, along)
        yield from _at(places, element, start, tuple(-f for f in along))
    else:
        yield from _along(places, element, effort, rate, displacement)


def _law(element: Spring, extension: sp.Expr) -> sp.Expr:
    return bounded.diff(element.energy, DELTA).subs(DELTA, extension)


def _moves(places: FixedPoints, expr: sp.Expr) -> bool:
    return places.context.form(places.context.model.expand(sp.sympify(expr))).moves


def _torque(places: FixedPoints, element: Torque) -> Iterator[Load | PassedOn]:
    """A torque on a frame or an angle: on the body that turns with it, else through something without mass."""
    model = places.context.model
    for action in element.works(model):
        if isinstance(action.target, Frame) and action.target.dimension == 3:
            continue
        loads = [] if action.displacement is None else _twisted(places, element, action.effort, action.displacement)
        yield from loads or [PassedOn(element, action.effort, action.rate)]
    for sign, target in ((1, element.on), (-1, element.reaction)):
        if not isinstance(target, Frame) or target.dimension == 2:
            continue
        body = next((b for b in model.bodies if b.axes is target and b.tensor), None)
        if body is None:
            for action in element.works(model):
                if action.target is target:
                    yield PassedOn(element, action.effort, action.rate)
            continue
        if isinstance(element.value, tuple):
            value: Any = element.value if element.axes is None else element.axes.in_fixed_axes(element.value)
        else:
            value = tuple(element.value * n for n in element.on.in_fixed_axes(element.on.axis))
        torque = tuple(model.expand(sign * x) for x in in_body_axes(body, value))
        yield Load(element, body, (sp.S.Zero,) * 3, torque)


def _along(
    places: FixedPoints, element: Element, effort: sp.Expr, rate: sp.Expr, displacement: sp.Expr
) -> Iterator[Load | PassedOn]:
    """An effort on a deflection: between two bodies, or a body and the ground, whose distance or angle it is."""
    found = _straight(places, element, effort, displacement) or _twisted(places, element, effort, displacement)
    found = found or _stretched(places, element, effort, displacement) or _slid(places, element, effort, displacement)
    yield from found or [PassedOn(element, effort, rate, _through(places, displacement))]


def _through(places: FixedPoints, displacement: sp.Expr) -> Through:
    """Whether a deflection that is no distance or angle of bodies involves a part without mass.

    It does not where every coordinate in it moves a body along a straight line or turns one that has inertia, as the
    load and the drum at the ends of a rope: y − R θ.
    """
    context = places.context
    own = {
        j
        for m in places.moving
        for j, column in enumerate(m.columns)
        if any(x.parts for x in column) and not any(x.moves for x in column)
    }
    held = (j for j, c in enumerate(context.model.coordinates) if context.form(displacement).diff(c.symbol).parts)
    return "deflection" if all(j in own for j in held) else "part"


def _pairs(places: FixedPoints) -> Iterator[tuple[Body | None, Body]]:
    """The ground with every body, then every body with every other."""
    bodies = places.context.model.bodies
    yield from ((None, b) for b in bodies)
    yield from ((a, b) for b in bodies for a in bodies if a is not b)


def _unit_slope(context: Context, displacement: sp.Expr) -> tuple[list[Form], int | None]:
    """The slopes of a deflection by the coordinates, and which is the first that is not 0; None if it is not ±1."""
    slopes = [context.form(bounded.diff(displacement, c.symbol)) for c in context.model.coordinates]
    at = next((j for j, s in enumerate(slopes) if not s.is_zero), None)
    unit = at is not None and slopes[at].is_number and abs(slopes[at].expr()) == 1
    return slopes, at if unit else None


def _straight(places: FixedPoints, element: Element, effort: sp.Expr, displacement: sp.Expr) -> list[Load]:
    """The deflection is the separation of two bodies along a direction u that does not turn: ∂r/∂ξ = u ∂δ/∂ξ."""
    context = places.context
    slopes, at = _unit_slope(context, displacement)
    if at is None:
        return []
    place = {m.body: m for m in places.moving if not m.turning}
    for a, b in _pairs(places):
        base = None if a is None else place[a]
        u = [x * slopes[at] for x in _apart(base, place[b], at)]
        if any(x.moves for x in u) or not (dot(context, u, u) - context.algebra.number(1)).is_zero:
            continue
        if all(
            (x - n * s).is_zero if s.parts else x.is_zero
            for j, s in enumerate(slopes)
            for x, n in zip(_apart(base, place[b], j), u, strict=True)
        ):
            return _pair(element, a, b, tuple(effort * x.expr() for x in u))
    return []


def _apart(a: Moving | None, b: Moving, index: int) -> Column:
    """∂(r_b − r_a)/∂ξ_j; the ground does not move."""
    if a is None:
        return b.columns[index]
    return tuple(x - y if y.parts else x for x, y in zip(b.columns[index], a.columns[index], strict=True))


def _stretched(places: FixedPoints, element: Element, effort: sp.Expr, displacement: sp.Expr) -> list[Load]:
    """The deflection, up to a constant, is the distance of two bodies, or of a body from the origin."""
    context, model = places.context, places.context.model
    delta = (
        displacement + element.rest if isinstance(element, Spring) and element.deflection is not None else displacement
    )
    square = context.form(delta) ** 2
    for a, b in _pairs(places):
        apart = difference(model, model.origin if a is None else a.at, b.at)
        forms = [context.form(x) for x in apart]
        if (dot(context, forms, forms) - square).is_zero:
            return _pair(element, a, b, tuple(effort * x / delta for x in apart))
    return []


def _slid(places: FixedPoints, element: Element, effort: sp.Expr, displacement: sp.Expr) -> list[Load]:
    """The deflection is how far a body has moved along a straight line in the axes of another that turns."""
    context, model = places.context, places.context.model
    slopes, at = _unit_slope(context, displacement)
    if at is None:
        return []
    for a, b in _pairs(places):
        if a is None or a.axes is None:
            continue
        arm = [context.form(x) for x in places.along_axes(a, difference(model, a.at, b.at))]
        u = [x.diff(model.coordinates[at].symbol) * slopes[at] for x in arm]
        if any(x.moves for x in u) or not (dot(context, u, u) - context.algebra.number(1)).is_zero:
            continue
        if all(
            (x.diff(c.symbol) - n * s).is_zero
            for c, s in zip(model.coordinates, slopes, strict=True)
            for x, n in zip(arm, u, strict=True)
        ):
            along = a.axes.in_fixed_axes([effort * x.expr() for x in u])
            force = tuple(map(model.expand, along))
            opposite = _load_at(places, element, a, b.at, tuple(-x for x in force))
            return [Load(element, b, force, _no_torque(b)), opposite]
    return []


def _pair(element: Element, a: Body | None, b: Body, force: tuple[sp.Expr, ...]) -> list[Load]:
    pair = [Load(element, b, force, _no_torque(b))]
    return pair if a is None else [*pair, Load(element, a, tuple(-f for f in force), _no_torque(a))]


def _hinged(places: FixedPoints, element: Element, effort: sp.Expr, displacement: sp.Expr) -> list[Load]:
    """The deflection is, up to a constant and a sign, the angle of a body's frame in space about its axis n.

    The torque E n acts on that body and −E n on the body that its frame turns on, if it does not turn on the ground; n
    has the same components in the axes of both.
    """
    model = places.context.model
    turning = [b for b in model.bodies if b.tensor and b.axes is not None and b.axes.axis is not None]
    for b in turning:
        assert b.axes is not None and b.axes.axis is not None
        sign = _turns(places, model.expand(b.axes.angle), displacement)
        base = b.axes.parent
        a = next((x for x in turning if x.axes is base), None)
        if sign == 0 or (base is not None and a is None):
            continue
        torque, zero = tuple(sign * effort * n for n in b.axes.axis), (sp.S.Zero,) * 3
        pair = [Load(element, b, zero, torque)]
        return pair if a is None else [*pair, Load(element, a, zero, tuple(-x for x in torque))]
    return []


def _twisted(places: FixedPoints, element: Element, effort: sp.Expr, displacement: sp.Expr) -> list[Load]:
    """The deflection is the angle of a body in the plane, or between two bodies, up to a constant and a sign."""
    model = places.context.model
    if model.dimension == 3:
        return _hinged(places, element, effort, displacement)
    zero = (sp.S.Zero,) * model.dimension
    angles = {
        b: model.expand(b.axes.total_angle)
        for b in model.bodies
        if b.axes is not None and b.axes.dimension == 2 and b.tensor
    }
    for a, b in _pairs(places):
        if b not in angles or (a is not None and a not in angles):
            continue
        if sign := _turns(places, angles[b] - (0 if a is None else angles[a]), displacement):
            pair = [Load(element, b, zero, (sign * effort,))]
            return pair if a is None else [*pair, Load(element, a, zero, (-sign * effort,))]
    return []


def _turns(places: FixedPoints, angle: sp.Expr, displacement: sp.Expr) -> int:
    """1 if a deflection is an angle up to a constant, −1 if it is the angle counted the other way round, else 0."""
    form = places.context.form
    return next((sign for sign in (1, -1) if not form(displacement - sign * angle).moves), 0)
