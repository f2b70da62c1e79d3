"""Checks as a report."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian import dynamics
from lagrangian.model import Model
from lagrangian.page.formula import Check, text
from lagrangian.page.report import Part, Report


def verification_report(model: Model, checks: Sequence[Check]) -> Report:
    """Return the report of the checks of a model, with its notices."""
    shown = [{"what": str(c.what), "holds": c.holds, "figure": c.figure} for c in checks]
    known = dynamics.notices(model)
    parts = [Part(text("What was checked"), (), tuple(checks))]
    if known:
        parts.append(Part(text("Notices"), tuple(text(f"{n.where}: {n.text}. [{n.code}]") for n in known)))
    data = {"checks": shown, "notices": [{"code": n.code, "where": n.where, "text": n.text} for n in known]}
    return Report(f"{model.name}: checked", model, tuple(parts), data)
