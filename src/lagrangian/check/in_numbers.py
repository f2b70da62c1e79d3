"""Answers for systems whose equations are too long to be written in the coordinates, or that float: judged in numbers.

The lines of an answer are put beside the mechanics of the system, in one graph. At random states, with random values of
the parameters and the accelerations that are compiled, an equation of motion is zero, and its slopes by the
accelerations are a row of M if it is Lagrange's own. Energies, forces and momenta are compared with those of the
system. What is wrong is found so; which mistake explains it is not sought.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownVariableType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any, cast

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from sympy.core.function import AppliedUndef

from lagrangian import dynamics
from lagrangian.check.constraints.answer_on_rows import AnswerAt
from lagrangian.check.constraints.constrained import Compared, verdict_at_states
from lagrangian.check.coordinates.chart import OF_COORDINATES
from lagrangian.check.reading import generalized_force
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict
from lagrangian.derive import Derived
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, Output, Program, from_sympy, gradient, vjp
from lagrangian.model import Model, time
from lagrangian.page.formula import text
from lagrangian.records import dataclass, field
from lagrangian.verify.on_rows import Groups, OnRows
from lagrangian.verify.states import evaluated

EQUAL = 1e-9
"""The difference, in parts of the size of a quantity, that is rounding."""

PLACES = 6
"""The number of states at which a quantity is compared."""

SPREAD = 0.05
"""How far parameters are drawn from their values, in parts of them, where loops close only near these."""

DRAWS = 40
"""Random states that are drawn for each that is asked for."""

CONSTANT = ("V", "L")
"""Quantities in which a constant does not matter."""


def check_in_numbers(derivation: Derived, lines: Sequence[AnsweredLine], *, hint: int) -> Verdict:
    """Return what is right and what is wrong in an answer, by its values at random states.

    ``derivation`` is a structured one; an answer may use its names. Answers are compared in the system's own
    coordinates and speeds.
    """
    truth = _Truth(derivation)
    written = [truth.written(line, lines) for line in lines]
    compared = Compared(derivation, truth.names, truth.known, truth.answer, truth.judge, truth.holding)
    verdict = verdict_at_states(compared, written, hint, given=False)
    used = {x for line in written for x in line.expr.free_symbols}
    if not verdict.right and verdict.status is not Status.INCOMPLETE and not used & set(derivation.model.values):
        second = verdict_at_states(compared, written, hint, given=True)  # values in the place of parameters
        verdict = second if second.right else verdict
    if verdict.right or verdict.status is Status.INCOMPLETE:
        return verdict
    return Verdict(verdict.status, verdict.findings, notes=(*verdict.notes, text(*NOT_SOUGHT)), hint=hint)


NOT_SOUGHT = (
    "The equations of this system are compared by numbers, in its own coordinates: which lines are wrong is told, and "
    "not which mistake explains them.",
)


class _Truth:
    """A system and the names that its answers may contain."""

    def __init__(self, derivation: Derived) -> None:
        self.derivation, self.model = derivation, derivation.model
        model = self.model
        rates: dict[sp.Expr, Any] = {c.rate: c for c in model.coordinates}
        self.names = [rates[v.symbol].name if v.symbol in rates else v.name for v in model.velocities]
        self.meanings: dict[sp.Basic, sp.Expr] = {d.symbol: d.expression for d in derivation.definitions}
        moving = (*model.coordinates, *model.velocities, *model.inputs, *model.parameters)
        self.known: set[sp.Basic] = {time, *(x.symbol for x in moving), *self.meanings}
        multipliers: set[sp.Basic] = {row.symbol for row in derivation.multipliers.values()}
        self.holding: dict[sp.Basic, set[sp.Basic]] = {}
        for symbol, meaning in self.meanings.items():
            inside = meaning.atoms(AppliedUndef) & multipliers
            held = inside.union(*(self.holding.get(s, set()) for s in meaning.free_symbols))
            if held:
                self.holding[symbol] = held

    def written(self, line: AnsweredLine, lines: Sequence[AnsweredLine]) -> AnsweredLine:
        """A line with the model's definitions and every Ξ that is only named written out."""
        given = {other.name: other.expr for other in lines if other.kind == "Xi"}
        names: dict[str, sp.Expr] = {d.symbol.name: d.symbol for d in self.derivation.definitions}
        table: dict[Any, sp.Expr] = {}
        for name, own in zip(self.names, self.derivation.Xi.values(), strict=True):
            table[generalized_force(name)] = given.get(name, own)
        for symbol in line.expr.free_symbols - self.known:
            if (name := getattr(symbol, "name", "")) in names:
                table[symbol] = names[name]
        expr = self.model.expand(cast("sp.Expr", line.expr.xreplace(table)), constants=True)
        return replace(line, expr=expr)

    def answer(self, lines: Sequence[AnsweredLine], unknown: Sequence[sp.Basic]) -> _AnswerInNumbers:
        """The equations of an answer at random states."""
        return _AnswerInNumbers(self, [line.expr for line in lines], unknown)

    def judge(self, lines: Sequence[AnsweredLine], k: int) -> Finding | None:
        """The finding for a line that states an energy, a force or a momentum; None for a coordinate that is not the
        system's."""
        line = lines[k]
        graphed = _Graphed(self, [line.expr], ())
        right = graphed.quantity(line)
        if right is None and line.kind in OF_COORDINATES and line.name not in self.names:
            return None
        if right is None:
            note = text("not compared: in a system of this size only equations, energies, momenta and forces are")
            return Finding(line, Status.INCOMPLETE, note, line.name)
        if graphed.strange:
            return Finding(line, Status.WRONG, text("it holds a name that the system does not have"), line.name)
        outputs = {"mine": Output((graphed.lines[0],), ()), "right": Output((right,), ())}
        program = Program("line", graphed.graph, graphed.inputs_of, outputs)
        found: list[tuple[float, float]] = []
        for state in _states(self.model, PLACES, still=line.kind in CONSTANT):
            got = evaluated(program, state)
            found.append((float(got["mine"]), float(got["right"])))
        off = np.array([mine - theirs for mine, theirs in found])
        if line.kind in CONSTANT and len(off):
            off = off - off[0]
        size = max((max(abs(x), abs(y)) for x, y in found), default=1.0)
        right_too = bool(len(off)) and float(np.abs(off).max()) <= EQUAL * max(size, 1.0)
        return Finding(line, Status.RIGHT if right_too else Status.WRONG, None, line.name)


