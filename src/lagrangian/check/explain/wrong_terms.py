"""What is told of a wrong answer that no small mistake explains: the line, or the one or two terms, that are wrong."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.check.explain.combined_rows import with_combined_rows
from lagrangian.check.explain.terms_alone import with_terms_alone
from lagrangian.check.explain.wrong_balance import with_wrong_balance
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Verdict


def with_wrong_terms(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer without an explanation, with the line or the terms that are wrong as its mistakes;
    also in equations into which others were put."""
    balanced = with_wrong_balance(truth, lines, verdict)
    return with_terms_alone(with_combined_rows(truth, lines, balanced))
