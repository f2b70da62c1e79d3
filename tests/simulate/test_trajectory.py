"""What can be asked of a run, and the files it is written to."""

from __future__ import annotations

import json
import stat
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet
import pytest
import sympy as sp
import xarray
from run_systems import example, oscillator

import lagrangian as lg


@pytest.fixture(scope="module")
def run() -> lg.Trajectory:
    return example("double-pendulum").simulate(2.0, theta1="40 deg", samples=21)


def test_it_looks_like_scipys_result(run: lg.Trajectory) -> None:
    assert run.t.shape == (21,) and run.y.shape == (4, 21)
    assert run.success is True and run.status == 0
    assert "end of the interval" in run.message and run.nfev > 12 * run.steps
    assert run.states == ("theta1", "theta2", "theta1'", "theta2'")
    assert run.params["L1"] == 1.0


@pytest.mark.slow
def test_states_accelerations_and_expressions_by_name(run: lg.Trajectory) -> None:
    theta1, theta2 = (c.symbol for c in run.model.coordinates)
    assert run["theta1"] is not None and np.array_equal(run["theta1"], run[theta1])
    assert np.array_equal(run["theta2'"], run[theta2.diff()])
    assert run["θ₁"] == pytest.approx(run["theta1"])
    assert run["sin(theta1)*L1"] == pytest.approx(np.sin(run["theta1"]))
    assert run[sp.sin(theta1 - theta2)] == pytest.approx(np.sin(run["theta1"] - run["theta2"]))
    dyn = example("double-pendulum").compile()
    a = dyn.forward(run.y[:2].T, run.y[2:].T)
    assert run["theta1''"] == pytest.approx(a[:, 0], rel=1e-12)
    assert run[theta2.diff().diff()] == pytest.approx(a[:, 1], rel=1e-12)
    several = run.observe({"a": theta1 + theta2, "t": sp.Symbol("t")})
    assert several["a"] == pytest.approx(run["theta1"] + run["theta2"])
    assert several["t"] == pytest.approx(run.t)


def test_points_have_paths(run: lg.Trajectory) -> None:
    P2 = run.points["P2"]
    assert P2.shape == (21, 2) and list(run.points) == ["P1", "P2"]
    assert P2[:, 0] == pytest.approx(np.sin(run["theta1"]) + np.sin(run["theta2"]))
    assert "P3" not in run.points
    with pytest.raises(lg.ModelError, match="Did you mean"):
        run.points["P22"]


def test_what_is_unknown_is_refused(run: lg.Trajectory) -> None:
    for asked, words in (
        ("theta3", "unknown symbol"),
        (sp.Symbol("z"), "unknown symbol 'z'"),
        (3.0j, "must be a number"),
    ):
        with pytest.raises(lg.ModelError, match=words):
            run[asked]


@pytest.mark.slow
def test_powers_of_elements_add_up_to_the_power_supplied() -> None:
    s = oscillator()
    run = s.simulate(3.0, q=1.0, inputs={"F": "2*sin(3*t)"}, samples=31)
    given = run.powers
    assert set(given) == {e.name for e in s.elements if e.ledger != "T*"}
    assert given["b"] == pytest.approx(-0.4 * run["q'"] ** 2)
    assert given["k"] == pytest.approx(-8.0 * run["q"] * run["q'"])
    force = next(e.name for e in s.elements if e.kind == "force")
    assert given[force] == pytest.approx(run["F"] * run["q'"])
    assert given["b"] + given[force] == pytest.approx(run.power)
    with pytest.raises(lg.ModelError, match="no element"):
        given["spring 7"]


def test_the_systems_energy_can_be_asked_for(run: lg.Trajectory) -> None:
    s = example("double-pendulum")
    assert run[s.energy] == pytest.approx(run.energy, rel=1e-12)


def test_repr_tells_the_audit(run: lg.Trajectory) -> None:
    assert "energy drift" in repr(run) and "dop853" in repr(run)
    assert str(run.audit) == f"energy drift {float(run.audit):.1e}"


def test_xarray_and_pandas_carry_units(run: lg.Trajectory) -> None:
    data = run.to_xarray()
    assert data["theta1"].attrs["units"] == "rad"
    assert data["theta1'"].attrs["units"] == "rad/s"
    assert "rod 1" in data["theta1"].attrs["long_name"]
    assert data["P2.x"].attrs["units"] == "m"
    assert json.loads(data.attrs["parameters"])["g"] == 9.81
    frame = run.to_pandas()
    assert frame.index.name == "t" and frame.attrs["units"]["energy.kinetic"] == "J"
    assert frame["theta2"].to_numpy() == pytest.approx(run["theta2"])


