"""The right answer: a system's own equations and energies, at random states and in normal form, computed once."""

from __future__ import annotations

import copy
from collections.abc import Callable, Hashable, Mapping, Sequence
from functools import cached_property, lru_cache
from typing import Any, cast

import mpmath
import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.branches import Branch, natural, sides_of
from lagrangian.check.half_angles import HalfAngle, half_angles, with_half_angles
from lagrangian.derive import Derived
from lagrangian.derive.algebra import Algebra, Form, OutOfReach
from lagrangian.derive.sampling import DIGITS, Array, CompiledExpressions, States
from lagrangian.model import Model, time

LONGEST = 4000
"""An expression with more terms when expanded is compared numerically instead of in normal form."""

MAX_VALUED = 8
"""The number of sets of values for which the reference is kept."""

MAX_KEPT = 500
"""The number of arrays of values that are kept."""


class Reference:
    """The right equations of a derivation, ready for comparison; ``values`` are substituted for parameters.

    ``others`` caches the same system in the coordinates of answers; ``tried_all`` becomes false if well-known mistakes
    have too many operations to be all tried.
    """

    def __init__(self, derivation: Derived, values: Mapping[sp.Symbol, sp.Expr] | None = None) -> None:
        self.derivation = derivation
        self.values = dict(values or {})
        self.others: dict[object, Reference | None] = {}
        self.tried_all = True
        self._kept: dict[Hashable, Array] = {}
        self._valued: dict[tuple[tuple[sp.Symbol, sp.Expr], ...], Reference] = {}
        self.model: Model = derivation.model
        self.n = len(derivation.coordinates)
        self.states = States(self.model, 2 * self.n + 6)
        self.region: sp.Expr | None = None
        self.sides: tuple[Branch, ...] = ()
        self.halves: tuple[HalfAngle, ...] = ()
        self.sides = self._sides()
        self.halves = self._halves()
        self.T, self.V = self.expand(derivation.T), self.expand(derivation.V)
        self.Xi = tuple(self.expand(derivation.Xi[q]) for q in derivation.coordinates)
        self.rows = tuple(map(self.expand, self._differences()))

    @cached_property
    def names(self) -> frozenset[sp.Basic]:
        """What the system has names for: time, its parameters, coordinates and inputs."""
        model = self.model
        return frozenset([time, *(x.symbol for x in (*model.parameters, *model.coordinates, *model.inputs))])

    @cached_property
    def energies(self) -> dict[str, sp.Expr]:
        """T*, V and L by the letters for their lines."""
        return {"T": self.T, "V": self.V, "L": self.L}

    @cached_property
    def mass_matrix(self) -> sp.ImmutableMatrix:
        """The mass matrix with all definitions written out and with values, as `expand` has it."""
        return sp.ImmutableMatrix(self.derivation.mass_matrix.applyfunc(self.expand))

    @cached_property
    def determinant(self) -> sp.Expr:
        """The determinant of the mass matrix, expanded."""
        return bounded.expand(cast("sp.Expr", self.mass_matrix.det(method="berkowitz")))

    @cached_property
    def prescribed(self) -> frozenset[sp.Basic]:
        """The parameters in prescribed motions, as A and Ω in φ = A sin Ωt."""
        moves = {c.symbol for c in self.model.coordinates} | {u.symbol for u in self.model.inputs}
        moving = [d.expression for d in self.model.definitions if d.moving and not d.expression.has(*moves)]
        return frozenset[sp.Basic]().union(*(x.free_symbols for x in moving)) - {time}

    @cached_property
    def placed(self) -> frozenset[sp.Expr]:
        """The system's own names that its coordinates give, ℓ of a spring; none of a prescribed motion."""
        moving = [c.symbol for c in self.model.coordinates]
        own = (d.symbol for d in self.model.definitions if d.moving)
        return frozenset(x for x in own if self.model.expand(x).has(*moving))

    @cached_property
    def angles(self) -> frozenset[sp.Basic]:
        """The parameters that stand in sines and cosines alone, as α in m g sin α."""
        exprs = [self.T, self.V, *self.Xi, *self.rows]
        turned = {f for x in exprs for f in bounded.atoms(x, sp.sin, sp.cos, sp.tan)}
        inside = frozenset[sp.Basic]().union(*(f.free_symbols for f in turned))
        straight = (x.xreplace(dict.fromkeys(turned, sp.S.One)).free_symbols for x in exprs)
        return inside.difference(*straight) & {p.symbol for p in self.model.parameters}

    def _differences(self) -> list[sp.Expr]:
        return [cast("sp.Expr", e.lhs) - cast("sp.Expr", e.rhs) for e in self.derivation.equations]

    def _sides(self) -> tuple[Branch, ...]:
        d = self.derivation
        exprs = [self.expand(x) for x in (d.T, d.V, *self._differences())]
        M = sp.Matrix(d.mass_matrix.applyfunc(self.expand))
        return sides_of(exprs, M, self.states, list(d.coordinates))

    def _halves(self) -> tuple[HalfAngle, ...]:
        d = self.derivation
        exprs = [d.T, d.V, *self._differences(), *(x.symbol for x in self.model.definitions)]
        return half_angles([self.expand(x) for x in exprs], self.states, list(d.coordinates))

    def within(self, region: sp.Expr | None) -> Reference:
        """The same reference, with distant states restricted to those where ``region`` has the sign that it has at
        ordinary states."""
        if region is None:
            return self
        other = copy.copy(self)
        other.region = region
        return other

    def wide(self, exprs: Sequence[sp.Expr]) -> tuple[States, list[int]]:
        """States of any size and sign, larger than any number in the expressions, and which of them to use.

        Distances stay positive. In changed coordinates, only states where the change is one-to-one are used.
        """
        numbers = [abs(float(x)) for e in exprs for x in e.atoms(sp.Number) if x.is_finite]
        reach = max([300.0, *(5 * x for x in numbers if x < 1e12)])
        states = States(self.model, 2, reach=reach, sides=self.sides)
        if self.region is None:
            return states, list(range(states.size))
        compiled = CompiledExpressions([self.region])
        near, far = compiled.at(self.states)[0], compiled.at(states)[0]
        sign = np.sign(np.nansum(np.sign(near)))
        return states, [int(i) for i in np.flatnonzero(np.sign(far) == sign)]

    @property
    def L(self) -> sp.Expr:
        """T* − V."""
        return self.T - self.V

    def expand(self, expr: sp.Expr) -> sp.Expr:
        """An expression with all definitions of the model written out and with values substituted for parameters.

        √(p²) becomes p for a distance p of the model, see `branches`, and √(1 + cos θ) √2 cos(θ/2), see `half_angles`.
        """
        whole = self.model.expand(sp.sympify(expr), constants=True)
        return self.put(whole)

    def put(self, expr: sp.Expr) -> sp.Expr:
        """The same for an expression without definitions."""
        put = natural(cast("sp.Expr", expr.xreplace(self.values)) if self.values else expr, self.sides)
        return with_half_angles(put, self.halves)

    def with_values(self, values: Mapping[sp.Symbol, sp.Expr]) -> Reference:
        """The same reference with values substituted for parameters too; the last few are kept."""
        key = tuple(sorted(values.items(), key=str))
        if key not in self._valued:
            while len(self._valued) >= MAX_VALUED:
                del self._valued[next(iter(self._valued))]
            own = {p: cast("sp.Expr", v.xreplace(dict(values))) for p, v in self.values.items()}
            self._valued[key] = Reference(self.derivation, own | dict(values))
        return self._valued[key].within(self.region)

    def kept(self, of: Hashable, found: Callable[[], Array]) -> Array:
        """Values at the states, which are found once; the last ones are kept, for all answers."""
        if of not in self._kept:
            while len(self._kept) >= MAX_KEPT:
                del self._kept[next(iter(self._kept))]
            self._kept[of] = found()
        return self._kept[of]

    @cached_property
    def algebra(self) -> Algebra:
        """The ring in which answers are compared exactly; that of the derivation itself is not changed."""
        return Algebra(self.model, (self.T, self.V, *self.Xi))

    def form(self, expr: sp.Expr) -> Form | None:
        """The normal form of an expression, or None if it would be too long."""
        if terms(expr) > LONGEST:
            return None
        try:
            return self.algebra.form(expr)
        except (OutOfReach, OverflowError, ValueError):
            return None

    @cached_property
    def forms(self) -> tuple[Form | None, ...]:
        """The normal forms of the right equations, left minus right."""
        return tuple(self.form(r) for r in self.rows)

    @cached_property
    def compiled(self) -> CompiledExpressions:
        """The right equations as one graph."""
        return CompiledExpressions(self.rows)

    @cached_property
    def W(self) -> Array:
        """The right equations at every state, shape (n, size): left minus right."""
        return self.compiled.at(self.states)

    @cached_property
    def _motion(self) -> CompiledExpressions:
        d = self.derivation
        bias: list[Any] = [r.xreplace({c.acceleration: sp.S.Zero for c in self.model.coordinates}) for r in self.rows]
        inertia: list[Any] = list(d.mass_matrix.flat())
        return CompiledExpressions([*map(self.expand, inertia), *bias])

    @cached_property
    def accelerations(self) -> dict[sp.Basic, Array]:
        """The true accelerations M⁻¹ (Ξ − C ξ̇ − G) at every state; NaN where M is singular."""
        values = self._motion.at(self.states)
        n, size = self.n, self.states.size
        M = values[: n * n].reshape(n, n, size).transpose(2, 0, 1)
        h = values[n * n :].T
        a = np.full((size, n), np.nan)
        for s in range(size):
            if np.isfinite(M[s]).all() and np.linalg.cond(M[s]) < 1e12:
                a[s] = np.linalg.solve(M[s], -h[s])
        return {c.acceleration: a[:, i] for i, c in enumerate(self.model.coordinates)}

    def accelerations_exactly(self, states: States, index: int) -> dict[sp.Basic, Any]:
        """The true accelerations at one state, with 50 digits."""
        values, n = self._motion.exactly(states, index), self.n
        with mpmath.workdps(DIGITS):
            M = mpmath.matrix(n, n)
            for k in range(n * n):
                M[k // n, k % n] = values[k]
            a = mpmath.lu_solve(M, mpmath.matrix([-x for x in values[n * n :]]))
            return {c.acceleration: a[i] for i, c in enumerate(self.model.coordinates)}


@lru_cache(maxsize=5_000)
def terms(expr: sp.Basic) -> int:
    """An upper bound on the number of terms of an expanded expression."""
    known: dict[sp.Basic, int] = {}
    for e in bounded.each(expr):
        if not e.args or isinstance(e, (AppliedUndef, sp.Derivative)):
            known[e] = 1
            continue
        parts = [known[a] for a in e.args]
        if isinstance(e, sp.Add):
            known[e] = sum(parts)
        elif isinstance(e, sp.Mul):
            known[e] = _product(parts)
        elif isinstance(e, sp.Pow) and isinstance(e.exp, sp.Integer) and parts[0] > 1:
            known[e] = _product([parts[0]] * min(abs(int(e.exp)), 64))
        else:
            known[e] = max([1, *parts]) if isinstance(e, sp.Pow) else 1
            if isinstance(e, sp.Function) and max(parts) > LONGEST:
                known[e] = max(parts)
    return known[expr]


def _product(counts: Sequence[int]) -> int:
    total = 1
    for c in counts:
        total = min(total * c, 10**12)
    return total


@lru_cache(maxsize=32)
def truth_of(derivation: Derived) -> Reference:
    """The reference for a derivation, made once for the derivations that were checked most recently."""
    return Reference(derivation)


def _may_hold_time(part: sp.Basic) -> bool:
    """Whether a smallest part of an expression is one that time may be in."""
    return isinstance(part, (sp.Symbol, AppliedUndef, sp.Derivative))


def without_time(truth: Reference, V: sp.Expr) -> sp.Expr:
    """A potential energy without what depends on time alone, such as m g e sin Ωt, which changes no equation."""
    own = {x for c in truth.model.coordinates for x in (c.symbol, c.rate)}
    if not any(x == time or (x not in own and time in x.free_symbols) for x in bounded.each(V) if _may_hold_time(x)):
        return V
    moving = {x: sp.Dummy() for x in own}
    if time not in V.xreplace(moving).free_symbols:
        return V
    return sp.Add(*[x for x in sp.Add.make_args(bounded.expand(V)) if x.has(*moving)])
