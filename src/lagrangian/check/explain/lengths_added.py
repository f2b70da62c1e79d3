"""Tells two lengths that are added before they are squared, (d + e)², where they stand at a right angle: d² + e².

As a mistake of a velocity it would be a direction that is turned by a right angle; what is written is a sum.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.rows import Kind, compare, zero_everywhere
from lagrangian.check.stated import index_of, right_value
from lagrangian.check.verdict import AnsweredLine, Verdict
from lagrangian.page.formula import text

TURNED = "segment_direction"
"""The mistake of a velocity in whose place such a sum is told."""
WHY = text("Lengths at a right angle to each other make a distance with the square a² + b², as Pythagoras says.")


def with_lengths_added(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict; a direction that is turned is told as the sum of two lengths where that is what is written."""
    turned = next((m for m in verdict.mistakes if m.name == TURNED), None)
    if turned is None or verdict.hint == 0:
        return verdict
    for finding in verdict.open_findings:
        for added, squares in _sums(truth, finding.line):
            what = text(f"In {finding.line.title}, ", added, " stands in place of ", squares, ".")
            brief = text(f"A sum of lengths in {finding.line.title} is not right.")
            told = replace(turned, name="lengths_added", what=what, why=WHY, brief=brief)
            mistakes = tuple(told if m is turned else m for m in verdict.mistakes)
            others = tuple(m for m in verdict.alternatives if m.name != TURNED)
            return replace(verdict, mistakes=mistakes, alternatives=others)
    return verdict


def _sums(truth: Reference, line: AnsweredLine) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """The squares of sums of constants with whose squares alone a line is right, and the sums of these."""
    powers = {x for x in line.expr.atoms(sp.Pow) if x.exp == 2 and x.base.is_Add and _is_constant(truth, x.base)}
    for power in sorted(powers, key=sp.default_sort_key):
        squares = sp.Add(*(cast("sp.Expr", x) ** 2 for x in power.base.args))
        if _is_right(truth, line, cast("sp.Expr", line.expr.xreplace({power: squares}))):
            yield power, squares


def _is_constant(truth: Reference, expr: sp.Expr) -> bool:
    return bounded.letters(expr) <= {p.symbol for p in truth.model.parameters}


def _is_right(truth: Reference, line: AnsweredLine, put: sp.Expr) -> bool:
    """Whether a line would be right with another expression."""
    if line.kind == "equation":
        return compare(truth, [put]).rows[0].kind not in (Kind.WRONG, Kind.NOTHING)
    right = right_value(truth, line, index_of(truth, line.name))
    return right is not None and zero_everywhere(truth, put - right)
