"""A run in a few lines: how it went, and the initial, final, smallest and largest value of every state."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.cli.wording import in_options
from lagrangian.simulate import plot
from lagrangian.simulate.trajectory import Trajectory
from lagrangian.write import Title
from lagrangian.write.tables import Column

SPANS = 4
"""The largest number of spans of time of a friction that are listed."""


def summary(run: Trajectory) -> list[str]:
    """Return the summary as text, with angles in degrees and, below, in radians."""
    lines = [
        Title(f"{run.model.name}: t = {run.t[0]:g} … {run.t[-1]:g} s, {len(run.t)} samples"),
        f"  {run.method}: {run.steps} steps, {run.rejected} rejected, {run.nfev} evaluations",
        f"  {run.audit}",
        f"  {in_options(run.message)}",
        *(f"  {words}" for name, spans in run.stuck.items() for words in _friction(name, spans)),
        "",
    ]
    rows: list[tuple[str, ...]] = [("", "start", "end", "least", "greatest", "")]
    for column in _columns(run):
        numbers = np.array(list(plot.extremes(column.values)))
        if column.unit == "rad":  # degrees are easier to read; the SI values follow below
            rows.append((column.name, *(f"{x:.6g}" for x in np.degrees(numbers)), "deg"))
            rows.append(("", *(f"({x:.4g})" for x in numbers), "(rad)"))
        else:
            rows.append((column.name, *(f"{x:.6g}" for x in numbers), column.unit))
    wide = [max(len(row[k]) for row in rows) for k in range(6)]
    for row in rows:
        cells = [row[0].ljust(wide[0]), *(row[k].rjust(wide[k]) for k in range(1, 5)), row[5]]
        lines.append(("  " + "  ".join(cells)).rstrip())
    return lines


def _friction(name: str, spans: NDArray[np.float64]) -> list[str]:
    """How often a friction sticks and how long in all; below, the first and the last spans of time."""
    if not len(spans):
        return [f"friction '{name}' slips all the time"]
    listed = [f"{a:.5g} … {b:.5g}" for a, b in spans.tolist()]
    if len(listed) > SPANS:
        listed = [*listed[: SPANS - 1], "…", listed[-1]]
    often = "once" if len(spans) == 1 else f"{len(spans)} times"
    return [f"friction '{name}' sticks {often}, {np.sum(np.diff(spans)):.5g} s in all:", f"  {', '.join(listed)} s"]


def figures(run: Trajectory) -> dict[str, Any]:
    """Return the same as data, in SI units."""
    return {
        "name": run.model.name,
        "success": bool(run.success),
        "message": in_options(run.message),
        "notices": [str(notice) for notice in run.notices],
        "method": run.method,
        "start": float(run.t[0]),
        "end": float(run.t[-1]),
        "samples": len(run.t),
        "steps": int(run.steps),
        "rejected": int(run.rejected),
        "evaluations": int(run.nfev),
        "balance": {"kind": "energy" if run.audit.conserved else "power", "missed_by": float(run.audit.figure)},
        "stuck": {name: spans.tolist() for name, spans in run.stuck.items()},
        "columns": [
            {
                "name": c.name,
                "unit": c.unit,
                **dict(zip(("start", "end", "least", "greatest"), plot.extremes(c.values), strict=True)),
            }
            for c in _columns(run)
        ],
    }


def _columns(run: Trajectory) -> Iterator[Column]:
    shown = ("multiplier.", "reaction.")
    yield from (c for c in plot.table(run).columns if "." not in c.name or c.name.startswith(shown))
