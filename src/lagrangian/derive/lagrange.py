"""Step 5: the left-hand sides d/dt(∂L/∂ξ̇_i) − ∂L/∂ξ_i, written out."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal, TypeAlias

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.derive.algebra import Form
from lagrangian.derive.context import Context, fit
from lagrangian.derive.derived import Step
from lagrangian.derive.energies import Share
from lagrangian.model import Coordinate, time
from lagrangian.page.formula import Heading, Item, Left, Minus, Name, Partial, Terms, Text, Total, formula, text
from lagrangian.records import dataclass

Detail: TypeAlias = Literal["usual", "full"]
"""How much of step 5 is written: "full" shows d/dt of every term."""


SUMMED = text("summed over the rows r of the constraints")


@dataclass(frozen=True, eq=False)
class LeftSide:
    """The left-hand side of one coordinate: the contribution of each part of T* or V, and the sum."""

    coordinate: Coordinate
    momentum: Form
    momentum_rate: Form
    gradient: Form
    parts: tuple[tuple[Share, Form], ...]
    whole: Form


def left_sides(context: Context, pieces: tuple[Share, ...]) -> tuple[LeftSide, ...]:
    """d/dt(∂L/∂ξ̇_i) − ∂L/∂ξ_i for each part: L is a sum, and so is every equation."""
    algebra = context.algebra
    sides: list[LeftSide] = []
    for c in context.model.coordinates:
        momenta: list[Form] = []
        gradients: list[Form] = []
        parts: list[tuple[Share, Form]] = []
        for share in pieces:
            signed = share.form if share.column == "T*" else -share.form
            momentum, gradient = signed.diff(c.rate), signed.diff(c.symbol)
            if momentum.is_zero and gradient.is_zero:
                continue
            momenta.append(momentum)
            gradients.append(gradient)
            parts.append((share, momentum.total_derivative() - gradient))
        momentum, gradient = algebra.total(momenta), algebra.total(gradients)
        rate = momentum.total_derivative()
        sides.append(LeftSide(c, momentum, rate, gradient, tuple(parts), rate - gradient))
    return tuple(sides)


def left_hand_sides(
    context: Context, sides: tuple[LeftSide, ...], detail: Detail = "usual", constrained: tuple[Left, ...] = ()
) -> Step:
    """Write out ∂L/∂ξ̇_i, its d/dt, ∂L/∂ξ_i and the left-hand side for every coordinate.

    With ``detail="full"``, d/dt is shown term by term before the result is collected. ``constrained`` is what the
    constraints add to the right-hand side of the law.
    """
    by_xi = Partial(Name("L"), Name("xi", "i", 1))
    law = Terms((Total(by_xi), Minus(Partial(Name("L"), Name("xi", "i")))))
    right = Terms((Name("Xi", "i"), *constrained)) if constrained else Name("Xi", "i")
    items: list[Item] = [formula(law, right, note=SUMMED if constrained else None, brief=True)]
    expressions: dict[sp.Expr, sp.Expr] = {}
    reasons: list[Text] = []
    for i, side in enumerate(sides):
        c = side.coordinate
        by_rate, by_place = Partial(Name("L"), c.rate), Partial(Name("L"), c.symbol)
        whole = Terms((Total(by_rate), Minus(by_place)))
        items += [
            Heading(text(f"Equation {i + 1}: ", c.symbol)),
            formula(by_rate, context.written(side.momentum)),
            *(_term_by_term(context, side.momentum) if detail == "full" else ()),
            formula(Total(by_rate), context.written(side.momentum_rate)),
            formula(by_place, context.written(side.gradient)),
            formula(whole, context.written(side.whole), brief=True),
        ]
        expressions[c.symbol] = side.whole.expr()
        reasons.append(
            text(
                f"equation {i + 1}: ",
                Total(by_rate),
                " collects the inertia, ",
                Minus(by_place),
                " the springs, gravity and what turns with the geometry",
            )
        )
    return left_hand_sides_step(items, {"left_hand_sides": expressions}, reasons)


def left_hand_sides_step(
    items: Sequence[Item], expressions: Mapping[str, dict[sp.Expr, sp.Expr]], reasons: Sequence[Text]
) -> Step:
    """Step 5 with its items, its results by name and the reason for each equation."""
    return Step(
        5,
        "Left-hand sides",
        text("Differentiated the Lagrangian for every coordinate: by its rate, then in time, and by the coordinate."),
        text(
            "Wiggle one coordinate alone: by d'Alembert's principle the work of inertia, of the conservative forces "
            "and of all others adds up to zero. The left-hand side is the part that follows from ",
            Name("L"),
            ", ",
            Name("Xi", "i"),
            " is the rest.",
        ),
        tuple(items),
        expressions,
        tuple(reasons),
    )


def _term_by_term(context: Context, momentum: Form) -> Iterator[Item]:
    """d/dt of every term of ∂L/∂ξ̇_i by the product and chain rules, before the results are added."""
    terms = [term.expr for term in context.terms(momentum)]
    if len(terms) == 1 and not _has_product_rule(terms[0]):
        return
    yield text("Term by term, by the product rule and the chain rule:" if len(terms) > 1 else "By the product rule:")
    for term in terms:
        yield formula(Total(fit(term)), context.written(context.form(term).total_derivative()))


def _has_product_rule(term: sp.Expr) -> bool:
    """Whether anything except a single rate changes with time in a term."""
    rates = term.atoms(sp.Derivative)
    rest = bounded.replaced(term, {a: sp.Dummy() for a in rates})
    return len(rates) != 1 or rest.has(AppliedUndef, time)
