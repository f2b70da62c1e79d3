"""Feedback that is compiled in: inputs are replaced by expressions of time and state.

    ẋ = f(x, u, p, t),  u_k = g_k(x, t, p, the remaining inputs)

They are replaced in the graph, after the equations were solved for the accelerations, so an input remains an external
signal for everything that is differentiated.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from lagrangian.dynamics.observe import Observed, holds_acceleration, observed
from lagrangian.dynamics.power import balance, balance_terms, supplied
from lagrangian.dynamics.programs import _program
from lagrangian.errors import ModelError, did_you_mean
from lagrangian.graph import Output, Program, replaced
from lagrangian.model import Input, Model, Point, as_expr
from lagrangian.page.plain import plain

Feedback = Mapping[Any, sp.Expr]

SUPPLY = "∫ power"
"""The name of the state that contains the supplied energy; no coordinate can have this name."""


def closed(model: Model, feedback: Feedback, *, supply: bool = False) -> Program:
    """x, u, p, t → ẋ with the inputs in ``feedback`` (by symbol) replaced; the remaining inputs are the group u.

    With ``supply`` there is an additional state, the energy supplied since the start, ∫ (Ξ·q̇ − ∂L/∂t) dt (see
    `lagrangian.dynamics.power`), unless nothing can supply energy. Raises `ModelError` for keys that are not inputs,
    for circular inputs, and for accelerations in an expression, because these depend on the inputs (an algebraic loop).
    """
    seen = Observed(model)
    ids = [*seen.mechanics.motion.rates, *seen.vdot]
    names: tuple[str, ...] = ()
    if supply:
        power = supplied(seen)
        if power != seen.graph.zero:
            ids.append(power)
            names = (SUPPLY,)
    return with_feedback(seen, {"xdot": Output(tuple(ids), (len(ids),))}, feedback, "closed", names)


def observe_closed(model: Model, outputs: Mapping[str, sp.Expr | Point], feedback: Feedback) -> Program:
    """`observe` with inputs replaced as in `closed`; an input in ``feedback`` has the value of its expression."""
    seen = Observed(model)
    return with_feedback(seen, observed(seen, outputs), feedback, "observe")


def power_closed(model: Model, feedback: Feedback) -> Program:
    """`lagrangian.dynamics.power.power` with inputs replaced as in `closed`."""
    seen = Observed(model)
    return with_feedback(seen, balance(seen), feedback, "power")


def balance_terms_closed(model: Model, feedback: Feedback) -> Program:
    """`lagrangian.dynamics.power.balance_terms` with inputs replaced as in `closed`."""
    seen = Observed(model)
    return with_feedback(seen, balance_terms(seen), feedback, "balance terms")


def with_feedback(
    seen: Observed, outputs: Mapping[str, Output], feedback: Feedback, name: str, states: Sequence[str] = ()
) -> Program:
    """The program of ``outputs`` with inputs replaced; ``states`` are the names of states after [q; v]."""
    model, graph = seen.model, seen.graph
    free = [u for u in model.inputs if u.symbol not in feedback]
    known = {graph.input("u", k): graph.input("u", free.index(u)) for k, u in enumerate(model.inputs) if u in free}
    # free inputs first get their new places; what replaces an input is renumbered along with the rest
    for u, expr in _in_order(model, feedback):
        node = seen.node(expr, f"the input '{u.name}'")
        known[graph.input("u", model.inputs.index(u))] = replaced(graph, [node], known)[0]
    changed = {key: Output(tuple(replaced(graph, output.ids, known)), output.shape) for key, output in outputs.items()}
    made = _program(model, name, graph, changed, groups=("x",))
    groups = {**made.inputs, "x": (*made.inputs["x"], *states), "u": tuple(u.name for u in free)}
    return replace(made, inputs=groups)


def _in_order(model: Model, feedback: Feedback) -> list[tuple[Input, sp.Expr]]:
    """The replaced inputs with their expressions written out, each after those that it depends on."""
    inputs = {u.symbol: u for u in model.inputs}
    waiting: dict[Any, sp.Expr] = {}
    for symbol, given in feedback.items():
        if symbol not in inputs:
            name = plain(symbol) if isinstance(symbol, sp.Basic) else str(symbol)
            names = [u.name for u in model.inputs]
            fix = did_you_mean(name, names) or f"inputs: {', '.join(names) or 'none'}"
            raise ModelError(f"'{name}' is not an input of system '{model.name}'", fix=fix, code="E402")
        expr = model.expand(as_expr(given, f"the input '{inputs[symbol].name}'"))
        if holds_acceleration(expr, model):
            raise ModelError(
                f"the input '{inputs[symbol].name}' depends on an acceleration, which depends on the input",
                fix="feed back coordinates and rates; solve an algebraic loop by hand",
                code="E418",
            )
        waiting[symbol] = expr
    done: list[tuple[Input, sp.Expr]] = []
    while waiting:
        ready = [s for s, e in waiting.items() if not any(e.has(other) for other in waiting)]
        if not ready:
            circle = " → ".join(inputs[s].name for s in waiting)
            raise ModelError(f"inputs depend on each other in a circle: {circle}", code="E413")
        done += [(inputs[s], waiting.pop(s)) for s in ready]
    return done
