"""What each kind of element states about its fields and what it acts on: data that other packages read."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from enum import Enum, auto
from typing import Any, TypeAlias

import sympy as sp

from lagrangian.model.geometry import Frame, Point
from lagrangian.records import dataclass

Unit: TypeAlias = "tuple[int, ...]"
"""The exponents of the SI base units kg, m, s, A, K, mol and cd, without trailing zeros."""

ANGLE: Unit = (0, 0, 0)
LENGTH: Unit = (0, 1, 0)
MASS: Unit = (1, 0, 0)
INERTIA: Unit = (1, 2, 0)
ACCELERATION: Unit = (0, 1, -2)
FORCE: Unit = (1, 1, -2)
ENERGY: Unit = (1, 2, -2)
POWER: Unit = (1, 2, -3)
CHARGE: Unit = (0, 0, 1, 1)
CURRENT: Unit = (0, 0, 0, 1)
VOLTAGE: Unit = (1, 2, -3, -1)
FLUX: Unit = (1, 2, -2, -1)
INDUCTANCE: Unit = (1, 2, -2, -2)
CAPACITANCE: Unit = (-1, -2, 4, 2)
RESISTANCE: Unit = (1, 2, -3, -2)

Rows: TypeAlias = "tuple[tuple[sp.Expr, ...], ...]"
"""A matrix, row by row."""


class FieldKind(Enum):
    """The format of a field in a file, which the schema, the reader and the writer of files use."""

    EXPRESSION = auto()
    VECTOR = auto()
    EXPRESSION_OR_VECTOR = auto()
    POINT = auto()
    TWO_POINTS = auto()
    FRAME = auto()
    FRAME_OR_ANGLE = auto()
    BODY_FRAME = auto()
    """A frame or, in the plane, an angle for which a frame is made."""
    INERTIA = auto()
    COORDINATE = auto()
    POINTS = auto()
    """Two points or more, in order."""
    FRAMES = auto()
    """One frame, against the fixed axes, or two."""
    BODY = auto()
    """A rigid body, by its name."""
    DIRECTIONS = auto()
    """A vector, or a list of them."""
    ROWS = auto()
    """A row of a constraint, by its name."""
    STRENGTH_OF_GRAVITY = auto()
    """An expression; the default is the parameter g."""


REQUIRED: Any = ...
"""The default of a field that must be given."""


@dataclass(frozen=True)
class Entry:
    """A field of an element: its format, its description, and its default in a file.

    ``local`` are symbols that have a meaning only in this expression. If the field ``made_from`` is given, this one
    follows from it and is not written.
    """

    kind: FieldKind
    about: str
    default: Any = None
    local: tuple[sp.Symbol, ...] = ()
    made_from: str = ""


@dataclass(frozen=True)
class Measure:
    """The unit that an expression of an element must have: ``unit`` · [along]^power.

    ``along`` is the deflection or coordinate along which the element acts; None means a length. With ``local``, the
    expression is a symbol that has this unit in the measures that follow.
    """

    what: str
    expr: sp.Expr
    unit: Unit
    along: sp.Expr | None = None
    power: int = 0
    local: bool = False


@dataclass(frozen=True)
class MovingMass:
    """What resists a motion: ``rates``, linear in ξ̇, and the symmetric matrix ``weight``, as in ½ ratesᵀ weight rates.

    The rates are velocities [m/s] with masses [kg], or with ``turning`` angular velocities [rad/s] with inertias.
    """

    rates: tuple[sp.Expr, ...]
    weight: Rows
    turning: bool = False


@dataclass(frozen=True)
class ActsOn:
    """What an element acts on, and the message if no coordinate moves any of it; a pair is two ends that are moved
    apart."""

    targets: tuple[Point | Frame | sp.Expr | tuple[Point, Point], ...]
    idle: str
    fix: str


def deflected(between: tuple[Point, Point] | None, deflection: sp.Expr) -> ActsOn:
    """The target of an element that acts along the distance of two points or along a deflection."""
    if between:
        return ActsOn(
            (between,),
            "it does nothing: no coordinate moves its two ends apart",
            "between=(P, Q) with at least one of them moved by a coordinate that does not carry the other along",
        )
    return ActsOn(
        (deflection,),
        "it does nothing: no coordinate changes its deflection",
        "write the deflection with coordinates, such as x2 - x1",
    )
