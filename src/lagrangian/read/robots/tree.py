"""Checks that links and joints form one tree, within limits, and that every moving joint moves some mass."""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.errors import ParseError
from lagrangian.quantities.source import shown
from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.robot import MAX_CHAIN, MAX_LINKS, RobotJoint, RobotLink
from lagrangian.records import dataclass


def check_count(tag: Tag, links: int) -> None:
    """Raise `ParseError` if a robot has more links than are read."""
    if links > MAX_LINKS:
        raise tag.error(f"the robot has {links} links; at most {MAX_LINKS} are read", "describe a part", "E703")


def checked_tree(tag: Tag, links: Mapping[str, RobotLink], joints: Mapping[str, RobotJoint]) -> str:
    """Return the name of the link that no joint carries; raise `ParseError` if the joints form no tree from there."""
    check_count(tag, len(links))
    carried: dict[str, RobotJoint] = {}
    for joint in joints.values():
        if (before := carried.get(joint.child)) is not None:
            raise ParseError(
                f"link {shown(joint.child)} is the child of two joints (the other is {shown(before.name)})",
                element=f"joint {shown(joint.name)}",
                place=joint.place,
                fix="a robot is a tree; close a loop with system.pin, ball or weld after loading",
                code="E404",
            )
        carried[joint.child] = joint
    roots = [link for link in links.values() if link.name not in carried]
    if not roots:
        first = next(iter(joints.values()))
        raise _circle(first, carried)
    if len(roots) > 1:
        named = ", ".join(shown(root.name) for root in roots[:8]) + (", …" if len(roots) > 8 else "")
        raise ParseError(
            f"{len(roots)} links have no parent: {named}",
            element=f"link {shown(roots[1].name)}",
            place=roots[1].place,
            fix="join them: a robot has one link that no joint carries, its root",
            code="E404",
        )
    if all(joint.kind == "fixed" for joint in joints.values()):
        raise ParseError(
            "nothing in the robot moves: all its joints are fixed, or it has none",
            element=f"link {shown(roots[0].name)}",
            place=roots[0].place,
            fix="the root is fixed to the ground; to let it float, join it to a new link by a joint of type 'floating'",
            code="E201",
        )
    _Walk(links, joints, carried).check(roots[0].name)
    return roots[0].name


def _circle(start: RobotJoint, carried: Mapping[str, RobotJoint]) -> ParseError:
    """The error for joints that carry each other."""
    trail, joint = [start.child], start
    while joint.parent not in trail:
        trail.append(joint.parent)
        joint = carried[joint.parent]
    circle = [*trail[trail.index(joint.parent) :], joint.parent][::-1]
    shortened = circle if len(circle) < 12 else [*circle[:6], "…", *circle[-4:]]
    return ParseError(
        f"the links carry each other in a circle: {' → '.join(shortened)}",
        element=f"joint {shown(joint.name)}",
        place=joint.place,
        fix="a robot is a tree; close a loop with system.pin, ball or weld after loading",
        code="E413",
    )


@dataclass(frozen=True)
class _Walk:
    links: Mapping[str, RobotLink]
    joints: Mapping[str, RobotJoint]
    carried: Mapping[str, RobotJoint]

    def check(self, root: str) -> None:
        """From the root outwards: is every link reached, none too far out, and does every joint move mass?"""
        below: dict[str, list[RobotJoint]] = {}
        for joint in self.joints.values():
            below.setdefault(joint.parent, []).append(joint)
        order, depth = [root], {root: 0}
        for link in order:
            for joint in below.get(link, ()):
                depth[joint.child] = depth[link] + 1
                order.append(joint.child)
                if depth[joint.child] > MAX_CHAIN:
                    raise ParseError(
                        f"more than {MAX_CHAIN} links one after the other",
                        element=f"joint {shown(joint.name)}",
                        place=joint.place,
                        fix="is this a robot?",
                        code="E703",
                    )
        missed = next((name for name in self.links if name not in depth), None)
        if missed is not None:
            raise _circle(self.carried[missed], self.carried)
        self._check_mass(order)

    def _check_mass(self, order: list[str]) -> None:
        """Raise an error for a joint that moves nothing with mass."""
        heavy = {name for name in order if self.links[name].inertial is not None}
        for name in reversed(order):
            joint = self.carried.get(name)
            if joint is None:
                continue
            if name in heavy:
                heavy.add(joint.parent)
            elif joint.kind != "fixed":
                raise ParseError(
                    f"nothing that it moves has mass: link {shown(name)} and what it carries have no <inertial>",
                    element=f"joint {shown(joint.name)}",
                    place=joint.place,
                    fix=f"give link {shown(name)} an <inertial> with a mass, or make the joint fixed",
                    code="E201",
                )
