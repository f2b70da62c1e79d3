"""The methods that describe constraints: joints that close loops, expressions that are zero, bodies without slip."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from typing import Any, Self

from lagrangian.calls import Guided, worded
from lagrangian.model import (
    Ball,
    Builder,
    Constraint,
    Frame,
    Friction,
    Pin,
    Point,
    RigidBody,
    Rolling,
    Rope,
    Slider,
    VelocityConstraint,
    Weld,
)
from lagrangian.model.decimals import describes
from lagrangian.model.known_regime import in_regime

Bodies = Frame | RigidBody | Sequence[Frame | RigidBody]
"""One body or two, as rigid bodies or as frames."""


@worded
@describes
class Constrained(Guided):
    """The methods that add constraints: M v̇ + h = Ξ + Aᵀ λ.

    A positive λ acts in the direction that increases f (or c), the quantity that the constraint keeps at zero.
    """

    _builder: Builder

    def constraint(
        self,
        expression: object = None,
        *,
        between: Sequence[Point] | None = None,
        distance: object = None,
        axes: Frame | None = None,
        name: str = "",
    ) -> Constraint:
        """Add a constraint f(q, t) = 0: an expression, two points that coincide, or their ``distance``.

        The points P, Q of ``between`` coincide: f = r_P − r_Q, one row for each component, and λ [N] is the force on
        P's body at P. With a distance ℓ [m], f = |r_P − r_Q| − ℓ, and λ [N] pushes the ends apart. In space the rows
        are components along the axes of P's body, or along those of ``axes``.
        """
        return self._builder.add(
            Constraint(expression=expression, between=between, distance=distance, axes=axes, name=name)
        )

    def velocity_constraint(
        self,
        expression: object = None,
        *,
        at: Point | None = None,
        body: RigidBody | None = None,
        along: object = None,
        axes: Frame | None = None,
        name: str = "",
    ) -> VelocityConstraint:
        """Add a constraint on velocities, linear in the rates: ``x.diff()*sin(theta) - y.diff()*cos(theta)`` is zero.

        Instead of an expression, give a rigid ``body``, a point ``at`` and one or several directions ``along`` (in the
        fixed axes, or in those of ``axes``): the body's material at that point has no velocity along them. Then λ [N]
        is the force on the body along that direction.
        """
        return self._builder.add(
            VelocityConstraint(expression=expression, at=at, body=body, along=along, axes=axes, name=name)
        )

    def rolling(
        self, body: RigidBody, at: Point, along: object, *, axes: Frame | None = None, name: str = ""
    ) -> Rolling:
        """Add a rolling body: its material at the point of contact does not slip ``along`` the given directions."""
        return self._builder.add(Rolling(body=body, at=at, along=along, axes=axes, name=name))

    def pin(
        self, between: Sequence[Point], *, axis: object = None, bodies: Bodies | None = None, name: str = ""
    ) -> Pin:
        """Close a loop by a pin: two points coincide; in space the bodies rotate relative to each other about ``axis``.

        The axis has the same components in the axes of both bodies. Give ``bodies`` if the points belong to none.
        """
        return self._builder.add(Pin(between=between, axis=axis, bodies=bodies, name=name))

    def ball(self, between: Sequence[Point], *, name: str = "") -> Ball:
        """Close a loop by a ball joint: two points coincide."""
        return self._builder.add(Ball(between=between, name=name))

    def slider(
        self,
        between: Sequence[Point],
        along: object,
        *,
        axes: Frame | None = None,
        bodies: Bodies | None = None,
        name: str = "",
    ) -> Slider:
        """Close a loop by a slider: the first point stays on the line through the second one ``along`` a direction.

        The direction is fixed in ``axes`` (by default the fixed axes). ``bodies`` do not rotate relative to each other.
        """
        return self._builder.add(Slider(between=between, along=along, axes=axes, bodies=bodies, name=name))

    def weld(self, between: Sequence[Point], *, bodies: Bodies | None = None, name: str = "") -> Weld:
        """Close a loop by a weld: two points coincide, and the bodies do not rotate relative to each other."""
        return self._builder.add(Weld(between=between, bodies=bodies, name=name))

    def rope(self, through: Sequence[Point], length: object, *, name: str = "") -> Rope:
        """Add a taut rope of fixed ``length`` [m] through points: Σ |r_{k+1} − r_k| = length; its tension is −λ [N]."""
        return self._builder.add(Rope(through=through, length=length, name=name))

    def regime(self, modes: Mapping[Any, int] | None = None, **by_name: int) -> Self:
        """Return the system in which it is known whether frictions slip or stick, so that nothing in it jumps.

        Name → mode: 1 or −1 for friction that slips in that sense, 0 for friction that sticks, which becomes a
        constraint. For a row that presses on friction (``pressed_by``) it is the sign of its multiplier. Everything
        that needs a smooth system takes the result: `compile`, `export`, `linearize`, `equilibria`. Whether the regime
        holds at a state is not checked: it slips while ±δ̇ > 0, and sticks while |λ| ≤ F_s.
        """
        made = copy(self)
        in_regime(made._builder, {**(modes or {}), **by_name})
        return made

    def friction(
        self,
        mu: object = None,
        *,
        normal: object = None,
        pressed_by: object = None,
        limit: object = None,
        static: object = None,
        viscous: object = None,
        between: Sequence[Point] | None = None,
        deflection: object = None,
        name: str = "",
    ) -> Friction:
        """Add dry friction along a deflection δ: it slips with −F sign(δ̇) − b δ̇, or it sticks while |λ| ≤ F_s.

        F [N or N m] is ``mu`` times the ``normal`` force, or ``limit``; ``static`` is the coefficient or the limit at
        rest if it is higher; ``viscous`` is b. ``pressed_by`` is a constraint (or its row) whose multiplier λ_N is the
        normal force, instead of ``normal``: F = μ |λ_N|, for which λ_N and the friction are solved together; two or
        three rows along perpendicular directions press with F = μ √(λ₁² + λ₂² + …). Nothing is smoothed: while it
        sticks, δ̇ = 0 is a constraint with the multiplier λ, and a run finds the times at which it begins to stick and
        to slip.
        """
        return self._builder.add(
            Friction(
                mu=mu,
                normal=normal,
                pressed_by=pressed_by,
                limit=limit,
                static=static,
                viscous=viscous,
                between=between,
                deflection=deflection,
                name=name,
            )
        )
