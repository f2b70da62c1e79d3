"""The part of the page on the work of the constraint forces: what holds every body, and the sum that vanishes."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false
# pyright: reportUnknownVariableType=false

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.derive.reasons.holders_page import reasons
from lagrangian.derive.reasons.laws import held_check
from lagrangian.derive.reasons.result import Reasoning
from lagrangian.derive.reasons.shown import (
    FORCE,
    LONG,
    MOST_SUMMED,
    PLACE,
    SUM,
    and_,
    short,
)
from lagrangian.page.formula import (
    Item,
    Left,
    Name,
    Partial,
    Product,
    Terms,
    formula,
    text,
)
from lagrangian.page.report import Part


def constraint_work(why: Reasoning) -> Part:
    """Σ R·δr = 0: the reasons, and the sum."""
    several = any(len(hold.bodies) > 1 for hold in why.holds)
    shared = " (the force between two masses is in the sum at both ends)" if several else ""
    items: list[Item] = [
        *_exception(why),
        text(
            "Multiply F = ma of every mass by its ",
            Partial(PLACE, Name("xi", "j")),
            " (a dot product) and add over the whole system. In the sum the constraint forces vanish, because of "
            f"what they are{shared}:",
        ),
    ]
    items.append(reasons(why))
    if why.derived.shares.rows:
        items.append(
            text(
                "The constraints that were stated as equations have multipliers. Their forces do no work in a wiggle "
                "that the constraints admit, but may do some if one coordinate is wiggled alone: the work is λ·A δ",
                Name("q"),
                ", and an admissible wiggle has A δ",
                Name("q"),
                " = 0.",
            )
        )
    coordinates = why.derived.model.coordinates
    few = len(coordinates) <= MOST_SUMMED
    reads = (
        " of F = ma the sum reads, coordinate by coordinate:"
        if few
        else f" of F = ma there are {len(coordinates)} sums."
    )
    items.append(text("With the ", Name("R"), reads))
    for j, (c, law) in enumerate(zip(coordinates, why.laws, strict=True) if few else ()):
        left: list[Left] = [Product((SUM, FORCE, Partial(PLACE, c.symbol)))]
        left += _turned(why, j, c.rate, Name("moment", "i"))
        left += [t.expr for t in why.context.terms(-law.passed)]
        right: Left = short(why, law.rows) if law.rows.parts else sp.S.Zero
        items.append(formula(Terms(tuple(left)), short(why, law.rest, LONG), right))
    so = "it is zero" if not why.derived.shares.rows else "both sides agree"
    items.append(
        text(
            f"That {so} is the equation of motion itself: Lagrange's equation for ",
            Name("xi", "j"),
            " is F = ma along the wiggle of ",
            Name("xi", "j"),
            *(
                (", where of all constraint forces only those of the multipliers are left.",)
                if why.derived.shares.rows
                else (", where the constraint forces have no say.",)
            ),
            " The other components of F = ma only tell how large ",
            Name("R"),
            " is.",
        )
    )
    return Part(text("The constraint forces do no work"), tuple(items), (held_check(why.context, why.laws),))


def _turned(why: Reasoning, index: int, rate: sp.Expr, moment: Name) -> Iterator[Left]:
    """Σ Γ·∂ω/∂ξ̇, if a body turns with this coordinate."""
    if any(m.turning and any(x.parts for x in m.columns[index]) for m in why.moving):
        yield Product((SUM, moment, Partial(Name("omega", "i"), rate)))


def _exception(why: Reasoning) -> Iterator[Item]:
    """What is in R without being a constraint force."""
    if titles := list(dict.fromkeys(item.element.title for item in why.applied.passed)):
        yield text(
            "First the exception: what ",
            Name("R"),
            f" contains of {and_(titles)} may do work. It is not a constraint force: it is taken out of the sum here "
            "and counted below. What follows is true for the rest of ",
            Name("R"),
            ".",
        )
