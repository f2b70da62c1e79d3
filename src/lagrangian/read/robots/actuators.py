"""Reads what drives a robot in MJCF: actuators, with the defaults of their classes.

    effort = (g₀ + g₁ L + g₂ L̇) u + b₀ + b₁ L + b₂ L̇

A motor has the gain 1, a servo of position the gain kp and the bias −kp L − kv L̇, a servo of velocity the gain kv and
the bias −kv L̇, a damper the gain −kv L̇. Actuators with a state of their own are told as not read, as muscles are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from lagrangian.quantities.source import shown
from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.mjcf_sites import site_named
from lagrangian.read.robots.mjcf_tags import Orientations
from lagrangian.read.robots.robot import RobotActuator, RobotJoint, RobotSite, RobotTendon
from lagrangian.read.robots.rotations import ZERO, Vector
from lagrangian.read.robots.tendons import Tendons
from lagrangian.records import dataclass

READ = ("general", "motor", "position", "velocity", "damper")
RANGES = {"ctrlrange": "control", "forcerange": "effort"}
DATA = ("ctrllimited", "forcelimited", "inheritrange", "group", "lengthrange", "actlimited", "actrange", "class")
PUSHING = ("joint", "jointinparent", "site", "tendon")


@dataclass(frozen=True)
class ActuatorLaw:
    """An actuator's law so far, as defaults and its own attributes say; ``shortcut`` is the last tag that set it."""

    gear: tuple[float, ...] = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    gains: Vector = (1.0, 0.0, 0.0)
    biases: Vector = ZERO
    affine_gain: bool = False
    affine_bias: bool = False
    shortcut: str = "general"
    ranges: tuple[tuple[str, str], ...] = ()
    why: str = ""

    def changed(self, tag: Tag) -> ActuatorLaw:
        """The law after the attributes of a tag."""
        ranges = {**dict(self.ranges)}
        for key, words in RANGES.items():
            if tag.get(key) is not None:
                low, high = tag.vector(key, (), (2,))
                ranges[key] = f"{words} {low:g} to {high:g}"
        tag.seen.update(DATA)
        given = tag.vector("gear", (), tuple(range(1, 7)))
        made = replace(self, gear=(*given, *self.gear[len(given) :]), ranges=tuple(ranges.items()), shortcut=tag.name)
        if tag.name not in READ:
            return replace(made, why="it has a state or a law of its own")
        return LAWS[tag.name](made, self, tag)


def _general(law: ActuatorLaw, before: ActuatorLaw, tag: Tag) -> ActuatorLaw:
    known = {"gaintype": ("fixed", "affine"), "biastype": ("none", "affine"), "dyntype": ("none",)}
    kinds = {"gaintype": law.affine_gain, "biastype": law.affine_bias}
    why = law.why
    for key, allowed in known.items():
        value = tag.get(key)
        if value is None:
            continue
        if value not in allowed:
            why = f"its {key} is {shown(value)}"
            continue
        why = "" if why.startswith(f"its {key} ") else why
        if key in kinds:
            kinds[key] = value == "affine"
    sizes = tuple(range(1, 11))
    gains, biases = ((*tag.vector(key, (), sizes), *old)[:3] for key, old in (("gainprm", ()), ("biasprm", ())))
    gains, biases = (*gains, *law.gains[len(gains) :]), (*biases, *law.biases[len(biases) :])
    tag.vector("dynprm", (), sizes)
    return replace(
        law,
        gains=(gains[0], gains[1], gains[2]),
        biases=(biases[0], biases[1], biases[2]),
        affine_gain=kinds["gaintype"],
        affine_bias=kinds["biastype"],
        why=why,
    )


def _motor(law: ActuatorLaw, before: ActuatorLaw, tag: Tag) -> ActuatorLaw:
    return replace(law, gains=(1.0, 0.0, 0.0), biases=ZERO, affine_gain=False, affine_bias=False, why="")


def _position(law: ActuatorLaw, before: ActuatorLaw, tag: Tag) -> ActuatorLaw:
    same = before.shortcut in ("general", "position")
    kp = _positive(tag, "kp", before.gains[0] if same else 1.0)
    kv = _positive(tag, "kv", -before.biases[2] if same and before.affine_bias else 0.0)
    why = next((f"its {key} needs what is not read" for key in ("timeconst", "dampratio") if tag.get(key)), "")
    return replace(law, gains=(kp, 0.0, 0.0), biases=(0.0, -kp, -kv), affine_gain=False, affine_bias=True, why=why)


def _velocity(law: ActuatorLaw, before: ActuatorLaw, tag: Tag) -> ActuatorLaw:
    kv = _positive(tag, "kv", before.gains[0] if before.shortcut in ("general", "velocity") else 1.0)
    return replace(law, gains=(kv, 0.0, 0.0), biases=(0.0, 0.0, -kv), affine_gain=False, affine_bias=True, why="")


