"""The parts of a step of a derivation: words with symbols in them, formulas, tables.

They are data without markup. `write` lays them out; ``str()`` returns plain text. A quantity is named by its meaning
("T*", "Xi"), and the writer chooses the letter in the requested notation (T*, T or K; Ξ, Q or τ).
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from typing import Literal, TypeAlias

import sympy as sp

from lagrangian.page.plain import plain
from lagrangian.records import dataclass
from lagrangian.viewed import Brief, Worded, cut


@dataclass(frozen=True)
class Name(Worded):
    """A named quantity: ``base`` is its meaning, ``index`` its subscript, ``dots`` the number of time derivatives.

    Bases: "T*" kinetic co-energy, "V" potential energy, "L" Lagrangian, "D" Rayleigh's function, "Xi" generalized
    force, "xi" generalized coordinate, "delta" deflection, "h" height, "v" speed or voltage, "omega" angular velocity,
    "current", "psi" flux linkage and "stored" energy T of a coil, "x", "y", "z" positions, "phi" an angle, "W" virtual
    work, "F" force, "lambda" multiplier, "f" and "c" what a constraint keeps at zero, "M" mass matrix, "C" Coriolis
    matrix, "G" gravity and stiffness vector, "q" the vector of coordinates, "E" energy, "H" Hamiltonian, "R" Routhian
    or constraint force, "r" a position, "moment" of constraint forces, "pull" and "push" of a rod and a track, "sum"
    the sign of a sum, "pi" the motion that a quasi-velocity makes; matrices "A", "A transposed", "B", "D matrix", "J",
    "K", "S"; vectors "x vector", "u vector", "y vector", "q vector", "f vector", "gamma vector", "lambda vector". Any
    other base is shown as it is.
    """

    base: str
    index: str = ""
    dots: int = 0

    def __str__(self) -> str:
        """Return plain text."""
        return self.base + (f"_{self.index}" if self.index else "") + "'" * self.dots


@dataclass(frozen=True)
class Partial(Worded):
    """The partial derivative ∂of/∂by."""

    of: Left
    by: Left

    def __str__(self) -> str:
        """Return plain text."""
        return f"∂{show(self.of)}/∂{show(self.by)}"


@dataclass(frozen=True)
class Total(Worded):
    """The total time derivative d/dt of something."""

    of: Left

    def __str__(self) -> str:
        """Return plain text."""
        return f"d/dt({show(self.of)})"


@dataclass(frozen=True)
class Variation(Worded):
    """δ of something: a virtual displacement or virtual work."""

    of: Left

    def __str__(self) -> str:
        """Return plain text."""
        return f"δ{show(self.of)}"


@dataclass(frozen=True)
class Terms(Worded):
    """A sum whose terms keep the given order; an empty sum is 0."""

    terms: tuple[Left, ...]

    def __str__(self) -> str:
        """Return plain text."""
        text = " + ".join(show(t) for t in self.terms) or "0"
        return text.replace("+ -", "- ")


@dataclass(frozen=True)
class Minus(Worded):
    """The negative, −of."""

    of: Left

    def __str__(self) -> str:
        """Return plain text."""
        return f"-{show(self.of)}"


@dataclass(frozen=True)
class Product(Worded):
    """Factors side by side in the given order; sums among them are in parentheses."""

    factors: tuple[Left, ...]

    def __str__(self) -> str:
        """Return plain text."""
        return "·".join(f"({show(f)})" if isinstance(f, (Terms, sp.Add)) else show(f) for f in self.factors)


@dataclass(frozen=True)
class Square(Worded):
    """coefficient · (a² + b² + …), each square written as a square: ½ m (ẋ² + ẏ²), ½ k (x₁ − x₂)²."""

    coefficient: sp.Expr
    of: tuple[Left, ...]

    def __str__(self) -> str:
        """Return plain text."""
        inner = " + ".join(f"({show(a)})^2" for a in self.of)
        return f"{plain(self.coefficient)}*({inner})" if len(self.of) > 1 else f"{plain(self.coefficient)}*{inner}"


@dataclass(frozen=True)
class Matrix(Worded):
    """A matrix or column of expressions, row by row; of a symmetric matrix the writer shows the upper half."""

    rows: tuple[tuple[Left, ...], ...]
    symmetric: bool = False

    def __str__(self) -> str:
        """Return plain text."""
        return "[" + "; ".join(", ".join(show(x) for x in row) for row in self.rows) + "]"


Left: TypeAlias = "Name | Partial | Total | Variation | Terms | Minus | Product | Square | Matrix | Elided | sp.Expr"
"""Anything that can be a side of an equality."""


@dataclass(frozen=True)
class Elided(Worded):
    """An expression or matrix that is too long to read: its number of operations, and the whole for those who want
    it."""

    expr: sp.Expr | Matrix
    operations: int
    terms: tuple[sp.Expr, ...] = ()

    def __str__(self) -> str:
        """Return plain text."""
        return f"[{self.operations} operations]"


def show(item: Left | Verbatim | str) -> str:
    """Return plain text for any part of a formula or a text."""
    return plain(item) if isinstance(item, sp.Basic) else str(item)


@dataclass(frozen=True)
class Formula(Worded):
    """A chain of equalities a = b = c. ``brief`` puts it on the one-page checklist; ``boxed`` marks a result."""

    sides: tuple[Left, ...]
    note: Text | None = None
    brief: bool = False
    boxed: bool = False

    def __str__(self) -> str:
        """Return plain text."""
        return " = ".join(show(s) for s in self.sides)


@dataclass(frozen=True)
class Verbatim(Worded):
    """Words that stay as they are, such as a unit or a user's name: no letter of the lecture is looked for in them."""

    words: str

    def __str__(self) -> str:
        """Return the words."""
        return self.words


