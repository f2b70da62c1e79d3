"""Finds that constraints on velocities were put into T* before it was differentiated.

An answer says so if its equations hold for the motion that such equations give, and not for the right one. Which other
mistake leads to the same equations does not matter: this one is named first.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.answer_on_rows import AnswerAt, AnswerOnRows
from lagrangian.check.constraints.constrained import (
    SMALL,
    STATES,
    check_constrained,
    consistent,
    expanded,
    in_coordinates,
    unknown_names,
)
from lagrangian.check.constraints.determined import of_lines
from lagrangian.check.constraints.put_in import PutIn, ways_to_put_in
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, Verdict
from lagrangian.model import time
from lagrangian.model.elements.base import T
from lagrangian.model.rows import rows_of
from lagrangian.page.formula import Left, Name, Text, text

NAME = "constraint_put_in_too_early"

STEP = 4
"""The step after which the derivatives are taken."""

MOST_SAID = 4
"""The most equations whose lost terms are written out."""

MOVED = 1e-6
"""The relative change of the accelerations above which a motion is another one."""

ENERGY = text("its value is right where the constraint holds; the equations do not follow from it alone")


def energies_on_rows(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict, hint: int) -> Verdict:
    """The verdict on an answer with right equations whose T* or L holds only where constraints on velocities do.

    Such an energy is right as a value. Equations of motion that are right were not derived from it alone.
    """
    named = [f for f in verdict.findings if f.line.kind in ("T", "L") and not f.status.right]
    equations = [line for line in lines if line.kind not in ("T", "L")]
    if not named or not any(line.kind == "equation" for line in equations) or not _on_velocities(truth):
        return verdict
    if not all(f.status.right for f in verdict.findings if f not in named) or not _hold_on_rows(truth, lines):
        return verdict
    without = check_constrained(truth, equations, hint)
    if not without.right:
        return verdict
    found = [
        replace(f, status=Status.EQUIVALENT, note=ENERGY, differences=()) if f in named else f for f in verdict.findings
    ]
    status = Status.EQUIVALENT if without.status is Status.RIGHT else without.status
    return replace(verdict, status=status, findings=tuple(found), notes=without.notes)


def with_rows_put_in(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer, with this mistake named first if it explains the answer."""
    wrong = [f for f in verdict.findings if f.line.kind in ("T", "L", "equation") and f.status is Status.WRONG]
    if verdict.status is not Status.WRONG or not wrong or not _on_velocities(truth):
        return verdict
    found = _found(truth, in_coordinates(truth, lines))
    if found is None:
        return verdict
    energy = next((f.line.number for f in verdict.findings if f.line.kind in ("T", "L") and not f.status.right), None)
    findings: list[Finding] = []
    for f in verdict.findings:
        if f.line.kind in ("T", "L", "equation") and not f.status.right:
            follows = f.line.kind == "equation" and energy is not None and energy < f.line.number
            f = replace(f, differences=(), follows=follows)
        findings.append(f)
    others = [m for m in (*verdict.mistakes, *verdict.alternatives) if m.name != NAME]
    return replace(
        verdict, findings=tuple(findings), mistakes=(_mistake(found),), alternatives=tuple(others[:5]), sure=True
    )


def _on_velocities(truth: Reference) -> bool:
    return any(row.position is None for row in rows_of(truth.model))


def _hold_on_rows(truth: Reference, lines: Sequence[AnsweredLine]) -> bool:
    """Whether every T* and L has the right value, but for a constant, where the constraints hold."""
    named = [line for line in in_coordinates(truth, lines) if line.kind in ("T", "L")]
    right = {"T": truth.T, "L": truth.L}
    rests = [replace(line, kind="equation", expr=_moving(truth, line, line.expr - right[line.kind])) for line in named]
    if unknown_names(expanded(truth), rests):
        return False
    places = list(_places(truth, rests, ()))
    values = np.array([place.value for place in places])
    sizes = np.array([1.0 + np.abs(place.size) for place in places])
    kinetic = np.array([line.kind == "T" for line in named])
    if not len(values) or not np.isfinite(values).all():
        return False
    values = values - np.where(kinetic, 0.0, values[0])
    return bool((np.abs(values) <= SMALL * sizes).all())


def _moving(truth: Reference, line: AnsweredLine, rest: sp.Expr) -> sp.Expr:
    """What an energy has more than the right one; of L without constants, as the level of V is free."""
    if line.kind == "T":
        return rest
    moving = [time, *(c.symbol for c in truth.model.coordinates)]
    return sp.Add(*(x for x in sp.Add.make_args(bounded.expand(rest)) if x.has(*moving)))


def _places(truth: Reference, lines: Sequence[AnsweredLine], unknown: Sequence[Any]) -> Iterator[AnswerAt]:
    answer = AnswerOnRows(truth, lines, unknown)
    for here in answer.states(STATES, given=False):
        yield answer.at(here)


