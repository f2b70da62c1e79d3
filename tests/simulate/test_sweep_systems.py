"""Ensembles and sweeps of described systems, against closed forms and against single runs."""

import csv

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import built_in
import lagrangian as lg
from lagrangian.integrate import Solver
from lagrangian.simulate.inputs import driving
from lagrangian.simulate.per_run import Recording, study_of
from lagrangian.simulate.settings import RunSettings
from size import sized


@pytest.fixture(scope="module")
def oscillator() -> lg.System:
    """m ẍ = −k x + F; x(0) = 0.5 unless varied."""
    system = lg.System("oscillator")
    x = system.coordinate("x", unit="m")
    m, k = system.parameters("m k", m="1 kg", k="4 N/m")
    F = system.input("F", unit="N")
    cart = system.point("A", (x, 0))
    system.particle(m, at=cart)
    system.spring(k, deflection=x)
    system.force(F, deflection=x)
    return system


FINE = {"method": "rk4", "step": 0.005}


def test_an_ensemble_of_arrays_against_the_closed_form(oscillator: lg.System) -> None:
    a, m = np.linspace(0.1, 1, 7), np.array([[1.0], [2.0], [4.0]])
    times = np.linspace(0, 3, 31)
    runs = oscillator.ensemble(
        initial={"x": a},
        params={"m": m},
        times=times,
        reduce=None,
        outputs={"x": "x", "E": "m*x'^2/2 + k*x^2/2"},
        **FINE,
    )
    assert runs.dims == ("run_0", "run_1")
    w = np.sqrt(4 / m)[..., None]
    np.testing.assert_allclose(runs["x"], a[None, :, None] * np.cos(w * times), atol=1e-8)
    np.testing.assert_allclose(runs["E"], np.broadcast_to(2 * a[None, :, None] ** 2, (3, 7, 31)), rtol=1e-7)
    assert runs.times.tolist() == times.tolist()
    assert runs.success
    assert runs.counts == {"the end was reached": 21}


def test_inputs_vary_too_and_expressions_are_fed_back(oscillator: lg.System) -> None:
    forces = np.array([0.0, 1.0, 2.0])
    runs = oscillator.ensemble(2.0, inputs={"F": forces}, outputs="x", **FINE)
    np.testing.assert_allclose(runs["x"], forces / 4 * (1 - np.cos(4.0)), atol=1e-8)
    x = oscillator["x"]
    damped = oscillator.ensemble(2.0, x=[0.5, 1.0], inputs={"F": -2 * x.diff()}, outputs=["x", "F"], **FINE)
    w = np.sqrt(3.0)
    decay = np.exp(-2.0) * (np.cos(w * 2) + np.sin(w * 2) / w)
    np.testing.assert_allclose(damped["final x"], np.array([0.5, 1.0]) * decay, atol=1e-8)
    rate = np.exp(-2.0) * (-(w + 1 / w) * np.sin(w * 2))
    np.testing.assert_allclose(damped["final F"], -2 * np.array([0.5, 1.0]) * rate, atol=1e-7)


def test_a_table_drives_every_run(oscillator: lg.System) -> None:
    runs = oscillator.ensemble(
        2.0, params={"k": [4.0, 9.0]}, inputs={"F": ([0.0, 1.0], [1.0, 0.0], "hold")}, outputs=["x", "F"], **FINE
    )
    w = np.array([2.0, 3.0])
    exact = (np.cos(w) - np.cos(2 * w)) / w**2
    np.testing.assert_allclose(runs["final x"], exact, atol=1e-8)
    assert runs["final F"].tolist() == [0, 0]


