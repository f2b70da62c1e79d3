"""What is found for equations by their comparison with the right ones: which of these each consists of, in words."""

from __future__ import annotations

import re
from collections.abc import Sequence

import sympy as sp

from lagrangian.check.explain.energy_theorem import note_on
from lagrangian.check.reference import Reference
from lagrangian.check.rows import Kind, ReferenceRow, RowComparison
from lagrangian.check.verdict import AnsweredLine, Finding, Status
from lagrangian.page.formula import Terms, Text, text

_DERIVES = re.compile(r"(?:∂|\\partial[ ]?|\bd ?)(?:[TVLUKED]\*?(?![\w'])|[ℒ(]|\\(?:mathcal|mathscr|cal)(?![A-Za-z]))")
"""In a line that says what a derivative of an energy is."""
_LETTER = re.compile(r"[^\W\d_]")


def findings_of(truth: Reference, lines: Sequence[AnsweredLine], comparison: RowComparison) -> list[Finding]:
    """The findings for every equation, without a comparison of wrong ones."""
    return [_finding(truth, line, row) for line, row in zip(lines, comparison.rows, strict=True)]


def is_of_numbers(line: AnsweredLine) -> bool:
    """Whether a line equates nothing but numbers: 120 + 25·1.8 = 165."""
    apart = len({side.strip() for side in line.text.split("=")}) > 1
    return line.kind == "equation" and apart and not line.names and _LETTER.search(line.text) is None


def _finding(truth: Reference, line: AnsweredLine, row: ReferenceRow) -> Finding:
    if row.kind is Kind.WRONG:
        return Finding(line, Status.WRONG)
    if row.kind is Kind.NOTHING and _DERIVES.search(line.text) is not None:
        return Finding(line, Status.RIGHT, text("it follows from the energies above"))
    if row.kind is Kind.NOTHING and is_of_numbers(line):
        return Finding(line, Status.RIGHT, text("worked out rightly; what it stands for is not judged"))
    if row.kind is Kind.NOTHING and len({side.strip() for side in line.text.split("=")}) > 1:
        return Finding(line, Status.RIGHT, text("it holds by itself, with what is stated"))
    return Finding(line, _status(row), _note(truth, row, line.expr), name_of(truth, row.index))


def name_of(truth: Reference, index: int | None) -> str | None:
    """The coordinate of a right equation."""
    return truth.model.coordinates[index].name if index is not None else None


def _status(row: ReferenceRow) -> Status:
    if row.kind is Kind.SAME:
        return Status.RIGHT
    if row.kind in (Kind.SCALED, Kind.COMBINED):
        return Status.EQUIVALENT
    return Status.INCOMPLETE if row.kind is Kind.NOTHING else Status.SAME_MOTION


def _note(truth: Reference, row: ReferenceRow, expr: sp.Expr) -> Text | None:
    """Which right equations a true row consists of, in words."""
    if row.kind is Kind.NOTHING:
        return text("says 0 = 0")
    if row.kind is Kind.SCALED and row.index is not None:
        times = row.factors[row.index] if row.factors is not None else "a factor"
        return text("the equation of ", truth.derivation.coordinates[row.index], ", times ", times)
    if row.factors is not None and row.kind in (Kind.COMBINED, Kind.TURNED):
        parts: list[sp.Expr | str | Terms] = []
        for factor, q in zip(row.factors, truth.derivation.coordinates, strict=True):
            if factor != 0:
                parts += [
                    " and " if parts else "",
                    *(("" if factor == 1 else factor), " times " if factor != 1 else ""),
                ]
                parts += ["the equation of ", q]
        return text("the sum of ", *parts)
    if row.kind is Kind.TURNED:
        return text("the equations added, each times a factor")
    if row.kind is Kind.CONSEQUENCE and (said := note_on(truth, expr, right=True)) is not None:
        return said
    if row.kind is Kind.CONSEQUENCE:
        return text("true whenever the right equations hold")
    return None
