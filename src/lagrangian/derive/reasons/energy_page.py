"""The later parts of the page: the chain rule, both energies, what is left, numbers and counts."""

# SymPy and mpmath have no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import mpmath

from lagrangian.derive.context import big_xi
from lagrangian.derive.reasons.at_a_state import NumbersAt
from lagrangian.derive.reasons.laws import AGREE, Law, chain_check, kinetic_check, potential_check, work_check
from lagrangian.derive.reasons.result import EquationCount, Reasoning
from lagrangian.derive.reasons.shown import (
    FORCE,
    LONG,
    MASS,
    MOST_LISTED,
    MOST_SUMMED,
    PLACE,
    SUM,
    and_,
    capital,
    short,
)
from lagrangian.model import Coordinate, Element
from lagrangian.page.formula import (
    Check,
    Formula,
    Item,
    Left,
    Minus,
    Name,
    Partial,
    Product,
    Table,
    Terms,
    Text,
    Total,
    formula,
    text,
)
from lagrangian.page.report import Part
from lagrangian.quantities.quantity import si_unit
from lagrangian.write.numerals import unit

MOST_COORDINATES = 5
"""With more coordinates, the tables of numbers are left out."""

VELOCITY = Name("r", "i", 1)
BY_XI, BY_RATE = Partial(PLACE, Name("xi", "j")), Partial(VELOCITY, Name("xi", "j"))


def _pairs(why: Reasoning) -> Iterator[tuple[Coordinate, Law]]:
    """Every coordinate with its equations, if they are few enough to be read."""
    if len(why.laws) <= MOST_SUMMED:
        yield from zip(why.derived.model.coordinates, why.laws, strict=True)


# -- (4) to (9) -----------------------------------------------------------------------------------------------------


def kinetic(why: Reasoning) -> Part:
    """Σ m r̈·∂r/∂ξ = d/dt(Σ m ṙ·∂r/∂ξ) − Σ m ṙ·∂ṙ/∂ξ, and both sums are derivatives of T*."""
    T, whole = Name("T*"), Product((SUM, MASS, Name("r", "i", 2), BY_XI))
    law = formula(
        whole,
        Terms((Total(Product((SUM, MASS, VELOCITY, BY_XI))), Minus(Product((SUM, MASS, VELOCITY, BY_RATE))))),
        note=text("equations 4 to 6"),
    )
    words = text("What is left of F = ma is mass times acceleration, which the product rule takes apart:")
    items: list[Item] = [words, law]
    for c, found in _pairs(why):
        left = Product((SUM, MASS, Name("r", "i", 2), Partial(PLACE, c.symbol)))
        items.append(formula(left, short(why, found.inertia, LONG)))
    items.append(text("Both sums on the right are derivatives of the energy of step 2, ", T, ":"))
    if len(why.laws) > MOST_SUMMED:
        which = text("equation 7 is d/dt of this; for every coordinate")
        by_rate, by_place = Partial(T, Name("xi", "j", 1)), Partial(T, Name("xi", "j"))
        items.append(formula(Product((SUM, MASS, VELOCITY, BY_XI)), by_rate, note=which))
        items.append(formula(Product((SUM, MASS, VELOCITY, BY_RATE)), by_place, note=text("equation 8")))
    for c, found in _pairs(why):
        items += _sums(why, c, found)
    if any(m.turning for m in why.moving):
        items.append(
            text(
                "The sums run over all the mass of a body too: its centre of mass with m, and its turning with J about "
                "it, where the angular velocity ω takes the place of ",
                Name("r", "", 1),
                ", and ∂ω/∂",
                Name("xi", "j", 1),
                " that of ",
                Partial(Name("r"), Name("xi", "j")),
                ".",
            )
        )
    moved = Terms((Total(Partial(T, Name("xi", "j", 1))), Minus(Partial(T, Name("xi", "j")))))
    items += [
        text("So F = ma along a wiggle, with the forces that were described on the left, is"),
        formula(Product((SUM, Name("F", "i"), BY_XI)), moved, note=text("equation 9, with forces")),
    ]
    checks = (chain_check(why.context, why.laws), kinetic_check(why.context, why.laws))
    return Part(text("From accelerations to kinetic energy"), tuple(items), checks)


