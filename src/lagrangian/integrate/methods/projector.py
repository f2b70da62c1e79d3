"""Projection inside an integrator: states are projected onto their rows, lane by lane, and the drift is recorded."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lagrangian.codegen.ir import Function, Value
from lagrangian.integrate.projection import (
    CLOSED,
    DRIFT,
    MARGIN,
    MARGIN_TIME,
    MORE_STEPS,
    NEARLY_DEPENDENT,
    RESET,
    ROUNDING,
    SEEN,
    START,
)

from . import memory_layout as at
from .evaluate import PrintedProgram
from .memory_layout import Lanes
from .printer import Printer, Vec

if TYPE_CHECKING:
    from lagrangian.graph import Program
    from lagrangian.integrate.projection import Projection

    from .lane_scheduler import LaneScheduler
    from .method import MethodStep

SHORTER = 0.5
"""The factor by which a step with too great a correction is shortened if no error estimate decides."""

UNKNOWN = "0x7FF8000000000000"
"""The value of a time that is not known yet."""


def _greater(f: Function, most: Value, entry: Value) -> Value:
    """The greater of a number and the magnitude of another."""
    size = f.intrinsic("fabs", entry)
    return f.select(f.compare("olt", most, size), size, most)


class Projector:
    """Prints the instructions that project states."""

    def __init__(
        self, p: Printer, lanes: Lanes, rates: Program, projection: Projection, ends: tuple[Vec, Vec], *, own: bool
    ) -> None:
        self.p, self.f, self.lanes, self.corrects = p, p.f, lanes, projection.corrects
        self.end, self.lost = ends
        # in WebAssembly both steps are one function: a page is small, and its functions are slow to compile
        self.joint = projection.joint and p.f.module.target.imports
        approach, landing = None if self.joint else projection.approach, projection.landing(rates, joint=self.joint)
        self.approach = None if approach is None else self._tapes(approach, "approach", own)
        self.landing = self._tapes(landing, "landing", own)
        self.tells = "margin" in landing.outputs
        self.first, self.second = p.reserve(p.size + 1), p.reserve(self.landing.count)
        self.moved = p.block()
        self.gap, self.size, self.shrunk, self.rounds = (p.reserve(1) for _ in range(4))
        self.worst = p.reserve(len(DRIFT))

    def _tapes(self, program: Program, name: str, own: bool) -> PrintedProgram:
        return PrintedProgram(self.p, program, name, own=own and bool(program.inputs.get("p")), copies=2, called=True)

    @property
    def tapes(self) -> tuple[PrintedProgram | None, PrintedProgram]:
        """The tapes that are evaluated, for the sizes of shared blocks."""
        return self.approach, self.landing

    def prepare(self, service: LaneScheduler) -> None:
        """Print, at the start of the function, the reading of values from the table."""
        p = self.p
        self.service = service
        self.approach_shared = p.entry(at.TABLE.index("approach_shared"), "ptr")
        self.landing_shared = p.entry(at.TABLE.index("landing_shared"), "ptr")
        self.drift = p.entry(at.TABLE.index("drift"), "ptr")

    def prologues(self) -> None:
        """Print the computations that depend only on every lane's parameters."""
        for tapes in self.tapes:
            if tapes is not None and tapes.own:
                tapes.prologue(self.lanes.p_in)

    # One state a lane --------------------------------------------------------------------------------------------

    def correct(self, t: Value, u: Vec, x: Vec, flag: str, lost: Vec | None = None, *, call: bool = True) -> None:
        """Print the projection of the vector in the slots ``x`` in lanes with the flag.

        The sum of the corrections is then in ``self.moved``. ``lost``: the rounding errors of sums so far.
        """
        p, f = self.p, self.f
        zero = Value(f, f.constant(0.0))
        p.map(lambda old: zero, self.moved, into=(self.moved,))
        if self.joint:
            self._jointly(t, u, x, flag, lost, call)
        elif self.approach is not None:
            self._approach(self.approach, t, u, x, flag, lost, call)
        else:
            self._land(t, u, x, call)
            p.store(self._seen("rest"), self.gap)
        if self.corrects:
            self._add(self.second, x, flag, lost)

    def _approach(
        self, approach: PrintedProgram, t: Value, u: Vec, x: Vec, flag: str, lost: Vec | None, call: bool
    ) -> None:
        """Print the steps on positions until they are closed, each with the step on velocities from there."""
        p, f = self.p, self.f
        p.store(0.0, self.rounds)
        p.store(0.0, self.gap)
        p.store(float("inf"), self.second, p.size + SEEN.index("rest"))
        with p.forever() as leave:
            rounds = p.load(self.rounds)
            again = self._again(flag, f.compare("ogt", self._seen("rest"), CLOSED), rounds)
            leave(f.put(f"xor i1 {p.any(again)}, true"))
            approach.evaluate(self.approach_shared, {"x": x, "u": u}, t, self.first, call=call)
            p.store(f.select(f.compare("oeq", rounds, 0.0), p.load(self.first, p.size), p.load(self.gap)), self.gap)
            self._add(self.first, x, again, lost)
            self._land(t, u, x, call)

    def _jointly(self, t: Value, u: Vec, x: Vec, flag: str, lost: Vec | None, call: bool) -> None:
        """Print the same where one program has both steps: one on positions at least, then until they are closed."""
        p, f = self.p, self.f
        p.store(0.0, self.rounds)
        p.store(0.0, self.gap)
        with p.forever() as leave:
            self._land(t, u, x, call)
            rounds = p.load(self.rounds)
            first = f.compare("oeq", rounds, 0.0)
            p.store(f.select(first, self._seen("rest"), p.load(self.gap)), self.gap)
            again = self._again(flag, f.logic("or", first, f.compare("ogt", self._seen("rest"), CLOSED)), rounds)
            leave(f.put(f"xor i1 {p.any(again)}, true"))
            self._add(self.second + self.landing.count - p.size, x, again, lost)

    def _again(self, flag: str, unclosed: str, rounds: Value) -> str:
        """In which lanes another step on positions is made, after so many."""
        f = self.f
        again = f.logic("and", flag, unclosed)
        self.p.store(rounds + 1.0, self.rounds)
        return f.logic("and", again, f.compare("ole", rounds, float(MORE_STEPS)))

    def _land(self, t: Value, u: Vec, x: Vec, call: bool) -> None:
        self.landing.evaluate(self.landing_shared, {"x": x, "u": u}, t, self.second, call=call)

    def _seen(self, name: str) -> Value:
        return self.p.load(self.second, self.p.size + SEEN.index(name))

    def _add(self, dx: int, x: Vec, flag: str, lost: Vec | None) -> None:
        """Add a correction to a state."""
        p, f = self.p, self.f
        zero = Value(f, f.constant(0.0))

        def add(x: Value, moved: Value, d: Value, lost: Value = zero) -> tuple[Value, ...]:
            whole = d + lost
            new = x + whole
            kept = f.select(flag, whole - (new - x), lost)
            return f.select(flag, new, x), f.select(flag, moved + d, moved), kept

        given = (x, self.moved, Vec(slot=dx)) if lost is None else (x, self.moved, Vec(slot=dx), lost)
        into = (x, self.moved) if lost is None else (x, self.moved, lost)
        if lost is None:
            p.map(lambda *entries: add(*entries)[:2], *given, into=into)
        else:
            p.map(add, *given, into=into)

    # The end of a step -------------------------------------------------------------------------------------------

    def settle(self, s: MethodStep, good: str, u: Vec, time: Value, error: Value, *, adaptive: bool) -> Value:
        """Print the projection of a step's end in lanes whose step is good.

        Return the greater of its error and the size of the correction, in tolerances; 0 for constant steps, and NaN
        if the projection failed.
        """
        p = self.p
        x, lost = self.end, self.lost
        p.store(error, self.size)
        with p.when(p.any(good)):
            self.correct(time, u, x, good, lost, call=False)
            if self.corrects and adaptive:
                self._measure(s, x, good)
        s.new_x, s.new_lost = self._read(x), self._read(lost)
        if self.corrects and not adaptive:
            (trouble,) = p.fold(lambda total, x: (self.f.fma(x, 0.0, total),), [0.0], s.new_x)
            return trouble
        return p.load(self.size)

    def _measure(self, s: MethodStep, x: Vec, good: str) -> None:
        """Print the record of the size of the correction, if it is more than rounding."""
        p, f = self.p, self.f

        def add(total: Value, old: Value, new: Value, atol: Value, moved: Value) -> tuple[Value]:
            ratio = moved / s.scale(old, new, atol)
            return (f.fma(ratio, ratio, total),)

        (total,) = p.fold(add, [0.0], s.x, x, s.atol, self.moved)
        size = f.intrinsic("sqrt", total * (1.0 / p.size))
        gap, speed, rest = p.load(self.gap), self._seen("gap"), self._seen("left")
        # rounding grows with the state: of speeds of thousands, residuals of 1e-12 are left
        (largest,) = p.fold(lambda most, entry: (_greater(f, most, entry),), [1.0], x)
        rounding = largest * ROUNDING
        worst = f.select(f.compare("olt", gap, speed), speed, gap)
        if not self.tells:
            small = f.compare("ole", worst, rounding)
        else:  # where rows are nearly dependent, residuals of rounding grow as 1/√margin
            margin = self._seen("margin")
            small = f.compare("ole", worst * worst * margin, rounding * rounding)
            small = f.logic("or", small, f.compare("olt", margin, NEARLY_DEPENDENT))
        error = p.load(self.size)
        greater = f.select(f.logic("or", small, f.compare("ole", size, error)), error, size)
        greater = f.fma(gap + speed + rest + size, 0.0, greater)  # 0·gap: what is not finite shows
        p.store(f.select(good, greater, error), self.size)

    def _read(self, home: Vec) -> Vec:
        """Read a vector from its slots, in the form that other code uses."""
        if not self.p.unrolled:
            return home
        assert home.slot is not None
        return Vec(values=tuple(self.p.load(home.slot, i) for i in range(self.p.size)))

    def within(self, tried: str, size: Value, rejected: int) -> str:
        """The lanes whose correction is within the tolerances; in others the step is rejected and shortened."""
        p, f = self.p, self.f
        good = f.logic("and", tried, f.compare("ole", size, 1.0))
        bad = f.logic("and", tried, f.opposite(good))
        shrunk = p.load(self.shrunk)
        p.store(f.select(good, 1.0, f.select(bad, shrunk * SHORTER, shrunk)), self.shrunk)
        p.count(bad, rejected)
        return good

    # What is told of a run ---------------------------------------------------------------------------------------

    def note(self, t: Value, flag: str, kind: int = 0) -> None:
        """Print the record of the last residuals in lanes with the flag: at a step's end, a start, or after a reset."""
        p, f = self.p, self.f
        before = (p.load(self.gap), self._seen("gap"))
        if kind:
            found = dict(zip((kind, kind + 1), before, strict=True))
        else:
            found = dict(zip(range(4), (before[0], self._seen("rest"), before[1], self._seen("left")), strict=True))
        for place, gap in found.items():
            worst = p.load(self.worst, place)
            p.store(f.select(f.logic("and", flag, f.compare("ogt", gap, worst)), gap, worst), self.worst, place)
        if not self.tells:
            return
        margin, least = self._seen("margin"), p.load(self.worst, MARGIN)
        closer = f.logic("and", flag, f.compare("olt", margin, least))
        p.store(f.select(closer, margin, least), self.worst, MARGIN)
        p.store(f.select(closer, t, p.load(self.worst, MARGIN_TIME)), self.worst, MARGIN_TIME)

    def begin(self, new: str, t: Value, u: Vec) -> None:
        """Print the projection in lanes that start or restart."""
        p = self.p
        with p.when(p.any(new)):
            self.correct(t, u, self.lanes.x, new)
            self.note(t, new, START)

    def reset(self, s: MethodStep, flag: str, t: Value, u: Vec) -> None:
        """Print the projection of the state after an event."""
        p = self.p
        with p.when(p.any(flag)):
            self.correct(t, u, self.end, flag)
            self.note(t, flag, RESET)
        s.new_x = self._read(self.end)

    def forget(self, lane: str) -> None:
        """Print the initial values of the record in a lane that takes a new run."""
        p = self.p
        for place in range(len(DRIFT)):
            p.set("0.0", self.worst + place, lane)
        p.set("0x7FF0000000000000", self.worst + MARGIN, lane)
        p.set(UNKNOWN, self.worst + MARGIN_TIME, lane)
        p.set("1.0", self.shrunk, lane)

    def write(self, lane: str, run: str) -> None:
        """Print the output of the record of a lane's run."""
        f, service = self.f, self.service
        row = f.put(f"getelementptr double, ptr {self.drift}, i64 {f.put(f'mul i64 {run}, {len(DRIFT)}')}")
        service.copy_out(self.worst, row, len(DRIFT), lane)
