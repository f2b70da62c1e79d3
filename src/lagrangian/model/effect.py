"""Finds elements that have no effect because no coordinate moves what they act on.

A virtual displacement moves a point only if a coordinate occurs in its offsets or in the angles of its frames. A point
that depends only on time moves, but not virtually, so a force on it does no virtual work.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.errors import ModelError
from lagrangian.model.geometry import Frame, Point
from lagrangian.model.model import Model


def check_effect(model: Model) -> None:
    """Raise an error for elements that act on nothing that a coordinate moves."""
    moving = _Moving(model)
    for element in model.elements:
        acts_on = element.acts_on()
        if acts_on is not None and not any(moving.target(x) for x in acts_on.targets):
            raise ModelError(acts_on.idle, element=element.title, place=element.place, fix=acts_on.fix, code="E410")


class _Moving:
    """What coordinates move; the results for points and frames are cached along their parents."""

    def __init__(self, model: Model) -> None:
        self._live: set[object] = {c.symbol for c in model.coordinates}
        for d in model.definitions:  # each after those that it uses
            if self.expr(d.expression):
                self._live.add(d.symbol)
        self._known: dict[int, bool] = {}

    def target(self, target: Point | Frame | sp.Expr | tuple[Point, Point]) -> bool:
        """Whether a coordinate moves it or, for a pair, moves the two apart."""
        if isinstance(target, tuple):
            return self.apart(*target)
        if isinstance(target, Point):
            return self.point(target)
        return self.frame(target) if isinstance(target, Frame) else self.expr(target)

    def expr(self, expr: sp.Expr) -> bool:
        """Whether it contains a coordinate."""
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
        """Whether r_end − r_start, seen from their common parent, contains a coordinate."""
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
        """Whether the step from its parent contains a coordinate."""
        return any(x != 0 for x in point.offset) and (
            self.frame(point.frame) or any(self.expr(x) for x in point.offset)
        )


def _parents(frame: Frame) -> Iterator[Frame]:
    at: Frame | None = frame
    while at is not None:
        yield at
        at = at.parent
