"""The first parts of the page: F = ma for every mass, a wiggle, and the work of the constraint forces."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false
# pyright: reportUnknownVariableType=false

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Form
from lagrangian.derive.reasons.holders_page import held_by
from lagrangian.derive.reasons.holding import Holding
from lagrangian.derive.reasons.laws import wiggle_check
from lagrangian.derive.reasons.loads import Through
from lagrangian.derive.reasons.motion import Moving
from lagrangian.derive.reasons.result import Reasoning
from lagrangian.derive.reasons.shown import (
    AXES,
    FORCE,
    MASS,
    MOST_ELIMINATED,
    MOST_LISTED,
    PLACE,
    SHORT,
    SUM,
    and_,
    capital,
    component,
    index_of,
    short,
)
from lagrangian.model import Body, time
from lagrangian.page.formula import (
    Elided,
    Heading,
    Item,
    Left,
    Minus,
    Name,
    Partial,
    Product,
    Terms,
    Text,
    Variation,
    formula,
    text,
)
from lagrangian.page.report import Part

# -- (1) ------------------------------------------------------------------------------------------------------------


def newton(why: Reasoning) -> Part:
    """F = ma for every mass, solved for what holds it."""
    bodies = why.derived.model.bodies
    turning = any(m.turning for m in why.moving)
    axes = ", here in its own axes" if why.derived.model.dimension == 3 else ""
    also = "; a body that turns also feels a moment ", Name("moment"), f" about its centre of mass{axes}"
    moment: tuple[str | Left, ...] = also if turning else ()
    items: list[Item] = [
        text(
            "Equation (1), Newton's second law: mass times acceleration is the sum of the forces on a mass. Some of "
            "them were described. The rest is whatever holds the mass: call it the constraint force ",
            Name("R"),
            *moment,
            ". Nobody described it, but F = ma says how large it is:",
        ),
        formula(
            Product((MASS, Name("r", "i", 2))),
            Terms((Name("F", "i"), FORCE)),
            note=text("equation 1, for every mass i"),
        ),
    ]
    if len(bodies) > MOST_LISTED:
        items.append(text(f"There are {len(bodies)} bodies; the numbers below say what holds each of them."))
        return Part(text("F = ma for every mass"), tuple(items))
    for body in bodies:
        items += _body(why, body, alone=len(bodies) == 1)
    items += _passed_on(why)
    return Part(text("F = ma for every mass"), tuple(items))


def _body(why: Reasoning, body: Body, *, alone: bool) -> Iterator[Item]:
    acting = [load.element.title for load in why.applied.loads if load.body is body]
    acting = list(dict.fromkeys(acting))
    title = capital(body.title)
    described = (
        f"{and_(acting)} act{'s' if len(acting) == 1 else ''} on it" if acting else "nothing described acts on it"
    )
    if not alone:
        yield Heading(text(title))
        yield text(f"{capital(described)}, and what holds it:")
    else:
        yield text(f"{title}: {described}, and what holds it:")
    free: list[str] = []
    for m, R in zip(why.moving, why.reactions, strict=True):
        if m.body is not body:
            continue
        letter = "moment" if m.turning else "R"
        for axis, reaction in enumerate(R):
            yield formula(
                component(letter, why, m, axis), *_newton(why, m, axis, reaction), note=_still_note(m, axis, reaction)
            )
            free += [AXES[axis]] if not m.turning and _vanishes(why, reaction) else []
    for hold in why.holds:
        if hold.body is body:
            yield from _pull(why, hold)
    yield held_by(why, body)
    if free and why.holders(body):
        yield text(
            f"Nothing holds it along {and_(free)}: there ", Name("R"), " is 0, as the equations of motion will say."
        )
    yield from _without_acceleration(why, body)


def _without_acceleration(why: Reasoning, body: Body) -> Iterator[Item]:
    """The constraint force where the equation of motion tells the only acceleration, if that is short."""
    shown: list[Item] = []
    for m, R in zip(why.moving, why.reactions, strict=True):
        for axis, reaction in enumerate(R if m.body is body else ()):
            if (found := eliminated(why, reaction)) is not None:
                shown.append(formula(component("moment" if m.turning else "R", why, m, axis), found))
    if shown:
        yield text("With ", why.derived.model.coordinates[0].acceleration, " from the equation of motion:")
        yield from shown


def eliminated(why: Reasoning, reaction: Form) -> sp.Expr | None:
    """The force without its acceleration, which is that of the only equation of motion; None if it has none or is long.

    R = a ξ̈ + b and M ξ̈ + c = 0 give R = (b M − a c)/M. The quotient is only returned if the normal form agrees.
    """
    if len(why.laws) != 1 or why.derived.shares.rows:
        return None
    context, law = why.context, why.laws[0]
    acceleration = why.derived.model.coordinates[0].acceleration
    a, M = reaction.diff(acceleration), law.left.diff(acceleration)
    if a.is_zero or bounded.operations(M.expr(), a.expr()) > SHORT:
        return None
    moving = context.form(acceleration)
    b, c = reaction - a * moving, law.left - law.Xi - M * moving
    over = b * M - a * c
    if bounded.operations(over.expr()) > SHORT:
        return None
    found = bounded.cancel(bounded.together(over.expr() / M.expr()))
    found = sp.factor_terms(cast("sp.Expr", sp.factor(found)))
    short_enough = bounded.operations(found) <= MOST_ELIMINATED
    return found if short_enough and (context.form(found) * M - over).is_zero else None


def _newton(why: Reasoning, m: Moving, axis: int, reaction: Form) -> Iterator[Left]:
    """m ẍ − F, and the same in the coordinates."""
    context = why.context
    if not m.turning and m.velocity[axis].parts:
        load = m.momentum_rate[axis] - reaction
        inertia = Product((m.body.mass, component(AXES[axis], why, _plane(m), 0, 2)))
        others = tuple(t.expr for t in context.terms(-load))
        if bounded.operations(*others) <= SHORT:
            yield Terms((inertia, *others))
    yield short(why, reaction)


MOST_ADDED = 4
"""With more equations of motion it is not tried whether a force is a sum of them."""


def _plane(m: Moving) -> Moving:
    """The same with one component, whose name is x_1 rather than x_x1."""
    return Moving(m.body, m.turning, m.velocity[:1], (), (), (), (), ())


def _still_note(m: Moving, axis: int, reaction: Form) -> Text | None:
    if not m.turning and not m.velocity[axis].parts and reaction.parts:
        return text(f"it does not move along {AXES[axis]}")
    return None


def _vanishes(why: Reasoning, reaction: Form) -> bool:
    """Whether a constraint force is 0 on every motion: a sum of left-hand sides minus Ξ, each 0, 1 or −1 times."""
    if reaction.is_zero or len(why.laws) > MOST_ADDED or why.derived.shares.rows:
        return False
    laws = [law.left - law.Xi for law in why.laws]
    for signs in product((0, 1, -1), repeat=len(laws)):
        rest = reaction
        for sign, law in zip(signs, laws, strict=True):
            rest = rest - law if sign > 0 else rest + law if sign < 0 else rest
        if any(signs) and rest.is_zero:
            return True
    return False


def _pull(why: Reasoning, hold: Holding) -> Iterator[Item]:
    """The pull of a rod, or the push of a track."""
    if hold.force is None or not hold.named:
        return
    letter = Name("pull" if hold.kind == "rod" else "push", index_of(why, hold.body, "pull"))
    if hold.kind == "rod":
        words = text(letter, " is the pull of the rod, string or round track, towards the pivot at ", *hold.on)
    else:
        words = text("across its path: the push of the track")
    yield formula(letter, short(why, hold.force), note=words)


THROUGH: Mapping[Through, tuple[str, str]] = {
    "part": (
        "{s:acts|act}, at one end at least, on a part without mass (a lever, a rod, a shaft). Such a part needs no "
        "force to be accelerated, so it passes on in full what acts on it: ",
        " contains that, too. This part of ",
    ),
    "deflection": (
        "{s:is|are} described by how far {s:it is|they are} stretched or turned. That says what work {s:it does|they "
        "do}, but not where {s:it pulls|they pull} at the masses, so what {s:it does|they do} to them is in ",
        ". This part of ",
    ),
    "energy": (
        "{s:is|are} described by {s:an energy or a generalized force|energies or generalized forces}. That says what "
        "work {s:it does|they do}, but not on which masses {s:it acts|they act}, so what {s:it does|they do} to "
        "them is in ",
        ". This part of ",
    ),
}
"""What is said of elements that are known as loads on no body, by the reason; ``{s:…|…}`` for one and for several."""


def _passed_on(why: Reasoning) -> Iterator[Item]:
    """What acts on parts without mass, or on masses that were not named, is in R."""
    for through, (first, then) in THROUGH.items():
        titles = list(dict.fromkeys(x.element.title for x in why.applied.passed if x.through == through))
        if titles:
            said = _for_number(first, len(titles) == 1)
            yield text(f"{capital(and_(titles))} {said}", Name("R"), then, Name("R"), " may do work.")


def _for_number(words: str, one: bool) -> str:
    """The words with what is said of one thing, or of several."""
    return re.sub(r"\{s:([^|}]*)\|([^}]*)\}", r"\1" if one else r"\2", words)


# -- (2), (3) -------------------------------------------------------------------------------------------------------


def wiggle(why: Reasoning) -> Part:
    """δr = Σ ∂r/∂ξ δξ, and δφ = Σ ∂ω/∂ξ̇ δξ."""
    items: list[Item] = [
        text(
            "Equations (2) and (3): hold time fixed (δt = 0) and change the coordinates a little. The lecture calls "
            "this a virtual displacement, this page a wiggle. Every mass moves with them, by"
        ),
        formula(
            Variation(PLACE),
            Product((SUM, Partial(PLACE, Name("xi", "j")), Variation(Name("xi", "j")))),
            note=text("summed over the coordinates j"),
        ),
    ]
    listed = len(why.derived.model.bodies) <= MOST_LISTED
    for m in why.moving if listed else ():
        for axis in range(len(m.velocity)):
            items += _wiggled(why, m, axis)
    if any(m.turning for m in why.moving):
        turn = Product((SUM, Partial(Name("omega", "i"), Name("xi", "j", 1)), Variation(Name("xi", "j"))))
        items.append(text("A body turns in a wiggle, too, by the angle"))
        items.append(formula(Variation(Name("phi", "i")), turn))
    if driven(why):
        items.append(
            text(
                "A support moves as prescribed, whatever the coordinates do. In a wiggle it stays where it is at that "
                "instant, because δt = 0: the force that drives it does work as time goes on, but no virtual work."
            )
        )
    return Part(text("A wiggle moves every mass"), tuple(items), (wiggle_check(why.context, why.moving),))


def driven(why: Reasoning) -> bool:
    """Whether a place or a turn changes with time while all coordinates rest."""
    model = why.derived.model
    places = [model.expand(x) for b in model.bodies for x in model.position(b.at)]
    angles = [model.expand(sp.sympify(f.angle)) for b in model.bodies if (f := b.axes) is not None]
    inputs = {i.symbol for i in model.inputs}
    return any({time, *inputs} & set(x.free_symbols | bounded.names(x)) and _explicit(x) for x in (*places, *angles))


def _explicit(expr: sp.Expr) -> bool:
    """Whether time occurs outside of a coordinate's (t)."""
    plain: Any = expr.xreplace({f: sp.Dummy() for f in bounded.names(expr) if f != time})
    return bool(plain.has(time))


def _wiggled(why: Reasoning, m: Moving, axis: int) -> Iterator[Item]:
    """δx = Σ ∂x/∂ξ δξ of one mass, if it moves along this axis."""
    moved = [(c.symbol, column[axis]) for c, column in zip(why.derived.model.coordinates, m.columns, strict=True)]
    moved = [(q, form) for q, form in moved if form.parts]
    if not moved:
        return
    name = component("phi", why, m, axis) if m.turning else component(AXES[axis], why, _plane(m), 0)
    parts: list[Left] = []
    for q, form in moved:
        expr = form.expr()
        what = Variation(q)
        if bounded.operations(expr) > SHORT:
            parts.append(Product((Elided(expr, bounded.operations(expr)), what)))
        elif expr.could_extract_minus_sign():
            parts.append(Minus(what if expr == -1 else Product((-expr, what))))
        else:
            parts.append(what if expr == 1 else Product((expr, what)))
    sides = formula(Variation(name), Terms(tuple(parts)))
    if str(sides.sides[0]) != str(sides.sides[-1]):
        yield sides
