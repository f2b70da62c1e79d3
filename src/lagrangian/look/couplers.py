"""Rods between two bodies that are held by something else, such as the rod of a trammel between its sliders.

A model that puts both ends where the angle wants them says nothing of the rod. What it says is that the distance of the
two bodies does not change, while the line between them turns.
"""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
import sympy as sp

from lagrangian.look.holds import HoldKind, Motions


def couplers(motions: Motions, owners: list[Any]) -> list[tuple[int, int]]:
    """Pairs of points of bodies at a constant distance that is a parameter; ``owners`` are the bodies' players."""
    spots = list(dict.fromkeys(x.point for x in owners))
    rigid = [{x.point, *x.points} for x in owners if x.frame is not None]
    sliding = (HoldKind.SLIDE, HoldKind.WIRE)
    found: list[tuple[int, int]] = []
    for a, b in combinations(spots, 2):
        holds = motions.holds[a], motions.holds[b]
        if not any(h.how in sliding for h in holds) or holds[0].holder == b or holds[1].holder == a:
            continue
        if any({a, b} <= body for body in rigid) or motions.relation(b, a).how is not HoldKind.ROD:
            continue
        if isinstance(motions.length(a, b), sp.Symbol) and not any(_along(motions, a, b, h.holder) for h in holds):
            found.append((a, b))
    return found


def _along(motions: Motions, a: int, b: int, holder: int) -> bool:
    """Whether two points keep their angle as seen from a holder: they belong to one rigid rod."""
    r = motions.views.r
    to_a, to_b = r[:, a] - r[:, holder], r[:, b] - r[:, holder]
    sizes = np.linalg.norm(to_a, axis=1) * np.linalg.norm(to_b, axis=1)
    if sizes.min() < 1e-9:
        return False
    return bool(np.ptp((to_a * to_b).sum(axis=1) / sizes) < 1e-9) and bool(np.ptp(sizes) < 1e-9 * sizes.max())
