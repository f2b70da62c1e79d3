"""How long a sweep takes is said before it begins; its results are read chunk by chunk."""

import io
import pathlib
import pickle
from typing import Any

import numpy as np
import pytest

import lagrangian as lg
from lagrangian.cli import main

GRID = ["theta=0.1:3:20", "m~normal(1,0.1)"]
HOW: dict[str, Any] = {"draws": 20, "method": "rk4", "step": 0.01, "outputs": ["max theta"], "times": 51}


@pytest.fixture(scope="module")
def system() -> lg.System:
    return lg.example("pendulum")


@pytest.mark.slow
def test_an_estimate_counts_the_runs_and_the_bytes_that_follow(system: lg.System, tmp_path: pathlib.Path) -> None:
    asked: list[lg.SweepEstimate] = []
    runs = system.sweep(1.0, GRID, **HOW, threads=1, store=tmp_path / "a.zarr", confirm=asked.append)
    (estimate,) = asked
    assert estimate.runs == runs.count == 400
    assert estimate.bytes == sum(runs[name].nbytes for name in runs)
    assert estimate.seconds > 0
    assert estimate.threads == 1
    assert 8 <= estimate.measured <= 400
    system.sweep(1.0, GRID, **HOW, store=tmp_path / "a.zarr", resume=True, confirm=asked.append)
    assert (asked[1].runs, asked[1].seconds, asked[1].measured) == (0, 0.0, 0)
    next(p for p in (tmp_path / "a.zarr" / "status" / "c").rglob("*") if p.is_file()).unlink()
    system.sweep(1.0, GRID, **HOW, store=tmp_path / "a.zarr", resume=True, confirm=asked.append)
    assert 0 < asked[2].runs < 400


def test_nothing_is_started_if_the_answer_is_no(system: lg.System, tmp_path: pathlib.Path) -> None:
    with pytest.raises(lg.NotStarted, match=r"about .* s and at most .* kB for 400 runs") as refused:
        system.sweep(1.0, GRID, **HOW, store=tmp_path / "a.zarr", confirm=lambda _: False)
    assert not list(tmp_path.iterdir())
    assert pickle.loads(pickle.dumps(refused.value)).estimate == refused.value.estimate
    with pytest.raises(lg.RunError, match="confirm must be a function"):
        system.sweep(1.0, GRID, **HOW, confirm=True)  # pyright: ignore[reportArgumentType]


def test_every_place_of_the_sweep_is_measured() -> None:
    from lagrangian.integrate.design import Design, DesignColumn
    from lagrangian.integrate.estimate import some_rows

    base = {"x": np.zeros(2), "u": np.zeros(1), "p": np.zeros(1)}
    design = Design(("a",), (1000,), base, [DesignColumn("p", 0, "k", np.arange(1000.0))])
    rows = some_rows(design, 64)
    assert len(rows) == len(rows.x) == 64
    np.testing.assert_array_equal(rows.p[::4, 0], np.linspace(0, 1000, 17).astype(int)[:-1])
    assert rows.u.shape == (1,)
    assert len(some_rows(design, 1000)) == 1000


@pytest.mark.parametrize(
    ("seconds", "size", "words"),
    [
        (0.002, 10, "about 0.01 s and at most 1 kB"),
        (119.0, 3_456_000, "about 120 s and at most 3.5 MB"),
        (2400.0, 12e9, "about 40 min and at most 12 GB"),
        (7200.0, 1.5e12, "about 2 h and at most 1.5 TB"),
        (1e6, 1e9, "about 12 days and at most 1 GB"),
    ],
)
def test_times_and_sizes_are_said_in_units_that_suit_them(seconds: float, size: int, words: str) -> None:
    assert str(lg.SweepEstimate(10, seconds, int(size), 8, 2)).startswith(words)


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("answer", "done"), [("y\n", True), ("yes\n", True), ("\n", False), ("", False)])
def test_the_command_asks_a_terminal(
    tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch, answer: str, done: bool
) -> None:
    monkeypatch.chdir(tmp_path)
    asked = Terminal()
    monkeypatch.setattr("sys.stdin", Terminal(answer))
    monkeypatch.setattr("sys.stderr", asked)
    assert main([*COMMAND, "-o", "a.csv"]) == 0
    assert "for 2 runs on" in asked.getvalue()
    assert "go on? [y/N] " in asked.getvalue()
    assert (tmp_path / "a.csv").exists() is done


