"""Accelerations and multipliers of the built-in examples with constraints against dense matrices of numbers."""

from __future__ import annotations

import numpy as np
import pytest
from built_in_mechanisms import ORACLES

import built_in
from built_in import CONSTRAINED, LARGE
from size import rest_slow


def test_every_example_with_constraints_has_an_oracle() -> None:
    assert set(ORACLES) == set(CONSTRAINED)


@pytest.mark.thinned(2)
@pytest.mark.sampled(12)
@pytest.mark.parametrize("name", rest_slow(CONSTRAINED, set(CONSTRAINED) - LARGE))
def test_accelerations_and_multipliers_are_those_of_dense_matrices(name: str) -> None:
    system = built_in.system(name)
    model, dyn = system.model, system.compile()
    p = {x.name: float(x.value or 0.0) for x in model.parameters}
    oracle = ORACLES[name](p)
    given, rng = system.simulate(0.001), np.random.default_rng(4)
    for _ in range(2):
        guess = given.y[: len(dyn.coordinates), 0] + 0.05 * rng.uniform(-1, 1, len(dyn.coordinates))
        q, v = dyn.assemble(guess, rng.uniform(-1, 1, len(dyn.velocities)))
        if name == "stewart-platform":
            q[3:7] /= np.linalg.norm(q[3:7])  # a quaternion of any length stands for the same turn
        u = rng.uniform(-1, 1, len(model.inputs))
        M, h, A, gamma = oracle.numbers.equations(q, v)
        m = len(A)
        saddle = np.block([[M, -A.T], [A, np.zeros((m, m))]])
        known = np.r_[np.array(oracle.forces(q, v, u), float) - h, -gamma]
        found = np.linalg.lstsq(saddle, known, rcond=1e-12)[0]
        vdot, lam = found[: len(M)], found[len(M) :]
        assert np.abs(np.array(oracle.numbers.gaps(q), float)).max(initial=0) < 1e-12
        assert np.abs(oracle.numbers.rows(q, v)[1]).max() < 1e-11
        size = 1 + np.abs(vdot).max()
        assert np.abs(dyn.forward(q, v, u) - vdot).max() < 1e-10 * size
        if np.linalg.matrix_rank(A, tol=1e-9) == m:
            wanted = lam if oracle.order is None else lam[oracle.order]
            got = np.array(list(dyn.multipliers(q, v, u).values()))
            assert np.abs(got - wanted).max() < 1e-10 * (1 + np.abs(lam).max())
        else:
            assert name == "double-parallelogram"
