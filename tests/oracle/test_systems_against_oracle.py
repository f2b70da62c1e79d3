"""Random systems in the plane, in space and from energies: every product against an oracle of difference quotients."""

from __future__ import annotations

import random
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import sympy as sp
from differences import DIGITS
from random_systems import Case, energies, floating, plane, space

from lagrangian.compiled import sources

FAMILIES = {"plane": plane, "space": space, "energies": energies, "floating": floating}
TOLERANCE = 1e-9


def close(got: Any, expected: Any, *terms: Any) -> None:
    """Equal up to `TOLERANCE` of the largest term."""
    got, expected = (np.array(np.array(x).tolist(), dtype=float) for x in (got, expected))
    sizes = [np.abs(np.array(np.array(x).tolist(), dtype=float)).max(initial=0.0) for x in (expected, *terms)]
    assert np.abs(got - expected).max(initial=0.0) <= TOLERANCE * max(sizes), (got, expected)


def check(case: Case, seed: int, *, derived: bool = False, further: bool = False) -> None:
    source = random.Random(seed)
    n, oracle, u = case.oracle.n, case.oracle, np.array(case.u)
    q, v, a = (np.array([source.uniform(0.2, 1.1) for _ in range(n)]) for _ in range(3))
    t = source.uniform(0.1, 1.0)
    extra = np.zeros(n)  # what the chart's acceleration has beyond that of the velocities in the frame's own axes
    if case.pose:
        q[:6] = 0.0
        extra[:3] = np.cross(v[3:6], v[:3])
    state = np.concatenate([case.pose, q[6:]]) if case.pose else q
    with mp.workdps(DIGITS):
        Q, W, A, time = ([mp.mpf(x) for x in values] for values in (q, v, a + extra, [t]))
        M = oracle.mass_matrix(Q, time[0])
        bias = oracle.residual(Q, W, [mp.mpf(x) for x in extra], time[0])
        residual = oracle.residual(Q, W, A, time[0]) if further else list(mp.matrix(M) * mp.matrix(a) + mp.matrix(bias))
        forward = list(mp.lu_solve(mp.matrix(M), -mp.matrix(bias)))
        T, V, G = oracle.T(Q, W, time[0]), oracle.V(Q, time[0]), oracle.gravity(Q, time[0])
    inertia = np.array(M, dtype=float)
    terms = (inertia * a, bias)
    dyn = case.system.compile()
    close(dyn.mass_matrix(state, t=t), M)
    close(dyn.bias(state, v, u=u, t=t), bias, *terms)
    close(dyn.inverse(state, v, a, u=u, t=t), residual, *terms)
    got = dyn.forward(state, v, u=u, t=t)
    close(inertia @ (got - np.array(forward, dtype=float)), np.zeros(n), bias)
    rates = dyn.rates(state, v)
    close(dyn.rhs(t, np.concatenate([state, v]), u=u), np.concatenate([rates, got]))
    close(dyn.energies(state, v, u=u, t=t), [T, V], [T, V])
    close(dyn.potential_force(state, u=u, t=t), G, bias)
    if derived:
        close(derived_residual(case, q, v, a, u, t), residual, *terms)
    if further:
        module = exported(case)
        close(module["dynamics_forward"](state, v, u, (), t), got, got)
        close(module["dynamics_energy"](state, v, u, (), t), [T, V], [T, V])
        if not case.pose:
            check_slopes(case, q, v, t)


def exported(case: Case) -> dict[str, Any]:
    """The functions of the exported Python."""
    (text,) = sources(case.system.model, "python", "dynamics").values()
    found: dict[str, Any] = {}
    exec(compile(text, "dynamics.py", "exec"), found)
    return found


def check_slopes(case: Case, q: Any, v: Any, t: float) -> None:
    """The lower half of A, ∂q̈/∂[q; v], against quotients of the oracle's accelerations."""
    names = [*(c.name for c in case.system.model.coordinates), *(w.name for w in case.system.model.velocities)]
    point = dict(zip(names, [*q, *v], strict=True))
    inputs = {i.name: x for i, x in zip(case.system.model.inputs, case.u, strict=True)}
    A = case.system.linearize(at=point, inputs=inputs, time=t, operating_point=True).A
    n, columns = case.oracle.n, []
    with mp.workdps(DIGITS):
        x, h = [mp.mpf(e) for e in (*q, *v)], mp.mpf(10) ** -5
        for k in range(2 * n):
            ends = []
            for sign in (1, -1):
                y = [e + sign * h * (i == k) for i, e in enumerate(x)]
                ends.append(case.oracle.accelerations(y[:n], y[n:], mp.mpf(t)))
            columns.append([(a - b) / (2 * h) for a, b in zip(*ends, strict=True)])
    expected = np.array(columns, dtype=float).T
    assert np.abs(A[n:] - expected).max() < 1e-7 * max(1.0, np.abs(expected).max())


def derived_residual(case: Case, q: Any, v: Any, a: Any, u: Any, t: float) -> list[float]:
    """The derived equations at a state, left minus right, by substitution."""
    s, d = case.system, case.system.derive()
    assert all(c.holds for c in d.verified), [str(c.what) for c in d.verified if not c.holds]
    x = d.coordinates
    values: dict[Any, float] = {c.diff(s.t, 2): w for c, w in zip(x, a, strict=True)}
    rates: dict[Any, float] = {c.diff(s.t): w for c, w in zip(x, v, strict=True)}
    rest = {**dict(zip(x, q, strict=True)), s.t: t}
    rest |= {i.symbol: w for i, w in zip(s.model.inputs, u, strict=True)}
    return [
        float((e.lhs - e.rhs).subs(values).subs(rates).subs(rest).subs(sp.Symbol("g"), 9.81).evalf())
        for e in d.equations
    ]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("family", FAMILIES)
def test_random_systems_agree_with_the_oracle(family: str, seed: int) -> None:
    check(FAMILIES[family](seed), seed, derived=seed == 0 and family != "floating", further=seed == 1)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(25))
@pytest.mark.parametrize("family", FAMILIES)
def test_many_random_systems_agree_with_the_oracle(family: str, block: int) -> None:
    for seed in range(100 + 5 * block, 105 + 5 * block):
        check(FAMILIES[family](seed), seed, derived=seed % 2 == 0 and family != "floating", further=seed % 5 == 0)
