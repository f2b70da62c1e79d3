"""The parts of T*, or of V, that an answer lists and never adds up: each against the energy of what it is of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.meant import kinds_of
from lagrangian.check.reading.carried_out.added_up import is_piece
from lagrangian.check.reading.summed_energies import ADDED, things_with
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import harmless
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict, inserted
from lagrangian.read.letters import key

_KINDS = {"T": "kinetic", "V": "potential"}
"""The kinds of quantities of which the names of their parts are."""
_Group: TypeAlias = tuple[frozenset[int], frozenset[str]]


def is_added(line: AnsweredLine) -> bool:
    """Whether a line is the sum of listed parts, which the answer does not write."""
    return line.text in ADDED.values()


def without_made_names(lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines without listed parts, of which nobody else uses the names, without pieces that a program adds, and
    without slopes that the reader named: so nothing is told in these names."""
    listed = frozenset[str]().union(*(x.names for x in lines if is_added(x)))

    def is_made(name: str) -> bool:
        return is_piece(name) or name.endswith("slope") or key(name) in listed

    return tuple(x for x in lines if x.kind != "definition" or not is_made(x.name or ""))


def with_parts_judged(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict with a finding for each part that was added up; if one is wrong, the sum follows from it.

    An energy is a sum of terms, each with one inertia, stiffness or weight as a factor: a part is right if it has all
    terms with the letters of its body, or of its springs. A constant in V is no mistake.
    """
    findings = list(verdict.findings)
    for whole in [f for f in findings if f.line.kind in ADDED]:
        listed = is_added(whole.line)
        named = [x for x in lines if x.kind == "definition" and key(x.name or "") in whole.line.names]
        parts = [x for x in named if listed or is_piece(x.name)]
        if not parts and not whole.follows and not whole.status.right and not truth.values:
            findings = _with_wrong_part(truth, lines, findings, whole)
        if len(parts) < 2 or len({key(x.name or "") for x in parts}) != len(parts):
            continue
        status = {} if truth.values else _judged(truth, whole.line, parts)
        told = {(f.line.number, f.line.text): f.status for f in findings if f.line.kind == "definition"}
        blamed = [x for x in parts if told.get((x.number, x.text)) is Status.WRONG]
        if whole.status.right:
            status = {k: x for k, x in status.items() if x.right and listed}
        wrong = [k for k, x in status.items() if not x.right]
        differing = whole.differences if len(wrong) == 1 and not blamed else ()
        for k, its in status.items():
            if (parts[k].number, parts[k].text) not in told and (listed or not its.right):
                findings = inserted(findings, Finding(parts[k], its, None, None, () if its.right else differing))
        if (wrong or blamed) and not whole.status.right:
            findings = [replace(f, follows=True, differences=()) if f is whole else f for f in findings]
    return replace(verdict, findings=tuple(findings))


def _with_wrong_part(
    truth: Reference, lines: Sequence[AnsweredLine], findings: list[Finding], whole: Finding
) -> list[Finding]:
    """The findings with the one wrong part of a sum that the answer writes, T = T1 + T2, and its other parts."""
    parts = _added_in(truth, lines, whole.line)
    told = {(f.line.number, f.line.text) for f in findings if f.line.kind == "definition" and not f.status.right}
    right = truth.expand(getattr(truth, whole.line.kind))
    wrong = _only_wrong(truth, whole.line.kind, right, {k: x.expr for k, x in enumerate(parts)})
    if wrong is None or told & {(x.number, x.text) for x in parts}:
        return findings
    known = {(f.line.number, f.line.text) for f in findings}
    for k, x in enumerate(parts):
        new = Finding(x, Status.WRONG, None, None, whole.differences) if k == wrong else Finding(x, Status.RIGHT)
        findings = inserted(findings, new) if (x.number, x.text) not in known else findings
    return [replace(f, follows=True, differences=()) if f is whole else f for f in findings]


def _judged(truth: Reference, whole: AnsweredLine, parts: Sequence[AnsweredLine]) -> dict[int, Status]:
    """Whether each part is right, by its place; not of those that share a letter, if their sum is wrong."""
    found: dict[int, Status] = {}
    for chosen, right in _right_parts(truth, whole.kind, parts):
        rest = cast("sp.Expr", sp.Add(*[parts[k].expr for k in chosen]) - right)
        is_right = zero_everywhere(truth, rest) or harmless(truth, replace(whole, expr=rest), rest) is not None
        if is_right or len(chosen) == 1:
            found |= dict.fromkeys(chosen, Status.RIGHT if is_right else Status.WRONG)
        elif (wrong := _only_wrong(truth, whole.kind, right, {k: parts[k].expr for k in chosen})) is not None:
            found |= {k: Status.WRONG if k == wrong else Status.RIGHT for k in chosen}
    return found


def _only_wrong(truth: Reference, kind: str, right: sp.Expr, parts: Mapping[int, sp.Expr]) -> int | None:
    """The place of the one part that is no sum of whole terms of an energy, where all others are, each of other terms;
    None if there is no such part, or if it may not be what lacks the terms that are left.

    Each term that is left has the rates of one that is written there, and its inertia, stiffness or weight.
    """
    left, wrong = _terms(truth, right), list[int]()
    for k, expr in parts.items():
        own = _terms(truth, expr)
        if own <= left:
            left -= own
        else:
            wrong.append(k)
    if len(wrong) != 1 or not left:
        return None
    rates = {c.rate for c in truth.model.coordinates}
    letters = frozenset[str]().union(*things_with(truth.model, kind))

    def of(term: sp.Basic) -> tuple[sp.Basic, frozenset[str]]:
        moving = cast("sp.Expr", term).as_independent(*rates, as_Add=False)[1]
        return moving, letters & {key(str(x)) for x in bounded.letters(term)}

    written = {of(t) for t in _terms(truth, parts[wrong[0]])}
    return wrong[0] if letters and {of(t) for t in left} <= written else None


def _terms(truth: Reference, expr: sp.Expr) -> set[sp.Expr]:
    """The terms of a sum, multiplied out."""
    return {*sp.Add.make_args(bounded.expand(truth.expand(expr)))} - {sp.S.Zero}


def parts_in_whole_terms(truth: Reference, lines: Sequence[AnsweredLine]) -> list[AnsweredLine]:
    """The definitions that are right parts of a T*, or of a V, that is wrong in one other part alone, whatever their
    names may mean: m R² φ'² of all that is carried around is no wrong energy of one of two bodies."""
    found: list[AnsweredLine] = []
    for whole in [x for x in lines if x.kind in ADDED] if not truth.values else ():
        parts = _added_in(truth, lines, whole)
        wrong = _only_wrong(truth, whole.kind, getattr(truth, whole.kind), {k: x.expr for k, x in enumerate(parts)})
        found += [x for k, x in enumerate(parts) if k != wrong] if wrong is not None else []
    return found


def _added_in(truth: Reference, lines: Sequence[AnsweredLine], whole: AnsweredLine) -> list[AnsweredLine]:
    """The definitions above a T*, or a V, of which it is the sum; none if it is none."""
    above = [x for x in lines if x.kind == "definition" and x.number <= whole.number]
    own = [x for x in above if key(x.name or "") in whole.names and kinds_of(x.name or "") == (_KINDS[whole.kind],)]
    alike = len({x.name for x in own}) < len(own) or len(own) < 2
    return [] if alike or not zero_everywhere(truth, sp.Add(*[x.expr for x in own], -whole.expr)) else own


def _right_parts(truth: Reference, kind: str, parts: Sequence[AnsweredLine]) -> list[tuple[frozenset[int], sp.Expr]]:
    """Groups of parts with what each group should add up to; none if some thing has no part, or some term no group."""
    energy = truth.expand(getattr(truth, kind))
    things = things_with(truth.model, kind)
    own = frozenset[str]().union(*things)
    groups = [
        (frozenset([k]), own & {key(str(a)) for a in bounded.letters(truth.expand(x.expr))})
        for k, x in enumerate(parts)
    ]
    groups = _joined(groups, list(own))
    for thing in things:
        if not any(thing & held for _, held in groups):
            return []
        if lacking := thing.difference(*(held for _, held in groups)):  # T_arm without the mass of the arm
            groups = [(g, held | lacking if held & thing else held) for g, held in groups]
            groups = _joined(groups, list(lacking))
    letters = {key(str(x)): x for x in bounded.letters(energy)}
    found: list[tuple[frozenset[int], sp.Expr]] = []
    for chosen, held in groups:
        others = [letters[x] for x in own - held if x in letters]
        found.append((chosen, cast("sp.Expr", energy.subs(dict.fromkeys(others, 0)))))
    return found if zero_everywhere(truth, sp.Add(*[x for _, x in found]) - energy) else []


def _joined(groups: Sequence[_Group], letters: Sequence[str]) -> list[_Group]:
    """Groups of parts, of which those that share a letter are one."""
    for x in letters:
        same = [g for g in groups if x in g[1]]
        if len(same) > 1:
            one = frozenset[int]().union(*(g for g, _ in same)), frozenset[str]().union(*(h for _, h in same))
            groups = [*(g for g in groups if x not in g[1]), one]
    return list(groups)


def without_added(verdict: Verdict) -> Verdict:
    """The verdict without the sums that the answer does not write, unless nothing else says what is wrong in one."""
    kept = tuple(f for f in verdict.findings if not is_added(f.line) or not (f.status.right or f.follows))
    return replace(verdict, findings=kept)