def test_files_give_back_the_numbers(run: lg.Trajectory, tmp_path: Path) -> None:
    for ending in ("csv", "nc", "parquet", "npz"):
        path = run.save(tmp_path / f"run.{ending}")
        assert path.exists()
    text = (tmp_path / "run.csv").read_text().splitlines()
    names = text[0].split(",")
    assert names[:3] == ["t", "theta1", "theta2"]
    back = np.array([[float(x) for x in line.split(",")] for line in text[1:]])
    assert np.array_equal(back[:, 1], run["theta1"])  # every digit
    with xarray.open_dataset(tmp_path / "run.nc", engine="h5netcdf") as data:
        assert np.array_equal(data["theta1'"], run["theta1'"])
        assert data["theta1'"].attrs["units"] == "rad/s" and data.attrs["method"] == "dop853"
    read = pyarrow.parquet.read_table(tmp_path / "run.parquet")
    assert np.array_equal(read["energy.kinetic"].to_numpy(), run.kinetic)
    assert read.schema.field("energy.kinetic").metadata[b"units"] == b"J"
    with np.load(tmp_path / "run.npz") as arrays:
        assert np.array_equal(arrays["P1.y"], run.points["P1"][:, 1])
    assert not list(tmp_path.glob(".*"))


def test_a_file_is_replaced_only_when_asked(run: lg.Trajectory, tmp_path: Path) -> None:
    path = tmp_path / "run.nc"
    path.write_bytes(b"precious")
    with pytest.raises(lg.Error, match="exists already"):
        run.save(path)
    assert path.read_bytes() == b"precious"
    run.save(path, overwrite=True)
    assert path.stat().st_size > 1000
    with pytest.raises(lg.ModelError, match="is not supported"):
        run.save(tmp_path / "run.xlsx")
    with pytest.raises(lg.Error, match="there is no folder"):
        run.save(tmp_path / "none" / "run.npz")


@pytest.mark.slow
def test_a_full_disk_is_told_and_leaves_what_was_there(tmp_path: Path) -> None:
    """A limit on the size of files stands for the disk, in a process of its own."""
    pytest.importorskip("resource")
    files = ["x.csv", "x.nc", "x.parquet", "x.npz", "y.csv", "y.nc", "y.parquet"]
    for name in files:
        (tmp_path / name).write_text("precious")
    code = """
import resource, signal
import lagrangian as lg
from lagrangian import examples
system = lg.loads(examples.text("pendulum"))
run = system.simulate(10, samples=2001)
run.to_csv()
runs = system.ensemble(0.01, theta=[0.001 * k for k in range(3000)], times=2)
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
for name in FILES:
    try:
        (run if name.startswith("x") else runs).save(name, overwrite=True)
    except lg.Error as error:
        print(error)
"""
    given = [sys.executable, "-c", f"FILES = {files}" + code]
    done = subprocess.run(given, cwd=tmp_path, capture_output=True, text=True)
    assert done.stderr == "" and done.stdout.count("file too large") == len(files)
    for name in files:
        assert (tmp_path / name).read_text() == "precious"
    assert len(list(tmp_path.iterdir())) == len(files)


@pytest.mark.parametrize(
    ("package", "use"),
    [
        ("xarray", lambda run, at: run.to_xarray()),
        ("pandas", lambda run, at: run.to_pandas()),
        ("h5netcdf", lambda run, at: run.save(at / "x.nc")),
        ("pyarrow", lambda run, at: run.save(at / "x.parquet")),
    ],
)
def test_a_missing_package_is_named_with_the_line_that_installs_it(
    run: lg.Trajectory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, package: str, use: Any
) -> None:
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(lg.MissingExtra, match=rf"'{package}'[\s\S]*pip install 'lagrangian\[data\]'"):
        use(run, tmp_path)


def test_permissions_of_a_file_are_kept(run: lg.Trajectory, tmp_path: Path) -> None:
    path = tmp_path / "run.parquet"
    path.write_bytes(b"")
    path.chmod(0o600)
    run.save(path, overwrite=True)
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
