"""Hamilton's and Routh's forms against textbooks and against the elimination in the graph."""

from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from built_in import FREE, SATURATED, SOME
from built_in import system as built_in
from lagrangian import bounded, dynamics
from lagrangian.errors import ModelError, RunError
from lagrangian.graph import evaluate
from lagrangian.model import time
from lagrangian.page.formula import Elided, Formula
from lagrangian.write.unicode_math import columns


def same(a: Any, b: Any) -> bool:
    return sp.simplify(sp.sympify(a) - b) == 0


def momenta(system: lg.System) -> dict[str, Any]:
    return {str(q.func): p for q, p in system.hamiltonian().momenta.items()}


def test_the_tops_hamiltonian_is_goldsteins() -> None:
    """Goldstein, Classical Mechanics (3rd ed.), § 5.7 and § 8.3: with (p_φ − p_ψ cos θ)²/(2 I₁ sin²θ)."""
    system = built_in("spinning-top")
    theta, m, l, A, C, g = (system[n] for n in ("theta", "m", "l", "A", "C", "g"))
    found = system.hamiltonian()
    p = momenta(system)
    I1 = A + m * l**2
    wanted = p["theta"] ** 2 / (2 * I1) + (p["phi"] - p["psi"] * sp.cos(theta)) ** 2 / (2 * I1 * sp.sin(theta) ** 2)
    wanted += p["psi"] ** 2 / (2 * C) + m * g * l * sp.cos(theta)
    assert same(found.H, wanted)
    assert found.equations[sp.Derivative(p["phi"], time)] == 0
    assert found.is_total and found.is_constant


def test_the_turning_hoops_hamiltonian_is_not_the_energy() -> None:
    found = built_in("bead-on-hoop").hamiltonian()
    assert not found.is_total and found.is_constant


def test_a_driven_pendulums_hamiltonian_holds_time() -> None:
    found = built_in("kapitza-pendulum").hamiltonian()
    assert not found.is_total and not found.is_constant
    bare = found.H.replace(lambda e: isinstance(e, sp.Function("f")(time).__class__.__mro__[1]), lambda _: sp.Dummy())
    assert bare.has(time)


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", [n for n in FREE if n not in {"spring-net", *SATURATED}])
def test_canonical_equations_are_those_of_the_elimination(name: str) -> None:
    """`dynamics.canonical` takes the velocities from the elimination along the tape and gradients from the graph."""
    system = built_in(name)
    model, found = system.model, system.hamiltonian()
    assert all(check.holds for check in found.checks)
    n, source = len(model.coordinates), np.random.default_rng(6)
    q, v = source.uniform(0.4, 1.2, n), source.uniform(-1, 1, n)
    u = source.uniform(-1, 1, len(model.inputs))
    values: list[Any] = [p.value for p in model.parameters]
    groups: dict[str, Any] = {"x": [*q, *v], "u": u.tolist(), "p": values, "t": [0.3]}
    p = evaluate(dynamics.momenta(model), groups)["p"]
    wanted = evaluate(dynamics.canonical(model, {}), {**groups, "x": [*q, *p]})["xdot"]
    table = _table(model, q, v, u, values, 0.3)
    assert np.allclose([float(_put(e, table)) for e in found.definitions.values()], p, rtol=1e-12, atol=1e-12)
    table |= dict(zip(found.momenta.values(), p, strict=True))
    assert np.allclose([float(_put(e, table)) for e in found.equations.values()], wanted, rtol=1e-10, atol=1e-10)


def _table(model: Any, q: Any, v: Any, u: Any, p: Any, t: float) -> dict[Any, Any]:
    named = [(c.rate, x) for c, x in zip(model.coordinates, v, strict=True)]
    named += [(c.symbol, x) for c, x in zip(model.coordinates, q, strict=True)]
    named += [(i.symbol, x) for i, x in zip(model.inputs, u, strict=True)]
    named += [(c.symbol, x) for c, x in zip(model.parameters, p, strict=True)]
    return {**dict(named), time: t}


def _put(expr: Any, table: dict[Any, Any]) -> Any:
    """Rates before coordinates, time last; SymPy's xreplace keeps what depends on time whole."""
    return sp.sympify(expr).xreplace({k: sp.Float(x, 17) for k, x in table.items()})


def test_the_spherical_pendulums_routhian() -> None:
    """Goldstein (3rd ed.), § 8.3 in sign L − p φ̇: R = ½ m L² θ̇² − p²/(2 m L² sin²θ) + m g L cos θ."""
    system = built_in("spherical-pendulum")
    theta, phi, m, L, g = (system[n] for n in ("theta", "phi", "m", "L", "g"))
    found = system.routhian()
    (beta,) = found.ignorable.values()
    barrier = beta**2 / (2 * m * L**2 * sp.sin(theta) ** 2)
    assert same(found.R, m * L**2 * theta.diff() ** 2 / 2 - barrier + m * g * L * sp.cos(theta))
    assert same(found.potential, barrier - m * g * L * sp.cos(theta))
    assert found.coordinates == (theta,)
    assert same(found.rates[phi.diff()], beta / (m * L**2 * sp.sin(theta) ** 2))
    equation: Any = found.equations[0]
    wanted = m * L**2 * theta.diff().diff() - beta**2 * sp.cos(theta) / (m * L**2 * sp.sin(theta) ** 3)
    assert same(equation.lhs - equation.rhs, wanted + m * g * L * sp.sin(theta))


