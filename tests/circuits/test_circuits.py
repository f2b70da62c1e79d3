"""Circuits against the closed forms and the equations of textbooks.

Sources: S. H. Crandall et al., Dynamics of Mechanical and Electromechanical Systems, McGraw-Hill 1968 (chapter 6);
A. E. Fitzgerald, C. Kingsley, S. D. Umans, Electric Machinery, 6th ed., McGraw-Hill 2003 (chapter 3).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg


def series() -> tuple[lg.System, Any]:
    """A coil, a resistor, a capacitor and a source in one loop."""
    s = lg.System("series circuit")
    q = s.coordinate("q", "charge", unit="C")
    L, R, C = s.parameters("L R C", L="0.5 H", R="20 ohm", C="100 uF")
    u = s.input("u", "voltage", unit="V")
    s.inductor(L, q)
    s.resistor(R, q)
    s.capacitor(C, q)
    s.voltage_source(u, q)
    return s, q


def left(d: lg.Derivation) -> list[Any]:
    """The equations with everything on the left."""
    sides: list[Any] = [e.args for e in d.equations]
    return [sp.expand(a - b) for a, b in sides]


def test_a_series_circuit_has_kirchhoffs_equation() -> None:
    s, q = series()
    d = s.derive()
    L, R, C, u = (s[name] for name in ("L", "R", "C", "u"))
    assert sp.expand(left(d)[0] - (L * q.diff(s.t, 2) + R * q.diff() + q / C - u)) == 0
    assert [row.column for row in d.ledger] == ["T*", "Ξ", "V", "Ξ"]
    assert d.verified and all(check.holds for check in d.verified)


def test_its_step_response_is_the_damped_oscillation() -> None:
    """q(t) = C u (1 − e^(−at) (cos wt + a/w sin wt)) with a = R/2L, w² = 1/LC − a²."""
    s, _ = series()
    run = s.simulate(0.4, inputs={"u": 10}, samples=201, rtol=1e-10, atol=1e-14)
    a, w = 20 / (2 * 0.5), math.sqrt(1 / (0.5 * 100e-6) - (20 / (2 * 0.5)) ** 2)
    t = np.asarray(run.t)
    known = 100e-6 * 10 * (1 - np.exp(-a * t) * (np.cos(w * t) + a / w * np.sin(w * t)))
    assert np.abs(run["q"] - known).max() < 1e-11
    assert np.abs(run.imbalance).max() < 1e-9 * np.abs(run.energy).max()


def motor() -> lg.System:
    """An armature and a rotor: L di/dt + R i + k θ' = u, J θ'' + b θ' = k i."""
    s = lg.System("DC motor")
    q = s.coordinate("q", "charge", unit="C")
    theta = s.coordinate("theta", "angle of the rotor")
    L, R, k, J, b = s.parameters("L R k J b", L="2 mH", R="1 ohm", k="0.05 V*s", J="1e-4 kg*m^2", b="1e-5 N*m*s")
    u = s.input("u", "voltage", unit="V")
    rotor = s.frame(theta, name="rotor")
    s.rigid_body(0, J, s.origin, rotor, name="rotor")
    s.damper(b, deflection=theta)
    s.inductor(L, q)
    s.resistor(R, q)
    s.voltage_source(u, q)
    s.transducer(k, q, on=rotor)
    return s


def test_a_motor_runs_at_the_speed_of_the_textbook() -> None:
    """In the steady state ω = k u/(R b + k²), i = b ω/k."""
    s = motor()
    d = s.derive()
    q, theta = s["q"], s["theta"]
    L, R, k, J, b, u = (s[x] for x in ("L", "R", "k", "J", "b", "u"))
    circuit, rotor = left(d)
    assert sp.expand(circuit - (L * q.diff(s.t, 2) + R * q.diff() + k * theta.diff() - u)) == 0
    assert sp.expand(rotor - (J * theta.diff(s.t, 2) + b * theta.diff() - k * q.diff())) == 0
    run = s.simulate(2, inputs={"u": 12})
    speed = 0.05 * 12 / (1 * 1e-5 + 0.05**2)
    assert run["theta'"][-1] == pytest.approx(speed, rel=1e-6)
    assert run["q'"][-1] == pytest.approx(1e-5 * speed / 0.05, rel=1e-5)
    assert np.abs(run.imbalance).max() < 1e-8 * np.abs(run.energy).max()


def test_a_file_says_the_same() -> None:
    for s in (series()[0], motor()):
        text = s.to_toml()
        again = lg.loads(text)
        assert again.to_toml() == text
        assert [type(e) for e in again.elements] == [type(e) for e in s.elements]
        assert [str(e) for e in again.derive().equations] == [str(e) for e in s.derive().equations]


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"L": "0.5 ohm"}, "inductance L has the unit Ω, but H is needed"),
        ({"R": "20 V"}, "resistance R has the unit V, but Ω is needed"),
        ({"C": "100 C"}, "capacitance C has the unit C, but F is needed"),
    ],
)
def test_units_that_do_not_fit_are_refused(wrong: dict[str, str], message: str) -> None:
    text = series()[0].to_toml()
    for name, value in wrong.items():
        before = {"L": "0.5 H", "R": "20 ohm", "C": "100 uF"}[name]
        text = text.replace(f'{name} = "{before}"', f'{name} = "{value}"')
    with pytest.raises(lg.Error, match=message) as found:
        lg.loads(text).derive()
    assert found.value.code == "E408"


def ladder(*, own: bool) -> lg.System:
    """A low-pass filter of two meshes; ``own``: its capacitor has a charge of its own."""
    s = lg.System("filter")
    first, q2 = s.coordinate("qC" if own else "q1", unit="C"), s.coordinate("q2", unit="C")
    L, C, R = s.parameters("L C R", L="1 mH", C="100 nF", R="100 ohm")
    source, across = (first + q2, first) if own else (first, first - q2)
    s.voltage_source(s.input("u", unit="V"), source)
    s.inductor(L, source, name="near")
    s.capacitor(C, across)
    s.inductor(L, q2, name="far")
    s.resistor(R, q2)
    return s


@pytest.mark.parametrize("own", [True, pytest.param(False, marks=pytest.mark.slow)])
def test_the_operating_point_of_a_filter_is_found_by_ohms_law(own: bool) -> None:
    """I = u/R and q = C u, though a charge is a million times as small as a current. With mesh charges the current
    flows through both meshes at once."""
    (rest,) = ladder(own=own).equilibria(inputs={"u": 2.0})
    assert rest["q2'"] == pytest.approx(0.02)
    assert (rest["qC"] if own else -rest["q2"]) == pytest.approx(2e-7)
    assert own or rest["q1'"] == pytest.approx(0.02)
    assert rest.stability.verdict == "asymptotically stable"


@pytest.mark.slow
def test_a_bridge_rests_with_the_currents_of_kirchhoffs_laws() -> None:
    """Three meshes with a capacitor in a branch of its own: the currents solve R i = u, and no current flows through
    the capacitor."""
    s = lg.System("bridge")
    q1, q2, q3 = (s.coordinate(f"q{k}", unit="C") for k in (1, 2, 3))
    for k, (charge, R) in enumerate([(q1, 10.0), (q1 - q2, 20.0), (q2, 30.0), (q3, 40.0)]):
        s.inductor(1e-3, charge, name=f"coil {k}")
        s.resistor(R, charge, name=f"resistor {k}")
    s.capacitor(1e-6, q2 - q3, name="across")
    s.voltage_source(s.input("u", unit="V"), q1)
    (rest,) = s.equilibria(inputs={"u": 5.0})
    i1, i2 = np.linalg.solve([[30.0, -20.0], [-20.0, 20.0 + 30.0 + 40.0]], [5.0, 0.0])
    assert [rest["q1'"], rest["q2'"], rest["q3'"]] == pytest.approx([i1, i2, i2])
    assert rest["q2"] - rest["q3"] == pytest.approx(1e-6 * (20.0 * i1 - 50.0 * i2))
