"""Options of runs: one definition, checked once, in one wording for one run and for many."""

from __future__ import annotations

import dataclasses
import inspect
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from lagrangian.integrate.status import RunStatus
from lagrangian.simulate.per_run import Recording

OF_ONE, OF_MANY = {"samples", "timeout"}, {"samples", "timeout", "times", "max_events"}


def defaults(*kinds: type) -> dict[str, Any]:
    return {f.name: f.default for kind in kinds for f in dataclasses.fields(kind)}


def taken(verb: Any) -> dict[str, Any]:
    return {name: p.default for name, p in inspect.signature(verb).parameters.items()}


@pytest.mark.parametrize("verb", [lg.System.ensemble, lg.System.sweep])
def test_many_runs_take_the_settings_with_their_defaults(verb: Any) -> None:
    listed, known = taken(verb), defaults(lg.RunSettings, Recording, lg.Execution)
    assert not (set(known) - OF_ONE) - set(listed)
    assert {name: listed[name] for name in known if name not in OF_MANY} == {
        name: known[name] for name in known if name not in OF_MANY
    }


@pytest.mark.parametrize(
    ("method", "shares"),
    [
        (None, (1e-3, 1e-3)),
        ("dop853", (1e-3, 1e-3)),
        ("RK45", (1e-3, 1e-3)),
        ("BDF", (1e-2, 1e-2)),
        ("LSODA", (1e-2, 1e-2)),
        ("Radau", (1.0, 1.0)),
    ],
)
def test_default_tolerances_are_those_of_a_run_and_given_ones_are_passed_on(
    method: str | None, shares: tuple[float, float]
) -> None:
    """A step may reach only a share of a run's tolerances; those given to SciPy's methods are of a step."""
    assert lg.RunSettings(method=method).of_a_step() == pytest.approx((1e-9 * shares[0], 1e-12 * shares[1]))
    given = lg.RunSettings(method=method, rtol=1e-6, atol=1e-7).of_a_step()
    assert given == pytest.approx((1e-9, 1e-10) if method in (None, "dop853") else (1e-6, 1e-7))
    assert lg.RunSettings(method=method).over_run == (method in ("BDF", "LSODA"))
    assert not lg.RunSettings(method=method, rtol=1e-6).over_run


def test_one_run_takes_the_settings_with_their_defaults() -> None:
    listed = taken(lg.System.simulate)
    assert {name: listed[name] for name in defaults(lg.RunSettings)} == defaults(lg.RunSettings)


WRONG: list[dict[str, Any]] = [
    {"method": "rk5"},
    {"method": "rk4"},
    {"step": 0.1},
    {"method": "rk4", "step": -0.1},
    {"rtol": 0.0},
    {"atol": "small"},
    {"max_step": "3 kg"},
    {"max_step": 0.0},
    {"max_steps": 0},
    {"max_events": True},
    {"start": "1 m"},
    {"events": ["bounce"]},
    {"times": [0.0, 2.0, 1.0]},
    {"times": [[0.0, 1.0]]},
    {"times": [0.0, math.nan]},
    {"duration": -1.0},
    {"duration": (0.0, 1.0)},
    {"duration": 1.0, "rotl": 1e-6},
    {"duration": 1.0, "times": [0.0, 1.0]},
    {"duration": 1.0, "k1": 1.0},
    {"duration": 1.0, "m": 1.0},
]


@pytest.mark.parametrize("options", WRONG, ids=str)
def test_one_run_and_many_say_the_same(options: dict[str, Any]) -> None:
    system = built_in.system("cart-pole")
    if not {"duration", "times"} & set(options):
        options = {"duration": 1.0, **options}
    said = []
    for call in (
        lambda: system.simulate(theta=0.1, **options),
        lambda: system.ensemble(theta=[0.1, 0.2], **options),
        lambda: system.sweep(grid=["theta=0.1:0.2:2"], **options),
    ):
        with pytest.raises(lg.Error) as caught:
            call()
        said.append(str(caught.value))
    assert len(set(said)) == 1, said


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"memory": 0}, "memory must be a whole number, at least 1"),
        ({"threads": 1.5}, "threads must be a whole number, at least 1"),
        ({"progress": "bar"}, "progress must be a function"),
        ({"resume": True}, "apply only to a store"),
        ({"store": 3}, "a store must be text or a Path"),
        ({"store": "runs.nc"}, "must end in .zarr"),
    ],
)
def test_the_way_runs_are_done_is_checked(options: dict[str, Any], words: str) -> None:
    with pytest.raises(lg.RunError, match=words):
        lg.Execution(**options)
    with pytest.raises(lg.RunError, match=words):
        built_in.system("cart-pole").ensemble(1.0, theta=[0.1, 0.2], **options)