@pytest.mark.slow
def test_the_tops_effective_potential_is_goldsteins() -> None:
    """Goldstein (3rd ed.), eq. (5.60)."""
    system = built_in("spinning-top")
    theta, m, l, A, C, g = (system[n] for n in ("theta", "m", "l", "A", "C", "g"))
    found = system.routhian(["phi", "psi"])
    b = {str(q.func): s for q, s in found.ignorable.items()}
    I1 = A + m * l**2
    wanted = m * g * l * sp.cos(theta) + b["psi"] ** 2 / (2 * C)
    wanted += (b["phi"] - b["psi"] * sp.cos(theta)) ** 2 / (2 * I1 * sp.sin(theta) ** 2)
    assert same(found.potential, wanted)


def test_momenta_of_coupled_ignorable_coordinates() -> None:
    """Two carts, relative coordinate: the reduced mass moves against the spring; Landau & Lifshitz, § 13."""
    system = built_in("two-carts")
    x2, m1, m2, k, F = (system[n] for n in ("x2", "m1", "m2", "k", "F"))
    found = system.routhian()
    equation: Any = found.equations[0]
    assert same(equation.lhs - equation.rhs, m1 * m2 / (m1 + m2) * x2.diff().diff() + k * x2 - F)
    assert all(check.holds for check in found.checks)


@pytest.mark.parametrize(
    ("name", "ignorable", "message"),
    [
        ("double-pendulum", None, "no coordinate is ignorable"),
        ("spherical-pendulum", ["theta"], "L contains it"),
        ("cart-pole", ["x"], "a force acts on it"),
        ("spherical-pendulum", ["fi"], "there is no coordinate 'fi'"),
        ("spherical-pendulum", [], "no coordinate is given"),
    ],
)
def test_what_is_not_ignorable_is_refused(name: str, ignorable: Any, message: str) -> None:
    with pytest.raises(RunError, match=message):
        built_in(name).routhian(ignorable)


def test_energies_that_are_not_quadratic_have_no_hamiltonian_here() -> None:
    system = lg.System("strange")
    x = system.coordinates("x")
    system.kinetic(x.diff() ** 4)
    with pytest.raises((RunError, ModelError), match="quadratic"):
        system.hamiltonian()


def test_momenta_do_not_take_names_that_are_there() -> None:
    system = lg.System("names")
    x = system.coordinates("x")
    p_x = system.parameters("p_x")
    system.particle(p_x, at=system.origin + (x, 0))
    assert [str(p) for p in system.hamiltonian().momenta.values()] == ["pp_x(t)"]


def test_both_forms_are_written_in_every_format() -> None:
    system = built_in("spherical-pendulum")
    for found in (system.hamiltonian(), system.routhian()):
        assert "✓" in str(found)
        assert found.to_latex().startswith("\\documentclass")
        assert found.to_html().startswith("<!DOCTYPE html>")
        assert found.to_dict()["system"] == "spherical pendulum"
        assert "$$" in found.to_markdown()


def test_a_singular_mass_matrix_is_said() -> None:
    system = lg.System("shared")
    x, y = system.coordinates("x y")
    system.particle(1, at=system.origin + (x + y, 0))
    with pytest.raises((RunError, ModelError), match="singular"):
        system.hamiltonian()


def test_a_long_hamiltonian_is_given_by_its_mass_matrix() -> None:
    """½ pᵀ M⁻¹ p + V, with the M and V of the page, is H: at random states."""
    system = built_in("triple-pendulum")
    found = system.hamiltonian()
    part = next(p for p in found.report().parts if str(p.title) == "Hamiltonian")
    shown = {str(f.sides[0]): f.sides[1] for f in part.items if isinstance(f, Formula)}
    rows: Any = shown["M"]
    V: Any = shown["V"]
    summary: Any = shown["H"]
    assert isinstance(summary, Elided) and summary.expr == found.H
    source = np.random.default_rng(8)
    model = system.model
    q, p = source.uniform(0.4, 1.2, 3), source.uniform(-1, 1, 3)
    table = _table(model, q, [0, 0, 0], [], [x.value for x in model.parameters], 0.3)
    table |= dict(zip(found.momenta.values(), p, strict=True))
    M = np.array([[float(_put(x, table)) for x in row] for row in rows.rows])
    V_there = sum(float(_put(term, table)) for term in V.terms)
    assert np.isclose(p @ np.linalg.solve(M, p) / 2 + V_there, float(_put(found.H, table)), rtol=1e-12)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["lecture-2", "acrobot", "furuta-pendulum", "triple-pendulum"])
def test_pages_of_long_hamiltonians_keep_to_their_width(name: str) -> None:
    found = built_in(name).hamiltonian()
    for width in (80, 100):
        assert max(columns(line) for line in found.to_text(width=width).splitlines()) <= width
    full = found.to_text(full=True)
    assert "operations⟩" not in full and max(columns(line) for line in full.splitlines()) <= 82
    assert ("written out" in found.to_html()) == (name in ("triple-pendulum", "furuta-pendulum"))


def test_what_is_too_long_to_read_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bounded.sizes, "MAX_OPERATIONS", 20)
    for form in (built_in("double-pendulum").hamiltonian, built_in("spinning-top").routhian):
        with pytest.raises(RunError, match="is too long to write out: one of its expressions has") as caught:
            form()
        assert caught.value.code == "E523" and caught.value.fix
