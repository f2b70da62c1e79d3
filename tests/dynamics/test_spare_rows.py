"""Accelerations beside the constraints where one row is known to be spare, against dense matrices of known rank."""

import numpy as np
import pytest

from lagrangian import dynamics
from lagrangian.graph import evaluate
from lagrangian.model.spare import SpareRows
from redundant_systems import CRANK, INERTIA, WEIGHT, plate_on_cranks

PLAIN = plate_on_cranks().model
NAMES = tuple(f"p{k}.{axis}" for k in range(3) for axis in "xy")
KNOWING = PLAIN.sparing((SpareRows(NAMES, 1),))
ANGLES = [1.0, 0.3, 0.0171, 0.001, -0.7, -np.pi / 2, 2.5]


def state(a, off, seed=0):
    """A position and velocities of the closed plate, each moved by ``off``."""
    rate = -2.0
    q = np.array([a, a, a, CRANK * np.cos(a), CRANK * np.sin(a), 0.0])
    v = rate * np.array([1, 1, 1, -CRANK * np.sin(a), CRANK * np.cos(a), 0])
    rng = np.random.default_rng(seed)
    return q + off * rng.uniform(-1, 1, 6), v + off * rng.uniform(-1, 1, 6)


def values(program, q, v):
    given = {"q": q.tolist(), "v": v.tolist(), "u": [], "p": [x.value for x in PLAIN.parameters], "t": [0.0]}
    return {name: np.array(x) for name, x in evaluate(program, given).items()}


def of_rank_five(q, v):
    """v̇ by an SVD of A M^(−1/2) of which the five largest singular values are kept."""
    M, h = values(dynamics.mass_matrix(PLAIN), q, v)["M"].reshape(6, 6), values(dynamics.bias(PLAIN), q, v)["h"]
    rows = values(dynamics.constraint_matrix(PLAIN), q, v)
    L = np.linalg.cholesky(M)
    B = np.linalg.solve(L, rows["A"].reshape(6, 6).T).T
    left, sizes, right = np.linalg.svd(B)
    inverse = right[:5].T @ np.diag(1 / sizes[:5]) @ left[:, :5].T
    free = np.linalg.solve(L, -h)
    return np.linalg.solve(L.T, free - inverse @ (B @ free + rows["gamma"]))


@pytest.mark.parametrize("a", ANGLES)
def test_on_the_constraints_the_angle_moves_as_with_one_coordinate(a):
    found = values(dynamics.forward(KNOWING), *state(a, 0.0))["a"]
    assert found[:3] == pytest.approx(-WEIGHT / INERTIA * np.cos(a), abs=1e-11)


@pytest.mark.sampled(7)
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("a", [1.0, 0.3, -0.7, -np.pi / 2, 2.5])
def test_beside_the_constraints_the_error_is_of_the_size_of_the_gap(a, seed):
    """Whichever row is left out, v̇ differs from that of rank 5 in proportion to the gap; a tiny pivot would give any
    number."""
    for off in (1e-3, 1e-4, 1e-5, 1e-6):
        q, v = state(a, off, seed)
        found, dense = values(dynamics.forward(KNOWING), q, v)["a"], of_rank_five(q, v)
        assert np.abs(found - dense).max() < 300 * off


def test_without_that_knowledge_the_pivot_of_the_spare_row_is_noise():
    errors = []
    for seed in range(8):
        q, v = state(0.3, 1e-5, seed)
        errors.append(np.abs(values(dynamics.forward(PLAIN), q, v)["a"] - of_rank_five(q, v)).max())
    assert max(errors) > 0.1


@pytest.mark.parametrize("a", [1.0, 0.3, -0.7, 2.5])
def test_exactly_one_row_is_left_out_and_the_others_carry_the_load(a):
    q, v = state(a, 0.0)
    lam = values(dynamics.multipliers(KNOWING), q, v)["lam"]
    rows = values(dynamics.constraint_matrix(PLAIN), q, v)
    M, h = values(dynamics.mass_matrix(PLAIN), q, v)["M"].reshape(6, 6), values(dynamics.bias(PLAIN), q, v)["h"]
    vdot = values(dynamics.forward(KNOWING), q, v)["a"]
    assert (lam == 0).sum() == 1
    assert rows["A"].reshape(6, 6).T @ lam == pytest.approx(M @ vdot + h, abs=1e-9)


def test_corrections_of_a_state_close_every_row():
    """Newton steps that leave one row out reach a position that satisfies it too."""
    position, velocity = dynamics.projection(KNOWING)
    q, v = state(-np.pi / 2, 1e-3)
    for _ in range(4):
        found = evaluate(position, {"x": [*q, *v], "u": [], "p": [x.value for x in PLAIN.parameters], "t": [0.0]})
        q = q + np.array(found["dx"])[:6]
    found = evaluate(velocity, {"x": [*q, *v], "u": [], "p": [x.value for x in PLAIN.parameters], "t": [0.0]})
    v = v + np.array(found["dx"])[6:]
    left = values(dynamics.residual(PLAIN), q, v)
    assert max(np.abs(x).max() for x in left.values()) < 1e-13
