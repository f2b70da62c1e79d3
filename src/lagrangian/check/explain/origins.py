"""Finds the values of an answer's own names in which wrong terms of its equations were made: a program, its matrices.

IH = J + m l;  IH β″ + k β = 0        the term m l β̈ of the equation is that of m l in IH

The answer is read with marks in its values (`reading.marked_values`). What an equation has of a value, as its slope by
the mark says, holds the wrong term: then it was made there, at the first value of which this is true. A term that is
missing was left out of the value whose factor in the equation is a factor of the term. An equation all of whose wrong
terms were made in values follows from these.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from itertools import islice
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.difference import differences
from lagrangian.check.explain.in_own_names import OwnName, own_names, with_names
from lagrangian.check.explain.numerators import multiplied, of_solved
from lagrangian.check.explain.origins_said import Made, with_made
from lagrangian.check.reading.marked_values import MarkedValue, ValueMarks
from lagrangian.check.reference import Reference
from lagrangian.check.rows import ratio, zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Status, TermDifference, Verdict
from lagrangian.model import time
from lagrangian.read.letters import key
from lagrangian.records import dataclass

MOST_TERMS, MOST_OVER_SUMS = 300, 100
"""A part of an equation with more terms is not looked at."""
LONGEST = 1_500
"""The most operations of an equation with marks."""
_COMMENT = re.compile(r"[%#].*+")
_DIGITS = "0123456789₀₁₂₃₄₅₆₇₈₉_"
_WORD = re.compile(r"[^\W\d]\w*+")


@dataclass(frozen=True, eq=False)
class PartOfValue:
    """What an equation has of a value: its factor, and the terms of factor times value."""

    of: MarkedValue
    factor: sp.Expr
    terms: frozenset[sp.Expr]

    @property
    def is_factor(self) -> bool:
        """Whether the value is multiplied by letters: it may be right, and what it is multiplied by wrong."""
        return bool(self.factor.free_symbols - {time})


def with_origins(truth: Reference, verdict: Verdict, marks: ValueMarks, lines: Sequence[AnsweredLine]) -> Verdict:
    """The verdict, with the wrong terms of equations at the values in which they were made; ``lines`` are those of the
    answer that was read with marks."""
    told, names = verdict, own_names(truth, lines, [f.line for f in verdict.findings if f.status is Status.WRONG])
    verdict = replace(verdict, findings=tuple(_written_out(f, names) for f in verdict.findings))
    rows = [replace(x, expr=truth.expand(x.expr)) for x in lines if x.kind == "equation"]
    equations = [f for f in verdict.findings if f.line.kind == "equation"]
    marked = {id(f): _with_marks(truth, marks, f.line, rows) for f in equations}
    parts = {id(f): [] if x is None else _parts(marks, x) for f in equations if (x := marked[id(f)]) is not None}
    said = {f.line.number for f in verdict.findings if f.line.kind == "definition" and f.status.right}
    judged = {f.line.number for f in verdict.findings if f.line.kind != "equation"} - said
    found: list[Made] = []
    differing: dict[int, Sequence[TermDifference]] = {}
    for f in verdict.findings:
        held = [p for p in parts.get(id(f), ()) if p.of.line not in (*judged, f.line.number)]
        expr = marked.get(id(f))
        if f.status is not Status.WRONG or f.follows or not held or expr is None:
            continue
        alone = _names_only(truth, marks, f.line.number)
        made = [Made(f, d, sp.S.One, *x, alone) for d in f.differences for x in _made_in(held, d, alone)]
        differing[id(f)] = f.differences
        if not made:
            expr, under, differing[id(f)] = _multiplied(truth, marks, expr, f.coordinate)
            held = [p for p in _parts(marks, expr) if any(p.of is q.of for q in held)]
            made = [Made(f, d, under, *x, alone) for d in differing[id(f)] for x in _made_in(held, d, alone)]
        solved = not f.differences and bool(of_solved(verdict.mistakes))  # no equation with several accelerations
        found += [x for x in made if not solved or x.term.kind not in ("missing", "extra")]
    uses = [(f, p) for f in verdict.findings for p in parts.get(id(f), ())]
    found = [x for x in found if _fits(x, found, uses) and (x.of.line not in said or _is_entry(x, uses))]
    if not found:
        return told
    lines_made = {x.of.line for x in found} & said  # m g l sin θ is right for a force, and not for this entry
    kept = (f for f in verdict.findings if f.line.kind != "definition" or f.line.number not in lines_made)
    verdict = replace(verdict, findings=tuple(kept))
    own = own_names(truth, lines, [x.finding.line for x in found])
    found = [replace(x, own=_named(x.own, own)) for x in found]
    made = with_made(truth, verdict, found, differing)
    named = (replace(f, differences=tuple(_named(d, names) for d in f.differences)) for f in made.findings)
    return replace(made, findings=tuple(named))


def _written_out(finding: Finding, names: Sequence[OwnName]) -> Finding:
    """A finding with terms in the letters of the system, as those are that a line is made of."""
    table: dict[Any, Any] = {x.symbol: x.value for x in names if not x.given}
    if not table or not any(d.term.has(*table) or d.written.has(*table) for d in finding.differences):
        return finding
    plain = (replace(d, term=d.term.xreplace(table), written=d.written.xreplace(table)) for d in finding.differences)
    return replace(finding, differences=tuple(plain))


def _named(d: TermDifference, names: Sequence[OwnName]) -> TermDifference:
    """What is wrong in a value, in names of the answer and of the system."""
    return replace(d, term=with_names(d.term, names), written=with_names(d.written, names))


def _fits(made: Made, found: Sequence[Made], uses: Sequence[tuple[Finding, PartOfValue]]) -> bool:
    """Whether every equation that has the value shows the same mistake in it, and the value rather than its use is
    wrong: a sign or a factor that is wrong in all of what a name adds may be that of the equation."""
    shown = {id(x.finding) for x in found if x.of is made.of}
    if any(p.of is made.of and id(f) not in shown for f, p in uses):
        return False
    own = [(f, p) for f, p in uses if p.of.name == made.of.name and p.terms != {sp.S.Zero}]
    if made.term.kind not in ("sign", "coefficient") or any(f.status.right for f, _ in own):
        return True
    turned = {y for x in found if x.finding is made.finding for y in sp.Add.make_args(bounded.expand(x.term.written))}
    here = [p for f, p in own if f is made.finding]
    if any(not p.terms <= turned for p in here) or _is_entry(made, uses):
        return True
    factor = next((p.factor for p in here if p.of is made.of), sp.S.Zero)
    if made.alone and factor == -1:
        return True
    return made.term.kind == "coefficient" and len(here) == 1 and _is_moving(factor)


def _is_entry(made: Made, uses: Sequence[tuple[Finding, PartOfValue]]) -> bool:
    """Whether a value is one of several with a name and a number, c₁ and c₂, of which another is right in an equation
    of the same line with the same factor: the sign of the equation is that of all."""
    stem, line = made.of.name.rstrip(_DIGITS), made.finding.line
    here = [p for f, p in uses if f is made.finding and p.of is made.of]
    others = [
        p
        for f, p in uses
        if f.status.right
        and (f.line.number, f.line.text) == (line.number, line.text)
        and p.of.name != made.of.name
        and p.of.name.rstrip(_DIGITS) == stem
    ]
    return made.alone and any(p.factor == q.factor for p in here for q in others)


def _is_moving(factor: sp.Expr) -> bool:
    """Whether a factor is a coordinate or a rate, with a sign or without."""
    return any(isinstance(x, (AppliedUndef, sp.Derivative)) for x in (factor, -factor))


def _names_only(truth: Reference, marks: ValueMarks, number: int) -> bool:
    """Whether a line of a program has nothing of the system but names to which values were given before."""
    said = _COMMENT.sub("", marks.lines[number - 1]) if 0 < number <= len(marks.lines) else ""
    own = {key(y) for x in marks.values for y in (x.name, x.name.rstrip(_DIGITS)) if y}  # M of M₁₁
    given = {key(x.name) for x in (*truth.model.parameters, *truth.model.inputs)} - own
    words = {key(x) for x in _WORD.findall(said)}
    return bool(words & own) and not words & given


def _with_marks(
    truth: Reference, marks: ValueMarks, line: AnsweredLine, rows: Sequence[AnsweredLine]
) -> sp.Expr | None:
    """An equation as it was read with marks; what it has of forces with names of the answer's own is not compared."""
    for expr in (x.expr for x in rows if x.number == line.number):
        if bounded.operations(expr) > LONGEST or not bounded.letters(expr) & marks.plain.keys():
            continue
        plain = [cast("sp.Expr", expr.xreplace(marks.plain)), line.expr]
        known = [cast("sp.Expr", x.xreplace(dict.fromkeys(_foreign(truth, x), sp.S.Zero))) for x in plain]
        rest = known[0] - known[1]
        if not rest.has(sp.nan, sp.zoo) and zero_everywhere(truth, rest):  # 0 in place of a name may divide
            return expr
    return None


