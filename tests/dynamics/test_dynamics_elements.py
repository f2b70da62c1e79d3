"""Every kind of element, in the plane and in space, against SymPy's Euler–Lagrange on the elements' own expressions."""

import numpy as np
import pytest
import sympy as sp
from dynamics_models import PROGRAMS, all_programs, euler_lagrange, run, state

from lagrangian import dynamics
from lagrangian.dynamics import programs
from lagrangian.errors import ModelError
from lagrangian.model import (
    Builder,
    Damper,
    Dissipation,
    Force,
    GeneralizedForce,
    Gravity,
    Kinetic,
    Particle,
    Point,
    Potential,
    RigidBody,
    Spring,
    Torque,
    time,
)
from lagrangian.model.elements.damper import RATE
from lagrangian.model.elements.spring import DELTA
from size import rest_slow


def cart_and_pole():
    b = Builder("cart and pole")
    x, th = b.coordinate("x").symbol, b.coordinate("theta").symbol
    m1, m2, L, J, g, k, c = (b.parameter(n).symbol for n in ["m1", "m2", "L", "J", "g", "k", "c"])
    F, tau = b.input("F").symbol, b.input("tau").symbol
    cart = b.point("cart", (x, 0))
    frame = b.frame("pole", th, origin=cart)
    b.add(Particle(mass=m1, at=cart))
    b.add(RigidBody(mass=m2, inertia=J, at=frame.point(0, -L), frame=frame))
    b.add(Gravity(direction=(1, -2), g=g, datum=b.origin + (0, 3)))
    b.add(Spring(k=k, deflection=x, rest=sp.Rational(1, 5)))
    b.add(Damper(b=c, deflection=th))
    b.add(Force(value=(F, 0), at=cart))
    b.add(Torque(value=tau, on=frame))
    return b.model()


def springs_and_dampers():
    b = Builder("springs and dampers")
    x, y, th = (b.coordinate(n).symbol for n in ["x", "y", "theta"])
    m, k, k3, c, L0, L = (b.parameter(n).symbol for n in ["m", "k", "k3", "c", "L0", "L"])
    u = b.input("u").symbol
    X = b.define("X", x + sp.Rational(1, 2)).symbol
    P = b.point("P", (X, y + 2))
    Q = b.point("Q", (L * sp.cos(th), L * sp.sin(th)), parent=P)
    b.add(Particle(mass=m, at=P))
    b.add(Particle(mass=2 * m, at=Q))
    b.add(Spring(k=k, between=(b.origin, P), rest=L0))
    b.add(Spring(k=k, between=(b.origin, Q)))
    b.add(Spring(law=k * DELTA + k3 * DELTA**3, between=(P, Q), rest=L0 * sp.cos(x) / 9))
    b.add(Spring(law=k * DELTA + k3 * DELTA**3, deflection=x - y, rest=u))
    b.add(Spring(energy=k * sp.cosh(DELTA), deflection=th))
    b.add(Damper(b=c, between=(b.origin, Q)))
    b.add(Damper(law=c * RATE * sp.Abs(RATE), between=(b.origin, P)))
    b.add(Damper(law=c * sp.tanh(RATE), deflection=X + th))
    b.add(Force(value=c * X.diff(time) + u, between=(b.origin, Q)))
    b.add(Force(value=u, deflection=x * y))
    b.add(Force(value=(u, -u * y.diff(time)), at=Q, reaction=P))
    return b.model()


def driven_pivot():
    b = Builder("driven pivot")
    th = b.coordinate("theta").symbol
    m, L, A, w, J, g = (b.parameter(n).symbol for n in ["m", "L", "A", "w", "J", "g"])
    pivot = b.point("pivot", (0, A * sp.cos(w * time)))
    frame = b.frame("rod", th + sp.sin(time), origin=pivot)
    b.add(RigidBody(mass=m, inertia=J, at=frame.point(L, L / 3), frame=frame))
    b.add(Gravity(direction=(0, -1), g=g))
    return b.model()


def raw_energies():
    b = Builder("raw")
    r, ph = b.coordinate("r").symbol, b.coordinate("phi").symbol
    m, k, c = (b.parameter(n).symbol for n in ["m", "k", "c"])
    u = b.input("u").symbol
    b.add(Kinetic(value=m / 2 * (r.diff(time) ** 2 + (r + 2) ** 2 * ph.diff(time) ** 2) * (1 + sp.sin(ph) ** 2)))
    b.add(Potential(value=k * (r - 1) ** 2 / 2 + sp.Piecewise((r**2, r > 0), (r**3, True))))
    b.add(Dissipation(value=c / 2 * (r.diff(time) ** 2 + r**2 * ph.diff(time) ** 2)))
    b.add(GeneralizedForce(coordinate=ph, value=u * sp.cos(ph)))
    return b.model()


