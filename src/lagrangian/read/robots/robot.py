"""A robot as its file describes it: links with inertias, joined to a tree by joints."""

from __future__ import annotations

from typing import Literal, TypeAlias

from lagrangian.errors import Place
from lagrangian.read.robots.rotations import FixedPose, Rows, Vector
from lagrangian.records import dataclass, field

JointKind: TypeAlias = Literal["revolute", "continuous", "prismatic", "fixed", "floating", "planar", "ball"]

MAX_LINKS = 1000
"""The largest number of links."""

MAX_CHAIN = 100
"""The largest number of links one after the other from the root."""


@dataclass(frozen=True)
class Inertial:
    """A mass [kg], its centre [m] and the inertia about it [kg m²], both in the axes of a link."""

    mass: float
    centre: Vector
    inertia: Rows
    place: Place = field(repr=False)


@dataclass(frozen=True)
class RobotLink:
    """A rigid part of a robot; without ``inertial`` it has no mass. ``lift`` is the share of its weight that something
    outside carries.
    """

    name: str
    inertial: Inertial | None
    place: Place = field(repr=False)
    lift: float = 0.0


@dataclass(frozen=True)
class Mimic:
    """A joint that follows another: q = multiplier · q_leader + offset."""

    leader: str
    multiplier: float
    offset: float
    place: Place = field(repr=False)


@dataclass(frozen=True)
class JointLimits:
    """What the file says of the range, effort and speed of a joint, as data; None where it says nothing."""

    lower: float | None = None
    upper: float | None = None
    effort: float | None = None
    velocity: float | None = None

    @property
    def ranged(self) -> bool:
        """Whether the coordinate has a range."""
        return self.lower is not None or self.upper is not None


@dataclass(frozen=True)
class RobotJoint:
    """How link ``child`` moves in link ``parent``: placed at ``pose``, then by its coordinate along or about ``axis``.

    A planar joint moves along the two directions perpendicular to ``axis``, and turns about it. ``damping`` is in
    N s/m or N m s, ``friction`` in N or N m. A spring of ``stiffness`` [N/m or N m] relaxes at ``rest``; the coordinate
    has the value ``start`` at the pose; ``armature`` is the inertia of a rotor that only its rate drives [kg or kg m²].
    """

    name: str
    kind: JointKind
    parent: str
    child: str
    pose: FixedPose
    axis: Vector
    place: Place = field(repr=False)
    damping: float = 0.0
    friction: float = 0.0
    mimic: Mimic | None = None
    limits: JointLimits = JointLimits()
    stiffness: float = 0.0
    rest: float = 0.0
    start: float = 0.0
    armature: float = 0.0


@dataclass(frozen=True)
class RobotSite:
    """A place of a link where an actuator pushes."""

    link: str
    pose: FixedPose


@dataclass(frozen=True)
class RobotTendon:
    """A tendon of the length L = Σ c q of the joints in ``parts``, with spring, damper, dry friction and inertia."""

    name: str
    parts: tuple[tuple[str, float], ...]
    place: Place = field(repr=False)
    rest: float = 0.0
    stiffness: float = 0.0
    damping: float = 0.0
    frictionloss: float = 0.0
    armature: float = 0.0


@dataclass(frozen=True)
class RobotActuator:
    """What drives a joint or a tendon, or pushes at a site, by an input u: the effort gain · u + bias, times ``gear``.

    gain = g₀ + g₁ L + g₂ L̇ and bias = b₀ + b₁ L + b₂ L̇ with L = gear · q, or gear times the length of a tendon, and L̇
    its rate. ``gear`` is a number for a hinge, a slide or a tendon, three for a ball joint (about the axes of what
    turns, or ``in_parent`` of what carries it), six (force and moment) for what floats and for a site. ``words`` is
    what the file says of it besides, as data.
    """

    name: str
    target: str | RobotSite | RobotTendon
    place: Place = field(repr=False)
    gear: tuple[float, ...] = (1.0,)
    gain: Vector = (1.0, 0.0, 0.0)
    bias: Vector = (0.0, 0.0, 0.0)
    in_parent: bool = False
    words: str = ""

    @property
    def kind(self) -> str:
        """What it does, in words: effort u, k (u − L) − d L̇, k (u − L̇), or another law."""
        (g0, *more), (b0, b1, b2) = self.gain, self.bias
        if any(more) or not g0:
            return "actuator"
        if b1 == -g0:
            return "position servo"
        if b1 == 0 and b2 == -g0:
            return "velocity servo"
        return "motor" if (g0, b0, b1, b2) == (1, 0, 0, 0) else "actuator"


@dataclass(frozen=True)
class RobotEquality:
    """What holds between positions: ``connect`` two places coincide, ``weld`` with their axes, too; ``joint`` the
    coordinate of the first joint is Σ a_k x^k in that of the second, both counted from their values as described.
    """

    name: str
    kind: Literal["connect", "weld", "joint"]
    place: Place = field(repr=False)
    between: tuple[RobotSite, RobotSite] | tuple[str, ...]
    coefficients: tuple[float, ...] = ()


@dataclass(frozen=True)
class Robot:
    """The tree: links and joints by name, in the order of the file.

    ``left_out`` lists in words what is not mechanics, ``unread`` the actuators that are not understood, ``inactive``
    the equalities that do not hold; ``gravity`` is the acceleration of free fall [m/s²]. If the robot is ``passive``,
    joints without an actuator have no input.
    """

    name: str
    links: dict[str, RobotLink]
    joints: dict[str, RobotJoint]
    root: str
    left_out: tuple[str, ...] = ()
    gravity: Vector = (0.0, 0.0, -9.81)
    place: Place | None = field(default=None, repr=False)
    actuators: tuple[RobotActuator, ...] = ()
    unread: tuple[str, ...] = ()
    passive: bool = False
    equalities: tuple[RobotEquality, ...] = ()
    tendons: tuple[RobotTendon, ...] = ()
    inactive: tuple[str, ...] = ()

    def outwards(self) -> list[RobotJoint]:
        """The joints limb after limb, every one after that which carries it; of one link, in the order of the file."""
        below: dict[str, list[RobotJoint]] = {}
        for joint in self.joints.values():
            below.setdefault(joint.parent, []).append(joint)
        found: list[RobotJoint] = []
        waiting = below.get(self.root, [])[::-1]
        while waiting:
            joint = waiting.pop()
            found.append(joint)
            waiting.extend(below.get(joint.child, [])[::-1])
        return found
