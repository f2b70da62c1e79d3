"""Runs exported function files of MATLAB in Octave."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from lagrangian.graph import Program
from lagrangian.verify.foreign.runs import Answers, MissingError, parted, run, stacked, written
from lagrangian.verify.states import State

OCTAVE = ("octave-cli", "octave")
"""Commands that start Octave, in the order in which they are tried."""

CALLER = "call_all.m"


def octave_answers(
    programs: Mapping[str, Program], files: Mapping[str, str | bytes], stem: str, states: Sequence[State], folder: Path
) -> Answers:
    """Call every function once, with all states as columns."""
    command = next((path for name in OCTAVE if (path := shutil.which(name))), None)
    if command is None:
        raise MissingError("Octave was not found (looked for " + ", ".join(OCTAVE) + ")")
    written(files, folder)
    groups = stacked(states)
    lines = []
    for group, values in groups.items():
        values.tofile(folder / f"{group}.bin")
        lines.append(f"file = fopen('{group}.bin');")
        lines.append(f"{group} = fread(file, [{values.shape[1]}, {len(states)}], 'double'); fclose(file);")
    lines.append("file = fopen('answers.bin', 'w');")
    for name, program in programs.items():
        outputs = [f"y{k}" for k in range(len(program.outputs))]
        lines.append(f"[{', '.join(outputs)}] = {stem}_{name}({', '.join(program.inputs)});")
        for y, output in zip(outputs, program.outputs.values(), strict=True):
            if len(output.shape) == 2:
                lines.append(f"{y} = permute({y}, [2, 1, 3]);")  # Octave writes columns, and the answers are rows
            lines.append(f"fwrite(file, {y}(:), 'double');")
    (folder / CALLER).write_text("\n".join([*lines, "fclose(file);", ""]), encoding="utf-8")
    run([command, "--no-gui", "--quiet", "--norc", CALLER], folder)
    return parted(np.fromfile(folder / "answers.bin"), programs, len(states))
