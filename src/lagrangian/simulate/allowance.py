"""What a fit or an optimization may take as a whole: evaluations and seconds."""

from __future__ import annotations

import math
import time

SHARE = 2 / 5
"""The largest share of all evaluations that one of several searches takes, so that some are left for the others."""


class OutOfTimeError(Exception):
    """The time of all searches together is over; whoever searches returns the best so far."""


class OutOfEvaluationsError(Exception):
    """The evaluations of all searches together are used up; whoever searches returns the best so far."""


class Allowance:
    """Evaluations and seconds of all searches together; ``seconds`` None is no limit. The clock starts at once."""

    def __init__(self, evaluations: int, seconds: float | None = None) -> None:
        self.total, self.left = evaluations, evaluations
        self._until = math.inf if seconds is None else time.monotonic() + seconds

    @property
    def over(self) -> bool:
        """Whether the time is over."""
        return self._until < math.inf and time.monotonic() > self._until

    @property
    def used_up(self) -> bool:
        """Whether nothing is left: no evaluation or no time."""
        return self.left <= 0 or self.over

    def part(self) -> int:
        """The evaluations that the next search may take, at least 1."""
        return max(1, min(self.left, math.ceil(SHARE * self.total)))

    def take(self, count: int = 1) -> None:
        """Count evaluations that were made."""
        self.left -= count

    def check(self) -> None:
        """Raise `OutOfTimeError` or `OutOfEvaluationsError` if nothing is left."""
        if self.over:
            raise OutOfTimeError
        if self.left <= 0:
            raise OutOfEvaluationsError
