"""Describes a robot to a `Builder`: a frame and a coordinate for every joint, a body for every link with mass.

Masses, inertias, lengths, damping, friction and angles that are no multiples of 30° or 45° become parameters with the
values of the file, zeros stay zeros. What a fixed joint carries belongs to the frame of the link that carries it.
"""

from __future__ import annotations

import sympy as sp

from lagrangian.errors import Place
from lagrangian.model import (
    Builder,
    Damper,
    Dissipation,
    Floating,
    Force,
    Frame,
    Friction,
    Gravity,
    Kinetic,
    Particle,
    Point,
    RigidBody,
    Spring,
)
from lagrangian.model.names import time
from lagrangian.read.robots.closing import Loops
from lagrangian.read.robots.driving import CarriedBy, Drives
from lagrangian.read.robots.naming import Identifiers
from lagrangian.read.robots.remarks import described, remarks
from lagrangian.read.robots.robot import Inertial, Robot, RobotJoint, RobotLink
from lagrangian.read.robots.rotations import ZERO, FixedPose, FixedTurn, Vector, X, Y, Z, length, turned_tensor

SHOWN = 0.7
"""Where the picture shows a joint with limits, as a part of its range."""

QUATERNION = [c.name.removeprefix("_") for c in (*Floating.named("").coordinates, *Floating.named("").velocities)]
"""The ends of the names that a frame with a quaternion makes."""

NEAR = 0.3
"""An angle [rad] that a joint must reach on both sides of 0 for the picture to choose its pose freely."""


def assembled(robot: Robot) -> Builder:
    """Return the description of a robot; raises `ModelError` with the place of what the description refuses."""
    return Assembly(robot).build()


