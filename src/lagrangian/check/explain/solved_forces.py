"""Lines that are linear in forces of the answer's own, and the forces with which they hold along the right motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.eliminated import slope_of, unknown_in
from lagrangian.check.reference import Reference
from lagrangian.check.rows import small
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.records import dataclass

MOST_LINES, MOST_FORCES = 12, 6
"""The most lines, and the most forces in them, that are compared."""
RANKED = 8
"""At how many states lines are compared with those above them."""
NEAR = 1e-8
"""The relative size of what is rounding."""


@dataclass(frozen=True, eq=False)
class Balances:
    """Lines A u + b = 0 with forces u, and their values along the right motion: A (S, k, m), b (S, k)."""

    lines: tuple[AnsweredLine, ...]
    forces: tuple[sp.Basic, ...]
    A: Array
    b: Array

    def solved(self, rows: Sequence[int]) -> Array | None:
        """The forces (S, m) with which some of the lines hold; None if there are none."""
        A, b = self.A[:, rows], self.b[:, rows]
        u = -(np.linalg.pinv(A) @ b[:, :, None])[:, :, 0]
        scale = (np.abs(A) * np.abs(u[:, None, :])).sum(axis=2) + np.abs(b)
        left = np.abs((A @ u[:, :, None])[:, :, 0] + b)
        return u if (left <= NEAR * np.maximum(scale, 1e-300)).all() else None

    def forces_without(self, k: int) -> dict[sp.Basic, Array] | None:
        """The forces that the lines without one determine; None if one of its own is not among these."""
        rows = [i for i in range(len(self.lines)) if i != k]
        if (u := self.solved(rows)) is None:
            return None
        found: dict[sp.Basic, Array] = {}
        for j, force in enumerate(self.forces):
            alone = np.zeros((len(self.A), 1, len(self.forces)))
            alone[:, 0, j] = 1
            both = np.linalg.matrix_rank(np.concatenate([self.A[:, rows], alone], axis=1))
            if (both == np.linalg.matrix_rank(self.A[:, rows])).all():
                found[force] = u[:, j]
            elif self.A[:, k, j].any():
                return None
        return found

    def compared(self, rows: Sequence[int]) -> bool:
        """Whether each of some lines is compared with the rest: the others determine all forces, too."""
        whole = self.rank(range(len(self.lines)))
        return all(self.rank([i for i in rows if i != j]) == whole for j in rows)

    def rank(self, rows: Sequence[int]) -> int:
        """How many forces some of the lines determine, at most states."""
        return int(np.median(np.linalg.matrix_rank(self.A[:, rows]))) if rows else 0


def balances_of(truth: Reference, lines: Sequence[AnsweredLine], *, few: bool = False) -> Balances | None:
    """The lines of an answer with forces of its own; None if these are not linear, or too many or too few: as many
    lines as forces give these, but are not compared with each other."""
    forces = sorted(unknown_in(truth, lines), key=str)
    rows = tuple(x for x in lines if x.kind == "equation" and x.expr.has(*forces)) if forces else ()
    if not 0 < len(forces) <= MOST_FORCES or not len(forces) < len(rows) + few <= MOST_LINES:
        return None
    slopes: list[sp.Expr] = []
    for x in rows:
        own = [slope_of(x.expr, f) if x.expr.has(f) else sp.S.Zero for f in forces]
        if any(s is None or s.has(*forces) for s in own):
            return None
        slopes += [s for s in own if s is not None]
    without = dict.fromkeys(forces, np.zeros(truth.states.size))
    values = CompiledExpressions([*slopes, *(x.expr for x in rows)]).at(truth.states, truth.accelerations | without)
    if not np.isfinite(values).all():
        return None
    A = values[: len(slopes)].reshape(len(rows), len(forces), -1).transpose(2, 0, 1)
    return Balances(rows, tuple(forces), A, values[len(slopes) :].T)


def used_elsewhere(balances: Balances, said: sp.Expr | None) -> Balances:
    """The lines without those that only say what a force is which no other line has, a_r = s̈ + s φ̇²: nothing in the
    answer says whether it is that. What is ``said`` to be wrong may be that another line lacks it."""
    held: Array = np.any(balances.A, axis=0)
    rows, forces = (list(range(n)) for n in held.shape)
    known = {j for j in forces if said is not None and said.has(balances.forces[j])}
    while alone := [j for j in forces if j not in known and held[rows, j].sum() < 2]:
        rows = [k for k in rows if not held[k, alone].any()]
        forces = [j for j in forces if j not in alone]
    lines, names = tuple(balances.lines[k] for k in rows), tuple(balances.forces[j] for j in forces)
    return Balances(lines, names, balances.A[:, rows][:, :, forces], balances.b[:, rows])


def left_out(balances: Balances) -> list[int]:
    """The places of the lines without which all others hold; none if all hold together."""
    every = list(range(len(balances.lines)))
    if balances.solved(every) is not None:
        return []
    return [k for k in every if balances.solved([i for i in every if i != k]) is not None]


def is_true(
    truth: Reference, line: AnsweredLine, values: Mapping[sp.Basic, Array], excess: Array | None = None
) -> bool:
    """Whether a line, without an ``excess``, holds along the right motion."""
    compiled = CompiledExpressions([line.expr])
    found = compiled.at(truth.states, values)[0]
    return small(found - (0 if excess is None else excess), float(np.abs(compiled.at(truth.states)[0]).max()))


def hold(
    truth: Reference, rows: Sequence[AnsweredLine], forces: Sequence[sp.Basic], below: Sequence[AnsweredLine]
) -> list[bool]:
    """Whether each of some lines holds for the motion that the balances give, the wrong one as it is."""
    none = [False] * len(below)
    wanted, k = [*(c.acceleration for c in truth.model.coordinates), *forces], len(rows)
    if (found := _affine(truth, [x.expr for x in (*rows, *below)], wanted)) is None:
        return none
    A, b = found
    used = list(range(k))
    for i, x in enumerate(below, k):  # what the balances do not say: the equation of a body without these forces
        if np.linalg.matrix_rank(A[0, [*used, i]]) > np.linalg.matrix_rank(A[0, used]) and is_true(
            truth, x, truth.accelerations
        ):
            used.append(i)
    if (np.linalg.matrix_rank(A[:, used]) < len(wanted)).any():
        return none
    motion = -(np.linalg.pinv(A[:, used]) @ b[:, used, None])
    scale = (np.abs(A) * np.abs(motion.transpose(0, 2, 1))).sum(axis=2) + np.abs(b)
    holds = (np.abs((A @ motion)[:, :, 0] + b) <= 1e-6 * np.maximum(scale, 1e-300)).all(axis=0)
    return [bool(x) for x in holds[k:]] if holds[used].all() else none


def _affine(truth: Reference, exprs: Sequence[sp.Expr], wanted: Sequence[sp.Basic]) -> tuple[Array, Array] | None:
    """Expressions that are A u + b in some quantities u: A (S, k, n) and b (S, k); None if they are not finite."""
    size = truth.states.size
    compiled, still = CompiledExpressions(exprs), dict.fromkeys(wanted, np.zeros(size))
    A = compiled.slopes(wanted).at(truth.states, still).reshape(len(exprs), len(wanted), size).transpose(2, 0, 1)
    b = compiled.at(truth.states, still).T
    return (A, b) if np.isfinite(A).all() and np.isfinite(b).all() else None


def without_derived(
    truth: Reference, balances: Balances, lines: Sequence[AnsweredLine]
) -> tuple[Balances, tuple[AnsweredLine, ...]]:
    """The balances that do not follow from lines above them, and those that do: with a force put in, or two added."""
    rows = list(balances.lines)
    relations = [x for x in lines if x.kind == "equation" and not x.expr.has(*balances.forces)]
    relations = [x for x in relations if is_true(truth, x, truth.accelerations)][:MOST_LINES]
    every = sorted([*rows, *relations], key=lambda x: x.number)
    wanted = [*(c.acceleration for c in truth.model.coordinates), *balances.forces]
    if (found := _affine(truth, [x.expr for x in every], wanted)) is None:
        return balances, ()
    whole = np.concatenate([found[0], found[1][:, :, None]], axis=2)[:: max(1, truth.states.size // RANKED)]
    whole /= np.maximum(np.abs(whole).max(axis=2, keepdims=True), 1e-300)
    used: list[int] = []
    for i in range(len(every)):
        if (np.linalg.matrix_rank(whole[:, [*used, i]]) > len(used)).any():
            used.append(i)
    kept = [k for k, x in enumerate(rows) if any(every[i] is x for i in used)]
    first = Balances(tuple(rows[k] for k in kept), balances.forces, balances.A[:, kept], balances.b[:, kept])
    return first, tuple(x for k, x in enumerate(rows) if k not in kept)


def place_of(line: AnsweredLine) -> tuple[int, str]:
    """Where a line stands, and its text."""
    return line.number, line.text


def primes_as_names(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines with S' beside S as a name, if the system has no S: a force is not differentiated."""
    told = [x.expr for x in lines if x.kind == "equation"]
    rates = set[sp.Basic]().union(*(e.atoms(sp.Derivative) for e in told))
    own = unknown_in(truth, lines)
    put = {
        d: sp.Symbol(f"{d.args[0].func}'")
        for d in rates
        if isinstance(d, sp.Derivative) and d.derivative_count == 1 and d.args[0] in own
    }
    moving = {d.args[0] for d in rates if isinstance(d, sp.Derivative) and d.derivative_count > 1}
    if not put or any(d.args[0] in moving for d in put):
        return tuple(lines)
    return tuple(replace(x, expr=bounded.replaced(x.expr, put)) for x in lines)
