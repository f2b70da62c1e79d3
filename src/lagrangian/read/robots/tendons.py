"""Reads the tendons of MJCF: fixed ones, whose length is L = Σ c q of joints, with what acts along them."""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.robot import RobotJoint, RobotTendon

SCALAR = ("revolute", "prismatic")
ACTING = ("stiffness", "damping", "frictionloss", "armature")
"""What makes a tendon more than data."""


class Tendons:
    """The tendons of one file: ``acting`` have springs, dampers, dry friction or inertia of their own."""

    def __init__(self, root: Tag, joints: Mapping[str, RobotJoint]) -> None:
        _refuse_defaults(root)
        self.joints = joints
        self.tags = [tag for outer in root.all("tendon") for tag in outer.children]
        self.acting = [self._fixed(tag) for tag in self.tags if self._acts(tag)]

    def pulled(self, tag: Tag, name: str) -> RobotTendon | str:
        """The tendon that an actuator names, or why it is not read."""
        found = {x.attributes.get("name"): x for x in self.tags}
        if name not in found:
            tag.unknown("tendon", name, [x for x in found if x], "tendon")
        return self._fixed(found[name]) if found[name].name == "fixed" else "its tendon leads through sites"

    def _acts(self, tag: Tag) -> bool:
        """Whether a tendon does more than to name a length; one through sites that does is refused."""
        acting = [key for key in ACTING if _first(tag, key)]
        if acting and tag.name != "fixed":
            fix = "the springs of fixed tendons are read; add those of others with system.spring after loading"
            raise tag.error(f"'{acting[0]}' of a tendon through sites is not supported", fix, "E405", acting[0])
        return bool(acting)

    def _fixed(self, tag: Tag) -> RobotTendon:
        tag.read = True
        parts: list[tuple[str, float]] = []
        for part in tag.all("joint"):
            name = part.word("joint", "elbow")
            check_scalar(part, name, "joint", self.joints)
            parts.append((name, part.number("coef")))
        if len({self.joints[name].kind for name, _ in parts}) != 1:
            what = "it has no joints" if not parts else "its joints turn and slide, so that its length has no unit"
            raise tag.error(what, "name joints of one kind, <joint joint=… coef=…/>", "E405")
        stiffness, damping, friction, armature = (_first(tag, key) for key in ACTING)
        low, *high = tag.vector("springlength", (-1.0,), (1, 2))
        if high and high[0] != low and stiffness:
            raise tag.error("a spring with slack is not supported", "give one length", "E405", "springlength")
        rest = sum(c * self.joints[name].rest for name, c in parts) if low == -1 else low
        name = tag.get("name") or "tendon"
        return RobotTendon(name, tuple(parts), tag.place, rest, stiffness, damping, friction, armature)


def check_scalar(tag: Tag, name: str, key: str, joints: Mapping[str, RobotJoint]) -> None:
    """Raise an error if an attribute names something other than a hinge or a slide."""
    moving = [n for n, joint in joints.items() if joint.kind in SCALAR]
    if name not in moving:
        tag.unknown("hinge or slide", name, moving, key)


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
            for key in ACTING:
                if any(child.vector(key, (0.0,), (1, 2, 3))):
                    raise child.error(f"a default '{key}' of tendons is not supported", "give it to each", "E405", key)
