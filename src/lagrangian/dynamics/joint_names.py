"""Which joint, and which of its sides, is meant by names of points, bodies, frames and constraints."""

from __future__ import annotations

from typing import Any, NoReturn, TypeAlias

from lagrangian.dynamics.parts import Parts, RigidPart
from lagrangian.errors import ModelError, did_you_mean
from lagrangian.model import Element, Frame, Point
from lagrangian.model.elements.conditions import NoSlip, Separation
from lagrangian.records import dataclass

GROUND = ("ground", "the ground")
MOST_LISTED = 12


@dataclass(frozen=True)
class ClosureSide:
    """A constraint, and which of its points is meant; ``sign`` is −1 for what has no point of its own."""

    element: Element
    side: int
    sign: int
    on: str
    at: str


@dataclass(frozen=True)
class Held:
    """The joint that holds a part; ``sign`` is −1 for the reaction on what carries it."""

    part: RigidPart
    sign: int
    on: str
    at: str


JointSide: TypeAlias = ClosureSide | Held
Asked: TypeAlias = Any


def joint_side(parts: Parts, asked: Asked, on: Any) -> JointSide:
    """The joint, or the constraint, that is meant. Raises `ModelError` that lists those that there are."""
    model = parts.d.model
    for element in model.constraints:
        if asked is element or (isinstance(asked, str) and asked == element.name):
            return _closure(parts, element, on)
    name = asked if isinstance(asked, str) else getattr(asked, "name", None)
    held: list[RigidPart] = []
    point = asked if isinstance(asked, Point) else next((p for p in _points(parts) if p.name == name), None)
    if point is not None and point in parts.d.places:
        held = parts.held_at(parts.d.places[point])
    if not held and name in parts.bodies:
        held = [parts.bodies[name]]
    frame = asked if isinstance(asked, Frame) else next((f for f in model.frames if f.name == name), None)
    if not held and frame is not None and frame in parts.d.axes and parts.of_frame(frame) in parts.known:
        held = [parts.of_frame(frame)]
    held = [part for part in held if part != parts.ground]
    if not held:
        _no_joint(parts, name if isinstance(name, str) else str(asked), point is not None)
    shown = name or "the joint"
    return _side(parts, held, on, shown)


def _points(parts: Parts) -> list[Point]:
    return [parts.d.model.origin, *parts.d.model.points]


def _no_joint(parts: Parts, name: str, is_point: bool) -> NoReturn:
    known = joints(parts)
    why = f"no joint at point '{name[:64]}': no body hangs on it" if is_point else f"no joint '{name[:64]}'"
    listed = ", ".join(known[:MOST_LISTED]) + (", …" if len(known) > MOST_LISTED else "")
    fix = did_you_mean(name, known) or f"joints: {listed or 'none'}"
    raise ModelError(f"there is {why}", fix=fix, code="E412")


def joints(parts: Parts) -> list[str]:
    """The names under which joints can be asked for: constraints, points that hold something, bodies."""
    model = parts.d.model
    at = [p.name for p in _points(parts) if p.name and p in parts.d.places and parts.held_at(parts.d.places[p])]
    bodies = [name for name, part in parts.bodies.items() if part != parts.ground]
    return list(dict.fromkeys([*(e.name for e in model.constraints), *at, *bodies]))


def _target(parts: Parts, on: Any) -> RigidPart:
    """The part that a side's name means: a body, a frame, a point, or the ground."""
    model = parts.d.model
    name = on if isinstance(on, str) else getattr(on, "name", None)
    if isinstance(on, str) and on in GROUND and on not in parts.bodies:
        return parts.ground
    if name in parts.bodies and not isinstance(on, (Point, Frame)):
        return parts.bodies[name]
    frame = on if isinstance(on, Frame) else next((f for f in model.frames if f.name == name), None)
    if frame is not None and frame in parts.d.axes:
        return parts.of_frame(frame)
    point = on if isinstance(on, Point) else next((p for p in _points(parts) if p.name == name), None)
    if point is not None and point in parts.d.places:
        return parts.natives[parts.d.places[point]]
    known = list(dict.fromkeys([*parts.bodies, *(f.name for f in model.frames if f.name), "ground"]))
    fix = did_you_mean(str(name), known) or f"known: {', '.join(known[:MOST_LISTED])}"
    raise ModelError(f"there is no body, frame or point '{str(name or on)[:64]}' to act on", fix=fix, code="E412")