def space():
    b = Builder("space")
    x, al, be, ga = (b.coordinate(n).symbol for n in ["x", "alpha", "beta", "gamma"])
    m, k, c, g = (b.parameter(n).symbol for n in ["m", "k", "c", "g"])
    A, B, C, D = (b.parameter(n).symbol for n in ["A", "B", "C", "D"])
    tau, f = b.input("tau").symbol, b.input("f").symbol
    F1 = b.frame("F1", al, axis=(0, 0, 1))
    slider = F1.point(x + 1, 0, sp.Rational(1, 5))
    F0 = b.frame("F0", sp.pi / 3, axis=(1, 0, 0), parent=F1, origin=slider)
    F2 = b.frame("F2", be, axis=(0, -1, 0), parent=F0, origin=slider)
    F3 = b.frame("F3", ga, axis=(1, 1, 0), parent=F2, origin=F2.point(0, sp.Rational(1, 4), sp.Rational(1, 10)))
    b.add(RigidBody(mass=m, inertia=(A, B, C), at=slider, frame=F1))
    b.add(RigidBody(mass=2 * m, inertia=[[2, D, 0], [D, 3, 0], [0, 0, 4]], at=F2.point(0.1, 0.2, 0.3), frame=F2))
    tip = F3.point(0.3, -0.1, 0.2)
    b.add(RigidBody(mass=m, inertia=(B, B, B), at=tip, frame=F3))
    b.add(Particle(mass=m / 2, at=F3.point(0, 0, sp.Rational(1, 2))))
    b.add(Gravity(direction=(0, 0.6, -0.8), g=g))
    b.add(Spring(k=k, between=(b.origin, tip), rest=sp.Rational(1, 2)))
    b.add(Damper(b=c, between=(slider, tip)))
    b.add(Torque(value=tau, on=F2, reaction=F1))
    b.add(Torque(value=(tau, 0, f), on=F3))
    b.add(Force(value=(f, tau, -f), at=tip, axes=F2, reaction=slider))
    return b.model()


MODELS = [cart_and_pole, springs_and_dampers, driven_pivot, raw_energies, space]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("build", rest_slow(MODELS, set(MODELS) - {space}), ids=lambda f: f.__name__)
def test_both_routes_against_euler_lagrange_by_sympy(build):
    model = build()
    made = all_programs(model)
    lagrangian = programs.inverse_from_lagrangian(model)
    for seed in (1,) if build is space else (1, 2):  # SymPy takes its time in space
        at = state(model, seed)
        at["a"] = state(model, seed + 50)["v"]
        expected = euler_lagrange(model, at)
        size = 1 + np.abs(expected).max()
        assert np.abs(run(made["inverse"], at)["r"] - expected).max() < 1e-11 * size
        assert np.abs(run(lagrangian, at)["r"] - expected).max() < 1e-11 * size
        M, h = run(made["mass_matrix"], at)["M"], run(made["bias"], at)["h"]
        assert np.abs(M @ at["a"] + h - expected).max() < 1e-11 * size
        assert np.abs(run(made["inverse"], {**at, "a": run(made["forward"], at)["a"]})["r"]).max() < 1e-11 * size


@pytest.mark.sampled(2)
@pytest.mark.parametrize("build", rest_slow(MODELS, set(MODELS) - {space}), ids=lambda f: f.__name__)
def test_mass_matrix_and_energies_against_the_elements(build):
    model = build()
    made = all_programs(model)
    at = state(model, 3)
    M = run(made["mass_matrix"], at)["M"]
    assert np.array_equal(M, M.T)
    assert np.linalg.eigvalsh(M).min() > 0
    values = {}
    for c, q, v in zip(model.coordinates, at["q"], at["v"], strict=True):
        values[c.rate], values[c.symbol] = v, q
    table = dict(zip([p.symbol for p in model.parameters], at["p"], strict=True))
    table |= dict(zip([u.symbol for u in model.inputs], at["u"], strict=True))
    table[time] = at["t"][0]
    for name, key in (("kinetic", "T"), ("potential", "V")):
        whole = sum((getattr(e, name)(model) for e in model.elements), sp.S.Zero)
        whole = model.expand(whole, constants=True)
        for pairs in ({k: v for k, v in values.items() if isinstance(k, sp.Derivative)}, values, table):
            whole = whole.subs(pairs)
        assert run(made["energy"], at)[key] == pytest.approx(float(whole), rel=1e-12, abs=1e-12)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("build", [cart_and_pole, springs_and_dampers, raw_energies, space], ids=lambda f: f.__name__)