def test_a_sweep_is_every_combination_and_every_sample(oscillator: lg.System) -> None:
    runs = oscillator.sweep(
        2.0,
        ["k=1 N/m:4N/m:4", "m=1,2", "x~uniform(0.1, 1)"],
        draws=50,
        seed=7,
        outputs=["x", "max x"],
        inputs={"F": 0.0},
        **FINE,
    )
    assert runs.dims == ("k", "m", "sample")
    assert runs.shape == (4, 2, 50)
    k, m, x0 = runs["k"], runs["m"], runs.coordinates["x"][1]
    assert k.tolist() == [1, 2, 3, 4]
    assert (x0 > 0.1).all()
    assert (x0 < 1).all()
    w = np.sqrt(k[:, None] / m[None, :])[..., None]
    np.testing.assert_allclose(runs["final x"], x0 * np.cos(2 * w), atol=1e-8)
    np.testing.assert_allclose(runs["max x"], np.broadcast_to(x0, runs.shape), atol=1e-8)
    again = oscillator.sweep(2.0, {"x": "uniform(0.1, 1)", oscillator["m"]: [1, 2]}, draws=50, seed=7, **FINE)
    assert again.coordinates["x"][1].tolist() == x0.tolist()
    other = oscillator.sweep(2.0, {"x": "uniform(0.1, 1)"}, draws=50, seed=8, **FINE)
    assert other.coordinates["x"][1].tolist() != x0.tolist()


@pytest.mark.slow
def test_the_same_bits_whatever_the_chunks_and_threads() -> None:
    system = built_in.system("double-pendulum")
    bits = set()
    for memory, threads in ((2**28, 1), (2**28, 2), (300_000, 2), (100_000, 1), (1, 1)):
        runs = system.sweep(
            1.0,
            ["theta1=0.1:3:13", "m1~normal(1,0.1)"],
            draws=11,
            times=11,
            outputs=["max theta1", "rms theta2'", "final theta1''"],
            memory=memory,
            threads=threads,
            **FINE,
        )
        bits.add(b"".join(runs[name].tobytes() for name in runs))
    assert len(bits) == 1


@sized(8, 2)
@given(st.integers(0, 2**32 - 1))
def test_random_double_pendulums_against_scipy(seed: int) -> None:
    rng = np.random.default_rng(seed)
    system = built_in.system("double-pendulum")
    dyn = system.compile()
    n = 4
    x0 = rng.uniform(-2, 2, (n, 4))
    p = {name: rng.uniform(0.5, 2, n) for name in ("m1", "m2", "L1", "L2")}
    initial = dict(zip(["theta1", "theta2", "theta1'", "theta2'"], x0.T, strict=True))
    runs = system.ensemble(1.0, initial=initial, params=p, method="rk4", step=1e-3, outputs=["theta1", "max theta2"])
    for k in range(n):
        own = {name: values[k] for name, values in p.items()}
        times = np.linspace(0, 1, 1001)
        done = solve_ivp(
            lambda t, x, own=own: dyn.rhs(t, x, p=own), (0, 1), x0[k], "DOP853", times, rtol=1e-10, atol=1e-10
        )
        assert runs["final theta1"][k] == pytest.approx(done.y[0, -1], abs=1e-7)
        assert runs["max theta2"][k] == pytest.approx(done.y[1].max(), abs=1e-6)


def test_a_run_that_fails_is_counted_and_told_and_harms_no_other(oscillator: lg.System) -> None:
    runs = oscillator.sweep(2.0, {"k": [4.0, -4e6, 4.0]}, x=0.5, outputs=["max x"], **FINE)
    assert not runs.success
    assert np.isnan(runs["x"]).tolist() == [False, True, False]
    assert runs["max x"][0] == runs["max x"][2] == 0.5
    failures = runs.failures()
    assert [f.index for f in failures] == [(1,)]
    assert failures[0].values == {"k": -4e6}
    assert "not finite" in str(failures[0])
    assert sum(runs.counts.values()) == 3
    assert "2 of 3: the end was reached; 1 of 3: the derivative" in repr(runs)


