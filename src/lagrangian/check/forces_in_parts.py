"""Generalized forces that an answer lists element by element: damper: Ξ_z = -c z', soil: Ξ_z = F."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from lagrangian.check.all_forces import whole_force
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import index_of
from lagrangian.check.verdict import Finding, Status
from lagrangian.page.formula import text


def with_forces_in_parts(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with those of one Ξ that is stated several times as right ones if Ξ is the sum of what they state,
    and not one of these alone."""
    found = list(findings)
    for name in dict.fromkeys(f.line.name for f in findings if f.line.kind == "Xi"):
        at = [k for k, f in enumerate(found) if f.line.kind == "Xi" and f.line.name == name]
        i = index_of(truth, name)
        if len(at) < 2 or i is None or any(found[k].status is Status.RIGHT for k in at):
            continue
        total = sp.Add(*(found[k].line.expr for k in at))
        rights = (
            [truth.Xi[i]] if any(f.line.kind in ("V", "L") for f in findings) else [truth.Xi[i], whole_force(truth, i)]
        )
        if all(found[k].status.right for k in at) or not any(zero_everywhere(truth, total - x) for x in rights):
            continue
        note = text("a part of it: all that is listed is the whole force")
        for k in at:
            found[k] = replace(found[k], status=Status.EQUIVALENT, note=note, differences=(), follows=False)
    return found
