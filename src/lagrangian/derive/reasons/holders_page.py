"""What holds a mass, in words: every holder of one mass, and why none does work."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from typing import TypeAlias

from lagrangian.derive.reasons.holding import Holding, HoldKind
from lagrangian.derive.reasons.result import Reasoning
from lagrangian.derive.reasons.shown import and_, index_of
from lagrangian.model import Body
from lagrangian.page.formula import Left, Minus, Name, Table, Terms, Text, text

Words: TypeAlias = "tuple[str | Left, ...]"

# -- one mass -------------------------------------------------------------------------------------------------------


def held_by(why: Reasoning, body: Body) -> Text:
    """All that holds a body, each with its force where it has a name, and that R is the sum of these forces."""
    holders = why.holders(body)
    if not holders:
        return text("Nothing holds it: ", *_also(why, body, force=False))
    listed = [(*_from(hold, body), *_force(why, hold, body)) for hold in holders]
    words: list[str | Left] = []
    for k, item in enumerate(listed):
        words += ["; " if k else "", *item]
    return text("Held by: ", *words, ". ", *_also(why, body, one=len(holders) == 1))


def _also(why: Reasoning, body: Body, *, force: bool = True, one: bool = False) -> Words:
    """What R is, and the moment of a body that turns."""
    R, moment = Name("R", index_of(why, body, "R")), Name("moment", index_of(why, body, "moment"))
    turns = any(m.turning for m in why.moving if m.body is body)
    letters: Words = (R, " and ", moment) if turns else (R,)
    besides = _unplaced(why, body)
    if not force:
        verb = "are" if turns else "is"
        return (
            (*letters, f" {verb} only what {besides} may do to it.")
            if besides
            else (*letters, f" {verb} 0, as the equations of motion will say.")
        )
    if turns:
        are = "are its force and moment" if one else "are the sums of their forces and moments"
        return (*letters, f" {are}{f', with what {besides} may do to it' if besides else ''}.")
    if one and not besides:
        return (*letters, " is its force.")
    whose = "its force" if one else "their forces"
    return (*letters, f" is the sum of {whose}{f' and of what {besides} may do to it' if besides else ''}.")


def _unplaced(why: Reasoning, body: Body) -> str:
    """The elements that may act on a body without being loads on it: a coordinate that moves it stands in them."""
    moved = {
        c.rate
        for m in why.moving
        if m.body is body
        for c, column in zip(why.derived.model.coordinates, m.columns, strict=True)
        if any(x.parts for x in column)
    }
    titles = [
        x.element.title
        for x in why.applied.passed
        if x.through != "part" and any(why.context.form(x.rate).diff(v).parts for v in moved)
    ]
    return and_(list(dict.fromkeys(titles))) if titles else ""


def _from(hold: Holding, body: Body) -> Words:
    """A holder as it is seen from one of its bodies."""
    others = [b.title for b in hold.bodies if b is not body]
    far = body is hold.carrier
    if hold.kind == "rod":
        return (f"a rod, a string or a round track {'to' if far else 'from'} ", *((others[0],) if far else hold.on))
    if hold.kind == "pin":
        return ("a pin at ", *((others[0],) if far else hold.on))
    if hold.kind == "track" and hold.carrier is not None:
        return (f"{others[0]}, which slides on it",) if far else (f"a straight track on {others[0]}",)
    if hold.kind == "track":
        return ("a straight track",)
    if hold.kind == "rolling":
        surface = others[0] if others else "the ground"
        return (f"{surface}, which rolls on it" if far else f"{surface}, on which it rolls",)
    if hold.kind == "constraint" and hold.element is not None:
        return (hold.element.title,)
    if hold.kind == "lever":
        return (f"the straight lever that it shares with {and_(others)}",)
    if hold.kind == "tie" and others:
        return (f"what ties it to {and_(others)} (a string, a lever, gears)",)
    return ("what ties it to its coordinates (a surface, a curve, another body)",)


def _force(why: Reasoning, hold: Holding, body: Body) -> Words:
    """The name of a holder's force on a body, in brackets, where it has one."""
    if not hold.branch or (hold.body is body and len(hold.branch) == 1 and not hold.along):
        return ()
    far = body is hold.carrier
    if hold.along:
        if not hold.named:
            return ()
        letter = Name("pull" if hold.kind == "rod" else "push", index_of(why, hold.body, "pull"))
        back = ", in the opposite direction" if far and hold.kind == "track" else ""
        return (" (", letter, f"{back})")
    parts: list[Left] = [Name("R", index_of(why, b, "R")) for b in hold.branch]
    return (" (its force is ", Terms(tuple(Minus(x) for x in parts) if far else tuple(parts)), ")")


