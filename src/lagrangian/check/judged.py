"""Judges the lines of an answer one by one, and its equations together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.balances import with_balances
from lagrangian.check.beside import beside
from lagrangian.check.coordinates.chart import of_unknown, with_own_quantities
from lagrangian.check.coordinates.tried import ProposedChange
from lagrangian.check.difference import Likeness, differences, likeness, nearest, paired, voted
from lagrangian.check.explain.after_definitions import follow_from_definitions
from lagrangian.check.explain.after_derivatives import (
    follow_from_derivatives,
    with_consequences,
    with_right_derivatives,
)
from lagrangian.check.explain.after_given_rates import follow_from_given_rates
from lagrangian.check.explain.after_own_rates import follow_from_own_rates
from lagrangian.check.explain.consequences import follow_from_above
from lagrangian.check.explain.energies_of_bodies import untrue_of_bodies
from lagrangian.check.explain.energy_theorem import is_energy_theorem, note_on
from lagrangian.check.explain.inner_rates import follow_from_inner_rates
from lagrangian.check.explain.numerators import multiplied
from lagrangian.check.explain.rates_of_energies import follow_from_rates
from lagrangian.check.explain.row_words import findings_of, name_of
from lagrangian.check.explain.two_values import follow_from_values
from lagrangian.check.forces_in_parts import with_forces_in_parts
from lagrangian.check.moving_frame import with_effective_potential, with_hamiltonian
from lagrangian.check.names.own_forces import without_own_names
from lagrangian.check.reference import Reference
from lagrangian.check.rows import Kind, RowComparison, compare, zero_everywhere
from lagrangian.check.stated import StatedQuantity, equations_follow, given, judge
from lagrangian.check.together import right_together
from lagrangian.check.verdict import IS_MISSING, OWN_DERIVATIVES, AnsweredLine, Finding, Status, TermDifference
from lagrangian.derive.algebra import Form
from lagrangian.model import time
from lagrangian.page.formula import Name, Text, text
from lagrangian.records import dataclass

REPEATED = 0.3
"""By how much more a wrong equation resembles one that another line says already, where it is meant to be that."""


@dataclass(frozen=True, eq=False)
class Judged:
    """The findings for all lines, and the overall verdict; ``motion``: the last equations of motion are right."""

    status: Status
    findings: tuple[Finding, ...]
    comparison: RowComparison
    notes: tuple[Text, ...] = ()
    motion: bool = False

    @property
    def combination(self) -> tuple[tuple[sp.Expr, ...], ...] | None:
        """The factors of the right equations in those of the answer, if all were found."""
        rows = [r for r in self.comparison.rows if r.kind is not Kind.NOTHING]
        return tuple(r.factors or () for r in rows) if rows and all(r.factors is not None for r in rows) else None


def judged_lines(
    truth: Reference, lines: Sequence[AnsweredLine], change: ProposedChange | None = None, *, compared: bool = True
) -> Judged:
    """Judge every line, and the equations together; with a change, everything is converted to the system's
    coordinates. Unless they are ``compared``, it is not said in which terms wrong equations differ."""
    chart = change.chart(truth, lines) if change is not None else None
    lines, called = with_hamiltonian(truth, lines) if change is None else (lines, ())
    lines = lines if chart is None else with_own_quantities(truth, lines, chart)
    moved = lines if change is None else [replace(line, expr=change.put(line.expr)) for line in lines]
    truth = truth.within(change.region(truth)) if change is not None else truth
    moved = with_balances(truth, moved, moved=change is not None)
    equations = [line for line in moved if line.kind == "equation"]
    comparison = compare(truth, [line.expr for line in equations])
    moved, aside = beside(truth, moved, comparison)
    if aside:
        equations = [line for line in moved if line.kind == "equation"]
        comparison = compare(truth, [line.expr for line in equations])
    above = given(truth, moved)
    told = _equations(truth, equations, comparison, above) if compared else findings_of(truth, equations, comparison)
    of_equation = dict(zip(map(id, equations), told, strict=True))
    findings: list[Finding] = []
    alone = untrue_of_bodies(truth, moved)
    for k, (line, own) in enumerate(zip(moved, lines, strict=True)):
        if line.kind in ("definition", "statement"):
            findings += [replace(alone[k], line=own)] if k in alone else []
            continue
        finding = of_equation[id(line)] if line.kind == "equation" else judge(truth, moved, k, chart, compared=compared)
        if finding is not None:
            findings.append(replace(finding, line=own))
        else:
            aside = (*aside, of_unknown(line))
    findings, named = without_own_names(truth, lines, findings)
    aside = (*called, *aside, *named)
    if change is None:
        findings = with_forces_in_parts(truth, findings, moved)
        findings = with_effective_potential(truth, findings, motion=of_equations(truth, comparison).right)
        findings = follow_from_derivatives(truth, right_together(truth, with_right_derivatives(truth, findings)))
        findings = follow_from_definitions(
            truth, findings, lambda x, own: judged_lines(x, own, compared=False).findings
        )
        findings = follow_from_inner_rates(truth, follow_from_given_rates(truth, findings))
        findings = follow_from_values(truth, follow_from_own_rates(truth, follow_from_rates(truth, findings)))
        findings = with_consequences(truth, _with_wrong_names(truth, findings))
    status, found = _overall(truth, comparison, _told_once(truth, findings))
    right = sum(f.status.right for f in found if f.line.kind == "equation")
    by_name = _use_wrong_slopes(found) or right < sum(row.true for row in comparison.rows)
    motion = status is Status.WRONG and _ends_right(truth, equations, comparison) and not by_name
    silent = _silent(truth, moved)
    if silent and status.right:
        status = Status.INCOMPLETE
    return Judged(status, found, comparison, (*_missing(truth, comparison), *silent, *aside), motion)


def _told_once(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings; of a wrong energy that a line gives in several forms, the terms that differ in the shortest one."""
    told = list(findings)
    for k, one in enumerate(told):
        same = [
            j
            for j, x in enumerate(told[:k])
            if (x.line.number, x.line.kind, x.line.name) == (one.line.number, one.line.kind, one.line.name)
            and x.differences
            and one.differences
            and one.line.kind != "equation"
        ]
        for j in same:
            if zero_everywhere(truth, one.line.expr - told[j].line.expr):
                longer = max(k, j, key=lambda i: len(told[i].differences))
                told[longer] = replace(told[longer], differences=())
    return told


