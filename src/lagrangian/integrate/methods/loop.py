"""The loop around a method: every lane has its own run, time and step; a lane that is done takes the next run.

    head     step size, trial step, error, new state if the step is good
    inspect  requested times and events inside the step, if there are any
    service  lane by lane: stop points, ends of runs, next runs
    begin    derivative and first step size of lanes that begin

Everything that lasts from step to step is in the work space, so the loop can be left and entered again (at service).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from lagrangian.codegen.emit import attributes
from lagrangian.codegen.ir import Module, Value
from lagrangian.integrate.status import RunStatus
from lagrangian.records import dataclass

from . import memory_layout as at
from .evaluate import PrintedProgram
from .events import EventDetector
from .jets import Jets
from .lane_end import attend
from .lane_scheduler import LaneScheduler
from .lane_start import LaneStart
from .memory_layout import Lanes
from .method import Method, MethodStep, rough_power
from .printer import Printer, Vec
from .projector import Projector

if TYPE_CHECKING:
    from lagrangian.graph import Program
    from lagrangian.integrate.problem import Events
    from lagrangian.integrate.projection import Projection

SAFETY = 0.85

RESOLVED = 2.0**-51
"""The smallest step as a fraction of t, so that time advances."""


@dataclass(frozen=True)
class IntegratorVariant:
    """The options that, besides program and method, determine the machine code of an integrator."""

    lanes: int
    own: bool  # every run has its own parameters
    signals: bool
    events: bool = False


class Loop:
    """Prints the function ``run(ptr table, ptr work, i64 budget)``, and ``facts(ptr)`` with the sizes that Python
    needs."""

    def __init__(
        self,
        module: Module,
        program: Program,
        method: Method,
        variant: IntegratorVariant,
        watched: Events | None = None,
        projection: Projection | None = None,
    ) -> None:
        size = len(program.inputs["x"])
        self.p = p = Printer(module, variant.lanes, size)
        self.f, self.method, self.variant = p.f, method, variant
        self.inputs = len(program.inputs.get("u", ()))
        self.signals = variant.signals
        own = variant.own and bool(program.inputs.get("p"))
        self.lanes = Lanes(p, self.inputs, len(program.inputs.get("p", ())))
        copies = method.evaluations + method.dense_evaluations + 2
        self.tapes = PrintedProgram(p, program, "body", own=own, copies=copies)
        self.new_x, self.new_lost, self.new_k = p.block(), p.block(), p.block()
        self.own_blocks = tuple(p.block() for _ in range(method.blocks))
        self.own_slots = tuple(p.reserve(1) for _ in range(method.slots))
        self.inlet: tuple[Vec, ...] = () if p.unrolled else (Vec(slot=self.tapes.start("body", "x")),)
        self.service = LaneScheduler(p, self.lanes, method, size=size, inputs=self.inputs, signals=self.signals)
        self.project: Projector | None = None
        if projection is not None:
            self.project = Projector(p, self.lanes, program, projection, (self.new_x, self.new_lost), own=own)
            self.service.evaluations -= self.project.corrects and method.lands_late
        self.watch: EventDetector | None = None
        if watched is not None:
            self.watch = EventDetector(p, self.lanes, method, self.service, watched, self.project, own=own)

    def print(self) -> None:
        """Print both functions."""
        p, f = self.p, self.f
        self.shared = p.entry(at.TABLE.index("shared"), "ptr")
        self.rtol = f.broadcast(p.entry(at.TABLE.index("rtol"), "double"))
        self.atol = Vec(pointer=p.entry(at.TABLE.index("atol"), "ptr"))
        self.max_step = f.broadcast(p.entry(at.TABLE.index("max_step"), "double"))
        self.max_steps = p.entry(at.TABLE.index("max_steps"))
        p.set_word("%budget", at.BUDGET)
        self.service.prepare()
        if self.project is not None:
            self.project.prepare(self.service)
        if self.watch is not None:
            self.watch.prepare()
        f.do("br label %service")
        self._head()
        self.service.print(self.tapes, self.watch, self.project)
        LaneStart(self).print()
        widest = f.module.target.lanes
        width = widest if self.method.expands else min(p.lanes, widest)  # expansions of one run are packed
        f.finish("run", "i64", "ptr %table, ptr %work, i64 %budget", attributes(width))
        tapes = (None,) * 3 if (w := self.watch) is None else (w.guard, w.after, w.pieces.tapes)
        tapes += (None,) * 2 if self.project is None else self.project.tapes
        sizes = [0 if t is None else len(t.low.prologue.outputs) for t in tapes]
        facts = (p.slots, len(self.tapes.low.prologue.outputs), *sizes, *self.lanes.places)
        lines = ["define void @facts(ptr %out) {"]
        for k, x in enumerate(facts):
            lines += [f"  %a{k} = getelementptr i64, ptr %out, i64 {k}", f"  store i64 {x}, ptr %a{k}"]
        f.module.define("facts", "\n".join([*lines, "  ret void", "}"]))

    # The right-hand side -----------------------------------------------------------------------------------------

    def inputs_at(self, t: Value) -> Vec:
        """The inputs u at time t in every lane."""
        p, lanes = self.p, self.lanes
        if not self.signals or not self.inputs:
            return Vec(slot=lanes.u)
        since = t - p.load(lanes.knot_time)
        return Vec(values=tuple(p.f.fma(p.load(lanes.slope, k), since, p.load(lanes.u, k)) for k in range(self.inputs)))

    def rate(self, t: Value, x: Vec, into: Vec | None = None) -> Vec:
        """The derivative at time t and state x; a long vector is written to ``into``, or to new slots."""
        p, f = self.p, self.p.f
        # conditions that switch at a stop point must not switch in the step that ends there: stay just before it
        if self.signals:
            stop = p.load(self.lanes.stop)
            last, first = stop - f.intrinsic("fabs", stop) * at.MARGIN, p.load(self.lanes.knot_time)
            last = f.select(f.compare("olt", last, first), first, last)
            t = f.select(f.compare("olt", last, t), last, t)
        values = {"x": x, "u": self.inputs_at(t)}
        if p.unrolled:
            return Vec(values=self.tapes.evaluate(self.shared, values, t))
        target = into if into is not None else p.block()
        self.tapes.evaluate(self.shared, values, t, target.slot)
        return target

    # One step ----------------------------------------------------------------------------------------------------

    def _head(self) -> None:
        p, f, lanes = self.p, self.f, self.lanes
        f.label("head")
        # return to Python when the budget of steps is used up, or when the log of events might overflow
        budget = f.put(f"sub i64 {p.word(at.BUDGET)}, 1")
        p.set_word(budget, at.BUDGET)
        f.do(f"br i1 {f.put(f'icmp slt i64 {budget}, 0')}, label %pause, label %go")
        f.label("pause")
        f.do(f"ret i64 {at.PAUSED}")
        f.label("go")
        if self.watch is not None:
            f.do(f"br i1 {self.watch.full()}, label %full, label %step")
            f.label("full")
            f.do(f"ret i64 {at.FULL}")
            f.label("step")
        t, stop = p.load(lanes.t), p.load(lanes.stop)
        running = p.whole_is(p.load_whole(lanes.state), at.RUNNING)
        if self.method.expands:
            self._expanding(t, stop, running)
        elif self.method.adaptive:
            self._adaptive(t, stop, running)
        else:
            self._fixed(t, stop, running)

    def _step(self, t: Value, h: Value, running: str) -> MethodStep:
        lanes = self.lanes
        return MethodStep(
            self.p, t, h, lanes.x, lanes.lost, lanes.k, self.rate, self.rtol, self.atol,
            self.new_x, self.new_lost, self.new_k, self.inlet, running, self.spend, self.own_blocks, self.own_slots,
            lands_late=self.project is not None and self.project.corrects and self.method.lands_late,
        )  # fmt: skip

    def spend(self, flag: str, count: int) -> None:
        """Count evaluations in addition to those of every step."""
        f, extra = self.f, self.lanes.extra
        spent = f.whole_op("mul", f.put(f"zext {f.flag} {flag} to {f.whole}"), count)
        self.p.store_whole(f.put(f"add {f.whole} {self.p.load_whole(extra)}, {spent}"), extra)

    def _fixed(self, t: Value, stop: Value, running: str) -> None:
        """A step of equal length up to a stop point; ``left`` counts the remaining steps."""
        p, f, lanes = self.p, self.f, self.lanes
        # the end of the step is counted back from the stop point, so that rounding does not add up
        h, left = p.load(lanes.h), p.load(lanes.left) - 1.0
        new_t = f.fma(-left, h, stop)
        s = self._step(t, h, running)
        unsettled = self.method.trial(s)
        (trouble,) = p.fold(lambda total, x: (f.fma(x, 0.0, total),), [0.0], s.new_x)
        finite = fine = f.compare("oeq", trouble, 0.0)
        if unsettled is not None:
            fine = f.logic("and", fine, f.compare("oeq", unsettled, 0.0))
        good = f.logic("and", running, fine)
        if self.project is not None:
            size = self._settle(s, good, new_t, Value(f, f.constant(0.0)))
            finite = f.logic("and", finite, f.compare("olt", size, float("inf")))
            fine, good = f.logic("and", fine, finite), f.logic("and", good, finite)
            self.project.note(new_t, good)
        self._inspect(s, good, new_t)
        self._accept(s, good, new_t)
        p.store(f.select(good, left, p.load(lanes.left)), lanes.left)
        arrived = f.logic("and", good, f.compare("ole", left, 0.0))
        broken = f.logic("and", running, f.opposite(fine))
        code = p.whole_select(finite, self._constant(RunStatus.NO_CONVERGENCE), self._constant(RunStatus.NOT_FINITE))
        attend(self, running, arrived, broken, code)

    def _adaptive(self, t: Value, stop: Value, running: str) -> None:
        """A step as long as the last error allows, which never crosses the stop point."""
        p, f, lanes, method = self.p, self.f, self.lanes, self.method
        # step length: at least what time can resolve, not beyond the stop point, and no tiny last step
        wanted, rest = p.load(lanes.h), stop - t
        least = f.intrinsic("fabs", t) * RESOLVED
        wanted = f.select(f.compare("olt", wanted, least), least, wanted)
        last = f.compare("ole", rest, wanted)
        half = f.compare("olt", rest, wanted + wanted)
        new_t = f.select(last, stop, t + f.select(half, rest * 0.5, wanted))
        h = new_t - t  # so that the sum of the steps is exact
        s = self._step(t, h, running)
        error = method.trial(s)
        assert error is not None
        good = f.logic("and", running, f.compare("ole", error, 1.0))
        if self.project is not None:
            error = self._settle(s, good, new_t, error)
            good = f.logic("and", running, f.compare("ole", error, 1.0))
            self.project.note(new_t, good)
        self._inspect(s, good, new_t)
        # next step length; a rejected step that can hardly become shorter ends the run
        next_h, finite = self._next_step(h, wanted, error, good)
        bad = f.logic("and", running, f.opposite(good))
        stuck = f.logic("and", bad, f.compare("ole", t + next_h * 0.125, t))
        p.store(f.select(running, next_h, wanted), lanes.h)
        self._accept(s, good, new_t)
        p.count(bad, lanes.rejected)
        code = p.whole_select(finite, self._constant(RunStatus.UNDERFLOW), self._constant(RunStatus.NOT_FINITE))
        attend(self, running, f.logic("and", good, last), stuck, code)

    def _expanding(self, t: Value, stop: Value, running: str) -> None:
        """A step whose length is determined by the expansion of the motion at its start."""
        p, f, lanes = self.p, self.f, self.lanes
        # coefficients for time in units of the last step, which give the longest step for the tolerance
        unit, rest = p.load(lanes.h), stop - t
        s = self._step(t, unit, running)
        wanted = self.method.expand(s, lambda states: self._jets(states, t, unit))
        longest = unit * self.method.limits[1]  # the last terms may vanish here, as those of sin(t)^40 do at t = 0
        seen = f.compare("ogt", t + longest * 0.125, t)
        wanted = f.select(f.logic("and", seen, f.compare("ogt", wanted, longest)), longest, wanted)
        wanted = f.select(f.compare("ogt", wanted, self.max_step), self.max_step, wanted)
        if self.project is not None:
            wanted = wanted * p.load(self.project.shrunk)
        last = f.compare("ole", rest, wanted)
        half = f.compare("olt", rest, wanted + wanted)
        new_t = f.select(last, stop, t + f.select(half, rest * 0.5, wanted))
        s.h, s.unit = new_t - t, unit
        self.method.trial(s)
        (trouble,) = p.fold(lambda total, x: (f.fma(x, 0.0, total),), [0.0], s.new_x)
        fine = f.compare("oeq", trouble, 0.0)
        good = f.logic("and", running, fine)
        if self.project is not None:
            size = self._settle(s, good, new_t, Value(f, f.constant(0.0)))
            fine = f.logic("and", fine, f.compare("olt", size, float("inf")))
            good = self.project.within(f.logic("and", running, fine), size, lanes.rejected)
            self.project.note(new_t, good)
        stuck = f.logic("and", running, f.compare("ole", t + wanted * 0.125, t))
        self._inspect(s, good, new_t)
        p.store(f.select(f.logic("and", good, f.compare("ogt", wanted, 0.0)), wanted, unit), lanes.h)
        self._accept(s, good, new_t)
        broken = f.logic("or", stuck, f.logic("and", running, f.opposite(fine)))
        code = p.whole_select(fine, self._constant(RunStatus.UNDERFLOW), self._constant(RunStatus.NOT_FINITE))
        arrived = f.logic("and", f.logic("and", good, last), f.opposite(broken))
        attend(self, running, arrived, broken, code)

    def _settle(self, s: MethodStep, good: str, new_t: Value, error: Value) -> Value:
        """Project the end of a step, and compute the derivative there; return the error that results."""
        assert self.project is not None
        error = self.project.settle(s, good, self.inputs_at(new_t), new_t, error, adaptive=self.method.adaptive)
        if self.method.follows and self.project.corrects:
            self.method.landed(s, s.rate(s.t + s.h, s.new_x, self.new_k))
            self.spend(good, 1)
        return error

    def _jets(self, states: list[list[Value]], t: Value, unit: Value) -> Jets:
        """The series of the right-hand side, with the coefficients of the states that are known so far."""
        tapes = self.tapes
        return Jets(self.f, tapes.low.body, lambda i: self._leaf(tapes.low.body.ops[i], states, t, unit))

    def _leaf(self, op: tuple, states: list[list[Value]], t: Value, unit: Value) -> tuple[list, bool]:
        """The coefficients of a constant or an input, for time in units of ``unit``, and whether it is constant."""
        f, p = self.f, self.p
        if op[0] == "const":
            return [Value(f, f.constant(op[1]))], True
        if op[0] == "shared":
            own = self.tapes.own
            return [f.load(p.at(self.tapes.shared) if own else self.shared, op[1], uniform=not own)], True
        group, slot = self.tapes.named(op[1])
        if group == "x":
            return states[slot], False
        if group == "t":
            return [t, unit], False
        now = p.read(self.inputs_at(t), slot)
        return ([now, p.load(self.lanes.slope, slot) * unit], False) if self.signals else ([now], True)

    def _next_step(self, h: Value, wanted: Value, error: Value, good: str) -> tuple[Value, str]:
        """The next step size, and where the error is a finite number."""
        p, f, lanes, method = self.p, self.f, self.lanes, self.method
        assert method.error_order is not None
        # PI control: h (tolerance/error)^(1/order), damped by the previous error, within the method's limits
        low, high = method.limits
        factor = rough_power(f, error, -1.0 / method.error_order) * SAFETY
        if method.memory:
            factor = factor * rough_power(f, p.load(lanes.error), method.memory)
        factor = f.select(f.compare("ogt", factor, high), high, factor)
        factor = f.select(f.compare("olt", factor, low), low, factor)
        finite = f.compare("olt", error, float("inf"))
        retry = f.select(finite, f.select(f.compare("ogt", factor, 0.9), 0.9, factor), 0.5)
        longer = h * factor
        cut = f.logic("and", f.compare("olt", longer, wanted), f.compare("olt", h, wanted))
        longer = f.select(cut, wanted, longer)  # a step shortened to meet a stop point says nothing against the wanted
        next_h = f.select(good, longer, h * retry)
        next_h = f.select(f.compare("ogt", next_h, self.max_step), self.max_step, next_h)
        if method.memory:
            held = f.select(f.compare("olt", error, 1e-4), 1e-4, error)
            p.store(f.select(good, held, p.load(lanes.error)), lanes.error)
        return next_h, finite

    def _constant(self, x: int) -> str:
        return self.f.integer(x)

    def _inspect(self, s: MethodStep, good: str, new_t: Value) -> None:
        """Handle requested times and events inside the step."""
        p, f, lanes, watch = self.p, self.f, self.lanes, self.watch
        if watch is None and not self.method.adaptive:
            return
        wants = good
        if watch is None:
            wants = f.logic("and", good, f.compare("ole", p.load(lanes.next), new_t))
        else:
            p.store_whole(self._constant(0), watch.cut)
        with p.when(p.any(wants)):
            # the polynomial inside the step is computed only if some lane needs it
            coefficients = self.method.interpolant(s)
            self.spend(wants, self.method.dense_evaluations)
            p.store(new_t, lanes.end)
            if watch is not None:
                watch.find(s, coefficients, self.inputs_at, good, new_t)
                if not self.method.adaptive:  # requested times are stop points, unless a lane never gets there
                    free = p.whole_is(p.load_whole(watch.cut), 0)
                    p.store(f.select(free, -float("inf"), p.load(lanes.end)), lanes.end)
            self._samples(s, good, coefficients)

    def _accept(self, s: MethodStep, good: str, new_t: Value) -> None:
        """Accept the step if it is good: the new state is stored."""
        p, f, lanes, watch = self.p, self.f, self.lanes, self.watch
        if watch is not None:
            # a lane that an event stopped inside the step continues from the event's time and state
            stays = p.whole_is(p.load_whole(watch.cut), 0)
            new_t = f.select(stays, new_t, p.load(lanes.end))
            (s.new_x,) = p.map(lambda new, kept: f.select(stays, new, kept), s.new_x, watch.kept, into=(self.new_x,))
            (s.new_lost,) = p.map(lambda lost: f.select(stays, lost, 0.0), s.new_lost, into=(self.new_lost,))
            if self.project is not None:
                self.project.reset(s, f.opposite(stays), new_t, self.inputs_at(new_t))
            on = f.logic("and", good, stays)
            for k in range(watch.count):
                p.store(f.select(on, 0.0, p.load(watch.fresh, k)), watch.fresh, k)

        def keep(new: Value, old: Value) -> Value:
            return f.select(good, new, old)

        p.map(keep, s.new_x, lanes.x, into=(lanes.x,))
        p.map(keep, s.new_lost, lanes.lost, into=(lanes.lost,))
        if self.method.follows:
            p.map(keep, s.new_k, lanes.k, into=(lanes.k,))
        p.store(f.select(good, new_t, s.t), lanes.t)
        p.count(good, lanes.steps)

    # Requested times ---------------------------------------------------------------------------------------------

    def _samples(self, s: MethodStep, good: str, coefficients: list[Vec]) -> None:
        """Write the states at the requested times inside the step, up to ``lanes.end``."""
        p, f, lanes, method = self.p, self.f, self.lanes, self.method
        p.store_whole(f.put(f"zext {f.flag} {good} to {f.whole}"), lanes.good)
        with p.forever() as leave:
            following, end = p.load(lanes.next), p.load(lanes.end)
            inside = f.logic("and", good, f.compare("ole", following, end))
            leave(f.put(f"xor i1 {p.any(inside)}, true"))
            theta = (following - s.t) / s.h
            whole = f.compare("oge", theta, 1.0)
            between = method.between(s, coefficients, theta)
            p.map(
                lambda x, new, *c: f.select(whole, new, between(x, *c)),
                s.x, s.new_x, *coefficients, into=(lanes.sampled,),
            )  # fmt: skip
            if self.project is not None and self.project.corrects:
                inner = f.logic("and", inside, f.opposite(whole))
                self.project.correct(following, self.inputs_at(following), lanes.sampled, inner)
            self.service.write_samples()
