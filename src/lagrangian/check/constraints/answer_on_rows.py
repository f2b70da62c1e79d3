"""Evaluates the equations of an answer at states that satisfy a system's constraints, with the true accelerations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import TypeAlias

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import bounded, dynamics
from lagrangian.check.constraints.pressed import directions
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive import Derived
from lagrangian.derive.sample import Sampler
from lagrangian.errors import ModelError
from lagrangian.graph import Program
from lagrangian.model.rows import rows_of
from lagrangian.records import dataclass
from lagrangian.verify.on_rows import Groups, OnRows, State
from lagrangian.verify.states import evaluated, state_groups

Array: TypeAlias = NDArray[np.float64]

ROUNDING = 1e-6
"""The least size of an equation, in those of its terms: one that says 0 = 0 is no other than rounding everywhere."""


CANCELLED = 1e-13
"""The slope by a multiplier or an acceleration, in the terms of its line, that is rounding: it cancels there."""


@dataclass(frozen=True, eq=False)
class AnswerAt:
    """An answer at one state: P and its slopes by accelerations and by its own multipliers, beside the right ones."""

    value: Array
    by_acceleration: Array
    by_multiplier: Array
    size: Array
    rows: Array
    mass: Array
    reduced: Array
    along: Array
    multipliers: Array


@lru_cache(maxsize=32)
def _programs(derivation: Derived) -> tuple[OnRows, tuple[Program, ...]]:
    model = derivation.model
    made = (
        dynamics.forward(model),
        dynamics.constraint_matrix(model),
        dynamics.mass_matrix(model),
        dynamics.multipliers(model),
    )
    return OnRows(model), made


class AnswerOnRows:
    """The equations of an answer, ready to be evaluated at states that satisfy the constraints."""

    def __init__(self, truth: Reference, lines: Sequence[AnsweredLine], unknown: Sequence[sp.Basic]) -> None:
        d = truth.derivation
        self.truth, self.unknown, self.count = truth, list(unknown), len(lines)
        self.letters = set[sp.Basic]().union(*(bounded.letters(line.expr) for line in lines))
        self.on_rows, self.programs = _programs(d)
        wanted: list[sp.Expr] = [line.expr for line in lines]
        wanted += [sp.Add(*[sp.Abs(x, evaluate=False) for x in sp.Add.make_args(line.expr)]) for line in lines]
        self.along: list[sp.Expr] = list(d.minimal.S.flat()) if d.minimal is not None else []
        self.coordinates = truth.model.coordinates
        atoms = [x for c in self.coordinates for x in (c.symbol, c.rate, c.acceleration)]
        atoms += [x.symbol for x in (*truth.model.parameters, *truth.model.inputs)]
        self.skipped = len(atoms)
        self.sampler = Sampler(truth.model, [*atoms, *wanted, *self.along])

    def states(self, count: int, *, given: bool) -> Iterator[tuple[State, Groups]]:
        """Up to ``count`` random states on the rows; with ``given`` the parameters keep their values."""
        try:
            yield from self.on_rows.states(self.sampler, count, 1, given=given)
        except ModelError as error:
            if error.code != "E503":  # roots of the answer that are real at few states
                raise

    def _values(self, here: dict[sp.Basic, float], *, terms: bool = False) -> Array:
        """P, or the sums of the sizes of its terms."""
        first = self.skipped + self.count * terms
        return np.array(self.sampler.at(here)[first : first + self.count])

    def at(self, here: tuple[State, Groups]) -> AnswerAt:
        """The answer at one state with the true accelerations, which are put into it."""
        state, groups = here
        n, coordinates = self.truth.n, self.coordinates
        a, rows, mass, lam = (evaluated(program, groups) for program in self.programs)
        state.update({c.acceleration: float(x) for c, x in zip(coordinates, a["a"], strict=True)})
        state.update(directions(self.truth.model, lam["lam"]))
        changes = [*(c.acceleration for c in coordinates), *self.unknown]
        still = {**state, **dict.fromkeys(self.unknown, 0.0)}
        value = self._values(still)
        slopes = np.array([self._values({**still, x: still[x] + 1.0}) - value for x in changes]).T
        acting = self._values({**still, **dict.fromkeys(self.unknown, 1.0)}, terms=True)
        slopes[:, n:][np.abs(slopes[:, n:]) <= CANCELLED * acting[:, None]] = 0.0
        slopes[:, :n][np.abs(slopes[:, :n]) <= CANCELLED * self._values(still, terms=True)[:, None]] = 0.0
        size = np.abs(slopes) @ np.array([1.0 + abs(still[x]) for x in changes]) + np.abs(self._values(state))
        off = {x: still[x] + 0.1 * (k + 1) for k, x in enumerate(y for c in coordinates for y in (c.symbol, c.rate))}
        size = np.maximum(size, np.abs(self._values({**still, **off})))
        size = np.maximum(size, ROUNDING * self._values(state, terms=True))
        A, M = np.array(rows["A"], float).reshape(-1, n), np.array(mass["M"], float).reshape(n, n)
        S = self.sampler.at(state)[self.skipped + 2 * self.count :]
        along = np.array(S).reshape(n, -1) if self.along else np.zeros((n, 0))
        return AnswerAt(
            value, slopes[:, :n], slopes[:, n:], size, A, M, along.T @ M @ along, along, np.array(lam["lam"], float)
        )

    def motions(self, here: tuple[State, Groups], count: int) -> Iterator[AnswerAt]:
        """The answer at other rates and inputs in the same position."""
        source = np.random.default_rng(7)
        moving = [*(c.rate for c in self.coordinates), *(u.symbol for u in self.truth.model.inputs)]
        for _ in range(count):
            if (found := self.changed(here[0], {x: float(source.uniform(-1.5, 1.5)) for x in moving})) is not None:
                yield found

    def heavier(self, here: tuple[State, Groups], count: int) -> Iterator[AnswerAt]:
        """The same with other values of the masses and moments of inertia that its lines have in letters, if any."""
        masses = [p for p in inertias(self.truth) if p in self.letters]
        if masses:
            other = {**here[0], **{p: here[0][p] * (1.3 + 0.4 * k) for k, p in enumerate(masses)}}
            yield from self.motions((other, here[1]), count)

    def changed(self, state: State, values: Mapping[sp.Basic, float]) -> AnswerAt | None:
        """The answer with other values of some letters, rates or inputs; None where no state on the rows is near."""
        other = {**state, **values}
        groups = self.on_rows.of(state_groups(self.truth.model, other))
        if groups is None:
            return None
        other.update({c.symbol: x for c, x in zip(self.coordinates, groups["q"], strict=True)})
        other.update({c.rate: x for c, x in zip(self.coordinates, groups["v"], strict=True)})
        return self.at((other, groups))


@lru_cache(maxsize=32)
def inertias(truth: Reference) -> tuple[sp.Symbol, ...]:
    """The parameters in which the kinetic co-energy is linear, as in masses, and that no constraint holds."""
    model = truth.model
    held = set[sp.Basic]().union(*(bounded.letters(row.rate) for row in rows_of(model)))
    moving = bounded.letters(truth.T) - held
    return tuple(
        p.symbol for p in model.parameters if p.symbol in moving and not bounded.diff(truth.T, p.symbol).has(p.symbol)
    )