@dataclass(frozen=True)
class Text(Worded):
    """Words and symbols, in order."""

    parts: tuple[str | Verbatim | Left, ...]
    brief: bool = False

    def __str__(self) -> str:
        """Return plain text."""
        return "".join(show(p) for p in self.parts)


@dataclass(frozen=True)
class Heading(Worded):
    """A heading inside a step."""

    text: Text

    def __str__(self) -> str:
        """Return plain text."""
        return str(self.text)


@dataclass(frozen=True)
class Table(Worded):
    """A table; a cell is a `Text`, a `Formula` or a single quantity."""

    header: tuple[Text, ...]
    rows: tuple[tuple[Text | Formula, ...], ...]
    brief: bool = False

    def __str__(self) -> str:
        """Return plain text."""
        lines = [" | ".join(str(h) for h in self.header)]
        return "\n".join(lines + [" | ".join(str(c) for c in row) for row in self.rows])


Item: TypeAlias = "Text | Formula | Heading | Table"


@dataclass(frozen=True)
class Check(Brief):
    """A check: its description, whether it holds, and its figure.

    ``holds`` is None if the check could not be made here; then the figure says why.
    """

    what: Text
    holds: bool | None
    figure: str = ""

    def __repr__(self) -> str:
        """Return ``<Check: the equations agree with …: holds, largest relative difference 5e-16 …>``."""
        if self.holds is None:
            why = self.figure.removeprefix("not checked").removeprefix(": ")
            return cut(f"<Check: {self.what}: not checked{': ' if why else ''}{why}>")
        verdict = "holds" if self.holds else "DOES NOT HOLD"
        return cut(f"<Check: {self.what}: {verdict}{', ' if self.figure else ''}{self.figure}>")


TermKind: TypeAlias = Literal["inertia", "velocity", "damping", "stiffness", "gravity", "other", "input", "constraint"]
"""The kinds of the terms of an equation, in the order in which they are written: "inertia" with an acceleration,
"velocity" with products of rates, "constraint" with a multiplier λ."""


@dataclass(frozen=True)
class EquationTerm(Brief):
    """A readable term of an equation of motion: its kind, and the elements that contribute to it."""

    expr: sp.Expr
    kind: TermKind
    elements: tuple[str, ...]


def text(*parts: str | Verbatim | Left, brief: bool = False) -> Text:
    """Return words and symbols as a `Text`: ``text("wiggle only ", theta, ": …")``."""
    return Text(parts, brief)


def formula(*sides: Left, note: Text | None = None, brief: bool = False, boxed: bool = False) -> Formula:
    """Return the `Formula` ``sides[0] = sides[1] = …``."""
    return Formula(sides, note, brief, boxed)
