"""A coil that saturates: T* is not T, M depends on the current, and the energy that is stored is T + V.

Source of the law: ψ = L₀ i₀ tanh(i/i₀)/(1 + x/a), a common model of a magnet over a gap x; its co-energy is
L₀ i₀² ln cosh(i/i₀)/(1 + x/a), as H. H. Woodson, J. R. Melcher, Electromechanical Dynamics, Wiley 1968, section 3.1,
integrates flux linkage over current with the positions held.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg


def magnet() -> lg.System:
    s = lg.System("magnet")
    q = s.coordinate("q", "charge through the coil", unit="C")
    x = s.coordinate("x", "gap", unit="m")
    L0, a, i0, R, m = s.parameters("L0 a i0 R m", L0="0.1 H", a="10 mm", i0="2 A", R="5 ohm", m="0.1 kg")
    u = s.input("u", "voltage", unit="V")
    s.particle(m, s.point("P", (0, -x)))
    s.gravity()
    s.inductor(law=lambda i: L0 * i0 * sp.tanh(i / i0) / (1 + x / a), charge=q, name="coil")
    s.resistor(R, q)
    s.voltage_source(u, q)
    return s


@pytest.fixture(scope="module")
def found() -> tuple[lg.System, lg.Derivation]:
    s = magnet()
    return s, s.derive()


@pytest.mark.slow
def test_the_equations_are_those_of_the_co_energy(found: tuple[lg.System, lg.Derivation]) -> None:
    s, d = found
    q, x, L0, a, i0, R, m, g, u = (s[n] for n in ("q", "x", "L0", "a", "i0", "R", "m", "g", "u"))
    i = q.diff()
    psi = L0 * i0 * sp.tanh(i / i0) / (1 + x / a)
    coenergy = L0 * i0**2 * sp.log(sp.cosh(i / i0)) / (1 + x / a)
    circuit, body = (e.args[0] - e.args[1] for e in d.equations)  # type: ignore[operator]
    assert sp.simplify(circuit - (psi.diff(s.t) + R * i - u)) == 0
    assert sp.simplify(body - (m * x.diff(s.t, 2) - m * g - coenergy.diff(x))) == 0
    assert "sinh" not in d.to_text()


@pytest.mark.slow
def test_the_page_shows_why_the_star_is_there(found: tuple[lg.System, lg.Derivation]) -> None:
    _, d = found
    text = " ".join(d.to_text().split())
    assert "ψ_coil = a i₀ L₀ tanh(q̇/i₀)/(a + x) (flux linkage)" in text
    assert "T*_coil = a i₀² L₀ ln(cosh(q̇/i₀))/(a + x)" in text
    assert "T_coil = ψ_coil I_coil − T*_coil" in text
    assert "∂T*_coil/∂I_coil = ψ_coil" in text and "This is what the star is for." in text
    assert "the velocities of all masses and the currents of all coils have rank 2" in text
    assert "a charge: its rate is a current" in text
    linear = " ".join(straight().derive().to_text().split())
    assert "what the star is for" not in linear and "ψ_L = L i_L = L q̇ (flux linkage)" in linear


def straight() -> lg.System:
    """A linear coil by itself on a capacitor."""
    s = lg.System("tank")
    q = s.coordinate("q", "charge", unit="C")
    s.inductor(s.parameter("L", "1 H"), q)
    s.capacitor(s.parameter("C", "1 F"), q)
    return s


def test_entries_of_m_that_depend_on_rates_have_no_part_in_c(found: tuple[lg.System, lg.Derivation]) -> None:
    _, d = found
    assert d.coriolis_matrix.is_zero_matrix
    assert "Entries of M that depend on rates have no part in C" in d.to_text()
    assert all(check.holds for check in d.verified), [c for c in d.verified if not c.holds]


@pytest.mark.slow
def test_the_energy_of_a_run_is_t_and_v_not_the_co_energy(found: tuple[lg.System, lg.Derivation]) -> None:
    s, _ = found
    run = s.simulate(0.03, initial={"x": 0.01}, inputs={"u": 15}, samples=61)
    scale = np.abs(run.energy).max()
    assert np.abs(run.imbalance).max() < 1e-8 * scale
    assert np.abs(run.energy - run.energy[0] - run.supplied).max() < 1e-8 * scale
    assert np.abs(run.kinetic + run.potential - run.energy).max() > 1e-2 * scale
    i0, L0, a = 2.0, 0.1, 0.01
    i, x = run["q'"], run["x"]
    stored = L0 / (1 + x / a) * (i0 * i * np.tanh(i / i0) - i0**2 * np.log(np.cosh(i / i0)))
    assert np.allclose(run[s.energy], stored + run["0.05*x'^2"] - 0.1 * 9.81 * x, rtol=1e-10, atol=1e-12)


@pytest.mark.slow
def test_laws_and_co_energies_say_the_same() -> None:
    """ψ by its law, by its co-energy and, where it is linear, by L; a law with a closed integral is integrated."""

    def derived(**coil: Any) -> Any:
        s = lg.System("coil")
        q = s.coordinate("q")
        a = s.parameter("a")
        given: dict[str, Any] = {
            key: value(a) if key == "L" else (lambda i, f=value: f(i, a)) for key, value in coil.items()
        }
        s.inductor(charge=q, **given)
        (e,) = s.derive().equations
        return e.args[0]

    bent = derived(law=lambda i, a: sp.atan(i / a))
    direct = derived(coenergy=lambda i, a: i * sp.atan(i / a) - a * sp.log(1 + i**2 / a**2) / 2)
    assert sp.simplify(bent - direct) == 0
    assert sp.simplify(derived(L=lambda a: a) - derived(law=lambda i, a: a * i)) == 0
    root = derived(law=lambda i, a: i / sp.sqrt(1 + i**2 / a**2))
    assert not root.has(sp.Piecewise)


def test_a_coil_has_its_co_energy_in_named_quantities_a_picture_and_an_exercise(
    found: tuple[lg.System, lg.Derivation],
) -> None:
    s, d = found
    named = s.derive(form="structured")
    assert named.form == "structured" and named.verified[0].holds
    assert sp.simplify(named.T.xreplace({x.symbol: x.expression for x in named.definitions}) - d.T) == 0
    assert "T*_coil: inductor 'coil' stores energy by the current of a charge" in " ".join(
        str(reason) for reason in named.steps[2].reasons
    )
    assert not s.look().missing
    assert "Charge q flows through inductor coil (which changes with x), resistor R and voltage source u" in (
        s.look().description
    )
    sheet = str(s.worksheet())
    assert "resistance of resistor R" in sheet and "flux linkage of every coil" in " ".join(sheet.split())
