"""Reads what MJCF asks of positions (<equality>).

MuJoCo's equalities give way; here they hold. At the pose that the file describes:

    connect   P on body 1 and Q on body 2 coincide, as they do there
    weld      body 2 stays where it is there relative to body 1, or at ``relpose``
    joint     q₁ − ref₁ = Σ_k a_k (q₂ − ref₂)^k
"""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.mjcf_sites import site_named
from lagrangian.read.robots.mjcf_tags import Orientations
from lagrangian.read.robots.robot import RobotEquality, RobotJoint, RobotSite
from lagrangian.read.robots.rotations import ZERO, FixedPose
from lagrangian.read.robots.tendons import check_scalar
from lagrangian.records import dataclass, field

PLAIN = (0.0, 1.0, 0.0, 0.0, 0.0)
"""The coefficients of q₁ = q₂."""


@dataclass
class Equalities:
    """The equalities of one file, and ``unread``: those that do not hold."""

    root: Tag
    world: str
    joints: Mapping[str, RobotJoint]
    sites: Mapping[str, tuple[Tag, str]]
    orientations: Orientations
    found: list[RobotEquality] = field(default_factory=list[RobotEquality])
    unread: list[str] = field(default_factory=list[str])

    def __post_init__(self) -> None:
        self.carrying = {joint.child: joint for joint in self.joints.values()}
        for outer in self.root.all("equality"):
            for tag in outer.children:
                tag.read = True
                if tag.get("active") == "false":
                    tag.seen.update(tag.attributes)
                    self.unread.append(f"{tag.title} (line {tag.place.line}): it is not active")
                else:
                    self.found.append(self._equality(tag))

    # -- equalities ----------------------------------------------------------------------------------------------------

    def _equality(self, tag: Tag) -> RobotEquality:
        if tag.name == "joint":
            return self._coupled(tag)
        if tag.name not in ("connect", "weld"):
            fix = "connect, weld and joint are read; describe others with system.constraint after loading"
            raise tag.error(f"<{tag.name}> among the equalities is not supported", fix, "E405")
        if tag.get("site1") is not None or tag.get("site2") is not None:
            first, second = (site_named(tag, key, self.sites, self.orientations) for key in ("site1", "site2"))
        else:
            first, second = self._bodies(tag)
        kind = "weld" if tag.name == "weld" else "connect"
        return RobotEquality(tag.get("name") or "", kind, tag.place, (first, second))

    def _bodies(self, tag: Tag) -> tuple[RobotSite, RobotSite]:
        """The places on two bodies that are to be one."""
        one, other = self._link(tag, "body1"), self._link(tag, "body2", self.world)
        between = self._at_start(other).seen_from(self._at_start(one))  # body 2 in the axes of body 1
        x, y, z = tag.vector("anchor", ZERO)
        if tag.name == "connect":
            if tag.get("anchor") is None:
                raise tag.error("the attribute 'anchor' is missing", 'write anchor="0 0 0.1"', "E401")
            back = FixedPose((x, y, z)).seen_from(between)
            return RobotSite(one, FixedPose((x, y, z))), RobotSite(other, FixedPose(back.offset))
        pose = tag.vector("relpose", (0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0), (7,))
        if any(pose[3:]):
            turns = self.orientations.by_quaternion((pose[3], pose[4], pose[5], pose[6]))
            between = FixedPose((pose[0], pose[1], pose[2]), turns)
        anchor = FixedPose((x, y, z))
        return RobotSite(one, anchor.within(between)), RobotSite(other, anchor)

    def _coupled(self, tag: Tag) -> RobotEquality:
        names = [tag.word("joint1", "elbow")]
        if tag.get("joint2") is not None:
            names.append(tag.word("joint2", "shoulder"))
        for key, name in zip(("joint1", "joint2"), names, strict=False):
            check_scalar(tag, name, key, self.joints)
        given = tag.vector("polycoef", PLAIN, (1, 2, 3, 4, 5))
        coefficients = (*given, *PLAIN[len(given) :])
        return RobotEquality(tag.get("name") or "", "joint", tag.place, tuple(names), coefficients)

    def _link(self, tag: Tag, key: str, default: str | None = None) -> str:
        name = tag.word(key, "hand") if default is None or tag.get(key) is not None else default
        if name != self.world and name not in self.carrying:
            tag.unknown("body", name, [self.world, *self.carrying], key)
        return name

    def _at_start(self, link: str) -> FixedPose:
        """Where a link is at the pose that the file describes: no joint has moved."""
        pose = FixedPose()
        while (joint := self.carrying.get(link)) is not None:
            pose, link = pose.within(joint.pose), joint.parent
        return pose
