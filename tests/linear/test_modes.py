"""Poles, modes, stability, what inputs reach: against closed forms and python-control."""

import builtins
import difflib
import json
import math
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
import scipy.linalg
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

import lagrangian as lg
import size
from built_in import system as built_in
from lagrangian.cli import main
from lagrangian.errors import MissingExtra, RunError
from lagrangian.linear.closed_loop import closed_loop
from lagrangian.linear.modes import spectrum
from size import sized


def row_of_masses(n: int, *, b: float = 0.0) -> lg.System:
    """n equal masses between two walls, n + 1 equal springs."""
    system = lg.System("row")
    x = [system.coordinate(f"x{k + 1}") for k in range(n)]
    m, k, c = system.parameters("m k c", m=2.0, k=50.0, c=b)
    for q in x:
        system.particle(m, at=system.origin + (q, 0))
    for left, right in zip([sp.S.Zero, *x], [*x, sp.S.Zero], strict=True):
        system.spring(k, deflection=right - left)
        if b:
            system.damper(c, deflection=right - left)
    return system


@pytest.mark.parametrize("n", [1, 2, 3, 6])
def test_a_row_of_masses_has_the_textbooks_modes(n: int) -> None:
    """ω_j = 2 √(k/m) sin(jπ/2(n+1)), φ_ij ∝ sin(ijπ/(n+1)); Goldstein, Classical Mechanics (3rd ed.), ch. 6."""
    found = row_of_masses(n).linearize()
    assert len(found.modes) == n
    for j, mode in enumerate(found.modes, 1):
        assert mode.frequency == pytest.approx(2 * 5 * math.sin(j * math.pi / (2 * (n + 1))), rel=1e-12)
        assert mode.damping == 0 and mode.pair and mode.is_real
        shape = np.sin(j * np.pi * np.arange(1, n + 1) / (n + 1))
        got = np.array([mode.shape[f"x{i + 1}"].real for i in range(n)])
        assert np.abs(got).max() == pytest.approx(1)
        assert abs(shape @ got) == pytest.approx(np.linalg.norm(shape) * np.linalg.norm(got), rel=1e-12)
    assert found.stability.verdict == "stable"


def test_stiffness_proportional_damping_gives_the_closed_form_ratios() -> None:
    """With D = (c/k) K: ζ_j = c ω_j / (2 k)."""
    found = row_of_masses(3, b=4.0).linearize()
    for j, mode in enumerate(found.modes, 1):
        omega = 10 * math.sin(j * math.pi / 8)
        assert mode.frequency == pytest.approx(omega, rel=1e-12)
        assert mode.damping == pytest.approx(4.0 * omega / (2 * 50.0), rel=1e-12)
    assert found.stability.verdict == "asymptotically stable"
    assert found.stable is True


def test_poles_of_an_overdamped_oscillator_are_real() -> None:
    system = lg.System("slow")
    x = system.coordinates("x")
    m, k, b = system.parameters("m k b", m=1, k=1, b=4)
    system.particle(m, at=system.origin + (x, 0))
    system.spring(k, deflection=x)
    system.damper(b, deflection=x)
    found = system.linearize()
    assert np.allclose(sorted(found.poles.real), [-2 - math.sqrt(3), -2 + math.sqrt(3)], rtol=1e-14)
    assert [mode.pair for mode in found.modes] == [False, False]
    assert np.allclose(found.damping_ratios, 1)


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "name", ["lecture-1", "acrobot", "cart-pole", "quarter-car", "three-masses", "furuta-pendulum"]
)
def test_poles_are_those_of_python_control(name: str) -> None:
    import control  # two seconds for the processes that need none of it

    found = built_in(name).linearize()
    system = found.to_control()
    assert system.state_labels == list(found.states) and system.input_labels == list(found.inputs)
    with np.errstate(invalid="ignore"):  # its damping ratio of a pole at 0 is 0/0
        wn, zeta, poles = control.damp(system, doprint=False)
    assert _matched(found.poles, poles) < 1e-7
    assert _matched(found.frequencies, wn) < 1e-7
    moving = np.abs(poles) > 1e-6
    assert _matched(found.damping_ratios[found.frequencies > 1e-6], np.asarray(zeta)[moving]) < 1e-7
    assert np.linalg.matrix_rank(control.obsv(system.A, system.C)) == found.observability.rank


