"""The same equations in numbers, with 50 digits, at a random state that satisfies the equations of motion.

This is another route than that of the formulas: positions are differentiated by SymPy, not in normal form, and the
accelerations are those that solve the equations of motion.
"""

# SymPy and mpmath have no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false
# pyright: reportUnknownVariableType=false

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, cast

import mpmath
import sympy as sp

from lagrangian import bounded
from lagrangian.derive.derived import Derived
from lagrangian.derive.reasons.laws import AGREE
from lagrangian.derive.reasons.loads import AppliedLoads, Load
from lagrangian.derive.reasons.motion import Moving
from lagrangian.derive.sampling import DIGITS, PLACES, SETS, CompiledExpressions, States
from lagrangian.model import Model, time
from lagrangian.model.geometry import entries
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

NEWTON = 60
"""The number of steps in which a position must satisfy the constraints."""

TRIES = SETS * PLACES

Vector = tuple[Any, ...]


@dataclass(frozen=True, eq=False)
class LawNumbers(Brief):
    """The sides for one coordinate; see `Law`. ``moved`` is d/dt(∂T/∂ξ̇) − ∂T/∂ξ."""

    inertia: Any
    moved: Any
    conservative: Any
    fall: Any
    others: Any
    Xi: Any
    held: Any
    passed: Any
    rows: Any


@dataclass(frozen=True, eq=False)
class NumbersAt(Brief):
    """A state, and everything that was computed there.

    ``reactions[k]`` is the constraint force, or its moment, on `Moving` k, and ``works[k][j]`` its virtual work for
    δξ_j = 1. ``wiggles`` are independent admissible wiggles, the columns of the unit matrix without constraints.
    ``digits`` is the number of digits to which everything agrees.
    """

    state: Mapping[sp.Basic, Any]
    accelerations: Vector
    multipliers: Vector
    reactions: tuple[Vector, ...]
    works: tuple[Vector, ...]
    laws: tuple[LawNumbers, ...]
    wiggles: tuple[Vector, ...]
    digits: int

    @property
    def agree(self) -> bool:
        """Whether both sides of every equation agree."""
        return self.digits >= AGREE


def numbers(d: Derived, moving: tuple[Moving, ...], applied: AppliedLoads) -> NumbersAt | None:
    """Everything at a random state; None if some of it has no value at each of the states that were tried.

    Parameters with a value keep it, so that forces are what they are in the system.
    """
    with mpmath.workdps(DIGITS):
        states = States(d.model, 1)
        for index in range(TRIES):
            at = _At(d.model, states, index)
            try:
                return _numbers(d, moving, applied, at)
            except (ZeroDivisionError, ValueError, OverflowError, _NoState):
                continue
    return None


class _NoState(Exception):
    """No position near this one satisfies the constraints, or the equations have no solution there."""


class _At:
    """Values at one state; ``known`` holds those that are not random."""

    def __init__(self, model: Model, states: States, index: int) -> None:
        self.states, self.index = states, index
        self.known: dict[sp.Basic, Any] = {s: mpmath.mpf(v) for s, v in model.values.items()}
        self.asked: dict[sp.Basic, None] = {}
        self.expand = model.expand

    def __call__(self, exprs: Sequence[sp.Expr]) -> list[Any]:
        """The values of expressions. Raises `_NoState` if one of them has none."""
        compiled = CompiledExpressions([self.expand(sp.sympify(x), constants=True) for x in exprs])
        self.asked.update(dict.fromkeys(compiled.symbols))
        found = compiled.exactly(self.states, self.index, self.known)
        if not all(isinstance(x, mpmath.mpf) and mpmath.isfinite(x) for x in map(mpmath.mpmathify, found)):
            raise _NoState
        return [mpmath.mpf(x) for x in found]

    def value(self, symbol: sp.Basic) -> Any:
        """The value of a symbol."""
        return self.known.get(symbol, mpmath.mpf(float(self.states.of(symbol)[self.index])))


