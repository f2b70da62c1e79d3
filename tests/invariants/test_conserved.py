"""What is kept: textbook quantities, and rates that vanish by another route, the forward dynamics."""

import json
from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from built_in import system as built_in
from lagrangian import dynamics
from lagrangian.cli import main
from lagrangian.errors import RunError
from lagrangian.graph import evaluate
from lagrangian.model import time


def named(system: lg.System) -> dict[str, sp.Expr]:
    return {c.name: c.expression for c in system.conserved_quantities()}


def same(a: Any, b: Any) -> bool:
    return sp.simplify(sp.sympify(a) - b) == 0


def kepler(polar: bool) -> lg.System:
    system = lg.System("Kepler")
    m, mu = system.parameters("m mu", m=2.0, mu=3.0)
    if polar:
        r, phi = system.coordinates("r phi")
        system.particle(m, at=system.origin + (r * sp.cos(phi), r * sp.sin(phi)))
        system.potential(-mu * m / r)
    else:
        x, y = system.coordinates("x y")
        system.particle(m, at=system.origin + (x, y))
        system.potential(-mu * m / sp.sqrt(x**2 + y**2))
    return system


def test_a_parameter_given_as_0_vanishes() -> None:
    """A pendulum with a damper keeps its energy where c = 0, and its momentum too where g = 0."""
    system = lg.System("damped")
    theta = system.coordinate("theta")
    m, L, c = system.parameters("m L c", m=1.0, L=1.0, c=0.5)
    system.particle(m, at=system.origin + (L * sp.sin(theta), -L * sp.cos(theta)))
    system.gravity(direction=(0, -1))
    system.damper(c, deflection=theta)
    assert not len(system.conserved_quantities()) and not len(system.conserved_quantities(params={"c": 0.25}))
    (energy,) = system.conserved_quantities(params={"c": 0.0})
    assert energy.kind == "energy" and energy.drift is not None and energy.drift < 1e-10
    free = system.conserved_quantities(params={c: 0, "g": "0 m/s^2"})
    assert {found.kind for found in free} == {"energy", "momentum"} and free.vanishing == ("c", "g")
    assert "conserved quantities where c = g = 0" in free.to_text()
    with pytest.raises(lg.ModelError, match="coordinate 'theta' moves no mass where m = 0"):
        system.conserved_quantities(params={"m": 0.0})
    system.spring(1 / c, deflection=theta)
    with pytest.raises(lg.ModelError, match="have no value where c = 0"):
        system.conserved_quantities(params={"c": 0.0})


def test_keplers_area_law_in_polar_coordinates() -> None:
    system = kepler(polar=True)
    r, phi, m, mu = (system[x] for x in ("r", "phi", "m", "mu"))
    found = named(system)
    assert same(found["momentum of phi"], m * r**2 * phi.diff())
    assert same(found["energy T* + V"], m * (r.diff() ** 2 + r**2 * phi.diff() ** 2) / 2 - mu * m / r)
    assert len(found) == 2


def test_keplers_area_law_hides_in_cartesian_coordinates_and_is_found() -> None:
    system = kepler(polar=False)
    x, y, m = (system[n] for n in ("x", "y", "m"))
    found = system.conserved_quantities()
    (turn,) = [c for c in found if c.kind == "turn"]
    assert turn.name == "angular momentum of x and y"
    area = m * (x * y.diff() - y * x.diff())
    assert same(turn.expression, area) or same(turn.expression, -area)
    assert {c.kind for c in found} == {"turn", "energy"}


@pytest.mark.slow
def test_two_free_bodies_keep_three_total_momenta() -> None:
    """Springs between points in the plane: P_x, P_y and the angular momentum about the origin."""
    system = lg.System("two bodies")
    x1, y1, x2, y2 = system.coordinates("x1 y1 x2 y2")
    m1, m2, k = system.parameters("m1 m2 k", m1=1, m2=2, k=5)
    a, b = system.origin + (x1, y1), system.origin + (x2, y2)
    system.particle(m1, at=a)
    system.particle(m2, at=b)
    system.spring(k, between=(a, b), rest=sp.Rational(1, 2))
    found = named(system)
    assert same(found["total momentum of x1 and x2"], m1 * x1.diff() + m2 * x2.diff())
    assert same(found["total momentum of y1 and y2"], m1 * y1.diff() + m2 * y2.diff())
    spin = m1 * (x1 * y1.diff() - y1 * x1.diff()) + m2 * (x2 * y2.diff() - y2 * x2.diff())
    turn = found["angular momentum of x1, y1, x2 and y2"]
    assert same(turn, spin) or same(turn, -spin)
    assert len(found) == 4


