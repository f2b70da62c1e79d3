"""Symbols for what an answer names before it says what it is: T*, V, L, D and the Ξ in ``L = T* - V``."""

from __future__ import annotations

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.model.names import moving_symbol

ENERGIES: dict[str, AppliedUndef] = {kind: moving_symbol(f"\u27e8{kind}\u27e9") for kind in ("T", "V", "L", "D")}
"""The placeholder of each energy, a function of time; no name that a person can write is one."""


def generalized_force(coordinate: str) -> AppliedUndef:
    """Return the placeholder of Ξ of a coordinate."""
    return moving_symbol(f"\u27e8Xi {coordinate}\u27e9")


def variation(name: str) -> AppliedUndef:
    """Return the placeholder of a virtual displacement or virtual work: δθ, δW."""
    return moving_symbol(f"\u27e8delta {name}\u27e9")


def vector(name: str) -> AppliedUndef:
    """Return the placeholder of a matrix or column that was not given: M, q."""
    return moving_symbol(f"\u27e8vector {name}\u27e9")


def is_vector(value: object) -> bool:
    """Whether a value holds the placeholder of a matrix."""
    return isinstance(value, sp.Expr) and any(
        x.func.__name__.startswith("\u27e8vector ") for x in value.atoms(AppliedUndef)
    )


def is_force(symbol: sp.Basic) -> bool:
    """Whether a symbol stands for a Ξ that was not given."""
    return isinstance(symbol, AppliedUndef) and symbol.func.__name__.startswith("\u27e8Xi ")


def is_placeholder(symbol: sp.Basic) -> bool:
    """Whether a symbol stands for an energy, a Ξ, a variation or a matrix."""
    return isinstance(symbol, AppliedUndef) and symbol.func.__name__.startswith("\u27e8")
