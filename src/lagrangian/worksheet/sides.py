"""Other places of forces, springs and dampers in a variant; the number of elements of each kind stays the same."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from copy import copy
from itertools import permutations
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.model import Damper, Element, Force, Model, Spring, Torque
from lagrangian.records import dataclass, field
from lagrangian.worksheet.dice import Dice


@dataclass(frozen=True)
class Moved:
    """Elements that are attached elsewhere, by the id of the original, and what was done.

    ``described`` has the new descriptions of letters, by name, such as those of arms.
    """

    elements: Mapping[int, Element]
    what: str
    described: Mapping[str, str] = field(default_factory=dict[str, str])


def moves(model: Model, dice: Dice) -> list[Moved]:
    """Return the ways to attach one force, or two elements, elsewhere, in random order.

    Each changes the equations in more than letters: a spring and a damper exchange their places, a force or torque acts
    on another body.
    """
    found = [*_exchanged(model), *_freed(model), *_forces(model), *_torques(model), *_dampers(model)]
    return dice.shuffled(found)


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
            described = _arms(model, one, other)
            if described is None:
                continue
            (b1, d1), (b2, d2) = _place(one), _place(other)
            made = {
                id(one): _with(one, between=b2, deflection=d2),
                id(other): _with(other, between=b1, deflection=d1),
            }
            yield Moved(made, f"{one.title} and {other.title} have exchanged their places", described)


def _arms(model: Model, one: Any, other: Any) -> dict[str, str] | None:
    """The descriptions of the letters in two deflections after an exchange, "pivot to spring" as "pivot to damper".

    None if one does not say to which of the two it belongs.
    """
    found: dict[str, str] = {}
    for own, new in ((one, other), (other, one)):
        letters = own.deflection.free_symbols if own.deflection is not None else set()
        for p in model.parameters:
            if p.symbol not in letters:
                continue
            if own.kind not in p.description or new.kind in p.description:
                return None
            found[p.name] = p.description.replace(own.kind, new.kind)
    return found


def _same(one: Any, other: Any) -> bool:
    """Whether two elements are attached at the same place."""
    if one.between is not None or other.between is not None:
        return one.between is not None and other.between is not None and set(one.between) == set(other.between)
    return (
        bounded.expand(one.deflection - other.deflection) == 0 or bounded.expand(one.deflection + other.deflection) == 0
    )


def _rest(element: Any) -> Any:
    return getattr(element, "rest", 0) or 0


def _freed(model: Model) -> Iterator[Moved]:
    """A spring, damper or force between two bodies has one end at the ground instead."""
    if model.dimension != 2:
        return
    own = [c.symbol for c in model.coordinates]
    places = {b: [model.expand(x) for x in model.position(b.at)] for b in model.bodies}
    for element in model.elements:
        if not isinstance(element, Spring | Damper | Force) or element.deflection is None or _rest(element) != 0:
            continue
        for one, other in permutations(places, 2):
            for axis in (0, 1):
                mine, its = places[one][axis], places[other][axis]
                rest = bounded.expand(model.expand(element.deflection) - (mine - its))
                if rest.has(*own) or not mine.has(*own) or not its.has(*own):
                    continue
                made = _with(element, **_grounded(element, one, mine, axis))
                yield Moved({id(element): made}, f"{element.title} is between {one.title} and the ground")


def _grounded(element: Any, body: Any, place: sp.Expr, axis: int) -> dict[str, Any]:
    if not isinstance(element, Force):
        return {"deflection": place}
    value = [sp.S.Zero, sp.S.Zero]
    value[axis] = element.value
    return {"deflection": None, "value": tuple(value), "at": body.at}


def _forces(model: Model) -> Iterator[Moved]:
    """A force at a body acts on another body."""
    bodies = {id(b.at): b for b in model.bodies}
    for force in model.elements:
        if not isinstance(force, Force) or id(force.at) not in bodies or force.reaction is not None:
            continue
        for body in bodies.values():
            if body.at is not force.at:
                yield Moved({id(force): _with(force, at=body.at)}, f"{force.title} acts on {body.title}")


def _torques(model: Model) -> Iterator[Moved]:
    """A torque acts without its reaction, or the other way round."""
    for torque in model.elements:
        if not isinstance(torque, Torque) or torque.reaction is None or torque.axes is not None:
            continue
        alone = _with(torque, reaction=None)
        yield Moved({id(torque): alone}, f"{torque.title} reacts on the ground")
        yield Moved({id(torque): _with(alone, on=torque.reaction)}, f"{torque.title} turns what it reacted on")


def _dampers(model: Model) -> Iterator[Moved]:
    """A damper on one coordinate is on another, if no element is there yet."""
    own = [c.symbol for c in model.coordinates]
    taken = [e.deflection for e in model.elements if isinstance(e, Spring | Damper)]
    for damper in model.elements:
        if not isinstance(damper, Damper) or damper.deflection not in own:
            continue
        for c in model.coordinates:
            if c.symbol != damper.deflection and c.symbol not in taken:
                made = _with(damper, deflection=c.symbol)
                yield Moved({id(damper): made}, f"{damper.title} is on {c.name}")
