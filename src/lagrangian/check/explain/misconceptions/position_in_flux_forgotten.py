"""The voltage of a coil, or the energy of a capacitor, without what it owes to a position that changes."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.model import Capacitor, Inductor
from lagrangian.page.formula import text

STEP = 5
WHY = text(
    "An energy that depends on a charge or a current and on a position has slopes by both: the voltage in the circuit "
    "and the force on what moves follow from the same T* or V."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Of a coil with L(x): dψ/dt without ∂ψ/∂x ẋ, and no force; of a capacitor with C(x): no force."""
    charges = {c.symbol for c in s.model.charges}
    for element in s.model.branches:
        if not isinstance(element, Inductor | Capacitor):
            continue
        coil = isinstance(element, Inductor)
        energy = s.expand(element.kinetic(s.model) if coil else -element.potential(s.model))
        for i, q in enumerate(s.q):
            if q in charges or (force := bounded.diff(energy, q)) == 0:
                continue
            what = text(f"The force of {element.title} on ", q, " is missing.")
            yield Variant(what=what, rows={i: force}, element=element, coordinate=i)
        if isinstance(element, Inductor):
            flux = s.expand(element.flux(s.model))
            moved = sum((bounded.diff(flux, q) * v for q, v in zip(s.q, s.v, strict=True)), start=flux * 0)
            sign = {i: s.expand(element.current(s.model)).diff(v) for i, v in enumerate(s.v)}
            rows = {i: -moved * x for i, x in sign.items() if x != 0}
            if moved != 0:
                what = text(f"The voltage of {element.title} lacks the rate of its flux linkage by position.")
                yield Variant(what=what, rows=rows, element=element)
