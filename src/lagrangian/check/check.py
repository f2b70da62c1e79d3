"""The check of an answer, from its lines to the verdict."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache, partial

import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.eliminated import without_forces
from lagrangian.check.constraints.inputs_beside import judged_with_inputs
from lagrangian.check.constraints.new_angles import check_in_any_angle
from lagrangian.check.constraints.on_branch import on_branch
from lagrangian.check.constraints.own_angle import without_own_angles
from lagrangian.check.constraints.own_constraints import unfolded
from lagrangian.check.constraints.own_counted import without_own_counts
from lagrangian.check.constraints.without_constraints import without_constraints
from lagrangian.check.coordinates.chart import chart, region, system_coordinates, with_own_quantities
from lagrangian.check.coordinates.relations import relations, without_relations
from lagrangian.check.coordinates.renamed import OwnNames, names_only
from lagrangian.check.coordinates.tried import ProposedChange, QuickTest, candidates, in_these, likeliest, new_names
from lagrangian.check.explain.advice import with_fitting_advice
from lagrangian.check.explain.as_they_stand import (
    with_terms_as_they_stand,
    with_terms_as_written,
    without_shared_signs,
)
from lagrangian.check.explain.candidates import too_long
from lagrangian.check.explain.definitions import with_right_definitions, with_wrong_definitions
from lagrangian.check.explain.derivatives_said import with_terms_of_equations
from lagrangian.check.explain.forces_named import with_forces_named
from lagrangian.check.explain.in_own_names import in_own_names
from lagrangian.check.explain.mistakes import mistakes
from lagrangian.check.explain.mistakes_beside_multipliers import named_beside_multipliers
from lagrangian.check.explain.other_forces import without_other_forces
from lagrangian.check.explain.parts_of_energies import with_parts_judged, without_made_names
from lagrangian.check.explain.rows_put_in import energies_on_rows, with_rows_put_in
from lagrangian.check.explain.said_again import as_said_of_others
from lagrangian.check.explain.said_in_numbers import said_in_numbers
from lagrangian.check.explain.sides_said import with_sides
from lagrangian.check.explain.special_cases import with_special_case
from lagrangian.check.explain.twice_said import with_twice_said
from lagrangian.check.explain.virtual_displacements import with_virtual_displacements
from lagrangian.check.explain.whole_terms import with_whole_terms
from lagrangian.check.explain.wrong_terms import with_wrong_terms
from lagrangian.check.explained import explained
from lagrangian.check.general import untrue_in_general
from lagrangian.check.given_slopes import with_given_slopes
from lagrangian.check.hardness import hard_to_check
from lagrangian.check.judged import judged_lines
from lagrangian.check.lines import filled, without_forms, without_periods
from lagrangian.check.momenta_said import with_rates_of_momenta
from lagrangian.check.names.amounts_said import judged_with_amounts
from lagrangian.check.names.declared import Declared, declared, likeliest_speeds, speeds
from lagrangian.check.names.own_forces import with_own_forces
from lagrangian.check.names.spelling import (
    Spelling,
    in_numbers,
    names_values,
    spelled,
    substituted,
    values_meant,
    values_of,
)
from lagrangian.check.names.values_at_rest import without_balanced_weights
from lagrangian.check.numbers_beside import numbers_alone, with_definitions_in_values, with_numbers_beside
from lagrangian.check.own_coordinates import off_constraints, right_in_own_coordinates
from lagrangian.check.reference import Reference, truth_of
from lagrangian.check.rounded import unrounded, with_prescribed_unrounded
from lagrangian.check.stated_apart import with_energies_apart, with_forces_apart, without_first_parts
from lagrangian.check.stated_numbers import with_stated_numbers
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.check.virtual_work import judged_with_work
from lagrangian.check.wrong_in_own_coordinates import (
    wrong_in,
    wrong_in_stated_coordinates,
    wrong_without_constraints,
)
from lagrangian.derive import Derived
from lagrangian.page.formula import text

_log = logging.getLogger(__name__)
MOST_PUT = 16
"""The most answers with values put in whose verdicts are kept."""


@bounded.answered(
    "checking the answer",
    hard_to_check,
    "shorten the lines of the answer, and the expressions of the system",
    once=True,
)
def check(derivation: Derived, lines: Sequence[AnsweredLine], *, hint: int = 3, explain: bool = True) -> Verdict:
    """Return what is right and what is wrong in an answer, line by line and as a whole.

    Lines are checked in order. Equality is decided in normal form or, if there is none, with 50 digits. Without
    ``explain``, mistakes are not sought; at ``hint`` 0, which tells none, only those that decide what is right.
    """
    _log.info("checking the answer")
    truth = truth_of(derivation)
    work = partial(judged_with_work, truth, judge=lambda said: _declared(truth, said, hint, explain))
    return judged_with_amounts(truth, with_stated_numbers(truth, lines), work)


def _declared(truth: Reference, lines: Sequence[AnsweredLine], hint: int, explain: bool) -> Verdict:
    """The verdict on the lines of an answer with what it says about names."""
    said = declared(truth, lines)
    exact = said.unrounded(truth)
    if exact is not said:
        found = (_assuming(truth, x, hint, False) for x in (exact, said))
        if (right := next((verdict for verdict in found if verdict.right), None)) is not None:
            return right
    verdict = _assuming(truth, exact, hint, explain)
    return _with_values_meant(truth, exact, verdict, hint, explain) or verdict


def _with_values_meant(truth: Reference, said: Declared, verdict: Verdict, hint: int, explain: bool) -> Verdict | None:
    """The verdict on a wrong answer with the values that it has in place of letters; None if it has none."""
    valued = truth.with_values(said.values) if said.values else truth
    wrong = verdict.status is Status.WRONG and truth.model.values
    values = values_meant(valued, _filled(valued, said.lines)) if wrong else {}
    judged = _assuming(truth, replace(said, values=said.values | values), hint, explain) if values else None
    return judged and replace(judged, notes=(substituted(values), *judged.notes))


def _assuming(truth: Reference, said: Declared, hint: int, explain: bool) -> Verdict:
    """The verdict on the lines of an answer with what it assumes about parameters."""
    truth = truth.with_values(said.values) if said.values else truth
    truth.algebra.renew()
    judged, unjudged = without_forms(truth, said.lines)
    judged, periods = without_periods(truth, judged)
    judged, added = with_energies_apart(truth, judged)
    judged, sides = with_forces_apart(truth, judged)
    judged, parts = without_first_parts(truth, judged)
    judged = with_definitions_in_values(truth, with_given_slopes(truth, judged))
    written = _filled(truth, judged)
    truth = truth.within(region(truth, written))
    verdict = _checked(truth, judged, written, hint, explain)
    general = untrue_in_general(truth, written)
    if verdict.findings:
        verdict = replace(verdict, findings=with_right_definitions(truth, written, verdict.findings))
        verdict = with_parts_judged(truth, written, verdict)
    if not verdict.right and hint:
        if explain:
            verdict = with_wrong_terms(truth, written, with_whole_terms(truth, verdict))
            verdict = with_terms_of_equations(truth, said.lines, verdict)
            verdict = with_sides(with_terms_as_written(truth, verdict))
            verdict = with_fitting_advice(truth, said.lines, with_terms_as_they_stand(truth, verdict))
            verdict = with_forces_named(truth, said.lines, with_twice_said(said.lines, verdict))
            verdict = without_balanced_weights(truth, said.lines, verdict)
        verdict = in_own_names(truth, without_made_names(written), verdict)
        verdict = without_shared_signs(said_in_numbers(truth, verdict))
    verdict = replace(verdict, notes=(*unjudged, *periods, *added, *sides, *parts, *verdict.notes, *general))
    if (assumed := said.told(truth)) is None:
        return verdict
    note = text("Right if " if verdict.right else "With ", *assumed.parts, ".")
    return replace(verdict, notes=(note, *verdict.notes))


def _filled(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines with names written out, and what they state for coordinates of their own."""
    written = with_rates_of_momenta(truth, as_said_of_others(truth, filled(truth, lines)))
    return with_own_quantities(truth, written, chart(truth, written))


