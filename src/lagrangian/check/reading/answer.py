"""What an answer says, line by line, as SymPy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import sympy as sp

from lagrangian.errors import Place

Kind: TypeAlias = Literal[
    "equation", "T", "V", "L", "D", "Xi", "p", "p-rate", "slope", "left", "definition", "identity", "statement"
]
"""What a line states:

    equation    lhs = rhs holds along every motion: an equation of motion. Where it says Ξ_i without its value, the
                placeholder ``generalized_force(name)`` stands there
    T, V, L, D  the kinetic co-energy, the potential energy, the Lagrangian, Rayleigh's dissipation function
    Xi          the generalized force Ξ of the coordinate ``name``
    p           ∂L/∂ξ̇ of the coordinate ``name``;  p-rate: d/dt ∂L/∂ξ̇;  slope: ∂L/∂ξ
    left        d/dt ∂L/∂ξ̇ − ∂L/∂ξ of the coordinate ``name``, worked out
    definition  a name of the person's own, or a coordinate of the model in new ones
    identity    lhs = rhs holds whatever the motion: the rate of a name that was defined before
    statement   a general truth that holds nothing of this system: d/dt ∂L/∂ξ̇ − ∂L/∂ξ = Ξ, before L was given
"""


@dataclass(frozen=True)
class AnswerLine:
    """One thing that is stated. ``lhs`` and ``rhs`` are both sides as written; ``lhs`` is None where the line says what
    ``kind`` (and ``name``) is. Names that the person defined are written out; the model's definitions stay named.
    ``place`` is where the line begins and ``text`` how it was written.
    """

    kind: Kind
    lhs: sp.Expr | None
    rhs: sp.Expr
    name: str | None
    place: Place
    text: str

    @property
    def residual(self) -> sp.Expr:
        """Left minus right; the right-hand side alone where there is no left one."""
        return self.rhs if self.lhs is None else self.lhs - self.rhs


@dataclass(frozen=True)
class Unknown:
    """A name the model has not: how it was written, its symbol in the lines, where it stands first, what was meant.

    The symbol is a function of time where the answer differentiates it. ``suggestion`` is a sentence or None.
    """

    name: str
    symbol: sp.Expr
    place: Place
    suggestion: str | None = None


@dataclass(frozen=True)
class Answer:
    """A whole answer in the order it was written."""

    lines: tuple[AnswerLine, ...]
    notation: Literal["text", "latex"]
    unknown: tuple[Unknown, ...] = ()

    @property
    def equations(self) -> tuple[AnswerLine, ...]:
        """The lines that state equations."""
        return tuple(line for line in self.lines if line.kind == "equation")
