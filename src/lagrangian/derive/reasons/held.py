"""What holds every body, found in the geometry: a rod, a pin, a track, a surface on which it rolls.

The names say no more than the geometry does: what stays at a constant distance from a point is held by a rod, a string
or a round track, and which of these it is makes no difference to the equations.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Literal, TypeAlias, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Form
from lagrangian.derive.context import Context
from lagrangian.derive.reasons.fixed import FixedPoints
from lagrangian.derive.reasons.laws import reaction
from lagrangian.derive.reasons.loads import AppliedLoads
from lagrangian.derive.reasons.motion import Column, Moving, dot
from lagrangian.model import Body, Point, Torque, Words
from lagrangian.model.elements.base import difference
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

HoldKind: TypeAlias = Literal["rod", "pin", "track", "rolling", "other"]

LONGEST_LENGTH = 40
"""The operations of a squared length of which a root is taken."""

MOST_BODIES = 12
"""With more bodies, what holds each is not looked for: pairs of them are compared."""


@dataclass(frozen=True, eq=False)
class Holding(Brief):
    """What holds a body: its kind, and in words the thing at the other end.

    ``carrier`` is the body that holds it, None for the ground or a support. ``along`` is the unit vector of a rod from
    there to the body, or the normal of a track in the plane, else empty. ``force`` is the pull of the rod, or the push
    of the track along that normal, None where it cannot be told from other forces.
    """

    body: Body
    kind: HoldKind
    on: Words
    carrier: Body | None = None
    along: Column = ()
    force: Form | None = None


def holds(context: Context, moving: tuple[Moving, ...], applied: AppliedLoads) -> tuple[Holding, ...]:
    """What holds every body, in the order of the bodies."""
    bodies = context.model.bodies
    if len(bodies) > MOST_BODIES:
        return tuple(Holding(b, "other", ()) for b in bodies)
    places = FixedPoints(context, moving)
    finder = _Finder(places, moving)
    found = [finder.of(body) for body in bodies]
    if context.model.constraints:
        return tuple(found)
    carried = _carried(found)
    alone = all(h.kind in ("rod", "track") and h.carrier is None for h in found)
    return tuple(_with_force(context, moving, applied, hold, carried[hold.body], alone) for hold in found)


def _carried(found: list[Holding]) -> dict[Body, tuple[Body, ...]]:
    """For every body, itself and all bodies that hang on it."""
    made: dict[Body, tuple[Body, ...]] = {}
    for hold in found:
        mine = [hold.body]
        for body in mine:
            mine += [h.body for h in found if h.carrier is body and h.body not in mine]
        made[hold.body] = tuple(mine)
    return made


def _with_force(
    context: Context,
    moving: tuple[Moving, ...],
    applied: AppliedLoads,
    hold: Holding,
    carried: tuple[Body, ...],
    alone: bool,
) -> Holding:
    """Add the pull of a rod, the part along it of what holds all that hang on it; or the push of a track on a body that
    touches no other."""
    simple = all(isinstance(x.element, Torque) for x in applied.passed)
    if not hold.along or (len(carried) > 1 and (not simple or hold.kind != "rod")):
        return hold
    if hold.kind == "track" and not alone:
        return hold
    whole = [reaction(context, applied, m) for m in moving if m.body in carried and not m.turning]
    along = context.algebra.total([dot(context, R, hold.along) for R in whole])
    force = -along if hold.kind == "rod" else along
    return replace(hold, force=force)


@dataclass(frozen=True, eq=False)
class _Finder:
    places: FixedPoints
    moving: tuple[Moving, ...]

    @property
    def context(self) -> Context:
        return self.places.context

    def of(self, body: Body) -> Holding:
        own = [m for m in self.moving if m.body is body]
        turning = next((m for m in own if m.turning), None)
        if turning is not None and self._rolls(own[0], turning):
            return Holding(body, "rolling", ())
        for point in body.at.with_parents():
            if (hold := self._at(body, point, turning is not None)) is not None:
                return hold
        normal = self._normal(own[0])
        if normal is not None:
            return Holding(body, "track", (), None, normal)
        carrier = next((b for b in self._before(body) if self._slides(body, b)), None)
        return Holding(body, "other", ()) if carrier is None else Holding(body, "track", (carrier.title,), carrier)

    def _slides(self, body: Body, carrier: Body) -> bool:
        """Whether a body moves along a straight line in the axes of another."""
        arm = self.places.along_axes(carrier, difference(self.context.model, carrier.at, body.at))
        forms = [self.context.form(x) for x in arm]
        columns = [[x.diff(c.symbol) for x in forms] for c in self.context.model.coordinates]
        return self._straight(columns) is not None

    def _at(self, body: Body, point: Point, turns: bool) -> Holding | None:
        """A pin at a point of another body or of the ground, or a rod from there; None if it is neither."""
        if point is body.at and not turns:
            return None
        still = self.places.still(point)
        carrier = None if still else next((b for b in self._before(body) if self.places.fixed_in(point, b)), None)
        if carrier is None and not still:
            return None
        words: Words = (carrier.title,) if carrier is not None else self._ground(point)
        if turns:
            return Holding(body, "pin", words, carrier) if self.places.fixed_in(point, body) else None
        rod = self._rod(body, point)
        return None if rod is None else Holding(body, "rod", words, carrier, rod)

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

    def _rolls(self, place: Moving, turn: Moving) -> bool:
        """Whether a point at a constant vector c from the centre is always at rest: v + ω × c = 0, in the plane."""
        context = self.context
        if len(turn.velocity) != 1 or not any(v.parts for v in place.velocity):
            return False
        j = next((j for j, (w,) in enumerate(turn.columns) if w.parts), None)
        if j is None or turn.columns[j][0].moves:
            return False
        spin, (vx, vy) = 1 / turn.columns[j][0].expr(), place.columns[j]
        c = (-vy * context.form(spin), vx * context.form(spin))
        if any(x.moves for x in c):
            return False
        return all(
            (x - w * c[1]).is_zero and (y + w * c[0]).is_zero
            for (x, y), (w,) in zip(place.columns, turn.columns, strict=True)
        )

    def _normal(self, m: Moving) -> Column | None:
        """The normal of the straight line, in a direction that does not turn, along which a body moves in the plane.

        It is empty in space, where a line has no single normal, and None if the path is no such line.
        """
        context = self.context
        u = self._straight(m.columns)
        if u is None:
            return None
        if len(u) != 2:
            return ()
        length = _root(dot(context, u, u).expr())
        if length is None:
            return ()
        inverse = context.form(1 / length)
        n = (-u[1] * inverse, u[0] * inverse)
        return tuple(-x for x in n) if _downward(context, n) else n

    def _straight(self, columns: Sequence[Sequence[Form]]) -> Sequence[Form] | None:
        """The direction, which never turns, that all columns have in common; None if there is none."""
        columns = [c for c in columns if any(x.parts for x in c)]
        if not columns or any(x.moves for x in columns[0]):
            return None
        u = columns[0]
        pairs = [(a, b) for a in range(len(u)) for b in range(a)]
        together = all((c[a] * u[b] - c[b] * u[a]).is_zero for c in columns[1:] for a, b in pairs)
        return u if together else None


def _root(square: sp.Expr) -> sp.Expr | None:
    """The length whose square is given, made of parameters that count as positive; None if it is long."""
    if bounded.operations(square) > LONGEST_LENGTH:
        return None
    return cast("sp.Expr", sp.powdenest(sp.sqrt(sp.factor(square)), force=True))


def _downward(context: Context, n: Column) -> bool:
    """Whether a normal points down at small angles, where a plus sign is expected to push upward."""
    value: Any = n[1].expr()
    return bool(value.xreplace(dict.fromkeys(value.free_symbols, sp.Rational(1, 10))).evalf() < 0)