def _foreign(truth: Reference, expr: sp.Expr) -> set[sp.Basic]:
    return {x for x in bounded.letters(expr) if isinstance(x, (sp.Symbol, AppliedUndef)) and x not in truth.names}


def _parts(marks: ValueMarks, expr: sp.Expr) -> list[PartOfValue]:
    """The parts of an equation that come from marked values."""
    used = bounded.letters(expr)
    found: list[PartOfValue] = []
    for of in marks.values:
        if of.added in used and not {of.added, of.scale} & marks.lost:
            factor, whole = (cast("sp.Expr", bounded.diff(expr, x).xreplace(marks.plain)) for x in (of.added, of.scale))
            if factor != 0 and bounded.terms(whole) <= (MOST_OVER_SUMS if _divides_by_sums(whole) else MOST_TERMS):
                found.append(PartOfValue(of, factor, frozenset(sp.Add.make_args(bounded.expand(whole)))))
    return found


def _divides_by_sums(expr: sp.Expr) -> bool:
    return any(x.exp.is_negative and x.base.is_Add for x in bounded.atoms(expr, sp.Pow))


def _multiplied(
    truth: Reference, marks: ValueMarks, expr: sp.Expr, coordinate: str | None
) -> tuple[sp.Expr, sp.Expr, tuple[TermDifference, ...]]:
    """An equation that is solved for its acceleration, times the denominator, this, and the terms that differ in it."""
    whole, under = map(cast("Any", sp.sympify), sp.fraction(bounded.together(expr)))
    plain, under = (cast("sp.Expr", x.xreplace(marks.plain)) for x in (whole, under))
    form = truth.form(plain)
    index = next((i for i, c in enumerate(truth.model.coordinates) if c.name == coordinate), None)
    solved = multiplied(truth, plain)
    if solved is not None:
        right = truth.form(solved[1])
    else:
        held = index is not None and all(plain.has(a) for a in truth.rows[index].atoms(sp.Derivative) if _is_second(a))
        right = truth.forms[index] if index is not None and held else None
    voted = ratio(form, right, unlike=0.5) if form is not None and right is not None else None
    if voted is None or form is None or right is None:
        return whole, under, ()
    return whole, under, differences(truth, form, right, voted[0], index, plain)


