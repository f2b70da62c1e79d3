"""The ground of a motion: hatched floors that reach as far as the frame, and grids that reach as far as bodies go."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lagrangian.page.placing import axes
from lagrangian.page.scene import Command, Path, ScenePart

Array = NDArray[np.float64]

FLOOR = "floor"
"""The kind of parts that are extended."""

GRID = "grid"
"""The kind of parts that are laid out where bodies go: squares on the ground in space."""

MOST = 2000
"""The largest number of strokes of the hatching."""

IN_A_ROW = 40
"""How many squares of a grid there are in a row before they become larger."""


def extended(part: ScenePart, at: Array, frame: tuple[float, float, float, float]) -> ScenePart:
    """Return a floor that reaches as far as the frame (left, top, right, bottom) [px]; any other part as it is.

    ``at`` (anchors, 2) are the places of the anchors. The longest straight line of the shape is the floor; the other
    lines are its hatching, which is repeated at its own step.
    """
    if part.kind != FLOOR or not isinstance(part.shape, Path):
        return part
    strokes = _strokes(part.shape)
    if not strokes:
        return part
    longest = max(strokes, key=lambda s: float(np.hypot(*(s[1] - s[0]))))
    start, end = longest
    length = float(np.hypot(*(end - start)))
    if length == 0.0:
        return part
    e = (end - start) / length
    reach = _reach(part, at, frame, start, e)
    if reach is None:
        return part
    low, high = min(0.0, reach[0]), max(length, reach[1])
    ticks = sorted((s for s in strokes if s is not longest), key=lambda s: float((s[0] - start) @ e))
    commands: list[Command] = [("M", _pair(start + low * e)), ("L", _pair(start + high * e))]
    for a, b in _repeated(ticks, start, e, low, high):
        commands += [("M", _pair(a)), ("L", _pair(b))]
    return replace(part, shape=Path(tuple(commands)))


def laid_out(part: ScenePart, positions: Array, handles: tuple[int, ...]) -> ScenePart:
    """Return a grid that reaches two squares beyond wherever bodies go over it; any other part as it is.

    ``positions`` (frames, anchors, 3) [m] are those of the anchors, ``handles`` the anchors of the bodies. The axes of
    a grid go from 0 to 1 along its two sides; its squares keep their size unless there would be very many.
    """
    place = part.placement
    if part.kind != GRID or not isinstance(part.shape, Path) or place.at is None or not handles:
        return part
    strokes = _strokes(part.shape)
    upright = sum(float(a[0]) == float(b[0]) for a, b in strokes)
    counts = upright - 1, len(strokes) - upright - 1
    ways = positions[:, list(handles)] - positions[:1, [place.at]]
    reach: list[tuple[int, int]] = []
    for count, end in zip(counts, (place.towards, place.across), strict=True):
        side = positions[0, end] - positions[0, place.at]
        along = count * (ways @ side) / float(side @ side)
        reach.append((min(0, int(np.floor(along.min() - 2))), max(count, int(np.ceil(along.max() + 2)))))
    every = -(-max(high - low for low, high in reach) // IN_A_ROW)
    (left, right), (top, bottom) = ((every * (low // every), every * -(-high // every)) for low, high in reach)
    n, m = counts
    commands: list[Command] = []
    for i in range(left, right + 1, every):
        commands += [("M", (i / n, top / m)), ("L", (i / n, bottom / m))]
    for i in range(top, bottom + 1, every):
        commands += [("M", (left / n, i / m)), ("L", (right / n, i / m))]
    return replace(part, shape=Path(tuple(commands)))


def _strokes(path: Path) -> list[tuple[Array, Array]]:
    """The straight lines of a shape; none if it has anything else."""
    strokes: list[tuple[Array, Array]] = []
    pen = np.zeros(2)
    for letter, numbers in path.commands:
        point = np.array(numbers[-2:], dtype=float)
        if letter == "L":
            strokes.append((pen, point))
        elif letter != "M":
            return []
        pen = point
    return strokes


def _reach(
    part: ScenePart, at: Array, frame: tuple[float, float, float, float], start: Array, e: Array
) -> tuple[float, float] | None:
    """From where to where along its line the floor is within the frame; None if it is outside of it."""
    origin, x, y = axes(part.placement, at)
    left, top, right, bottom = frame
    foot = origin + start[0] * x + start[1] * y
    step = e[0] * x + e[1] * y
    low, high = -np.inf, np.inf
    for place, rate, least, most in ((foot[0], step[0], left, right), (foot[1], step[1], top, bottom)):
        if abs(rate) < 1e-9:
            if not least <= place <= most:
                return None
            continue
        ends = sorted(((least - place) / rate, (most - place) / rate))
        low, high = max(low, ends[0]), min(high, ends[1])
    return (float(low), float(high)) if np.isfinite(low) and np.isfinite(high) and low < high else None


def _repeated(
    ticks: list[tuple[Array, Array]], start: Array, e: Array, low: float, high: float
) -> list[tuple[Array, Array]]:
    """The hatching from ``low`` to ``high`` along the floor."""
    if len(ticks) < 2:
        return ticks
    places = [float((a - start) @ e) for a, _ in ticks]
    step = float(np.median(np.diff(places)))
    if step <= 0 or (high - low) / step > MOST:
        return ticks
    first, (a, b) = places[0], ticks[0]
    counts = range(int(np.ceil((low - first) / step)), int(np.floor((high - first) / step)) + 1)
    return [(a + n * step * e, b + n * step * e) for n in counts]


def _pair(point: Array) -> tuple[float, float]:
    return float(point[0]), float(point[1])
