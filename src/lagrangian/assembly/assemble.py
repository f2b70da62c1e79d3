"""Consistent starts: coordinates that close every loop and rates that keep them closed, from a rough guess."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.errors import RunError, did_you_mean
from lagrangian.graph import Program, evaluate
from lagrangian.integrate.closing import KEPT, Array, Closing, CompiledRows, DenseRows, LoopSearch, least_step
from lagrangian.model import Model
from lagrangian.model.elements.conditions import Stated
from lagrangian.model.rows import NamedCondition, named_conditions
from lagrangian.values.multiplier_units import units_of_gaps
from lagrangian.values.values import key_name

Flags = NDArray[np.bool_]

NEAR = 64
"""The number of guesses near the given one; they are tried if that one does not close."""

FAR = 1000
"""The number of guesses anywhere."""

SPREAD = 0.3
"""The spread of the near guesses, in rad or relative to the system's length."""

SAME = 1e-6
"""Positions nearer to each other than this are the same."""


class Assembler:
    """Finds positions and velocities of a model that satisfy its constraints; ``fixed`` coordinates stay as given."""

    def __init__(self, model: Model, fixed: Collection[str] = ()) -> None:
        self.model, self.fixed = model, tuple(fixed)
        self.names = [c.name for c in model.coordinates]

    @cached_property
    def _positions(self) -> Closing:
        """The programs that move positions."""
        position = dynamics.correction(self.model, self.fixed, position=True)
        return Closing(position, None, dynamics.residual(self.model), self.matrix)

    @cached_property
    def search(self) -> LoopSearch | None:
        """The search for positions; None without rows on positions."""
        return None if self._positions.position is None else LoopSearch(CompiledRows(self._positions))

    @property
    def matrix(self) -> Program:
        """The program of A, a₀ and γ, which is the same whatever is fixed."""
        return dynamics.constraint_matrix(self.model)

    @cached_property
    def closing(self) -> Closing:
        """The programs for positions and velocities; what moves velocities is long and not needed for a picture."""
        return replace(self._positions, velocity=dynamics.correction(self.model, self.fixed, position=False))

    @cached_property
    def rows(self) -> tuple[NamedCondition, ...]:
        """The model's rows."""
        return tuple(named_conditions(self.model))

    # -- positions ----------------------------------------------------------------------------------------------

    def position(self, q: Array, p: Array, t: float = 0.0) -> Array:
        """Return the nearest position found to the guess q (n,). Raises `RunError`, with the gaps, if there is none."""
        if self.search is None:
            return q
        found, closed = self.search.run(q[None, :], p, t)
        if closed[0]:
            return found[0]
        others = self.positions(q, p, t, spread=SPREAD, count=NEAR)
        if not len(others):
            others = self.positions(q, p, t, spread=None, count=FAR)
        if not len(others):
            raise self._open(q, found[0], p, t)
        return others[0]

    def positions(self, q: Array, p: Array, t: float, *, spread: float | None, count: int) -> Array:
        """Return the different positions found from random guesses, shape (found, n), the nearest to q first."""
        if self.search is None:
            return q[None, :]
        rng = np.random.default_rng(1)
        angles, moving = self.search.angles(q, p, t), self.search.moving(q, p, t)
        noise = rng.uniform(-1.0, 1.0, (count, len(q))) * moving
        size = self._length(q, p, t, angles)
        reach = np.where(angles, np.pi if spread is None else spread, (2.0 if spread is None else spread) * size)
        centre = q if spread is not None else np.where(angles, 0.0, q)
        guesses = centre + noise * reach
        held = [self.names.index(name) for name in self.fixed]
        guesses[:, held] = q[held]
        guesses[0] = q
        found, closed = self.search.run(guesses, p, t)
        angles[held] = False  # what stays, stays to the last digit
        return self._different(found[closed], q, angles)

    def _length(self, q: Array, p: Array, t: float, angles: Flags) -> float:
        """The length of the system, estimated from the gaps and the guess."""
        assert self.search is not None
        lengths = np.abs(np.where(angles, 0.0, q)).max(initial=0.0)
        gaps = np.abs(self.search.gaps(q[None, :], p, t))
        return float(max(lengths, gaps[np.isfinite(gaps)].max(initial=0.0), 1e-3))

    @staticmethod
    def _different(found: Array, q: Array, angles: Flags) -> Array:
        """Each position once, with angles near those of the guess, the nearest first."""
        turned = np.where(angles, q + np.remainder(found - q + np.pi, 2 * np.pi) - np.pi, found)
        order = np.argsort(np.linalg.norm(turned - q, axis=-1), kind="stable")
        kept: list[Array] = []
        for x in turned[order]:
            apart = [np.where(angles, np.remainder(x - y + np.pi, 2 * np.pi) - np.pi, x - y) for y in kept]
            if all(np.abs(d).max() > SAME * (1.0 + np.abs(x).max()) for d in apart):
                kept.append(x)
        return np.array(kept).reshape(-1, len(q))

    def _open(self, guess: Array, nearest: Array, p: Array, t: float) -> RunError:
        """The error that names the open rows, their gaps, and the fixed coordinates that prevent them from closing."""
        assert self.search is not None
        gaps = self.search.gaps(nearest[None, :], p, t)[0]
        named: dict[tuple[str, str], tuple[float, NamedCondition]] = {}
        units = units_of_gaps(self.model)
        for row, gap in zip([r for r in self.rows if r.condition.on_positions], gaps, strict=True):
            key = (row.element.name, units.get(row.name, ""))
            if key not in named or named[key][0] < abs(gap):
                named[key] = (abs(float(gap)), row)
            if not np.isfinite(gap):
                return RunError(
                    f"no position was found that satisfies the constraints: '{row.name}' has no finite value near the "
                    "guess",
                    fix="start from positions at which every constraint can be evaluated",
                    place=row.element.place,
                    code="E304",
                )
        worst = sorted((item for item in named.items() if item[1][0] > 0), key=lambda item: -item[1][0])
        shown = ", ".join(f"'{name}' by {gap:.3g} {unit}".rstrip() for (name, unit), (gap, _) in worst[:4])
        rows = [row for _, (_, row) in worst]
        return RunError(
            f"no position was found that satisfies the constraints (open in the nearest position: {shown})",
            fix=self._cure(rows, guess, p, t),
            place=rows[0].element.place,
            code="E304",
        )

    def _cure(self, rows: Sequence[NamedCondition], guess: Array, p: Array, t: float) -> str:
        """What would satisfy the open rows, the worst first."""
        freed = [name for name in self.fixed if self._closes_with([n for n in self.fixed if n != name], guess, p, t)]
        if freed:
            return f"do not hold {' or '.join(freed[:4])} fixed: without that, a position is found"
        if len(self.fixed) > 1 and self._closes_with((), guess, p, t):
            return "hold fewer coordinates fixed: with none of them, a position is found"
        repeated = dynamics.dependent_rows(self.model)
        for row in rows:
            if row.name in repeated:
                others = dynamics.quoted(repeated[row.name])
                return f"'{row.name}' contradicts {others}: leave one of them out, or change one so that both can hold"
        what = "at the expressions and their values" if isinstance(rows[0].condition, Stated) else "at the lengths"
        free = f", even with {' or '.join(self.fixed[:4])} free" if self.fixed else ""
        return f"look {what}: no position was found in which all constraints hold{free}"

    def _closes_with(self, fixed: Sequence[str], guess: Array, p: Array, t: float) -> bool:
        other = assembler_of(self.model, fixed)
        return bool(len(other.positions(guess, p, t, spread=SPREAD, count=NEAR)))

    # -- velocities ---------------------------------------------------------------------------------------------

    def velocity(self, q: Array, v: Array, p: Array, t: float = 0.0) -> Array:
        """Return the rates nearest to v, by kinetic energy, that satisfy the rows. Raises `RunError` if none do.

        Rates that satisfy them to the last digit, as those of a system at rest do, need no program that moves them.
        """
        if self.satisfied(q, v, p, t):
            return v
        v, kept = self.closing.rates(q, v, p, t)
        wrong = ~kept
        if wrong.any():
            rows = [row for row, bad in zip(self.rows, wrong, strict=True) if bad]
            names = [f"'{row.name}'" for row in rows]
            held = f" with {', '.join(self.fixed)} fixed" if self.fixed else ""
            raise RunError(
                f"no rates satisfy the constraint{'s' if len(names) > 1 else ''} {', '.join(names[:6])}{held}",
                fix="hold fewer coordinates fixed" if self.fixed else "look at constraints that contradict each other",
                place=rows[0].element.place,
                code="E305" if self.fixed else "E302",
            )
        return v

    def satisfied(self, q: Array, v: Array, p: Array, t: float) -> bool:
        """Whether rates satisfy the rows to the last digit."""
        rows = dynamics.residual(self.model)
        groups = {"q": q.tolist(), "v": v.tolist(), "u": [0.0] * len(rows.inputs["u"]), "p": p.tolist(), "t": [t]}
        return not np.any(evaluate(rows, groups)["Av"])


