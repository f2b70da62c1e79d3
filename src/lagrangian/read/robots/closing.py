"""Adds to the description of a robot what holds between its positions, and the springs of its tendons."""

from __future__ import annotations

import sympy as sp

from lagrangian.errors import Place
from lagrangian.model import Ball, Constraint, Damper, Frame, Friction, Kinetic, Point, Spring, Weld
from lagrangian.model.names import time
from lagrangian.read.robots.driving import Assembled, tendon_length
from lagrangian.read.robots.robot import RobotEquality, RobotJoint, RobotSite, RobotTendon
from lagrangian.read.robots.rotations import ZERO, FixedPose


class Loops:
    """Adds the equalities and the tendons of a robot to its builder."""

    def __init__(self, assembly: Assembled) -> None:
        self.assembly, self.builder, self.robot = assembly, assembly.builder, assembly.robot

    def add(self) -> list[str]:
        """Add all of them; return in words what holds."""
        for tendon in self.robot.tendons:
            self._tendon(tendon)
        return [self._equality(x) for x in self.robot.equalities]

    # -- equalities ----------------------------------------------------------------------------------------------------

    def _equality(self, given: RobotEquality) -> str:
        if given.kind == "joint":
            return self._coupled(given)
        first, second = (x for x in given.between if isinstance(x, RobotSite))
        name = self._name(given.name or f"{given.kind} {first.link} {second.link}")
        place = given.place
        ends = self._end(first, name, place), self._end(second, f"{name}_2", place)
        between = ends[0][0], ends[1][0]
        if given.kind == "connect":
            self.builder.add(Ball(between=between, name=name, place=place))
        else:
            axes = [self._axes(x, at, key, place) for x, (at, key) in zip((first, second), ends, strict=True)]
            bodies = tuple(frame for frame in axes if frame is not None)  # the ground needs no name
            self.builder.add(Weld(between=between, bodies=bodies, name=name, place=place))
        return f"{name} ({given.kind} {first.link} to {second.link})"

    def _name(self, wanted: str) -> str:
        return self.assembly.names.of(wanted, also="_constraint")

    def _end(self, site: RobotSite, name: str, place: Place) -> tuple[Point, str]:
        """The point of an equality on a link, and the name that its parameters end in."""
        words = ("{}_" + name, f"{name} on {site.link}")
        return self.assembly.point(self.assembly.carriers[site.link], site.pose.offset, words, place), name

    def _axes(self, site: RobotSite, at: Point, name: str, place: Place) -> Frame | None:
        """The frame that is fixed to a link and whose axes are to agree; None for those of the ground."""
        carrier = self.assembly.carriers[site.link]
        frame = carrier.frame
        for turn in FixedPose(ZERO, carrier.turns + site.pose.turns).short.turns:
            angle = self.assembly.angle(turn, name, name, place)
            frame = self.builder.frame(None, angle, axis=turn.axis, parent=frame, origin=at, place=place)
        return frame

    def _coupled(self, given: RobotEquality) -> str:
        """q₁ − ref₁ = Σ a_k (q₂ − ref₂)^k."""
        first, *second = (self.robot.joints[x] for x in given.between if isinstance(x, str))
        x = self._moved(second[0]) if second else sp.S.Zero
        value = sp.Add(*(_exact(a) * x**k for k, a in enumerate(given.coefficients) if a))
        name = self._name(given.name or f"{first.name} with {second[0].name if second else 'its place'}")
        self.builder.add(Constraint(expression=self._moved(first) - value, name=name, place=given.place))
        return f"{name} (joint {first.name}" + (f" follows {second[0].name})" if second else " stays)")

    def _moved(self, joint: RobotJoint) -> sp.Expr:
        """How far a joint is from where the file describes it."""
        return self.assembly.coordinate(joint) - _exact(joint.start)

    # -- tendons -------------------------------------------------------------------------------------------------------

    def _tendon(self, given: RobotTendon) -> None:
        """½ k (L − rest)², a damper, dry friction and ½ J L̇² with L = Σ c q."""
        length, first = tendon_length(self.assembly, given), self.robot.joints[given.parts[0][0]]
        along, name, place = first.kind == "prismatic", self.assembly.names.of(given.name), given.place
        unit = "m" if along else "rad"

        def parameter(letter: str, value: float, units: tuple[str, str], what: str) -> sp.Expr:
            return self.assembly.parameter(
                f"{letter}_{name}", value, units[not along], f"{what} of {given.name}", place
            )

        if given.stiffness:
            k = parameter("k", given.stiffness, ("N/m", "N*m/rad"), "stiffness")
            rest = parameter("rest", given.rest, (unit, unit), "length without force")
            self.builder.add(Spring(k=k, deflection=length, rest=rest, name=f"spring of {given.name}", place=place))
        if given.damping:
            b = parameter("b", given.damping, ("N*s/m", "N*m*s"), "damping")
            self.builder.add(Damper(b=b, deflection=length, name=f"damping of {given.name}", place=place))
        if given.frictionloss:
            limit = parameter("f", given.frictionloss, ("N", "N*m"), "dry friction")
            self.builder.add(Friction(limit=limit, deflection=length, name=f"friction of {given.name}", place=place))
        if given.armature:
            J = parameter("J", given.armature, ("kg", "kg*m^2"), "armature")
            energy = J * sp.Derivative(length, time).doit() ** 2 / 2
            self.builder.add(Kinetic(value=energy, name=f"armature of {given.name}", place=place))


def _exact(value: float) -> sp.Expr:
    """A number of the file, exactly."""
    return sp.Rational(repr(value))
