"""Stores: what is done is kept, and nothing is done twice."""

import errno
import os
import pathlib
import sys

import numpy as np
import pytest

from lagrangian.errors import Error, MissingExtra, RunError
from lagrangian.integrate import store
from lagrangian.integrate.chunks import Portions
from lagrangian.integrate.status import RunStatus
from lagrangian.integrate.store import ChunkPlan, Variable
from lagrangian.integrate.stored import Stored

PORTIONS = Portions((3, 10), (1, 4))


def plan(**changed) -> ChunkPlan:
    results = {
        "max x": Variable("float64", ("k", "run"), (3, 10), {"units": "m"}),
        "x": Variable("float64", ("k", "run", "time"), (3, 10, 5)),
        "status": Variable("int8", ("k", "run"), (3, 10)),
    }
    coordinates = {
        "k": (Variable("float64", ("k",), (3,)), [np.array([1.0, 2.0]), np.array([3.0])]),
        "g": (Variable("float64", (), ()), [np.array(9.81)]),
    }
    return ChunkPlan(
        PORTIONS, results, coordinates, {"rtol": 1e-9, "grid": {"k": "1:3:3"}, **changed}, {"title": "test"}
    )


def values(index: int) -> dict[str, np.ndarray]:
    start, stop = PORTIONS.range(index)
    runs = np.arange(start, stop, dtype=float)
    return {"max x": runs, "x": runs[:, None] + np.arange(5) / 10, "status": np.zeros(len(runs), np.int8)}


def test_chunks_are_written_marked_and_read_back(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "a.zarr"
    with store.create(path, plan()) as made:
        assert not made.done.any()
        for k in range(len(PORTIONS)):
            made.write(k, PORTIONS.box(k), values(k))
    with store.resume(path, plan()) as again:
        assert again.done.all()
        assert again.portions == PORTIONS
    made = Stored(path)
    runs = np.arange(30.0).reshape(3, 10)
    np.testing.assert_array_equal(made.results["max x"][...], runs)
    np.testing.assert_array_equal(made.results["x"][...], runs[..., None] + np.arange(5) / 10)
    assert made.coordinates["k"].tolist() == [1, 2, 3]
    assert made.done.all()


def test_to_other_readers_a_run_that_is_not_done_says_so(tmp_path: pathlib.Path) -> None:
    """A kill between two arrays of a chunk: its status is not there yet, whatever else is."""
    import xarray

    path, plans = tmp_path / "a.zarr", plan()
    plans.results["count up"] = Variable("int32", ("k", "run"), (3, 10))
    plans.results["status"] = plans.results.pop("status")  # the last, as in a sweep
    more = {k: values(k) | {"count up": np.full(len(values(k)["max x"]), 2, np.int32)} for k in (0, 1)}
    with store.create(path, plans) as made:
        made.write(0, PORTIONS.box(0), more[0])
        del more[1]["status"]
        with pytest.raises(KeyError):
            made.write(1, PORTIONS.box(1), more[1])
    data = xarray.open_zarr(path, chunks=None, consolidated=False)
    there = np.zeros((3, 10), bool)
    there[PORTIONS.box(0)] = True
    assert (data["status"].values == np.where(there, 0, RunStatus.NOT_RUN)).all()
    there[PORTIONS.box(1)] = True
    assert (data["count up"].values == np.where(there, 2, -1)).all()
    assert (np.isnan(data["max x"].values) == ~there).all()


def test_xarray_opens_it(tmp_path: pathlib.Path) -> None:
    import xarray

    path = tmp_path / "a.zarr"
    with store.create(path, plan()) as made:
        made.write(0, PORTIONS.box(0), values(0))
    data = xarray.open_zarr(path, chunks=None)
    assert data["max x"].dims == ("k", "run")
    assert data["max x"].attrs["units"] == "m"
    assert data["max x"].sel(k=1.0).values[:4].tolist() == [0, 1, 2, 3]
    assert np.isnan(data["max x"].values).sum() == 26
    assert (data["status"].values == RunStatus.NOT_RUN).sum() == 26


def test_an_unfinished_store_knows_what_is_missing(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "a.zarr"
    with store.create(path, plan()) as made:
        made.write(4, PORTIONS.box(4), values(4))
    with store.resume(path, plan()) as again:
        assert np.flatnonzero(again.done).tolist() == [4]
        assert again.notices == []


def test_another_task_is_refused_and_the_difference_told(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "a.zarr"
    store.create(path, plan()).close()
    with pytest.raises(RunError, match="rtol was 1e-09, is 1e-06; grid k was 1:3:3, is 1:4:3; method was absent"):
        store.resume(path, plan(rtol=1e-6, grid={"k": "1:4:3"}, method="rk4"))


def test_what_exists_is_not_overwritten(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "a.zarr"
    store.create(path, plan()).close()
    with pytest.raises(Error, match=r"exists[\s\S]*resume"):
        store.create(path, plan())
    with store.create(path, plan(), overwrite=True) as made:
        assert not made.done.any()
    precious = tmp_path / "thesis"
    precious.mkdir()
    with pytest.raises(Error, match="is not a store of a sweep and is not replaced: it is an empty folder"):
        store.create(precious, plan(), overwrite=True)
    assert precious.is_dir()
    assert {p.name for p in tmp_path.iterdir()} == {"a.zarr", "thesis"}


def test_two_writers_at_once_are_refused(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "a.zarr"
    with store.create(path, plan()):
        with pytest.raises(Error, match="another process is writing"):
            store.resume(path, plan())
        with pytest.raises(Error, match="another process is writing"):
            store.create(path, plan(), overwrite=True)
    store.create(path, plan(), overwrite=True).close()


@pytest.mark.parametrize("what", ["nothing", "file", "folder", "other"])
def test_what_is_no_store_is_told(tmp_path: pathlib.Path, what: str) -> None:
    path = tmp_path / "a.zarr"
    if what == "file":
        path.write_text("hello")
    elif what == "folder":
        path.mkdir()
    elif what == "other":
        import zarr

        zarr.create_group(path)
    with pytest.raises(Error, match=r"there is no|is not a store of a sweep"):
        store.resume(path, plan())


def test_a_full_disk_loses_nothing(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.zarr"
    with store.create(path, plan()) as made:
        made.write(0, PORTIONS.box(0), values(0))

        class Full:
            def __setitem__(self, *_: object) -> None:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        monkeypatch.setitem(made._arrays, "x", Full())
        with pytest.raises(Error, match=r"no space left on device[\s\S]*4 runs are safely there"):
            made.write(1, PORTIONS.box(1), values(1))
    with store.resume(path, plan()) as again:
        assert np.flatnonzero(again.done).tolist() == [0]
    with pytest.raises(Error, match="no folder"):
        store.create(tmp_path / "nowhere" / "a.zarr", plan())


def test_without_zarr_the_line_that_installs_it_is_told(
    tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "zarr", None)
    with pytest.raises(MissingExtra, match=r"pip install 'lagrangian\[sweep\]'"):
        store.create(tmp_path / "a.zarr", plan())
