"""Which coordinate turns what about which axis in space: an angle belongs to the frame whose own turn it is."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.holds import HoldKind, Motions
from lagrangian.look.kinematics import Views
from lagrangian.look.turning import Turn
from lagrangian.records import dataclass

Array = NDArray[np.float64]

SAME = 1e-8


@dataclass(frozen=True)
class Spin:
    """A coordinate that is an angle.

    It turns ``frame`` against ``base`` (None: the fixed axes) about ``axis``, a unit vector in the axes of ``base``,
    by the right hand; or, with ``frame`` None, the direction from ``joint`` to ``tip``, where an axis that itself moves
    is None. ``tip`` is a point that turns with it, if there is one.
    """

    coordinate: int
    joint: int
    tip: int | None
    frame: int | None
    base: int | None
    axis: Array | None

    def turn(self, count: int, name: str = "") -> Turn:
        """The same as what turns about a joint, for ties and torques."""
        slopes = np.zeros(count)
        slopes[self.coordinate] = 1.0
        return Turn(self.joint, self.joint if self.tip is None else self.tip, slopes, self.frame, name)


def spins_of(motions: Motions, floating: frozenset[int]) -> list[Spin]:
    """The angles among the coordinates, apart from those of ``floating`` frames."""
    found: list[Spin] = []
    of_frames = _of_frames(motions)
    for i in range(len(motions.stage.inputs.q)):
        if i in floating:
            continue
        spin = of_frames.get(i) or _of_rods(motions, i)
        if spin is not None:
            found.append(spin)
    return found


def relative(motions: Motions, frame: int, base: int | None) -> tuple[Array, Array]:
    """The rotation of a frame against another at every state, and its slopes by the coordinates."""
    v = motions.views
    R, RJ = v.R[:, frame], v.RJ[:, frame]
    if base is None:
        return R, RJ
    B, BJ = v.R[:, base], v.RJ[:, base]
    return np.einsum("sji,sjk->sik", B, R), np.einsum("sji,sjkn->sikn", B, RJ) + np.einsum("sjin,sjk->sikn", BJ, R)


def own_turn(motions: Motions, frame: int, base: int | None) -> tuple[int, Array] | None:
    """The one coordinate that turns a frame against another, and its axis, if that is constant."""
    R, RJ = relative(motions, frame, base)
    moving = np.flatnonzero(np.abs(RJ).max(axis=(0, 1, 2)) > SAME)
    if len(moving) != 1:
        return None
    i = int(moving[0])
    W = np.einsum("sik,sjk->sij", RJ[..., i], R)
    n = np.stack([W[:, 2, 1], W[:, 0, 2], W[:, 1, 0]], axis=-1)
    if np.abs(n - n[0]).max() > SAME or abs(float(np.linalg.norm(n[0])) - 1.0) > 1e-6:
        return None
    return i, np.asarray(n[0])


def _of_frames(motions: Motions) -> dict[int, Spin]:
    """The spins that turn frames, by their coordinates: against the frame's parent, else against an earlier frame."""
    stage = motions.stage
    numbers = {id(f): k for k, f in enumerate(stage.frames)}
    parents = [None if f.parent is None else numbers.get(id(f.parent)) for f in stage.frames]
    pairs: list[tuple[int, int | None]] = list(enumerate(parents))
    pairs += [(f, base) for f in range(len(stage.frames)) for base in (None, *range(f)) if base != parents[f]]
    found: dict[int, Spin] = {}
    for f, base in pairs:
        if not (set(motions.turns(f)) | set(motions.turns(base))) - set(found):
            continue
        turn = own_turn(motions, f, base)
        if turn is not None and turn[0] not in found:
            found[turn[0]] = _made(motions, turn[0], f, base, turn[1])
    return found


def _made(motions: Motions, i: int, frame: int, base: int | None, axis: Array) -> Spin:
    """The joint of a frame: from where its points are counted, or those of the frames on it, or its body's centre."""
    stage = motions.stage
    family = [frame]
    for f in range(frame + 1, len(stage.frames)):
        parent = stage.frames[f].parent
        if parent is not None and stage.frames.index(parent) in family:
            family.append(f)
    for level, f in enumerate(family):
        for k, point in enumerate(stage.points):
            if point.parent is not None and point.frame is stage.frames[f]:
                joint = stage.index(point.parent)
                if i in motions.coordinates(joint):
                    continue
                direct = level == 0 and motions.carried(k, joint, frame)
                return Spin(i, joint, k if direct else None, frame, base, axis)
        for body in stage.model.bodies:
            if getattr(body, "frame", None) is stage.frames[f]:
                return Spin(i, stage.index(body.at), None, frame, base, axis)
    return Spin(i, 0, None, frame, base, axis)


def _of_rods(motions: Motions, i: int) -> Spin | None:
    """A coordinate that turns a rod or rope without a frame: about a constant axis, or about one that moves."""
    for k, hold in enumerate(motions.holds):
        if hold.how not in (HoldKind.ROD, HoldKind.TELESCOPE) or i not in hold.moving or i == hold.along:
            continue
        d, D = motions.local(k, hold.holder, None)
        column = D[:, :, i]
        rows = np.concatenate([_cross(-x) for x in d])
        n, *_ = np.linalg.lstsq(rows, column.ravel(), rcond=None)
        about = np.abs(rows @ n - column.ravel()).max() < 1e-8 * motions.size and abs(np.linalg.norm(n) - 1.0) < 1e-6
        if about and float(np.abs(np.einsum("sd,d->s", d, n)).max()) > 1e-6 * motions.size:
            return Spin(i, hold.holder, k, None, None, np.asarray(n, dtype=float))
        lengths, rates = np.linalg.norm(d, axis=1), np.linalg.norm(column, axis=1)
        if np.abs(lengths - rates).max() < 1e-8 * lengths.max():
            return Spin(i, hold.holder, k, None, None, None)
    return None


def _cross(a: Array) -> Array:
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def axis_now(spin: Spin, views: Views) -> Array:
    """The axis of a spin in a pose, as a unit vector in the fixed axes."""
    if spin.axis is not None:
        return spin.axis if spin.base is None else views.R[0, spin.base] @ spin.axis
    assert spin.tip is not None
    d = views.r[0, spin.tip] - views.r[0, spin.joint]
    D = views.J[0, spin.tip, :, spin.coordinate] - views.J[0, spin.joint, :, spin.coordinate]
    n = np.cross(d, D)
    size = float(np.linalg.norm(n))
    return n / size if size > 1e-12 else np.array([0.0, 0.0, 1.0])
