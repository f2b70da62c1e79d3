"""Other places of forces, springs and dampers in a variant; the number of elements of each kind stays the same."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from copy import copy
from itertools import permutations
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.coordinates import measured
from lagrangian.model import Coordinate, Damper, Element, Force, Frame, Model, Spring, Torque
from lagrangian.records import dataclass, field
from lagrangian.worksheet.told import MOVABLE, from_outside, letters_of, told, told_turned

Units = Mapping[str, tuple[str, float | None]]
"""The new units and values of parameters, by name."""


@dataclass(frozen=True)
class Moved:
    """Elements that are attached elsewhere, by the id of the original, and what was done.

    ``described`` has the new descriptions, by name, of letters and coordinates; it is None if they cannot be true.
    ``units`` has new units and values of constants, such as the damping of a damper that is in a hinge now; ``turned``
    are the elements that stay in their place and act the other way round.
    """

    elements: Mapping[int, Element]
    what: str
    described: Mapping[str, str] | None = field(default_factory=dict[str, str])
    units: Units = field(default_factory=dict[str, tuple[str, "float | None"]])
    turned: frozenset[int] = frozenset()


def moves(model: Model) -> list[Moved]:
    """Return the ways to attach one or two elements elsewhere; each changes the equations in more than letters."""
    found = [*_exchanged(model), *_freed(model), *_tied(model), *_forces(model), *_torques(model), *_elsewhere(model)]
    inside = {id(e) for e in model.elements if isinstance(e, Force | Torque) and not from_outside(model, e)}
    return [_told(model, move) for move in found if not inside & set(move.elements)]


def turns(model: Model) -> list[Moved]:
    """Return the ways to let one force or torque act the other way round."""
    return [*_turned(model)]


def both(model: Model, one: Moved, other: Moved) -> Moved | None:
    """Two moves in one, or None if an element would move twice or the words cannot be true.

    What has moved may act the other way round as well.
    """
    again = set(one.elements) & set(other.elements)
    if again and (one.turned or not other.turned):
        return None
    elements = {**other.elements, **one.elements, **{k: _negative(one.elements[k]) for k in again}}
    turned = (one.turned | other.turned) - again
    words = told(model, {k: e for k, e in elements.items() if k not in turned})
    if words is None:
        return None
    for move in (one, other):
        if move.turned & turned:
            words |= {name: "" if name in words else said for name, said in (move.described or {}).items()}
    what = f"{one.what}, the other way round" if again else f"{one.what}; {other.what}"
    return Moved(elements, what, words, {**one.units, **other.units}, turned)


def _told(model: Model, move: Moved) -> Moved:
    return Moved(move.elements, move.what, told(model, move.elements), move.units)


def _with(element: Element, **fields: Any) -> Element:
    made = copy(element)
    made._set(**fields)
    return made


def _place(element: Any) -> tuple[Any, Any]:
    return element.between, element.deflection


def _exchanged(model: Model) -> Iterator[Moved]:
    """A spring and a damper, or a spring and a force between two bodies, exchange their places."""
    tied = [e for e in model.elements if isinstance(e, Spring | Damper | Force) and _place(e) != (None, None)]
    for k, one in enumerate(tied):
        for other in tied[k + 1 :]:
            if one.kind == other.kind or _same(one, other) or _rest(one) != 0 or _rest(other) != 0:
                continue
            (b1, d1), (b2, d2) = _place(one), _place(other)
            made = {
                id(one): _with(one, between=b2, deflection=d2),
                id(other): _with(other, between=b1, deflection=d1),
            }
            yield Moved(made, f"{one.title} and {other.title} have exchanged their places")


def _same(one: Any, other: Any) -> bool:
    """Whether two elements are attached at the same place."""
    if one.between is not None or other.between is not None:
        return one.between is not None and other.between is not None and set(one.between) == set(other.between)
    return (
        bounded.expand(one.deflection - other.deflection) == 0 or bounded.expand(one.deflection + other.deflection) == 0
    )


def _rest(element: Any) -> Any:
    return getattr(element, "rest", 0) or 0


def _deflected(model: Model) -> Iterator[Any]:
    """The springs, dampers and forces along a deflection of a system in the plane."""
    for element in model.elements:
        if isinstance(element, Spring | Damper | Force) and element.deflection is not None and _rest(element) == 0:
            yield element


def _places(model: Model) -> dict[Any, list[sp.Expr]]:
    """Where the bodies are; only in the plane, where directions are told in words."""
    if model.dimension != 2:
        return {}
    return {b: [model.expand(x) for x in model.position(b.at)] for b in model.bodies}


def _way(model: Model, place: sp.Expr) -> sp.Expr:
    """How far something is from where all coordinates are 0."""
    return bounded.expand(place - place.subs({c.symbol: 0 for c in model.coordinates}))


def _freed(model: Model) -> Iterator[Moved]:
    """A spring, damper or force between two bodies has one end at the ground instead."""
    own = [c.symbol for c in model.coordinates]
    places = _places(model)
    for element in _deflected(model):
        for one, other in permutations(places, 2):
            for axis in (0, 1):
                mine, its = places[one][axis], places[other][axis]
                deflection = model.expand(element.deflection)
                side = next((s for s in (1, -1) if not bounded.expand(deflection - s * (mine - its)).has(*own)), 0)
                if side and mine.has(*own) and its.has(*own):
                    made = _with(element, **_grounded(element, one, side, _way(model, mine), axis))
                    yield Moved({id(element): made}, f"{element.title} is between {one.title} and the ground")


def _grounded(element: Any, body: Any, side: int, way: sp.Expr, axis: int) -> dict[str, Any]:
    if not isinstance(element, Force):
        return {"deflection": way}
    value = [sp.S.Zero, sp.S.Zero]
    value[axis] = side * element.value
    return {"deflection": None, "value": tuple(value), "at": body.at}


def _tied(model: Model) -> Iterator[Moved]:
    """A spring, damper or force between a body and the ground is between two bodies that move along one line."""
    own = [c.symbol for c in model.coordinates]
    places = _places(model)
    for element in _deflected(model):
        for one, other in permutations(places, 2):
            for axis in (0, 1):
                mine, its = places[one][axis], places[other][axis]
                if its.has(sp.sin, sp.cos) or any(places[x][1 - axis].has(*own) for x in (one, other)):
                    continue
                side = next((s for s in (1, -1) if _way(model, model.expand(element.deflection) - s * mine) == 0), 0)
                if side and mine.has(*own) and its.has(*own):
                    made = _with(element, deflection=side * (_way(model, mine) - _way(model, its)))
                    yield Moved({id(element): made}, f"{element.title} is between {one.title} and {other.title}")


def _forces(model: Model) -> Iterator[Moved]:
    """A force at a body acts on another body, or across its direction."""
    bodies = {id(b.at): b for b in model.bodies}
    for force in model.elements:
        if not isinstance(force, Force) or id(force.at) not in bodies or force.reaction is not None:
            continue
        for body in bodies.values():
            if body.at is not force.at:
                yield Moved({id(force): _with(force, at=body.at)}, f"{force.title} acts on {body.title}")
        for body in bodies.values():
            if len(force.value) == 2 and force.axes is None and 0 in force.value:
                across = "upward" if force.value[1] == 0 else "to the right"
                made = _with(force, at=body.at, value=tuple(reversed(force.value)))
                yield Moved({id(force): made}, f"{force.title} acts {across} on {body.title}")


def _torques(model: Model) -> Iterator[Moved]:
    """A torque acts without its reaction, or the other way round, or on the frame of another body."""
    for torque in model.elements:
        if not isinstance(torque, Torque) or torque.axes is not None:
            continue
        if torque.reaction is not None:
            alone = _with(torque, reaction=None)
            yield Moved({id(torque): alone}, f"{torque.title} reacts on the ground")
            yield Moved({id(torque): _with(alone, on=torque.reaction)}, f"{torque.title} turns what it reacted on")
        elif isinstance(torque.on, Frame) and model.dimension == 2:
            for body in model.bodies:
                frame = getattr(body, "frame", None)
                if frame is not None and frame is not torque.on and _turns_freely(model, frame):
                    yield Moved({id(torque): _with(torque, on=frame)}, f"{torque.title} turns {body.title}")


def _turns_freely(model: Model, frame: Frame) -> bool:
    """Whether a frame turns by angles alone, not as a wheel that rolls."""
    kinds, angle = measured(model), model.expand(frame.total_angle)
    return all(kinds[c.symbol].angle for c in model.coordinates if angle.has(c.symbol))


def _elsewhere(model: Model) -> Iterator[Moved]:
    """A spring, damper, force or torque on one coordinate is on another, if no element of its kind is there yet."""
    own = {c.symbol: c for c in model.coordinates if c not in model.charges}
    kinds = measured(model)
    taken = {(e.kind, e.deflection) for e in model.elements if isinstance(e, Spring | Damper)}
    for element in model.elements:
        if not isinstance(element, MOVABLE) or _rest(element) != 0 or getattr(element, "reaction", None) is not None:
            continue
        key = "on" if isinstance(element, Torque) else "deflection"
        place = getattr(element, key)
        sides = [s for s in own if place in (s, -s)] if isinstance(place, sp.Expr) else []
        for old in sides:
            for new, c in own.items():
                if new == old or (element.kind, new) in taken or not kinds[new].known:
                    continue
                units = _units(model, element, own[old], c, kinds[new].angle - kinds[old].angle)
                if units is not None:
                    made = _with(element, **{key: new})
                    yield Moved({id(element): made}, f"{element.title} is on {c.name}", units=units)


UNITS = {Spring: ("N/m", "N*m/rad"), Damper: ("N*s/m", "N*m*s/rad")}
"""The units of constants along a line and in a hinge."""


def _units(model: Model, element: Any, old: Coordinate, new: Coordinate, change: int) -> Units | None:
    """The units that an element has at a coordinate of another kind; None if it cannot be there.

    ``change`` is 1 from a length to an angle, -1 the other way. The new value is that at an arm of the system's length.
    """
    if change == 0:
        return {}
    symbol = getattr(element, "k" if isinstance(element, Spring) else "b", None)
    found = next((p for p in model.parameters if p.symbol == symbol), None)
    if type(element) not in UNITS or found is None or found.value is None:
        return None
    if any(found.name in letters_of(e) for e in model.elements if e is not element) or _has_law(element):
        return None
    arm = next((v for p in model.parameters if p.unit == "m" and (v := p.value)), 1.0)
    return {found.name: (UNITS[type(element)][change == 1], found.value * abs(arm) ** (2 * change))}


def _has_law(element: Any) -> bool:
    return any(getattr(element, key, None) is not None for key in ("law", "energy"))


def _turned(model: Model) -> Iterator[Moved]:
    """A force or torque, with a letter of its own, acts the other way round."""
    for element in model.elements:
        if not isinstance(element, Force | Torque) or not letters_of(element) or not from_outside(model, element):
            continue
        if isinstance(element, Torque) and (isinstance(element.value, tuple) or model.dimension != 2):
            continue
        if not any(letters_of(e) & letters_of(element) for e in model.elements if e is not element):
            what = f"{element.title} acts the other way round"
            yield Moved(
                {id(element): _negative(element)}, what, told_turned(model, element), turned=frozenset([id(element)])
            )


def _negative(element: Any) -> Element:
    """A force or torque that acts the other way round."""
    value = element.value
    return _with(element, value=tuple(-x for x in value) if isinstance(value, tuple) else -value)
