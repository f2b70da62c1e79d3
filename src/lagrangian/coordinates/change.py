"""A change of coordinates ξ = φ(η, t): read from what a person gives, and checked before anything is changed.

    J = ∂φ/∂η      ξ̇ = J η̇ + ∂φ/∂t      ξ̈ = d/dt ξ̇

A coordinate that is not mentioned keeps its name and its meaning. A new coordinate may have the name of one that it
replaces: ``theta2 = theta1 + theta2`` means that the old θ2 is the sum, and that the new θ2 is measured from θ1.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from itertools import combinations, islice
from typing import Any, cast

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.derive.sample import Sampler
from lagrangian.errors import ModelError, did_you_mean
from lagrangian.model import Coordinate, Model, as_expr, time
from lagrangian.model.names import RESERVED, check_name, moving_symbol
from lagrangian.model.rows import rows_of
from lagrangian.page.plain import plain
from lagrangian.read import Scope, parse_expression
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief

MOST_SETS = 500
"""The largest number of sets of old coordinates that are tried if the new ones are given in terms of the old."""
STATES = 3
"""The number of random positions at which the rank of J is computed; the largest counts."""
MIN_SINGULAR_VALUE = 1e-9
"""J is singular at a position if its relative singular value is below this."""


@dataclass(frozen=True, eq=False)
class Change(Brief):
    """A change ξ = φ(η, t): the old coordinates in terms of the new ones, both in order.

    ``old`` are the coordinates of the model; ``new`` are those that take their places, in the same order: a coordinate
    that stays keeps its position, and a new one has the position of the one that it replaces. ``table`` contains φ for
    every old symbol.
    """

    old: tuple[Coordinate, ...]
    new: tuple[Coordinate, ...]
    table: Mapping[AppliedUndef, sp.Expr]
    _memo: dict[sp.Expr, sp.Expr] = field(default_factory=dict, repr=False)

    @cached_property
    def jacobian(self) -> sp.ImmutableMatrix:
        """J = ∂φ/∂η, with a row for each old coordinate and a column for each new one."""
        rows = [[sp.diff(self.table[c.symbol], n.symbol) for n in self.new] for c in self.old]
        return sp.ImmutableMatrix(rows)

    @cached_property
    def replacements(self) -> dict[sp.Basic, sp.Expr]:
        """The expression for every old coordinate, rate and acceleration, to be substituted all at once."""
        found: dict[sp.Basic, sp.Expr] = {}
        for c in self.old:
            value = self.table[c.symbol]
            if value == c.symbol:
                continue
            found[c.symbol] = value
            for order in (1, 2):
                value = cast("sp.Expr", sp.diff(value, time))
                found[sp.Derivative(c.symbol, (time, order))] = value
        return found

    def put_in(self, expr: sp.Expr) -> sp.Expr:
        """An expression of the old coordinates and their rates, converted to the new ones."""
        if expr not in self._memo:
            self._memo[expr] = cast("sp.Expr", expr.xreplace(self.replacements)) if self.replacements else expr
        return self._memo[expr]

    @property
    def replaced(self) -> tuple[tuple[Coordinate, sp.Expr], ...]:
        """The old coordinates that are replaced, with φ."""
        return tuple((c, self.table[c.symbol]) for c in self.old if self.table[c.symbol] != c.symbol)


def read_change(model: Model, given: Mapping[Any, Any]) -> Change:
    """Return the change of coordinates described by ``given``, after checking it.

    Keys are coordinates of the model (symbols or names); values are expressions of coordinates that stay or are new, as
    SymPy or text. A mapping of new names to expressions of old coordinates is solved if it is linear. Raises
    `ModelError` if the change is singular, if the numbers of old and new coordinates differ, if it contains rates,
    inputs or undeclared symbols, or if it replaces part of a floating frame.
    """
    if not isinstance(given, Mapping) or not given:
        raise ModelError(
            "a change of coordinates is a mapping from old coordinates to expressions in new ones",
            fix="{x2: x1 + x2r}",
            code="E406",
        )
    by_name = {c.name: c for c in model.coordinates}
    keys = [_key(key) for key in given]
    if len(set(keys)) < len(keys):
        raise ModelError("a coordinate is given twice, by name and by symbol", fix="give each once", code="E404")
    known = [k in by_name for k in keys]
    if not any(known):
        pairs = {k: _expression(model, v, k) for k, v in zip(keys, given.values(), strict=True)}
        _check_new(model, pairs)
        return _checked(model, _solved(model, pairs))
    if not all(known):
        raise _no_coordinate(model, keys[known.index(False)])
    table = {by_name[k]: _expression(model, v, k) for k, v in zip(keys, given.values(), strict=True)}
    return _checked(model, _placed(model, table))


def _no_coordinate(model: Model, name: str) -> ModelError:
    known = [c.name for c in model.coordinates]
    fix = did_you_mean(name, known) or f"coordinates: {', '.join(known)}"
    return ModelError(f"there is no coordinate '{name}' to be replaced", fix=fix, code="E402")


def _check_new(model: Model, pairs: Mapping[str, sp.Expr]) -> None:
    """Raise an error for names that are not coordinates, unless the expressions contain only coordinates of the
    system."""
    own = {c.symbol for c in model.coordinates}
    for name, expr in pairs.items():
        if not expr.atoms(AppliedUndef) & own:
            raise _no_coordinate(model, name)


def _key(key: object) -> str:
    if isinstance(key, sp.Basic):
        return plain(key)
    if not isinstance(key, str):
        raise ModelError(
            f"a coordinate is given by its symbol or its name (got {type(key).__name__})",
            fix='{"x2": "x1 + x2r"}',
            code="E406",
        )
    return key.strip()


class _Open(Scope):
    """The names of a model; any other name is that of a new coordinate."""

    def meanings(self, written: str) -> tuple[list[str], int]:
        """The meanings of a name; an unknown name that could be that of a coordinate is one."""
        names, dots = super().meanings(written)
        if not names and written not in RESERVED and str(written).isidentifier() and len(written) <= 64:
            name = check_name(str(written), "coordinate")
            self.add(name, moving_symbol(name))
            return [name], 0
        return names, dots


def _expression(model: Model, value: object, key: str) -> sp.Expr:
    if isinstance(value, str):
        scope = _Open(model.symbols)
        return parse_expression(value, scope, what=f"what '{key}' becomes")
    return as_expr(value, f"what '{key}' becomes")


def _solved(model: Model, pairs: Mapping[str, sp.Expr]) -> Change:
    """Solve the change in which new coordinates are given in terms of old ones for as many old ones, the last first."""
    new = [moving_symbol(check_name(k, "coordinate")) for k in pairs]
    for key, expr in pairs.items():
        _check_letters(model, expr, key, {c.symbol for c in model.coordinates})
    used = [c for c in model.coordinates if any(e.has(c.symbol) for e in pairs.values())]
    for out in islice(combinations(reversed(used), len(new)), MOST_SETS):
        symbols = [c.symbol for c in out]
        slopes = sp.Matrix([[sp.diff(e, s) for s in symbols] for e in pairs.values()])
        if slopes.has(*symbols) or bounded.simplify(_determinant(slopes)) == 0:
            continue
        rest = sp.Matrix([e.xreplace(dict.fromkeys(symbols, sp.S.Zero)) for e in pairs.values()])
        values = slopes.LUsolve(sp.Matrix(new) - rest)
        return _placed(model, {c: bounded.expand(v) for c, v in zip(out, values, strict=True)})
    raise ModelError(
        f"{', '.join(pairs)} cannot be solved for coordinates of the system",
        fix="give it the other way round, an old coordinate by the new ones: {x: r*cos(phi), y: r*sin(phi)}",
        code="E210",
    )


def _ties(model: Model) -> str:
    """Why a constraint does not take a coordinate away."""
    rows = rows_of(model)
    if not rows:
        return ""
    if all(row.position is not None for row in rows):
        return "; a constraint takes none away: leave it out, and describe positions with fewer coordinates"
    names = " and ".join(f"'{row.name}'" for row in rows if row.position is None)
    return (
        f"; {names} ties rates, and if no position follows from it, every coordinate is still needed to say where "
        "the system is: the derivation eliminates rates instead (derive().minimal)"
    )


def _determinant(matrix: sp.Matrix) -> sp.Expr:
    return cast("sp.Expr", matrix.det(method="berkowitz"))


def _placed(model: Model, given: Mapping[Coordinate, sp.Expr]) -> Change:
    """Put the new coordinates in the places of those that they replace."""
    given = {c: e for c, e in given.items() if e != c.symbol}
    kept = {c.symbol for c in model.coordinates if c not in given}
    fresh: dict[AppliedUndef, None] = {}
    own: dict[Coordinate, list[AppliedUndef]] = {}
    signals = {u.symbol for u in model.inputs} | {d.symbol for d in model.definitions}
    for c, e in given.items():
        mine = sorted(e.atoms(AppliedUndef) - kept - signals, key=lambda s: (s != c.symbol, str(s)))
        own[c] = mine
        fresh.update(dict.fromkeys(mine))
        _check_letters(model, e, c.name, {*kept, *mine})
    if len(fresh) != len(given):
        raise ModelError(
            f"{_counted(len(given), 'coordinate is', 'coordinates are')} replaced ({', '.join(c.name for c in given)}) "
            f"by {len(fresh)} new ({', '.join(plain(s) for s in fresh) or 'none'})",
            fix="a system has as many coordinates after a change as before it"
            + ("; declare other letters as parameters first" if len(fresh) > len(given) else _ties(model)),
            code="E210",
        )
    taken: list[AppliedUndef] = []
    for mine in own.values():
        for s in mine:
            if s not in taken:
                taken.append(s)
                break
        else:
            taken.append(next(s for s in fresh if s not in taken and not _promised(s, own, taken)))
    new = dict(zip(given, taken, strict=True))
    made = tuple(_named(c, given[c], new[c]) if c in given else c for c in model.coordinates)
    return Change(model.coordinates, made, {c.symbol: given.get(c, c.symbol) for c in model.coordinates})


def _promised(s: AppliedUndef, own: Mapping[Coordinate, list[AppliedUndef]], taken: list[AppliedUndef]) -> bool:
    """Whether this new coordinate is the only one left for the place of another expression."""
    later = list(own.values())[len(taken) + 1 :]
    return any([x for x in mine if x not in taken] == [s] for mine in later)


def _named(old: Coordinate, value: sp.Expr, symbol: AppliedUndef) -> Coordinate:
    slope = sp.diff(value, symbol)
    name = symbol.func.__name__
    words = f"{old.name} = {plain(value)}" if name != old.name else f"in place of a {name} that is {plain(value)}"
    unit = old.unit if slope.is_number else None
    positive = symbol.is_positive is True
    return Coordinate(name, symbol, words if len(words) <= 100 else "", unit, old.place, positive=positive)


def _counted(n: int, one: str, many: str) -> str:
    return f"{n} {one if n == 1 else many}"


def _check_letters(model: Model, expr: sp.Expr, key: str, moving: set[Any]) -> None:
    """Raise an error for rates, inputs, moving definitions and constants that the model does not have."""
    where = f"what '{key}' becomes"
    if rates := expr.atoms(sp.Derivative):
        rate = min(map(plain, rates))
        raise ModelError(
            f"{where} contains a rate, {rate}",
            fix="use only coordinates, parameters and t; the rates are derived from them",
            code="E308",
        )
    inputs = {u.symbol for u in model.inputs}
    quasi = {v.symbol for v in model.velocities}
    known = {*model.symbols.values()}
    for s in sorted(expr.atoms(AppliedUndef) - moving, key=str):
        if s not in known:
            names = [plain(m) for m in moving]
            fix = did_you_mean(plain(s), names) or f"coordinates: {', '.join(sorted(names))}"
            raise ModelError(f"unknown coordinate '{plain(s)}' in {where}", fix=fix, code="E402")
        what = "an input" if s in inputs else "a velocity" if s in quasi else "a definition that moves"
        raise ModelError(
            f"{where} contains '{plain(s)}', {what}",
            fix="use only kept or new coordinates, parameters and t",
            code="E417",
        )
    constants = {p.symbol for p in model.parameters} | {d.symbol for d in model.definitions}
    for s in sorted(expr.free_symbols - constants - {time}, key=str):
        names = [p.name for p in model.parameters]
        raise ModelError(
            f"unknown symbol '{s}' in {where}",
            fix=did_you_mean(str(s), names) or "a new coordinate is a function of time, dynamicsymbols('x2r')",
            code="E402",
        )


def _checked(model: Model, change: Change) -> Change:
    """Raise an error if a coordinate of a floating frame is changed, or if J nowhere has full rank."""
    floating = {c.name: f for f in model.floating if f.floating is not None for c in f.floating.coordinates}
    for c, _ in change.replaced:
        if c.name in floating:
            raise ModelError(
                f"'{c.name}' belongs to frame '{floating[c.name].name}', which has a quaternion",
                fix="keep the coordinates of the frame: they belong together and cannot be replaced",
                code="E210",
            )
    if change.replaced:
        check_regular(model, change)
    return change


def check_regular(model: Model, change: Change) -> None:
    """Raise an error if J = ∂(old)/∂(new) nowhere has full rank."""
    size, weakest = _smallest(model, change)
    if size < MIN_SINGULAR_VALUE:
        names = [c.name for c, w in zip(change.new, weakest, strict=True) if abs(w) > 1e-6]
        raise ModelError(
            f"the change is singular: {' and '.join(names)} can wiggle without moving an old coordinate",
            fix="every new coordinate must move the system independently: det ∂(old)/∂(new) must not be 0 everywhere",
            code="E210",
        )


def is_regular(model: Model, change: Change) -> bool:
    """Whether J = ∂(old)/∂(new) has full rank at some position."""
    return _smallest(model, change)[0] >= MIN_SINGULAR_VALUE


def _smallest(model: Model, change: Change) -> tuple[float, NDArray[np.float64]]:
    """The smallest singular value of J relative to its largest, with its direction, at the best position."""
    n = len(change.old)
    sampler = Sampler(model, list(change.jacobian.flat()))
    best, weakest = -1.0, np.zeros(n)
    for _, values in sampler.states(STATES, seed=3):
        _, s, vt = np.linalg.svd(np.array(values, float).reshape(n, n))
        if s[-1] / max(s[0], 1e-300) > best:
            best, weakest = float(s[-1] / max(s[0], 1e-300)), vt[-1]
    return best, weakest