REMEMBERED = 8
"""The number of choices of fixed coordinates whose programs are kept for a model; the most recent ones stay."""


def assembler_of(model: Model, fixed: Iterable[str] = ()) -> Assembler:
    """Return the assembler of a model that holds these coordinates; it is made, and its code compiled, only once."""
    key = tuple(fixed)
    return model.recent("assemblers", key, lambda: Assembler(model, key), REMEMBERED)


def seen_position(model: Model, q: Array, p: Array, fixed: Iterable[str] = (), t: float = 0.0) -> Array:
    """Return the nearest position found to the guess q, for a picture: no program is compiled for one guess.

    The coordinates in ``fixed`` stay. Raises `RunError`, with the gaps, if there is none.
    """
    key = tuple(fixed)
    if not any(row.on_positions for e in model.constraints for row in e.conditions(model)):
        return q
    found, closed = LoopSearch(DenseRows(_terms(model, key))).run(q[None, :], p, t)
    return found[0] if closed[0] else assembler_of(model, key).position(q, p, t)


def seen_velocity(model: Model, q: Array, v: Array, p: Array, fixed: Iterable[str] = (), t: float = 0.0) -> Array:
    """Return the rates nearest to v that satisfy the rows at q, with dense matrices: no program is compiled for them.

    The rates of coordinates in ``fixed`` stay. Raises `RunError` as `Assembler.velocity`.
    """
    key = tuple(fixed)
    assembler = assembler_of(model, key)
    if assembler.satisfied(q, v, p, t):
        return v
    matrix, terms = assembler.matrix, _terms(model, key)
    rest = {"q": q.tolist(), "v": [0.0] * len(v), "u": [0.0] * len(model.inputs), "p": p.tolist(), "t": [t]}
    found = {**evaluate(terms, rest), **evaluate(matrix, rest)}
    A, a0, M, N = (np.array(found[name], float) for name in ("A", "a0", "M", "N"))
    if all(np.isfinite(x).all() for x in (A, a0, M, N)):
        held = [k for k, c in enumerate(model.coordinates) if c.name in key]
        rows = np.concatenate([A, N[held]])
        near = v
        for _ in range(2):  # the second takes the rounding of the first away
            near = near + least_step(np.append(A @ near + a0, np.zeros(len(held))), rows, M)
        if (np.abs(A @ near + a0) <= KEPT * (1e-3 + np.abs(A) @ np.abs(near) + np.abs(a0))).all():
            return near
    return assembler.velocity(q, v, p, t)


