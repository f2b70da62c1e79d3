"""Narrow pulses of functions of time alone: the times at which steps have to end so that none is jumped over.

Between pulses nothing shows a method that there are any, and its steps grow. A function of time is cut into pieces in
each of which bounds of its second derivative (`lagrangian.graph.bounds`) show that it bends by no more than `BENT` of
its whole change: the pieces are short where it is narrow. Where they are of very different lengths, steps end where
these pass from one power of `CLASS` to the next, and at every end of the shortest ones.
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
"""Part of its whole change by which a function may bend in one piece."""

CLASS, UNEVEN = 8.0, 16.0
"""The ratio of lengths that makes a class; the ratio of the longest piece to the shortest that makes a pulse."""

MOST, DEEPEST = 20_000, 44
"""Pieces that are looked at, and how often the run is halved, at most; a function that needs more has no stops."""

SHORTEST = 2048
"""Ends of shortest pieces at which steps end, at most: where there are more the function is not narrow but restless."""

CURVED = frozenset({*UNARY, "div", "pow", "powi"})
"""Operations that can make a pulse."""


def curved(program: Program, *, inputs: bool) -> list[int]:
    """The nodes that read time, and beside it constants alone, and can be narrow there. ``inputs``: are constants."""
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
    """The narrow functions of time alone of a model that is driven so."""

    def __init__(self, model: Model, drive: InputSignals) -> None:
        self.program, self._model = right_hand_side(model, drive), model
        self._key = ("pulses", drive.constant, frozenset(drive.feedback.items()))
        self.nodes = remembered(model, (*self._key, "nodes"), lambda: curved(self.program, inputs=drive.constant))

    def __bool__(self) -> bool:
        return bool(self.nodes)

    @property
    def parameters(self) -> set[int]:
        """Which parameters decide when the pulses are."""
        nodes = self.program.graph.nodes
        return {nodes[i][2] for i in reached(self.program.graph, self.nodes) if nodes[i][:2] == ("input", "p")}

    def times(self, p: Array, u: Array, start: float, end: float) -> Array:
        """The times in (start, end) at which some function becomes narrower or wider."""
        key = (*self._key, p.tobytes(), u.tobytes(), start, end)
        return remembered(self._model, key, lambda: self.times_anew(p, u, start, end))

    def times_anew(self, p: Array, u: Array, start: float, end: float) -> Array:
        """The same, not remembered: for many sets of parameters."""
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
        """Of each function at times t its value, and the greatest second derivative within r; (S, functions)."""
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
        """Where the class of the pieces of function k changes, and the ends of those of the lowest class."""
        low = np.concatenate([at[settled[:, k]] for at, _, settled in leaves])
        width = np.concatenate([wide[settled[:, k]] for _, wide, settled in leaves])
        order = np.argsort(low)
        low, width = low[order], width[order]
        if not len(low) or width.max() < UNEVEN * width.min():
            return np.empty(0)
        level = np.floor(np.log(width / width.min()) / np.log(CLASS))
        every = np.diff(level) != 0
        return low[1:][every | (level[1:] == 0) if (level == 0).sum() <= SHORTEST else every]
