"""How runs end."""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum


class RunStatus(IntEnum):
    """How a run ended, with a ``message`` in words; negative numbers are failures, or runs without results.

    >>> RunStatus(-3).message
    'the limit on the number of steps was reached'
    """

    message: str

    def __new__(cls, value: int, message: str) -> RunStatus:
        """Make a member, which is the number."""
        made = int.__new__(cls, value)
        made._value_, made.message = value, message
        return made

    TERMINAL = 1, "a terminal event ended the run"
    REACHED = 0, "the end was reached"
    UNDERFLOW = -1, "the step size fell below the resolution of time"
    NOT_FINITE = -2, "the derivative or the state is not finite"
    TOO_MANY = -3, "the limit on the number of steps was reached"
    ZENO = -4, "events accumulate: too many change the state, or no time passes between them"
    NO_CONVERGENCE = -5, "the implicit stages do not converge"
    LATE = -6, "the time allowed for computing was over"
    UNFIT = -7, "a mass is not above 0, or a moment of inertia is below"
    CHATTERS = -8, "the motion sticks where a force jumps: steps get ever shorter, or jump to and fro"
    CROWDED = -9, "the limit on the number of events was reached"
    BLIND = -10, "the condition of an event is not a number"
    BROKEN = -11, "an event leaves a state that breaks a constraint"
    APART = -13, "a row of constraints that followed from the others does so no more"
    OPEN = -12, "no start near the given one satisfies the constraints"
    PARADOX = -14, "friction and the force that presses on it do not determine each other (Painlevé's paradox)"
    LOST = -127, "its results are damaged"
    NOT_RUN = -128, "not run yet"


def reason_of(status: int) -> str:
    """Return the message of a status, also of one that a later version wrote into a store."""
    try:
        return RunStatus(status).message
    except ValueError:
        return f"status {status}"


def endings_of(counts: Mapping[str, int], count: int) -> tuple[str, ...]:
    """Return how ``count`` runs ended, from the number of runs for each message.

    >>> endings_of({"the end was reached": 2, "its results are damaged": 1}, 3)
    ('2 of 3: the end was reached', '1 of 3: its results are damaged')
    """
    if set(counts) == {RunStatus.REACHED.message}:
        return ("it reached the end" if count == 1 else "all reached the end",)
    return tuple(f"{n} of {count}: {words}" for words, n in counts.items())
