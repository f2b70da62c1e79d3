"""The one summand of an equation, as it is written, that is wrong where all others are right: θ̈ = (I R₂ + S R₁)/Δ.

Multiplied out, S R₁ is many terms, and all of them are wrong; as it is written it is one, with the wrong sign.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import islice

import numpy as np
import sympy as sp

from lagrangian.check.explain.combined_rows import NUMBERS, WrongTerm, as_written, difference, in_factors, outside_rows
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Verdict
from lagrangian.derive.sampling import CompiledExpressions

MOST = 60
"""The most summands of a line that are tried."""


def with_wrong_summands(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict on an answer without an explanation, in which a wrong equation of which nothing is known differs in
    one summand alone, with which it is a sum of right ones."""
    if verdict.mistakes or truth.derivation.multipliers or truth.n < 2 or not np.isfinite(truth.W).all():
        return verdict
    findings = tuple(_with_summand(truth, lines, f) for f in verdict.findings)
    return replace(verdict, findings=findings)


def _with_summand(truth: Reference, lines: Sequence[AnsweredLine], finding: Finding) -> Finding:
    """The finding with its one wrong summand, if it has one."""
    open_one = finding.is_open and not finding.differences
    if not open_one or finding.line.kind != "equation":
        return finding
    wrong = one_wrong_summand(truth, as_written(lines, finding.line))
    return finding if wrong is None else replace(finding, differences=(difference(truth, wrong, finding.coordinate),))


def one_wrong_summand(truth: Reference, line: AnsweredLine) -> WrongTerm | None:
    """The one summand of an equation that has a wrong sign or number, or does not belong there; None if there is none,
    or if it may be one of several."""
    products = (sp.Mul(*product) for ways in line.summands for product in ways)
    own = list(dict.fromkeys(islice((truth.expand(x) for x in products if x != 0), MOST)))
    values = CompiledExpressions([line.expr, *own]).at(truth.states)
    if len(own) < 2 or not np.isfinite(values).all():
        return None
    outside = outside_rows(truth, values)
    found = in_factors(truth, outside[0], dict(zip(own, outside[1:], strict=True)))
    plain = [x for rank, x in found if rank == 0 and any(x.factor == number for _, number in NUMBERS)]
    return plain[0] if len(plain) == 1 else None