def _matched(a: Any, b: Any) -> float:
    """The largest difference after pairing nearest numbers."""
    from scipy.optimize import linear_sum_assignment

    cost = np.abs(np.asarray(a)[:, None] - np.asarray(b)[None, :])
    return float(cost[linear_sum_assignment(cost)].max(initial=0.0))


def test_the_mass_normal_form_is_the_first_order_one() -> None:
    found = built_in("quarter-car").linearize()
    assert found.mass is not None and found.stiffness is not None
    assert found.damping is not None and found.input_matrix is not None
    assert np.allclose(found.A[2:, :2], -np.linalg.solve(found.mass, found.stiffness), rtol=1e-12)
    assert np.allclose(found.A[2:, 2:], -np.linalg.solve(found.mass, found.damping), rtol=1e-12)
    assert np.allclose(found.B[2:], np.linalg.solve(found.mass, found.input_matrix), rtol=1e-12)


def test_a_cart_that_may_stand_anywhere_is_marginal_and_named() -> None:
    found = built_in("two-carts").linearize()
    assert found.stability.verdict == "marginal" and found.stable is None
    assert "brings x1 back" in found.stability.reason
    assert found.free == ("x1",)


def test_the_rest_at_a_pitchfork_is_not_decided_by_rounding() -> None:
    system = built_in("bead-on-hoop")
    found = system.linearize(params={"Omega": math.sqrt(9.81 / 0.3)})
    assert found.stability.verdict == "marginal"


def test_the_upright_pendulum_is_unstable_by_its_pole() -> None:
    found = built_in("pendulum").linearize({"theta": math.pi})
    assert found.stable is False
    assert found.stability.pole is not None and found.stability.pole.real > 0


def test_coefficients_that_change_with_time_are_not_judged_by_poles() -> None:
    found = built_in("kapitza-pendulum").linearize()
    assert found.changing and found.stability.verdict == "depends on time"


def test_a_follower_force_is_judged_by_poles_not_by_energy() -> None:
    """A circulatory K: symmetric part positive definite, and yet flutter (Ziegler). M = 1, K = [[2, 3], [-3, 2]]."""
    system = lg.System("flutter")
    x, y = system.coordinates("x y")
    system.particle(1, at=system.origin + (x, y))
    system.potential(x**2 + y**2)
    system.generalized_force(x, -3 * y)
    system.generalized_force(y, 3 * x)
    found = system.linearize()
    assert found.stable is False
    # λ² = −2 ± 3i
    wanted = [s * np.sqrt(complex(-2, t)) for s in (1, -1) for t in (3, -3)]
    assert _matched(found.poles, wanted) < 1e-12


def test_gyroscopic_stabilisation_of_a_sleeping_top_is_found_by_poles() -> None:
    """Upright the top sleeps where (C ω)² > 4 A m g l; Goldstein (3rd ed.), § 5.7. Angles about fixed x and y."""
    for spin, sleeps in ((150.0, True), (60.0, False)):
        found = _top().linearize({"psi'": spin})
        assert found.kind == "steady motion" and found.free == ("psi",)
        A, C, mgl = 0.0006 + 0.5 * 0.08**2, 0.0008, 0.5 * 9.81 * 0.08
        assert ((C * spin) ** 2 > 4 * A * mgl) == sleeps
        assert (found.stable is not False) == sleeps
        rates = sorted(f for f in found.frequencies if f > 1e-6)
        if sleeps:  # A λ² ∓ i C ω λ − m g l = 0
            root = math.sqrt((C * spin) ** 2 - 4 * A * mgl)
            wanted = sorted([(C * spin - root) / (2 * A), (C * spin + root) / (2 * A)] * 2)
            assert rates == pytest.approx(wanted, rel=1e-9)


