"""A sweep in a few lines: the smallest, mean and largest value of each result, and the varied values at the largest."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from lagrangian.cli.wording import in_options
from lagrangian.records import dataclass
from lagrangian.simulate.ensemble import Ensemble
from lagrangian.write import Title


@dataclass(frozen=True)
class _Result:
    """The statistics of one result over all runs, and the varied values at its maximum."""

    name: str
    least: float
    mean: float
    greatest: float
    where: dict[str, float]


def summary(runs: Ensemble) -> list[str]:
    """Return the summary as text."""
    axes = " × ".join(f"{d} ({n})" for d, n in zip(runs.dims, runs.shape, strict=True))
    lines: list[str] = [Title(f"{runs.name}: {runs.count} runs, {axes}, {runs.settings['method']}")]
    lines += [f"  {words}" for words in runs.endings]
    rows: list[list[str]] = [["", "least", "mean", "greatest", "where"]]
    for r in _results(runs):
        where = ", ".join(f"{n} = {x:.6g}" for n, x in r.where.items())
        rows.append([r.name, *(f"{x:.6g}" for x in (r.least, r.mean, r.greatest)), where])
    widths = [max(len(row[k]) for row in rows) for k in range(4)]
    for first, *cells, where in rows:
        shown = [cell.rjust(width) for cell, width in zip(cells, widths[1:], strict=True)]
        lines.append("  ".join([first.ljust(widths[0]), *shown, where]).rstrip())
    return lines


def figures(runs: Ensemble) -> dict[str, Any]:
    """Return the same as data."""
    return {
        "name": runs.name,
        "runs": int(runs.count),
        "axes": {str(d): int(n) for d, n in zip(runs.dims, runs.shape, strict=True)},
        "method": str(runs.settings["method"]),
        "endings": {words: int(n) for words, n in runs.counts.items()},
        "failed": int((runs.status < 0).sum()),
        "notices": [in_options(notice) for notice in runs.notices],
        "results": [asdict(r) for r in _results(runs)],
    }


def _results(runs: Ensemble) -> list[_Result]:
    found: list[_Result] = []
    for name in runs:
        values = runs[name]
        if name in ("status", "reached") or not np.isfinite(values).any():
            continue
        place = np.unravel_index(int(np.nanargmax(values)), values.shape)[: len(runs.shape)]
        where = {str(n): float(x) for n, x in runs.at(tuple(int(k) for k in place)).items()}
        least, mean, greatest = (float(f(values)) for f in (np.nanmin, np.nanmean, np.nanmax))
        found.append(_Result(name, least, mean, greatest, where))
    return found
