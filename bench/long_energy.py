"""Energy of a pendulum over a million periods: Gauss' symplectic method against Runge and Kutta's, steps alike.

    python bench/long_energy.py [docs/figures/long-energy.png]

Prints the largest relative energy errors by decade of time and draws the figure of docs/simulation.md.
"""

from __future__ import annotations

import sys
import time

import numpy as np

import lagrangian as lg
from lagrangian import examples
from lagrangian.view import Panel, Plotted, Series, draw

PERIODS = 1_000_000
STEPS = 40
"""Steps a period."""


def instants(period: float) -> np.ndarray:
    """Times spaced evenly on a logarithmic axis, all multiples of the step."""
    step = period / STEPS
    counts = np.unique(np.round(np.geomspace(1, PERIODS * STEPS, 1500)).astype(int))
    return np.concatenate([[0.0], counts * step])


def main() -> None:
    pendulum = lg.loads(examples.text("pendulum"))
    small = {"theta": 0.5, "params": {"b": 0.0}}
    found = pendulum.simulate(10.0, events=lg.event(pendulum["theta"], direction=1, name="up"), **small)
    period = float(np.diff(found.events["up"].t)[0])
    times = instants(period)
    errors = {}
    for method in ("gauss4", "rk4"):
        begin = time.perf_counter()
        run = pendulum.simulate(times=times, method=method, step=period / STEPS, max_steps=10**9, **small)
        took = time.perf_counter() - begin
        swing = run.energy[0] + np.max(-run.potential)  # the energy above the lowest point
        errors[method] = np.abs(run.imbalance) / swing
        print(f"{method}: {run.steps} steps in {took:.1f} s, {1e9 * took / run.steps:.0f} ns a step; {run.message}")
        for decade in range(6):
            part = (run.t >= 10**decade * period) & (run.t <= 10 ** (decade + 1) * period * 1.001)
            print(f"  up to 1e{decade + 1} periods: {np.max(errors[method][part]):.1e}")
    if len(sys.argv) > 1:
        figure(times / period, errors).savefig(sys.argv[1], dpi=110)


def figure(periods: np.ndarray, errors: dict[str, np.ndarray]):
    """Relative energy errors over time, both on logarithmic axes."""
    curves = [Series(r"\mathrm{" + name + "}", name, values[1:]) for name, values in errors.items()]
    panel = Panel("relative energy error", "", tuple(curves))
    made = draw(Plotted("pendulum, 0.5 rad, 40 steps a period", periods[1:], (panel,)))
    axes = made.axes[0]
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(1e-10, 2.0)
    axes.set_xlabel("periods")
    return made


if __name__ == "__main__":
    main()
