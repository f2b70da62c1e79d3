"""Compares systems with constraints by their motions, at random states that the constraints allow.

Rows with multipliers are not sums of rows of other coordinates, and two systems may have different numbers of them. So
with ξ = φ(η), states of one system are taken that satisfy its rows, and with q = φ, v = φ̇ the other system must

    satisfy its rows there,    have the same ways to move,    and have the accelerations q̈ = d²φ/dt² along the motion.

Then both have the same motions near these states. Where velocities are not rates of coordinates, q̇ = N(q) v is solved
for them. Systems whose equations are too long to be compared row by row are compared in the same way.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.assembly.assemble import consistent
from lagrangian.coordinates import Change
from lagrangian.dynamics.describe import described
from lagrangian.errors import ModelError, RunError
from lagrangian.graph import Graph, Output, Program, evaluate
from lagrangian.model import Model
from lagrangian.model.without_friction import check_no_friction
from lagrangian.page.formula import Check, Name, Text, text
from lagrangian.records import dataclass

Array = NDArray[np.float64]
State = tuple[Array, Array, Array, float]
"""q, v, u and t."""

STATES, TRIES = 4, 40
"""The number of states at which motions are compared, and of attempts to find them."""

EQUAL = 1e-8
"""What differs by at most this part of its size is equal: rounding of an assembly, times a moderate factor."""

NOTHING, SOMETHING = 1e-9, 1e-4
"""A singular value of the rows below the first part of the largest is 0, above the second not; else the state is not
used."""


@dataclass(frozen=True)
class MotionChecks:
    """What was found: the checks, and whether the motions are the same."""

    checks: tuple[Check, ...]
    same: bool
    first: str


def compared_motions(source: Model, into: Model, change: Change, tags: tuple[str, str]) -> MotionChecks:
    """Compare the motions of two models, where ``change`` has the coordinates of ``source`` in those of ``into``.

    ``tags`` are the letters of the two systems.

    Raises `ModelError` if no states are found that satisfy the constraints, or for friction.
    """
    for model in (source, into):
        check_no_friction(model, "motions are compared by their accelerations")
    into = _with_parameters_of(into, source)
    own = {p.name: _value(p.name, p.value) for p in (*into.parameters, *source.parameters)}
    ours, theirs = _Side.of(source, own), _Side.of(into, own)
    path = _along(into, source, change)
    bending = _bending(source)
    gaps, ways, seen, rates = _Worst(), set[tuple[int, int]](), set[bool](), _Worst()
    worst = ""
    for q, v, u, t in _allowed_states(theirs):
        found = theirs.at(path, (q, v, u, t))
        place, rate, bend = (np.array(found[kind], float) for kind in ("value", "rate", "bend"))
        driven = dict(zip((i.name for i in into.inputs), u, strict=True))
        inputs = np.array([driven.get(i.name, 0.7) for i in source.inputs])
        speeds = ours.speeds(place, rate, t)
        here = (place, speeds, inputs, t)
        gaps.add(*ours.off(here))
        ways.add((theirs.freedoms((q, v, u, t)), ours.freedoms(here)))
        seen.add(_ways_seen(theirs, path, (q, v, u, t)))
        acceleration = np.array(ours.at(bending, here)["a"], float)
        size = 1.0 + float(np.abs(bend).max(initial=0.0))
        k = int(np.argmax(np.abs(acceleration - bend)))
        if rates.add(float(np.abs(acceleration - bend)[k]), size):
            worst = f"{source.coordinates[k].name}'' is {acceleration[k]:.6g} instead of {bend[k]:.6g}"
    bound = ours.rows is not None or theirs.rows is not None
    return _judged(gaps, ways if all(seen) else ways | {(-1, 0)}, rates, worst, tags, bound=bound)


def _ways_seen(side: _Side, path: Program, state: State) -> bool:
    """Whether different velocities that the rows allow are different rates of the other system's coordinates."""
    q, v, u, t = state

    def rates(v: Array) -> Array:
        return np.array(side.at(path, (q, v, u, t))["rate"], float)

    free, still = side.directions(state), rates(0 * v)
    images = np.array([rates(e) - still for e in free]).reshape(len(free), len(still))
    return len(free) == int(np.linalg.matrix_rank(images, tol=SOMETHING)) if len(free) else True


