"""Lanes that begin: the derivative, the first step size, and arming of the events."""

from __future__ import annotations

from typing import Protocol

from lagrangian.codegen.ir import Function, Value
from lagrangian.integrate.status import RunStatus

from . import memory_layout as at
from .events import EventDetector
from .memory_layout import Lanes
from .method import Method, rough_power
from .printer import Printer, Vec
from .projector import Projector


class Around(Protocol):
    """What this part needs from the loop around it; see `loop.Loop`."""

    p: Printer
    f: Function
    lanes: Lanes
    method: Method
    watch: EventDetector | None
    project: Projector | None
    new_k: Vec
    own_blocks: tuple[Vec, ...]
    inlet: tuple[Vec, ...]
    rtol: Value
    max_step: Value
    atol: Vec

    def rate(self, t: Value, x: Vec, into: Vec | None = None) -> Vec:
        """Print the derivative at (t, x)."""
        ...

    def spend(self, flag: str, count: int) -> None:
        """Print that evaluations were made."""
        ...

    def inputs_at(self, t: Value) -> Vec:
        """Print the inputs at a time."""
        ...


class LaneStart:
    """Prints the part of the loop after the service."""

    def __init__(self, loop: Around) -> None:
        self.loop, self.p, self.f, self.lanes, self.method = loop, loop.p, loop.f, loop.lanes, loop.method

    def print(self) -> None:
        """Print the derivative for lanes that begin or whose right-hand side changed, and the first step size of the
        former."""
        p, f, lanes, method = self.p, self.f, self.lanes, self.method
        f.label("begin")
        state = p.load_whole(lanes.state)
        new = p.whole_is(state, at.NEW)
        fresh = f.logic("or", new, p.whole_is(state, at.RESTARTED))
        trouble = Value(f, f.constant(0.0))
        if self.loop.project is not None:
            t = p.load(lanes.t)
            self.loop.project.begin(new, t, self.loop.inputs_at(t))
        # the derivative at the start, and a first step length for new runs
        if method.follows:
            t = p.load(lanes.t)
            k = self.loop.rate(t, lanes.x, self.loop.new_k)
            p.map(lambda a, b: f.select(fresh, a, b), k, lanes.k, into=(lanes.k,))
            h = self._first_step(t, k)
            p.store(f.select(new, h, p.load(lanes.h)), lanes.h)
            p.store(f.select(new, 1e-4, p.load(lanes.error)), lanes.error)
            self.loop.spend(new, 1)
            self.loop.spend(fresh, 1)
            (trouble,) = p.fold(lambda total, a: (f.fma(a, 0.0, total),), [0.0], lanes.k)
        elif method.expands:
            t = p.load(lanes.t)
            k = self.loop.rate(t, lanes.x)
            p.store(f.select(fresh, self._first_step(t, k), p.load(lanes.h)), lanes.h)  # a first unit of time
            self.loop.spend(fresh, 2)
        elif method.blocks:
            k = self.loop.rate(p.load(lanes.t), lanes.x)
            self.loop.spend(fresh, 1)
            for block in self.loop.own_blocks:
                p.map(lambda a, b: f.select(fresh, a, b), k, block, into=(block,))
        # runs whose derivative or event functions are not finite end at once
        broken, code = f.compare("une", trouble, 0.0), f.integer(RunStatus.NOT_FINITE)
        if self.loop.watch is not None:
            code = p.whole_select(broken, code, f.integer(RunStatus.BLIND))
            broken = f.logic("or", broken, self.loop.watch.arm(self.loop.inputs_at, self.loop.rate, new))
        broken = f.logic("and", fresh, broken)
        p.store_whole(p.whole_select(fresh, f.integer(at.RUNNING), state), lanes.state)
        f.do(f"br i1 {p.any(broken)}, label %lost, label %head")
        f.label("lost")
        state = p.load_whole(lanes.state)
        p.store_whole(p.whole_select(broken, f.integer(at.ENDED), state), lanes.state)
        p.store_whole(p.whole_select(broken, code, p.load_whole(lanes.code)), lanes.code)
        f.do("br label %service")

    def _first_step(self, t: Value, k: Vec) -> Value:
        """A first step size from the sizes of x, ẋ and ẍ (Hairer, Nørsett, Wanner I, section II.4)."""
        p, f, method = self.p, self.f, self.method
        assert method.error_order is not None
        lanes = self.lanes

        def sizes(a: Value, b: Value, x: Value, k: Value, atol: Value) -> tuple[Value, Value]:
            scale = f.fma(f.intrinsic("fabs", x), self.loop.rtol, atol)
            x, k = x / scale, k / scale
            return f.fma(x, x, a), f.fma(k, k, b)

        # h so that an explicit Euler step changes x by 1 % of its size
        d0, d1 = p.fold(sizes, [0.0, 0.0], lanes.x, k, self.loop.atol)
        d0, d1 = (f.intrinsic("sqrt", d * (1.0 / p.size)) for d in (d0, d1))
        small = f.logic("or", f.compare("olt", d0, 1e-5), f.compare("olt", d1, 1e-5))
        h = f.select(small, 1e-6, d0 * 0.01 / d1)
        (ahead,) = p.map(lambda x, k: f.fma(h, k, x), lanes.x, k, into=self.loop.inlet)
        k2 = self.loop.rate(t + h, ahead)

        # ẍ from the derivative after that step, and h for the order of the method
        def bend(a: Value, x: Value, k: Value, k2: Value, atol: Value) -> tuple[Value]:
            d = (k2 - k) / f.fma(f.intrinsic("fabs", x), self.loop.rtol, atol)
            return (f.fma(d, d, a),)

        (d2,) = p.fold(bend, [0.0], lanes.x, k, k2, self.loop.atol)
        d2 = f.intrinsic("sqrt", d2 * (1.0 / p.size)) / h
        greater = f.select(f.compare("ogt", d2, d1), d2, d1)
        flat = f.compare("ole", greater, 1e-15)
        second = rough_power(f, 0.01 / f.select(flat, 1.0, greater), 1.0 / method.error_order)
        second = f.select(flat, f.select(f.compare("ogt", h * 1e-3, 1e-6), h * 1e-3, 1e-6), second)
        hundred = h * 100.0
        best = f.select(f.compare("olt", second, hundred), second, hundred)
        best = f.select(f.compare("olt", best, float("inf")), best, h)  # the trial point may lie outside the domain
        return f.select(f.compare("ogt", best, self.loop.max_step), self.loop.max_step, best)
