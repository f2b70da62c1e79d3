"""The result of an integration."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian.integrate.projection import Drift
from lagrangian.records import dataclass

Array = NDArray[np.float64]
Whole = NDArray[np.int64]


@dataclass
class Solution:
    """N runs at S requested times.

    ``states`` (N, S, nx): NaN after the end of a run that stopped early (with ``store=False`` there are none, S = 0).
    ``status`` (N,): a `RunStatus`. ``reached`` (N,): the time of ``final`` (N, nx), the last state. ``steps``,
    ``rejected``, ``evaluations`` (N,): accepted and rejected steps, evaluations of the derivative. ``event_count``
    (N,), and for the e-th event of a run ``event_index`` (N, E), −1 where there is none, ``event_time`` (N, E) and
    ``event_state`` (N, E, nx), the state before a reset, NaN where there is none; E is the greatest count. ``drift``:
    how far the runs came from the rows of a projection, None without one.
    """

    times: Array
    states: Array
    status: Whole
    reached: Array
    final: Array
    steps: Whole
    rejected: Whole
    evaluations: Whole
    event_count: Whole
    event_index: Whole
    event_time: Array
    event_state: Array
    drift: Drift | None = None