def _numbers(d: Derived, moving: tuple[Moving, ...], applied: AppliedLoads, at: _At) -> NumbersAt:
    coordinates, rows = d.model.coordinates, d.shares.rows
    slopes = [[slope.expr() for slope in row.slopes] for row in rows]
    _onto(d, at, slopes)
    A = _matrix(at([x for row in slopes for x in row]), len(rows), len(coordinates))
    _solve(d, at, A)
    values = _Values(d, moving, applied, at)
    multipliers = tuple(at.known[row.symbol] for row in rows)
    pushed = [sum((A[r, j] * multipliers[r] for r in range(len(rows))), mpmath.mpf(0)) for j in range(len(coordinates))]
    lines = values.laws(pushed)
    wiggles = _null(A, len(coordinates))
    pairs = [
        *((x.inertia, x.moved, values.scale) for x in lines),
        *((x.conservative, x.fall, values.scale) for x in lines),
        *((x.others, x.Xi, values.scale) for x in lines),
        *((x.held - x.passed, x.rows, values.scale) for x in lines),
        *((sum(a * b for a, b in zip(w, pushed, strict=True)), 0, values.scale) for w in wiggles),
    ]
    worst = max((abs(a - b) / scale for a, b, scale in pairs), default=mpmath.mpf(0))
    digits = DIGITS if worst == 0 else int(mpmath.floor(-mpmath.log10(worst)))
    named = {s: at.value(s) for s in at.asked if not str(s).startswith("number ")}
    accelerations = tuple(at.known[c.acceleration] for c in coordinates)
    return NumbersAt(named, accelerations, multipliers, values.reactions, values.works, lines, wiggles, digits)


def _matrix(values: Sequence[Any], rows: int, columns: int) -> Any:
    made = mpmath.zeros(rows, columns) if rows else mpmath.matrix(0, columns)
    for i in range(rows):
        for j in range(columns):
            made[i, j] = values[columns * i + j]
    return made


def _onto(d: Derived, at: _At, slopes: Sequence[Sequence[sp.Expr]]) -> None:
    """Move the coordinates, then the rates, onto the constraints, by the shortest steps."""
    rows, q = d.shares.rows, [c.symbol for c in d.model.coordinates]
    if not rows:
        return
    tied = [k for k, row in enumerate(rows) if row.row.position is not None]
    for symbol in q:
        at.known[symbol] = at.value(symbol)
    for _ in range(NEWTON if tied else 0):
        f = mpmath.matrix(at([rows[k].row.position for k in tied]))
        if max(abs(x) for x in f) < mpmath.mpf(10) ** (5 - DIGITS):
            break
        step = _shortest(_matrix(at([x for k in tied for x in slopes[k]]), len(tied), len(q)), f)
        long = max(1, max(abs(x) for x in step) / mpmath.mpf("0.5"))
        for symbol, x in zip(q, step, strict=True):
            at.known[symbol] -= x / long
    else:
        if tied:
            raise _NoState
    A = _matrix(at([x for row in slopes for x in row]), len(rows), len(q))
    step = _shortest(A, mpmath.matrix(at([row.rate.expr() for row in rows])))
    for c, x in zip(d.model.coordinates, step, strict=True):
        at.known[c.rate] = at.value(c.rate) - x


def _shortest(A: Any, right: Any) -> Any:
    """The shortest x with A x = right: Aᵀ (A Aᵀ)⁻¹ right."""
    return A.T * mpmath.lu_solve(A * A.T, right)


def _solve(d: Derived, at: _At, A: Any) -> None:
    """Find ξ̈ and λ from M ξ̈ + b = Aᵀ λ and A ξ̈ + γ = 0."""
    coordinates, rows = d.model.coordinates, d.shares.rows
    n, m = len(coordinates), len(rows)
    resting = {**{c.acceleration: mpmath.mpf(0) for c in coordinates}, **{r.symbol: mpmath.mpf(0) for r in rows}}
    at.known.update(resting)
    b = at([cast("sp.Expr", e.lhs) - cast("sp.Expr", e.rhs) for e in d.equations])
    gamma = at([row.second_rate.expr() for row in rows]) if rows else []
    M = at(list(entries(d.mass_matrix)))
    whole = mpmath.zeros(n + m, n + m)
    for i in range(n):
        for j in range(n):
            whole[i, j] = M[n * i + j]
        for r in range(m):
            whole[i, n + r], whole[n + r, i] = -A[r, i], A[r, i]
    found = mpmath.lu_solve(whole, mpmath.matrix([-x for x in (*b, *gamma)]))
    at.known.update({c.acceleration: found[i] for i, c in enumerate(coordinates)})
    at.known.update({row.symbol: found[n + r] for r, row in enumerate(rows)})


def _null(A: Any, n: int) -> tuple[Vector, ...]:
    """Independent vectors with A x = 0, each made of a unit vector without its part across the rows."""
    units = [mpmath.matrix([mpmath.mpf(int(i == j)) for i in range(n)]) for j in range(n)]
    if A.rows == 0:
        return tuple(tuple(u) for u in units)
    found: list[Any] = []
    for u in units:
        x = u - _shortest(A, A * u)
        for y in found:
            x -= y * ((y.T * x)[0] / (y.T * y)[0])
        if mpmath.norm(x) > mpmath.mpf(10) ** -9 and len(found) < n - A.rows:
            found.append(x / max(abs(v) for v in x))
    return tuple(tuple(x) for x in found)


