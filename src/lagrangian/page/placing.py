"""Where the parts of a scene lie: shapes in the pixels of the picture, in one pose or in many at once.

An array of places has the shape (…, anchors, 2); the axes before that count poses, such as the frames of a motion.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.page.scene import Disc, Label, Placement, Scene, ScenePart, Trace

Array = NDArray[np.float64]

Drawn: TypeAlias = "tuple[str, Array]"
"""A command with its numbers (…, 2k) in pixels; ``O cx cy r`` is a circle."""


def places(scene: Scene, positions: Any = None) -> Array:
    """Return the places in the picture [px], (…, anchors, 2), of positions [m], (…, anchors, d).

    Without positions, they are those of the pose that the scene is drawn in.
    """
    at = np.asarray(scene.positions if positions is None else positions, dtype=float)
    view = np.asarray(scene.view, dtype=float)
    if not at.size:
        return np.zeros((*at.shape[:-1], 2))
    return np.asarray(scene.origin) + scene.scale * (at @ view.T)


def placed(part: ScenePart, at: Array) -> list[Drawn]:
    """Return the commands of a part with all numbers in pixels, for places ``at`` (…, anchors, 2) of the anchors."""
    shape = part.shape
    if isinstance(shape, Trace):
        return _trace(shape, at)
    origin, x, y = axes(part.placement, at)
    if part.facing:  # the other side is seen: nothing is left of the shape
        seen = (x[..., 0] * y[..., 1] - x[..., 1] * y[..., 0] < 0)[..., None]
        if not seen.any():
            return []
        x, y = np.where(seen, x, 0.0), np.where(seen, y, 0.0)
    if isinstance(shape, Disc):
        centre = origin + shape.centre[0] * x + shape.centre[1] * y
        radius = shape.radius * np.hypot(x[..., 0], x[..., 1])
        return [("O", np.concatenate([centre, radius[..., None]], axis=-1))]
    pairs = np.array([v for _, numbers in shape.commands for v in numbers]).reshape(-1, 2)
    spots = origin[..., None, :] + pairs[:, :1] * x[..., None, :] + pairs[:, 1:] * y[..., None, :]
    return _split([(letter, len(numbers) // 2) for letter, numbers in shape.commands], spots)


def _trace(trace: Trace, at: Array) -> list[Drawn]:
    spots = at[..., list(trace.anchors), :]
    if trace.shifts:
        spots = spots + np.array(trace.shifts)
    letters = [("L" if i else "M", 1) for i in range(len(trace.anchors))]
    return _split([*letters, ("Z", 0)] if trace.closed else letters, spots)


def _split(letters: list[tuple[str, int]], spots: Array) -> list[Drawn]:
    """The commands with the places (…, m, 2) that follow one another, each as many as its letter takes."""
    flat, first, drawn = spots.reshape(*spots.shape[:-2], -1), 0, list[Drawn]()
    for letter, count in letters:
        drawn.append((letter, flat[..., 2 * first : 2 * (first + count)]))
        first += count
    return drawn


def axes(placement: Placement, at: Array) -> tuple[Array, Array, Array]:
    """Return the origin of a part's axes and its unit vectors x and y, each (…, 2), in pixels.

    They are oblique for a part in a plane in space. Two anchors at the same place have no direction; x then points to
    the right.
    """
    lead = at.shape[:-2]
    origin = _anchor(placement.at, placement.shift, at)
    if placement.towards is None:
        right, down = np.array([1.0, 0.0]), np.array([0.0, 1.0])
        return origin, np.broadcast_to(right, (*lead, 2)), np.broadcast_to(down, (*lead, 2))
    along = _anchor(placement.towards, placement.shift_towards, at) - origin
    if placement.across is not None:
        return origin, along, _anchor(placement.across, placement.shift, at) - origin
    length = np.hypot(along[..., 0], along[..., 1])[..., None]
    unit = np.where(length > 0, along / np.where(length > 0, length, 1.0), np.array([1.0, 0.0]))
    across = np.stack([-unit[..., 1], unit[..., 0]], axis=-1)
    match placement.scaling:
        case "none":
            return origin, unit, across
        case "along":
            return origin, length * unit, across
        case "both":
            return origin, length * unit, length * across


def _anchor(number: int | None, shift: tuple[float, float], at: Array) -> Array:
    base = np.zeros((*at.shape[:-2], 2)) if number is None else at[..., number, :]
    return base + np.asarray(shift)


def on_bodies(scene: Scene, at: Array) -> Iterator[tuple[Label, bool]]:
    """Return every label of a scene, and whether it stands on the inside of a body."""
    bodies = [_outlined(placed(part, at)) for part in scene.parts if part.filled and part.role == "body"]
    return ((label, any(_inside(label.centre, body) for body in bodies)) for label in scene.labels)


def inside(point: tuple[float, float], drawn: list[Drawn]) -> bool:
    """Whether a point lies inside a circle or a closed shape in one pose; curves count as their chords."""
    return _inside(point, _outlined(drawn))


def _outlined(drawn: list[Drawn]) -> list[list[float]]:
    """The corners of a closed shape, or the middle of a circle and its radius."""
    if len(drawn) == 1 and drawn[0][0] == "O":
        return [drawn[0][1].tolist()]
    return [numbers[-2:].tolist() for _, numbers in drawn if numbers.size]


def _inside(point: tuple[float, float], outline: list[list[float]]) -> bool:
    if len(outline) == 1 and len(outline[0]) == 3:
        x, y, r = outline[0]
        return (point[0] - x) ** 2 + (point[1] - y) ** 2 < r**2
    crossed = False
    for (x0, y0), (x1, y1) in zip(outline, outline[1:] + outline[:1], strict=True):
        if (y0 > point[1]) != (y1 > point[1]) and point[0] < x0 + (x1 - x0) * (point[1] - y0) / (y1 - y0):
            crossed = not crossed
    return crossed
