"""The verdict on a system's constraints: holonomic, nonholonomic and by how many, or undecided."""

# mpmath has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownVariableType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import mpmath
import sympy as sp

from lagrangian.derive.constraints.brackets import MAX_NODES, Closure, closure
from lagrangian.derive.constraints.closed import ranks_where_closed
from lagrangian.derive.constraints.elimination import fields, kernel, solved
from lagrangian.derive.constraints.integrals import TRIED, Integral, IntegralSearch
from lagrangian.derive.constraints.pfaffian import HasRow, RowForm, Sheet, Variables, combined, forms
from lagrangian.derive.constraints.rows import RedundantRow, Sorted, sort_rows
from lagrangian.derive.constraints.spans import ExactPlace, FloatPlace, GenericPoint, OutsideError, UnclearError
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

__all__ = ["Holonomy", "Integral", "RedundantRow", "judge"]


@dataclass(frozen=True, eq=False)
class Holonomy(Brief):
    """The consequences of a system's constraints.

    ``independent`` are the names of the independent rows, in order. ``growth`` are the numbers of directions that can
    be reached: directly (#DDOF), and with brackets of depth 2, 3, …; the last is #GC if ``complete``. ``integrals`` are
    the surfaces f = constant that were found, ``missing`` is the number of the others. ``exact`` is False if numbers of
    50 digits decided; ``notes`` explain this. ``special`` is another verdict, if the given values of the parameters
    change it.
    """

    independent: tuple[str, ...]
    redundant: tuple[RedundantRow, ...]
    contradictions: tuple[RedundantRow, ...]
    growth: tuple[int, ...]
    complete: bool
    exact: bool = True
    integrals: tuple[Integral, ...] = ()
    missing: int = 0
    notes: tuple[str, ...] = ()
    special: Holonomy | None = None

    @property
    def holonomic(self) -> bool | None:
        """Whether #GC = #DDOF; None if this is undecided."""
        return False if len(self.growth) > 1 else True if self.complete else None

    @property
    def DDOF(self) -> int:
        """The differential degrees of freedom: rates that can be chosen freely at an instant."""
        return self.growth[0]

    @property
    def GC(self) -> int | None:
        """The number of generalized coordinates of all configurations that can be reached; None if undecided."""
        return self.growth[-1] if self.complete else None

    @property
    def degree(self) -> int:
        """#GC − #DDOF, or a lower bound of it if the growth is not complete: the system is nonholonomic by this."""
        return self.growth[-1] - self.growth[0]

    def __str__(self) -> str:
        """Read as ``nonholonomic by 2: #DDOF = 2, #GC = 4, growth (2, 3, 4)``."""
        ends = f"#DDOF = {self.DDOF}"
        if self.holonomic is None:
            return f"undecided beyond depth {len(self.growth)}: {ends}"
        if self.holonomic:
            return f"holonomic: #GC = #DDOF = {self.DDOF}"
        least = "" if self.complete else "at least "
        count = f"#GC = {self.GC}" if self.complete else f"#GC ≥ {self.growth[-1]}"
        return f"nonholonomic by {least}{self.degree}: {ends}, {count}, growth {self.growth}"


def judge(
    rows: Sequence[HasRow],
    coordinates: Sequence[sp.Expr],
    time: sp.Symbol,
    *,
    values: Mapping[Any, Any] | None = None,
    limit: int = MAX_NODES,
    idle: int = 0,
) -> Holonomy:
    """Return the verdict on constraints: redundant rows, contradictions, holonomic or not, and integrals.

    Rows A(q, t) q̇ + a0(q, t) = 0 are differential forms over (q, t); the fields that satisfy them are closed under
    brackets. Ranks are exact, in a prime field, with parameters generic; ``values`` (rational, by symbol) are tried as
    well. ``limit`` bounds the nodes that brackets may make. ``idle`` directions mean nothing, such as the length of a
    quaternion; no row depends on them. Raises `ModelError` for a row that is not linear in the rates.
    """
    variables = Variables(tuple(coordinates), time)
    found = _tried(rows, variables, values, limit)
    return _without(found, idle) if idle else found


def _without(found: Holonomy, idle: int) -> Holonomy:
    """The verdict without directions that mean nothing."""
    special = None if found.special is None else _without(found.special, idle)
    return replace(found, growth=tuple(count - idle for count in found.growth), special=special)


def _tried(rows: Sequence[HasRow], variables: Variables, values: Mapping[Any, Any] | None, limit: int) -> Holonomy:
    """The verdict with generic parameters, and what changes with the values given."""
    generic = _judged(rows, variables, None, limit)
    moving = [row for row in rows if row.position is None]
    if not values or not any(row.rate.has(*values) for row in moving):
        return generic
    given = _judged(rows, variables, values, limit, search=False)
    same = (given.growth, given.independent, len(given.contradictions)) == (
        generic.growth,
        generic.independent,
        len(generic.contradictions),
    )
    return generic if same else replace(generic, special=_judged(rows, variables, values, limit))


