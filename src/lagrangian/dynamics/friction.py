"""Dry friction, regime by regime: every friction slips in one sense or sticks, and nothing jumps.

    mode ±1:  Ξ += −F · (±1) − b δ̇ on δ̇          while ±δ̇ > 0
    mode  0:  the row δ̇ = 0 with its multiplier λ   while |λ| ≤ F_s
    side ±1:  |λ_N| = ±λ_N of a row that presses on friction, F = μ |λ_N|, while ±λ_N ≥ 0

A regime is a model of its own, in which a friction that sticks is a constraint. What ends it are zeros of smooth
functions; a verdict on a state tells which regime follows.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from lagrangian.dynamics.constrained import velocity_correction
from lagrangian.dynamics.drags import undetermined
from lagrangian.dynamics.feedback import SUPPLY, Feedback, with_feedback
from lagrangian.dynamics.impacts import Impact, impact_outputs
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.dynamics.observe import Observed
from lagrangian.dynamics.vectors import zeros
from lagrangian.errors import ModelError
from lagrangian.graph import Output, Program
from lagrangian.model import Friction, Model
from lagrangian.model.rows import pressed_rows, pressing_rows
from lagrangian.records import dataclass

DEPENDENT = 1e-9
"""A row whose margin is below this follows from others."""

LEAST_REGULARITY = 1e-6
"""Friction that determines what presses on it less than this is a paradox."""

Modes = tuple[int, ...]
"""A mode for every friction, in order: −1 or +1 while it slips in that sense, 0 while it sticks; then a side for every
row that presses, the sign ±1 of its multiplier, in the order of `pressed_rows`."""


def regime(model: Model, modes: Modes) -> Model:
    """The model in which every friction keeps its mode, and every row that presses its side."""
    known: dict[Modes, Model] = model._memo.setdefault("regimes", {})
    if modes not in known:
        kept = dict(zip(model.frictions, _sided(model, modes), strict=True))
        elements = tuple(kept[e] if isinstance(e, Friction) else e for e in model.elements)
        known[modes] = replace(model, elements=elements, _memo={})
    return known[modes]


def slips(model: Model) -> Model:
    """The model itself, or where a multiplier presses on friction a regime of it, whose states have the same names."""
    if not pressing_rows(model):
        return model
    return regime(model, (1,) * (len(model.frictions) + len(pressed_rows(model))))


def _sided(model: Model, modes: Modes) -> list[Any]:
    """The frictions in their modes."""
    on = [f.on_side(side) if side else f for f, side in _sides(model, modes)]
    return [f.slipping(mode) if mode else f.sticking() for f, mode in zip(on, modes, strict=False)]


def _sides(model: Model, modes: Modes) -> list[tuple[Friction, int]]:
    """The frictions with the sides of what presses on them, 0 where that is not one multiplier."""
    sides = dict(zip(pressed_rows(model), modes[len(model.frictions) :], strict=True))
    return [(f, sides[f.pressing[0]] if len(f.pressing) == 1 else 0) for f in model.frictions]


@dataclass(frozen=True)
class Watch:
    """What ends a regime: the number of a friction that comes to rest (``sense`` 0), or breaks away in a ``sense``; the
    number of a row that presses, counted on, whose multiplier changes its sign; ``friction`` −1: a paradox."""

    friction: int
    sense: int = 0


PARADOX = Watch(-1)
"""Friction and the force that presses on it do not determine each other any more."""


def watches(model: Model, modes: Modes) -> tuple[Watch, ...]:
    """What may end a regime, in the order of `watched`."""
    found: list[Watch] = []
    for i, mode in enumerate(modes):
        found += [Watch(i)] if mode else [Watch(i, -1), Watch(i, 1)]
    return (*found, PARADOX) if pressing_rows(model) else tuple(found)


def watched(
    model: Model, modes: Modes, events: Sequence[Impact], feedback: Feedback, *, supply: bool, rest: float
) -> Program:
    """x, u, p, t → ``g``: the functions of ``events``, then those of `watches`, each of which falls through zero.

    They are ±δ̇ + rest for a friction that slips, F_s − λ and F_s + λ for one that sticks, ±λ_N + rest of a row that
    presses. ``rest`` is above 0, so that rounding at the start of a slip does not end it. With ``supply``, the last
    entry of x is the energy supplied.
    """
    seen = Observed(regime(model, modes))
    g = list(impact_outputs(seen, [(name, function, {}) for name, function, _ in events], supply)["g"].ids)
    graph, states = seen.graph, _states(seen, model, modes)
    for mode, state in zip(modes, states, strict=False):
        if mode:
            speed = state.rate if mode > 0 else graph.neg(state.rate)
            g.append(graph.add(speed, graph.const(rest)))
        else:
            g += [graph.sub(state.most, state.effort), graph.add(state.most, state.effort)]
    g += [graph.add(force, graph.const(rest)) for force in _normals(seen, model, modes)]
    if pressing_rows(model):
        g.append(graph.sub(_regularity(seen.mechanics), graph.const(LEAST_REGULARITY)))
    outputs = {"g": Output(tuple(g), (len(g),))}
    return with_feedback(seen, outputs, feedback, "ends of a regime", (SUPPLY,) if supply else ())


def verdict(model: Model, modes: Modes, feedback: Feedback) -> Program:
    """x, u, p, t → for every friction (k,): ``rate`` δ̇, ``change`` δ̈, ``effort`` on δ, ``least`` F and ``most`` F_s.

    ``effort`` is λ where it sticks. ``dv`` (nv,) is the least change of the velocities after which all rows hold, those
    of what sticks among them. ``dependent`` is the number of rows that follow from others there. For every row that
    presses ``normal`` is |λ_N|, below 0 on the wrong side; ``regularity`` is above 0 as long as friction and what
    presses on it determine each other (`drags`).
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
    normals = _normals(seen, model, modes)
    outputs["normal"] = Output(tuple(normals), (len(normals),))
    outputs["regularity"] = Output((_regularity(m),), ())
    return with_feedback(seen, outputs, feedback, "verdict on friction")


def _normals(seen: Observed, model: Model, modes: Modes) -> list[int]:
    """±λ_N of the rows that press, on their sides."""
    rows, g = pressed_rows(model), seen.graph
    if not rows:
        return []
    known = {row.name: x for row, x in zip(seen.mechanics.rows, seen.mechanics.constrained.multipliers, strict=True)}
    sides = modes[len(model.frictions) :]
    return [known[row] if side > 0 else g.neg(known[row]) for row, side in zip(rows, sides, strict=True)]


def _regularity(m: Mechanics) -> int:
    """The least determinant of the equations for what presses on friction; 1 if nothing does."""
    pressing = m.constrained.pressing if m.rows else None
    return m.graph.one if pressing is None else pressing.regularity()


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
    for (given, side), mode in zip(_sides(model, modes), modes, strict=False):
        friction = given.on_side(side) if side else given
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


def _check_split(model: Model, modes: Modes, left_out: Iterable[str]) -> None:
    """Refuse frictions whose shares of one force cannot be told."""
    stuck = [f for f, mode in zip(model.frictions, modes, strict=False) if not mode]
    for f in model.frictions:
        for row in set(f.pressing).intersection(left_out):
            raise undetermined(row, f)
    if stuck and left_out:
        names = " and ".join(f"'{name}'" for name in (*(f.name for f in stuck), *left_out))
        raise ModelError(
            f"when it sticks, it depends on other constraints: the share of each of {names} cannot be told",
            element=stuck[0].title,
            place=stuck[0].place,
            fix="describe frictions that act together as one, and none where a constraint prevents the slip",
            code="E310",
        )
