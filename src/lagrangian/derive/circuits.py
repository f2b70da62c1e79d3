"""What a derivation says of circuits: charges and currents, flux linkage, why T* is not T, and the words for them."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence

from lagrangian import bounded
from lagrangian.derive.context import Context, fit
from lagrangian.model import (
    Action,
    Capacitor,
    CircuitBranch,
    Coordinate,
    Element,
    Inductor,
    Model,
    MutualInductance,
    Resistor,
    Transducer,
)
from lagrangian.model.elements.branch import CURRENT_SYMBOL
from lagrangian.page.formula import (
    Item,
    Left,
    Minus,
    Name,
    Partial,
    Product,
    Square,
    Terms,
    Text,
    formula,
    text,
)

# -- words ----------------------------------------------------------------------------------------------------------


def has_coils(model: Model) -> bool:
    """Whether something stores energy by its current."""
    return any(isinstance(e, Inductor | MutualInductance) for e in model.elements)


def what_moves(model: Model) -> str:
    """What the rates determine: the velocities of all masses, the currents of all coils, or both."""
    if not has_coils(model):
        return "the velocities of all masses"
    return "the velocities of all masses and the currents of all coils" if model.bodies else "the currents of all coils"


def what_is_known(model: Model) -> str:
    """What the coordinates determine."""
    if not model.branches:
        return "the position of every mass"
    if not model.bodies:
        return "the charge that has flowed through every part of the circuit"
    return "the position of every mass and the charge that has flowed through every part of the circuit"


def without(model: Model) -> str:
    """What a combination of the coordinates cannot do."""
    if not has_coils(model):
        return "without moving a mass"
    return "without moving a mass or changing the current of a coil" if model.bodies else "without current in a coil"


def carried(model: Model, coordinate: Coordinate) -> str:
    """The elements that carry the current of a charge, in words."""
    found = [
        e.title for e in model.branches if any(model.expand(charge).has(coordinate.symbol) for charge in e.charges)
    ]
    return found[0] if len(found) == 1 else ", ".join(found[:-1]) + " and " + found[-1]


def reason_of(element: Element) -> str:
    """Why an element is in T*, in words."""
    if isinstance(element, Inductor | MutualInductance):
        return "stores energy by the current of a charge"
    return "has mass and moves"


UNMIXED = "With the velocity of the centre of mass and J about it, translation and rotation add without a mixed term."


def step_two(model: Model, turning: str = "½Jω²", velocities: str = UNMIXED) -> tuple[Text, Text]:
    """What step 2 does, and why; ``turning`` is the energy of a body that turns, ``velocities`` says what they are."""
    masses, turning = "Wrote ½mv² for every mass", f"{turning} for every body that turns"
    bodies = f"Every mass that moves stores kinetic co-energy. {velocities}"
    if not has_coils(model):
        return text(f"{masses} and {turning}, and added them up."), text(bodies)
    psi = Name("psi")
    coils = (
        "A coil stores energy by its current, the rate of a charge. Its flux linkage ",
        psi,
        " is to the current what a momentum is to a velocity, so it belongs here too.",
    )
    if not model.bodies:
        return text("Wrote the co-energy of every coil, the integral of ", psi, " over its current."), text(*coils)
    return text(f"{masses}, {turning} and the co-energy of every coil, and added them up."), text(bodies, " ", *coils)


def step_three(model: Model) -> tuple[Text, Text]:
    """What step 3 does, and why."""
    counted = (" Such forces are counted here and never again among the ", Name("Xi"), ".")
    first = "The work of a spring's force or of a weight depends only on where it starts and ends"
    if not model.branches:
        what = "Wrote ½k(Δx)² for every spring and mgh for every mass under gravity, and added them up."
        return text(what), text(f"{first}, so it is the difference of an energy.", *counted)
    what = "Wrote ½k(Δx)² for every spring, mgh for every mass under gravity and the energy of every capacitor."
    if not model.bodies:
        what = "Wrote the energy of every capacitor, the integral of its voltage over its charge."
        first = "The work of a capacitor's voltage depends only on the charge at the start and at the end"
        counted = (" Such voltages are counted here and never again among the ", Name("Xi"), ".")
    else:
        first += ", that of a capacitor's voltage only on the charge and the positions there"
    return text(what), text(f"{first}, so it is the difference of an energy.", *counted)


def nothing_stored(model: Model) -> Text:
    """Why V is 0."""
    lacking = ["no spring, no gravity"] if model.bodies or not model.branches else []
    lacking += ["no capacitor"] if model.branches else []
    by = "charge" if not model.bodies and model.branches else "position or charge" if model.branches else "position"
    return text(f"Nothing stores energy by its {by}: {', '.join(lacking)}.")


def nothing_acts(model: Model) -> str:
    """What would be in Ξ, if there were any."""
    if not model.branches:
        return "force, torque or damper"
    return "force, torque, damper, resistor or source" if model.bodies else "resistor or source"


def step_six(model: Model) -> tuple[Text, Text]:
    """What step 6 does, and why."""
    no_potential = ("They have no potential, so ", Name("V"), " does not contain them; ")
    twice = "add to every equation, twice: by virtual work and by the box."
    alone = "what they do to a coordinate is the work they do when it wiggles alone."
    if not model.branches:
        return text(f"Found what the forces, torques and dampers {twice}"), text(*no_potential, alone)
    acting = "resistors and sources" if not model.bodies else "forces, torques, dampers, resistors and sources"
    work = "A voltage does work on the charge that flows, as a force does on what it moves: u δq."
    return text(f"Found what the {acting} {twice}"), text(*no_potential, alone, " ", work)


def named_losses(elements: Sequence[Element]) -> str:
    """What a dissipation function is of, as a plural."""
    resistors = [e for e in elements if isinstance(e, Resistor)]
    if not resistors:
        return "dampers"
    return "resistors" if len(resistors) == len(elements) else "dampers and resistors"


def through(model: Model, element: Element, ends: Sequence[Action], index: int) -> Text | None:
    """The box rule in words for an element of a circuit: whether the charge flows through it; None for any other."""
    if not isinstance(element, CircuitBranch):
        return None
    c = model.coordinates[index]
    reached = [end for end in ends if bounded.diff(end.rate, c.rate) != 0]
    if not reached:
        return text(c.symbol, f" does not {'flow through' if c in model.charges else 'move'} it: it adds nothing")
    if isinstance(element, Transducer):
        if c in model.charges:
            return text(c.symbol, " flows through it: its back-emf opposes the motion's power")
        return text("it drives what moves with ", c.symbol, ": its effort is proportional to the current")
    if isinstance(element, Resistor):
        return text(c.symbol, " flows through it: its voltage opposes the current")
    return text(c.symbol, " flows through it: it drives the current")


def kirchhoff(model: Model) -> list[Item]:
    """What the equation of a charge means."""
    if not model.charges:
        return []
    listed: Sequence[str | Left] = [part for c in model.charges for part in (c.symbol, ", ")][:-1]
    one = len(model.charges) == 1
    return [
        text(
            f"{'A charge is a coordinate' if one else 'Charges are coordinates'}: ",
            *listed,
            f" [C], with {'its rate as the current' if one else 'their rates as the currents'} around "
            f"{'a loop' if one else 'loops'} of the circuit [A]. Kirchhoff's current law holds by this choice; his "
            f"voltage law is the equation that {'this coordinate' if one else 'each of them'} gets.",
        )
    ]


# -- coils ----------------------------------------------------------------------------------------------------------


def by_current(context: Context, element: Inductor | MutualInductance, name: Name) -> list[Item]:
    """The co-energy of a coil, or of what two coils share."""
    return _coil(context, element, name) if isinstance(element, Inductor) else _shared_flux(context, element, name)


def _coil(context: Context, element: Inductor, name: Name) -> list[Item]:
    """i, ψ and T* of a coil; of one that is not linear also T, with the reason for the star."""
    model = context.model
    current, psi = Name("current", name.index), Name("psi", name.index)
    flux, energy = (context.readable(x) for x in (element.flux(model), element.kinetic(model)))
    items: list[Item] = [formula(current, fit(context.readable(element.current(model))), note=text("current"))]
    if element.linear:
        L = context.readable(model.expand(element.L))
        items.append(formula(psi, Product((L, current)), fit(flux), note=text("flux linkage")))
        items.append(formula(name, Square(L / 2, (current,)), fit(energy)))
        return items
    items.append(formula(psi, fit(flux), note=text("flux linkage")))
    items.append(
        text("Its co-energy is the integral of ", psi, " over ", current, ", from 0, with all positions held:")
    )
    items.append(formula(name, fit(energy)))
    return [*items, *_star(context, element, name, psi, current)]


def _star(context: Context, element: Inductor, name: Name, psi: Name, current: Name) -> list[Item]:
    """T = ψ i − T*, and why Lagrange's equations need T*: ∂T*/∂i is ψ, ∂T/∂i is not."""
    model = context.model
    stored = Name("stored", name.index)
    slope = bounded.diff(element.flux_of_current(), CURRENT_SYMBOL)
    i = element.current(model)
    shown = context.readable(i * element.at_current(model, slope))
    return [
        text("The energy that is stored is what is left of ", Product((psi, current)), ":"),
        formula(
            stored,
            Terms((Product((psi, current)), Minus(name))),
            fit(context.readable(element.stored_energy(model))),
        ),
        text(
            stored,
            " differs from ",
            name,
            " because ",
            psi,
            " is not proportional to ",
            current,
            ". The voltage across the coil is the rate of ",
            psi,
            ", and only the slope of ",
            name,
            " is ",
            psi,
            ": Lagrange's equations need the co-energy. This is what the star is for.",
        ),
        formula(Partial(name, current), psi),
        formula(Partial(stored, current), fit(shown)),
    ]


def _shared_flux(context: Context, element: MutualInductance, name: Name) -> list[Item]:
    """T* = M i₁ i₂."""
    model = context.model
    first, second = context.readable(element.current(model)), context.readable(element.other_current(model))
    M = context.readable(model.expand(element.M))
    return [
        text("Through each of the two coils goes flux of the other: M times the other's current."),
        formula(name, Product((M, first, second))),
    ]


# -- capacitors -----------------------------------------------------------------------------------------------------


def capacitor(context: Context, element: Capacitor, name: Name) -> list[Item]:
    """V of a capacitor: the work of its voltage on its charge."""
    model = context.model
    voltage = Name("v", name.index)
    items: list[Item] = [
        formula(voltage, fit(context.readable(element.voltage(model))), note=text("voltage")),
        text("Its energy is the integral of the voltage over the charge, from 0, with all positions held:"),
        formula(name, fit(context.readable(element.potential(model)))),
    ]
    return items
