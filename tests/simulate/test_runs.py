"""Runs against closed forms, hand-written equations and the energy they keep."""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import sympy as sp
from run_systems import example, oscillator
from scipy.integrate import solve_ivp

import lagrangian as lg
from lagrangian import dynamics, examples
from lagrangian.simulate.integrating import REMEMBERED, remembered

OURS = {"dop853": {}, "taylor": {}, "tsit5": {}, "rk4": {"step": 0.002}, "gauss4": {"step": 0.002}}
SCIPY = ("RK45", "DOP853", "Radau", "BDF", "LSODA")


def damped(t: np.ndarray, m: float = 2.0, k: float = 8.0, b: float = 0.4, q0: float = 1.0) -> np.ndarray:
    """q of m q̈ + b q̇ + k q = 0 from rest at q0."""
    a = b / (2 * m)
    w = np.sqrt(k / m - a * a)
    return q0 * np.exp(-a * t) * (np.cos(w * t) + a / w * np.sin(w * t))


@pytest.mark.parametrize("method", OURS)
def test_our_methods_follow_the_damped_oscillator(method: str) -> None:
    run = oscillator().simulate(5.0, q=1.0, samples=51, method=method, **OURS[method])
    assert run.success and run.method == method
    assert run["q"] == pytest.approx(damped(run.t), abs=1e-9)
    assert float(run.audit) < 1e-9


@pytest.mark.sampled(4)
@pytest.mark.parametrize("method", SCIPY)
def test_scipys_methods_follow_the_damped_oscillator(method: str) -> None:
    run = oscillator().simulate(5.0, q=1.0, samples=51, method=method, rtol=1e-8, atol=1e-10)
    assert run.success and run.method == method
    assert run["q"] == pytest.approx(damped(run.t), abs=3e-6)
    assert float(run.audit) < 1e-5


@pytest.mark.slow
def test_a_driven_oscillator_follows_its_closed_form() -> None:
    """m q̈ + b q̇ + k q = A sin Ω t from rest: steady state plus the decaying part that starts it at rest."""
    m, k, b, A, W = 2.0, 8.0, 0.4, 3.0, 1.3
    run = oscillator(m, k, b).simulate(10.0, inputs={"F": "3*sin(1.3*t)"}, samples=41)
    D = (k - m * W * W) ** 2 + (b * W) ** 2
    s, c = A * (k - m * W * W) / D, -A * b * W / D  # q_p = s sin Ωt + c cos Ωt
    a = b / (2 * m)
    w = np.sqrt(k / m - a * a)
    C1, C2 = -c, (-a * c - s * W) / w
    t = run.t
    wanted = s * np.sin(W * t) + c * np.cos(W * t) + np.exp(-a * t) * (C1 * np.cos(w * t) + C2 * np.sin(w * t))
    assert run["q"] == pytest.approx(wanted, abs=1e-9)
    assert run["F"] == pytest.approx(A * np.sin(W * t), abs=1e-12)


@pytest.mark.slow
def test_a_cart_pole_follows_equations_written_by_hand() -> None:
    s = example("cart-pole")
    p = {q.name: float(q.value or 0.0) for q in s.model.parameters}
    d = s.derive()
    accelerations = [sp.Derivative(c.symbol, (s.t, 2)) for c in s.model.coordinates]
    solved = sp.solve([e.lhs - e.rhs for e in d.equations], accelerations)
    state = sp.symbols("x theta v w F")
    named = [s["x"].diff(), s["theta"].diff(), s["x"], s["theta"], s["F"]]
    names = dict(zip(named, [state[k] for k in (2, 3, 0, 1, 4)], strict=True))
    q2 = [sp.lambdify(state, solved[a].subs(names).subs(p)) for a in accelerations]

    def f(t: float, x: np.ndarray) -> list[float]:
        return [x[2], x[3], *(g(*x, np.sin(t)) for g in q2)]

    ours = s.simulate(3.0, theta=0.3, inputs={"F": sp.sin(s.t)}, samples=31)
    theirs = solve_ivp(f, (0, 3), [0, 0.3, 0, 0], method="DOP853", t_eval=ours.t, rtol=1e-12, atol=1e-13)
    assert ours.y == pytest.approx(theirs.y, abs=1e-8)


