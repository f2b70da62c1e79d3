"""The service of single lanes: stop points, the ends of runs, and the next run.

Stop points are the end of the run, the knots of the inputs and, for fixed steps, the requested times.
"""

from __future__ import annotations

from typing import Protocol

from lagrangian.integrate.status import RunStatus

from . import memory_layout as at
from .evaluate import PrintedProgram
from .memory_layout import Lanes
from .method import Method
from .printer import Printer

NEVER = "0x7FF0000000000000"  # +∞


class Watching(Protocol):
    """What a lane needs from the detector of events."""

    def forget(self, lane: str) -> None:
        """Print that a lane has not seen anything yet."""
        ...

    def prologues(self) -> None:
        """Print what is computed once for new parameters."""
        ...


class Noting(Watching, Protocol):
    """Something that records data of every run."""

    def write(self, lane: str, run: str) -> None:
        """Print the code that stores what was recorded of a lane's run."""
        ...


class LaneScheduler:
    """Prints the part of the loop that handles single lanes."""

    def __init__(self, p: Printer, lanes: Lanes, method: Method, *, size: int, inputs: int, signals: bool) -> None:
        self.p, self.f, self.lanes, self.method = p, p.f, lanes, method
        self.size, self.inputs, self.signals = size, inputs, signals
        self.evaluations = method.evaluations  # of the derivative, in every step that is tried

    def prepare(self) -> None:
        """Print the code that reads the table, at the start of the function."""
        self._read: dict[str, str] = {}
        pointers = ("times", "states", "final", "status", "reached", "steps", "rejected", "evaluations",
                    "x0", "u", "p", "knots", "knot_start", "knot_slope", "event_count")  # fmt: skip
        words = ("samples", "states_row", "states_step", "x0_row", "u_row", "p_row", "knot_count")
        for name in pointers:
            self._read[name] = self.p.entry(at.TABLE.index(name), "ptr")
        for name in words:
            self._read[name] = self.p.entry(at.TABLE.index(name))
        self._read["step"] = self.p.entry(at.TABLE.index("step"), "double")

    def __getitem__(self, name: str) -> str:
        return self._read[name]

    # Small things ------------------------------------------------------------------------------------------------

    def element(self, array: str, index: str, kind: str = "double") -> str:
        """An element of an array of 8-byte numbers."""
        f = self.f
        return f.put(f"load {kind}, ptr {f.put(f'getelementptr i64, ptr {array}, i64 {index}')}")

    def put(self, x: str, array: str, index: str, kind: str = "double") -> None:
        """Set an element of an array of 8-byte numbers."""
        f = self.f
        f.do(f"store {kind} {x}, ptr {f.put(f'getelementptr i64, ptr {array}, i64 {index}')}")

    def row(self, array: str, stride: str, index: str) -> str:
        """The address of a row."""
        f = self.f
        return f.put(f"getelementptr i8, ptr {array}, i64 {f.put(f'mul i64 {index}, {stride}')}")

    def compare(self, condition: str, a: str, b: str, kind: str = "i64") -> str:
        """Compare two scalars."""
        return self.f.put(f"{'fcmp' if kind == 'double' else 'icmp'} {condition} {kind} {a}, {b}")

    def add(self, a: str, b: str | int) -> str:
        """The sum of two scalar integers."""
        return self.f.put(f"add i64 {a}, {b}")

    def copy_in(self, row: str, slot: int, count: int, lane: str) -> None:
        """Copy a row of numbers to one lane of ``count`` slots."""
        with self.p.repeat(count) as i:
            self.p.set(self.element(row, i), slot, self.moved(lane, i))

    def copy_out(self, slot: int, row: str, count: int, lane: str) -> None:
        """Copy one lane of ``count`` slots to a row of numbers."""
        with self.p.repeat(count) as i:
            self.put(self.p.get(slot, self.moved(lane, i)), row, i)

    def moved(self, lane: str, i: str) -> str:
        """The index of the same lane, i slots further: slots are ``lanes`` numbers apart."""
        return self.add(lane, self.f.put(f"mul i64 {i}, {self.p.lanes}"))

    # Samples -----------------------------------------------------------------------------------------------------

    def write_samples(self) -> None:
        """Write ``lanes.sampled`` for lanes whose next requested time is before ``lanes.end``; advance to the time
        after.
        """
        p, f, lanes = self.p, self.f, self.lanes
        with p.repeat(p.lanes) as lane:
            here = self.compare("ole", p.get(lanes.next, lane), p.get(lanes.end, lane), "double")
            good = self.compare("ne", p.get(lanes.good, lane, "i64"), "0")
            with p.when(f.put(f"and i1 {here}, {good}")):
                assert lanes.sampled.slot is not None
                self.write_sample(lane, lanes.sampled.slot)

    def write_sample(self, lane: str, slot: int) -> None:
        """Write a state as the next sample of a lane; advance to the requested time after it."""
        p, f, lanes = self.p, self.f, self.lanes
        sample = p.get(lanes.sample, lane, "i64")
        row = self.row(self["states"], self["states_row"], p.get(lanes.run, lane, "i64"))
        row = self.row(row, self["states_step"], sample)
        self.copy_out(slot, row, self.size, lane)
        following = self.add(sample, 1)
        p.set(following, lanes.sample, lane, "i64")
        last = self.add(self["samples"], -1)
        held = f.put(f"call i64 @llvm.smin.i64(i64 {following}, i64 {last})")
        f.module.declare("llvm.smin.i64", "i64", ["i64", "i64"])
        more = self.compare("sle", following, last)
        time = f.put(f"select i1 {more}, double {self.element(self['times'], held)}, double {NEVER}")
        p.set(time, lanes.next, lane)

    # The service itself ------------------------------------------------------------------------------------------

    def print(self, tapes: PrintedProgram, watch: Watching | None, project: Noting | None) -> None:
        """Print the service; at its end the function returns, or continues with ``begin`` or ``head``."""
        p, f, lanes = self.p, self.f, self.lanes
        f.label("service")
        quit_now = self.compare("ne", p.word(at.QUIT), "0")
        with p.repeat(p.lanes) as lane:
            # each lane: time is up, stop point, event, end of the run; an empty lane takes the next run
            late = self.compare("eq", p.get(lanes.state, lane, "i64"), str(at.RUNNING))
            with p.when(f.put(f"and i1 {late}, {quit_now}")):
                self._end(lane, RunStatus.LATE)
            stopped = self.compare("eq", p.get(lanes.state, lane, "i64"), str(at.STOPPED))
            with p.when(stopped):
                self._stop(lane, at.RESTARTED if self.signals else at.RUNNING)
            if watch is not None:
                with p.when(self.compare("eq", p.get(lanes.state, lane, "i64"), str(at.AT_EVENT))):
                    self._stop(lane, at.NEW)
            ended = self.compare("eq", p.get(lanes.state, lane, "i64"), str(at.ENDED))
            with p.when(ended):
                self._finish(lane, project)
            empty = self.compare("eq", p.get(lanes.state, lane, "i64"), str(at.EMPTY))
            there = self.compare("slt", p.word(at.CURSOR), p.word(at.LAST))
            with p.when(f.put(f"and i1 {empty}, {there}")):
                self._take(lane)
                for other in (watch, project):
                    if other is not None:
                        other.forget(lane)
        # results that depend only on the parameters, for lanes with a new run
        if tapes.own:
            state = p.load_whole(lanes.state)
            with p.when(p.any(p.whole_is(state, at.NEW))):
                tapes.prologue(lanes.p_in)
                for other in (watch, project):
                    if other is not None:
                        other.prologues()
        state = p.load_whole(lanes.state)
        # return if all lanes are empty; lanes that begin, or begin anew, go to ``begin``
        fresh = f.logic("or", p.whole_is(state, at.NEW), p.whole_is(state, at.RESTARTED))
        f.do(f"br i1 {p.any(f.opposite(p.whole_is(state, at.EMPTY)))}, label %some, label %none")
        f.label("none")
        f.do(f"ret i64 {at.DONE}")
        f.label("some")
        f.do(f"br i1 {p.any(fresh)}, label %begin, label %head")

    def _end(self, lane: str, code: int) -> None:
        self.p.set(str(at.ENDED), self.lanes.state, lane, "i64")
        self.p.set(str(code), self.lanes.code, lane, "i64")

    def _stop(self, lane: str, state: int) -> None:
        """Handle a lane at its stop point: a sample, a knot or the end of the run; then find the next stop point."""
        p, f, lanes = self.p, self.f, self.lanes
        p.set(str(state), lanes.state, lane, "i64")
        t = p.get(lanes.t, lane)
        if not self.method.adaptive:
            with p.when(self.compare("oge", t, p.get(lanes.next, lane), "double")):
                assert lanes.x.slot is not None
                self.write_sample(lane, lanes.x.slot)
        over = self.compare("oge", t, self._last_time(), "double")
        with p.when(over):
            self._end(lane, RunStatus.REACHED)
        with p.when(f.put(f"xor i1 {over}, true")):
            self.next_stop(lane)

    def _last_time(self) -> str:
        return self.element(self["times"], self.add(self["samples"], -1))

    def next_stop(self, lane: str) -> None:
        """Find the next stop point of a lane, and load the piece of the inputs that begins here."""
        p, f, lanes = self.p, self.f, self.lanes
        p.set(self._last_time() if self.method.adaptive else p.get(lanes.next, lane), lanes.stop, lane)
        if self.signals:
            t = p.get(lanes.t, lane)
            with p.forever() as leave:  # the piece whose end lies after t
                following = self.add(p.get(lanes.knot, lane, "i64"), 1)
                leave(self.compare("sge", following, self["knot_count"]))
                leave(self.compare("ogt", self.element(self["knots"], following), t, "double"))
                p.set(following, lanes.knot, lane, "i64")
            knot = p.get(lanes.knot, lane, "i64")
            offset = f.put(f"mul i64 {knot}, {self.inputs}")
            for array, slot in (("knot_start", lanes.u), ("knot_slope", lanes.slope)) if self.inputs else ():
                row = f.put(f"getelementptr double, ptr {self[array]}, i64 {offset}")
                self.copy_in(row, slot, self.inputs, lane)
            p.set(self.element(self["knots"], knot), lanes.knot_time, lane)
            following = self.add(knot, 1)
            with p.when(self.compare("slt", following, self["knot_count"])):
                time = self.element(self["knots"], following)
                with p.when(self.compare("olt", time, p.get(lanes.stop, lane), "double")):
                    p.set(time, lanes.stop, lane)
        if not self.method.adaptive:
            self._equal_steps(lane)

    def _equal_steps(self, lane: str) -> None:
        """Divide the interval up to the stop point into equal steps, not longer than requested."""
        p, f, lanes = self.p, self.f, self.lanes
        way = f.put(f"fsub double {p.get(lanes.stop, lane)}, {p.get(lanes.t, lane)}")
        ratio = f.put(f"fdiv double {way}, {self['step']}")
        nearly = f.put(f"fmul double {ratio}, 0x3FEFFFFFFFFFFC00")  # 1 − 2⁻⁴³: a ratio that is whole but for rounding
        down = f.put(f"fptosi double {nearly} to i64")
        count = f.put(f"sitofp i64 {self.add(down, 1)} to double")
        p.set(count, lanes.left, lane)
        p.set(f.put(f"fdiv double {way}, {count}"), lanes.h, lane)

    def _finish(self, lane: str, project: Noting | None) -> None:
        """Write the results of a lane's run, and make the lane empty."""
        p, f, lanes = self.p, self.f, self.lanes
        assert lanes.x.slot is not None
        run = p.get(lanes.run, lane, "i64")
        row = f.put(f"getelementptr double, ptr {self['final']}, i64 {f.put(f'mul i64 {run}, {self.size}')}")
        self.copy_out(lanes.x.slot, row, self.size, lane)
        self.put(p.get(lanes.t, lane), self["reached"], run)
        steps, rejected = p.get(lanes.steps, lane, "i64"), p.get(lanes.rejected, lane, "i64")
        tried = f.put(f"mul i64 {self.add(steps, rejected)}, {self.evaluations}")
        found = {
            "status": p.get(lanes.code, lane, "i64"),
            "steps": steps,
            "rejected": rejected,
            "evaluations": self.add(tried, p.get(lanes.extra, lane, "i64")),
            "event_count": p.get(lanes.events, lane, "i64"),
        }
        for name, x in found.items():
            self.put(x, self[name], run, "i64")
        if project is not None:
            project.write(lane, run)
        p.set(str(at.EMPTY), lanes.state, lane, "i64")

    def _take(self, lane: str) -> None:
        """Start the next run in a lane."""
        p, lanes = self.p, self.lanes
        assert lanes.x.slot is not None and lanes.lost.slot is not None
        run = p.word(at.CURSOR)
        p.set_word(self.add(run, 1), at.CURSOR)
        p.set(run, lanes.run, lane, "i64")
        self.copy_in(self.row(self["x0"], self["x0_row"], run), lanes.x.slot, self.size, lane)
        with p.repeat(self.size) as i:
            p.set("0.0", lanes.lost.slot, self.moved(lane, i))
        if self.inputs and not self.signals:
            self.copy_in(self.row(self["u"], self["u_row"], run), lanes.u, self.inputs, lane)
        if lanes.parameters:
            self.copy_in(self.row(self["p"], self["p_row"], run), lanes.p_in, lanes.parameters, lane)
        p.set(self.element(self["times"], "0"), lanes.t, lane)
        p.set("0", lanes.sample, lane, "i64")
        self.write_sample(lane, lanes.x.slot)
        for slot in (lanes.steps, lanes.rejected, lanes.extra, lanes.events, lanes.knot):
            p.set("0", slot, lane, "i64")
        p.set(str(at.NEW), lanes.state, lane, "i64")
        self.next_stop(lane)
