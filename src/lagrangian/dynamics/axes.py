"""Axes that turn and places that move: what `Motion` is made of."""

from __future__ import annotations

from dataclasses import dataclass, field

from lagrangian.dynamics.vectors import Matrix, Vector


@dataclass(eq=False)
class Axes:
    """Axes that turn. ``turn`` is R (own axes → parent's axes), ``own`` the angular velocity against the parent, in
    these axes; ``axis`` is the number of the coordinate axis of a turn about one. In the plane ``own`` is one number
    and ``turn`` goes to the fixed axes.
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
    """A place that moves: ``offset`` and its rate in ``axes``, from ``parent``; ``velocity`` in ``axes``.

    ``slide`` are velocity components against the ground in ``axes``, for a place that floats with quasi-velocities;
    ``given`` are the axes and components an offset in the plane was given in.
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
    """α of axes and a of places at v̇; in the plane α is one number and a stands in the fixed axes."""

    vdot: Vector
    alpha: dict[Axes, Vector]
    a: dict[PlaceMotion, Vector]
