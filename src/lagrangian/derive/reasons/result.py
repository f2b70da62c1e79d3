"""The result: why Lagrange's equations hold for one system, with everything that was computed for it."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.derive.context import Context
from lagrangian.derive.derived import Derived
from lagrangian.derive.reasons.at_a_state import NumbersAt
from lagrangian.derive.reasons.holding import Holding
from lagrangian.derive.reasons.laws import Law
from lagrangian.derive.reasons.loads import AppliedLoads
from lagrangian.derive.reasons.motion import Column, Moving
from lagrangian.model import Body
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief


@dataclass(frozen=True)
class EquationCount(Brief):
    """The numbers of equations and unknowns by free bodies, and by Lagrange, in the same coordinates.

    By free bodies there are ``equations``: F = ma and moments of all bodies, and one for every row of the constraints
    that were stated, of which there are as many as ``multipliers``. There are as many unknowns: ``accelerations`` of
    the coordinates, and ``forces``, the components of constraint forces and moments. By Lagrange there is one equation
    for each of ``coordinates`` and every row, for their accelerations and the multipliers.
    """

    particles: int
    rigid_bodies: int
    equations: int
    accelerations: int
    forces: int
    coordinates: int
    multipliers: int


@dataclass(frozen=True, eq=False)
class Reasoning(Brief):
    """All that is computed for the page, as normal forms and numbers.

    ``reactions`` are the constraint forces, or their moments, in the order of ``moving``.
    """

    derived: Derived
    moving: tuple[Moving, ...]
    applied: AppliedLoads
    reactions: tuple[Column, ...]
    laws: tuple[Law, ...]
    holds: tuple[Holding, ...]
    numbers: NumbersAt | None
    spared: EquationCount
    index: Mapping[Body, str] = field(default_factory=dict[Body, str])

    @property
    def context(self) -> Context:
        """The algebra of the derivation."""
        return self.derived.shares.context

    def holders(self, body: Body) -> tuple[Holding, ...]:
        """All that holds a body; its constraint force is the sum of their forces."""
        own = [hold for hold in self.holds if body in hold.bodies]
        return tuple(sorted(own, key=lambda hold: (hold.kind in ("tie", "lever", "constraint"), hold.body is not body)))


def spared(d: Derived) -> EquationCount:
    """Count the equations and unknowns: 2 or 3 for a particle, 3 or 6 for a rigid body, in the plane or in space.

    The unknown components of constraint forces are as many as there are more equations than accelerations.
    """
    model = d.model
    rigid = sum(bool(b.tensor) for b in model.bodies)
    particles = len(model.bodies) - rigid
    m, n = len(d.shares.rows), len(model.coordinates)
    equations = particles * model.dimension + rigid * (3 if model.dimension == 2 else 6) + m
    accelerations = n - len(model.charges)  # a charge moves no mass
    return EquationCount(particles, rigid, equations, accelerations, equations - accelerations, n, m)
