"""The equations of motion, their matrix form, the energy ledger, and the origin of every term."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Iterable
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Form
from lagrangian.derive.circuits import named_losses
from lagrangian.derive.context import READABLE, Context, fit_terms
from lagrangian.derive.derived import LedgerRow, Origin
from lagrangian.derive.forces import Contribution
from lagrangian.derive.lagrange import LeftSide
from lagrangian.derive.multipliers.rows import RowForms
from lagrangian.derive.multipliers.step import AFTER, matrix_form, second_rates
from lagrangian.model import Model
from lagrangian.page.formula import (
    Elided,
    EquationTerm,
    Heading,
    Item,
    Left,
    Matrix,
    Name,
    Product,
    Table,
    Terms,
    formula,
    text,
)
from lagrangian.records import dataclass
from lagrangian.viewed import Brief


@dataclass(frozen=True, eq=False)
class Shares(Brief):
    """The contributions to every equation, by which a term can be traced to its elements."""

    context: Context
    sides: tuple[LeftSide, ...]
    forces: tuple[Contribution, ...]
    rows: tuple[RowForms, ...] = ()

    def where(self, term: sp.Expr) -> tuple[Origin, ...]:
        """The elements that contribute to a term, equation by equation, each with its share of it."""
        keys = self.context.form(sp.sympify(term)).keys()
        found: list[Origin] = []
        for i, side in enumerate(self.sides):
            for share, part in side.parts:
                if not (common := part.restricted(keys)).is_zero:
                    found.append(
                        Origin(share.element, side.coordinate.name, common.expr(), 2 if share.column == "T*" else 3)
                    )
            for f in self.forces:
                if f.index == i and not (common := f.virtual.restricted(keys)).is_zero:
                    found.append(Origin(f.element, side.coordinate.name, common.expr(), 6))
            for row in self.rows:
                if not (common := row.pushes[i].restricted(keys)).is_zero:
                    found.append(Origin(row.row.element, side.coordinate.name, common.expr(), AFTER))
        return tuple(found)

    def names(self, index: int, term: sp.Expr) -> tuple[str, ...]:
        """The titles of the elements behind a term of equation ``index``."""
        keys = self.context.form(term).keys()
        titles = [s.element.title for s, part in self.sides[index].parts if not part.restricted(keys).is_zero]
        titles += [f.element.title for f in self.forces if f.index == index and not f.virtual.restricted(keys).is_zero]
        return tuple(dict.fromkeys(titles))


@dataclass(frozen=True, eq=False)
class Equations:
    """The readable equations: damping on the left, the other Ξ on the right, as the lecture combines steps 5 and 6."""

    left: tuple[tuple[sp.Expr, ...], ...]
    right: tuple[tuple[sp.Expr, ...], ...]
    terms: tuple[tuple[EquationTerm, ...], ...]
    equalities: tuple[sp.Eq, ...]


def equations(
    context: Context, sides: tuple[LeftSide, ...], found: tuple[Contribution, ...], rows: tuple[RowForms, ...] = ()
) -> Equations:
    """Combine steps 5 and 6; what the rows of constraints add comes last on the right."""
    shares = Shares(context, sides, found)
    lefts: list[tuple[sp.Expr, ...]] = []
    rights: list[tuple[sp.Expr, ...]] = []
    described: list[tuple[EquationTerm, ...]] = []
    equalities: list[sp.Eq] = []
    for i, side in enumerate(sides):
        mine = [f for f in found if f.index == i]
        damping = context.algebra.total([f.virtual for f in mine if f.resists])
        driving = context.algebra.total([f.virtual for f in mine if not f.resists])
        left = context.terms(side.whole if damping.is_zero else side.whole - damping)
        right = context.terms(driving)
        pushes = [(row, row.pushes[i].expr()) for row in rows if not row.pushes[i].is_zero]
        lefts.append(tuple(t.expr for t in left))
        rights.append((*(t.expr for t in right), *(push for _, push in pushes)))
        described.append(
            tuple(EquationTerm(t.expr, t.kind, shares.names(i, t.expr)) for t in left)
            + tuple(EquationTerm(t.expr, "input", shares.names(i, t.expr)) for t in right)
            + tuple(EquationTerm(push, "constraint", (row.row.element.title,)) for row, push in pushes)
        )
        equalities.append(cast("sp.Eq", sp.Eq(sp.Add(*lefts[-1]), sp.Add(*rights[-1]), evaluate=False)))
    return Equations(tuple(lefts), tuple(rights), tuple(described), tuple(equalities))


@dataclass(frozen=True, eq=False)
class Matrices:
    """M ξ̈ + C ξ̇ + G = Ξ; ``rest`` contains the terms of G in the order of the equations."""

    M: sp.ImmutableMatrix
    C: sp.ImmutableMatrix
    G: sp.ImmutableMatrix
    Xi: sp.ImmutableMatrix
    rest: tuple[Terms, ...]


def matrices(context: Context, sides: tuple[LeftSide, ...], xi_of: dict[sp.Expr, sp.Expr]) -> Matrices:
    """M_ij = ∂²T*/∂ξ̇_i∂ξ̇_j;  C_ij = Σ_k ½ (∂M_ij/∂ξ_k + ∂M_ik/∂ξ_j − ∂M_jk/∂ξ_i) ξ̇_k;  G is the rest.

    Because of the Christoffel symbols, Ṁ − 2C is skew-symmetric if M does not contain t. Entries of M that depend on
    rates (of coils that saturate) have no part in C: T* is not a quadratic form of the rates then.
    """
    coordinates, algebra = context.model.coordinates, context.algebra
    n = len(coordinates)
    M = [[sides[i].momentum.diff(coordinates[j].rate) for j in range(n)] for i in range(n)]
    C = _christoffel(context, M)
    G: list[Form] = []
    for i, side in enumerate(sides):
        inertia = [
            entry * algebra.form(moving)
            for j, c in enumerate(coordinates)
            for entry, moving in ((M[i][j], c.acceleration), (C[i][j], c.rate))
            if entry.parts
        ]
        G.append(side.whole - algebra.total(inertia))
    return Matrices(
        sp.ImmutableMatrix([[entry.expr() for entry in row] for row in M]),
        sp.ImmutableMatrix([[entry.expr() for entry in row] for row in C]),
        sp.ImmutableMatrix([[form.expr()] for form in G]),
        sp.ImmutableMatrix(n, 1, list(xi_of.values())),
        tuple(Terms(tuple(t.expr for t in context.terms(form))) for form in G),
    )


def _christoffel(context: Context, M: list[list[Form]]) -> list[list[Form]]:
    """C, collected from the nonzero derivatives ∂M_ab/∂ξ_k: each occurs in C_ab, in C_ak, and with a minus in C_ka."""
    coordinates, algebra = context.model.coordinates, context.algebra
    n = len(coordinates)
    halves = [algebra.form(sp.Rational(1, 2) * c.rate) for c in coordinates]
    pieces: list[list[list[Form]]] = [[[] for _ in range(n)] for _ in range(n)]
    for a, row in enumerate(M):
        for b, entry in enumerate(row):
            of_positions = entry.parts and all(entry.diff(c.rate).is_zero for c in coordinates)
            for k, c in enumerate(coordinates if of_positions else ()):
                if (slope := entry.diff(c.symbol)).parts:
                    pieces[a][b].append(slope * halves[k])
                    turned = slope * halves[b]
                    pieces[a][k].append(turned)
                    pieces[k][a].append(-turned)
    return [[algebra.total(entry) for entry in row] for row in pieces]


def closing(
    context: Context,
    eqs: Equations,
    mats: Matrices,
    rows: tuple[RowForms, ...] = (),
    without: Iterable[Item] = (),
) -> tuple[Item, ...]:
    """The boxed equations of motion, and the matrix form.

    With ``rows`` of constraints what they ask of the accelerations follows, and ``without``: the equations that hold no
    multiplier.
    """
    M, C, G, Xi = Name("M"), Name("C"), Name("G"), Name("Xi")
    items: list[Item] = [Heading(text("Equations of motion"))]
    for left, right in zip(eqs.left, eqs.right, strict=True):
        items.append(formula(fit_terms(left), fit_terms(right), brief=True, boxed=True))
    if any(f.kind == "damping" for row in eqs.terms for f in row):
        losing = named_losses([e for e in context.model.elements if e.resists])
        whose = "The dampers' part of " if losing == "dampers" else f"The part of {losing} in "
        items.append(text(whose, Xi, " is written on the left-hand side, with its sign changed."))
    items += [*second_rates(context, rows), *without]
    for friction in context.model.frictions:
        items.append(
            text(f"These hold while {friction.title} slips; step 6 says what takes its place while it sticks.")
        )
    items.append(Heading(text("Matrix form")))
    q, dq, ddq = Name("q"), Name("q", "", 1), Name("q", "", 2)
    right = Terms((Xi, Product((Name("A transposed"), Name("lambda vector"))))) if rows else Xi
    items.append(formula(Terms((Product((M, ddq)), Product((C, dq)), G)), right))
    items.append(formula(q, Matrix(tuple((c.symbol,) for c in context.model.coordinates))))
    items.append(formula(M, _shown(mats.M, symmetric=True)))
    items.append(formula(C, _shown(mats.C)))
    if any(mats.M.has(c.rate) for c in context.model.coordinates):
        items.append(
            text("Entries of ", M, " that depend on rates have no part in ", C, ": what they add is in ", G, ".")
        )
    items.append(formula(G, _shown(mats.G, mats.rest)))
    items.append(formula(Xi, _shown(mats.Xi)))
    items += matrix_form(context, rows) if rows else ()
    return tuple(items)


def _shown(matrix: sp.ImmutableMatrix, column: tuple[Left, ...] = (), *, symmetric: bool = False) -> Left:
    """A matrix for the page, or its column as it will be written; one of only zeros becomes 0."""
    if matrix.is_zero_matrix:
        return sp.S.Zero
    entries = [[cast("sp.Expr", matrix[i, j]) for j in range(matrix.cols)] for i in range(matrix.rows)]
    rows: tuple[tuple[Left, ...], ...] = tuple((x,) for x in column) if column else tuple(map(tuple, entries))
    operations = bounded.operations(*(x for row in entries for x in row))
    whole = Matrix(rows, symmetric)
    return whole if operations <= READABLE else Elided(whole, operations)


def ledger(model: Model, context: Context) -> tuple[LedgerRow, ...]:
    """All elements, each exactly once in T*, V or Ξ, or with its multiplier, and the reason."""
    rows: list[LedgerRow] = []
    for element in model.elements:
        expr: sp.Expr | None = None
        if element.ledger == "T*":
            expr = context.readable(element.kinetic(model))
        elif element.ledger == "V":
            expr = context.readable(element.potential(model))
        rows.append(LedgerRow(element.title, element.ledger, expr, text(*element.because)))
    return tuple(rows)


def ledger_items(rows: tuple[LedgerRow, ...]) -> tuple[Item, ...]:
    """The ledger as a table."""
    header = (text("element"), text("counted in"), text("because"))
    table = Table(header, tuple((text(r.element), text(_column(r.column)), r.reason) for r in rows))
    return (Heading(text("Energy ledger: every element once")), table)


def _column(column: str) -> Name:
    return Name({"T*": "T*", "V": "V", "Ξ": "Xi", "λ": "lambda"}[column])