# -- the table ------------------------------------------------------------------------------------------------------


def reasons(why: Reasoning) -> Table:
    """Every holder with the masses that it holds, and why it does no work."""
    rows: list[tuple[list[str], Text, Text]] = []
    for body in why.derived.model.bodies:
        if not why.holders(body):
            rest = "the rest of " if why.applied.passed else ""
            _add(rows, [body.title], text("nothing"), text(rest, Name("R"), " = 0 in every motion"))
        for hold in why.holds:
            if hold.body is body:
                held = sorted(hold.bodies, key=why.derived.model.bodies.index)
                _add(rows, [and_([b.title for b in held])], *_reason(hold, why.derived.model.dimension))
    header = (text("mass"), text("held by"), text("why no work"))
    return Table(header, tuple((text(_joined(titles)), by, because) for titles, by, because in rows))


def _joined(titles: list[str]) -> str:
    """Single masses with commas, pairs with semicolons."""
    return ("; " if any(" and " in x for x in titles) else ", ").join(titles)


def _add(rows: list[tuple[list[str], Text, Text]], titles: list[str], by: Text, because: Text) -> None:
    """Add a row; masses, or pairs of masses, that are held in the same way share one."""
    same = next((row for row in rows if (str(row[1]), str(row[2])) == (str(by), str(because))), None)
    if same is not None:
        same[0].extend(titles)
    else:
        rows.append((titles, by, because))


WHY: dict[tuple[HoldKind, bool], str] = {
    ("rod", False): "it pulls along its line, and a wiggle moves its end across this line",
    ("rod", True): "the forces at its two ends are opposite, along a line whose length a wiggle does not change",
    ("track", False): "a smooth track pushes across the path, a wiggle moves along it",
    ("track", True): (
        "the two push each other across the track with opposite forces; in a wiggle one moves past the other only "
        "along it"
    ),
    ("rolling", False): "the point of contact is at rest at every instant: a force on it moves nothing",
    ("rolling", True): "where they touch both move alike, and feel opposite forces",
    ("tie", False): (
        "a tie pushes across every wiggle, or pulls at both its ends and gains at one what it loses at the other"
    ),
    ("tie", True): "a tie pulls at all its ends: what it gains at one it loses at the others",
    ("lever", True): "it turns as a whole in a wiggle: what it gains at one mass it loses at the others",
}
"""Why a holder of one mass does no work, and one between two (True)."""


def _reason(hold: Holding, dimension: int) -> tuple[Text, Text]:
    """What a holder is, and why it does no work."""
    pair = len(hold.bodies) > 1
    because = text(WHY.get((hold.kind, pair), WHY["tie", False]))
    if hold.kind == "rod":
        from_: Words = ("each other",) if pair else hold.on
        return text("a constant distance from ", *from_, ": a rod, a string or a round track"), because
    if hold.kind == "pin":
        axis = "the axis" if dimension == 2 else "an axis"
        return text("a pin that joins them") if pair else text("a pin at ", *hold.on), text(
            "both sides of the pin move alike and feel opposite forces; a smooth pin gives no moment about "
            f"{axis} that it leaves free"
        )
    if hold.kind == "track":
        return text(f"a straight track on {hold.carrier.title}" if hold.carrier else "a straight track"), because
    if hold.kind == "rolling":
        on = hold.carrier.title if hold.carrier else "the ground"
        return text(f"rolling on {on}" if hold.carrier else f"{on}, on which it rolls"), because
    if hold.kind == "constraint" and hold.element is not None:
        return text(hold.element.title), text("no work in a wiggle that it admits: see below")
    if hold.kind == "lever":
        return text("a straight lever that they share"), because
    if hold.kind == "tie" and pair:
        return text("what ties them together: a string, a lever, gears"), because
    return text("what ties it to its coordinates: a surface, a curve, another body"), because