def _sums(why: Reasoning, c: Coordinate, found: Law) -> Iterator[Formula]:
    """Σ m ṙ·∂r/∂ξ = ∂T/∂ξ̇ and Σ m ṙ·∂ṙ/∂ξ = ∂T/∂ξ of one coordinate."""
    T = Name("T*")
    momentum = Product((SUM, MASS, VELOCITY, Partial(PLACE, c.symbol)))
    yield formula(
        momentum, Partial(T, c.rate), short(why, found.by_rate, LONG), note=text("equation 7 is d/dt of this")
    )
    slope = Product((SUM, MASS, VELOCITY, Partial(VELOCITY, c.symbol)))
    yield formula(slope, Partial(T, c.symbol), short(why, found.by_place, LONG), note=text("equation 8"))


# -- (10) to (12) ---------------------------------------------------------------------------------------------------


def forces(why: Reasoning) -> Part:
    """Σ F·∂r/∂ξ = −∂V/∂ξ + Ξ."""
    V, L = Name("V"), Name("L")
    stored = [e.title for e in elements(why, "V")]
    left = [e.title for e in elements(why, "Ξ")]
    items: list[Item] = []
    if stored:
        one = len(stored) == 1
        items.append(
            text(
                f"The force{'' if one else 's'} of {and_(stored)} {'has' if one else 'have'} a potential: the work in "
                "a wiggle is what ",
                V,
                " loses.",
            )
        )
        for c, found in _pairs(why):
            work = Product((SUM, Name("F", "i"), Partial(PLACE, c.symbol)))
            items.append(
                formula(work, Minus(Partial(V, c.symbol)), short(why, found.fall, LONG), note=text("equation 10"))
            )
    else:
        items.append(text("No force here has a potential, so ", V, " = 0."))
    if left:
        items.append(text(f"What is left is the work of {and_(left)}, and that is what ", Name("Xi"), " means:"))
        items += _left_over(why)
    else:
        items.append(text("No other force was described, so every ", Name("Xi", "j"), " is 0."))
    by_rate, by_place = Partial(L, Name("xi", "j", 1)), Partial(L, Name("xi", "j"))
    right: list[Left] = [Name("Xi", "j")]
    right += [Product((Name("A transposed"), Name("lambda vector")))] if why.derived.shares.rows else []
    items += [
        text("With ", L, " = ", Terms((Name("T*"), Minus(V))), " this is equation (12), one for every coordinate:"),
        formula(Terms((Total(by_rate), Minus(by_place))), Terms(tuple(right)), boxed=True),
    ]
    return Part(
        text("Potential energy, and what is left"),
        tuple(items),
        (potential_check(why.context, why.laws), work_check(why.context, why.laws)),
    )


def _left_over(why: Reasoning) -> Iterator[Formula]:
    for j, (c, found) in enumerate(_pairs(why)):
        work = Product((SUM, Name("F", "i"), Partial(PLACE, c.symbol)))
        yield formula(big_xi(j), work, short(why, found.Xi, LONG))


# -- numbers --------------------------------------------------------------------------------------------------------