def _top() -> lg.System:
    system = lg.System("top")
    a, b, psi = system.coordinates("a b psi")
    first = system.frame(a, axis=(1, 0, 0))
    second = system.frame(b, axis=(0, 1, 0), parent=first)
    third = system.frame(psi, axis=(0, 0, 1), parent=second)
    centre = second.point(0, 0, sp.Rational(8, 100))
    system.rigid_body(0.5, (0.0006, 0.0006, 0.0008), at=centre, frame=third)
    system.gravity(direction=(0, 0, -1))
    return system


# -- poles that count more than once -------------------------------------------------------------------------------


def test_critical_damping_is_one_mode_without_swinging() -> None:
    """m = k = 1, b = 2: (λ + 1)² = 0."""
    system = lg.System("critical")
    x = system.coordinates("x")
    m, k, b = system.parameters("m k b", m=1, k=1, b=2)
    system.particle(m, at=system.origin + (x, 0))
    system.spring(k, deflection=x)
    system.damper(b, deflection=x)
    found = system.linearize()
    assert found.poles == pytest.approx([-1, -1], rel=1e-12) and (found.poles.imag == 0).all()
    (mode,) = found.modes
    assert mode.damping == 1 and not mode.pair


def _ring(c: float) -> lg.System:
    """Three equal masses in a ring of equal springs and dampers."""
    system = lg.System("ring")
    x = system.coordinates("x1 x2 x3")
    m, k = system.parameters("m k", m=2, k=6)
    for q, before in zip(x, (x[2], *x[:2]), strict=True):
        system.particle(m, at=system.origin + (q, 0))
        system.spring(k, deflection=q - before)
        if c:
            system.damper(c, deflection=q - before)
    return system


@pytest.mark.parametrize("c", [0, 0.4])
def test_equal_poles_have_shapes_in_reduced_form(c: float) -> None:
    """ω² = 3k/m twice, with any shape of sum 0."""
    still, *swinging = _ring(c).linearize().modes
    assert still.pole == 0 and list(still.shape.values()) == pytest.approx([1, 1, 1], rel=1e-14)
    assert [m.frequency for m in swinging] == pytest.approx([3, 3], rel=1e-12)
    assert np.allclose([list(m.shape.values()) for m in swinging], [[1, 0, -1], [0, 1, -1]], rtol=0, atol=1e-12)
    assert [m.is_real for m in swinging] == [True, True]


@pytest.mark.parametrize("rows", [2, 3, 4])
def test_a_jordan_block_is_one_pole_with_one_vector(rows: int) -> None:
    from lagrangian.linear.eigenspaces import eigenspaces

    source = np.random.default_rng(rows)
    for pole in (0.0, -1.5):
        J = np.diag(np.array([pole] * rows + [-3.0, 2.0])) + np.diag([1.0] * (rows - 1) + [0.0, 0.0], 1)
        turn = np.linalg.qr(source.standard_normal(J.shape))[0]
        found = sorted(eigenspaces(turn @ J @ turn.T), key=lambda s: -s.times)
        assert [s.times for s in found] == [rows, 1, 1]
        assert found[0].pole == pytest.approx(pole, abs=1e-12)
        (vector,) = found[0].basis.T
        assert abs(vector @ turn[:, 0]) == pytest.approx(1, rel=1e-10)  # J e₁ = λ e₁


def test_poles_that_differ_stay_apart() -> None:
    from lagrangian.linear.modes import spectrum

    apart = [-1e-7, -2e-7, -1.0, -1.0001, -1.0002, -500.0]
    assert np.allclose(spectrum(np.diag(apart)).poles, apart, rtol=1e-14)


def test_poles_of_a_system_in_unlike_units_are_found() -> None:
    """A charge of 1 C on a plate of a microscope: entries of A from 1 to 1e28. Oracle: its poles in 60 digits."""
    linear = built_in("capacitive-actuator").linearize({"q": 1.0, "x": 0.3}, operating_point=True)
    assert np.abs(linear.A).max() > 1e25
    with mpmath.workdps(60):
        exact = [complex(x) for x in mpmath.eig(mpmath.matrix(linear.A.tolist()))[0]]
    for pole in linear.poles:
        assert min(abs(pole - x) for x in exact) < 1e-9 * abs(pole)
    assert len(set(np.round(linear.poles / np.abs(linear.poles).max(), 6))) == 4


