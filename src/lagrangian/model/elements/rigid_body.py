"""A rigid body: a mass at its centre of mass, and an inertia about it."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar, cast

import sympy as sp

from lagrangian.model.elements.answers import INERTIA, MASS, REQUIRED, Entry, FieldKind, Measure, MovingMass, Rows
from lagrangian.model.elements.base import Body, Level, Surroundings, Use
from lagrangian.model.elements.vectors import diagonal
from lagrangian.model.geometry import Frame, Point, as_expr, entries, is_listed, turned
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class RigidBody(Body):
    """A rigid body: T* = ½ m v² + ½ J ω² in the plane, ½ m v² + ½ ωᵀ I ω in space.

    ``at`` is the centre of mass, and ``inertia`` [kg m²] is always about the centre of mass: a scalar in the plane; in
    space three principal moments or a symmetric 3×3 matrix in the axes of ``frame``, whose off-diagonal entries are the
    elements of the tensor (−∫xy dm).
    """

    inertia: Any
    frame: Any

    kind: ClassVar[str] = "rigid_body"
    plural = "Rigid bodies."
    about = "A rigid body: T* = ½ m v² + ½ J ω²."
    entries: ClassVar[Mapping[str, Entry]] = {
        "mass": Entry(FieldKind.EXPRESSION, "The mass, made of parameters.", REQUIRED),
        "inertia": Entry(
            FieldKind.INERTIA,
            "About the centre of mass: J in the plane; three principal moments or a 3×3 tensor in space.",
            REQUIRED,
        ),
        "at": Entry(FieldKind.POINT, "Its centre of mass.", REQUIRED),
        "frame": Entry(FieldKind.BODY_FRAME, "The frame that turns with it; in the plane an angle will do.", REQUIRED),
    }

    def __post_init__(self) -> None:
        if not isinstance(self.at, Point):
            raise self._error("a rigid body's centre of mass must be a point", fix="at=P", code="E412")
        if not isinstance(self.frame, Frame):
            raise self._error(
                "a rigid body needs the frame that turns with it",
                fix="write frame=system.frame(angle=…)",
                code="E412",
            )
        self._set(mass=as_expr(self.mass, f"the mass of {self.title}", place=self.place))
        self._set(inertia=self._tensor(self.inertia))

    def _tensor(self, given: object) -> sp.ImmutableMatrix:
        """Return the inertia as a 1×1 matrix in the plane, 3×3 in space."""
        what = f"the inertia of {self.title}"
        rows: Sequence[object] | None = None
        if isinstance(given, sp.MatrixBase):
            rows = cast("list[object]", given.tolist()) if given.rows > 1 and given.cols > 1 else entries(given)
        elif is_listed(given):
            rows = given
        if self.frame.dimension == 2:
            if rows is not None:
                raise self._error(
                    "in the plane the inertia is one number J about the centre of mass", fix="inertia=J", code="E106"
                )
            return sp.ImmutableMatrix([[as_expr(given, what, place=self.place)]])
        if rows is None or len(rows) != 3:
            raise self._error(
                "in space the inertia is three principal moments or a 3×3 matrix",
                fix="write inertia=(A, B, C) or inertia=[[Ixx, Ixy, Ixz], [Ixy, Iyy, Iyz], [Ixz, Iyz, Izz]]",
                code="E106",
            )
        if not is_listed(rows[0]):
            return sp.ImmutableMatrix(diagonal([as_expr(v, what, place=self.place) for v in rows]))
        if any(not is_listed(row) or len(row) != 3 for row in rows):
            raise self._error("the inertia matrix is not 3×3", fix="give three rows of three entries", code="E106")
        listed = cast("Sequence[Sequence[object]]", rows)
        tensor = sp.ImmutableMatrix([[as_expr(v, what, place=self.place) for v in row] for row in listed])
        for i, j in ((0, 1), (0, 2), (1, 2)):
            if tensor[i, j] != tensor[j, i]:
                raise self._error(
                    f"the inertia matrix is not symmetric: entry ({i + 1},{j + 1}) is {tensor[i, j]} and "
                    f"entry ({j + 1},{i + 1}) is {tensor[j, i]}",
                    fix="an inertia is a symmetric tensor; products are its elements (−∫xy dm)",
                    code="E106",
                )
        return tensor

    def suggested_name(self) -> str:
        """The symbol of its mass, or else of its inertia."""
        if isinstance(self.mass, sp.Symbol):
            return self.mass.name
        return self.inertia[0, 0].name if isinstance(self.inertia[0, 0], sp.Symbol) else ""

    def uses(self) -> Iterator[Use]:
        """The mass and the entries of the inertia, made of parameters."""
        yield Use("mass", "mass", self.mass, Level.CONSTANT)
        for entry in self.inertia:
            yield Use("inertia", "inertia", entry, Level.CONSTANT)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """A mass and moments of inertia."""
        yield Measure("mass", self.mass, MASS)
        for entry in self.inertia:
            yield Measure("inertia", entry, INERTIA)

    def frames(self) -> Iterator[tuple[str, Frame]]:
        """The axes that turn with it."""
        yield "frame", self.frame

    @property
    def axes(self) -> Frame:
        """The frame that turns with it."""
        return self.frame

    @property
    def tensor(self) -> Rows:
        """The inertia [kg m²] about its centre of mass in its axes."""
        size, listed = self.inertia.rows, entries(self.inertia)
        return tuple(listed[size * i : size * (i + 1)] for i in range(size))

    def masses(self, model: Surroundings) -> Iterator[MovingMass]:
        """Its mass, and its inertia with its angular velocity."""
        yield from super().masses(model)
        yield MovingMass(self.angular_velocity(model), self.tensor, turning=True)

    def angular_velocity(self, model: Surroundings) -> tuple[sp.Expr, ...]:
        """``(ω,)`` in the plane; in space three components in the body's axes; written out in the coordinates."""
        return tuple(model.expand(w) for w in self.frame.angular_velocity)

    def kinetic(self, model: Surroundings) -> sp.Expr:
        """½ m v² + ½ ωᵀ I ω."""
        omega = self.angular_velocity(model)
        translation = self.mass / 2 * sum((v**2 for v in model.velocity(self.at)), sp.S.Zero)
        momentum = turned(self.inertia, omega)
        return translation + sp.Add(*(w * h for w, h in zip(omega, momentum, strict=True))) / 2
