"""Events: sign changes of g over a step, located on the dense output to the last bit of time.

An event is *armed* with the last sign of g; it has happened when g has the other sign, in a direction that counts. The
condition "some armed event has happened by θ" is bisected, so several events cost no more than one: the result is the
place of a crossing, and every event that crossed there counts.

The state of an event is the last one before it: a reset that reverses the motion leaves it on the side from which it
came, and if two events coincide, the other one is still to come. After its own reset, an event whose g is zero to
within rounding is armed by the change of g along ẋ. If it happens again before g was ever seen on the armed side,
events accumulate.

If some g is NaN, the run ends at the last place where all are numbers: this place is bisected like a crossing.

A step is searched piece by piece (``pieces.py``); each piece is so short that no function crosses zero twice in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from lagrangian.codegen.ir import Value, hexadecimal
from lagrangian.graph import Program

from . import memory_layout as at
from .evaluate import PrintedProgram
from .memory_layout import Lanes
from .method import Method, MethodStep
from .pieces import Pieces
from .printer import Printer, Vec

if TYPE_CHECKING:
    from collections.abc import Callable

    from lagrangian.integrate.problem import Events

    from .lane_scheduler import LaneScheduler
    from .projector import Projector

ROUNDS = 128
"""The number of distinct times of events in one step after which the step is cut."""

SOON = 2.0**-46
"""Two resets whose times differ by less than this fraction of t count as simultaneous."""

LOOKAHEAD = 2.0**-10
"""The fraction of a step by which one looks ahead for the sign that g takes when it leaves 0."""

START, ZERO, TURNED, FIRST = -1.0, 1.0, 2.0, 3.0
"""The phases of an event: its run begins; g is 0 where a run continues; its reset has just been made; g is 0 where its
run begins."""

RESET, ENDS, ACCUMULATING, CROWDS, BLIND = 1, 2, 3, 4, 5
"""Why a lane leaves a step: to continue from another state, because of a terminal event, because changes of the state
accumulate, because a run has too many events, because some g is NaN."""


def parts(events: Events) -> tuple[Program, Program | None]:
    """The programs for g and, if any event resets the state, for the states after events."""
    program = events.program
    made = [
        Program(name, program.graph, program.inputs, {name: program.outputs[name]}, program.defaults)
        for name in ("g", "after")
        if name in program.outputs
    ]
    return made[0], made[1] if any(events.reset) else None


class EventDetector:
    """Prints the code that detects ``count`` events."""

    def __init__(
        self, p: Printer, lanes: Lanes, method: Method, service: LaneScheduler, events: Events,
        project: Projector | None, *, own: bool,
    ) -> None:  # fmt: skip
        self.project = project if project is not None and project.corrects else None
        self.p, self.f, self.lanes, self.method, self.service = p, p.f, lanes, method, service
        self.events, self.count = events, len(events.direction)
        guard, after = parts(events)
        own = own and bool(guard.inputs.get("p"))
        self.guard = PrintedProgram(p, guard, "guard", own=own, copies=5)
        self.after = None if after is None else PrintedProgram(p, after, "after", own=own, copies=5)
        self.pieces = Pieces(p, lanes, method, service, guard, own=own)
        self.armed, self.phase, self.fresh, self.fired = (p.reserve(self.count) for _ in range(4))
        self.low, self.high, self.busy, self.settled, self.cut, self.rounds = (p.reserve(1) for _ in range(6))
        self.latest, self.same, self.when, self.past, self.blind = (p.reserve(1) for _ in range(5))
        self.there, self.beyond, self.kept, self.states = (
            p.block(),
            p.block(),
            p.block(),
            p.reserve(self.count * p.size),
        )

    def prepare(self) -> None:
        """Print the code that reads the table, at the start of the function."""
        p = self.p
        self.guard_shared = p.entry(at.TABLE.index("guard_shared"), "ptr")
        self.after_shared = p.entry(at.TABLE.index("after_shared"), "ptr")
        self.pieces.prepare()
        self.log, self.room = p.word(at.LOG, "ptr"), p.word(at.ROOM)
        self.most = p.entry(at.TABLE.index("max_events"))

    def full(self) -> str:
        """Whether one more step might log more events than there is room for."""
        wanted = self.service.add(self.p.word(at.LOGGED), (ROUNDS + 2) * self.count * self.p.lanes)
        return self.service.compare("sgt", wanted, self.room)

    def prologues(self) -> None:
        """Print what depends only on the parameters of every lane."""
        for tapes in (self.guard, self.after, self.pieces.tapes):
            if tapes is not None and tapes.own:
                tapes.prologue(self.lanes.p_in)

    def value(self, inputs: Callable[[Value], Vec], t: Value, x: Vec) -> tuple[Value, ...]:
        """The value of g for every event."""
        found = self.guard.evaluate(self.guard_shared, {"x": x, "u": inputs(t)}, t)
        assert found is not None
        return found

    def arm(self, inputs: Callable[[Value], Vec], rate: Callable[..., Vec], new: str) -> str:
        """Arm the events of lanes that begin; return where some g is NaN."""
        p, f, lanes = self.p, self.f, self.lanes
        t = p.load(lanes.t)
        doubt = ""
        now = self.value(inputs, t, lanes.x)
        for k, g in enumerate(now):
            phase, old = p.load(self.phase, k), p.load(self.armed, k)
            usual = f.logic("and", new, f.compare("ole", phase, 0.0))
            p.store(f.select(usual, g, old), self.armed, k)
            zero = f.logic("and", usual, f.compare("oeq", g, 0.0))
            phase = f.select(zero, f.select(f.compare("olt", phase, 0.0), FIRST, ZERO), phase)
            p.store(phase, self.phase, k)
            unclear = f.logic("and", new, f.compare("ogt", phase, 0.0))
            doubt = f.logic("or", doubt, unclear) if doubt else unclear
        with p.when(p.any(doubt)):
            little = p.load(lanes.h) * LOOKAHEAD
            k = lanes.k if self.method.follows else rate(t, lanes.x)
            (ahead,) = p.map(lambda x, k: f.fma(little, k, x), lanes.x, k, into=(self.there,))
            thens = self.value(inputs, t + little, ahead)
            k = rate(t + little, ahead)
            (resting,) = p.map(lambda x, k: f.fma(little, k, x), lanes.x, k, into=(self.there,))
            laters = self.value(inputs, t + little, resting)
            for k, (here, then, later) in enumerate(zip(now, thens, laters, strict=True)):
                p.store(self._side(k, here, then, later), self.armed, k)
        for k in range(self.count):
            turned = f.compare("oeq", p.load(self.phase, k), TURNED)
            p.store(f.select(f.logic("and", new, turned), 1.0, 0.0), self.fresh, k)
            p.store(f.select(new, 0.0, p.load(self.phase, k)), self.phase, k)
        return self.dark(now)

    def _side(self, k: int, here: Value, then: Value, later: Value) -> Value:
        """The sign that arms an undecided event, from g here and slightly later; ``later`` uses the ẋ of there, for g
        at rest.

        An event whose g moves through 0 in its direction at the start of its run happens there.
        """
        p, f = self.p, self.f
        phase, old = p.load(self.phase, k), p.load(self.armed, k)
        turn = then - here
        back = f.compare("oge", f.intrinsic("copysign", 1.0, old) * turn, 0.0)
        clear = f.compare("ogt", f.intrinsic("copysign", 1.0, here) * then, 0.0)
        clear = f.logic("and", clear, f.compare("one", here, 0.0))
        reset = f.select(clear, here, f.select(back, old, 0.0))
        started = f.select(f.compare("oeq", phase, ZERO), turn, old)
        if direction := self.events.direction[k]:
            turn = f.select(f.compare("oeq", turn, 0.0), later - here, turn)
            opposed = f.select(f.compare("ogt", turn * float(direction), 0.0), turn * -1.0, turn)
        else:
            opposed = turn
        started = f.select(f.compare("oeq", phase, FIRST), opposed, started)
        return f.select(f.compare("oeq", phase, TURNED), reset, started)

    def forget(self, lane: str) -> None:
        """Print the initial values for a lane with a new run."""
        p = self.p
        for k in range(self.count):
            p.set(f"{START}", self.phase + k, lane)
            p.set("0.0", self.fresh + k, lane)
        p.set("0xFFF0000000000000", self.latest, lane)
        p.set("0", self.same, lane, "i64")

    def happened(self, k: int, g: Value) -> str:
        """Where armed event k has happened, given this value of g."""
        f = self.f
        armed, direction = self.p.load(self.armed, k), self.events.direction[k]
        fell = f.logic("and", f.compare("ogt", armed, 0.0), f.compare("ole", g, 0.0))
        rose = f.logic("and", f.compare("olt", armed, 0.0), f.compare("oge", g, 0.0))
        return fell if direction < 0 else rose if direction > 0 else f.logic("or", fell, rose)

    def some(self, gs: Sequence[Value]) -> str:
        """Where some armed event has happened, or some g is NaN."""
        flag = self.dark(gs)
        for k, g in enumerate(gs):
            flag = self.f.logic("or", flag, self.happened(k, g))
        return flag

    def dark(self, gs: Sequence[Value]) -> str:
        """Where some g is NaN."""
        flag = self.f.compare("uno", gs[0], gs[0])
        for g in gs[1:]:
            flag = self.f.logic("or", flag, self.f.compare("uno", g, g))
        return flag

    # A step ------------------------------------------------------------------------------------------------------

    def find(
        self, s: MethodStep, coefficients: list[Vec], inputs: Callable[[Value], Vec], good: str, new_t: Value
    ) -> None:
        """Print the search through a step, which logs events. Where ``self.cut`` is not 0 afterwards, a lane leaves the
        step at the time in ``lanes.end`` with the state in ``self.kept``.
        """
        p, f, lanes, pieces = self.p, self.f, self.lanes, self.pieces

        def place(theta: Value, into: Vec) -> tuple[Vec, Value]:
            whole = f.compare("oge", theta, 1.0)
            between = self.method.between(s, coefficients, theta)

            def entry(x: Value, new: Value, *rest: Value) -> Value:
                return f.select(whole, new, between(x, *rest))

            p.map(entry, s.x, s.new_x, *coefficients, into=(into,))
            x, t = Vec(slot=into.slot), f.select(whole, new_t, f.fma(theta, s.h, s.t))
            if self.project is not None:
                self.project.correct(t, inputs(t), x, f.logic("and", good, f.opposite(whole)))
            return x, t

        def values_at(theta: Value) -> tuple[Value, ...]:
            x, t = place(theta, self.there)
            return self.value(inputs, t, x)

        # the search begins at θ = 0 (low) in every lane
        p.store(new_t, lanes.end)
        p.store(0.0, self.low)
        for slot in (self.cut, self.rounds):
            p.store_whole(f.integer(0), slot)
        pieces.begin(s, coefficients)
        with p.forever() as leave:
            free = f.logic("and", good, p.whole_is(p.load_whole(self.cut), 0))
            busy = f.logic("and", free, f.compare("olt", p.load(self.low), 1.0))
            leave(f.put(f"xor i1 {p.any(busy)}, true"))
            # choose the next piece [low, high] of each lane, short enough for at most one crossing
            settled, high = pieces.judged(s, inputs, p.load(self.low), busy)
            p.store(high, self.high)
            self._note(settled, self.settled)
            with p.when(p.any(settled)):
                # compare the signs at its end; without a crossing, the search continues after the piece
                gs = values_at(p.load(self.high))
                settled = self._noted(self.settled)
                crossed = f.logic("and", settled, self.some(gs))
                self._note(crossed, self.busy)
                self._pass(gs, f.logic("and", settled, f.opposite(crossed)))
                with p.when(p.any(crossed)):
                    self._locate(s, values_at)
                    self._handle(place, inputs)
                    busy = self._noted(self.busy)
                    p.store(f.select(busy, p.load(self.high), p.load(self.low)), self.low)
                    pieces.refresh(busy)

    def _pass(self, gs: Sequence[Value], clear: str) -> None:
        """Arm events with the sign of g at the end of a piece without crossings, and continue after it."""
        p, f = self.p, self.f
        for k, g in enumerate(gs):
            armed = p.load(self.armed, k)
            p.store(f.select(f.logic("and", clear, f.compare("une", g, 0.0)), g, armed), self.armed, k)
        p.store(f.select(clear, p.load(self.high), p.load(self.low)), self.low)

    def _locate(self, s: MethodStep, values_at: Callable[[Value], tuple[Value, ...]]) -> None:
        """Bisect the piece with a crossing, in busy lanes, until there is no time between its ends."""
        p, f = self.p, self.f
        with p.forever() as found:
            busy = self._noted(self.busy)
            low, high = p.load(self.low), p.load(self.high)
            half = (low + high) * 0.5
            apart = f.compare("olt", f.fma(low, s.h, s.t), f.fma(high, s.h, s.t))
            apart = f.logic("and", apart, f.logic("and", f.compare("ogt", half, low), f.compare("olt", half, high)))
            apart = f.logic("and", apart, busy)
            found(f.put(f"xor i1 {p.any(apart)}, true"))
            before = self.some(values_at(half))
            p.store(f.select(f.logic("and", apart, before), half, high), self.high)
            p.store(f.select(f.logic("and", apart, f.opposite(before)), half, low), self.low)

    def _note(self, flag: str, slot: int) -> None:
        self.p.store_whole(self.f.put(f"zext {self.f.flag} {flag} to {self.f.whole}"), slot)

    def _noted(self, slot: int) -> str:
        return self.f.opposite(self.p.whole_is(self.p.load_whole(slot), 0))

    def _handle(self, place: Callable[[Value, Vec], tuple[Vec, Value]], inputs: Callable[[Value], Vec]) -> None:
        """At the crossings found, lane by lane: log the events, arm them again, reset the state, or end the run."""
        p, f = self.p, self.f
        # just after the crossing: which events have happened, and the new signs of the others
        x, t = place(p.load(self.high), self.beyond)
        busy = self._noted(self.busy)
        gs = self.value(inputs, t, x)
        self._note(self.dark(gs), self.blind)
        for k, g in enumerate(gs):
            fired, armed = self.happened(k, g), p.load(self.armed, k)
            self._note(fired, self.fired + k)
            crossed = f.logic("and", f.logic("and", busy, f.opposite(fired)), f.compare("une", g, 0.0))
            p.store(f.select(crossed, g, armed), self.armed, k)  # it may have crossed the way that does not count
        p.store(t, self.past)
        # just before the crossing: the state that is logged, and the states after resets
        x, t = place(p.load(self.low), self.there)
        p.store(t, self.when)
        if self.after is not None:
            self.after.evaluate(self.after_shared, {"x": x, "u": inputs(t)}, t, self.states)
        with p.repeat(p.lanes) as lane:
            busy = self.service.compare("ne", p.get(self.busy, lane, "i64"), "0")
            with p.when(busy):
                for k in range(self.count):
                    with p.when(self.service.compare("ne", p.get(self.fired + k, lane, "i64"), "0")):
                        self._happen(k, lane)
                self._settle(lane)

    def _happen(self, k: int, lane: str) -> None:
        """Handle event k in a lane."""
        p, service = self.p, self.service
        if not self.events.reset[k]:
            self._write(k, lane, self.there.slot)
            other = self.f.put(f"fneg double {p.get(self.armed + k, lane)}")
            p.set(other, self.armed + k, lane)
            if self.events.terminal[k]:
                self._keep(self.there.slot, self.kept.slot, lane)
                p.set(str(ENDS), self.cut, lane, "i64")
            return
        with p.when(service.compare("eq", p.get(self.cut, lane, "i64"), "0")):  # else another reset comes first
            self._write(k, lane, self.there.slot)
            p.set(f"{TURNED}", self.phase + k, lane)
            self._keep(self.states + k * p.size, self.kept.slot, lane)
            p.set(str(ENDS if self.events.terminal[k] else RESET), self.cut, lane, "i64")
            never = service.compare("oeq", p.get(self.low, lane), "0.0", "double")
            fresh = service.compare("one", p.get(self.fresh + k, lane), "0.0", "double")
            with p.when(self.f.put(f"and i1 {never}, {fresh}")):
                p.set(str(ACCUMULATING), self.cut, lane, "i64")

    def _keep(self, source: int | None, target: int | None, lane: str) -> None:
        """Copy a lane of a vector to another vector."""
        p = self.p
        assert source is not None and target is not None
        with p.repeat(p.size) as i:
            moved = self.service.moved(lane, i)
            p.set(p.get(source, moved), target, moved)

    def _write(self, k: int, lane: str, slot: int | None) -> None:
        """Count and log an event: run, event, time, state."""
        p, f, service = self.p, self.f, self.service
        at_row = f.put(f"mul i64 {p.word(at.LOGGED)}, {8 * (3 + p.size)}")
        row = f.put(f"getelementptr i8, ptr {self.log}, i64 {at_row}")
        run = f.put(f"sitofp i64 {p.get(self.lanes.run, lane, 'i64')} to double")
        for place, x in enumerate((run, f"{float(k)}", p.get(self.when, lane))):
            service.put(x, row, str(place))
        rest = f.put(f"getelementptr double, ptr {row}, i64 3")
        assert slot is not None
        service.copy_out(slot, rest, p.size, lane)
        p.set_word(service.add(p.word(at.LOGGED), 1), at.LOGGED)
        events = self.lanes.events
        p.set(service.add(p.get(events, lane, "i64"), 1), events, lane, "i64")

    def _settle(self, lane: str) -> None:
        """After the events at one time in a lane: decide whether they accumulate, and whether the step is cut."""
        p, f, service = self.p, self.f, self.service
        t = p.get(self.when, lane)
        with p.when(service.compare("eq", p.get(self.cut, lane, "i64"), str(RESET))):
            gap = f.put(f"fsub double {t}, {p.get(self.latest, lane)}")
            limit = f.put(f"fmul double {t}, {hexadecimal(SOON)}")
            size = f.module.declare("llvm.fabs.f64", "double", ["double"])
            soon = service.compare("ole", gap, f.put(f"call double {size}(double {limit})"), "double")
            more = f.put(f"select i1 {soon}, i64 {service.add(p.get(self.same, lane, 'i64'), 1)}, i64 0")
            p.set(more, self.same, lane, "i64")
            p.set(t, self.latest, lane)
            with p.when(service.compare("sgt", more, str(self.count + 2))):
                p.set(str(ACCUMULATING), self.cut, lane, "i64")
        rounds = service.add(p.get(self.rounds, lane, "i64"), 1)
        p.set(rounds, self.rounds, lane, "i64")
        many = service.compare("sge", rounds, str(ROUNDS))
        free = service.compare("eq", p.get(self.cut, lane, "i64"), "0")
        with p.when(f.put(f"and i1 {many}, {free}")):
            self._keep(self.beyond.slot, self.kept.slot, lane)
            p.set(p.get(self.past, lane), self.when, lane)  # before it, what reads time would happen once more
            p.set(str(RESET), self.cut, lane, "i64")
        ended = service.compare("eq", p.get(self.cut, lane, "i64"), str(ENDS))
        over = service.compare("sge", p.get(self.lanes.events, lane, "i64"), self.most)
        with p.when(f.put(f"and i1 {over}, {f.put(f'xor i1 {ended}, true')}")):
            with p.when(service.compare("eq", p.get(self.cut, lane, "i64"), "0")):
                self._keep(self.there.slot, self.kept.slot, lane)
            p.set(f.put(f"select i1 {free}, i64 {CROWDS}, i64 {ACCUMULATING}"), self.cut, lane, "i64")
        free = service.compare("eq", p.get(self.cut, lane, "i64"), "0")
        blind = service.compare("ne", p.get(self.blind, lane, "i64"), "0")
        with p.when(f.put(f"and i1 {blind}, {free}")):
            self._keep(self.there.slot, self.kept.slot, lane)
            p.set(str(BLIND), self.cut, lane, "i64")
        with p.when(service.compare("ne", p.get(self.cut, lane, "i64"), "0")):
            p.set(p.get(self.when, lane), self.lanes.end, lane)
