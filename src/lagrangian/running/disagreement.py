"""Why an energy balance is missed: steps that are too long, or a motion and an energy that contradict each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lagrangian import compile as machine
from lagrangian import dynamics
from lagrangian.errors import RunError
from lagrangian.graph import evaluate

if TYPE_CHECKING:
    from lagrangian.running.trajectory import Trajectory

LOOKS = 12
"""States of the run at which the balance is looked at."""

TOLERANCE = 1e-6
"""What dh/dt − P may differ from 0 by, relative to the largest of its terms in the run: more than rounding is a
contradiction. At one state all terms may cancel, as where the run begins at rest."""

CONTRADICTIONS = (
    "the energy does not change by the power supplied",
    "the compiled rates are not those of the equations",
)


def disagreement(run: Trajectory) -> str:
    """Say where the compiled system contradicts its own energy or its own formulas; empty where it does not.

    At states of the run dh/dt along the accelerations must be the power supplied, whatever the steps were, and the
    compiled rates must be those of the slow evaluation. What is missed although both hold is the integration's.
    """
    terms = dynamics.balance_terms_closed(run.model, run.feedback)
    rates = dynamics.closed(run.model, run.feedback)
    kernel = machine.compile(rates)
    times, offs, sizes = [], [], []
    for k in np.unique(np.linspace(0, len(run.t) - 1, LOOKS).astype(int)):
        state = {"x": run.y[:, k].tolist(), "u": run.u[k].tolist(), "p": run.p.tolist(), "t": [float(run.t[k])]}
        balance = np.array(evaluate(terms, state)["terms"], float)
        slow = np.array(evaluate(rates, state)["xdot"], float)
        try:
            fast = np.asarray(kernel(np.array(state["x"]), np.array(state["u"]), run.p, state["t"][0]))
        except RunError:
            continue
        if not np.isfinite([*balance, *slow]).all():  # a state without finite rates says nothing about either
            continue
        times.append(float(run.t[k]))
        offs.append((abs(balance.sum()), np.abs(fast - slow).max()))
        sizes.append((np.abs(balance).max(), np.abs(slow).max()))
    if not times:
        return ""
    share = np.array(offs) / np.maximum(np.max(sizes, axis=0), np.finfo(float).tiny)
    k, which = np.unravel_index(np.argmax(share), share.shape)
    if not share[k, which] > TOLERANCE:
        return ""
    return (
        f"the compiled system and its energy disagree: at t = {times[k]:.4g} s {CONTRADICTIONS[which]} "
        f"({100 * share[k, which]:.2g} % off). Do not use this run; `verify` shows which part is wrong"
    )
