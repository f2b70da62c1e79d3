"""Reads MJCF, the format of MuJoCo: bodies within bodies, their joints, and masses given or found from geoms.

Every joint of a body carries the next one: a body with several joints is a chain of links, of which the last has the
mass.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass

from lagrangian.quantities.source import shown
from lagrangian.read.robots.left_out import left_out
from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.mjcf_tags import Defaults, Orientations, between
from lagrangian.read.robots.robot import Inertial, JointKind, JointLimits, Robot, RobotJoint, RobotLink
from lagrangian.read.robots.rotations import FixedPose, Vector, X, Z, length, turned_tensor
from lagrangian.read.robots.solids import Solid, solid, together, volume
from lagrangian.read.robots.tree import checked_tree

GROUND = "world"
DENSITY = 1000.0
"""The density of a geom [kg/m³] unless it is given."""

KINDS: dict[str, JointKind] = {"hinge": "revolute", "slide": "prismatic", "free": "floating"}
SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "box": 3, "ellipsoid": 3}
WITHOUT_MASS = ("plane", "hfield")
REFUSED = {
    "include": "nothing outside the file is read: put the text of that file in its place",
    "equality": "constraints are not read from a file: add them with system.constraint, pin, ball or weld",
    "tendon": "tendons are not read: add their springs and constraints to the system",
    "frame": "put its position and orientation into what it contains",
    "replicate": "write the copies out",
    "composite": "write the bodies out",
    "flexcomp": "bodies that bend are not read",
    "attach": "put the other model in its place",
}
CHANGING = ("settotalmass", "balanceinertia", "boundmass", "boundinertia", "inertiagrouprange", "coordinate")


def read_mjcf(root: Tag) -> Robot:
    """Return the robot in the tree of a file; raises `ParseError` with the place of what is wrong."""
    root.read = True
    for key, fix in REFUSED.items():
        for tag in root.all(key):
            raise tag.error(f"<{key}> is not supported", fix, "E405")
    reader = Reader.of(root)
    world = root.need("worldbody", "<worldbody> … </worldbody>")
    reader.links[GROUND] = RobotLink(GROUND, None, world.place)
    reader.below(world, GROUND, "main")
    top = checked_tree(root, reader.links, reader.joints)
    name = (root.get("model") or "").strip() or "robot"
    return Robot(name, reader.links, reader.joints, top, tuple(left_out(root)), reader.gravity, root.place)


@dataclass
class Reader:
    """The bodies of one file, on their way into links and joints."""

    defaults: Defaults
    orientations: Orientations
    gravity: Vector
    from_geoms: str
    links: dict[str, RobotLink]
    joints: dict[str, RobotJoint]

    @classmethod
    def of(cls, root: Tag) -> Reader:
        """Read what the file says of all its bodies."""
        degree, sequence, from_geoms = math.pi / 180, "xyz", "auto"
        for tag in root.all("compiler"):
            for key in CHANGING:
                if tag.get(key) not in (None, "-1", "0", "false", "local"):
                    raise tag.error(f"'{key}' is not supported", "write the masses themselves", "E405", key)
            degree = 1.0 if tag.get("angle") == "radian" else degree if tag.get("angle") in (None, "degree") else 0.0
            if not degree:
                raise tag.error("'angle' is neither degree nor radian", 'write angle="radian"', "E406", "angle")
            sequence, from_geoms = tag.get("eulerseq") or sequence, tag.get("inertiafromgeom") or from_geoms
            if len(sequence) != 3 or (set(sequence) - set("xyz") and set(sequence) - set("XYZ")):
                raise tag.error("'eulerseq' is not three of x, y, z or X, Y, Z", 'eulerseq="xyz"', "E406", "eulerseq")
        gravity = (0.0, 0.0, -9.81)
        for tag in root.all("option"):
            x, y, z = tag.vector("gravity", gravity)
            gravity = (x, y, z)
            for key in ("wind", "density", "viscosity"):
                if any(tag.vector(key, (0.0,), (1, 3))):
                    raise tag.error(f"'{key}' is not supported", "add the force of the air to the system", "E405", key)
        return cls(Defaults.of(root), Orientations(degree, sequence), gravity, from_geoms, {}, {})

    def below(self, tag: Tag, parent: str, inherited: str) -> None:
        """Read the bodies within a tag, whose class of defaults they inherit."""
        for body in tag.all("body"):
            for key, fix in REFUSED.items():
                for wrong in body.all(key):
                    raise wrong.error(f"<{key}> is not supported", fix, "E405")
            if body.number("gravcomp", 0.0):
                raise body.error("'gravcomp' is not supported", "add the force to the system", "E405", "gravcomp")
            own = body.get("childclass") or inherited
            name = self._new(body, body.get("name") or f"body{len(self.links)}", self.links, "body")
            self._chain(body, name, parent, own)
            self.below(body, name, own)

    def _new(self, tag: Tag, name: str, taken: Collection[str], what: str) -> str:
        if name in taken:
            raise tag.error(f"there are two of the name {shown(name)}", f"give the {what} another name", "E404", "name")
        return name

    def _chain(self, body: Tag, name: str, parent: str, inherited: str) -> None:
        """The joints of a body, one carrying the next; without any it is fixed to its parent."""
        at = self.orientations.pose(body)
        tags = [self.defaults.put_into(tag, inherited) for tag in body.all("joint")]
        free = body.all("freejoint")
        moving = [(tag, tag.get("type") or "hinge") for tag in tags] + [(tag, "free") for tag in free]
        self.links[name] = RobotLink(name, self._inertial(body, inherited), body.place)
        if any(kind == "free" for _, kind in moving) and (len(moving) > 1 or parent != GROUND):
            what = "a body that floats has one joint, and no body carries it"
            raise moving[0][0].error(what, "put it at the top, without other joints", "E405")
        if not moving:
            self._add(RobotJoint(f"{name}_fixed", "fixed", parent, name, at, X, body.place), body)
        for number, (tag, kind) in enumerate(moving, 1):
            if kind not in KINDS:
                fix = "three hinges about x, y and z at the same point move likewise, but for one position"
                what = "a ball joint is not supported yet" if kind == "ball" else f"there is no joint {shown(kind)}"
                raise tag.error(what, fix if kind == "ball" else "known: hinge, slide, free", "E405", "type")
            joint = (tag.get("name") or "").strip() or (
                f"{name}_joint" if len(moving) == 1 else f"{name}_joint{number}"
            )
            child = name if number == len(moving) else f"{name}_{joint}"
            x, y, z = tag.vector("pos", (0.0, 0.0, 0.0))
            shifted = any((x, y, z)) and kind == "hinge"
            if shifted:  # the joint is elsewhere than the origin of the body, which follows it
                at = FixedPose(self._sum(at, (x, y, z)), at.turns)
            end = f"{child}_on_{joint}" if shifted else child
            if end != child or child != name:
                self.links[self._new(tag, end, self.links, "body")] = RobotLink(end, None, tag.place)
            self._add(self._joint(tag, joint, KINDS[kind], parent, end, at), tag)
            if shifted:
                if child != name:
                    self.links[self._new(tag, child, self.links, "body")] = RobotLink(child, None, tag.place)
                back = FixedPose((-x, -y, -z))
                self._add(RobotJoint(f"{joint}_back", "fixed", end, child, back, X, tag.place), tag)
            parent, at = child, FixedPose()

    @staticmethod
    def _sum(at: FixedPose, inner: Vector) -> Vector:
        x, y, z = (float(f"{a + b:.15g}") for a, b in zip(at.offset, at.along(inner), strict=True))
        return x, y, z

    def _add(self, joint: RobotJoint, tag: Tag) -> None:
        self.joints[self._new(tag, joint.name, self.joints, "joint")] = joint

    def _joint(self, tag: Tag, name: str, kind: JointKind, parent: str, child: str, at: FixedPose) -> RobotJoint:
        """A joint with its resistance, its spring and its armature."""
        if tag.get("springdamper") is not None:
            raise tag.error("'springdamper' is not supported", "give stiffness and damping", "E405", "springdamper")
        x, y, z = tag.vector("axis", Z)
        if kind != "floating" and length((x, y, z)) == 0:
            raise tag.error("the axis is (0, 0, 0)", 'axis="0 0 1"', "E409", "axis")
        unit = self.orientations.degree if kind == "revolute" else 1.0
        values = {key: tag.number(key, 0.0) for key in ("damping", "frictionloss", "stiffness", "armature")}
        for key, value in values.items():
            if value < 0:
                raise tag.error(f"the {key} is negative ({value:g})", "give 0 or more", "E406", key)
        if kind == "floating" and any(values.values()):
            what = "damping, friction, springs and armature of a body that floats are not supported"
            raise tag.error(what, "write <freejoint/>, which has none", "E405")
        limits = JointLimits()
        if tag.get("range") is not None:
            lower, upper = tag.vector("range", (0.0, 0.0), (2,))
            limits = JointLimits(lower * unit, upper * unit)
        return RobotJoint(
            name,
            kind,
            parent,
            child,
            at,
            (x, y, z),
            tag.place,
            damping=values["damping"],
            friction=values["frictionloss"],
            limits=limits,
            stiffness=values["stiffness"],
            rest=tag.number("springref", 0.0) * unit,
            start=tag.number("ref", 0.0) * unit,
            armature=values["armature"],
        )

    # -- masses -------------------------------------------------------------------------------------------------

    def _inertial(self, body: Tag, inherited: str) -> Inertial | None:
        """The mass of a body, from <inertial> or from its geoms."""
        given = body.one("inertial")
        if given is not None and self.from_geoms != "true":
            return self._given(given)
        geoms = [self.defaults.put_into(tag, inherited) for tag in body.all("geom")]
        solids = [] if self.from_geoms == "false" else list(self._solids(geoms))
        if not solids:
            return None
        all_of_them = together(solids)
        return Inertial(all_of_them.mass, all_of_them.centre, all_of_them.inertia, body.place)

    def _given(self, tag: Tag) -> Inertial:
        at, mass = self.orientations.pose(tag), tag.number("mass")
        if mass <= 0:
            raise tag.error(f"the mass is {mass:g} kg", "give a mass above 0", "E103" if mass == 0 else "E102", "mass")
        xx, yy, zz, xy, xz, yz = (*tag.vector("diaginertia", (0.0, 0.0, 0.0)), 0.0, 0.0, 0.0)
        if tag.get("fullinertia") is not None:
            xx, yy, zz, xy, xz, yz = tag.vector("fullinertia", (), (6,))
        rows = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
        return Inertial(mass, at.offset, turned_tensor(at.matrix, rows), tag.place)

    def _solids(self, geoms: list[Tag]) -> Iterator[Solid]:
        """The geoms with mass, as solids in the axes of their body."""
        for tag in geoms:
            kind = tag.get("type") or ("mesh" if tag.get("mesh") is not None else "sphere")
            mass = None if tag.get("mass") is None else tag.number("mass")
            density = tag.number("density", DENSITY)
            if kind in WITHOUT_MASS or mass == 0 or (mass is None and density == 0):
                continue
            if kind not in SIZES or tag.get("shellinertia") == "true":
                fix = 'give the body an <inertial>, or the geom mass="0"'
                raise tag.error(f"the mass of a {kind} or a shell is not found from its shape", fix, "E405")
            if (mass is not None and mass < 0) or density < 0:
                raise tag.error("the mass is negative", "give a mass above 0", "E102")
            size, at = self._size(tag, kind)
            made = solid(kind, size, mass if mass is not None else density * volume(kind, size))
            yield (
                made.placed(at.offset, at.matrix)
                if tag.get("fromto") is None
                else self._stretched(tag, kind, made, size)
            )

    def _size(self, tag: Tag, kind: str) -> tuple[Vector, FixedPose]:
        """Radii and half lengths, of which fromto gives the last."""
        needed = SIZES[kind]
        if tag.get("size") is None:
            raise tag.error("the attribute 'size' is missing", f"give {needed} numbers", "E401")
        values = tag.vector("size", (), (1, 2, 3))
        if tag.get("fromto") is not None:
            ends = tag.vector("fromto", (), (6,))
            half = between(ends[:3], ends[3:])[2]
            values = (values[0], half) if needed == 2 else (values[0], values[min(1, len(values) - 1)], half)
        if len(values) < needed or min(values[:needed]) <= 0:
            raise tag.error(
                f"a {kind} needs {needed} positive sizes", "radii and half lengths, in metres", "E414", "size"
            )
        a, b, c = (*values[:needed], 0.0, 0.0)[:3]
        return (a, b, c), self.orientations.pose(tag)

    def _stretched(self, tag: Tag, kind: str, made: Solid, size: Vector) -> Solid:
        """A geom that leads from one point to another."""
        if kind == "sphere":
            raise tag.error("a sphere leads from nowhere to nowhere", "leave fromto out", "E405", "fromto")
        ends = tag.vector("fromto", (), (6,))
        centre, axes, _ = between(ends[:3], ends[3:])
        return made.placed(centre, axes)
