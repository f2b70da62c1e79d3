"""The result: why Lagrange's equations hold for one system, with everything that was computed for it."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.derive.context import Context
from lagrangian.derive.derived import Derived
from lagrangian.derive.reasons.at_a_state import NumbersAt
from lagrangian.derive.reasons.held import Holding
from lagrangian.derive.reasons.laws import Law
from lagrangian.derive.reasons.loads import AppliedLoads
from lagrangian.derive.reasons.motion import Column, Moving
from lagrangian.model import Body
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief


@dataclass(frozen=True)
class EquationCount(Brief):
    """The numbers of equations and unknowns by free bodies, and by Lagrange.

    By free bodies there are ``equations`` of F = ma and of moments, and as many unknowns: ``accelerations`` of the
    coordinates, and ``forces``, the components of constraint forces and moments. By Lagrange there are ``coordinates``
    equations for as many accelerations, and with explicit constraints ``multipliers`` more of both.
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


def spared(d: Derived) -> EquationCount:
    """Count the equations and unknowns: 2 or 3 for a particle, 3 or 6 for a rigid body, in the plane or in space.

    The constraint forces have as many components as constraints take away freedoms: equations − degrees of freedom.
    """
    model = d.model
    rigid = sum(bool(b.tensor) for b in model.bodies)
    particles = len(model.bodies) - rigid
    equations = particles * model.dimension + rigid * (3 if model.dimension == 2 else 6)
    n, m = len(model.coordinates), len(d.shares.rows)
    moving = n - m - len(model.charges)  # a charge moves no mass
    return EquationCount(particles, rigid, equations, n - m, equations - moving, n, m)
