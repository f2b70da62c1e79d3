"""Finds zero crossings of event functions on a step's dense output, for runs that are made step by step in Python.

A step is divided into pieces as in the machine code (``methods/pieces.py``), all pieces of one length together.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen import compile
from lagrangian.graph import Program, bounds, reached, states_read
from lagrangian.records import dataclass

from .methods.pieces import COARSE, MAX_FINE_PIECES, MIN_PIECE

Array = NDArray[np.float64]
Control = Callable[[float, Array], Array]

DEGREE = 12
"""The highest degree of a polynomial inside a step (that of LSODA)."""

ASKED = 16
"""The number of places in a step at which a function is evaluated if it depends on an input that is a Python
function."""

NEAREST = 60
"""After an event its function is 0: it is evaluated at h/2^60, h/2^59, … of the next step to find its direction."""

MANY = 1 << 14
"""The initial number of pieces of a step: all of one length are examined together, which is fast."""

AHEAD = 1e-8
"""The time [s] along ẋ at which a function is evaluated to find its direction after its event."""


@dataclass(frozen=True)
class Hit:
    """An event that happened: its number, its time, the state before it and, if it changes the state, the state
    after it."""

    index: int
    time: float
    before: Array
    after: Array | None
    terminal: bool


class Crossings:
    """Watches functions g along a run.

    ``program`` has the outputs ``g`` (ne,) and, with resets, ``after`` (ne, nx); ``kernel`` evaluates it. ``side`` is
    the last sign of each g, or 0 directly after its own event: it must then leave zero before it can cross again.
    ``settled`` is the number of an event whose reset sends its function back so weakly that it would cross again
    unnoticed within one step: the bodies that touch have come to rest. ``blind`` is the last time at which every g is a
    number, once one of them is NaN.
    """

    def __init__(
        self,
        kernel: Callable[..., Any],
        program: Program,
        p: Array,
        direction: Sequence[int],
        terminal: Sequence[bool],
        reset: Sequence[bool],
    ) -> None:
        self.kernel, self.p = kernel, p
        self.direction, self.terminal, self.reset = list(direction), list(terminal), list(reset)
        count = len(self.direction)
        self.side: Array = np.zeros(count)
        self.came_from: Array = np.zeros(count)  # the side before the last event of each
        self.bound: Array = np.zeros(count)  # the side to which it moves afterwards
        self.last = np.full(count, -np.inf)  # its time
        self.settled: int | None = None
        self.blind: float | None = None
        self.most = MANY
        self.begun = False  # a run that begins at zero and moves in an event's direction has its event there
        self.field: Control = lambda t, x: x
        self.inputs = len(program.inputs.get("u", ()))
        self.judge = compile(bounds(program), threads=1)
        self.read = list(states_read(program))
        nodes = program.graph.nodes
        guards = reached(program.graph, program.outputs["g"].ids)
        self.driven = {nodes[i][2] for i in guards if nodes[i][:2] == ("input", "u")}

    def start(self, t: float, x: Array, u: Control, field: Control) -> None:
        """Evaluate the functions at the beginning of an interval with ẋ = field(t, x); one that just had its event may
        leave 0."""
        self.field = field
        g = self._g(t, x, u)
        if np.isnan(g).any():
            self.blind = t
            return
        self.side = np.where(self.last == t, 0.0, np.sign(g))
        self.bound = self._heading(t, x, u)
        if not self.begun:
            self.begun = True
            toward = np.where(self.bound == 0, self._pressed(t, x, u), self.bound)
            through = (self.side == 0) & (np.array(self.direction) * toward > 0)
            self.side = np.where(through, -toward, self.side)

    def _heading(self, t: float, x: Array, u: Control) -> Array:
        """The sides to which the functions move from a state, along ẋ."""
        rate = self.field(t, x)
        return np.sign(self._g(t + AHEAD, x + AHEAD * rate, u)) if np.all(np.isfinite(rate)) else self.side

    def _pressed(self, t: float, x: Array, u: Control) -> Array:
        """The sides to which the functions move from a state in which they rest, along ẋ of a slightly later time."""
        later = self.field(t, x + AHEAD * self.field(t, x))
        return np.sign(self._g(t + AHEAD, x + AHEAD * later, u)) if np.all(np.isfinite(later)) else self.side

    def between(self, start: float, end: float, dense: Any, u: Control, asked: Sequence[int] = ()) -> list[Hit]:
        """The events of a step in order of time, up to the first that stops the run or changes the state.

        ``asked``: the inputs that are Python functions; the others are linear in time.
        """
        # places at which signs are compared; more of them near the start while a function is still 0
        fractions = self._pieces(start, end, dense, u, asked)
        if not self.side.all():
            fractions = np.concatenate([2.0 ** -np.arange(NEAREST, 2, -1), fractions])
        places = np.unique(np.minimum(start + (end - start) * fractions, end))
        sent = (self.last == start) & np.array(self.reset) & (self.bound != -self.came_from)
        before, found = start, []
        for place in places[places > start]:
            # signs at this place; if a function is NaN there, go only as far as all are numbers
            now = np.sign(self._g(place, dense(place), u))
            if np.isnan(now).any():
                clear, place = self._edge(before, place, dense, u)
                now = np.sign(self._g(place, dense(place), u))
                now, self.blind = np.where(np.isnan(now), self.side, now), clear
            astray = sent & (self.side == 0) & (now == -self.came_from)  # rounding, or sent back too weakly
            if place == places[-1] and astray.any():
                self.settled = int(np.flatnonzero(astray)[0])
                return found
            # events between the two places, up to one that ends the step
            for hit in self._crossed(before, place, now, dense, u):
                if hit.after is not None and self._heading(hit.time, hit.before, u)[hit.index] == self.side[hit.index]:
                    self.settled = hit.index  # the crossing is finer than the resolution of the dense output
                    return found
                found.append(hit)
                if hit.terminal or hit.after is not None:
                    return found
            moved = np.where(self.last == place, 0.0, self.side)
            self.side = np.where((now != 0) & ~astray, now, moved)
            before = place
            if self.blind is not None:
                break
        return found

    def _pieces(self, start: float, end: float, dense: Any, u: Control, asked: Sequence[int]) -> Array:
        """The ends of pieces, as fractions of the step, so short that no function crosses zero twice in one."""
        # the states inside the step as polynomials on [−1, 1], through Chebyshev points
        z = np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))
        middle, half = (start + end) / 2, (end - start) / 2
        powers = np.linalg.solve(np.vander(z, increasing=True), dense(middle + half * z)[self.read].T)
        inputs = [u(t, dense(t)) if self.driven else np.zeros(self.inputs) for t in (start, end)]
        ends: list[Array] = []
        # halve all unsettled pieces until each is settled, or too many have been examined
        low, high, count = np.array([-1.0]), np.array([1.0]), 0
        while len(low) and count + len(low) <= self.most:
            count += len(low)
            settled = self._proved(low, high, powers, (middle, half), inputs) | (high - low <= 2 * MIN_PIECE)
            ends.append(high[settled])
            low, high = low[~settled], high[~settled]
            cut = (low + high) / 2
            low, high = np.concatenate([low, cut]), np.concatenate([cut, high])
        if len(low):
            ends.append(np.unique(2 * COARSE * np.ceil(high / (2 * COARSE))))
            self.most = max(MAX_FINE_PIECES, self.most // 2)  # it may be so in every step
        if self.driven & set(asked):
            ends.append(np.linspace(-1, 1, ASKED + 1)[1:])
        return np.unique(np.concatenate(ends)) / 2 + 0.5

    def _proved(
        self, low: Array, high: Array, powers: Array, at: tuple[float, float], inputs: Sequence[Array]
    ) -> NDArray[np.bool_]:
        """The pieces of the step, from −1 to 1, in which it is proved that no function crosses zero twice."""
        centre, r = (low + high) / 2, (high - low) / 2
        value, rate, bend = (np.zeros((len(low), len(self.read))) for _ in range(3))
        third, z, far = np.zeros_like(value), centre[:, None], (np.abs(centre) + r)[:, None]
        # Horner's scheme with two derivatives, and a bound of the third derivative
        for j in range(DEGREE, -1, -1):
            bend, rate, value = bend * z + rate, rate * z + value, value * z + powers[j]
            if j > 2:
                third = third * far + j * (j - 1) * (j - 2) * np.abs(powers[j])
        given = {
            "x": value, "rate": rate, "bend": 2 * np.abs(bend) + third * r[:, None],
            "u": (inputs[0] + inputs[1]) / 2 + z * (inputs[1] - inputs[0]) / 2,
            "drift": np.broadcast_to((inputs[1] - inputs[0]) / 2, (len(low), len(inputs[0]))),
            "p": self.p, "t": at[0] + at[1] * centre, "stretch": np.stack([np.full(len(r), at[1]), r], axis=1),
        }  # fmt: skip
        found = self.judge(**{name: array for name, array in given.items() if name in self.judge.program.inputs})
        return np.all((found["clear"] > 0) | (found["steady"] > 0), axis=1)

    def _crossed(self, before: float, place: float, now: Array, dense: Any, u: Control) -> list[Hit]:
        """The events between two places, in order of time."""
        wanted = np.array([not d or d == -s for d, s in zip(self.direction, self.side, strict=True)], bool)
        crossed = np.flatnonzero((self.side != 0) & (now != self.side) & wanted)
        times = sorted((self._located(int(k), before, place, dense, u), int(k)) for k in crossed)
        hits: list[Hit] = []
        for time, k in times:
            state = np.array(dense(time))
            after = np.array(self._outputs(time, state, u)["after"][k]) if self.reset[k] else None
            self.last[k], self.came_from[k] = time, self.side[k]
            hits.append(Hit(k, time, state, after, bool(self.terminal[k])))
            if self.terminal[k] or after is not None:
                break
        return hits

    def _edge(self, a: float, b: float, dense: Any, u: Control) -> tuple[float, float]:
        """The last time from a on at which every g is a number, and the next at which one is NaN, as it is at b."""
        while a < (half := a + (b - a) / 2) < b:
            a, b = (a, half) if np.isnan(self._g(half, dense(half), u)).any() else (half, b)
        return a, b

    def _located(self, k: int, a: float, b: float, dense: Any, u: Control) -> float:
        """The time in (a, b] at which function k is 0, to the last bit."""

        from scipy.optimize import brentq

        def g(t: float) -> float:
            return float(self._g(t, dense(t), u)[k])

        high, low = g(b), g(a)
        if high == 0:
            return float(b)
        if low == 0 or (low > 0) == (high > 0):  # rounding at the beginning of the step
            return float(a)
        root: Any = brentq(g, a, b, xtol=4e-300, rtol=4 * np.finfo(np.float64).eps, maxiter=200)
        return float(root)

    def _outputs(self, t: float, x: Array, u: Control) -> dict[str, Array]:
        answer = self.kernel(np.ascontiguousarray(x), u(t, x), self.p, t)
        return answer if isinstance(answer, dict) else {"g": answer}

    def _g(self, t: float, x: Array, u: Control) -> Array:
        return np.asarray(self._outputs(float(t), x, u)["g"])
