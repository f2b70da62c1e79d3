"""Moves many guesses at once onto the rows that a motion must satisfy, by damped Newton steps.

    δq = −N M⁻¹ Aᵀ (A M⁻¹ Aᵀ)⁺ f,        δv = −M⁻¹ Aᵀ (A M⁻¹ Aᵀ)⁺ (A v + a₀)

The programs that compute the corrections, or M, A and N, are made elsewhere. A step changes no angle by more than
1 rad, and it is halved while it makes the gap larger.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen import Kernel, compile
from lagrangian.errors import RunError
from lagrangian.graph import Program, evaluate
from lagrangian.records import dataclass

Array: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]

MAX_STEPS = 60
"""The largest number of Newton steps; a start that converges needs about five."""

NUDGE = -0.01
"""How far a guess is moved at which the rows have no direction."""

HALVINGS = 12
"""The largest number of times that one step is halved."""

MAX_TURN = 1.0
"""[rad] The largest change of an angle in one step."""

SETTLED = 1e-12
"""A step of this size relative to the coordinates ends the search."""

SEEN = 1e-9
"""A larger change of a gap than this is not rounding."""

CLOSED = 1e-11
"""A gap of this size relative to its terms counts as closed."""


SAME_WAY = 1e-10
"""Rows whose directions differ by less than this, as the sine of the angle, say the same."""

KEPT = 1e-9
"""A velocity row whose residual is larger than this, relative to its terms, is not satisfied."""


def _values(kernel: Kernel, q: Array, p: Array, t: float) -> dict[str, Array]:
    """The outputs of a kernel at positions (guesses, n) at rest; values that are not finite are returned unchanged."""
    out = {name: np.empty((len(q), *output.shape)) for name, output in kernel.program.outputs.items()}
    try:
        kernel(q=q, p=p, t=t, out=out)
    except RunError as trouble:
        if trouble.code != "E503":
            raise
    return out


def kernel_of(program: Program) -> Kernel:
    """A program of a position, compiled; v, u and t are 0 unless given."""
    return program.remembered("closing", lambda: compile(program, optional={"u": 0.0, "v": 0.0, "t": 0.0}))


@dataclass(frozen=True)
class Closing:
    """The programs that move a state onto its rows; it can be sent to another process.

    All are over the groups q, v, u, p, t. ``position`` has the output ``dq``, ``velocity`` the output ``dv``, each the
    step that satisfies the rows to first order (None without such rows); ``rows`` has ``f`` of the rows on positions
    and ``Av`` of all, ``matrix`` has ``A`` and ``a0``.
    """

    position: Program | None
    velocity: Program | None
    rows: Program
    matrix: Program

    def closed(self, x: Array, p: Array, t: float) -> tuple[Array, Flags]:
        """States x (runs, nx) moved onto the rows, and which of them satisfy the rows."""
        n = len(self.rows.inputs["q"])
        q, arrived = x[:, :n], np.ones(len(x), bool)
        if self.position is not None:
            q, arrived = LoopSearch(CompiledRows(self)).run(q, p, t)
        v, kept = self.rates(q, x[:, n : n + len(self.rows.inputs["v"])], p, t)
        return np.concatenate([q, v, x[:, n + v.shape[1] :]], axis=1), arrived & kept.all(axis=-1)

    def rates(self, q: Array, v: Array, p: Array, t: float) -> tuple[Array, Flags]:
        """The velocities nearest to v that satisfy the rows, and which rows they satisfy, (…, rows)."""
        assert self.velocity is not None
        correct, rows, matrix = (kernel_of(program) for program in (self.velocity, self.rows, self.matrix))
        for _ in range(2):  # the second takes the rounding of the first away
            v = v + np.asarray(correct(q, v, None, p, t)["dv"])
        left = np.abs(np.asarray(rows(q, v, None, p, t)["Av"]))
        found: dict[str, Any] = matrix(q, None, None, p, t)
        terms = np.einsum("...ij,...j->...i", np.abs(found["A"]), np.abs(v)) + np.abs(found["a0"])
        return v, left <= KEPT * (1e-3 + terms)


class PositionRows(Protocol):
    """The rows on positions at q (guesses, n), for parameters (np,), or different ones for each guess."""

    def step(self, q: Array, p: Array, t: float) -> Array:
        """δq (guesses, n), the least step that satisfies the rows to first order."""
        ...

    def gaps(self, q: Array, p: Array, t: float) -> Array:
        """f of every row, shape (guesses, rows)."""
        ...

    def sizes(self, q: Array, p: Array, t: float) -> Array:
        """The largest |A_rj| of each guess, (guesses,)."""
        ...


class CompiledRows:
    """Rows as machine code, with an elimination made for them: for many guesses, and for long chains of loops."""

    def __init__(self, programs: Closing) -> None:
        assert programs.position is not None
        self._correct, self._rows = kernel_of(programs.position), kernel_of(programs.rows)
        self._matrix = kernel_of(programs.matrix)

    def step(self, q: Array, p: Array, t: float) -> Array:
        """See `PositionRows`."""
        return _values(self._correct, q, p, t)["dq"]

    def gaps(self, q: Array, p: Array, t: float) -> Array:
        """See `PositionRows`."""
        return _values(self._rows, q, p, t)["f"]

    def sizes(self, q: Array, p: Array, t: float) -> Array:
        """See `PositionRows`."""
        return np.abs(_values(self._matrix, q, p, t)["A"]).max(axis=(-1, -2))


class DenseRows:
    """Rows as numbers, with dense matrices: for one guess, which needs neither an elimination nor machine code.

    ``terms`` has the outputs f, A, M and N over q, v, u, p, t. The step is Newton's, δ₀ = −A⁺ f, plus the motion
    within the null space Z of A that makes ½ δᵀ M δ the least.
    """

    def __init__(self, terms: Program) -> None:
        self._terms, self._residual = terms, replace(terms, outputs={"f": terms.outputs["f"]})

    def step(self, q: Array, p: Array, t: float) -> Array:
        """See `PositionRows`."""
        return np.array([self._step(x, p, t) for x in q])

    def gaps(self, q: Array, p: Array, t: float) -> Array:
        """See `PositionRows`."""
        return np.array([self._at(self._residual, x, p, t)["f"] for x in q])

    def sizes(self, q: Array, p: Array, t: float) -> Array:
        """See `PositionRows`."""
        return np.array([np.abs(self._at(self._terms, x, p, t)["A"]).max() for x in q])

    def _at(self, program: Program, q: Array, p: Array, t: float) -> dict[str, Any]:
        groups = program.inputs
        rest = {name: [0.0] * len(groups[name]) for name in ("v", "u")}
        return evaluate(program, {"q": q.tolist(), "p": p.tolist(), "t": [t], **rest})

    def _step(self, q: Array, p: Array, t: float) -> Array:
        terms = self._at(self._terms, q, p, t)
        f, A, M, N = (np.array(terms[name], float) for name in ("f", "A", "M", "N"))
        if not all(np.isfinite(x).all() for x in (f, A, M)):
            return np.full(len(N), np.nan)
        return N @ least_step(f, A, M)


def least_step(f: Array, A: Array, M: Array) -> Array:
    """The least δ (n,), by ½ δᵀ M δ, with A δ = −f (rows,); rows that say the same are taken once."""
    sizes = np.linalg.norm(A, axis=1)
    sizes[sizes == 0.0] = 1.0  # nothing moves this row: it is skipped
    U, s, W = np.linalg.svd(A / sizes[:, None])
    rank = int((s > SAME_WAY * s[0]).sum())
    delta = -W[:rank].T @ ((U[:, :rank].T @ (f / sizes)) / s[:rank])
    Z = W[rank:].T
    inside = Z.T @ M @ Z
    return delta - Z @ (np.linalg.pinv(inside, hermitian=True) @ (Z.T @ (M @ delta)))


class LoopSearch:
    """Positions that satisfy the rows, from many guesses at once."""

    def __init__(self, rows: PositionRows) -> None:
        self.rows = rows

    def angles(self, q: Array, p: Array, t: float) -> Flags:
        """Which coordinates are angles: the rows depend on them, but do not change after a full turn."""
        return self.moving(q, p, t) & ~self._changes(q, p, t, [2 * np.pi])

    def moving(self, q: Array, p: Array, t: float) -> Flags:
        """Which coordinates the rows depend on."""
        return self._changes(q, p, t, [0.37, 1.1])

    def _changes(self, q: Array, p: Array, t: float, by: list[float]) -> Flags:
        """Which coordinates change the gaps by more than rounding when they are changed, at one of three places."""
        n = len(q)
        places = np.array([q, q + np.linspace(0.3, 1.1, n), q - np.linspace(0.7, 0.2, n)])
        moves = np.concatenate([np.zeros((1, n)), *(step * np.eye(n) for step in by)])
        gaps = self.gaps((places[:, None] + moves).reshape(-1, n), p, t).reshape(len(places), len(moves), -1)
        here, there = gaps[:, :1], gaps[:, 1:]
        found = np.abs(there - here).max(axis=-1) > SEEN * (1.0 + np.abs(here).max(axis=-1))
        return found.reshape(-1, n).any(axis=0)

    def gaps(self, q: Array, p: Array, t: float) -> Array:
        """f of every row on positions, shape (guesses, rows)."""
        return self.rows.gaps(q, p, t)

    def closed(self, q: Array, p: Array, t: float) -> Flags:
        """Whether every gap is rounding, compared with the sum of its terms Σ |A_rj| |q_j|."""
        scale = 1.0 + self.rows.sizes(q, p, t) * np.maximum(np.abs(q).max(axis=-1), 1.0)
        return np.abs(self.gaps(q, p, t)).max(axis=-1) <= CLOSED * scale

    def run(self, guesses: Array, p: Array, t: float) -> tuple[Array, Flags]:
        """Move every guess (guesses, n) towards the rows; return the results, and which of them closed.

        Parameters are the same for all guesses, (np,), or different for each, (guesses, np).
        """
        q, start = guesses.copy(), guesses[0].copy()
        step = self._step(q, p, t, start)
        lost = ~np.isfinite(step).all(axis=-1)  # as where the two ends of a rod coincide
        if lost.any():
            q[lost] += NUDGE * np.linspace(0.3, 1.0, q.shape[1])
            step[lost] = self._step(q[lost], p if p.ndim == 1 else p[lost], t, start)
        going = np.arange(len(q))
        for _ in range(MAX_STEPS):
            own = p if p.ndim == 1 else p[going]
            q[going], settled = self._damped(q[going], np.nan_to_num(step, posinf=0.0, neginf=0.0), own, t)
            going = going[~settled]
            if not len(going):
                break
            step = self._step(q[going], p if p.ndim == 1 else p[going], t, start)
        return q, self.closed(q, p, t)

    def _step(self, q: Array, p: Array, t: float, start: Array) -> Array:
        """A step that changes no angle by more than `MAX_TURN`; which coordinates are angles is asked at ``start``."""
        step = self.rows.step(q, p, t)
        if not (np.abs(step) > MAX_TURN).any():
            return step
        angles = self.angles(start, p if p.ndim == 1 else p[0], t)
        turn = np.abs(np.where(angles, step, 0.0)).max(axis=-1, keepdims=True)
        return step * np.minimum(1.0, MAX_TURN / np.maximum(turn, MAX_TURN))

    def _damped(self, q: Array, step: Array, p: Array, t: float) -> tuple[Array, Flags]:
        """q after a step that does not enlarge the gap, and whether the search ended there."""
        before = np.linalg.norm(self.gaps(q, p, t), axis=-1)
        tiny = np.abs(step).max(axis=-1) <= SETTLED * (1.0 + np.abs(q).max(axis=-1))

        def enlarged(q: Array) -> Flags:
            return (np.linalg.norm(self.gaps(q, p, t), axis=-1) > before) & ~tiny

        length, halvings = np.ones((len(q), 1)), 0
        taken = q + step
        worse = enlarged(taken)
        while worse.any() and halvings < HALVINGS:
            length[worse] *= 0.5
            taken = q + length * step
            worse, halvings = enlarged(taken), halvings + 1
        return np.where(worse[:, None], q, taken), tiny | worse
