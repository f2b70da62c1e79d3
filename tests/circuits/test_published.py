"""Electromechanical systems that are no built-in examples, against the results that books and papers publish."""

from __future__ import annotations

import math
import pathlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from sympy import cos, log, sin

import lagrangian as lg


def response(linear: lg.Linearization, s: complex) -> complex:
    """C (s I − A)⁻¹ B + D for one input and one output."""
    n = len(linear.A)
    return complex((linear.C @ np.linalg.solve(s * np.eye(n) - linear.A, linear.B) + linear.D)[0, 0])


def charges(s: lg.System, names: str) -> list[Any]:
    return [s.coordinate(name, unit="C") for name in names.split()]


def rotor(s: lg.System, inertia: str) -> tuple[Any, Any]:
    """An angle, and the frame of a body that turns by it."""
    theta = s.coordinate("theta")
    frame = s.frame(theta, name="rotor")
    s.rigid_body(1, s.parameter("J", inertia), at=s.origin, frame=frame, name="rotor")
    return theta, frame


@pytest.mark.slow
def test_the_torque_between_two_windings() -> None:
    """A. E. Fitzgerald, C. Kingsley, S. D. Umans, Electric Machinery, 6th edition (2003), example 3.6.

    L₁₁ = (3 + cos 2θ) mH, L₁₂ = 0.3 cos θ H, L₂₂ = 30 + 10 cos 2θ H, i₁ = 0.8 A, i₂ = 0.01 A:
    T = −1.64e-3 sin 2θ − 2.4e-3 sin θ.
    """
    s = lg.System("two windings")
    q1, q2 = charges(s, "q1 q2")
    theta, _ = rotor(s, "0.01 kg*m^2")
    H = s.parameter("H", "1 H")
    s.inductor(H * (3 + cos(2 * theta)) / 1000, q1, name="stator")
    s.inductor(H * (30 + 10 * cos(2 * theta)), q2, name="rotor winding")
    s.mutual_inductance(H * 3 * cos(theta) / 10, q1, q2)
    angle = np.linspace(-3, 3, 13)
    q, v = np.zeros((13, 3)), np.tile([0.8, 0.01, 0.0], (13, 1))
    q[:, 2] = angle
    torque = -s.compile().inverse(q, v, np.zeros((13, 3)))[:, 2]
    np.testing.assert_allclose(torque, -1.64e-3 * np.sin(2 * angle) - 2.4e-3 * np.sin(angle), atol=1e-15)


@pytest.mark.slow
def test_a_motor_for_positions_has_the_published_transfer_function() -> None:
    """Control Tutorials for MATLAB and Simulink (University of Michigan), DC motor speed: J = 0.01, b = 0.1, K = 0.01,
    R = 1, L = 0.5: P(s) = 0.01/(0.005 s² + 0.06 s + 0.1001), poles at −2.0025 and −9.9975."""
    s = lg.System("motor")
    (q,) = charges(s, "q")
    theta, frame = rotor(s, "0.01 kg*m^2")
    u = s.input("u", unit="V")
    s.damper(s.parameter("b", "0.1 N*m*s"), deflection=theta)
    s.inductor(s.parameter("L", "0.5 H"), q)
    s.resistor(s.parameter("R", "1 ohm"), q)
    s.voltage_source(u, q)
    s.transducer(s.parameter("K", "0.01 N*m/A"), q, on=frame)
    linear = s.linearize(outputs=["theta'"])
    assert sorted(p.real for p in linear.poles)[:2] == pytest.approx([-9.9975, -2.0025], abs=5e-5)
    for z in (0.3, 1j, 3 + 2j):
        assert abs(response(linear, z) * (0.005 * z * z + 0.06 * z + 0.1001) / 0.01 - 1) < 1e-9


