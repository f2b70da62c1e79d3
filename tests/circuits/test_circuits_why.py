"""The page that says why: Kirchhoff's law of every loop, and the forces of an energy balance, each checked exactly."""

from __future__ import annotations

import pytest
import sympy as sp

import built_in
import lagrangian as lg
from lagrangian.derive import why
from lagrangian.model import Resistor

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("name", built_in.CIRCUITS)
def test_every_check_of_the_page_holds(name: str) -> None:
    page = built_in.derivation(name).why
    assert len(page.checks) >= 3 and all(check.holds for check in page.checks)
    text = " ".join(str(page).split())
    assert "Kirchhoff's voltage law is the equation of q" in text
    assert page.to_html() and page.to_latex() and page.constraint_forces == {}


def test_the_page_of_a_magnet_has_its_voltage_and_its_pull() -> None:
    text = " ".join(str(built_in.derivation("magnetic-levitation").why).split())
    assert "v_u = −u" in text and "v_R = R q̇" in text
    assert "F_coil = ∂T*_coil/∂y = −a i₀² L₀ ln(cosh(q̇/i₀))/(a + y)²" in text
    assert "the equation of y is that of the bodies with this force" in text


def test_coils_that_are_driven_coupled_bent_and_tied_are_balanced() -> None:
    """L(t), a prescribed current, a law of a resistor, M(x), and a constraint between two charges."""
    s = lg.System("everything")
    q1, q2, x = s.coordinates("q1 q2 x")
    s.particle(1, s.point("P", (x, 0)))
    s.inductor(2 + sp.cos(s.t), q1, name="driven")
    s.inductor(3, q2 - s.t, name="shifted")
    s.mutual_inductance(sp.sin(x) / 2, q1, q2)
    s.resistor(charge=q1, law=lambda i: i**3, name="bent")
    s.capacitor(1 + x**2, q1 - q2, name="plates")
    s.transducer(x, q2, on=x, name="winding")
    page = s.derive().why
    assert len(page.checks) == 7 and all(check.holds for check in page.checks), page.checks
    tied = lg.System("tied")
    a, b = tied.coordinates("a b")
    tied.inductor(1, a)
    tied.inductor(2, b)
    tied.constraint(a - 2 * b, name="gear")
    gear = tied.derive().why
    assert all(check.holds for check in gear.checks) and "λ" in str(gear)


def test_a_wrong_voltage_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """The check compares two routes: with another voltage of the resistor it fails."""
    d = built_in.derivation("loudspeaker")
    voltage = Resistor.voltage
    monkeypatch.setattr(Resistor, "voltage", lambda self, model: 2 * voltage(self, model))
    checks = {str(check.what): check.holds for check in why(d).checks}
    assert checks["Kirchhoff's voltage law is the equation of q"] is False
