"""Chooses the mistakes to report: those that explain the first wrong line and as many other lines as possible."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import sympy as sp

from lagrangian.check import say
from lagrangian.check.align import LARGEST, Alignment, alignments
from lagrangian.check.changes.pool import Pool, Possible, pool_of
from lagrangian.check.reference import Reference
from lagrangian.check.search import (
    EXOTIC,
    Explanation,
    OwnTerm,
    Told,
    Vectors,
    by_rows,
    first_explained,
    own_terms,
    singles,
)
from lagrangian.check.stated import dissipation, index_of
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status
from lagrangian.derive.sampling import SETS, Array, CompiledExpressions
from lagrangian.page.formula import text

ENERGIES = ("T", "V", "L", "Xi")
SPARED = 1.0
"""What an explanation gains for every other wrong line that it explains as well."""
UNNATURAL = 8.0
"""An explanation that costs more may be true, but is no help."""
OWN_TERM = text("Go through ∂L/∂ξ̇, its d/dt and ∂L/∂ξ once more, term by term, and mind the signs.")


@dataclass(frozen=True)
class NamedMistakes:
    """The mistakes that explain an answer, as the most likely set; ``others`` explain it as well.

    ``certain``: a single specific mistake explains everything.
    """

    told: tuple[Mistake, ...] = ()
    others: tuple[Mistake, ...] = ()
    certain: bool = False


def mistakes(truth: Reference, lines: Sequence[AnsweredLine], findings: Sequence[Finding]) -> NamedMistakes:
    """Find the mistakes behind the wrong lines; lines that follow from others need no explanation of their own.

    A mistake that would be visible in a line that is right is not considered.
    """
    wrong = [f.line for f in findings if f.status is Status.WRONG and not f.follows]
    if not wrong or not np.isfinite(truth.W).all():
        return NamedMistakes()
    pool = pool_of(truth)
    against = _contradicted(pool, [f.line for f in findings if f.status.right])
    groups = [_of_line(pool, line) for line in wrong if line.kind != "equation"]
    groups = [_likely(found, against) or found for found in groups]  # a slip in one of two lines shows in that one
    combined = {id(f.line) for f in findings if f.status.right and f.coordinate is None}  # sums of right equations
    equations = [line for line in lines if line.kind == "equation" and id(line) not in combined]
    own: list[Mistake] = []
    if any(w.kind == "equation" for w in wrong):
        found, own = _of_equations(pool, equations)
        groups.append(_likely(found, against))
    groups = [g for g in groups if g]
    if not groups:
        return NamedMistakes(tuple(own))
    return _named(pool, groups)


def _likely(found: Sequence[Explanation], against: set[int]) -> list[Explanation]:
    """The explanations that no right line speaks against."""
    return [e for e in found if not any(id(t.mistake) in against for t in e.told)]


def _of_equations(pool: Pool, equations: Sequence[AnsweredLine]) -> tuple[list[Explanation], list[Mistake]]:
    """The explanations of all equations together; if there is none, the terms of their own that are wrong."""
    exprs = [line.expr for line in equations]
    P = CompiledExpressions(exprs).at(pool.truth.states)
    says = np.isfinite(P).all(axis=1) & (np.abs(P).max(axis=1, initial=0.0) > 1e-12)
    exprs, P = [e for e, s in zip(exprs, says, strict=True) if s], P[says]
    found = alignments(pool.truth, exprs, P)
    if any(np.abs(a.rest).max() <= 1e-9 for a in found):
        return [], []  # what is wrong is too small to be seen in doubles
    explained = first_explained(pool, found) or by_rows(pool, found)
    if explained and len(explained[0].told) == 1 and explained[0].cost <= EXOTIC:
        return explained, []
    own = own_terms(pool, exprs, P, found)
    if own is not None and (not explained or sum(t.cost for t in own) + len(own) - 1 < explained[0].cost):
        return [], [_own_term(pool.truth, t) for t in own]
    return [e for e in explained if e.cost <= UNNATURAL], []


def _own_term(truth: Reference, own: OwnTerm) -> Mistake:
    """A term of the answer's own that is too much or missing, or has the wrong sign or number."""
    name, t = truth.model.coordinates[own.row].name, own.term
    brief = text("A term of the equation of ", truth.derivation.coordinates[own.row], " is not right.")
    if own.forgotten:
        what = text("The term ", t, " is missing: there is one like it with sine and cosine the other way round.")
        return Mistake("term_forgotten", what, OWN_TERM, 5, None, name, brief)
    if own.times == 2:
        return Mistake("sign_of_a_term", text("The term ", t, " has the wrong sign."), OWN_TERM, 5, None, name, brief)
    if own.times == 1:
        return Mistake("term_too_much", text("The term ", t, " is too much."), OWN_TERM, 5, None, name, brief)
    number = 1 - sp.Rational(own.times.numerator, own.times.denominator)
    what = text("The term ", t, " should be ", number * t, ".")
    return Mistake("factor_of_a_term", what, OWN_TERM, 5, None, name, brief)


