"""What comes back from an integration."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from .methods import memory_layout

Array = NDArray[np.float64]
Whole = NDArray[np.int64]

STATUS: Mapping[int, str] = MappingProxyType(
    {
        memory_layout.REACHED: "the end was reached",
        memory_layout.TERMINAL: "a terminal event ended the run",
        memory_layout.UNDERFLOW: "the step size fell below the resolution of time",
        memory_layout.NOT_FINITE: "the derivative or the state is not finite",
        memory_layout.TOO_MANY: "the limit on the number of steps was reached",
        memory_layout.ZENO: "events accumulate: too many change the state, or no time passes between them",
        memory_layout.NO_CONVERGENCE: "the implicit stages do not converge",
        memory_layout.LATE: "the time allowed for computing was over",
        memory_layout.CHATTERS: "the motion sticks where a force jumps: steps get ever shorter, or jump to and fro",
        memory_layout.CROWDED: "the limit on the number of events was reached",
        memory_layout.BLIND: "the condition of an event is not a number",
        memory_layout.UNFIT: "a mass is not above 0, or a moment of inertia is below",
    }
)
"""What the numbers in ``Solution.status`` mean; negative ones are failures."""


@dataclass
class Solution:
    """N runs at S requested times.

    ``states`` (N, S, nx): NaN after the end of a run that stopped early (with ``store=False`` there are none, S = 0).
    ``status`` (N,): a key of `STATUS`. ``reached`` (N,): the time of ``final`` (N, nx), the last state. ``steps``,
    ``rejected``, ``evaluations`` (N,): accepted and rejected steps, evaluations of the derivative. ``event_count``
    (N,), and for the e-th event of a run ``event_index`` (N, E), −1 where there is none, ``event_time`` (N, E) and
    ``event_state`` (N, E, nx), the state before a reset, NaN where there is none; E is the greatest count.
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
