"""Checks of a derivation in named quantities: every line of it is proved, not the graph it was read from.

The printed definitions and lines are read back into a graph of their own. There they meet L = T* − V, differentiated by
the machine, at random points of a prime field: what is zero there is zero identically, except with a probability of
about the degree over the prime, some 1e-16 a point. Where the field has no value (logarithms, cases, …), and where
decimal numbers are rounded differently on the two sides, numbers at random states decide.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import random
from collections.abc import Sequence
from functools import cached_property

import numpy as np
import sympy as sp

from lagrangian import dynamics
from lagrangian.derive import Derived
from lagrangian.dynamics.drags import slipping_by
from lagrangian.dynamics.floating import transported_momenta
from lagrangian.dynamics.vectors import minus
from lagrangian.graph import Graph, NotAlgebraic, Output, PrimePoint, Program, from_sympy, gradient
from lagrangian.model import Model, time
from lagrangian.model.rows import rows_of
from lagrangian.page.formula import Check, Name, Text, text
from lagrangian.records import dataclass
from lagrangian.verify.motion import verify_motion
from lagrangian.verify.on_rows import OnRows
from lagrangian.verify.states import State, evaluated, random_states, relative

POINTS = 3
"""The number of random points of the prime field."""

TOLERANCE = 1e-9
"""The relative difference up to which two numbers count as equal: no more than rounding."""


@dataclass(frozen=True)
class _Claim:
    """Two lists of nodes that are equal if the derivation is right."""

    what: Text
    shown: Sequence[int]
    other: Sequence[int]


def verify_listed(derivation: Derived, *, states: int, seed: int) -> tuple[Check, ...]:
    """Prove the lines of a structured derivation, and check what is compiled of its model at random states.

    Raises `ModelError` if units do not agree, or if no random state has finite forces.
    """
    reading = _Reading(derivation)
    checks = [_proved(reading, claim, states, seed) for claim in reading.claims()]
    if derivation.multipliers:
        checks.append(_on_rows(reading, states, seed))
    checks.append(_in_numbers(reading, states, seed))
    return (*checks, *verify_motion(dynamics.slips(derivation.model), states=states, seed=seed))


class _Reading:
    """The lines of a derivation, read back as nodes beside the mechanics of its model."""

    def __init__(self, derivation: Derived) -> None:
        self.derivation, self.model = derivation, derivation.model
        self.graph = Graph()
        self.inputs = dynamics.Inputs.of(self.graph, self.model)
        self.mechanics = dynamics.describe(self.model, self.graph, self.inputs)
        self.a = [self.graph.input("a", i) for i in range(len(self.inputs.v))]
        self.table = _table(self.model, self.inputs, self.a)
        rates = zip(self.model.coordinates, self.mechanics.motion.rates, strict=True)
        self.table = {**{c.rate: rate for c, rate in rates}, **self.table}  # of floating frames: made of their speeds
        names = [row.name for row in self.mechanics.rows]
        self.kept = [names.index(name) for name in derivation.multipliers]
        self.lam = [self.graph.input("lambda", k) for k in range(len(self.kept))]
        self.table |= {x.symbol: n for x, n in zip(derivation.multipliers.values(), self.lam, strict=True)}
        known = dict(zip(derivation.multipliers, self.lam, strict=True))
        self.slips = [(drag.rate, effort) for drag, effort in slipping_by(self.graph, self.mechanics.drags, known)]
        for d in derivation.definitions:
            self.table[d.symbol] = self.node(d.expression)

    @cached_property
    def forward(self) -> Program:
        """The forward dynamics, which say whether a state has finite forces."""
        return dynamics.forward(dynamics.slips(self.model))

    def held(self, state: State) -> dict[str, list[float]]:
        """A state with values of the multipliers."""
        source = random.Random(repr(state["q"]))
        return {**state, "lambda": [source.uniform(-1, 1) for _ in self.lam]}

    def node(self, expr: sp.Basic) -> int:
        """The node of an expression in the coordinates and the defined symbols."""
        return from_sympy(self.graph, expr, self.table)

    def pushed(self, forces: Sequence[int]) -> list[int]:
        """Forces that a motion needs, less those of the constraints: Σ λ ∂c/∂v of the rows that are compiled."""
        m = self.mechanics
        pairs = [(m.rows[k].rate, lam) for k, lam in zip(self.kept, self.lam, strict=True)]
        return minus(self.graph, forces, m.gathered(pairs)) if pairs else list(forces)

    def rows(self) -> list[int]:
        """Left minus right of every equation."""
        return [self.graph.sub(self.node(e.lhs), self.node(e.rhs)) for e in self.derivation.equations]

    def claims(self) -> list[_Claim]:
        """What the lines say, and the same by differentiating L."""
        g, d, m = self.graph, self.derivation, self.mechanics
        step5 = d.steps[5].expressions
        momenta = [self.node(x) for x in step5["momenta"].values()]
        gradients = [self.node(x) for x in step5["gradients"].values()]
        T, V = self.node(d.T), self.node(d.V)
        rates = m.motion.second_rate(momenta, self.a)
        stored = m.motion.along_velocities(gradient(g, V, self.inputs.q))
        turned = transported_momenta(g, m.floats, m.v, momenta)
        lagrange = [
            g.add(g.sub(rate, g.add(slope, twist)), force)
            for rate, slope, twist, force in zip(rates, gradients, turned, stored, strict=True)
        ]
        L, Xi = Name("L"), Name("Xi")
        return [
            *self._kinematics(),
            _Claim(
                text("the equations are Lagrange's equations of ", L, " by automatic differentiation: identically"),
                self.rows(),
                self.pushed(m.inverse_from_lagrangian(self.a, self.slips)),
            ),
            _Claim(
                text(
                    "d/dt of the momenta shown, minus ∂",
                    Name("T*"),
                    "/∂ξ as shown, plus ∂",
                    Name("V"),
                    "/∂ξ, are the left-hand sides shown: identically",
                ),
                [self.node(x) for x in step5["left_hand_sides"].values()],
                lagrange,
            ),
            _Claim(
                text("the momenta shown are ∂", Name("T*"), "/∂ξ̇ of the energies shown: identically"),
                momenta,
                gradient(g, T, self.inputs.v),
            ),
            _Claim(
                text("the energies shown are those of the bodies and springs: identically"), [T, V], self._energies()
            ),
            _Claim(
                text(Xi, " is the power of the forces by its rate: identically"),
                self._forces(),
                m.gathered([*m.efforts, *self.slips]),
            ),
            *self._rows_of_constraints(),
        ]

    def _rows_of_constraints(self) -> list[_Claim]:
        """The rows shown are those that the machine keeps; none without constraints."""
        m, known = self.mechanics, list(self.derivation.multipliers.values())
        if not known:
            return []
        shown, other = [self.node(row.rate) for row in known], [m.rows[k].rate for k in self.kept]
        for row, k in zip(known, self.kept, strict=True):
            if row.position is not None:
                shown.append(self.node(row.position))
                other.append(m.rows[k].residual or self.graph.zero)
        return [_Claim(text("the compiled rows of the constraints are those shown: identically"), shown, other)]

    def row_rates(self) -> _Claim:
        """f, c and ċ as shown against f as it was described, its rate and the rate of that: where f and c are zero."""
        motion, shown, other = self.mechanics.motion, list[int](), list[int]()
        described = {row.name: row for row in rows_of(self.model)}
        for row in self.derivation.multipliers.values():
            given, held = described[row.name], self.node(row.rate)
            if row.position is not None and given.position is not None:
                f = self.node(self.model.expand(given.position, constants=True))
                shown.append(self.node(row.position))
                other.append(f)
                rate = motion.rate([f])[0]
            else:
                rate = self.node(self.model.expand(given.rate, constants=True))
            shown += [held, self.node(row.second_rate)]
            other += [rate, *motion.second_rate([rate], self.a)]
        return _Claim(
            text("on the constraints, ċ as shown is the rate of c, and c that of f as it was described"), shown, other
        )

    def _kinematics(self) -> list[_Claim]:
        """The rates of the coordinates of floating frames, as step 1 shows them; none without such a frame."""
        shown = self.derivation.steps[1].expressions.get("rates", {})
        known = dict(zip((c.symbol for c in self.model.coordinates), self.mechanics.motion.rates, strict=True))
        if not shown:
            return []
        what = text("the rates shown are those of the positions and turns that the velocities make: identically")
        return [_Claim(what, [self.node(x) for x in shown.values()], [known[q] for q in shown])]

    def _energies(self) -> list[int]:
        return [self.mechanics.kinetic(), self.mechanics.potential()]

    def _forces(self) -> list[int]:
        return [self.node(x) for x in self.derivation.Xi.values()]


def _table(model: Model, inputs: dynamics.Inputs, a: Sequence[int]) -> dict[sp.Basic, int]:
    """The node of every symbol of a model."""
    table: dict[sp.Basic, int] = {time: inputs.t}
    table |= {c.symbol: q for c, q in zip(model.coordinates, inputs.q, strict=True)}
    table |= {v.symbol: node for v, node in zip(model.velocities, inputs.v, strict=True)}
    table |= {sp.Derivative(v.symbol, time): vdot for v, vdot in zip(model.velocities, a, strict=True)}
    table |= dict(zip((u.symbol for u in model.inputs), inputs.u, strict=True))
    table |= dict(zip((p.symbol for p in model.parameters), inputs.p, strict=True))
    return table


def _proved(reading: _Reading, claim: _Claim, states: int, seed: int) -> Check:
    """Whether a claim holds at random points of a prime field, or else in numbers at random states.

    Decimal numbers of a description are rounded in different places on the two sides, so that exact numbers may differ
    where nothing is wrong; then, and where the field has no value, numbers decide.
    """
    g = reading.graph
    apart = [g.sub(x, y) for x, y in zip(claim.shown, claim.other, strict=True)]
    for k in range(POINTS):
        values = PrimePoint(g, seed=k + 1).values(apart)
        if isinstance(values, NotAlgebraic):
            return _compared(reading, claim, states, seed, f"no exact numbers for {values.operation}")
        if any(values):
            return _compared(reading, claim, states, seed, "not identical in exact numbers")
    return Check(claim.what, True, f"zero at {POINTS} random points of a prime field")


def _compared(reading: _Reading, claim: _Claim, states: int, seed: int, why: str) -> Check:
    """A claim in numbers."""
    worst = _worst(reading, claim.shown, claim.other, states, seed)
    figure = f"{why}; largest relative difference {worst:.1e} at {_counted(states)}"
    return Check(claim.what, worst < TOLERANCE, figure)


def _worst(reading: _Reading, one: Sequence[int], other: Sequence[int], states: int, seed: int) -> float:
    """The largest relative difference of two lists of nodes at random states."""
    program, worst = _sides(reading, one, other), 0.0
    for state in random_states(reading.model, reading.forward, states, seed):
        got = {k: np.array(x, float) for k, x in evaluated(program, reading.held(state)).items()}
        size = got["other"] if np.any(got["other"]) else np.array(state["a"])
        worst = float(np.maximum(worst, relative(got["one"] - got["other"], got["one"], size)))
    return worst


def _sides(reading: _Reading, one: Sequence[int], other: Sequence[int]) -> Program:
    """Two lists of nodes as the outputs of a program."""
    outputs = {k: Output(tuple(x), (len(x),)) for k, x in (("one", one), ("other", other))}
    inputs = {**reading.forward.inputs, "a": tuple(v.rate for v in reading.model.velocities)}
    if reading.lam:
        inputs["lambda"] = tuple(reading.derivation.multipliers)
    return Program("lines", reading.graph, inputs, outputs)


def _on_rows(reading: _Reading, states: int, seed: int) -> Check:
    """The rates of the rows, at states that satisfy the rows."""
    claim, onto, found, worst = reading.row_rates(), OnRows(reading.model), 0, 0.0
    program = _sides(reading, claim.shown, claim.other)
    for drawn in random_states(reading.model, reading.forward, states, seed):
        if (state := onto.of(drawn)) is None:
            continue
        found += 1
        got = {k: np.array(x, float) for k, x in evaluated(program, reading.held(state)).items()}
        off, size = np.abs(got["one"] - got["other"]).max(), np.abs(got["other"]).max()
        worst = float(np.maximum(worst, off / max(1.0, float(size))))
    if not found:
        why = "not checked: no random position could be moved to where it satisfies the constraints"
        return Check(claim.what, None, why)
    return Check(claim.what, worst < TOLERANCE, f"largest relative difference {worst:.1e} at {_counted(found)}")


def _counted(states: int) -> str:
    return f"{states} random state{'s' if states != 1 else ''}"


def _in_numbers(reading: _Reading, states: int, seed: int) -> Check:
    """The equations as shown against virtual work, in numbers."""
    work = reading.pushed(reading.mechanics.inverse(reading.a, reading.slips))
    worst = _worst(reading, reading.rows(), work, states, seed)
    return Check(
        text("the equations agree with virtual work, a route without energies"),
        worst < TOLERANCE,
        f"largest relative difference {worst:.1e} at {_counted(states)}",
    )
