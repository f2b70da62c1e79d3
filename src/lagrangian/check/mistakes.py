"""Chooses the mistakes to report: those that explain the first wrong line and as many other lines as possible."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lagrangian.check.candidates import Effects, Wrong, effects_of
from lagrangian.check.explain import Explanation, explain_rows
from lagrangian.check.own_terms import wrong_term
from lagrangian.check.reference import Reference
from lagrangian.check.rows import DOUBLE_TOLERANCE
from lagrangian.check.stated import dissipation, index_of
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status
from lagrangian.derive.sampling import SETS, Array, CompiledExpressions


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

    A mistake that would be visible in a line that is right is considered last.
    """
    wrong = [f.line for f in findings if f.status is Status.WRONG and not f.follows]
    if not wrong:
        return NamedMistakes()
    groups: list[list[Explanation]] = []
    for line in [w for w in wrong if w.kind != "equation"]:
        groups.append([Explanation((w,), 0) for w in _explain_line(truth, line)])
    if any(w.kind == "equation" for w in wrong):
        exprs = [line.expr for line in lines if line.kind == "equation"]
        explained = explain_rows(truth, exprs)
        far = not explained or len(explained[0].wrongs) > 1 or explained[0].plainness == 3
        if far and not any(groups):
            own = [f for f in findings if f.status is Status.WRONG and f.line.kind == "equation"]
            found = [wrong_term(truth, f.line.expr, f.coordinate) for f in own]
            if all(m is not None for m in found):
                return NamedMistakes(tuple(m for m in found if m is not None))
        groups.append(explained)
    if not (groups := [g for g in groups if g]):
        return NamedMistakes()
    against = _contradicted(truth, [f.line for f in findings if f.status.right])
    groups = [sorted(g, key=lambda e: any(w in against for w in e.wrongs)) for g in groups]
    return _named(truth, groups, against)


def _contradicted(truth: Reference, right: Sequence[AnsweredLine]) -> set[Wrong]:
    """The variants that would be visible in a line that is right."""
    found: set[Wrong] = set()
    for line in right:
        if line.kind in ("T", "V", "L", "Xi"):
            i = index_of(truth, line.name)
            if line.kind == "Xi" and i is None:
                continue
            change = _changes(effects_of(truth), line.kind, i)
            if line.kind in ("V", "L"):
                change = _without_constant(change)
            shown = np.abs(np.where(np.isfinite(change), change, 0)).max(axis=1) > 1e-9
            found.update(effects_of(truth).wrongs[k] for k in np.flatnonzero(shown))
    return found


def _named(truth: Reference, groups: Sequence[Sequence[Explanation]], against: set[Wrong]) -> NamedMistakes:
    """One mistake that explains every group, otherwise the best for each group in turn."""
    held = [{w for e in g if len(e.wrongs) == 1 for w in e.wrongs} for g in groups]
    shared = set.intersection(*held) if all(held) else set()
    first = [e for e in groups[0] if e.wrongs[0] in shared and len(e.wrongs) == 1] if shared else list(groups[0])
    best = first[0]
    told = [w.mistake(truth) for w in best.wrongs]
    if not shared:
        for group in groups[1:]:
            if not any(w in best.wrongs for e in group for w in e.wrongs):
                told += [w.mistake(truth) for w in group[0].wrongs]
    others = _once([w.mistake(truth) for e in first[1:] for w in e.wrongs if w not in against], told)
    single = (bool(shared) or len(groups) == 1) and len(best.wrongs) == 1
    certain = single and best.plainness < 2 and not best.wrongs[0].general and best.wrongs[0] not in against
    return NamedMistakes(tuple(told), others[:5], certain)


def _once(mistakes: Sequence[Mistake], told: Sequence[Mistake]) -> tuple[Mistake, ...]:
    """Every misconception once, without those that are already reported."""
    names = {m.name for m in told}
    kept: list[Mistake] = []
    for m in mistakes:
        if m.name not in names:
            names.add(m.name)
            kept.append(m)
    return tuple(kept)


def _explain_line(truth: Reference, line: AnsweredLine) -> list[Wrong]:
    """The variants that lead to a line of T*, V, L or a Ξ, the most likely first."""
    i = index_of(truth, line.name)
    if line.kind == "D":
        return _explain_dissipation(truth, line)
    if line.kind not in ("T", "V", "L", "Xi") or (line.kind == "Xi" and i is None):
        return []
    effects = effects_of(truth)
    right = {"T": truth.T, "V": truth.V, "L": truth.L}.get(line.kind)
    if right is None:
        assert i is not None
        right = truth.Xi[i]
    rest = CompiledExpressions([line.expr - right]).at(truth.states)[0]
    if not np.isfinite(rest).all():
        return []
    change = _changes(effects, line.kind, i)
    if line.kind in ("V", "L"):
        rest, change = _without_constant(rest), _without_constant(change)
    scale = max(float(np.abs(rest).max()), 1e-300)
    fits = np.logical_and(effects.usable, np.abs(change - rest).max(axis=1) <= DOUBLE_TOLERANCE * scale)
    found = [effects.wrongs[k] for k in np.flatnonzero(fits)]
    return sorted(found, key=lambda w: (w.general, w.variant.doubt, w.rank))


def _explain_dissipation(truth: Reference, line: AnsweredLine) -> list[Wrong]:
    """The variants for which ΔΞ = −∂ΔD/∂ξ̇."""
    effects = effects_of(truth)
    rest = line.expr - dissipation(truth)
    change = CompiledExpressions([-rest.diff(c.rate) for c in truth.model.coordinates]).at(truth.states)
    if not np.isfinite(change).all():
        return []
    scale = max(float(np.abs(change).max()), 1e-300)
    fits = np.logical_and(effects.usable, np.abs(effects.Xi - change).max(axis=(1, 2)) <= DOUBLE_TOLERANCE * scale)
    found = [effects.wrongs[k] for k in np.flatnonzero(fits)]
    return sorted(found, key=lambda w: (w.general, w.variant.doubt, w.rank))


def _changes(effects: Effects, kind: str, i: int | None) -> Array:
    if kind == "Xi":
        return effects.Xi[:, i]
    return {"T": effects.T, "V": effects.V, "L": effects.L}[kind]


def _without_constant(values: Array) -> Array:
    """Values minus the value at the first state with the same parameters."""
    shaped = values.reshape(*values.shape[:-1], SETS, -1)
    return (shaped - shaped[..., :1]).reshape(values.shape)
