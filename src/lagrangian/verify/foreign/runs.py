"""What the checks of all foreign programs share: states side by side, and how a program is called."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.graph import Program
from lagrangian.verify.states import State

Array: TypeAlias = NDArray[np.float64]

Answers: TypeAlias = Mapping[str, Sequence[Array]]
"""The outputs of every program, in order, each of shape (states, entries): row by row of a matrix."""

PATIENCE = 300
"""The time [s] after which a program is stopped."""


class MissingError(Exception):
    """A program that is needed is not installed, does not start, or cannot be asked this; the text says which."""


class RefusedError(Exception):
    """A program refuses what was exported; the text is its own message."""


def stacked(states: Sequence[State]) -> dict[str, Array]:
    """The groups of arguments, each of shape (states, entries), x = [q; v] included."""
    found = {group: np.array([state[group] for state in states], float).reshape(len(states), -1) for group in states[0]}
    return {**found, "x": np.concatenate([found["q"], found["v"]], axis=1)}


def declared(program: Program) -> list[float]:
    """The values of the parameters that a file declares; none if one of them has no value."""
    values = [program.defaults.get(name) for name in program.inputs["p"]]
    return [] if None in values else [float(x) for x in values if x is not None]


def written(files: Mapping[str, str | bytes], folder: Path) -> None:
    """Write exported files into a folder."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)


def run(command: Sequence[str], folder: Path, given: str = "") -> str:
    """The output of a program that runs in a folder. Raises `MissingError` and `RefusedError`."""
    try:
        done = subprocess.run(
            command, input=given, cwd=folder, capture_output=True, text=True, timeout=PATIENCE, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise MissingError(f"{command[0]} could not be run ({error})") from error
    if done.returncode:
        said = [line.strip() for line in done.stderr.splitlines() if line.strip()]
        first = next((line for line in said if "error" in line.lower()), said[-1] if said else "no message")
        raise RefusedError(first[:200])
    return done.stdout


def parted(numbers: Array, programs: Mapping[str, Program], count: int) -> Answers:
    """The answers from all numbers: program after program, output after output, state after state."""
    found: dict[str, list[Array]] = {}
    at = 0
    for name, program in programs.items():
        found[name] = []
        for output in program.outputs.values():
            size = len(output.ids) * count
            found[name].append(numbers[at : at + size].reshape(count, len(output.ids)))
            at += size
    if at != len(numbers):
        raise RefusedError(f"{len(numbers)} numbers came back, not {at}")
    return found
