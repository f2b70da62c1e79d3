"""The one term that is wrong in an equation which the mistakes that are found elsewhere leave open.

N = k (r β + …) + c (r β̇ + …);  m l² θ̈ = … − b l² θ̇;  J₂ β̈ = τ − N R      N R should be N r, and nothing else

The first mistake explains the damper. The last equation was compared with a multiple of ours in which more of the terms
are as they should be when N is written out; as it is written, one of its terms is wrong.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import sympy as sp

from lagrangian.check.cleared import cleared
from lagrangian.check.explain.combined_rows import as_written, difference, one_wrong_term
from lagrangian.check.explain.terms_alone import LEFT_OVER, term_mistake
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Verdict


def with_one_term_beside(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict, in which equations that its mistakes leave open are told by the one term of them that is wrong."""
    notes = [n for n in verdict.notes if str(n).endswith(LEFT_OVER)]
    if len(notes) != 1 or not verdict.mistakes or truth.derivation.multipliers or not np.isfinite(truth.W).all():
        return verdict
    left = [f for f in verdict.findings if _is_open(f) and f.line.title in notes[0].parts]
    told = [(f, x) for f in left if (x := _by_one_term(truth, lines, f)) is not None]
    if not left or len(told) < len(left):
        return verdict
    new = {id(f): x for f, x in told}
    findings = tuple(new.get(id(f), f) for f in verdict.findings)
    mistakes = (*verdict.mistakes, *(_mistake(x) for _, x in told))
    kept = tuple(n for n in verdict.notes if n is not notes[0])
    return replace(verdict, findings=findings, mistakes=mistakes, notes=kept)


def _is_open(finding: Finding) -> bool:
    return finding.is_open and finding.line.kind == "equation"


def _by_one_term(truth: Reference, lines: Sequence[AnsweredLine], finding: Finding) -> Finding | None:
    """The finding with the one term as it is written that a factor puts right; None if there is none."""
    if len(finding.differences) < 2:
        return None
    wrong = one_wrong_term(truth, cleared(as_written(lines, finding.line).expr))
    if wrong is None or wrong.factor in (sp.oo, sp.S.Zero):
        return None
    return replace(finding, differences=(difference(truth, wrong, finding.coordinate),))


def _mistake(finding: Finding) -> Mistake:
    return term_mistake(finding, finding.differences[0])