def _contradicted(pool: Pool, right: Sequence[AnsweredLine]) -> set[int]:
    """The possible mistakes that would be visible in a line that is right, by their identity."""
    found: set[int] = set()
    for line in right:
        i = index_of(pool.truth, line.name)
        if line.kind in ENERGIES and (line.kind != "Xi" or i is not None):
            found |= _shown(pool, line.kind, i)
    return found


def _shown(pool: Pool, kind: str, i: int | None) -> set[int]:
    """The possible mistakes that would be visible in a line, by their identity."""

    def shown() -> set[int]:
        visible = np.abs(_changes(pool, kind, i)).max(axis=1) > 1e-9
        return {id(pool.all[k]) for k in np.flatnonzero(visible)}

    return pool.kept(("shown", kind, i), shown)


def _changes(pool: Pool, kind: str, i: int | None) -> Array:
    """What every possible mistake adds to a line."""
    if kind == "Xi":
        return pool.Xi[:, i]
    if kind == "T":
        return pool.T
    return pool.kept(("line", kind), lambda: _without_constant(pool.V if kind == "V" else pool.L))


def _of_line(pool: Pool, line: AnsweredLine) -> list[Explanation]:
    """The mistakes that lead to a line of T*, V, L, D or a Ξ, the most likely first."""
    truth, i = pool.truth, index_of(pool.truth, line.name)
    if line.kind == "D":
        rest = line.expr - dissipation(truth)
        values = CompiledExpressions([-rest.diff(c.rate) for c in truth.model.coordinates]).at(truth.states)
        return (
            singles(pool, pool.Xi, values)
            if np.isfinite(values).all() and 1e-12 < np.abs(values).max() < LARGEST
            else []
        )
    if line.kind not in ENERGIES or (line.kind == "Xi" and i is None):
        return []
    right = {"T": truth.T, "V": truth.V, "L": truth.L}.get(line.kind)
    if right is None:
        assert i is not None
        right = truth.Xi[i]
    values = CompiledExpressions([line.expr - right]).at(truth.states)[0]
    if not np.isfinite(values).all() or np.abs(values).max() > LARGEST:
        return []
    change = _changes(pool, line.kind, i)
    values = _without_constant(values) if line.kind in ("V", "L") else values
    if np.abs(values).max() <= 1e-12:
        return []
    found = singles(pool, change, values)
    if found:
        return found
    vectors: Vectors = pool.kept(("vectors", line.kind, i), lambda: Vectors(pool, change))
    return vectors.pairs(values)


def _without_constant(values: Array) -> Array:
    """Values minus the value at the first state with the same parameters."""
    shaped = values.reshape(*values.shape[:-1], SETS, -1)
    return (shaped - shaped[..., :1]).reshape(values.shape)


def _named(pool: Pool, groups: Sequence[Sequence[Explanation]]) -> NamedMistakes:
    """One mistake that explains every group, otherwise the best for each group in turn."""

    def key(t: Told) -> tuple[float, ...]:
        return pool.key(t.mistake, float(t.times))

    held = [{key(e.told[0]) for e in g if len(e.told) == 1} for g in groups]

    def reach(e: Explanation) -> float:
        """The cost of an explanation, less what it spares in the other groups."""
        shared = sum(key(e.told[0]) in h for h in held) - 1 if len(e.told) == 1 else 0
        return e.cost - SPARED * shared

    chosen: list[tuple[Told, Alignment | None]] = []
    others: list[Explanation] = []
    for group in groups:
        known = {key(t) for t, _ in chosen}
        if any(len(e.told) == 1 and key(e.told[0]) in known for e in group):
            continue
        holding = [e for e in group if known & {key(t) for t in e.told}]
        best = min(
            holding or group, key=lambda e: (sum(key(t) not in known for t in e.told) if holding else 0, reach(e))
        )
        if not chosen:
            others = [e for e in group if e is not best and len(e.told) == len(best.told) == 1]
            others = [e for e in others if reach(e) < reach(best) + SPARED]
        chosen += [(t, best.under) for t in best.told if key(t) not in known]
    every = [_mistake(pool.truth, t, a) for t, a in chosen]
    told = tuple(
        {(m.name, m.element, m.coordinate) if m.element else str(m.what): m for m in reversed(every)}.values()
    )[::-1]
    more = _once([_mistake(pool.truth, t, e.under) for e in others[:8] for t in e.told], told)
    return NamedMistakes(told, more[:5], len(chosen) == 1 and chosen[0][0].mistake.wrong is not None)


def _mistake(truth: Reference, told: Told, under: Alignment | None) -> Mistake:
    """A possible mistake in words."""
    possible: Possible = told.mistake
    if possible.wrong is not None:
        return possible.wrong.mistake(truth)
    assert possible.change is not None
    row = possible.change.site.coordinate
    factor = under.factor(truth, row) if under is not None and row is not None else None
    return say.mistake(possible.change, told.times, truth.model, factor)


def _once(mistakes: Sequence[Mistake], told: Sequence[Mistake]) -> tuple[Mistake, ...]:
    """Every mistake once, without those that are already reported."""
    said = {str(m.what) for m in told}
    kept: list[Mistake] = []
    for m in mistakes:
        if str(m.what) not in said:
            said.add(str(m.what))
            kept.append(m)
    return tuple(kept)