@dataclass(frozen=True, eq=False)
class _Graphed:
    """The lines of an answer as nodes beside the mechanics of the system."""

    truth: _Truth
    exprs: Sequence[sp.Expr]
    unknown: Sequence[sp.Basic]
    graph: Graph = field(default_factory=Graph)

    @cached_property
    def inputs(self) -> dynamics.Inputs:
        """The nodes of q, v, u, p and t."""
        return dynamics.Inputs.of(self.graph, self.truth.model)

    @cached_property
    def a(self) -> list[int]:
        """The accelerations."""
        return [self.graph.input("a", i) for i in range(len(self.inputs.v))]

    @cached_property
    def own(self) -> list[int]:
        """The answer's own multipliers."""
        return [self.graph.input("s", i) for i in range(len(self.unknown))]

    @cached_property
    def mechanics(self) -> Any:
        """The system."""
        return dynamics.describe(self.truth.model, self.graph, self.inputs)

    @cached_property
    def lines(self) -> list[int]:
        """The values of the lines."""
        model, inputs = self.truth.model, self.inputs
        table: dict[sp.Basic, int] = {time: inputs.t}
        for c, q, rate in zip(model.coordinates, inputs.q, self.mechanics.motion.rates, strict=True):
            table[c.symbol], table[c.rate] = q, rate
        for v, node, vdot in zip(model.velocities, inputs.v, self.a, strict=True):
            table[v.symbol], table[cast("sp.Expr", sp.Derivative(v.symbol, time))] = node, vdot
        table |= dict(zip((u.symbol for u in model.inputs), inputs.u, strict=True))
        table |= dict(zip((p.symbol for p in model.parameters), inputs.p, strict=True))
        table |= dict(zip(self.unknown, self.own, strict=True))
        known = set(self.truth.meanings)
        needed = {s for e in self.exprs for s in e.free_symbols & known}
        for symbol, meaning in reversed(self.truth.meanings.items()):
            if symbol in needed:
                needed |= meaning.free_symbols & known
        for symbol, meaning in self.truth.meanings.items():
            if symbol in needed:
                table[symbol] = from_sympy(self.graph, meaning, table)
        for s in self.strange:
            table[s] = self.graph.input("strange", len(table))
        return [from_sympy(self.graph, e, table) for e in self.exprs]

    @cached_property
    def strange(self) -> set[sp.Basic]:
        """Names that neither the system nor its derivation has."""
        return {s for e in self.exprs for s in e.free_symbols} - self.truth.known - set(self.unknown)

    @cached_property
    def inputs_of(self) -> Mapping[str, tuple[str, ...]]:
        """The inputs of a program of these nodes."""
        names = dynamics.forward(self.truth.model).inputs
        own = {"s": tuple(map(str, self.unknown))} if self.unknown else {}
        return {**names, "a": tuple(v.rate for v in self.truth.model.velocities), **own}

    def quantity(self, line: AnsweredLine) -> int | None:
        """The node of the system's own quantity that a line states; None if a line states something else."""
        m, g, names = self.mechanics, self.graph, self.truth.names
        i = names.index(line.name) if line.name in names else -1
        _ = self.lines
        if line.kind in ("T", "V", "L"):
            T, V = m.kinetic(), m.potential()
            return {"T": T, "V": V, "L": g.sub(T, V)}[line.kind]
        if i < 0 or line.kind not in ("Xi", "p", "p-rate", "slope"):
            return None
        if line.kind == "Xi":
            return m.gathered(m.efforts)[i]
        if line.kind == "slope":
            L = g.sub(m.kinetic(), m.potential())
            return m.motion.along_velocities(gradient(g, L, self.inputs.q))[i]
        momenta = gradient(g, m.kinetic(), self.inputs.v)
        return momenta[i] if line.kind == "p" else m.motion.second_rate([momenta[i]], self.a)[0]


