"""Finds narrow pulses in functions of time: the times at which steps have to end so that no pulse is skipped.

Between pulses a method cannot notice them, and its steps grow. Therefore a function of time is divided into pieces. In
each of them, bounds of its second derivative (`lagrangian.graph.bounds`) show that the curvature changes it by no more
than `BENT` of its whole range; the pieces are short where the function is narrow. If their lengths are very different,
steps end where the lengths pass from one power of `CLASS` to the next, and at every end of the shortest ones.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian.graph import Output, Program, bends, operands, reached
from lagrangian.graph.graph import UNARY
from lagrangian.model import Model
from lagrangian.simulate.inputs import InputSignals
from lagrangian.simulate.integrating import remembered, right_hand_side

Array = NDArray[np.float64]

BENT = 0.1
"""The fraction of its whole range by which curvature may change a function within one piece."""

CLASS, UNEVEN = 8.0, 16.0
"""The ratio of lengths that separates classes; also the ratio of longest to shortest piece that makes a pulse."""

MOST, DEEPEST = 20_000, 44
"""The largest number of pieces, and of halvings of the run; a function that needs more gets no stops."""

SHORTEST = 2048
"""The largest number of shortest pieces at which steps end; if there are more, the function is not a pulse."""

CURVED = frozenset({*UNARY, "div", "pow", "powi"})
"""Operations that can produce a pulse."""


def curved(program: Program, *, inputs: bool) -> list[int]:
    """The nodes that depend only on time and constants, and may be narrow. ``inputs``: whether inputs are constants."""
    nodes = program.graph.nodes
    time: dict[int, bool] = {}
    state: dict[int, bool] = {}
    for i in reached(program.graph, program.ids):
        node = nodes[i]
        if node[0] == "input":
            time[i], state[i] = node[1] == "t", node[1] == "x" or (node[1] == "u" and not inputs)
        else:
            time[i], state[i] = (any(kind[k] for k in operands(node)) for kind in (time, state))
    return [i for i in time if time[i] and not state[i] and nodes[i][0] in CURVED]


class Pulses:
    """The narrow functions of time in a model with given inputs."""

    def __init__(self, model: Model, drive: InputSignals) -> None:
        self.program, self._model = right_hand_side(model, drive), model
        self._key = ("pulses", drive.constant, frozenset(drive.feedback.items()))
        self.nodes = remembered(model, (*self._key, "nodes"), lambda: curved(self.program, inputs=drive.constant))

    def __bool__(self) -> bool:
        return bool(self.nodes)

    @property
    def parameters(self) -> set[int]:
        """The parameters that determine the times of the pulses."""
        nodes = self.program.graph.nodes
        return {nodes[i][2] for i in reached(self.program.graph, self.nodes) if nodes[i][:2] == ("input", "p")}

    def times(self, p: Array, u: Array, start: float, end: float) -> Array:
        """The times in (start, end) at which a function becomes narrower or wider."""
        key = (*self._key, p.tobytes(), u.tobytes(), start, end)
        return remembered(self._model, key, lambda: self.times_anew(p, u, start, end))

    def times_anew(self, p: Array, u: Array, start: float, end: float) -> Array:
        """The same without caching, for many sets of parameters."""
        count = len(self.nodes)
        leaves: list[tuple[Array, Array, NDArray[np.bool_]]] = []
        low, width = np.array([0.0]), 1.0
        open_, looked = np.ones((1, count), bool), 0
        least, most = np.full(count, np.inf), np.full(count, -np.inf)
        for _ in range(DEEPEST):
            looked += len(low)
            if not len(low) or looked > MOST:
                break
            value, bend = self._bends(start + (end - start) * (low + width / 2), (end - start) * width / 2, p, u)
            least, most = np.minimum(least, value.min(axis=0)), np.maximum(most, value.max(axis=0))
            settled = open_ & (bend * ((end - start) * width / 2) ** 2 <= BENT * (most - least))
            leaves.append((low, np.full(len(low), width), settled))
            open_ &= ~settled
            rest = open_.any(axis=1)
            low, width = np.concatenate([low[rest], low[rest] + width / 2]), width / 2
            open_ = np.concatenate([open_[rest]] * 2)
        known = ~open_.any(axis=0) if len(low) else np.ones(count, bool)
        found = [self._edges(leaves, k) for k in np.flatnonzero(known).tolist()]
        return start + (end - start) * np.unique(np.concatenate([*found, np.empty(0)]))

    def _bends(self, t: Array, r: float, p: Array, u: Array) -> tuple[Array, Array]:
        """The value of each function at times t, and the largest second derivative within r; (S, functions)."""
        kernel = remembered(self._model, (*self._key, "kernel"), self._kernel)
        given: dict[str, Any] = {"t": t, "p": p, "u": u, "drift": np.zeros_like(u)}
        given["stretch"] = np.tile([1.0, r], (len(t), 1))
        found = kernel(**{name: array for name, array in given.items() if name in kernel.program.inputs})
        return found["value"], found["bend"]

    def _kernel(self) -> Any:
        program = self.program
        outputs = {"g": Output(tuple(self.nodes), (len(self.nodes),))}
        return machine.compile(bends(Program("pulses", program.graph, program.inputs, outputs, program.defaults)))

    @staticmethod
    def _edges(leaves: list[tuple[Array, Array, NDArray[np.bool_]]], k: int) -> Array:
        """The times at which the class of the pieces of function k changes, and the ends of pieces of the lowest
        class."""
        low = np.concatenate([at[settled[:, k]] for at, _, settled in leaves])
        width = np.concatenate([wide[settled[:, k]] for _, wide, settled in leaves])
        order = np.argsort(low)
        low, width = low[order], width[order]
        if not len(low) or width.max() < UNEVEN * width.min():
            return np.empty(0)
        level = np.floor(np.log(width / width.min()) / np.log(CLASS))
        every = np.diff(level) != 0
        return low[1:][every | (level[1:] == 0) if (level == 0).sum() <= SHORTEST else every]
