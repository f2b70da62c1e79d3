"""Answers in other coordinates: the changes that are tried, and lines converted to the system's coordinates.

A change expresses a coordinate η of the answer as ψ(ξ) in those of the system. To try it, ψ, ψ̇ and ψ̈ replace η, η̇
and η̈ in every line; a line that is then right was right in the other coordinates.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from functools import lru_cache
from itertools import islice, product
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.coordinates.relations import related, solutions
from lagrangian.check.coordinates.rest import position_at_rest, turning
from lagrangian.check.reading import OwnCoordinates, named, replaced_by
from lagrangian.check.reference import Reference
from lagrangian.check.rows import DOUBLE_TOLERANCE
from lagrangian.check.verdict import AnsweredLine
from lagrangian.coordinates import changed
from lagrangian.derive import derive
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.errors import ModelError
from lagrangian.model import time
from lagrangian.page.formula import Text, text
from lagrangian.page.plain import plain
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

MAX_CHANGES = 200
"""The largest number of changes that are tried."""

TRIED_TOGETHER = 32
"""The number of changes that are tried at once."""

MOST_CHOSEN = 3
"""The largest number of new names for which all meanings are tried; more are renamed coordinates, in their order."""


@dataclass(frozen=True, eq=False)
class ProposedChange(Brief):
    """A change of coordinates: the answer's symbols in those of the system, its description, and whether it must be
    reported.

    ``plain`` changes are usually made without saying so (relative instead of absolute coordinates), or are stated in
    the answer under a new name. With others, such as a direction counted the other way round, the answer would be right
    if it said so.
    """

    table: Mapping[sp.Expr, sp.Expr]
    words: Text
    plain: bool

    @property
    def told(self) -> Text:
        """How the coordinates were understood."""
        return text("In other coordinates: ", *self.words.parts, ".")

    def put(self, expr: sp.Expr) -> sp.Expr:
        """An expression of the answer in the system's coordinates."""
        whole: dict[sp.Basic, sp.Expr] = {}
        for eta, psi in self.table.items():
            rate = bounded.diff(psi, time)
            whole[eta] = psi
            whole[sp.Derivative(eta, time)] = rate
            whole[sp.Derivative(eta, (time, 2))] = bounded.diff(rate, time)
        return cast("sp.Expr", bounded.replaced(expr, whole))  # a derivative by a coordinate stays as it is written

    def chart(self, truth: Reference, lines: Sequence[AnsweredLine]) -> OwnCoordinates | None:
        """The answer's coordinates, in the order of those that they replace; None if they do not determine these."""
        own = tuple(truth.derivation.coordinates)
        used = {q for line in lines if line.kind != "definition" for q in own if line.expr.has(q)}
        return replaced_by(tuple(self._in_order(truth, used)), own, own)

    def region(self, truth: Reference) -> sp.Expr | None:
        """det ∂ψ/∂ξ, whose sign is constant where the change is one-to-one; None if it is constant or too long."""
        psi = [psi for _, psi in self._in_order(truth)]
        q = truth.derivation.coordinates
        J = sp.Matrix([[p.diff(x) for x in q] for p in psi])
        if truth.n > 4 or not J.has(*q):
            return None
        det = cast("sp.Expr", J.det())
        return det if det.has(*q) else None

    def _in_order(self, truth: Reference, used: Set[sp.Expr] = frozenset()) -> list[tuple[str, sp.Expr]]:
        """The name, as a key, and ψ of every coordinate: itself if it stays; new names take the places of those that
        they replace, which are none that is ``used``."""
        own = list(truth.derivation.coordinates)
        new = [(named(eta), psi) for eta, psi in self.table.items() if eta not in own]
        free = [q for q in own if q not in self.table and q not in used]
        free = free if len(free) >= len(new) else [q for q in own if q not in self.table]
        found: list[tuple[str, sp.Expr]] = []
        for q in own:
            mine = named(q), self.table.get(q, q)
            if q in free and (other := next((x for x in new if x[1].has(q)), None)) is not None:
                new.remove(other)
                mine = other
            found.append(mine)
        return found


def candidates(truth: Reference, lines: Sequence[AnsweredLine]) -> Iterator[ProposedChange]:
    """The changes worth trying for an answer: for its own names if it has any, otherwise for the system's coordinates
    of which it writes one."""
    new = new_names(truth, lines)
    written = tuple(frozenset[str]().union(*(line.names for line in lines)))
    own = (x for x in _reused(truth) if x.plain or not written or any(named(q).startswith(written) for q in x.table))
    yield from islice(_renamed(truth, new, lines) if new else own, MAX_CHANGES)