class _AnswerInNumbers:
    """The equations of an answer, ready to be evaluated with the true accelerations."""

    def __init__(self, truth: _Truth, exprs: Sequence[sp.Expr], unknown: Sequence[sp.Basic]) -> None:
        self.truth, self.unknown, self.model = truth, list(unknown), truth.model
        made = _Graphed(truth, exprs, unknown)
        g, by = made.graph, [*made.a, *made.own]
        slopes = [x for line in made.lines for x in vjp(g, [line], [g.one], by)]
        outputs = {k: Output(tuple(x), (len(x),)) for k, x in (("value", made.lines), ("slopes", slopes))}
        self.program = Program("answer", g, made.inputs_of, outputs)
        self.width, self.n, self.count = len(by), len(made.a), len(made.lines)
        model, bound = self.model, bool(self.model.constraints)
        self.forward, self.mass = dynamics.forward(model), dynamics.mass_matrix(model)
        self.onto = OnRows(model) if bound else None
        self.multipliers = dynamics.multipliers(model) if bound else None

    def states(self, count: int, *, given: bool) -> Iterator[Groups]:
        """Up to ``count`` random states; with ``given`` the parameters keep their values.

        Where no loop closes with random lengths, parameters are drawn near their values.
        """
        found = 0
        for spread in (0.0,) if given else (None, SPREAD):
            for drawn in _states(self.model, DRAWS * count if self.onto else count, spread=spread):
                if (state := self.onto_rows(drawn)) is not None:
                    found += 1
                    yield state
                    if found == count:
                        return
            if found:
                return

    def at(self, here: Groups) -> AnswerAt:
        """The answer at one state with the true accelerations."""
        n = self.n
        state: Groups = {**here, "a": [float(x) for x in evaluated(self.forward, here)["a"]]}
        own = [0.0] * len(self.unknown)
        found = evaluated(self.program, {**state, "s": own})
        slopes = np.array(found["slopes"], float).reshape(self.count, self.width)
        size = np.abs(slopes) @ (1.0 + np.abs(np.array([*state["a"], *own])))
        for shift in (0.1, -0.2):
            off = {k: [x + shift * (i + 1) for i, x in enumerate(state[k])] for k in ("q", "v", "u")}
            size = np.maximum(size, np.abs(np.array(evaluated(self.program, {**state, **off, "s": own})["value"])))
        M = np.array(evaluated(self.mass, state)["M"], float).reshape(n, n)
        A, lam = np.zeros((0, n)), np.zeros(0)
        if self.onto is not None and self.multipliers is not None:
            A = np.array(evaluated(self.onto.matrix, state)["A"], float).reshape(-1, n)
            lam = np.array(evaluated(self.multipliers, state)["lam"], float)
        value, none = np.array(found["value"], float), np.zeros((n, 0))
        return AnswerAt(value, slopes[:, :n], slopes[:, n:], size, A, M, none.T @ M @ none, none, lam)

    def motions(self, here: Groups, count: int) -> Iterator[AnswerAt]:
        """The answer at other rates and inputs in the same position."""
        source = np.random.default_rng(7)
        for _ in range(count):
            other = dict(here)
            for group in ("v", "u"):
                other[group] = source.uniform(-1.5, 1.5, len(here[group])).tolist()
            if (state := self.onto_rows(other)) is not None:
                yield self.at(state)

    def heavier(self, here: Groups, count: int) -> Iterator[AnswerAt]:
        """None: the numbers of the program are those of the parameters."""
        yield from ()

    def onto_rows(self, here: Groups) -> Groups | None:
        """The state moved onto the constraints, with unit quaternions; None where there is none."""
        state = here if self.onto is None else self.onto.of(here)
        return state if state is None else {**state, "q": _of_unit_length(self.model, np.array(state["q"])).tolist()}


