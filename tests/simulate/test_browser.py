"""Runs in WebAssembly, in Node, against runs in machine code; and what a page gets with them."""

import json
import shutil
import subprocess

import numpy as np
import pytest

import lagrangian as lg
from lagrangian.simulate.browser import browser_module

NODE = shutil.which("node")
needs_node = pytest.mark.skipif(NODE is None, reason="node is not installed")

SHOWN = """
const told = (r) => ({...r, t: Array.from(r.t), states: r.states.map((x) => Array.from(x)), final: Array.from(r.final),
  events: r.events.map((e) => ({...e, state: Array.from(e.state)}))});
const show = (x) => console.log(JSON.stringify(x));
const native = () => lagrangianSolver.makeSolver(physics.bytes, physics.layout);
const fallback = () => lagrangianSolver.makeFallback(physics.functions, physics.layout);
"""


def node(module, text, folder):
    """The JSON lines that a script prints after the module's own."""
    path = folder / "run.js"
    path.write_text(module.script() + SHOWN + text, encoding="utf-8")
    done = subprocess.run([NODE, str(path)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    return [json.loads(line) for line in done.stdout.splitlines()]


# One of each kind: chaos, a closed loop, feedback, a driven pivot, a chain in space, rolling, floating, many rows
SYSTEMS = (
    "double-pendulum", "four-bar", "crane", "kapitza-pendulum", "robot-arm", "rolling-disc", "quarter-car", "ladder",
)  # fmt: skip


@needs_node
@pytest.mark.parametrize("name", SYSTEMS)
def test_a_run_in_webassembly_is_that_of_machine_code(name, tmp_path):
    system = lg.example(name)
    (found,) = node(browser_module(system), "show(told(native().solve({t1: 1, samples: 11})));", tmp_path)
    run = system.simulate(1.0, samples=11)
    assert found["status"] == run.status == 0
    assert np.array(found["t"]) == pytest.approx(run.t, abs=1e-15)
    np.testing.assert_allclose(np.array(found["states"]).T, run.y, rtol=1e-9, atol=1e-9)
