"""The data of a derivation: the seven steps, their results in SymPy, and the origin of every term."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeAlias, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.derive.multiplier import Minimal, Multiplier, equality
from lagrangian.errors import ModelError, Notice, did_you_mean
from lagrangian.model import as_expr
from lagrangian.page.formula import Check, EquationTerm, Formula, Item, Text
from lagrangian.page.plain import plain
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief, cut

if TYPE_CHECKING:
    from lagrangian.derive.constraints.page import Constraints
    from lagrangian.model import Element, Model
    from lagrangian.page.report import Report
    from lagrangian.write.document import HeadPicture

LARGEST_EXPANDED = 200_000
"""The size above which an equation is not written in the coordinates alone."""


@dataclass(frozen=True)
class Step(Brief):
    """One step of the lecture: what was done and why, the results, and the checks.

    ``items`` are the words, formulas and tables in reading order; ``expressions`` are the results by name; ``reasons``
    explain each result (in step 6, each Ξ).
    """

    number: int
    title: str
    what: Text
    why: Text
    items: tuple[Item, ...]
    expressions: Mapping[str, Any] = field(default_factory=dict[str, Any])
    reasons: tuple[Text, ...] = ()
    checked: tuple[Check, ...] = ()
    view: Callable[[], str] | None = field(default=None, repr=False, compare=False)

    def __repr__(self) -> str:
        return f"<Step {self.number}: {self.title}>"

    def _repr_html_(self) -> str | None:
        """The step as shown by a notebook, if it belongs to a derivation that can be written."""
        return None if self.view is None else self.view()


@dataclass(frozen=True)
class LedgerRow(Brief):
    """The one place of an element among T*, V and Ξ, with the reason."""

    element: str
    column: str
    expression: sp.Expr | None
    reason: Text


@dataclass(frozen=True)
class Origin(Brief):
    """The origin of a term: the element, the equation (named by its coordinate), and the element's share of the
    term. ``step`` is the lecture's step that it was found in; for a constraint 4, which its rows follow.
    """

    element: Element
    coordinate: str
    share: sp.Expr
    step: int

    def __repr__(self) -> str:
        """Return one line, without the fields of the element."""
        return (
            f"Origin({self.element.title}, equation of {self.coordinate}, step {self.step}, share {plain(self.share)})"
        )


WrittenForm: TypeAlias = Literal["expanded", "structured"]
"""How equations are written: in the coordinates alone, or in named quantities that are defined once."""

QuantityKind: TypeAlias = Literal[
    "turn", "vertical", "height", "length", "velocity", "constraint", "momentum", "acceleration", "force", "shared"
]
"""What a named quantity is; in this order they are introduced."""


@dataclass(frozen=True, eq=False)
class NamedQuantity(Brief):
    """A quantity that is defined once: its ``symbol``, and its ``expression`` in the coordinates and earlier symbols.

    ``kind`` says what it is and ``of`` what it belongs to; ``inward`` marks a sum over everything that hangs on that;
    ``elements`` are the titles of the elements it comes from.
    """

    symbol: sp.Symbol
    expression: sp.Expr
    kind: QuantityKind
    of: str = ""
    inward: bool = False
    elements: tuple[str, ...] = ()


class MatrixForm(Protocol):
    """M ξ̈ + C ξ̇ + G = Ξ: see `Derived`."""

    @property
    def M(self) -> sp.ImmutableMatrix:
        """The mass matrix."""
        ...

    @property
    def C(self) -> sp.ImmutableMatrix:
        """The matrix of Christoffel symbols and rates."""
        ...

    @property
    def G(self) -> sp.ImmutableMatrix:
        """The rest of the left-hand sides."""
        ...

    @property
    def Xi(self) -> sp.ImmutableMatrix:
        """The generalized forces."""
        ...


@dataclass(frozen=True, eq=False)
class Derived(Brief):
    """The equations of motion of a model, and how they were derived.

    ``steps[0]`` to ``steps[6]`` are those of the lecture. ``equations[i]`` is ``Eq(left-hand side, Ξ_i)`` for
    coordinate i. M ξ̈ + C ξ̇ + G = Ξ holds with ``mass_matrix`` (n×n), ``coriolis_matrix`` (n×n, from Christoffel
    symbols, so that Ṁ − 2C is skew-symmetric), ``gravity_vector`` (n×1: ∂V/∂ξ, and terms from explicit time) and
    ``generalized_forces`` (n×1). ``result`` is the closing section; ``ledger`` lists every element once; ``verified``
    contains the checks at the end. ``notes`` say what could not be shortened and why; ``notices`` are those of the
    system.
    ``constraints`` is what step 0 says of the constraints, None for a system without any.

    ``form`` is "expanded" or "structured". Structured equations, and T, V, L and Ξ with them, are written in named
    quantities, the ``definitions``, each in the coordinates and earlier quantities; of an expanded derivation there are
    none. ``patterns`` are the names that lines which stand for several have on a page, with k for a number.
    ``constants`` are those in which parameters enter T* and the weights, none of an expanded derivation, and of a
    structured one where they are very many.

    With constraints the equations are ``Eq(left-hand side, Ξ_i + Σ λ ∂c/∂ξ̇_i)``, and M ξ̈ + C ξ̇ + G = Ξ + Aᵀ λ.
    ``multipliers`` has a `Multiplier` for every row, by the row's name; ``constraint_equations`` are the conditions of
    the rows on the accelerations; ``constraint_step`` shows how they were found. ``minimal`` are the same equations
    without multipliers, None where there are none that hold everywhere; ``no_minimal`` then says why.
    """

    model: Model
    steps: tuple[Step, ...]
    T: sp.Expr
    V: sp.Expr
    L: sp.Expr
    Xi: Mapping[sp.Expr, sp.Expr]
    equations: tuple[sp.Eq, ...]
    terms: tuple[tuple[EquationTerm, ...], ...]
    matrices: MatrixForm = field(repr=False)
    result: tuple[Item, ...]
    ledger: tuple[LedgerRow, ...]
    shares: Any = field(repr=False)
    multipliers: Mapping[str, Multiplier] = field(default_factory=dict[str, "Multiplier"])
    minimal: Minimal | None = None
    no_minimal: Text | None = None
    constraint_step: Step | None = None
    verified: tuple[Check, ...] = ()
    notes: tuple[Text, ...] = ()
    notices: tuple[Notice, ...] = ()
    constraints: Constraints | None = None
    form: WrittenForm = "expanded"
    definitions: tuple[NamedQuantity, ...] = ()
    patterns: tuple[NamedQuantity, ...] = field(default=(), repr=False)
    constants: tuple[sp.Expr, ...] = ()

    @property
    def mass_matrix(self) -> sp.ImmutableMatrix:
        """M, n×n."""
        return self.matrices.M

    @property
    def coriolis_matrix(self) -> sp.ImmutableMatrix:
        """C, n×n, from Christoffel symbols, so that Ṁ − 2C is skew-symmetric."""
        return self.matrices.C

    @property
    def gravity_vector(self) -> sp.ImmutableMatrix:
        """G, n×1: ∂V/∂ξ, and terms from explicit time."""
        return self.matrices.G

    @property
    def generalized_forces(self) -> sp.ImmutableMatrix:
        """Ξ, n×1."""
        return self.matrices.Xi

    @property
    def cse(self) -> tuple[list[tuple[sp.Symbol, sp.Expr]], list[sp.Eq]]:
        """The definitions and the equations in the form of ``sympy.cse``: (replacements, reduced expressions)."""
        return [(d.symbol, d.expression) for d in self.definitions], list(self.equations)

    def expanded(self, index: int) -> sp.Eq:
        """Return equation ``index`` in the coordinates alone, with every definition put in, but not multiplied out.

        Raises `ModelError` if there is no such equation, and if it would be too long.
        """
        if isinstance(index, bool) or not 0 <= index < len(self.equations):
            most = len(self.equations) - 1
            raise ModelError(f"there is no equation {index}", fix=f"a number from 0 to {most}", code="E406")
        meanings: dict[sp.Basic, sp.Expr] = {}
        sizes: dict[sp.Basic, int] = {}
        wanted = self.equations[index]
        for d in self.definitions:
            sizes[d.symbol] = bounded.size(d.expression, sizes)
        long = max(bounded.size(side, sizes) for side in (wanted.lhs, wanted.rhs))
        if long > LARGEST_EXPANDED:
            raise ModelError(
                f"equation {index} in the coordinates alone has {long} operands and operations",
                fix="use its definitions, with cse for SymPy's printers and lambdify, or compile()",
                code="E601",
            )
        for d in self.definitions:
            if sizes[d.symbol] <= long:
                meanings[d.symbol] = cast("sp.Expr", bounded.replaced(d.expression, meanings))
        return cast("sp.Eq", bounded.replaced(wanted, meanings))

    @property
    def picture(self) -> HeadPicture | None:
        """The picture at the head of a page; a derivation without the room that draws has none."""
        return None

    @property
    def reasoning(self) -> Report[Model] | None:
        """The page on why the equations hold, for links to it; None without the room that makes it."""
        return None

    @property
    def coordinates(self) -> tuple[sp.Expr, ...]:
        """The generalized coordinates, in declared order."""
        return tuple(c.symbol for c in self.model.coordinates)

    @property
    def constraint_equations(self) -> tuple[sp.Eq, ...]:
        """What the rows of the constraints ask of the accelerations: A ξ̈ + γ = 0, row by row."""
        return tuple(equality(row.second_rate, sp.S.Zero) for row in self.multipliers.values())

    def __repr__(self) -> str:
        """Summarize the derivation; ``print`` shows all of it."""
        names = ", ".join(c.name for c in self.model.coordinates)
        n, failed = len(self.model.coordinates), sum(check.holds is False for check in self.verified)
        return cut(
            f"<Derivation of {self.model.name!r}: {n} coordinate{'s' if n != 1 else ''} {names}; {len(self.steps)} "
            f"steps; {len(self.verified) - failed} of {len(self.verified)} checks hold; print() shows it>"
        )

    def formulas(self) -> tuple[Formula, ...]:
        """All formulas of the steps and of the result, in reading order."""
        steps = (*self.steps, self.constraint_step) if self.constraint_step else self.steps
        items = [item for step in steps for item in step.items] + list(self.result)
        return tuple(item for item in items if isinstance(item, Formula))

    def where(self, term: sp.Expr) -> tuple[Origin, ...]:
        """Return the elements from which a term came, with the equation, the step and the share of each.

        Raises `ModelError` for a term that does not occur in any equation, and for text.
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