def new_names(truth: Reference, lines: Sequence[AnsweredLine]) -> list[sp.Expr]:
    """The moving names in an answer that are not coordinates, inputs or definitions of the system."""
    own = set(truth.derivation.coordinates) | {u.symbol for u in truth.model.inputs}
    own |= {d.symbol for d in truth.model.definitions}
    found = set[sp.Expr]().union(*(_moving(line.expr) for line in lines if line.kind != "statement"))
    return sorted(found - own, key=str)


@lru_cache(maxsize=2_000)
def _moving(expr: sp.Expr) -> frozenset[Any]:
    """The functions of time in an expression, kept: many ask for them."""
    return frozenset(f for f in bounded.names(expr) if isinstance(f, AppliedUndef) and f.args == (time,))


# -- names that only the answer has -----------------------------------------------------------------------------------


def _renamed(truth: Reference, new: Sequence[sp.Expr], lines: Sequence[AnsweredLine]) -> Iterator[ProposedChange]:
    stated = {line.name: line.expr for line in lines if line.kind == "definition"}
    solved: dict[sp.Expr, list[sp.Expr]] = {}
    for c in truth.model.coordinates:
        expr = stated.get(c.name)
        for f in new if expr is not None else ():
            if expr is not None and expr.has(f):
                solved.setdefault(f, []).extend(solutions(expr - c.symbol, f))
    for f in new:
        if f not in solved and (found := related(truth, f, lines)):
            solved[f] = found
    if len(new) > MOST_CHOSEN:
        yield from _in_order(truth, new, lines)
        return
    choices = [solved.get(f) or list(meanings(truth)) for f in new]
    used = {q for line in lines for q in truth.derivation.coordinates if line.expr.has(q) and line.kind != "definition"}
    tried: list[tuple[tuple[int, int], ProposedChange]] = []
    for k, picked in enumerate(islice(product(*choices), 4000)):
        if len(set(picked)) < len(picked):
            continue
        table = dict(zip(new, picked, strict=True))
        missing = sum(q not in used and not any(p.has(q) for p in picked) for q in truth.derivation.coordinates)
        if missing == 0:
            tried.append(((sum(p in used for p in picked), k), ProposedChange(table, _meant(table), True)))
    yield from (change for _, change in sorted(tried, key=lambda x: x[0]))


def _in_order(truth: Reference, new: Sequence[sp.Expr], lines: Sequence[AnsweredLine]) -> Iterator[ProposedChange]:
    """New names for all coordinates, which the answer uses nowhere, in their order: y₁ … y₅ in place of x₁ … x₅."""
    own = list(truth.derivation.coordinates)
    if len(new) != len(own) or any(line.expr.has(*own) for line in lines):
        return
    by_length = sorted(new, key=lambda f: (len(str(f)), str(f)))  # y10 behind y9
    table = dict(zip(by_length, own, strict=True))
    yield ProposedChange(table, _meant(table), True)


def _meant(table: Mapping[sp.Expr, sp.Expr]) -> Text:
    parts: list[Any] = []
    for eta, psi in table.items():
        parts += [eta, " = ", psi, ", "]
    return text("with ", *parts[:-1])


@lru_cache(maxsize=64)
def meanings(truth: Reference) -> tuple[sp.Expr, ...]:
    """The possible meanings of an unknown coordinate: one of the system, sums and differences, positions and
    directions."""
    q: list[sp.Expr] = list(truth.derivation.coordinates)
    found: list[sp.Expr] = [*q, *(-x for x in q)]
    for i, a in enumerate(q):
        found += [a + b for b in q[i + 1 :]]
        found += [a - b for b in q if b is not a]
    for body in truth.model.bodies:
        found += [x for p in truth.model.position(body.at) if (x := truth.expand(p)).has(*q)]
        frame = getattr(body, "frame", None)
        if frame is not None and frame.dimension == 2:
            found.append(truth.expand(frame.total_angle))
    found += [sp.Add(*q[: k + 1]) for k in range(2, len(q))]
    for x in turning(truth):
        found += [sp.pi / 2 - x, x + sp.pi / 2, x - sp.pi / 2, sp.pi - x, x + sp.pi]
    for x, c in shifts(truth):
        found += [x - c, c - x]
    return tuple(dict.fromkeys(found))


