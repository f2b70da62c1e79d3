"""What a robot's file says that its description does not: notices, so that nothing is left out in silence."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from lagrangian.codes import Code
from lagrangian.errors import Notice
from lagrangian.read.robots.robot import JointLimits, Robot, RobotActuator, RobotJoint, RobotTendon


def remarks(
    robot: Robot, still: Sequence[str], changed: Mapping[str, str], driven: Sequence[str], closed: Sequence[str]
) -> Iterator[Notice]:
    """The notices of a robot: limits, actuators, joints without input, bodies at rest, names, what is not mechanics.

    ``driven`` says what each actuator drives, ``closed`` what holds between positions.
    """
    where = f"robot '{robot.name}'"
    moving = [joint for joint in robot.joints.values() if joint.kind != "fixed"]

    def notice(text: str) -> Notice:
        return Notice(Code.E108, where, text)

    if limits := [f"{joint.name} {said}" for joint in moving if (said := ", ".join(in_words(joint.limits, joint)))]:
        yield notice("limits are data, which the motion does not keep: " + "; ".join(limits))
    if followers := [j for j in moving if j.mimic is not None]:
        said = "; ".join(f"{j.name} follows {j.mimic.leader}" for j in followers if j.mimic is not None)
        yield notice(f"joints that follow others have neither coordinate nor input: {said}")
    if driven:
        ranges = ", whose ranges are data, which a run does not obey" if any(x.words for x in robot.actuators) else ""
        yield notice(f"actuators are inputs{ranges}: " + "; ".join(driven))
    if closed:
        yield notice("these hold exactly, where MuJoCo's give way: " + "; ".join(closed))
    if robot.inactive:
        yield notice("these do not hold: " + "; ".join(robot.inactive))
    if robot.unread:
        yield notice("these actuators are not read: " + "; ".join(robot.unread))
    targets = {name for x in robot.actuators for name in driven_joints(x)}
    if robot.passive and (idle := [j.name for j in moving if j.name not in targets]):
        yield notice("no actuator drives these joints, so they have no input: " + ", ".join(idle))
    for joint in moving:
        if joint.kind == "floating":
            drives = "no input drives it, and " if not robot.passive else ""
            yield notice(f"joint {joint.name} floats: {drives}its coordinates count from the fixed axes")
        if joint.kind in ("floating", "planar") and (joint.damping or joint.friction):
            yield notice(f"damping and friction of the {joint.kind} joint {joint.name} are left out")
    if still:
        yield notice(f"what does not move needs no mass: {', '.join(still)}")
    if changed:
        yield notice("names were made identifiers: " + ", ".join(f"'{a}' is {b}" for a, b in changed.items()))
    if robot.left_out:
        yield notice("these are no part of the mechanics and are left out: " + ", ".join(robot.left_out))


def driven_joints(actuator: RobotActuator) -> list[str]:
    """The joints that an actuator drives: one, those of a tendon, or none where it pushes at a site."""
    target = actuator.target
    if isinstance(target, RobotTendon):
        return [name for name, _ in target.parts]
    return [target] if isinstance(target, str) else []


def described(joint: RobotJoint) -> str:
    """A joint in words, for its coordinate: ``revolute joint, arm on base, -2 to 2 rad``."""
    said = f"{joint.kind} joint, {joint.child} on {joint.parent}"
    return ", ".join([said, *in_words(joint.limits, joint)[:1]]) if joint.limits.ranged else said


def in_words(limits: JointLimits, joint: RobotJoint) -> list[str]:
    """JointLimits in words: ``-2.9 to 2.9 rad``, ``effort 87 N m``, ``velocity 2.2 rad/s``."""
    length, effort = ("m", "N") if joint.kind == "prismatic" else ("rad", "N m")
    said: list[str] = []
    if limits.ranged:
        said.append(f"{limits.lower or 0:g} to {limits.upper or 0:g} {length}")
    if limits.effort is not None:
        said.append(f"effort {limits.effort:g} {effort}")
    if limits.velocity is not None:
        said.append(f"velocity {limits.velocity:g} {length}/s")
    return said