def test_what_is_observed_may_not_be_finite(oscillator: lg.System) -> None:

    runs = oscillator.ensemble(1.0, x=[0.0, 1.0], outputs={"inverse": "1/x"}, times=3, **FINE)
    assert runs.success
    assert np.isfinite(runs["inverse"]).tolist() == [False, True]
    assert runs["inverse"][1] == pytest.approx(1 / np.cos(2.0))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda s: s.ensemble(1.0, x=[1.0, 2.0], params={"k": [1.0, 2.0, 3.0]}), "do not fit together"),
        (lambda s: s.ensemble(1.0, x=[1.0, np.nan]), "'x' is nan at"),
        (lambda s: s.ensemble(1.0, params={"kk": [1.0]}), "no parameter 'kk'"),
        (lambda s: s.ensemble(1.0, initial={"y": [1.0]}), "no coordinate or rate 'y'"),
        (lambda s: s.ensemble(1.0, y=[1.0]), "no option or state 'y'"),
        (lambda s: s.ensemble(1.0, x=[]), "'run' is empty"),
        (lambda s: s.ensemble(-1.0, x=[1.0]), "duration is negative"),
        (lambda s: s.ensemble(0.0, x=[1.0]), "needs a duration above 0"),
        (lambda s: s.ensemble(x=[1.0]), "no duration is given"),
        (lambda s: s.ensemble(1.0, x=[1.0], method="rk5"), "no method 'rk5'"),
        (lambda s: s.ensemble(1.0, x=[1.0], method="rk4"), "uses a constant step size"),
        (lambda s: s.ensemble(1.0, x=[1.0], rtol=0.0, method="dop853"), "rtol"),
        (lambda s: s.ensemble(1.0, x=[1.0], outputs="maxi x", **FINE), "no reduction 'maxi'"),
        (lambda s: s.ensemble(1.0, x=[1.0], outputs="y", **FINE), "unknown"),
        (lambda s: s.ensemble(1.0, x=[1.0], outputs="x/2", **FINE), "cannot be the name of a result"),
        (lambda s: s.ensemble(1.0, x=[1.0], reduce=("biggest",), **FINE), "no reduction 'biggest'"),
        (lambda s: s.ensemble(1.0, x=[1.0], outputs={"status": "max x"}, **FINE), "cannot be called 'status'"),
        (lambda s: s.ensemble(1.0, x=[1.0], outputs={"..": "max x"}, **FINE), "cannot be the name of a result"),
        (lambda s: s.ensemble(1.0, x=[1.0], outputs={"a\n": "x"}, **FINE), "cannot be the name of a result"),
        (lambda s: s.ensemble(1.0, x=[1.0], dims=("time",), **FINE), "an axis cannot be called 'time'"),
        (lambda s: s.ensemble(1.0, x=[1.0], dims=("a", "b"), **FINE), "as many different names"),
        (
            lambda s: s.ensemble(1.0, x=[[1.0], [2.0]], params={"k": [1.0, 2.0]}, dims=("k", "x"), **FINE),
            "varies along",
        ),
        (lambda s: s.ensemble(1.0, x=[1.0], inputs={"F": lambda t, x: 0.0}, **FINE), "cannot be a Python function"),
        (lambda s: s.ensemble(times=[0, 2, 1], x=[1.0], **FINE), "out of order"),
        (lambda s: s.ensemble(1.0, x=[1.0], memory=0, **FINE), "memory"),
        (lambda s: s.ensemble(1.0, x=[1.0], resume=True, **FINE), "apply only to a store"),
        (lambda s: s.ensemble(1.0, x=[1.0], store="a.txt", **FINE), "must end in .zarr"),
        (lambda s: s.sweep(1.0, ["k=1:2:3", "k=1"]), "varied twice"),
        (lambda s: s.sweep(1.0, []), "no varied quantity is given"),
        (lambda s: s.sweep(1.0, ["kay=1:2:3"]), "no parameter, coordinate, rate or input 'kay'"),
        (lambda s: s.sweep(1.0, ["k=1 kg:2 kg:3"]), "is given in kg"),
        (lambda s: s.sweep(1.0, ["k~normal(1,0.1)"]), "the number of draws"),
        (lambda s: s.sweep(1.0, ["k=1:2:3"], draws=10), "no quantity is drawn"),
        (lambda s: s.sweep(1.0, ["k~normal(1,0.1)"], draws=-1), "draws must be"),
        (lambda s: s.sweep(1.0, ["k~normal(1,0.1)"], draws=3, seed=-1), "a seed is"),
        (lambda s: s.sweep(1.0, {"k": np.ones((2, 2))}), "one row"),
        (lambda s: s.sweep(1.0, {"k": [1.0]}, inputs={"G": 1.0}), "no input 'G'"),
        (lambda s: s.sweep(1.0, ["k=1:2:10000000", "m=1:2:10000000"]), "too many"),
    ],
)
def test_what_is_wrong_is_told_before_anything_runs(oscillator: lg.System, call, message: str) -> None:
    with pytest.raises((lg.RunError, lg.ModelError, lg.Error), match=message):
        call(oscillator)


