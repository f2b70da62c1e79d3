"""How each point is held: by a rod, on a slide, at a telescope, on a wire, or not at all."""

from __future__ import annotations

from enum import Enum

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.kinematics import Kinematics
from lagrangian.model import RigidBody
from lagrangian.records import dataclass

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

SAME = 1e-9
"""What is zero or parallel, relative to the sizes that enter."""


class HoldKind(Enum):
    """How a point moves as seen from its holder."""

    FIRMLY = "at rest against its holder"
    ROD = "at a constant distance"
    SLIDE = "along one constant direction"
    TRACK = "along one direction of a frame that moves"
    TELESCOPE = "at a distance that is a coordinate, in a direction that turns"
    WIRE = "along a curve"
    FREE = "freely"


@dataclass(frozen=True)
class Hold:
    """A point (by its number), its holder, and how it is held.

    ``moving`` are the numbers of the coordinates that move it against its holder. ``along`` is the coordinate that is a
    telescope's length, or the only one of a wire. ``frame`` is the number of a track's frame.
    """

    point: int
    holder: int
    how: HoldKind
    moving: tuple[int, ...] = ()
    along: int | None = None
    frame: int | None = None


class Motions:
    """What moves with what, from numbers at random states."""

    def __init__(self, stage: Kinematics) -> None:
        self.stage, self.views = stage, stage.random_views()
        self._slopes: dict[sp.Expr, tuple[Array, Array]] = {}
        v = self.views
        self.size = float(max(1e-12, np.abs(v.r).max()))
        self.moves = np.abs(v.J).max(axis=(0, 1, 2)) if v.J.size else np.zeros(0)
        turning = np.abs(v.RJ).max(axis=(0, 2, 3)) > SAME if v.RJ.size else np.zeros((len(stage.frames), 0), bool)
        self._turns = [tuple(np.flatnonzero(row).tolist()) for row in turning]
        self._moving: dict[int, list[tuple[int, ...]]] = {}
        self._rods: dict[int, Flags] = {}
        self._carried: dict[tuple[int, int | None], Flags] = {}
        self.holds: list[Hold] = []
        for k in range(len(stage.points)):
            self.holds.append(self._hold(k))
        for body in stage.model.bodies:
            if isinstance(body, RigidBody):
                self._held_at_its_ends(body)

    # -- questions ----------------------------------------------------------------------------------------------

    def still(self, k: int) -> bool:
        """Whether a point of the model does not move at all."""
        return (
            k < self.views.J.shape[1]
            and not self.coordinates(k)
            and bool(np.abs(self.views.rt[:, k]).max() < SAME * self.size)
        )

    def coordinates(self, k: int, holder: int = 0) -> tuple[int, ...]:
        """The coordinates that move a point against another."""
        if k not in self._moving:
            change = np.abs(self.views.J - self.views.J[:, k, None]).max(axis=(0, 2))
            moving = change > SAME * np.maximum(1e-3, self.moves)
            self._moving[k] = [tuple(np.flatnonzero(row).tolist()) for row in moving]
        return self._moving[k][holder]

    def even(self, k: int, holder: int, i: int) -> bool:
        """Whether a coordinate moves a point against another one by the same step everywhere."""
        J = self.views.J
        moved = J[:, k, :, i] - J[:, holder, :, i]
        return bool(np.ptp(moved, axis=0).max() < 1e-8 * max(float(np.abs(moved).max()), SAME))

    def turns(self, frame: int | None) -> tuple[int, ...]:
        """The coordinates that turn a frame."""
        return () if frame is None else self._turns[frame]

    def local(self, k: int, centre: int, frame: int | None) -> tuple[Array, Array]:
        """The offset of a point from another in a frame's axes at every state, and its derivatives by coordinates."""
        v = self.views
        d, D = v.r[:, k] - v.r[:, centre], v.J[:, k] - v.J[:, centre]
        if frame is None:
            return d, D
        R, RJ = v.R[:, frame], v.RJ[:, frame]
        return np.einsum("sji,sj->si", R, d), np.einsum("sji,sjn->sin", R, D) + np.einsum("sjin,sj->sin", RJ, d)

    def carried(self, k: int, centre: int, frame: int | None) -> bool:
        """Whether a point is at rest in a body: against its centre, in its axes."""
        key = centre, frame
        if key not in self._carried:
            self._carried[key] = self._all_carried(centre, frame)
        return bool(self._carried[key][k])

    def _all_carried(self, centre: int, frame: int | None) -> Flags:
        """Which points are at rest in a body."""
        v = self.views
        x, X = v.r - v.r[:, centre, None], v.J - v.J[:, centre, None]
        if frame is not None:
            R, RJ = v.R[:, frame], v.RJ[:, frame]
            x, X = x @ R, np.einsum("sji,skjn->skin", R, X) + np.einsum("sjin,skj->skin", RJ, x)
        steady = np.abs(x - x[0]).max(axis=(0, 2)) < 1e-7 * self.size
        return steady & (np.abs(X).max(axis=(0, 2, 3), initial=0.0) < 1e-7 * max(1.0, self.size))

    def in_line(self, one: Hold, two: Hold) -> float | None:
        """The length of the second rod by that of the first, if both are seen as one: on a line, in every position.

        They share a joint, or the second one begins where the first one ends.
        """
        if two.holder not in (one.holder, one.point) or HoldKind.ROD not in (one.how, two.how):
            return None
        r = self.views.r
        first, second = r[:, one.point] - r[:, one.holder], r[:, two.point] - r[:, two.holder]
        ratios = np.einsum("sd,sd->s", second, first) / np.einsum("sd,sd->s", first, first)
        straight = float(np.abs(second - ratios[:, None] * first).max()) < 1e-7 * self.size
        return float(ratios[0]) if straight and one.how is two.how else None

    def length(self, a: int, b: int) -> sp.Expr:
        """A constant distance [m]: the parameter that it is, if it is one, otherwise a number."""
        v = self.views
        name = self.named(float(np.linalg.norm(v.r[0, a] - v.r[0, b])))
        if name is not None:
            return name
        r = self.stage.views([np.full(len(self.stage.inputs.q), 0.5)], self.stage.parameters()).r[0]
        return sp.Float(float(np.linalg.norm(r[a] - r[b])), 17)

    def named(self, value: float) -> sp.Symbol | None:
        """The parameter that has a value at the random parameters."""
        for parameter, known in zip(self.stage.model.parameters, self.views.p, strict=True):
            if abs(known - value) < 1e-11 * abs(value):
                return parameter.symbol
        return None

    def slope_name(self, e: Array) -> str:
        """The parameter that is the angle of a direction at the random parameters against the horizontal, if any."""
        found = self.named(float(np.arctan2(abs(e[1]), abs(e[0]))))
        return "" if found is None else found.name

    def slopes(self, deflection: sp.Expr) -> tuple[Array, Array]:
        """∂δ/∂q (n,) of a deflection at the first two states of ``views``."""
        if deflection not in self._slopes:
            v = self.views
            first, second = (self.stage.slopes(deflection, q, v.p, t=v.t) for q in v.q[:2])
            self._slopes[deflection] = first, second
        return self._slopes[deflection]

    def angle_slopes(self, frame: int) -> Array:
        """In the plane: ∂φ/∂q of a frame's angle (n,), at the first state."""
        R, RJ = self.views.R[0, frame], self.views.RJ[0, frame]
        return R[0, 0] * RJ[1, 0] - R[1, 0] * RJ[0, 0]

    def relation(self, k: int, holder: int) -> Hold:
        """How a point moves as seen from another."""
        moving = self.coordinates(k, holder)
        if not moving:
            return Hold(k, holder, HoldKind.FIRMLY)
        if self._rod(k, holder):
            return Hold(k, holder, HoldKind.ROD, moving)
        d, D = self.local(k, holder, None)
        if _one_direction(D):
            return Hold(k, holder, HoldKind.SLIDE, moving, moving[0] if len(moving) == 1 else None)
        steady = _steady(D)
        for s in moving:
            if steady[s] and self._telescope(d, D, s):
                return Hold(k, holder, HoldKind.TELESCOPE, moving, s)
        track = self._track(k, holder, moving)
        if track is not None:
            return track
        if len(moving) == 1:
            return Hold(k, holder, HoldKind.WIRE, moving, moving[0])
        return Hold(k, holder, HoldKind.FREE, moving)

    def slides(self, k: int, holder: int) -> bool:
        """Whether a point moves along one constant direction as seen from another."""
        D = self.views.J[:, k] - self.views.J[:, holder]
        return _one_direction(D) and self.relation(k, holder).how is HoldKind.SLIDE

    # -- rules --------------------------------------------------------------------------------------------------

    def _rod(self, k: int, holder: int) -> bool:
        """Whether two points keep their distance."""
        if k not in self._rods:
            d, D = self.views.r[:, k, None] - self.views.r, self.views.J[:, k, None] - self.views.J
            lengths = np.abs(d).max(axis=(0, 2))
            radial = np.abs(np.einsum("skd,skdn->skn", d, D)).max(axis=(0, 2), initial=0.0)
            largest = np.maximum(np.abs(D).max(axis=(0, 2, 3), initial=0.0), SAME)
            self._rods[k] = (lengths > SAME * self.size) & (radial < 1e-8 * lengths * largest)
        return bool(self._rods[k][holder])

    def _telescope(self, d: Array, D: Array, s: int) -> bool:
        """d = s u, where |u| is constant, see `_steady`, and the other coordinates turn u."""
        u = D[:, :, s]
        unit = u / np.linalg.norm(u, axis=1)[:, None]
        along = np.einsum("sd,sd->s", d, unit)
        across = np.abs(d - along[:, None] * unit).max()
        others = np.delete(np.einsum("sd,sdn->sn", unit, D), s, axis=1)
        return bool(across < 1e-8 * self.size and (not others.size or np.abs(others).max() < 1e-8 * np.abs(D).max()))

    def _track(self, k: int, holder: int, moving: tuple[int, ...]) -> Hold | None:
        own = self.stage.points[k].frame
        if own is None:
            return None
        frame = self.stage.frames.index(own)
        if not self.turns(frame):
            return None
        _, X = self.local(k, holder, frame)
        if not _one_direction(X):
            return None
        along = np.flatnonzero(np.abs(X).max(axis=(0, 1)) > SAME * max(1.0, np.abs(X).max()))
        return Hold(k, holder, HoldKind.TRACK, moving, int(along[0]), frame)

    def _hold(self, k: int) -> Hold:
        """How a point is held by its parent; where that says little, by the nearest earlier point that holds it."""
        parent = self.stage.points[k].parent
        if parent is None:
            return Hold(k, k, HoldKind.FIRMLY)
        home = self.stage.index(parent)
        first = self.relation(k, home)
        shaken = self._shaken_by(k)
        if shaken is not None:
            return Hold(k, shaken, HoldKind.FIRMLY)
        if first.how is HoldKind.FIRMLY and not self.still(home):
            return self.relation(k, self.holds[home].holder)
        if first.how not in (HoldKind.FREE, HoldKind.WIRE, HoldKind.TELESCOPE):
            return first
        others = [h for h in range(k) if h != home and self.stage.points[h] is not self.stage.points[k]]
        others.sort(key=lambda h: (self.still(h), float(np.linalg.norm(self.views.r[0, k] - self.views.r[0, h]))))
        for h in others:
            moving = self.coordinates(k, h)
            if moving and self._rod(k, h) and len(moving) < len(first.moving) + (first.how is not HoldKind.FREE):
                return Hold(k, h, HoldKind.ROD, moving)
        if first.how is not HoldKind.FREE:
            return first
        carriers = [h for h in others if not {*self.coordinates(k, h)} & {*self.coordinates(h)}]
        found = [self.relation(k, h) for h in carriers]
        for how in (HoldKind.SLIDE, HoldKind.TELESCOPE):
            for hold in found:
                if hold.how is how and len(hold.moving) < len(first.moving):
                    return hold
        return first

    def _held_at_its_ends(self, body: RigidBody) -> None:
        """Hold the centre of a body by one of its points that slide, not by a distance from what it does not meet.

        The middle of a ladder keeps its distance from the corner, but no rod holds it there.
        """
        k, frame = self.stage.index(body.at), self.stage.frames.index(body.axes)
        hold = self.holds[k]
        if hold.how is not HoldKind.ROD or self.carried(hold.holder, k, frame):
            return
        ends = [h for h in range(1, len(self.holds)) if h != k and self.carried(h, k, frame)]
        sliding = [h for h in ends if self.holds[h].how is HoldKind.SLIDE and self.holds[h].holder != k]
        if len(sliding) > 1:
            self.holds[k] = self.relation(k, sliding[0])

    def _shaken_by(self, k: int) -> int | None:
        """The point that carries a point which only time moves against it, such as the axle of an unbalanced rotor."""
        rt = self.views.rt
        if not self.coordinates(k) or float(np.abs(rt[:, k]).max()) < SAME * self.size:
            return None
        for h in range(1, k):
            if not self.coordinates(k, h) and float(np.abs(rt[:, k] - rt[:, h]).max()) > SAME * self.size:
                return h
        return None


def _steady(D: Array) -> NDArray[np.bool_]:
    """Which columns have one length at all states, and not 0."""
    lengths = np.linalg.norm(D, axis=1)
    return (lengths.min(axis=0) >= SAME) & (np.ptp(lengths, axis=0) <= 1e-8 * lengths.max(axis=0))


def _one_direction(D: Array) -> bool:
    """Whether all columns at all states are parallel to one direction."""
    columns = np.moveaxis(D, 1, -1).reshape(-1, D.shape[1])
    sizes = np.linalg.norm(columns, axis=1)
    columns = columns[sizes > SAME * max(sizes.max(initial=0.0), 1e-300)]
    if not len(columns):
        return False
    sizes = np.linalg.norm(columns, axis=1)
    e = columns[0] / sizes[0]
    along = columns @ e
    return bool(np.abs(columns - along[:, None] * e).max() < 1e-8 * sizes.max())
