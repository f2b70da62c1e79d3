"""The wrong equations that follow where constraints on velocities are put into T* before it is differentiated.

With ξ̇ = S u + s₀ put in, T* has the same value on every motion that the rows allow, but not the same derivatives:

    d/dt ∂T*_u/∂u_k − S_kᵀ ∂T*_u/∂ξ = S_kᵀ (d/dt ∂T*/∂ξ̇ − ∂T*/∂ξ) + pᵀ (Ṡ_k − ∂(S u + s₀)/∂ξ S_k),    p = ∂T*/∂ξ̇.

The last part vanishes where the rows can be integrated, and only there. Where the multipliers stay, T* is replaced by
T* − μᵀ c with c = A ξ̇ + a₀: a multiplier takes up μ̇ᵀ A, and μᵀ (Ȧ_i − ∂c/∂ξ_i) is lost.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, lru_cache
from itertools import combinations, islice
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import left_sides
from lagrangian.derive.algebra import Algebra, OutOfReach
from lagrangian.model import time
from lagrangian.model.rows import Row, rows_of
from lagrangian.records import dataclass

MOST_WAYS = 12
"""The largest number of ways in which rows are solved for rates."""

LONGEST = 3_000
"""The largest number of operations of T* and the rows together; longer ones are not put in."""

LONGEST_SUM = 24
"""The largest number of terms that are written out."""

Lost = Sequence[tuple[sp.Expr, sp.Expr | None]]
"""What an equation is called by, and the terms that it lacks; None where they are too long to be written."""


@dataclass(frozen=True, eq=False)
class PutIn:
    """Rows that were put into T*, the equations that follow (left minus right), and the terms that these lack.

    ``speeds`` are those in which T* is then written. Where a multiplier is ``kept``, it takes up the rest.
    ``partly``: of the forces on coordinates whose rates are left out, nothing is in the equations.
    """

    rows: tuple[Row, ...]
    equations: Callable[[], tuple[sp.Expr, ...]]
    lost: Callable[[], Lost]
    speeds: tuple[sp.Expr, ...]
    kept: bool
    partly: bool = False


@dataclass(frozen=True, eq=False)
class _Along:
    """Rates in speeds: ``rates`` are S u + s₀ by ξ̇, ``meanings`` are the speeds that are no rates of coordinates."""

    rows: tuple[Row, ...]
    speeds: tuple[sp.Expr, ...]
    rates: Mapping[sp.Expr, sp.Expr]
    meanings: Mapping[sp.Expr, sp.Expr]


def ways_to_put_in(truth: Reference, stated: Sequence[sp.Expr]) -> Iterator[PutIn]:
    """Every way in which rows on velocities may have been put into T*; ``stated`` are kinetic energies of an answer."""
    for way in _first_ways(truth):
        yield from (_with_multipliers(truth, way, T) for T in stated)
    yield from _known_ways(truth)


@lru_cache(maxsize=8)
def _first_ways(truth: Reference) -> tuple[_Along, ...]:
    """One way for all rows together and for each of them alone."""
    return tuple(ways[0] for ways in _solved_ways(truth) if ways)


@lru_cache(maxsize=8)
def _solved_ways(truth: Reference) -> list[list[_Along]]:
    """Every way for all rows together and for each of them alone."""
    rows = tuple(row for row in rows_of(truth.model) if row.position is None)
    if not rows or bounded.operations(truth.T, *(row.rate for row in rows)) > LONGEST:
        return []
    sets = [rows, *((row,) for row in rows if len(rows) > 1)]
    return [list(islice(_solved(truth, chosen), MOST_WAYS)) for chosen in sets]


@lru_cache(maxsize=8)
def _known_ways(truth: Reference) -> tuple[PutIn, ...]:
    """The ways that need no energy of an answer; their equations are made when they are asked for."""
    found: list[PutIn] = []
    for way in _first_ways(truth):
        found += [_with_multipliers(truth, way, T) for T in _without_the_row(truth, way)]
    rows = tuple(row for row in rows_of(truth.model) if row.position is None)
    if _first_ways(truth) and (own := _by_speeds(truth, rows)) is not None:
        found += _reduced(truth, own)
    for way in (way for ways in _solved_ways(truth) for way in ways):
        found += [*_reduced(truth, way), _with_multipliers(truth, way, _put(truth.T, way.rates))]
    return tuple(found)


def _put(expr: sp.Expr, table: Mapping[Any, sp.Expr]) -> sp.Expr:
    return cast("sp.Expr", bounded.replaced(expr, {k: x for k, x in table.items() if k != x}))


def _solved(truth: Reference, rows: tuple[Row, ...]) -> Iterator[_Along]:
    """Every choice of as many rates as there are rows, which the rows then determine."""
    rates = [c.rate for c in truth.model.coordinates]
    c = [truth.expand(row.rate) for row in rows]
    for chosen in combinations([v for v in rates if any(x.has(v) for x in c)], len(rows)):
        A = sp.Matrix([[bounded.diff(x, v) for v in chosen] for x in c])
        whole = bounded.expand(cast("sp.Expr", A.det()))
        if zero_everywhere(truth, whole):
            continue
        others = {v: sp.S.Zero if v in chosen else v for v in rates}
        rest = sp.Matrix([_put(x, others) for x in c])
        values = cast("Sequence[sp.Expr]", (-A.adjugate() * rest).flat())
        found = {
            v: sp.Add(*[x / whole for x in sp.Add.make_args(bounded.expand(x))])
            for v, x in zip(chosen, values, strict=True)
        }
        free = tuple(v for v in rates if v not in chosen)
        yield _Along(rows, free, {v: found.get(v, v) for v in rates}, {})


def _by_speeds(truth: Reference, rows: tuple[Row, ...]) -> _Along | None:
    """The speeds of the derivation's own equations without multipliers, if some are no rates of coordinates."""
    minimal = truth.derivation.minimal
    if minimal is None or not minimal.meanings or len(rows) < len(rows_of(truth.model)):
        return None
    return _Along(rows, minimal.speeds, {v: truth.expand(x) for v, x in minimal.rates.items()}, minimal.meanings)