@pytest.mark.slow
def test_the_tops_two_momenta_are_goldsteins() -> None:
    """Goldstein, Classical Mechanics (3rd ed.), eqs. (5.53), (5.54): p_ψ = I₃(ψ̇ + φ̇ cos θ), p_φ = …"""
    system = built_in("spinning-top")
    phi, theta, psi, m, l, A, C = (system[n] for n in ("phi", "theta", "psi", "m", "l", "A", "C"))
    found = named(system)
    spin = C * (psi.diff() + phi.diff() * sp.cos(theta))
    assert same(found["momentum of psi"], spin)
    across = (A + m * l**2) * sp.sin(theta) ** 2
    assert same(found["momentum of phi"], across * phi.diff() + spin * sp.cos(theta))


def test_carts_keep_their_total_momentum_under_a_force_between_them_and_energy_only_without() -> None:
    system = built_in("lecture-3a")
    found = system.conserved_quantities()
    assert [(c.kind, c.while_zero) for c in found] == [("total momentum", ()), ("energy", ("F",))]
    x1, x2, m1, m2 = (system[n] for n in ("x1", "x2", "m1", "m2"))
    assert same(found[0].expression, m1 * x1.diff() + m2 * x2.diff())
    assert found[0].direction == {x1: 1, x2: 1}


def test_energy_is_not_t_plus_v_where_a_motion_is_prescribed() -> None:
    """Goldstein (3rd ed.), § 2.7: h = T₂ − T₀ + V is kept on the turning hoop, T + V is not."""
    system = built_in("bead-on-hoop")
    theta, m, R, W, g = (system[n] for n in ("theta", "m", "R", "Omega", "g"))
    (h,) = system.conserved_quantities()
    assert h.name.startswith("h = ")
    wanted = m * R**2 * theta.diff() ** 2 / 2 - m * R**2 * W**2 * sp.sin(theta) ** 2 / 2 - m * g * R * sp.cos(theta)
    assert same(sp.diff(h.expression - wanted, theta), 0) and same(sp.diff(h.expression - wanted, theta.diff()), 0)


def test_what_friction_and_forces_take_is_said() -> None:
    found = built_in("cart-pole").conserved_quantities()
    assert len(found) == 0
    words = [str(why) for why in found.missed]
    assert any("does not contain x" in w and "F" in w for w in words)
    assert any(w.startswith("the energy changes at") for w in words)


CONSERVATIVE = ["lecture-3a", "double-pendulum", "elastic-pendulum", "spherical-pendulum", "spinning-top", "wedge"]


@pytest.mark.sampled(6)
@pytest.mark.parametrize("name", [*CONSERVATIVE, "two-carts", "bead-on-hoop"])
def test_rates_vanish_by_the_forward_dynamics_and_runs_keep_them(name: str) -> None:
    system = built_in(name)
    model, found = system.model, system.conserved_quantities()
    assert len(found) > 0 and found.run is not None
    program = dynamics.rhs(model)
    n, source = len(model.coordinates), np.random.default_rng(2)
    p: list[Any] = [x.value for x in model.parameters]
    for c in found:
        assert c.drift is not None and c.drift < 1e-9
        x = source.uniform(0.3, 1.2, 2 * n)
        u = [0.0 if i.name in c.while_zero else float(source.normal()) for i in model.inputs]
        a = evaluate(program, {"x": x.tolist(), "u": u, "p": p, "t": [0.4]})["xdot"][n:]
        values: dict[Any, Any] = dict(zip((k.symbol for k in model.parameters), p, strict=True))
        state = dict(zip([k.symbol for k in model.coordinates], x[:n], strict=True))
        rate = dict(zip([k.rate for k in model.coordinates], x[n:], strict=True))
        acceleration = dict(zip([k.acceleration for k in model.coordinates], a, strict=True))
        full: Any = sp.diff(c.expression, time)
        got = full.subs(acceleration).subs(rate).subs(state).subs(values).subs(time, 0.4)
        assert abs(float(got)) < 1e-9


def test_without_values_nothing_is_run_and_all_is_still_proved() -> None:
    system = lg.System("free")
    x = system.coordinates("x")
    system.particle(system.parameters("m"), at=system.origin + (x, 0))
    found = system.conserved_quantities()
    assert found.run is None and [c.drift for c in found] == [None, None]
    assert [c.drift is not None for c in system.conserved_quantities(params={"m": 2})] == [True, True]


def test_a_wrong_parameter_is_named() -> None:
    with pytest.raises(RunError, match="Did you mean 'm1'"):
        built_in("lecture-3a").conserved_quantities(params={"m11": 2})


