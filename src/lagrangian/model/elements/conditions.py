"""The conditions of constraints, one scalar row each: f(q, t) = 0 on positions, or c(q, q̇, t) = 0 on velocities.

A constraint consists of conditions about points and frames. Each has two forms: expressions that a derivation shows,
here, and nodes that a machine computes, in `dynamics.constraints`. The sign is the same everywhere,

    M v̇ + h = Ξ + Aᵀ λ,        A v̇ + γ = 0,

so a positive λ acts in the direction that increases f (or c).
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import sympy as sp

from lagrangian import bounded
from lagrangian.model.elements.answers import ENERGY, FORCE, Unit
from lagrangian.model.elements.base import Condition, Surroundings, Words, difference
from lagrangian.model.geometry import Frame, Point, entries, turned
from lagrangian.records import dataclass

LETTERS = "xyz"


def axes_words(model: Surroundings, axis: int, frame: Frame | None) -> Words:
    """A coordinate axis in words: of the fixed axes, or of a frame."""
    return (LETTERS[axis],) if frame is None else (f"{LETTERS[axis]} of ", *model.frame_words(frame))


def _fixed(frame: Frame | None, components: Sequence[sp.Expr]) -> tuple[sp.Expr, ...]:
    """The components along the fixed axes of a vector that is given in a frame."""
    return tuple(components) if frame is None else turned(frame.rotation, components)


def _dot(a: Sequence[sp.Expr], b: Sequence[sp.Expr]) -> sp.Expr:
    return sp.Add(*(x * y for x, y in zip(a, b, strict=True)))


@dataclass(frozen=True, kw_only=True)
class Coincidence(Condition):
    """Component ``axis`` of r_start − r_end is zero, in the axes of ``frame`` (None: the fixed axes)."""

    start: Point
    end: Point
    axis: int
    frame: Frame | None = None
    unit: Unit | None = FORCE

    def position(self, model: Surroundings) -> sp.Expr:
        """f = e_axis · (r_start − r_end)."""
        gap = difference(model, self.end, self.start)
        if self.frame is None:
            return gap[self.axis]
        columns = entries(self.frame.rotation)
        return model.expand(_dot(columns[self.axis :: len(gap)], gap))

    def multiplier(self, model: Surroundings) -> Words:
        """The force on the first point's body."""
        along = axes_words(model, self.axis, self.frame)
        return ("the force along ", *along, " on ", *model.point_words(self.start), _opposite(model, self.end))


def _opposite(model: Surroundings, point: Point) -> str:
    words = "".join(map(str, model.point_words(point)))
    return "" if words == "the ground" else f"; its opposite acts on {words}"


@dataclass(frozen=True, kw_only=True)
class Separation(Condition):
    """The length of the path over ``points``, Σ |r_{k+1} − r_k|, is ``length``."""

    points: tuple[Point, ...]
    length: sp.Expr
    unit: Unit | None = FORCE

    def position(self, model: Surroundings) -> sp.Expr:
        """f = Σ |r_{k+1} − r_k| − length."""
        total = -model.expand(self.length)
        for start, end in pairwise(self.points):
            total += sp.sqrt(sp.Add(*(x**2 for x in difference(model, start, end))))
        return total

    def multiplier(self, model: Surroundings) -> Words:
        """The force that pushes the ends apart; the tension is −λ."""
        start, end = self.points[0], self.points[-1]
        ends = ("between ", *model.point_words(start), " and ", *model.point_words(end))
        return ("the force that pushes apart, ", *ends, "; the tension is its negative")


MOST_REPEATED = 12
"""The number of operations up to which the words on a multiplier repeat the expression of its row."""


@dataclass(frozen=True, kw_only=True)
class Stated(Condition):
    """An expression that is zero: ``value`` of positions, or with ``velocity`` one that is linear in the rates."""

    value: sp.Expr
    velocity: bool = False

    @property
    def on_positions(self) -> bool:
        """Whether it was given as a position."""
        return not self.velocity

    def position(self, model: Surroundings) -> sp.Expr | None:
        """f as given."""
        return None if self.velocity else model.expand(self.value)

    def rate(self, model: Surroundings) -> sp.Expr:
        """c as given, or ḟ."""
        return model.expand(self.value) if self.velocity else super().rate(model)

    def multiplier(self, model: Surroundings) -> Words:
        """The generalized force per unit of the expression; a long one is not repeated."""
        value = model.expand(self.value)
        long = bounded.operations(value) > MOST_REPEATED
        return ("the generalized force per unit of ", "what this row keeps at zero" if long else value)


