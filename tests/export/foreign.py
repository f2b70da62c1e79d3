"""Exports run by the programs they were written for, against the compiled code at random states."""

from __future__ import annotations

import functools
import pathlib
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

import built_in
from lagrangian import dynamics
from lagrangian.export.start import start_of
from lagrangian.graph import Program
from lagrangian.model import Model
from lagrangian.verify.foreign.checks import answers
from lagrangian.verify.foreign.runs import Answers, MissingError, stacked
from lagrangian.verify.on_rows import OnRows
from lagrangian.verify.states import State, cancelling, random_states

TOLERANCE = 1e-12
"""The largest difference of an export from the compiled code, relative to the largest term."""


@functools.cache
def states_of(name: str) -> tuple[State, ...]:
    """Random states of an example, on its constraints; its start if no random one can be moved there."""
    model = built_in.system(name).model
    found: list[State] = list(random_states(model, dynamics.forward(model), 4, 5))
    if model.constraints:
        rows = OnRows(model)
        found = [moved for state in found if (moved := rows.of(state)) is not None] or [_start(model)]
    return tuple(found)


def _start(model: Model) -> State:
    start, n = start_of(model), len(model.coordinates)
    v = list(start.x[n:])
    return {"q": list(start.x[:n]), "v": v, "a": v, "u": list(start.u), "p": list(start.p), "t": [start.t]}


@functools.cache
def compiled_answers(name: str) -> dict[str, list[Any]]:
    """The same outputs by the compiled code."""
    dyn = built_in.system(name).compile()
    at = stacked(states_of(name))
    q, v, a, u, p, t = (at[group] for group in ("q", "v", "a", "u", "p", "t"))
    rest: Any = {"u": u, "p": p, "t": t[:, 0]}
    still: Any = {"p": p, "t": t[:, 0]}
    found = {
        "forward": [dyn.forward(q, v, **rest)],
        "inverse": [dyn.inverse(q, v, a, **rest)],
        "mass_matrix": [dyn.mass_matrix(q, v=v, **still)],
        "energy": list(dyn.energies(q, v, **rest)),
        "rates": [dyn.rates(q, v)],
        "rhs": [dyn.rhs(t[:, 0], np.concatenate([q, v], axis=1), u=u, p=p)],
    }
    if built_in.system(name).model.constraints:
        rows = dyn.residual(q, v, **still)
        found["multipliers"] = [np.stack(list(dyn.multipliers(q, v, **rest).values()), axis=-1)]
        found["residual"] = [np.stack([*rows[kind].values()] or [t[:0]], axis=-1) for kind in ("position", "velocity")]
    return {name: [np.reshape(x, (len(t), -1)) for x in outputs] for name, outputs in found.items()}


def holds(name: str, target: str, folder: pathlib.Path) -> None:
    """Assert that an export gives the numbers of the compiled code; skip if nothing here runs it."""
    model = built_in.system(name).model
    try:
        made, found = answers(model, target, states_of(name), folder)
    except MissingError as missing:
        pytest.skip(str(missing))
    compare(name, made, found)


def compare(name: str, made: Mapping[str, Program], found: Answers) -> None:
    """Assert that the answers of an export are those of the compiled code."""
    model, states = built_in.system(name).model, states_of(name)
    assert set(found) <= set(made) and {"rhs", "energy"} <= set(found)
    assert ("multipliers" in found) == bool(model.constraints)
    expected = compiled_answers(name)
    for k, state in enumerate(states):
        M = expected["mass_matrix"][0][k].reshape(len(model.velocities), -1)
        for program, outputs in found.items():
            terms = np.ravel(cancelling(program, state, M))
            for wanted, got in zip(expected[program], outputs, strict=True):
                sizes = [np.abs(x).max(initial=0.0) for x in (wanted[k], terms)]
                if program == "residual":  # 0 on the constraints: the size of what cancels is that of the state
                    sizes.append(np.abs([*state["q"], *state["v"], *state["p"]]).max())
                off = np.abs(got[k] - wanted[k]).max(initial=0.0)
                assert off <= TOLERANCE * max(sizes), (name, program, off, max(sizes))
