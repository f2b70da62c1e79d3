"""What drives a robot: an input for every actuator, and for joints that have none, if the file leaves them to us.

Ξ = gear · e,    e = (g₀ + g₁ L + g₂ L̇) u + b₀ + b₁ L + b₂ L̇,    L = gear · q
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import sympy as sp

from lagrangian.errors import Place
from lagrangian.model import Builder, Floating, Force, Frame, Point, Torque
from lagrangian.model.names import time
from lagrangian.read.robots.naming import Identifiers, identifier
from lagrangian.read.robots.robot import Robot, RobotActuator, RobotJoint, RobotSite, RobotTendon
from lagrangian.read.robots.rotations import ZERO, FixedPose, FixedTurn, Vector
from lagrangian.records import dataclass

TURNING_OR_SLIDING = ("revolute", "continuous", "prismatic")
ALONG, ABOUT = ("N", "N/m", "N*s/m", "m", "m/s"), ("N*m", "N*m/rad", "N*m*s", "rad", "rad/s")
"""The units of effort, stiffness and damping, of L and of L̇ where something slides, and where it turns."""


@dataclass(frozen=True)
class CarriedBy:
    """Where a link is: its origin ``at``, and its axes after ``turns`` from a frame's; no frame is the ground."""

    frame: Frame | None
    at: Point
    turns: tuple[FixedTurn, ...] = ()

    @property
    def moves(self) -> bool:
        """Whether the link moves."""
        return self.frame is not None


class Assembled(Protocol):
    """A robot whose joints, links and masses are described: by name its frames, ball joints, coordinates, carriers."""

    robot: Robot
    builder: Builder
    names: Identifiers
    order: list[RobotJoint]
    held: dict[str, Floating]
    frames: dict[str, Frame]
    coordinates: dict[str, tuple[sp.Expr, ...]]
    carriers: dict[str, CarriedBy]

    def coordinate(self, joint: RobotJoint) -> sp.Expr:
        """The coordinate of a joint."""
        ...

    def parameter(self, name: str, value: float, unit: str | None, what: str, place: Place) -> sp.Expr:
        """A new parameter, or 0 where the value is 0."""
        ...

    def point(
        self, carrier: CarriedBy, offset: Vector, words: tuple[str, str], place: Place, name: str | None = None
    ) -> Point:
        """The point at an offset in the axes of a link."""
        ...

    def angle(self, turn: FixedTurn, name: str, what: str, place: Place) -> sp.Expr:
        """The angle of a constant turn, which belongs to ``what``."""
        ...


def tendon_length(assembly: Assembled, tendon: RobotTendon) -> sp.Expr:
    """L = Σ c q."""
    parts = ((sp.Rational(repr(c)), assembly.robot.joints[name]) for name, c in tendon.parts)
    return sp.Add(*(c * assembly.coordinate(joint) for c, joint in parts))