# -- the system's own names -------------------------------------------------------------------------------------------


@lru_cache(maxsize=64)
def _reused(truth: Reference) -> tuple[ProposedChange, ...]:
    """The changes of a system's own coordinates, the same for all answers."""
    return tuple(islice(_with_own_names(truth), MAX_CHANGES))


def _with_own_names(truth: Reference) -> Iterator[ProposedChange]:
    q: list[sp.Expr] = list(truth.derivation.coordinates)
    turned = set(turning(truth))
    groups = [g for g in ([x for x in q if x in turned], [x for x in q if x not in turned]) if g]
    for group in groups:
        yield from _relative(group)
    for x in q:
        yield ProposedChange({x: -x}, text(x, " counted the other way round"), False)
    if len(q) > 1:
        yield ProposedChange({x: -x for x in q}, text("every coordinate counted the other way round"), False)
    away = [lambda x: sp.pi / 2 - x, lambda x: x + sp.pi / 2, lambda x: x - sp.pi / 2]
    away += [lambda x: sp.pi - x, lambda x: x + sp.pi]
    for other in away:
        for x in turned:
            yield ProposedChange({x: other(x)}, text(x, " measured from another axis: yours is ", other(x)), False)
        if len(turned) > 1:
            yield ProposedChange({x: other(x) for x in turned}, text("angles measured from another axis"), False)
    moved = list(shifts(truth))
    for x, c in moved:
        yield ProposedChange({x: x - c}, text(x, " measured from another point: yours is ", x - c), False)
        yield ProposedChange({x: c - x}, text(x, " measured from another point: yours is ", c - x), False)
    rest = position_at_rest(truth)
    if len(rest) > 1:
        yield ProposedChange(
            {x: x - c for x, c in rest.items()}, text("coordinates measured from the place of rest"), False
        )


def _relative(group: Sequence[sp.Expr]) -> Iterator[ProposedChange]:
    """Relative instead of absolute coordinates and vice versa: for each pair, and all along the chain."""
    if len(group) > 2:
        sums = {x: sp.Add(*group[: k + 1]) for k, x in enumerate(group) if k}
        steps = {x: x - group[k] for k, x in enumerate(group[1:])}
        yield ProposedChange(sums, text("every coordinate absolute"), True)
        yield ProposedChange(steps, text("every coordinate relative to the one before"), True)
    for k, x in enumerate(group):
        for y in group[:k]:
            yield ProposedChange({x: x + y}, text(x, " absolute: yours is ", x + y), True)
            yield ProposedChange({x: x - y}, text(x, " relative to ", y, ": yours is ", x - y), True)


def shifts(truth: Reference) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """Pairs (coordinate, constant): rest lengths with both signs, and the equilibrium position."""
    rests = [
        truth.expand(r) for e in truth.model.elements if (r := cast("sp.Expr", getattr(e, "rest", sp.S.Zero))) != 0
    ]
    turned = set(turning(truth))
    for q in truth.derivation.coordinates:
        for rest in rests if q not in turned else ():
            if not rest.has(*truth.derivation.coordinates):
                yield q, rest
                yield q, -rest
    for q, c in position_at_rest(truth).items():
        yield q, c
        yield q, -c


# -- quick test -------------------------------------------------------------------------------------------------------


ROUNDING = 1e-12
"""What is smaller is 0 at every motion, as in ẏ = h α̇/cos² α with y = h tan α."""


