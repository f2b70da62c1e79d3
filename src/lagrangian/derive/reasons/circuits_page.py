"""Why Lagrange's equations hold for circuits: Kirchhoff's voltage law, and forces by an energy balance.

Two laws that know nothing of Lagrange are carried out on the system. Around a loop the voltages add up to zero. And the
power that a circuit gives to a coil, i dψ/dt, or to a capacitor, v dq/dt, is stored or does work on what moves: so the
force on a position x is ∂T*/∂x of a coil, and −∂V/∂x of a capacitor. Source: H. H. Woodson, J. R. Melcher,
Electromechanical Dynamics, Wiley 1968, sections 3.1 and 3.2.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.derive.algebra import Form
from lagrangian.derive.context import Context, fit, fit_terms
from lagrangian.derive.derived import Derived
from lagrangian.model import (
    Capacitor,
    CircuitBranch,
    Coordinate,
    Inductor,
    Model,
    MutualInductance,
    Resistor,
    Transducer,
    VoltageSource,
    time,
)
from lagrangian.page.formula import (
    Check,
    Heading,
    Item,
    Left,
    Minus,
    Name,
    Partial,
    Product,
    Total,
    formula,
    text,
)
from lagrangian.page.report import Part

EXACT = "exact"


def circuit_parts(d: Derived) -> tuple[Part, ...]:
    """The parts of the page: loops, forces, and both put together."""
    context: Context = d.shares.context
    return (_loops(d, context), _forces(d, context), _together(d, context))


# -- loops ----------------------------------------------------------------------------------------------------------


def voltages(model: Model, coordinate: Coordinate) -> Iterator[tuple[CircuitBranch, sp.Expr]]:
    """The voltages [V] around the loop of a charge, in its direction, that of a source with a minus."""
    q = coordinate.symbol
    for element in model.branches:
        turn = bounded.diff(element.flowed(model), q)
        if isinstance(element, MutualInductance):
            M, first, second = model.expand(element.M), element.current(model), element.other_current(model)
            other = bounded.diff(model.expand(element.other_charge), q)
            if turn != 0 or other != 0:
                yield element, turn * bounded.diff(M * second, time) + other * bounded.diff(M * first, time)
            continue
        if turn == 0:
            continue
        if isinstance(element, Inductor):
            yield element, turn * bounded.diff(element.flux(model), time)
        elif isinstance(element, Capacitor | Resistor):
            yield element, turn * element.voltage(model)
        elif isinstance(element, VoltageSource):
            yield element, -turn * model.expand(element.value)
        elif isinstance(element, Transducer):
            yield element, turn * model.expand(element.k) * bounded.diff(element.moved(model), time)


def _loops(d: Derived, context: Context) -> Part:
    """Σ v = 0 around every loop, and that it is the equation of its charge."""
    model = d.model
    items: list[Item] = [
        text(
            "Kirchhoff's voltage law: around a loop the voltages add up to zero. That of a coil is the rate of its "
            "flux linkage, that of a capacitor or resistor follows from its charge or current, a source has the "
            "opposite sign, and a winding that moves in a magnet's field has its back-emf:"
        )
    ]
    checks: list[Check] = []
    for index, c in enumerate(model.coordinates):
        if c not in model.charges:
            continue
        items.append(Heading(text("The loop of ", c.symbol)))
        around: list[Form] = []
        for element, voltage in voltages(model, c):
            around.append(context.form(voltage))
            items.append(formula(Name("v", element.name), fit(context.readable(voltage)), note=text(element.title)))
        total = context.algebra.total(around)
        held = context.algebra.total([row.pushes[index] for row in d.shares.rows])  # of constraints, if there are any
        items.append(formula(fit_terms(tuple(t.expr for t in context.terms(total))), fit(held.expr())))
        same = (total - _equation(d, context, index)).is_zero
        checks.append(Check(text("Kirchhoff's voltage law is the equation of ", c.symbol), same, EXACT))
    return Part(text("Kirchhoff's voltage law for every loop"), tuple(items), tuple(checks))


def _equation(d: Derived, context: Context, index: int) -> Form:
    """Left-hand side minus Ξ of a coordinate."""
    mine = [f.virtual for f in d.shares.forces if f.index == index]
    return d.shares.sides[index].whole - context.algebra.total(mine)


# -- forces ---------------------------------------------------------------------------------------------------------


def _forces(d: Derived, context: Context) -> Part:
    """F ẋ = i ψ̇ − Ṫ of a coil, v q̇ − V̇ of a capacitor: what is given and not stored does work."""
    model = d.model
    items: list[Item] = [
        text(
            "The power that a circuit supplies to a coil or a capacitor, voltage times current, is stored in it or "
            "does work on what moves. This energy balance gives the force on every position:"
        )
    ]
    checks: list[Check] = []
    idle: list[str] = []
    for element in model.elements:
        if isinstance(element, Inductor):
            given = element.current(model) * bounded.diff(element.flux(model), time)
            stored, energy = bounded.diff(element.stored_energy(model), time), element.kinetic(model)
        elif isinstance(element, MutualInductance):
            M, first, second = model.expand(element.M), element.current(model), element.other_current(model)
            given = first * bounded.diff(M * second, time) + second * bounded.diff(M * first, time)
            stored, energy = bounded.diff(element.kinetic(model), time), element.kinetic(model)
        elif isinstance(element, Capacitor):
            given = element.voltage(model) * element.current(model)
            stored, energy = bounded.diff(element.potential(model), time), -element.potential(model)
        else:
            continue
        if not any(_pulls(model, energy)):
            idle.append(element.title)
        else:
            items += _balance(context, element, given, stored, energy)
        work = [context.form(x * v) for _, x, v in _pulls(model, energy)]
        work.append(context.form(_by_time(energy)))  # what moves as prescribed does work too
        holds = (context.form(given - stored) - context.algebra.total(work)).is_zero
        name = "co-energy" if element.ledger == "T*" else "energy"
        checks.append(
            Check(
                text(f"{element.title}: the power supplied and not stored is the work of the slopes of its {name}"),
                holds,
                EXACT,
            )
        )
    if idle:
        listed = idle[0] if len(idle) == 1 else ", ".join(idle[:-1]) + " and " + idle[-1]
        do, it = ("does", "it") if len(idle) == 1 else ("do", "them")
        words = f"{listed} {do} not depend on a position: all the energy supplied to {it} is stored."
        items.append(text(words[0].upper() + words[1:]))
    if any(isinstance(e, Transducer) for e in model.branches):
        items.append(
            text(
                "A winding in a magnet's field stores nothing: its effort k i does the work k i ẋ that its back-emf "
                "k ẋ takes from the current."
            )
        )
    return Part(text("Power that is not stored does work"), tuple(items), tuple(checks))


def _by_time(energy: sp.Expr) -> sp.Expr:
    """∂/∂t of an energy, with coordinates and rates held."""
    atoms = sorted(energy.atoms(sp.Derivative), key=str) + sorted(energy.atoms(AppliedUndef), key=str)
    held = {x: sp.Dummy() for x in atoms}
    slope = bounded.diff(cast("sp.Expr", bounded.replaced(energy, held)), time)
    return cast("sp.Expr", bounded.replaced(slope, {dummy: x for x, dummy in held.items()}))


def _pulls(model: Model, energy: sp.Expr) -> Iterator[tuple[Coordinate, sp.Expr, sp.Expr]]:
    """The slopes of an energy by the positions, with their rates."""
    for c in model.coordinates:
        if c not in model.charges and (slope := bounded.diff(energy, c.symbol)) != 0:
            yield c, slope, c.rate


def _balance(
    context: Context, element: Inductor | MutualInductance | Capacitor, given: sp.Expr, stored: sp.Expr, energy: sp.Expr
) -> Iterator[Item]:
    """The power given, the power stored, and the forces."""
    coil = element.ledger == "T*"
    store = Name("stored" if coil else "V", element.name)
    current, voltage = Name("current", element.name), Name("v", element.name)
    left: Left = Product((current, Total(Name("psi", element.name)))) if coil else Product((voltage, current))
    yield Heading(text(element.title[:1].upper() + element.title[1:]))
    if not isinstance(element, MutualInductance):
        yield formula(left, fit(context.readable(given)), note=text("supplied by the circuit"))
        yield formula(Total(store), fit(context.readable(stored)), note=text("stored"))
    for c, slope, _ in _pulls(context.model, energy):
        by = Partial(Name("T*" if coil else "V", element.name), c.symbol)
        yield formula(
            Name("F", element.name),
            by if coil else Minus(by),
            fit(context.readable(slope)),
            note=text("what is left, divided by ", c.rate),
        )


# -- together -------------------------------------------------------------------------------------------------------


def _together(d: Derived, context: Context) -> Part:
    """The equation of every position is that of the bodies without the circuit, with the circuit's forces."""
    model = d.model
    places = [(i, c) for i, c in enumerate(model.coordinates) if c not in model.charges]
    if not places:
        words = "So all equations of this circuit are Kirchhoff's. With Lagrange you need no signs of voltages."
        return Part(text("Together"), (text(words),))
    items: list[Item] = [
        text(
            "For the bodies F = ma leads to Lagrange's equations as in every mechanical system; the page of the same "
            "system without its circuit shows it. The circuit acts on them with"
        )
    ]
    checks: list[Check] = []
    for index, c in places:
        pushed = _pushed(model, c)
        items.append(
            formula(Name("F", c.name), fit_terms(tuple(context.readable(x) for x in pushed)) if pushed else sp.S.Zero)
        )
        without = [part for share, part in d.shares.sides[index].parts if not isinstance(share.element, CircuitBranch)]
        acting = [f.virtual for f in d.shares.forces if f.index == index and not isinstance(f.element, CircuitBranch)]
        bodies = context.algebra.total(without) - context.algebra.total(acting)
        total = bodies - context.algebra.total([context.form(x) for x in pushed])
        same = (total - _equation(d, context, index)).is_zero
        checks.append(Check(text("the equation of ", c.symbol, " is that of the bodies with this force"), same, EXACT))
    return Part(text("Together"), tuple(items), tuple(checks))


def _pushed(model: Model, coordinate: Coordinate) -> Sequence[sp.Expr]:
    """The generalized forces of all circuit elements on a position, from the energy balance and k i."""
    found: list[sp.Expr] = []
    for element in model.branches:
        if isinstance(element, Transducer):
            arm = bounded.diff(element.moved(model), coordinate.symbol)
            found.append(model.expand(element.k) * element.current(model) * arm)
            continue
        energy = element.kinetic(model) if element.ledger == "T*" else -element.potential(model)
        found += [slope for c, slope, _ in _pulls(model, energy) if c is coordinate]
    return [x for x in found if x != 0]
