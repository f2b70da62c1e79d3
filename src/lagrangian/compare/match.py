"""Matches the coordinates of two systems by the places that the systems have in common.

Bodies, points and frames are matched by name; bodies also by mass and by order. Equal positions, differences of
positions and angles give equations for ξ = φ(η). Linear equations are solved directly; from L cos α(ξ) = L cos β(η), L
sin α(ξ) = L sin β(η) follows α = ±β + k π/2. The result is a proposal; `agreement` measures how many places it makes
equal.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import islice, pairwise
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.coordinates import Change
from lagrangian.derive.sample import Sampler
from lagrangian.model import Frame, Model, Point, time
from lagrangian.records import dataclass

MAX_OPERATIONS = 200
"""The largest number of operations in a component of a position that is used."""
POSITION_TOLERANCE = 1e-9
MAX_PROPOSALS = 12
"""The largest number of proposals that are examined."""
Vector = tuple[sp.Expr, ...]
Table = dict[Any, sp.Expr]


@dataclass(frozen=True)
class Places:
    """Pairs of vectors (positions, or single angles) that describe the same place in two systems."""

    pairs: tuple[tuple[Vector, Vector], ...]

    def swapped(self) -> Places:
        """The same pairs in the opposite order."""
        return Places(tuple((b, a) for a, b in self.pairs))


def places(a: Model, b: Model) -> Places:
    """Return the places that both systems have: positions of bodies and points, angles of bodies and frames, by
    name."""
    found: list[tuple[Vector, Vector]] = []
    if a.dimension == b.dimension:
        for p, q in _points(a, b):
            found.append((_position(a, p), _position(b, q)))
    for f, g in _frames(a, b):
        if f.floating is None and g.floating is None and f.dimension == g.dimension:
            if f.dimension == 2:
                found.append(((_full(a, f.total_angle),), (_full(b, g.total_angle),)))
            elif f.axis == g.axis:
                found.append(((_full(a, f.angle),), (_full(b, g.angle),)))
    return Places(tuple(found))


def _full(model: Model, expr: sp.Expr) -> sp.Expr:
    return model.expand(expr, constants=True)


def _position(model: Model, point: Point) -> Vector:
    return tuple(_full(model, x) for x in model.position(point))


def bodies(a: Model, b: Model) -> list[tuple[Any, Any]]:
    """Pairs of bodies with the same name, else the same mass, else in order if this leaves none over."""
    left, right, pairs = list(a.bodies), list(b.bodies), []
    for same in (lambda x, y: x.title == y.title, lambda x, y: x.name == y.name, lambda x, y: x.mass == y.mass):
        for x in list(left):
            alike = [y for y in right if same(x, y)]
            if len(alike) == 1:
                pairs.append((x, alike[0]))
                left.remove(x)
                right.remove(alike[0])
    if len(left) == len(right):
        pairs += list(zip(left, right, strict=True))
    order = {id(x): i for i, x in enumerate(a.bodies)}
    return sorted(pairs, key=lambda pair: order[id(pair[0])])


def _points(a: Model, b: Model) -> Iterator[tuple[Point, Point]]:
    for x, y in bodies(a, b):
        yield x.at, y.at
    named = {p.name: p for p in b.points}
    for p in a.points:
        if p.name in named:
            yield p, named[p.name]


def _frames(a: Model, b: Model) -> Iterator[tuple[Frame, Frame]]:
    for x, y in bodies(a, b):
        if x.axes is not None and y.axes is not None:
            yield x.axes, y.axes
    named = {f.name: f for f in b.frames}
    for f in a.frames:
        if f.name in named:
            yield f, named[f.name]


def agreement(a: Model, change: Change, pairs: Places) -> float:
    """The fraction of the places that ξ = φ(η) makes equal; 0 if there are none."""
    if not pairs.pairs:
        return 0.0
    gaps = [[change.put_in(x) - y for x, y in zip(p, q, strict=True)] for p, q in pairs.pairs]
    sampler = Sampler(a, [x for gap in gaps for x in gap])
    values = [abs(v) for v in sampler.at(sampler.draw(11))]
    equal, at = 0, 0
    for gap in gaps:
        part = values[at : at + len(gap)]
        at += len(gap)
        equal += all(not math.isnan(v) and v < POSITION_TOLERANCE for v in part)
    return equal / len(gaps)


def solved(a: Model, b: Model, pairs: Places) -> Iterator[dict[AppliedUndef, sp.Expr]]:
    """All φ that the places allow, coordinates of ``a`` in those of ``b``, the most certain first.

    If the places do not determine all coordinates, one after another is assumed to equal the one of the same name.
    """
    old = {c.symbol: sp.Dummy(c.name) for c in a.coordinates}  # a symbol may have different meanings in the two systems
    vectors = [(tuple(_renamed(x, old) for x in p), q) for p, q in _differences(pairs)]
    vectors += [((x,), (y,)) for p, q in vectors if len(p) > 1 for x, y in zip(p, q, strict=True)]
    theirs = {c.name: c.symbol for c in b.coordinates}
    same: Table = {dummy: theirs[s.func.__name__] for s, dummy in old.items() if s.func.__name__ in theirs}
    for table in islice(_deduced(vectors, old.values(), set(theirs.values()), same, {}), MAX_PROPOSALS):
        yield {symbol: table[dummy] for symbol, dummy in old.items()}


def _deduced(
    vectors: Sequence[tuple[Vector, Vector]], letters: Collection[Any], moving: set[Any], same: Table, known: Table
) -> Iterator[Table]:
    table = dict(known)
    while len(table) < len(letters):
        unknown = {s for s in letters if s not in table}
        equations = []
        for p, q in vectors:
            put = tuple(_renamed(x, table) for x in p)
            if any(x.free_symbols & unknown for x in put):
                equations += _linear(put, q, unknown) or _turned(put, q, unknown, moving)
        found = _resolved(equations, unknown)
        if not found:
            for letter in sorted(unknown & same.keys(), key=lambda s: s.sort_key()):
                yield from _deduced(vectors, letters, moving, same, {**table, letter: same[letter]})
            return
        table.update(found)
    yield table


def _renamed(expr: sp.Expr, names: Mapping[Any, sp.Expr]) -> sp.Expr:
    return cast("sp.Expr", expr.xreplace(names))


def _differences(pairs: Places) -> Iterator[tuple[Vector, Vector]]:
    """The positions, and the difference of each from the previous one, the simplest first."""
    yield from pairs.pairs
    for (p, q), (r, s) in pairwise(pairs.pairs):
        if len(p) == len(r):
            yield (
                tuple(bounded.expand(y - x) for x, y in zip(p, r, strict=True)),
                tuple(bounded.expand(y - x) for x, y in zip(q, s, strict=True)),
            )


def _linear(p: Vector, q: Vector, unknown: set[Any]) -> list[sp.Expr]:
    """Components that are linear in the unknowns, with constant factors or alone: left minus right."""
    found = []
    for x, y in zip(p, q, strict=True):
        mine = x.free_symbols & unknown
        if not mine or bounded.operations(x) > MAX_OPERATIONS:
            continue
        slopes = [sp.diff(x, u) for u in mine]
        if any(s.free_symbols & unknown for s in slopes):
            continue
        if all(not s.has(AppliedUndef, time) for s in slopes):
            found.append(x - y)
        elif len(mine) == 1:
            (u,) = mine
            value = bounded.cancel((y - x.xreplace({u: sp.S.Zero})) / slopes[0])
            if not sp.denom(value).has(AppliedUndef, time):
                found.append(u - value)
    return found


def _turned(p: Vector, q: Vector, unknown: set[Any], moving: set[Any]) -> list[sp.Expr]:
    """α = ±β + k π/2 if the unknowns occur only in sines and cosines of a single angle α."""
    if any(bounded.operations(x) > MAX_OPERATIONS for x in (*p, *q)):
        return []
    angles = {_upright(f.args[0]) for x in p for f in x.atoms(sp.sin, sp.cos) if f.free_symbols & unknown}
    if len(angles) != 1:
        return []
    (alpha,) = angles
    others = {_upright(f.args[0]) for x in q for f in x.atoms(sp.sin, sp.cos) if f.atoms(AppliedUndef) & moving}
    hidden = sp.Dummy("alpha")
    ours = [cast("sp.Expr", x.xreplace({alpha: hidden, -alpha: -hidden})) for x in p]
    if any(x.free_symbols & unknown for x in ours):
        return []
    for quarters in (0, 2, 1, -1):
        for beta in sorted(others, key=sp.default_sort_key):
            for sign in (1, -1):
                meant = sign * beta + quarters * sp.pi / 2
                if all(bounded.expand(x.xreplace({hidden: meant}) - y) == 0 for x, y in zip(ours, q, strict=True)):
                    return [alpha - meant]
    return []


def _upright(argument: Any) -> sp.Expr:
    """An angle without the sign that SymPy takes out of a sine."""
    angle: sp.Expr = argument
    return -angle if angle.could_extract_minus_sign() else angle


def _resolved(equations: Sequence[sp.Expr], unknown: set[Any]) -> Table:
    """Solve linear equations for the unknowns by elimination; an equation that contradicts earlier ones is omitted."""
    rows: dict[Any, tuple[Table, sp.Expr]] = {}  # symbol = rest − Σ factor · other symbol
    for equation in dict.fromkeys(bounded.expand(e) for e in equations):
        factors: Table = {u: f for u in equation.free_symbols & unknown if (f := sp.diff(equation, u)) != 0}
        rest = bounded.expand(-cast("sp.Expr", equation.xreplace(dict.fromkeys(unknown, sp.S.Zero))))
        for letter in list(factors.keys() & rows.keys()):
            factors, rest = _without(letter, factors, rest, rows[letter])
        if not factors:
            continue
        pivot = min(factors, key=lambda u: (not factors[u].is_number, u.sort_key()))
        scale = factors.pop(pivot)
        row = {u: bounded.cancel(f / scale) for u, f in factors.items()}, bounded.expand(rest / scale)
        for letter, (others, value) in list(rows.items()):
            if pivot in others:
                rows[letter] = _without(pivot, others, value, row)
        rows[pivot] = row
    return {letter: rest for letter, (others, rest) in rows.items() if not others}


def _without(letter: Any, factors: Table, rest: sp.Expr, row: tuple[Table, sp.Expr]) -> tuple[Table, sp.Expr]:
    """Substitute the row of a symbol into Σ factor · symbol = rest."""
    factor = factors[letter]
    others, value = row
    out = {u: f for u, f in factors.items() if u is not letter}
    for u, f in others.items():
        total = bounded.cancel(out.get(u, sp.S.Zero) - factor * f)
        out[u] = total
    return {u: f for u, f in out.items() if f != 0}, bounded.expand(rest - factor * value)
