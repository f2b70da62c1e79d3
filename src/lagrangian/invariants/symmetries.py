"""Finds symmetries of a Lagrangian, directions in which nothing changes: by a null space, and proved in normal form.

Along δξ_i = a_i + Σ_j B_ij ξ_j (shifts, turns and what is made of them; a, B and e made of parameters) and δt = −e

    d/dt (Σ_i δξ_i p_i + e h) = Σ_i (δξ_i (∂L/∂ξ_i + Ξ_i) + δξ̇_i p_i) + e (Ξ·ξ̇ − ∂L/∂t),

which is linear in a, B, e: Noether's theorem with forces. A constraint A ξ̇ + a₀ = 0 adds λ (A δξ − e a₀), which must
vanish for every λ. Its value at random states, parameters and inputs gives one
row a state; what is 0 everywhere is the null space. Source: Noether, Göttinger Nachrichten (1918) 235–257.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any, cast

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import bounded
from lagrangian.derive.algebra import Form
from lagrangian.derive.sample import Sampler
from lagrangian.errors import ModelError
from lagrangian.invariants.lagrangian_form import LagrangianForm
from lagrangian.linear.echelon import null_space, reduced
from lagrangian.model import time
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

TURNS = 12
"""Directions that depend on the coordinates are sought for at most this many coordinates."""

DENOMINATOR = 24
"""The largest denominator of a component of a direction."""


PARAMETRIC = 6
"""Rotations with components that depend on parameters are sought for at most this many coordinates."""


@dataclass(frozen=True, eq=False)
class Symmetry(Brief):
    """A symmetry δξ_i = shift_i + Σ_j turn_ij ξ_j, δt = −time; its components contain only parameters."""

    system: LagrangianForm
    shift: tuple[sp.Expr, ...]
    turn: Mapping[tuple[int, int], sp.Expr]
    time: sp.Expr

    @cached_property
    def direction(self) -> tuple[Form, ...]:
        """δξ_i."""
        algebra = self.system.algebra
        n = len(self.system.q)
        found = []
        for i in range(n):
            parts = [algebra.form(self.shift[i])] if self.shift[i] != 0 else []
            parts += [algebra.form(self.system.q[j]) * algebra.form(c) for (k, j), c in self.turn.items() if k == i]
            found.append(algebra.total(parts))
        return tuple(found)

    @cached_property
    def conserved(self) -> Form:
        """Σ δξ_i p_i + e h."""
        algebra = self.system.algebra
        parts = [d * p for d, p in zip(self.direction, self.system.momenta, strict=True) if d.parts]
        if self.time != 0:
            parts.append(self.system.energy * algebra.form(self.time))
        return algebra.total(parts)

    @cached_property
    def rate(self) -> Form:
        """The rate at which the conserved quantity changes, which is 0 for a true symmetry."""
        system, algebra = self.system, self.system.algebra
        parts = []
        for d, push, p in zip(self.direction, system.pushes, system.momenta, strict=True):
            if d.parts:
                parts += [d * push, d.total_derivative() * p]
        if self.time != 0:
            parts.append(system.power * algebra.form(self.time))
        return algebra.total(parts)

    @property
    def kept_by_rows(self) -> bool:
        """Whether constraints do no work on the direction, whatever their multipliers: A δξ = e a₀ for every row."""
        system, algebra = self.system, self.system.algebra
        for _, A, a0 in system.pushes_of_rows:
            parts = [a * d for a, d in zip(A, self.direction, strict=True) if a.parts and d.parts]
            if self.time != 0:
                parts.append(-(a0 * algebra.form(self.time)))
            if not algebra.total(parts).is_zero:
                return False
        return True

    @property
    def kind(self) -> str:
        """The kind: "energy", "momentum" (of one coordinate), "shift" (of several), "turn", "screw" (with energy)."""
        moved = sum(1 for x in self.shift if x != 0)
        if self.time != 0:
            return "energy" if not moved and not self.turn else "screw"
        if self.turn:
            return "turn"
        return "momentum" if moved == 1 else "shift"


@dataclass(frozen=True, eq=False)
class _Columns:
    """The elementary directions and the rates of their quantities at random states."""

    system: LagrangianForm
    names: list[tuple[str, int, int]]
    sampler: Sampler

    @classmethod
    def of(cls, system: LagrangianForm, still: Mapping[Any, Any], turns: bool) -> _Columns:
        n = len(system.q)
        names = [("shift", i, 0) for i in range(n)]
        names += [("turn", i, j) for i in range(n) for j in range(n)] if turns else []
        forms = [*system.pushes, *system.momenta, system.power]
        exprs: list[sp.Expr] = [system.at(f, still).raw() for f in forms]
        rows = [system.at(f, still).raw() for _, A, a0 in system.pushes_of_rows for f in (*A, a0)]
        return cls(system, [*names, ("time", 0, 0)], Sampler(system.model, [*exprs, *system.q, *system.v, *rows]))

    def null_rows(self, fixed: Mapping[Any, float]) -> tuple[NDArray[np.float64], list[int]]:
        """The null space in reduced form and its leading columns, with the values of ``fixed`` substituted."""
        rows = np.array([row for got in self._states(fixed) for row in self._rows(got)])
        if not len(rows):
            raise ModelError(
                f"the forces of system '{self.system.model.name}' have no finite value at any random state",
                fix="check square roots, logarithms and divisions for arguments that are never allowed",
                code="E503",
            )
        size = np.linalg.norm(rows, axis=0)
        scale = np.where(size > 0, size, 1.0)  # one tolerance for all; a column of zeros is a symmetry by itself
        return reduced(null_space(rows / scale) / scale)

    def _states(self, fixed: Mapping[Any, float]) -> list[list[float]]:
        found: list[list[float]] = []
        wanted = 2 * len(self.names) + 8
        for seed in range(4 * wanted):
            got = self.sampler.at({**self.sampler.draw(seed), **fixed})
            if np.isfinite(got).all():
                found.append(got)
                if len(found) == wanted:
                    break
        return found

    def _rows(self, got: list[float]) -> list[list[float]]:
        """What must vanish at a state: the rate of the quantity, and what every constraint adds for λ = 1."""
        n = len(self.system.q)
        push, p, power = got[:n], got[n : 2 * n], got[2 * n]
        q, v, rest = got[2 * n + 1 : 3 * n + 1], got[3 * n + 1 : 4 * n + 1], got[4 * n + 1 :]
        made = [[]]
        for kind, i, j in self.names:
            made[0].append(push[i] if kind == "shift" else q[j] * push[i] + v[j] * p[i] if kind == "turn" else power)
        for at in range(0, len(rest), n + 1):
            A, a0 = rest[at : at + n], rest[at + n]
            made.append([A[i] if k == "shift" else q[j] * A[i] if k == "turn" else -a0 for k, i, j in self.names])
        return made

    def symmetry(self, shares: Sequence[sp.Expr]) -> Symmetry:
        """The symmetry with these components along the elementary directions."""
        shift = [sp.S.Zero] * len(self.system.q)
        turn: dict[tuple[int, int], sp.Expr] = {}
        at_time: sp.Expr = sp.S.Zero
        for (kind, i, j), share in zip(self.names, shares, strict=True):
            if share == 0:
                continue
            if kind == "shift":
                shift[i] = share  # type: ignore[call-overload]
            elif kind == "turn":
                turn[i, j] = share
            else:
                at_time = share
        return Symmetry(self.system, tuple(shift), turn, at_time)


def symmetries(system: LagrangianForm, still: Mapping[Any, Any]) -> list[Symmetry]:
    """The symmetries of a system with the values of ``still`` substituted; proved, and independent.

    They are exact: a direction counts only if the normal form of its rate is 0. Components are small fractions, or
    small fractions times powers of parameters.
    """
    n = len(system.q)
    columns = _Columns.of(system, still, n <= TURNS)
    found, _ = columns.null_rows({})
    shares = [row for row in (_rational(r) for r in found) if row is not None]
    wider = columns if n <= PARAMETRIC else _Columns.of(system, still, turns=False)
    candidates = [columns.symmetry(row) for row in shares]
    known = sum(1 for c in candidates if wider is columns or not c.turn)
    own = _parametric(wider, [s for s in columns.sampler.symbols if isinstance(s, sp.Symbol) and s != time], known)
    if own is not None:
        extra = [wider.symmetry(row) for row in own]
        candidates = extra if wider is columns else [*extra, *(c for c in candidates if c.turn)]
    return [c for c in candidates if c.conserved.parts and system.at(c.rate, still).is_zero and c.kept_by_rows]


def _parametric(columns: _Columns, parameters: Sequence[Any], known: int) -> list[list[sp.Expr]] | None:
    """Components as fractions times powers of parameters, found by doubling one parameter after another.

    None if there are no more than the ``known`` ones, or if they do not have this form.
    """
    base = {p: 0.5 + 0.37 * ((k * 0.618) % 1.0) for k, p in enumerate(parameters)}
    first, leading = columns.null_rows(base)
    if len(first) <= known:
        return None
    powers = np.zeros((*first.shape, len(parameters)))
    for k, p in enumerate(parameters):
        moved, others = columns.null_rows({**base, p: 2 * base[p]})
        if others != leading or ((moved == 0) != (first == 0)).any():
            return None
        with np.errstate(divide="ignore", invalid="ignore"):
            powers[:, :, k] = np.where(first == 0, 0.0, np.log2(np.abs(moved / first)))
    found = []
    for r in range(first.shape[0]):
        shares = [_power(float(first[r, k]), powers[r, k, :], parameters, base) for k in range(first.shape[1])]
        if all(s is not None for s in shares):
            found.append(_cleared([s for s in shares if s is not None]))
    return found


def _power(
    x: float, exponents: NDArray[np.float64], parameters: Sequence[Any], base: Mapping[Any, float]
) -> sp.Expr | None:
    """x as a small fraction times powers of parameters, or None."""
    if x == 0:
        return sp.S.Zero
    whole: list[int] = [round(e) for e in exponents.tolist()]
    if any(abs(e - w) > 1e-6 or abs(w) > 4 for e, w in zip(exponents.tolist(), whole, strict=True)):
        return None
    size = float(np.prod([base[p] ** e for p, e in zip(parameters, whole, strict=True)]))
    number = _rational([x / size])
    if number is None:
        return None
    return cast("sp.Expr", sp.Mul(number[0], *(p**e for p, e in zip(parameters, whole, strict=True))))


def _cleared(shares: list[sp.Expr]) -> list[sp.Expr]:
    """The components multiplied by their common denominator."""
    under = sp.S.One
    for share in shares:
        under = sp.lcm(under, sp.fraction(share)[1])
    return [cast("sp.Expr", bounded.expand(share * under)) for share in shares]


def _rational(row: Any) -> list[sp.Expr] | None:
    """A row as small fractions, or None."""
    shares = [Fraction(float(x)).limit_denominator(DENOMINATOR) for x in row]
    if not all(abs(float(s) - x) < 1e-7 for s, x in zip(shares, row, strict=True)):
        return None
    return [sp.Rational(s.numerator, s.denominator) for s in shares]  # type: ignore[misc]