@pytest.mark.slow
def test_every_text_is_the_same_whatever_the_processor() -> None:
    """OpenBLAS has kernels for many processors, each with other last digits; where another library is, all agree.

    The two that differ most are compared for every change, on every second example; all, and a third, before a release.
    """
    program = Path(__file__).with_name("texts_of_examples.py")
    texts: dict[str, list[str]] = {}
    step = "1" if size.EVERY else "2"
    for core, shaken in (("Haswell", 0), ("Prescott", 2), ("SkylakeX", 1))[: 3 if size.EVERY else 2]:
        known = {**os.environ, "OPENBLAS_CORETYPE": core, "PYTHONIOENCODING": "utf-8"}
        done = subprocess.run(
            [sys.executable, str(program), str(shaken), step], env=known, capture_output=True, check=False
        )
        if done.returncode < 0 and core == "SkylakeX":
            continue  # its instructions are not there
        assert done.returncode == 0, done.stderr.decode()
        texts[f"{core}, shaken by {shaken}"] = done.stdout.decode().splitlines()
    (name, first), *others = texts.items()
    assert first and others
    for other, text in others:
        differing = difflib.unified_diff(first, text, name, other, lineterm="", n=3)
        assert text == first, "\n".join(differing)


# -- what inputs reach ---------------------------------------------------------------------------------------------


def test_two_carts_pushed_apart_keep_their_centre_of_mass() -> None:
    found = built_in("lecture-3a").linearize().controllability
    assert (found.rank, found.order, found.complete, found.enough) == (2, 4, False, False)
    momentum = found.missing[0].combination
    assert set(momentum) == {"x1'", "x2'"}
    assert all(m.pole == 0 for m in found.missing)


def _in_other_last_digits(a: Any, seed: int) -> Any:
    """What another processor may have made of an array: every entry a few roundings away."""
    source = np.random.default_rng(seed)
    return a + 4e-16 * np.abs(a).max() * source.uniform(-1, 1, a.shape)


@pytest.mark.parametrize("seed", range(5))
def test_what_runs_by_itself_is_named_alike_on_every_processor(seed: int) -> None:
    """The momentum x1' + 2 x2' of masses 1 and 2 is the one combination with wᵀA = 0: a Jordan block of two rows."""
    from lagrangian.linear.reach import controllable

    found = built_in("lecture-3a").linearize()
    (missing,) = controllable(_in_other_last_digits(found.A, seed), found.B, found.states).missing
    assert missing.pole == 0 and missing.times == 2
    assert set(missing.combination) == {"x1'", "x2'"}
    assert missing.combination["x1'"] == pytest.approx(0.5, rel=1e-12)
    assert missing.combination["x2'"] == 1


def test_the_report_names_momentum_once() -> None:
    text = " ".join(built_in("lecture-3a").linearize().to_text().split())
    assert "not controllable: the pole 0 (2 times) of 0.5·x1' + x2'; not stabilizable." in text


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", ["acrobot", "ball-and-beam", "cart-pole", "segway", "furuta-pendulum", "lecture-2"])
def test_ranks_are_those_of_python_controls_matrices(name: str) -> None:
    import control  # two seconds for the processes that need none of it

    system = built_in(name)
    found = system.linearize(system.equilibria()[0])
    assert found.controllability.rank == np.linalg.matrix_rank(control.ctrb(found.A, found.B), tol=1e-8)


def test_the_staircase_finds_planted_uncontrollable_modes_whatever_the_units() -> None:
    from lagrangian.linear.reach import controllable

    source = np.random.default_rng(8)
    for hidden in (1, 2, 3):
        n = 6
        A = source.standard_normal((n, n))
        B = source.standard_normal((n, 2))
        A[n - hidden :, : n - hidden] = 0
        B[n - hidden :] = 0
        planted = np.linalg.eigvals(A[n - hidden :, n - hidden :])
        turn = np.linalg.qr(source.standard_normal((n, n)))[0]
        units = np.diag(10.0 ** source.uniform(-4, 4, n))
        T = units @ turn
        found = controllable(T @ A @ np.linalg.inv(T), T @ B, tuple(f"s{k}" for k in range(n)))
        assert found.rank == n - hidden
        assert _matched([m.pole for m in found.missing], [p for p in planted if p.imag >= 0]) < 1e-6