def _found(truth: Reference, lines: Sequence[AnsweredLine]) -> PutIn | None:
    """The way in which rows were put in that explains all lines."""
    if any(line.kind in ("T", "L") for line in lines) and not _hold_on_rows(truth, lines):
        return None
    equations = [line for line in lines if line.kind == "equation"]
    unknown = unknown_names(expanded(truth), equations)
    if len(unknown) > len(truth.derivation.multipliers):
        return None
    rates = {c.rate for c in truth.model.coordinates}
    stated = [line.expr + (truth.V if line.kind == "L" else 0) for line in lines if line.kind in ("T", "L")]
    used = {x for line in lines for x in rates & line.expr.atoms(sp.Derivative)}
    ways = sorted(ways_to_put_in(truth, stated), key=lambda x: (x.kept != bool(unknown), not used <= {*x.speeds}))
    harmful: set[tuple[str, ...]] = set()
    for way in ways:
        names = tuple(row.name for row in way.rows)
        if way.partly and names not in harmful:
            continue
        moved = _motions(truth, way, equations, unknown)
        if moved is None:
            continue
        harmful.add(names)
        if consistent(moved, range(len(equations))):
            return way
    return None


def _motions(
    truth: Reference, way: PutIn, equations: Sequence[AnsweredLine], unknown: Sequence[Any]
) -> list[AnswerAt] | None:
    """The equations of an answer with the accelerations that follow where rows were put in; None where these are right.

    They are right, too, where rows can be integrated.
    """
    own = [m.symbol for m in truth.derivation.multipliers.values()]
    every = list(dict.fromkeys([*unknown, *own]))
    put = [AnsweredLine("equation", x, 0) for x in way.equations()]
    count = len(equations)
    places = list(_places(truth, [*equations, *put], every))
    moved = [_moved(p, slice(count, None), [every.index(x) for x in own]) for p in places]
    shifts = [x for x in moved if x is not None]
    if not shifts or len(shifts) < len(places) or max(np.abs(x).max() for x in shifts) <= MOVED:
        return None
    ours = [of_lines(place, slice(0, count), [every.index(x) for x in unknown]) for place in places]
    return [replace(p, value=p.value + p.by_acceleration @ x) for p, x in zip(ours, shifts, strict=True)]


def _moved(place: AnswerAt, rows: slice, columns: Sequence[int]) -> np.ndarray | None:
    """How far the accelerations by other equations are from the right ones; None if they determine none.

    Both satisfy the constraints, so that A δξ̈ = 0.
    """
    n, m = len(place.mass), len(columns)
    upper = np.hstack([place.by_acceleration[rows], place.by_multiplier[rows][:, list(columns)]])
    held = [k for k in range(m) if np.abs(upper[:, n + k]).max(initial=0.0) > 0]
    upper = np.hstack([upper[:, :n], upper[:, [n + k for k in held]]])
    whole = np.vstack([upper, np.hstack([place.rows, np.zeros((len(place.rows), len(held)))])])
    right = np.concatenate([-place.value[rows], np.zeros(len(place.rows))])
    if not (np.isfinite(whole).all() and np.isfinite(right).all()) or np.linalg.matrix_rank(whole) < n + len(held):
        return None
    found, *_ = np.linalg.lstsq(whole, right, rcond=None)
    return np.asarray(found[:n], float)


# -- in words ---------------------------------------------------------------------------------------------------------


def _mistake(way: PutIn) -> Mistake:
    titles = list(dict.fromkeys(row.element.title for row in way.rows))
    which = titles[0] if len(titles) == 1 else "constraints on velocities"
    were = "was" if len(titles) == 1 else "were"
    first: list[Left | str] = [f"The {which} {were} put into ", T, " before it was differentiated."]
    first += _lost(way)
    brief = text(f"The {which} {were} used too early, before the derivatives were taken.")
    return Mistake(
        NAME, text(*first), _why(which, len(titles) > 1), STEP, titles[0] if len(titles) == 1 else None, None, brief
    )


def _lost(way: PutIn) -> list[Left | str]:
    """The terms that are lost, or the equations that lack some where these are long."""
    lost = list(way.lost())[:MOST_SAID]
    said: list[Left | str] = []
    if any(terms is None for _, terms in lost):
        for name, _ in lost:
            said += [", " if said else "", name]
        return [" So terms with products of rates are lost on the left-hand sides of the equations of ", *said, "."]
    for name, terms in lost:
        said += [", " if said else "", *([terms] if terms is not None else []), " in the equation of ", name]
    taken = "; a multiplier takes up whatever else differs." if way.kept else "."
    return [" So these terms are lost on the left-hand sides: ", *said, taken] if said else []


def _why(which: str, several: bool) -> Text:
    they = "they cannot all" if several else "it cannot"
    return text(
        "Differentiate first, then put the rates in. The derivatives of ",
        Name("L"),
        f" compare the motion with neighbours that break the {which}, and {they} be integrated to a "
        "relation between the coordinates. So to leave out a rate leaves out no coordinate.",
    )
