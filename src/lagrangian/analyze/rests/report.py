"""Rests as a report: a table of where and how stable, how well they balance, and what nothing depends on."""

from __future__ import annotations

from typing import Any

from lagrangian.analyze.figures import figure, scientific
from lagrangian.analyze.linear.report import symbol
from lagrangian.analyze.report import Part, Report
from lagrangian.analyze.rests.equilibria import Equilibria, Equilibrium
from lagrangian.analyze.rests.roots import EXACT
from lagrangian.derive.formula import Item, Table, text


def equilibria_report(found: Equilibria) -> Report:
    """Return the report of rests."""
    names = list(found.box)
    letters = [symbol(found.model, name) for name in names]
    items: list[Item] = []
    if found:
        header = (text(""), *(text(x) for x in letters), text("verdict"), text("starts"))
        rows = tuple(
            (
                text(str(k)),
                *(text(_shown(found, e, name)) for name in names),
                text(e.stability.verdict),
                text(str(e.starts) if e.starts else "–"),
            )
            for k, e in enumerate(found)
        )
        items.append(Table(header, rows))
        items += [
            text(f"{k}: {e.stability.reason[0].upper()}{e.stability.reason[1:]}.{_family(e)}")
            for k, e in enumerate(found)
        ]
        items.append(text(f"Forces balance there to {scientific(EXACT, 1)} of their own size in the box."))
    items += [text(note[0].upper() + note[1:] + ".") for note in found.notes]
    sides: list[Any] = []
    for name, letter in zip(names, letters, strict=True):
        low, high = found.box[name]
        sides += [", " if sides else "", letter, f" from {figure(low)} to {figure(high)}"]
    items.append(text(f"Sought from {found.starts} starts in the box ", *sides, "."))
    return Report(
        f"{found.model.name}: equilibria", found.model, (Part(text("Equilibria"), tuple(items)),), data(found)
    )


def _shown(found: Equilibria, e: Equilibrium, name: str) -> str:
    free = any(name in direction for direction in found.free) and name in found.held
    return "free" if free else figure(e.at[name]) + (" *" if name in e.moves else "")


def _family(e: Equilibrium) -> str:
    if not e.dimension:
        return ""
    what = "a curve" if e.dimension == 1 else f"a family of {e.dimension} dimensions"
    return f" One of {what} of rests along which {', '.join(e.moves)} (*) change."


def data(found: Equilibria) -> dict[str, Any]:
    """Rests as plain data."""
    return {
        "system": found.model.name,
        "equilibria": [
            {
                "at": dict(e.at),
                "inputs": dict(e.inputs),
                "parameters": dict(e.parameters),
                "residual": e.residual,
                "verdict": e.stability.verdict,
                "stable": e.stability.stable,
                "reason": e.stability.reason,
                "starts": e.starts,
                "family": {"dimension": e.dimension, "moves": list(e.moves)} if e.dimension else None,
            }
            for e in found
        ],
        "box": {name: list(side) for name, side in found.box.items()},
        "free": [dict(direction) for direction in found.free],
        "held": dict(found.held),
        "starts": found.starts,
        "sure": found.sure,
        "notes": list(found.notes),
    }
