"""Finds systems without inertia, and charges that flow through no coil: nothing decides how fast currents change."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.errors import ModelError
from lagrangian.model.body_checks import ConstantValues
from lagrangian.model.elements import CircuitBranch, Element, Inductor, MutualInductance
from lagrangian.model.elements.base import error_of
from lagrangian.model.model import Model
from lagrangian.page.plain import plain


def check_inertia(name: str, elements: Sequence[Element]) -> None:
    """Raise an error for a system in which nothing has mass or inductance."""
    if any(e.ledger == "T*" for e in elements):
        return
    circuit = any(isinstance(e, CircuitBranch) for e in elements)
    raise ModelError(
        f"nothing in system '{name}' has {'inductance' if circuit else 'mass'}",
        fix="add an inductor: without one no current has inertia, and its equation is not one of motion"
        if circuit
        else "add a particle, a rigid_body or a kinetic energy",
        code="E201",
    )


def check_coils(model: Model) -> None:
    """Raise an error for an inductance that is not positive, and for a charge without any, by which M would be
    singular.

    With constraints, a charge may be carried along by others.
    """
    for element in model.branches:
        if isinstance(element, Inductor) and element.L is not None:
            _check_positive(ConstantValues.of_model(model).of(element.L), element)
        elif isinstance(element, MutualInductance):
            _check_shared(model, element)
    if model.constraints or not model.charges:
        return
    energies = [e.kinetic(model) for e in model.elements if e.ledger == "T*"]
    for c in model.charges:
        if not any(energy.has(c.rate) for energy in energies):
            raise ModelError(
                f"the circuit of charge '{c.name}' has no inductance: nothing decides how fast its current changes",
                place=c.place,
                fix=f"add an inductor that '{c.name}' flows through (leads have some), or eliminate '{c.name}': "
                "without a coil its equation gives the current, or the charge, from the other coordinates",
                code="E201",
            )


def _check_positive(value: float | None, element: Inductor) -> None:
    """Raise an error for a constant inductance that is not positive, as far as it is known."""
    if value is None or value > 0:
        return
    what = f"its inductance {plain(element.L)} is {'zero' if value == 0 else 'negative'}"
    fix = "give it an inductance above 0, or leave it out"
    raise error_of(element, what, fix=fix, code="E103" if value == 0 else "E102" if value < 0 else "E101")


def _check_shared(model: Model, element: MutualInductance) -> None:
    """Raise an error for M² ≥ L₁ L₂, as far as the values are known and the two coils carry just these charges."""
    numbers = ConstantValues.of_model(model)
    M = numbers.of(element.M)
    own = [
        [numbers.of(e.L) for e in model.branches if isinstance(e, Inductor) and e.L is not None and e.charge == charge]
        for charge in element.charges
    ]
    if M is None or not all(own) or any(L is None for listed in own for L in listed):
        return
    first, second = (sum(L for L in listed if L is not None) for listed in own)
    if first * second > M**2:
        return
    raise error_of(
        element,
        f"its mutual inductance is {M:g} H, but no coil sends more flux through another than √(L₁ L₂) = "
        f"{(first * second) ** 0.5:g} H allows",
        fix="give an M with M² below L₁ L₂",
        code="E203",
    )
