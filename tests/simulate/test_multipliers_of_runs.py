"""The multipliers of constraints in runs, against closed forms."""

from __future__ import annotations

import matplotlib
import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from lagrangian.model import time

matplotlib.use("Agg")
MASS, LENGTH, GRAVITY, START = 2.0, 1.5, 9.81, 0.5


def pendulum() -> lg.System:
    """A point mass on a rod, in Cartesian coordinates."""
    s = lg.System("rod pendulum")
    x, y = s.coordinates("x y")
    P = s.point("P", (x, y))
    s.particle(s.parameter("m", f"{MASS} kg"), at=P)
    s.gravity((0, -1), s.parameter("g", f"{GRAVITY} m/s^2"))
    s.constraint(between=(P, s.origin), distance=s.parameter("l", f"{LENGTH} m"), name="rod")
    return s


def start() -> dict[str, float]:
    return {"x": LENGTH * np.sin(START), "y": -LENGTH * np.cos(START)}


@pytest.fixture(scope="module")
def run() -> lg.Trajectory:
    return pendulum().simulate(2.0, initial=start(), samples=201)


def tension(run: lg.Trajectory) -> np.ndarray:
    """m g cos θ + m l θ'², the balance of forces along the rod."""
    cosine = -run["y"] / LENGTH
    speed = np.hypot(run["x'"], run["y'"])
    return MASS * GRAVITY * cosine + MASS * speed**2 / LENGTH


@pytest.mark.slow
def test_an_event_named_like_a_row_is_where_its_force_vanishes() -> None:
    """Thrown up at v₀, the bob is free where v²/l = g sin of its height: v₀² − 2 g (y − y₀) = g y, for l as a rope."""
    speed = 7.0
    given = {**start(), "x'": speed * np.cos(START), "y'": speed * np.sin(START)}
    slack = lg.event("rod", direction=1, terminal=True, name="slack")
    up = pendulum().simulate(2.0, initial=given, events=slack, samples=5)
    height = (speed**2 + 2 * GRAVITY * start()["y"]) / (3 * GRAVITY)
    assert up.events["slack"].y[1] == pytest.approx([height], abs=1e-9)
    assert "event 'slack' ended the run" in up.message and abs(up["rod"][-1]) < 1e-9
    with pytest.raises(lg.ModelError, match="no quantity and no constraint row 'rodd'"):
        pendulum().simulate(1.0, initial=given, events=lg.event("rodd"))


def test_a_row_by_name_is_its_multiplier_and_the_tension_its_negative(run: lg.Trajectory) -> None:
    assert -run["rod"] == pytest.approx(tension(run), abs=1e-11)
    assert np.array_equal(run.multipliers["rod"], run["rod"])
    assert list(run.multipliers) == ["rod"]


def test_ensembles_reduce_and_sample_multipliers(run: lg.Trajectory) -> None:
    given = {name: [value] for name, value in start().items()}
    runs = pendulum().ensemble(initial=given, outputs=["min rod", "max rod"], times=run.t)
    assert runs["min rod"] == pytest.approx(-tension(run).max(), rel=1e-7)
    assert runs["max rod"] == pytest.approx(-tension(run).min(), rel=1e-7)
    sampled = pendulum().ensemble(initial=given, outputs=["rod"], reduce=None, times=run.t)
    assert sampled["rod"][0] == pytest.approx(-tension(run), rel=1e-7)


def test_tables_and_pictures_hold_them_with_units(run: lg.Trajectory) -> None:
    data = run.to_xarray()
    assert data["multiplier.rod"].attrs["units"] == "N"
    assert "pushes apart" in data["multiplier.rod"].attrs["long_name"]
    assert "multiplier.rod" in run.to_csv().splitlines()[0].split(",")
    axes = run.figure("rod").axes[0]
    assert "rod" in axes.get_ylabel() and "[N]" in axes.get_ylabel()
    assert axes.lines[0].get_ydata() == pytest.approx(run["rod"])


@pytest.mark.slow
def test_the_unit_of_an_expressions_multiplier_is_energy_or_power_per_unit_of_it() -> None:
    s = lg.System("disc")
    x, phi = s.coordinates("x phi")
    s.particle(s.parameter("m", "1 kg"), at=s.point("C", (x, 0)))
    s.potential(phi**2 * s.parameter("c", "2 N*m"))
    s.kinetic(s.parameter("J", "2 kg*m^2") * phi.diff(time) ** 2 / 2)
    s.constraint(x - s.parameter("r", "0.5 m") * phi, name="no slip")
    data = s.simulate(0.1, phi=0.1, x=0.05, samples=3).to_xarray()
    assert data["multiplier.no slip"].attrs["units"] == "N"


@pytest.mark.slow
def test_names_that_are_no_row_say_which_there_are(run: lg.Trajectory) -> None:
    s = lg.System("pinned twice")
    x, y = s.coordinates("x y")
    P = s.point("P", (x, y))
    s.particle(s.parameter("m", "1 kg"), at=P)
    s.constraint(between=(P, s.origin), name="loop")
    still = s.simulate(0.1, samples=3)
    with pytest.raises(lg.ModelError, match="has 2 multipliers") as trouble:
        still["loop"]
    assert "loop.x, loop.y" in trouble.value.fix
    with pytest.raises(lg.ModelError, match=r"no constraint row 'loop\.z'"):
        still["loop.z"]
    with pytest.raises(KeyError, match="no constraint row 'rope'"):
        run.multipliers["rope"]


@pytest.mark.slow
def test_a_driven_constraint_supplies_its_force_times_the_speed_that_it_prescribes() -> None:
    """x = A sin ω t: λ = (k − m ω²) x, and the drive's power is λ A ω cos ω t."""
    s = lg.System("driven mass")
    x = s.coordinates("x")
    m, k = s.parameter("m", "2 kg"), s.parameter("k", "50 N/m")
    P = s.point("P", (x, 0))
    s.particle(m, at=P)
    s.spring(k, deflection=x)
    A, w = s.parameter("A", "0.1 m"), s.parameter("w", "3 1/s")
    s.constraint(x - A * sp.sin(w * time), name="drive")
    run = s.simulate(2.0, initial={"x'": 0.3}, samples=101)
    force = (50 - 2 * 9) * 0.1 * np.sin(3 * run.t)
    assert run["drive"] == pytest.approx(force, abs=1e-10)
    assert run.powers["drive"] == pytest.approx(force * 0.3 * np.cos(3 * run.t), abs=1e-10)
    assert run.powers["drive"] == pytest.approx(run.power, abs=1e-12)
    assert float(run.audit) < 1e-8


def test_a_constraint_that_stands_still_supplies_no_power(run: lg.Trajectory) -> None:
    assert np.array_equal(run.powers["rod"], np.zeros(len(run.t)))


@pytest.mark.parametrize("asked", ["Rod", "ROD", "rodd"])
def test_a_row_that_is_spelled_wrong_is_suggested(asked):
    run = built_in.system("rod-pendulum").simulate(0.01)
    with pytest.raises(lg.ModelError) as caught:
        run[asked]
    assert "Did you mean 'rod'?" in str(caught.value)


@pytest.mark.slow
def test_a_symbol_that_is_spelled_wrong_is_not_taken_for_a_row():
    run = built_in.system("four-bar").simulate(0.01)
    name = run.states[0]
    with pytest.raises(lg.ModelError) as caught:
        run[name[:-1] + "_"]
    assert "constraint row" not in str(caught.value)
