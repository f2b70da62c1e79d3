"""The elimination of a tape, recorded, so that it answers any number of loads.

The accelerations x minimize ½ Σ H_ij x_i x_j + Σ g_i x_i along the tape: x = −M⁻¹ (g gathered along it). What happens
to H does not depend on g, so it is done once; every further g costs one pass backwards and one forwards. A step of
the tape may also be shifted, x_i = Σ c_ij x_j + e_i, which is what a change of its coefficients does to first order,
e_i = Σ δc_ij x_j.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from lagrangian.dynamics.accelerations import Elimination
from lagrangian.dynamics.row_problem import Problem
from lagrangian.dynamics.tape import Form
from lagrangian.graph import Graph
from lagrangian.records import dataclass, field


class Loads:
    """What acts on the unknowns during one pass backwards, and the constants with which they are recovered."""

    def __init__(self, graph: Graph, given: Mapping[int, int], shifts: Mapping[int, int]) -> None:
        self.graph, self.shifts = graph, shifts
        self.g = {i: x for i, x in given.items() if x != graph.zero}
        self.constants: dict[int, int] = {}

    def add(self, i: int, x: int) -> None:
        """Add x to g_i."""
        self.g[i] = self.graph.add(self.g.get(i, self.graph.zero), x)

    def take(self, i: int) -> int:
        """Return g_i, which is 0 from now on."""
        return self.g.pop(i, self.graph.zero)

    def shift(self, i: int, row: Mapping[int, int]) -> None:
        """Move x_i by its shift e: g_k += H_ik e for every neighbour k, i itself included."""
        e = self.shifts.get(i, self.graph.zero)
        self.constants[i] = e
        if e != self.graph.zero:
            for k, h in row.items():
                self.add(k, self.graph.mul(h, e))


class Pass(Protocol):
    """One recorded step of an elimination."""

    def load(self, loads: Loads) -> None:
        """Carry the loads past this step."""
        ...


@dataclass(frozen=True)
class Substituted:
    """x_i = Σ c_j x_j + e; ``row`` is that of H at this moment."""

    i: int
    form: Form
    row: Mapping[int, int]

    def load(self, loads: Loads) -> None:
        """Carry g_j += c_j g_i, after the shift."""
        loads.shift(self.i, self.row)
        linear = loads.take(self.i)
        for j, c in self.form.items():
            loads.add(j, loads.graph.mul(c, linear))


@dataclass(frozen=True)
class Turned:
    """first = c a + s b + e₁ and second = c b − s a + e₂."""

    pair: tuple[int, int]
    parents: tuple[int, int]
    cs: tuple[int, int]
    rows: tuple[Mapping[int, int], Mapping[int, int]]

    def load(self, loads: Loads) -> None:
        """Turn the two loads back, after the shifts."""
        g, (a, b), (c, s) = loads.graph, self.parents, self.cs
        for i, row in zip(self.pair, self.rows, strict=True):
            loads.shift(i, row)
        x, y = (loads.take(i) for i in self.pair)
        loads.add(a, g.sub(g.mul(c, x), g.mul(s, y)))
        loads.add(b, g.add(g.mul(s, x), g.mul(c, y)))


@dataclass(frozen=True)
class Minimised:
    """x_k = −(g_k + Σ H_ki x_i) · inverse."""

    k: int
    row: Mapping[int, int]
    inverse: int

    def load(self, loads: Loads) -> None:
        """Carry g_i −= H_ik g_k · inverse."""
        g, linear = loads.graph, loads.take(self.k)
        for i, h in self.row.items():
            loads.add(i, g.neg(g.mul(g.mul(h, self.inverse), linear)))
        loads.constants[self.k] = g.neg(g.mul(linear, self.inverse))


@dataclass(frozen=True)
class Exchanged:
    """rate = sign · (t − Σ c_j x_j − e): t becomes the unknown."""

    t: int
    rate: int
    sign: int
    form: Form

    def load(self, loads: Loads) -> None:
        """Carry what acts on the rate to t and to the rest of its form."""
        g = loads.graph
        turned = g.mul(self.sign, loads.take(self.rate))
        loads.add(self.t, turned)
        for j, c in self.form.items():
            loads.add(j, g.neg(g.mul(c, turned)))
        loads.constants[self.rate] = g.neg(g.mul(self.sign, loads.shifts.get(self.t, g.zero)))


@dataclass
class RecordedElimination(Elimination):
    """An elimination without loads whose steps are recorded."""

    steps: list[Pass] = field(default_factory=list[Pass])

    @classmethod
    def of(cls, problem: Problem) -> RecordedElimination:
        """Eliminate the form of a problem without rows; raises `ModelError` for a rate that moves no mass."""
        made = cls(problem.graph, problem.tape, problem.H.copy(), {}, problem.names)
        made.run()
        return made

    def substitute(self, i: int, form: Form) -> None:
        """Record the step, and make it."""
        self.steps.append(Substituted(i, form, dict(self.H.rows.get(i, {}))))
        super().substitute(i, form)

    def substitute_pair(self, first: int, second: int, a: int, b: int, c: int, s: int) -> None:
        """Record the step, and make it."""
        # H between the two belongs to both rows: what shifts one loads the other
        rows = dict(self.H.rows.get(first, {})), dict(self.H.rows.get(second, {}))
        self.steps.append(Turned((first, second), (a, b), (c, s), rows))
        super().substitute_pair(first, second, a, b, c, s)

    def eliminate(self, k: int, row: Mapping[int, int], linear: int, inverse: int) -> None:
        """Record the step, and make it."""
        self.steps.append(Minimised(k, dict(row), inverse))
        super().eliminate(k, row, linear, inverse)

    def hand_over(self, t: int, rate: int, sign: int) -> None:
        """Record the step, and make it."""
        form = {j: c for j, c in self.tape.forms[t].items() if j != rate}
        self.steps.append(Exchanged(t, rate, sign, form))
        super().hand_over(t, rate, sign)

    def answer(self, given: Mapping[int, int], shifts: Mapping[int, int] | None = None) -> dict[int, int]:
        """x of every node for the loads ``given`` (node → g), with the shifts of the tape's nodes."""
        g, loads = self.graph, Loads(self.graph, given, shifts or {})
        for step in self.steps:
            step.load(loads)
        value: dict[int, int] = {}
        for i, _, form in reversed(self.found):
            total = loads.constants.get(i, g.zero)
            for k, c in form.items():
                total = g.add(total, g.mul(c, value[k]))
            value[i] = total
        return value