def _judged(
    rows: Sequence[HasRow],
    variables: Variables,
    values: Mapping[Any, Any] | None,
    limit: int,
    *,
    search: bool = True,
) -> Holonomy:
    sheet = Sheet(variables)
    given = forms(sheet, rows, values)
    try:
        return _Judge(sheet, ExactPlace(sheet), limit).verdict(given, search=search)
    except OutsideError as error:
        why = f"not decided exactly, because of {error}"
    try:
        # a kink has sides: the verdict is that of the side on which the motion reaches most
        sides = [
            _Judge(sheet, FloatPlace(sheet, seed=seed), limit).verdict(given, search=False) for seed in range(SIDES)
        ]
        growths = [side.growth for side in sides]
        best = max(range(SIDES), key=lambda k: (growths[k][-1], -k))
        place = FloatPlace(sheet, seed=best)
        found = _Judge(sheet, place, limit).verdict(given, search=search)
    except UnclearError as error:
        n = len(variables.coordinates)
        return Holonomy((), (), (), (n,), complete=False, exact=False, notes=(f"{why}: {error}",))
    least, most = mpmath.nstr(place.smallest, 2), mpmath.nstr(place.largest, 2)
    gap = (
        f"{why}: ranks were taken with 50 digits at random points instead. Of unit vectors that count as "
        f"independent at least {least} was left, of the others at most {most}"
    )
    sided: tuple[str, ...] = ()
    if len(set(growths)) > 1:
        sided = (f"the growth differs from region to region: {', '.join(map(str, sorted(set(growths))))}",)
    return replace(found, exact=False, notes=(gap, *sided, *found.notes))


SIDES = 8
"""The number of random points at which growths are compared if kinks divide space into regions."""


def _fewer_where_closed(ranks: Sequence[int], rows: int, n: int) -> Iterator[str]:
    """What to note of rows that depend on others where all of them hold, everywhere or at some positions."""
    for rank in ranks:
        if rank == rows:
            continue
        ways = f"{n - rank} way{'s' if n - rank > 1 else ''}"
        if rank == ranks[0]:
            yield (
                f"at positions that satisfy the rows only {rank} of the {rows} are independent: there the system moves "
                f"in {ways}, and the multipliers are not unique"
            )
        else:
            yield (
                f"the rows also hold at positions of another kind, where only {rank} of them are independent: there "
                f"the system moves in {ways}, and where the two kinds meet it can branch"
            )


@dataclass(frozen=True, eq=False)
class _Judge:
    sheet: Sheet
    place: GenericPoint
    limit: int

    def verdict(self, given: Sequence[RowForm], *, search: bool = True) -> Holonomy:
        n = len(self.sheet.variables.coordinates)
        rows = sort_rows(self.sheet, self.place, given)
        names = tuple(form.name for form in rows.kept)
        notes = [
            f"whether the positions of '{name}' agree with those of the rows that it repeats was not decided: no "
            "position was found that satisfies these"
            for name in rows.unsure
        ]
        found = Holonomy(names, tuple(rows.redundant), tuple(rows.contradictions), (n - len(names),), complete=True)
        if rows.contradictions or not rows.kept:
            return replace(found, notes=tuple(notes))
        if all(form.position is not None for form in rows.kept):
            seeker = IntegralSearch(self.sheet, self.place, rows.kept, len(names))
            seeker.positions()
            ranks = ranks_where_closed(self.sheet, [form.position for form in rows.kept if form.position is not None])
            if ranks and ranks[0] < len(names):
                found = replace(found, growth=(n - ranks[0],))
            notes += _fewer_where_closed(ranks, len(names), n)
            return replace(found, integrals=tuple(seeker.found), notes=tuple(notes))
        return self._closed(found, rows, notes, search)

    def _closed(self, found: Holonomy, rows: Sorted, notes: list[str], search: bool) -> Holonomy:
        """The verdict if there are rows on velocities."""
        width = len(self.sheet.columns)
        solution = solved(self.sheet, self.place, [list(form.coefficients) for form in rows.kept], range(width - 1))
        space = closure(self.sheet, self.place, fields(self.sheet, solution), limit=self.limit)
        if not space.complete:
            notes.append(
                f"brackets were followed to depth {space.depth}: the next would take more than {self.limit} operations"
            )
        if not search:
            return replace(found, growth=space.growth, complete=space.complete)
        surfaces = width - 1 - space.growth[-1]
        seeker = IntegralSearch(self.sheet, self.place, rows.kept, surfaces)
        seeker.positions()
        if not seeker.done:
            seeker.look([form.coefficients for form in rows.kept if form.position is None])
        if space.complete and not seeker.done:
            seeker.look(solution.rows)
        if space.complete and not seeker.done and space.brackets:
            seeker.look(self._annihilator(solution.rows, solution.pivots, space))
        missing = surfaces - len(seeker.found) if space.complete else 0
        if missing:
            notes.append(f"no elementary integral was found for {missing} of {surfaces} (tried: {', '.join(TRIED)})")
        return replace(
            found,
            growth=space.growth,
            complete=space.complete,
            integrals=tuple(seeker.found),
            missing=missing,
            notes=tuple(notes),
        )

    def _annihilator(self, rows: list[list[int]], pivots: list[int], space: Closure) -> list[list[int]]:
        """The combinations of solved rows that are zero on the brackets too: together they are integrable."""
        shares = [[bracket[k] for k in pivots] for bracket in space.brackets]
        basis = kernel(self.sheet, self.place, shares, len(pivots), range(len(pivots)))
        left = [combined(self.sheet.graph, factors, rows) for factors in basis]
        return solved(self.sheet, self.place, left, range(len(self.sheet.columns) - 1)).rows if left else []
