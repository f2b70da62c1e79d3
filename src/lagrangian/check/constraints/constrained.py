"""Answers for systems with constraints: with multipliers of any sign and scale, or without multipliers.

A multiplier's sign and scale are a choice: λ' = c λ with the row c' = c⁻¹ c is the same constraint. So an answer's own
multipliers s are unknowns here. At states that satisfy the constraints, with the true accelerations, an answer is true
if one s satisfies all of its lines; it is complete if its lines and the constraints determine the accelerations and s.
Both are decided by numbers, at random states.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import replace
from functools import lru_cache, partial
from itertools import combinations
from operator import attrgetter
from typing import Any, Protocol, TypeAlias, cast

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import bounded
from lagrangian.check.balances import as_equation
from lagrangian.check.constraints.answer_on_rows import AnswerAt, AnswerOnRows
from lagrangian.check.constraints.between_bodies import other_forms
from lagrangian.check.constraints.determined import SMALL, accelerations_determined, ends_right, in_span
from lagrangian.check.constraints.in_rates import in_coordinates
from lagrangian.check.constraints.own_scales import are_scaled, solved
from lagrangian.check.constraints.pressed import SizeReading, direction_symbols, readings
from lagrangian.check.coordinates.chart import of_unknown
from lagrangian.check.names.results import FORCE, is_factor_of_forces, results_in
from lagrangian.check.names.spelling import not_there
from lagrangian.check.reference import Reference
from lagrangian.check.stated import judge
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict, keys_of
from lagrangian.derive import Derived
from lagrangian.model import Model
from lagrangian.model.rows import rows_of
from lagrangian.page.formula import Text, text
from lagrangian.page.plain import plain
from lagrangian.records import dataclass, field

Array: TypeAlias = NDArray[np.float64]

STATES = 8
"""Random states on the constraints at which an answer is looked at."""

POSITIONS = 3
"""Positions at which an answer's multipliers are compared with those of the system."""

MOST = 10
"""Lines among which those are sought that are true together."""

_NAME = re.compile(r"[\s$&]*+\\?[^\W\d]\w{0,24}(?:_\{\w{1,24}\})?[\s$&]*+")
"""A name alone."""


class Answered(Protocol):
    """The equations of an answer, evaluated at random states with the true accelerations."""

    def states(self, count: int, *, given: bool) -> Iterator[Any]:
        """Up to ``count`` states; with ``given`` the parameters keep their values."""
        ...

    def at(self, here: Any) -> AnswerAt:
        """The answer at a state."""
        ...

    def motions(self, here: Any, count: int) -> Iterator[AnswerAt]:
        """The answer at ``count`` other motions from the position of a state."""
        ...

    def heavier(self, here: Any, count: int) -> Iterator[AnswerAt]:
        """The same with other values of the inertias that its lines have in letters, if any."""
        ...


@dataclass(frozen=True, eq=False)
class Compared:
    """What an answer is compared with: the system with the ``names`` of its equations and all names that are ``known``.

    ``answer`` evaluates its lines, given its own multipliers; ``judge`` judges a line that is not an equation.
    ``holding`` are the multipliers in named quantities.
    """

    derivation: Derived
    names: Sequence[str]
    known: Set[sp.Basic]
    answer: Callable[[Sequence[AnsweredLine], Sequence[sp.Basic]], Answered]
    judge: Callable[[Sequence[AnsweredLine], int], Finding | None]
    holding: Mapping[sp.Basic, Set[sp.Basic]] = field(default_factory=dict[sp.Basic, "Set[sp.Basic]"])

    @property
    def model(self) -> Model:
        """The system."""
        return self.derivation.model


def expanded(truth: Reference) -> Compared:
    """A system whose equations are written in the coordinates."""
    model = truth.model
    return Compared(
        truth.derivation,
        [c.name for c in model.coordinates],
        truth.names | direction_symbols(model),
        partial(AnswerOnRows, truth),
        partial(judge, truth),
    )


def check_constrained(truth: Reference, lines: Sequence[AnsweredLine], hint: int) -> Verdict:
    """Return the verdict on an answer for a system with constraints."""
    tried: list[Verdict] = []
    for read in readings(truth.model, lines):
        tried.append(_checked(truth, read.lines, hint))
        if tried[-1].right and _as_read(truth, read):
            return tried[-1]
    first = max(tried, key=lambda found: found.right, default=None) or _checked(truth, lines, hint)
    together: list[Verdict] = []
    for put, told in () if first.right else other_forms(truth, lines):
        found = _checked(truth, put, hint)
        found = replace(found, notes=(*found.notes, *told))
        if found.right:
            return found
        together += [_of_lines(found, lines)] if len(put) == len(lines) else []
    if not tried:
        return max([first, *together], key=attrgetter("right_lines"))
    if opposite := next((found for found in tried if found.right), None):
        said = text("The motion would be right if the friction had the opposite sign.")
        return replace(opposite, status=Status.WRONG, notes=(said,))
    return max(tried, key=attrgetter("right_lines"))


