"""What is told of a wrong answer that no small mistake explains: the line, or the one or two terms, that are wrong."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.cleared import cleared
from lagrangian.check.constraints.eliminated import unknown_in
from lagrangian.check.explain.bodies_said import BodiesSaid
from lagrangian.check.explain.changes.pool import pool_of
from lagrangian.check.explain.combined_rows import (
    as_written,
    denominator_of,
    difference,
    term_to_blame,
    terms_of,
    with_combined_rows,
)
from lagrangian.check.explain.definitions import with_wrong_definitions
from lagrangian.check.explain.determinant_said import with_determinant
from lagrangian.check.explain.names_exchanged import with_names_exchanged
from lagrangian.check.explain.one_term_beside import with_one_term_beside
from lagrangian.check.explain.reasoned import reasoned
from lagrangian.check.explain.sum_not_squared import with_sum_not_squared
from lagrangian.check.explain.summands_wrong import with_wrong_summands
from lagrangian.check.explain.terms_alone import with_terms_alone
from lagrangian.check.explain.written_pieces import WrittenPieces
from lagrangian.check.explain.wrong_balance import with_wrong_balance
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict
from lagrangian.page.formula import text

VAGUE = ("special_case", "denominator", "multiplier_missing")
"""Mistakes that say less than the one term that is wrong, where the multipliers were eliminated."""


def with_wrong_terms(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer without an explanation, with the line or the terms that are wrong as its mistakes;
    also in equations into which others were put. A definition from which all that is wrong follows goes first."""
    if (divided := with_determinant(truth, lines, verdict)) is not verdict:
        return divided
    told = with_names_exchanged(truth, lines, verdict)
    if told is verdict and (told := _with_terms(truth, lines, verdict)) is not verdict:
        told = with_names_exchanged(truth, lines, told)
    if told.hint and told.status is Status.WRONG and all(m.name in (*VAGUE, "term_alone") for m in told.mistakes):
        return _with_definition(truth, lines, verdict) or told
    return with_one_term_beside(truth, lines, told)


def _with_definition(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict | None:
    """The verdict with the wrong definitions from which all lines follow that are wrong; None if there are none."""
    wrong = [f.line for f in verdict.open_findings]
    right = [f.line for f in verdict.findings if f.status.right]
    if not all(x.kind == "equation" for x in wrong) or not np.isfinite(truth.W).all():
        return None
    bodies = BodiesSaid(truth, lines, right)
    free = bool(truth.derivation.multipliers)  # the scale of multipliers in the others is the answer's own
    moved = [f for f in verdict.findings if not free or f.status is Status.WRONG]
    blamed = bodies.of_all(moved, wrong) if wrong and bodies.parts else None
    if blamed is None:
        return None
    pool = pool_of(truth)
    pieces = WrittenPieces(pool, lines)
    mistakes = tuple(reasoned(pool, p, pieces) for p in blamed.said)
    return replace(
        verdict, mistakes=mistakes, alternatives=(), findings=with_wrong_definitions(verdict.findings, blamed)
    )


def _with_terms(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict with the line or the terms that are wrong as its mistakes."""
    balanced = with_wrong_balance(truth, lines, verdict)
    if balanced is verdict and verdict.mistakes and all(m.name in VAGUE for m in verdict.mistakes):
        combined = with_combined_rows(truth, lines, replace(verdict, mistakes=(), alternatives=()))
        wrong = [f.line.expr for f in verdict.open_findings]
        if any(m.name == "denominator" for m in verdict.mistakes) and any(denominator_of(x) is not None for x in wrong):
            return _with_term_of_denominator(truth, lines, verdict, combined)
        found = _with_denominators(truth, lines, with_terms_alone(combined), combined)
        return found if found.mistakes else verdict
    combined = with_wrong_summands(truth, lines, with_combined_rows(truth, lines, balanced))
    told = with_terms_alone(_with_term_of_one_line(truth, combined))
    told = told if balanced.mistakes else _with_denominators(truth, lines, told, combined)
    return with_sum_not_squared(truth, told)


def _in_denominator(
    truth: Reference, lines: Sequence[AnsweredLine], finding: Finding
) -> tuple[sp.Expr, sp.Expr] | None:
    """The one term of a denominator that is wrong, and the right one."""
    expr = as_written(lines, finding.line).expr
    below = denominator_of(expr) if finding.status is Status.WRONG and len(finding.differences) == 1 else None
    moving = [c.acceleration for c in truth.model.coordinates if expr.has(c.acceleration)]
    if below is None:
        return None
    (d,) = finding.differences
    a = next((a for a in moving if d.written.has(a)), None)
    if a is None or d.kind not in ("coefficient", "sign"):
        return None
    scale = bounded.cancel(bounded.diff(cleared(expr), a) / below)
    right, written = (bounded.cancel(x / a / scale) for x in (d.term, d.written))
    there = not right.has(a) and any(bounded.expand(t - written) == 0 for t in terms_of(below))
    return (written, right) if there else None


def _with_denominators(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict, combined: Verdict) -> Verdict:
    """The verdict with one wrong term, told as one of a denominator where it stands in one."""
    roots = combined.open_findings
    terms = _in_denominator(truth, lines, roots[0]) if len(roots) == len(verdict.mistakes) == 1 else None
    if terms is None:
        return verdict
    (mistake,) = verdict.mistakes
    what = text(f"In the denominator of {roots[0].line.title}, ", terms[0], " should be ", terms[1], ".")
    findings = tuple(replace(f, differences=()) if f.line is roots[0].line else f for f in verdict.findings)
    return replace(verdict, mistakes=(replace(mistake, what=what),), findings=findings)


def _with_term_of_denominator(
    truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict, combined: Verdict
) -> Verdict:
    """The verdict on accelerations with a wrong denominator, with the one term of it that is wrong; ``combined`` says
    which term of an equation times its denominator is."""
    for finding in combined.findings:
        if (terms := _in_denominator(truth, lines, finding)) is not None:
            told = [
                replace(m, what=text(*m.what.parts, " In it, ", terms[0], " should be ", terms[1], "."))
                if m.name == "denominator"
                else m
                for m in verdict.mistakes
            ]
            return replace(verdict, mistakes=tuple(told))
    return verdict


def _with_term_of_one_line(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict on an answer in which one line alone is wrong beside right equations of motion, and nothing explains
    it: with the term without which it is right along the right motion."""
    wrong = verdict.open_findings
    alone = len(wrong) == 1 and wrong[0].line.kind == "equation" and len(wrong[0].differences) != 1
    if verdict.mistakes or not verdict.motion or not alone or truth.derivation.multipliers:
        return verdict
    if unknown_in(truth, [wrong[0].line]):
        return verdict
    term = term_to_blame(truth, wrong[0].line.expr, truth.accelerations)
    if term is None:
        return verdict
    blamed = replace(wrong[0], differences=(difference(truth, term, None),), coordinate=None, note=None)
    return replace(verdict, findings=tuple(blamed if f is wrong[0] else f for f in verdict.findings))