def test_m_dot_minus_2_c_is_skew_and_bias_is_c_v_plus_g(build):
    model = build()
    made = all_programs(model)
    at = state(model, 4) | {"u": [0.0] * len(model.inputs)}
    C = run(made["coriolis"], at)["C"]
    step = 1e-6

    def M(sign):
        moved = [q + sign * step * v for q, v in zip(at["q"], at["v"], strict=True)]
        return run(made["mass_matrix"], {**at, "q": moved})["M"]

    skew = (M(1) - M(-1)) / (2 * step) - 2 * C
    assert np.abs(skew + skew.T).max() < 1e-8 * (1 + np.abs(C).max())


@pytest.mark.parametrize("build", [cart_and_pole, space], ids=lambda f: f.__name__)
def test_power_balance(build):
    """dE/dt = Ξ_u·v − P with P the dampers' power, E = T + V, along the motion that `forward` gives."""
    model = build()
    made = all_programs(model)
    at = state(model, 5)
    a = run(made["forward"], at)["a"]
    step = 1e-6

    def energy(sign):
        q = [q + sign * step * v for q, v in zip(at["q"], at["v"], strict=True)]
        v = [v + sign * step * x for v, x in zip(at["v"], a, strict=True)]
        now = run(made["energy"], {**at, "q": q, "v": v})
        return now["T"] + now["V"]

    without = run(made["bias"], {**at, "u": [0.0] * len(model.inputs)})["h"]
    delivered = (without - run(made["bias"], at)["h"]) @ np.array(at["v"])
    change = (energy(1) - energy(-1)) / (2 * step)
    assert change == pytest.approx(delivered - run(made["loss"], at)["P"], rel=1e-6, abs=1e-6)


def test_gravity_is_the_slope_of_the_potential():
    model = space()
    made = all_programs(model)
    at = state(model, 6)
    G = run(made["potential_force"], at)["G"]
    step = 1e-6
    for i in range(len(G)):
        V = []
        for sign in (1, -1):
            q = list(at["q"])
            q[i] += sign * step
            V.append(run(made["energy"], {**at, "q": q})["V"])
        assert G[i] == pytest.approx((V[0] - V[1]) / (2 * step), rel=1e-7, abs=1e-7)


def test_rhs_is_the_rates_and_the_accelerations_in_declared_order():
    model = cart_and_pole()
    at = state(model, 7)
    a = run(programs.forward(model), at)["a"]
    xdot = run(programs.rhs(model), {**at, "x": [*at["q"], *at["v"]]})["xdot"]
    assert np.array_equal(xdot, [*at["v"], *a])


def test_jacobian_of_a_named_point():
    model = springs_and_dampers()
    at = state(model, 8)
    found = run(dynamics.point_program(model, dynamics.named_place(model, "Q", Point)), at)
    x, y, th = at["q"]
    L = dict(zip([p.name for p in model.parameters], at["p"], strict=True))["L"]
    assert found["r"] == pytest.approx([x + 0.5 + L * np.cos(th), y + 2 + L * np.sin(th)])
    assert found["J"] == pytest.approx(np.array([[1, 0, -L * np.sin(th)], [0, 1, L * np.cos(th)]]))
    assert found["v"] == pytest.approx(found["J"] @ at["v"])
    with pytest.raises(ModelError, match="no point 'q'"):
        dynamics.named_place(model, "q", Point)


def test_a_coordinate_without_mass_is_named():
    b = Builder("idle")
    x, y = b.coordinate("x").symbol, b.coordinate("y").symbol
    b.add(Particle(mass=1, at=b.origin + (x, 0)))
    b.add(Spring(k=2, deflection=x - y))
    with pytest.raises(ModelError, match="coordinate 'y' moves no mass"):
        programs.forward(b.model())


def test_every_program_has_the_same_groups_and_the_defaults():
    model = cart_and_pole()
    for name in PROGRAMS:
        program = getattr(programs, name)(model)
        assert set(program.inputs) >= {"q", "v", "u", "p", "t"}
        assert program.inputs["v"] == ("x'", "theta'")
        assert program.defaults.keys() == set(program.inputs["p"])
