"""Tells in numbers what is wrong in lines in numbers: 210 sin θ for 2 k L s₀ sin θ, 1.0975 θ̈ for (439/400) θ̈."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.coordinates.renamed import each_formula
from lagrangian.check.decimals import places
from lagrangian.check.names.spelling import in_numbers, names_of, values_of
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, TermDifference, Verdict
from lagrangian.records import dataclass

DIGITS = 6
"""The digits of a number that is no shorter decimal."""
_DECIMALS = re.compile(r"\d[.,]\d|(?<![\w.])\.\d")
LARGEST_BELOW = 12
"""The largest denominator of a fraction that stays one, as ⅓ of ⅓ m l²."""


def said_in_numbers(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict, in which terms of lines in numbers are told with the values of the system.

    Words that speak of a letter itself keep their letters, and so do those of an answer that has wrong lines in letters
    too. Numbers are told as decimals, also in lines with some letters if these have decimals or values are put in.
    """
    judged = [f.line for f in verdict.findings if f.line.kind not in ("definition", "statement")]
    wrong = [f for f in verdict.findings if f.status is Status.WRONG and f.line.kind not in ("definition", "statement")]
    letters = names_of(truth)
    unlettered = [x for x in judged if letters.isdisjoint(bounded.symbols(x.expr))]
    unlettered = unlettered if in_numbers(truth, unlettered) else []
    kept = truth.prescribed | truth.angles.intersection(x for line in judged for x in bounded.symbols(line.expr))
    values = {**values_of(truth, ()), **truth.values}
    put: dict[sp.Basic, sp.Expr] = {p: v for p, v in values.items() if p not in kept and v.is_number}
    told = [
        _Told(put, letters, _has_decimals(f.line) and "/" not in f.line.text)
        if put and any(f.line is x for x in unlettered)
        else _Told({}, letters, False)
        if _has_decimals(f.line) or any(v.is_Rational for v in truth.values.values())
        else None
        for f in wrong
    ]
    ways = {id(f): way for f, way in zip(wrong, told, strict=True) if way is not None}
    if not ways:
        return verdict
    findings = tuple(ways[id(f)].finding(f) if id(f) in ways else f for f in verdict.findings)
    if None in told:
        return replace(verdict, findings=findings)
    every = min(ways.values(), key=lambda way: (len(way.put), way.halves))
    mistakes, others = (tuple(map(every.mistake, x)) for x in (verdict.mistakes, verdict.alternatives))
    return replace(verdict, findings=findings, mistakes=mistakes, alternatives=others)


def _has_decimals(line: AnsweredLine) -> bool:
    """Whether a line is written with decimals, which may have a comma in front."""
    return _DECIMALS.search(line.text) is not None


@dataclass(frozen=True)
class _Told:
    """How formulas are told: what is ``put`` for the ``letters`` of parameters, and whether ``halves`` are decimals
    too, as 0.5 is."""

    put: Mapping[sp.Basic, sp.Expr]
    letters: Collection[sp.Basic]
    halves: bool

    def finding(self, finding: Finding) -> Finding:
        """A finding, with its differences told so."""
        return replace(finding, differences=tuple(map(self._difference, finding.differences)))

    def _difference(self, d: TermDifference) -> TermDifference:
        return replace(d, term=self._in_decimals(d.term), written=self._in_decimals(d.written))

    def mistake(self, mistake: Mistake) -> Mistake:
        """A mistake, told so unless its words speak of a letter."""
        formulas = [x for x in mistake.what.parts if isinstance(x, sp.Expr)]
        if any(self._is_of(x, self.put) for x in formulas):
            return mistake
        what = each_formula(mistake.what, lambda x: x if self._is_of(x, self.letters) else self._in_decimals(x))
        return replace(mistake, what=what)

    def _is_of(self, x: sp.Basic, letters: Collection[sp.Basic]) -> bool:
        """Whether a formula has some of these letters, and nothing that moves."""
        return not bounded.symbols(x).isdisjoint(letters) and not bounded.atoms(x, AppliedUndef)

    def _in_decimals(self, expr: Any) -> Any:
        """A formula with values, its numbers as decimals."""
        return self._with_decimals(expr.xreplace(dict(self.put))) if isinstance(expr, sp.Expr) else expr

    def _with_decimals(self, expr: Any) -> Any:
        if isinstance(expr, sp.Rational):
            return self._decimal(expr)
        if expr.is_number and expr.is_real and expr.is_finite and not expr.is_Float:
            return sp.Float(f"{float(expr):.{DIGITS}g}")
        if isinstance(expr, (sp.Add, sp.Mul)):
            return _again(expr, [self._with_decimals(x) for x in expr.args])
        if isinstance(expr, sp.Pow):
            return expr.func(self._with_decimals(expr.args[0]), expr.args[1])
        return expr

    def _decimal(self, x: sp.Rational) -> sp.Expr:
        """A number as a decimal, rounded if it has many digits; a plain fraction as it is."""
        if x.q == 1 or (x.q <= LARGEST_BELOW and x.q % 5 and not (self.halves and places(x) is not None)):
            return x
        return sp.Float(f"{float(x):.{DIGITS}g}")


def _again(expr: Any, args: Sequence[Any]) -> Any:
    return expr if all(a is b for a, b in zip(expr.args, args, strict=True)) else expr.func(*args)
