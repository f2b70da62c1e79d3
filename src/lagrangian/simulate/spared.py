"""Rows of constraints that follow from others along a run: how they are found, and what is said of them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lagrangian.assembly.spare import check_slopes, spare_rows
from lagrangian.codes import Code
from lagrangian.errors import Notice
from lagrangian.integrate.closing import Closing
from lagrangian.integrate.design import Design
from lagrangian.model import Model
from lagrangian.model.spare import SpareRows

Array = NDArray[np.float64]

EXAMINED = 8
"""The number of runs of an ensemble at whose starts the rows are examined."""


def of_run(model: Model, x: Array, p: Array, t: float) -> tuple[Model, tuple[Notice, ...]]:
    """The model that knows which rows are spare along a run from x, and a notice about them."""
    if not model.constraints:
        return model, ()
    n, m = len(model.coordinates), len(model.velocities)
    check_slopes(model, x[:n], p, t)
    return _knowing(model, spare_rows(model, x[:n], x[n : n + m], p, t))


def of_runs(model: Model, design: Design, closing: Closing | None, t: float) -> tuple[Model, tuple[Notice, ...]]:
    """The same for many runs: the rows that are spare in all of those examined."""
    if closing is None:
        return model, ()
    n, m = len(model.coordinates), len(model.velocities)
    common: set[SpareRows] | None = None
    for k in dict.fromkeys(np.linspace(0, design.count - 1, EXAMINED).astype(int).tolist()):
        row = design.rows(k, k + 1)
        p = row.p if row.p.ndim == 1 else row.p[0]
        x, closed = closing.closed(row.x, p, t)
        if not closed[0]:
            continue
        check_slopes(model, x[0, :n], p, t)
        found = set(spare_rows(model, x[0, :n], x[0, n : n + m], p, t))
        common = found if common is None else common & found
        if not common:
            break
    return _knowing(model, sorted(common or (), key=lambda spare: spare.names))


def _knowing(model: Model, spare: Sequence[SpareRows]) -> tuple[Model, tuple[Notice, ...]]:
    return model.sparing(tuple(spare)), tuple(Notice(Code.E508, "constraints", _said(s)) for s in spare)


def _said(spare: SpareRows) -> str:
    names = ", ".join(f"'{name}'" for name in spare.names)
    one = spare.count == 1
    return (
        f"of {names}, {'one follows' if one else f'{spare.count} follow'} from the others wherever all of them hold: "
        f"at each time {'one is' if one else f'{spare.count} are'} left out, with the multiplier 0, and still checked; "
        "the sum of their forces is right, but the share of each is not determined by rigid bodies"
    )