def _checked(
    truth: Reference, lines: Sequence[AnsweredLine], written: Sequence[AnsweredLine], hint: int, explain: bool
) -> Verdict:
    """The verdict on an answer, and on it with its own names ``written`` out."""
    if truth.derivation.multipliers and not truth.values and (numbers := numbers_alone(truth, written)):
        valued = truth.with_values(numbers.values)
        return numbers.judged(valued, lambda said, explains: _checked(valued, said, said, hint, explain and explains))
    if truth.derivation.multipliers:
        return judged_with_inputs(truth, written, lambda said: _on_constraints(truth, said, hint, explain))
    written, told = speeds(truth, written)
    forces = without_forces(truth, written)
    if forces is not None:
        verdict = _valued(truth, forces.lines, forces.lines, hint, False)
        if verdict.right:
            return replace(verdict, notes=(*told, forces.note, *verdict.notes))
    verdict = _valued(truth, lines, written, hint, explain)
    if (own := with_own_forces(truth, lines, written, verdict)) is not None:
        read = _valued(truth, own.lines, own.written, hint, explain and own.sure)
        verdict = replace(read, notes=(*read.notes, own.note)) if read.right or own.sure else verdict
    return replace(verdict, notes=(*told, *verdict.notes))


def _on_constraints(truth: Reference, written: Sequence[AnsweredLine], hint: int, explain: bool) -> Verdict:
    """The verdict on an answer for a system with constraints."""
    read = unfolded(truth, without_own_angles(truth, without_own_counts(truth, written)))
    judge = partial(check_in_any_angle, truth, hint=hint)
    verdict = read.judged(judge)
    verdict = energies_on_rows(truth, read.lines, verdict, hint)
    if not verdict.right:
        verdict = on_branch(truth, read.lines, hint) or right_in_own_coordinates(truth, read.lines, hint) or verdict
    if not explain or not hint:
        return verdict
    if (off := off_constraints(truth, read.lines, verdict)) is not None:
        return off
    own = without_other_forces(truth, *with_virtual_displacements(truth, read.lines, verdict, judge), judge)
    named = named_beside_multipliers(truth, own.lines, own.verdict, lambda x: judged_lines(truth, x).findings)
    named = with_rows_put_in(truth, own.lines, named)
    return wrong_without_constraints(truth, own.lines, named) or with_special_case(truth, named)


