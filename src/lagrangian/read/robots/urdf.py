"""Reads URDF, the Unified Robot Description Format of ROS: links with inertias, joined to a tree by joints."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TypeVar, cast, get_args

from lagrangian.errors import ParseError, did_you_mean
from lagrangian.quantities.source import shown
from lagrangian.read.robots.left_out import left_out
from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.robot import Inertial, JointKind, JointLimits, Mimic, Robot, RobotJoint, RobotLink
from lagrangian.read.robots.rotations import ZERO, FixedPose, Rows, X, fixed_axes, length, turned_tensor
from lagrangian.read.robots.transmissions import Transmissions
from lagrangian.read.robots.tree import check_count, checked_tree

KINDS = tuple(kind for kind in get_args(JointKind) if kind != "ball")
NO_AXIS = ("fixed", "floating")
Named = TypeVar("Named", RobotLink, RobotJoint)
_SMALL = 1e-12
"""A component of an axis is 0 if it is smaller than this part of its length: it is the rounding of a program."""


def read_urdf(root: Tag) -> Robot:
    """Return the robot in the tree of a file; raises `ParseError` with the place of what is wrong."""
    root.read = True
    name = (root.get("name") or "").strip() or "robot"
    check_count(root, len(root.all("link")))
    links = dict(_once(((tag, _link(tag)) for tag in root.all("link")), "link"))
    joints = dict(_once(((tag, _joint(tag)) for tag in root.all("joint")), "joint"))
    if not links:
        raise root.error("the robot has no links", 'write <link name="base"/> and its joints', "E401")
    _check_ends(root, links, joints)
    top = checked_tree(root, links, joints)
    _check_mimics(joints)
    drives = Transmissions(root, joints)
    return Robot(
        name,
        links,
        joints,
        top,
        tuple(left_out(root)),
        place=root.place,
        actuators=tuple(drives.found),
        unread=tuple(drives.unread),
    )


def _once(found: Iterable[tuple[Tag, Named]], what: str) -> Iterator[tuple[str, Named]]:
    """The things by name, none of which may occur twice."""
    lines: dict[str, int | None] = {}
    for tag, thing in found:
        if thing.name in lines:
            said = f"there are two {what}s named {shown(thing.name)} (the other in line {lines[thing.name]})"
            raise tag.error(said, "rename one of them", "E404", "name")
        lines[thing.name] = tag.place.line
        yield thing.name, thing


# -- links --------------------------------------------------------------------------------------------------------


def _link(tag: Tag) -> RobotLink:
    name = tag.word("name", "upper_arm")
    inertial = tag.one("inertial")
    return RobotLink(name, None if inertial is None else _inertial(inertial, name), tag.place)


def _inertial(tag: Tag, link: str) -> Inertial | None:
    """The mass and inertia of a link; None if all of it is 0."""
    pose = _pose(tag)
    mass_tag = tag.need("mass", '<mass value="1.2"/>')
    mass = mass_tag.number("value")
    moments = _moments(tag)
    if mass < 0:
        raise mass_tag.error(f"the mass of link {shown(link)} is negative ({mass:g} kg)", "a mass is positive", "E102")
    if mass == 0:
        if any(any(row) for row in moments):
            raise mass_tag.error(
                f"link {shown(link)} has an inertia, and its mass is 0",
                "give it a mass above 0, or leave out <inertial>",
                "E103",
            )
        return None
    return Inertial(mass, pose.offset, turned_tensor(pose.matrix, moments), tag.place)


def _moments(tag: Tag) -> Rows:
    """The tensor in the axes of <inertial>; without <inertia>, the mass is a point."""
    found = tag.one("inertia")
    if found is None:
        return (ZERO, ZERO, ZERO)
    xx, yy, zz = (found.number(key) for key in ("ixx", "iyy", "izz"))
    xy, xz, yz = (found.number(key, 0.0) for key in ("ixy", "ixz", "iyz"))
    return ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))


def _pose(tag: Tag) -> FixedPose:
    """The contents of <origin xyz rpy>; both are zero where they are not written."""
    origin = tag.one("origin")
    if origin is None:
        return FixedPose()
    x, y, z = origin.vector("xyz", ZERO)
    roll, pitch, yaw = origin.vector("rpy", ZERO)
    origin.check_angles("rpy", (roll, pitch, yaw))
    return FixedPose((x, y, z), fixed_axes(roll, pitch, yaw))


# -- joints -------------------------------------------------------------------------------------------------------


def _joint(tag: Tag) -> RobotJoint:
    name, kind = tag.word("name", "elbow"), tag.word("type", "revolute")
    if kind not in KINDS:
        fix = did_you_mean(kind[:64], KINDS) or "known: " + ", ".join(KINDS)
        raise tag.error(f"there is no joint of type {shown(kind)}", fix, "E405", "type")
    parent = tag.need("parent", '<parent link="base"/>').word("link", "base")
    child = tag.need("child", '<child link="arm"/>').word("link", "arm")
    damping, friction = _resistance(tag)
    moves = kind not in NO_AXIS
    return RobotJoint(
        name,
        cast("JointKind", kind),
        parent,
        child,
        _pose(tag),
        _axis(tag) if moves else X,
        tag.place,
        damping,
        friction,
        _mimic(tag) if moves else None,
        _limits(tag) if moves else JointLimits(),
    )


def _axis(tag: Tag) -> tuple[float, float, float]:
    """The direction of the axis as the file has it, without the rounding of the program that wrote it."""
    found = tag.one("axis")
    if found is None:
        return X
    axis = found.vector("xyz", X)
    size = length(axis)
    if size == 0:
        raise found.error(f"the axis of {tag.title} is (0, 0, 0)", 'write <axis xyz="0 0 1"/>', "E409", "xyz")
    kept = [0.0 if abs(x) < _SMALL * size else x for x in axis]
    if sum(x != 0 for x in kept) == 1:
        kept = [math.copysign(1.0, x) if x else 0.0 for x in kept]
    x, y, z = kept
    return x, y, z


def _resistance(tag: Tag) -> tuple[float, float]:
    """Damping and dry friction of a joint."""
    found = tag.one("dynamics")
    if found is None:
        return 0.0, 0.0
    values = {key: found.number(key, 0.0) for key in ("damping", "friction")}
    for key, value in values.items():
        if value < 0:
            raise found.error(f"the {key} of {tag.title} is negative ({value:g})", "give 0 or more", "E406", key)
    return values["damping"], values["friction"]


def _mimic(tag: Tag) -> Mimic | None:
    found = tag.one("mimic")
    if found is None:
        return None
    leader = found.word("joint", "finger_joint")
    return Mimic(leader, found.number("multiplier", 1.0), found.number("offset", 0.0), found.place)


def _limits(tag: Tag) -> JointLimits:
    found = tag.one("limit")
    if found is None:
        return JointLimits()
    given = {key: found.number(key) if found.get(key) is not None else None for key in JointLimits.__dataclass_fields__}
    return JointLimits(**given)


# -- what joints refer to -----------------------------------------------------------------------------------------


def _check_ends(root: Tag, links: dict[str, RobotLink], joints: dict[str, RobotJoint]) -> None:
    """Raise an error for a joint whose link the file does not have, or that joins a link to itself."""
    for tag in root.all("joint"):
        joint = joints[tag.attributes["name"].strip()]
        for end in ("parent", "child"):
            link = getattr(joint, end)
            if link not in links:
                tag.need(end, "").unknown("link", link, links, "link")
        if joint.parent == joint.child:
            said = f"{tag.title} joins link {shown(joint.child)} to itself"
            raise tag.error(said, "name two links: the one that carries it, and the one that it moves", "E410")


def _check_mimics(joints: dict[str, RobotJoint]) -> None:
    """Raise an error for a joint that follows one without a coordinate, or itself."""
    followers = {j.name: j.mimic for j in joints.values() if j.mimic is not None}
    for name, mimic in followers.items():
        what = f"joint {shown(name)}"
        if joints[name].kind == "planar":
            raise ParseError("a planar joint cannot follow another", element=what, place=mimic.place, code="E405")
        leader = joints.get(mimic.leader)
        if leader is None:
            fix = did_you_mean(mimic.leader[:64], joints) or f"known: {', '.join(list(joints)[:12])}"
            said = f"it follows the joint {shown(mimic.leader)}, which does not exist"
            raise ParseError(said, element=what, place=mimic.place, fix=fix, code="E402")
        if leader.kind not in ("revolute", "continuous", "prismatic"):
            said = f"it follows joint {shown(leader.name)}, which is {leader.kind} and has no coordinate to follow"
            raise ParseError(said, element=what, place=mimic.place, fix="name a joint that moves", code="E402")
        trail = [name]
        while (following := followers.get(trail[-1])) is not None:
            if following.leader in trail:
                said = f"joints follow each other in a circle: {' → '.join([*trail, following.leader])}"
                raise ParseError(said, element=what, place=mimic.place, fix="let one of them lead", code="E413")
            trail.append(following.leader)
