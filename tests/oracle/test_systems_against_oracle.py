"""Random systems in the plane, in space, from energies, floating, with circuits: all against difference quotients."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp
from answers import FAMILIES, SEEDS, Answers, State, computed, is_further, state_of, stored
from random_circuits import circuits
from random_systems import Case

from lagrangian.export import sources
from size import rest_slow

TOLERANCE = 1e-9


def close(got: Any, expected: Any, *terms: Any) -> None:
    """Equal up to `TOLERANCE` of the largest term."""
    got, expected = (np.array(np.array(x).tolist(), dtype=float) for x in (got, expected))
    sizes = [np.abs(np.array(np.array(x).tolist(), dtype=float)).max(initial=0.0) for x in (expected, *terms)]
    assert np.abs(got - expected).max(initial=0.0) <= TOLERANCE * max(sizes), (got, expected)


def check(case: Case, at: State, expected: Answers, *, derived: bool = False, further: bool = False) -> None:
    n, u, v, a, t = case.oracle.n, np.array(case.u), at.v, at.a, at.t
    state = np.concatenate([case.pose, at.q[6:]]) if case.pose else at.q
    M, bias = expected.M, expected.bias
    terms = (M * a, bias)
    dyn = case.system.compile()
    close(dyn.mass_matrix(state, t=t), M)
    close(dyn.bias(state, v, u=u, t=t), bias, *terms)
    close(dyn.inverse(state, v, a, u=u, t=t), expected.residual, *terms)
    got = dyn.forward(state, v, u=u, t=t)
    close(M @ (got - expected.forward), np.zeros(n), bias)
    rates = dyn.rates(state, v)
    close(dyn.rhs(t, np.concatenate([state, v]), u=u), np.concatenate([rates, got]))
    close(dyn.energies(state, v, u=u, t=t), expected.energies, expected.energies)
    close(dyn.potential_force(state, u=u, t=t), expected.gravity, bias)
    if derived:
        close(derived_residual(case, at.q, v, a, u, t), expected.residual, *terms)
    if further:
        module = exported(case)
        close(module["dynamics_forward"](state, v, u, (), t), got, got)
        close(module["dynamics_energy"](state, v, u, (), t), expected.energies, expected.energies)
        if not case.pose:
            check_slopes(case, at, expected.slopes)


def exported(case: Case) -> dict[str, Any]:
    """The functions of the exported Python."""
    (text,) = sources(case.system.model, "python", "dynamics").values()
    found: dict[str, Any] = {}
    exec(compile(text, "dynamics.py", "exec"), found)
    return found


def check_slopes(case: Case, at: State, expected: Any) -> None:
    """The lower half of A, ∂q̈/∂[q; v], against quotients of the oracle's accelerations."""
    names = [*(c.name for c in case.system.model.coordinates), *(w.name for w in case.system.model.velocities)]
    point = dict(zip(names, [*at.q, *at.v], strict=True))
    inputs = {i.name: x for i, x in zip(case.system.model.inputs, case.u, strict=True)}
    A = case.system.linearize(at=point, inputs=inputs, time=at.t, operating_point=True).A
    assert np.abs(A[case.oracle.n :] - expected).max() < 1e-7 * max(1.0, np.abs(expected).max())


def derived_residual(case: Case, q: Any, v: Any, a: Any, u: Any, t: float) -> list[float]:
    """The derived equations at a state, left minus right, by substitution."""
    s, d = case.system, case.system.derive()
    assert all(c.holds for c in d.verified), [str(c.what) for c in d.verified if not c.holds]
    x = d.coordinates
    values: dict[Any, float] = {c.diff(s.t, 2): w for c, w in zip(x, a, strict=True)}
    values |= {c.diff(s.t): w for c, w in zip(x, v, strict=True)}
    values |= {**dict(zip(x, q, strict=True)), s.t: t, sp.Symbol("g"): 9.81}
    values |= {i.symbol: w for i, w in zip(s.model.inputs, u, strict=True)}
    put = {name: sp.Float(value) for name, value in values.items()}
    for known in d.definitions:  # long equations are written in named quantities
        put[known.symbol] = known.expression.xreplace(put).evalf()
    return [float((e.lhs - e.rhs).xreplace(put).evalf()) for e in d.equations]


@pytest.mark.sampled(6)
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("family", rest_slow(FAMILIES, set(FAMILIES) - {"floating"}))
def test_random_systems_agree_with_the_oracle(family: str, seed: int) -> None:
    case, further = FAMILIES[family](seed), seed == 1
    derived = seed == 0 and family != "floating"
    check(case, state_of(case, seed), computed(case, seed, further), derived=derived, further=further)


@pytest.mark.thinned(14)
@pytest.mark.slow
@pytest.mark.parametrize("block", range(25))
@pytest.mark.parametrize("family", FAMILIES)
def test_many_random_systems_agree_with_the_oracle(family: str, block: int) -> None:
    for seed in SEEDS[5 * block : 5 * block + 5]:
        case = FAMILIES[family](seed)
        derived = seed % 2 == 0 and family != "floating"
        check(case, state_of(case, seed), stored(family, case, seed), derived=derived, further=is_further(seed))


@pytest.mark.thinned(2)
@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS[3::31])
@pytest.mark.parametrize("family", FAMILIES)
def test_the_stored_answers_are_the_oracle_s(family: str, seed: int) -> None:
    case = FAMILIES[family](seed)
    now, kept = computed(case, seed, is_further(seed)), stored(family, case, seed)
    for name, value in vars(now).items():
        assert getattr(kept, name) == pytest.approx(value, rel=1e-13, abs=1e-15), name


@pytest.mark.thinned(6)
@pytest.mark.parametrize("seed", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in range(1, 40))])
def test_random_circuits_agree_with_the_oracle(seed: int) -> None:
    """Their energies are quadratic in the rates, so the same oracle answers; its answers take tenths of seconds."""
    case, further = circuits(seed), is_further(seed)
    check(case, state_of(case, seed), computed(case, seed, further), derived=True, further=further)
