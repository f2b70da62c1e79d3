"""Reads MJCF, the format of MuJoCo: bodies within bodies, their joints, and masses given or found from geoms.

Every joint of a body carries the next one: a body with several joints is a chain of links, of which the last has the
mass.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from pathlib import Path

from lagrangian.quantities.source import shown
from lagrangian.read.robots.actuators import Actuators
from lagrangian.read.robots.equalities import Equalities
from lagrangian.read.robots.left_out import left_out
from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.meshes import Meshes
from lagrangian.read.robots.mjcf_expanded import expand
from lagrangian.read.robots.mjcf_masses import Masses, scaled
from lagrangian.read.robots.mjcf_tags import Defaults, Orientations
from lagrangian.read.robots.robot import JointKind, JointLimits, Robot, RobotJoint, RobotLink
from lagrangian.read.robots.rotations import ZERO, FixedPose, Vector, X, Z, length
from lagrangian.read.robots.tendons import Tendons
from lagrangian.read.robots.tree import checked_tree
from lagrangian.records import dataclass, field

GROUND = "world"
KINDS: dict[str, JointKind] = {"hinge": "revolute", "slide": "prismatic", "free": "floating", "ball": "ball"}
REFUSED = {
    "composite": "write the bodies out",
    "flexcomp": "bodies that bend are not read",
    "attach": "put the other model in its place",
}
CHANGING = ("balanceinertia", "boundmass", "boundinertia", "inertiagrouprange", "coordinate")


DISABLING = ("spring", "damper", "passive", "actuation", "clampctrl")
"""Flags that change the motion where they are disabled."""


def read_mjcf(root: Tag, folder: Path | None = None) -> Robot:
    """Return the robot in the tree of a file; raises `ParseError` with the place of what is wrong.

    Meshes whose mass is asked for are read from the file's ``folder``; without one they are refused.
    """
    root.read = True
    expand(root, folder)
    _check_supported(root)
    reader = Reader.of(root, folder)
    world = root.need("worldbody", "<worldbody> … </worldbody>")
    _check_supported(world)
    reader.links[GROUND] = RobotLink(GROUND, None, world.place)
    reader.below(world, GROUND, "main")
    if reader.total:
        scaled(reader.links, reader.total)
    top = checked_tree(root, reader.links, reader.joints)
    tendons = Tendons(root, reader.joints)
    drives = Actuators(root, reader.joints, reader.sites, tendons, reader.orientations)
    held = Equalities(root, GROUND, reader.joints, reader.sites, reader.orientations)
    return Robot(
        (root.get("model") or "").strip() or "robot",
        reader.links,
        reader.joints,
        top,
        tuple(left_out(root)),
        reader.gravity,
        root.place,
        actuators=tuple(drives.found),
        unread=tuple(drives.unread),
        passive=bool(drives.found),
        equalities=tuple(held.found),
        tendons=tuple(tendons.acting),
        inactive=tuple(held.unread),
    )


def _check_supported(tag: Tag) -> None:
    """Raise an error for what a tag contains that is not supported."""
    for key, fix in REFUSED.items():
        for wrong in tag.all(key):
            raise wrong.error(f"<{key}> is not supported", fix, "E405")


@dataclass
class Reader:
    """The bodies of one file, on their way into links and joints."""

    defaults: Defaults
    orientations: Orientations
    gravity: Vector
    masses: Masses
    total: float = 0.0
    links: dict[str, RobotLink] = field(default_factory=dict[str, RobotLink])
    joints: dict[str, RobotJoint] = field(default_factory=dict[str, RobotJoint])
    sites: dict[str, tuple[Tag, str]] = field(default_factory=dict[str, "tuple[Tag, str]"])

    @classmethod
    def of(cls, root: Tag, folder: Path | None) -> Reader:
        """Read what the file says of all its bodies."""
        degree, sequence, from_geoms, total = math.pi / 180, "xyz", "auto", 0.0
        defaults = Defaults.of(root)
        meshes = Meshes(defaults, folder)
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
            total = max(0.0, tag.number("settotalmass", total))
            meshes.directory = tag.get("meshdir") or tag.get("assetdir") or meshes.directory
            meshes.base_name_only = tag.get("strippath") == "true" or meshes.base_name_only
            meshes.exact = tag.get("exactmeshinertia") == "true" or meshes.exact
        meshes.collect(root)
        gravity = (0.0, 0.0, -9.81)
        for tag in root.all("option"):
            x, y, z = tag.vector("gravity", gravity)
            gravity = (x, y, z)
            for key in ("wind", "density", "viscosity"):
                if any(tag.vector(key, (0.0,), (1, 3))):
                    raise tag.error(f"'{key}' is not supported", "add the force of the air to the system", "E405", key)
            for flag in tag.all("flag"):
                for key in DISABLING:
                    if flag.get(key) == "disable":
                        raise flag.error(f"'{key}' cannot be disabled", "leave it out of the file", "E405", key)
                gravity = (0.0, 0.0, 0.0) if flag.get("gravity") == "disable" else gravity
        orientations = Orientations(degree, sequence)
        masses = Masses(defaults, orientations, meshes, from_geoms)
        return cls(defaults, orientations, gravity, masses, total)

    def below(self, tag: Tag, parent: str, inherited: str) -> None:
        """Read the sites of a link and the bodies within its tag, whose class of defaults they inherit."""
        for site in (x for x in tag.children if x.name == "site" and x.attributes.get("name")):
            self.sites[self._new(site, site.attributes["name"], self.sites, "site")] = site, parent
        for body in tag.all("body"):
            _check_supported(body)
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
        inertial, lift = self.masses.inertial(body, inherited), body.number("gravcomp", 0.0)
        self.links[name] = RobotLink(name, inertial, body.place, lift)
        if any(kind == "free" for _, kind in moving) and (len(moving) > 1 or parent != GROUND):
            what = "a body that floats has one joint, and no body carries it"
            raise moving[0][0].error(what, "put it at the top, without other joints", "E405")
        if not moving:
            self._add(RobotJoint(f"{name}_fixed", "fixed", parent, name, at, X, body.place), body)
        for number, (tag, kind) in enumerate(moving, 1):
            if kind not in KINDS:
                raise tag.error(f"there is no joint {shown(kind)}", f"known: {', '.join(KINDS)}", "E405", "type")
            joint = (tag.get("name") or "").strip() or (
                f"{name}_joint" if len(moving) == 1 else f"{name}_joint{number}"
            )
            child = name if number == len(moving) else f"{name}_{joint}"
            x, y, z = FixedPose(self._vector(tag, "pos", ZERO)).within(self.orientations.moved(tag)).offset
            shifted = any((x, y, z)) and kind in ("hinge", "ball")
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
    def _vector(tag: Tag, key: str, default: Vector) -> Vector:
        x, y, z = tag.vector(key, default)
        return x, y, z

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
        x, y, z = self.orientations.moved(tag).along(self._vector(tag, "axis", Z))
        if kind not in ("floating", "ball") and length((x, y, z)) == 0:
            raise tag.error("the axis is (0, 0, 0)", 'axis="0 0 1"', "E409", "axis")
        unit = self.orientations.degree if kind in ("revolute", "ball") else 1.0
        values = {key: tag.number(key, 0.0) for key in ("damping", "frictionloss", "stiffness", "armature")}
        for key, value in values.items():
            if value < 0:
                raise tag.error(f"the {key} is negative ({value:g})", "give 0 or more", "E406", key)
        if kind == "floating" and any(values.values()):
            what = "damping, friction, springs and armature of a body that floats are not supported"
            raise tag.error(what, "write <freejoint/>, which has none", "E405")
        if kind == "ball" and (values["stiffness"] or values["frictionloss"]):
            what = "springs and friction of a ball joint are not supported"
            raise tag.error(what, "leave them out, and add their energy or force to the system", "E405")
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
