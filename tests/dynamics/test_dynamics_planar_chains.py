"""Planar chains: closed forms, linear cost, accuracy."""

import mpmath
import numpy as np
import pytest
from dynamics_models import chain, graph_chain, run, state

from lagrangian.dynamics import programs
from lagrangian.graph import count_program


def closed_form(model, at, relative):
    """M θ̈ = −h of the chain of point masses in absolute angles, the textbook's sums.

    M_ij = μ_ij L_i L_j cos(θ_i − θ_j),  h_i = Σ_j μ_ij L_i L_j sin(θ_i − θ_j) θ̇_j² + g L_i sin θ_i Σ_{k ≥ i} m_k,
    μ_ij the mass from max(i, j) outwards.
    """
    p = dict(zip([x.name for x in model.parameters], at["p"], strict=True))
    n = len(model.coordinates)
    m = np.array([p[f"m{i}"] for i in range(n)])
    L = np.array([p[f"L{i}"] for i in range(n)])
    theta, omega = np.array(at["q"]), np.array(at["v"])
    if relative:
        theta, omega = np.cumsum(theta), np.cumsum(omega)
    outer = np.cumsum(m[::-1])[::-1]
    i, j = np.indices((n, n))
    weight = outer[np.maximum(i, j)] * L[i] * L[j]
    apart = theta[i] - theta[j]
    h = (weight * np.sin(apart)) @ omega**2 + p["g"] * L * np.sin(theta) * outer
    acc = np.linalg.solve(weight * np.cos(apart), -h)
    return np.diff(acc, prepend=0) if relative else acc


@pytest.mark.parametrize("relative", [False, True])
@pytest.mark.parametrize("n", [1, 2, 3, 7])
def test_accelerations_against_the_closed_form(n, relative):
    model = chain(n, relative=relative)
    for seed in range(3):
        at = state(model, seed)
        expected = closed_form(model, at, relative)
        assert run(programs.forward(model), at)["a"] == pytest.approx(expected, rel=1e-9, abs=1e-9)


@pytest.mark.slow
@pytest.mark.sampled(2)
@pytest.mark.parametrize(("relative", "limit"), [(False, 18), (True, 19)])
def test_cost_a_link_is_constant(relative, limit):
    counts = {n: count_program(graph_chain(n, relative=relative)) for n in (8, 16, 64, 256, 1000)}
    for n, count in counts.items():
        assert count.sincos == n
        assert count.operations <= limit * n
    assert (
        counts[1000].operations - counts[256].operations == 744 * (counts[256].operations - counts[64].operations) / 192
    )


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("relative", "limit"), [(False, 33), (True, 35)])
def test_cost_a_link_with_a_torque_and_a_damper_on_every_coordinate(relative, limit):
    for n in (8, 64):
        assert count_program(graph_chain(n, relative=relative, torques=True)).operations <= limit * n


def test_a_model_costs_what_its_graph_costs():
    for relative in (False, True):
        model = count_program(programs.forward(chain(8, relative=relative)))
        assert model.operations <= count_program(graph_chain(8, relative=relative)).operations


@pytest.mark.parametrize("relative", [False, True])
def test_digits_of_a_long_chain(relative):
    """Against the same graph in 40 digits: the elimination itself loses few of the sixteen digits."""
    program = graph_chain(64, relative=relative)
    rng = np.random.default_rng(2)
    at = {
        "q": rng.uniform(-1, 1, 64),
        "v": rng.uniform(-1, 1, 64),
        "u": [0.0] * 64,
        "p": [*rng.uniform(0.8, 1.2, 128), 9.81, 0.0],
    }
    exact = run(program, at, digits=40)["a"]
    close = run(program, at)["a"]
    with mpmath.workdps(40):
        error = max(abs(x - float(y)) for x, y in zip(close, exact, strict=True))
    assert error < 1e-11 * max(abs(float(y)) for y in exact)


@pytest.mark.parametrize(("n", "relative", "most"), [(6, True, 500), (6, False, 280), (14, True, 3_150)])
def test_the_coriolis_matrix_of_a_chain_grows_with_the_square_of_its_length(n, relative, most):
    """C_ij = μ_ij L_i L_j sin(θ_i − θ_j) θ̇_j in absolute angles θ = J q, and Jᵀ C J in relative ones."""
    model = chain(n, relative=relative)
    at, made = state(model, 1), programs.coriolis(model)
    p = dict(zip([x.name for x in model.parameters], at["p"], strict=True))
    m, L = (np.array([p[f"{letter}{i}"] for i in range(n)]) for letter in "mL")
    J = np.tril(np.ones((n, n))) if relative else np.eye(n)
    theta, omega = J @ at["q"], J @ at["v"]
    i, j = np.indices((n, n))
    C = np.cumsum(m[::-1])[::-1][np.maximum(i, j)] * L[i] * L[j] * np.sin(theta[i] - theta[j]) * omega[j]
    assert run(made, at)["C"] == pytest.approx(J.T @ C @ J, rel=1e-11, abs=1e-11)
    assert count_program(made).operations <= most  # 7 792 for the longest, if M v is multiplied out