# -- without the multipliers of the rows ------------------------------------------------------------------------------


def _reduced(truth: Reference, way: _Along) -> Iterator[PutIn]:
    """Lagrange's equations of T* with the rows put in: with the forces along each speed, or with its own alone."""
    coordinates = truth.model.coordinates
    whole = [[bounded.diff(way.rates[c.rate], u) for u in way.speeds] for c in coordinates]
    own: list[list[sp.Expr]] = [[sp.S.One if c.rate == u else sp.S.Zero for u in way.speeds] for c in coordinates]
    yield _along(truth, way, whole, whole)
    if not way.meanings and own != whole:
        yield _along(truth, way, whole, own)


def _along(truth: Reference, way: _Along, S: list[list[sp.Expr]], used: list[list[sp.Expr]]) -> PutIn:
    """Equations in which ∂L/∂ξ and forces are taken along the columns of ``used``."""
    coordinates = truth.model.coordinates

    @cache
    def pushed() -> list[sp.Expr]:
        L = _put(truth.T, way.rates) - truth.V
        own = zip(coordinates, truth.Xi, _forces(truth, way.rows), strict=True)
        return [bounded.diff(L, c.symbol) + x + y for c, x, y in own]

    @cache
    def equations() -> tuple[sp.Expr, ...]:
        T = _put(truth.T, way.rates)
        left = [bounded.diff(bounded.diff(T, u), time) for u in way.speeds]
        right = [sp.Add(*[used[i][k] * x for i, x in enumerate(pushed())]) for k in range(len(left))]
        return tuple(_meant(x - y, way.meanings) for x, y in zip(left, right, strict=True))

    def lost() -> Lost:
        p = [_put(bounded.diff(truth.T, c.rate), way.rates) for c in coordinates]
        found: list[tuple[sp.Expr, sp.Expr | None]] = []
        for k, u in enumerate(way.speeds):
            total: list[sp.Expr] = []
            for i, c in enumerate(coordinates):
                moved = _put(bounded.diff(S[i][k], time), way.rates)
                turned = [bounded.diff(way.rates[c.rate], o.symbol) * S[j][k] for j, o in enumerate(coordinates)]
                total += [p[i] * (sp.Add(*turned) - moved), (used[i][k] - S[i][k]) * _put(pushed()[i], way.rates)]
            found.append((_called(truth, u), _readable(truth, sp.Add(*total), way)))
        return [x for x in found if x[1] != 0]

    return PutIn(way.rows, equations, lost, way.speeds, False, used != S)


