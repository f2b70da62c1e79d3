"""Hamilton's equations against the accelerations of forward dynamics."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from built_in import FREE, SATURATED, SOME
from lagrangian import dynamics
from lagrangian.graph import count_program, evaluate


def state(name: str) -> tuple[lg.System, dict[str, list[float]]]:
    system = built_in.system(name)
    model, rng = system.model, np.random.default_rng(5)
    p = [0.5 + 0.1 * k if v.value is None else v.value for k, v in enumerate(model.parameters)]
    x = list(rng.uniform(0.2, 0.7, 2 * len(model.coordinates)))
    return system, {"x": x, "u": list(rng.normal(size=len(model.inputs))), "p": p, "t": [0.3]}


@pytest.mark.parametrize("name", [n for n in FREE if n not in SATURATED])
def test_velocities_come_back_from_momenta(name: str) -> None:
    system, at = state(name)
    n = len(system.model.coordinates)
    p = evaluate(dynamics.momenta(system.model), at)["p"]
    v = evaluate(dynamics.velocities(system.model), {**at, "x": [*at["x"][:n], *p]})["v"]
    assert v == pytest.approx(at["x"][n:], rel=1e-11)


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", [n for n in FREE if n not in SATURATED])
def test_momenta_change_as_they_do_along_the_accelerations(name: str) -> None:
    """ṗ of Hamilton's equations is the derivative of p(q, v, t) along ẋ = f(x), taken in 40 digits."""
    system, at = state(name)
    model, n = system.model, len(system.model.coordinates)
    momenta = dynamics.momenta(model)
    p = evaluate(momenta, at)["p"]
    got = evaluate(dynamics.canonical(model, {}), {**at, "x": [*at["x"][:n], *p]})["xdot"]
    rate = evaluate(dynamics.rhs(model), at, digits=40)["xdot"]
    with mpmath.workdps(40):
        e = mpmath.mpf(10) ** -13
        ends = []
        for sign in (1, -1):
            x = [mpmath.mpf(a) + sign * e * b for a, b in zip(at["x"], rate, strict=True)]
            ends.append(evaluate(momenta, {**at, "x": x, "t": [mpmath.mpf(0.3) + sign * e]}, digits=40)["p"])
        slope = [float((a - b) / (2 * e)) for a, b in zip(*ends, strict=True)]
    assert got[:n] == pytest.approx([float(r) for r in rate[:n]], rel=1e-11)
    assert got[n:] == pytest.approx(slope, rel=1e-9, abs=1e-10)


def test_a_double_pendulum_has_the_textbooks_hamiltonian_flow() -> None:
    """q̇ = ∂H/∂p and ṗ = −∂H/∂q of H = ½ pᵀ M⁻¹ p + V, differentiated by SymPy."""
    s = built_in.system("double-pendulum")
    d = s.derive()
    q = [c.symbol for c in s.model.coordinates]
    p = sp.symbols("p1 p2")
    values = s.model.values
    M = sp.Matrix(d.mass_matrix).subs(values)
    H = (sp.Matrix([p]) * M.inv() * sp.Matrix(p))[0] / 2 + d.V.subs(values)
    at = dict(zip([*q, *p], [0.4, 0.9, 0.3, -0.2], strict=True))
    wanted = [*(sp.diff(H, x) for x in p), *(-sp.diff(H, x) for x in q)]
    got = evaluate(dynamics.canonical(s.model, {}), {"x": [0.4, 0.9, 0.3, -0.2], "u": [], "t": [0]})["xdot"]
    assert got == pytest.approx([float(w.subs(at)) for w in wanted], rel=1e-12)


def test_feedback_reads_rates_out_of_momenta() -> None:
    s = built_in.system("cart-pole")
    x, F = s["x"], s["F"]
    law = {F: -3 * x - 2 * x.diff()}
    at = {"x": [0.1, 0.2, 0.3, 0.4], "u": [], "t": [0.0]}
    p = evaluate(dynamics.momenta(s.model), {**at, "u": [0.0]})["p"]
    closed = evaluate(dynamics.canonical(s.model, law, supply=True), {**at, "x": [0.1, 0.2, *p, 0.0]})["xdot"]
    opened = evaluate(dynamics.canonical(s.model, {}, supply=True), {**at, "x": [0.1, 0.2, *p, 0.0], "u": [-0.9]})
    assert closed == pytest.approx(opened["xdot"], rel=1e-12)


def test_long_chains_stay_linear() -> None:
    counts = []
    for links in (8, 16):
        s = lg.System("chain")
        m, L = s.parameters("m L", m=1.0, L=1.0)
        at = s.origin
        for k in range(links):
            th = s.coordinate(f"th{k}")
            at = at + (L * sp.sin(th), -L * sp.cos(th))
            s.particle(m, at=at)
        s.gravity()
        counts.append(count_program(dynamics.canonical(s.model, {})).operations)
    assert counts[1] < 2.2 * counts[0]


def test_bodies_that_float_are_refused() -> None:
    s = lg.System("brick")
    base = s.floating_frame("base")
    s.rigid_body(s.parameter("m", 1.0), (1, 2, 3), at=base.origin, frame=base)
    with pytest.raises(lg.ModelError, match="no canonical momenta"):
        dynamics.canonical(s.model, {})
