"""Is this answer right? The check as a table of contents."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from lagrangian.analyze.check.difference import differences, likeness, paired
from lagrangian.analyze.check.rows import Comparison, Kind, Row, compare
from lagrangian.analyze.check.truth import Truth, truth_of
from lagrangian.analyze.check.verdict import Finding, Line, Status, Verdict
from lagrangian.derive import Derivation
from lagrangian.derive.formula import Text, text


def check(derivation: Derivation, lines: Sequence[Line], *, hint: int = 3) -> Verdict:
    """Return what is right and what is wrong with an answer, line by line and as a whole."""
    truth = truth_of(derivation)
    equations = [line for line in lines if line.kind == "equation"]
    exprs = [truth.expand(line.expr) for line in equations]
    comparison = compare(truth, exprs)
    status = overall(truth, comparison)
    findings = equation_findings(truth, equations, exprs, comparison)
    combination = None
    if status.right and all(r.factors is not None for r in comparison.rows if r.true):
        combination = tuple(r.factors for r in comparison.rows if r.factors is not None)
    return Verdict(status, findings, combination=combination, hint=hint)


def overall(truth: Truth, comparison: Comparison) -> Status:
    """The verdict on a set of equations."""
    rows = [r for r in comparison.rows if r.kind is not Kind.NOTHING]
    if any(r.kind is Kind.WRONG for r in rows):
        return Status.WRONG
    if comparison.rank < truth.n:
        return Status.INCOMPLETE
    kinds = {r.kind for r in rows}
    if kinds == {Kind.SAME} and [r.index for r in rows] == list(range(truth.n)):
        return Status.RIGHT
    if kinds <= {Kind.SAME, Kind.SCALED, Kind.COMBINED}:
        return Status.EQUIVALENT
    return Status.SAME_MOTION


def equation_findings(
    truth: Truth, lines: Sequence[Line], exprs: Sequence[sp.Expr], comparison: Comparison
) -> tuple[Finding, ...]:
    """What was found of every equation; a wrong one is compared with the right one it is most like."""
    taken = [r.index for r in comparison.rows if r.true and r.index is not None]
    wrong = [j for j, r in enumerate(comparison.rows) if r.kind is Kind.WRONG]
    forms = {j: truth.form(exprs[j]) for j in wrong}
    pairs = dict(zip(wrong, paired([likeness(forms[j], truth.forms) for j in wrong], taken), strict=True))
    found: list[Finding] = []
    for j, (line, row) in enumerate(zip(lines, comparison.rows, strict=True)):
        if row.kind is not Kind.WRONG:
            found.append(Finding(line, _status(row), _note(truth, row), _name(truth, row.index)))
            continue
        like, form = pairs[j], forms[j]
        right = truth.forms[like.index] if like is not None else None
        if like is None or form is None or right is None:
            found.append(Finding(line, Status.WRONG))
            continue
        differing = differences(truth, form, right, like.factor, like.index)
        found.append(Finding(line, Status.WRONG, None, _name(truth, like.index), differing))
    return tuple(found)


def _name(truth: Truth, index: int | None) -> str | None:
    return truth.model.coordinates[index].name if index is not None else None


def _status(row: Row) -> Status:
    if row.kind is Kind.SAME:
        return Status.RIGHT
    if row.kind in (Kind.SCALED, Kind.COMBINED):
        return Status.EQUIVALENT
    return Status.INCOMPLETE if row.kind is Kind.NOTHING else Status.SAME_MOTION


def _note(truth: Truth, row: Row) -> Text | None:
    """What a true row is made of, in words."""
    if row.kind is Kind.NOTHING:
        return text("says 0 = 0")
    if row.kind is Kind.SCALED and row.factors is not None and row.index is not None:
        return text(f"equation {row.index + 1} times ", row.factors[row.index])
    return None
