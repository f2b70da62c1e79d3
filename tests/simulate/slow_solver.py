"""A slow and obvious solver: classical Runge–Kutta 4 in NumPy over the graph's own evaluation, run by run."""

from dataclasses import dataclass

import numpy as np

from lagrangian.graph import Program, evaluate


@dataclass
class SlowSolution:
    times: np.ndarray
    states: np.ndarray
    status: np.ndarray
    reached: np.ndarray
    final: np.ndarray
    event_index: np.ndarray
    event_time: np.ndarray
    drift: None = None


class SlowSolver:
    """The classical method with ``steps`` equal steps between samples; a run that leaves |x| < 1e6 fails."""

    def __init__(self, program: Program, steps: int = 4) -> None:
        self.program, self.steps = program, steps

    def solve(self, x0, times, *, u=None, p=None, store=True, **_) -> SlowSolution:
        n, size = x0.shape
        states = np.full((n, len(times), size), np.nan)
        status, reached, final = np.zeros(n, int), np.full(n, float(times[-1])), np.empty((n, size))
        for k in range(n):
            uk = u if u.ndim == 1 else u[k]
            pk = p if p.ndim == 1 else p[k]
            x = states[k, 0] = x0[k]
            for s in range(1, len(times)):
                x = self._advance(x, times[s - 1], times[s], uk, pk)
                if not np.abs(x).max() < 1e6:
                    status[k], reached[k] = -2, times[s - 1]
                    x = np.full(size, np.nan)
                    break
                states[k, s] = x
            final[k] = x
        none = np.empty((n, 0))
        return SlowSolution(times, states, status, reached, final, none.astype(int), none)

    def _advance(self, x, begin, end, u, p):
        h = (end - begin) / self.steps
        f = lambda t, x: np.array(evaluate(self.program, {"x": x, "u": u, "p": p, "t": [t]})["xdot"])  # noqa: E731
        for i in range(self.steps):
            t = begin + i * h
            k1 = f(t, x)
            k2 = f(t + h / 2, x + h / 2 * k1)
            k3 = f(t + h / 2, x + h / 2 * k2)
            k4 = f(t + h, x + h * k3)
            x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            if not np.isfinite(x).all():
                break
        return x