def test_the_command_writes_text_and_data(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["conserved", "-e", "spherical-pendulum"]) == 0
    out = capsys.readouterr().out
    assert "Momentum of phi" in out and "✓ it stays constant along a run" in out
    assert main(["conserved", "-e", "two-carts", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [c["kind"] for c in found["conserved"]] == ["momentum", "energy"]


def test_a_rack_and_its_pinion_shift_together() -> None:
    """The share depends on a parameter: R p_x + p_φ."""
    system = lg.System("rack")
    x, phi = system.coordinates("x phi")
    m, J, R, k = system.parameters("m J R k", m=1, J=2, R=0.3, k=10)
    system.particle(m, at=system.origin + (x, 0))
    system.kinetic(J * phi.diff() ** 2 / 2)
    system.spring(k, deflection=x - R * phi)
    first = system.conserved_quantities()[0]
    assert first.kind == "total momentum"
    assert same(first.expression, R * m * x.diff() + J * phi.diff())


def test_jacobis_integral_of_a_turning_trough() -> None:
    """Goldstein (3rd ed.), § 2.7: h − Ω p_φ is kept where the potential turns at Ω; here in fixed x and y."""
    system = lg.System("trough")
    x, y = system.coordinates("x y")
    m, k, W = system.parameters("m k Omega", m=1, k=10, Omega=0.7)
    system.particle(m, at=system.origin + (x, y))
    across = x * sp.cos(W * time) + y * sp.sin(W * time)
    system.potential(k * across**2 / 2)
    (found,) = system.conserved_quantities()
    assert found.kind == "mixed" and found.drift is not None and found.drift < 1e-9
    energy = m * (x.diff() ** 2 + y.diff() ** 2) / 2 + k * across**2 / 2
    assert same(found.expression, energy - W * m * (x * y.diff() - y * x.diff()))


def quarter_car(damping: Any) -> tuple[lg.System, dict[str, Any]]:
    system = lg.System("quarter car")
    a, b = system.coordinates("a b")
    m1, m2, k1, k2 = system.parameters("m1 m2 k1 k2", m1=300, m2=40, k1=20e3, k2=180e3)
    z = system.input("z", "road", unit="m")
    system.particle(m1, at=system.origin + (0, a))
    system.particle(m2, at=system.origin + (0, b))
    system.spring(k1, deflection=a - b)
    system.spring(k2, deflection=b - z)
    if damping:
        system.damper(damping, deflection=a - b)
    return system, {"a": a, "b": b, "m1": m1, "m2": m2, "k1": k1, "k2": k2, "z": z}


def test_a_road_in_the_tyres_energy_must_stand_still_for_the_energy_to_be_kept() -> None:
    """By hand: m1 ä = −k1 (a − b), m2 b̈ = k1 (a − b) − k2 (b − z), so d(T + V)/dt = −k2 (b − z) ż."""
    system, s = quarter_car(0)
    (energy,) = system.conserved_quantities()
    assert energy.while_zero == () and energy.while_constant == ("z",)
    assert str(energy).endswith("while z is constant")
    a, b, z, k1, k2 = (s[x] for x in ("a", "b", "z", "k1", "k2"))
    by_hand = {
        a.diff().diff(): -k1 * (a - b) / s["m1"],
        b.diff().diff(): (k1 * (a - b) - k2 * (b - z)) / s["m2"],
    }
    changes: Any = sp.diff(energy.expression, time)
    assert same(changes.subs(by_hand), -k2 * (b - z) * sp.Derivative(z, time))
    kept = system.conserved_quantities()
    assert "with constant z" in str(kept) and "any motion is" not in str(kept)
    assert kept.to_dict()["conserved"][0]["while_constant"] == ["z"]
    found = system.hamiltonian()
    assert not found.is_constant and found.while_constant == ("z",)
    assert "every motion" not in str(found) and "while z is constant" in str(found)


def test_what_a_road_gives_is_named_beside_what_a_damper_takes() -> None:
    system, s = quarter_car(1500)
    assert len(system.conserved_quantities()) == 0
    (why,) = system.conserved_quantities().missed
    taken, given, road = (part for part in why.parts if isinstance(part, sp.Basic))
    assert same(taken, -1500 * (s["a"].diff() - s["b"].diff()) ** 2)
    assert same(given, -s["k2"] * (s["b"] - s["z"])) and road == s["z"]


def test_a_force_that_is_0_and_a_road_that_stands_are_both_asked_for() -> None:
    system, s = quarter_car(0)
    F = system.input("F", "force", unit="N")
    system.force(F, deflection=s["a"])
    (energy,) = system.conserved_quantities()
    assert (energy.while_zero, energy.while_constant) == (("F",), ("z",))
    assert str(energy).endswith("while F is 0 and z is constant")
