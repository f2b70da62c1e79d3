"""What a picture needs and a model does not say: hints of ``[look]`` and of `System.look`, checked, in SI units."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from math import pi
from typing import Any

from lagrangian.errors import ModelError, did_you_mean
from lagrangian.look.kinematics import Kinematics
from lagrangian.model import Frame, Model, Point, RigidBody
from lagrangian.model.hints import BODY_KINDS, LINE_KINDS
from lagrangian.quantities.quantity import parse_quantity, unit_dimension
from lagrangian.records import dataclass, field
from lagrangian.values.values import Given, key_name

MOST = 1000
"""The largest number of lines, of shapes, and of points of each."""

Named = Mapping[str, Any]


@dataclass(frozen=True)
class Outline:
    """A closed line through corners [m] in the axes of a frame (None: the fixed axes), from a point of the model.

    ``owner`` is the name of the frame or body by which it was given.
    """

    owner: str
    at: Point
    frame: Frame | None
    corners: tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class LookLine:
    """A line through points of the model that carries no mass and no force."""

    kind: str
    through: tuple[Point, ...]


@dataclass(frozen=True)
class Hints:
    """What a picture needs and a model does not say; all of it is optional.

    ``pose``: coordinate → value in SI units. ``kinds``: body → glyph (``model.hints.BODY_KINDS``). ``azimuth``,
    ``elevation`` [rad]: from where a system in space is seen; None where that is to be chosen. ``trail``: points whose
    path is shown. ``hide``: elements and coordinates. ``lines`` and ``shapes``: what is drawn besides.
    """

    pose: Mapping[str, float] = field(default_factory=dict[str, float])
    kinds: Mapping[str, str] = field(default_factory=dict[str, str])
    azimuth: float | None = None
    elevation: float | None = None
    trail: tuple[Point, ...] = ()
    hide: tuple[str, ...] = ()
    lines: tuple[LookLine, ...] = ()
    shapes: tuple[Outline, ...] = ()


def hints_of(
    model: Model,
    *,
    pose: Mapping[Any, Any] | None = None,
    kinds: Named | None = None,
    azimuth: Any = None,
    elevation: Any = None,
    trail: Sequence[Any] | None = None,
    hide: Sequence[str] | None = None,
    lines: Sequence[Named] | None = None,
    shapes: Sequence[Named] | None = None,
) -> Hints:
    """The hints of a model file, ``[look]``, where an argument does not say otherwise.

    ``pose`` and ``kinds`` are merged entry by entry; every other argument replaces what the file says. Raises
    `ModelError` for a name that the model does not have, and for a value that makes no sense.
    """
    table: Named = model.look
    view: Named = table.get("view", {})
    asked = {**dict(table.get("pose", {})), **{key_name(k): v for k, v in (pose or {}).items()}}
    chosen = {**dict(table.get("kinds", {})), **dict(kinds or {})}
    names = _Names(model)
    return Hints(
        pose=_pose(model, asked),
        kinds=_kinds(model, chosen),
        azimuth=_angle(_first(azimuth, view.get("azimuth")), "azimuth"),
        elevation=_angle(_first(elevation, view.get("elevation")), "elevation"),
        trail=tuple(names.point(x) for x in _listed(_first(trail, table.get("trail"), ()), "trail")),
        hide=names.seen(_listed(_first(hide, table.get("hide"), ()), "hide")),
        lines=tuple(_line(names, x) for x in _listed(_first(lines, table.get("line"), ()), "lines")),
        shapes=tuple(_outline(names, x) for x in _listed(_first(shapes, table.get("shape"), ()), "shapes")),
    )


def _first(*values: Any) -> Any:
    return next((x for x in values if x is not None), None)


def _listed(things: Any, what: str) -> list[Any]:
    if isinstance(things, str | bytes | Mapping) or not isinstance(things, Iterable):
        raise ModelError(f"{what} must be a list (got {type(things).__name__})", code="E406")
    listed = list(things)
    if len(listed) > MOST:
        raise ModelError(f"{what} has {len(listed)} entries", fix=f"give at most {MOST}", code="E406")
    return listed


# -- names ------------------------------------------------------------------------------------------------------------


class _Names:
    """Finds points, bodies and frames by their names."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.bodies = {b.name: b for b in model.bodies}
        self.points = {**{b.name: b.at for b in model.bodies}, **{p.name: p for p in model.points if p.name}}
        self.points["origin"] = model.origin
        self.frames = {f.name: f for f in model.frames if f.name}

    def point(self, name: Any) -> Point:
        """A point by its name, or that of the body at it, or itself."""
        if isinstance(name, Point) and any(name is p for p in self.points.values()):
            return name
        return self.points[_known("point or body", name, self.points)]

    def seen(self, names: Sequence[Any]) -> tuple[str, ...]:
        known = [*(e.name for e in self.model.elements), *(c.name for c in self.model.coordinates)]
        return tuple(_known("element or coordinate", name, known) for name in names)

    def axes(self, name: Any) -> tuple[str, Point, Frame | None]:
        """The origin and axes of a frame or of a body."""
        asked = name.name if isinstance(name, Frame) else name
        text = _known("frame or body", asked, {**self.frames, **self.bodies})
        if (frame := self.frames.get(text)) is not None:
            return text, frame.origin, frame
        body = self.bodies[text]
        return text, body.at, body.frame if isinstance(body, RigidBody) else None


