"""Symbols for quantities that an answer uses before it gives their value: T*, V, L, D and the Ξ in ``L = T* - V``."""

from __future__ import annotations

import re

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.model import Model
from lagrangian.model.names import moving_symbol

ENERGIES: dict[str, AppliedUndef] = {kind: moving_symbol(f"\u27e8{kind}\u27e9") for kind in ("T", "V", "L", "D")}
"""The placeholder of each energy, a function of time, with a name that nobody can type."""


_VARIED = re.compile("\u27e8delta (.{1,40})\u27e9")


def generalized_force(coordinate: str) -> AppliedUndef:
    """Return the placeholder for the Ξ of a coordinate."""
    return moving_symbol(f"\u27e8Xi {coordinate}\u27e9")


def variation(name: str) -> AppliedUndef:
    """Return the placeholder for a virtual displacement or virtual work: δθ, δW."""
    return moving_symbol(f"\u27e8delta {name}\u27e9")


def displacements(expr: sp.Expr) -> dict[AppliedUndef, str]:
    """The virtual displacements and works in an expression, with their names."""
    found = {x: _VARIED.fullmatch(x.func.__name__) for x in expr.atoms(AppliedUndef)}
    return {x: m[1] for x, m in found.items() if m is not None}


def called(symbol: sp.Basic) -> str:
    """The letters of a symbol, which may be a function of time."""
    return str(symbol.func) if isinstance(symbol, AppliedUndef) else str(symbol)


def vector(name: str) -> AppliedUndef:
    """Return the placeholder for a matrix or column that was not given: M, q."""
    return moving_symbol(f"\u27e8vector {name}\u27e9")


def slope(what: str, by: object) -> AppliedUndef:
    """Return the placeholder for the derivative of a quantity without a value by a name: ∂A/∂θ."""
    return moving_symbol(f"\u27e8slope {what} {by}\u27e9")


def slope_of_L(name: str, model: Model) -> AppliedUndef:
    """Return the placeholder for ∂L/∂ξ of a coordinate of the system or of the answer, by its name."""
    by = next((c.symbol for c in model.coordinates if c.name == name), name)
    return slope(str(ENERGIES["L"]), (by,))


def is_vector(value: object) -> bool:
    """Whether an expression contains the placeholder of a matrix."""
    return isinstance(value, sp.Expr) and any(
        x.func.__name__.startswith("\u27e8vector ") for x in bounded.atoms(value, AppliedUndef)
    )


def is_force(symbol: sp.Basic) -> bool:
    """Whether a symbol is the placeholder of a Ξ that was not given."""
    return isinstance(symbol, AppliedUndef) and symbol.func.__name__.startswith("\u27e8Xi ")


def is_placeholder(symbol: sp.Basic) -> bool:
    """Whether a symbol is the placeholder of an energy, a Ξ, a variation, a matrix or a derivative."""
    return isinstance(symbol, AppliedUndef) and symbol.func.__name__.startswith("\u27e8")


def is_slope(symbol: sp.Basic) -> bool:
    """Whether a symbol is the placeholder of the derivative of a quantity without a value."""
    return isinstance(symbol, AppliedUndef) and symbol.func.__name__.startswith("\u27e8slope ")


def multiple_of_energy(side: sp.Expr) -> tuple[str, sp.Expr] | None:
    """Which energy a side is, and how often: 2 T; None for any other."""
    functions = bounded.atoms(side, AppliedUndef)
    held = [(kind, side / energy) for kind, energy in ENERGIES.items() if energy in functions]
    return held[0] if len(held) == 1 and held[0][1].is_number else None
