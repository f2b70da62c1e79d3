"""Refuses what friction that sticks has no answer to: functions of the state alone."""

from __future__ import annotations

from lagrangian.errors import ModelError
from lagrangian.model.model import Model


def check_no_friction(model: Model, what: str) -> None:
    """Raise `ModelError` if a model has friction that sticks; ``what`` cannot be done then."""
    if not model.frictions:
        return
    friction = model.frictions[0]
    raise ModelError(
        f"it sticks or slips, and accelerations at rest are no smooth function of the state: {what}",
        element=friction.title,
        place=friction.place,
        fix="use simulate, ensemble or sweep; or a regime in which nothing jumps: "
        f"regime({{'{friction.name}': 1}}) while it slips and its deflection grows, -1 while it slips the other way, "
        "0 while it sticks",
        code="E311",
    )