def _forces(truth: Reference, rows: Sequence[Row]) -> list[sp.Expr]:
    """What the multipliers of all other rows add to every equation."""
    put = {row.name for row in rows}
    others = [m.symbol for m in truth.derivation.multipliers.values() if m.name not in put]
    return [sp.Add(*[-x * row.diff(x) for x in others]) for row in truth.rows]


def _meant(expr: sp.Expr, meanings: Mapping[sp.Expr, sp.Expr]) -> sp.Expr:
    """An expression in the rates alone."""
    table: dict[Any, sp.Expr] = {}
    for u, meaning in meanings.items():
        table |= {u: meaning, sp.Derivative(u, time): bounded.diff(meaning, time)}
    return _put(expr, table)


def _called(truth: Reference, u: sp.Expr) -> sp.Expr:
    """What the equation of a speed is called by: the coordinate, or the speed itself."""
    return next((c.symbol for c in truth.model.coordinates if c.rate == u), u)


# -- with the multipliers ---------------------------------------------------------------------------------------------


def _without_the_row(truth: Reference, way: _Along) -> Iterator[sp.Expr]:
    """T* without its mixed terms v_j c_r: those of a rate v_j whose factors are in proportion to a row's."""
    rates = [c.rate for c in truth.model.coordinates]
    for row in way.rows:
        c = truth.expand(row.rate)
        held = {v: bounded.diff(c, v) for v in rates if c.has(v)}
        factors: list[sp.Expr] = []
        for v in rates:
            if v in held:
                continue
            slope = bounded.diff(truth.T, v)
            ratios = [bounded.cancel(bounded.expand(bounded.diff(slope, w)) / a) for w, a in held.items()]
            if ratios[0] != 0 and all(zero_everywhere(truth, x - ratios[0]) for x in ratios[1:]):
                factors.append(ratios[0] * v)
        if factors:
            yield truth.T - sp.Add(*factors) * c


def _with_multipliers(truth: Reference, way: _Along, T: sp.Expr) -> PutIn:
    """Equations from ``T`` instead of T*, with all multipliers."""

    @cache
    def equations() -> tuple[sp.Expr, ...]:
        change = left_sides(truth, T - truth.T)
        return tuple(row + x for row, x in zip(truth.rows, change, strict=True))

    def lost() -> Lost:
        coordinates = truth.model.coordinates
        rows = [truth.expand(row.rate) for row in way.rows]
        chosen = [c.rate for c in coordinates if c.rate not in way.speeds]
        A = sp.Matrix([[bounded.diff(x, v) for v in chosen] for x in rows])
        slopes = [_put(bounded.diff(truth.T - T, v), way.rates) for v in chosen]
        mu = (A.T).LUsolve(sp.Matrix(slopes))
        found: list[tuple[sp.Expr, sp.Expr | None]] = []
        for c in coordinates:
            turned = [
                mu[r] * (bounded.diff(bounded.diff(x, c.rate), time) - bounded.diff(x, c.symbol))
                for r, x in enumerate(rows)
            ]
            found.append((c.symbol, _readable(truth, sp.Add(*turned), way)))
        return [x for x in found if x[1] != 0]

    return PutIn(way.rows, equations, lost, way.speeds, True)


def _readable(truth: Reference, expr: sp.Expr, way: _Along) -> sp.Expr | None:
    """An expression where the rows hold, as it is written on a page; None where it is too long for that."""
    algebra = Algebra(truth.model, (truth.T, truth.V))
    for u in way.meanings:
        algebra.generators.add_speed(u)
    try:
        form = algebra.form(expr)
        if form.size > LONGEST_SUM:
            return None
        return algebra.form(bounded.trigsimp(expr)).expr() if _divided(form.raw()) else form.expr()
    except (OutOfReach, OverflowError, ValueError):
        return None


def _divided(expr: sp.Expr) -> bool:
    """Whether an expression is divided by sines or cosines."""
    return any(x.exp.is_negative and x.has(sp.sin, sp.cos) for x in expr.atoms(sp.Pow))
