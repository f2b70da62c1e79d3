"""A component of a velocity or an acceleration that is wrong beside another one of the same point that is right.

a_y = b θ̈ cos θ − …   is that of the pan along y, so a_x is that of the pan along x, whatever else uses it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.quantities import Effect, Sayable, accelerations_of, quantities_of
from lagrangian.check.explain.said_wrongly import SaidWrongly, in_words, right_quantities
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, Verdict, inserted
from lagrangian.page.formula import text

AXES = "xyz"
"""What names of components end with."""
KINDS = ("component", "acceleration")
"""The kinds of quantities that are counted from no place."""
LONGEST = 60
"""The most operations of such a definition."""


def with_other_components(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer, with such definitions as mistakes where nothing was said of them before."""
    if verdict.status is not Status.WRONG or verdict.hint == 0:
        return verdict
    known = {(f.line.number, f.line.text) for f in verdict.findings}
    named = [x for x in lines if x.kind == "definition" and x.name and (x.name[-1:].lower() in AXES)]
    open_ones = [x for x in named if (x.number, x.text) not in known and bounded.operations(x.expr) <= LONGEST]
    findings, more = list(verdict.findings), list[tuple[int, Mistake]]()
    for line in open_ones:
        for said in _wrong(truth, line, [x for x in named if x is not line]):
            findings = inserted(findings, Finding(line, Status.WRONG))
            more.append((line.number, said.mistake))
            break
    if not more:
        return verdict
    first = next((f.line.number for f in verdict.open_findings), None)
    above = [m for number, m in more if first is None or number < first]
    below = [m for _, m in more if m not in above]
    return replace(verdict, findings=tuple(findings), mistakes=(*above, *verdict.mistakes, *below))


def _wrong(truth: Reference, line: AnsweredLine, others: Sequence[AnsweredLine]) -> Iterator[SaidWrongly]:
    """What a definition has wrong of the quantity whose other component another one is."""
    name = str(line.name)
    for other in others:
        theirs = str(other.name)
        if theirs[:-1] != name[:-1] or theirs[-1].lower() == name[-1].lower():
            continue
        for q in right_quantities(truth, other):
            for own in _of_same(truth, q, theirs[-1].lower(), name[-1].lower()) if q.kind in KINDS else ():
                if _is_like(truth, line.expr, own.right):
                    words = partial(in_words, quantities_of(truth).of, own, line.expr, 1)
                    yield SaidWrongly(line, Effect(), words, right=own.right)


def _of_same(truth: Reference, q: Sayable, theirs: str, axis: str) -> Iterator[Sayable]:
    """The component of the same quantity along another axis, by its words: the x component of the acceleration of …"""
    words = text(*q.words)
    meant = str(words).replace(f"{theirs} component of ", f"{axis} component of ")
    if meant != str(words):
        every = accelerations_of(truth) if q.kind == "acceleration" else quantities_of(truth)
        yield from (x for x in every.all if x.kind == q.kind and str(text(*x.words)) == meant)


def _is_like(truth: Reference, written: sp.Expr, right: sp.Expr) -> bool:
    """Whether a wrong component has a term of the right one, and is not this one in another sense."""
    own, theirs = (truth.put(truth.expand(x)) for x in (written, right))
    if any(zero_everywhere(truth, own - s * theirs) for s in (1, -1)):
        return False
    one, other = (set(cast("tuple[sp.Expr, ...]", sp.Add.make_args(bounded.expand(x)))) for x in (own, theirs))
    return bool(one & other)
