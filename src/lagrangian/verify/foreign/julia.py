"""Runs exported modules of Julia."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from lagrangian.graph import Program
from lagrangian.verify.foreign.runs import Answers, MissingError, parted, run, stacked, written
from lagrangian.verify.states import State


def julia_answers(
    programs: Mapping[str, Program], files: Mapping[str, str | bytes], stem: str, states: Sequence[State], folder: Path
) -> Answers:
    """Call every function at every state."""
    command = shutil.which("julia")
    if command is None:
        raise MissingError("Julia was not found (looked for julia)")
    written(files, folder)
    lines = [f'include("{stem}.jl")', f"using .{stem[:1].upper()}{stem[1:]}Dynamics"]
    for group, values in stacked(states).items():
        values.tofile(folder / f"{group}.bin")
        n = values.shape[1]
        lines.append(f'all_{group} = read!("{group}.bin", Array{{Float64}}(undef, {n}, {len(states)}))')
    lines.append('file = open("answers.bin", "w")')
    for name, program in programs.items():
        given = ", ".join("all_t[1, k]" if x == "t" else f"all_{x}[:, k]" for x in program.inputs)
        for i, output in enumerate(program.outputs.values(), 1):
            value = f"{stem}_{name}({given})" + (f"[{i}]" if len(program.outputs) > 1 else "")
            if len(output.shape) == 2:
                value = f"permutedims({value})"  # Julia writes columns, and the answers are rows
            lines.append(f"for k in 1:{len(states)}; write(file, collect(Float64, {value})); end")
    (folder / "call_all.jl").write_text("\n".join([*lines, "close(file)", ""]), encoding="utf-8")
    run([command, "--startup-file=no", "call_all.jl"], folder)
    return parted(np.fromfile(folder / "answers.bin"), programs, len(states))
