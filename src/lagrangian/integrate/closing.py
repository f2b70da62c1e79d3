"""Many guesses at once, each moved onto the rows that a motion must keep by damped Newton steps.

    δq = −N M⁻¹ Aᵀ (A M⁻¹ Aᵀ)⁺ f,        δv = −M⁻¹ Aᵀ (A M⁻¹ Aᵀ)⁺ (A v + a₀)

The programs come from outside: what is corrected by how much is their business. A step turns no angle by more than
1 rad, and is halved while it makes the gap larger.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen import Kernel, compile
from lagrangian.graph import Program

Array: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]

MAX_STEPS = 60
"""Newton steps: a start that is going to close needs five."""

HALVINGS = 12
"""How often one step is halved."""

MAX_TURN = 1.0
"""[rad] The most that one step turns an angle."""

SETTLED = 1e-12
"""A step of this part of the coordinates ends the search."""

SEEN = 1e-9
"""A change of a gap that is more than rounding."""

CLOSED = 1e-11
"""A gap of this part of the terms that make it up is none."""


KEPT = 1e-9
"""A velocity row that is left with more than this part of its terms is not satisfied."""


def _kernel(program: Program) -> Kernel:
    return program.remembered("closing", lambda: compile(program, optional={"u": 0.0, "v": 0.0, "t": 0.0}))


@dataclass(frozen=True)
class Closing:
    """The programs that bring a state onto its rows; small, and can be sent to another process.

    All are over the groups q, v, u, p, t. ``position`` has the output ``dq``, ``velocity`` the output ``dv``, each the
    step that satisfies the rows to first order (None without such rows); ``rows`` has ``f`` of the rows on positions
    and ``Av`` of all, ``matrix`` has ``A`` and ``a0``.
    """

    position: Program | None
    velocity: Program | None
    rows: Program
    matrix: Program

    def closed(self, x: Array, p: Array, t: float) -> tuple[Array, Flags]:
        """States x (runs, nx) brought onto the rows from where they are, and which of them arrived there."""
        n = len(self.rows.inputs["q"])
        q, arrived = x[:, :n], np.ones(len(x), bool)
        if self.position is not None:
            q, arrived = LoopSearch(self).run(q, p, t)
        v, kept = self.rates(q, x[:, n : n + len(self.rows.inputs["v"])], p, t)
        return np.concatenate([q, v, x[:, n + v.shape[1] :]], axis=1), arrived & kept.all(axis=-1)

    def rates(self, q: Array, v: Array, p: Array, t: float) -> tuple[Array, Flags]:
        """The velocities nearest to v that satisfy the rows, and which rows they satisfy, (…, rows)."""
        assert self.velocity is not None
        correct, rows, matrix = (_kernel(program) for program in (self.velocity, self.rows, self.matrix))
        for _ in range(2):  # the second takes the rounding of the first away
            v = v + np.asarray(correct(q, v, None, p, t)["dv"])
        left = np.abs(np.asarray(rows(q, v, None, p, t)["Av"]))
        found: dict[str, Any] = matrix(q, None, None, p, t)
        terms = np.einsum("...ij,...j->...i", np.abs(found["A"]), np.abs(v)) + np.abs(found["a0"])
        return v, left <= KEPT * (1e-3 + terms)


class LoopSearch:
    """Positions that satisfy the rows, from many guesses at once."""

    def __init__(self, programs: Closing) -> None:
        assert programs.position is not None
        self.correct, self.rows = _kernel(programs.position), _kernel(programs.rows)
        self.matrix = _kernel(programs.matrix)

    def angles(self, q: Array, p: Array, t: float) -> Flags:
        """Which coordinates are angles: those that the rows depend on, but not on a whole turn of them."""
        return self.moving(q, p, t) & ~self._changes(q, p, t, [2 * np.pi])

    def moving(self, q: Array, p: Array, t: float) -> Flags:
        """Which coordinates the rows depend on."""
        return self._changes(q, p, t, [0.37, 1.1])

    def _changes(self, q: Array, p: Array, t: float, by: list[float]) -> Flags:
        """Which coordinates change the gaps by more than rounding where they are changed; looked at three places."""
        n = len(q)
        found = np.zeros(n, bool)
        for place in (q, q + np.linspace(0.3, 1.1, n), q - np.linspace(0.7, 0.2, n)):
            here = self.gaps(place[None, :], p, t)
            for step in by:
                there = self.gaps(place + step * np.eye(n), p, t)
                found |= np.abs(there - here).max(axis=-1) > SEEN * (1.0 + np.abs(here).max())
        return found

    def gaps(self, q: Array, p: Array, t: float) -> Array:
        """f of every row on positions, shape (guesses, rows)."""
        return np.asarray(self.rows(q, None, None, p, t)["f"])

    def closed(self, q: Array, p: Array, t: float) -> Flags:
        """Whether every gap is rounding, measured by the terms Σ |A_rj| |q_j| that it is made of."""
        sizes = np.abs(np.asarray(self.matrix(q, None, None, p, t)["A"]))
        scale = 1.0 + sizes.max(axis=(-1, -2)) * np.maximum(np.abs(q).max(axis=-1), 1.0)
        return np.abs(self.gaps(q, p, t)).max(axis=-1) <= CLOSED * scale

    def run(self, guesses: Array, p: Array, t: float) -> tuple[Array, Flags]:
        """Move every guess (rows of (guesses, n)) towards the rows; where it ends, and whether it closed.

        Parameters are the same for all, (np,), or each guess's own, (guesses, np).
        """
        q, angles = guesses.copy(), self.angles(guesses[0], p if p.ndim == 1 else p[0], t)
        going = np.arange(len(q))
        for _ in range(MAX_STEPS):
            own = p if p.ndim == 1 else p[going]
            step = self._step(q[going], own, t, angles)
            q[going], settled = self._damped(q[going], step, own, t)
            going = going[~settled]
            if not len(going):
                break
        return q, self.closed(q, p, t)

    def _step(self, q: Array, p: Array, t: float, angles: Flags) -> Array:
        step = np.asarray(self.correct(q, None, None, p, t)["dq"])
        turn = np.abs(np.where(angles, step, 0.0)).max(axis=-1, keepdims=True)
        return step * np.minimum(1.0, MAX_TURN / np.maximum(turn, MAX_TURN))

    def _damped(self, q: Array, step: Array, p: Array, t: float) -> tuple[Array, Flags]:
        """q after a step that does not enlarge the gap, and whether it has settled there."""
        before = np.linalg.norm(self.gaps(q, p, t), axis=-1)
        tiny = np.abs(step).max(axis=-1) <= SETTLED * (1.0 + np.abs(q).max(axis=-1))
        length = np.ones((len(q), 1))
        taken = q + step
        for _ in range(HALVINGS):
            worse = (np.linalg.norm(self.gaps(taken, p, t), axis=-1) > before) & ~tiny
            if not worse.any():
                break
            length[worse] *= 0.5
            taken = q + length * step
        worse = (np.linalg.norm(self.gaps(taken, p, t), axis=-1) > before) & ~tiny
        return np.where(worse[:, None], q, taken), tiny | worse
