"""Terms that only say the same in other coordinates, k x/R for k φ where x = R φ: they differ from none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from lagrangian.check.difference import MAX_DIFFERENCES
from lagrangian.check.held import OnConstraints, held
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import Finding, Status, TermDifference
from lagrangian.page.formula import text


def with_terms_put_in(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings without such differences; a line without others is right."""
    on = held(truth)
    return list(findings) if on is None else [_with_terms_put_in(truth, on, f) for f in findings]


def _with_terms_put_in(truth: Reference, on: OnConstraints, finding: Finding) -> Finding:
    if not finding.differences or len(finding.differences) == MAX_DIFFERENCES:
        return finding
    lacking = [_lacking(on, d) for d in finding.differences]
    same = {k for k, x in enumerate(lacking) if zero_everywhere(truth, x)}
    for k, x in enumerate(lacking):
        for j in range(k):
            if not same & {j, k} and zero_everywhere(truth, sp.Add(x, lacking[j])):
                same |= {j, k}
    kept = tuple(d for k, d in enumerate(finding.differences) if k not in same)
    if kept or finding.line.kind != "equation":
        return replace(finding, differences=kept)
    return replace(finding, status=Status.RIGHT, note=text("with the constraint put in"), differences=(), follows=False)


def _lacking(on: OnConstraints, difference: TermDifference) -> sp.Expr:
    """What a line lacks by a difference where the constraints hold."""
    right = sp.S.Zero if difference.kind == "extra" else difference.term
    return on.put_in(sp.Add(right, -difference.written))
