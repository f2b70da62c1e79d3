"""The elements of a mechanical system, one file each.

A new element is one new file, one line in `REGISTRY` and its tests. Each element says, in its own file, where its
energy or force is booked (``ledger``) and with what expression.
"""

from lagrangian.model.elements.answers import ActsOn, Entry, FieldKind, Measure, MovingMass
from lagrangian.model.elements.base import DEFLECTION, Action, Body, Element, Level, Use, Words, deflection_between
from lagrangian.model.elements.branch import THROUGH, CircuitBranch
from lagrangian.model.elements.capacitor import Capacitor
from lagrangian.model.elements.constraint import Constraint, Restriction
from lagrangian.model.elements.damper import Damper
from lagrangian.model.elements.force import Force
from lagrangian.model.elements.friction import Friction
from lagrangian.model.elements.gravity import Gravity
from lagrangian.model.elements.inductor import Inductor, MutualInductance
from lagrangian.model.elements.joints import Ball, Pin, Slider, Weld
from lagrangian.model.elements.particle import Particle
from lagrangian.model.elements.raw import Dissipation, GeneralizedForce, Kinetic, Potential
from lagrangian.model.elements.resistor import Resistor, VoltageSource
from lagrangian.model.elements.rigid_body import RigidBody
from lagrangian.model.elements.rope import Rope
from lagrangian.model.elements.spring import Spring
from lagrangian.model.elements.torque import Torque
from lagrangian.model.elements.transducer import Transducer
from lagrangian.model.elements.velocity_constraint import Rolling, VelocityConstraint

REGISTRY: dict[str, type[Element]] = {
    "particle": Particle,
    "rigid_body": RigidBody,
    "gravity": Gravity,
    "spring": Spring,
    "damper": Damper,
    "friction": Friction,
    "force": Force,
    "torque": Torque,
    "potential": Potential,
    "kinetic": Kinetic,
    "dissipation": Dissipation,
    "generalized_force": GeneralizedForce,
    "constraint": Constraint,
    "velocity_constraint": VelocityConstraint,
    "pin": Pin,
    "ball": Ball,
    "slider": Slider,
    "weld": Weld,
    "rolling": Rolling,
    "rope": Rope,
    "inductor": Inductor,
    "mutual_inductance": MutualInductance,
    "capacitor": Capacitor,
    "resistor": Resistor,
    "voltage_source": VoltageSource,
    "transducer": Transducer,
}
"""All kinds of elements by their names in files and in Python."""

__all__ = [
    "DEFLECTION",
    "REGISTRY",
    "THROUGH",
    "Action",
    "ActsOn",
    "Ball",
    "Body",
    "Capacitor",
    "CircuitBranch",
    "Constraint",
    "Damper",
    "Dissipation",
    "Element",
    "Entry",
    "FieldKind",
    "Force",
    "Friction",
    "GeneralizedForce",
    "Gravity",
    "Inductor",
    "Kinetic",
    "Level",
    "Measure",
    "MovingMass",
    "MutualInductance",
    "Particle",
    "Pin",
    "Potential",
    "Resistor",
    "Restriction",
    "RigidBody",
    "Rolling",
    "Rope",
    "Slider",
    "Spring",
    "Torque",
    "Transducer",
    "Use",
    "VelocityConstraint",
    "VoltageSource",
    "Weld",
    "Words",
    "deflection_between",
]