def _side(parts: Parts, held: list[RigidPart], on: Any, shown: str) -> Held:
    """The part that is held, and on which side of the joint the reaction is asked for."""
    names = [parts.label(part) for part in held]
    if on is None:
        if len(held) > 1:
            said = f"{len(held)} parts are held at '{shown}': {', '.join(names)}"
            raise ModelError(said, fix=f"on={names[0].split(' and ')[0]}", code="E412")
        return Held(held[0], 1, _plain(names[0]), _at(parts, held[0], shown))
    target = _target(parts, on)
    outer = [part for part in held if target == part]
    outer = outer or [part for part in held if target in parts.outer(part)]
    if len(outer) > 1:  # the one that is nearest to the target
        outer = [max(outer, key=lambda part: len(list(parts.chain(part))))]
    if outer:
        return Held(outer[0], 1, _plain(parts.label(outer[0])), _at(parts, outer[0], shown))
    inner = [part for part in held if parts.carrier(part) == target]
    if len(inner) == 1:
        return Held(inner[0], -1, _plain(parts.label(target)), _at(parts, inner[0], shown))
    raise ModelError(
        f"'{shown}' does not join {parts.label(target)}"
        if not inner
        else f"'{shown}' joins several parts to {parts.label(target)}",
        fix=f"on={names[0].split(' and ')[0]}",
        code="E412",
    )


def _plain(label: str) -> str:
    return label.replace("'", "")


def _at(parts: Parts, part: RigidPart, shown: str) -> str:
    """The name of the point at which a part is held, if it has one."""
    there = parts.same_place(part.anchor)
    at = [p.name for p in _points(parts) if p.name and p in parts.d.places]
    named = [name for name in at if parts.same_place(parts.d.places[_point(parts, name)]) is there]
    return shown if shown in named or not named else named[0]


def _point(parts: Parts, name: str) -> Point:
    return next(p for p in _points(parts) if p.name == name)


# -- constraints ------------------------------------------------------------------------------------------------


def _closure(parts: Parts, element: Element, on: Any) -> ClosureSide:
    """A constraint's points, and the one that is meant; the first by default."""
    model = parts.d.model
    conditions = element.conditions(model)
    first = conditions[0]
    if isinstance(first, NoSlip):
        body = parts.label(parts.of_frame(first.frame))
        at = first.at.name or "the contact"
        if on is None or _target(parts, on) == parts.of_frame(first.frame):
            return ClosureSide(element, 0, 1, _plain(body), at)
        if _target(parts, on) == parts.ground:
            return ClosureSide(element, 0, -1, "the ground", at)
        raise ModelError(f"'{element.name}' acts on {body} and the ground", fix=f"on={body}", code="E412")
    points: list[Point] = []
    for condition in conditions:
        listed = condition.points if isinstance(condition, Separation) else _ends(condition)
        points += [p for p in listed if p not in points]
    if not points:
        raise ModelError(
            f"the constraint '{element.name}' is an expression, which has a multiplier and no force at a point",
            fix=f"ask for its multiplier '{element.name}', or describe the joint between two points",
            code="E412",
        )
    side = 0
    if on is not None:
        side = _end(parts, element, points, on)
    shown = points[side].name or ("the origin" if points[side].is_origin else "the point")
    own = parts.label(parts.natives[parts.d.places[points[side]]])
    return ClosureSide(element, side, 1, _plain(own), shown)


def _ends(condition: Any) -> tuple[Point, ...]:
    return tuple(p for p in (getattr(condition, "start", None), getattr(condition, "end", None)) if p is not None)


def _end(parts: Parts, element: Element, points: list[Point], on: Any) -> int:
    """The number of the point on which the reaction is asked for: itself, or the body or frame that it belongs to."""
    for number, point in enumerate(points):
        if on is point or (isinstance(on, str) and on == point.name):
            return number
    target = _target(parts, on)
    own = [number for number, p in enumerate(points) if parts.natives[parts.d.places[p]] == target]
    names = [p.name or parts.label(parts.natives[parts.d.places[p]]) for p in points]
    if len(own) == 1:
        return own[0]
    what = f"'{element.name}' has {len(own) or 'no'} point{'s' if len(own) != 1 else ''} on {parts.label(target)}"
    raise ModelError(what, fix=f"name one of its points: {', '.join(names)}", code="E412")
