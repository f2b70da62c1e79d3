"""The part of the page on the work of the constraint forces: what holds every body, and the sum that vanishes."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false
# pyright: reportUnknownVariableType=false

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.derive.reasons.held import Holding
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
from lagrangian.model import Body
from lagrangian.page.formula import (
    Item,
    Left,
    Name,
    Partial,
    Product,
    Table,
    Terms,
    Text,
    formula,
    text,
)
from lagrangian.page.report import Part


def constraint_work(why: Reasoning) -> Part:
    """Σ R·δr = 0: the reasons, and the sum."""
    items: list[Item] = [
        *_exception(why),
        text(
            "Multiply F = ma of every mass by its ",
            Partial(PLACE, Name("xi", "j")),
            " (a dot product) and add over the whole system. In the sum the constraint forces vanish, because of "
            "what they are:",
        ),
    ]
    items += _reasons(why)
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


def _reasons(why: Reasoning) -> Iterator[Item]:
    rows: list[tuple[Text, Text, Text]] = []
    known: list[tuple[str, str]] = []
    for hold in why.holds:
        by, because = _held(why, hold)
        key = (str(by), str(because))
        if key in known:
            k = known.index(key)
            rows[k] = (text(*rows[k][0].parts, f", {hold.body.title}"), by, because)
        else:
            known.append(key)
            rows.append((text(hold.body.title), by, because))
    header = (text("mass"), text("held by"), text("why no work"))
    yield Table(header, tuple(rows))


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


def _held(why: Reasoning, hold: Holding) -> tuple[Text, Text]:
    """What holds a body, and why it does no work."""
    if hold.kind == "rod":
        by = text("a constant distance from ", *hold.on, ": a rod, a string or a round track")
        if hold.carrier is None and len(why.holds) == 1:
            return by, text("it pulls along its line, and a wiggle moves its end across this line")
        return by, text("the forces at its two ends are opposite, along a line whose length a wiggle does not change")
    if hold.kind == "pin":
        return text("a pin at ", *hold.on), text(
            "both sides of the pin move alike and feel opposite forces; a smooth pin gives no moment about the axis "
            "that it leaves free"
        )
    if hold.kind == "track" and hold.carrier is not None:
        return text("a straight track on ", *hold.on), text(
            "track and body push each other with opposite forces across it, and a wiggle moves them along it apart"
        )
    if hold.kind == "track":
        others = _together(why, hold.body)
        by = f", tied to {and_(others)}" if others else ""
        tied = "; the tie pulls at both ends, what one end gains the other loses" if others else ""
        return text(f"a straight track{by}"), text(
            f"a smooth track pushes across the path, a wiggle moves along it{tied}"
        )
    if hold.kind == "rolling":
        return text("the ground, on which it rolls"), text(
            "the point of contact is at rest at every instant: a force on it moves nothing"
        )
    if why.numbers is not None and _free(why, hold.body):
        return text("nothing"), text(Name("R"), " = 0 in every motion")
    if why.derived.shares.rows:
        named = and_([e.title for e in why.derived.model.constraints])
        return text(named), text("see below: no work in a wiggle that is admitted")
    return text("what ties it to the coordinates: a surface, a string, another body"), text(
        "a tie pushes across every wiggle, or pulls at both its ends and gains at one what it loses at the other"
    )


def _together(why: Reasoning, body: Body) -> list[str]:
    """The bodies that a coordinate moves together with this one, if neither carries the other."""
    bodies = [h.body for h in why.holds]
    carriers = {h.body: h.carrier for h in why.holds}
    found: list[Body] = []
    for j in range(len(why.derived.model.coordinates)):
        moved = [b for b in bodies if any(x.parts for m in why.moving if m.body is b for x in m.columns[j])]
        if body in moved and all(_alone(why, j, b) for b in moved):
            found += [b for b in moved if b is not body and b not in found and carriers[b] is not body]
    return [b.title for b in found]


def _alone(why: Reasoning, index: int, body: Body) -> bool:
    """Whether a body is moved by this coordinate and no other."""
    mine = [m for m in why.moving if m.body is body]
    return not any(x.parts for m in mine for j, c in enumerate(m.columns) if j != index for x in c)


def _free(why: Reasoning, body: Body) -> bool:
    """Whether nothing holds a body in the state of the numbers, to all digits."""
    assert why.numbers is not None
    pairs = zip(why.moving, why.numbers.reactions, strict=True)
    return all(abs(x) < 1e-25 for m, R in pairs if m.body is body for x in R)