@pytest.mark.slow
def test_values_missing_are_listed_unless_they_vary() -> None:
    system = lg.System("free")
    x = system.coordinate("x")
    m, k = system.parameters("m k")
    system.particle(m, at=system.origin + (x, 0))
    system.spring(k, deflection=x)
    with pytest.raises(lg.RunError, match="Missing: m, k"):
        system.ensemble(1.0, x=[1.0], **FINE)
    runs = system.sweep(1.0, {"m": [1.0, 2.0]}, params={"k": 1.0}, x=1.0, outputs=[x, sp.sin(x)], **FINE)
    np.testing.assert_allclose(runs["final x"], np.cos(1 / np.sqrt([1.0, 2.0])), atol=1e-9)


def test_tables_for_others(oscillator: lg.System) -> None:
    runs = oscillator.sweep(1.0, ["k=1:4:4", "m~normal(1,0.01)"], draws=3, x=1.0, outputs=["x", "max x"], **FINE)
    data = runs.to_xarray()
    assert data["final x"].dims == ("k", "sample")
    assert data["k"].attrs["units"] == "N/m"
    assert data["m"].dims == ("sample",)
    frame = runs.to_pandas()
    assert list(frame.columns) == ["sample", "k", "m", "final x", "max x", "reached", "status"]
    assert len(frame) == 12
    kept = oscillator.ensemble(1.0, x=[0.1, 0.2], reduce=None, times=5, **FINE)
    data = kept.to_xarray()
    assert data["x"].dims == ("run", "time")
    assert data["x(0)"].dims == ("run",)
    assert len(kept.to_pandas()) == 10


def test_files(oscillator: lg.System, tmp_path) -> None:
    import pandas
    import xarray

    runs = oscillator.sweep(1.0, ["k=1:4:4", "m~normal(1,0.01)"], draws=3, x=1.0, outputs=["x", "max x'"], **FINE)
    for ending in (".csv", ".nc", ".parquet"):
        path = runs.save(tmp_path / f"a{ending}")
        with pytest.raises(lg.Error, match="exists"):
            runs.save(path)
        runs.save(path, overwrite=True)
    with (tmp_path / "a.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for name, column in runs.columns().items():
        assert [float(row[name]) for row in rows] == column.tolist()
    pandas.testing.assert_frame_equal(pandas.read_parquet(tmp_path / "a.parquet"), runs.to_pandas())
    data = xarray.load_dataset(tmp_path / "a.nc", engine="h5netcdf")
    xarray.testing.assert_identical(data, runs.to_xarray())
    assert data["k"].attrs["units"] == "N/m"
    with pytest.raises(lg.ModelError, match="is not supported"):
        runs.save(tmp_path / "a.xls")
    assert len(list(tmp_path.iterdir())) == 3


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("method", "how"), [("dop853", {}), ("tsit5", {}), ("gauss4", {"step": 0.01})])
def test_every_run_is_what_simulate_gives(method: str, how: dict[str, float]) -> None:
    system = built_in.system("cart-pole")
    theta, m = np.array([0.1, 1.0, 2.0]), np.array([0.2, 0.3, 0.1])
    inputs = {"F": "-x - 0.2*x' + 0.1*sin(t)"}
    asked = ["max theta", "final x'", "mean theta''", "rms F"]
    times = np.linspace(0, 2, 41)
    runs = system.ensemble(
        times=times, theta=theta, params={"m": m}, inputs=inputs, outputs=asked, method=method, **how
    )
    for k in range(3):
        one = system.simulate(times=times, theta=theta[k], params={"m": m[k]}, inputs=inputs, method=method, **how)
        close = {"rel": 1e-9, "abs": 1e-9}
        assert runs["max theta"][k] == pytest.approx(one["theta"].max(), **close)
        assert runs["final x'"][k] == pytest.approx(one["x'"][-1], **close)
        assert runs["mean theta''"][k] == pytest.approx(np.trapezoid(one["theta''"], times) / 2, **close)
        assert runs["rms F"][k] == pytest.approx(np.sqrt(np.trapezoid(one["F"] ** 2, times) / 2), **close)


