"""Decides which parameter sets are possible: positive masses, and a positive definite mass matrix."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen import Kernel, Look, compile
from lagrangian.errors import RunError
from lagrangian.graph import Output, Program, evaluate
from lagrangian.records import dataclass

Array: TypeAlias = NDArray[np.float64]

NOT_FINITE = "E503"

ROUNDING = 1e-9
"""A negative smallest eigenvalue counts as 0 if it is below this fraction of the largest."""

MAX_SETS_IN_PYTHON = 4
"""Up to this many parameter sets, no machine code is compiled."""

MAX_NUMBERS_ONE_BY_ONE = 100
"""Up to this many numbers, it is faster to check them one by one."""


@dataclass(frozen=True)
class Fitness:
    """How parameter sets are checked before they are run; small, and can be sent to another process.

    ``bodies`` is a program p → ``mass k`` (must be positive), ``resting mass k`` (must not be negative) and ``inertia
    k``, (d, d). If an inertia has a negative eigenvalue, ``metric``, a program q, v, u, p, t → M, decides at the
    configurations ``states`` (k, n_q): M must not have a negative eigenvalue there. Both exist if ``bodies`` has an
    inertia.
    """

    bodies: Program
    metric: Program | None = None
    states: Array | None = None

    def unfit(self, p: Array) -> NDArray[np.bool_]:
        """Which of the parameter sets (k, n_p) are impossible."""
        values = _few(self.bodies, p) if len(p) <= MAX_SETS_IN_PYTHON else _computed(self._bodies, {"p": p}, len(p))
        bad, doubtful = np.zeros(len(p), bool), np.zeros(len(p), bool)
        for name, value in values.items():
            finite = np.asarray(np.isfinite(value).all(axis=tuple(range(1, value.ndim))))
            bad |= ~finite
            if name.startswith("inertia"):
                doubtful |= finite & _negative(np.where(finite[:, None, None], value, 0.0))
            else:
                bad |= ~(value >= 0 if name.startswith("resting") else value > 0)
        doubtful &= ~bad
        if doubtful.any():
            bad[doubtful] = self._indefinite(p[doubtful])
        return bad

    @property
    def look(self) -> Look | None:
        """A fast test that accepts only sets (k, n_p) that are certainly possible; None if there is none.

        Its criterion is stricter than that of `unfit`: a set that it does not accept may be possible.
        """
        return self._look

    def _indefinite(self, p: Array) -> NDArray[np.bool_]:
        """Which parameter sets (k, n_p) lead to a negative eigenvalue of M in one of the states."""
        assert self.metric is not None and self.states is not None
        count = len(self.states)
        q, every = np.tile(self.states, (len(p), 1)), np.repeat(p, count, axis=0)
        M = _computed(self._metric, {"q": q, "p": every}, len(q))["M"]
        known = np.asarray(np.isfinite(M).reshape(len(M), -1).all(axis=1))
        low = known & _negative(np.where(known[:, None, None], M, 0.0))
        return np.asarray(low.reshape(len(p), count).any(axis=1))

    @cached_property
    def _bodies(self) -> Kernel:
        return compile(self.bodies, threads=1)

    @cached_property
    def _look(self) -> Look | None:
        """A program for the masses and, of an inertia, the leading minors (or the diagonal if it is diagonal)."""
        above, rest = [], []
        g = self.bodies.graph
        for name, output in self.bodies.outputs.items():
            ids = output.ids
            if not name.startswith("inertia"):
                (rest if name.startswith("resting") else above).extend(ids)
            elif len(ids) == 1 or all(g.value(i) == 0 for k, i in enumerate(ids) if k % 4):
                rest += ids[::4]
            else:
                a, b, c, d, e, f = (ids[k] for k in (0, 1, 2, 4, 5, 8))
                if (ids[3], ids[6], ids[7]) != (b, c, e):
                    return None
                minor = g.sub(g.mul(a, d), g.mul(b, b))
                last = g.sub(g.mul(b, e), g.mul(c, d))
                whole = g.add(g.mul(f, minor), g.sub(g.mul(c, last), g.mul(e, g.sub(g.mul(a, e), g.mul(b, c)))))
                above += [a, minor, whole]
        if len(above) + len(rest) > MAX_NUMBERS_ONE_BY_ONE:
            return None
        outputs = {"numbers": Output((*above, *rest), (len(above) + len(rest),))}
        program = Program("fit", g, self.bodies.inputs, outputs, self.bodies.defaults)
        return compile(program, hoist=(), threads=1).signs(len(above))

    @cached_property
    def _metric(self) -> Kernel:
        assert self.metric is not None
        return compile(self.metric, optional={"v": 0.0, "u": 0.0, "t": 1.0}, threads=1)

    def __getstate__(self) -> dict[str, Any]:
        return {k: v for k, v in self.__dict__.items() if not k.startswith("_")}


def _negative(matrices: Array) -> NDArray[np.bool_]:
    """Which symmetric matrices (k, d, d) have an eigenvalue that is negative beyond rounding."""
    values = np.linalg.eigvalsh((matrices + matrices.swapaxes(-1, -2)) / 2)
    return np.asarray(values[:, 0] < -ROUNDING * np.abs(values).max(axis=1))


def _few(program: Program, p: Array) -> dict[str, Array]:
    """The outputs of a program of parameters for a few sets of them, without machine code."""
    each = [evaluate(program, {"p": row}) for row in p]
    return {
        name: np.array([row[name] for row in each], float).reshape(len(p), *output.shape)
        for name, output in program.outputs.items()
    }


def _computed(kernel: Kernel, groups: Mapping[str, Array], count: int) -> dict[str, Array]:
    """The outputs of a kernel for ``count`` rows; values that are not finite are returned unchanged."""
    out = {name: np.empty((count, *output.shape)) for name, output in kernel.program.outputs.items()}
    try:
        kernel(**groups, out=out)
    except RunError as trouble:
        if trouble.code != NOT_FINITE:
            raise
    return out
