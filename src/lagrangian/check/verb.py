"""The results of `System.check` and `Derivation.check`: the verdict on an answer, with the methods that write it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cache, partial
from typing import Any

import sympy as sp

from lagrangian import bounded, check
from lagrangian.advice import Advice, Argument
from lagrangian.check import AnsweredLine
from lagrangian.check.as_typed import as_typed
from lagrangian.check.carried_frame import judged_as_carried
from lagrangian.check.closed_loop import only_drives
from lagrangian.check.coordinates.auxiliary import turning_alone, with_auxiliary
from lagrangian.check.counted import judged_as_counted
from lagrangian.check.explain.balances_apart import with_balances_apart
from lagrangian.check.explain.bare_forms import without_bare_forms
from lagrangian.check.explain.claims_checked import with_claims_checked
from lagrangian.check.explain.combinations_meant import with_sums_compared
from lagrangian.check.explain.cut_forces import with_wrong_cut_force
from lagrangian.check.explain.deflections_written import with_written_deflections
from lagrangian.check.explain.denominators_said import with_denominators_named
from lagrangian.check.explain.lengths_added import with_lengths_added
from lagrangian.check.explain.origins import with_origins
from lagrangian.check.explain.other_components import with_other_components
from lagrangian.check.explain.parts_of_energies import without_added
from lagrangian.check.explain.prescribed_speeds import with_prescribed_speeds
from lagrangian.check.explain.put_right import with_wrong_name
from lagrangian.check.explain.same_residuals import with_same_residuals
from lagrangian.check.explain.second_choices import fitting
from lagrangian.check.explain.told_as_a_whole import told_as_a_whole
from lagrangian.check.explain.told_truly import told_truly
from lagrangian.check.explain.uncovered import with_uncovered_terms
from lagrangian.check.explain.wrong_balance import with_forces_of_below, with_wrong_balance
from lagrangian.check.lines import filled
from lagrangian.check.named_accelerations import with_accelerations
from lagrangian.check.names.needless import WITHOUT, Needed, needed, unused_in_motion, without_constants
from lagrangian.check.names.of_equations import without_names_of_equations
from lagrangian.check.names.unexplained import question, unexplained
from lagrangian.check.not_judged import hidden_result, rows_left, unjudged_above
from lagrangian.check.parts_above import with_parts_above
from lagrangian.check.reading import Answer, parse_answer
from lagrangian.check.readings_compared import (
    ENTRY,
    computes_right,
    is_misread,
    is_of_others,
    of_comments,
    program_of,
    without_flipped,
    wrong_together,
)
from lagrangian.check.reasons_unread import without_unread_reasons
from lagrangian.check.reference import Reference, truth_of
from lagrangian.check.sums_as_letters import with_sums_as_letters
from lagrangian.check.whole import only_parts
from lagrangian.check.without_marks import without_marks
from lagrangian.derive import Derived, derive
from lagrangian.errors import Error, ModelError, ParseError
from lagrangian.model import Model
from lagrangian.page.formula import Text, Verbatim, text
from lagrangian.page.report import Report
from lagrangian.read.letters import key
from lagrangian.records import dataclass
from lagrangian.structured.predict import is_long
from lagrangian.viewed import cut
from lagrangian.write.written import Written


@dataclass(frozen=True, eq=False, kw_only=True)
class CheckedAnswer(Written, check.Verdict):
    """Whether an answer is right, in what sense, or where it is wrong and why; see `lagrangian.check.Verdict`."""

    model: Model

    def report(self) -> Report[Model]:
        """Return the verdict as words and tables; ``hint`` limits how much it reveals."""
        return check.report(self, self.model)

    def __repr__(self) -> str:
        """Name the system and the verdict; ``print`` shows the whole result."""
        return cut(f"<CheckedAnswer, {self.model.name}: {self.status.value}>")


@bounded.rarely_collected()
def check_answer(derivation: Derived, answer: Any, *, hint: int = 3, name: str | None = None) -> CheckedAnswer:
    """Check an answer: text or LaTeX, an `Answer` that was read, SymPy equations, or energies by name.

    ``hint`` limits how much the result reveals: 0 right or wrong, 1 the line, 2 the element and the step, 3 the term.
    ``name`` is the file of the answer, for messages. Where the equations cannot be written in the coordinates alone, an
    answer is compared by numbers. Raises `ParseError`, with the place, if a text cannot be read.
    """
    if isinstance(hint, bool) or hint not in (0, 1, 2, 3):
        raise ModelError(f"a hint has a level from 0 to 3 (got {hint})", fix=Advice(Argument("hint", "2")), code="E406")
    written = answer if isinstance(answer, str) else ""
    if isinstance(answer, str):
        answer = parse_answer(answer, derivation.model, name=name)
    given = answer if isinstance(answer, Answer) else check.lines_from(answer)
    if derivation.form == "structured":
        verdict = _in_numbers(derivation, given, hint)
        other = None if verdict.right else _expanded(derivation.model)
        if other is None:
            if isinstance(given, Answer) and (asked := unexplained(derivation, given, verdict)):
                raise question(asked, given.mentioned)
            return verdict
        derivation = other
    if isinstance(given, Answer):
        verdict, derivation = judged_as_carried(
            derivation, written, given, partial(_as_counted, hint=hint), lambda x, read: _judged(x, read)[1]
        )
        verdict = with_prescribed_speeds(truth_of(derivation), given, verdict)
        if verdict.right and (hidden := hidden_result(given, verdict)) is not None:
            raise hidden
    else:
        verdict = check.check(derivation, given, hint=hint)
    if written and isinstance(given, Answer):
        if given.notation == "text" and not given.program and verdict.status is check.Status.WRONG and hint:
            verdict = with_parts_above(truth_of(derivation), written, verdict)
        above = unjudged_above(written, verdict, derivation.model, given)
        verdict = without_unread_reasons(replace(verdict, unjudged=above.lines, partly=above.partly), written)
    return CheckedAnswer(**vars(verdict), model=derivation.model)


def _as_counted(derivation: Derived, answer: Answer, hint: int) -> check.Verdict:
    """The verdict on an answer with the coordinates as it counts them."""
    return judged_as_counted(
        derivation, answer.counted, lambda x: _of_readings(x, answer, hint), lambda x: _judged(x, answer)[1]
    )


def _expanded(model: Model) -> Derived | None:
    """The equations in the coordinates alone, in which mistakes are named; None where they cannot be had."""

    def made() -> Derived | None:
        try:
            return derive(model)
        except Error as error:
            if error.code != "E601":
                raise
            return None

    hopeless = bool(model.floating or model.constraints) or is_long(model, MOST_EXPANDED)
    return None if hopeless else model.remembered("expanded", made)


_NAMES = re.compile(r"[^\W\d_]\w{0,30}+")
MOST_EXPANDED = 10_000
"""Terms of the equations, as predicted, up to which they are written out to name a mistake."""


def _in_numbers(derivation: Derived, answer: Answer | tuple[AnsweredLine, ...], hint: int) -> CheckedAnswer:
    """The verdict on an answer for a system whose equations are not written in the coordinates alone."""
    read = isinstance(answer, Answer)
    verdict = check.check_in_numbers(derivation, check.lines_of(answer) if read else answer, hint=hint)
    for other in answer.others if read and not verdict.right else ():
        try:
            found = check.check_in_numbers(derivation, check.lines_of(other()), hint=hint)
        except ParseError:
            continue
        if found.right:
            verdict = found
            break
    if read and answer.computed is not None and verdict.right:
        with suppress(ParseError):
            computed = answer.computed()
            found = check.check_in_numbers(derivation, check.lines_of(computed), hint=hint)
            verdict = found if found.status is check.Status.WRONG and not computed.unknown else verdict
    if read and answer.doubt is not None and not verdict.right:
        raise answer.doubt
    told = _told(derivation, verdict, answer) if read else verdict
    return CheckedAnswer(**vars(told), model=derivation.model)


def _of_readings(derivation: Derived, answer: Answer, hint: int) -> check.Verdict:
    """The verdict on an answer as it is most likely meant or, if only that is right, in one of its other readings."""
    without = None if answer.read_without is None else cache(answer.read_without)
    answer = replace(answer, others=tuple(map(cache, answer.others)), read_without=without)  # what is read is read once
    likely = without_flipped(truth_of(derivation), answer)
    own = _deciding(derivation, likely)
    if (right := _right_reading(derivation, likely, own, hint)) is not None:
        return right
    decides = own[-1]
    sought = hint or int(_needs_mistakes(derivation, answer, decides.lines))
    verdict = replace(check.check(derivation, decides.lines, hint=sought), hint=hint)
    if likely is not answer and not likely.others and len(own) == 1 and (verdict.right or is_of_others(verdict)):
        quick = verdict if verdict.right else check.check(derivation, decides.lines, hint=hint, explain=False)
        if quick.right:
            return _told(derivation, _apart(derivation, answer, quick), answer, decides.notes)
    answer = likely
    again = without_marks(answer, verdict, lambda read: _judged(derivation, read))
    if again is not None:
        answer, decides = again.answer, again.decides
        verdict = again.verdict if again.verdict.right else check.check(derivation, decides.lines, hint=sought)
        verdict = replace(verdict, hint=hint)
    if not verdict.right and not answer.program:
        verdict = _with_balances(derivation, answer, decides, verdict)
        verdict = _with_names(derivation, answer, decides, verdict)
    asked = unexplained(derivation, answer, verdict)
    unsure = asked or is_misread(verdict) or (answer.doubt is not None and not verdict.right)
    program = None if verdict.right and not unsure else program_of(answer)
    if program is not None and (unsure or computes_right(verdict, _judged(derivation, program)[1])):
        return _of_readings(derivation, program, hint)
    if answer.doubt is not None and not verdict.right:
        raise answer.doubt
    if not answer.program and len(verdict.open_findings) > 1 and program is not None:
        other = verdict
        with suppress(ParseError):
            other = _of_readings(derivation, program, hint)
        if 0 < len(other.open_findings) < len(verdict.open_findings):
            return other
    if asked:
        lines = without_names_of_equations(decides.lines, asked)
        verdict = verdict if lines is None else check.check(derivation, lines, hint=hint)
        if not verdict.right:
            raise question(asked, answer.mentioned)
    truth = truth_of(derivation)
    verdict = with_sums_as_letters(derivation, decides.lines, verdict, partial(check.check, hint=hint))
    verdict = with_other_components(truth, decides.lines, _with_origins(derivation, answer, verdict, hint))
    told = fitting(_claims_checked(truth, told_truly(with_same_residuals(truth, verdict))))
    return _told(derivation, _apart(derivation, answer, told), answer, decides.notes)


def _right_reading(derivation: Derived, answer: Answer, own: Sequence[Needed], hint: int) -> check.Verdict | None:
    """The verdict on the first reading that is right; None if none is, or there is no other than with ``own`` lines."""
    wrong: set[tuple[int, str]] = set()
    for reading in (lambda: answer, *answer.others) if answer.others or len(own) > 1 else ():
        try:
            other = reading()
        except ParseError:
            continue
        for decides in own if other is answer else _deciding(derivation, other):
            verdict = check.check(derivation, decides.lines, hint=hint, explain=False)
            needed = of_comments(wrong) if other.program else wrong
            if verdict.right and needed <= {(line.number, line.text) for line in decides.lines}:
                if not other.program and (computed := _contradicting(derivation, answer)) is not None:
                    return _of_readings(derivation, computed, hint)
                return _told(derivation, _apart(derivation, other, verdict), other, decides.notes)
            wrong |= _wrong_beside(derivation, verdict) if other is answer else set()
            wrong |= wrong_together(verdict) if other is answer and decides.together else set()
    return None


def _claims_checked(truth: Reference, verdict: check.Verdict) -> check.Verdict:
    """The verdict with mistakes that say no more than what is written."""
    verdict = told_as_a_whole(truth, with_lengths_added(truth, with_sums_compared(truth, verdict)))
    checked = with_denominators_named(truth, with_claims_checked(with_written_deflections(verdict)))
    return without_bare_forms(truth, with_uncovered_terms(truth, checked))


def _apart(derivation: Derived, answer: Answer, verdict: check.Verdict) -> check.Verdict:
    """The verdict without calling balances right that only are so together."""
    if answer.program or not answer.unknown:
        return verdict
    truth = truth_of(derivation)
    return with_balances_apart(truth, filled(truth, with_accelerations(check.lines_of(answer))), verdict)


def _with_origins(derivation: Derived, answer: Answer, verdict: check.Verdict, hint: int) -> check.Verdict:
    """The verdict on a wrong answer with its wrong terms at the values of names in which they were made."""
    wrong = [f for f in verdict.findings if f.line.kind == "equation" and f.status is check.Status.WRONG]
    if (
        not hint
        or answer.marked is None
        or not any(_has_values(derivation, answer, f.line) for f in wrong if not f.follows)
    ):
        return verdict
    try:
        read, marks = answer.marked()
    except ParseError:
        return verdict
    return with_origins(truth_of(derivation), verdict, marks, filled(truth_of(derivation), check.lines_of(read)))


def _has_values(derivation: Derived, answer: Answer, line: AnsweredLine) -> bool:
    """Whether a line has names to which the answer may have given values; those of a program are put in already."""
    own = {key(x) for a in answer.lines if a.kind == "definition" and a.name for x in _NAMES.findall(a.name)}
    return answer.program or not line.names <= {key(x) for x in (*derivation.model.symbols, "t")} - own


def _needs_mistakes(derivation: Derived, answer: Answer, lines: Sequence[AnsweredLine]) -> bool:
    """Whether the mistakes of a wrong answer decide how it is read: whether it has names that nothing explains, which
    are no forces of constraints, or lines that may be misread."""
    marked = answer.read_marked is not None and bool(answer.marked_rows())
    asked = bool(answer.unknown) and not derivation.multipliers
    return marked or asked or answer.doubt is not None or any(ENTRY.fullmatch(x.text) for x in lines)


def _with_balances(derivation: Derived, answer: Answer, decides: Needed, verdict: check.Verdict) -> check.Verdict:
    """The verdict on a wrong answer with its balances as they stand, which were not judged or with their forces put in,
    and in which forces that it solves from these are read as unknown."""

    def read(numbers: frozenset[int]) -> tuple[Sequence[AnsweredLine], dict[str, sp.Expr]]:
        assert answer.read_without is not None
        found = answer.read_without(numbers)
        return with_accelerations(check.lines_of(found)), {u.name: u.symbol for u in found.unknown}

    def judge(others: Sequence[AnsweredLine]) -> check.Verdict:
        return check.check(derivation, others, hint=verdict.hint)

    truth = truth_of(derivation)
    lines = with_auxiliary(truth, check.lines_of(answer))
    if not any(f.line.kind == "definition" and f.status is check.Status.WRONG for f in verdict.findings):
        lines = with_accelerations(lines)
    left_out = any(all(x.text != y.text for y in decides.lines) for x in lines if x.kind == "equation")
    if left_out or (decides.together and not derivation.multipliers):
        verdict = with_wrong_balance(truth, filled(truth, lines), verdict, judge=judge)
    if answer.read_without is None:
        return verdict
    verdict = with_forces_of_below(truth, lines, read, verdict, judge)
    return with_wrong_cut_force(truth, lines, read, verdict, judge)


def _with_names(derivation: Derived, answer: Answer, decides: Needed, verdict: check.Verdict) -> check.Verdict:
    """The verdict on a wrong answer in which the definition is the mistake whose right value puts the others right."""
    if answer.read_without is None or verdict.status is not check.Status.WRONG:
        return verdict
    truth = truth_of(derivation)
    lines = filled(truth, decides.lines)
    return with_wrong_name(truth, lines, answer, lambda put: _judged(derivation, put)[1], verdict)


def _wrong_beside(derivation: Derived, verdict: check.Verdict) -> set[tuple[int, str]]:
    """The lines of remarks that are wrong beside right equations: no reading without these is taken.

    Where constraints hold, what is said of a case, at rest or for e = 0, is not compared with every motion.
    """
    wrong = [f.line for f in verdict.findings if f.status is check.Status.WRONG] if verdict.motion else []
    cases = {"case"} if derivation.multipliers else set[str]()
    return {(x.number, x.text) for x in wrong if x.beside and not x.beside & cases}


def _contradicting(derivation: Derived, answer: Answer) -> Answer | None:
    """The reading of a program that is carried out, if it computes a wrong motion, whatever its comments say; what it
    gives the inputs is no mistake."""
    with suppress(ParseError):
        if answer.opened is not None and _judged(derivation, answer.opened())[1].right:
            return None
    try:
        computed = None if answer.computed is None else answer.computed()
        verdict = None if computed is None else _judged(derivation, computed)[1]
        if computed is None or verdict is None or verdict.status is not check.Status.WRONG:
            return None
        if unexplained(derivation, computed, verdict) or any(u.symbol.is_Symbol for u in computed.unknown):
            return None  # names that its comments may explain
        if only_drives(truth_of(derivation), filled(truth_of(derivation), check.lines_of(computed))):
            return None
    except ParseError:
        return None
    return replace(answer, others=(), computed=None) if answer.program else program_of(answer) or computed


def _judged(derivation: Derived, answer: Answer) -> tuple[Needed, check.Verdict]:
    """The lines of an answer that decide, and the verdict on them, without mistakes."""
    *others, last = _deciding(derivation, answer)
    for decides in others:
        verdict = check.check(derivation, decides.lines, explain=False)
        if verdict.right:
            return decides, verdict
    return last, check.check(derivation, last.lines, explain=False)


def _deciding(derivation: Derived, answer: Answer) -> list[Needed]:
    """All lines of an answer, then those that decide if its equations do without the names that nothing explains."""
    names = [u.symbol for u in answer.unknown]
    before = without_constants(check.lines_of(answer), names)
    lines = with_auxiliary(truth_of(derivation), before)
    told = tuple(text(f"'{x.text}'{WITHOUT}") for x in turning_alone(before, lines))
    if derivation.multipliers:  # any name beside accelerations may be a multiplier
        names = unused_in_motion(lines, names, [c.name for c in derivation.model.coordinates])
    free = len(derivation.model.coordinates) - len(derivation.multipliers)
    fewer = needed(lines, names, max(free, 1))
    if fewer is not None and fewer.together:
        return [replace(fewer, notes=(*told, *fewer.notes))]
    put = with_accelerations(lines)
    if fewer is None:
        return [Needed(put, told)]
    whole = [Needed(lines, told)] if put == tuple(lines) else [Needed(put, told), Needed(lines, told)]
    return [*whole, replace(fewer, notes=(*told, *fewer.notes))]


def _told(derivation: Derived, verdict: check.Verdict, answer: Answer, notes: Sequence[Text] = ()) -> check.Verdict:
    """The verdict with the notes of the reading, each once, but for names that nothing uses and that were judged, and
    for energies without a value in lines that are judged by another side, p = ∂L/∂x' = m x'."""
    why = ("nothing else uses ", "no equation uses this matrix ", "it is an expression without an equals sign")
    why = (*why, "it is a list without an equals sign", "an energy in it has no value", "it is a general form")
    why = (*why, "nothing says what is differentiated there", "it is of virtual displacements")
    judged = tuple(f"'{f.line.text}' was not judged: {x}" for f in verdict.findings for x in why)
    told = [note for note in answer.notes if not note.startswith(judged)]
    named = {f"'{f.line.text}'{WITHOUT}" for f in verdict.findings}
    unjudged, matrices = (any(x in note for note in told) for x in ("was not judged", "no equation uses this matrix"))
    notes = [x for x in notes if str(x) not in named] + rows_left(derivation.model, answer, verdict, whole=not unjudged)
    verdict = without_added(only_parts(verdict, check.lines_of(answer), unjudged=unjudged, matrices=matrices))
    listed = {str(x): x for x in (*(text(Verbatim(note)) for note in told), *notes, *verdict.notes)}
    return replace(verdict, notes=tuple(as_typed(note, answer.lines) for note in listed.values()))
