"""Finds the second wrong line among balances with unknown forces of which one has a wrong term of its own.

J₁ φ₁″ = r₁ S₁ + c φ₁′ for − c φ₁′, and m y″ = m g − S₁ − S₂ without − b y′: as soon as the first is put right, the
second alone does not hold with the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.right_balances import marked
from lagrangian.check.explain.solved_forces import balances_of, is_true, left_out, place_of
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Status, TermDifference, Verdict
from lagrangian.page.formula import text


def with_second_balance(
    truth: Reference, lines: Sequence[AnsweredLine], asked: Verdict, verdict: Verdict, names: set[str]
) -> Verdict:
    """The verdict with the one balance that does not hold beside those with wrong terms of their own, which are put
    right for this; the other balances are right.

    ``lines`` have unknown forces, of which ``names`` are those that the answer solved. If nothing tells it, the verdict
    without what only says what a force is; ``asked`` has no finding of such lines.
    """
    own = {place_of(x): d for x in lines if (d := _of_its_own(x, verdict.findings))}
    if not own or truth.derivation.multipliers:
        return _without_what_says_forces(verdict, names)
    put = [replace(x, expr=_put_right(x, own.get(place_of(x), ()))) for x in lines]
    balances = balances_of(truth, put)
    places = left_out(balances) if balances is not None else []
    if balances is None or len(places) != 1 or place_of(balances.lines[places[0]]) in own:
        return _without_what_says_forces(verdict, names)
    (k,) = places
    forces = balances.forces_without(k)
    others = [x for x in balances.lines if x is not balances.lines[k]]
    if forces is None or not all(is_true(truth, x, truth.accelerations | forces) for x in others):
        return _without_what_says_forces(verdict, names)
    right = [x for x in others if place_of(x) not in own]
    found = marked(asked.findings, right, [Finding(balances.lines[k], Status.WRONG)], ())
    return replace(
        verdict,
        findings=tuple(replace(f, differences=own[at]) if (at := place_of(f.line)) in own else f for f in found),
    )


def _of_its_own(line: AnsweredLine, findings: Sequence[Finding]) -> tuple[TermDifference, ...]:
    """The terms of a wrong equation that stand in it, and not in a force that is put in."""
    found = [f for f in findings if f.is_open and place_of(f.line) == place_of(line)]
    terms = _terms(line.expr)
    return tuple(d for f in found for d in f.differences if (own := _terms(d.written)) and own <= terms)


def _put_right(line: AnsweredLine, wrong: Sequence[TermDifference]) -> sp.Expr:
    """A balance, left minus right, with what its own wrong terms should be."""
    return sp.Add(line.expr, *[d.term - d.written for d in wrong])


def _terms(expr: sp.Expr) -> set[sp.Basic]:
    """The terms of a sum, multiplied out."""
    return set[sp.Basic](sp.Add.make_args(bounded.expand(expr))) - {sp.S.Zero}


def _without_what_says_forces(verdict: Verdict, names: set[str]) -> Verdict:
    """The verdict on a wrong answer without calling a balance right that only says what a force is that was solved
    from it; with notes on what was not judged."""
    said = [
        f
        for f in verdict.findings
        if f.status.right and f.line.kind == "equation" and f.line.names & names and bounded.expand(f.line.expr) == 0
    ]
    notes = [text(f"'{f.line.text}' was not judged: it says what a force is, which was solved from it.") for f in said]
    findings = tuple(f for f in verdict.findings if f not in said)
    return replace(verdict, findings=findings, notes=(*verdict.notes, *notes))