def _known(what: str, name: Any, known: Iterable[str]) -> str:
    listed = list(known)
    if not isinstance(name, str) or name not in listed:
        few = ", ".join(listed[:12]) + (", …" if len(listed) > 12 else "")
        fix = did_you_mean(str(name)[:64], listed) or f"known: {few or 'none has a name'}"
        raise ModelError(f"there is no {what} '{str(name)[:64]}'", fix=fix, code="E412")
    return name


# -- values -----------------------------------------------------------------------------------------------------------


def _pose(model: Model, asked: Named) -> dict[str, float]:
    if not asked:
        return {}
    names = [c.name for c in model.coordinates]
    given = Given.of(model, Kinematics(model).program(()))
    values = given.states.values(asked)
    if rates := [name for name in values if name not in names]:
        raise ModelError(f"'{rates[0]}' is no coordinate, and a pose has only these", code="E402")
    return values


def _kinds(model: Model, chosen: Named) -> dict[str, str]:
    for body, kind in chosen.items():
        _known("body", body, (b.name for b in model.bodies))
        if kind not in BODY_KINDS:
            fix = did_you_mean(str(kind)[:64], BODY_KINDS) or f"kinds: {', '.join(BODY_KINDS)}"
            raise ModelError(f"body '{body}' cannot be drawn as '{str(kind)[:40]}'", fix=fix, code="E402")
    return dict(chosen)


def _angle(value: Any, what: str) -> float | None:
    if value is None:
        return None
    angle = parse_quantity(value, what=what).value if isinstance(value, str) else value
    if isinstance(angle, bool) or not isinstance(angle, int | float) or not abs(angle) <= 4 * pi:
        raise ModelError(f"{what} must be an angle within two turns (got {value!r:.60})", code="E406")
    return float(angle)


def _length(value: Any, what: str) -> float:
    if isinstance(value, str):
        quantity = parse_quantity(value, what=what)
        if not quantity.is_bare and quantity.dimension.exponents != unit_dimension("m"):
            raise ModelError(f"{what} must be a length (got {value!r:.60})", fix="write '0.2 m'", code="E408")
        value = quantity.value
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise ModelError(f"{what} must be a length [m] (got {value!r:.60})", code="E406")
    return float(value)


def _line(names: _Names, table: Any) -> LookLine:
    given = _table(table, "a line", ("through", "kind"))
    kind = given.get("kind", "string")
    if kind not in LINE_KINDS:
        fix = did_you_mean(str(kind)[:64], LINE_KINDS) or f"kinds: {', '.join(LINE_KINDS)}"
        raise ModelError(f"a line cannot be drawn as '{str(kind)[:40]}'", fix=fix, code="E402")
    through = _listed(given.get("through", ()), "the points of a line")
    if len(through) < 2:
        raise ModelError(f"a line runs through {len(through)} points", fix="give at least two", code="E414")
    return LookLine(kind, tuple(names.point(x) for x in through))


def _outline(names: _Names, table: Any) -> Outline:
    given = _table(table, "a shape", ("frame", "at", "box", "points"))
    owner, origin, frame = names.axes(given.get("frame"))
    at = origin if given.get("at") is None else names.point(given["at"])
    if ("box" in given) == ("points" in given):
        raise ModelError("a shape has either 'box' or 'points'", fix="box=[width, height]", code="E401")
    corners = [_corner(names.model, x) for x in _listed(given.get("points", ()), "the points of a shape")]
    if "box" in given:
        sides = [_length(x, "a side of a box") for x in _listed(given["box"], "a box")]
        if len(sides) != 2 or min(sides) <= 0:
            raise ModelError("a box has a width and a height, both greater than 0", code="E406")
        w, h = sides[0] / 2, sides[1] / 2
        more = (0.0,) * (names.model.dimension - 2)
        corners = [(x, y, *more) for x, y in ((-w, -h), (w, -h), (w, h), (-w, h))]
    if len(corners) < 2:
        raise ModelError(f"a shape has {len(corners)} points", fix="give at least two", code="E414")
    return Outline(owner, at, frame, tuple(corners))


def _corner(model: Model, given: Any) -> tuple[float, ...]:
    found = [_length(x, "a component of a shape") for x in _listed(given, "a point of a shape")]
    if len(found) not in (2, model.dimension):
        raise ModelError(f"a point of a shape has {len(found)} components", fix="give two", code="E414")
    return (*found, *(0.0,) * (model.dimension - len(found)))


def _table(given: Any, what: str, known: tuple[str, ...]) -> dict[str, Any]:
    if not isinstance(given, Mapping):
        raise ModelError(f"{what} is given by a mapping (got {type(given).__name__})", code="E406")
    table: dict[str, Any] = {str(k): v for k, v in given.items() if v is not None}  # type: ignore[reportUnknownVariableType]
    for key in table:
        if key not in known:
            fix = did_you_mean(key[:64], known) or f"known: {', '.join(known)}"
            raise ModelError(f"{what} has no '{key[:64]}'", fix=fix, code="E405")
    return table
