"""Refuses what friction that sticks has no answer to: functions of the state alone."""

from __future__ import annotations

from lagrangian.advice import Advice, Verb
from lagrangian.errors import ModelError
from lagrangian.model.elements import Friction
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
        fix=advice_for(friction),
        code="E311",
    )


def advice_for(friction: Friction) -> str:
    """What to do where it must be known whether a friction slips or sticks, in Python or in its file."""
    regime = "; or a regime in which nothing jumps: "
    if friction.place is not None:
        sides = ", and side = 1 or -1, the sign of what presses" if len(friction.pressing) == 1 else ""
        return Advice(
            "use ",
            Verb("simulate"),
            " or ",
            Verb("sweep"),
            f"{regime}sense = 1 in [[friction]] while it slips and its deflection grows, -1 while it slips the other "
            f"way{sides}; while it sticks, in Python, system.regime({{'{friction.name}': 0}})",
        )
    first = f"use simulate, ensemble or sweep{regime}"
    if len(friction.pressing) == 1:
        (row,) = friction.pressing
        return (
            f"{first}regime({{'{friction.name}': 1, '{row}': 1}}) while it slips, its deflection grows and the "
            f"multiplier of '{row}' is positive, each -1 in the other sense; regime({{'{friction.name}': 0}}) while it "
            "sticks"
        )
    return (
        f"{first}regime({{'{friction.name}': 1}}) while it slips and its deflection grows, -1 while it slips the other "
        "way, 0 while it sticks"
    )
