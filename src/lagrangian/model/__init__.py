"""What a person described: coordinates, parameters, points, frames and elements, frozen as a `Model`.

`Builder` collects and checks; `Model` is the constant description that `derive` and `dynamics` read.
"""

from lagrangian.model.builder import Builder
from lagrangian.model.elements import (
    DEFLECTION,
    REGISTRY,
    Action,
    Damper,
    Dissipation,
    Element,
    Force,
    GeneralizedForce,
    Gravity,
    Kinetic,
    Particle,
    Potential,
    RigidBody,
    Spring,
    Torque,
    Words,
)
from lagrangian.model.floating import Floating
from lagrangian.model.geometry import Frame, Point, as_expr
from lagrangian.model.model import Model
from lagrangian.model.names import RESERVED, check_name, time
from lagrangian.model.symbols import Coordinate, Definition, Input, Parameter, Velocity

__all__ = [
    "DEFLECTION",
    "REGISTRY",
    "RESERVED",
    "Action",
    "Builder",
    "Coordinate",
    "Damper",
    "Definition",
    "Dissipation",
    "Element",
    "Floating",
    "Force",
    "Frame",
    "GeneralizedForce",
    "Gravity",
    "Input",
    "Kinetic",
    "Model",
    "Parameter",
    "Particle",
    "Point",
    "Potential",
    "RigidBody",
    "Spring",
    "Torque",
    "Velocity",
    "Words",
    "as_expr",
    "check_name",
    "time",
]
