"""Which points are fixed in which bodies, and which no coordinate moves."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.context import Context
from lagrangian.derive.reasons.motion import Moving
from lagrangian.model import Body, Point
from lagrangian.model.elements.base import difference
from lagrangian.records import dataclass, field


@dataclass(frozen=True, eq=False)
class FixedPoints:
    """Finds the body in which a point is fixed, and whether a coordinate moves the point."""

    context: Context
    moving: tuple[Moving, ...]
    _known: dict[tuple[int, int], bool] = field(default_factory=dict[tuple[int, int], bool])

    def body_of(self, point: Point) -> Body | None:
        """The body in which a point is fixed, None if there is none; a body at that very point first."""
        bodies = self.context.model.bodies
        same = [b for b in bodies if b.at is point]
        return next(iter(same), None) or next((b for b in bodies if self.fixed_in(point, b)), None)

    def fixed_in(self, point: Point, body: Body) -> bool:
        """Whether a point never moves relative to a body: R^T (r_P − r_G) does not change."""
        key = (id(point), id(body))
        if key not in self._known:
            self._known[key] = point is body.at or self._fixed(point, body)
        return self._known[key]

    def _fixed(self, point: Point, body: Body) -> bool:
        arm = difference(self.context.model, body.at, point)
        return all(not self.context.form(x).moves for x in self.along_axes(body, arm))

    def along_axes(self, body: Body, vector: Sequence[sp.Expr]) -> tuple[sp.Expr, ...]:
        """The components of a vector in the axes of a body, in the plane too."""
        if body.axes is None:
            return tuple(vector)
        expand = self.context.model.expand
        turn = body.axes.rotation
        return tuple(
            sp.Add(*(expand(turn[i, j]) * x for i, x in enumerate(vector)))  # type: ignore[operator]
            for j in range(len(vector))
        )

    def still(self, point: Point) -> bool:
        """Whether no coordinate moves a point: it is on the ground, or on a support that moves as prescribed."""
        symbols = set(self.context.symbols)
        return not any(
            symbols & bounded.names(x) for x in map(self.context.model.expand, self.context.model.position(point))
        )
