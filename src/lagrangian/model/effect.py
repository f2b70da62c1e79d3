"""Elements that can do nothing: what they act on does not move with any coordinate.

A virtual displacement moves a point only where a coordinate stands in its offsets or in the angles of its frames; what
hangs on time alone moves, but not virtually, so that no force on it does virtual work.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.errors import ModelError
from lagrangian.model.elements import Damper, Element, Force, Spring, Torque
from lagrangian.model.geometry import Frame, Point
from lagrangian.model.model import Model


def check_effect(model: Model) -> None:
    """Refuse springs, dampers, forces and torques that act on nothing that a coordinate moves."""
    moving = _Moving(model)
    for element in model.elements:
        if not isinstance(element, (Spring, Damper, Force, Torque)) or _acts(moving, element):
            continue
        what, fix = _words(element)
        raise ModelError(what, element=element.title, place=element.place, fix=fix, code="E410")


def _acts(moving: _Moving, element: Spring | Damper | Force | Torque) -> bool:
    if isinstance(element, Torque):
        targets = [t for t in (element.on, element.reaction) if t is not None]
        return any(moving.frame(t) if isinstance(t, Frame) else moving.expr(t) for t in targets)
    if element.between:
        return moving.apart(*element.between)
    if isinstance(element, Force) and element.is_vector:
        return any(moving.point(p) for p in (element.at, element.reaction) if p is not None)
    return moving.expr(element.deflection)


def _words(element: Element) -> tuple[str, str]:
    if isinstance(element, Torque):
        return (
            "it does nothing: no coordinate turns what it acts on",
            "on=an angle that moves, such as theta1 + theta2, or on=the frame of a body",
        )
    if isinstance(element, Force) and element.is_vector:
        return (
            "it does nothing: no coordinate moves the point it acts at",
            "at=the point that the force moves; to hold a fixed point takes no force in these equations",
        )
    if getattr(element, "between", None):
        return (
            "it does nothing: no coordinate moves its two ends apart",
            "between=(P, Q) with at least one of them moved by a coordinate that does not carry the other along",
        )
    return (
        "it does nothing: no coordinate changes its deflection",
        "write the deflection with coordinates, such as x2 - x1",
    )


class _Moving:
    """What moves with a coordinate; points and frames are asked once, along their parents."""

    def __init__(self, model: Model) -> None:
        self._live: set[object] = {c.symbol for c in model.coordinates}
        for d in model.definitions:  # each after those that it uses
            if self.expr(d.expression):
                self._live.add(d.symbol)
        self._known: dict[int, bool] = {}

    def expr(self, expr: sp.Expr) -> bool:
        """Whether a coordinate stands in it."""
        return not self._live.isdisjoint(expr.atoms(AppliedUndef))

    def frame(self, frame: Frame | None) -> bool:
        """Whether a coordinate turns it."""
        if frame is None:
            return False
        if id(frame) not in self._known:
            chain = list(_parents(frame))
            for f in reversed(chain):
                above = self._known.get(id(f.parent), False) if f.parent is not None else False
                self._known[id(f)] = above or f.floating is not None or self.expr(f.angle)
        return self._known[id(frame)]

    def point(self, point: Point) -> bool:
        """Whether a coordinate moves it."""
        chain: list[Point] = []
        at: Point | None = point
        while at is not None and id(at) not in self._known:
            chain.append(at)
            at = at.parent
        for p in reversed(chain):
            above = self._known[id(p.parent)] if p.parent is not None else False
            self._known[id(p)] = above or self._step(p)
        return self._known[id(point)]

    def apart(self, start: Point, end: Point) -> bool:
        """Whether a coordinate stands in r_end − r_start, seen from the parent that both hang on."""
        above: dict[int, bool] = {}
        at, moved = start, False
        while True:
            above[id(at)] = moved
            if at.parent is None:
                break
            moved = moved or self._step(at)
            at = at.parent
        at, moved = end, False
        while id(at) not in above:
            moved = moved or self._step(at)
            assert at.parent is not None
            at = at.parent
        return moved or above[id(at)]

    def _step(self, point: Point) -> bool:
        """Whether a coordinate stands in the step from its parent."""
        return any(x != 0 for x in point.offset) and (
            self.frame(point.frame) or any(self.expr(x) for x in point.offset)
        )


def _parents(frame: Frame) -> Iterator[Frame]:
    at: Frame | None = frame
    while at is not None:
        yield at
        at = at.parent
