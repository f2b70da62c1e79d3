"""Systems in which it is known whether friction slips or sticks, and reactions from regime to regime."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.advice import Advice, Verb

G = 9.81


def pendulum(limit: float = 0.5) -> lg.System:
    """A point mass of 1 kg at 1 m with dry friction in its pivot."""
    s = lg.System("pendulum")
    theta = s.coordinates("theta")
    frame = s.frame(theta, name="rod")
    torque = s.parameters("c", c=limit)
    s.particle(1, frame.point(0, -1, name="bob"))
    s.gravity(g=G)
    s.friction(limit=torque, deflection=theta, name="pivot")
    return s


def bead() -> lg.System:
    """A bead on a rough rod, in x and y."""
    s = lg.System("bead")
    x, y = s.coordinates("x y")
    a, k = s.parameters("alpha mu", alpha=0.6, mu=0.3)
    s.particle(2, s.point("P", (x, y)))
    s.gravity(g=G)
    s.constraint(x * sp.sin(a) - y * sp.cos(a), name="rod")
    s.friction(k, pressed_by="rod", deflection=x * sp.cos(a) + y * sp.sin(a), name="rough")
    return s


@pytest.mark.slow
def test_while_it_slips_all_functions_are_smooth_and_verified(tmp_path: Path) -> None:
    slips = bead().regime(rough=-1, rod=-1)
    found = slips.compile()
    down = G * (np.sin(0.6) - 0.3 * np.cos(0.6)) * np.array([np.cos(0.6), np.sin(0.6)])
    assert found.forward(np.zeros(2), np.array([-1.0, -np.tan(0.6)])) == pytest.approx(-down, abs=1e-13)
    assert all(check.holds for check in slips.verify(states=3))
    again = lg.loads(slips.to_toml())
    assert again.derive().equations == slips.derive().equations
    assert [p.name for p in slips.export(tmp_path / "bead.c")] == ["bead.c", "bead.h"]


def test_while_it_sticks_it_is_a_constraint() -> None:
    held = pendulum().regime(pivot=0)
    found = held.compile()
    q, v = np.array([0.04]), np.zeros(1)
    assert found.forward(q, v) == pytest.approx(0.0, abs=1e-15)
    assert found.multipliers(q, v)["pivot"] == pytest.approx(G * np.sin(0.04), abs=1e-14)
    assert bead().regime(rough=0).compile().forward(np.zeros(2), np.zeros(2)) == pytest.approx(0.0, abs=1e-15)


def test_equilibria_of_the_slip_are_the_ends_of_the_region_where_it_sticks() -> None:
    for sense in (1, -1):
        found = [e.at["theta"] for e in pendulum().regime(pivot=sense).equilibria()]
        least = -sense * np.arcsin(0.5 / G)
        assert min(found, key=abs) == pytest.approx(least, abs=1e-12)


def test_modes_that_make_no_sense_are_refused() -> None:
    for wrong, code in (({"pivot": 2}, "E406"), ({"pivto": 1}, "E402"), ({"pivot": True}, "E406")):
        with pytest.raises(lg.Error) as caught:
            pendulum().regime(wrong)
        assert caught.value.code == code
    with pytest.raises(lg.Error, match="sign of its multiplier decides"):
        bead().regime(rough=1)
    with pytest.raises(lg.Error, match=r"E311.*\n.*regime\(\{'pivot': 1\}\)"):
        pendulum().compile()


def test_readers_of_a_file_are_told_what_to_write_there() -> None:
    in_file = lg.loads(pendulum().to_toml())
    with pytest.raises(lg.Error, match=r"E311.*(?s:.*)Fix: .*sense = 1 in \[\[friction\]\] while it slips") as caught:
        in_file.compile()
    assert caught.value.place is not None and "side" not in str(caught.value)
    fix = caught.value.fix
    assert isinstance(fix, Advice) and {x.name for x in fix.pieces if isinstance(x, Verb)} == {"simulate", "sweep"}
    with pytest.raises(lg.Error, match=r"E311(?s:.*)side = 1 or -1"):
        lg.loads(bead().to_toml()).compile()


@pytest.mark.slow
def test_reactions_are_those_of_the_regime_at_each_time() -> None:
    """m a = R + m g with the accelerations of the run, while it swings and after it sticks."""
    run = pendulum(2.0).simulate(4.0, theta=1.0, rtol=1e-10, atol=1e-11)
    assert {-1, 0, 1} == set(run.modes["pivot"].tolist())
    theta, rate, change = run["theta"], run["theta'"], run["theta''"]
    along = np.array([np.cos(theta), np.sin(theta)]), np.array([-np.sin(theta), np.cos(theta)])
    needed = (change * along[0] + rate**2 * along[1]).T + [0.0, G]
    pin = run.reaction("origin")
    assert pin.force == pytest.approx(needed, abs=1e-9)
    assert pin.torque == pytest.approx(0.0, abs=1e-9)  # the friction is an element of its own


@pytest.mark.slow
def test_friction_between_two_points_acts_at_the_points() -> None:
    """A brake between the bob and a fixed point A: what is missing in m a = R + m g + B acts along the brake."""
    s = lg.System("braked")
    theta = s.coordinates("theta")
    frame = s.frame(theta, name="rod")
    bob, A = frame.point(0, -1, name="bob"), s.point("A", (1.5, 0.5))
    s.particle(1, bob)
    s.gravity(g=G)
    s.friction(limit=4, between=(A, bob), name="brake")
    run = s.simulate(4.0, theta=1.0, rtol=1e-10, atol=1e-11)
    modes = run.modes["brake"]
    assert set(modes.tolist()) == {-1, 0, 1}
    q, rate, change = run["theta"], run["theta'"], run["theta''"]
    a = (change * np.array([np.cos(q), np.sin(q)]) + rate**2 * np.array([-np.sin(q), np.cos(q)])).T
    brake = a + [0.0, G] - run.reaction("origin").force
    e = run.points["bob"] - [1.5, 0.5]
    e /= np.linalg.norm(e, axis=1)[:, None]
    force: Any = np.einsum("ij,ij->i", brake, e)
    assert brake - force[:, None] * e == pytest.approx(0.0, abs=1e-9)
    assert force[modes != 0] == pytest.approx(-4 * modes[modes != 0], abs=1e-9)
    assert np.abs(force[modes == 0]).max() <= 4 + 1e-9