COMMAND = ["sweep", "--example", "pendulum", "theta=0.1,0.2", "--duration", "1", "--estimate"]


def test_elsewhere_the_command_only_says_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(COMMAND) == 0
    said = capsys.readouterr()
    assert said.out.startswith("about ")
    assert said.out.count("\n") == 1
    assert said.err == ""


def test_results_are_read_chunk_by_chunk_and_checked(system: lg.System, tmp_path: pathlib.Path) -> None:
    pytest.importorskip("dask.array")
    how = {**HOW, "draws": 30, "reduce": None, "outputs": ["theta"]}
    store = tmp_path / "a.zarr"
    runs = system.sweep(1.0, ["theta=0.1:3:20", "m~normal(1,0.1)"], **how, store=store)
    lazy, whole = runs.to_xarray(lazy=True), runs.to_xarray()
    assert lazy["theta"].chunks is not None
    assert len(lazy["theta"].chunks[0]) > 1
    assert lazy.identical(whole)
    np.testing.assert_array_equal(lazy["theta"][::-3, 5, 7:2:-1].values, whole["theta"][::-3, 5, 7:2:-1].values)
    first = lazy["theta"].data.blocks[0, 0, 0]
    (store / "theta" / "c" / "0" / "0" / "0").write_bytes((store / "theta" / "c" / "1" / "0" / "0").read_bytes())
    with pytest.raises(lg.RunError, match=r"1 damaged chunk .*'theta/c/0/0/0' is not what was written"):
        first.compute()
    np.testing.assert_array_equal(lazy["theta"][-1].values, whole["theta"][-1].values)
    left = lg.Ensemble.of_store(store, lost=True)
    assert left.to_xarray(lazy=True).identical(left.to_xarray())
    assert -127 in left.status
    with pytest.raises(lg.RunError, match="only results in a store are read lazily"):
        system.sweep(1.0, GRID, **HOW).to_xarray(lazy=True)


@pytest.mark.parametrize("answer", [False, np.False_])
def test_every_no_is_a_no(system: lg.System, answer: Any) -> None:
    """A comparison of NumPy's numbers is False without being the object False."""
    with pytest.raises(lg.NotStarted):
        system.sweep(1.0, GRID, **HOW, confirm=lambda _: answer)


@pytest.mark.parametrize("answer", ["no", 0, np.array([False, False])])
def test_an_answer_that_is_no_answer_starts_nothing(system: lg.System, answer: Any) -> None:
    with pytest.raises(lg.RunError, match="confirm must return True or False, or nothing to go on"):
        system.sweep(1.0, GRID, **HOW, confirm=lambda _: answer)


def test_a_store_is_continued_or_replaced(tmp_path: pathlib.Path) -> None:
    with pytest.raises(lg.RunError, match="either continued or replaced, not both"):
        lg.example("pendulum").sweep(1.0, GRID, **HOW, store=tmp_path / "a.zarr", resume=True, overwrite=True)


def test_a_store_that_is_not_there_or_is_no_name() -> None:
    with pytest.raises(lg.Error, match="name a store that a sweep made"):
        lg.Ensemble.of_store("memory://nowhere.zarr")
    with pytest.raises(lg.Error, match=r"a store must be text or a Path \(got NoneType\)"):
        lg.Ensemble.of_store(None)  # pyright: ignore[reportArgumentType]


@pytest.mark.parametrize("url", ["s3://me:secret@bucket/a.zarr", "http://me:secret@host/a.zarr"])
def test_a_password_in_the_url_of_a_store_is_refused_without_being_shown(url: str) -> None:
    with pytest.raises(lg.Error, match="contains a password") as found:
        lg.Ensemble.of_store(url)
    assert "secret" not in str(found.value)
    with pytest.raises(lg.Error, match="contains a password") as found:
        lg.example("pendulum").sweep(1.0, GRID, **HOW, store=url)
    assert "secret" not in str(found.value)


def test_a_range_with_too_many_values_says_so() -> None:
    with pytest.raises(lg.ParseError, match="values are too many for one range"):
        lg.example("pendulum").sweep(1.0, f"theta=0:1:{10**30}")