def test_a_double_pendulum_follows_the_textbooks_equations() -> None:
    """With equal masses and rods of length 1, absolute angles; every textbook has them."""

    def f(t: float, x: np.ndarray) -> list[float]:
        a, b, v, w = x
        s, c, g = np.sin(a - b), np.cos(a - b), 9.81
        M = np.array([[2.0, c], [c, 1.0]])
        right = np.array([-w * w * s - 2 * g * np.sin(a), v * v * s - g * np.sin(b)])
        return [v, w, *np.linalg.solve(M, right)]

    x0 = [0.9, -0.4, 0.3, 0.1]
    run = example("double-pendulum").simulate(5.0, initial=x0, samples=51)
    theirs = solve_ivp(f, (0, 5), x0, method="DOP853", t_eval=run.t, rtol=1e-12, atol=1e-13)
    assert run.y == pytest.approx(theirs.y, abs=1e-8)


CONSERVATIVE = (
    "atwood", "bead-on-hoop", "bead-on-parabola", "chaplygin-sleigh", "double-parallelogram", "double-pendulum",
    "double-pendulum-relative", "elastic-pendulum", "ladder", "rod-pendulum", "rolling-cylinder", "rolling-disc",
    "spherical-pendulum", "spinning-top", "swinging-atwood", "triple-pendulum", "triple-pendulum-relative",
    "wheel-on-incline",
)  # fmt: skip


@pytest.mark.slow
def test_the_examples_without_supply_are_listed() -> None:
    free = [name for name in examples.names() if not example(name).model.inputs]
    supplied = [n for n in free if dynamics.SUPPLY in dynamics.closed(example(n).model, {}, supply=True).inputs["x"]]
    assert [n for n in free if n not in supplied] == list(CONSERVATIVE)


@pytest.mark.sampled(20)
@pytest.mark.parametrize("name", CONSERVATIVE)
def test_conservative_examples_hold_their_energy_over_a_hundred_seconds(name: str) -> None:
    """To 1e-9 relative at the default tolerances."""
    s = example(name)
    missing = {p.name: 1.0 for p in s.model.parameters if p.value is None}
    run = s.simulate(100.0, params=missing)
    assert run.success and run.t[-1] == 100.0
    assert float(run.audit) < 1e-9
    assert run.audit.conserved


def test_conservative_examples_are_many() -> None:
    assert len(CONSERVATIVE) >= 10


@pytest.mark.sampled(6)
@pytest.mark.parametrize("name", ["kapitza-pendulum", "duffing", "quarter-car", "crane", "acrobot"])
def test_driven_and_damped_examples_balance_their_power(name: str) -> None:
    s = example(name)
    missing = {p.name: 1.0 for p in s.model.parameters if p.value is None}
    first = {s.model.inputs[0].name: "0.3*sin(5*t)"} if s.model.inputs else {}
    run = s.simulate(2.0, params=missing, inputs=first)
    assert run.success and not run.audit.conserved
    assert float(run.audit) < 1e-9
    assert np.ptp(run.supplied) > 0


def test_a_symplectic_run_keeps_its_energy_where_a_fixed_step_run_loses_it() -> None:
    s = example("double-pendulum")
    options = {"theta1": 0.3, "theta2": 0.2, "samples": 401, "step": 0.05}
    drift = {m: s.simulate(400.0, method=m, **options).imbalance for m in ("gauss4", "rk4")}
    early, late = (np.max(np.abs(drift["gauss4"][part])) for part in (slice(0, 100), slice(300, 401)))
    assert late < 2 * early  # it stays within its bound
    assert abs(drift["rk4"][-1]) > 10 * late


@pytest.mark.parametrize("turns", [0.5, 2.0])
def test_a_pendulum_that_rounding_alone_moves_is_not_called_wrong(turns: float) -> None:
    """sin(2π) is 2.4e-16 in floating point: it creeps off with energies of 1e-29 J, beside 5 J of V."""
    run = lg.example("pendulum").simulate(1.0, theta=2 * np.pi * turns, initial={"theta'": 0.0})
    assert 0 < np.max(np.abs(run["theta'"])) < 1e-13 and np.ptp(run.energy) < 1e-14
    assert run.success and run.message == "the end of the interval was reached, t = 1 s"
    faint = lg.example("pendulum").simulate(1.0, theta=1e-9, initial={"theta'": 0.0})  # it does move, by 1e-18 J
    assert np.max(np.abs(faint["theta'"])) > 1e-9 and faint.message == run.message
    coarse = lg.example("pendulum").simulate(1.0, theta=1e-3, initial={"theta'": 0.0}, atol=10.0)
    assert coarse.audit.figure > 0  # a large tolerance does not make it rest


