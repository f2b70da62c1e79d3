"""Animations of SVG without script (SMIL): values at equal steps of time, or at chosen times where that is shorter.

Between two values, browsers go on straight lines. A value may therefore be left out where a straight line comes close
enough to it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from lagrangian.records import dataclass
from lagrangian.write.scene_svg import number

Array = NDArray[np.float64]

TOLERANCE = 0.15
"""How far a value on a straight line may be from the true one [px]."""


@dataclass(frozen=True)
class Timing:
    """How long an animation takes [s], how far its values may be off [px], and how many pixels of the drawing are one
    on the screen."""

    duration: float
    tolerance: float
    zoom: float = 1.0


def key_frames(track: Array, tolerance: float) -> list[int]:
    """Return the frames between which straight lines stay within a tolerance of a track (frames, k).

    It is the method of Ramer (doi:10.1016/S0146-664X(72)80017-0) and of Douglas and Peucker, with distances at equal
    times.
    """
    last = len(track) - 1
    kept, waiting = {0, last}, [(0, last)]
    while waiting:
        a, b = waiting.pop()
        if b - a < 2:
            continue
        share = ((np.arange(a + 1, b) - a) / (b - a))[:, None]
        off = np.abs(track[a + 1 : b] - ((1 - share) * track[a] + share * track[b])).max(axis=1)
        worst = int(np.argmax(off))
        if off[worst] > tolerance:
            middle = a + 1 + worst
            kept.add(middle)
            waiting += [(a, middle), (middle, b)]
    return sorted(kept)


def timed(track: Array, write: Callable[[Array], str], timing: Timing) -> str:
    """Return the attributes ``values``, ``dur``, … of a track whose rows ``write`` turns to text."""
    chosen = key_frames(track, timing.tolerance)
    every = ";".join(map(write, track))
    few = ";".join(write(track[k]) for k in chosen)
    at = ";".join(number(k / (len(track) - 1), 4).removeprefix("0") or "0" for k in chosen)
    shorter = len(few) + len(at) + 12 < len(every)
    values = f'values="{few}" keyTimes="{at}"' if shorter else f'values="{every}"'
    return f'{values} dur="{number(timing.duration, 3)}s" repeatCount="indefinite"'


def animate(attribute: str, track: Array, write: Callable[[Array], str], timing: Timing) -> str:
    """Return the animation of an attribute."""
    return f'<animate attributeName="{attribute}" {timed(track, write, timing)}/>'


def moved(track: Array, timing: Timing) -> str:
    """Return the animation that moves a group to the places of a track (frames, 2)."""
    return _transformed("translate", track, lambda row: ",".join(number(x, 1) for x in row.tolist()), timing)


def turned(angles: Array, reach: float, timing: Timing, *, added: bool) -> str:
    """Return the animation that turns a group by angles [rad], (frames,), whose farthest point is ``reach`` [px] away.

    If it is ``added``, it comes after another animation of the same group.
    """
    digits = 1 if reach < 60 else 2
    scale = max(reach, 1.0)

    def write(row: Array) -> str:
        return number(float(np.degrees(row[0] / scale)), digits)

    return _transformed("rotate", scale * angles[:, None], write, timing, added=added)


def stretched(factors: Array, length: float, timing: Timing) -> str:
    """Return the animation that stretches a group along x by factors (frames,), after it was moved and turned.

    ``length`` [px] is how far it reaches at a factor of 1.
    """

    def write(row: Array) -> str:
        return f"{number(float(row[0]) / length, 4)},1"

    return _transformed("scale", length * factors[:, None], write, timing, added=True)


def _transformed(kind: str, track: Array, write: Callable[[Array], str], timing: Timing, *, added: bool = False) -> str:
    also = ' additive="sum"' if added else ""
    return f'<animateTransform attributeName="transform" type="{kind}"{also} {timed(track, write, timing)}/>'