def test_a_ball_below_a_magnet_is_linearized_as_published() -> None:
    """Control Tutorials for MATLAB and Simulink, magnetically suspended ball: the pull K i²/h, m = 0.05 kg, K = 1e-4,
    L = 0.01 H, R = 1 Ω, g = 9.8, h = 0.01 m, i = 7 A: A = [0 1 0; 980 0 −2.8; 0 0 −100], B = [0; 0; 100].

    The pull K i²/h is that of the inductance L − 2 K ln h. So the ball's velocity is also in the circuit's equation,
    by 2 K i/(h L) = 14, which the tutorial neglects.
    """
    s = lg.System("ball")
    (q,) = charges(s, "q")
    h = s.coordinate("h", unit="m", positive=True)
    L, K, h0, m = s.parameters("L K h0 m", L="0.01 H", K="1e-4 H", h0="0.01 m", m="0.05 kg")
    s.particle(m, at=s.point("ball", (0, -h)))
    s.gravity()
    s.inductor(L - 2 * K * log(h / h0), q)
    s.resistor(s.parameter("R", "1 ohm"), q)
    s.voltage_source(s.input("u", unit="V"), q)
    linear = s.linearize({"h": 0.01, "q'": 7}, inputs={"u": 7}, params={"g": 9.8})
    order = [linear.states.index(x) for x in ("h", "h'", "q'")]
    A = linear.A[np.ix_(order, order)]
    np.testing.assert_allclose(A, [[0, 1, 0], [980, 0, -2.8], [0, 14, -100]], rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(linear.B[order, 0], [0, 0, 100], rtol=1e-12)


def test_a_loaded_transformer_has_the_reflected_impedance() -> None:
    """J. W. Nilsson, S. A. Riedel, Electric Circuits, section 9.10: Z = R₁ + jωL₁ + ω²M²/(R₂ + jωL₂)."""
    s = lg.System("transformer")
    q1, q2 = charges(s, "q1 q2")
    R1, L1, M, L2, R2 = s.parameters("R1 L1 M L2 R2", R1="200 ohm", L1="9 H", M="3 H", L2="4 H", R2="900 ohm")
    s.inductor(L1, q1, name="primary")
    s.inductor(L2, q2, name="secondary")
    s.mutual_inductance(M, q1, q2)
    s.resistor(R1, q1, name="first")
    s.resistor(R2, q2, name="second")
    s.voltage_source(s.input("u", unit="V"), q1)
    linear = s.linearize(outputs=["q1'"])
    for w in (10.0, 400.0):
        Z = 200 + 9j * w + (3 * w) ** 2 / (900 + 4j * w)
        assert abs(response(linear, 1j * w) * Z - 1) < 1e-10


def test_a_loudspeaker_is_measured_as_thiele_and_small_do() -> None:
    """R. H. Small, Direct-radiator loudspeaker system analysis, J. Audio Eng. Soc. 20 (1972), appendix: with the
    largest impedance r₀ R at f_s, and |Z| = √r₀ R at f₁ and f₂: f₁ f₂ = f_s², Q_MS = f_s √r₀/(f₂ − f₁),
    Q_ES = Q_MS/(r₀ − 1); by construction Q_MS = √(k m)/b and Q_ES = R √(k m)/(Bl)²."""
    s = lg.System("woofer")
    (q,) = charges(s, "q")
    x = s.coordinate("x", unit="m")
    m, k, b, Bl, R = 0.025, 900.0, 1.5, 8.0, 5.6
    s.particle(s.parameter("m", m), at=s.point("cone", (x, 0)))
    s.spring(s.parameter("k", k), deflection=x)
    s.damper(s.parameter("b", b), deflection=x)
    s.inductor(s.parameter("L", "1 nH"), q)  # a voice coil's is neglected there
    s.resistor(s.parameter("R", R), q)
    s.voltage_source(s.input("u", unit="V"), q)
    s.transducer(s.parameter("Bl", Bl), q, on=x)
    linear = s.linearize(outputs=["q'"])

    def Z(w: float) -> float:
        return abs(1 / response(linear, 1j * w))

    ws = math.sqrt(k / m)
    r0 = Z(ws) / R
    level = math.sqrt(r0) * R
    w1, w2 = (bisected(lambda w: Z(w) - level, *ends) for ends in ((ws / 20, ws), (ws, 20 * ws)))
    assert math.sqrt(w1 * w2) == pytest.approx(ws, rel=1e-6)
    Q = ws * math.sqrt(r0) / (w2 - w1)
    assert Q * b == pytest.approx(math.sqrt(k * m), rel=1e-6)
    assert Q / (r0 - 1) == pytest.approx(R * math.sqrt(k * m) / Bl**2, rel=1e-6)


def bisected(f: Callable[[float], float], low: float, high: float) -> float:
    """A root of f between two ends at which it has other signs."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if f(low) * f(middle) > 0 else (low, middle)
    return low


def test_a_piezoelectric_resonator_couples_as_the_standard_says() -> None:
    """IEEE Std 176-1987: k² = (f_p² − f_s²)/f_p² with the resonances of open and of closed electrodes.

    With V = ½ k x² + q²/(2 C) − α q x it is α² C/k: closed electrodes soften the spring to k − α² C.
    """
    s = lg.System("resonator")
    (q,) = charges(s, "q")
    x = s.coordinate("x", unit="m")
    m, k, a, C = s.parameters("m k a C", m="1 g", k="1e6 N/m", a="2e7 V/m", C="1 nF")
    s.particle(m, at=s.point("P", (x, 0)))
    s.spring(k, deflection=x)
    s.capacitor(energy=lambda Q: Q**2 / (2 * C) - a * Q * x, charge=q)
    s.inductor(s.parameter("L", "1e-12 H"), q)
    f_s = min(abs(p) for p in s.linearize().poles if abs(p) > 0)
    f_p = math.sqrt(1e6 / 1e-3)
    assert (f_p**2 - f_s**2) / f_p**2 == pytest.approx(4e14 * 1e-9 / 1e6, rel=1e-5)


@pytest.mark.slow
def test_the_speed_of_a_motor_in_series_is_that_of_the_books() -> None:
    """P. C. Krause, O. Wasynczuk, S. D. Sudhoff, Analysis of Electric Machinery, section on series-connected machines:
    T = L_AF V²/(r + L_AF ω)²: the field is made by the current itself, so k = L_AF i."""
    s = lg.System("series motor")
    (q,) = charges(s, "q")
    theta, frame = rotor(s, "0.02 kg*m^2")
    K, R, L, b = s.parameters("K R L b", K="0.05 H", R="1.2 ohm", L="20 mH", b="0.03 N*m*s")
    u = s.input("u", unit="V")
    s.damper(b, deflection=theta)
    s.inductor(L, q)
    s.resistor(R, q)
    s.voltage_source(u, q)
    s.transducer(K * q.diff(), q, on=frame)
    run = s.simulate(15.0, inputs={"u": 40}, initial={"q'": 1}, samples=31)
    speed = run["theta'"][-1]
    assert 0.05 * 40**2 / (1.2 + 0.05 * speed) ** 2 == pytest.approx(0.03 * speed, rel=1e-6)
    assert np.abs(run.imbalance).max() < 1e-7 * np.abs(run.supplied).max()
    checks = s.derive().verify()
    assert checks and all(check.holds for check in checks)


def test_a_disc_dynamo_excites_itself_and_keeps_its_amplitude() -> None:
    """E. C. Bullard, The stability of a homopolar dynamo, Proc. Camb. Phil. Soc. 51 (1955) 744: L i' + R i = M Ω i and
    J Ω' = G − M i². Without friction the oscillation about Ω = R/M, i² = G/M is neither damped nor grows;
    ½ J (Ω − R/M)² + ½ L i² − (G L/M) ln i stays what it is, and small ones have ω² = 2 M G/(J L)."""
    s = lg.System("disc dynamo")
    (q,) = charges(s, "q")
    theta, frame = rotor(s, "2 kg*m^2")
    G, R, L, M = s.parameters("G R L M", G="3 N*m", R="0.5 ohm", L="0.4 H", M="0.1 H")
    s.torque(G, on=theta)
    s.inductor(L, q)
    s.resistor(R, q)
    s.transducer(-M * q.diff(), q, on=frame)
    steady = {"theta'": 5.0, "q'": math.sqrt(30.0)}
    poles = s.linearize(steady).poles
    assert max(abs(p.imag) for p in poles) == pytest.approx(math.sqrt(2 * 0.1 * 3 / (2 * 0.4)), rel=1e-9)
    assert max(abs(p.real) for p in poles) < 1e-9
    run = s.simulate(60.0, initial={"theta'": 5.0, "q'": 1.0}, samples=601, rtol=1e-11)
    spin, i = run["theta'"], run["q'"]
    kept = (spin - 5.0) ** 2 + 0.2 * i**2 - 12.0 * np.log(i)
    assert np.ptp(kept) < 1e-6 * abs(kept).max()
    assert np.ptp(i) > 3


@pytest.mark.slow
def test_a_two_phase_induction_motor_has_the_torque_of_its_slip() -> None:
    """H. H. Woodson, J. R. Melcher, Electromechanical Dynamics I (1968), section 4.1.6: with the stator's currents
    I cos ωt and I sin ωt and the slip frequency σ = ω − Ω, T = M² I² σ R/(R² + σ² L²)."""
    s = lg.System("induction motor")
    qa, qb = charges(s, "q_a q_b")
    theta, _ = rotor(s, "0.0002 kg*m^2")
    M, L, R, I, w = s.parameters("M L R I w", M="50 mH", L="60 mH", R="2 ohm", I="5 A", w="300 rad/s")
    s.damper(s.parameter("b", "0.003 N*m*s"), deflection=theta)
    first, second = I * sin(w * s.t) / w, -I * cos(w * s.t) / w
    for q in (qa, qb):
        s.inductor(L, q)
        s.resistor(R, q)
    s.mutual_inductance(M * cos(theta), qa, first)
    s.mutual_inductance(M * sin(theta), qa, second)
    s.mutual_inductance(-M * sin(theta), qb, first)
    s.mutual_inductance(M * cos(theta), qb, second)
    run = s.simulate(4.0, samples=401)
    speed = run["theta'"][-1]
    slip = 300 - speed
    assert 0.05**2 * 25 * slip * 2 / (4 + slip**2 * 0.06**2) == pytest.approx(0.003 * speed, rel=1e-6)
    assert np.ptp(run["theta'"][-50:]) < 1e-6 * speed


@pytest.mark.slow
def test_a_plate_of_fixed_charge_is_pulled_alike_at_every_distance() -> None:
    """Woodson and Melcher, section 3.1: at a given charge f = −½ q² ∂(1/C)/∂x, with C = ε A/x it is −q²/(2 ε A)."""
    s = lg.System("isolated plates")
    x = s.coordinate("x", unit="m", positive=True)
    Q, A, eps = s.parameters("Q A epsilon", Q="2 nC", A="1 cm^2", epsilon="8.854 pF/m")
    s.particle(s.parameter("m", "1 g"), at=s.point("plate", (x, 0)))
    s.capacitor(eps * A / x, charge=Q)
    a = s.compile().forward([[1e-3], [3e-3]], [[0.0], [0.0]])
    np.testing.assert_allclose(a, -((2e-9) ** 2) / (2 * 8.854e-12 * 1e-4) / 1e-3, rtol=1e-12)
    assert all(check.holds for check in s.derive().verify())


@pytest.mark.slow
def test_a_solenoid_at_a_given_current_pulls_with_the_slope_of_its_inductance(tmp_path: pathlib.Path) -> None:
    """Woodson and Melcher, section 3.1: f = ½ i² ∂L/∂x at a given current; L = L₀/(1 + x/a)."""
    s = lg.System("solenoid")
    x = s.coordinate("x", unit="m")
    I, L0, a = s.parameters("I L0 a", I="3 A", L0="0.2 H", a="5 mm")
    s.particle(s.parameter("m", "0.1 kg"), at=s.point("plunger", (x, 0)))
    s.inductor(L0 / (1 + x / a), charge=I * s.t)
    found = s.compile().forward([0.002], [0.0])[0]
    assert found == pytest.approx(-0.5 * 9 * 0.2 / 0.005 / (1 + 0.4) ** 2 / 0.1, rel=1e-12)
    d = s.derive()
    assert all(check.holds for check in d.verify())
    assert all(check.holds for check in d.why.checks)
    s.save(tmp_path / "solenoid.toml")
    assert lg.load(tmp_path / "solenoid.toml").to_toml() == s.to_toml()
