"""Model → Program: inverse and forward dynamics, mass matrix, energies, by virtual work through the graph.

`Mechanics` over a `Motion` is the layer below, for what is not described by a model.
"""

from lagrangian.dynamics.bodies import Bodies
from lagrangian.dynamics.describe import Inputs, describe
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.dynamics.motion import Motion
from lagrangian.dynamics.programs import (
    bias,
    coriolis,
    energy,
    forward,
    gravity,
    inverse,
    inverse_from_lagrangian,
    loss,
    mass_matrix,
    point_jacobian,
    rhs,
)

__all__ = [
    "Bodies",
    "Inputs",
    "Mechanics",
    "Motion",
    "bias",
    "coriolis",
    "describe",
    "energy",
    "forward",
    "gravity",
    "inverse",
    "inverse_from_lagrangian",
    "loss",
    "mass_matrix",
    "point_jacobian",
    "rhs",
]