def test_settings_are_values_that_stay() -> None:
    settings = lg.RunSettings(times=["0 s", "10 ms"], max_step="2 ms", start="0 s")
    assert (settings.times, settings.max_step, settings.start) == ((0.0, 0.01), 0.002, 0.0)
    assert settings == lg.RunSettings(times=(0.0, 0.01), max_step=0.002)
    with pytest.raises(dataclasses.FrozenInstanceError):
        settings.rtol = 1.0  # type: ignore[misc]


@pytest.mark.parametrize(
    ("call", "fix"),
    [
        (lambda s: s.ensemble(1.0, theta=[0.1], treads=2), "Did you mean 'threads'?"),
        (lambda s: s.ensemble(1.0, theta=[0.1], timeout=2), "max_steps=100000 bounds each run"),
        (lambda s: s.sweep(1.0, ["theta=1:2:3"], samples=2), "draws=1000 that of the draws"),
        (lambda s: s.simulate(1.0, sample=2), "Did you mean 'samples'?"),
        (lambda s: s.simulate(1.0, M=2), "params={'M': …}"),
    ],
)
def test_an_option_that_is_not_there_is_answered(call: Any, fix: str) -> None:
    with pytest.raises(lg.RunError, match="there is no option or state") as caught:
        call(built_in.system("cart-pole"))
    assert fix in str(caught.value)


def test_a_settings_object_is_the_options_of_one_run() -> None:
    system, options = built_in.system("pendulum"), {"duration": "2 s", "rtol": 1e-6, "samples": 11, "method": "tsit5"}
    run = system.simulate(settings=lg.RunSettings(**options), theta=0.5)
    assert run.t.tolist() == pytest.approx([0.2 * i for i in range(11)])
    assert (run.method, run.settings["rtol"]) == ("tsit5", 1e-6)
    assert run.y.tobytes() == system.simulate(theta=0.5, **options).y.tobytes()


def test_settings_and_execution_are_the_options_of_many_runs(tmp_path: Path) -> None:
    system, done = built_in.system("pendulum"), []
    settings = lg.RunSettings(duration=1.0, method="rk4", step=0.01, samples=5)
    execution = lg.Execution(store=tmp_path / "runs.zarr", progress=lambda now, _: done.append(now))
    for runs in (
        system.ensemble(theta=[0.1, 0.2], reduce=None, settings=settings, execution=execution),
        system.sweep(grid=["theta=0.1:0.2:2"], reduce=None, settings=settings),
    ):
        assert runs["theta"].shape == (2, 5)
        alone = [system.simulate(theta=theta, settings=settings)["theta"] for theta in (0.1, 0.2)]
        assert runs["theta"] == pytest.approx(np.array(alone), abs=1e-12)
    assert done[-1] == 2
    assert (tmp_path / "runs.zarr").is_dir()


def test_settings_are_taken_as_they_are_by_many_runs() -> None:
    ball = lg.System("ball")
    ball.particle(1, ball.origin + (0, ball.coordinate("y")))
    turning = lg.event(sp.sin(50 * ball.t), name="turning")
    counts = {}
    for limit in (10, 100):
        settings = lg.RunSettings(duration=1.0, max_events=limit, events=turning)
        counts[limit] = ball.ensemble(y=[0.0], settings=settings)["status"].tolist()
    assert counts == {10: [RunStatus.CROWDED], 100: [RunStatus.REACHED]}  # sin 50t has 15 zeros in (0, 1)


@pytest.mark.parametrize(
    ("call", "words", "code"),
    [
        (
            lambda s, given: s.simulate(1.0, settings=given),
            "'duration' is given twice: as an argument, and in s",
            "E404",
        ),
        (lambda s, given: s.simulate(rtol=1e-9, settings=given), "'rtol' is given twice", "E404"),
        (lambda s, given: s.ensemble(times=1001, theta=[0.1], settings=given), "'times' is given twice", "E404"),
        (lambda s, given: s.sweep(1.0, ["theta=1:2:3"], settings=given), "'duration' is given twice", "E404"),
        (
            lambda s, given: s.sweep(1.0, ["theta=1:2:3"], execution=lg.Execution(), threads=1),
            "'threads' is given twice: as an argument, and in execution",
            "E404",
        ),
        (lambda s, given: s.simulate(settings={"rtol": 1.0}), r"settings must be a RunSettings \(got dict\)", "E501"),
        (lambda s, given: s.ensemble(theta=[0.1], execution=given), "execution must be an Execution", "E501"),
        (
            lambda s, given: s.ensemble(theta=[0.1], settings=dataclasses.replace(given, timeout=3)),
            "a timeout applies only to a single run",
            "E501",
        ),
    ],
)
def test_an_option_is_given_once(call: Any, words: str, code: str) -> None:
    with pytest.raises(lg.RunError, match=words) as caught:
        call(built_in.system("pendulum"), lg.RunSettings(duration=1.0))
    assert caught.value.code == code
