"""What turns: links, rods and frames with their joints, and how each coordinate turns them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.cast import BodyGlyph, Player
from lagrangian.look.couplers import couplers
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.records import dataclass

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Turn:
    """Something that turns about a joint.

    ``joint`` and ``tip`` are points; the direction from one to the other turns. ``slopes`` (n,) are ∂φ/∂q of its angle
    in the plane, counter-clockwise; in space they are 1 for the coordinates that turn it. ``frame`` is the number of
    its frame, ``name`` the name of its body.
    """

    joint: int
    tip: int
    slopes: Array
    frame: int | None = None
    name: str = ""


def turns_of(motions: Motions, parts: list[Player], tips: dict[int, int]) -> list[Turn]:
    """What turns in a system, in the order of its bodies; ``tips`` are the far ends of links that were drawn."""
    found: list[Turn] = []
    for part in parts:
        if part.frame is not None and motions.turns(part.frame):
            joint, tip = _ends(motions, part, tips)
            slopes = motions.angle_slopes(part.frame)
            found.append(Turn(joint, tip, slopes, part.frame, part.name))
        _rods(motions, part, found)
    for a, b in couplers(motions, parts):
        slopes = _rod_slopes(motions, b, a)
        if slopes is not None:
            found.append(Turn(a, b, slopes))
    return found


def _ends(motions: Motions, part: Player, tips: dict[int, int]) -> tuple[int, int]:
    k = part.point
    if part.glyph in (BodyGlyph.LINK, BodyGlyph.PLATE, BodyGlyph.NONE) and part.points:
        holder = motions.holds[k].holder
        tip = tips.get(k, k)
        if holder not in part.points:  # it turns about its centre
            spine = part.spine or (k, k)
            return k, spine[1] if spine[0] == k else spine[0] if spine[1] == k else spine[1]
        return holder, (k if tip == holder else tip)
    return k, tips.get(k, k)


def _rods(motions: Motions, part: Player, found: list[Turn]) -> None:
    """The rods and ropes that hold a body, up to the ground."""
    k = part.point
    while True:
        hold = motions.holds[k]
        if hold.holder == k:
            return
        known = any(t.tip == k and t.joint == hold.holder for t in found)
        carried = part.frame is not None and (hold.holder in part.points or k in part.points)
        if hold.how in (HoldKind.ROD, HoldKind.TELESCOPE) and not known and not carried:
            slopes = _rod_slopes(motions, k, hold.holder)
            if slopes is not None:
                found.append(Turn(hold.holder, k, slopes, None, part.name))
        k = hold.holder


def _rod_slopes(motions: Motions, k: int, holder: int) -> Array | None:
    """∂φ/∂q of the direction from a holder to a point: (d × ∂d)/|d|²; None where it is not constant."""
    d, D = motions.local(k, holder, None)
    square = (d**2).sum(axis=1)
    slopes = (d[:, 0, None] * D[:, 1] - d[:, 1, None] * D[:, 0]) / square[:, None]
    if np.ptp(slopes, axis=0).max(initial=0.0) > 1e-7:
        return None
    return np.where(np.abs(slopes[0]) < 1e-9, 0.0, slopes[0])