def _of_lines(verdict: Verdict, lines: Sequence[AnsweredLine]) -> Verdict:
    """A verdict on lines in which coordinates are counted together, as one on these lines as they were written."""
    own = dict(zip(keys_of(lines), lines, strict=True))
    keys = keys_of([f.line for f in verdict.findings])
    found = (replace(f, line=own.get(key, f.line)) for key, f in zip(keys, verdict.findings, strict=True))
    return replace(verdict, findings=tuple(found))


def _checked(truth: Reference, lines: Sequence[AnsweredLine], hint: int) -> Verdict:
    other = expanded(truth)
    lines = _with_held(other, [as_equation(truth, line) for line in in_coordinates(truth, lines)])
    once = lru_cache(maxsize=None)(partial(judge, truth, lines))  # an energy is the same with values and without
    other = replace(other, judge=lambda _, k: once(k))
    first = verdict_at_states(other, lines, hint, given=False)
    if first.right or not truth.model.values or first.status is Status.INCOMPLETE:
        return first
    second = verdict_at_states(other, lines, hint, given=True)  # the numbers of an answer may be values of parameters
    return second if second.right or (truth.values and second.right_lines >= first.right_lines) else first


def _with_held(truth: Compared, lines: list[AnsweredLine]) -> list[AnsweredLine]:
    """The lines; a length in two ways that is the same where constraints hold, ρ = √(s² + d²) = l + r φ, says these."""
    twice = [line for line in lines if line.kind == "identity" and _names_in(truth, line) <= truth.known]
    places = list(_places(truth, twice, [], given=False)) if twice and truth.model.constraints else []
    true = {id(line) for j, line in enumerate(twice) if places and consistent(places, [j])}
    return [replace(line, kind="equation", name=None) if id(line) in true else line for line in lines]


def _as_read(truth: Reference, read: SizeReading) -> bool:
    """Whether the multipliers of a right answer have the sizes that they were given."""
    equations = [line for line in read.lines if line.kind == "equation"]
    other = expanded(truth)
    unknown = unknown_names(other, equations)
    for given in (False, True):
        places = _places(other, equations, unknown, given=given)
        if all(
            read.fits(dict(zip(unknown, map(float, solved(p)), strict=True)), p.multipliers.tolist()) for p in places
        ):
            return True
    return False


def verdict_at_states(truth: Compared, lines: Sequence[AnsweredLine], hint: int, *, given: bool) -> Verdict:
    """The verdict on an answer by its values at random states; with ``given`` parameters keep their values."""
    equations = [line for line in lines if line.kind == "equation"]
    results = results_in(truth.model, truth.known, equations)
    equations = [line for line in equations if line not in results.values()]
    unknown = unknown_names(truth, equations)
    found: dict[int, Finding] = {}
    notes: list[Text] = []
    status: Status | None = None
    motion = False
    for s, line in results.items():
        right = _are_forces(truth, [line], [s], given=given)
        found[id(line)] = Finding(line, Status.RIGHT if right else Status.WRONG, FORCE if right else None)
        notes += [] if right else [text(f"'{plain(s)}' is not the force of a constraint, in no scale.")]
    forces = [s for s in unknown if is_factor_of_forces(s, equations)]
    if equations and (len(unknown) > len(truth.derivation.multipliers) or len(forces) < len(unknown)):
        notes += [not_there(truth.model, s) for s in unknown]
        found |= _beside_unknown(truth, equations, unknown, given=given)
        status = Status.WRONG
    elif equations:
        places = list(_places(truth, equations, unknown, given=given))
        if not places:
            notes.append(text("No random position satisfies the constraints, so the equations could not be compared."))
            status = Status.INCOMPLETE
        true = _true_lines(places, len(equations)) if places else set[int]()
        for j, line in enumerate(equations):
            found[id(line)] = _finding(truth, line, j, places, j in true)
        if places and len(true) == len(equations) and not _are_forces(truth, equations, unknown, given=given):
            status = Status.WRONG
            notes.append(_no_force(unknown))
            held = [line for line in equations if not _names_in(truth, line).isdisjoint(unknown)]
            found |= {id(line): Finding(line, Status.WRONG) for line in held}
        elif places and len(true) == len(equations):
            notes += _named(truth, unknown, places)
            motion = (count := accelerations_determined(places)) >= len(truth.names)
            if not motion:
                whose = "With the constraints, your" if truth.model.constraints else "Your"
                notes.append(
                    text(
                        f"{whose} equations determine {count} of {len(truth.names)} accelerations; "
                        "more equations are needed."
                    )
                )
            status = _worst([f.status for f in found.values()]) if motion else Status.INCOMPLETE
        elif places:
            status = Status.WRONG
            motion = ends_right(places, [j in true for j in range(len(equations))], len(truth.names))
            if unknown:
                notes += [text("The sign and the scale of a multiplier are yours to choose, but the same everywhere.")]
    findings: list[Finding] = []
    for k, line in enumerate(lines):
        if line.kind not in ("definition", "statement"):
            finding = found[id(line)] if line.kind == "equation" else truth.judge(lines, k)
            findings += [] if finding is None else [finding]
            notes += [of_unknown(line)] if finding is None else []
    others = [f.status for f in findings if f.line.kind != "equation" or f.line in results.values()]
    worst = _worst([*others, *([status] if status is not None else [])])
    motion = motion and worst is Status.WRONG
    return Verdict(worst, tuple(findings), notes=tuple(notes), hint=hint, motion=motion)