def test_events_are_counted_and_their_times_kept(oscillator: lg.System) -> None:
    x = oscillator["x"]
    crossing, rising = lg.event(x, name="zero"), lg.event(x, direction=1, name="up")
    k = np.array([1.0, 4.0, 9.0])
    runs = oscillator.ensemble(
        10.0, x=1.0, params={"k": k}, events=[crossing, rising], event_times=3, outputs="x", method="dop853"
    )
    w = np.sqrt(k)
    assert runs["count zero"].tolist() == np.floor(10 * w / np.pi + 0.5).astype(int).tolist()
    zeros = (np.arange(3) + 0.5) * np.pi / w[:, None]
    np.testing.assert_allclose(runs["time zero"], np.where(zeros < 10, zeros, np.nan), atol=1e-9)
    np.testing.assert_allclose(runs["time up"][:, 0], 1.5 * np.pi / w, atol=1e-9)
    assert runs.to_xarray()["time zero"].dims == ("run", "event")


@pytest.mark.parametrize("reduce", [("final", "max", "mean"), ("final",), None])
def test_a_run_that_an_event_ends_is_reduced_over_what_it_reached(oscillator: lg.System, reduce) -> None:
    end = lg.event(oscillator["x"], terminal=True, name="end")
    k, times = np.array([1.0, 4.0, 0.01]), np.linspace(0, 2, 21)
    runs = oscillator.ensemble(times=times, x=1.0, params={"k": k}, events=end, outputs=["x", "x'"], reduce=reduce)
    w = np.sqrt(k)
    ends = np.minimum(np.pi / 2 / w, 2.0)
    assert runs.status.tolist() == [1, 1, 0]
    np.testing.assert_allclose(runs["reached"], ends, atol=1e-9)
    np.testing.assert_allclose(runs["time end"], np.where(ends < 2, ends, np.nan), atol=1e-9)
    if reduce is None:
        exact = np.where(times <= ends[:, None], np.cos(w[:, None] * times), np.nan)
        np.testing.assert_allclose(runs["x"], exact, atol=1e-9)
        return
    np.testing.assert_allclose(runs["final x"], np.cos(w * ends), atol=1e-9)
    np.testing.assert_allclose(runs["final x'"], -w * np.sin(w * ends), atol=1e-9)
    if "mean" in reduce:
        assert (runs["max x"] == 1).all()
        np.testing.assert_allclose(runs["mean x'"], (np.cos(w * ends) - 1) / ends, atol=5e-3)


def test_impacts_in_an_ensemble() -> None:
    ball = lg.System("ball")
    y = ball.coordinate("y")
    m, e = ball.parameters("m e", m=1.0, e=0.5)
    ball.particle(m, at=ball.origin + (0, y))
    ball.gravity(direction=(0, -1), g=10)
    bounce = lg.event(y, direction=-1, reset={y.diff(): -e * y.diff()}, name="bounce")
    runs = ball.ensemble(2.0, y=5.0, params={"e": [0.5, 0.8]}, events=bounce, outputs=["y", "max y"], event_times=2)
    np.testing.assert_allclose(runs["time bounce"], [[1.0, 2.0], [1.0, np.nan]], atol=1e-9)
    assert runs["max y"].tolist() == [5.0, 5.0]
    assert runs["final y"][1] == pytest.approx(8 - 5, abs=1e-9)


def test_one_run_is_an_ensemble_too(oscillator: lg.System) -> None:
    runs = oscillator.ensemble(1.0, x=1.0, **FINE)
    assert runs.shape == ()
    assert float(runs["x"]) == pytest.approx(np.cos(2.0))
    assert len(runs.to_pandas()) == 1
    assert "1 runs, rk4" in repr(runs)
    assert runs.failures() == []
    assert "final x" in runs
    assert "final y" not in runs
    assert runs.get("final y") is None
    with pytest.raises(lg.RunError, match="there is no result 'final y'"):
        runs["final y"]