def _terms(model: Model, fixed: tuple[str, ...]) -> Program:
    return model.recent("closing terms", fixed, lambda: dynamics.closing_terms(model, fixed), REMEMBERED)


def fixed_names(model: Model, fixed: Iterable[Any] | str) -> tuple[str, ...]:
    """Return the names of the coordinates to hold fixed, given as text, names or symbols. Raises `RunError`."""
    listed = fixed.replace(",", " ").split() if isinstance(fixed, str) else fixed
    names, known = tuple(key_name(x) for x in listed), [c.name for c in model.coordinates]
    for name in names:
        if name not in known:
            raise RunError(
                f"there is no coordinate '{name[:64]}' to hold fixed",
                fix=did_you_mean(name, known) or f"known: {', '.join(known[:12])}",
                code="E402",
            )
    return names


def consistent(
    model: Model, q: Array, v: Array, p: Array, t: float = 0.0, *, fixed: Sequence[str] = (), compiled: bool = True
) -> tuple[Array, Array]:
    """Return q and v that satisfy every constraint, from a guess; coordinates in ``fixed`` and their rates stay.

    Without ``compiled``, they are found without machine code, which is quicker for one start.
    Raises `RunError` if no position closes the loops (E304), or no rates do with the fixed coordinates (E305).
    """
    assembler = assembler_of(model, fixed)
    guess = np.asarray(q, float)
    rates = np.asarray(v, float)
    if compiled:
        at = assembler.position(guess, p, t)
        return at, assembler.velocity(at, rates, p, t)
    at = seen_position(model, guess, p, fixed, t)
    return at, seen_velocity(model, at, rates, p, fixed, t)
