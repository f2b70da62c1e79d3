"""Checks as a report."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian import dynamics
from lagrangian.model import Model
from lagrangian.page.formula import Check, text
from lagrangian.page.report import Part, Report
from lagrangian.verify.foreign.checks import RUNNERS

NEVER = (
    "The pixels of PNG, GIF and videos, which show what SVG shows, labels of pictures, plots, and what is written on "
    "pages beside equations and values: the tests of this package check them, with other systems than this."
)
"""What no check is made of."""


def left_out(exports: bool) -> tuple[str, ...]:
    """What the checks do not look at, with or without the exports to other programs."""
    more = (
        f"Exports to {', '.join(RUNNERS)}, the files of runs, stores of sweeps, the printed checklist, worksheets, "
        "pictures, animations and the page that moves: verify(exports=True) and `lagrangian verify --exports` look at "
        "them."
    )
    return (NEVER,) if exports else (more, NEVER)


def verification_report(model: Model, checks: Sequence[Check], *, exports: bool = False) -> Report:
    """Return the report of the checks of a model, with its notices, and with what they did not look at."""
    shown = [{"what": str(c.what), "holds": c.holds, "figure": c.figure} for c in checks]
    known = dynamics.notices(model)
    parts = [Part(text("What was checked"), (), tuple(checks))]
    if known:
        parts.append(Part(text("Notices"), tuple(text(f"{n.where}: {n.text}. [{n.code}]") for n in known)))
    unseen = left_out(exports)
    parts.append(Part(text("What was not looked at"), tuple(text(line) for line in unseen)))
    noted = [{"code": n.code, "where": n.where, "text": n.text} for n in known]
    data = {"checks": shown, "notices": noted, "not_looked_at": list(unseen)}
    return Report(f"{model.name}: checked", model, tuple(parts), data)
