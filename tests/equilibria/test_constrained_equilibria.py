"""Equilibria of systems with constraints: closed forms of positions and multipliers."""

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from constrained_systems import G, cart_pole, disc, rod, sleigh, slider_crank
from lagrangian.errors import RunError


def test_a_rod_pendulum_hangs_and_stands() -> None:
    found = rod().equilibria()
    assert [(e["x"], e["y"]) for e in found] == [(0.0, pytest.approx(-1.5)), (0.0, pytest.approx(1.5))]
    assert [e.stability.verdict for e in found] == ["stable", "unstable"]
    assert [e.multipliers["rod"] for e in found] == pytest.approx([-2 * G, 2 * G])
    assert found.free == () and "λ of 'rod' = −19.62" in str(found)
    assert found.to_dict()["equilibria"][0]["multipliers"]["rod"] == pytest.approx(-2 * G)
    at = rod().linearize(found[0])
    assert np.abs(at.poles.imag - np.array([1, -1]) * np.sqrt(G / 1.5)).max() < 1e-9


@pytest.mark.slow
def test_a_slider_crank_balances_a_weight_against_a_force() -> None:
    """F dx/dφ + m g r cos φ = 0 with x = r cos φ ± √(l² − r² sin² φ)."""
    r, l, m, F = 0.05, 0.15, 2.0 + 1e-6, 60.0
    found = slider_crank().equilibria(inputs={"F": F})
    assert len(found) == 4 and found.sure
    for e in found:
        phi = e["phi"]
        root = np.sqrt(l**2 - (r * np.sin(phi)) ** 2) * (1 if e["x"] > r * np.cos(phi) else -1)
        assert e["x"] == pytest.approx(r * np.cos(phi) + root, abs=1e-12)
        slope = -r * np.sin(phi) - r**2 * np.sin(phi) * np.cos(phi) / root
        assert abs(F * slope + m * G * r * np.cos(phi)) < 1e-9
        assert e.multipliers["loop.x"] == pytest.approx(-F)
        assert e.multipliers["loop.y"] == pytest.approx(-F * np.tan(e["psi"]))  # the rod carries a force along itself


@pytest.mark.slow
def test_redundant_coordinates_have_the_same_equilibria() -> None:
    found, plain = cart_pole(redundant=True).equilibria(), cart_pole(redundant=False).equilibria()
    assert [e["theta"] for e in found] == pytest.approx([e["theta"] for e in plain], abs=1e-12)
    assert [e.stability.verdict for e in found] == [e.stability.verdict for e in plain]
    assert [dict(direction) for direction in found.free] == [{"x": 1.0, "X": pytest.approx(1.0)}]


@pytest.mark.slow
def test_rows_on_velocities_hold_forces_in_families() -> None:
    found = sleigh().equilibria()
    assert [e["theta"] for e in found] == pytest.approx([-np.pi / 2, np.pi / 2])
    assert [e.multipliers["edge"] for e in found] == pytest.approx([-3.0, 3.0])
    assert {name for direction in found.free for name in direction} == {"x", "y"}
    assert any("equilibria form families" in note for note in found.notes)
    rolling = disc()[0].equilibria()
    assert [e["theta"] for e in rolling] == pytest.approx([0.0, np.pi])
    assert {name for direction in rolling.free for name in direction} == {"x", "y", "psi", "phi"}


def test_nothing_rests_where_constraints_move() -> None:
    driven = rod()
    driven.constraint(driven.model.coordinates[0].symbol - sp.sin(sp.Symbol("t")), name="drive")
    with pytest.raises(RunError, match="nothing stays at rest") as error:
        driven.equilibria()
    assert error.value.code == "E521"
    pushed = rod()
    pushed.velocity_constraint(pushed.model.coordinates[0].rate - 2.0, name="belt")
    with pytest.raises(RunError, match="'belt' asks for motion"):
        pushed.equilibria()


def test_where_nothing_balances_it_is_said() -> None:
    s = lg.System("wedge")
    m = s.parameter("m", 1.0)
    x, y = s.coordinate("x"), s.coordinate("y")
    s.particle(m, at=s.origin + (x, y))
    s.gravity((0, -1))
    s.constraint(y - x / 2, name="slope")
    found = s.equilibria()
    assert not found and "no equilibrium in the box searched that satisfies the constraints" in found.notes[-1]