def test_a_mode_that_the_output_does_not_show_is_named() -> None:
    system = row_of_masses(3)
    found = system.linearize(outputs=["x2"]).observability
    (missing,) = found.missing
    assert missing.pole.imag == pytest.approx(10 * math.sin(math.pi / 4))
    assert missing.combination["x1'"] == pytest.approx(-missing.combination["x3'"])


def test_a_system_without_inputs_has_no_controllability() -> None:
    with pytest.raises(RunError, match="no input"):
        _ = built_in("double-pendulum").linearize().controllability


# -- python-control ------------------------------------------------------------------------------------------------


def test_the_regulator_solves_riccatis_equation_and_its_law_stabilises() -> None:
    linear = built_in("cart-pole").linearize()
    found = linear.lqr({"x": 10, "theta": 100}, 0.5)
    Q, R = np.diag([10.0, 100, 0, 0]), np.array([[0.5]])
    S = scipy.linalg.solve_continuous_are(linear.A, linear.B, Q, R)
    assert np.allclose(found.K, np.linalg.solve(R, linear.B.T @ S), rtol=1e-8)
    assert _matched(found.poles, np.linalg.eigvals(linear.A - linear.B @ found.K)) < 1e-8
    assert (found.poles.real < 0).all()
    (law,) = found.law.values()
    x = linear.model.coordinates[0].symbol
    assert float(-sp.diff(law, x)) == pytest.approx(found.K[0, 0], rel=1e-15)


def test_the_regulator_is_that_of_python_control() -> None:
    control = pytest.importorskip("control")
    linear = built_in("acrobot").linearize()
    found = linear.lqr({"theta1": 3, "theta2": 2, "theta1'": 1}, 0.25)
    K, S, poles = control.lqr(linear.A, linear.B, np.diag([3.0, 2, 1, 0]), np.array([[0.25]]))
    assert np.allclose(found.K, K, rtol=1e-8) and np.allclose(found.S, S, rtol=1e-8)
    assert _matched(found.poles, poles) < 1e-6


def test_a_regulator_says_what_was_checked_of_it() -> None:
    """Riccati's and Lyapunov's equations, the poles, and the slopes of the nonlinear system with the law as it is."""
    found = built_in("cart-pole").linearize().lqr({"x": 10, "theta": 100}, 0.5)
    assert len(found.verified) == 4 and all(check.holds for check in found.verified)
    assert "What was checked" in str(found)
    wrong = replace(found, K=found.K * 1.001)
    assert [check.holds for check in wrong.verified] == [True, False, True, True]  # it costs more than S
    S = found.S.copy()
    S[0, 0] *= 1.001
    assert [check.holds for check in replace(found, S=S).verified] == [False, False, True, True]
    (symbol, expression), *_ = found.law.items()
    other = closed_loop(found.linear, (found.Q, found.R, found.K, found.S), {symbol: expression * 1.001})
    assert [check.holds for check in other] == [True, True, True, False]


def test_what_no_feedback_stabilises_is_named() -> None:
    with pytest.raises(RunError, match="not controllable"):
        built_in("lecture-3a").linearize().lqr(1, 1)


def test_a_regulator_without_an_input_says_so(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["regulate", "-e", "pendulum", "--at", "theta=0.3"]) != 0
    assert "the system has no input" in capsys.readouterr().err


def test_a_kink_of_friction_is_told_with_its_name_and_what_helps() -> None:
    s = lg.System("block")
    x, m = s.coordinate("x"), s.parameter("m", 2.0)
    s.particle(m, at=s.origin + (x, 0))
    s.friction(0.3, normal=9.81 * m, deflection=x, name="floor")
    with pytest.raises(RunError, match=r"'floor' turns round.*no linearization") as error:
        s.linearize()
    assert "regime({'floor': 1})" in str(error.value)