def _valued(
    truth: Reference, lines: Sequence[AnsweredLine], written: Sequence[AnsweredLine], hint: int, explain: bool
) -> Verdict:
    """The verdict on an answer in letters or, if that is not right, in numbers."""
    values = values_of(truth, written)
    numbers = bool(values) and in_numbers(truth, written)
    verdict = _read(truth, spelled(truth, written), hint, explain=explain and not numbers)
    if verdict.right or verdict.status is Status.INCOMPLETE:
        return verdict
    if (listed := _with_all_values(truth, lines, hint, explain=explain)) is not None:
        return listed
    if (beside := with_numbers_beside(truth, written, partial(_alone, hint=hint, explain=explain))) is not None:
        return beside
    if not values:
        return verdict
    sure = (
        values if numbers or not names_values(truth, written) else {p: v for p, v in values.items() if v not in (0, 1)}
    )
    if sure:
        put = _put(truth, lines, sure, hint, explain=explain and numbers)
        if put.right or numbers:
            return put
    if len(sure) < len(values) and _put(truth, lines, values, hint, explain=False).right:
        given = [x for p in sorted(values.keys() - sure.keys(), key=str) for x in (p, f" = {values[p]}", ", ")][:-1]
        note = text("It would be right with ", *given, "; a letter that is given must be written.")
        return replace(verdict, notes=(*verdict.notes, note))
    return verdict