def _damper(law: ActuatorLaw, before: ActuatorLaw, tag: Tag) -> ActuatorLaw:
    kv = _positive(tag, "kv", -before.gains[2] if before.shortcut == "damper" else 0.0)
    return replace(law, gains=(0.0, 0.0, -kv), biases=ZERO, affine_gain=True, affine_bias=False, why="")


def _positive(tag: Tag, key: str, default: float) -> float:
    value = tag.number(key, default)
    if value < 0 and tag.get(key) is not None:
        raise tag.error(f"'{key}' is negative ({value:g})", "give 0 or more", "E406", key)
    return value


LAWS: dict[str, Callable[[ActuatorLaw, ActuatorLaw, Tag], ActuatorLaw]] = {
    "general": _general,
    "motor": _motor,
    "position": _position,
    "velocity": _velocity,
    "damper": _damper,
}


class Actuators:
    """The actuators of one file: those that are read, and what is told of the others."""

    def __init__(
        self,
        root: Tag,
        joints: Mapping[str, RobotJoint],
        sites: Mapping[str, tuple[Tag, str]],
        tendons: Tendons,
        orientations: Orientations,
    ) -> None:
        self.joints = {name: joint for name, joint in joints.items() if joint.kind != "fixed"}
        self.carrying = {joint.child: joint for joint in joints.values()}
        self.sites, self.tendons, self.orientations = sites, tendons, orientations
        self.classes = dict(_defaults(root))
        self.found: list[RobotActuator] = []
        self.unread: list[str] = []
        for outer in root.all("actuator"):
            for tag in outer.children:
                tag.read = True
                self._add(tag)

    def _add(self, tag: Tag) -> None:
        law = self._law(tag)
        made = law.why or self._made(tag, law)
        if isinstance(made, str):
            tag.seen.update(tag.attributes)
            self.unread.append(f"{tag.title} (line {tag.place.line}): {made}")
        else:
            self.found.append(made)

    def _law(self, tag: Tag) -> ActuatorLaw:
        name = tag.get("class") or "main"
        if name not in self.classes and name != "main":
            tag.unknown("default class", name, self.classes, "class")
        return self.classes.get(name, ActuatorLaw()).changed(tag)

    def _made(self, tag: Tag, law: ActuatorLaw) -> RobotActuator | str:
        """The actuator, or why it is not read."""
        given = [key for key in PUSHING if tag.get(key) is not None]
        if len(given) != 1:
            return "it drives something other than one joint, tendon or site"
        key = given[0]
        gain = law.gains if law.affine_gain else (law.gains[0], 0.0, 0.0)
        bias = law.biases if law.affine_bias else ZERO
        by_length, by_rate = bool(gain[1] or bias[1]), bool(gain[2] or bias[2])
        target: str | RobotSite | RobotTendon
        name, gear = tag.get(key) or "", law.gear
        if key == "site":
            target = site_named(tag, key, self.sites, self.orientations)
            if tag.get("refsite") is not None or by_length or by_rate:
                return "its effort depends on how its site moves"
            if not self._moves(target.link):
                return "its site does not move"
        elif key == "tendon":
            pulled, gear = self.tendons.pulled(tag, name), gear[:1]
            if isinstance(pulled, str):
                return pulled
            target = pulled
        else:
            if name not in self.joints:
                tag.unknown("joint", name, self.joints, key)
            target, kind = name, self.joints[name].kind
            gear = gear[:3] if kind == "ball" else gear if kind == "floating" else gear[:1]
            if kind in ("ball", "floating") and (by_length or (by_rate and (kind == "floating" or key != "joint"))):
                return "its effort depends on how far its joint has turned or how it moves"
        if not any(gear):
            return "its gear is 0, so that it does nothing"
        words = ", ".join(text for _, text in law.ranges)
        in_parent = key == "jointinparent"
        return RobotActuator(tag.get("name") or "", target, tag.place, gear, gain, bias, in_parent, words)

    def _moves(self, link: str) -> bool:
        """Whether any joint moves a link."""
        while (joint := self.carrying.get(link)) is not None:
            if joint.kind != "fixed":
                return True
            link = joint.parent
        return False


def _defaults(root: Tag) -> Iterator[tuple[str, ActuatorLaw]]:
    """The laws of all classes of defaults, those within others with what the outer ones say."""
    waiting = [(tag, tag.get("class") or "main", ActuatorLaw()) for tag in root.all("default")]
    for tag, name, law in waiting:
        for child in tag.children:
            if child.name in LAWS:
                child.read = True
                law = law.changed(child)
            elif child.name in UNREAD:
                child.read = True
                law = replace(law, why=f"its class has the law of <{child.name}>")
        yield name, law
        waiting += [(inner, inner.get("class") or "", law) for inner in tag.all("default")]


UNREAD = ("intvelocity", "cylinder", "muscle", "adhesion", "plugin", "dcmotor")
