"""Events of a moving system: functions whose zeros are events, and the changes of the state there.

    g_k(x, u, p, t) = 0:  x⁺ = after_k(x⁻, u, p, t)

An impact replaces velocities, such as θ̇⁺ = −e θ̇⁻; everything that is not replaced stays the same.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp

from lagrangian.dynamics.feedback import SUPPLY, Feedback, with_feedback
from lagrangian.dynamics.observe import Observed
from lagrangian.errors import ModelError, did_you_mean
from lagrangian.graph import Output, Program
from lagrangian.model import Model
from lagrangian.page.plain import plain

Impact = tuple[str, sp.Expr, Mapping[Any, sp.Expr]]
"""An event: its name, its function, and state → value after it."""


def impacts(model: Model, events: Sequence[Impact], feedback: Feedback, *, supply: bool = False) -> Program:
    """x, u, p, t → ``g`` (ne,) and, if an event changes the state, ``after`` (ne, nx): the state after event k.

    With ``supply``, the last entry of x is the supplied energy (`lagrangian.dynamics.feedback`), which no event
    changes. Raises `ModelError` for unknown symbols, and for keys that are not states.
    """
    seen = Observed(model)
    return with_feedback(seen, impact_outputs(seen, events, supply), feedback, "events", (SUPPLY,) if supply else ())


def impact_outputs(seen: Observed, events: Sequence[Impact], supply: bool) -> dict[str, Output]:
    """``g`` and ``after`` as outputs over [q; v] and, with ``supply``, the supplied energy."""
    model, motion = seen.model, seen.mechanics.motion
    states: dict[Any, int] = {c.symbol: i for i, c in enumerate(model.coordinates)}
    states.update({v.symbol: len(model.coordinates) + i for i, v in enumerate(model.velocities)})
    before = [*motion.q, *motion.v, *([seen.graph.input("x", len(states))] if supply else [])]
    g, rows = [], []
    for name, function, reset in events:
        g.append(seen.node(function, f"event '{name}'"))
        row = list(before)
        for state, value in reset.items():
            if state not in states:
                raise _no_state(name, state, list(states))
            row[states[state]] = seen.node(value, f"'{plain(state)}' after event '{name}'")
        rows.append(row)
    outputs = {"g": Output(tuple(g), (len(g),))}
    if any(reset for _, _, reset in events):
        outputs["after"] = Output(tuple(x for row in rows for x in row), (len(rows), len(before)))
    return outputs


def _no_state(event: str, state: Any, states: Sequence[Any]) -> ModelError:
    shown = plain(state) if isinstance(state, sp.Basic) else str(state)
    known = [plain(s) for s in states]
    fix = did_you_mean(shown, known) or f"states: {', '.join(known[:12])}"
    return ModelError(f"event '{event}' sets '{shown}', which is not a state", fix=fix, code="E402")