def _with_all_values(truth: Reference, lines: Sequence[AnsweredLine], hint: int, *, explain: bool) -> Verdict | None:
    """The verdict on an answer that lists values, with those of the system for what it does not list, as 15.696 for
    m g c where g is in no list; None if it is not right so, or if it lists none."""
    more = {p: v for p, v in values_of(truth, ()).items() if v != 1} if truth.values else {}
    put = _put(truth, lines, more, hint, explain=explain) if more else None
    return put if put is not None and put.right else None


def _alone(truth: Reference, lines: Sequence[AnsweredLine], hint: int, explain: bool) -> Verdict:
    """The verdict on some lines of an answer; numbers are not read as letters where values are put in."""
    read = _filled(truth, lines) if truth.values else lines
    return _read(truth, spelled(truth, read, numbers=not truth.values), hint, explain=explain)


def _put(
    truth: Reference, lines: Sequence[AnsweredLine], values: Mapping[sp.Symbol, sp.Expr], hint: int, *, explain: bool
) -> Verdict:
    """The verdict on an answer with values substituted for the parameters that it does not name; one without
    explanations is kept, as an answer is judged again to explain it."""
    found = _putting if explain else _kept_putting
    beyond = tuple((x.sides, x.summands, x.words) for x in lines)
    return found(truth, tuple(lines), beyond, tuple(values.items()), hint, explain)


def _putting(
    truth: Reference,
    lines: Sequence[AnsweredLine],
    beyond: object,  # in what else lines differ that are equal
    put: tuple[tuple[sp.Symbol, sp.Expr], ...],
    hint: int,
    explain: bool,
) -> Verdict:
    valued = truth.with_values(dict(put))
    lines, told = with_prescribed_unrounded(valued, lines)
    read = spelled(valued, _filled(valued, lines), numbers=False)
    energies = [expr for kind, expr in truth.energies.items() if any(x.kind == kind for x in read.lines)]
    notes = (*read.notes, substituted(dict(put), [*truth.rows, *energies]), *told)
    return _read(valued, replace(read, notes=notes), hint, explain=explain)


_kept_putting = lru_cache(maxsize=MOST_PUT)(_putting)


def _read(truth: Reference, spelling: Spelling, hint: int, *, explain: bool) -> Verdict:
    """The verdict on an answer whose names are known; with ``explain``, also the mistakes that explain it."""
    lines, told = unrounded(truth, spelling.lines)
    spelling = replace(spelling, lines=lines, notes=(*spelling.notes, *told))
    judged = judged_lines(truth, spelling.lines, compared=explain and hint > 0)
    verdict = Verdict(judged.status, judged.findings, notes=spelling.notes + judged.notes, hint=hint)
    verdict = replace(verdict, motion=judged.motion)
    if judged.status.right or judged.status is Status.INCOMPLETE:
        return replace(verdict, combination=judged.combination)
    return (
        _elsewhere(truth, spelling, verdict, explain)
        or (_own_names(truth, spelling, verdict) if explain else None)
        or (explained(truth, spelling, judged, verdict) if explain else verdict)
    )


# -- other coordinates, and what went wrong ---------------------------------------------------------------------------


