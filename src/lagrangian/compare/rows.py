"""The data of a comparison."""

from __future__ import annotations

from typing import Literal

import sympy as sp

from lagrangian.derive import Derived
from lagrangian.page.formula import Check, Text
from lagrangian.records import dataclass
from lagrangian.viewed import Brief


@dataclass(frozen=True, eq=False)
class ComparedSystem(Brief):
    """One of the two systems: its tag "A" or "B", its derivation, and the letter of its rows (a absolute, r
    relative)."""

    tag: Literal["A", "B"]
    derivation: Derived
    letter: str

    def label(self, index: int) -> str:
        """The label of an equation of motion, 1a or 2r."""
        return f"{index + 1}{self.letter}"


@dataclass(frozen=True)
class EquationRow(Brief):
    """An equation of one set as a sum of rows of the other: ``label`` = Σ factors · ``of``.

    ``rest`` is the remainder, ``label`` − Σ factors · ``of``, which is 0 if the row holds.
    """

    label: str
    factors: tuple[sp.Expr, ...]
    of: tuple[str, ...]
    words: Text
    check: Check
    rest: sp.Expr

    @property
    def holds(self) -> bool:
        """Whether the remainder is 0."""
        return self.check.holds is True


@dataclass(frozen=True)
class Rewritten(Brief):
    """An equation of the first set in the coordinates of the other, B-1, with its terms on the left and right."""

    label: str
    source: str
    left: tuple[sp.Expr, ...]
    right: tuple[sp.Expr, ...]


@dataclass(frozen=True)
class Difference(Brief):
    """A difference: the step, the quantity ("T*", "V", "Xi"), and the contributions of both systems with their
    elements.

    ``coordinate`` is the one whose Ξ it is. ``a`` and ``b`` are the contributions in the shared coordinates, ``term``
    is the first term of a − b. An element that one system does not have is None.
    """

    step: int
    quantity: Literal["T*", "V", "Xi"]
    coordinate: str | None
    a: sp.Expr
    b: sp.Expr
    term: sp.Expr
    element_a: str | None
    element_b: str | None


@dataclass(frozen=True)
class ParameterDifference(Brief):
    """A parameter whose values differ, or that one system does not have (``missing``: "A" or "B")."""

    name: str
    a: float | None
    b: float | None
    missing: str = ""
