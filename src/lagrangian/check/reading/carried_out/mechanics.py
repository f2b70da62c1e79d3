"""Frames, vectors, points and bodies of SymPy's mechanics, carried out on symbols.

A vector is a sum of columns in axes of frames. Every frame is turned against the ground, in which velocities are taken.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.carried_out.values import (
    TIME,
    AbandonedError,
    BoundMethod,
    Mechanical,
    Value,
    checked,
    is_scalar,
    listed,
    scalar,
    slope,
)
from lagrangian.records import dataclass, field

_AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}
MOST = 12
"""The most frames that are turned one against the other."""


@dataclass(eq=False)
class SymbolicFrame(Mechanical):
    """A frame: the matrix that turns its columns into those of the ground, and its angular velocity."""

    turned: MatrixBase = field(default_factory=lambda: sp.eye(3))
    omega: Vector | None = None
    depth: int = 0

    def attribute(self, name: str) -> Value:
        """An axis of the frame, or a method."""
        return Vector({self: sp.Matrix(_AXES[name])}) if name in _AXES else BoundMethod(self, name)

    def call(self, name: str, given: Sequence[Value], options: Mapping[str, Value]) -> Value:
        """What a method of the frame does."""
        if name in ("orientnew", "orient"):
            made = SymbolicFrame() if name == "orientnew" else self
            parent, (kind, angles, *order) = (self, given[1:]) if name == "orientnew" else (_frame(given[0]), given[1:])
            order = order or [options.get("rot_order", "")]
            if str(kind).lower() == "axis":
                made.turn(parent, *_angle_and_axis(listed(angles)))
            elif str(kind).lower() == "body":
                made.turn_thrice(parent, listed(angles), str(order[0]))
            else:
                raise AbandonedError
            return made
        if name == "orient_axis":
            self.turn(_frame(given[0]), *_angle_and_axis(given[1:]))
        elif name == "orient_body_fixed":
            self.turn_thrice(_frame(given[0]), listed(given[1]), str(given[2]))
        elif name == "set_ang_vel":
            self.omega = _vector(given[1])
        elif name == "ang_vel_in":
            return self.rate()
        elif name == "ang_acc_in":
            return self.rate().moved()
        else:
            raise AbandonedError
        return self

    def rate(self) -> Vector:
        """The angular velocity."""
        return self.omega or Vector({})

    def turn(self, parent: SymbolicFrame, angle: sp.Expr, axis: Vector) -> None:
        """Turn about an axis of a parent."""
        n = parent.turned.T * axis.column()
        skew = sp.Matrix([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
        R = sp.eye(3) + sp.sin(angle) * skew + (1 - sp.cos(angle)) * skew * skew
        self.depth = parent.depth + 1
        if self.depth > MOST:
            raise AbandonedError
        self.turned = checked((parent.turned * R).applyfunc(sp.expand))
        self.omega = parent.rate().plus(Vector({parent: n * slope(angle, TIME)}))

    def turn_thrice(self, parent: SymbolicFrame, angles: Sequence[Value], order: str) -> None:
        """Turn by three angles about axes that turn, 313 or ZXZ."""
        if len(order) != len(angles) or len(order) != 3:
            raise AbandonedError
        at = parent
        for k, (angle, axis) in enumerate(
            zip(angles, order.lower().translate(str.maketrans("123", "xyz")), strict=True)
        ):
            made = self if k == 2 else SymbolicFrame()
            made.turn(at, scalar(angle), at.attribute(axis))
            at = made


@dataclass(frozen=True, eq=False)
class Vector(Mechanical):
    """A vector: a column for each frame in whose axes it is given."""

    parts: Mapping[SymbolicFrame, MatrixBase]

    def column(self, frame: SymbolicFrame | None = None) -> MatrixBase:
        """The column in the axes of the ground, or of a frame."""
        if set(self.parts) == {frame}:
            return self.parts[frame]  # type: ignore[index]  # a frame
        total = sp.zeros(3, 1)
        for of, x in self.parts.items():
            total += of.turned * x
        return checked(frame.turned.T * total if frame is not None else total)

    def plus(self, other: Vector, sign: int = 1) -> Vector:
        """The sum or the difference."""
        found = dict(self.parts)
        for frame, x in other.parts.items():
            found[frame] = checked(found.get(frame, sp.zeros(3, 1)) + sign * x)
        return Vector(found)

    def scaled(self, by: sp.Expr) -> Vector:
        """A multiple."""
        return Vector({frame: checked(x * by) for frame, x in self.parts.items()})

    def dot(self, other: Vector) -> sp.Expr:
        """The scalar product."""
        one = next(iter(self.parts), None) if self.parts.keys() == other.parts.keys() and len(self.parts) == 1 else None
        a, b = self.column(one), other.column(one)
        return checked(sp.Add(*[x * y for x, y in zip(a.flat(), b.flat(), strict=True)]))

    def cross(self, other: Vector) -> Vector:
        """The vector product."""
        found = Vector({})
        for a, x in self.parts.items():
            for b, y in other.parts.items():
                z = y if a is b else a.turned.T * b.turned * y
                found = found.plus(Vector({a: checked(x.cross(z))}))
        return found

    def moved(self) -> Vector:
        """The derivative by time in the ground."""
        found = Vector({frame: slope(x, TIME) for frame, x in self.parts.items()})
        for frame, x in self.parts.items():
            found = found.plus(frame.rate().cross(Vector({frame: x})))
        return found

    def slope(self, by: sp.Expr) -> Vector:
        """The partial derivative by a rate or a speed."""
        return Vector({frame: slope(x, by) for frame, x in self.parts.items()})

    def put(self, table: Mapping[Any, Any]) -> Vector:
        """The vector with others in place of parts."""
        return Vector({frame: checked(x.xreplace(dict(table))) for frame, x in self.parts.items()})

    def attribute(self, name: str) -> Value:
        """A method of the vector."""
        return BoundMethod(self, name)

    def call(self, name: str, given: Sequence[Value], options: Mapping[str, Value]) -> Value:
        """What a method of the vector does."""
        if name in ("dot", "cross") and given:
            return self.dot(_vector(given[0])) if name == "dot" else self.cross(_vector(given[0]))
        if name in ("dt", "diff") and given:
            return self.moved() if name == "dt" or given[0] == TIME else self.slope(scalar(given[0]))
        if name in ("magnitude", "norm"):
            return sp.sqrt(self.dot(self))
        if name == "to_matrix":
            return self.column(_frame(given[0]))
        if name in ("express", "simplify", "subs"):
            return self if name != "subs" else self.put(dict(given[0]) if isinstance(given[0], dict) else {})
        raise AbandonedError


@dataclass(frozen=True, eq=False)
class Dyad(Mechanical):
    """An inertia: a matrix in the axes of a frame."""

    frame: SymbolicFrame
    matrix: MatrixBase

    def along(self, v: Vector) -> Vector:
        """What it makes of an angular velocity."""
        return Vector({self.frame: checked(self.matrix * v.column(self.frame))})

    def attribute(self, name: str) -> Value:
        """Nothing is asked of an inertia."""
        raise AbandonedError

    def call(self, name: str, given: Sequence[Value], options: Mapping[str, Value]) -> Value:
        """Nothing is asked of an inertia."""
        raise AbandonedError


@dataclass(eq=False)
class SymbolicPoint(Mechanical):
    """A point: where it is seen from another one, and its velocities in frames, as they are stated."""

    parent: SymbolicPoint | None = None
    seen: Vector = field(default_factory=lambda: Vector({}))
    velocity: Vector | None = None
    within: dict[SymbolicFrame, Vector] = field(default_factory=dict)
    depth: int = 0

    def attribute(self, name: str) -> Value:
        """A method of the point."""
        return BoundMethod(self, name)

    def call(self, name: str, given: Sequence[Value], options: Mapping[str, Value]) -> Value:
        """What a method of the point does."""
        if name == "locatenew":
            return SymbolicPoint(self, _vector(given[1]), depth=self.depth + 1)
        if name == "set_pos":
            self.parent, self.seen, self.depth = _point(given[0]), _vector(given[1]), _point(given[0]).depth + 1
        elif name == "set_vel":
            frame, v = _frame(given[0]), _vector(given[1])
            self.within[frame] = v
            self.velocity = v if frame.omega is None else self.velocity
        elif name in ("v2pt_theory", "v1pt_theory"):
            of, turning = _point(given[0]), _frame(given[2])
            self.velocity = of.moving().plus(turning.rate().cross(self.from_(of)))
            if name == "v1pt_theory":
                self.velocity = self.velocity.plus(self.within.get(turning, Vector({})))
            return self.velocity
        elif name in ("vel", "acc"):
            return self.moving() if name == "vel" else self.moving().moved()
        elif name == "pos_from":
            return self.from_(_point(given[0]))
        else:
            raise AbandonedError
        return self

    def place(self) -> Vector:
        """Where the point is, seen from the first of its parents."""
        if self.depth > MOST:
            raise AbandonedError
        return self.seen if self.parent is None else self.parent.place().plus(self.seen)

    def from_(self, other: SymbolicPoint) -> Vector:
        """Where the point is, seen from another one."""
        return self.place().plus(other.place(), -1)

    def moving(self) -> Vector:
        """The velocity in the ground: as it is stated, or that of the place."""
        if self.velocity is not None:
            return self.velocity
        return Vector({}) if self.parent is None else self.parent.moving().plus(self.seen.moved())


@dataclass(eq=False)
class Mass(Mechanical):
    """A particle or a rigid body."""

    at: SymbolicPoint
    mass: sp.Expr
    frame: SymbolicFrame | None = None
    inertia: Dyad | None = None
    potential: sp.Expr = sp.S.Zero

    def attribute(self, name: str) -> Value:
        """The mass, the potential energy, or a method."""
        known: dict[str, Value] = {"mass": self.mass, "potential_energy": self.potential, "point": self.at}
        known |= {"masscenter": self.at, "frame": self.frame}
        return known[name] if known.get(name) is not None else BoundMethod(self, name)

    def call(self, name: str, given: Sequence[Value], options: Mapping[str, Value]) -> Value:
        """The kinetic energy."""
        if name != "kinetic_energy":
            raise AbandonedError
        return self.kinetic()

    def kinetic(self) -> sp.Expr:
        """The kinetic energy."""
        v = self.at.moving()
        found = self.mass * v.dot(v) / 2
        if self.frame is not None and self.inertia is not None:
            w = self.frame.rate()
            found += w.dot(self.inertia.along(w)) / 2
        return checked(found)


def _angle_and_axis(given: Sequence[Value]) -> tuple[sp.Expr, Vector]:
    a, b = given
    return (scalar(b), a) if isinstance(a, Vector) else (scalar(a), _vector(b))


def _frame(value: Value) -> SymbolicFrame:
    if not isinstance(value, SymbolicFrame):
        raise AbandonedError
    return value


def _point(value: Value) -> SymbolicPoint:
    if not isinstance(value, SymbolicPoint):
        raise AbandonedError
    return value


def _vector(value: Value) -> Vector:
    if isinstance(value, Vector):
        return value
    if value != 0:
        raise AbandonedError
    return Vector({})


def masses(values: Sequence[Value]) -> list[Mass]:
    """The bodies among what a routine is given, one by one or in a list."""
    found = [y for x in values for y in (listed(x) if isinstance(x, (list, tuple)) else [x])]
    return [x for x in found if isinstance(x, Mass)]


def made(name: str, given: Sequence[Value], options: Mapping[str, Value]) -> Value | None:
    """What a routine of SymPy's mechanics makes; None for any other routine."""
    if name == "ReferenceFrame":
        return SymbolicFrame()
    if name == "Point":
        return SymbolicPoint()
    if name == "Particle" and len(given) > 2:
        return Mass(_point(given[1]), scalar(given[2]))
    if name == "RigidBody" and len(given) > 4:
        dyad = listed(given[4])[0]
        return Mass(_point(given[1]), scalar(given[3]), _frame(given[2]), dyad if isinstance(dyad, Dyad) else None)
    if name == "inertia" and len(given) > 3:
        a, b, c, ab, bc, ca = (*map(scalar, given[1:]), *([sp.S.Zero] * (7 - len(given))))
        return Dyad(_frame(given[0]), sp.Matrix([[a, ab, ca], [ab, b, bc], [ca, bc, c]]))
    if name in ("kinetic_energy", "potential_energy", "Lagrangian") and (bodies := masses(given)):
        T, V = sp.Add(*[x.kinetic() for x in bodies]), sp.Add(*[x.potential for x in bodies])
        return checked({"kinetic_energy": T, "potential_energy": V}.get(name, T - V))
    if name in ("dot", "cross", "outer") and any(isinstance(x, Vector) for x in given):
        ops: Mapping[str, ast.operator] = {"dot": ast.BitAnd(), "cross": ast.BitXor(), "outer": ast.BitOr()}
        return combined(ops[name], given[0], given[1])
    return None