def _elsewhere(truth: Reference, spelling: Spelling, verdict: Verdict, explain: bool) -> Verdict | None:
    """The verdict in other coordinates if the answer is right in some. A change that an answer has to state, but does
    not, makes nothing right: a note says what would be; without ``explain`` it is not considered."""
    new = new_names(truth, spelling.lines)
    for change, told in _possible(truth, spelling.lines, new):
        judged = judged_lines(truth, told, change, compared=False)
        if not judged.status.right and judged.status is not Status.INCOMPLETE:
            continue
        if not change.plain and not explain:
            continue
        if not change.plain or not (new or _tells(spelling.lines)):
            findings = verdict.findings if explain and verdict.hint else judged_lines(truth, spelling.lines).findings
            named = mistakes(truth, spelling.lines, findings)
            if named.certain or too_long(truth) or not change.plain:
                unsaid = "." if change.plain else ". Say so in your answer if that is what you mean."
                note = text("It would be right with ", *change.words.parts, unsaid)
                return replace(
                    verdict,
                    findings=with_wrong_definitions(verdict.findings, named.blamed),
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
    return _put_in(truth, spelling, verdict) if new else None


def _possible(
    truth: Reference, lines: Sequence[AnsweredLine], new: Sequence[sp.Expr]
) -> Iterator[tuple[ProposedChange, Sequence[AnsweredLine]]]:
    """The changes with which an answer may be right, and its lines without those that only relate coordinates."""
    found, tried = relations(new, lines), candidates(truth, lines)
    if not found:
        yield from ((change, lines) for change in QuickTest(truth, lines).possible(tried))
        return
    for change in tried:
        told = without_relations(found, change.put, lines)
        yield from ((change, told) for change in QuickTest(truth, told).possible([change]))


def _put_in(truth: Reference, spelling: Spelling, verdict: Verdict) -> Verdict | None:
    """The verdict on an answer that is right in the coordinates in which it gives those of the system: x = r cos φ."""
    if truth.derivation.multipliers or (own := without_constraints(truth, spelling.lines)) is None:
        return None
    lines = with_own_quantities(own.truth, own.lines, system_coordinates(own.truth))
    judged = judged_lines(own.truth, lines, compared=False)
    if not judged.status.right:
        return None
    notes = (*spelling.notes, own.change.told, *judged.notes)
    return Verdict(Status.OTHER_COORDINATES, judged.findings, notes=notes, hint=verdict.hint)


def _tells(lines: Sequence[AnsweredLine]) -> bool:
    """Whether an answer contains enough to distinguish a relative coordinate from a wrong absolute one."""
    kinds = {line.kind for line in lines}
    return bool(kinds & {"equation", "L"}) or {"T", "V"} <= kinds


def _own_names(truth: Reference, spelling: Spelling, verdict: Verdict) -> Verdict | None:
    """The verdict on a wrong answer with its own coordinates: the system is converted to these and compared again."""
    if not new_names(truth, spelling.lines):
        return wrong_in_stated_coordinates(truth, spelling, verdict)
    change = likeliest(truth, spelling.lines)
    true = 0 if change is None else QuickTest(truth, spelling.lines).true_lines(change)
    if (rates := likeliest_speeds(truth, spelling.lines, true + 1)) is not None:
        told = replace(spelling, lines=rates.lines, notes=(*spelling.notes, *rates.notes))
        return _read(truth, told, verdict.hint, explain=True)
    if change is None:
        return None
    if names_only(change.table, list(truth.derivation.coordinates)):
        return _renamed(truth, change, spelling, verdict)
    if (other := in_these(truth, change)) is None:
        return None
    own = {c.name for c in truth.model.coordinates}
    told = without_relations(relations(list(change.table), spelling.lines), change.put, spelling.lines)
    return wrong_in(
        other, [x for x in told if x.kind != "definition" or x.name not in own], change, spelling.notes, verdict
    )


def _renamed(truth: Reference, change: ProposedChange, spelling: Spelling, verdict: Verdict) -> Verdict | None:
    """The verdict on a wrong answer that only gives coordinates other names, in these names."""
    own = [line for line in spelling.lines if line.kind != "definition"]
    lines = [replace(line, expr=change.put(line.expr)) for line in own]
    found = wrong_in(truth, lines, change, spelling.notes, verdict)
    if found is None:
        return None
    names, written = OwnNames(change.table), dict(zip(map(id, lines), own, strict=True))
    findings = [replace(names.finding(f), line=written.get(id(f.line), f.line)) for f in found.findings]
    told, others = (tuple(map(names.mistake, x)) for x in (found.mistakes, found.alternatives))
    return replace(found, findings=tuple(findings), mistakes=told, alternatives=others)
