"""Axes that turn and places that move: the parts of a `Motion`."""

from __future__ import annotations

from lagrangian.dynamics.vectors import Matrix, Vector
from lagrangian.records import dataclass, field


@dataclass(eq=False)
class Axes:
    """Axes that turn. ``turn`` is R (own axes → parent's axes), and ``own`` is the angular velocity relative to the
    parent, in these axes; ``axis`` is the number of the coordinate axis for a turn about one. In the plane ``own`` is
    one number, and ``turn`` leads to the fixed axes.
    """

    parent: Axes | None
    turn: Matrix
    own: Vector
    axis: int | None = None
    omega: Vector = field(default_factory=list)
    depth: int = 0
    steady: bool = False  # at rest against the parent


@dataclass(eq=False)
class PlaceMotion:
    """A place that moves: its ``offset`` from ``parent`` in ``axes``, the rate of the offset, and its ``velocity`` in
    ``axes``.

    ``slide`` are the velocity components relative to the ground in ``axes``, for a floating place with
    quasi-velocities; ``given`` are the axes and components in which an offset in the plane was given.
    """

    parent: PlaceMotion | None
    axes: Axes
    offset: Vector
    offset_rate: Vector
    velocity: Vector
    slide: Vector | None = None
    position: Vector | None = None
    given: tuple[Axes, Vector] | None = None


@dataclass
class Accelerations:
    """α of axes and a of places for given v̇; in the plane α is one number, and a is in the fixed axes."""

    vdot: Vector
    alpha: dict[Axes, Vector]
    a: dict[PlaceMotion, Vector]
