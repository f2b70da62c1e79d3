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


def is_placeholder(symbol: sp.Basic) -> bool:
    """Whether a symbol stands for an energy or a Ξ that was not given."""
    return isinstance(symbol, AppliedUndef) and symbol.func.__name__.startswith("\u27e8")
