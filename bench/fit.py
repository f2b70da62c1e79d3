"""Measure whether the stated confidence of a fit is right: many draws of the noise on a double pendulum.

    python bench/fit.py                  print a Markdown table of 1000 draws for each noise
    python bench/fit.py --draws 100      fewer
    python bench/fit.py --append         and append it to bench/RESULTS.md, with the machine

Both angles are measured 101 times in 4 s; unknown are m₂, L₁, L₂ and both initial angles. Counted are the draws with
the truth in the joint region of 95 %, and in the interval of each unknown. The spread of the estimates is
the oracle of the standard deviations that single fits state.
"""

from __future__ import annotations

import math
import time

import numpy as np

import lagrangian as lg
from record import append, command_line, this_machine

TRUTH = {"m2": 1.0, "L1": 1.0, "L2": 1.0, "theta1": 0.7, "theta2": 0.4}
GUESS = {"m2": 1.2, "L1": 0.95, "L2": 1.05, "theta1": 0.65, "theta2": 0.45}
MEASURED = ("theta1", "theta2")


def row(noise: float, draws: int) -> str:
    """A line of the table for one standard deviation of the noise [rad]."""
    system, t = lg.example("double-pendulum"), np.linspace(0, 4, 101)
    clean = system.simulate(times=t, theta1=TRUTH["theta1"], theta2=TRUTH["theta2"])
    joint, each = 0, dict.fromkeys(TRUTH, 0)
    estimates, stated = [], []
    begin = time.process_time()
    for draw in range(draws):
        rng = np.random.default_rng(10_000 + draw)
        data = {"t": t} | {name: clean[name] + noise * rng.normal(size=t.size) for name in MEASURED}
        found = system.fit(data, GUESS)
        if not found.success:
            raise SystemExit(f"draw {draw} did not converge")
        joint += found.contains(TRUTH)
        for name, value in TRUTH.items():
            low, high = found.interval(name)
            each[name] += low <= value <= high
        estimates.append([found.estimate[name] for name in TRUTH])
        stated.append([found.std[name] for name in TRUTH])
    cpu = (time.process_time() - begin) / draws
    ratio = np.mean(stated, axis=0) / np.std(estimates, axis=0, ddof=1)
    singles = ", ".join(f"{100 * n / draws:.1f}" for n in each.values())
    ratios = f"{ratio.min():.3f} to {ratio.max():.3f}"
    return f"| {noise} | {100 * joint / draws:.1f} | {singles} | {ratios} | {1000 * cpu:.0f} |"


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--draws", type=int, default=1000)
    given = parser.parse_args()
    error = 100 * math.sqrt(0.95 * 0.05 / given.draws)
    lines = [
        "## Confidence of fits",
        "",
        f"`python bench/fit.py --draws {given.draws}`. {this_machine('numpy', 'scipy')}.",
        "",
        f"A double pendulum, {given.draws} draws of the noise; the share of draws with the truth in the region of 95 %",
        f"has a standard error of {error:.1f} %.",
        "",
        "| noise [rad] | joint region [%] | intervals of "
        + ", ".join(TRUTH)
        + " [%] | stated / true spread | CPU [ms] |",
        "| ---: | ---: | --- | --- | ---: |",
        *(row(noise, given.draws) for noise in (0.005, 0.02, 0.05)),
    ]
    text = "\n".join(lines) + "\n"
    print(text)
    if given.append:
        append([text])


if __name__ == "__main__":
    main()
