"""The conserved quantities as a report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp

from lagrangian.errors import listed
from lagrangian.model import Model
from lagrangian.page.formula import Check, Item, Name, Text, formula, text
from lagrangian.page.plain import plain
from lagrangian.page.report import Part, Report
from lagrangian.records import dataclass
from lagrangian.viewed import Brief
from lagrangian.write.written import Written

KEPT = 1e-8
"""A quantity counts as conserved if its drift is at most this: the integrator's tolerance, not only rounding."""

ROUNDING = 1e-10
"""Below this drift, runs differ only by rounding and the last digits of the integrator."""


@dataclass(frozen=True)
class Conserved(Brief):
    """A quantity that is constant along every motion.

    ``kind``: "energy", "momentum" (of one ignorable coordinate), "total momentum" (a shift of several coordinates),
    "turn" (a direction that depends on the coordinates, such as the angular momentum of x and y), "mixed" (combined
    with energy, as when a potential rotates at a constant rate: Jacobi's integral). ``expression`` is the quantity.
    ``direction`` is the displacement of every coordinate that changes nothing (empty for the energy). ``while_zero``
    are the inputs that must be 0; ``while_constant`` are those that must not change, such as a road height in a
    spring's energy. ``drift`` is the largest change along a run relative to the size of the quantity, None if there was
    no run.
    """

    name: str
    kind: str
    expression: sp.Expr
    direction: Mapping[sp.Expr, sp.Expr]
    while_zero: tuple[str, ...]
    reason: Text
    drift: float | None = None
    while_constant: tuple[str, ...] = ()

    def __str__(self) -> str:
        """Return the quantity as one line."""
        only = condition(self.while_zero, self.while_constant)
        return f"{self.name}: {plain(self.expression)}{' ' + only if only else ''}"


@dataclass(frozen=True, eq=False)
class ConservedQuantities(Written, Sequence[Conserved]):
    """The conserved quantities; ``missed`` says why others are not conserved; ``run`` is the length of the run [s].

    ``vanishing`` are the parameters that were given as 0.
    """

    model: Model
    found: tuple[Conserved, ...]
    missed: tuple[Text, ...]
    run: float | None
    vanishing: tuple[str, ...] = ()

    def __getitem__(self, index: Any) -> Any:
        """The quantity with an index."""
        return self.found[index]

    def __len__(self) -> int:
        """The number of quantities."""
        return len(self.found)

    def report(self) -> Report[Model]:
        """Return the report."""
        return conserved_report(self)


def condition(zero: Sequence[str], constant: Sequence[str]) -> str:
    """``while F is 0 and z is constant``, or an empty text."""
    pairs = ((zero, "0"), (constant, "constant"))
    parts = [f"{listed(names)} {'is' if len(names) == 1 else 'are'} {what}" for names, what in pairs if names]
    return "while " + " and ".join(parts) if parts else ""


def conserved_report(found: ConservedQuantities) -> Report[Model]:
    """Return the report of conserved quantities."""
    parts = [_part(found, c) for c in found]
    items: list[Item] = [] if found else [text("No conserved quantity was found.")]
    items += [Text(("Not conserved: ", *why.parts, ".")) for why in found.missed]
    if items:
        parts.append(Part(text("Not conserved"), tuple(items)))
    where = f" where {' = '.join((*found.vanishing, '0'))}" if found.vanishing else ""
    return Report(f"{found.model.name}: conserved quantities{where}", found.model, tuple(parts), data(found))


def _part(found: ConservedQuantities, c: Conserved) -> Part:
    every = f"any motion with constant {', '.join(c.while_constant)}" if c.while_constant else "any motion"
    checks = [Check(text(f"its rate along {every} is 0"), True, "exactly, in normal form")]
    if c.drift is not None:
        drift = f"drift below {ROUNDING:.0e}" if c.drift < ROUNDING else f"drift {c.drift:.1e}"
        checks.append(Check(text(f"it stays constant along a run of {found.run:.3g} s"), c.drift < KEPT, drift))
    title = c.name[0].upper() + c.name[1:]
    items = (formula(c.expression, Name("constant")), Text(("Conserved because ", *c.reason.parts, ".")))
    return Part(text(title), items, tuple(checks))


def data(found: ConservedQuantities) -> dict[str, Any]:
    """Conserved quantities as plain data."""
    return {
        "system": found.model.name,
        "vanishing": list(found.vanishing),
        "conserved": [
            {
                "name": c.name,
                "kind": c.kind,
                "expression": plain(c.expression),
                "direction": {plain(q): plain(d) for q, d in c.direction.items()},
                "while_zero": list(c.while_zero),
                "while_constant": list(c.while_constant),
                "reason": str(c.reason),
                "drift": c.drift,
            }
            for c in found
        ],
        "missed": [str(why) for why in found.missed],
        "run": found.run,
    }
