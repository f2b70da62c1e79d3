"""Masses given for a run are checked as those of a file are; a run that misses its energy balance says so."""

from __future__ import annotations

import numpy as np
import pytest
from typer.testing import CliRunner

import lagrangian as lg
from lagrangian.cli.app import app
from lagrangian.errors import ModelError


def swinging() -> lg.System:
    """A mass m on a spring of 4 N/m."""
    s = lg.System("swinging")
    x = s.coordinate("x")
    s.particle(s.parameter("m", 1.0), at=s.origin + (x, 0), name="bob")
    s.spring(s.parameter("k", 4.0), deflection=x)
    return s


@pytest.mark.parametrize(("mass", "code"), [(-1.0, "E102"), (0.0, "E103")])
def test_a_mass_that_nothing_has_is_refused(mass: float, code: str) -> None:
    with pytest.raises(ModelError, match="bob") as trouble:
        swinging().simulate(1.0, params={"m": mass})
    assert trouble.value.code == code
    with pytest.raises(ModelError, match="bob"):
        swinging().ensemble(1.0, params={"m": mass}, initial={"x": [0.1, 0.2]})


def test_runs_of_a_sweep_with_such_a_mass_fail_and_are_counted() -> None:
    m = np.array([-1.0, 0.0, 1.0, 4.0])
    runs = swinging().sweep(1.0, {"m": m}, x=0.1)
    assert list(runs.status) == [-7, -7, 0, 0]
    assert runs.counts["a mass is not above 0, or a moment of inertia is below"] == 2
    np.testing.assert_allclose(runs["x"][2:], 0.1 * np.cos(np.sqrt(4.0 / m[2:])), rtol=1e-9)
    assert np.isnan(runs["x"][:2]).all()


def test_the_command_refuses_it_too() -> None:
    answer = CliRunner().invoke(app, ["simulate", "--example", "pendulum", "-d", "1", "--set", "m=-1"])
    assert isinstance(answer.exception, ModelError)
    assert answer.exception.code == "E102"


def test_a_missed_energy_balance_is_said() -> None:
    run = swinging().simulate(20.0, x=0.1, method="rk4", step=0.5, samples=21)
    error = abs(run.energy - run.energy[0]).max() / 0.02  # k x²/2 at the start
    assert error > 1e-3
    assert run.success
    for said in (run.message, repr(run), run.audit.missed):
        assert "energy balance missed by" in said
    assert "missed" not in swinging().simulate(20.0, x=0.1).message
