"""Finds what carries a body: a rod or a pin from a point, a straight track, or something on which it rolls."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Form
from lagrangian.derive.context import Context
from lagrangian.derive.reasons.fixed import FixedPoints
from lagrangian.derive.reasons.holding import Holding
from lagrangian.derive.reasons.motion import Column, Moving, dot
from lagrangian.model import Body, Point, Words
from lagrangian.model.elements.base import difference
from lagrangian.records import dataclass

LONGEST_LENGTH = 40
"""The operations of a squared length of which a root is taken."""


@dataclass(frozen=True, eq=False)
class Finder:
    """Finds the one thing that carries a body, if there is one."""

    places: FixedPoints
    moving: tuple[Moving, ...]

    @property
    def context(self) -> Context:
        """The algebra of the derivation."""
        return self.places.context

    def of(self, body: Body) -> Holding | None:
        """What carries a body; None if the geometry shows no rod, pin, track or rolling."""
        own = [m for m in self.moving if m.body is body]
        turning = next((m for m in own if m.turning), None)
        turns = turning is not None and any(x.parts for column in turning.columns for x in column)
        before = self._before(body)
        if turns and self._rolls(body, None):
            return Holding(body, "rolling")
        for point in self._pivots(body, before, turns):
            if (hold := self._at(body, point, before, turns)) is not None:
                return hold
        normal = self._normal(own[0])
        if normal is not None:
            return Holding(body, "track", along=normal)
        carrier = next((b for b in before if turns and self._rolls(body, b)), None)
        if carrier is not None:
            return Holding(body, "rolling", (carrier.title,), carrier)
        carried = ((b, self._slides(body, b)) for b in before)
        return next((Holding(body, "track", (b.title,), b, n) for b, n in carried if n is not None), None)

    def _pivots(self, body: Body, before: Sequence[Body], turns: bool) -> Iterator[Point]:
        """The points from which a body may be held: those from which its place is described, then of other bodies."""
        yield from body.at.with_parents()
        yield from (b.at for b in before if not turns)

    def _at(self, body: Body, point: Point, before: Sequence[Body], turns: bool) -> Holding | None:
        """A pin at a point of another body or of the ground, or a rod from there; None if it is neither."""
        if point is body.at and not turns:
            return None
        fixed = [b for b in before if self.places.fixed_in(point, b)]
        still = self.places.still(point)
        hinged = next((b for b in fixed if turns and b.axes is not None and _within(body, b)), None)
        carrier = hinged or (None if still else next(iter(fixed), None))
        if carrier is None and not still:
            return None
        words: Words = (carrier.title,) if carrier is not None else self._ground(point)
        if turns:
            return Holding(body, "pin", words, carrier, at=point) if self.places.fixed_in(point, body) else None
        rod = self._rod(body, point)
        return None if rod is None else Holding(body, "rod", words, carrier, rod, at=point)

    def _before(self, body: Body) -> list[Body]:
        """The other bodies that are described before this one: of two that a pin joins, one carries the other."""
        bodies = self.context.model.bodies
        depth = {b: (sum(1 for _ in b.at.with_parents()), k) for k, b in enumerate(bodies)}
        return [b for b in bodies if depth[b] < depth[body]]

    def _ground(self, point: Point) -> Words:
        model = self.context.model
        moves = any(self.context.form(v).parts for v in model.velocity(point))
        return ("a support that moves as prescribed",) if moves else ("the ground",)

    def _rod(self, body: Body, point: Point) -> Column | None:
        """The unit vector from a point to a body at a constant distance; None if the distance changes."""
        context = self.context
        arm = [context.form(x) for x in difference(context.model, point, body.at)]
        if not any(x.moves for x in arm):
            return None
        square = dot(context, arm, arm)
        if square.moves or square.is_zero:
            return None
        length = _root(square.expr())
        return () if length is None else tuple(context.form(1 / length) * x for x in arm)

    def _arm(self, body: Body, carrier: Body | None) -> list[Form]:
        """The place of a body, or where it is in the axes of another."""
        model = self.context.model
        if carrier is None:
            return [self.context.form(model.expand(x)) for x in model.position(body.at)]
        arm = self.places.along_axes(carrier, difference(model, carrier.at, body.at))
        return [self.context.form(x) for x in arm]

    def _turn(self, body: Body | None) -> list[Form]:
        """In the plane: how fast a body turns, by the rate of every coordinate."""
        turning = next((m for m in self.moving if m.body is body and m.turning), None)
        zero = self.context.algebra.total([])
        return [c[0] for c in turning.columns] if turning else [zero for _ in self.context.model.coordinates]

    def _rolls(self, body: Body, carrier: Body | None) -> bool:
        """Whether a point at a constant vector c from the centre, in the plane, never moves relative to what carries
        the body: v + ω × c = 0, with v, ω and c in the axes of that."""
        context = self.context
        if context.model.dimension != 2 or (carrier is not None and carrier.axes is None):
            return False
        turns = [a - b for a, b in zip(self._turn(body), self._turn(carrier), strict=True)]
        arm = self._arm(body, carrier)
        columns = [[x.diff(c.symbol) for x in arm] for c in context.model.coordinates]
        j = next((j for j, w in enumerate(turns) if w.parts), None)
        if j is None or turns[j].moves:
            return False
        spin = context.form(1 / turns[j].expr())
        c = (-columns[j][1] * spin, columns[j][0] * spin)
        if any(x.moves for x in c) or all(x.is_zero for x in c):
            return False
        return all((x - w * c[1]).is_zero and (y + w * c[0]).is_zero for (x, y), w in zip(columns, turns, strict=True))

    def _slides(self, body: Body, carrier: Body) -> Column | None:
        """The normal of the straight line along which a body moves in the axes of another; None if it does not."""
        context = self.context
        arm = self._arm(body, carrier)
        u = self._straight([[x.diff(c.symbol) for x in arm] for c in context.model.coordinates])
        if u is None:
            return None
        normal = self._across(u)
        if not normal or carrier.axes is None:
            return normal
        fixed = carrier.axes.in_fixed_axes([x.expr() for x in normal])
        return tuple(context.form(context.model.expand(x)) for x in fixed)

    def _normal(self, m: Moving) -> Column | None:
        """The normal of the straight line, in a direction that does not turn, along which a body moves; None if its
        path is no such line."""
        u = self._straight(m.columns)
        return None if u is None else self._across(u)

    def _across(self, u: Sequence[Form]) -> Column:
        """The unit vector across a direction of the plane; empty in space, where a line has no single normal."""
        context = self.context
        length = _root(dot(context, u, u).expr()) if len(u) == 2 else None
        if length is None:
            return ()
        inverse = context.form(1 / length)
        n = (-u[1] * inverse, u[0] * inverse)
        return tuple(-x for x in n) if _downward(n) else n

    def _straight(self, columns: Sequence[Sequence[Form]]) -> Sequence[Form] | None:
        """The direction, which never turns, that all columns have in common; None if there is none."""
        columns = [c for c in columns if any(x.parts for x in c)]
        if not columns or any(x.moves for x in columns[0]):
            return None
        u = columns[0]
        pairs = [(a, b) for a in range(len(u)) for b in range(a)]
        together = all((c[a] * u[b] - c[b] * u[a]).is_zero for c in columns[1:] for a, b in pairs)
        return u if together else None


def _within(body: Body, carrier: Body) -> bool:
    """In space: whether the frame of a body turns in that of another, which then holds its hinge."""
    frame = body.axes
    if frame is None or frame.dimension == 2:
        return False
    while (frame := frame.parent) is not None:
        if frame is carrier.axes:
            return True
    return False


def _root(square: sp.Expr) -> sp.Expr | None:
    """The length whose square is given, made of parameters that count as positive; None if it is long."""
    if bounded.operations(square) > LONGEST_LENGTH:
        return None
    return cast("sp.Expr", sp.powdenest(sp.sqrt(sp.factor(square)), force=True))


def _downward(n: Column) -> bool:
    """Whether a normal points down at small angles, where a plus sign is expected to push upward."""
    value: Any = n[1].expr()
    return bool(value.xreplace(dict.fromkeys(value.free_symbols, sp.Rational(1, 10))).evalf() < 0)
