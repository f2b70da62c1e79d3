"""A motion of a scene: the places of its anchors in every frame, and a frame that holds all of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from lagrangian.page.ground import extended
from lagrangian.page.placing import Drawn, placed, places
from lagrangian.page.scene import Part, Scene

Array = NDArray[np.float64]

MARGIN = 18.0
"""The space around everything that moves [px]."""

NARROWEST = 0.4
"""The smallest ratio of the shorter side of the frame to the longer one."""


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion of a scene in frames at equal steps of time.

    ``at`` (frames, anchors, 2) are the places of the anchors [px], ``times`` (frames,) the times of the run [s],
    ``duration`` is how long all of it is shown [s]. ``frame`` is the part of the plane that is shown: left, top, width,
    height [px]. ``trails`` are the anchors whose paths are drawn. ``ending`` says why the motion ends early, if it
    does.
    """

    scene: Scene
    at: Array
    times: Array
    duration: float
    frame: tuple[float, float, float, float]
    trails: tuple[int, ...] = ()
    ending: str = ""

    @property
    def count(self) -> int:
        """The number of frames."""
        return len(self.times)

    @property
    def parts(self) -> list[Part]:
        """The parts that are drawn in motion, from back to front."""
        return sorted((part for part in self.scene.parts if part.moves), key=lambda part: part.layer)

    def fewer(self, every: int) -> Motion:
        """Return the same motion with every second, third, … frame, and its last frame."""
        kept = np.unique(np.append(np.arange(0, self.count, every), self.count - 1))
        even = np.linspace(float(self.times[0]), float(self.times[-1]), len(kept), dtype=np.float64)
        at = _resampled(self.times, self.at, even)
        return replace(self, at=at, times=even)


def motion(
    scene: Scene,
    positions: Array,
    times: Array,
    *,
    duration: float,
    trails: tuple[int, ...] = (),
    ending: str = "",
) -> Motion:
    """Return the motion of a scene whose anchors have ``positions`` [m], (frames, anchors, d), at ``times`` [s]."""
    at = restrained(scene, places(scene, positions))
    box = _bounds(scene.parts, at, trails)
    left, top, right, bottom = _proportioned(*box)
    parts = tuple(extended(part, at[0], (left, top, right, bottom)) for part in scene.parts)
    frame = (left, top, right - left, bottom - top)
    return Motion(replace(scene, parts=parts), at, times, duration, frame, trails, ending)


def restrained(scene: Scene, at: Array) -> Array:
    """Return places (frames, anchors, 2) in which bodies that the scene moved apart do not meet.

    Such a scene is not to scale: displacements from its pose are reduced by one factor. Anchors that turn about another
    one keep their distance from it.
    """
    if scene.room is None or len(scene.handles) < 2:
        return at
    rest = places(scene)
    moved = at - rest
    pairs = list(combinations(scene.handles, 2))
    apart = max(float(np.max(np.hypot(*(moved[:, a] - moved[:, b]).T))) for a, b in pairs)
    factor = min(1.0, 2 * scene.room / apart) if apart > 0 else 1.0
    if factor == 1.0:
        return at
    found = rest + factor * moved
    for anchor, about in _carried(at):
        found[:, anchor] = found[:, about] + at[:, anchor] - at[:, about]
    return found


def _carried(at: Array) -> Iterator[tuple[int, int]]:
    """Pairs of anchors of which the first does not move straight and keeps its distance from the second, whose own
    place is known by then."""
    spread = at - at.mean(axis=0)
    straight = [np.linalg.svd(spread[:, a], compute_uv=False)[1] < 0.05 for a in range(at.shape[1])]
    known = [a for a, found in enumerate(straight) if found]
    waiting = [a for a, found in enumerate(straight) if not found]
    for about in known:  # grows while it is read: what turns may carry what turns about it
        for anchor in list(waiting):
            distance = np.hypot(*(at[:, anchor] - at[:, about]).T)
            if np.ptp(distance) < 0.05:
                yield anchor, about
                waiting.remove(anchor)
                known.append(anchor)


def extent(drawn: list[Drawn]) -> tuple[float, float, float, float] | None:
    """Return left, top, right and bottom of a shape in all its poses; of curves, of their control points."""
    low, high = np.full(2, np.inf), np.full(2, -np.inf)
    for letter, numbers in drawn:
        if not numbers.size:
            continue
        flat = numbers.reshape(-1, numbers.shape[-1])
        if letter == "O":
            low = np.minimum(low, (flat[:, :2] - flat[:, 2:]).min(axis=0))
            high = np.maximum(high, (flat[:, :2] + flat[:, 2:]).max(axis=0))
        else:
            pairs = flat.reshape(-1, 2)
            low, high = np.minimum(low, pairs.min(axis=0)), np.maximum(high, pairs.max(axis=0))
    return None if np.isinf(low).any() else (float(low[0]), float(low[1]), float(high[0]), float(high[1]))


def _bounds(parts: tuple[Part, ...], at: Array, trails: tuple[int, ...]) -> tuple[float, float, float, float]:
    """The smallest frame that holds all parts in all frames, with the margin around it."""
    boxes = [
        (box[0] - part.outline / 2, box[1] - part.outline / 2, box[2] + part.outline / 2, box[3] + part.outline / 2)
        for part in parts
        if part.moves and (box := extent(placed(part, at))) is not None
    ]
    boxes += [box for a in trails if (box := extent([("M", at[:, a])])) is not None]
    if not boxes:
        return 0.0, 0.0, 100.0, 100.0
    left, top = min(b[0] for b in boxes), min(b[1] for b in boxes)
    right, bottom = max(b[2] for b in boxes), max(b[3] for b in boxes)
    return left - MARGIN, top - MARGIN, right + MARGIN, bottom + MARGIN


def _proportioned(left: float, top: float, right: float, bottom: float) -> tuple[float, float, float, float]:
    """A frame that is neither a thin strip nor a tall one."""
    wide = max(0.0, NARROWEST * (bottom - top) - (right - left)) / 2
    high = max(0.0, NARROWEST * (right - left) - (bottom - top)) / 2
    return left - wide, top - high, right + wide, bottom + high


def _resampled(times: Array, at: Array, wanted: Array) -> Array:
    """Places at other times, on straight lines between frames."""
    i = np.clip(np.searchsorted(times, wanted, side="right") - 1, 0, max(len(times) - 2, 0))
    if len(times) < 2:
        return at[i]
    share = ((wanted - times[i]) / (times[i + 1] - times[i]))[:, None, None]
    return (1 - share) * at[i] + share * at[i + 1]
