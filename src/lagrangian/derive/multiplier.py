"""What a derivation says of constraints: the multiplier of every row, and the equations that hold none."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import cast

import sympy as sp

from lagrangian.model import Element
from lagrangian.page.formula import EquationTerm, Text
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief


@dataclass(frozen=True, eq=False)
class Multiplier(Brief):
    """The multiplier λ of one row f(q, t) = 0 or c(q, q̇, t) = 0, and the row itself.

    λ > 0 acts so as to increase f (or c): it adds λ ∂c/∂ξ̇_i to the right-hand side of equation i. ``name`` is the
    row's, such as "loop.x"; ``symbol`` is λ, a function of time; ``unit`` is "N" for a force, "N m" for a torque, ""
    where the expression that was given decides; ``words`` say what λ is. ``position`` is f, None for a row on
    velocities alone; ``rate`` is c (c = ḟ); ``second_rate`` is ċ = A ξ̈ + γ, which is zero along every motion.
    """

    name: str
    symbol: sp.Expr
    unit: str
    words: Text
    element: Element
    position: sp.Expr | None
    rate: sp.Expr
    second_rate: sp.Expr


@dataclass(frozen=True)
class SpeedLine(Brief):
    """One line of an elimination: a row or a new speed, what it says of a rate, and why it may be used.

    ``rate`` = ``value``. ``fails`` is what is divided by where that can vanish, else None.
    """

    rate: sp.Expr
    value: sp.Expr
    reason: Text
    fails: sp.Expr | None = None


@dataclass(frozen=True, eq=False)
class Minimal(Brief):
    """Equations of motion without multipliers, in fewer speeds u: ξ̇ = S u + s₀.

    Every motion that the constraints allow has this form, and Sᵀ (d/dt ∂L/∂ξ̇ − ∂L/∂ξ − Ξ) = 0 with it. ``speeds`` are
    the u: rates that stay free, then new ones with their ``meanings`` in the rates. ``S`` is n×k, ``s0`` n×1; ``rates``
    holds every ξ̇ in the speeds, ``lines`` how it was found. ``equations`` and ``terms`` are as in a derivation, an
    equation a speed; ``sides`` are the terms left and right in order.
    """

    speeds: tuple[sp.Expr, ...]
    meanings: Mapping[sp.Expr, sp.Expr]
    S: sp.ImmutableMatrix
    s0: sp.ImmutableMatrix
    rates: Mapping[sp.Expr, sp.Expr]
    lines: tuple[SpeedLine, ...]
    equations: tuple[sp.Eq, ...]
    terms: tuple[tuple[EquationTerm, ...], ...]
    sides: tuple[tuple[tuple[sp.Expr, ...], tuple[sp.Expr, ...]], ...] = field(repr=False)
    solver: Callable[[], Mapping[sp.Expr, sp.Expr]] = field(repr=False)

    def accelerations(self) -> Mapping[sp.Expr, sp.Expr]:
        """Return the equations solved for the rates of the speeds, by Cramer's rule: u̇ → expression.

        Raises `OutOfReach` where the determinants are too long to write out.
        """
        return self.solver()


def equality(left: sp.Expr, right: sp.Expr) -> sp.Eq:
    """left = right, as it is written."""
    return cast("sp.Eq", sp.Eq(left, right, evaluate=False))