def in_numbers(why: Reasoning) -> Part:
    """The constraint forces, their work, and both sides of the equations at a random state."""
    n, title = why.numbers, text("The same in numbers")
    if n is None:
        words = (
            "No state was found at which everything has a value and the constraints are independent, so there are no "
        )
        return Part(title, (text(f"{words}numbers here; what is marked as exact was decided without them."),))
    coordinates = why.derived.model.coordinates
    how = " that satisfies the constraints" if why.derived.shares.rows else ""
    words = (
        "Another route: positions differentiated twice by a computer algebra system, and the accelerations that solve "
        f"the equations of motion, at a random state{how}"
    )
    items: list[Item] = []
    if len(coordinates) > MOST_COORDINATES or len(why.moving) > 2 * MOST_LISTED:
        items.append(text(f"{words}. There are too many numbers to show; all of them were compared."))
    else:
        listed: list[str | Left] = []
        for c, acceleration in zip(coordinates, n.accelerations, strict=True):
            for symbol in (c.symbol, c.rate):
                listed += [", ", symbol, f" = {figure(n.state.get(symbol))}"]
            listed += [", ", c.acceleration, f" = {figure(acceleration)}"]
        items += [text(words, ": ", *listed[1:], "."), *_letters(why, n)]
        items.append(text("A force times ", Partial(PLACE, Name("xi", "j")), WORK_UNITS))
        items.append(_works(why, n))
    worst = f"to {min(n.digits, 50)} of 50 digits"
    what = text("F = ma, both sides of (3) to (12), and the work of the constraint forces")
    return Part(title, tuple(items), (Check(what, n.agree, f"agree {worst}; {AGREE} are asked for"),))


WORK_UNITS = " is in N if this coordinate is a length, and in N·m if it is an angle."


def _letters(why: Reasoning, n: NumbersAt) -> Iterator[Item]:
    """The values of the parameters and inputs, without which nobody could compute the numbers again."""
    known = [x for x in (*why.derived.model.parameters, *why.derived.model.inputs) if x.symbol in n.state]
    listed: list[str | Left] = []
    for x in known:
        measure = f" {unit(si_unit(x.unit) or x.unit)}" if x.unit else ""
        listed += [", ", x.symbol, f" = {figure(n.state[x.symbol])}{measure}"]
    if listed:
        yield text("The letters stand for ", *listed[1:], ".")


def _works(why: Reasoning, n: NumbersAt) -> Table:
    """The constraint force on every mass, and its work for every coordinate."""
    coordinates = why.derived.model.coordinates
    header = (
        text("constraint force on"),
        text("in the fixed axes [N]"),
        *(text(Product((FORCE, Partial(PLACE, c.symbol)))) for c in coordinates),
    )
    rows: list[tuple[Text, ...]] = []
    for m, R, works in zip(why.moving, n.reactions, n.works, strict=True):
        title = f"{capital(m.body.title)}{', moment [N m]' if m.turning else ''}"
        rows.append((text(title), text(f"({', '.join(map(figure, R))})"), *(text(figure(w)) for w in works)))
    if any(x.passed for x in n.laws):
        rows.append((text("less what is no constraint force"), text(""), *(text(figure(-x.passed)) for x in n.laws)))
    rows.append((text("sum"), text(""), *(text(figure(x.held - x.passed)) for x in n.laws)))
    if why.derived.shares.rows:
        rows.append((text("of the multipliers"), text(""), *(text(figure(x.rows)) for x in n.laws)))
    return Table(header, tuple(rows))


def figure(x: Any) -> str:
    """A number with five digits; what is zero but for rounding is 0."""
    if x is None:
        return "0"
    if abs(x) < 1e-25:
        return "0"
    return str(mpmath.nstr(x, 5, strip_zeros=False)).removesuffix(".0").replace("-", "−")


# -- what was spared ------------------------------------------------------------------------------------------------


def spared_part(why: Reasoning) -> Part:
    """The numbers of equations and unknowns by both ways, in the same coordinates."""
    s = why.spared
    m = s.multipliers
    free = text("free bodies: F = ma and the constraints" if m else "free bodies: F = ma")
    rows = (
        (free, text(str(s.equations)), text(_unknowns(s.accelerations, s.forces, "constraint force"))),
        (text("Lagrange"), text(str(s.coordinates + m)), text(_unknowns(s.coordinates, m, "multiplier"))),
    )
    items: list[Item] = [
        Table((text("way"), text("equations"), text("unknowns")), rows),
        text(f"Free bodies: {and_(_free_bodies(why))}. ", *_saved(s)),
        *_multiplied(why),
        *_known(why),
    ]
    return Part(text("What Lagrange spared you"), tuple(items))


