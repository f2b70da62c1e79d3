"""Where things are: the table that Python fills, the head of the work space, and the slots of the lanes."""

from __future__ import annotations

from dataclasses import dataclass, field

from .printer import Printer, Vec

TABLE = (
    "x0", "x0_row", "u", "u_row", "p", "p_row", "shared", "times", "samples", "states", "states_row", "states_step",
    "final", "status", "reached", "steps", "rejected", "evaluations", "event_count", "rtol", "atol", "step",
    "max_step", "max_steps", "knots", "knot_count", "knot_start", "knot_slope", "max_events",
    "guard_shared", "after_shared", "bounds_shared", "approach_shared", "landing_shared", "drift",
)  # fmt: skip
"""Entries of the table: addresses, strides in bytes, counts, and ``rtol``, ``step``, ``max_step`` as doubles."""

CURSOR, LAST, LOGGED, BUDGET, QUIT, LOG, ROOM = range(7)
"""Words of the work space's head: next run, end of the range, events logged, steps left, whether to give up,
address of the log and how many events it has room for."""

EMPTY, NEW, RESTARTED, RUNNING, ENDED, STOPPED, AT_EVENT = range(7)
"""What a lane does: nothing; begins; goes on after the right-hand side changed; runs; is over; reached a stop point;
left a step at an event."""

DONE, PAUSED, FULL = 0, 1, 2
"""Why the machine code came back: all runs of the range are over, the budget is spent, the log of events is full."""


@dataclass
class Lanes:
    """The slots of a problem's lanes; ``x`` … ``k`` are vectors, the others one slot each."""

    p: Printer
    inputs: int
    parameters: int
    x: Vec = field(init=False)
    lost: Vec = field(init=False)
    k: Vec = field(init=False)

    def __post_init__(self) -> None:
        p = self.p
        self.x, self.lost, self.k = p.block(), p.block(), p.block()
        self.t, self.h, self.stop, self.next, self.left, self.error = (p.reserve(1) for _ in range(6))
        self.state, self.code, self.run, self.sample, self.knot = (p.reserve(1) for _ in range(5))
        self.steps, self.rejected, self.extra, self.events = (p.reserve(1) for _ in range(4))
        self.knot_time = p.reserve(1)
        self.good, self.end = p.reserve(1), p.reserve(1)
        self.u, self.slope, self.p_in = p.reserve(self.inputs), p.reserve(self.inputs), p.reserve(self.parameters)
        self.sampled = p.block()

    @property
    def places(self) -> tuple[int, ...]:
        """The slots that Python looks at between two calls, in the order of `PLACES`."""
        assert self.x.slot is not None
        return (self.state, self.code, self.run, self.t, self.steps, self.rejected, self.x.slot)


PLACES = ("state", "code", "run", "t", "steps", "rejected", "x")
"""What `Lanes.places` are."""

MARGIN = 2.0**-50
"""Part of it by which one looks before a stop point in a step that ends there: what switches there has not yet."""