@dataclass(frozen=True, kw_only=True)
class Unmoved(Stated):
    """A deflection that does not change: that of two points, or one that is given by an expression."""

    between: tuple[Point, Point] | None = None


@dataclass(frozen=True, kw_only=True)
class SameTurn(Condition):
    """In the plane: ``first`` is turned by ``angle`` from ``second`` (None: from the fixed axes)."""

    first: Frame
    second: Frame | None
    angle: sp.Expr
    unit: Unit | None = ENERGY

    def position(self, model: Surroundings) -> sp.Expr:
        """f = φ_first − φ_second − angle."""
        other = self.second.total_angle if self.second is not None else sp.S.Zero
        return model.expand(self.first.total_angle - other - self.angle)

    def multiplier(self, model: Surroundings) -> Words:
        """The torque on the first."""
        return ("the torque on ", *model.frame_words(self.first))


@dataclass(frozen=True, kw_only=True)
class Perpendicular(Condition):
    """A direction fixed in ``first`` stays perpendicular to one fixed in ``second`` (None: to a fixed one)."""

    first: Frame
    along: tuple[sp.Expr, ...]
    second: Frame | None
    other: tuple[sp.Expr, ...]
    unit: Unit | None = ENERGY

    def position(self, model: Surroundings) -> sp.Expr:
        """f = a · b."""
        return model.expand(_dot(_fixed(self.first, self.along), _fixed(self.second, self.other)))

    def multiplier(self, model: Surroundings) -> Words:
        """A torque about the common perpendicular."""
        return ("the torque on ", *model.frame_words(self.first), " about the perpendicular of the two directions")


@dataclass(frozen=True, kw_only=True)
class OnLine(Condition):
    """``start`` is on the line, or plane, through ``end`` to which ``normal``, fixed in ``frame``, is perpendicular."""

    start: Point
    end: Point
    normal: tuple[sp.Expr, ...]
    frame: Frame | None
    unit: Unit | None = FORCE

    def position(self, model: Surroundings) -> sp.Expr:
        """f = n · (r_start − r_end)."""
        gap = difference(model, self.end, self.start)
        return model.expand(_dot(_fixed(self.frame, self.normal), gap))

    def multiplier(self, model: Surroundings) -> Words:
        """The force across the line on the first point's body."""
        return ("the force across the line on ", *model.point_words(self.start), _opposite(model, self.end))


@dataclass(frozen=True, kw_only=True)
class NoSlip(Condition):
    """A body's material at ``at`` has no velocity along ``along``, given in the axes of ``axes`` (None: fixed axes).

    ``centre`` and ``frame`` are the body's; the material at r moves with v_centre + ω × (r − r_centre).
    """

    at: Point
    centre: Point
    frame: Frame
    along: tuple[sp.Expr, ...]
    axes: Frame | None
    unit: Unit | None = FORCE

    @property
    def on_positions(self) -> bool:
        """Always False: it is a condition on velocities."""
        return False

    def position(self, model: Surroundings) -> None:
        """None: it is a condition on velocities."""

    def rate(self, model: Surroundings) -> sp.Expr:
        """c = e · (v_centre + ω × (r_at − r_centre))."""
        r = difference(model, self.centre, self.at)
        omega = tuple(model.expand(x) for x in self.frame.angular_velocity)
        if self.frame.dimension == 2:
            carried = (-omega[0] * r[1], omega[0] * r[0])
        else:
            w = _fixed(self.frame, omega)
            carried = tuple(w[i - 2] * r[i - 1] - w[i - 1] * r[i - 2] for i in range(3))
        velocity = tuple(a + b for a, b in zip(model.velocity(self.centre), carried, strict=True))
        return model.expand(_dot(_fixed(self.axes, self.along), velocity))

    def multiplier(self, model: Surroundings) -> Words:
        """The force on the body along the direction."""
        on = model.frame_words(self.frame)
        return ("the force on ", *on, " ", *self._direction(model), ", the direction in which it does not slip")

    def _direction(self, model: Surroundings) -> Words:
        """The direction in words: along an axis, or its components, and whose axes they are."""
        held = [(letter, x) for letter, x in zip("xyz", self.along, strict=False) if x != 0]
        if len(held) == 1 and held[0][1] in (1, -1):
            words: Words = (f"along {'' if held[0][1] == 1 else '−'}{held[0][0]}",)
        else:
            parts = [p for x in self.along for p in (x, ", ")][:-1]
            words = ("along (", *parts, ")")
        return words if self.axes is None else (*words, " of ", *model.frame_words(self.axes))
