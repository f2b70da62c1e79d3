"""Marks lines without accelerations that only follow from wrong ones above: what is wrong is the same, times a factor.

v = r β̇ + 2 l cos θ − R α̇         θ̇ is missing        L̇ = 2 b cos γ θ̇        for b cos γ θ̇
N = k e + c v                      c times as much     φ̇ = L̇/r = (2 b/r) …    1/r times as much
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.in_own_names import names_in
from lagrangian.check.explain.said_wrongly import said_of
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Finding, Mistake, Status, Verdict
from lagrangian.model import time
from lagrangian.read.letters import key

LONGEST = 120
"""The most operations of what is wrong in a line."""
MOST, MOST_MEANT = 6, 100
"""The most lines that are compared, and the most quantities that a definition may have been meant to be."""
NOT = ", not "
"""What stands between what is right and what is written."""


def with_same_residuals(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict with such lines marked; without the terms that differ from an equation of motion they are none of."""
    open_ones = [f for f in verdict.findings if _is_of_rates(truth, f)]
    if len(open_ones) < 2 or len(open_ones) > MOST:
        return verdict
    wrong = {id(f): _told(truth, f, verdict.mistakes) or list(_wrong(truth, f)) for f in open_ones}
    follow: set[int] = set()
    for k, f in enumerate(open_ones):
        above = [x for x in open_ones[:k] if id(x) not in follow and x.line.number < f.line.number]
        if any(_uses(f, x) and _are_multiples(wrong[id(f)], wrong[id(x)]) for x in above):
            follow.add(id(f))
    findings = tuple(replace(f, follows=True, differences=()) if id(f) in follow else f for f in verdict.findings)
    return replace(verdict, findings=findings) if follow else verdict


def _is_of_rates(truth: Reference, finding: Finding) -> bool:
    """Whether a finding is of a wrong line that says what a quantity or a rate is."""
    line = finding.line
    if finding.status is not Status.WRONG or finding.follows or line.kind not in ("definition", "identity", "equation"):
        return False
    return not line.expr.has(*(c.acceleration for c in truth.model.coordinates))


def _uses(finding: Finding, above: Finding) -> bool:
    """Whether a line has the name of which one above it says what it is, or its rate."""
    name = key((above.line.name or "").rstrip("'"))
    return bool(name) and name in names_in(finding.line)


def _told(truth: Reference, finding: Finding, mistakes: Sequence[Mistake]) -> list[sp.Expr]:
    """What is wrong in a definition as it is told: v is …, not …"""
    for parts in (m.what.parts for m in mistakes if str(m.what).startswith(f"Line {finding.line.number} is not right")):
        for right, middle, written in zip(parts, parts[1:], parts[2:], strict=False):
            if middle == NOT and isinstance(right, sp.Expr) and isinstance(written, sp.Expr):
                return [cast("sp.Expr", truth.expand(written) - truth.expand(right))]
    return []


def _wrong(truth: Reference, finding: Finding) -> Iterator[sp.Expr]:
    """What is wrong in a line: left minus right, or the value less one that it may have been meant to be."""
    line = finding.line
    if line.kind != "definition":
        yield line.expr
        return
    rights = [p.right for p in islice(said_of(truth, line), MOST_MEANT) if p.right is not None]
    yield from (cast("sp.Expr", truth.expand(line.expr) - truth.expand(x)) for x in rights)


def _are_multiples(some: list[sp.Expr], others: list[sp.Expr]) -> bool:
    """Whether one of some expressions is one of others, times a constant factor."""
    for one in some:
        for other in others:
            if 0 in (one, other) or max(map(bounded.operations, (one, other))) > LONGEST:
                continue
            factor = bounded.cancel(cast("sp.Expr", bounded.expand(one) / bounded.expand(other)))
            if factor != 0 and not any(x.args or x == time for x in bounded.letters(factor)):
                return True
    return False
