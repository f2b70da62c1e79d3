"""Tells a wrong function of an angle by what was written: by the term of the equation, where no energy is stated.

"In the velocity terms, sin θ stands in place of cos θ" is said of the one term that has it, and "In the weight,
cos(α + θ) stands in place of cos θ" is said of the sine in the equation if the answer has no V.
"""

from __future__ import annotations

from collections.abc import Set
from dataclasses import replace

import numpy as np

from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.search import SMALL, Told

FUNCTIONS = ("sine_cosine", "tangent", "angle", "double_angle")
"""The kinds of changes that only exchange a function of an angle."""
POWERS = ("not_squared", "squared")
"""Those that only change the power of a letter."""


def narrowed(pool: Pool, told: Told, kinds: Set[str]) -> Told:
    """The same change in the single term of an equation, or in what an element adds to it; ``kinds`` are those of the
    lines of the answer."""
    change = told.mistake.change
    place = pool.places[id(told.mistake)]
    if change is None or change.kind not in (*FUNCTIONS, *POWERS) or pool.felt[place].sum() != 1:
        return told
    energies = bool(change.site.T and kinds & {"T", "L"}) or bool(change.site.V and kinds & {"V", "L"})
    if energies or change.site.single or change.site.Xi:
        return told
    row, made = int(np.flatnonzero(pool.felt[place])[0]), pool.W[place]
    found = [
        (not c.site.single, p.cost, k)
        for k, p in enumerate(pool.all)
        if (c := p.change) is not None
        and c.kind == change.kind
        and set(c.site.rows) == {row}
        and np.abs(pool.W[k] - made).max() <= SMALL * np.abs(made).max()
    ]
    return replace(told, mistake=pool.all[min(found)[2]]) if found else told