def test_energy_is_what_the_derivation_says() -> None:
    s = example("elastic-pendulum")
    run = s.simulate(1.0, samples=5)
    d = s.derive()
    q = [c.symbol for c in s.model.coordinates]
    for k in range(5):
        at = dict(zip([*(x.diff() for x in q), *q], [*run.y[2:, k], *run.y[:2, k]], strict=True))
        for expr, found in ((d.T, run.kinetic), (d.V, run.potential)):
            assert float(expr.subs(s.model.values).subs(at)) == pytest.approx(found[k], rel=1e-12)
    assert run.energy == pytest.approx(run.kinetic + run.potential)


def test_a_prescribed_motion_supplies_its_energy() -> None:
    """A bead on a rod that turns at Ω: r̈ = Ω² r, and h = ½ m ṙ² − ½ m Ω² r² is kept, T* is not."""
    s = lg.System("rod")
    r = s.coordinate("r")
    m, W = s.parameters("m W", m=1.0, W=2.0)
    s.particle(m, at=s.origin + (r * sp.cos(W * s.t), r * sp.sin(W * s.t)))
    run = s.simulate(1.0, r=0.1, samples=11)
    assert run["r"] == pytest.approx(0.1 * np.cosh(2 * run.t), rel=1e-10)
    assert run.audit.conserved and float(run.audit) < 1e-10
    assert run.energy[-1] > 5 * run.energy[0]


@pytest.mark.slow
def test_a_frame_that_floats_runs_by_its_quasi_velocities() -> None:
    """A brick turning free about its axis of greatest inertia, pushed by nothing: ω and its energy stay."""
    s = lg.System("brick")
    base = s.floating_frame("base")
    s.rigid_body(s.parameter("m", 1.0), (1, 2, 3), at=base.origin, frame=base)
    run = s.simulate(10.0, base_wz=2.0, base_vx=1.0, samples=21)
    assert run["base_wz"] == pytest.approx(np.full(21, 2.0), rel=1e-10)
    turn = 2 * np.arctan2(run["base_qz"], run["base_qw"])
    assert np.mod(turn - 2.0 * run.t + 1, 2 * np.pi) - 1 == pytest.approx(np.zeros(21), abs=1e-8)
    assert float(run.audit) < 1e-9
    with pytest.raises(lg.ModelError, match="no canonical momenta"):
        s.simulate(1.0, method="gauss4", step=0.1)


def test_defaults_come_from_the_models_file() -> None:
    s = example("cart-pole")
    run = s.simulate()
    assert run.t[-1] == 5.0 and run["theta"][0] == 0.1
    assert s.simulate(theta="20 deg")["theta"][0] == pytest.approx(np.radians(20))
    named = lg.loads(s.to_toml().replace("[simulate]", '[simulate]\ninputs = { F = "2*sin(t)" }'))
    assert named.simulate(1.0, samples=3)["F"] == pytest.approx(2 * np.sin([0, 0.5, 1.0]))


def test_parameters_change_without_new_code() -> None:
    s = oscillator()
    first = s.simulate(1.0, q=1.0, params={"b": 0.0})
    kept = dict(s.model._memo["compiled"])
    second = s.simulate(1.0, q=1.0, params={s["k"]: "32 N/m", "b": 0.0})
    solvers = [k for k in s.model._memo["compiled"] if k[0] == "solver"]
    assert len(solvers) == 1 and kept[solvers[0]] is s.model._memo["compiled"][solvers[0]]
    assert first["q"] == pytest.approx(np.cos(2 * first.t), abs=1e-9)
    assert second["q"] == pytest.approx(np.cos(4 * second.t), abs=1e-9)


def test_times_may_be_listed_and_need_not_start_at_the_start() -> None:
    run = oscillator(b=0.0).simulate(times=[1.0, 1.5, 4.0], start=0.5, q=1.0)
    assert list(run.t) == [0.5, 1.0, 1.5, 4.0]
    assert run["q"] == pytest.approx(np.cos(2 * (run.t - 0.5)), abs=1e-9)


def test_a_run_of_no_length_is_its_start() -> None:
    run = oscillator().simulate(0, q=1.0)
    assert run.success and run.y.shape == (2, 1) and run["q''"] == pytest.approx([-4.0])
    assert float(run.audit) == 0.0


def test_threads_may_run_one_system_at_a_time() -> None:
    """More laws than are kept compiled, asked for by four threads that give way to each other all the time."""
    system, before = oscillator(), sys.getswitchinterval()
    kept = [lambda k=k: str(k) for k in range(2 * REMEMBERED)]

    def ask(seed: int) -> bool:
        order = np.random.default_rng(seed).integers(0, len(kept), 5000)
        return all(remembered(model, int(k), kept[k]) == str(k) for k in order)

    model = system.model
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(4) as threads:
            assert all(threads.map(ask, range(4)))
    finally:
        sys.setswitchinterval(before)
