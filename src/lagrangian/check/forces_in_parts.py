"""Generalized forces that an answer lists element by element: damper: Ξ_z = -c z', soil: Ξ_z = F."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import sympy as sp

from lagrangian import bounded
from lagrangian.check.all_forces import whole_force
from lagrangian.check.difference import differences
from lagrangian.check.reference import Reference
from lagrangian.check.stated import index_of, whole_forces
from lagrangian.check.verdict import AnsweredLine, Finding, Status
from lagrangian.page.formula import Text, text

Terms = Counter[sp.Expr]
"""The terms of a force, each with how often it stands there."""


def with_forces_in_parts(truth: Reference, findings: Sequence[Finding], lines: Sequence[AnsweredLine]) -> list[Finding]:
    """The findings, with those of one Ξ that is stated several times as right ones if Ξ has the terms that they state,
    each in one of them, and is not one of these alone.

    Where some of them are such parts and others are not, those are right, and these are compared with what is left.
    """
    found = list(findings)
    for name in dict.fromkeys(f.line.name for f in findings if f.line.kind == "Xi"):
        at = [k for k, f in enumerate(found) if f.line.kind == "Xi" and f.line.name == name]
        if len(at) < 2 or any(found[k].status is Status.RIGHT for k in at):
            continue
        if all(found[k].status.right for k in at):
            continue
        parts = [_terms(truth, found[k].line.expr) for k in at]
        i = index_of(truth, name)
        summed = replace(found[at[-1]].line, expr=sp.Add(*[found[k].line.expr for k in at]))
        potential = i is None or any(f.line.kind in ("V", "L", "V-slope") for f in findings)
        forces = [*whole_forces(truth, lines, summed), *([] if potential or i is None else [whole_force(truth, i)])]
        rights = [_terms(truth, x) for x in forces]
        if any(_make_up(parts, x) for x in rights):
            note = text("a part of it: all that is listed is the whole force")
            for k in at:
                found[k] = _as_part(found[k], note)
        elif rights and _is_list(truth, found, at):
            _compare_with_rest(truth, found, dict(zip(at, parts, strict=True)), rights[-1])
    return found


def _as_part(finding: Finding, note: Text) -> Finding:
    return replace(finding, status=Status.EQUIVALENT, note=note, differences=(), follows=False)


def _compare_with_rest(truth: Reference, found: list[Finding], parts: dict[int, Terms], right: Terms) -> None:
    """Judge each part of a listed force by itself: right if all of its terms belong to it, otherwise by the terms that
    no right part has and that are in its letters."""
    true = [k for k, part in parts.items() if part and part <= right]
    others = [k for k in parts if k not in true]
    if not true or not others:
        return
    rest = right - sum((parts[k] for k in true), Terms())
    for k in true:
        found[k] = _as_part(found[k], text("a part of it"))
    for k in others:
        line = found[k].line
        near = [x for x in rest if len(others) == 1 or _letters(truth, x) & _letters(truth, line.expr)]
        mine, own = truth.form(line.expr), truth.form(sp.Add(*near))
        told = () if mine is None or own is None else differences(truth, mine, own, sp.S.One, None, line.expr)
        found[k] = replace(found[k], differences=told, follows=False)


def _is_list(truth: Reference, found: Sequence[Finding], at: Sequence[int]) -> bool:
    """Whether forces of one name are a list: nothing else stands between them, and no two hold the same letter."""
    between = all(f.line.kind == "Xi" for f in found[at[0] : at[-1]])
    letters = [_letters(truth, found[k].line.expr) for k in at]
    return between and not any(a & b for a, b in combinations(letters, 2))


def _letters(truth: Reference, expr: sp.Expr) -> set[sp.Basic]:
    """The parameters and inputs in an expression."""
    named = set[sp.Basic](x.symbol for x in (*truth.model.parameters, *truth.model.inputs))
    return named & bounded.letters(truth.expand(expr))


def _terms(truth: Reference, force: sp.Expr) -> Terms:
    """The terms of a force, multiplied out."""
    return Counter(x for x in sp.Add.make_args(bounded.expand(truth.expand(force))) if x != 0)


def _make_up(parts: Sequence[Terms], right: Terms) -> bool:
    """Whether parts have the terms of a force, each once and in one part, and none is empty: nothing cancels."""
    return all(parts) and sum(parts, Terms()) == right
