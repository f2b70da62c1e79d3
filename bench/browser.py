"""Measure runs in WebAssembly and in JavaScript, in Node, beside machine code.

    python bench/browser.py                  print Markdown tables
    python bench/browser.py --append         and append them to bench/RESULTS.md, with the machine

The contenders take turns, and a figure is the least of its rounds, which are some milliseconds long. Each is one run
from one start. JavaScript makes the same steps, by the functions that `export --to javascript` writes.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

import engine_systems as systems
import lagrangian as lg
from lagrangian.simulate.browser import BrowserModule, browser_module
from record import append, command_line, this_machine

HERE = Path(__file__).parent
ROUNDS = 80
STEP = 1e-3
TOLERANCE = 1e-9

RUN = """
const s = KIND === "wasm" ? lagrangianSolver.makeSolver(physics.bytes, physics.layout, physics.functions)
  : lagrangianSolver.makeFallback(physics.functions, physics.layout);
const o = OPTIONS, n = o.states ? "many" : "solve";
let least = Infinity, steps = 0, ok = true;
for (let k = 0; k < ROUNDS; k++) {
  const begin = performance.now(), run = s[n](o);
  least = Math.min(least, performance.now() - begin);
  steps = run.steps;
  ok = ok && run.status === 0;
}
console.log(JSON.stringify([least / 1000, steps, ok]));
"""


def node(module: BrowserModule, kind: str, options: dict[str, Any], rounds: int) -> tuple[float, int]:
    """The least time [s] of a run, and its steps."""
    text = RUN.replace("KIND", json.dumps(kind)).replace("OPTIONS", json.dumps(options)).replace("ROUNDS", str(rounds))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.js"
        path.write_text(module.script() + text, encoding="utf-8")
        done = subprocess.run([str(shutil.which("node")), str(path)], capture_output=True, text=True, check=True)
    seconds, steps, fine = json.loads(done.stdout)
    assert fine, "a run in Node failed"
    return seconds, steps


def native(system: lg.System, **options: Any) -> tuple[float, int]:
    """The least time [s] of a run in machine code, from Python, and its steps."""
    from lagrangian.integrate import Solver
    from lagrangian.simulate.inputs import driving
    from lagrangian.simulate.integrating import right_hand_side

    model = system.model
    program = right_hand_side(model, driving(model, None, model.settings.get("inputs", {})))
    layout = browser_module(system, "rk4").layout
    start = [*layout["start"], *[0.0] * (len(program.inputs["x"]) - len(layout["start"]))]
    method = options.pop("method")
    solver = Solver(program, method, threads=1)
    given = {"p": [p["value"] for p in layout["parameters"]], "u": [u["value"] for u in layout["inputs"]]}
    end = options.pop("end")
    least, steps = float("inf"), 0
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        found = solver.solve(start, [0.0, end], store=False, **given, **options)
        least, steps = min(least, time.perf_counter() - begin), int(found.steps[0])
        assert found.status[0] == 0
    return least, steps


def table(cases: dict[str, tuple[lg.System, int, float]]) -> list[str]:
    """Steps of rk4 a second, and adaptive runs."""
    lines = [
        "| | machine code | WebAssembly | of machine code | JavaScript | of machine code | bytes of the module |",
        "|---|---:|---:|---:|---:|---:|---:|",
    ]
    for name, (system, steps, end) in cases.items():
        module = browser_module(system, "rk4", step=STEP)
        options = {"t1": steps * STEP, "samples": 2, "step": STEP}
        best: dict[str, float] = {}
        for _ in range(3):
            found = {
                "native": native(system, method="rk4", end=steps * STEP, step=STEP),
                "wasm": node(module, "wasm", options, ROUNDS),
                "javascript": node(module, "javascript", options, ROUNDS),
            }
            for kind, (seconds, made) in found.items():
                best[kind] = max(best.get(kind, 0.0), made / seconds)
        ratio = {kind: f"{100 * best[kind] / best['native']:.0f} %" for kind in ("wasm", "javascript")}
        shown = {kind: f"{speed / 1e6:.2f} M" for kind, speed in best.items()}
        lines.append(
            f"| {name}, rk4, steps a second | {shown['native']} | {shown['wasm']} | {ratio['wasm']} "
            f"| {shown['javascript']} | {ratio['javascript']} | {len(module.code)} |"
        )
        lines.append(adaptive(name, system, end))
    return lines


def adaptive(name: str, system: lg.System, end: float) -> str:
    """A row for one run by dop853."""
    module = browser_module(system, "dop853", rtol=TOLERANCE)
    relative, absolute = (module.layout["defaults"][k] for k in ("rtol", "atol"))
    best = {"native": float("inf"), "wasm": float("inf")}
    for _ in range(3):
        found = {
            "native": native(system, method="dop853", end=end, rtol=relative, atol=absolute),
            "wasm": node(module, "wasm", {"t1": end, "samples": 2}, ROUNDS),
        }
        best = {kind: min(best[kind], seconds) for kind, (seconds, _) in found.items()}
    ratio = f"{100 * best['native'] / best['wasm']:.0f} %"
    shown = f"{1e3 * best['native']:.2f} ms | {1e3 * best['wasm']:.2f} ms | {ratio}"
    return f"| {name}, dop853, {end:g} s at {relative:g} a step | {shown} | | | {len(module.code)} |"


def main() -> None:
    parser = command_line(__doc__)
    given = parser.parse_args()
    if shutil.which("node") is None:
        raise SystemExit("node is not installed")
    shown = subprocess.run(["node", "--version"], capture_output=True, text=True, check=True).stdout.strip()
    arm = systems.described(systems.arm_tree())
    cases = {"double pendulum": (lg.example("double-pendulum"), 30_000, 10.0), "7-joint arm": (arm, 2_000, 1.0)}
    head = f"`python bench/browser.py`. Node {shown}; {this_machine('llvmlite')}."
    text = "\n".join(["## Runs in WebAssembly", "", head, "", *table(cases), ""])
    print(text)
    if given.append:
        append([text])


if __name__ == "__main__":
    main()