def _worst(statuses: Sequence[Status]) -> Status:
    return max(statuses, key=list(Status).index, default=Status.INCOMPLETE)


def _names_in(truth: Compared, line: AnsweredLine) -> set[sp.Basic]:
    """The names in a line, and the multipliers in the named quantities among them."""
    used: set[sp.Basic] = bounded.letters(line.expr)
    return used | {x for name in used & truth.holding.keys() for x in truth.holding[name]}


def unknown_names(truth: Compared, lines: Sequence[AnsweredLine]) -> list[sp.Basic]:
    """The names in an answer that the system does not have, and its multipliers."""
    used = set[sp.Basic]().union(*(_names_in(truth, line) for line in lines))
    return sorted(used - truth.known, key=str)


def _places(
    truth: Compared, lines: Sequence[AnsweredLine], unknown: Sequence[sp.Basic], *, given: bool
) -> Iterator[AnswerAt]:
    """The answer at random states that satisfy the constraints, with the true accelerations."""
    answer = truth.answer(lines, unknown)
    for here in answer.states(STATES, given=given):
        yield answer.at(here)


def _beside_unknown(
    truth: Compared, lines: Sequence[AnsweredLine], unknown: Sequence[sp.Basic], *, given: bool
) -> dict[int, Finding]:
    """The findings where names are not understood: only lines without these can be right."""
    known = [line for line in lines if _names_in(truth, line).isdisjoint(unknown)]
    places = list(_places(truth, known, [], given=given)) if known else []
    true = _true_lines(places, len(known)) if places else set[int]()
    found = {id(line): Finding(line, Status.WRONG) for line in lines}
    return found | {id(x): _finding(truth, x, j, places, True) for j, x in enumerate(known) if j in true}


def _are_forces(truth: Compared, lines: Sequence[AnsweredLine], unknown: Sequence[sp.Basic], *, given: bool) -> bool:
    """Whether the answer's multipliers are those of the system times what depends on the position alone, not on masses.

    A multiplier that also takes up a slip in its equation, such as a centrifugal term left out, is not: at one
    position it changes otherwise with rates and inputs.
    """
    if not unknown:
        return True
    answer = truth.answer(lines, unknown)
    for here in answer.states(POSITIONS, given=given):
        found = list(answer.motions(here, len(rows_of(truth.model)) + 4))
        if any(np.linalg.matrix_rank(p.by_multiplier, tol=1e-8) < len(unknown) for p in found):
            return True  # a multiplier that no line determines
        if are_scaled(found, list(answer.heavier(here, len(found)))) is False:
            return False
    return True


def _no_force(unknown: Sequence[sp.Basic]) -> Text:
    """Why a multiplier with which all equations hold is still not right."""
    names = ", ".join(f"'{plain(s)}'" for s in unknown)
    return text(
        f"The motion would be right, but {names} would not be the force of the constraint alone: "
        "it would take up what is wrong in its equation."
    )


def consistent(places: Sequence[AnswerAt], chosen: Sequence[int]) -> bool:
    """Whether one set of multipliers satisfies these lines at every state."""
    for place in places:
        rows, size = list(chosen), place.size[list(chosen)]
        B, value = place.by_multiplier[rows], place.value[rows]
        scale = np.where(size > 0, size, 1.0)
        B, value = B / scale[:, None], value / scale
        left = value if not B.size else value + B @ np.linalg.lstsq(B, -value, rcond=1e-10)[0]
        if not np.isfinite(left).all() or np.abs(left).max(initial=0.0) > SMALL:
            return False
    return True


