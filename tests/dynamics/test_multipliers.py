"""Accelerations and multipliers along the tape against dense matrices of numbers."""

import mechanisms
import numpy as np
import pytest
from closed_loops import values

SYSTEMS = {
    "slider-crank": mechanisms.slider_crank,
    "four-bar": mechanisms.four_bar,
    "five-bar": mechanisms.five_bar,
    "sleigh": mechanisms.sleigh,
    "disc": mechanisms.rolling_disc,
    "ladder of 2": lambda: mechanisms.ladder(2),
    "ladder of 5": lambda: mechanisms.ladder(5),
}


def random_state(numbers, seed):
    rng = np.random.default_rng(seed)
    return rng.uniform(0.2, 1.2, numbers.n), rng.uniform(-1, 1, numbers.n)


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("seed", range(3))
def test_accelerations_and_multipliers_are_those_of_dense_matrices(name, seed):
    m, numbers, p = SYSTEMS[name]()
    q, v = random_state(numbers, seed)
    vdot, lam = numbers.solution(q, v)
    found = values(m, q, v, p, vdot=m.forward(), lam=m.constrained.multipliers)
    assert np.abs(found["vdot"] - vdot).max() < 1e-12 * (1 + np.abs(vdot).max())
    assert np.abs(found["lam"] - lam).max() < 1e-12 * (1 + np.abs(lam).max())
