"""Runs exported modules of JAX and CasADi in a process of their own, where JAX can be set to double precision."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from lagrangian.graph import Program
from lagrangian.verify.foreign.runs import Answers, MissingError, declared, parted, run, stacked, written
from lagrangian.verify.states import State

_HEAD = """\
import importlib, json, sys
import numpy as np

found = []
"""
_JOBS = """\
for stem, wanted, given, declared in json.load(sys.stdin):
    made = importlib.import_module(stem)
    if list(getattr(made, "PARAMETERS", ())) != declared:
        sys.exit("error: PARAMETERS has other values than the parameters of the model")
    groups = {name: np.array(values, float) for name, values in given.items()}
    for name, arguments in wanted:
        found += called(getattr(made, name), [groups[x] for x in arguments], arguments)
np.concatenate(found).tofile("answers.bin")
"""
_JAX = (
    _HEAD
    + """\
import jax

jax.config.update("jax_enable_x64", True)

def called(function, given, names):
    answer = function(*(x[:, 0] if name == "t" else x for x, name in zip(given, names)))
    return [np.ravel(x) for x in (answer if isinstance(answer, tuple) else (answer,))]

"""
    + _JOBS
)
_CASADI = (
    _HEAD
    + """\
def called(make, given, names):
    function = make()
    answers = [function.call([x[k] for x in given]) for k in range(len(given[0]))]
    return [np.ravel(np.array(one[i])) for i in range(function.n_out()) for one in answers]

"""
    + _JOBS
)

Job: TypeAlias = tuple[str, Mapping[str, Program], Mapping[str, str | bytes], Sequence[State]]
"""A stem, the programs, the files, and the states at which the functions are called."""


def jax_answers(
    programs: Mapping[str, Program], files: Mapping[str, str | bytes], stem: str, states: Sequence[State], folder: Path
) -> Answers:
    """Call every function once, with all states in one array."""
    return all_jax_answers([(stem, programs, files, states)], folder)[0]


def casadi_answers(
    programs: Mapping[str, Program], files: Mapping[str, str | bytes], stem: str, states: Sequence[State], folder: Path
) -> Answers:
    """Make every Function once, and call it at every state."""
    return all_casadi_answers([(stem, programs, files, states)], folder)[0]


def all_jax_answers(jobs: Sequence[Job], folder: Path) -> list[Answers]:
    """The answers of several exports by one process, which compiles equal operations once."""
    return _called("jax", _JAX, jobs, folder)


def all_casadi_answers(jobs: Sequence[Job], folder: Path) -> list[Answers]:
    """The answers of several exports by one process."""
    return _called("casadi", _CASADI, jobs, folder)


def _called(needed: str, code: str, jobs: Sequence[Job], folder: Path) -> list[Answers]:
    if find_spec(needed) is None:
        raise MissingError(f"the package {needed} is not installed")
    given: list[Any] = []
    for stem, programs, files, states in jobs:
        written(files, folder)
        wanted = [[f"{stem}_{name}", list(program.inputs)] for name, program in programs.items()]
        given.append([stem, wanted, {name: values.tolist() for name, values in stacked(states).items()}])
        given[-1].append(declared(next(iter(programs.values()))))
    (folder / "call_all.py").write_text(code, encoding="utf-8")
    run([sys.executable, "-W", "ignore", "call_all.py"], folder, json.dumps(given))
    numbers, found = np.fromfile(folder / "answers.bin"), list[Answers]()
    for _, programs, _, states in jobs:
        size = sum(len(output.ids) for program in programs.values() for output in program.outputs.values())
        found.append(parted(numbers[: size * len(states)], programs, len(states)))
        numbers = numbers[size * len(states) :]
    return found
