"""The oracle's answers about 500 random systems, kept in `answers.npz`: quotients of 60 digits take minutes.

``python tests/oracle/answers.py`` computes all of them anew; the tests that take long do so for some and compare.
A family is an array with a row for each seed, padded with NaN.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import mpmath as mp
import numpy as np
from differences import DIGITS
from numpy.typing import NDArray
from random_systems import Case, energies, floating, plane, space

FAMILIES = {"plane": plane, "space": space, "energies": energies, "floating": floating}
SEEDS = range(100, 225)
FILE = Path(__file__).with_name("answers.npz")

Array = NDArray[np.float64]


def is_further(seed: int) -> bool:
    """Whether slopes of the accelerations, and exports, are asked for, too."""
    return seed % 5 == 0


@dataclass
class State:
    """Coordinates, rates and accelerations of the oracle, and t; ``chart`` is the acceleration that its chart of a
    floating frame has beyond that of the velocities in the frame's own axes."""

    q: Array
    v: Array
    a: Array
    t: float
    chart: Array


def state_of(case: Case, seed: int) -> State:
    source, n = random.Random(seed), case.oracle.n
    q, v, a = (np.array([source.uniform(0.2, 1.1) for _ in range(n)]) for _ in range(3))
    chart = np.zeros(n)
    if case.pose:
        q[:6] = 0.0
        chart[:3] = np.cross(v[3:6], v[:3])
    return State(q, v, a, source.uniform(0.1, 1.0), chart)


@dataclass
class Answers:
    """M, M q̈ + h and h at a state, the q̈ without other forces, T, V, ∂V/∂q, and ∂q̈/∂[q; v] where it is asked for."""

    M: Array
    residual: Array
    bias: Array
    forward: Array
    energies: Array
    gravity: Array
    slopes: Array


def shapes(n: int, further: bool) -> list[tuple[int, ...]]:
    """The shapes of the fields of `Answers`."""
    return [(n, n), (n,), (n,), (n,), (2,), (n,), (n, 2 * n) if further else (0,)]


def computed(case: Case, seed: int, further: bool) -> Answers:
    """The oracle's answers by quotients; where they are ``further``, M q̈ + h comes from its definition, too."""
    oracle, s = case.oracle, state_of(case, seed)
    with mp.workdps(DIGITS):
        Q, W, A, (t,) = ([mp.mpf(x) for x in values] for values in (s.q, s.v, s.a + s.chart, [s.t]))
        M = oracle.mass_matrix(Q, t)
        bias = oracle.residual(Q, W, [mp.mpf(x) for x in s.chart], t)
        residual = oracle.residual(Q, W, A, t) if further else list(mp.matrix(M) * mp.matrix(s.a) + mp.matrix(bias))
        forward = list(mp.lu_solve(mp.matrix(M), -mp.matrix(bias)))
        found = [M, residual, bias, forward, [oracle.T(Q, W, t), oracle.V(Q, t)], oracle.gravity(Q, t)]
        found.append(_slopes(case, Q, W, t) if further and not case.pose else [])
    return Answers(*(np.array(x, dtype=float) for x in found))


def _slopes(case: Case, q: list[mp.mpf], v: list[mp.mpf], t: mp.mpf) -> list[list[mp.mpf]]:
    """∂q̈/∂[q; v]."""
    n, x, h = case.oracle.n, [*q, *v], mp.mpf(10) ** -5
    columns = []
    for k in range(2 * n):
        ends = []
        for sign in (1, -1):
            y = [e + sign * h * (i == k) for i, e in enumerate(x)]
            ends.append(case.oracle.accelerations(y[:n], y[n:], t))
        columns.append([(a - b) / (2 * h) for a, b in zip(*ends, strict=True)])
    return [list(row) for row in zip(*columns, strict=True)]


@cache
def _file() -> dict[str, Array]:
    with np.load(FILE) as data:
        return dict(data)


def stored(family: str, case: Case, seed: int) -> Answers:
    """The answers that are kept."""
    row, wanted = _file()[family][seed - SEEDS.start], shapes(case.oracle.n, is_further(seed) and not case.pose)
    ends = np.cumsum([int(np.prod(s)) for s in wanted])
    assert np.isfinite(row[: ends[-1]]).all() and np.isnan(row[ends[-1] :]).all(), (family, seed)
    return Answers(*(x.reshape(s) for x, s in zip(np.split(row, ends)[:-1], wanted, strict=True)))


def main() -> None:
    """Compute and keep all answers."""
    arrays = {}
    for family, build in FAMILIES.items():
        rows = [np.concatenate([x.ravel() for x in vars(computed(build(s), s, is_further(s))).values()]) for s in SEEDS]
        arrays[family] = np.full((len(rows), max(map(len, rows))), np.nan)
        for kept, row in zip(arrays[family], rows, strict=True):
            kept[: len(row)] = row
    np.savez_compressed(FILE, **arrays)


if __name__ == "__main__":
    main()
