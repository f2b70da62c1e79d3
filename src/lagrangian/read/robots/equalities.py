"""Reads what MJCF asks of positions (<equality>) and the springs of fixed tendons (<tendon>).

MuJoCo's equalities give way; here they hold. At the pose that the file describes:

    connect   P on body 1 and Q on body 2 coincide, as they do there
    weld      body 2 stays where it is there relative to body 1, or at ``relpose``
    joint     q₁ − ref₁ = Σ_k a_k (q₂ − ref₂)^k
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.mjcf_tags import Orientations
from lagrangian.read.robots.robot import RobotEquality, RobotJoint, RobotSite, RobotTendon
from lagrangian.read.robots.rotations import ZERO, FixedPose

SCALAR = ("revolute", "prismatic")
PLAIN = (0.0, 1.0, 0.0, 0.0, 0.0)
"""The coefficients of q₁ = q₂."""

TENDON = ("stiffness", "damping", "frictionloss", "armature")
"""What makes a tendon more than data."""


@dataclass
class Equalities:
    """The equalities and tendons of one file that act, and ``unread``: those that do not hold."""

    root: Tag
    world: str
    joints: Mapping[str, RobotJoint]
    sites: Mapping[str, tuple[Tag, str]]
    orientations: Orientations
    found: list[RobotEquality] = field(default_factory=list[RobotEquality])
    tendons: list[RobotTendon] = field(default_factory=list[RobotTendon])
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
        _refuse_defaults(self.root)
        for outer in self.root.all("tendon"):
            for tag in outer.children:
                self.tendons += self._tendon(tag)

    # -- equalities ----------------------------------------------------------------------------------------------------

    def _equality(self, tag: Tag) -> RobotEquality:
        if tag.name == "joint":
            return self._coupled(tag)
        if tag.name not in ("connect", "weld"):
            fix = "connect, weld and joint are read; describe others with system.constraint after loading"
            raise tag.error(f"<{tag.name}> among the equalities is not supported", fix, "E405")
        if tag.get("site1") is not None or tag.get("site2") is not None:
            first, second = self._site(tag, "site1"), self._site(tag, "site2")
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
            self._scalar(tag, name, key)
        given = tag.vector("polycoef", PLAIN, (1, 2, 3, 4, 5))
        coefficients = (*given, *PLAIN[len(given) :])
        return RobotEquality(tag.get("name") or "", "joint", tag.place, tuple(names), coefficients)

    def _scalar(self, tag: Tag, name: str, key: str) -> None:
        moving = {n: joint for n, joint in self.joints.items() if joint.kind in SCALAR}
        if name not in moving:
            tag.unknown("hinge or slide", name, moving, key)

    def _link(self, tag: Tag, key: str, default: str | None = None) -> str:
        name = tag.word(key, "hand") if default is None or tag.get(key) is not None else default
        if name != self.world and name not in self.carrying:
            tag.unknown("body", name, [self.world, *self.carrying], key)
        return name

    def _site(self, tag: Tag, key: str) -> RobotSite:
        name = tag.word(key, "tip")
        if name not in self.sites:
            tag.unknown("site", name, self.sites, key)
        found, link = self.sites[name]
        found.read = True
        if found.get("fromto") is not None:
            raise found.error("'fromto' of a site is not supported", "write pos and quat", "E405", "fromto")
        return RobotSite(link, self.orientations.pose(found))

    def _at_start(self, link: str) -> FixedPose:
        """Where a link is at the pose that the file describes: no joint has moved."""
        pose = FixedPose()
        while (joint := self.carrying.get(link)) is not None:
            pose, link = pose.within(joint.pose), joint.parent
        return pose

    # -- tendons -------------------------------------------------------------------------------------------------------

    def _tendon(self, tag: Tag) -> Iterator[RobotTendon]:
        """A tendon that acts; one that only names a length is data."""
        values = {key: _first(tag, key) for key in TENDON}
        if not any(values.values()):
            return
        if tag.name != "fixed":
            key = next(key for key in TENDON if values[key])
            fix = "the springs of fixed tendons are read; add those of others with system.spring after loading"
            raise tag.error(f"'{key}' of a tendon through sites is not supported", fix, "E405", key)
        tag.read = True
        parts: list[tuple[str, float]] = []
        for part in tag.all("joint"):
            name = part.word("joint", "elbow")
            self._scalar(part, name, "joint")
            parts.append((name, part.number("coef")))
        if len({self.joints[name].kind for name, _ in parts}) != 1:
            what = "it has no joints" if not parts else "its joints turn and slide, so that its length has no unit"
            raise tag.error(what, "name joints of one kind, <joint joint=… coef=…/>", "E405")
        low, *high = tag.vector("springlength", (-1.0,), (1, 2))
        if high and high[0] != low and values["stiffness"]:
            raise tag.error("a spring with slack is not supported", "give one length", "E405", "springlength")
        rest = sum(c * self.joints[name].rest for name, c in parts) if low == -1 else low
        yield RobotTendon(tag.get("name") or "tendon", tuple(parts), tag.place, rest=rest, **values)


def _first(tag: Tag, key: str) -> float:
    """The coefficient of a linear law; one that is not linear is refused."""
    first, *more = tag.vector(key, (0.0,), (1, 2, 3))
    if any(more):
        raise tag.error(f"'{key}' is that of a law that is not linear", "give one number", "E405", key)
    if first < 0:
        raise tag.error(f"the {key} is negative ({first:g})", "give 0 or more", "E406", key)
    return first


def _refuse_defaults(root: Tag) -> None:
    """Raise an error for a class of defaults in which tendons act."""
    waiting = root.all("default")
    for tag in waiting:
        waiting += [child for child in tag.children if child.name == "default"]
        for child in (child for child in tag.children if child.name == "tendon"):
            for key in TENDON:
                if any(child.vector(key, (0.0,), (1, 2, 3))):
                    raise child.error(f"a default '{key}' of tendons is not supported", "give it to each", "E405", key)