@pytest.mark.slow
def test_frames_that_float() -> None:
    system = lg.System("satellite")
    hull = system.floating_frame("hull")
    system.rigid_body(500, (80, 90, 120), at=hull.origin, frame=hull)
    rate = np.linspace(0, 1, 4)
    runs = system.ensemble(2.0, hull_wz=rate, outputs=["hull_qz", "hull_qw"])
    np.testing.assert_allclose(runs["hull_qz"], np.sin(rate), atol=1e-9)
    np.testing.assert_allclose(runs["hull_qw"], np.cos(rate), atol=1e-9)


def test_xarray_reads_a_store_as_it_is(oscillator: lg.System, tmp_path) -> None:
    import xarray

    given = (1.0, ["k=1:4:4", "m~normal(1,0.01)"])
    how = {"draws": 3, "x": 1.0, "outputs": ["max x'", "x"], **FINE}
    runs = oscillator.sweep(*given, store=tmp_path / "a.zarr", **how)
    data = xarray.open_zarr(tmp_path / "a.zarr").load()
    assert set(data.coords) == {"k", "m"}
    assert data["final x"].attrs == {"long_name": "final of x", "units": "m"}
    np.testing.assert_array_equal(data["max x'"], runs["max x'"])
    here = oscillator.sweep(*given, **how)
    assert here.to_xarray().equals(runs.to_xarray())
    with pytest.raises(lg.Error, match="exists"):
        oscillator.sweep(*given, store=tmp_path / "a.zarr", **how)


def test_results_larger_than_memory_want_a_store(oscillator: lg.System, monkeypatch: pytest.MonkeyPatch) -> None:
    from lagrangian.simulate import sweeping

    monkeypatch.setattr(sweeping, "_machine_memory", lambda: 1e6)
    with pytest.raises(lg.RunError, match=r"take 0\.00[0-9]+ GiB\n.*store="):
        oscillator.ensemble(1.0, x=np.linspace(0, 1, 100), reduce=None, **FINE)


def test_memory_is_left_for_the_events_of_a_chunk() -> None:
    """A ball that bounces fifty times in every run: what the solver hands back fits in what a run is said to take."""
    system = lg.System("ball")
    y = system.coordinate("y")
    system.particle(system.parameter("m", 1.0), at=system.origin + (0, y))
    system.gravity()
    bounce = lg.event(y, direction=-1, reset={y.diff(): -y.diff()}, name="bounce")
    settings, recording = RunSettings(duration=100.0, events=bounce, max_events=50), Recording(outputs=["y"])
    study, _ = study_of(system.model, settings, recording, driving(system.model, None, {}), np.array([0.0, 100.0]))
    x0 = np.column_stack([np.linspace(0.5, 1.0, 20), np.zeros(20)])
    found = Solver(study.program, study.method, events=study.events).solve(
        x0, study.times, p=[1.0, 9.81], store=study.whole, **study.options
    )
    assert (found.event_count == 50).all()
    held = found.event_state.nbytes + found.event_time.nbytes + found.event_index.nbytes
    assert held < len(x0) * study.bytes_per_run


@pytest.mark.parametrize("other", [{"terminal": False}, {"direction": 1}, {"reset": True}])
def test_a_store_of_other_events_is_not_gone_on_with(tmp_path, oscillator: lg.System, other: dict) -> None:
    x = oscillator["x"]
    given = {"initial": {"x": [1.0, 2.0]}, "method": "rk4", "step": 0.01, "store": tmp_path / "a.zarr"}
    if other.pop("reset", False):
        other["reset"] = {x.diff(): -x.diff()}
    oscillator.ensemble(2.0, events=lg.event(x, terminal=True, name="e"), **given)
    with pytest.raises(lg.RunError, match="belongs to a different sweep: events was"):
        oscillator.ensemble(2.0, events=lg.event(x, **{"terminal": True, **other}, name="e"), resume=True, **given)
    with pytest.raises(lg.RunError, match="belongs to a different sweep: events was"):
        oscillator.ensemble(2.0, events=lg.event(x, terminal=True, name="e"), event_times=2, resume=True, **given)
