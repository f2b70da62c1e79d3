"""Points relative to points, frames relative to frames.

A point and a frame store their parents, so that common parts of positions are stored only once:

    r_P = r_parent + R_frame · offset,      R_frame = R_parent · R(axis, angle)

In the plane R(angle) = [[cos, −sin], [sin, cos]], counter-clockwise positive. In space the axis is given in the
parent's axes and R is Rodrigues' rotation  R = 1 + sin φ [n]× + (1 − cos φ) [n]×².
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import count
from math import isfinite
from numbers import Rational, Real
from typing import TYPE_CHECKING, Any, TypeGuard, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.errors import ModelError, Place
from lagrangian.model.decimals import noted, noting
from lagrangian.model.floating import Floating
from lagrangian.model.names import time
from lagrangian.quantities.largest import LARGEST, SMALLER, too_large
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief

if TYPE_CHECKING:
    from typing import TypeAlias

Scalar: TypeAlias = "sp.Expr | int | float"
_serial = count(1)
NOT_REAL: tuple[sp.Expr, ...] = (sp.sqrt(-1), sp.nan, sp.oo, sp.zoo, -sp.oo)
_LARGEST = int(LARGEST)
MAX_BITS = 1100  # of a numerator or denominator: 5e-324, the least double, has 1077


def as_expr(value: object, what: str, *, place: Place | None = None) -> sp.Expr:
    """Return a SymPy expression for a number or an expression; text raises an error and is never parsed here.

    Decimal numbers become exact rationals (0.1 → 1/10), because equations are displayed and compared exactly.
    """
    from lagrangian.graph import unknown_part  # here, so that importing the package does not wait for the graph

    if isinstance(value, sp.Expr):
        expr = value
    elif isinstance(value, bool) or not isinstance(value, Real):
        kind = type(value).__name__
        raise ModelError(
            f"{what} must be a number or a SymPy expression (got {kind})",
            place=place,
            fix="write symbols as SymPy expressions; text belongs in a model file",
            code="E406",
        )
    elif not isinstance(value, Rational) and not isfinite(value):
        raise ModelError(f"{what} must be a finite number (got {value})", place=place, code="E101")
    else:
        expr = noted(sp.Rational(str(value)))
    if expr.has(*NOT_REAL):
        raise ModelError(f"{what} must be real and finite (got {expr})", place=place, code="E101")
    if any(max(abs(r.p), r.q).bit_length() > MAX_BITS for r in expr.atoms(sp.Rational)):
        raise ModelError(
            f"{what} contains a number larger than the largest floating-point number, 1.8e308", place=place, code="E101"
        )
    if large := next((r for r in expr.atoms(sp.Rational) if abs(r.p) > _LARGEST * r.q), None):
        raise ModelError(f"{what} holds a number that {too_large(float(large))}", place=place, fix=SMALLER, code="E101")
    if (part := unknown_part(expr)) is not None:
        raise ModelError(
            f"{what} contains {str(part)[:60]}, which is not supported ({type(part).__name__})",
            place=place,
            fix="write it with sin, cos, exp, log, sqrt, Abs, Piecewise and the like",
            code="E402",
        )
    if not expr.is_commutative:
        raise ModelError(f"{what} must be a scalar (got {expr})", place=place, code="E406")
    if expr.has(sp.Float):
        expr = cast("sp.Expr", expr.xreplace({f: noted(sp.Rational(str(f))) for f in expr.atoms(sp.Float)}))
    return expr


def is_listed(value: object) -> TypeGuard[Sequence[object]]:
    """Whether it is a tuple, a list or a matrix, rather than a single value."""
    return isinstance(value, (tuple, list, sp.MatrixBase))


def turned(matrix: sp.MatrixBase, components: Sequence[sp.Expr]) -> tuple[sp.Expr, ...]:
    """The components of a vector after a rotation: matrix · components."""
    size, flat = len(components), entries(matrix)
    rows = (flat[k : k + size] for k in range(0, len(flat), size))
    return tuple(sp.Add(*(a * b for a, b in zip(row, components, strict=True))) for row in rows)


def entries(matrix: sp.MatrixBase) -> tuple[sp.Expr, ...]:
    """The entries of a matrix, row by row."""
    return tuple(cast("list[sp.Expr]", matrix.flat()))


def as_vector(values: object, what: str, *, place: Place | None = None) -> tuple[sp.Expr, ...]:
    """Return a tuple of two or three expressions."""
    if isinstance(values, sp.MatrixBase):
        values = entries(values)
    if isinstance(values, str) or not isinstance(values, Sequence):
        fix = "such as (x, y) with SymPy expressions"
        if isinstance(values, Point):
            fix = (
                'point("A", (x, y), relative_to=P) counts from P; frame.point(x, y, name="A") names a point of a frame'
            )
        raise ModelError(
            f"{what} must be a pair or a triple (got {type(values).__name__})", place=place, fix=fix, code="E414"
        )
    components = cast("Sequence[object]", values)
    if len(components) not in (2, 3):
        raise ModelError(
            f"{what} has {len(components)} component{'s' if len(components) != 1 else ''}",
            place=place,
            fix="give two in the plane, three in space",
            code="E414",
        )
    return tuple(as_expr(v, f"component {i} of {what}", place=place) for i, v in enumerate(components, 1))


def as_axis(axis: object, what: str, *, place: Place | None = None) -> tuple[sp.Expr, ...]:
    """Return the direction of an axis of rotation in space, with length 1; it must not move."""
    vector = as_vector(axis, f"the axis of {what}", place=place)
    if len(vector) != 3:
        raise ModelError(f"the axis of {what} needs three components", place=place, code="E414")
    if any(v.has(AppliedUndef, time) for v in vector):
        raise ModelError(
            f"the axis of {what} moves",
            place=place,
            fix="an axis is fixed in its parent; turn the parent instead",
            code="E409",
        )
    norm2 = bounded.expand(sp.Add(*(v**2 for v in vector)))
    if norm2 == 0:
        raise ModelError(f"the axis of {what} is (0, 0, 0)", place=place, fix="axis=(0, 0, 1)", code="E409")
    norm = sp.S.One if bounded.is_one(norm2) else sp.sqrt(norm2)
    return tuple(v / norm for v in vector)


@dataclass(frozen=True, eq=False)
class Point(Brief):
    """A point, given by an offset from its parent along the axes of a frame (the fixed axes if ``frame`` is None).

    ``point + (x, y)`` is a new point. The origin has no parent. ``serial`` orders points by creation.
    """

    name: str | None
    parent: Point | None
    offset: tuple[sp.Expr, ...]
    frame: Frame | None = None
    owner: object = field(default=None, repr=False)
    place: Place | None = field(default=None, repr=False)
    serial: int = field(default_factory=lambda: next(_serial), repr=False)

    @property
    def is_origin(self) -> bool:
        """Whether this is the fixed origin."""
        return self.parent is None

    def __add__(self, offset: object) -> Point:
        """Return the point at ``offset`` (two or three components along the fixed axes) from this one."""
        if isinstance(offset, Point):
            raise ModelError(
                "two points cannot be added",
                fix="write point + (x, y): a point is given by its offset from another",
                code="E414",
            )
        with noting(cast("Any", self.owner).decimals):
            components = as_vector(offset, "the offset of a point")
        mine = self.dimension
        if mine is not None and mine != len(components):
            raise ModelError(
                f"an offset with {len(components)} components was added to a point with {mine}",
                fix=f"give {mine} components, as for the other points",
                code="E414",
            )
        return Point(None, self, components, None, self.owner)

    def with_parents(self) -> Iterator[Point]:
        """The point itself, its parent, and so on up to the origin."""
        at: Point | None = self
        while at is not None:
            yield at
            at = at.parent

    @property
    def dimension(self) -> int | None:
        """2 in the plane, 3 in space, None for an origin to which nothing was added."""
        return len(self.offset) or None

    @cached_property
    def position(self) -> tuple[sp.Expr, ...]:
        """The components of the position in the fixed axes, measured from the origin (empty for the origin itself)."""
        if self.parent is None:
            return ()
        step: Sequence[sp.Expr] = self.offset
        if self.frame is not None:
            step = self.frame.in_fixed_axes(self.offset)
        before = self.parent.position or (sp.S.Zero,) * len(self.offset)
        return tuple(a + b for a, b in zip(before, step, strict=True))


@dataclass(frozen=True, eq=False)
class Frame(Brief):
    """Axes turned by ``angle`` from the parent's axes, about ``axis`` (given in the parent's axes; None in the plane).

    ``origin`` is the point from which ``frame.point`` measures; by default it is that of the parent. A floating frame
    has no angle or axis but ``floating``, and its origin moves with it; so has one that turns in a ball joint, whose
    origin is a point that the parent carries.
    """

    name: str | None
    parent: Frame | None
    axis: tuple[sp.Expr, ...] | None
    angle: sp.Expr
    origin: Point
    owner: object = field(default=None, repr=False)
    place: Place | None = field(default=None, repr=False)
    serial: int = field(default_factory=lambda: next(_serial), repr=False)
    floating: Floating | None = None

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return 2 if self.axis is None and self.floating is None else 3

    def point(self, *offset: object, at: Point | None = None, name: str | None = None) -> Point:
        """Return the point at ``offset`` along this frame's axes, from its origin or from ``at``.

        With a ``name`` it is one of the system's named points, which appear in files, runs and results.
        """
        listed = offset[0] if len(offset) == 1 and is_listed(offset[0]) else offset
        with noting(cast("Any", self.owner).decimals):
            components = as_vector(listed, "the offset of a point")
        if len(components) != self.dimension:
            raise ModelError(
                f"a point with {len(components)} components was given in a frame with {self.dimension}",
                fix=f"give {self.dimension} components",
                code="E414",
            )
        if name is not None:
            return cast("Any", self.owner).point(name, components, parent=at, frame=self)
        return Point(None, at if at is not None else self.origin, components, self, self.owner)

    @cached_property
    def local_rotation(self) -> sp.ImmutableMatrix:
        """R(axis, angle), or R of the quaternion, from this frame's axes to its parent's."""
        if self.floating is not None:
            return self.floating.rotation
        c, s = sp.cos(self.angle), sp.sin(self.angle)
        if self.axis is None:
            return sp.ImmutableMatrix([[c, -s], [s, c]])
        x, y, z = self.axis
        cross = ((0, -z, y), (z, 0, -x), (-y, x, 0))
        # R = 1 + sin φ [n]× + (1 − cos φ) [n]×², with [n]×² = n nᵀ − 1 for a unit axis
        rows = [
            [c * (int(i == j) - a * b) + a * b + s * cross[i][j] for j, b in enumerate(self.axis)]
            for i, a in enumerate(self.axis)
        ]
        return sp.ImmutableMatrix(rows)

    @cached_property
    def rotation(self) -> sp.ImmutableMatrix:
        """The rotation from this frame's axes to the fixed axes."""
        if self.parent is None:
            return self.local_rotation
        if self.dimension == 2:  # rotations in the plane add their angles
            c, s = sp.cos(self.total_angle), sp.sin(self.total_angle)
            return sp.ImmutableMatrix([[c, -s], [s, c]])
        return sp.ImmutableMatrix(self.parent.rotation * self.local_rotation)

    def in_fixed_axes(self, components: Sequence[sp.Expr]) -> tuple[sp.Expr, ...]:
        """The components in the fixed axes of a vector given in this frame's axes."""
        return turned(self.rotation, components)

    @cached_property
    def total_angle(self) -> sp.Expr:
        """In the plane: the angle from the fixed axes, the sum over the parents."""
        if self.dimension == 3:
            raise ModelError("a frame in space has no single angle from the fixed axes", code="E414")
        return self.angle + (self.parent.total_angle if self.parent is not None else 0)

    @cached_property
    def angular_velocity(self) -> tuple[sp.Expr, ...]:
        """The angular velocity: ``(ω,)`` in the plane; in space three components in this frame's own axes.

        ω = Rᵀ ω_parent + n φ̇   (the axis n is the same in the frame's and in its parent's axes); with a quaternion,
        the frame's own quasi-velocities take the place of n φ̇.
        """
        if self.floating is not None:
            own = self.floating.angular_velocity
        else:
            rate = bounded.diff(self.angle, time)
            if self.axis is None:
                return (bounded.diff(self.total_angle, time),)
            own = tuple(n * rate for n in self.axis)
        if self.parent is None:
            return own
        before = turned(cast("sp.MatrixBase", self.local_rotation.T), self.parent.angular_velocity)
        return tuple(x + y for x, y in zip(before, own, strict=True))