def _judged(
    gaps: _Worst,
    ways: set[tuple[int, int]],
    rates: _Worst,
    worst: str,
    tags: tuple[str, str],
    *,
    bound: bool,
) -> MotionChecks:
    ours, theirs = (f"({tag})" for tag in tags)
    where = f"at {rates.count} random states{' that the constraints allow' if bound else ''}"
    free = all(a == b for a, b in ways)
    counts = ", ".join(sorted(f"{b} in {ours}, {a} in {theirs}" for a, b in ways if a >= 0))
    held = text(f"the constraints of {ours} hold where those of {theirs} do")
    checks = (
        *([Check(held, gaps.holds, f"{gaps.most:.0e} {where}")] if bound else []),
        Check(text("both can move in the same ways"), free, counts),
        Check(text("the accelerations are the same"), rates.holds, f"{rates.most:.0e} {where}"),
    )
    first = ""
    if not gaps.holds:
        first = f"the constraints of {ours} do not hold where those of {theirs} do"
    elif not free:
        first = f"they do not move in the same ways ({counts})"
    elif not rates.holds:
        first = f"along a motion of {theirs}, {worst} in {ours}"
    return MotionChecks(checks, not first, first)


@dataclass
class _Worst:
    """The largest error so far, relative to its size."""

    most: float = 0.0
    count: int = 0

    def add(self, error: float, size: float) -> bool:
        """Take an error into account; return whether it is the largest."""
        self.count += 1
        share = error / size if np.isfinite(error) else np.inf
        larger = share > self.most
        self.most = max(self.most, share)
        return larger

    @property
    def holds(self) -> bool:
        """Whether all are rounding."""
        return self.most <= EQUAL


@dataclass(frozen=True)
class _Side:
    """One system: its parameters and programs."""

    model: Model
    p: list[float]
    forward: Program
    rows: Program | None
    matrix: Program | None
    rates: Program

    @classmethod
    def of(cls, model: Model, values: Mapping[str, float]) -> _Side:
        """The programs of a model."""
        bound = bool(model.constraints)
        rows = dynamics.residual(model) if bound else None
        matrix = dynamics.constraint_matrix(model) if bound else None
        return cls(
            model,
            [values[p.name] for p in model.parameters],
            dynamics.forward(model),
            rows,
            matrix,
            dynamics.rates(model),
        )

    def at(self, program: Program, state: State) -> dict[str, Any]:
        """The outputs of a program."""
        q, v, u, t = state
        groups = {"q": q.tolist(), "v": v.tolist(), "u": u.tolist(), "p": self.p, "t": [t]}
        return evaluate(program, {group: groups[group] for group in program.inputs})

    def speeds(self, q: Array, rates: Array, t: float) -> Array:
        """The velocities v of rates q̇ = N(q) v."""
        if not self.model.floating:
            return rates
        none = np.zeros(len(self.model.inputs))
        columns = [self.at(self.rates, (q, e, none, t))["qdot"] for e in np.eye(len(self.model.velocities))]
        return np.asarray(np.linalg.lstsq(np.array(columns, float).T, rates, rcond=None)[0], float)

    def off(self, state: State) -> tuple[float, float]:
        """The largest residual of a row, and the size that it is compared with."""
        if self.rows is None:
            return 0.0, 1.0
        found = self.at(self.rows, state)
        largest = max((abs(float(x)) for name in ("f", "Av") for x in found[name]), default=0.0)
        return largest, 1.0 + float(np.abs(np.concatenate(state[:2])).max(initial=0.0))

    def freedoms(self, state: State) -> int:
        """The number of velocities less the number of independent rows; −1 in doubt."""
        n = len(self.model.velocities)
        sizes = np.linalg.svd(self._rows(state), compute_uv=False)
        some, all_ = (int((sizes > x * sizes.max(initial=0.0)).sum()) for x in (SOMETHING, NOTHING))
        return n - some if some == all_ else -1

    def directions(self, state: State) -> Array:
        """A basis of the velocities that the rows allow, in rows."""
        _, sizes, right = np.linalg.svd(self._rows(state))
        return right[int((sizes > SOMETHING * sizes.max(initial=0.0)).sum()) :]

    def _rows(self, state: State) -> Array:
        """A with rows of the size 1."""
        n = len(self.model.velocities)
        if self.matrix is None:
            return np.zeros((0, n))
        A = np.array(self.at(self.matrix, state)["A"], float).reshape(-1, n)
        size = np.abs(A).max(axis=1, initial=0.0, keepdims=True)
        return A / np.where(size > 0, size, 1.0)


