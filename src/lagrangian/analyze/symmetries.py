"""Symmetries of a Lagrangian: directions in which nothing changes, found by a null space and proved in normal form.

Along δξ_i = a_i + Σ_j B_ij ξ_j (shifts, turns and what is made of them; a and B constant) and δt = −e

    d/dt (Σ_i δξ_i p_i + e h) = Σ_i (δξ_i (∂L/∂ξ_i + Ξ_i) + δξ̇_i p_i) + e (Ξ·ξ̇ − ∂L/∂t),

which is linear in a, B, e: Noether's theorem with forces. Its value at random states, parameters and inputs gives one
row a state; what is 0 everywhere is the null space. Source: Noether, Göttinger Nachrichten (1918) 235–257.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
import sympy as sp

from lagrangian.analyze.echelon import null_space, reduced
from lagrangian.analyze.lagrangian_form import LagrangianForm
from lagrangian.derive.algebra import Form
from lagrangian.derive.sample import Sampler

TURNS = 12
"""Coordinates up to which directions that depend on the coordinates are looked for."""

DENOMINATOR = 24
"""Largest denominator of a share in a direction."""


@dataclass(frozen=True, eq=False)
class Symmetry:
    """δξ_i = shift_i + Σ_j turn_ij ξ_j and δt = −time, that leave the motion as it is."""

    system: LagrangianForm
    shift: tuple[Fraction, ...]
    turn: Mapping[tuple[int, int], Fraction]
    time: Fraction

    @cached_property
    def direction(self) -> tuple[Form, ...]:
        """δξ_i."""
        algebra = self.system.algebra
        n = len(self.system.q)
        found = []
        for i in range(n):
            parts = [algebra.number(self.shift[i])] if self.shift[i] else []
            parts += [algebra.form(self.system.q[j]) * c for (k, j), c in self.turn.items() if k == i]
            found.append(algebra.total(parts))
        return tuple(found)

    @cached_property
    def conserved(self) -> Form:
        """Σ δξ_i p_i + e h."""
        algebra = self.system.algebra
        parts = [d * p for d, p in zip(self.direction, self.system.momenta, strict=True) if d.parts]
        if self.time:
            parts.append(self.system.energy * self.time)
        return algebra.total(parts)

    @cached_property
    def rate(self) -> Form:
        """What it changes at."""
        system, algebra = self.system, self.system.algebra
        parts = []
        for d, push, p in zip(self.direction, system.pushes, system.momenta, strict=True):
            if d.parts:
                parts += [d * push, d.total_derivative() * p]
        if self.time:
            parts.append(system.power * self.time)
        return algebra.total(parts)

    @property
    def kind(self) -> str:
        """ "energy", "momentum" of one ignorable coordinate, "shift" of several, or "turn"."""
        if self.turn:
            return "turn"
        moved = sum(1 for x in self.shift if x)
        if self.time:
            return "energy" if not moved else "screw"
        return "momentum" if moved == 1 else "shift"


def symmetries(system: LagrangianForm, still: Mapping[Any, Any]) -> list[Symmetry]:
    """The symmetries of a system, with the symbols of ``still`` at their values; proved, and independent.

    What is found is exact: a direction counts only if the normal form of its rate is 0.
    """
    n = len(system.q)
    names = [("shift", i, 0) for i in range(n)]
    if n <= TURNS:
        names += [("turn", i, j) for i in range(n) for j in range(n)]
    names.append(("time", 0, 0))
    rows = _rows(system, still, names)
    if rows is None:
        return []
    size = np.linalg.norm(rows, axis=0)
    # columns of their own size, so that one tolerance serves all; a column of zeros is a symmetry by itself
    scale = np.where(size > 0, size, 1.0)
    found, _ = reduced(null_space(rows / scale) / scale)
    listed = []
    for row in found:
        shares = _rational(row)
        if shares is None:
            continue
        symmetry = _symmetry(system, names, shares)
        if system.at(symmetry.rate, still).is_zero and symmetry.conserved.parts:
            listed.append(symmetry)
    return listed


def _rows(system: LagrangianForm, still: Mapping[Any, Any], names: list[tuple[str, int, int]]) -> Any:
    """The rate of every elementary direction, a column each, at random states, a row each."""
    n = len(system.q)
    forms = [*system.pushes, *system.momenta, system.power]
    exprs: list[sp.Expr] = [system.at(f, still).raw() for f in forms]
    sampler = Sampler(system.model, [*exprs, *system.q, *system.v])
    rows = []
    for _, got in sampler.states(2 * len(names) + 8, seed=3):
        push, p, power = got[:n], got[n : 2 * n], got[2 * n]
        q, v = got[2 * n + 1 : 3 * n + 1], got[3 * n + 1 :]
        row = []
        for kind, i, j in names:
            row.append(push[i] if kind == "shift" else q[j] * push[i] + v[j] * p[i] if kind == "turn" else power)
        rows.append(row)
    return np.array(rows)


def _rational(row: Any) -> list[Fraction] | None:
    """A row as small fractions, or None."""
    shares = [Fraction(float(x)).limit_denominator(DENOMINATOR) for x in row]
    return shares if all(abs(float(s) - x) < 1e-7 for s, x in zip(shares, row, strict=True)) else None


def _symmetry(system: LagrangianForm, names: list[tuple[str, int, int]], shares: list[Fraction]) -> Symmetry:
    shift = [Fraction(0)] * len(system.q)
    turn: dict[tuple[int, int], Fraction] = {}
    at_time = Fraction(0)
    for (kind, i, j), share in zip(names, shares, strict=True):
        if not share:
            continue
        if kind == "shift":
            shift[i] = share
        elif kind == "turn":
            turn[i, j] = share
        else:
            at_time = share
    return Symmetry(system, tuple(shift), turn, at_time)
