"""Converts a Model to Programs, by virtual work on the graph: inverse and forward dynamics, mass matrix, energies.

`Mechanics` with a `Motion` is the layer below, for systems that are not described by a model.
"""

from lagrangian.dynamics.bodies import Bodies
from lagrangian.dynamics.body_numbers import body_numbers
from lagrangian.dynamics.canonical import canonical, canonical_impacts, momenta, velocities
from lagrangian.dynamics.constraint_programs import (
    changes,
    closing_terms,
    constraint_matrix,
    correction,
    divisors,
    forward_dual,
    multipliers,
    projection,
    pushed_bias,
    residual,
)
from lagrangian.dynamics.dependent import quoted
from lagrangian.dynamics.derivatives import PARAMETER, VARIED, derivatives, inverse_derivatives, singles, tangent
from lagrangian.dynamics.describe import describe, placed
from lagrangian.dynamics.description import Inputs
from lagrangian.dynamics.feedback import SUPPLY, balance_terms_closed, closed, observe_closed, power_closed
from lagrangian.dynamics.friction import (
    LEAST_REGULARITY,
    PARADOX,
    Modes,
    Watch,
    regime,
    slips,
    verdict,
    watched,
    watches,
)
from lagrangian.dynamics.impacts import impacts
from lagrangian.dynamics.loose import loose, moving_no_mass
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.dynamics.motion import Motion
from lagrangian.dynamics.notices import configurations, dependent_rows, notices
from lagrangian.dynamics.observe import observe
from lagrangian.dynamics.places import frame_program, named_place, point_program
from lagrangian.dynamics.power import power
from lagrangian.dynamics.programs import (
    bias,
    coriolis,
    energy,
    forward,
    inverse,
    inverse_from_lagrangian,
    loss,
    mass_matrix,
    potential_force,
    rates,
    rhs,
)
from lagrangian.dynamics.pullbacks import hessian_product, pullback
from lagrangian.dynamics.reactions import ReactionProgram, check_joint, reaction
from lagrangian.dynamics.variational import (
    VariedColumn,
    VariedPrograms,
    columns_key,
    variational,
    varied_quantities,
)

__all__ = [
    "LEAST_REGULARITY",
    "PARADOX",
    "PARAMETER",
    "SUPPLY",
    "VARIED",
    "Bodies",
    "Inputs",
    "Mechanics",
    "Modes",
    "Motion",
    "ReactionProgram",
    "VariedColumn",
    "VariedPrograms",
    "Watch",
    "balance_terms_closed",
    "bias",
    "body_numbers",
    "canonical",
    "canonical_impacts",
    "changes",
    "check_joint",
    "closed",
    "closing_terms",
    "columns_key",
    "configurations",
    "constraint_matrix",
    "coriolis",
    "correction",
    "dependent_rows",
    "derivatives",
    "describe",
    "divisors",
    "energy",
    "forward",
    "forward_dual",
    "frame_program",
    "hessian_product",
    "impacts",
    "inverse",
    "inverse_derivatives",
    "inverse_from_lagrangian",
    "loose",
    "loss",
    "mass_matrix",
    "momenta",
    "moving_no_mass",
    "multipliers",
    "named_place",
    "notices",
    "observe",
    "observe_closed",
    "placed",
    "point_program",
    "potential_force",
    "power",
    "power_closed",
    "projection",
    "pullback",
    "pushed_bias",
    "quoted",
    "rates",
    "reaction",
    "regime",
    "residual",
    "rhs",
    "singles",
    "slips",
    "tangent",
    "variational",
    "varied_quantities",
    "velocities",
    "verdict",
    "watched",
    "watches",
]