def _allowed_states(side: _Side) -> Iterator[State]:
    """Random states that satisfy the rows, where their rank is clear."""
    model, source, found = side.model, np.random.default_rng(3), 0
    for _ in range(TRIES):
        n = len(model.coordinates)
        q = source.uniform(0.2, 1.2, n) * source.choice([-1, 1], n)
        v = source.uniform(-1.0, 1.0, len(model.velocities))
        q = np.where([c.positive for c in model.coordinates], np.abs(q), q)
        u, t = source.uniform(0.3, 1.2, len(model.inputs)), float(source.uniform(0.1, 0.9))
        try:
            if model.constraints:
                q, v = consistent(model, q, v, np.array(side.p), t)
            state = (q, v, u, t)
            if side.freedoms(state) < 0:
                continue
        except RunError:  # it does not close from there
            continue
        yield state
        found += 1
        if found == STATES:
            return
    if not found:
        raise ModelError(
            f"no state of '{model.name}' was found that satisfies its constraints with these parameters",
            fix="look at the lengths, or compare runs of both",
            code="E304",
        )


def _along(into: Model, source: Model, change: Change) -> Program:
    """q, v, u, p, t of ``into`` → the coordinates of ``source``, their rates and accelerations along its motion."""
    g = Graph()
    inputs = dynamics.Inputs.of(g, into)
    m, d = described(into, g, inputs)
    value = [d.node(into.expand(change.table[c.symbol], constants=True)) for c in source.coordinates]
    rate = m.motion.rate(value)
    made = {"value": value, "rate": rate, "bend": m.motion.second_rate(rate, m.forward())}
    return _program(into, g, made)


def _bending(model: Model) -> Program:
    """q, v, u, p, t → the second rates of the coordinates along the motion."""
    g = Graph()
    inputs = dynamics.Inputs.of(g, model)
    m = dynamics.describe(model, g, inputs)
    return _program(model, g, {"a": m.motion.second_rate(list(m.motion.rates), m.forward())})


def _program(model: Model, g: Graph, made: Mapping[str, list[int]]) -> Program:
    outputs = {name: Output(tuple(ids), (len(ids),)) for name, ids in made.items()}
    return Program("motions", g, dynamics.forward(model).inputs, outputs)


def _with_parameters_of(model: Model, other: Model) -> Model:
    """The model with the parameters of another besides, which a change of coordinates may contain."""
    own = {p.name for p in model.parameters}
    more = tuple(p for p in other.parameters if p.name not in own)
    return replace(model, parameters=(*model.parameters, *more), _memo={}) if more else model


def _value(name: str, value: float | None) -> float:
    """A parameter's value; one that is not given gets a number that depends on its name."""
    return value if value is not None else 0.6 + (sum(map(ord, name)) % 17) / 20


def motion_words(same: bool, first: str, *, bound: bool) -> Text:
    """The verdict in words; ``bound``: one of the systems has constraints."""
    if same and not bound:
        return text("(A) and (B) describe the same motion: the accelerations are the same at random states.")
    if same:
        return text(
            "(A) and (B) describe the same motion: where the constraints of one hold, those of the other hold, and the "
            "accelerations are the same. Multipliers are not compared."
        )
    return text(f"(A) and (B) do not describe the same motion: {first}.")


def comparison_method(source: str, into: str, *, bound: bool) -> Text:
    """How systems with multipliers, or with equations in named quantities, are compared, in words."""
    what, which = ("multipliers", " that its constraints allow") if bound else ("named quantities", "")
    return text(
        f"Equations with {what} are not compared row by row. States of ({into}){which} are put into ({source}), and ",
        Name("q vector", "", 2),
        f" of ({source}) must be what follows from the motion of ({into}), with the values of the parameters that are "
        "given.",
    )
