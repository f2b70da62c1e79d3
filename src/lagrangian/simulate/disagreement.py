"""Finds why an energy balance is violated: steps that are too long, or a motion that contradicts its energy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.errors import RunError
from lagrangian.graph import evaluate

if TYPE_CHECKING:
    from lagrangian.simulate.trajectory import Trajectory

LOOKS = 12
"""The number of states of the run at which the balance is examined."""

TOLERANCE = 1e-6
"""If dh/dt − P exceeds this, relative to its largest term, motion and energy contradict each other."""


def disagreement(run: Trajectory) -> str:
    """Return how the compiled system contradicts its own energy or its own formulas; an empty text if it does not.

    At states of the run, dh/dt along the accelerations must be the supplied power, whatever the steps were, and the
    compiled rates must equal those of the slow evaluation. If both hold, the integration is the cause.
    """
    terms = dynamics.balance_terms_closed(run.model, run.feedback)
    rates = dynamics.closed(run.model, run.feedback)
    kernel = machine.compile(rates)
    worst, where, what = 0.0, 0.0, ""
    for k in np.unique(np.linspace(0, len(run.t) - 1, LOOKS).astype(int)):
        state = {"x": run.y[:, k].tolist(), "u": run.u[k].tolist(), "p": run.p.tolist(), "t": [float(run.t[k])]}
        balance = np.array(evaluate(terms, state)["terms"], float)
        slow = np.array(evaluate(rates, state)["xdot"], float)
        try:
            fast = np.asarray(kernel(np.array(state["x"]), np.array(state["u"]), run.p, state["t"][0]))
        except RunError:  # a state without finite rates says nothing about either
            continue
        for off, size, words in (
            (abs(balance.sum()), np.abs(balance).max(), "the energy does not change by the power supplied"),
            (np.abs(fast - slow).max(), np.abs(slow).max(), "the compiled rates are not those of the equations"),
        ):
            if off > TOLERANCE * size > 0.0 and off / size > worst:  # of a state at rest there are no digits
                worst, where, what = off / size, float(run.t[k]), words
    if not what:
        return ""
    return (
        f"the compiled system and its energy disagree: at t = {where:.4g} s {what} ({100 * worst:.2g} % off). "
        "Do not use this run; `verify` shows which part is wrong"
    )