def _true_lines(places: Sequence[AnswerAt], count: int) -> set[int]:
    """The largest set of lines that are true together; of equals, that with the most equations of the system, so that
    a multiplier does not take up what is wrong in another line, then that with the first lines."""
    if consistent(places, range(count)):
        return set(range(count))
    if count > MOST:
        return {j for j in range(count) if consistent(places, [j])}
    own = {j for j in range(count) if _row_of(places, j)[0] is not None}
    for size in range(count - 1, 0, -1):
        for chosen in sorted(combinations(range(count), size), key=lambda js: -sum(j in own for j in js)):
            if consistent(places, chosen):
                return set(chosen)
    return set()


def _row_of(places: Sequence[AnswerAt], j: int) -> tuple[int | None, bool]:
    """Of which equation of the system a line has the accelerations, and whether it is scaled."""
    return _like([p.by_acceleration[j] for p in places], [p.mass for p in places])


def _finding(truth: Compared, line: AnsweredLine, j: int, places: Sequence[AnswerAt], true: bool) -> Finding:
    """The finding for an equation: one with multipliers, one without, or something else that holds."""
    if not true:
        return Finding(line, Status.WRONG)
    if all(np.abs(p.by_acceleration[j]).max() <= SMALL * (1.0 + p.size[j]) for p in places):
        return Finding(line, Status.RIGHT, text("true where the constraints hold"))
    if all(in_span(p.by_acceleration[j], p.rows) and not p.by_multiplier[j].any() for p in places):
        return Finding(line, Status.RIGHT, text("what the constraints ask of the accelerations"))
    if any(np.abs(p.by_multiplier[j]).max(initial=0.0) > 0 for p in places) or truth.derivation.minimal is None:
        index, scaled = _row_of(places, j)
        named = None if index is None else truth.names[index]
    else:
        index, scaled = _like([p.by_acceleration[j] @ p.along for p in places], [p.reduced for p in places])
        named = None
    if index is None and _gives_force(truth, line):
        return Finding(line, Status.RIGHT, FORCE)
    if index is None:
        return Finding(line, Status.SAME_MOTION, text("true whenever the right equations hold"))
    return Finding(line, Status.EQUIVALENT if scaled else Status.RIGHT, None, named)


def _gives_force(truth: Compared, line: AnsweredLine) -> bool:
    """Whether a line says what a multiplier is: λ = m g + 2 m a x ẍ."""
    new = _names_in(truth, line) - truth.known
    alone = len(new) == 1 and bounded.diff(line.expr, *new) in (1, -1)
    return alone and any(_NAME.fullmatch(side) for side in line.text.split("="))


def _like(slopes: Sequence[Array], rows: Sequence[Array]) -> tuple[int | None, bool]:
    """Which row the slopes are a multiple of at every state, and whether the factor is another than ±1."""
    for i in range(len(rows[0])):
        factors: list[float] = []
        for slope, matrix in zip(slopes, rows, strict=True):
            row = matrix[i]
            factor = float(slope @ row / (row @ row))
            if np.abs(slope - factor * row).max() > SMALL * np.abs(slope).max():
                break
            factors.append(factor)
        else:
            return i, max(abs(abs(f) - 1.0) for f in factors) > SMALL
    return None, False


def _named(truth: Compared, unknown: Sequence[sp.Basic], places: Sequence[AnswerAt]) -> Iterator[Text]:
    """What the answer's multipliers are: a number times one of the system's, or another scale."""
    names = list(truth.derivation.multipliers.values())
    order = [row.name for row in rows_of(truth.model)]
    for k, s in enumerate(unknown):
        found = [solved(p)[k] for p in places]
        for known in names:
            theirs = [p.multipliers[order.index(known.name)] for p in places]
            ratios = [x / y for x, y in zip(found, theirs, strict=True) if abs(y) > SMALL]
            if (
                len(ratios) > 2
                and max(ratios) - min(ratios) < SMALL * abs(ratios[0])
                and plain(known.symbol) != plain(s)
            ):
                number = sp.nsimplify(round(ratios[0], 9), rational=True)
                yield text(f"'{plain(s)}' was read as ", cast("sp.Expr", number * known.symbol), ".")
                break
        else:
            if all(plain(known.symbol) != plain(s) for known in names):
                yield text(f"'{plain(s)}' was read as a multiplier with a scale of your own.")
