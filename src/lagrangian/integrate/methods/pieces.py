"""Divides a step into pieces, each so short that no event function can cross zero twice in it.

A piece is settled if, for every function g, bounds of g along the dense output (`graph.bounds`) exclude a zero in it,
or bounds of g′ exclude a turning point; otherwise its first half is examined next. After a piece that was proved, the
next one is twice as long. Pieces are not shorter than `MIN_PIECE`; after `MAX_FINE_PIECES` of them since the last
event, they are not shorter than `COARSE`. All lengths are fractions of the step.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from lagrangian.codegen.ir import Value
from lagrangian.graph import Program, bounds, states_read

from . import memory_layout as at
from .evaluate import PrintedProgram
from .memory_layout import Lanes
from .method import Method, MethodStep
from .printer import Printer, Vec

if TYPE_CHECKING:
    from collections.abc import Callable

    from .lane_scheduler import LaneScheduler

MIN_PIECE = 2.0**-24
"""The shortest piece: two crossings inside one are not noticed."""

COARSE = 2.0**-8
"""The shortest piece once there have been too many."""

MAX_FINE_PIECES = 512
"""The number of pieces since the last event after which none is shorter than `COARSE`."""


class Pieces:
    """Prints the division of a step into pieces."""

    def __init__(
        self, p: Printer, lanes: Lanes, method: Method, service: LaneScheduler, guard: Program, *, own: bool
    ) -> None:
        self.p, self.f, self.lanes, self.method, self.service = p, p.f, lanes, method, service
        self.read = states_read(guard)
        self.tapes = PrintedProgram(p, bounds(guard), "bounds", own=own, copies=1)
        self.span, self.count = p.reserve(1), p.reserve(1)
        self.terms: list[int] = []

    def prepare(self) -> None:
        """Print the code that reads the table, at the start of the function."""
        self.shared = self.p.entry(at.TABLE.index("bounds_shared"), "ptr")

    def begin(self, s: MethodStep, coefficients: list[Vec]) -> None:
        """Print the initial values for a step: the polynomials of the states that are needed, and one piece."""
        p = self.p
        self.terms = []
        for entry in self.read:
            found = self.method.powers(s, coefficients, entry)
            self.terms.append(p.reserve(len(found)))
            for j, c in enumerate(found):
                p.store(c, self.terms[-1], j)
        self.degree = len(coefficients)
        p.store(1.0, self.span)
        p.store(0.0, self.count)

    def refresh(self, busy: str) -> None:
        """Restart the count in lanes that just had an event."""
        p = self.p
        p.store(self.f.select(busy, 0.0, p.load(self.count)), self.count)

    def judged(self, s: MethodStep, inputs: Callable[[Value], Vec], low: Value, busy: str) -> tuple[str, Value]:
        """Examine the next piece of busy lanes; return where it is settled, and its end. The length of the next one is
        stored."""
        p, f = self.p, self.f
        span, count = p.load(self.span), p.load(self.count)
        # settled if proved, or if the piece cannot become shorter
        high = low + span
        high = f.select(f.compare("olt", high, 1.0), high, 1.0)
        proved = self._proved(s, inputs, low, high)
        least = f.select(f.compare("ogt", count, float(MAX_FINE_PIECES)), COARSE, MIN_PIECE)
        length = high - low
        settled = f.logic("or", proved, f.compare("ole", length, least))
        # next length: twice as long after a proof, otherwise half
        longer = f.select(proved, span + span, f.select(f.compare("olt", span, least), least, span))
        following = f.select(settled, longer, length * 0.5)
        p.store(f.select(busy, following, span), self.span)
        p.store(f.select(busy, count + 1.0, count), self.count)
        return f.logic("and", busy, settled), high

    def _proved(self, s: MethodStep, inputs: Callable[[Value], Vec], low: Value, high: Value) -> str:
        """Where no function can cross zero twice between two places of the step."""
        p, f = self.p, self.f
        centre, r = (low + high) * 0.5, (high - low) * 0.5
        origin = self.method.origin
        z = centre - origin
        far = f.intrinsic("fabs", z) + r
        # value, derivative and bound of the second derivative of the states at the centre of the piece
        columns = [self._jet(slot, z, far, r) for slot in self.terms]
        names = ("x", "rate", "bend")
        values = {name: Vec(values=column) for name, column in zip(names, zip(*columns, strict=True), strict=False)}
        t = f.fma(centre, s.h, s.t)
        zero = Value(f, f.constant(0.0))
        slopes = (
            tuple(p.load(self.lanes.slope, k) * s.h for k in range(self.service.inputs))
            if self.service.signals
            else (zero,) * self.service.inputs
        )
        values |= {"u": inputs(t), "drift": Vec(values=slopes), "stretch": Vec(values=(s.h, r))}
        # bounds of every g: clear (no zero) or steady (monotonic) everywhere in the piece
        found = self.tapes.evaluate(self.shared, values, t)
        assert found is not None
        half = len(found) // 2
        proved = ""
        for clear, steady in zip(found[:half], found[half:], strict=True):
            good = f.logic("or", f.compare("ogt", clear, 0.0), f.compare("ogt", steady, 0.0))
            proved = f.logic("and", proved, good) if proved else good
        return proved

    def _jet(self, slot: int, z: Value, far: Value, r: Value) -> tuple[Value, Value, Value]:
        """A polynomial at z: its value, its derivative, and a bound of the second derivative within r.

        ``far`` ≥ |z| + r bounds the third derivative term by term.
        """
        p, f, n = self.p, self.f, self.degree
        zero = Value(f, f.constant(0.0))
        value, rate, bend, third = p.load(slot, n), zero, zero, zero
        # Horner's scheme with two derivatives; then the third derivative's terms in absolute value
        for j in range(n - 1, -1, -1):
            bend = f.fma(bend, z, rate)
            rate = f.fma(rate, z, value)
            value = f.fma(value, z, p.load(slot, j))
        for j in range(n, 2, -1):
            size = f.intrinsic("fabs", p.load(slot, j)) * float(j * (j - 1) * (j - 2))
            third = f.fma(third, far, size)
        return value, rate, f.fma(third, r, f.intrinsic("fabs", bend) * 2.0)