class QuickTest:
    """Tests quickly whether a change may make an answer right: from its equations in doubles, from an energy where no
    equation has a name that is changed."""

    def __init__(self, truth: Reference, lines: Sequence[AnsweredLine]) -> None:
        self.truth = truth
        equations = [line.expr for line in lines if line.kind == "equation"]
        energy = next((line for line in lines if line.kind in ("T", "V", "L")), None)
        new = new_names(truth, lines)
        if energy is not None and new and energy.expr.has(*new) and not any(x.has(*new) for x in equations):
            equations = []
        self._equations = bool(equations)
        right = [truth.energies[energy.kind]] if energy is not None else []
        self._own = CompiledExpressions([] if equations else right)
        chosen = equations or ([energy.expr] if energy is not None else [])
        self._compiled = CompiledExpressions(chosen)

    def true_lines(self, change: ProposedChange) -> int:
        """The number of equations that are true with this change, in doubles."""
        if not self._equations:
            return int(self._keeps_energy(change))
        return int(self._true([change]).sum())

    def possible(self, changes: Iterable[ProposedChange]) -> Iterator[ProposedChange]:
        """The changes with which the answer may be right, in their order; none if nothing can be compared."""
        waiting = iter(changes if self._compiled.ids else ())
        while some := list(islice(waiting, TRIED_TOGETHER)):
            true = self._true(some).all(axis=0) if self._equations else np.array([self._keeps_energy(x) for x in some])
            yield from (some[int(k)] for k in np.flatnonzero(true))

    def _true(self, changes: Sequence[ProposedChange]) -> Array:
        """Which equations are true with each of the changes, in doubles: shape (equations, changes)."""
        instead = [self._values(change, truly=x) for x in (True, False) for change in changes]
        truly, off = np.split(self._compiled.at_each(self.truth.states, instead), 2, axis=1)
        good = np.isfinite(truly) & np.isfinite(off)
        scale = np.where(good, np.abs(off), 0).max(axis=2)
        small = np.where(good, np.abs(truly), 0).max(axis=2) <= np.maximum(DOUBLE_TOLERANCE * scale, ROUNDING)
        return np.logical_and(good.any(axis=2), small)

    def _keeps_energy(self, change: ProposedChange) -> bool:
        """Whether the energy differs with this change from the right one by a constant, or not at all."""
        if not self._compiled.ids:
            return False
        moved = self._compiled.at(self.truth.states, self._values(change, truly=False))[0]
        own = self._own.at(self.truth.states)[0]
        rest = (moved - own).reshape(2, -1)
        with np.errstate(invalid="ignore"):  # what is infinite at every state is no constant
            rest = rest - rest[:, :1]
        return bool(np.isfinite(rest).all() and np.abs(rest).max() <= 1e-6 * (1 + np.abs(own).max()))

    def _values(self, change: ProposedChange, *, truly: bool) -> dict[sp.Basic, Array]:
        accelerations = self.truth.accelerations if truly else {}
        out: dict[sp.Basic, Array] = dict(accelerations)
        for eta, psi in change.table.items():
            values = self.truth.kept((psi, truly), lambda psi=psi: _motion(psi).at(self.truth.states, accelerations))
            out.update(zip(_with_rates(eta), values, strict=True))
        return out


@lru_cache(maxsize=1024)
def _motion(psi: sp.Expr) -> CompiledExpressions:
    """ψ, ψ̇ and ψ̈ as one graph, which is made once for the changes of all answers."""
    rate = bounded.diff(psi, time)
    return CompiledExpressions([psi, rate, bounded.diff(rate, time)])


@lru_cache(maxsize=1024)
def _with_rates(eta: sp.Expr) -> tuple[sp.Expr, ...]:
    """η, η̇ and η̈."""
    return eta, sp.Derivative(eta, time), sp.Derivative(eta, (time, 2))


# -- the system in the answer's coordinates ---------------------------------------------------------------------------


def likeliest(truth: Reference, lines: Sequence[AnsweredLine]) -> ProposedChange | None:
    """The change for which most equations of a wrong answer are true; if it makes none true, the one that reads a name
    as a coordinate of which it is the beginning (th for theta), else None."""
    glance = QuickTest(truth, lines)
    tried = [(glance.true_lines(change), -k, change) for k, change in enumerate(candidates(truth, lines))]
    best = max(tried, key=lambda x: x[:2], default=None)
    if best is None:
        return None
    if best[0] or len(tried) == 1:
        return best[2]
    short = [change for _, _, change in tried if _abbreviates(change)]
    return short[0] if len(short) == 1 else None


def _abbreviates(change: ProposedChange) -> bool:
    """Whether a change only reads names as the coordinates whose names begin with them."""
    pairs = [(getattr(eta, "func", eta), getattr(psi, "func", psi)) for eta, psi in change.table.items()]
    written = [(str(eta), str(psi)) for eta, psi in pairs]
    return bool(written) and all(1 < len(short) < len(long) and long.startswith(short) for short, long in written)


def in_these(truth: Reference, change: ProposedChange) -> Reference | None:
    """The reference in the answer's coordinates, if the change can be inverted; made once for each change."""
    key = tuple(change.table.items())
    known = truth.others
    if key not in known:
        try:
            names = {plain(eta): psi for eta, psi in change.table.items()}
            known[key] = Reference(derive(changed(truth.model, names)), truth.values)
        except ModelError:
            known[key] = None
    return known[key]
