"""The one summand of an equation, as it is written, that is wrong where all others are right: θ̈ = (I R₂ + S R₁)/Δ.

Multiplied out, S R₁ is many terms, and all of them are wrong; as it is written it is one, with the wrong sign. It may
also have a quantity of the answer's own too much or too little, or one for another: R₁ S for R₁ S/I, M R₁/Δ for I R₁/Δ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import islice

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.combined_rows import (
    NUMBERS,
    WrongTerm,
    as_written,
    at_places,
    difference,
    in_factors,
    multiple_of,
    outside_rows,
)
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Verdict
from lagrangian.derive.sampling import PLACES, SETS, CompiledExpressions

MOST, MOST_NAMED = 60, 6
"""The most summands of a line that are tried, and the most quantities by which one may have to be multiplied."""


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
    named = {x.name: truth.expand(x.expr) for x in lines if x.kind == "definition" and x.name is not None}
    wrong = one_wrong_summand(truth, as_written(lines, finding.line), list(named.values()))
    return finding if wrong is None else replace(finding, differences=(difference(truth, wrong, finding.coordinate),))


def one_wrong_summand(truth: Reference, line: AnsweredLine, named: Sequence[sp.Expr] = ()) -> WrongTerm | None:
    """The one summand of an equation that has a wrong sign or number, or does not belong there, or that lacks one of
    the ``named`` quantities of the answer or has it too much; None if there is none, or if it may be one of several.

    Of a name alone, nothing says whether it or its use is wrong.
    """
    written = (sp.Mul(*product) for ways in line.summands for product in ways)
    own = list(dict.fromkeys(islice((truth.expand(x) for x in written if x != 0), MOST)))
    values = CompiledExpressions([line.expr, *own]).at(truth.states)
    if len(own) < 2 or not np.isfinite(values).all():
        return None
    whole, *each = values.reshape(len(values), SETS * PLACES, -1)
    apart = [multiple_of(whole, x) is None for x in each]  # without the line itself, nothing would be left to be wrong
    outside = outside_rows(truth, values)
    across = dict(zip(own, outside[1:], strict=True))
    found = in_factors(truth, outside[0], across)
    plain = [x for rank, x in found if rank == 0 and any(x.factor == number for _, number in NUMBERS)]
    moving = (sp.Derivative, *(u.symbol for u in truth.model.inputs))
    if not plain and (placed := [x for x in named if bounded.expand(x) != 0 and not x.has(*moving)][:MOST_NAMED]):
        factors = [*placed, *(1 / x for x in placed), *(x / y for x in placed for y in placed if x is not y)]
        parts = [x for x, part in zip(own, apart, strict=True) if part]
        products = {x: across[x] for x in parts if not any(x in (n, -n) for n in named)}
        plain = [x for _, x in in_factors(truth, outside[0], products, at_places(truth, factors))]
    return plain[0] if len(plain) == 1 else None
