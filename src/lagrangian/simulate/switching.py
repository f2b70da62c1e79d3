"""Finds when conditions that depend only on time switch; steps have to end then, as they do at the knots of tables.

The error of a step is estimated from a few places inside it. A pulse between them is not noticed at all, and a jump
looks like an error for which no step is short enough. If piecewise, Heaviside, abs, sign, min, max and atan2 depend
only on time and constants, the times at which they switch can be computed before the run.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian.advice import Advice, Argument
from lagrangian.errors import RunError
from lagrangian.graph import Graph, Output, Program, operands, reached
from lagrangian.integrate.design import Design
from lagrangian.integrate.methods.memory_layout import MARGIN
from lagrangian.model import Model
from lagrangian.simulate.inputs import MAX_KNOTS, InputSignals
from lagrangian.simulate.integrating import remembered, right_hand_side
from lagrangian.simulate.pulses import Pulses

Array = NDArray[np.float64]

COARSE, FINE = 1 << 12, 1 << 20
"""The number of places at which conditions are examined at first, and at most if finer searches find more switches."""

ROUNDS = 1100
"""The largest number of halvings between any two doubles."""

MOST_RUNS, MOST_DIFFERENT = 100_000, 1000
"""The largest number of runs that are searched for different switching times, and of runs with different times."""

MOST_PULSES, SOME = 10_000, 32
"""The limits on ends of steps at the pulses of all runs of an ensemble, and on runs examined if there are too many."""

NOT_FINITE = "E503"


def pairs(program: Program, *, inputs: bool) -> list[tuple[int, int]]:
    """The pairs (a, b) of nodes that are compared and depend only on time and constants.

    ``inputs``: whether the inputs are constants.
    """
    graph, nodes = program.graph, program.graph.nodes
    time: dict[int, bool] = {}
    state: dict[int, bool] = {}
    found: dict[tuple[int, int], None] = {}
    for i in reached(graph, program.ids):
        node = nodes[i]
        if node[0] == "input":
            time[i], state[i] = node[1] == "t", node[1] == "x" or (node[1] == "u" and not inputs)
            continue
        below = operands(node)
        time[i], state[i] = any(time[k] for k in below), any(state[k] for k in below)
        pair = _pair(graph, node)
        if pair is not None and any(time.get(k) for k in pair) and not any(state.get(k) for k in pair):
            found[pair] = None
    return list(found)


def _pair(graph: Graph, node: Any) -> tuple[int, int] | None:
    """The two nodes that an operation compares, if it does."""
    match node[0]:
        case "lt" | "le" | "min" | "max":
            return node[1], node[2]
        case "abs" | "sign" | "atan2":  # atan2 jumps where its first argument changes sign
            return node[1], graph.zero
    return None


def parameters_read(program: Program, found: list[tuple[int, int]]) -> set[int]:
    """The parameters that determine when the pairs switch."""
    nodes = program.graph.nodes
    ids = [i for pair in found for i in pair]
    return {nodes[i][2] for i in reached(program.graph, ids) if nodes[i][:2] == ("input", "p")}


class Switches:
    """The conditions in a model with given inputs that depend only on time."""

    def __init__(self, model: Model, drive: InputSignals) -> None:
        self.program, self._model = right_hand_side(model, drive), model
        self._key = ("switches", drive.constant, frozenset(drive.feedback.items()))
        self.pairs = remembered(model, (*self._key, "pairs"), lambda: pairs(self.program, inputs=drive.constant))

    def __bool__(self) -> bool:
        return bool(self.pairs)

    @property
    def parameters(self) -> set[int]:
        """The parameters that determine when they switch."""
        return parameters_read(self.program, self.pairs)

    def times(self, p: Array, u: Array, start: float, end: float) -> Array:
        """The times in (start, end] at which a condition switches: each is the first time at which the switch is
        complete."""
        count = COARSE
        grid = np.linspace(start, end, count + 1)
        order = self._order(grid, p, u)
        changed = order[1:] != order[:-1]
        while count < FINE:
            count *= 4
            finer = np.linspace(start, end, count + 1)
            order = self._order(finer, p, u)
            more = order[1:] != order[:-1]
            same = more.sum() == changed.sum()
            grid, changed = finer, more
            if same:
                break
        where, which = np.nonzero(changed)
        if len(where) > MAX_KNOTS:
            raise RunError(
                f"conditions in time switch {len(where)} times in this run", fix="simulate a shorter time", code="E505"
            )
        low, high = grid[where], grid[where + 1]
        after = order[where + 1, which]  # equality may lie between the two and is passed, too
        for _ in range(ROUNDS):
            middle = low + (high - low) / 2
            open_ = (middle > low) & (middle < high)
            if not open_.any():
                break
            now = self._order(middle, p, u)[np.arange(len(middle)), which] != after
            low, high = np.where(open_ & now, middle, low), np.where(open_ & ~now, middle, high)
        return merged(high, start, end)

    def _order(self, t: Array, p: Array, u: Array) -> NDArray[np.int8]:
        """The sign −1, 0 or 1 of a − b for each pair at times t; (S, pairs)."""
        kernel = remembered(self._model, (*self._key, "kernel"), self._kernel)
        out = np.empty((len(t), 2 * len(self.pairs)))
        x = np.zeros(len(self.program.inputs["x"]))
        try:
            kernel(x=x, u=u, p=p, t=np.ascontiguousarray(t), out=out)
        except RunError as trouble:  # every time is computed in any case; NaN has no order
            if trouble.code != NOT_FINITE:
                raise
        a, b = out[:, 0::2], out[:, 1::2]
        return (a > b).astype(np.int8) - (a < b).astype(np.int8)

    def compared(self) -> Program:
        """The program of what conditions compare, a₁ b₁ a₂ b₂ …"""
        ids = tuple(i for pair in self.pairs for i in pair)
        program = self.program
        return Program("switches", program.graph, program.inputs, {"g": Output(ids, (len(ids),))}, program.defaults)

    def _kernel(self) -> Any:
        return machine.compile(self.compared())


def merged(times: Array, start: float, end: float) -> Array:
    """Times in order; of those that differ only by rounding (0 is crossed within two bits), the last."""
    ordered = np.unique(times[(times > start) & (times <= end)])
    if not len(ordered):
        return ordered
    near = MARGIN / 2 * np.abs(ordered)
    ordered = ordered[ordered - start > near]
    apart = np.diff(ordered) > MARGIN / 2 * np.abs(ordered[1:])
    return ordered[np.append(apart, True)] if len(ordered) else ordered


def with_stops(model: Model, drive: InputSignals, p: Array, times: Array) -> InputSignals:
    """The inputs with the times at which conditions in time switch in a run over ``times``."""
    if len(times) < 2:
        return drive
    switches, pulses = Switches(model, drive), Pulses(model, drive)
    u = _constants(drive, times)
    start, end = float(times[0]), float(times[-1])
    found = [kind.times(p, u, start, end) for kind in (switches, pulses) if kind]
    return replace(drive, stops=merged(np.concatenate(found), start, end)) if found else drive


def with_stops_of_all(
    model: Model, drive: InputSignals, design: Design, times: Array, max_step: float
) -> tuple[InputSignals, tuple[Advice, ...]]:
    """The inputs with the times of switches and pulses in all runs of an ensemble.

    If these differ from run to run, the steps of every run end at all of them. If there are too many switching times,
    `RunError` is raised unless ``max_step`` limits the steps. If there are too many pulses, only ``max_step`` limits
    the steps; without it, a notice says so.
    """
    found = _switches_of_all(model, drive, design, times, max_step)
    narrow = _pulses_of_all(model, drive, design, times)
    said: tuple[Advice, ...] = ()
    if narrow is None and not math.isfinite(max_step):
        said = (
            Advice(
                "an input is narrow at different times in too many runs: steps do not end there, and a run may jump "
                "over a pulse. Limit the steps to less than the shortest one: ",
                Argument("max_step", "0.01"),
            ),
        )
    found += narrow or []
    if found:
        drive = replace(drive, stops=merged(np.concatenate(found), float(times[0]), float(times[-1])))
    return drive, said


def _constants(drive: InputSignals, times: Array) -> Array:
    """The inputs if all are constant, else zeros."""
    return drive.at(times[:1], np.zeros((1, drive.size)))[0] if drive.constant else np.zeros(len(drive.free))


def _pulses_of_all(model: Model, drive: InputSignals, design: Design, times: Array) -> list[Array] | None:
    """The times of narrow functions of time in the runs of an ensemble; None if there are too many."""
    pulses = Pulses(model, drive)
    if not pulses:
        return []
    deciding = pulses.parameters
    listed = any(c.group == "p" and c.index in deciding for c in design.columns)
    known = not any(c.group == "u" for c in design.columns)
    p, u = np.array(design.base["p"])[np.newaxis], _constants(drive, times)
    if listed:
        known = known and design.count <= MOST_RUNS
        p = design.rows(0, design.count if known else SOME).p
        p = p[np.unique(p[:, sorted(deciding)], axis=0, return_index=True)[1]]
    times_of = pulses.times if len(p) == 1 else pulses.times_anew
    known = known and len(p) <= MOST_DIFFERENT
    found, total = [], 0
    for row in p if known else p[:: max(1, len(p) // SOME)]:
        found.append(times_of(np.ascontiguousarray(row), u, float(times[0]), float(times[-1])))
        total += len(found[-1])
        if total > (MOST_PULSES if known else 0):
            return None
    return found


def _switches_of_all(model: Model, drive: InputSignals, design: Design, times: Array, max_step: float) -> list[Array]:
    """The times at which conditions in time switch in the runs of an ensemble."""
    switches = Switches(model, drive)
    if not switches:
        return []
    varied_inputs = any(c.group == "u" for c in design.columns)
    deciding = switches.parameters
    listed = [c for c in design.columns if c.group == "p" and c.index in deciding]
    if (varied_inputs or (listed and design.count > MOST_RUNS)) and math.isfinite(max_step):
        return []
    if varied_inputs:
        raise RunError(
            "an input varies from run to run, and conditions on time switch",
            fix=Advice("make the varied quantity a parameter, or limit the steps: ", Argument("max_step", "0.01")),
            code="E501",
        )
    p = np.array(design.base["p"])[np.newaxis]
    if listed:
        if design.count > MOST_RUNS:
            _too_many(design.count, [c.name for c in listed])
        p = design.rows(0, design.count).p
        _, first = np.unique(p[:, sorted(deciding)], axis=0, return_index=True)
        p = p[first]
        if len(p) > MOST_DIFFERENT:
            if math.isfinite(max_step):
                return []
            _too_many(len(p), [c.name for c in listed])
    u = _constants(drive, times)
    return [switches.times(row, u, float(times[0]), float(times[-1])) for row in p]


def _too_many(count: int, names: list[str]) -> NoReturn:
    raise RunError(
        f"each of {count} runs switches at different times, depending on {', '.join(names)}",
        fix=Advice("limit the steps to less than the shortest pulse: ", Argument("max_step", "0.01")),
        code="E505",
    )
