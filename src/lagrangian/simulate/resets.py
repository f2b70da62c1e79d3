"""Resets whose value is not finite: the run ends at the state before the event, with the reason."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import RunError
from lagrangian.integrate.scipy_methods import Outcome
from lagrangian.integrate.status import RunStatus

if TYPE_CHECKING:
    from lagrangian.codegen import Kernel

Array = NDArray[np.float64]

NOT_A_VALUE = "E503"
"""The error code of outputs that are not finite."""


def valued(kernel: Kernel) -> Callable[..., dict[str, Array]]:
    """The outputs ``g`` and ``after`` of events, in which a value that is not finite is returned instead of raising an
    error."""
    shapes = {name: out.shape for name, out in kernel.program.outputs.items()}

    def evaluate(x: Array, u: Any, p: Array, t: Any) -> dict[str, Array]:
        try:
            answer = kernel(x, u, p, t)
            return answer if isinstance(answer, dict) else {"g": answer}
        except RunError as trouble:
            if trouble.code != NOT_A_VALUE:  # such as an input that is not finite
                raise
        found = {name: np.empty(shape) for name, shape in shapes.items()}
        with contextlib.suppress(RunError):  # the same call again, with every value returned
            kernel(x, u, p, t, out=found)
        return found

    return evaluate


def cut_at(outcome: Outcome, k: int, status: RunStatus, reason: str) -> Outcome:
    """Return the outcome, ended by the reset of its event number k, whose state is not taken over."""
    hit = outcome.hits[k]
    kept = int(np.searchsorted(outcome.times, hit.time, side="right"))
    return replace(
        outcome,
        times=outcome.times[:kept],
        states=outcome.states[:kept],
        status=status,
        reached=hit.time,
        final=hit.before,
        hits=[*outcome.hits[:k], replace(hit, after=None)],
        reason=reason,
    )


def ended(outcome: Outcome, states: Sequence[str], titles: Sequence[str]) -> Outcome:
    """Return the outcome cut at the first event whose reset leaves a state without a finite value.

    ``states`` are the names of the states, ``titles`` those of the events.
    """
    for k, hit in enumerate(outcome.hits):
        if hit.after is None or np.isfinite(hit.after).all():
            continue
        first = next(f"{name} = {x}" for name, x in zip(states, hit.after, strict=False) if not np.isfinite(x))
        said = f"[{NOT_A_VALUE}] the reset of event '{titles[hit.index]}' gives {first}"
        return cut_at(outcome, k, RunStatus.NOT_FINITE, said)
    return outcome
