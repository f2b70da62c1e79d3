"""The picture of a system as data: parts that are placed by anchors, labels, and what they belong to.

All lengths are pixels of the picture, with x to the right and y downward. An anchor is a point of the system: its
position r [m] is output number ``at`` of the scene's program, and its place in the picture is

    origin + scale · view · r + shift,

where ``view`` projects the fixed axes onto the picture (2 × 2 in the plane, 2 × 3 in space; its second row points
downward). A part is a shape in its own axes together with a placement, so whoever draws a scene, once or sixty times a
second, only has to place shapes; springs, wheels and carts need no code of their own.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Literal, TypeAlias

from lagrangian.records import dataclass, field

Pair: TypeAlias = "tuple[float, float]"

Role: TypeAlias = Literal[
    "body", "rod", "ground", "stiffness", "damping", "friction", "gravity", "input", "coordinate", "constraint", "thin"
]
"""What a part stands for; it decides the colours."""

Scaling: TypeAlias = Literal["none", "along", "both"]

Command: TypeAlias = "tuple[str, tuple[float, ...]]"
"""``M x y`` begins a line, ``L x y`` continues it, ``C x₁ y₁ x₂ y₂ x y`` is a cubic Bézier curve, ``Z`` closes it."""


@dataclass(frozen=True)
class Placement:
    """Where the axes of a part lie in the picture.

    The origin of the axes is the anchor ``at``, or that of the picture if it is None. With ``towards``, the x axis
    points from there to that anchor, and y is 90° clockwise from x as seen on the screen. ``scaling`` says what the
    distance of the two anchors is: nothing (``none``), the unit of x alone (``along``, such as for a spring), or the
    unit of both axes (``both``, such as for a wheel with an anchor on its rim). ``shift`` and ``shift_towards`` [px]
    are added to the places of the anchors.

    With ``across`` the part lies in a plane in space: x = 1 is seen at ``towards`` and y = 1 at ``across``, so that a
    circle of radius 1 becomes the ellipse as which it is seen. The axes are then oblique.
    """

    at: int | None = None
    towards: int | None = None
    scaling: Scaling = "none"
    shift: Pair = (0.0, 0.0)
    shift_towards: Pair = (0.0, 0.0)
    across: int | None = None


FIXED = Placement()
SWING = 34.0
"""How far the motion of a picture without sizes reaches at least, to both sides of its middle [px]."""


@dataclass(frozen=True)
class Path:
    """Lines and curves in the part's own axes."""

    commands: tuple[Command, ...]


@dataclass(frozen=True)
class Disc:
    """A circle: its centre and radius in the part's own axes (not for parts that are scaled along one axis)."""

    centre: Pair
    radius: float


@dataclass(frozen=True)
class Trace:
    """Straight lines from anchor to anchor, such as a rope, a wire, or the rim of a disc in space.

    ``shifts`` [px] are added to the places of the anchors; a placement does not apply.
    """

    anchors: tuple[int, ...]
    closed: bool = False
    shifts: tuple[Pair, ...] = ()


@dataclass(frozen=True)
class ScenePart:
    """A shape, where it lies, and which elements it stands for.

    ``elements`` are the names of elements of the model (empty for the ground). ``outline`` is the width of its line
    [px], 0 for none; ``filled`` says whether its inside is painted; ``dashed`` whether its line is dashed. All ends and
    corners of lines are round. Parts are drawn by rising ``layer``. ``moves`` is False for what belongs to the picture
    at rest alone: measures, arcs.
    """

    shape: Path | Disc | Trace
    role: Role
    placement: Placement = FIXED
    elements: tuple[str, ...] = ()
    kind: str = ""
    outline: float = 1.5
    filled: bool = False
    dashed: bool = False
    layer: int = 0
    moves: bool = True
    solid: bool = False
    """Whether it is filled with the colour of its line, such as the head of an arrow."""
    paint: Literal["line", "inside"] = "line"
    """The colour of its line: that of lines, or that of insides (a thin one of these on a wide one is a bar)."""
    group: int | None = None
    """In space: the solid to which it belongs, as its number in ``Scene.solids``."""
    facing: bool = False
    """Whether it is one side of a plane in space: drawn only where y = 1 is counter-clockwise from x = 1 as seen."""
    aside: bool = False
    """Whether it stands beside what moves, such as a circuit: in a page it gives way to the bodies."""

    @property
    def dashes(self) -> Pair:
        """The lengths of its dashes and of the gaps between them [px], if its line is dashed."""
        return 2.5 + 1.7 * self.outline, 1.6 + 1.3 * self.outline


