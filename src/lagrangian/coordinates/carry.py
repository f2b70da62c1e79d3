"""Converts a model to other coordinates; every definition, point, frame and element keeps its name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from dataclasses import fields
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.coordinates.change import Change, read_change
from lagrangian.coordinates.initial import carried_settings
from lagrangian.coordinates.pose import carried_look
from lagrangian.coordinates.signals import carried_signals
from lagrangian.model import (
    Builder,
    Definition,
    Element,
    Floating,
    Frame,
    GeneralizedForce,
    Model,
    Parameter,
    Point,
    is_hard,
)
from lagrangian.page.plain import plain


def changed(model: Model, change: Mapping[Any, Any] | Change, *, name: str | None = None) -> Model:
    """Return the same system in other coordinates; ``change`` is {old: expression in coordinates that stay or are new}.

    Points and frames keep their parents, and elements their names. A generalized force on an old coordinate becomes one
    on each new coordinate that moves it, Ξ_η = Jᵀ Ξ_ξ. Raises `ModelError` if the change is not valid (see
    `read_change`).
    """
    return carried(model, change, name=name).model()


@bounded.answered("a change of coordinates", is_hard)
def carried(model: Model, change: Mapping[Any, Any] | Change, *, name: str | None = None) -> Builder:
    """Return the same as `changed`, as a builder that can still be extended."""
    found = change if isinstance(change, Change) else read_change(model, change)
    return Carrier(model, found, name or _title(model, found)).built()


def _title(model: Model, change: Change) -> str:
    words = ", ".join(f"{c.name} = {plain(e)}" for c, e in change.replaced)
    return f"{model.name} ({words})" if words and len(words) <= 60 else model.name


class Carrier:
    """Builds the new description piece by piece, in the order of the old one."""

    def __init__(self, model: Model, change: Change, name: str) -> None:
        self.model, self.change, self.builder = model, change, Builder(name)
        self._things: dict[int, Point | Frame] = {id(model.origin): self.builder.origin}
        self._held: dict[int, Floating] = {}
        self._bodies: dict[int, Element] = {}

    def built(self) -> Builder:
        """Return the builder with the complete description."""
        model, b = self.model, self.builder
        b.decimals |= model.decimals
        self.declare()
        for d in model.definitions:
            b.define(d.name, self.definition(d), place=d.place)
        for frame in model.frames:
            self.frame(frame)
        for point in model.points:
            self.point(point)
        for element in model.elements:
            for made in self.elements(element):
                b.add(made)
        self.settle()
        return b

    def declare(self) -> None:
        """Declare the coordinates, parameters and inputs of the new description."""
        model, b = self.model, self.builder
        floating = {c.name: f for f in model.floating if f.floating is not None for c in f.floating.coordinates}
        for c in self.change.new:
            if c.name in floating:
                self._quaternion(floating[c.name])
            else:
                b.coordinate(c.name, description=c.description, unit=c.unit, positive=c.positive, place=c.place)
        for p in self.parameters():
            b.parameter(p.name, p.value, unit=p.unit, description=p.description, place=p.place)
        for u in model.inputs:
            b.input(u.name, description=u.description, unit=u.unit, place=u.place)

    def parameters(self) -> Sequence[Parameter]:
        """The parameters of the new description."""
        return self.model.parameters

    def definition(self, definition: Definition) -> sp.Expr:
        """What a definition stands for in the new coordinates."""
        return self.change.put_in(definition.expression)

    def settle(self) -> None:
        """Carry over the settings of runs and the hints for the picture."""
        model, b = self.model, self.builder
        b.settings.update(carried_settings(model, self.change))
        if inputs := model.settings.get("inputs"):
            b.settings["inputs"] = carried_signals(model, self.change, inputs)
        b.look.update(carried_look(model, self.change, [e.name for e in b.elements]))

    def _quaternion(self, frame: Frame) -> None:
        """Declare a floating frame, or the variables of one in a ball joint, at the first of its coordinates."""
        assert frame.name is not None and frame.floating is not None
        if id(frame) in self._things or id(frame) in self._held:
            return
        if frame.floating.held:
            self._held[id(frame)] = self.builder.quaternion(frame.name, held=True, place=frame.place)
            return
        made = self.builder.floating_frame(frame.name, place=frame.place)
        self._things.update({id(frame): made, id(frame.origin): made.origin})

    def point(self, point: Point) -> Point:
        """The point in the new coordinates, with its parent."""
        made = self._things.get(id(point))
        if not isinstance(made, Point):
            assert point.parent is not None
            made = self.builder.point(
                point.name,
                tuple(map(self.change.put_in, point.offset)),
                parent=self.point(point.parent),
                frame=None if point.frame is None else self.frame(point.frame),
                place=point.place,
            )
            self._things[id(point)] = made
        return made

    def frame(self, frame: Frame) -> Frame:
        """The frame in the new coordinates, with its parent and origin."""
        made = self._things.get(id(frame))
        if not isinstance(made, Frame):
            parent = None if frame.parent is None else self.frame(frame.parent)
            origin, place = self.point(frame.origin), frame.place
            if (held := self._held.get(id(frame))) is not None:
                assert frame.name is not None
                made = self.builder.ball_frame(frame.name, parent=parent, origin=origin, declared=held, place=place)
            else:
                angle = self.change.put_in(frame.angle)
                made = self.builder.frame(frame.name, angle, axis=frame.axis, parent=parent, origin=origin, place=place)
            self._things[id(frame)] = made
        return made

    def elements(self, element: Element) -> Iterator[Element]:
        """The element in the new coordinates; a generalized force may become several."""
        if isinstance(element, GeneralizedForce):
            yield from self._generalized(element)
            return
        made = copy(element)
        made._set(**{f.name: self._value(getattr(element, f.name)) for f in fields(element)})
        yield made

    def _generalized(self, force: GeneralizedForce) -> Iterator[Element]:
        """Ξ_j = Ξ_i ∂ξ_i/∂η_j for every new coordinate that moves ξ_i."""
        old = [c.symbol for c in self.change.old]
        value = self.change.put_in(force.value)
        if force.coordinate not in old:  # a velocity of a floating frame
            yield force.named(force.name)
            return
        row = self.change.jacobian.row(old.index(force.coordinate))
        shares = [(c, slope) for c, slope in zip(self.change.new, row, strict=True) if slope != 0]
        for c, slope in shares:
            name = force.name if len(shares) == 1 else f"{force.name} on {c.name}"
            yield GeneralizedForce(coordinate=c.symbol, value=slope * value, name=name, place=force.place)

    def _named(self, element: Element) -> Element:
        """The body that a constraint names, in the new coordinates."""
        if id(element) not in self._bodies:
            (self._bodies[id(element)],) = self.elements(element)
        return self._bodies[id(element)]

    def _value(self, value: Any) -> Any:
        if isinstance(value, Point):
            return self.point(value)
        if isinstance(value, Frame):
            return self.frame(value)
        if isinstance(value, Element):
            return self._named(value)
        if isinstance(value, tuple):
            return tuple(map(self._value, value))
        return self.change.put_in(value) if isinstance(value, sp.Expr) else value
