"""The energy T of a coil that saturates, or ½ ψ i, instead of its co-energy T*."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text(
    "The flux linkage ψ is the slope of the co-energy ∫ψ di, and the voltage across the coil is the rate of ψ. The "
    "energy ψ i − ∫ψ di has that slope only where ψ is proportional to i."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """T = ψ i − T*, or ½ ψ i as for a linear coil, for every coil whose flux linkage is not proportional to its
    current."""
    for coil in s.model.saturating:
        coenergy, stored = s.expand(coil.kinetic(s.model)), s.expand(coil.stored_energy(s.model))
        what = text(f"Of {coil.title} the energy that is stored is in ", Name("T*"), ", not its co-energy.")
        yield Variant(what=what, T=stored - coenergy, element=coil)
        half = s.expand(coil.flux(s.model) * coil.current(s.model)) / 2
        what = text(f"The co-energy of {coil.title} is taken as ½ψi, as if its flux linkage were proportional to i.")
        yield Variant(what=what, T=half - coenergy, element=coil)
