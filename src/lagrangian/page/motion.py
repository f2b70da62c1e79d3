"""A motion of a scene: the places of its anchors in every frame, and a frame that holds all of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from lagrangian.page.ground import extended, laid_out
from lagrangian.page.placing import Drawn, placed, places
from lagrangian.page.scene import SWING, Scene, ScenePart, Trace, drawing_order
from lagrangian.records import dataclass

Array = NDArray[np.float64]

LETTER = 9.0
"""At least how wide a frame is for each letter of the words in it [px]."""
MARGIN = 18.0
"""The space around everything that moves [px]."""

WORDS = 0.04
"""The height of the line of words below the picture, as a share of the width."""

WIDEST, HIGHEST = 640.0, 480.0
"""The largest usual size of the picture [px]."""

THIN = 0.7
"""Lines are widened so that they are shown with at least this share of their width."""

FAR = 6.0
"""Bodies that leave the picture by so many times its size, and stay together, are followed."""

NARROWEST = 0.22
"""The smallest ratio of the shorter side of the frame to the longer one."""


@dataclass(frozen=True, eq=False)
class SceneMotion:
    """A motion of a scene in frames at equal steps of time.

    ``at`` (frames, anchors, 2) are the places of the anchors [px], ``times`` (frames,) the times of the run [s],
    ``duration`` is how long all of it is shown [s]. ``frame`` is the part of the plane that is shown: left, top, width,
    height [px]. ``paths`` (places, 2) are paths that are drawn [px], at equal steps of time, which may be finer than
    those of the frames. ``ending`` says why the motion ends early, if it does.
    ``followed`` is true where the frame moves with the bodies: places are then those seen from the middle of these.
    """

    scene: Scene
    at: Array
    times: Array
    duration: float
    frame: tuple[float, float, float, float]
    paths: tuple[Array, ...] = ()
    ending: str = ""
    followed: bool = False

    @property
    def count(self) -> int:
        """The number of frames."""
        return len(self.times)

    @property
    def pace(self) -> str:
        """How fast the motion is shown, unless it is real time, and whether the frame moves with the bodies."""
        speed = float(self.times[-1] - self.times[0]) / self.duration
        said = [] if abs(speed - 1.0) < 0.02 else [f"{speed:.4g} × real time"]
        return ", ".join([*said, "the frame moves with the bodies"] if self.followed else said)

    @property
    def usual_width(self) -> float:
        """The width [px] in which the picture has the scale of the schematic, or is as large as it may be."""
        _, _, w, h = self.frame
        return min(w, WIDEST, HIGHEST * w / h)

    @property
    def parts(self) -> list[ScenePart]:
        """The parts that are drawn in motion, from back to front."""
        return drawing_order(part for part in self.scene.parts if part.moves and not part.aside)

    def fewer(self, every: int) -> SceneMotion:
        """Return the same motion with every second, third, … frame, and its last frame."""
        kept = np.unique(np.append(np.arange(0, self.count, every), self.count - 1))
        even = np.linspace(float(self.times[0]), float(self.times[-1]), len(kept), dtype=np.float64)
        at = _resampled(self.times, self.at, even)
        return replace(self, at=at, times=even)


def motion(
    scene: Scene, positions: Array, times: Array, *, duration: float, finer: int = 1, ending: str = ""
) -> SceneMotion:
    """Return the motion of a scene whose anchors have ``positions`` [m], (places, anchors, d), at equal steps of time.

    Every ``finer``-th place is a frame, the first and the last one too; ``times`` (frames,) are the times of the frames
    [s]. The paths of the scene's trail go through all places.
    """
    scene = replace(scene, parts=tuple(laid_out(part, positions, scene.handles) for part in scene.parts))
    fine = restrained(scene, places(scene, positions))
    away = _away(scene, fine)
    still = np.ptp(fine, axis=0).max(axis=1) < 1e-6
    fine = fine - away[:, None]
    paths = tuple(fine[:, anchor] + _drawn_at(scene, anchor) for anchor in scene.trail)
    whole = SceneMotion(
        scene, fine[::finer], times, duration, (0.0, 0.0, 0.0, 0.0), paths, ending, bool(np.ptp(away) > 0)
    )
    left, top, right, bottom = _proportioned(*_bounds(whole, still))
    if ending or whole.pace:
        wide = max(0.0, min(WIDEST, LETTER * max(len(ending), len(whole.pace))) - (right - left)) / 2
        left, right = left - wide, right + wide
        bottom += max(2 * LETTER, WORDS * (right - left))
    low, high = away.min(axis=0), away.max(axis=0)
    reach = left + low[0], top + low[1], right + high[0], bottom + high[1]
    parts = tuple(extended(part, fine[0], reach) for part in scene.parts)
    return replace(whole, scene=replace(scene, parts=parts), frame=(left, top, right - left, bottom - top))


def _away(scene: Scene, at: Array) -> Array:
    """How far the frame moves (places, 2) [px]: with the middle of the bodies where these leave the picture for good.

    Only what falls or rolls down does: without gravity it is the path that tells, and the frame holds it. It stays
    where bodies go less than `FAR` times the size of the picture, and where they part.
    """
    stays = np.zeros((len(at), 2))
    if not scene.handles or scene.room is not None or all(part.kind != "gravity" for part in scene.parts):
        return stays
    bodies = at[:, list(scene.handles)]
    middle = bodies.mean(axis=1)
    spread = float(np.hypot(*np.moveaxis(bodies - middle[:, None], -1, 0)).max())
    gone = float(np.hypot(*(middle - middle[0]).T).max())
    return middle - middle[0] if gone > FAR * max(*scene.size, spread) else stays


def _drawn_at(scene: Scene, anchor: int) -> Array:
    """How far from an anchor [px] its body is drawn."""
    bodies = (x.placement.shift for x in scene.parts if x.role == "body" and x.moves and x.placement.at == anchor)
    return np.array(next(bodies, (0.0, 0.0)))


def restrained(scene: Scene, at: Array) -> Array:
    """Return places (frames, anchors, 2) in which bodies that the scene moved apart do not meet.

    Such a scene is not to scale: displacements from its pose are reduced by one factor. Anchors that turn about another
    one keep their distance from it. Where nothing has a size, displacements from the middle of the motion are drawn as
    large as there is room, and at least so large that they can be seen.
    """
    handles, rest = list(scene.handles), places(scene)
    if not handles or (scene.room is None and not scene.sizeless) or (len(handles) < 2 and not scene.sizeless):
        return at
    moved = at - ((at.min(axis=0) + at.max(axis=0)) / 2 if scene.sizeless else rest)
    ways = moved[:, handles]
    apart = max((float(np.hypot(*(ways[:, a] - ways[:, b]).T).max()) for a, b in combinations(range(len(handles)), 2)),
                default=2 * float(np.hypot(*ways[:, 0].T).max()))  # fmt: skip
    factor = 2 * scene.room / apart if scene.room is not None and apart > 0 else np.inf
    if factor >= 1.0:
        most = float(np.hypot(*np.moveaxis(ways, -1, 0)).max())
        seen = scene.sizeless and most > 1e-9 * scene.scale
        factor = max(1.0, min(factor, (scene.room or SWING) / most)) if seen else 1.0
    if factor == 1.0 and (scene.room is None or not scene.sizeless):
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


def _bounds(motion: SceneMotion, still: NDArray[np.bool_]) -> tuple[float, float, float, float]:
    """The smallest frame that holds all parts in all frames, with the margin around it.

    Where the frame moves with the bodies, parts at anchors that are ``still`` (anchors,) pass by.
    """
    boxes: list[tuple[float, float, float, float]] = []
    for part in motion.parts:
        used = part.shape.anchors if isinstance(part.shape, Trace) else (part.placement.at, part.placement.towards)
        if motion.followed and all(still[k] for k in used if k is not None):
            continue
        if (box := extent(placed(part, motion.at))) is not None:
            half = part.outline / 2
            boxes.append((box[0] - half, box[1] - half, box[2] + half, box[3] + half))
    boxes += [box for path in motion.paths if (box := extent([("M", path)])) is not None]
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
