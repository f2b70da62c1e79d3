"""The built-in machines with circuits against what textbooks say of them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg

pytestmark = pytest.mark.slow


def test_a_capacitive_actuator_snaps_at_a_third_of_its_gap() -> None:
    """Senturia, Microsystem Design (2001), section 6.4: V² = 8 k d³/(27 ε A), x = d/3."""
    s = built_in.system("capacitive-actuator")
    k, d, epsilon, A = 1.0, 2e-6, 8.854e-12, 1e-8
    limit = math.sqrt(8 * k * d**3 / (27 * epsilon * A))
    box = {"x": (0, 0.95 * d)}
    below = s.equilibria(inputs={"u": 0.999 * limit}, box=box)
    assert [e.stability.verdict for e in below] == ["asymptotically stable", "unstable"]
    assert below[0]["x"] < d / 3 < below[1]["x"] and below[1]["x"] - below[0]["x"] < 0.04 * d
    assert len(s.equilibria(inputs={"u": 1.001 * limit}, box=box)) == 0
    for e in below:  # a force ε A u²/(2 (d − x)²) against the spring
        assert epsilon * A * (0.999 * limit) ** 2 / (2 * (d - e["x"]) ** 2) == pytest.approx(k * e["x"], rel=1e-9)


def test_its_plate_snaps_in_a_run_above_that_voltage_and_settles_below() -> None:
    s = built_in.system("capacitive-actuator")
    rests = s.equilibria(inputs={"u": 4}, box={"x": (0, "1.9 um")})
    run = s.simulate("0.6 ms", inputs={"u": 4}, samples=61)
    assert run["x"][-1] == pytest.approx(rests[0]["x"], rel=1e-2)
    assert np.abs(run.imbalance).max() < 1e-8 * np.abs(run.supplied).max()
    snapped = s.simulate("0.2 ms", inputs={"u": 7}, events=[lg.event(s["x"] - 1.5e-6, terminal=True, name="closed")])
    assert len(snapped.events["closed"]) == 1


def test_a_magnet_holds_a_ball_where_its_force_is_the_weight() -> None:
    """Khalil, Nonlinear Systems, exercise 1.18: L₀ i²/(2 a (1 + y/a)²) = m g with i = u/R, and it is unstable.

    With a large i₀ the coil does not saturate.
    """
    s = built_in.system("magnetic-levitation")
    for i0, far in (("8 A", False), ("800 A", True)):
        (rest,) = s.equilibria(inputs={"u": 6.5}, params={"i_0": i0})
        i, y = rest["q'"], rest["y"]
        assert i == pytest.approx(6.5) and rest.stability.verdict == "unstable"
        limit = 800.0 if far else 8.0
        bent = limit**2 * math.log(math.cosh(i / limit))
        assert 0.01 * bent / (0.05 * (1 + y / 0.05) ** 2) == pytest.approx(0.981, rel=1e-7)
        if far:
            assert y == pytest.approx(0.05 * (6.5 * math.sqrt(0.01 / (2 * 0.05 * 0.981)) - 1), rel=1e-4)
    linear = s.linearize(at=s.equilibria(inputs={"u": 6.5})[0])
    assert linear.kind == "steady motion" and sum(p.real > 1e-6 for p in linear.poles) == 1


def test_a_loudspeaker_has_the_impedance_of_the_textbook() -> None:
    """Beranek, Acoustics (1954), section 7.3: Z = R + jωL + (Bl)²/(b + jωm + k/jω); i = u/Z."""
    s = built_in.system("loudspeaker")
    linear = s.linearize(outputs=["q'"])
    m, k, b, Bl, R, L = 0.012, 1200.0, 1.1, 6.5, 6.0, 0.6e-3
    n = len(linear.A)
    for w in (50.0, math.sqrt(k / m), 2000.0):
        G = (linear.C @ np.linalg.solve(1j * w * np.eye(n) - linear.A, linear.B) + linear.D)[0, 0]
        Z = R + 1j * w * L + Bl**2 / (b + 1j * w * m + k / (1j * w))
        assert abs(Z * G - 1) < 1e-9


def test_a_motor_holds_its_arm_at_the_angle_at_which_its_torque_is_the_weights() -> None:
    s = built_in.system("dc-motor")
    hanging, _ = s.equilibria(inputs={"u": 1})
    assert hanging["q'"] == pytest.approx(1 / 1.2)
    assert math.sin(hanging["theta"]) == pytest.approx(0.06 / 1.2 / (0.1 * 9.81 * 0.08), rel=1e-9)
    assert hanging.stability.verdict == "asymptotically stable"
    assert "the charge q does not count" in hanging.stability.reason
    run = s.simulate(8, inputs={"u": 1}, samples=81)
    assert run["theta"][-1] == pytest.approx(hanging["theta"], rel=1e-4)
    assert np.abs(run.imbalance).max() < 1e-9 * run.supplied.max()


@pytest.mark.thinned(2)
@pytest.mark.parametrize("name", built_in.CIRCUITS)
def test_machines_are_verified_compiled_saved_and_read_again(name: str, tmp_path: Any) -> None:
    s = built_in.system(name)
    checks = built_in.derivation(name).verify()
    assert checks and all(check.holds for check in checks), [c for c in checks if not c.holds]
    compiled = s.compile()
    n = len(s.model.coordinates)
    q, v, u = np.full(n, 1e-7), np.full(n, 0.1), np.ones(1)
    assert np.allclose(compiled.inverse(q, v, compiled.forward(q, v, u), u), 0, atol=1e-8)
    run = s.simulate(samples=51)
    assert run.success and np.abs(run.imbalance).max() < 1e-7 * np.abs(run.energy).max()
    s.save(tmp_path / "again.toml")
    assert lg.load(tmp_path / "again.toml").to_toml() == s.to_toml()


def transformer(k: float) -> lg.System:
    """Two loops with a coil and a capacitor each, coupled by M = k √(L₁ L₂)."""
    s = lg.System("transformer")
    q1, q2 = s.coordinate("q1", unit="C"), s.coordinate("q2", unit="C")
    L, C, M = s.parameters("L C M", L="2 mH", C="5 uF", M=f"{k * 2} mH")
    for q in (q1, q2):
        s.inductor(L, q, name=f"coil {q.func}")
        s.capacitor(C, q, name=f"capacitor {q.func}")
    s.mutual_inductance(M, q1, q2)
    return s


def test_two_coupled_circuits_have_two_frequencies() -> None:
    """ω² = 1/((L ± M) C): equal loops swing together, or against each other."""
    s = transformer(0.25)
    found = sorted({round(abs(p.imag), 3) for p in s.linearize(at={}).poles})
    known = sorted(1 / math.sqrt(2e-3 * (1 + sign * 0.25) * 5e-6) for sign in (1, -1))
    assert found == pytest.approx(known, rel=1e-6)
    d = s.derive()
    q1, q2, L, C, M = (s[x] for x in ("q1", "q2", "L", "C", "M"))
    (first, _) = (e.args[0] - e.args[1] for e in d.equations)  # type: ignore[operator]
    assert sp.expand(first - (L * q1.diff(s.t, 2) + M * q2.diff(s.t, 2) + q1 / C)) == 0
    assert all(check.holds for check in d.verified)
    run = s.simulate("20 ms", initial={"q1": "1 uC"}, samples=101)
    assert np.abs(run.energy / run.energy[0] - 1).max() < 1e-8


def test_coils_that_share_more_flux_than_they_have_are_told() -> None:
    with pytest.raises(lg.Error, match=r"mutual inductance is 0\.003 H, but no coil sends more flux") as found:
        transformer(1.5).simulate(1)
    assert found.value.code == "E203"
    free = lg.System("no values")
    q1, q2 = free.coordinates("q1 q2")
    L, M = free.parameters("L M")
    free.inductor(L, q1, name="one")
    free.inductor(L, q2, name="two")
    free.mutual_inductance(M, q1, q2)
    with pytest.raises(lg.Error, match="mass matrix is not positive definite"):
        free.linearize(params={"L": 1, "M": 2})


@pytest.mark.thinned(2)
@pytest.mark.parametrize("name", built_in.CIRCUITS)
def test_exercises_about_machines_have_variants(name: str) -> None:
    for seed in range(3):
        sheet = built_in.system(name).worksheet(seed=seed)
        assert "flux linkage of every coil" in " ".join(str(sheet).split())


def test_a_branch_that_two_loops_share_carries_the_difference_of_their_charges() -> None:
    """A bridge of two meshes: Kirchhoff's laws by hand; the power balance of a run with a law v = c i³."""
    s = lg.System("two meshes")
    q1, q2 = s.coordinate("q1", unit="C"), s.coordinate("q2", unit="C")
    L, R, C, c = s.parameters("L R C c", L="1 mH", R="3 ohm", C="10 uF", c="2 V/A^3")
    u = s.input("u", unit="V")
    s.inductor(L, q1, name="first")
    s.inductor(L, q2, name="second")
    s.resistor(R, q1 - q2)
    s.capacitor(C, q2)
    s.resistor(law=lambda i: c * i**3, charge=q2, name="varistor")
    s.voltage_source(u, q1)
    first, second = (e.args[0] - e.args[1] for e in s.derive().equations)  # type: ignore[operator]
    i1, i2 = q1.diff(), q2.diff()
    assert sp.expand(first - (L * i1.diff(s.t) + R * (i1 - i2) - u)) == 0
    assert sp.expand(second - (L * i2.diff(s.t) - R * (i1 - i2) + q2 / C + c * i2**3)) == 0
    run = s.simulate("3 ms", inputs={"u": 10}, samples=61)
    assert np.abs(run.imbalance).max() < 1e-9 * np.abs(run.supplied).max()


def test_a_capacitor_by_its_law_is_one_by_its_energy() -> None:
    def force(**how: Any) -> Any:
        s = lg.System("capacitor")
        q = s.coordinate("q")
        C, a = s.parameters("C a")
        s.inductor(1, q)
        given: dict[str, Any] = {key: (lambda x, f=f: f(x, C, a)) for key, f in how.items()}
        s.capacitor(charge=q, **given)
        (e,) = s.derive().equations
        return sp.expand(e.args[0])

    by_law = force(law=lambda x, C, a: x / C + a * x**3)
    assert sp.expand(by_law - force(energy=lambda x, C, a: x**2 / (2 * C) + a * x**4 / 4)) == 0
