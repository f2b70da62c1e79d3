"""Generalized forces that an answer lists element by element: damper: Ξ_z = -c z', soil: Ξ_z = F."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.all_forces import whole_force
from lagrangian.check.reference import Reference
from lagrangian.check.stated import index_of
from lagrangian.check.verdict import Finding, Status
from lagrangian.page.formula import text


def with_forces_in_parts(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with those of one Ξ that is stated several times as right ones if Ξ has the terms that they state,
    each in one of them, and is not one of these alone."""
    found = list(findings)
    for name in dict.fromkeys(f.line.name for f in findings if f.line.kind == "Xi"):
        at = [k for k, f in enumerate(found) if f.line.kind == "Xi" and f.line.name == name]
        i = index_of(truth, name)
        if len(at) < 2 or i is None or any(found[k].status is Status.RIGHT for k in at):
            continue
        parts = [_terms(truth, found[k].line.expr) for k in at]
        potential = any(f.line.kind in ("V", "L", "V-slope") for f in findings)
        rights = [_terms(truth, x) for x in ([truth.Xi[i]] if potential else [truth.Xi[i], whole_force(truth, i)])]
        if all(found[k].status.right for k in at) or not any(_make_up(parts, x) for x in rights):
            continue
        note = text("a part of it: all that is listed is the whole force")
        for k in at:
            found[k] = replace(found[k], status=Status.EQUIVALENT, note=note, differences=(), follows=False)
    return found


def _terms(truth: Reference, force: sp.Expr) -> Counter[sp.Expr]:
    """The terms of a force, multiplied out."""
    return Counter(x for x in sp.Add.make_args(bounded.expand(truth.expand(force))) if x != 0)


def _make_up(parts: Sequence[Counter[sp.Expr]], right: Counter[sp.Expr]) -> bool:
    """Whether parts have the terms of a force, each once and in one part, and none is empty: nothing cancels."""
    return all(parts) and sum(parts, Counter[sp.Expr]()) == right