def _is_second(rate: sp.Derivative) -> bool:
    return bool(rate.derivative_count > 1)


def _made_in(parts: Sequence[PartOfValue], d: TermDifference, alone: bool) -> list[tuple[MarkedValue, TermDifference]]:
    """The values in which a wrong term was made, with what is wrong in them; none if it was made in the equation.

    ``alone``: the equation has only names, so that a term which is missing was left out of one of them.
    """
    if d.written != 0:
        written = set(sp.Add.make_args(bounded.expand(d.written)))
        holding = (p for p in parts if written <= p.terms and not (written == p.terms and p.is_factor))
        return list(islice(((p.of, own) for p in holding if (own := _in_value(p, d)) is not None), 1))
    found: list[tuple[MarkedValue, TermDifference]] = []
    for term in sp.Add.make_args(bounded.expand(d.term)) if alone else ():
        lacking = replace(d, term=term)
        own = [(p, x) for p in parts if not _is_still(p, term) and (x := _in_value(p, lacking)) is not None]
        fewest = min((_moving(x.term) for _, x in own), default=0)
        own = [(p, x) for p, x in own if _moving(x.term) == fewest]
        if not own:
            return []
        last = own[-1][0]  # of several names for the same, the first one
        found.append(next((p.of, x) for p, x in own if p.terms == last.terms))
    return found


def _is_still(part: PartOfValue, term: sp.Expr) -> bool:
    """Whether a term with an acceleration is none of a value, which has no acceleration and is multiplied by none."""
    exprs = (part.factor, *part.terms)
    return any(map(_is_second, _rates(term))) and not any(_is_second(d) for x in exprs for d in _rates(x))


def _rates(expr: sp.Expr) -> list[sp.Derivative]:
    return [d for d in expr.atoms(sp.Derivative) if isinstance(d, sp.Derivative)]


def _in_value(part: PartOfValue, d: TermDifference) -> TermDifference | None:
    """What is wrong in a value, of a term that is wrong in the equation; None if its factor is not in the term."""
    term, written = (_divided(x, part.factor) for x in (d.term, d.written))
    for x in (term, written):
        if sp.fraction(bounded.together(x))[1].atoms(AppliedUndef, sp.Derivative):
            return None
    return replace(d, term=term, written=written)


def _divided(term: sp.Expr, factor: sp.Expr) -> sp.Expr:
    """A term, or every one of a sum, by a factor of it; its other factors stay as they are written."""
    if factor.atoms(sp.Add):
        return bounded.cancel(cast("sp.Expr", term / factor))
    return cast("sp.Expr", sp.Add(*[x / factor for x in sp.Add.make_args(term)]))


def _moving(expr: sp.Expr) -> int:
    """How many coordinates and rates are factors of a term."""
    powers: dict[Any, Any] = dict(expr.as_powers_dict())
    return sum(abs(int(n)) for x, n in powers.items() if x.atoms(AppliedUndef) and n.is_Integer)
