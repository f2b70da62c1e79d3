"""From where a system in space is seen: so that arcs are open, links are long and joints lie apart."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.holds import Motions
from lagrangian.look.kinematics import Views
from lagrangian.look.pose import views_of
from lagrangian.look.space_turns import Spin, axis_now

Array = NDArray[np.float64]

AZIMUTHS = tuple(a * pi / 180 for a in (40, 28, 52, 64, 18, -28, -40, -55, -68, 76, 118, 140))
ELEVATIONS = tuple(a * pi / 180 for a in (20, 26, 32, 15))
OPEN, LONG, APART = 0.38, 0.75, 0.16
"""What an arc's narrowness, a link's seen part of its length, and the distance of joints should not fall below."""


def best_view(
    motions: Motions, spins: list[Spin], rods: list[tuple[int, int]], wheels: list[tuple[int, float, Array]],
    rings: list[Array], seen: Views,
    azimuth: float | None, elevation: float | None,
) -> Array:  # fmt: skip
    """The projection (2, 3) with the least cost; a given azimuth or elevation is kept."""
    r = seen.r[0]
    axes = np.array([axis_now(s, seen) for s in spins] + rings).reshape(-1, 3)
    links = np.array([r[b] - r[a] for a, b in rods if np.linalg.norm(r[b] - r[a]) > 1e-9]).reshape(-1, 3)
    joints = sorted({k for rod in rods for k in rod} | {s.joint for s in spins})
    spots = _distinct(r[joints]) if joints else np.zeros((0, 3))
    size = float(np.ptp(spots, axis=0).max()) if len(spots) > 1 else 1.0
    azimuths = AZIMUTHS if azimuth is None else (azimuth,)
    elevations = ELEVATIONS if elevation is None else (elevation,)
    grid = [x.ravel() for x in np.meshgrid(azimuths, elevations, indexing="ij")]
    views = views_of(motions, *grid)
    cost = np.add.outer(0.012 * np.arange(len(azimuths)), 0.03 * np.arange(len(elevations))).ravel()
    cost += _costs(views, axes, links, spots / (size or 1.0))
    cost += sum(_hidden(views, chain, r[k], radius) for k, radius, chain in wheels)
    return views[int(np.flatnonzero(cost < cost.min() + 1e-12)[0])]


def _eyes(views: Array) -> Array:
    """The directions from which the views (v, 2, 3) are seen."""
    return np.cross(views[:, 0], -views[:, 1])


def _hidden(views: Array, chain: Array, centre: Array, radius: float) -> Array:
    """How much of a line on the floor (n, 3) lies behind a wheel in each view: 0 to 1."""
    near = np.linalg.norm((chain - centre) @ views.swapaxes(1, 2), axis=2) < radius
    return np.mean(near & (_eyes(views) @ (chain - centre).T < 0.0), axis=1)


def _distinct(r: Array) -> Array:
    found: list[Array] = []
    for x in r:
        if all(float(np.linalg.norm(x - y)) > 1e-9 for y in found):
            found.append(x)
    return np.array(found)


def _costs(views: Array, axes: Array, links: Array, spots: Array) -> Array:
    """How narrow arcs are, how short links, and how near joints, in each view (v, 2, 3)."""
    across = views.swapaxes(1, 2)
    narrow = np.maximum(0.0, OPEN - np.abs(_eyes(views) @ axes.T)) / OPEN
    seen = np.linalg.norm(links @ across, axis=2) / np.linalg.norm(links, axis=1)
    short = np.maximum(0.0, LONG - seen) / LONG
    one, two = np.tril_indices(len(spots), -1)
    gaps = np.linalg.norm((spots[one] - spots[two]) @ across, axis=2)
    near = np.maximum(0.0, APART - gaps) / APART
    return 1.6 * (narrow**2).sum(axis=1) + 2.0 * (short**2).sum(axis=1) + 0.5 * near.sum(axis=1)
