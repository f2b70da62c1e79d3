"""The layout of memory: the table that Python fills, the head of the work space, and the slots of the lanes."""

from __future__ import annotations

from lagrangian.records import dataclass, field

from .printer import Printer, Vec

TABLE = (
    "x0", "x0_row", "u", "u_row", "p", "p_row", "shared", "times", "samples", "states", "states_row", "states_step",
    "final", "status", "reached", "steps", "rejected", "evaluations", "event_count", "rtol", "atol", "step",
    "max_step", "max_steps", "knots", "knot_count", "knot_start", "knot_slope", "max_events",
    "guard_shared", "after_shared", "bounds_shared", "approach_shared", "landing_shared", "drift",
)  # fmt: skip
"""Entries of the table: addresses, strides in bytes, counts, and ``rtol``, ``step``, ``max_step`` as doubles."""

CURSOR, LAST, LOGGED, BUDGET, QUIT, LOG, ROOM = range(7)
"""Words of the work space's head: next run, end of the range, number of logged events, steps left, whether to stop,
address of the log and its capacity."""

EMPTY, NEW, RESTARTED, RUNNING, ENDED, STOPPED, AT_EVENT = range(7)
"""The state of a lane: it has no run; it begins; it continues after a change of the right-hand side; it runs; its run
is over; it reached a stop point; it left a step at an event."""

DONE, PAUSED, FULL = 0, 1, 2
"""Why the machine code returned: all runs of the range are finished, the budget is used up, the log of events is
full."""


@dataclass
class Lanes:
    """The slots of a problem's lanes; ``x`` … ``k`` are vectors, the others have one slot each."""

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
        """The slots that Python examines between two calls, in the order of `PLACES`."""
        assert self.x.slot is not None
        return (self.state, self.code, self.run, self.t, self.steps, self.rejected, self.x.slot)


PLACES = ("state", "code", "run", "t", "steps", "rejected", "x")
"""The names of `Lanes.places`."""

MARGIN = 2.0**-50
"""In a step that ends at a stop point, conditions are evaluated by this fraction of t earlier, so that they have not
switched."""
