"""Runs exported models of Modelica by Rumoca, a compiler of Modelica, in a process of its own."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from lagrangian.export.modelica import ModelicaNames
from lagrangian.graph import Program
from lagrangian.verify.foreign.runs import Answers, MissingError, RefusedError, parted, run, stacked, written
from lagrangian.verify.states import State

ASKED = ("rhs", "energy", "multipliers")
"""The programs whose results are variables of a model."""

SPAN = 1e-9
"""The duration [s] of the runs, of which only the begin is read."""

_CODE = """\
import json, sys
import numpy as np
import rumoca

source, span, wanted, sizes, states = json.load(sys.stdin)
model = rumoca.Session().loads(source, model="Asked")
how = rumoca.SimConfig(solver="rk-like", dt=span)
found = []
for start, params, t in states:
    run = model.simulate(t=(t, t + span), config=how, start=start, params=params)
    found.append([float(np.ravel(run[name])[0]) for name in wanted])
np.concatenate([np.ravel(x) for x in np.split(np.array(found), np.cumsum(sizes)[:-1], axis=1)]).tofile("answers.bin")
"""


def asking(names: ModelicaNames, stem: str) -> tuple[str, list[str]]:
    """A model with the exported one as a part, whose inputs are parameters, and the names of what is asked of it."""
    given = [f"{name} = {name}_given" for name in names.u]
    slopes = [f"slope_{name}" for name in (*names.q, *names.v)]
    lines = [
        "model Asked",
        *(f"  parameter Real {name}_given = 0;" for name in names.u),
        f"  {stem} part({', '.join(given)});",
        *(f"  Real {name};" for name in slopes),
        "equation",
        *(f"  slope_{name} = der(part.{name});" for name in (*names.q, *names.v)),
        "end Asked;",
    ]
    others = ("energy_kinetic", "energy_potential", *names.lam)
    return "\n".join([*lines, ""]), [*slopes, *(f"part.{name}" for name in others)]


def modelica_answers(
    programs: Mapping[str, Program], files: Mapping[str, str | bytes], stem: str, states: Sequence[State], folder: Path
) -> Answers:
    """Compile the model once, and read its slopes, energies and multipliers where runs from the states begin."""
    if find_spec("rumoca") is None:
        raise MissingError("the package rumoca is not installed")
    written(files, folder)
    asked = {name: programs[name] for name in ASKED if name in programs}
    sizes = [len(output.ids) for program in asked.values() for output in program.outputs.values()]
    names = ModelicaNames.among(programs["inverse"].inputs, sum(sizes[3:]))
    question, wanted = asking(names, stem)
    source = (folder / f"{stem}.mo").read_text(encoding="utf-8") + question
    at = stacked(states)
    starts = [dict(zip((f"part.{x}" for x in (*names.q, *names.v)), row, strict=True)) for row in at["x"].tolist()]
    params = [
        {f"part.{n}": x for n, x in zip(names.p, p, strict=True)}
        | {f"{n}_given": x for n, x in zip(names.u, u, strict=True)}
        for p, u in zip(at["p"].tolist(), at["u"].tolist(), strict=True)
    ]
    jobs = list(zip(starts, params, at["t"][:, 0].tolist(), strict=True))
    (folder / "call_all.py").write_text(_CODE, encoding="utf-8")
    given = json.dumps([source, SPAN, wanted, sizes, jobs])
    try:
        run([sys.executable, "-W", "ignore", "call_all.py"], folder, given)
    except RefusedError as error:
        if "step size" in str(error).lower():
            raise MissingError("Rumoca's solver takes no step from one of these states") from error
        raise
    return parted(np.fromfile(folder / "answers.bin"), asked, len(states))
