"""The checks of exports that other programs run: whether each gives the numbers of the slow evaluation."""

from __future__ import annotations

import logging
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np

from lagrangian.export import programs, targets
from lagrangian.graph import Program
from lagrangian.model import Model
from lagrangian.page.formula import Check, text
from lagrangian.verify.foreign.fmus import fmu_answers
from lagrangian.verify.foreign.julia import julia_answers
from lagrangian.verify.foreign.modelica import modelica_answers
from lagrangian.verify.foreign.octave import octave_answers
from lagrangian.verify.foreign.python_modules import casadi_answers, jax_answers
from lagrangian.verify.foreign.runs import Answers, Array, MissingError, RefusedError
from lagrangian.verify.states import State, cancelling, evaluated, relative

_log = logging.getLogger(__name__)

TOLERANCE = 1e-9
"""Two numbers are equal if their difference, relative to the largest term of the output, is at most this."""

STEM = "exported"

Runner: TypeAlias = Callable[
    [Mapping[str, Program], Mapping[str, str | bytes], str, Sequence[State], Path],
    Answers,
]
"""Runs exported files at all states: programs, files, their stem, states, and an empty folder."""

RUNNERS: dict[str, tuple[str, Runner]] = {
    "matlab": ("Octave", octave_answers),
    "jax": ("JAX", jax_answers),
    "casadi": ("CasADi", casadi_answers),
    "julia": ("Julia", julia_answers),
    "modelica": ("Rumoca", modelica_answers),
    "fmu2": ("FMPy", fmu_answers),
    "fmu3": ("FMPy", fmu_answers),
}
"""Target → the program that runs it, and how."""


NOT_RUN: dict[str, str] = {
    "wasm": "by itself: the check below of the page that moves runs it",
    "simulink": "S-functions run in Simulink alone",
}
"""Targets that are run by nothing here, and why."""


def answers(model: Model, target: str, states: Sequence[State], folder: Path) -> tuple[dict[str, Program], Answers]:
    """Export a model, and return its programs with what the other program makes of them at all states.

    Raises `MissingError` if that program is not installed, and `RefusedError` with its message.
    """
    names = programs.exported(model, whole=targets.TARGETS[target].whole)
    made = {name: programs.program_of(model, name) for name in names}
    files = targets.exported_files(model, target, STEM)
    return made, RUNNERS[target][1](made, files, STEM, states, folder)


def foreign_checks(model: Model, states: Sequence[State], wanted: Sequence[str] = tuple(RUNNERS)) -> tuple[Check, ...]:
    """Return a check for each target in ``wanted``; ``holds`` is None where its program is not installed."""
    return tuple(_check(model, target, states) for target in wanted)


def not_run() -> tuple[Check, ...]:
    """Return what no check is made of, so that nobody takes it for checked."""
    return tuple(
        Check(text(f"the export to {target} gives the same numbers"), None, f"not checked: {why}")
        for target, why in NOT_RUN.items()
    )


def _check(model: Model, target: str, states: Sequence[State]) -> Check:
    program = RUNNERS[target][0]
    what = text(f"the export to {target} gives the same numbers, run by {program}")
    _log.info("verifying: the export to %s", target)
    with tempfile.TemporaryDirectory(prefix="lagrangian-", ignore_cleanup_errors=True) as folder:
        try:
            made, found = answers(model, target, states, Path(folder))
        except MissingError as error:
            return Check(what, None, f"not checked: {error}")
        except RefusedError as error:
            return Check(what, False, f"{program} refuses it: {error}")
    worst = largest_difference(made, found, states)
    n = f"{len(states)} random state{'s' if len(states) != 1 else ''}"
    return Check(what, worst < TOLERANCE, f"largest relative difference {worst:.1e} at {n}")


def largest_difference(made: Mapping[str, Program], found: Answers, states: Sequence[State]) -> float:
    """The largest difference from the slow evaluation, relative to the largest term of an output."""
    worst = 0.0
    for k, state in enumerate(states):
        state = {**state, "x": [*state["q"], *state["v"]]}
        M = np.array(evaluated(made["mass_matrix"], state)["M"], float)
        for name, outputs in found.items():
            program = made[name]
            terms = np.ravel(cancelling(name, state, M))
            for expected, answer in zip(evaluated(program, state).values(), outputs, strict=True):
                slow: Array = np.ravel(np.array(expected, float))
                worst = float(np.maximum(worst, relative(answer[k] - slow, slow, terms)))
    return worst