def test_a_state_that_costs_nothing_and_does_not_decay_is_named() -> None:
    s = lg.System("cart")
    x, F, m = s.coordinate("x"), s.input("F"), s.parameter("m", "2 kg")
    s.particle(m, at=s.origin + (x, 0))
    s.force(F, deflection=x)
    with pytest.raises(RunError, match="the pole 0 of x' would stay as it is, since no weight"):
        s.linearize().lqr(0, 1)


def test_a_coordinate_that_only_moves_on_and_costs_nothing_is_left_out_of_a_law() -> None:
    """A motor's current, angle and speed are its states: its charge drifts while the law holds them."""
    found = built_in("dc-motor").linearize().lqr({"theta": 1}, 1)
    assert found.left_out == ("q",) and len(found.poles) == 3
    assert not found.K[:, 0].any() and not found.S[0].any() and (found.poles.real < 0).all()
    assert all(check.holds for check in found.verified) and "left out: no rate depends on it" in str(found)
    assert not built_in("dc-motor").linearize().lqr({"theta": 1, "q": 0.1}, 1).left_out


@pytest.mark.parametrize(
    ("Q", "R", "message"),
    [
        (np.eye(3), 1, r"\(4, 4\)"),
        ({"thta": 1}, 1, "Did you mean 'theta'"),
        (1, -1, "positive definite"),
        (-1, 1, "semidefinite"),
        (np.triu(np.ones((4, 4))), 1, "symmetric"),
        ("x", 1, "Q"),
    ],
)
def test_bad_weights_are_named(Q: object, R: object, message: str) -> None:
    with pytest.raises((RunError, lg.ModelError), match=message):
        built_in("cart-pole").linearize().lqr(Q, R)


def test_the_command_regulates(capsys: pytest.CaptureFixture[str]) -> None:
    """K is Riccati's by SciPy; the law that is printed is read by `simulate` as it stands."""
    assert main(["regulate", "-e", "cart-pole", "-Q", "x=10", "-Q", "theta=100", "-R", "F=0.5", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    linear = built_in("cart-pole").linearize()
    S = scipy.linalg.solve_continuous_are(linear.A, linear.B, np.diag([10.0, 100, 0, 0]), [[0.5]])
    assert np.allclose(found["K"], linear.B.T @ S / 0.5, rtol=1e-12) and np.allclose(found["S"], S, rtol=1e-12)
    assert [check["holds"] for check in found["checks"]] == [True] * 4 and found["states"] == list(linear.states)
    law = built_in("cart-pole").simulate(6.0, theta=0.1, samples=2, inputs=found["law"])
    assert abs(law["theta"][-1]) < 1e-2 and abs(law["x"][-1]) < 1e-2
    assert main(["regulate", "-e", "cart-pole"]) == 0
    said = capsys.readouterr().out
    assert "poles of the closed loop" in said and "the system with this law has the slopes A − BK" in said


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (["lecture-3a"], "no feedback can stabilize the system"),
        (["cart-pole", "-Q", "theta=1", "-Q", "3"], "-Q takes name=weight, or one number for all"),
        (["cart-pole", "-R", "F=-1"], "R must be positive definite"),
        (["cart-pole", "-Q", "thta=1"], "Did you mean 'theta'?"),
        (["cart-pole", "--at", "theta=1"], "constant inputs may hold the point, --input F=5"),
    ],
)
def test_the_command_says_why_it_does_not_regulate(
    given: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["regulate", "-e", *given]) == 2
    assert message in capsys.readouterr().err


