"""Rows in the order given: which are independent, which are redundant, and which contradict others."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.derive.constraints.pfaffian import RowForm, Sheet
from lagrangian.derive.constraints.satisfied import satisfied
from lagrangian.derive.constraints.spans import GenericPoint
from lagrangian.records import dataclass

STARTS = 6
"""The number of points from which a position that satisfies the earlier rows is sought."""

CLOSED, ZERO = 1e-40, 1e-30
"""The largest residual of such a position, and the largest value there of a row that agrees."""


@dataclass(frozen=True)
class RedundantRow:
    """A redundant row, and the rows from which it follows."""

    name: str
    repeats: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Sorted:
    """The independent rows, and the others; ``unsure`` names rows that are redundant in the rates alone."""

    kept: list[RowForm]
    redundant: list[RedundantRow]
    contradictions: list[RedundantRow]
    unsure: list[str]


def sort_rows(sheet: Sheet, place: GenericPoint, given: Sequence[RowForm]) -> Sorted:
    """Return which rows are independent for all q, t and parameters.

    A row whose coefficients of the rates depend on those of earlier rows is redundant if its right-hand side follows
    too; otherwise it contradicts them. Rows on positions with the same rates must also agree in the positions.
    """
    rates, whole = place.span(), place.span()
    found = Sorted([], [], [], [])
    for k, form in enumerate(given):
        names = rates.made_of(form.coefficients[:-1])
        if names is None:
            rates.take(k, form.coefficients[:-1])
            whole.take(k, form.coefficients)
            found.kept.append(form)
            continue
        repeated = [given[i] for i in names]
        said = RedundantRow(form.name, tuple(f.name for f in repeated))
        if whole.made_of(form.coefficients) is None:
            found.contradictions.append(said)
            continue
        agrees = _agrees(sheet, place, form, repeated)
        if agrees is None:
            found.unsure.append(form.name)
        (found.contradictions if agrees is False else found.redundant).append(said)
    return found


def _agrees(sheet: Sheet, place: GenericPoint, form: RowForm, repeated: Sequence[RowForm]) -> bool | None:
    """Whether f = 0 at positions that satisfy the rows that it repeats; None if no such position was found.

    There f is constant, because df is a combination of their differentials. A row on rates cannot disagree.
    """
    if form.position is None or any(f.position is None for f in repeated):
        return True
    if not place.nonzero([form.position])[0]:
        return True
    others = [f.position for f in repeated if f.position is not None]
    for start in range(STARTS):
        value = _at_satisfied(sheet, form.position, others, start)
        if value is not None:
            return value
    return None


def _at_satisfied(sheet: Sheet, position: int, others: list[int], start: int) -> bool | None:
    """Whether f = 0 at a position that satisfies the others; None if none was found from this start."""
    if not others:
        return False  # f does not depend on the coordinates, and is not 0
    there = satisfied(sheet, others, start, within=CLOSED, others=[position])
    return None if there is None else bool(abs(there[0]) < ZERO)
