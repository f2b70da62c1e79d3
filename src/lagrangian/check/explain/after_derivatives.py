"""Which wrong equations follow from a wrong derivative above them: ∂V/∂θ = −m g l cos θ, put into the equation of θ.

Equation i is d/dt ∂L/∂ξ̇_i − ∂L/∂ξ_i − Ξ_i = 0: what a derivative has too much, the equation has too much as well.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import alignments
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import StatedQuantity, dissipation, given, index_of, right_value, spanned
from lagrangian.check.verdict import DERIVED, OWN_DERIVATIVES, AnsweredLine, Finding, Status
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import time
from lagrangian.page.formula import text

SMALL = 1e-9
"""The relative size of a difference that is rounding."""


def follow_from_derivatives(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with the equations marked that have exactly what a wrong derivative above them has too much, and
    the d/dt ∂L/∂ξ̇ that are the derivative of a wrong ∂L/∂ξ̇ above them."""
    findings = _of_momenta(truth, findings)
    derived = [f for f in findings if f.line.kind in ("p", *DERIVED) and f.is_open]
    rows = [f for f in findings if f.line.kind == "equation" and f.is_open]
    both = list(_of_both(truth, findings)) if rows else []
    if not (derived or both) or not rows:
        return findings
    extra = [x for f in derived for x in _extra(truth, f)]
    values = CompiledExpressions([f.line.expr for f in rows]).at(truth.states)
    follow: set[int] = set()
    for f, P in zip(rows, values, strict=True):
        above = [(i, r) for number, i, r in extra if number <= f.line.number]
        if np.isfinite(P).all() and any(n <= f.line.number and spanned(P[None], x) for n, x in both):
            follow.add(id(f))
        if np.isfinite(P).all() and any(_has(truth, f, P, i, r) for i, r in above):
            follow.add(id(f))
    return [replace(f, follows=True) if id(f) in follow else f for f in findings]


def _of_momenta(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with the derivatives by time marked that follow from what is stated wrongly above them."""
    momenta = [f.line for f in findings if f.line.kind == "p" and f.status is Status.WRONG]

    def follows(f: Finding) -> bool:
        above = (x for x in momenta if x.name == f.line.name and x.number <= f.line.number)
        return any(zero_everywhere(truth, f.line.expr - bounded.diff(x.expr, time)) for x in above)

    open_ones = (f for f in findings if f.line.kind == "p-rate" and f.is_open)
    following = {id(f) for f in open_ones if follows(f)}
    return [replace(f, follows=True) if id(f) in following else f for f in findings]


def _of_both(truth: Reference, findings: Sequence[Finding]) -> Iterator[tuple[int, Array]]:
    """The equations d/dt ∂L/∂ξ̇_i − ∂L/∂ξ_i − Ξ_i of both derivatives as they are stated, of which one is wrong, whether
    it follows or not, with the line of the last; Ξ_i is the right one."""
    for i, c in enumerate(truth.model.coordinates):
        own = {k: [f for f in findings if f.line.kind == k and f.line.name == c.name] for k in ("p", "slope")}
        if any(len(x) != 1 for x in own.values()):
            continue
        p, slope = (x[0] for x in own.values())
        if p.status.right and slope.status.right:
            continue
        expr = bounded.diff(p.line.expr, time) - slope.line.expr - truth.Xi[i]
        values = CompiledExpressions([expr]).at(truth.states)
        if np.isfinite(values).all() and np.abs(values).max() > 0:
            yield max(p.line.number, slope.line.number), values


def with_right_derivatives(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with derivatives as right that are those of the right T*, V or D, beside a wrong one of these."""
    own = given(truth, [f.line for f in findings])
    wrong = {f.line.kind for f in findings if f.status is Status.WRONG} & {"T", "V", "D"}
    return [_right_derivative(truth, f, own) if f.line.kind[:1] in wrong else f for f in findings]


def with_consequences(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with derivatives of a wrong T*, V or D of the answer that are not those of the right one as wrong
    because of it."""
    own = given(truth, [f.line for f in findings])
    wrong = {f.line.kind for f in findings if f.status is Status.WRONG} & {"T", "V", "D"}
    return [
        replace(f, status=Status.WRONG, note=None, follows=True)
        if f.line.kind in OWN_DERIVATIVES
        and f.line.kind[0] in wrong
        and f.status is Status.RIGHT
        and (rest := _rest_of_energy(truth, f.line, own)) is not None
        and zero_everywhere(truth, f.line.expr)
        and not zero_everywhere(truth, rest)
        else f
        for f in findings
    ]


def _right_derivative(truth: Reference, finding: Finding, own: StatedQuantity) -> Finding:
    line = finding.line
    if line.kind not in OWN_DERIVATIVES or finding.status is not Status.WRONG:
        return finding
    stated = -line.expr if line.kind in ("T-p", "T-slope") else line.expr  # what it has too much beside its own energy
    if (rest := _rest_of_energy(truth, line, own)) is None or not zero_everywhere(truth, stated + rest):
        return finding
    letter = "T*" if line.kind[0] == "T" else line.kind[0]
    note = text(f"the derivative of the right {letter}, not of yours")
    return replace(finding, status=Status.RIGHT, note=note)


def _rest_of_energy(truth: Reference, line: AnsweredLine, own: StatedQuantity) -> sp.Expr | None:
    """What the derivative of the answer's own T*, V or D that a line gives has too much; None for no coordinate."""
    if (i := index_of(truth, line.name)) is None:
        return None
    c, energy = truth.model.coordinates[i], line.kind[0]
    mine, right = getattr(own, energy), dissipation(truth) if energy == "D" else getattr(truth, energy)
    rest = (sp.S.Zero if mine is None else mine) - right
    by = c.symbol if line.kind in ("T-slope", "V-slope") else c.rate
    return bounded.diff(rest, by, time) if line.kind == "T-rate" else bounded.diff(rest, by)


def _extra(truth: Reference, finding: Finding) -> Iterator[tuple[int, int, Array]]:
    """What the equation of which coordinate has too much if a derivative is put in, but for the sign, and its line."""
    line, i = finding.line, index_of(truth, finding.line.name)
    right = right_value(truth, line, i) if i is not None else None
    if i is None or right is None:
        return
    rest = line.expr - right
    (values,) = CompiledExpressions([bounded.diff(rest, time) if line.kind in ("p", "T-p") else rest]).at(truth.states)
    if np.isfinite(values).all() and np.abs(values).max() > 0:
        yield line.number, i, values


def _has(truth: Reference, finding: Finding, P: Array, i: int, extra: Array) -> bool:
    """Whether an equation is that of ξ_i, in some scale, with exactly that too much."""
    for a in alignments(truth, [finding.line.expr], P[None]):
        size = np.abs(extra).max()
        if a.rows == (i,) and any(np.abs(a.rest[0] - s * extra).max() <= SMALL * size for s in (1, -1)):
            return True
    return False