def _of_unit_length(model: Model, q: NDArray[np.float64]) -> NDArray[np.float64]:
    """The position q with quaternions of length 1: R of one of another length is the same, as long as it is divided by
    the square of its length, which an answer need not do."""
    places, q = {c.name: k for k, c in enumerate(model.coordinates)}, q.copy()
    for frame in model.floating:
        if frame.floating is not None:
            turned = [places[c.name] for c in frame.floating.orientation]
            q[turned] /= np.linalg.norm(q[turned])
    return q


def _states(model: Model, count: int, *, spread: float | None = None, still: bool = False) -> Iterator[Groups]:
    """Random states with finite accelerations; parameters are drawn, too, and keep their first values if ``still``.

    With a ``spread`` those that have a value are drawn near it: all different, though their values may be equal.
    """
    forward, source, found = dynamics.forward(model), np.random.default_rng(11), 0
    quaternions = {c.name for f in model.floating if f.floating is not None for c in f.floating.orientation}
    turned = [c.name in quaternions for c in model.coordinates]
    positive = np.array([c.positive for c in model.coordinates])
    p, t = [0.0], 0.0
    for _ in range(DRAWS + count):
        if not (still and found):
            drawn = source.uniform(0.4, 1.6, len(model.parameters))
            values = [None if spread is None else x.value for x in model.parameters]
            near = 1.0 + (spread or 0.0) * (drawn - 1.0)
            p = [float(x if v is None else v * f) for x, v, f in zip(drawn, values, near, strict=True)]
            t = float(source.uniform(0.1, 0.9))
        q = source.uniform(-1.2, 1.2, len(model.coordinates))
        q = np.where(turned, source.normal(size=len(q)), np.where(positive, np.abs(q) + 0.2, q))
        q = _of_unit_length(model, q)
        n = len(model.velocities)
        v, a, u = (source.uniform(-1.0, 1.0, k).tolist() for k in (n, n, len(model.inputs)))
        state: Groups = {"q": q.tolist(), "v": v, "a": a, "u": u, "p": p, "t": [t]}
        try:
            fine = bool(np.isfinite(evaluated(forward, state)["a"]).all())
        except (ZeroDivisionError, ValueError, OverflowError):
            fine = False
        if fine:
            found += 1
            yield state
            if found == count:
                return
    if not found:
        raise ModelError(
            f"there are no finite accelerations of '{model.name}' at any of {DRAWS} random states",
            fix="check square roots, logarithms and divisions for arguments that are never allowed",
            code="E503",
        )
