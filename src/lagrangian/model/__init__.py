"""The description of a system: coordinates, parameters, points, frames and elements, frozen as a `Model`.

`Builder` collects and checks a description; `Model` is the frozen description that `derive` and `dynamics` read.
"""

from lagrangian.model.builder import Builder
from lagrangian.model.elements import (
    DEFLECTION,
    REGISTRY,
    Action,
    Ball,
    Body,
    Constraint,
    Damper,
    Dissipation,
    Element,
    Force,
    Friction,
    GeneralizedForce,
    Gravity,
    Kinetic,
    Particle,
    Pin,
    Potential,
    RigidBody,
    Rolling,
    Rope,
    Slider,
    Spring,
    Torque,
    VelocityConstraint,
    Weld,
    Words,
)
from lagrangian.model.floating import Floating
from lagrangian.model.geometry import Frame, Point, as_expr
from lagrangian.model.model import Model, is_hard
from lagrangian.model.names import RESERVED, check_name, time
from lagrangian.model.rows import Row
from lagrangian.model.symbols import Coordinate, Definition, Input, Parameter, Velocity

__all__ = [
    "DEFLECTION",
    "REGISTRY",
    "RESERVED",
    "Action",
    "Ball",
    "Body",
    "Builder",
    "Constraint",
    "Coordinate",
    "Damper",
    "Definition",
    "Dissipation",
    "Element",
    "Floating",
    "Force",
    "Frame",
    "Friction",
    "GeneralizedForce",
    "Gravity",
    "Input",
    "Kinetic",
    "Model",
    "Parameter",
    "Particle",
    "Pin",
    "Point",
    "Potential",
    "RigidBody",
    "Rolling",
    "Rope",
    "Row",
    "Slider",
    "Spring",
    "Torque",
    "Velocity",
    "VelocityConstraint",
    "Weld",
    "Words",
    "as_expr",
    "check_name",
    "is_hard",
    "time",
]
