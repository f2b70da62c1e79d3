"""Dry friction, regime by regime: every friction slips in one sense or sticks, and nothing jumps.

    mode ±1:  Ξ += −F · (±1) − b δ̇ on δ̇          while ±δ̇ > 0
    mode  0:  the row δ̇ = 0 with its multiplier λ   while |λ| ≤ F_s

A regime is a model of its own, in which a friction that sticks is a constraint. What ends it are zeros of smooth
functions; a verdict on a state tells which regime follows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from lagrangian.dynamics.constrained import velocity_correction
from lagrangian.dynamics.feedback import SUPPLY, Feedback, with_feedback
from lagrangian.dynamics.impacts import Impact, impact_outputs
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.dynamics.observe import Observed
from lagrangian.dynamics.vectors import zeros
from lagrangian.errors import ModelError
from lagrangian.graph import Output, Program
from lagrangian.model import Friction, Model

DEPENDENT = 1e-9
"""A row whose margin is below this follows from others."""

Modes = tuple[int, ...]
"""A mode for every friction, in order: −1 or +1 while it slips in that sense, 0 while it sticks."""


def regime(model: Model, modes: Modes) -> Model:
    """The model in which every friction keeps its mode."""
    known: dict[Modes, Model] = model._memo.setdefault("regimes", {})
    if modes not in known:
        kept = dict(zip(model.frictions, modes, strict=True))
        elements = tuple(_kept(e, kept[e]) if isinstance(e, Friction) else e for e in model.elements)
        known[modes] = replace(model, elements=elements, _memo={})
    return known[modes]


def _kept(friction: Friction, mode: int) -> Any:
    return friction.slipping(mode) if mode else friction.sticking()


@dataclass(frozen=True)
class Watch:
    """What ends a regime: the number of a friction that comes to rest (``sense`` 0), or breaks away in a ``sense``."""

    friction: int
    sense: int


def watches(modes: Modes) -> tuple[Watch, ...]:
    """What may end a regime, in the order of `watched`."""
    found: list[Watch] = []
    for i, mode in enumerate(modes):
        found += [Watch(i, 0)] if mode else [Watch(i, -1), Watch(i, 1)]
    return tuple(found)


def watched(
    model: Model, modes: Modes, events: Sequence[Impact], feedback: Feedback, *, supply: bool, rest: float
) -> Program:
    """x, u, p, t → ``g``: the functions of ``events``, then those of `watches`, each of which falls through zero.

    They are ±δ̇ + rest for a friction that slips, F_s − λ and F_s + λ for one that sticks. ``rest`` is above 0, so that
    rounding at the start of a slip does not end it. With ``supply``, the last entry of x is the energy supplied.
    """
    seen = Observed(regime(model, modes))
    g = list(impact_outputs(seen, [(name, function, {}) for name, function, _ in events], supply)["g"].ids)
    graph, states = seen.graph, _states(seen, model, modes)
    for mode, state in zip(modes, states, strict=True):
        if mode:
            speed = state.rate if mode > 0 else graph.neg(state.rate)
            g.append(graph.add(speed, graph.const(rest)))
        else:
            g += [graph.sub(state.most, state.effort), graph.add(state.most, state.effort)]
    outputs = {"g": Output(tuple(g), (len(g),))}
    return with_feedback(seen, outputs, feedback, "ends of a regime", (SUPPLY,) if supply else ())


def verdict(model: Model, modes: Modes, feedback: Feedback) -> Program:
    """x, u, p, t → for every friction (k,): ``rate`` δ̇, ``change`` δ̈, ``effort`` on δ, ``least`` F and ``most`` F_s.

    ``effort`` is λ where it sticks. ``dv`` (nv,) is the least change of the velocities after which all rows hold, those
    of what sticks among them. ``dependent`` is the number of rows that follow from others there.
    """
    seen = Observed(regime(model, modes))
    m = seen.mechanics
    found = _states(seen, model, modes)
    changes = m.motion.second_rate([state.rate for state in found], seen.vdot)
    step = velocity_correction(m)
    columns: Mapping[str, Sequence[int]] = {
        "rate": [state.rate for state in found],
        "change": changes,
        "effort": [state.effort for state in found],
        "least": [state.least for state in found],
        "most": [state.most for state in found],
        "dv": zeros(seen.graph, len(m.v)) if step is None else step[0],
    }
    outputs = {name: Output(tuple(ids), (len(ids),)) for name, ids in columns.items()}
    outputs["dependent"] = Output((_dependent(m),), ())
    return with_feedback(seen, outputs, feedback, "verdict on friction")


def _dependent(m: Mechanics) -> int:
    """The number of rows whose margin is rounding."""
    g, total = m.graph, m.graph.zero
    for margin in m.constrained.margins if m.rows else ():
        total = g.add(total, g.select(g.lt(margin, g.const(DEPENDENT)), g.one, g.zero))
    return total


@dataclass(frozen=True)
class _State:
    """The nodes of one friction: δ̇, its effort, F and F_s."""

    rate: int
    effort: int
    least: int
    most: int


def _states(seen: Observed, model: Model, modes: Modes) -> list[_State]:
    """The frictions of a model in a regime, as nodes."""
    m, found = seen.mechanics, list[_State]()
    forces: dict[str, int] = {}
    if m.rows:
        solution, left_out = m.settled
        _check_split(model, modes, left_out)
        forces = {row.name: force for row, force in zip(m.rows, solution.multipliers, strict=True)}
    for friction, mode in zip(model.frictions, modes, strict=True):
        what = friction.title
        rate = friction.rate(seen.model)
        effort = seen.node(friction.slipping(mode).effort(seen.model, rate), what) if mode else forces[friction.name]
        found.append(
            _State(
                seen.node(rate, what),
                effort,
                seen.node(seen.model.expand(friction.slipping_limit), what),
                seen.node(seen.model.expand(friction.sticking_limit), what),
            )
        )
    return found


def _check_split(model: Model, modes: Modes, left_out: Sequence[str]) -> None:
    """Refuse frictions whose shares of one force cannot be told."""
    stuck = [f for f, mode in zip(model.frictions, modes, strict=True) if not mode]
    if stuck and left_out:
        names = " and ".join(f"'{name}'" for name in (*(f.name for f in stuck), *left_out))
        raise ModelError(
            f"when it sticks, it depends on other constraints: the share of each of {names} cannot be told",
            element=stuck[0].title,
            place=stuck[0].place,
            fix="describe frictions that act together as one, and none where a constraint prevents the slip",
            code="E310",
        )