def _ends_right(truth: Reference, lines: Sequence[AnsweredLine], comparison: RowComparison) -> bool:
    """Whether the equations behind the last wrong one that accelerates are as many as there are coordinates; a remark
    is not the last word."""
    accelerations = [c.acceleration for c in truth.model.coordinates]
    told = [j for j, row in enumerate(comparison.rows) if row.kind is Kind.WRONG and not lines[j].beside]
    exprs = [line.expr for line in lines]
    wrong = [j for j in told if exprs[j].has(*accelerations)]
    rows = exprs[wrong[-1] + 1 :] if wrong else exprs
    rank = comparison.rank if rows is exprs or len(rows) < truth.n else compare(truth, rows).rank
    return len(rows) >= truth.n and rank >= truth.n


def _with_wrong_names(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with the equations marked that are right by a name of the system alone of which a line above says
    what is wrong: ṡ = b c cos θ θ̇/(2 s), and then c ṡ."""
    names = {x for own in truth.placed for x in (own, bounded.diff(own, time))}
    wrong = [
        (f.line.number, f.line.sides[0])
        for f in findings
        if f.is_open and f.line.kind in ("equation", "identity") and f.line.sides and f.line.sides[0] in names
    ]
    if not wrong:
        return list(findings)

    def uses(finding: Finding) -> bool:
        line = finding.line
        above = [x for number, x in wrong if number < line.number]
        named = bool(above) and line.sides is not None and any(x.has(*above) for x in line.sides)
        return named and line.kind == "equation" and finding.status.right

    return [replace(f, status=Status.WRONG, note=None, follows=True) if uses(f) else f for f in findings]


def _use_wrong_slopes(findings: Sequence[Finding]) -> bool:
    """Whether an equation names a derivative of an energy that has a wrong value: m s″ + dV/ds = F is right by the
    name alone."""
    wrong = [f.line for f in findings if f.line.kind in OWN_DERIVATIVES and f.status is Status.WRONG]
    named = {"".join(x.text.split("=")[0].split()) for x in wrong if "=" in x.text} - {""}
    rows = ["".join(f.line.text.split()) for f in findings if f.line.kind == "equation"]
    return any(len(x) > 3 and x in row for x in named for row in rows)


def _overall(
    truth: Reference, comparison: RowComparison, findings: Sequence[Finding]
) -> tuple[Status, tuple[Finding, ...]]:
    """The overall verdict: that of the worst line, or that of the equations together."""
    statuses = [f.status for f in findings if f.line.kind != "equation"]
    if comparison.rows:
        statuses.append(of_equations(truth, comparison))
    order = list(Status)
    worst = max(statuses, key=order.index, default=Status.INCOMPLETE)
    return worst, tuple(findings)


def of_equations(truth: Reference, comparison: RowComparison) -> Status:
    """The verdict on a set of equations."""
    rows = [r for r in comparison.rows if r.kind is not Kind.NOTHING]
    if any(r.kind is Kind.WRONG for r in rows):
        return Status.WRONG
    if comparison.rank < truth.n:
        return Status.INCOMPLETE
    kinds = {r.kind for r in rows}
    if kinds == {Kind.SAME} and [r.index for r in rows] == list(range(truth.n)):
        return Status.RIGHT
    each = {r.index for r in rows if r.kind is Kind.SAME} >= set(range(truth.n))
    if each or kinds <= {Kind.SAME, Kind.SCALED, Kind.COMBINED}:
        return Status.EQUIVALENT
    return Status.SAME_MOTION


def _missing(truth: Reference, comparison: RowComparison) -> tuple[Text, ...]:
    """What is missing in a set of right equations that is too small, in words."""
    rows = comparison.rows
    if not rows or comparison.rank >= truth.n or any(r.kind is Kind.WRONG for r in rows):
        return ()
    count = "one" if truth.n == 1 else str(truth.n)
    plural = "" if truth.n == 1 else "s"
    notes = [
        text(
            f"A system with {count} generalized coordinate{plural} has {count} equation{plural} of motion; yours say ",
            f"{comparison.rank} independent thing{'' if comparison.rank == 1 else 's'}.",
        )
    ]
    said = {r.index for r in rows if r.index is not None}
    if len(said) == comparison.rank:
        for i, c in enumerate(truth.model.coordinates):
            if i not in said:
                notes.append(text("The equation of ", c.symbol, f"{IS_MISSING}."))
    return tuple(notes)


def _silent(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[Text, ...]:
    """Which energy no line of an answer states that has forces and the other energy, and no equation of motion."""
    kinds = {x.kind for x in lines}
    if kinds & {"equation", "left", "L"} or "Xi" not in kinds or not kinds & {"T", "V"}:
        return ()
    moving = [x for c in truth.model.coordinates for x in (c.symbol, c.rate)]
    energies = (("T", Name("T*"), truth.T), ("V", Name("V"), truth.V))
    return tuple(
        text(name, f"{IS_MISSING}: no line states it as a whole, so it was not judged.")
        for kind, name, energy in energies
        if kind not in kinds and truth.expand(energy).has(*moving)
    )


# -- equations --------------------------------------------------------------------------------------------------------


def _equations(
    truth: Reference, lines: Sequence[AnsweredLine], comparison: RowComparison, above: StatedQuantity
) -> list[Finding]:
    """The findings for every equation; a wrong one is compared with the right equation that it resembles most."""
    taken = [r.index for r in comparison.rows if r.true and r.index is not None]
    wrong = [j for j, r in enumerate(comparison.rows) if r.kind is Kind.WRONG]
    solved = {j: pair for j in wrong if (pair := multiplied(truth, lines[j].expr)) is not None}
    forms = {j: None if is_energy_theorem(truth, x := lines[j].expr) else truth.form(x) for j in wrong}
    follow = dict(zip(wrong, equations_follow(truth, [lines[j].expr for j in wrong], above), strict=True))
    follow |= dict.fromkeys(follow_from_above(truth, [line.expr for line in lines], wrong), True)
    pairs: dict[int, Likeness | None] = {}
    for later in (False, True):  # the same equations once more do not take the places of the first ones
        some = [j for j in wrong if follow[j] is later]
        likes = [likeness(forms[j], truth.forms) for j in some]
        pairs |= zip(some, [_meant(x, y) for x, y in zip(paired(likes, taken), likes, strict=True)], strict=True)
    found = findings_of(truth, lines, comparison)
    for j in wrong:
        line, like, form = lines[j], pairs[j], forms[j]
        like = voted(truth, line.expr, truth.forms[like.index], like) if like is not None and form is not None else like
        others = [_differing(truth, line.expr, form, truth.forms[like.index], like)] if like is not None else []
        if j in solved and like is not None:
            accelerations = [c.acceleration for c in truth.model.coordinates]
            alone = Likeness(next(i for i, a in enumerate(accelerations) if line.expr.has(a)), sp.S.One, 1.0)
            form, right = (truth.form(x) for x in solved[j])
            others.insert(0, _differing(truth, solved[j][0], form, right, alone))
        told = [] if _is_kinematic(truth, line.expr) else [x for x in others if x is not None]
        if not told:
            found[j] = Finding(line, Status.WRONG, note_on(truth, line.expr, right=False), follows=follow[j])
            continue
        # solved for its acceleration, or an equation that lacks another one
        index, differing = min(told, key=lambda x: (not x[1], len(x[1])))
        differing = () if _divided(truth, index, differing) else differing
        name = name_of(truth, index)
        found[j] = Finding(line, Status.WRONG, None, name, differing, follow[j], _elements(truth, index))
    return found


def _meant(free: Likeness | None, likes: Sequence[Likeness]) -> Likeness | None:
    """The right equation that a wrong one is meant to be: one that no other line says, unless it resembles one that is
    said already by far more, as a result that repeats a balance above."""
    best = nearest(likes)
    return best if best is not None and (free is None or best.score - free.score > REPEATED) else free


def _is_kinematic(truth: Reference, expr: sp.Expr) -> bool:
    """Whether a line has rates and lengths alone, as a squared speed, where nothing holds the coordinates together: it
    is no equation of motion."""
    if truth.derivation.multipliers or expr.has(*(c.acceleration for c in truth.model.coordinates)):
        return False
    places = [x for p in truth.model.points for x in truth.model.position(p)]
    lengths = set[sp.Basic]().union(*(truth.expand(x).free_symbols for x in places))
    return expr.has(sp.Derivative) and expr.free_symbols <= lengths | {time}


def _differing(
    truth: Reference, expr: sp.Expr, form: Form | None, right: Form | None, like: Likeness
) -> tuple[int, tuple[TermDifference, ...]] | None:
    """The right equation that one is compared with, and the terms that differ; None for one without a normal form."""
    if form is None or right is None:
        return None
    found = differences(truth, form, right, like.factor, like.index, expr)
    accelerations = [c.acceleration for c in truth.model.coordinates]
    if like.factor in (1, -1) and any(d.kind == "sign" and d.term.has(*accelerations) for d in found):
        other = differences(truth, form, right, -like.factor, like.index, expr)
        if not any(d.term.has(*accelerations) for d in other):  # m y″ has a sign that everybody knows
            return like.index, other
    return like.index, found


def _divided(truth: Reference, index: int, differing: Sequence[TermDifference]) -> bool:
    """Whether terms are divided by sums by which no right one is: those of a solved form."""
    own = _divisors(truth.rows[index])
    return any(not _divisors(x) <= own for d in differing for x in (d.term, d.written))


def _divisors(expr: sp.Expr) -> set[sp.Basic]:
    return {p.base for p in expr.atoms(sp.Pow) if isinstance(p.base, sp.Add) and p.exp.is_negative}


def _elements(truth: Reference, index: int) -> tuple[str, ...]:
    """The elements that add to a right equation."""
    return tuple(dict.fromkeys(e for term in truth.derivation.terms[index] for e in term.elements))
