"""Measure the energy and the closure of conservative systems with constraints over 100 s, by every method.

    python bench/linkages.py                           print a Markdown table
    python bench/linkages.py --append                  and append it to bench/RESULTS.md, with the machine
    python bench/linkages.py -s four-bar -m BDF,Radau  only these systems and methods
    python bench/linkages.py --seconds 10              a shorter motion

Every run has the default tolerances, and `rk4` the steps of `STEP`. A cell has the largest error of the energy balance
relative to the energy that moves, and in brackets the steps and the CPU seconds. What is above 1e-8 is in bold, and
what takes longer than `LIMIT` is given up. Inputs are zero, and so are dampers.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

import numpy as np

import lagrangian as lg
from lagrangian.integrate.method_names import MACHINE, SCIPY
from record import append, command_line, table, this_machine

BOUND = 1e-8
LIMIT = 600.0
SAMPLES = 2001
STEP = 0.0005

METHODS = [name for name in (*MACHINE, *SCIPY) if name != "gauss4"]  # that one is refused

SYSTEMS: Mapping[str, Mapping[str, Any]] = {
    "rod-pendulum": {},
    "four-bar": {},
    "slider-crank": {"params": {"b": 0}},
    "double-parallelogram": {},
    "ladder": {},
    "wheel-on-incline": {},
    "rolling-disc": {},
    "chaplygin-sleigh": {},
    "car": {"params": {"b": 0}, "inputs": {"tau": 0.0}, "initial": {"delta": 0.1, "x'": 10.0}},
    "car-with-trailer": {"params": {"b": 0}, "inputs": {"tau": 0.0}, "initial": {"delta": 0.1, "x'": 10.0}},
    "balancing-robot": {},
    "whipple-bicycle": {},
    "stewart-platform": {"params": {"b": 0}},
}


def closure(run: lg.Trajectory, system: lg.System) -> float:
    """The largest residual of a row, positions [m, rad] and velocities [m/s, rad/s], at all samples."""
    n = len(system.model.coordinates)
    left = system.compile().residual(run.y[:n].T, run.y[n:].T)
    return max(float(np.abs(x).max()) for rows in left.values() for x in rows.values())


def measured(name: str, method: str, seconds: float) -> tuple[str, float]:
    """The cell of one run, and what is left of its rows."""
    system = lg.example(name)
    step = STEP if method == "rk4" else None
    begin = time.process_time()
    try:
        run = system.simulate(seconds, method=method, step=step, samples=SAMPLES, timeout=LIMIT, **SYSTEMS[name])
    except lg.RunError as refused:
        return f"refused: {refused.code}", 0.0
    taken, error = time.process_time() - begin, float(run.audit)
    said = f"{error:.1e}" if error <= BOUND else f"**{error:.1e}**"
    until = "" if run.success else f" until {run.t[-1]:.3g} s"
    return f"{said}{until} ({run.steps}, {taken:.3g} s)", closure(run, system)


def report(names: list[str], methods: list[str], seconds: float) -> list[str]:
    lines = [f"## Energy and closure of linkages over {seconds:g} s", ""]
    lines += [f"`python bench/linkages.py`. {this_machine('llvmlite', 'scipy')}.", ""]
    rows, left = [], 0.0
    for name in names:
        row = [name]
        for method in methods:
            cell, rest = measured(name, method, seconds)
            print(f"{name}, {method}: {cell}, {rest:.1e}", flush=True)
            left = max(left, rest)
            row.append(cell)
        rows.append(row)
    lines += table([f"{seconds:g} s", *methods], rows)
    return [*lines, "", f"The largest residual of a row in any of them, positions and velocities: {left:.1e}."]


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("-s", "--systems", default=",".join(SYSTEMS), help="names, with commas")
    parser.add_argument("-m", "--methods", default=",".join(METHODS), help="names, with commas")
    parser.add_argument("--seconds", type=float, default=100.0, help="the length of a motion")
    given = parser.parse_args()
    lines = report(given.systems.split(","), given.methods.split(","), given.seconds)
    print("\n".join(lines), flush=True)
    if given.append:
        append(lines)


if __name__ == "__main__":
    main()
