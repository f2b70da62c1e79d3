"""Detects runs that stick where ẋ jumps: no step is short enough there, however many are made.

A surface is s(x, u, p, t) = 0, s = a − b, where the right-hand side may jump: sign s, |s|, or a condition a < b. If ẋ
leads to the surface from both of its sides,

    ṡ < 0 for s > 0 and ṡ > 0 for s < 0,        ṡ = ∇s·f + ∂s/∂t,

the motion cannot leave it: it slides along it, or rests (A. F. Filippov, Differential Equations with Discontinuous
Righthand Sides, 1988, section 4). A method jumps to and fro across it in steps that become ever shorter.
"""

from __future__ import annotations

import threading

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen import Kernel, compile
from lagrangian.errors import RunError
from lagrangian.graph import Output, Program, jacobian, jvp, operands, reached
from lagrangian.integrate.guards import guards
from lagrangian.records import dataclass

Array = NDArray[np.float64]

LEAST = 256
"""The smallest number of steps between two checks of a run's progress."""

NEAR = 1e-6
"""A state counts as on a surface if ẋ carries it there within this fraction of the run's time."""

ASIDE = 1e-9
"""The smallest relative distance from a surface at which its sides are examined."""

RESTS = 1e-3
"""If the speed along its normal is below this fraction of the speed towards a surface, a state rests on it."""

TROUBLE = ("E502", "E503")


def jumps(program: Program) -> list[tuple[int, int]]:
    """The pairs (a, b) of nodes whose order can make the right-hand side jump (as in s/|s|) and that depend on the
    state."""
    graph, nodes = program.graph, program.graph.nodes
    live = reached(graph, program.ids)
    state: dict[int, bool] = {}
    for i in live:
        node = nodes[i]
        state[i] = node[:2] == ("input", "x") or any(state[k] for k in operands(node))
    found: dict[tuple[int, int], None] = {}
    _, conditions = guards(program)
    for i in live:
        node = nodes[i]
        if i in conditions:
            continue
        if node[0] in ("sign", "abs") and state[node[1]]:
            found[node[1], graph.zero] = None
        elif node[0] in ("lt", "le") and (state[node[1]] or state[node[2]]):
            found[node[1], node[2]] = None
    return list(found)


@dataclass
class Pace:
    """The progress of a run at the last check: its time, and the number of steps tried."""

    time: float
    tried: int = 0

    def hopeless(self, time: float, tried: int, end: float, most: int, least: int = LEAST) -> bool:
        """Whether, at the pace since the last check, the remaining steps do not reach the end; this becomes the last
        check if at least ``least`` steps have been tried since."""
        steps = tried - self.tried
        if steps < least:
            return False
        gained, self.time, self.tried = time - self.time, time, tried
        return gained * (most - tried) < (end - time) * steps


class Sticking:
    """Decides whether a run of ``rates`` sticks where its right-hand side jumps; false if it nowhere jumps."""

    def __init__(self, rates: Program) -> None:
        self.rates, self.pairs = rates, jumps(rates)
        self._field: Kernel | None = None
        self._surfaces: Kernel | None = None
        self._lock = threading.Lock()

    def __bool__(self) -> bool:
        return bool(self.pairs)

    def at(self, x: Array, u: Array, p: Array, t: float, reach: float, step: float = 0.0) -> bool:
        """Whether a state (nx,) sticks to a surface; see `among`."""
        return bool(self.among(x[np.newaxis], u, p, np.array([t]), reach, step)[0])

    def among(self, x: Array, u: Array, p: Array, t: Array, reach: float, step: float = 0.0) -> NDArray[np.bool_]:
        """Which of the states x (n, nx) at times t (n,) stick to a surface; u and p are rows (n, …), or one for all.

        ``reach`` [s]: a state is on a surface if ẋ carries it there within this time, or if a step of length ``step``
        that began on the other side does. A state that rests exactly on the surface does not stick, nor does one with
        no finite values beside it.
        """
        field, surfaces = self._kernels()
        x = np.ascontiguousarray(x)
        known, here = self._called(surfaces, x, u, p, t), self._called(field, x, u, p, t)["xdot"]
        stuck = np.zeros(len(x), bool)
        for k in range(len(self.pairs)):
            s, normal = known["s"][:, k], known["normal"][:, k]
            length = (normal * normal).sum(axis=1)
            aside = 2 * np.abs(s) + ASIDE * (np.abs(normal) * (np.abs(x) + ASIDE)).sum(axis=1)
            speeds = []
            for side in (1.0, -1.0):
                beside = x + ((side * aside - s) / np.where(length > 0, length, 1.0))[:, np.newaxis] * normal
                rate, drift = self._called(field, beside, u, p, t)["xdot"], self._called(surfaces, beside, u, p, t)
                speeds.append(-side * ((drift["normal"][:, k] * rate).sum(axis=1) + drift["drift"][:, k]))
            slow, fast = np.minimum(*speeds), np.maximum(*speeds)
            near = (aside <= reach * slow) | (aside <= 2 * step * fast)
            moves = np.abs((normal * here).sum(axis=1) + known["drift"][:, k]) > RESTS * slow
            stuck |= (slow > 0) & near & moves & np.isfinite(length) & (length > 0)  # no: ẋ is continuous and 0 there
        return stuck

    def _kernels(self) -> tuple[Kernel, Kernel]:
        with self._lock:
            if self._field is None or self._surfaces is None:
                self._field, self._surfaces = compile(self.rates, threads=1), compile(self.surfaces(), threads=1)
            return self._field, self._surfaces

    def _called(self, kernel: Kernel, x: Array, u: Array, p: Array, t: Array) -> dict[str, Array]:
        """The outputs at every state, finite or not."""
        given = {"x": x, "u": u, "p": p, "t": t}
        made = {name: np.empty((len(x), *output.shape)) for name, output in kernel.program.outputs.items()}
        try:
            kernel(
                **{name: value for name, value in given.items() if name in kernel.program.inputs},
                out=made if len(made) > 1 else made["xdot"],
            )
        except RunError as trouble:
            if trouble.code not in TROUBLE:
                raise
        return made

    def surfaces(self) -> Program:
        """Return the program of ``s`` (m,), ``normal`` = ∂s/∂x (m, nx) and ``drift`` = ∂s/∂t (m,)."""
        program, g = self.rates, self.rates.graph
        n, m = len(program.inputs["x"]), len(self.pairs)
        s = [g.sub(a, b) for a, b in self.pairs]
        entries = jacobian(g, s, [g.input("x", k) for k in range(n)])
        normal = tuple(entries.get((i, k), g.zero) for i in range(m) for k in range(n))
        drift = tuple(jvp(g, s, {g.input("t", 0): g.one}))
        outputs = {"s": Output(tuple(s), (m,)), "normal": Output(normal, (m, n)), "drift": Output(drift, (m,))}
        return Program(f"{program.name} surfaces", g, program.inputs, outputs, program.defaults)
