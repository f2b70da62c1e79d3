"""Routh's form: ignorable coordinates are eliminated, and their constant momenta take their place.

    R = L − Σ_s p_s ξ̇_s,   ξ̇_s from p_s = ∂L/∂ξ̇_s:      d/dt(∂R/∂ξ̇_r) − ∂R/∂ξ_r = Ξ_r for the coordinates that are left

so that R serves as their Lagrangian (Goldstein, Classical Mechanics, 3rd ed., § 8.3, has −R). With
w = p_s − b_s − M_sr ξ̇_r it is  R = ½ ξ̇_rᵀ M_rr ξ̇_r + b_rᵀ ξ̇_r − (V − T₀) − ½ wᵀ M_ss⁻¹ w.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.bounded import TooLarge
from lagrangian.derive.algebra import Form
from lagrangian.derive.sample import Sampler
from lagrangian.errors import RunError, did_you_mean
from lagrangian.invariants.canonical_forms import Routhian
from lagrangian.invariants.hamiltonian import STATES, TOLERANCE, momentum_names, split
from lagrangian.invariants.lagrangian_form import LagrangianForm
from lagrangian.invariants.squares import SquarePiece, half_square, summed
from lagrangian.model import Model, is_hard, time
from lagrangian.page.formula import Check, text
from lagrangian.page.plain import plain
from lagrangian.values.values import key_name


@bounded.answered("Routh's form", is_hard)
def routhian(model: Model, ignorable: Sequence[Any] | None = None) -> Routhian:
    """Return Routh's form of a model; ``ignorable`` names the coordinates to eliminate, by default all that are
    ignorable.

    Raises `RunError` for a coordinate that appears in L or on which a force acts, and if none is ignorable.
    """
    system = LagrangianForm.of(model).without_rows("Routh's form")
    gone = _chosen(system, ignorable)
    left = [k for k in range(len(system.q)) if k not in gone]
    names = momentum_names(model)
    betas = [sp.Symbol(names[k]) for k in gone]
    algebra = system.algebra
    b, potential = split(system)
    M = system.mass
    rate = [algebra.form(v) for v in system.v]
    half = algebra.number(Fraction(1, 2))
    try:
        w = [
            algebra.total([algebra.form(beta), -b[s], *(-(M[s][r] * rate[r]) for r in left)])
            for s, beta in zip(gone, betas, strict=True)
        ]
        pieces = half_square([[M[i][j] for j in gone] for i in gone], w, algebra)
        own = [M[i][j] * rate[i] * rate[j] * half for i in left for j in left]
        own += [b[r] * rate[r] for r in left]
        polynomial = algebra.total([*own, -potential])
        solved = [summed([d for p in pieces for d in p.diff(beta)]) for beta in betas]
        still = dict.fromkeys(system.v, sp.S.Zero)
        effective = potential.expr() + cast("sp.Expr", summed(pieces).xreplace(still))
        equations = tuple(_equation(system, r, polynomial, pieces) for r in left)
        longest = max(bounded.size(x) for x in (*solved, effective, *(cast("sp.Expr", e.lhs) for e in equations)))
        bounded.check_size(longest, "one of its expressions")
    except TooLarge as trouble:
        raise RunError(
            f"R is too long to write out: {trouble.what}",
            fix="describe the system by points and frames instead of long expressions, or in other coordinates",
            code="E523",
        ) from trouble
    R = polynomial.expr() - summed(pieces)
    return Routhian(
        model=model,
        R=R,
        ignorable={system.q[k]: beta for k, beta in zip(gone, betas, strict=True)},
        definitions={beta: system.momenta[k].expr() for k, beta in zip(gone, betas, strict=True)},
        rates={system.v[k]: x for k, x in zip(gone, solved, strict=True)},
        coordinates=tuple(system.q[k] for k in left),
        equations=equations,
        potential=effective,
        checks=_checks(system, gone, left, betas, R, equations),
    )


def _chosen(system: LagrangianForm, asked: Sequence[Any] | None) -> list[int]:
    """The coordinates to eliminate."""
    names = [c.name for c in system.model.coordinates]
    proper = [
        k
        for k in range(len(names))
        if system.slopes[k].is_zero and system.forces[k].is_zero and not system.momenta[k].is_zero
    ]
    if asked is None:
        if not proper:
            raise RunError(
                "no coordinate is ignorable: every coordinate appears in L, or a force acts on it",
                fix="try other coordinates: polar ones, if the forces are central",
                code="E524",
            )
        return proper
    found = []
    for key in [asked] if isinstance(asked, str | sp.Basic) else list(asked):
        name = key_name(key)
        if name not in names:
            raise RunError(f"there is no coordinate '{name[:64]}'", fix=did_you_mean(name, names), code="E402")
        k = names.index(name)
        if k not in proper:
            slope, force = system.slopes[k], system.forces[k]
            why = f"L contains it: ∂L/∂{name} = {plain(slope.expr())}" if not slope.is_zero else None
            why = why or f"a force acts on it: {plain(force.expr())}"
            raise RunError(f"'{name}' is not ignorable: {why}", code="E524")
        found.append(k)
    if not found:
        raise RunError(
            "no coordinate is given",
            fix="name at least one; routhian() without arguments removes all ignorable coordinates",
            code="E524",
        )
    return sorted(set(found))


def _equation(system: LagrangianForm, r: int, polynomial: Form, pieces: Sequence[SquarePiece]) -> sp.Eq:
    """d/dt ∂R/∂ξ̇_r − ∂R/∂ξ_r = Ξ_r."""
    momentum = polynomial.diff(system.v[r])
    left = (momentum.total_derivative() - polynomial.diff(system.q[r])).expr()
    extra = summed([d for p in pieces for d in p.diff(system.v[r])])  # ∂/∂ξ̇_r of the subtracted terms
    left += summed([d for p in pieces for d in p.diff(system.q[r])])
    if extra != 0:
        left -= bounded.diff(extra, time)
    return cast("sp.Eq", sp.Eq(left, system.forces[r].expr(), evaluate=False))


def _checks(
    system: LagrangianForm,
    gone: Sequence[int],
    left: Sequence[int],
    betas: Sequence[sp.Symbol],
    R: sp.Expr,
    equations: Sequence[sp.Eq],
) -> tuple[Check, ...]:
    """Check R against L − Σ p ξ̇ with the momenta substituted, and its equations against Lagrange's for ṗ = 0."""
    put = {beta: system.momenta[k].raw() for k, beta in zip(gone, betas, strict=True)}
    wanted = system.lagrangian.raw() - sp.Add(*(put[b] * system.v[k] for k, b in zip(gone, betas, strict=True)))
    pairs: list[tuple[Any, Any]] = [(R.xreplace(put), wanted)]
    # accelerations of the eliminated coordinates for constant momenta: Σ_s M_ss ξ̈_s = −(ṗ at ξ̈_s = 0)
    accelerations = [c.acceleration for c in system.model.coordinates]
    rows = [system.momenta[k].total_derivative().raw() for k in gone]
    unknown = [accelerations[k] for k in gone]
    found = bounded.searched(lambda: sp.solve(rows, unknown, dict=True)) if len(gone) <= 2 else None
    solved = found[0] if found else None
    if solved is not None:
        for r, equation in zip(left, equations, strict=True):
            lagrange = (system.momenta[r].total_derivative() - system.slopes[r] - system.forces[r]).raw()
            routh = cast("Any", equation.lhs) - cast("Any", equation.rhs)
            pairs.append((routh.xreplace(put), lagrange.xreplace(solved)))
    worst = 0.0
    exprs = [side for a, b in pairs for side in (a, b)]
    for _, values in Sampler(system.model, exprs).states(STATES, seed=7):
        for a, b in zip(values[::2], values[1::2], strict=True):
            difference = abs(a - b) / max(1.0, abs(b))
            worst = difference if not difference <= worst else worst
    what = text("with the momenta substituted, R is L − Σ p ξ̇, and its equations are Lagrange's")
    return (Check(what, worst < TOLERANCE, f"largest relative difference {worst:.1e} at {STATES} random states"),)
