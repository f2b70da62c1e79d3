"""Variational equations: how the states of a motion change with parameters, initial values and inputs.

    ẋ = f(x, u, p, t):        δẋ_j = ∂f/∂x δx_j + ∂f/∂u δu_j + ∂f/∂p δp_j        for every column j

δu is 1 for a change of an input at all times, or a function of time that is an input itself, such as the hat of a
knot of a table. Integrals ż = c(x, u, p, t) are further states. Where an event g(x, u, p, t) = 0 replaces x by
R(x, u, p, t), the time of the event changes as well (E. N. Rozenvasser, General sensitivity equations of discontinuous
systems, Automation and Remote Control 28, 1967):

    δt_j = −(∂g δ)_j / (dg/dt)        δx⁺_j = ∂R (δx_j + f⁻ δt_j, δu_j, δp_j, δt_j) − f⁺ δt_j

where dg/dt is taken along the motion before the event, and f⁺ belongs to x⁺.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal

import sympy as sp

from lagrangian.dynamics.feedback import Feedback, with_feedback
from lagrangian.dynamics.impacts import Impact, impact_outputs
from lagrangian.dynamics.observe import Observed, observed
from lagrangian.graph import Graph, Output, Program, Tangents, replaced
from lagrangian.model import Model, Point
from lagrangian.records import dataclass


@dataclass(frozen=True)
class VariedColumn:
    """One quantity that is varied: the ``at``-th parameter ("p"), initial state ("x") or free input ("u") of a run.

    "knot" varies the ``at``-th free input by a function of time, the ``signal``-th further input of the program.
    """

    kind: Literal["p", "x", "u", "knot"]
    at: int
    name: str
    signal: int = 0


@dataclass(frozen=True)
class VariedPrograms:
    """The programs over x = [states; integrals; δ of these, column after column], u with signals, p and t.

    ``base`` is f and the integrands before they are varied, ``rates`` → ẋ, ``events`` → ``g`` and ``after``, ``times``
    → ``dt`` (number of events, columns); the last two are None without events. ``size`` is the number of states and
    integrals.
    """

    base: Program
    rates: Program
    events: Program | None
    times: Program | None
    size: int


@dataclass(frozen=True)
class _Varied:
    """The inputs of a graph that columns vary: the places of states in x, of inputs in u, and the tangents of both."""

    graph: Graph
    columns: Sequence[VariedColumn]
    states: int
    size: int
    free: int

    def changes(self, j: int) -> list[int]:
        """δx and δz of a column."""
        return [self.graph.input("x", self.size * (1 + j) + i) for i in range(self.size)]

    def around(self, j: int) -> dict[int, int]:
        """What a column changes beside states: a parameter or an input."""
        g, column = self.graph, self.columns[j]
        if column.kind == "x":
            return {}
        if column.kind == "knot":
            return {g.input("u", column.at): g.input("u", self.free + column.signal)}
        return {g.input(column.kind, column.at): g.one}

    def direction(self, j: int) -> dict[int, int]:
        """The tangents of all inputs for a column."""
        states = {self.graph.input("x", i): dx for i, dx in enumerate(self.changes(j)[: self.states])}
        return {**states, **self.around(j)}

    def program(self, base: Program, name: str, outputs: Mapping[str, Output]) -> Program:
        """A program over the varied groups."""
        own = [*base.inputs["x"], *(f"integral {i}" for i in range(self.size - self.states))]
        changed = [f"change of {x} by {c.name}" for c in self.columns for x in own]
        signals = [c.name for c in self.columns if c.kind == "knot"]
        inputs = {**base.inputs, "x": (*own, *changed), "u": (*base.inputs["u"], *signals)}
        return replace(base, name=name, outputs=dict(outputs), inputs=inputs)


def variational(
    model: Model,
    columns: Sequence[VariedColumn],
    feedback: Feedback,
    events: Sequence[Impact] = (),
    integrals: Sequence[sp.Expr] = (),
) -> VariedPrograms:
    """The variational equations of a model along ``columns``, with feedback compiled in.

    ``events`` and ``integrals`` are those of the run. Raises `ModelError` for unknown symbols.
    """
    seen = Observed(model)
    rates = [*seen.mechanics.motion.rates, *seen.vdot]
    outputs = {"xdot": Output(tuple(rates), (len(rates),))}
    grown = [seen.node(x, "what is integrated over the run") for x in integrals]
    outputs["zdot"] = Output(tuple(grown), (len(grown),))
    if events:
        outputs |= impact_outputs(seen, events, supply=False)
    base = with_feedback(seen, outputs, feedback, "variational")
    g = base.graph
    f = [*base.outputs["xdot"].ids, *base.outputs["zdot"].ids]
    varied = _Varied(g, columns, len(rates), len(f), len(base.inputs["u"]))
    slopes = [dx for j in range(len(columns)) for dx in Tangents(g, varied.direction(j))(f)]
    xdot = {"xdot": Output((*f, *slopes), (len(f) * (1 + len(columns)),))}
    made = varied.program(base, "variational", xdot)
    own = replace(base, outputs={"xdot": Output(tuple(f), (len(f),))})
    if not events:
        return VariedPrograms(own, made, None, None, len(f))
    watched, times = _events(base, varied, f, len(events))
    return VariedPrograms(own, made, watched, times, len(f))


def _events(base: Program, varied: _Varied, f: Sequence[int], count: int) -> tuple[Program, Program]:
    """``g`` with the varied states after each event, and how the times of events change."""
    g, n, size = base.graph, varied.states, varied.size
    x = [g.input("x", i) for i in range(size)]
    before = {x[i]: f[i] for i in range(n)}
    along = Tangents(g, {**before, g.input("t", 0): g.one})
    rows: list[int] = []
    delays: list[int] = []
    after = base.outputs["after"].ids if "after" in base.outputs else ()
    for e, node in enumerate(base.outputs["g"].ids):
        reset = [*after[e * n : (e + 1) * n], *x[n:]] if after else x
        behind = replaced(g, f, dict(zip(x[:n], reset[:n], strict=True))) if reset != x else list(f)
        rate = along([node])[0]
        row = list(reset)
        for j in range(len(varied.columns)):
            moved = Tangents(g, varied.direction(j))([node])[0]
            delay = g.neg(g.div(moved, rate)) if rate != g.zero else g.zero
            delays.append(delay)
            row += _after(g, varied, j, (f, behind, reset), delay)
        rows += row
    signature = varied.program(base, "varied events", {})
    outputs = {"g": base.outputs["g"]}
    if after:
        outputs["after"] = Output(tuple(rows), (count, len(rows) // count))
    shape = (count, len(varied.columns))
    return replace(signature, outputs=outputs), replace(signature, outputs={"dt": Output(tuple(delays), shape)})


def _after(
    g: Graph, varied: _Varied, j: int, passed: tuple[Sequence[int], Sequence[int], Sequence[int]], delay: int
) -> list[int]:
    """δx⁺ of column j, for the rates before and behind an event, its reset, and δt."""
    before, behind, reset = passed
    changes = varied.changes(j)
    if list(reset) == [g.input("x", i) for i in range(varied.size)]:
        return changes
    moved = [g.add(dx, g.mul(f, delay)) for dx, f in zip(changes, before, strict=True)]
    states = {g.input("x", i): moved[i] for i in range(varied.size)}
    mapped = Tangents(g, {**states, **varied.around(j), g.input("t", 0): delay})(reset)
    return [g.sub(dx, g.mul(f, delay)) for dx, f in zip(mapped, behind, strict=True)]


def varied_quantities(
    model: Model, columns: Sequence[VariedColumn], feedback: Feedback, outputs: Mapping[str, sp.Expr | Point]
) -> Program:
    """x, u, p, t of `variational` (without integrals) → each of ``outputs`` and its change by every column.

    ``"theta"``, ``"change of theta"`` with the columns as the last axis, and ``"rate of theta"``, along the motion at
    constant inputs.
    """
    seen = Observed(model)
    asked = observed(seen, outputs)
    ids = [*seen.mechanics.motion.rates, *seen.vdot]
    base = with_feedback(seen, {**asked, "xdot": Output(tuple(ids), (len(ids),))}, feedback, "varied quantities")
    g, n = base.graph, len(base.inputs["x"])
    varied = _Varied(g, columns, n, n, len(base.inputs["u"]))
    f = base.outputs["xdot"].ids
    along = Tangents(g, {**{g.input("x", i): f[i] for i in range(n)}, g.input("t", 0): g.one})
    found: dict[str, Output] = {name: base.outputs[name] for name in asked}
    for name in asked:
        output = base.outputs[name]
        changes = [Tangents(g, varied.direction(j))(output.ids) for j in range(len(columns))]
        flat = tuple(change[i] for i in range(len(output.ids)) for change in changes)
        found[f"change of {name}"] = Output(flat, (*output.shape, len(columns)))
        found[f"rate of {name}"] = Output(tuple(along(output.ids)), output.shape)
    return varied.program(base, "varied quantities", found)


def columns_key(columns: Sequence[VariedColumn]) -> Any:
    """What the programs of columns depend on."""
    return tuple((c.kind, c.at, c.signal) for c in columns)
