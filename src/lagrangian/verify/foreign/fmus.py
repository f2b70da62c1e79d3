"""Runs exported FMUs by FMPy in a process of its own: they are validated, and derivatives asked at all states."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from lagrangian.graph import Program
from lagrangian.verify.foreign.runs import Answers, MissingError, declared, parted, run, stacked, written
from lagrangian.verify.states import State

ASKED = ("rhs", "energy", "multipliers")
"""The programs whose results are variables of an FMU."""

_CODE = """\
import json, sys
import fmpy
import numpy as np
from fmpy.validation import validate_fmu

groups = {name: np.array(values, float) for name, values in json.load(sys.stdin).items()}
declared = groups.pop("declared").tolist()
problems = validate_fmu("STEM.fmu")
if problems:
    sys.exit("error: " + problems[0])
description = fmpy.read_model_description("STEM.fmu")
folder = fmpy.extract("STEM.fmu")
fmu = fmpy.instantiate_fmu(folder, description, "ModelExchange")
three = description.fmiVersion.startswith("3")
get, put = (fmu.getFloat64, fmu.setFloat64) if three else (fmu.getReal, fmu.setReal)
if three:
    fmu.enterInitializationMode(startTime=0.0)
else:
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
fmu.exitInitializationMode()
fmu.enterContinuousTimeMode()

def references(*causalities):
    return [v.valueReference for v in description.modelVariables if v.causality in causalities]

said = [float(v.start) for v in description.modelVariables if v.causality == "parameter"]
if said != declared or list(get(references("parameter"))) != declared:
    sys.exit("error: parameters start at other values than those of the model")

size = groups["x"].shape[1]
sizes = {"rhs": range(size + 1, 2 * size + 1)}
others = [r for r in references("output") if r > 2 * size]
sizes["energy"], sizes["multipliers"] = others[:2], others[2:]
found = {name: [] for name in sizes}
for x, u, p, t in zip(*(groups[name] for name in "xupt")):
    put(references("parameter"), list(p))
    put(references("input"), list(u))
    fmu.setTime(t[0])
    if three:
        fmu.setContinuousStates((fmpy.fmi3.c_double * size)(*x), size)
    else:
        fmu.setContinuousStates((fmpy.fmi2.c_double * size)(*x), size)
    for name, wanted in sizes.items():
        found[name].append(get(list(wanted)) if wanted else [])
fmu.terminate()
fmu.freeInstance()
columns = [np.array(found["rhs"]), *np.array(found["energy"]).T, np.array(found["multipliers"])]
np.concatenate([np.ravel(x) for x in columns]).tofile("answers.bin")
"""


def fmu_answers(
    programs: Mapping[str, Program], files: Mapping[str, str | bytes], stem: str, states: Sequence[State], folder: Path
) -> Answers:
    """Ask the FMU for derivatives, energies and multipliers at all states, once FMPy finds it valid."""
    if find_spec("fmpy") is None:
        raise MissingError("the package fmpy is not installed")
    written(files, folder)
    if b"binaries/" not in (folder / f"{stem}.fmu").read_bytes():
        raise MissingError("no C compiler was found, so the FMU has no binary")
    (folder / "call_all.py").write_text(_CODE.replace("STEM", stem), encoding="utf-8")
    given = {name: values.tolist() for name, values in stacked(states).items()}
    given["declared"] = declared(programs["rhs"])
    run([sys.executable, "-W", "ignore", "call_all.py"], folder, json.dumps(given))
    asked = {name: programs[name] for name in ASKED if name in programs}
    return parted(np.fromfile(folder / "answers.bin"), asked, len(states))