@dataclass(frozen=True)
class Flow:
    """A charge that flows around a loop, clockwise as seen if ``sense`` is 1, else −1: in a page, dots move with it.

    ``coordinate`` is its name; ``box`` is (left, top, right, bottom) of the way that the dots take [px].
    """

    coordinate: str
    box: tuple[float, float, float, float]
    sense: float


def drawing_order(parts: Iterable[ScenePart]) -> list[ScenePart]:
    """Return parts from back to front, by rising layer."""
    return sorted(parts, key=lambda part: part.layer)


@dataclass(frozen=True)
class Label:
    """Names of symbols, written with commas at a place of the picture; ``box`` is (left, top, width, height) [px]."""

    names: tuple[str, ...]
    centre: Pair
    role: Role
    elements: tuple[str, ...] = ()
    box: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    size: float = 15.0


@dataclass(frozen=True)
class Scene:
    """A picture of a system.

    ``positions`` are the places r [m] of the anchors in the pose that is drawn. ``origin`` [px], ``scale`` [px/m] and
    ``view`` are those of the module's formula. ``description`` says in words what is seen; ``missing`` says what is not
    drawn, each with the line of ``[look]`` that helps.
    """

    name: str
    size: Pair
    origin: Pair
    scale: float
    view: tuple[tuple[float, ...], tuple[float, ...]]
    positions: tuple[tuple[float, ...], ...]
    parts: tuple[ScenePart, ...]
    labels: tuple[Label, ...]
    description: str = ""
    missing: tuple[str, ...] = ()
    trail: tuple[int, ...] = ()
    handles: tuple[int, ...] = field(default=())
    """The anchors that a pointer can take hold of in the page: the bodies' centres."""
    room: float | None = None
    """How far [px] bodies that are shifted apart can move without meeting; None if the picture is to scale."""
    pose: Mapping[str, float] = field(default_factory=dict[str, float])
    """The coordinates that are drawn, in SI units, by name."""
    solids: tuple[tuple[int, int, float, float], ...] = ()
    """In space: what is drawn at one depth, about the line between two anchors, with its radius and its lift to the
    eye [px]. A page asks which of them lies in front as things move and as the view turns."""

    flows: tuple[Flow, ...] = ()
    """The charges that flow around the loops of circuits."""
    sizeless: bool = False
    """Whether nothing in it has a size [m]: displacements are then drawn as large as can be seen well."""

    def seen(self, anchor: int, shift: Pair = (0.0, 0.0)) -> Pair:
        """The place of an anchor in the picture [px]."""
        r = self.positions[anchor]
        x, y = (sum(a * b for a, b in zip(row, r, strict=True)) for row in self.view)
        return self.origin[0] + self.scale * x + shift[0], self.origin[1] + self.scale * y + shift[1]


def as_data(scene: Scene) -> dict[str, Any]:
    """What moves in a scene as plain data for JSON, from which a page draws the motion."""
    return {
        "size": scene.size,
        "origin": scene.origin,
        "scale": scene.scale,
        "view": scene.view,
        "positions": scene.positions,
        "parts": [_part(part) for part in scene.parts if part.moves],
        "handles": scene.handles,
        "room": scene.room,
        "swing": SWING if scene.sizeless else None,
        "solids": scene.solids,
    }


def _part(part: ScenePart) -> dict[str, Any]:
    placement, shape = part.placement, part.shape
    data: dict[str, Any] = {"role": part.role, "kind": part.kind, "elements": part.elements, "outline": part.outline}
    data |= {"filled": part.filled, "solid": part.solid, "dashed": part.dashed}
    data["layer"], data["paint"] = part.layer, part.paint
    data["placement"] = {
        "at": placement.at,
        "towards": placement.towards,
        "scaling": placement.scaling,
        "shift": placement.shift,
        "shiftTowards": placement.shift_towards,
        "across": placement.across,
    }
    data["facing"], data["group"], data["aside"] = part.facing, part.group, part.aside
    if isinstance(shape, Disc):
        data["disc"] = [*shape.centre, shape.radius]
    elif isinstance(shape, Trace):
        data["trace"] = {"anchors": shape.anchors, "closed": shape.closed, "shifts": shape.shifts}
    else:
        data["path"] = [[letter, *numbers] for letter, numbers in shape.commands]
    return data
