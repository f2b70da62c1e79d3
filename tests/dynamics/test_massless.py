"""Rates without inertia that several rows hold, with coefficients that vanish somewhere, against fewer coordinates."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg

TIGHT: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-13}


def bead() -> lg.System:
    """A bead in polar coordinates on the circle (3 + 2 sin u, −2 cos u), whose parameter u moves nothing."""
    s = lg.System("bead")
    r, f, u = s.coordinates("r f u")
    m = s.parameters("m", m=1.5)
    s.particle(m, s.point("P", (r * sp.cos(f), r * sp.sin(f))))
    s.gravity(g=9.81)
    s.constraint(r * sp.cos(f) - 3 - 2 * sp.sin(u), name="across")
    s.constraint(r * sp.sin(f) + 2 * sp.cos(u), name="up")
    return s


def on_the_circle(u: float) -> dict[str, float]:
    x, y = 3 + 2 * np.sin(u), -2 * np.cos(u)
    return {"r": float(np.hypot(x, y)), "f": float(np.arctan2(y, x)), "u": u}


def test_a_bead_on_a_parametrized_wire_is_a_pendulum_and_its_multipliers_are_the_tension() -> None:
    """Also where either coefficient of u vanishes, at u = 0 and π/2: u″ = −(g/2) sin u, and λ = m ẍ, m (ÿ + g)."""
    s = bead()
    dyn = s.compile()
    for u, rate in ((0.0, 1.0), (0.7, -0.5), (np.pi / 2, 2.0), (2.5, 0.0)):
        q = [on_the_circle(u)[name] for name in "rfu"]
        x, y = 3 + 2 * np.sin(u), -2 * np.cos(u)
        dx, dy = 2 * np.cos(u) * rate, 2 * np.sin(u) * rate
        v = [(x * dx + y * dy) / q[0], (x * dy - y * dx) / q[0] ** 2, rate]
        bend = -9.81 / 2 * np.sin(u)
        assert dyn.forward(q, v)[2] == pytest.approx(bend, abs=1e-12)
        found = dyn.multipliers(q, v)
        ddx = 2 * np.cos(u) * bend - 2 * np.sin(u) * rate**2
        ddy = 2 * np.sin(u) * bend + 2 * np.cos(u) * rate**2
        assert [found["across"], found["up"]] == pytest.approx([1.5 * ddx, 1.5 * (ddy + 9.81)], abs=1e-12)
        assert dyn.margin(q) > 1e-3


@pytest.mark.slow
def test_its_runs_linearization_and_derivation_are_those_of_the_pendulum() -> None:
    s = bead()
    pendulum = lg.System("pendulum")
    u = pendulum.coordinates("u")
    m = pendulum.parameters("m", m=1.5)
    pendulum.particle(m, pendulum.point("P", (3 + 2 * sp.sin(u), -2 * sp.cos(u))))
    pendulum.gravity(g=9.81)
    run = s.simulate(3.0, initial=on_the_circle(2.0), **TIGHT)
    assert run["u"] == pytest.approx(pendulum.simulate(3.0, u=2.0, **TIGHT)["u"], abs=1e-9)
    assert run.drift and run.drift.position_after < 1e-12 and float(run.audit) < 1e-11
    poles = s.linearize(at=on_the_circle(0.0)).poles
    assert sorted(np.abs(poles)) == pytest.approx([np.sqrt(9.81 / 2)] * 2, abs=1e-9)
    assert all(check.holds for check in s.derive().verified)


@pytest.mark.slow
def test_three_rows_hold_the_parameter_of_a_helix_in_space() -> None:
    """A bead on (cos u, sin u, u/2) in spherical coordinates: u″ = −g h/(1 + h²) with h = 1/2."""
    s = lg.System("helix")
    r, f, e, u = s.coordinates("r f e u")
    s.particle(2, s.point("P", (r * sp.cos(e) * sp.cos(f), r * sp.cos(e) * sp.sin(f), r * sp.sin(e))))
    s.gravity(direction=(0, 0, -1), g=9.81)
    P = s.point("H", (sp.cos(u), sp.sin(u), u / 2))
    s.ball((s.model.points[0], P), name="bead")
    for at in (0.4, 1.3, 2.0):
        run = s.simulate(0.4, initial={"r": np.hypot(1, at / 2), "f": at, "e": np.arctan(at / 2), "u": at}, **TIGHT)
        assert run["u''"] == pytest.approx(-9.81 * 0.5 / 1.25, abs=1e-8)


def test_where_nothing_holds_it_the_coordinate_is_named() -> None:
    s = bead()
    P = s.model.points[0]
    w = s.coordinates("w")
    s.force((w.diff(), 0), at=P)
    with pytest.raises(lg.Error, match="coordinate 'w' moves no mass of its own") as caught:
        s.compile()
    assert caught.value.code == "E201"
