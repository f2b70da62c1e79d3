"""All forces on a coordinate, those with a potential among them."""

from __future__ import annotations

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.model import Gravity


def whole_force(truth: Reference, i: int) -> sp.Expr:
    """Ξ_i − ∂V/∂ξ_i: all forces on a coordinate."""
    return truth.Xi[i] - bounded.diff(truth.V, truth.model.coordinates[i].symbol)


def letters_of_gravity(truth: Reference) -> set[sp.Basic]:
    """The letters of the accelerations of gravity, as they are given and written out."""
    given = [sp.sympify(e.g) for e in truth.model.elements if isinstance(e, Gravity)]
    return set[sp.Basic]().union(*(bounded.letters(x) for g in given for x in (g, truth.expand(g))))


def holds_potential(truth: Reference, i: int, force: sp.Expr) -> bool:
    """Whether a force on a coordinate has letters that only those with a potential have there: g or k, no length."""
    storing = bounded.letters(whole_force(truth, i) - truth.Xi[i]) - bounded.letters(truth.Xi[i] + truth.T)
    return bool(storing & {p.symbol for p in truth.model.parameters} & bounded.letters(force))
