"""Holds the page that moves against the system that it shows: its data, its model file, and the run of its solver.

The page is unpacked from its text, as a browser does. Its values and the model file that it saves are compared with the
system's; its solver in WebAssembly, and its functions in JavaScript, run in Node beside a run by machine code and the
slow evaluation of formulas.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import tempfile
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from lagrangian import dynamics
from lagrangian.errors import Error
from lagrangian.graph import Program
from lagrangian.model import Model
from lagrangian.page.formula import Check, text
from lagrangian.picture import picture
from lagrangian.read import loads
from lagrangian.simulate.settings import RunSettings
from lagrangian.simulate.simulation import simulate
from lagrangian.verify.exports import NODE, PATIENCE
from lagrangian.verify.states import State, evaluated, relative

TOLERANCE = 1e-6
"""The allowed difference of two runs, relative to the largest state: both keep theirs to some 1e-9."""

ROUNDING = 1e-9
"""The allowed relative difference of numbers that are computed twice from the same state."""

LONGEST = 1.0
"""The length of the run [s] is that of the page, and at most this."""

SAMPLES = 5
"""Its instants."""

STARTS = 3
"""So many starts are tried."""

DATA = text("the page that moves has the values of the system, also in the model file that it saves")
RUN = text("a run in the page that moves, in WebAssembly, equals one by machine code")
FUNCTIONS = text("the page's energies, and the places of what it draws, equal the slow evaluation of their formulas")

_PACKED = re.compile(r'<script type="text/plain" id="packed">(.*?)</script>', re.DOTALL)

_SCRIPT = """
const list = (x) => Array.from(x);
physics.solver().then((solver) => {
  const layout = physics.layout;
  const u = %(inputs)s, p = layout.parameters.map((x) => x.value);
  const run = solver.solve({ state: %(state)s, inputs: u, t1: %(end)r, samples: %(samples)d });
  const x = list(run.final);
  const of = (name) => list(physics.functions[name](x, p, u, %(end)r));
  console.log(JSON.stringify({
    kind: solver.kind, status: run.status, message: run.message, final: x, states: run.states.map(list),
    energy: of("power").slice(-2), anchors: of("anchors"),
  }));
});
"""


def live_page_checks(model: Model, states: Sequence[State]) -> tuple[Check, ...]:
    """Return the checks of the page of a model; ``holds`` is None where there is no page, or no Node to run it.

    The run starts at the first of the ``states``, up to `STARTS` of them, from which the page's run reaches its end.
    """
    try:
        drawn = picture(model)
        parts = unpacked(drawn.to_html())
        made = _data(model, json.loads(parts["data"]), states[0])
        runs = (_run(model, parts, drawn.program, state) for state in states[:STARTS])
        first = next(runs)
        while any(check.holds is None for check in first) and (further := next(runs, None)) is not None:
            first = further
        return made, *first
    except Error as error:
        return tuple(Check(what, None, f"not checked: {error.what[:160]}") for what in (DATA, RUN, FUNCTIONS))


def unpacked(page: str) -> dict[str, str]:
    """Return the packed parts of a page by their names."""
    return {name: content for name, content, _ in packed_parts(page)}


def packed_parts(page: str) -> list[tuple[str, str, str]]:
    """Return the name, the content and the type of every packed part of a page.

    Two characters hold 13 bits, in base 91 with the lower digit first; the first byte counts those that fill up.
    """
    found = _PACKED.search(page)
    assert found is not None, "a page has packed parts"
    digits = {c: n for n, c in enumerate(c for c in map(chr, range(33, 127)) if c not in '"&<')}
    text = found[1].strip()
    bits = "".join(f"{digits[low] + 91 * digits[high]:013b}" for low, high in zip(text[::2], text[1::2], strict=True))
    content = int(bits, 2).to_bytes(len(bits) // 8, "big")
    listed: list[tuple[str, str, str]] = json.loads(zlib.decompress(content[1 : len(content) - content[0]]))
    return listed


def _data(model: Model, data: Mapping[str, Any], state: State) -> Check:
    """The numbers of the page, and the system of its model file, beside the model."""
    wanted = {p.name: p.value for p in model.parameters}
    shown = dict(zip(data["p"]["names"], data["p"]["values"], strict=True))
    wrong = [name for name, value in wanted.items() if shown.get(name) != value]
    starts = dict(zip(data["x"]["names"], data["x"]["values"], strict=True))
    given = {str(k): v for k, v in model.settings.get("initial", {}).items() if isinstance(v, (int, float))}
    moved = bool(model.constraints)  # onto the constraints
    wrong += [name for name, value in given.items() if not moved and starts.get(name, value) != value]
    if wrong:
        return Check(DATA, False, f"{', '.join(wrong)} differ")
    count = f"{len(wanted)} parameters and {len(starts)} initial values"
    if not data["model"]:
        return Check(DATA, True, f"{count}; it saves no model file")
    try:
        saved = loads(_saved(data)).model()
    except Error as error:
        return Check(DATA, False, f"the model file is refused: {error.what[:160]}")
    kept = {p.name: p.value for p in saved.parameters}
    if wrong := [name for name, value in wanted.items() if not _near(kept.get(name), value)]:
        return Check(DATA, False, f"{', '.join(wrong)} differ in the model file")
    here, there = (np.array(evaluated(dynamics.forward(dynamics.slips(m)), state)["a"], float) for m in (model, saved))
    apart = relative(here - there, here, np.array(state["a"]))
    return Check(DATA, apart < ROUNDING, f"{count}; accelerations of the model file differ by {apart:.1e}")


def _near(one: float | None, other: float | None) -> bool:
    if one is None or other is None:
        return one is other
    return abs(one - other) <= ROUNDING * abs(other)


def _saved(data: Mapping[str, Any]) -> str:
    """The model file that the page saves: pieces of text, and between them values in their units."""
    pieces = [
        piece if isinstance(piece, str) else _slot(data[piece[0]]["values"][piece[1]], piece[2], piece[3])
        for piece in data["model"]
    ]
    return "".join(pieces)


def _slot(value: float, unit: str, factor: float) -> str:
    return json.dumps(f"{value / factor!r} {unit}") if unit else repr(value)


def _run(model: Model, parts: Mapping[str, str], anchors: Program, state: State) -> tuple[Check, ...]:
    """The run from a state and the functions of the page, in Node."""
    node = shutil.which(NODE)
    if node is None:
        return tuple(
            Check(what, None, "not checked: Node was not found (looked for node)") for what in (RUN, FUNCTIONS)
        )
    data = json.loads(parts["data"])
    known = dict(zip((u.name for u in model.inputs), state["u"], strict=True))
    start = {
        "x": dict(zip(data["x"]["names"], (*state["q"], *state["v"]), strict=True)),
        "u": {name: known[name] for name in data["u"]["names"]},
    }
    end = min(float(data["duration"]), LONGEST)
    begun = {"state": json.dumps([*start["x"].values()]), "inputs": json.dumps([*start["u"].values()])}
    found = _answered(node, parts["engine"] + _SCRIPT % {**begun, "end": end, "samples": SAMPLES})
    if isinstance(found, str):
        return tuple(Check(what, False, f"Node refuses it: {found[:200]}") for what in (RUN, FUNCTIONS))
    return _as_machine_code(model, start, end, found), _as_formulas(model, start["u"], data, end, found, anchors)


def _answered(node: str, script: str) -> dict[str, Any] | str:
    """What a script shows, or the message of the error that stops it."""
    with tempfile.TemporaryDirectory(prefix="lagrangian-", ignore_cleanup_errors=True) as folder:
        path = Path(folder) / "page.js"
        path.write_text(script, encoding="utf-8")
        try:
            done = subprocess.run([node, str(path)], capture_output=True, text=True, timeout=PATIENCE, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            return str(error)
    if done.returncode or not done.stdout:
        return next((line for line in done.stderr.splitlines() if "Error" in line), f"exit {done.returncode}")
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def _as_machine_code(
    model: Model, start: Mapping[str, Mapping[str, float]], end: float, found: Mapping[str, Any]
) -> Check:
    if found["status"] != 0:
        return Check(RUN, None, f"not checked: the page's run ends early ({found['message']})")
    times = RunSettings(times=np.linspace(0.0, end, SAMPLES))
    run = simulate(model, times, initial=start["x"], params={}, inputs=start["u"], by_name={})
    if not run.success:
        return Check(RUN, None, f"not checked: {run.message}")
    states = np.array(found["states"], float).T[: len(run.y)]
    apart = relative(states - run.y, run.y, np.ones(1))
    return Check(RUN, apart < TOLERANCE, f"largest relative difference {apart:.1e} over {end:g} s, by {found['kind']}")


def _as_formulas(
    model: Model,
    free: Mapping[str, float],
    data: Mapping[str, Any],
    end: float,
    found: Mapping[str, Any],
    anchors: Program,
) -> Check:
    """The functions at the last state."""
    if any(u.name not in free for u in model.inputs):
        return Check(FUNCTIONS, None, "not checked: an input is given as a function of the state")
    at = {"x": found["final"], "p": data["p"]["values"], "u": [free[u.name] for u in model.inputs], "t": [end]}
    n = len(model.coordinates)
    at |= {"q": at["x"][:n], "v": at["x"][n:]}
    energies = evaluated(dynamics.energy(model), at)
    T_V = np.array([energies["T"], energies["V"]], float).ravel()
    r = np.ravel(np.array(evaluated(anchors, at)["r"], float))
    worst = max(
        relative(np.array(found["energy"], float) - T_V, T_V, np.ones(1)),
        relative(np.ravel(np.array(found["anchors"], float)) - r, r, np.ones(1)),
    )
    return Check(FUNCTIONS, worst < ROUNDING, f"largest relative difference {worst:.1e}")
