"""Random states of a model by the groups of its programs."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeAlias

import numpy as np
import sympy as sp

from lagrangian.derive.sample import without_value
from lagrangian.errors import ModelError
from lagrangian.graph import Program, evaluate
from lagrangian.model import Model, time
from lagrangian.records import dataclass

State: TypeAlias = Mapping[str, list[float]]
"""Values of the groups q, v, a, u, p and t."""

TRIES = 60
"""The number of random states without finite accelerations after which the search is abandoned."""


def evaluated(program: Program, state: Mapping[str, list[float]]) -> dict[str, Any]:
    """The outputs of a program at a state, by the slow evaluator."""
    return evaluate(program, {group: state[group] for group in program.inputs})


class Expected:
    """The outputs of programs by name at states, by the slow evaluator: each is computed once, however often asked."""

    def __init__(self, program: Callable[[str], Program]) -> None:
        self._program = program
        self._known: dict[tuple[str, int], tuple[State, dict[str, Any]]] = {}

    def at(self, name: str, state: State) -> dict[str, Any]:
        """The outputs of a program at a state."""
        key = name, id(state)  # the state is held beside its outputs, so that no other one gets its number
        if key not in self._known:
            whole = {**state, "x": [*state["q"], *state["v"]]}
            self._known[key] = state, evaluated(self._program(name), whole)
        return self._known[key][1]


def cancelling(name: str, state: State, M: Any) -> Any:
    """The size of the terms of a result at the rates and accelerations of a state, which may cancel to zero.

    The weight of a balanced wheel, for example, is the difference of two equal terms: only a rounding error, which is
    small compared with them.
    """
    a, v = np.array(state["a"]), np.array(state["v"])
    if name in ("forward", "rhs"):
        return a
    if name in ("inverse", "bias", "potential_force"):
        return M * a
    if name in ("energy", "T", "V"):
        return v @ M @ v
    return M if name == "coriolis" else np.zeros(0)


def relative(difference: Any, *terms: Any) -> float:
    """The largest entry of a difference relative to the largest of ``terms``; infinite if these are all 0."""
    off = float(np.max(np.abs(difference), initial=0.0))
    size = max((float(np.max(np.abs(x), initial=0.0)) for x in terms), default=0.0)
    return off and (off / size if size else np.inf)


def random_states(model: Model, forward: Program, count: int, seed: int) -> Iterator[dict[str, list[float]]]:
    """``count`` random states with finite accelerations; parameters keep their values.

    Quaternions may have any length; coordinates that are declared positive are. Raises `ModelError` if `TRIES` states
    have no finite accelerations.
    """
    source, missed = random.Random(seed), 0
    quaternions = {c.name for f in model.floating if f.floating is not None for c in f.floating.orientation}
    while count:
        state = {
            "q": [
                source.gauss() if c.name in quaternions else source.uniform(0.01 if c.positive else -1, 1)
                for c in model.coordinates
            ],
            "v": [source.uniform(-1, 1) for _ in model.velocities],
            "a": [source.uniform(-1, 1) for _ in model.velocities],
            "u": [source.uniform(-1, 1) for _ in model.inputs],
            "p": [source.uniform(0.4, 1.6) if p.value is None else p.value for p in model.parameters],
            "t": [source.uniform(0, 1)],
        }
        try:
            fine = np.isfinite(evaluated(forward, state)["a"]).all()
        except (ZeroDivisionError, ValueError, OverflowError):
            fine = False
        if fine:
            count -= 1
            yield state
        elif (missed := missed + 1) > TRIES:
            culprit = without_value(model, values=True)
            whose = f"{culprit.title} has no finite real value" if culprit else f"system '{model.name}' has none"
            raise ModelError(
                f"there are no finite accelerations at any of {TRIES} random states: {whose}",
                fix="check square roots, logarithms and divisions for arguments that are never allowed",
                code="E503",
            )


@dataclass(frozen=True, eq=False)
class NamedValues:
    """The values of a state by name: of coordinates and velocities, of parameters, and of inputs."""

    initial: dict[str, float]
    params: dict[str, float]
    inputs: dict[str, float]


def named_values(model: Model, state: State) -> NamedValues:
    """A state as verbs that start a run or linearize take it."""
    names = (*(c.name for c in model.coordinates), *(v.name for v in model.velocities))
    return NamedValues(
        dict(zip(names, (*state["q"], *state["v"]), strict=True)),
        {p.name: x for p, x in zip(model.parameters, state["p"], strict=True)},
        {u.name: x for u, x in zip(model.inputs, state["u"], strict=True)},
    )


def state_groups(model: Model, state: Mapping[sp.Basic, float]) -> dict[str, list[float]]:
    """A state as the groups of arguments of the programs of `dynamics`."""
    return {
        "q": [state[c.symbol] for c in model.coordinates],
        "v": [state[c.rate] for c in model.coordinates],
        "a": [state[c.acceleration] for c in model.coordinates],
        "u": [state[u.symbol] for u in model.inputs],
        "p": [state[p.symbol] for p in model.parameters],
        "t": [state[time]],
    }
