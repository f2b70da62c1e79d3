"""Tells in numbers what is wrong in lines in numbers: 210 sin θ for 2 k L s₀ sin θ, 1.0975 θ̈ for (439/400) θ̈."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.coordinates.renamed import each_formula
from lagrangian.check.names.spelling import in_numbers, values_of
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Finding, Mistake, Status, TermDifference, Verdict
from lagrangian.page.formula import Text

DIGITS = 6
"""The digits of a number that is no shorter decimal."""
LARGEST_BELOW = 12
"""The largest denominator of a fraction that stays one, as ⅓ of ⅓ m l²."""


def said_in_numbers(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict, in which terms of lines in numbers are told with the values of the system.

    Words that speak of a letter itself keep their letters, and so do those of an answer that has wrong lines in letters
    too.
    """
    values = {**values_of(truth, ()), **truth.values}
    put: dict[sp.Basic, sp.Expr] = {p: v for p, v in values.items() if p not in truth.prescribed and v.is_number}
    wrong = [f for f in verdict.findings if f.status is Status.WRONG and f.line.kind not in ("definition", "statement")]
    numeric = [f for f in wrong if put and in_numbers(truth, [f.line])]
    if not numeric:
        return verdict
    findings = [_finding(f, put) if any(f is x for x in numeric) else f for f in verdict.findings]
    if len(numeric) < len(wrong):
        return replace(verdict, findings=tuple(findings))
    mistakes, others = (tuple(_mistake(m, put) for m in x) for x in (verdict.mistakes, verdict.alternatives))
    return replace(verdict, findings=tuple(findings), mistakes=mistakes, alternatives=others)


def _finding(finding: Finding, put: Mapping[sp.Basic, sp.Expr]) -> Finding:
    return replace(finding, differences=tuple(_difference(d, put) for d in finding.differences))


def _difference(d: TermDifference, put: Mapping[sp.Basic, sp.Expr]) -> TermDifference:
    return replace(d, term=_in_decimals(d.term, put), written=_in_decimals(d.written, put))


def _mistake(mistake: Mistake, put: Mapping[sp.Basic, sp.Expr]) -> Mistake:
    return replace(mistake, what=_words(mistake.what, put))


def _words(words: Text, put: Mapping[sp.Basic, sp.Expr]) -> Text:
    """Words in which no letter is spoken of, with the values put in."""
    formulas = [x for x in words.parts if isinstance(x, sp.Expr)]
    if any(_is_of_letters(x, put) for x in formulas):
        return words
    return each_formula(words, lambda x: _in_decimals(x, put) if isinstance(x, sp.Expr) else x)


def _is_of_letters(x: sp.Expr, put: Mapping[sp.Basic, sp.Expr]) -> bool:
    """Whether a formula is made of letters that have values, and of nothing that moves."""
    return bool(bounded.symbols(x) & put.keys()) and not bounded.atoms(x, AppliedUndef)


def _in_decimals(expr: sp.Expr, put: Mapping[sp.Basic, sp.Expr]) -> sp.Expr:
    """A formula with values, its numbers as decimals."""
    moving = bool(bounded.atoms(expr, AppliedUndef))
    if not moving and expr not in (0, 1, -1) and not expr.is_number:
        return expr
    return cast("sp.Expr", _with_decimals(expr.xreplace(dict(put))))


def _with_decimals(expr: Any) -> Any:
    if isinstance(expr, sp.Rational):
        return _decimal(expr)
    if expr.is_number and expr.is_real and expr.is_finite and not expr.is_Float:
        return sp.Float(f"{float(expr):.{DIGITS}g}")
    if isinstance(expr, (sp.Add, sp.Mul)):
        return _again(expr, [_with_decimals(x) for x in expr.args])
    if isinstance(expr, sp.Pow):
        return expr.func(_with_decimals(expr.args[0]), expr.args[1])
    return expr


def _again(expr: Any, args: Sequence[Any]) -> Any:
    return expr if all(a is b for a, b in zip(expr.args, args, strict=True)) else expr.func(*args)


def _decimal(x: sp.Rational) -> sp.Expr:
    """A number as a decimal, rounded if it has many digits; a plain fraction as it is."""
    if x.q == 1 or (x.q <= LARGEST_BELOW and x.q % 5):
        return x
    return sp.Float(f"{float(x):.{DIGITS}g}")
