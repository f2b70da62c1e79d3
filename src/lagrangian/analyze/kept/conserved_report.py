"""Conserved quantities as a report."""

from __future__ import annotations

from typing import Any

from lagrangian.analyze.kept.conserved import Conserved, ConservedQuantities
from lagrangian.analyze.report import Part, Report
from lagrangian.derive import Check
from lagrangian.derive.formula import Item, Name, Text, formula, text
from lagrangian.model import plain

KEPT = 1e-8
"""Drift along a run up to which a quantity counts as kept: the integrator's tolerance, not rounding alone."""

ROUNDING = 1e-10
"""Drift below which only rounding and the integrator's last digits tell runs apart."""


def conserved_report(found: ConservedQuantities) -> Report:
    """Return the report of what a system keeps."""
    parts = [_part(found, c) for c in found]
    items: list[Item] = [] if found else [text("Nothing was found that every motion keeps.")]
    items += [Text(("Not kept: ", *why.parts, ".")) for why in found.missed]
    if items:
        parts.append(Part(text("What is not kept"), tuple(items)))
    where = f" where {' = '.join((*found.vanishing, '0'))}" if found.vanishing else ""
    return Report(f"{found.model.name}: conserved quantities{where}", found.model, tuple(parts), data(found))


def _part(found: ConservedQuantities, c: Conserved) -> Part:
    every = f"any motion with constant {', '.join(c.while_constant)}" if c.while_constant else "any motion"
    checks = [Check(text(f"its rate along {every} is 0"), True, "exactly, in normal form")]
    if c.drift is not None:
        drift = f"drift below {ROUNDING:.0e}" if c.drift < ROUNDING else f"drift {c.drift:.1e}"
        checks.append(Check(text(f"along a run of {found.run:.3g} s"), c.drift < KEPT, drift))
    title = c.name[0].upper() + c.name[1:]
    items = (formula(c.expression, Name("constant")), Text(("Kept because ", *c.reason.parts, ".")))
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
