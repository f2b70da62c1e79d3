"""The check of an answer, from its lines to the verdict."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.beside import beside
from lagrangian.check.candidates import too_long
from lagrangian.check.consequences import follow_from_above
from lagrangian.check.coordinates import ProposedChange, QuickTest, candidates, in_these, likeliest, new_names
from lagrangian.check.declared import declared, speeds
from lagrangian.check.difference import Likeness, differences, likeness, paired
from lagrangian.check.eliminated import without_forces
from lagrangian.check.energy_theorem import is_energy_theorem, note_on
from lagrangian.check.hardness import hard_to_check
from lagrangian.check.lines import filled, without_forms
from lagrangian.check.mistakes import mistakes
from lagrangian.check.mistakes_beside_multipliers import named_beside_multipliers
from lagrangian.check.new_angles import check_in_any_angle
from lagrangian.check.numerators import multiplied
from lagrangian.check.own_constraints import unfolded
from lagrangian.check.own_forces import with_own_forces
from lagrangian.check.reference import Reference, truth_of
from lagrangian.check.relations import relations, without_relations
from lagrangian.check.rounded import unrounded
from lagrangian.check.row_words import findings_of, name_of
from lagrangian.check.rows import Kind, RowComparison, compare
from lagrangian.check.rows_put_in import energies_on_rows, with_rows_put_in
from lagrangian.check.special_cases import with_special_case
from lagrangian.check.spelling import Spelling, in_numbers, names_values, not_there, spelled, values_of
from lagrangian.check.stated import StatedQuantity, equations_follow, given, judge
from lagrangian.check.stated_coordinates import in_stated_coordinates
from lagrangian.check.verdict import AnsweredLine, Finding, Status, TermDifference, Verdict
from lagrangian.derive import Derived
from lagrangian.derive.algebra import Form
from lagrangian.page.formula import Text, text
from lagrangian.records import dataclass

_log = logging.getLogger(__name__)


@bounded.answered(
    "checking the answer", hard_to_check, "shorten the lines of the answer, and the expressions of the system"
)
def check(derivation: Derived, lines: Sequence[AnsweredLine], *, hint: int = 3, explain: bool = True) -> Verdict:
    """Return what is right and what is wrong in an answer, line by line and as a whole.

    Lines are checked in order. Equality is decided in normal form or, if there is none, with 50 digits. Without
    ``explain``, mistakes are not sought.
    """
    _log.info("checking the answer")
    truth = truth_of(derivation)
    said = declared(truth, lines)
    truth = truth.with_values(said.values) if said.values else truth
    truth.algebra.renew()
    judged, unjudged = without_forms(truth, said.lines)
    verdict = _checked(truth, judged, hint, explain)
    verdict = replace(verdict, notes=(*unjudged, *verdict.notes))
    if (assumed := said.told(truth)) is None:
        return verdict
    note = text("Right if " if verdict.right else "With ", *assumed.parts, ".")
    return replace(verdict, notes=(note, *verdict.notes))


def _checked(truth: Reference, lines: Sequence[AnsweredLine], hint: int, explain: bool) -> Verdict:
    """The verdict on an answer whose own names are written out."""
    written = filled(truth, lines)
    if truth.derivation.multipliers:
        read = unfolded(truth, written)
        verdict = read.judged(lambda said: check_in_any_angle(truth, said, hint))
        verdict = energies_on_rows(truth, read.lines, verdict, hint)
        if not explain:
            return verdict
        named = named_beside_multipliers(truth, read.lines, verdict, lambda x: _judged(truth, x).findings)
        return with_special_case(truth, with_rows_put_in(truth, read.lines, named))
    written, told = speeds(truth, written)
    forces = without_forces(truth, written)
    if forces is not None:
        verdict = _valued(truth, forces.lines, forces.lines, hint, False)
        if verdict.right:
            return replace(verdict, notes=(*told, forces.note, *verdict.notes))
    verdict = _valued(truth, lines, written, hint, explain)
    if (own := with_own_forces(lines, written, verdict)) is not None:
        read = _valued(truth, own.lines, own.written, hint, False)
        verdict = replace(read, notes=(*read.notes, own.note)) if read.right else verdict
    return replace(verdict, notes=(*told, *verdict.notes))


def _valued(
    truth: Reference, lines: Sequence[AnsweredLine], written: Sequence[AnsweredLine], hint: int, explain: bool
) -> Verdict:
    """The verdict on an answer in letters or, if that is not right, in numbers."""
    values = values_of(truth, written)
    numbers = bool(values) and in_numbers(truth, written)
    verdict = _read(truth, spelled(truth, written), hint, explain=explain and not numbers)
    if verdict.right or verdict.status is Status.INCOMPLETE or not values:
        return verdict
    sure = values if numbers or not names_values(truth, written) else {p: v for p, v in values.items() if v != 1}
    if sure:
        put = _put(truth, lines, sure, hint, explain=explain and numbers)
        if put.right or numbers:
            return put
    if len(sure) < len(values) and _put(truth, lines, values, hint, explain=False).right:
        ones = [x for p in sorted(values.keys() - sure.keys(), key=str) for x in (p, " = 1, ")]
        note = text("It would be right with ", *ones[:-1], " = 1; a letter that is given must be written.")
        return replace(verdict, notes=(*verdict.notes, note))
    return verdict


def _put(
    truth: Reference, lines: Sequence[AnsweredLine], values: Mapping[sp.Symbol, sp.Expr], hint: int, *, explain: bool
) -> Verdict:
    """The verdict on an answer with values substituted for the parameters that it does not name."""
    valued = truth.with_values(values)
    read = _with_values(values, spelled(valued, filled(valued, lines), numbers=False))
    return _read(valued, read, hint, explain=explain)


def _read(truth: Reference, spelling: Spelling, hint: int, *, explain: bool) -> Verdict:
    """The verdict on an answer whose names are known; with ``explain``, also the mistakes that explain it."""
    lines, told = unrounded(truth, spelling.lines)
    spelling = replace(spelling, lines=lines, notes=(*spelling.notes, *told))
    judged = _judged(truth, spelling.lines, compared=explain)
    verdict = Verdict(judged.status, judged.findings, notes=spelling.notes + judged.notes, hint=hint)
    if judged.status.right or judged.status is Status.INCOMPLETE:
        return replace(verdict, combination=judged.combination)
    return (
        _elsewhere(truth, spelling, verdict, explain)
        or (_own_names(truth, spelling, verdict) if explain else None)
        or (_explained(truth, spelling, judged, verdict) if explain else verdict)
    )


@dataclass(frozen=True, eq=False)
class Judged:
    """The findings for all lines, and the overall verdict."""

    status: Status
    findings: tuple[Finding, ...]
    comparison: RowComparison
    notes: tuple[Text, ...] = ()

    @property
    def combination(self) -> tuple[tuple[sp.Expr, ...], ...] | None:
        """The factors of the right equations in those of the answer, if all were found."""
        rows = [r for r in self.comparison.rows if r.kind is not Kind.NOTHING]
        return tuple(r.factors or () for r in rows) if rows and all(r.factors is not None for r in rows) else None


def _judged(
    truth: Reference, lines: Sequence[AnsweredLine], change: ProposedChange | None = None, *, compared: bool = True
) -> Judged:
    """Judge every line, and the equations together; with a change, everything is converted to the system's
    coordinates. Unless they are ``compared``, it is not said in which terms wrong equations differ."""
    moved = lines if change is None else [replace(line, expr=change.put(line.expr)) for line in lines]
    turn = change.turn(truth) if change is not None else None
    truth = truth.within(change.region(truth)) if change is not None else truth
    equations = [line for line in moved if line.kind == "equation"]
    comparison = compare(truth, [line.expr for line in equations])
    moved, aside = beside(truth, moved, comparison)
    if aside:
        equations = [line for line in moved if line.kind == "equation"]
        comparison = compare(truth, [line.expr for line in equations])
    above = given(truth, moved)
    told = _equations(truth, equations, comparison, above) if compared else findings_of(truth, equations, comparison)
    found = dict(zip(map(id, equations), told, strict=True))
    findings: list[Finding] = []
    for k, (line, own) in enumerate(zip(moved, lines, strict=True)):
        if line.kind in ("definition", "statement"):
            continue
        finding = found[id(line)] if line.kind == "equation" else judge(truth, moved, k, turn)
        findings.append(replace(finding, line=own))
    return Judged(*_overall(truth, comparison, findings), comparison, (*_missing(truth, comparison), *aside))


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
    if kinds <= {Kind.SAME, Kind.SCALED, Kind.COMBINED}:
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
                notes.append(text("The equation of ", c.symbol, " is missing."))
    return tuple(notes)


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
        pairs |= zip(some, paired([likeness(forms[j], truth.forms) for j in some], taken), strict=True)
    found = findings_of(truth, lines, comparison)
    for j in wrong:
        line, like, form = lines[j], pairs[j], forms[j]
        others = [_differing(truth, form, truth.forms[like.index], like)] if like is not None else []
        if j in solved and like is not None:
            accelerations = [c.acceleration for c in truth.model.coordinates]
            alone = Likeness(next(i for i, a in enumerate(accelerations) if line.expr.has(a)), sp.S.One, 1.0)
            others.insert(0, _differing(truth, *(truth.form(x) for x in solved[j]), alone))
        told = [x for x in others if x is not None]
        if not told:
            found[j] = Finding(line, Status.WRONG, note_on(truth, line.expr, right=False), follows=follow[j])
            continue
        # solved for its acceleration, or an equation that lacks another one
        index, differing = min(told, key=lambda x: (not x[1], len(x[1])))
        name = name_of(truth, index)
        found[j] = Finding(line, Status.WRONG, None, name, differing, follow[j], _elements(truth, index))
    return found


def _differing(
    truth: Reference, form: Form | None, right: Form | None, like: Likeness
) -> tuple[int, tuple[TermDifference, ...]] | None:
    """The right equation that one is compared with, and the terms that differ; None for one without a normal form."""
    if form is None or right is None:
        return None
    return like.index, differences(truth, form, right, like.factor, like.index)


def _elements(truth: Reference, index: int) -> tuple[str, ...]:
    """The elements that add to a right equation."""
    return tuple(dict.fromkeys(e for term in truth.derivation.terms[index] for e in term.elements))


# -- other coordinates, and what went wrong ---------------------------------------------------------------------------


def _elsewhere(truth: Reference, spelling: Spelling, verdict: Verdict, explain: bool) -> Verdict | None:
    """The verdict in other coordinates if the answer is right in some; a known mistake has precedence over an unstated
    change, which without ``explain`` is not considered."""
    whole, new = QuickTest(truth, spelling.lines), new_names(truth, spelling.lines)
    found = relations(new, spelling.lines)
    for change in candidates(truth, spelling.lines):
        told = without_relations(found, change.put, spelling.lines) if found else spelling.lines
        glance = QuickTest(truth, told) if found else whole
        if not glance.may_be(change):
            continue
        judged = _judged(truth, told, change, compared=False)
        if not judged.status.right and judged.status is not Status.INCOMPLETE:
            continue
        if not change.plain and not explain:
            continue
        if not change.plain or not (new or _tells(spelling.lines)):
            findings = verdict.findings if explain else _judged(truth, spelling.lines).findings
            named = mistakes(truth, spelling.lines, findings)
            if named.certain or too_long(truth):
                note = text("It would be right with ", *change.words.parts, ".")
                return replace(
                    verdict,
                    mistakes=named.told,
                    alternatives=named.others,
                    notes=(*verdict.notes, note),
                    sure=named.sure,
                )
        status = Status.OTHER_COORDINATES if judged.status.right else judged.status
        notes = (*spelling.notes, change.told, *judged.notes)
        return Verdict(
            status,
            judged.findings,
            combination=judged.combination,
            change=change.table,
            notes=notes,
            hint=verdict.hint,
        )
    return None


def _tells(lines: Sequence[AnsweredLine]) -> bool:
    """Whether an answer contains enough to distinguish a relative coordinate from a wrong absolute one."""
    kinds = {line.kind for line in lines}
    return bool(kinds & {"equation", "L"}) or {"T", "V"} <= kinds


def _with_values(values: Mapping[sp.Symbol, sp.Expr], spelling: Spelling) -> Spelling:
    """The verdict on an answer with numbers: the values of the parameters are substituted."""
    named = [x for p in sorted(values, key=str) for x in (p, ", ")][:-1]
    return replace(spelling, notes=(*spelling.notes, text("The values of ", *named, " are substituted.")))


def _own_names(truth: Reference, spelling: Spelling, verdict: Verdict) -> Verdict | None:
    """The verdict on a wrong answer with its own coordinates: the system is converted to these and compared again."""
    if not new_names(truth, spelling.lines):
        return _own_coordinates(truth, spelling, verdict)
    change = likeliest(truth, spelling.lines)
    other = in_these(truth, change) if change is not None else None
    if change is None or other is None:
        return None
    told = without_relations(relations(list(change.table), spelling.lines), change.put, spelling.lines)
    lines = tuple(line for line in told if line.kind != "definition")
    return _in_these(other, lines, change, spelling, verdict)


def _own_coordinates(truth: Reference, spelling: Spelling, verdict: Verdict) -> Verdict | None:
    """The verdict on a wrong answer in coordinates that it defines, if its mistakes are found in these."""
    if (own := in_stated_coordinates(truth, spelling.lines)) is None:
        return None
    found = _in_these(own.truth, own.lines, own.change, spelling, verdict)
    return found if found is not None and found.mistakes else None


def _in_these(
    other: Reference, lines: tuple[AnsweredLine, ...], change: ProposedChange, spelling: Spelling, verdict: Verdict
) -> Verdict | None:
    """The verdict on lines in the coordinates of another reference; None if they are right there."""
    judged = _judged(other, lines)
    if judged.status.right:  # equal only in double precision
        return None
    named = mistakes(other, lines, judged.findings)
    note = text("Your coordinates were read ", *change.words.parts, ".")
    return Verdict(
        judged.status,
        judged.findings,
        named.told,
        named.others,
        change=change.table,
        notes=(*spelling.notes, note),
        hint=verdict.hint,
        sure=named.sure,
    )


def _explained(truth: Reference, spelling: Spelling, judged: Judged, verdict: Verdict) -> Verdict:
    """The verdict, with the mistakes that explain the answer."""
    named = mistakes(truth, spelling.lines, judged.findings)
    notes = (*verdict.notes, *(not_there(truth.model, name) for name in new_names(truth, spelling.lines)))
    if too_long(truth) or not truth.tried_all:
        every = "" if too_long(truth) else "all "
        said = f"The system is too long for {every}well-known mistakes to be tried; its terms are compared."
        notes = (*notes, text(said))
    if named.told and named.left:
        lines = [x for line in named.left for x in (line.title, ", ")][:-1]
        notes = (
            *notes,
            text(*lines, " differs in other ways as well." if len(named.left) == 1 else " differ as well."),
        )
    return replace(verdict, mistakes=named.told, alternatives=named.others, notes=notes, sure=named.sure)