def combined(op: ast.operator, a: Value, b: Value) -> Value:
    """The value of an operator between vectors, inertias and numbers."""
    if isinstance(op, (ast.Add, ast.Sub)):
        sign = 1 if isinstance(op, ast.Add) else -1
        if isinstance(a, Dyad) and isinstance(b, Dyad):
            turned = b.matrix if a.frame is b.frame else a.frame.turned.T * b.frame.turned * b.matrix
            turned = turned if a.frame is b.frame else turned * b.frame.turned.T * a.frame.turned
            return Dyad(a.frame, checked(a.matrix + sign * turned))
        return _vector(a).plus(_vector(b), sign)
    if isinstance(op, (ast.Mult, ast.Div)):
        a, b = (b, a) if isinstance(b, Mechanical) else (a, b)
        if not is_scalar(b):
            raise AbandonedError
        factor = 1 / scalar(b) if isinstance(op, ast.Div) else scalar(b)
        return Dyad(a.frame, checked(a.matrix * factor)) if isinstance(a, Dyad) else _vector(a).scaled(factor)
    if isinstance(op, ast.BitAnd):
        if isinstance(a, Dyad) or isinstance(b, Dyad):
            return a.along(_vector(b)) if isinstance(a, Dyad) else b.along(_vector(a))
        return _vector(a).dot(_vector(b))
    if isinstance(op, ast.BitXor):
        return _vector(a).cross(_vector(b))
    if isinstance(op, ast.BitOr) and len(_vector(a).parts) == 1:
        frame = next(iter(a.parts))
        return Dyad(frame, checked(a.column(frame) * _vector(b).column(frame).T))
    raise AbandonedError