class Assembly:
    """A robot on its way into a `Builder`."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.builder = Builder(robot.name)
        self.names = Identifiers()
        self.floating: dict[str, Frame] = {}
        self.held: dict[str, Floating] = {}
        self.frames: dict[str, Frame] = {}
        self.coordinates: dict[str, tuple[sp.Expr, ...]] = {}
        self.order = robot.outwards()
        self.centres: dict[str, tuple[Point, sp.Expr]] = {}
        self.carriers = {robot.root: CarriedBy(None, self.builder.origin)}

    def build(self) -> Builder:
        """Coordinates first, because joints may follow later ones; then links from the root outwards."""
        for joint in self.order:
            self._declare(joint)
        carriers = self.carriers
        for joint in self.order:
            carriers[joint.child] = self._carried(joint, carriers[joint.parent])
            self._mass(self.robot.links[joint.child], carriers[joint.child])
        for joint in self.order:
            self._resistance(joint)
            self._spring(joint)
            self._resist_turning(joint)
        driven = Drives(self).add()
        if strength := length(self.robot.gravity):
            g = self.builder.standard_gravity(strength)
            self.builder.add(Gravity(direction=self.robot.gravity, g=g, place=self.robot.place))
            self._lift(g)
        closed = Loops(self).add()
        still = [name for name, carrier in carriers.items() if not carrier.moves and self.robot.links[name].inertial]
        if pose := self._pose():
            self.builder.look["pose"] = pose
        self.builder.remarks.extend(remarks(self.robot, still, self.names.changed, driven, closed))
        return self.builder

    # -- coordinates --------------------------------------------------------------------------------------------

    def _declare(self, joint: RobotJoint) -> None:
        """Declare the coordinates of a joint that moves by itself."""
        if joint.kind == "fixed" or joint.mimic is not None:
            return
        if joint.kind == "floating":
            name = self.names.of(joint.child, ends=("", "_origin", *(f"_{key}" for key in QUATERNION)))
            self.floating[joint.name] = self.builder.floating_frame(name, place=joint.place)
            return
        if joint.kind == "ball":
            name = self.names.of(joint.child, ends=("", *(f"_{key}" for key in QUATERNION if "q" in key or "w" in key)))
            self.held[joint.name] = self.builder.quaternion(name, held=True, place=joint.place)
            return
        if joint.kind == "planar":
            names = [self.names.of(f"{joint.name}_{key}") for key in ("x", "y", "angle")]
        else:
            names = [self.names.of(joint.name)]
        units = {"planar": ("m", "m", "rad"), "prismatic": ("m",)}.get(joint.kind, ("rad",))
        self.coordinates[joint.name] = tuple(
            self.builder.coordinate(name, unit=unit, description=described(joint), place=joint.place).symbol
            for name, unit in zip(names, units, strict=True)
        )

    def coordinate(self, joint: RobotJoint) -> sp.Expr:
        """The coordinate of a joint, that of the joint it follows put in: q = multiplier · q_leader + offset."""
        factor, offset = sp.S.One, sp.S.Zero
        while (mimic := joint.mimic) is not None:
            offset += factor * sp.Rational(repr(mimic.offset))
            factor *= sp.Rational(repr(mimic.multiplier))
            joint = self.robot.joints[mimic.leader]
        return factor * self.coordinates[joint.name][0] + offset

    def _pose(self) -> dict[str, float]:
        """Where the picture shows joints that slide, and those that turn and cannot be near 0: within their limits."""
        found: dict[str, float] = {}
        for joint in self.order:
            low, high = joint.limits.lower, joint.limits.upper
            if (
                joint.name not in self.coordinates
                or joint.kind == "planar"
                or low is None
                or high is None
                or low >= high
            ):
                continue
            if joint.kind == "prismatic" or low > -NEAR or high < NEAR:
                found[self.names.known(joint.name)] = float(f"{low + SHOWN * (high - low):.3g}")
        return found

    # -- frames -------------------------------------------------------------------------------------------------

    def _carried(self, joint: RobotJoint, carrier: CarriedBy) -> CarriedBy:
        """Where the child of a joint is."""
        if joint.kind == "fixed":
            at, turns = carrier.at, FixedPose(ZERO, carrier.turns + joint.pose.turns).short.turns
            if joint.pose.offset != ZERO:
                name = self.names.of(joint.child, also="_point")
                words = ("{}_" + name, f"{joint.child} on {joint.parent}")
                at = self.point(carrier, joint.pose.offset, words, joint.place, name)
            return CarriedBy(carrier.frame, at, turns)
        if joint.kind == "floating":
            frame = self.frames[joint.name] = self.floating[joint.name]
            return CarriedBy(frame, frame.origin)
        own = self.names.known(joint.name)
        at = self.point(carrier, joint.pose.offset, ("{}_" + own, f"joint {joint.name}"), joint.place)
        turns = FixedPose(ZERO, carrier.turns + joint.pose.turns).short.turns
        angle: sp.Expr = sp.S.Zero
        axis = _unit(joint.axis)
        if joint.kind in ("revolute", "continuous"):
            angle = self.coordinate(joint) - self._start(joint, own)
        elif joint.kind == "planar":
            angle = self.coordinates[joint.name][2]
        if turns and angle != 0 and turns[-1].axis == joint.axis:  # two turns about one axis are one
            angle, turns = angle + self.angle(turns[-1], own, f"joint {joint.name}", joint.place), turns[:-1]
        parent = carrier.frame
        for turn in turns:
            fixed = self.angle(turn, own, f"joint {joint.name}", joint.place)
            parent = self.builder.frame(None, fixed, axis=turn.axis, parent=parent, origin=at, place=joint.place)
        if joint.kind == "ball":
            name, held = self.names.known(joint.child), self.held[joint.name]
            frame = self.builder.ball_frame(name, parent=parent, origin=at, declared=held, place=joint.place)
            self.frames[joint.name] = frame
            return CarriedBy(frame, at)
        if joint.kind == "prismatic":
            at = self._moved(at, parent, [n * (self.coordinate(joint) - self._start(joint, own)) for n in axis])
        elif joint.kind == "planar":
            x, y = self.coordinates[joint.name][:2]
            first, second = _across(joint.axis)
            at = self._moved(at, parent, [a * x + b * y for a, b in zip(first, second, strict=True)])
        name = self.names.of(joint.child, also="_link")
        frame = self.builder.frame(name, angle, axis=joint.axis, parent=parent, origin=at, place=joint.place)
        return CarriedBy(frame, at)

    def _moved(self, at: Point, frame: Frame | None, offset: list[sp.Expr]) -> Point:
        return at + tuple(offset) if frame is None else frame.point(*offset, at=at)

    def point(
        self, carrier: CarriedBy, offset: Vector, words: tuple[str, str], place: Place, name: str | None = None
    ) -> Point:
        """The point at ``offset`` in the axes of a link; its lengths are parameters, named and described by words."""
        if offset == ZERO:
            return carrier.at
        pattern, what = words
        lengths = [
            self.parameter(pattern.format(key), value, "m", f"{key} of {what}", place)
            for key, value in zip("xyz", FixedPose(ZERO, carrier.turns).along(offset), strict=True)
        ]
        return self.builder.point(name, lengths, parent=carrier.at, frame=carrier.frame, place=place)

    def angle(self, turn: FixedTurn, name: str, what: str, place: Place) -> sp.Expr:
        """The angle of a constant turn: a multiple of π, or else a parameter, which belongs to ``what``."""
        if (exact := turn.exact).has(sp.pi):
            return exact
        key = {X: "roll", Y: "pitch", Z: "yaw"}.get(turn.axis, "angle")
        return self.parameter(f"{key}_{name}", turn.angle, "rad", f"{key} of {what}", place)

    # -- elements -----------------------------------------------------------------------------------------------

    def parameter(self, name: str, value: float, unit: str | None, what: str, place: Place) -> sp.Expr:
        """A new parameter, or 0 where the value is 0."""
        if value == 0:
            return sp.S.Zero
        return self.builder.parameter(self.names.free(name), value, unit=unit, description=what, place=place).symbol

    def _mass(self, link: RobotLink, carrier: CarriedBy) -> None:
        """Add the body of a link that moves."""
        given = link.inertial
        if given is None or carrier.frame is None:
            return
        name = self.names.known(link.name)
        mass = self.parameter(f"m_{name}", given.mass, "kg", f"mass of {link.name}", given.place)
        centre = ("c{}_" + name, f"centre of mass of {link.name}")
        at = self.point(carrier, given.centre, centre, given.place)
        if not any(any(row) for row in given.inertia):
            self.builder.add(Particle(mass=mass, at=at, name=link.name, place=given.place))
            self.centres[link.name] = at, mass
            return
        self.centres[link.name] = at, mass
        tensor = self._tensor(given, carrier, name, link.name)
        self.builder.add(
            RigidBody(mass=mass, inertia=tensor, at=at, frame=carrier.frame, name=link.name, place=given.place)
        )

    def _lift(self, g: sp.Expr) -> None:
        """Add −lift m g at the centres of mass of links that something else carries in part."""
        down = _unit(self.robot.gravity)
        for name, (at, mass) in self.centres.items():
            link = self.robot.links[name]
            if link.lift:
                known = self.names.known(name)
                share = self.parameter(
                    f"lift_{known}", link.lift, None, f"share of its weight that lifts {name}", link.place
                )
                value = [-share * mass * g * x for x in down]
                self.builder.add(Force(value=value, at=at, name=f"lift of {name}", place=link.place))

    def _tensor(self, given: Inertial, carrier: CarriedBy, name: str, link: str) -> list[list[sp.Expr]]:
        """The inertia in the axes of the frame that carries the link, a parameter for every entry that is not 0."""
        rows = turned_tensor(FixedPose(ZERO, carrier.turns).matrix, given.inertia) if carrier.turns else given.inertia
        entries: dict[tuple[int, int], sp.Expr] = {}
        for i in range(3):
            for j in range(i, 3):
                key = "xyz"[i] + "xyz"[j]
                what = f"inertia of {link} about its centre of mass, {key}"
                made = self.parameter(f"I{key}_{name}", rows[i][j], "kg*m^2", what, given.place)
                entries[i, j] = entries[j, i] = made
        return [[entries[i, j] for j in range(3)] for i in range(3)]

    def _resistance(self, joint: RobotJoint) -> None:
        """Add a damper and dry friction on the coordinate of a joint."""
        if joint.kind in ("fixed", "floating", "planar", "ball"):
            return
        q, name, along = self.coordinate(joint), self.names.known(joint.name), joint.kind == "prismatic"
        if joint.damping:
            unit = "N*s/m" if along else "N*m*s"
            b = self.parameter(f"b_{name}", joint.damping, unit, f"damping of {joint.name}", joint.place)
            self.builder.add(Damper(b=b, deflection=q, name=f"damping of {joint.name}", place=joint.place))
        if joint.friction:
            unit = "N" if along else "N*m"
            limit = self.parameter(f"f_{name}", joint.friction, unit, f"dry friction of {joint.name}", joint.place)
            self.builder.add(Friction(limit=limit, deflection=q, name=f"friction of {joint.name}", place=joint.place))

    def _resist_turning(self, joint: RobotJoint) -> None:
        """Add D = ½ b |ω|² and T* = ½ J |ω|² to a ball joint, ω its angular velocity."""
        if joint.kind != "ball":
            return
        square = sp.Add(*(w**2 for w in self.held[joint.name].angular_velocity))
        name, place = self.names.known(joint.child), joint.place
        if joint.damping:
            b = self.parameter(f"b_{name}", joint.damping, "N*m*s", f"damping of {joint.name}", place)
            self.builder.add(Dissipation(value=b * square / 2, name=f"damping of {joint.name}", place=place))
        if joint.armature:
            J = self.parameter(f"J_{name}", joint.armature, "kg*m^2", f"armature of {joint.name}", place)
            self.builder.add(Kinetic(value=J * square / 2, name=f"armature of {joint.name}", place=place))

    def _start(self, joint: RobotJoint, name: str) -> sp.Expr:
        """The value of the coordinate at the pose of the file."""
        unit = "m" if joint.kind == "prismatic" else "rad"
        return self.parameter(f"ref_{name}", joint.start, unit, f"value of {joint.name} as described", joint.place)

    def _spring(self, joint: RobotJoint) -> None:
        """Add a spring and the inertia of a rotor on the coordinate of a joint."""
        if joint.kind not in ("revolute", "prismatic"):
            return
        q, name, along = self.coordinate(joint), self.names.known(joint.name), joint.kind == "prismatic"
        if joint.stiffness:
            unit = "N/m" if along else "N*m/rad"
            k = self.parameter(f"k_{name}", joint.stiffness, unit, f"stiffness of {joint.name}", joint.place)
            unit = "m" if along else "rad"
            rest = self.parameter(f"rest_{name}", joint.rest, unit, f"where {joint.name} relaxes", joint.place)
            said = f"spring of {joint.name}"
            self.builder.add(Spring(k=k, deflection=q, rest=rest, name=said, place=joint.place))
        if joint.armature:
            unit = "kg" if along else "kg*m^2"
            J = self.parameter(f"J_{name}", joint.armature, unit, f"armature of {joint.name}", joint.place)
            rate = sp.Derivative(q, time)
            self.builder.add(Kinetic(value=J * rate**2 / 2, name=f"armature of {joint.name}", place=joint.place))


def _unit(axis: Vector) -> list[sp.Expr]:
    """The axis with length 1, exactly."""
    exact = [sp.Rational(repr(x)) for x in axis]
    size = sp.sqrt(sum((x**2 for x in exact), sp.S.Zero))
    return [x / size for x in exact]


def _across(axis: Vector) -> tuple[list[sp.Expr], list[sp.Expr]]:
    """Two directions that make a right-handed system with an axis: x and y for the axis z."""
    n = sp.Matrix(_unit(axis))
    least = min(range(3), key=lambda k: (abs(axis[k]), (k - 2) % 3))
    helper = sp.Matrix([int(k == least) for k in range(3)])
    second = n.cross(helper)
    second = second / sp.sqrt(second.dot(second))
    return list(second.cross(n)), list(second)
