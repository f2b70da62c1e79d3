"""The constraints of a derivation: what holds, what each multiplier is, and what it adds to every equation."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Protocol

import sympy as sp

from lagrangian.derive.algebra import Form
from lagrangian.derive.context import READABLE, Context, fit
from lagrangian.derive.derived import Step
from lagrangian.derive.multiplier import Multiplier
from lagrangian.derive.multipliers.rows import RowForms
from lagrangian.model.rows import Row
from lagrangian.page.formula import (
    Elided,
    Heading,
    Item,
    Left,
    Matrix,
    Name,
    Partial,
    Product,
    Table,
    Terms,
    Text,
    formula,
    text,
)

AFTER = 4
"""The lecture's step that the constraints follow: L is there, and nothing is differentiated yet."""


class NamedRow(Protocol):
    """What holds a row of a constraint, in whatever form its lines are."""

    @property
    def row(self) -> Row:
        """The row as it was described."""
        ...


def by_multipliers() -> tuple[Left, ...]:
    """Σ over the rows of λ ∂c/∂ξ̇_i: what constraints add to the right-hand side."""
    return (Product((Name("lambda", "r"), Partial(Name("c", "r"), Name("xi", "i", 1)))),)


def introduced(context: Context, rows: tuple[RowForms, ...], found: Mapping[str, Multiplier]) -> Step:
    """Write down every row, what its multiplier is, and what it adds to each equation of motion."""
    rates = [context.written(forms.rate) for forms in rows]
    return constraint_step(rows, found.values(), rates, _added(context, rows))


def constraint_step(
    rows: Sequence[NamedRow],
    found: Iterable[Multiplier],
    rates: Sequence[Left],
    added: Iterable[tuple[sp.Expr, Left]],
    defined: Iterable[Item] = (),
) -> Step:
    """The step between 4 and 5: every row with its rate as it is written, and what all of them add to each equation.

    ``added`` has what an equation is called by and what the rows add to it; ``defined`` are the definitions of what
    these lines contain.
    """
    known = list(found)
    items: list[Item] = [*defined]
    for named, one, rate in zip(rows, known, rates, strict=True):
        items += _row(named, one, rate)
    items += [
        Heading(text("What the constraints add")),
        text(
            "A constraint's force does no work on a motion that the constraint allows. So it is λ times the slope of "
            "the row, and by virtual work, as for any other force, it adds to the right-hand side of equation i:"
        ),
        formula(*by_multipliers(), note=ADDED, brief=True),
        _table(added),
    ]
    if any(one.position is None for one in known):
        items.append(text(*NEVER_INTO_L))
    return Step(
        AFTER,
        "Constraints",
        text("Wrote down what restricts the motion, one row for every scalar condition, each with a multiplier λ."),
        text(
            "The coordinates cannot wiggle freely any more. Each row is kept by a force that nobody has described, and "
            "λ is that force: one more unknown, and one more equation, the row itself."
        ),
        tuple(items),
        {"rows": {one.name: one.rate for one in known}},
        tuple(text(one.symbol, " is ", *one.words.parts) for one in known),
    )


ADDED = text("added to the right-hand side of equation i, summed over the rows r")
"""What the multipliers do to the equations."""

NEVER_INTO_L: tuple[str | Left, ...] = (
    "A constraint on velocities is never put into ",
    Name("L"),
    " before the derivatives are taken: ",
    Partial(Name("L"), Name("xi", "i", 1)),
    " and ",
    Partial(Name("L"), Name("xi", "i")),
    " compare the motion with neighbours that break the constraint too, and with these left out the equations "
    "would be wrong.",
)


def _row(named: NamedRow, known: Multiplier, rate: Left) -> Iterator[Item]:
    """One row: what is zero, its rate, and what its multiplier is."""
    title, suffix = named.row.element.title, named.row.condition.suffix
    yield Heading(text(title[:1].upper() + title[1:], f", row {suffix}" if suffix else ""))
    if known.position is not None:
        yield formula(Name("f"), fit(known.position), sp.S.Zero, brief=True)
        yield formula(Name("c"), Name("f", "", 1), rate, sp.S.Zero)
    else:
        yield formula(Name("c"), rate, sp.S.Zero, brief=True)
    unit = f" [{known.unit}]" if known.unit else ""
    held = Name("c" if known.position is None else "f")
    sign = (". Where it is positive, it acts so as to increase ", held, ".")
    yield Text((known.symbol, f"{unit} is ", *known.words.parts, *sign), brief=True)


def _added(context: Context, rows: tuple[RowForms, ...]) -> Iterator[tuple[sp.Expr, Left]]:
    """What the rows add to each equation, a term for each λ."""
    for i, c in enumerate(context.model.coordinates):
        pushes = [forms.pushes[i] for forms in rows]
        terms: tuple[Left, ...] = tuple(fit(push.expr()) for push in pushes if not push.is_zero)
        yield c.symbol, Terms(terms)


def _table(added: Iterable[tuple[sp.Expr, Left]]) -> Table:
    """What the constraints add to each equation."""
    lines = tuple((text(symbol), text(push)) for symbol, push in added)
    return Table((text("equation"), text("constraints add")), lines)


def second_rates(context: Context, rows: tuple[RowForms, ...]) -> Iterator[Item]:
    """What the rows ask of the accelerations, A ξ̈ + γ = 0, row by row; nothing without rows."""
    changes = [(forms.row.name, context.written(forms.second_rate)) for forms in rows]
    return missing_equations(len(context.model.coordinates), changes)


def missing_equations(count: int, changes: Sequence[tuple[str, Left]]) -> Iterator[Item]:
    """The rates ċ of the rows, by name, as the equations that ``count`` equations of motion need besides."""
    if not changes:
        return
    yield text(
        f"These are {count} equations for as many accelerations and {len(changes)} "
        f"multiplier{'s' if len(changes) > 1 else ''}. The rows, differentiated until accelerations appear, are the "
        "missing equations:"
    )
    for name, change in changes:
        yield formula(Name("c", "", 1), change, sp.S.Zero, note=text(name))


def matrix_form(context: Context, rows: tuple[RowForms, ...]) -> Iterator[Item]:
    """A and γ of A ξ̈ + γ = 0, beside M ξ̈ + C ξ̇ + G = Ξ + Aᵀ λ."""
    A, gamma, ddq = Name("A"), Name("gamma vector"), Name("q", "", 2)
    yield formula(Terms((Product((A, ddq)), gamma)), sp.S.Zero)
    yield formula(A, _whole([[slope.expr() for slope in forms.slopes] for forms in rows]))
    yield formula(gamma, _whole([[still(context, forms).expr()] for forms in rows]))
    yield formula(Name("lambda vector"), Matrix(tuple((forms.symbol,) for forms in rows)))


def _whole(rows: Sequence[Sequence[sp.Expr]]) -> Left:
    whole = Matrix(tuple(map(tuple, rows)))
    operations = sum(int(sp.count_ops(x)) for row in rows for x in row)
    return whole if operations <= READABLE else Elided(whole, operations)


def still(context: Context, forms: RowForms) -> Form:
    """γ: ċ at ξ̈ = 0."""
    algebra, coordinates = context.algebra, context.model.coordinates
    moving = [s * algebra.form(c.acceleration) for s, c in zip(forms.slopes, coordinates, strict=True)]
    return forms.second_rate - algebra.total(moving)
