"""From where a system in space is seen: so that arcs are open, links are long and joints lie apart."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.holds import Motions
from lagrangian.look.kinematics import Views
from lagrangian.look.pose import view_of
from lagrangian.look.space_turns import Spin, axis_now

Array = NDArray[np.float64]

AZIMUTHS = tuple(a * pi / 180 for a in (40, 28, 52, 64, 18, -28, -40, -55, -68, 76, 118, 140))
ELEVATIONS = tuple(a * pi / 180 for a in (20, 26, 32, 15))
OPEN, LONG, APART = 0.38, 0.75, 0.16
"""What an arc's narrowness, a link's seen part of its length, and the distance of joints should not fall below."""


def best_view(
    motions: Motions, spins: list[Spin], rods: list[tuple[int, int]], wheels: list[tuple[int, float, Array]],
    rings: list[Array], views: Views,
    azimuth: float | None, elevation: float | None,
) -> Array:  # fmt: skip
    """The projection (2, 3) with the least cost; a given azimuth or elevation is kept."""
    r = views.r[0]
    axes = np.array([axis_now(s, views) for s in spins] + rings).reshape(-1, 3)
    links = np.array([r[b] - r[a] for a, b in rods if np.linalg.norm(r[b] - r[a]) > 1e-9]).reshape(-1, 3)
    joints = sorted({k for rod in rods for k in rod} | {s.joint for s in spins})
    spots = _distinct(r[joints]) if joints else np.zeros((0, 3))
    size = float(np.ptp(spots, axis=0).max()) if len(spots) > 1 else 1.0
    best, least = view_of(motions, AZIMUTHS[0], ELEVATIONS[0]), float("inf")
    for n, a in enumerate(AZIMUTHS if azimuth is None else (azimuth,)):
        for m, e in enumerate(ELEVATIONS if elevation is None else (elevation,)):
            view = view_of(motions, a, e)
            cost = 0.012 * n + 0.03 * m + _cost(view, axes, links, spots / (size or 1.0))
            cost += sum(_hidden(view, chain, r[k], radius) for k, radius, chain in wheels)
            if cost < least - 1e-12:
                best, least = view, cost
    return best


def _hidden(view: Array, chain: Array, centre: Array, radius: float) -> float:
    """How much of a line on the floor (n, 3) lies behind a wheel: 0 to 1."""
    eye = np.cross(view[0], -view[1])
    near = np.linalg.norm((chain - centre) @ view.T, axis=1) < radius
    return float(np.mean(near & ((chain - centre) @ eye < 0.0)))


def _distinct(r: Array) -> Array:
    found: list[Array] = []
    for x in r:
        if all(float(np.linalg.norm(x - y)) > 1e-9 for y in found):
            found.append(x)
    return np.array(found)


def _cost(view: Array, axes: Array, links: Array, spots: Array) -> float:
    eye = np.cross(view[0], -view[1])
    cost = 0.0
    if len(axes):
        narrow = np.maximum(0.0, OPEN - np.abs(axes @ eye)) / OPEN
        cost += 1.6 * float((narrow**2).sum())
    if len(links):
        seen = np.linalg.norm(links @ view.T, axis=1) / np.linalg.norm(links, axis=1)
        cost += 2.0 * float(((np.maximum(0.0, LONG - seen) / LONG) ** 2).sum())
    for i in range(len(spots)):
        gaps = np.linalg.norm((spots[i] - spots[:i]) @ view.T, axis=1) if i else np.zeros(0)
        cost += 0.5 * float((np.maximum(0.0, APART - gaps) / APART).sum())
    return cost
