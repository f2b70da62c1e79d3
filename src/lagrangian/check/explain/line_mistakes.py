"""The mistakes that lead to one line of T*, V, L, D or a Ξ, and what other lines say for or against them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import LARGEST, alignments
from lagrangian.check.explain.after_own_rates import slip_in_own_rate
from lagrangian.check.explain.changes.pool import Pool, Possible
from lagrangian.check.explain.derivative_lines import elsewhere, slip_in
from lagrangian.check.explain.inner_rates import slip_in_inner_rate
from lagrangian.check.explain.own_terms import LINES, own_term
from lagrangian.check.explain.rates_of_energies import slip_in_rate
from lagrangian.check.explain.search import (
    EXOTIC,
    MOST_FOR_PAIRS,
    Explanation,
    Vectors,
    reproduces,
    singles,
    without_constant,
)
from lagrangian.check.explain.two_values import slip_in_values
from lagrangian.check.explain.written_pieces import Against
from lagrangian.check.reference import Reference, without_time
from lagrangian.check.stated import dissipation, index_of, right_value, without_dampers
from lagrangian.check.verdict import DERIVED, AnsweredLine, Mistake
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import Force, Torque

ENERGIES = ("T", "V", "L", "Xi")
MOST_TOLD = 24
"""The largest number of explanations of a line that are put into words."""
MOST_TOGETHER = 10
"""The largest number of explanations of each of two lines that are tried together."""
ELSEWHERE = 0.8
"""What it costs more to take a mistake of another step for one that shows in a derivative of an energy."""
UNNATURAL = 8.0
"""An explanation that costs more may be true, but is no help."""


def of_line(
    pool: Pool, line: AnsweredLine, lines: Sequence[AnsweredLine], against: Against
) -> tuple[list[Explanation], list[Mistake]]:
    """The mistakes that lead to a line of T*, V, L, D or a Ξ, the most likely first, or a term of its own.

    ``lines`` are all lines of the answer. A derivative of energies that are right has no mistake of these, which right
    lines speak ``against``.
    """
    truth, i = pool.truth, index_of(pool.truth, line.name)
    if line.kind == "D":
        return _of_dissipation(pool, line, lines), []
    if line.kind in DERIVED and i is not None:
        found = against.unopposed(_of_derivative(pool, line, i)) if line.kind != "T-p" else []
        slip = None if found else slip_in(truth, line, lines)
        return found, [slip] if slip is not None else []
    if line.kind == "p" and i is not None:
        return against.unopposed(_of_momentum(pool, line, i)), []
    if line.kind not in ENERGIES or (line.kind == "Xi" and i is None):
        slip = slip_in_rate(truth, line, lines) or slip_in_own_rate(truth, line) or slip_in_values(truth, line)
        slip = slip or slip_in_inner_rate(truth, line)
        return [], [slip] if slip is not None else []
    right = truth.energies.get(line.kind)
    if right is None:
        assert i is not None
        undamped = without_dampers(truth, line, i, lines)
        right = truth.Xi[i] if undamped is None else undamped
    values = CompiledExpressions(
        [without_time(truth, line.expr - right) if line.kind == "V" else line.expr - right]
    ).at(truth.states)[0]
    if not np.isfinite(values).all() or np.abs(values).max() > LARGEST:
        return [], []
    whole = values
    change = _changes(pool, line.kind, i)
    values = without_constant(values) if line.kind in ("V", "L") else values
    if np.abs(values).max() <= 1e-12:
        return [], []
    found = against.pieces.allow(singles(pool, [change], values))
    found = _of_one_force(pool, found, i, against) if line.kind == "Xi" and i is not None else found
    if found and found[0].cost <= EXOTIC:
        return found, []
    if line.kind == "T" and (level := _up_to_a_constant(pool, values) or _up_to_time(pool, line.expr - right)):
        return level, []
    vectors: Vectors = pool.kept(("vectors", line.kind, i), lambda: Vectors(pool, change))
    pairs = against.pieces.allow(vectors.pairs(values))
    if line.kind == "Xi" and pairs and not against.unopposed([*found, *pairs]):
        opposed = [pool.places[k] for k in against.mistakes]  # of those with the same effect here, one may be free
        kept = np.where(np.isin(np.arange(len(change)), opposed)[:, None], 0.0, change)
        pairs = Vectors(pool, kept).pairs(values) or pairs
    found = sorted([*found, *pairs], key=lambda e: e.cost)
    own = own_term(pool, line.expr, whole, line.kind, i)
    if own is None and line.kind == "V" and (moving := _moving_part(truth, line.expr - right)) is not None:
        own = own_term(pool, line.expr, moving, line.kind, i)
    if own is not None and (not found or own.cost < found[0].cost):
        return [], [own.mistake(truth)]
    return [e for e in found if e.cost <= UNNATURAL], []


def _of_dissipation(pool: Pool, line: AnsweredLine, lines: Sequence[AnsweredLine]) -> list[Explanation]:
    """The explanations of a wrong D; with the spring beside a damper only if a V that is stated is wrong so, too."""
    truth = pool.truth
    rest = line.expr - dissipation(truth)
    values = CompiledExpressions([-bounded.diff(rest, c.rate) for c in truth.model.coordinates]).at(truth.states)
    seen = np.isfinite(values).all() and 1e-12 < np.abs(values).max() < LARGEST
    stated_V = [x for x in lines if x.kind == "V"]
    alone = pool.Xi if not stated_V or not seen else _as_in_potential(pool, stated_V[0])
    found = singles(pool, [alone[:, j] for j in range(truth.n)], values) if seen else []
    if seen and not (found and found[0].cost <= EXOTIC):
        whole = alone is pool.Xi
        of_dampers: Vectors = (
            pool.kept(("vectors", "D"), lambda: Vectors(pool, pool.Xi)) if whole else Vectors(pool, alone)
        )
        found += of_dampers.pairs(values)
    return [e for e in found if all(_of_whole_damper(t.mistake) for t in e.told)]


def _as_in_potential(pool: Pool, line: AnsweredLine) -> Array:
    """What every mistake adds to the forces, 0 for one that would change V in another way than the line that states it
    is wrong."""
    changed = _changes(pool, "V", None)
    off = without_constant(CompiledExpressions([line.expr - pool.truth.V]).at(pool.truth.states)[0])
    if not np.isfinite(off).all():
        return pool.Xi
    free = np.abs(changed).max(axis=1) <= 1e-9
    so = np.abs(changed - off).max(axis=1) <= 1e-9 * (1 + np.abs(off).max())
    return np.where((free | so)[:, None, None], pool.Xi, 0.0)


def _moving_part(truth: Reference, rest: sp.Expr) -> Array | None:
    """What a potential energy has too much but for constants: heights may be counted from elsewhere. None without such
    constants."""
    listed = sp.Add.make_args(bounded.expand(rest))
    moving = [x for x in listed if x.has(*(c.symbol for c in truth.model.coordinates))]
    return CompiledExpressions([sp.Add(*moving)]).at(truth.states)[0] if 0 < len(moving) < len(listed) else None


def _of_one_force(pool: Pool, found: list[Explanation], i: int, against: Against) -> list[Explanation]:
    """The explanations of Ξ_i, without those by which the Ξ of another coordinate that is right would be wrong."""

    def elsewhere(e: Explanation) -> bool:
        own = (t for t in e.told if against.speaks(t))
        return any(
            np.abs(np.delete(pool.Xi[pool.places[id(t.mistake)]], i, axis=0)).max(initial=0.0) > 1e-9 for t in own
        )

    return [e for e in found if not elsewhere(e)]


def _up_to_a_constant(pool: Pool, values: Array) -> list[Explanation]:
    """The likely mistakes in T* that lead to what differs but for a constant: ½ m a² Ω² of what is carried around at a
    given rate may be left out, whatever else is wrong."""
    level = without_constant(values)
    if (
        np.abs(level).max() <= 1e-9 * np.abs(values).max()
        or np.abs(level - values).max() <= 1e-9 * np.abs(values).max()
    ):
        return []
    change: Array = pool.kept(("level", "T"), lambda: without_constant(pool.T))
    return [e for e in singles(pool, [change], level) if e.cost <= EXOTIC]


def _up_to_time(pool: Pool, rest: sp.Expr) -> list[Explanation]:
    """The same but for what time alone gives, as ½ m a² Ω² sin² Ωt of a component in which no coordinate stands."""
    moving = without_time(pool.truth, rest)
    if moving is rest or moving == 0:
        return []
    values = CompiledExpressions([moving]).at(pool.truth.states)[0]
    if not np.isfinite(values).all() or not 1e-12 < np.abs(values).max() < LARGEST:
        return []
    return [e for e in singles(pool, [pool.T], values) if e.cost <= EXOTIC]


def of_forces(pool: Pool, wrong: Sequence[AnsweredLine], lines: Sequence[AnsweredLine]) -> list[Explanation]:
    """The mistakes, or pairs, that lead to all wrong Ξ at once, where several are wrong: a force in the wrong one."""
    truth, rests = pool.truth, dict[int, Array]()
    for line in wrong:
        i = index_of(truth, line.name)
        if line.kind == "Xi" and i is not None:
            undamped = without_dampers(truth, line, i, lines)
            right = truth.Xi[i] if undamped is None else undamped
            rests[i] = CompiledExpressions([line.expr - right]).at(truth.states)[0]
    rest = np.array(list(rests.values()))
    if len(rests) < 2 or not np.isfinite(rest).all() or np.abs(rest).max() > LARGEST:
        return []
    if np.abs(rest).max(axis=1).min() <= 1e-12:
        return []
    if found := [e for e in singles(pool, [pool.Xi[:, i] for i in rests], rest) if e.cost <= EXOTIC]:
        return found
    rows = tuple(rests)
    vectors: Vectors = pool.kept(("vectors", "Xi", rows), lambda: Vectors(pool, pool.Xi[:, list(rows)]))
    return [e for e in vectors.pairs(rest) if e.cost <= UNNATURAL]


def _of_momentum(pool: Pool, line: AnsweredLine, i: int) -> list[Explanation]:
    """The likely mistakes in T* that lead to its ∂L/∂ξ̇."""
    right = right_value(pool.truth, line, i)
    values = CompiledExpressions([line.expr - right]).at(pool.truth.states) if right is not None else None
    if values is None or not np.isfinite(values).all() or not 1e-12 < np.abs(values).max() < LARGEST:
        return []
    return [e for e in singles(pool, [pool.momenta(i)], values) if e.cost <= EXOTIC]


def _of_derivative(pool: Pool, line: AnsweredLine, i: int) -> list[Explanation]:
    """The likely mistakes of one equation alone that lead to its d/dt ∂L/∂ξ̇, to its ∂L/∂ξ or to both."""
    right = right_value(pool.truth, line, i)
    sign = -1 if line.kind == "slope" else 1
    values = CompiledExpressions([sign * (line.expr - right)]).at(pool.truth.states) if right is not None else None
    if values is None or not np.isfinite(values).all() or not 1e-12 < np.abs(values).max() < LARGEST:
        return []
    found = [e for e in singles(pool, [pool.W[:, i]], values) if e.cost <= EXOTIC]
    found = [e for e in found if not any(elsewhere(pool.truth, line, t.mistake) for t in e.told)]
    found = [e for e in found if e.told[0].mistake.name != "sine_for_cosine"] or found  # no angle is measured here
    own = [e if _step(e.told[0].mistake) == LINES["equation"] else replace(e, cost=e.cost + ELSEWHERE) for e in found]
    return sorted(own, key=lambda e: e.cost)


def _step(possible: Possible) -> int | None:
    """The step in which a possible mistake is made."""
    if possible.change is not None:
        return possible.change.site.step
    return possible.wrong.step if possible.wrong is not None else None


def _of_whole_damper(possible: Possible) -> bool:
    """Whether a mistake can be made in D, which has no ends, no reactions and no equation: ½ b (rate)² of a damper."""
    if possible.wrong is not None:
        v = possible.wrong.variant
        return v.coordinate is None and "D" in v.stated
    return possible.change is not None and possible.change.site.coordinate is None


def _changes(pool: Pool, kind: str, i: int | None) -> Array:
    """What every possible mistake adds to a line."""
    if kind == "Xi":
        return pool.Xi[:, i]
    if kind == "T":
        return pool.T
    return pool.kept(("line", kind), lambda: without_constant(pool.V if kind == "V" else pool.L))


def followed(pool: Pool, groups: list[list[Explanation]], equations: Sequence[AnsweredLine]) -> list[list[Explanation]]:
    """The explanations of lines from which equations follow: those that lead to these equations as well, if any do.

    A letter may be wrong in V alone or everywhere; only the equations below tell.
    """
    if not groups or not all(groups) or len(groups) > 2 or not equations:
        return groups
    exprs, P = stated(pool.truth, equations)
    found = alignments(pool.truth, exprs, P)[:MOST_FOR_PAIRS]
    few = [g[: MOST_TOLD if len(groups) == 1 else MOST_TOGETHER] for g in groups]
    chosen: list[dict[int, Explanation]] = [{} for _ in groups]
    for together in product(*few):
        told = {(id(t.mistake), t.times): t for e in together for t in e.told}  # one may explain several lines
        if any(reproduces(pool, list(told.values()), a) for a in found):
            for kept, e in zip(chosen, together, strict=True):
                kept.setdefault(id(e), e)
    return [[*kept.values()] for kept in chosen] if all(chosen) else groups


def contradicted(pool: Pool, right: Sequence[AnsweredLine], lines: Sequence[AnsweredLine]) -> set[int]:
    """The possible mistakes that would be visible in a line that is right, by their identity.

    A Ξ without the dampers, which other ``lines`` hold, says nothing of these and of the springs beside them.
    """
    found: set[int] = set()
    driven: set[int] = pool.kept("driven", lambda: {id(p) for p in pool.all if isinstance(p.element, Force | Torque)})
    for line in right:
        i = index_of(pool.truth, line.name)
        if line.kind in ENERGIES and (line.kind != "Xi" or i is not None):
            shown = _shown(pool, line.kind, i)
            undamped = line.kind == "Xi" and without_dampers(pool.truth, line, i, lines) is not None
            found |= shown & driven if undamped else shown
    return found


def least_opposed(
    pool: Pool,
    found: list[Explanation],
    line: AnsweredLine,
    right: Sequence[AnsweredLine],
    lines: Sequence[AnsweredLine],
    against: Against,
) -> list[Explanation]:
    """The explanations of a line that nothing speaks against; else those that only right lines of its own kind speak
    against, as a slip in one of two T* shows in that one; else all."""
    elsewhere = against.only(contradicted(pool, [x for x in right if x.kind != line.kind], lines))
    return against.unopposed(found) or elsewhere.unopposed(found) or found


def _shown(pool: Pool, kind: str, i: int | None) -> set[int]:
    """The possible mistakes that would be visible in a line, by their identity."""

    def shown() -> set[int]:
        visible = np.abs(_changes(pool, kind, i)).max(axis=1) > 1e-9
        return {id(pool.all[k]) for k in np.flatnonzero(visible)}

    return pool.kept(("shown", kind, i), shown)


def stated(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[list[sp.Expr], Array]:
    """The equations that have a value and say something, left minus right, with their values."""
    exprs = [line.expr for line in lines]
    P = CompiledExpressions(exprs).at(truth.states)
    says = np.isfinite(P).all(axis=1) & (np.abs(P).max(axis=1, initial=0.0) > 1e-12)
    return [e for e, s in zip(exprs, says, strict=True) if s], P[says]
