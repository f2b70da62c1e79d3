"""Hamilton's form: momenta, H(q, p, t) and the canonical equations, as a textbook writes them.

    p = ∂L/∂ξ̇ = M ξ̇ + b,    H = Σ ξ̇_i p_i − L = ½ (p − b)ᵀ M⁻¹ (p − b) + V − T₀
    ξ̇_i = ∂H/∂p_i,            ṗ_i = −∂H/∂ξ_i + Ξ_i

Source: Goldstein, Classical Mechanics (3rd ed.), § 8.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.bounded import TooLarge
from lagrangian.derive.algebra import Form
from lagrangian.derive.sample import Sampler
from lagrangian.errors import RunError
from lagrangian.invariants.canonical_forms import Hamiltonian
from lagrangian.invariants.lagrangian_form import LagrangianForm
from lagrangian.invariants.squares import SquarePiece, half_square, summed
from lagrangian.model import Model, is_hard
from lagrangian.model.names import moving_symbol
from lagrangian.page.formula import Check, text

STATES = 20
"""The number of random states at which the canonical equations are compared with Lagrange's."""

TOLERANCE = 1e-9


@bounded.answered("Hamilton's form", is_hard)
def hamiltonian(model: Model) -> Hamiltonian:
    """Return Hamilton's form of a model. Raises `RunError` if the inverse of M is too long to write out."""
    system = LagrangianForm.of(model).without_rows("Hamilton's form")
    letters = [sp.Symbol(name) for name in momentum_names(model)]
    moving = [cast("sp.Expr", moving_symbol(s.name)) for s in letters]
    to_moving = dict(zip(letters, moving, strict=True))
    try:
        pieces, potential = _pieces(system, letters)
        H = summed(pieces) + potential.expr()
        rates = [summed([d for p in pieces for d in p.diff(s)]) for s in letters]
        slopes = [summed([d for p in pieces for d in p.diff(q)]) + potential.diff(q).expr() for q in system.q]
        bounded.check_size(max(bounded.size(x) for x in (H, *rates, *slopes)), "one of its expressions")
    except TooLarge as trouble:
        raise RunError(
            f"H is too long to write out: {trouble.what}",
            fix="describe the system by points and frames instead of long expressions, or in other coordinates",
            code="E523",
        ) from trouble
    in_momenta = dict(zip(system.v, rates, strict=True))
    forces = [cast("sp.Expr", f.expr().xreplace(in_momenta)) for f in system.forces]
    pushes = [f - s for f, s in zip(forces, slopes, strict=True)]
    checks = _checks(system, letters, H, rates, pushes)
    time_symbol = sp.Symbol("t")
    kept = system.power.is_zero
    steady = tuple(u.name for u in system.moved_by(system.energy)) if kept else ()
    equations: dict[sp.Expr, sp.Expr] = {}
    for v, rate in zip(system.v, rates, strict=True):
        equations[v] = cast("sp.Expr", rate.xreplace(to_moving))
    for p, push in zip(moving, pushes, strict=True):
        equations[cast("sp.Expr", sp.Derivative(p, time_symbol))] = cast("sp.Expr", push.xreplace(to_moving))
    return Hamiltonian(
        model=model,
        H=cast("sp.Expr", H.xreplace(to_moving)),
        momenta=dict(zip(system.q, moving, strict=True)),
        definitions={p: form.expr() for p, form in zip(moving, system.momenta, strict=True)},
        equations=equations,
        is_total=system.is_total,
        is_constant=kept and not steady,
        checks=checks,
        while_constant=steady,
    )


def momentum_names(model: Model) -> list[str]:
    """``p_theta`` for every coordinate, with a different first letter if the model already has such a name."""
    taken = set(model.symbols)
    found = []
    for c in model.coordinates:
        name = f"p_{c.name}"
        while name in taken:
            name = f"p{name}"
        taken.add(name)
        found.append(name)
    return found


def split(system: LagrangianForm) -> tuple[list[Form], Form]:
    """b_i = ∂L/∂ξ̇_i at rest and V − T₀, for L = T₂ + T₁ + T₀ − V. Raises `RunError` if T* is not quadratic."""
    if any(entry.diff(v).parts for row in system.mass for entry in row for v in system.v):
        raise RunError(
            "T* is not quadratic in the rates: the momenta cannot be solved for them",
            fix="the kinetic co-energy must be ½ ξ̇ᵀ M ξ̇ + bᵀ ξ̇ + T₀",
            code="E523",
        )
    still = dict.fromkeys(system.v, sp.S.Zero)
    b = [system.at(p, still) for p in system.momenta]
    return b, -system.at(system.lagrangian, still)


def _pieces(system: LagrangianForm, letters: Sequence[sp.Symbol]) -> tuple[list[SquarePiece], Form]:
    """½ (p − b)ᵀ M⁻¹ (p − b) in pieces, and V − T₀."""
    b, potential = split(system)
    w = [system.algebra.form(s) - x for s, x in zip(letters, b, strict=True)]
    return half_square(system.mass, w, system.algebra), potential


def _checks(
    system: LagrangianForm,
    letters: Sequence[sp.Symbol],
    H: sp.Expr,
    rates: Sequence[sp.Expr],
    pushes: Sequence[sp.Expr],
) -> tuple[Check, ...]:
    """Compare H, ξ̇ and ṗ, with the momenta substituted, to Σ ξ̇ p − L, the rates and ∂L/∂ξ + Ξ, at random states."""
    put = {s: p.raw() for s, p in zip(letters, system.momenta, strict=True)}
    pairs: list[tuple[Any, Any]] = [(H, system.energy.raw())]
    pairs += list(zip(rates, system.v, strict=True))
    pairs += list(zip(pushes, (f.raw() for f in system.pushes), strict=True))
    exprs = [side for left, right in pairs for side in (left.xreplace(put), right)]
    worst = 0.0
    for _, values in Sampler(system.model, exprs).states(STATES, seed=7):
        for left, right in zip(values[::2], values[1::2], strict=True):
            difference = abs(left - right) / max(1.0, abs(right))
            worst = difference if not difference <= worst else worst
    what = text("with the momenta substituted, H is Σ ξ̇ p − L, ξ̇ are the rates, and ṗ is ∂L/∂ξ + Ξ")
    return (Check(what, worst < TOLERANCE, f"largest relative difference {worst:.1e} at {STATES} random states"),)