def _free_bodies(why: Reasoning) -> list[str]:
    """How many equations each kind of body has, and every constraint."""
    s, plane = why.spared, why.derived.model.dimension == 2
    of: list[str] = []
    if s.particles:
        of.append(f"{2 if plane else 3} for each of {_counted(s.particles, 'particle')}")
    if s.rigid_bodies:
        of.append(f"{3 if plane else 6} for each of {_counted(s.rigid_bodies, 'rigid body', 'rigid bodies')}")
    if s.multipliers:
        of.append(f"{_counted(s.multipliers, 'equation')} of constraints")
    return of


def _saved(s: EquationCount) -> Iterator[str | Left]:
    """What is not needed by Lagrange's way."""
    if s.equations <= s.coordinates + s.multipliers:
        yield "So both ways have equally many equations and unknowns: Lagrange spares none of them here, but no free "
        yield "body has to be drawn."
        return
    yield "A part without mass, and a pin between two such parts, would add still more. By Lagrange no free body has "
    if s.multipliers:
        yield from ("to be drawn, and of ", Name("R"), " only what the multipliers tell is calculated.")
    else:
        yield from ("to be drawn, and ", Name("R"), " never has to be calculated.")


def _multiplied(why: Reasoning) -> Iterator[Item]:
    """What multipliers are, and what they are good for."""
    if not why.spared.multipliers:
        return
    named = and_([e.title for e in why.derived.model.constraints])
    one = why.spared.multipliers == 1
    known = "" if why.numbers is not None else " as far as the constraints do not repeat each other"
    tell = "The multiplier tells the force" if one else "The multipliers tell the forces"
    yield text(
        f"{tell} of {named}, so {'this is' if one else 'these are'} calculated with the motion{known}. In return "
        "the coordinates need not be independent, and no constraint has to be solved. Independent coordinates, where "
        f"they exist, or an elimination of the multiplier{'' if one else 's'} give fewer equations and no constraint "
        "force."
    )


def _known(why: Reasoning) -> Iterator[Item]:
    """Why fewer components of R are unknown than there are equations."""
    s, rods = why.spared, [hold for hold in why.holds if hold.kind == "rod"]
    components = s.equations - s.multipliers
    free = components - s.forces
    if not 0 < s.forces < components:
        return
    turns = " and the moments have" if s.rigid_bodies else " has"
    way = "the one way" if free == 1 else f"the {free} ways"
    only = (" This one is the pull ", Name("pull"), ".") if len(rods) == len(why.holds) == s.forces == 1 else ()
    yield text(
        Name("R"),
        f"{turns} {_counted(components, 'component')}. In {way} in which the masses can move, nothing holds them: so "
        f"{_counted(free, 'component')} {'is' if free == 1 else 'are'} known, and {s.forces} "
        f"{'is' if s.forces == 1 else 'are'} unknown.",
        *only,
    )


def _counted(number: int, what: str, many: str = "") -> str:
    return f"{number} {what if number == 1 else many or what + 's'}"


def _unknowns(accelerations: int, forces: int, what: str) -> str:
    more = f" and {forces} component{'s' if forces != 1 else ''} of constraint forces"
    if what == "multiplier":
        more = f" and {_counted(forces, what)}"
    return _counted(accelerations, "acceleration") + (more if forces else "")


def elements(why: Reasoning, ledger: str) -> list[Element]:
    """The elements that are counted in V, or in Ξ."""
    return [e for e in why.derived.model.elements if e.ledger == ledger]