class Drives:
    """Adds the inputs of a robot and their forces to its builder."""

    def __init__(self, assembly: Assembled) -> None:
        self.assembly, self.builder, self.names = assembly, assembly.builder, assembly.names
        self.robot = assembly.robot

    def add(self) -> list[str]:
        """Add all inputs; return in words what each actuator drives."""
        driven = {x.target for x in self.robot.actuators if isinstance(x.target, str)}
        for joint in self.assembly.order:
            if joint.name not in driven and not self.robot.passive:
                self._joint(joint)
        said: list[str] = []
        for actuator in self.robot.actuators:
            u = self._actuator(actuator)
            said.append(f"{u} drives {self._where(actuator)}" + (f" ({actuator.words})" if actuator.words else ""))
        return said

    # -- joints without an actuator --------------------------------------------------------------------------------

    def _joint(self, joint: RobotJoint) -> None:
        """Add an input for every coordinate of a joint that moves by itself, three moments for a ball joint."""
        if joint.kind == "ball":
            frame, name = self.assembly.frames[joint.name], self.names.known(joint.child)
            about = f"on {name} about its own"
            moments = [self._input(f"tau_{name}_{k}", "N*m", f"torque {about} {k}", joint) for k in "xyz"]
            self.builder.add(Torque(value=moments, on=frame, reaction=frame.parent, axes=frame, place=joint.place))
            return
        for q in self.assembly.coordinates.get(joint.name, ()):
            coordinate = next(c for c in self.builder.coordinates if c.symbol == q)
            name, along = coordinate.name, coordinate.unit == "m"
            unit, letter, what = ("N", "F", "force") if along else ("N*m", "tau", "torque")
            bound = "" if joint.limits.effort is None else f", at most {joint.limits.effort:g} {unit.replace('*', ' ')}"
            u = self._input(f"{letter}_{name}", unit, f"{what} on {name}{bound}", joint)
            self.builder.add(
                Force(value=u, deflection=q, place=joint.place) if along else Torque(value=u, on=q, place=joint.place)
            )

    def _input(self, name: str, unit: str | None, words: str, source: RobotJoint | RobotActuator) -> sp.Expr:
        return self.builder.input(self.names.free(name), unit=unit, description=words, place=source.place).symbol

    # -- actuators ------------------------------------------------------------------------------------------------

    def _where(self, actuator: RobotActuator) -> str:
        target = actuator.target
        if isinstance(target, RobotTendon):
            return f"tendon {target.name}"
        return f"a point of {target.link}" if isinstance(target, RobotSite) else target

    def _joint_of(self, actuator: RobotActuator) -> RobotJoint | None:
        """The joint that an actuator drives, of a tendon its first one (they are of one kind); None for a site."""
        target = actuator.target
        if isinstance(target, RobotSite):
            return None
        return self.robot.joints[target if isinstance(target, str) else target.parts[0][0]]

    def _length(self, actuator: RobotActuator, joint: RobotJoint) -> sp.Expr:
        """What an actuator of a hinge, a slide or a tendon moves."""
        if isinstance(actuator.target, RobotTendon):
            return tendon_length(self.assembly, actuator.target)
        return self.assembly.coordinate(joint)

    def _actuator(self, actuator: RobotActuator) -> str:
        """Add the input of an actuator, and what it does; return the name of the input."""
        joint = self._joint_of(actuator)
        units = ALONG if joint is not None and joint.kind == "prismatic" else ABOUT
        scalar = joint is not None and joint.kind in TURNING_OR_SLIDING
        unit = {"motor": units[0], "position servo": units[3], "velocity servo": units[4]}.get(actuator.kind)
        words = f"{actuator.kind} of {self._where(actuator)}"
        u = self._input(self._name(actuator, joint), unit if scalar else None, words, actuator)
        label = u.func.__name__
        gear = [
            self._number(f"gear{'' if scalar else k}_{label}", x, None, f"gear of {label}", actuator)
            for k, x in enumerate(self._gear(actuator, joint), 1)
        ]
        L, rate = sp.S.Zero, sp.S.Zero
        if joint is not None and scalar:
            L = gear[0] * self._length(actuator, joint)
            rate = sp.diff(L, time)
        elif joint is not None and joint.kind == "ball":
            omega = self.assembly.held[joint.name].angular_velocity
            rate = sp.Add(*(x * w for x, w in zip(gear, omega, strict=True)))
        effort = self._effort(actuator, label, units, (u, L, rate))
        self._apply(actuator, joint, [x * effort for x in gear])
        return label

    def _effort(
        self, actuator: RobotActuator, label: str, units: Sequence[str], values: tuple[sp.Expr, sp.Expr, sp.Expr]
    ) -> sp.Expr:
        """e of u, L and L̇: k (u − L) − d L̇ for a servo of position, k (u − L̇) for one of velocity."""
        u, L, rate = values
        effort, stiffness, damping = units[:3]

        def number(name: str, value: float, unit: str) -> sp.Expr:
            return self._number(f"{name}_{label}", value, unit, f"{name} of {label}", actuator)

        (g0, g1, g2), (b0, b1, b2) = actuator.gain, actuator.bias
        offset = number("bias0", b0, effort)
        if actuator.kind == "position servo":
            return number("kp", g0, stiffness) * (u - L) - number("kv", -b2, damping) * rate + offset
        if actuator.kind == "velocity servo":
            return number("kv", g0, damping) * (u - rate) + offset
        if actuator.kind == "motor":
            return u
        gain = number("gain0", g0, effort) + number("gain1", g1, stiffness) * L + number("gain2", g2, damping) * rate
        return gain * u + offset + number("bias1", b1, stiffness) * L + number("bias2", b2, damping) * rate

    def _number(self, name: str, value: float, unit: str | None, what: str, source: RobotActuator) -> sp.Expr:
        """A number of an actuator: a parameter, unless it is 0, or a 1 or −1 without a unit that would get lost."""
        if not value or (unit is None and abs(value) == 1.0):
            return sp.Integer(int(value))
        return self.assembly.parameter(name, value, unit, what, source.place)

    def _name(self, actuator: RobotActuator, joint: RobotJoint | None) -> str:
        """The name of an input: that of its actuator if it is free, else one with ``u_``, or that of a motor."""
        if actuator.name:
            own = identifier(actuator.name)
            return self.names.unused(own) or self.names.unused(f"u_{own}") or f"u_{own}"
        if joint is None or isinstance(actuator.target, RobotTendon):
            return f"u_{identifier(self._where(actuator))}"
        letter = "u" if actuator.kind != "motor" else "F" if joint.kind == "prismatic" else "tau"
        return f"{letter}_{self.names.known(joint.name)}"

    def _gear(self, actuator: RobotActuator, joint: RobotJoint | None) -> list[float]:
        """The gear along the axes in which it acts: for a site, those of the frame that carries it."""
        gear, target = actuator.gear, actuator.target
        if isinstance(target, RobotSite):
            turns = FixedPose(ZERO, (*self.assembly.carriers[target.link].turns, *target.pose.turns))
            fx, fy, fz, mx, my, mz = gear
            return [*turns.along((fx, fy, fz)), *turns.along((mx, my, mz))]
        return list(gear)

    def _apply(self, actuator: RobotActuator, joint: RobotJoint | None, efforts: Sequence[sp.Expr]) -> None:
        """Add the force or torque of an actuator, or both."""
        add, place = self.builder.add, actuator.place
        if joint is None:
            self._push(actuator, efforts)
        elif joint.kind in TURNING_OR_SLIDING:
            q, (effort,) = self._length(actuator, joint), efforts
            along = joint.kind == "prismatic"
            add(Force(value=effort, deflection=q, place=place) if along else Torque(value=effort, on=q, place=place))
        elif joint.kind == "ball":
            frame = self.assembly.frames[joint.name]
            axes = frame.parent if actuator.in_parent else frame
            add(Torque(value=efforts, on=frame, reaction=frame.parent, axes=axes, place=place))
        else:  # a body that floats: a force along the fixed axes, a moment about its own
            frame = self.assembly.frames[joint.name]
            if any(efforts[:3]):
                add(Force(value=efforts[:3], at=frame.origin, place=place))
            if any(efforts[3:]):
                axes = None if actuator.in_parent else frame
                add(Torque(value=efforts[3:], on=frame, axes=axes, place=place))

    def _push(self, actuator: RobotActuator, efforts: Sequence[sp.Expr]) -> None:
        """Add the force and the moment of an actuator at a site."""
        site, place = actuator.target, actuator.place
        assert isinstance(site, RobotSite)
        carrier = self.assembly.carriers[site.link]
        assert carrier.frame is not None
        if any(efforts[:3]):
            label = self.names.free(f"site_{identifier(actuator.name or site.link)}")
            words = ("{}_" + label, f"where {actuator.name or 'an actuator'} pushes")
            at = self.assembly.point(carrier, site.pose.offset, words, place)
            self.builder.add(Force(value=efforts[:3], at=at, axes=carrier.frame, place=place))
        if any(efforts[3:]):
            self.builder.add(Torque(value=efforts[3:], on=carrier.frame, axes=carrier.frame, place=place))