class _Values:
    """Momenta, loads and virtual work at a state, from derivatives by SymPy."""

    def __init__(self, d: Derived, moving: tuple[Moving, ...], applied: AppliedLoads, at: _At) -> None:
        self.d, self.moving, self.applied, self.at = d, moving, applied, at
        self.columns: list[list[Vector]] = []
        self.rates: list[Vector] = []
        loads: list[Vector] = []
        for m in moving:
            rates, columns = _motion(d, m)
            size, n = len(rates), len(d.model.coordinates)
            values = at([*rates, *(x for column in columns for x in column)])
            self.rates.append(tuple(values[:size]))
            self.columns.append([tuple(values[size * (1 + j) : size * (2 + j)]) for j in range(n)])
            loads.append(self._loads(m, size))
        self.reactions = tuple(
            tuple(p - f for p, f in zip(rate, load, strict=True)) for rate, load in zip(self.rates, loads, strict=True)
        )
        self.works = tuple(
            tuple(_dot(R, column) for column in columns)
            for R, columns in zip(self.reactions, self.columns, strict=True)
        )
        self.scale = 1 + max(
            (
                abs(x * y)
                for v, columns in zip(self.reactions, self.columns, strict=True)
                for column in columns
                for x, y in zip(v, column, strict=True)
            ),
            default=mpmath.mpf(0),
        )

    def _loads(self, m: Moving, size: int) -> Vector:
        mine = [b.torque if m.turning else b.force for b in self.applied.loads if b.body is m.body]
        flat = self.at([x for v in mine for x in v]) if any(mine) else []
        return tuple(sum(flat[i::size], mpmath.mpf(0)) for i in range(size))

    def laws(self, pushed: Sequence[Any]) -> tuple[LawNumbers, ...]:
        """Both sides of every equation, for every coordinate; ``pushed`` is Aᵀ λ."""
        d = self.d
        exprs: list[sp.Expr] = []
        for c in d.model.coordinates:
            by_rate = bounded.diff(bounded.diff(d.T, c.rate), time)
            exprs += [by_rate - bounded.diff(d.T, c.symbol), -bounded.diff(d.V, c.symbol), d.Xi[c.symbol]]
            exprs += [item.effort * bounded.diff(item.rate, c.rate) for item in self.applied.passed]
        values = self.at(exprs)
        size = 3 + len(self.applied.passed)
        vectors = [(load, self._vectors(load)) for load in self.applied.loads]
        found: list[LawNumbers] = []
        for j in range(len(d.model.coordinates)):
            moved, fall, Xi, *shares = values[size * j : size * (j + 1)]
            through = {"V": mpmath.mpf(0), "Ξ": mpmath.mpf(0)}
            for item, x in zip(self.applied.passed, shares, strict=True):
                through[item.element.ledger] += x
            for load, parts in vectors:
                through[load.element.ledger] += sum(_dot(v, self.columns[k][j]) for k, v in parts)
            inertia = sum((_dot(p, cs[j]) for p, cs in zip(self.rates, self.columns, strict=True)), mpmath.mpf(0))
            held, passed = sum(works[j] for works in self.works), sum(shares, mpmath.mpf(0))
            row = pushed[j] if pushed else mpmath.mpf(0)
            found.append(LawNumbers(inertia, moved, through["V"], fall, through["Ξ"], Xi, held, passed, row))
        return tuple(found)

    def _vectors(self, load: Load) -> list[tuple[int, list[Any]]]:
        """The force and the torque of a load, each with the index of the motion that it acts on."""
        parts = [
            (k, load.torque if m.turning else load.force) for k, m in enumerate(self.moving) if m.body is load.body
        ]
        return [(k, self.at(list(v))) for k, v in parts if v]


def _dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    return sum((x * y for x, y in zip(a, b, strict=True)), mpmath.mpf(0))


def _motion(d: Derived, m: Moving) -> tuple[list[sp.Expr], list[list[sp.Expr]]]:
    """ṗ, and ∂r/∂ξ_j or ∂ω/∂ξ̇_j, by SymPy."""
    model, body = d.model, m.body
    if not m.turning:
        place = [model.expand(x) for x in model.position(body.at)]
        rates = [body.mass * bounded.diff(v, time) for v in model.velocity(body.at)]
        return rates, [[bounded.diff(x, c.symbol) for x in place] for c in model.coordinates]
    omega = body.angular_velocity(model)
    momentum = [sp.Add(*(x * w for x, w in zip(row, omega, strict=True))) for row in body.tensor]
    rates = [bounded.diff(h, time) for h in momentum]
    if len(omega) == 3:
        rates = [
            rates[k] + omega[i] * momentum[j] - omega[j] * momentum[i]
            for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1)))
        ]
    return rates, [[bounded.diff(w, c.rate) for w in omega] for c in model.coordinates]
