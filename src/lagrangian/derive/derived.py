"""The data of a derivation: seven steps as data, their results as SymPy, and where every term came from."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.errors import ModelError, Notice, did_you_mean
from lagrangian.model import as_expr
from lagrangian.page.formula import Check, EquationTerm, Formula, Item, Text
from lagrangian.page.plain import plain
from lagrangian.viewed import Brief, cut

if TYPE_CHECKING:
    from lagrangian.model import Element, Model


@dataclass(frozen=True)
class Step(Brief):
    """One step of the lecture: what was done, why, what came out, what was checked.

    ``items`` are the words, formulas and tables in reading order; ``expressions`` the results by name; ``reasons`` why
    each result is what it is (in step 6: why each Ξ is what it is).
    """

    number: int
    title: str
    what: Text
    why: Text
    items: tuple[Item, ...]
    expressions: Mapping[str, Any] = field(default_factory=dict)
    reasons: tuple[Text, ...] = ()
    checked: tuple[Check, ...] = ()
    view: Callable[[], str] | None = field(default=None, repr=False, compare=False)

    def __repr__(self) -> str:
        return f"<Step {self.number}: {self.title}>"

    def _repr_html_(self) -> str | None:
        """The step as a notebook shows it, where it belongs to a derivation that can be written."""
        return None if self.view is None else self.view()


@dataclass(frozen=True)
class LedgerRow(Brief):
    """An element's one place among T*, V and Ξ, with the reason."""

    element: str
    column: str
    expression: sp.Expr | None
    reason: Text


@dataclass(frozen=True)
class Origin(Brief):
    """Where a term came from: the element, the equation it stands in (a coordinate's name), its share of the term."""

    element: Element
    coordinate: str
    share: sp.Expr
    step: int

    def __repr__(self) -> str:
        """Read in one line, without the element's own fields."""
        return (
            f"Origin({self.element.title}, equation of {self.coordinate}, step {self.step}, share {plain(self.share)})"
        )


@dataclass(frozen=True, eq=False)
class Derived(Brief):
    """The equations of motion of a model, and how they were found.

    ``steps[0]`` to ``steps[6]`` are the lecture's. ``equations[i]`` is ``Eq(left-hand side, Ξ_i)`` of coordinate i.
    M ξ̈ + C ξ̇ + G = Ξ holds with ``mass_matrix`` (n×n), ``coriolis_matrix`` (n×n, by Christoffel symbols, so that
    Ṁ − 2C is skew), ``gravity_vector`` (n×1: ∂V/∂ξ, and what explicit time adds) and ``generalized_forces`` (n×1).
    ``result`` is the closing section, ``ledger`` books every element once, ``verified`` holds what was checked at the
    end. ``notes`` say where something could not be made short and why, ``notices`` what is to be known of the system.
    """

    model: Model
    steps: tuple[Step, ...]
    T: sp.Expr
    V: sp.Expr
    L: sp.Expr
    Xi: Mapping[sp.Expr, sp.Expr]
    equations: tuple[sp.Eq, ...]
    terms: tuple[tuple[EquationTerm, ...], ...]
    mass_matrix: sp.ImmutableMatrix
    coriolis_matrix: sp.ImmutableMatrix
    gravity_vector: sp.ImmutableMatrix
    generalized_forces: sp.ImmutableMatrix
    result: tuple[Item, ...]
    ledger: tuple[LedgerRow, ...]
    shares: Any = field(repr=False)
    verified: tuple[Check, ...] = ()
    notes: tuple[Text, ...] = ()
    notices: tuple[Notice, ...] = ()

    @property
    def coordinates(self) -> tuple[sp.Expr, ...]:
        """The generalized coordinates, in declared order."""
        return tuple(c.symbol for c in self.model.coordinates)

    def __repr__(self) -> str:
        """Say of what it is; ``print`` shows it all."""
        names = ", ".join(c.name for c in self.model.coordinates)
        n, failed = len(self.model.coordinates), sum(check.holds is False for check in self.verified)
        return cut(
            f"<Derivation of {self.model.name!r}: {n} coordinate{'s' if n != 1 else ''} {names}; {len(self.steps)} "
            f"steps; {len(self.verified) - failed} of {len(self.verified)} checks hold; print() shows it>"
        )

    def formulas(self) -> tuple[Formula, ...]:
        """Every formula of every step and of the result, in reading order."""
        items = [item for step in self.steps for item in step.items] + list(self.result)
        return tuple(item for item in items if isinstance(item, Formula))

    def where(self, term: sp.Expr) -> tuple[Origin, ...]:
        """Return the elements a term came from, with the equation, the step and each one's share of it.

        Raises `ModelError` for a term that stands in no equation, and for text.
        """
        wanted = as_expr(term, "the term")
        if found := self.shares.where(wanted):
            return found
        known = [*self.model.symbols, "t"]
        atoms = {*wanted.free_symbols, *wanted.atoms(AppliedUndef)}
        names = sorted({str(getattr(a, "name", a.func)) for a in atoms} - set(known))
        listed = ", ".join(plain(t.expr) for row in self.terms for t in row)
        raise ModelError(
            f"no equation of motion holds the term {plain(wanted)}"
            + (f": nothing is named '{names[0]}'" if names else ""),
            fix=(did_you_mean(names[0], known) if names else None)
            or f"terms: {listed if len(listed) <= 300 else listed[:300] + ' …'}",
            code="E402",
        )