def test_a_missing_python_control_is_answered_with_the_line_that_installs_it(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def without(name: str, *rest: Any, **named: Any) -> Any:
        if name == "control":
            raise ImportError(name)
        return real(name, *rest, **named)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(MissingExtra, match=r"pip install 'lagrangian\[control\]'"):
        built_in("cart-pole").linearize().to_control()


@pytest.mark.slow
def test_the_regulators_law_balances_the_pole_in_a_run() -> None:
    system = built_in("cart-pole")
    regulator = system.linearize().lqr({"x": 10, "theta": 100}, 0.5)
    run = system.simulate(12.0, theta=0.15, inputs=regulator.law)
    assert run.success
    assert abs(run["theta"][-1]) < 1e-4 and abs(run["x"][-1]) < 1e-3
    along = system.linearize_along(run)
    assert along.A.shape == (len(run.t), 4, 4)
    assert np.allclose(along.A[-1], system.linearize().A, atol=1e-3)
    assert np.allclose(along.u[0, 0], -regulator.K[0] @ [0, 0.15, 0, 0])


@sized(40, 10)
@given(n=st.integers(1, 6), seed=st.integers(0, 10_000), floor=st.sampled_from([0, 0, 1, 2]))
def test_undamped_spectra_are_those_of_scipys_pencil(n: int, seed: int, floor: int) -> None:
    """K with ``floor`` directions that nothing restores: as many double poles at 0, the others imaginary exactly."""
    from lagrangian.linear.modes import modes, spectrum

    source = np.random.default_rng(seed)
    floor = min(floor, n)
    X, Y = source.standard_normal((n, n)), source.standard_normal((n, n))
    M = X @ X.T + 0.1 * np.eye(n)
    half = Y[:, floor:]
    K = half @ half.T
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K), np.zeros((n, n))]])
    found = spectrum(A, (M, np.zeros((n, n)), K))
    squares = np.sort(np.maximum(scipy.linalg.eigvalsh(K, M), 0))
    assert (found.poles.real == 0).all()
    assert np.allclose(
        np.sort(found.poles.imag**2), np.repeat(squares, 2), rtol=1e-7, atol=1e-9 * squares.max(initial=1)
    )
    listed = modes(found, tuple(f"q{k}" for k in range(n)))
    assert sum(m.pole != 0 for m in listed) == n - floor
    for m in listed:
        shape = np.array(list(m.shape.values()))
        assert np.abs(shape).max() == pytest.approx(1)
        residual = K @ shape - m.frequency**2 * (M @ shape)
        assert np.abs(residual).max() <= 1e-7 * max(1.0, np.abs(K).max())


@pytest.mark.parametrize("ratio", [1e-4, 1e-14, 1e-30, 1e-149])
def test_a_slow_mode_keeps_its_digits_beside_a_much_faster_one(ratio: float) -> None:
    """Two masses in a row behind a wall, exact to the third power of the ratio: ω² = 1 − r and 1/r + 1."""
    s = lg.System("row")
    x, y = s.coordinates("x y")
    s.particle(1, at=s.origin + (x, 0))
    s.particle(ratio, at=s.origin + (y, 0))
    s.spring(1, deflection=x)
    s.spring(1, deflection=y - x)
    slow, fast = s.linearize().modes
    assert slow.frequency**2 == pytest.approx(1 - ratio, rel=10 * ratio**2 + 1e-13)
    assert fast.frequency**2 == pytest.approx(1 / ratio + 1, rel=10 * ratio**2 + 1e-13)
    assert slow.shape["y"] / slow.shape["x"] == pytest.approx(1 + ratio, rel=10 * ratio**2 + 1e-13)


def test_shapes_do_not_take_their_scale_from_rounding() -> None:
    """A coordinate on which nothing depends, with 1e-18 for its slopes: eigenvectors had lost half of their digits."""
    A = np.zeros((6, 6))
    A[:3, 3:] = np.eye(3)
    A[3:] = [
        [0, 1.9e-2, 1.2e-18, 2.0e-2, 1.0, -3e-3],
        [0, 79.3, 3.5e-18, -0.37, 0, 6.6e-2],
        [0, -1.7e-2, -4.9e-19, -2.1e-2, -1.1, 2.3e-3],
    ]
    noise = np.where(np.abs(A) < 1e-12, 2e-19, 1e-15) * (A != 0) * (np.arange(6) > 2)[:, None]
    found = spectrum(A, None, (noise, 0.0))
    off = A @ found.vectors - found.vectors * found.poles
    assert np.abs(off).max() < 1e-13 * np.abs(found.vectors).max() * np.linalg.norm(A)
