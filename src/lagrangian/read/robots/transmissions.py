"""Reads the transmissions of URDF: a motor whose effort reaches a joint times the reduction of its gear, Ξ = n u.

Those with one joint and one actuator are read; what couples several joints is told as not read. With the reduction 1
the motor's effort is that of the joint, whose input it is; a joint without a transmission has that input, too.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from lagrangian.quantities.source import shown
from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.robot import RobotActuator, RobotJoint

SIMPLE = "SimpleTransmission"
"""How the type of a transmission ends that has one joint and one actuator."""

DRIVEN = ("revolute", "continuous", "prismatic")


class Transmissions:
    """The transmissions of one file: motors that are read, and what is told of the others."""

    def __init__(self, root: Tag, joints: Mapping[str, RobotJoint]) -> None:
        self.joints = joints
        self.found: list[RobotActuator] = []
        self.unread: list[str] = []
        driven: set[str] = set()
        for tag in root.all("transmission"):
            made = self._made(tag)
            if isinstance(made, RobotActuator) and made.target in driven:
                made = f"another transmission drives joint {made.target}"
            if isinstance(made, str):
                tag.seen.update(tag.attributes)
                self.unread.append(f"{tag.title} (line {tag.place.line}): {made}")
            else:
                driven.add(str(made.target))
                if made.gear != (1.0,):
                    self.found.append(made)

    def _made(self, tag: Tag) -> RobotActuator | str:
        """The motor of a transmission, or why it is not read."""
        kind = tag.get("type") or next((inner.text.strip() for inner in tag.all("type")), SIMPLE)
        joints, actuators = tag.all("joint"), tag.all("actuator")
        if not kind.endswith(SIMPLE):
            return f"its type is {kind[:64]}"
        if len(joints) != 1 or len(actuators) != 1:
            return "it does not lead from one actuator to one joint"
        name = joints[0].word("name", "elbow")
        joint = self.joints.get(name)
        if joint is None:  # as in files of a part of a robot
            return f"there is no joint {shown(name)}"
        if joint.kind not in DRIVEN or joint.mimic is not None:
            return f"joint {name} has no coordinate of its own that turns or slides"
        reductions = list(_reductions(tag))
        if len(set(reductions)) > 1:
            return "it has more than one reduction"
        gear = reductions[0] if reductions else 1.0
        if gear == 0:
            return "its reduction is 0"
        return RobotActuator(actuators[0].word("name", "elbow_motor"), name, tag.place, (gear,))


def _reductions(tag: Tag) -> Iterator[float]:
    """The reductions that are written in a transmission, in its actuator or in its joint."""
    for holder in (tag, *(child for child in tag.children if child.name in ("actuator", "joint"))):
        for inner in holder.all("mechanicalReduction"):
            yield inner.content()
